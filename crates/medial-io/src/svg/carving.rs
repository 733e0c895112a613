//! Pictures of tool paths, from above: moves coloured by depth, lifts between passes.
//!
//! A group that is not shown has each move in its exact form, one after another as they are made: the curve as
//! seen from above, `data-pass`, and in `data-z` the heights of its control points, with the weight of the
//! middle one if that is not 1.

use super::Options;
use super::canvas::{Anchor, Canvas, Data, number};
use super::frame::Frame;
use super::layers::{self, INK};
use super::legend::{self, QUIET, plural};
use super::palette::{STEPS, color};
use crate::number::shortest;
use crate::text::escaped;
use medial::geom::Point;
use medial::ops::{Carving, Move, Role, Stroke};

/// What a picture needs of the tool path of a shape.
#[derive(Clone, Debug)]
pub struct ToolPath {
    /// The closed boundary walks.
    pub boundary: Vec<Vec<Point>>,
    /// The tool path.
    pub carving: Carving,
}

/// Least width of a cut, in pixels.
const WIDTH: f64 = 1.4;
/// Parts of a move with a colour each, at most.
const MOST_PARTS: f64 = 16.0;
/// The colour of a flat floor.
const FLOOR: &str = "#eceff1";

/// The picture of the tool paths of some shapes in one frame.
#[must_use]
pub fn write_tool_paths(shapes: &[ToolPath], options: &Options) -> String {
    let corners = shapes.iter().flat_map(|shape| shape.boundary.iter().flatten());
    let moves = || shapes.iter().flat_map(|shape| &shape.carving.moves);
    let frame = Frame::over(corners.copied(), moves().count(), options);
    let mut canvas = Canvas::new(frame, options.lettering);
    layers::domain(&mut canvas, shapes.iter().map(|shape| &shape.boundary));
    floors(&mut canvas, shapes);
    layers::boundary(&mut canvas, shapes.iter().map(|shape| &shape.boundary));
    lifts(&mut canvas, shapes);
    let depth = |(_, cut): &(Role, Move)| -cut.from().z.min(cut.to().z);
    let deepest = moves().map(depth).fold(0.0, f64::max);
    for (class, is_floor, share) in [("clearing", true, 0.6), ("cuts", false, 1.0)] {
        let chosen = moves().filter(|(role, _)| (*role == Role::Floor) == is_floor);
        let layers = by_depth(&canvas.frame, chosen.map(|(_, cut)| cut), deepest);
        let width = number(share * canvas.frame.stroke.max(WIDTH));
        canvas.open(
            class,
            &format!("fill=\"none\" stroke-width=\"{width}\" stroke-linecap=\"round\""),
        );
        for (step, data) in layers.iter().enumerate() {
            canvas.path(data, &format!("stroke=\"{}\"", color(step)));
        }
        canvas.close();
    }
    legend::title(&mut canvas, options);
    if options.legend {
        let (left, right) = canvas.frame.margins();
        let y = canvas.frame.legend_y;
        legend::bar(&mut canvas, Point::new(left, y), deepest, "depth");
        let n_passes: usize = shapes.iter().map(|shape| shape.carving.passes.len()).sum();
        let counts = format!("{}, {}", plural(moves().count(), "move"), passes(n_passes));
        canvas.text(Point::new(right, y + 10.0), 12.0, Anchor::End, INK, &counts);
    }
    exact(&mut canvas, shapes);
    canvas.finish(&escaped(&options.title))
}

/// Every move as it is, not shown.
fn exact(canvas: &mut Canvas, shapes: &[ToolPath]) {
    canvas.open("moves", "display=\"none\"");
    for shape in shapes {
        for (number, pass) in shape.carving.passes.iter().enumerate() {
            for (_, cut) in shape.carving.steps(pass) {
                let mut data = Data::new(&canvas.frame);
                piece(&mut data, &cut, 0.0, 1.0);
                let data = data.text;
                let [from, to] = [cut.from(), cut.to()].map(|tip| shortest(tip.z));
                let heights = match cut {
                    Move::Line { .. } | Move::Arc { .. } => format!("{from} {to}"),
                    Move::Quadratic { control, .. } => {
                        format!("{from} {} {to}", shortest(control.z))
                    }
                    Move::Conic { control, weight, .. } => {
                        format!("{from} {} {to} {}", shortest(control.z), shortest(weight))
                    }
                };
                canvas.path(&data, &format!("data-pass=\"{number}\" data-z=\"{heights}\""));
            }
        }
    }
    canvas.close();
}

fn passes(n: usize) -> String {
    if n == 1 { "1 pass".to_owned() } else { format!("{n} passes") }
}

/// Flat floors.
fn floors(canvas: &mut Canvas, shapes: &[ToolPath]) {
    let mut data = Data::new(&canvas.frame);
    for polygon in shapes.iter().flat_map(|shape| &shape.carving.floor.polygons) {
        polygon.0.iter().for_each(|contour| data.contour(&contour.strokes()));
    }
    let data = data.text;
    canvas.path(&data, &format!("class=\"floor\" fill=\"{FLOOR}\" fill-rule=\"evenodd\""));
}

