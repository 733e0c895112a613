//! Pictures of parallel curves: contours coloured by distance, their arcs as arcs.

use super::Options;
use super::canvas::{Canvas, Data, number};
use super::frame::Frame;
use super::layers;
use super::legend;
use super::palette::{STEPS, color};
use crate::text::escaped;
use medial::geom::Point;
use medial::ops::{Contour, Outline, Stroke};

/// What a picture needs of the parallel curves of a shape.
#[derive(Clone, Debug)]
pub struct Parallels {
    /// The closed boundary walks.
    pub boundary: Vec<Vec<Point>>,
    /// Each with its distance, outward if negative.
    pub outlines: Vec<(f64, Outline)>,
}

/// Least width of a contour, in pixels.
const WIDTH: f64 = 1.2;

/// The picture of the parallel curves of some shapes in one frame.
#[must_use]
pub fn write_offsets(shapes: &[Parallels], options: &Options) -> String {
    let contours = |shape: &'_ Parallels| -> Vec<Stroke> {
        let polygons = shape.outlines.iter().flat_map(|(_, outline)| &outline.polygons);
        polygons.flat_map(|polygon| &polygon.0).flat_map(Contour::strokes).collect()
    };
    // Arcs of grown polygons reach beyond their ends.
    let drawn: Vec<Point> = shapes.iter().flat_map(contours).flat_map(extent).collect();
    let corners = shapes.iter().flat_map(|shape| shape.boundary.iter().flatten());
    let frame = Frame::over(corners.chain(&drawn).copied(), drawn.len(), options);
    let mut canvas = Canvas::new(frame, options.lettering);
    layers::domain(&mut canvas, shapes.iter().map(|shape| &shape.boundary));
    layers::boundary(&mut canvas, shapes.iter().map(|shape| &shape.boundary));
    let distances = || shapes.iter().flat_map(|shape| shape.outlines.iter().map(|o| o.0.abs()));
    let most = distances().fold(0.0, f64::max);
    let width = number(canvas.frame.stroke.max(WIDTH));
    canvas.open(
        "offsets",
        &format!("fill=\"none\" stroke-width=\"{width}\" stroke-linejoin=\"round\""),
    );
    for (distance, outline) in shapes.iter().flat_map(|shape| &shape.outlines) {
        let mut data = Data::new(&canvas.frame);
        for contour in outline.polygons.iter().flat_map(|polygon| &polygon.0) {
            data.contour(&contour.strokes());
        }
        let step = if most > 0.0 { (distance.abs() / most * STEPS as f64) as usize } else { 0 };
        let data = data.text;
        canvas.path(&data, &format!("stroke=\"{}\"", color(step)));
    }
    canvas.close();
    legend::title(&mut canvas, options);
    if options.legend {
        let at = Point::new(canvas.frame.margins().0, canvas.frame.legend_y);
        legend::bar(&mut canvas, at, most, "distance");
    }
    canvas.finish(&escaped(&options.title))
}

/// Points that hold a stroke.
fn extent(stroke: Stroke) -> Vec<Point> {
    match stroke {
        Stroke::Line { from, to } => vec![from, to],
        Stroke::Arc { from, to, centre, radius, sense, angle } => {
            let start = from - centre;
            let turned = |k: u32| {
                let angle = f64::from(k) / 8.0 * angle;
                let (sin, cos) = angle.sin_cos();
                let across = match sense {
                    medial::ops::Sense::Counterclockwise => start.perp(),
                    medial::ops::Sense::Clockwise => start.perp() * -1.0,
                };
                let way = start * cos + across * sin;
                centre + way * (radius / way.norm().max(f64::MIN_POSITIVE))
            };
            (1..8).map(turned).chain([from, to]).collect()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use medial::axis::Engine;
    use medial::domain::{self, Domain};
    use medial::engine::{self, exterior};
    use medial::ops::offsets;

    #[test]
    fn arcs_are_drawn_as_arcs() {
        let p = |x: f64, y: f64| Point::new(x, y);
        let square = vec![p(0., 0.), p(2., 0.), p(2., 2.), p(0., 2.)];
        let domain =
            Domain::from_polygons(&[vec![square.clone()]], &domain::Options::default()).unwrap();
        let options = engine::Options::default();
        let axis = exterior(&domain, Engine::PathTracing, None, &options).unwrap();
        let grown = offsets(&domain, &axis, &[1.0]).unwrap().remove(0);
        let shape = Parallels { boundary: vec![square], outlines: vec![(-1.0, grown)] };
        let picture = write_offsets(&[shape], &Options::default());
        let start = picture.find("<g class=\"offsets\"").unwrap();
        let group = &picture[start..start + picture[start..].find("</g>").unwrap()];
        assert_eq!((group.matches('A').count(), group.matches('L').count()), (4, 4));
        // Quarters of circles with a radius of a quarter of the width, counterclockwise.
        assert_eq!(group.matches("A250 250 0 0 0 ").count(), 4, "{group}");
        assert!(picture.contains(">distance<"));
    }
}
