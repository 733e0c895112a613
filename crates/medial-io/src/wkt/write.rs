use crate::Drawing;
use crate::number::push_shortest;
use crate::path::{records, written_keypoints};
use crate::record::Shape;
use medial::axis::MedialAxis;
use medial::geom::Point;

/// The axis as one MULTILINESTRING, a line per path, with its line end.
///
/// With keypoints, or if pruning left points, it is a collection of the lines and a MULTIPOINT.
#[must_use]
pub fn write(axis: &MedialAxis, drawing: Drawing) -> String {
    let tolerance = drawing.tolerance(axis);
    let z = if drawing.radius_as_z { "Z " } else { "" };
    let mut out = String::with_capacity(LINE_BYTES * axis.paths().len());
    let keypoints = written_keypoints(axis, drawing);
    let is_collection = drawing.keypoints || !keypoints.is_empty();
    if is_collection {
        out.extend(["GEOMETRYCOLLECTION ", z, "("]);
    }
    out.extend(["MULTILINESTRING ", z]);
    group(&mut out, records(axis, drawing), |out, record| {
        points(out, &record.points(drawing, tolerance), drawing.radius_as_z);
    });
    if is_collection {
        out.extend([", MULTIPOINT ", z]);
        group(&mut out, keypoints, |out, keypoint| {
            let keypoint = axis.keypoints().at(keypoint);
            out.push('(');
            point(out, keypoint.position, drawing.radius_as_z.then_some(keypoint.radius));
            out.push(')');
        });
        out.push(')');
    }
    out.push('\n');
    out
}

/// Lines, each of points with a radius, as one MULTILINESTRING with its line end; with the radius as
/// third coordinate if asked for.
#[must_use]
pub fn write_lines(lines: &[Vec<(Point, f64)>], radius_as_z: bool) -> String {
    let mut out = String::from(if radius_as_z { "MULTILINESTRING Z " } else { "MULTILINESTRING " });
    group(&mut out, lines, |out, line| points(out, line, radius_as_z));
    out.push('\n');
    out
}

/// A shape, without a line end.
pub(crate) fn shape(out: &mut String, shape: &Shape) {
    let ring = |out: &mut String, ring: &Vec<Point>| {
        group(out, ring.iter().chain(ring.first()), |out, &p| point(out, p, None));
    };
    match shape {
        Shape::Point(p) => {
            out.push_str("POINT ");
            group(out, [p], |out, &p| point(out, p, None));
        }
        Shape::PointInSpace(p, z) => {
            out.push_str("POINT Z ");
            group(out, [p], |out, &p| point(out, p, Some(*z)));
        }
        Shape::Line(points) => {
            out.push_str("LINESTRING ");
            group(out, points, |out, &p| point(out, p, None));
        }
        Shape::LineInSpace(points) => drawn_line(out, points, true),
        Shape::Lines(lines) => {
            out.push_str("MULTILINESTRING ");
            group(out, lines, |out, line| group(out, line, |out, &p| point(out, p, None)));
        }
        Shape::Polygons(polygons) => match &polygons[..] {
            [polygon] => {
                out.push_str("POLYGON ");
                group(out, polygon, ring);
            }
            polygons => {
                out.push_str("MULTIPOLYGON ");
                group(out, polygons, |out, polygon| group(out, polygon, ring));
            }
        },
    }
}

/// Points with a radius as LINESTRING.
pub(crate) fn drawn_line(out: &mut String, line: &[(Point, f64)], radius_as_z: bool) {
    out.push_str(if radius_as_z { "LINESTRING Z " } else { "LINESTRING " });
    points(out, line, radius_as_z);
}

fn points(out: &mut String, line: &[(Point, f64)], radius_as_z: bool) {
    group(out, line, |out, &(p, radius)| point(out, p, radius_as_z.then_some(radius)));
}

/// About as many bytes as a line takes.
const LINE_BYTES: usize = 100;

fn point(out: &mut String, p: Point, radius: Option<f64>) {
    push_shortest(out, p.x);
    for value in [p.y].into_iter().chain(radius) {
        out.push(' ');
        push_shortest(out, value);
    }
}

/// The items in brackets, or `EMPTY`.
fn group<T>(out: &mut String, items: impl IntoIterator<Item = T>, item: impl Fn(&mut String, T)) {
    let mut opening = "(";
    for each in items {
        out.push_str(opening);
        item(out, each);
        opening = ", ";
    }
    out.push_str(if opening == "(" { "EMPTY" } else { ")" });
}