/// The ways from the end of each pass to the start of the next, above the material.
fn lifts(canvas: &mut Canvas, shapes: &[ToolPath]) {
    let mut data = Data::new(&canvas.frame);
    let mut last = None;
    for shape in shapes {
        for pass in &shape.carving.passes {
            let ends = |at: Option<(Role, Move)>| at.map(|(_, cut)| [cut.from(), cut.to()]);
            let first = ends(shape.carving.steps(pass).next()).map(|ends| ends[0].point);
            if let (Some(from), Some(to)) = (last, first) {
                data.move_to(from);
                data.line_to(to);
            }
            last = ends(shape.carving.steps(pass).last()).map(|ends| ends[1].point);
        }
    }
    let data = data.text;
    let style = format!(
        "class=\"lifts\" fill=\"none\" stroke=\"{QUIET}\" stroke-width=\"0.6\" stroke-dasharray=\"3 3\""
    );
    canvas.path(&data, &style);
}

/// The data of moves for each colour of depth; what runs through several colours is cut where they change.
fn by_depth<'m>(frame: &Frame, moves: impl Iterator<Item = &'m Move>, deepest: f64) -> Vec<String> {
    let mut layers: Vec<Data<'_>> = (0..STEPS).map(|_| Data::new(frame)).collect();
    let steps_of = |z: f64| if deepest > 0.0 { -z / deepest * STEPS as f64 } else { 0.0 };
    for cut in moves {
        let span = (steps_of(cut.to().z) - steps_of(cut.from().z)).abs();
        let n = span.ceil().clamp(1.0, MOST_PARTS);
        for k in 0..n as u32 {
            let [u, v] = [k, k + 1].map(|k| f64::from(k) / n);
            let step = steps_of(cut.at(0.5 * (u + v)).z) as usize;
            piece(&mut layers[step.min(STEPS - 1)], cut, u, v);
        }
    }
    layers.into_iter().map(|data| data.text).collect()
}

/// The part of a move between two parameters, as seen from above.
fn piece(data: &mut Data<'_>, cut: &Move, u: f64, v: f64) {
    data.move_to(cut.at(u).point);
    let to = cut.at(v).point;
    match *cut {
        Move::Quadratic { from, control, to: end } => {
            // The middle control point of the part.
            let weights = [(1.0 - u) * (1.0 - v), u * (1.0 - v) + v * (1.0 - u), u * v];
            let points = [from.point, control.point, end.point];
            let sum = |s: Point, (p, w): (Point, f64)| s + p * w;
            let control = points.into_iter().zip(weights).fold(Point::new(0.0, 0.0), sum);
            data.quadratic_to(control, to);
        }
        // One height, so one part.
        Move::Arc { from, to, centre, radius, sense, angle } => {
            let [from, to] = [from.point, to.point];
            data.stroke(&Stroke::Arc { from, to, centre, radius, sense, angle });
        }
        _ => data.line_to(to),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use medial::domain::{self, Domain};
    use medial::ops::{CarveOptions, carve};

    #[test]
    fn moves_are_drawn_as_what_they_are() {
        let p = |x: f64, y: f64| Point::new(x, y);
        let l = vec![p(0., 0.), p(20., 0.), p(20., 10.), p(10., 10.), p(10., 20.), p(0., 20.)];
        let domain =
            Domain::from_polygons(&[vec![l.clone()]], &domain::Options::default()).unwrap();
        let axis = medial::engine::path_tracing(&domain).unwrap();
        let options = CarveOptions { depth: Some(4.0), ..CarveOptions::with_angle(90.0) };
        let carving = carve(&domain, &axis, &options).unwrap();
        let shape = ToolPath { boundary: vec![l], carving };
        let picture = write_tool_paths(std::slice::from_ref(&shape), &Options::default());
        let group = |class: &str| {
            let start = picture.find(&format!("<g class=\"{class}\"")).unwrap();
            &picture[start..start + picture[start..].find("</g>").unwrap()]
        };
        // One wall is an arc around the reflex corner; five corners go down to the floor.
        assert_eq!(group("cuts").matches('A').count(), 1);
        assert!(group("cuts").matches("<path").count() > 10);
        // All moves once more, with their heights.
        assert!(group("moves").matches("data-z=\"-4 -4\"").count() >= 7);
        assert!(
            group("moves").contains("data-z=\"0 -4\"")
                || group("moves").contains("data-z=\"-4 0\"")
        );
        assert!(picture.contains("class=\"floor\"") && picture.contains(">depth<"));
        let full = carve(&domain, &axis, &CarveOptions::with_angle(90.0)).unwrap();
        let picture = write_tool_paths(&[ToolPath { carving: full, ..shape }], &Options::default());
        assert!(picture.contains('Q'), "parabolas are curves");
    }
}
