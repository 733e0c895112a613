//! Pictures of layers over the pixels of an image, once all features have told their lines.

use super::features::Run;
use super::place::tell_place;
use super::records::{Found, Plan};
use crate::args::{ImageArgs, ImageLayer};
use crate::failure::{Failure, Status};
use crate::report::Entry;
use crate::timings::{Stages, timed};
use medial::domain::Domain;
use medial::engine;
use medial::geom::{Point, Rect};
use medial::raster::Grid;
use medial_io::record::Shape;
use medial_io::svg::{LineStyle, Options, Overlay, OverlayLayer};
use medial_io::{Crs, Feature, Format, Layer, png, svg};

/// Lines of a layer in a picture.
pub type Drawn = (ImageLayer, Vec<Vec<Point>>);

/// Layers that are painted over an image, once all features have told theirs.
pub struct Painting {
    pub args: &'static ImageArgs,
    pub format: Format,
    pub title: String,
    pub overlay: Overlay,
    pub layers: Vec<ImageLayer>,
}

impl Painting {
    /// Runs a plan on a layer that comes from an input with this name, and paints what is no record.
    pub fn run(
        self,
        plan: &Plan,
        run: Run,
        input: &str,
        layer: Layer<'static>,
        work: impl Fn(
            &Feature,
            &Domain,
            &mut Stages,
            &engine::Options<'_>,
        ) -> Result<Found<Vec<Drawn>>, Entry>
        + Send
        + Sync
        + 'static,
    ) -> Result<Status, Failure> {
        let Self { args, format, title, overlay, layers } = self;
        let mut drawn = None;
        let status = plan.run_on(run, input, layer, work, |parts, stages| {
            timed(&mut stages.write, || {
                let picture = picture(args, format, title, overlay, &layers, parts)?;
                Ok(drawn.insert(picture).take_bytes())
            })
        })?;
        drawn.map_or(Ok(()), |picture| picture.tell_place(args))?;
        Ok(status)
    }
}

/// The lines of a shape; rings of polygons are not closed.
pub fn lines(shape: Shape) -> Vec<Vec<Point>> {
    match shape {
        Shape::Point(p) | Shape::PointInSpace(p, _) => vec![vec![p]],
        Shape::Line(points) => vec![points],
        Shape::LineInSpace(points) => vec![points.into_iter().map(|(p, _)| p).collect()],
        Shape::Lines(lines) => lines,
        Shape::Polygons(polygons) => polygons.into_iter().flatten().collect(),
        _ => Vec::new(),
    }
}

/// A picture, and where it lies.
struct Picture {
    bytes: Vec<u8>,
    is_png: bool,
    /// The pixels of PNG in the plane of a georeference, and its reference system.
    place: Option<(Grid, Option<Crs>)>,
}

impl Picture {
    fn take_bytes(&mut self) -> Vec<u8> {
        std::mem::take(&mut self.bytes)
    }

    /// Tells beside the file that was drawn where it lies, if it cannot tell it itself.
    fn tell_place(&self, args: &ImageArgs) -> Result<(), Failure> {
        let file = args.target.output.as_deref().filter(|_| self.is_png);
        let place = self.place.as_ref().map(|(grid, crs)| (grid, crs.as_ref()));
        tell_place(file, place, args.run.run.quiet)
    }
}

/// The picture of layers over the pixels of an image.
fn picture(
    args: &ImageArgs,
    format: Format,
    title: String,
    mut overlay: Overlay,
    layers: &[ImageLayer],
    parts: Vec<Vec<Drawn>>,
) -> Result<Picture, Failure> {
    let mut drawn: Vec<OverlayLayer> = layers.iter().map(|&layer| overlay_layer(layer)).collect();
    for (layer, lines) in parts.into_iter().flatten() {
        if let Some(number) = layers.iter().position(|&other| other == layer) {
            drawn[number].lines.extend(lines);
        }
    }
    overlay.layers = drawn;
    if let Some([a, b]) = args.window {
        let min = Point::new(a.x.min(b.x), a.y.min(b.y));
        let max = Point::new(a.x.max(b.x), a.y.max(b.y));
        overlay = overlay.within(Rect { min, max }).ok_or_else(|| {
            let name = args.input.display().to_string();
            Failure::file(&name, "has no pixel in --window; see where the image lies")
        })?;
    }
    let options = Options { title, ..Options::default() };
    if format == Format::Svg {
        let bytes = svg::write_overlay(&overlay, &options).into_bytes();
        return Ok(Picture { bytes, is_png: false, place: None });
    }
    let bytes = png::write_overlay(&overlay, &options);
    let bytes = bytes.map_err(|error| Failure::file("<picture>", error))?;
    let grid = png::overlay_grid(&overlay, &options);
    Ok(Picture {
        bytes,
        is_png: true,
        place: overlay.is_georeferenced.then_some((grid, overlay.crs)),
    })
}

fn overlay_layer(layer: ImageLayer) -> OverlayLayer {
    let style = match layer {
        ImageLayer::Border => LineStyle::BORDER,
        ImageLayer::Delaunay => LineStyle::DELAUNAY,
        ImageLayer::Crust => LineStyle::CRUST,
        ImageLayer::Dual => LineStyle::DUAL,
        ImageLayer::Nodes => LineStyle::NODES,
        ImageLayer::Axis => LineStyle::AXIS,
        ImageLayer::Change => LineStyle::CHANGE,
        ImageLayer::Gained => LineStyle::GAINED,
        ImageLayer::Lost => LineStyle::LOST,
    };
    let are_rings = layer == ImageLayer::Border || layer.is_of_changes();
    OverlayLayer { name: layer.name(), style, lines: Vec::new(), are_rings }
}
