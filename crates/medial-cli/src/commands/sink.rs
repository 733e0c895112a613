use crate::failure::Failure;
use crate::output::Output;
use crate::table::Table;
use medial::axis::{MedialAxis, Side};
use medial::domain::Domain;
use medial::ops::Significance;
use medial_io::svg::{Options, Scene};
use medial_io::{
    Crs, Drawing, Feature, Format, axis_document, csv, domain_tolerance, dxf, geojson, png, svg,
    wkb, wkt,
};
use std::path::Path;

/// Where axes go, in one format.
pub struct Sink {
    output: Output,
    format: Format,
    /// The row of column names of CSV, or what comes before the entities of DXF.
    head: String,
    crs: Option<Crs>,
    begun: bool,
    /// The rows of a table, until all are known.
    table: Option<Table>,
    /// How many entities of DXF have a handle.
    n_handles: u64,
}

/// Appends the axes of a feature, each with what was measured, in a format, or gives what to draw of them.
pub fn encode(
    format: Format,
    drawing: Drawing,
    feature: &Feature,
    domain: &Domain,
    axes: Vec<(MedialAxis, Vec<Significance>)>,
    bytes: &mut Vec<u8>,
) -> Vec<Scene> {
    let mut scenes = Vec::new();
    for (axis, measured) in axes {
        let mut drawing = drawing;
        if axis.side == Side::Exterior {
            drawing.tolerance.get_or_insert_with(|| domain_tolerance(domain));
        }
        let mut scene = encode_one(format, drawing, feature, (axis, &measured), bytes);
        // The boundary once.
        if let (Some(scene), true) = (&mut scene, scenes.is_empty()) {
            scene.boundary = boundary(domain);
        }
        scenes.extend(scene);
    }
    scenes
}

/// Appends one axis, or gives it to be drawn.
fn encode_one(
    format: Format,
    drawing: Drawing,
    feature: &Feature,
    (axis, measured): (MedialAxis, &[Significance]),
    bytes: &mut Vec<u8>,
) -> Option<Scene> {
    let text = match format {
        Format::GeoJson => {
            geojson::features(bytes, feature, &axis, measured, drawing);
            return None;
        }
        Format::GeoJsonLines => {
            geojson::feature_lines(bytes, feature, &axis, measured, drawing);
            return None;
        }
        Format::Wkt => wkt::write(&axis, drawing),
        Format::Dxf => {
            let mut entities = dxf::Entities::default();
            entities.axis(&axis, drawing.keypoints, drawing.radius_as_z);
            entities.into_text()
        }
        Format::Csv => csv::rows(feature, &axis, measured, drawing),
        Format::Svg | Format::Png => {
            return Some(Scene { boundary: Vec::new(), axis });
        }
        Format::Wkb => {
            bytes.extend(wkb::write(&axis, drawing));
            return None;
        }
        _ => axis_document::write(feature, &axis, measured),
    };
    bytes.extend_from_slice(text.as_bytes());
    None
}

/// The closed boundary walks of a domain.
pub fn boundary(domain: &Domain) -> Vec<Vec<medial::geom::Point>> {
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
        head: String,
        crs: Option<Crs>,
        quiet: bool,
    ) -> Result<Self, Failure> {
        Self::of_layers(path, format, head, crs, &[], quiet)
    }

    /// The same for features of several layers, which become tables of their own if the format is a GeoPackage.
    pub fn of_layers(
        path: Option<&Path>,
        format: Format,
        head: String,
        crs: Option<Crs>,
        layers: &[&str],
        quiet: bool,
    ) -> Result<Self, Failure> {
        let output = Output::create(path)?;
        if let Some(lost) = lost(format, crs.as_ref()).filter(|_| !quiet) {
            crate::progress::line(&format!("warning: {}: {lost}", output.name()));
        }
        let table = match path {
            Some(path) if format.is_table() => {
                let layers = if format == Format::Gpkg { layers } else { &[] };
                Some(Table::create(path, format, layers, quiet)?)
            }
            _ => None,
        };
        Ok(Self { output, format, head, crs, begun: false, table, n_handles: 0 })
    }

    /// Writes what [`encode`] made of axes that follow one another.
    pub fn write(&mut self, mut bytes: &[u8]) -> Result<(), Failure> {
        if bytes.is_empty() {
            return Ok(());
        }
        if let Some(table) = &mut self.table {
            return table.add(bytes);
        }
        if self.format == Format::GeoJsonSeq {
            for line in bytes.split_inclusive(|&byte| byte == b'\n') {
                self.output.write(&[b"\x1e", line].concat())?;
            }
            return Ok(());
        }
        if !self.begun && self.format == Format::GeoJson {
            bytes = bytes.strip_prefix(geojson::SEPARATOR).unwrap_or(bytes);
        }
        self.begin()?;
        if self.format == Format::Dxf {
            return self.output.write(&dxf::number(bytes, &mut self.n_handles));
        }
        self.output.write(bytes)
    }

    fn begin(&mut self) -> Result<(), Failure> {
        if std::mem::replace(&mut self.begun, true) {
            return Ok(());
        }
        match self.format {
            Format::GeoJson => self.output.write(geojson::header(self.crs.as_ref()).as_bytes()),
            Format::Csv | Format::Dxf => self.output.write(self.head.as_bytes()),
            _ => Ok(()),
        }
    }

    /// Writes what comes last, the picture if the format is one, and lets the output appear.
    pub fn finish(mut self, picture: &[u8]) -> Result<(), Failure> {
        if let Some(table) = self.table {
            return table.finish(self.output, self.crs.as_ref());
        }
        self.begin()?;
        if self.format == Format::GeoJson {
            self.output.write(geojson::FOOTER.as_bytes())?;
        }
        if self.format == Format::Dxf {
            self.output.write(dxf::FOOTER.as_bytes())?;
        }
        self.output.write(picture)?;
        self.output.finish()
    }
}

/// What to say of a reference system that a format cannot keep although its readers expect one: features of GeoJSON
/// without it are in longitudes and latitudes, which need none. Of bare coordinates and pictures nobody expects it.
pub fn lost(format: Format, crs: Option<&Crs>) -> Option<String> {
    const WGS_84: u32 = 4326;
    let crs = crs.filter(|crs| !crs.is_assumed() && crs.epsg_code() != Some(WGS_84))?;
    let why = match format {
        Format::GeoJson | Format::Maxis if crs.member().is_some() => return None,
        Format::GeoJson | Format::Maxis => "names systems by a code, and it has none that is known",
        Format::GeoJsonLines | Format::GeoJsonSeq => "has no place for it",
        // Where tables cannot keep it they say so themselves.
        _ => return None,
    };
    Some(format!("the reference system {crs} is not written: {format} {why}"))
}

/// What comes first in a format: the names of columns, or a head with the unit of the input.
pub fn head(format: Format, columns: String, units: Option<&str>) -> String {
    if format == Format::Dxf { dxf::header(units) } else { columns }
}

/// The picture of all axes; nothing for other formats.
pub fn draw(format: Format, scenes: &[Scene], options: &Options) -> Result<Vec<u8>, Failure> {
    match format {
        Format::Svg => Ok(svg::write(scenes, options).into_bytes()),
        Format::Png => {
            png::write(scenes, options).map_err(|error| Failure::file("<picture>", error))
        }
        _ => Ok(Vec::new()),
    }
}

/// The line above a picture of something: what it is, and the name of the input.
pub fn title(what: &str, input: &Path) -> String {
    match input.file_name() {
        Some(name) if input.as_os_str() != "-" => format!("{what} of {}", name.to_string_lossy()),
        _ => what.to_owned(),
    }
}
