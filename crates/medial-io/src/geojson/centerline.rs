//! Centerlines: a LineString for each, with the widths along it.

use super::write::{COMMON, SEPARATOR, beginning, number, position};
use crate::Feature;
use medial::axis::Engine;
use medial::geom::Point;
use medial::ops::{Centerline, Widths};
use std::io::Write as _;

/// The properties of lines besides.
const OURS: [&str; 8] =
    ["rank", "length", "width_min", "width_max", "width_mean", "closed", "is_best", "widths"];

/// Appends the lines of one feature, each behind a [`SEPARATOR`], as [`polylines`](medial::ops::polylines)
/// has drawn them; with the distance of the boundary as third coordinate if asked for.
pub fn centerline_features(
    out: &mut Vec<u8>,
    source: &Feature,
    engine: Engine,
    lines: &[Centerline],
    drawn: &[Vec<(Point, f64)>],
    radius_as_z: bool,
) {
    write(out, source, engine, lines, (drawn, radius_as_z), [SEPARATOR, b""]);
}

/// Appends the same features, each on a line of its own.
pub fn centerline_lines(
    out: &mut Vec<u8>,
    source: &Feature,
    engine: Engine,
    lines: &[Centerline],
    drawn: &[Vec<(Point, f64)>],
    radius_as_z: bool,
) {
    write(out, source, engine, lines, (drawn, radius_as_z), [b"", b"\n"]);
}

/// Writes each feature between two texts.
fn write(
    out: &mut Vec<u8>,
    source: &Feature,
    engine: Engine,
    lines: &[Centerline],
    (drawn, radius_as_z): (&[Vec<(Point, f64)>], bool),
    [before, after]: [&[u8]; 2],
) {
    let ours = |name: &str| COMMON.contains(&name) || OURS.contains(&name);
    let common = beginning(source, Some(engine), ours, before);
    for ((rank, line), points) in (1..).zip(lines).zip(drawn) {
        out.extend_from_slice(&common);
        // Memory takes all that is written.
        let _ = write!(out, "\"rank\":{rank},\"length\":");
        number(out, line.length());
        let Widths { least, greatest, mean } = line.widths();
        for (name, value) in [("min", least), ("max", greatest), ("mean", mean)] {
            let _ = write!(out, ",\"width_{name}\":");
            number(out, value);
        }
        let (closed, best) = (line.is_closed(), line.is_best);
        let _ = write!(out, ",\"closed\":{closed},\"is_best\":{best},\"widths\":[");
        for (k, (_, radius)) in points.iter().enumerate() {
            out.extend_from_slice(if k > 0 { b"," } else { b"" });
            number(out, 2.0 * radius);
        }
        out.extend_from_slice(b"]},\"geometry\":{\"type\":\"LineString\",\"coordinates\":[");
        for (k, &(point, radius)) in points.iter().enumerate() {
            out.extend_from_slice(if k > 0 { b"," } else { b"" });
            position(out, point, radius_as_z.then_some(radius));
        }
        out.extend_from_slice(b"]}}");
        out.extend_from_slice(after);
    }
}
