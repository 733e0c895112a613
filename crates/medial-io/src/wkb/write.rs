use super::polygons::write_polygons;
use crate::Drawing;
use crate::path::{records, written_keypoints};
use crate::record::Shape;
use medial::axis::MedialAxis;
use medial::geom::Point;

const POINT: u32 = 1;
const LINE: u32 = 2;
const MULTI_POINT: u32 = 4;
const MULTI_LINE: u32 = 5;
const COLLECTION: u32 = 7;
/// What is added to the type of a geometry with heights.
const IN_SPACE: u32 = 1000;

/// The axis as one MULTILINESTRING, a line per path, little-endian; ISO types with heights.
///
/// With keypoints it is a collection of the lines and a MULTIPOINT.
#[must_use]
pub fn write(axis: &MedialAxis, drawing: Drawing) -> Vec<u8> {
    let mut out = Vec::new();
    let z = if drawing.radius_as_z { IN_SPACE } else { 0 };
    let tolerance = drawing.tolerance(axis);
    let keypoints = written_keypoints(axis, drawing);
    let is_collection = drawing.keypoints || !keypoints.is_empty();
    if is_collection {
        head(&mut out, COLLECTION + z);
        count(&mut out, 2);
    }
    head(&mut out, MULTI_LINE + z);
    let lines: Vec<_> = records(axis, drawing).collect();
    count(&mut out, lines.len());
    for record in lines {
        let points = record.points(drawing, tolerance);
        head(&mut out, LINE + z);
        count(&mut out, points.len());
        for (p, radius) in points {
            point(&mut out, p, drawing.radius_as_z.then_some(radius));
        }
    }
    if is_collection {
        head(&mut out, MULTI_POINT + z);
        count(&mut out, keypoints.len());
        for keypoint in keypoints {
            let keypoint = axis.keypoints().at(keypoint);
            head(&mut out, POINT + z);
            point(&mut out, keypoint.position, drawing.radius_as_z.then_some(keypoint.radius));
        }
    }
    out
}

/// A shape.
pub(crate) fn shape(out: &mut Vec<u8>, shape: &Shape) {
    match shape {
        Shape::Point(p) => {
            head(out, POINT);
            point(out, *p, None);
        }
        Shape::PointInSpace(p, z) => {
            head(out, POINT + IN_SPACE);
            point(out, *p, Some(*z));
        }
        Shape::Line(points) => {
            head(out, LINE);
            count(out, points.len());
            points.iter().for_each(|&p| point(out, p, None));
        }
        Shape::LineInSpace(points) => {
            head(out, LINE + IN_SPACE);
            count(out, points.len());
            points.iter().for_each(|&(p, z)| point(out, p, Some(z)));
        }
        Shape::Lines(lines) => {
            head(out, MULTI_LINE);
            count(out, lines.len());
            for line in lines {
                head(out, LINE);
                count(out, line.len());
                line.iter().for_each(|&p| point(out, p, None));
            }
        }
        Shape::Polygons(polygons) => out.extend(write_polygons(polygons)),
    }
}

pub(super) fn head(out: &mut Vec<u8>, kind: u32) {
    out.push(1);
    out.extend(kind.to_le_bytes());
}

pub(super) fn count(out: &mut Vec<u8>, count: usize) {
    out.extend((count as u32).to_le_bytes());
}

pub(super) fn point(out: &mut Vec<u8>, p: Point, radius: Option<f64>) {
    for value in [p.x, p.y].into_iter().chain(radius) {
        out.extend(value.to_le_bytes());
    }
}
