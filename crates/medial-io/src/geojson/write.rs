use crate::json::{compact, quoted};
use crate::number::push_decimal;
use crate::path::{PathRecord, records};
use crate::{Drawing, Feature, Json};
use medial::axis::{MedialAxis, Path};
use medial::geom::Point;
use std::fmt::Write as _;

/// The end of a collection.
pub const FOOTER: &str = "\n]}\n";

/// About as many bytes as a path takes, without the properties of its source.
const PATH_BYTES: usize = 440;

/// The beginning of a collection, up to its first feature.
#[must_use]
pub fn header(crs: Option<&Json>) -> String {
    let crs = crs.map_or_else(String::new, |crs| format!("\"crs\":{},\n", compact(crs)));
    format!("{{\"type\":\"FeatureCollection\",\n{crs}\"features\":[\n")
}

/// The features of one axis, joined by commas and line ends: paths, then keypoints if asked for.
#[must_use]
pub fn features(source: &Feature, axis: &MedialAxis, drawing: Drawing) -> String {
    joined(source, axis, drawing, ",\n")
}

/// The same features, each on a line of its own.
#[must_use]
pub fn feature_lines(source: &Feature, axis: &MedialAxis, drawing: Drawing) -> String {
    let mut out = joined(source, axis, drawing, "\n");
    if !out.is_empty() {
        out.push('\n');
    }
    out
}

fn joined(source: &Feature, axis: &MedialAxis, drawing: Drawing, separator: &str) -> String {
    let tolerance = drawing.tolerance(axis);
    let common = common_properties(source, axis, drawing);
    let mut out = String::with_capacity(axis.paths().len() * (common.len() + PATH_BYTES));
    for record in records(axis) {
        separate(&mut out, separator);
        out.push_str("{\"type\":\"Feature\",\"properties\":{");
        path_properties(&mut out, &record, &common);
        out.push_str("},\"geometry\":{\"type\":\"LineString\",\"coordinates\":[");
        for (k, (p, radius)) in drawing.points(&record.curve, tolerance).into_iter().enumerate() {
            if k > 0 {
                out.push(',');
            }
            position(&mut out, p, drawing.radius_as_z.then_some(radius));
        }
        out.push_str("]}}");
    }
    if drawing.keypoints {
        keypoints(&mut out, axis, drawing, &common, separator);
    }
    out
}

fn keypoints(out: &mut String, axis: &MedialAxis, drawing: Drawing, common: &str, separator: &str) {
    for ((k, keypoint), degree) in axis.keypoints().iter().enumerate().zip(axis.degrees()) {
        separate(out, separator);
        let _ = write!(
            out,
            "{{\"type\":\"Feature\",\"properties\":{{{common}\"keypoint\":{k},\"kind\":\"{}\",\
             \"radius\":{:?},\"degree\":{degree},\"governors\":{:?}}},\
             \"geometry\":{{\"type\":\"Point\",\"coordinates\":",
            keypoint.kind,
            keypoint.radius,
            axis.governors(k as u32),
        );
        position(out, keypoint.position, drawing.radius_as_z.then_some(keypoint.radius));
        out.push_str("}}");
    }
}

fn path_properties(out: &mut String, record: &PathRecord, common: &str) {
    let curve = &record.curve;
    out.push_str(common);
    out.push_str("\"curve\":\"");
    out.push_str(curve.kind().name());
    out.push_str("\",");
    let mut number = |name: &str, value: f64| {
        out.push_str(name);
        push_decimal(out, value);
    };
    number("\"length\":", curve.length());
    number(",\"radius_min\":", curve.radius_min());
    number(",\"radius_max\":", curve.radius_max());
    number(",\"radius_start\":", curve.radius_from());
    number(",\"radius_end\":", curve.radius_to());
    for (name, end) in [(",\"kind_start\":\"", 0), ("\",\"kind_end\":\"", 1)] {
        out.push_str(name);
        out.push_str(record.ends[end].kind.name());
    }
    let Path { left, right, .. } = record.path;
    let _ = write!(out, "\",\"governor_left\":{left},\"governor_right\":{right}");
}

/// The properties every feature of one axis shares: those of the source, renamed where the name
/// is ours, then `feature`, `source_id` and `engine`. Ends with a comma.
fn common_properties(source: &Feature, axis: &MedialAxis, drawing: Drawing) -> String {
    let mut out = String::new();
    let names: Vec<&str> = source.properties.iter().map(|(name, _)| name.as_str()).collect();
    for (k, (name, value)) in source.properties.iter().enumerate() {
        let mut name = name.clone();
        // Prefix until the name is free, so that no property hides another.
        while is_ours(&name, drawing) || names[..k].contains(&name.as_str()) || {
            name != names[k] && names.contains(&name.as_str())
        } {
            name.insert_str(0, "source_");
        }
        let _ = write!(out, "{}:{},", quoted(&name), compact(value));
    }
    let _ = write!(out, "\"feature\":{},\"source_id\":", source.index);
    match &source.id {
        Some(id) => out.push_str(&compact(id)),
        None => out.push_str("null"),
    }
    let _ = write!(out, ",\"engine\":\"{}\",", axis.engine);
    out
}

fn is_ours(name: &str, drawing: Drawing) -> bool {
    const KEYPOINT: [&str; 5] = ["keypoint", "kind", "radius", "degree", "governors"];
    ["feature", "source_id", "engine"].contains(&name)
        || PathRecord::COLUMNS.contains(&name)
        || drawing.keypoints && KEYPOINT.contains(&name)
}

fn separate(out: &mut String, separator: &str) {
    if !out.is_empty() {
        out.push_str(separator);
    }
}

fn position(out: &mut String, p: Point, radius: Option<f64>) {
    let mut opening = '[';
    for value in [p.x, p.y].into_iter().chain(radius) {
        out.push(opening);
        push_decimal(out, value);
        opening = ',';
    }
    out.push(']');
}
