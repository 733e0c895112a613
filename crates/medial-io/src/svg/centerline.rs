//! Pictures of centerlines: the first line of each shape, and the others thinner.

use super::Options;
use super::canvas::{Anchor, Canvas, Data, number};
use super::frame::Frame;
use super::layers::{self, INK};
use super::legend::{self, plural};
use crate::text::escaped;
use medial::geom::Point;

/// What a picture needs of the lines of a shape.
#[derive(Clone, Debug)]
pub struct MainLines {
    /// The closed boundary walks.
    pub boundary: Vec<Vec<Point>>,
    /// The points of each line, the best first.
    pub lines: Vec<Vec<Point>>,
}

/// The colour of lines.
const LINE: &str = "#c62828";
/// Least width of a first line, in pixels; others are half as wide.
const WIDTH: f64 = 2.0;

/// The picture of the lines of some shapes in one frame.
#[must_use]
pub fn write_lines(shapes: &[MainLines], options: &Options) -> String {
    // A line may go on beyond its shape, to a point that was given.
    let lines = shapes.iter().flat_map(|shape| shape.lines.iter().flatten());
    let corners = shapes.iter().flat_map(|shape| shape.boundary.iter().flatten()).chain(lines);
    let n = shapes.iter().map(|shape| shape.lines.len()).sum();
    let mut canvas = Canvas::new(Frame::over(corners.copied(), n, options), options.lettering);
    layers::domain(&mut canvas, shapes.iter().map(|shape| &shape.boundary));
    layers::boundary(&mut canvas, shapes.iter().map(|shape| &shape.boundary));
    let width = canvas.frame.stroke.max(WIDTH);
    let others = shapes.iter().flat_map(|shape| shape.lines.iter().skip(1));
    draw(&mut canvas, "others", 0.5 * width, others);
    draw(&mut canvas, "lines", width, shapes.iter().filter_map(|shape| shape.lines.first()));
    legend::title(&mut canvas, options);
    if options.legend {
        let at = Point::new(canvas.frame.margins().0, canvas.frame.legend_y + 10.0);
        canvas.open("legend", "");
        canvas.text(at, 12.0, Anchor::Start, INK, &plural(n, "line"));
        canvas.close();
    }
    canvas.finish(&escaped(&options.title))
}

fn draw<'l>(
    canvas: &mut Canvas,
    class: &str,
    width: f64,
    lines: impl Iterator<Item = &'l Vec<Point>>,
) {
    let mut data = Data::new(&canvas.frame);
    for line in lines {
        for (k, &p) in line.iter().enumerate() {
            if k == 0 { data.move_to(p) } else { data.line_to(p) }
        }
    }
    let style = format!(
        "fill=\"none\" stroke=\"{LINE}\" stroke-width=\"{}\" stroke-linecap=\"round\" \
         stroke-linejoin=\"round\"",
        number(width)
    );
    let data = data.text;
    canvas.open(class, &style);
    canvas.path(&data, "");
    canvas.close();
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_lines_and_others_are_drawn_apart() {
        let p = |x: f64, y: f64| Point::new(x, y);
        let boundary = vec![vec![p(0.0, 0.0), p(4.0, 0.0), p(4.0, 2.0), p(0.0, 2.0)]];
        let lines =
            vec![vec![p(1.0, 1.0), p(3.0, 1.0)], vec![p(2.0, 0.0), p(2.0, 1.0), p(2.0, 2.0)]];
        let picture = write_lines(&[MainLines { boundary, lines }], &Options::default());
        let group = |class: &str| {
            let start = picture.find(&format!("<g class=\"{class}\"")).unwrap();
            &picture[start..start + picture[start..].find("</g>").unwrap()]
        };
        assert_eq!(
            (group("lines").matches('L').count(), group("others").matches('L').count()),
            (1, 2)
        );
        assert!(picture.contains(">2 lines<"));
    }
}
