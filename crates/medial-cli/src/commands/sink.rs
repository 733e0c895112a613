use crate::failure::Failure;
use crate::output::Output;
use medial::axis::MedialAxis;
use medial::domain::Domain;
use medial_io::svg::{Options, Scene};
use medial_io::{Drawing, Feature, Format, Json, axis_document, csv, geojson, png, svg, wkb, wkt};
use std::path::Path;

/// Where axes go, in one format.
pub struct Sink {
    output: Output,
    format: Format,
    crs: Option<Json>,
    picture: Options,
    scenes: Vec<Scene>,
    begun: bool,
    separated: bool,
}

/// What a thread makes of an axis, for the sink.
pub enum Chunk {
    Bytes(Vec<u8>),
    Scene(Box<Scene>),
}

/// The axis of a feature in a format.
pub fn encode(
    format: Format,
    drawing: Drawing,
    feature: &Feature,
    domain: &Domain,
    axis: MedialAxis,
) -> Chunk {
    let text = match format {
        Format::GeoJson => geojson::features(feature, &axis, drawing),
        Format::GeoJsonLines => geojson::feature_lines(feature, &axis, drawing),
        Format::Wkt => wkt::write(&axis, drawing),
        Format::Csv => csv::rows(feature, &axis, drawing),
        Format::Svg | Format::Png => {
            return Chunk::Scene(Box::new(Scene { boundary: boundary(domain), axis }));
        }
        Format::Wkb => return Chunk::Bytes(wkb::write(&axis, drawing)),
        _ => axis_document::write(feature, &axis),
    };
    Chunk::Bytes(text.into_bytes())
}

fn boundary(domain: &Domain) -> Vec<Vec<medial::geom::Point>> {
    let edges = |walk: &medial::domain::Walk| {
        let first = walk.first as usize;
        domain.edges()[first..first + walk.len as usize].iter().map(|edge| edge.start).collect()
    };
    domain.walks().iter().map(edges).collect()
}

impl Sink {
    pub fn create(
        path: Option<&Path>,
        format: Format,
        crs: Option<Json>,
        picture: Options,
    ) -> Result<Self, Failure> {
        Ok(Self {
            output: Output::create(path)?,
            format,
            crs,
            picture,
            scenes: Vec::new(),
            begun: false,
            separated: true,
        })
    }

    pub fn add(&mut self, chunk: Chunk) -> Result<(), Failure> {
        match chunk {
            Chunk::Scene(scene) => self.scenes.push(*scene),
            Chunk::Bytes(bytes) if bytes.is_empty() => {}
            Chunk::Bytes(bytes) => {
                self.begin()?;
                if !self.separated {
                    self.output.write(b",\n")?;
                }
                self.separated = self.format != Format::GeoJson;
                self.output.write(&bytes)?;
            }
        }
        Ok(())
    }

    fn begin(&mut self) -> Result<(), Failure> {
        if std::mem::replace(&mut self.begun, true) {
            return Ok(());
        }
        match self.format {
            Format::GeoJson => self.output.write(geojson::header(self.crs.as_ref()).as_bytes()),
            Format::Csv => self.output.write(csv::header().as_bytes()),
            _ => Ok(()),
        }
    }

    /// Writes what comes last, and lets the output appear.
    pub fn finish(mut self) -> Result<(), Failure> {
        self.begin()?;
        match self.format {
            Format::GeoJson => self.output.write(geojson::FOOTER.as_bytes())?,
            Format::Svg => {
                let picture = svg::write(&self.scenes, &self.picture);
                self.output.write(picture.as_bytes())?;
            }
            Format::Png => {
                let picture = png::write(&self.scenes, &self.picture)
                    .map_err(|error| Failure::file("<picture>", error))?;
                self.output.write(&picture)?;
            }
            _ => {}
        }
        self.output.finish()
    }
}
