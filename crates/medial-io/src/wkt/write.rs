use crate::Drawing;
use crate::number::shortest;
use crate::path::records;
use medial::axis::{Curve, MedialAxis};

/// The axis as one MULTILINESTRING, a line per path, with its line end.
///
/// With keypoints it is a collection of the lines and a MULTIPOINT.
#[must_use]
pub fn write(axis: &MedialAxis, drawing: Drawing) -> String {
    let tolerance = drawing.tolerance(axis);
    let z = if drawing.radius_as_z { "Z " } else { "" };
    let lines = records(axis).map(|record| line(&record.curve, drawing, tolerance));
    let lines = format!("MULTILINESTRING {z}{}", group(lines));
    if !drawing.keypoints {
        return format!("{lines}\n");
    }
    let points = axis.keypoints().iter().map(|k| {
        let z =
            if drawing.radius_as_z { format!(" {}", shortest(k.radius)) } else { String::new() };
        format!("({} {}{z})", shortest(k.position.x), shortest(k.position.y))
    });
    format!("GEOMETRYCOLLECTION {z}({lines}, MULTIPOINT {z}{})\n", group(points))
}

/// One curve as LINESTRING.
pub(crate) fn line_string(curve: &Curve, drawing: Drawing, tolerance: f64) -> String {
    let z = if drawing.radius_as_z { "Z " } else { "" };
    format!("LINESTRING {z}{}", line(curve, drawing, tolerance))
}

fn line(curve: &Curve, drawing: Drawing, tolerance: f64) -> String {
    group(drawing.points(curve, tolerance).into_iter().map(|(p, radius)| {
        let mut point = format!("{} {}", shortest(p.x), shortest(p.y));
        if drawing.radius_as_z {
            point.push(' ');
            point.push_str(&shortest(radius));
        }
        point
    }))
}

fn group(items: impl Iterator<Item = String>) -> String {
    let items = items.collect::<Vec<_>>().join(", ");
    if items.is_empty() { "EMPTY".to_owned() } else { format!("({items})") }
}
