//! Pictures of thin walls: lines as wide as the shape, with their middles.

use super::Options;
use super::canvas::{Anchor, Canvas, Data, number};
use super::frame::Frame;
use super::layers::{self, INK};
use super::legend::{self, plural};
use crate::text::escaped;
use medial::geom::Point;

/// What a picture needs of the thin walls of a shape.
#[derive(Clone, Debug)]
pub struct ThinWalls {
    /// The closed boundary walks.
    pub boundary: Vec<Vec<Point>>,
    /// The points of each wall, and the width at each.
    pub walls: Vec<Vec<(Point, f64)>>,
}

/// The colour of what a pen as wide as the wall covers.
const BODY: &str = "#90caf9";
/// The colour of the middle.
const MIDDLE: &str = "#0d47a1";
/// Width of the middle, in pixels.
const WIDTH: f64 = 1.2;

/// The picture of the thin walls of some shapes in one frame.
#[must_use]
pub fn write_walls(shapes: &[ThinWalls], options: &Options) -> String {
    let corners = shapes.iter().flat_map(|shape| shape.boundary.iter().flatten());
    let walls = || shapes.iter().flat_map(|shape| &shape.walls);
    let frame = Frame::over(corners.copied(), walls().map(Vec::len).sum(), options);
    let mut canvas = Canvas::new(frame, options.lettering);
    layers::domain(&mut canvas, shapes.iter().map(|shape| &shape.boundary));
    let mut bodies = Data::new(&canvas.frame);
    let mut middles = Data::new(&canvas.frame);
    for wall in walls() {
        wall.iter().for_each(|&(p, width)| bodies.disk(p, 0.5 * width));
        for pair in wall.windows(2) {
            bodies.hull(pair[0], pair[1]);
        }
        match wall[..] {
            [(p, _)] => middles.dot(p),
            _ => wall.iter().enumerate().for_each(|(k, &(p, _))| {
                if k == 0 { middles.move_to(p) } else { middles.line_to(p) }
            }),
        }
    }
    let (bodies, middles) = (bodies.text, middles.text);
    // All pieces run the same way round, so what they share is filled as well.
    canvas.path(&bodies, &format!("class=\"walls\" fill=\"{BODY}\" fill-rule=\"nonzero\""));
    layers::boundary(&mut canvas, shapes.iter().map(|shape| &shape.boundary));
    let style = format!(
        "class=\"middles\" fill=\"none\" stroke=\"{MIDDLE}\" stroke-width=\"{}\" stroke-linecap=\"round\"",
        number(WIDTH)
    );
    canvas.path(&middles, &style);
    legend::title(&mut canvas, options);
    if options.legend {
        let at = Point::new(canvas.frame.margins().0, canvas.frame.legend_y + 10.0);
        canvas.open("legend", "");
        canvas.text(at, 12.0, Anchor::Start, INK, &plural(walls().count(), "wall"));
        canvas.close();
    }
    canvas.finish(&escaped(&options.title))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn walls_are_as_wide_as_they_are() {
        let p = |x: f64, y: f64| Point::new(x, y);
        let boundary = vec![vec![p(0., 0.), p(10., 0.), p(10., 1.), p(0., 1.)]];
        let walls = vec![vec![(p(0.5, 0.5), 1.0), (p(9.5, 0.5), 1.0)], vec![(p(5.0, 0.5), 0.5)]];
        let picture = write_walls(&[ThinWalls { boundary, walls }], &Options::default());
        // Half a width of 1 is 50 of the 1000 pixels of a length of 10.
        assert_eq!(picture.matches("A50 50 ").count(), 4);
        assert_eq!(picture.matches("A25 25 ").count(), 2);
        assert!(picture.contains(">2 walls<"));
    }
}
