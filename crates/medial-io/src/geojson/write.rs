use crate::json::{compact, push_quoted};
use crate::number::decimal;
use crate::path::{PathRecord, measure_columns, records, written_keypoints};
use crate::{Crs, Drawing, Feature};
use medial::axis::{Engine, MedialAxis};
use medial::geom::Point;
use medial::ops::Significance;
use std::borrow::Cow;

/// The end of a collection.
pub const FOOTER: &str = "\n]}\n";

/// About as many bytes as a path takes, without the properties of its source.
const PATH_BYTES: usize = 440;

/// About as many bytes as the beginning of a feature takes.
const COMMON_BYTES: usize = 256;

/// About as many bytes as the radius and the position of a keypoint take.
const PLACE_BYTES: usize = 64;

/// The beginning of a collection, up to its first feature.
#[must_use]
pub fn header(crs: Option<&Crs>) -> String {
    let member = crs.and_then(Crs::member);
    let crs = member.map_or_else(String::new, |crs| format!("\"crs\":{},\n", compact(&crs)));
    format!("{{\"type\":\"FeatureCollection\",\n{crs}\"features\":[\n")
}

/// Stands before every feature of a collection but the first.
pub const SEPARATOR: &[u8] = b",\n";

/// Appends the features of one axis, each behind a [`SEPARATOR`]: paths with the values that were
/// measured, then keypoints if asked for; those without a path in any case, for nothing else shows what was
/// pruned to a point.
pub fn features(
    out: &mut Vec<u8>,
    source: &Feature,
    axis: &MedialAxis,
    measured: &[Significance],
    drawing: Drawing,
) {
    write(out, source, axis, measured, drawing, [SEPARATOR, b""]);
}

/// Appends the same features, each on a line of its own.
pub fn feature_lines(
    out: &mut Vec<u8>,
    source: &Feature,
    axis: &MedialAxis,
    measured: &[Significance],
    drawing: Drawing,
) {
    write(out, source, axis, measured, drawing, [b"", b"\n"]);
}

/// Writes each feature between two texts.
fn write(
    out: &mut Vec<u8>,
    source: &Feature,
    axis: &MedialAxis,
    measured: &[Significance],
    drawing: Drawing,
    [before, after]: [&[u8]; 2],
) {
    let tolerance = drawing.tolerance(axis);
    let keypoints = written_keypoints(axis, drawing);
    let degrees = if keypoints.is_empty() { Vec::new() } else { axis.degrees() };
    let drawing = Drawing { keypoints: drawing.keypoints || !keypoints.is_empty(), ..drawing };
    let columns: Vec<_> = measured.iter().flat_map(measure_columns).collect();
    let ours = |name: &str| is_ours(name, drawing) || columns.iter().any(|ours| ours == name);
    let mut common = beginning(source, Some(axis.engine), ours, before);
    if drawing.side {
        common.extend_from_slice(b"\"side\":\"");
        common.extend_from_slice(axis.side.name().as_bytes());
        common.extend_from_slice(b"\",");
    }
    let places = Places::new(axis, drawing);
    out.reserve(axis.paths().len() * (common.len() + PATH_BYTES));
    for record in records(axis, drawing) {
        out.extend_from_slice(&common);
        path_properties(out, &record, &places);
        let values = measured.iter().flat_map(|measured| record.values(measured));
        for (name, value) in columns.iter().zip(values) {
            out.extend_from_slice(b",\"");
            out.extend_from_slice(name.as_bytes());
            out.extend_from_slice(b"\":");
            match value {
                Some(value) => number(out, value),
                None => out.extend_from_slice(b"null"),
            }
        }
        out.extend_from_slice(b"},\"geometry\":{\"type\":\"LineString\",\"coordinates\":[");
        out.extend_from_slice(places.position(record.path.from));
        out.push(b',');
        if !record.curves.iter().all(|curve| drawing.is_straight(curve)) || record.curves.len() > 1
        {
            let points = record.points(drawing, tolerance);
            for &(p, radius) in &points[1..points.len() - 1] {
                position(out, p, drawing.radius_as_z.then_some(radius));
                out.push(b',');
            }
        }
        out.extend_from_slice(places.position(record.path.to));
        out.extend_from_slice(b"]}}");
        out.extend_from_slice(after);
    }
    for (k, degree) in keypoints.into_iter().map(|k| (k, degrees[k as usize])) {
        let keypoint = axis.keypoints().at(k);
        out.extend_from_slice(&common);
        let properties = format!(
            "\"keypoint\":{k},\"kind\":\"{}\",\
             \"radius\":{:?},\"degree\":{degree},\"governors\":{:?}}},\
             \"geometry\":{{\"type\":\"Point\",\"coordinates\":",
            keypoint.kind,
            keypoint.radius,
            axis.governors(k),
        );
        out.extend_from_slice(properties.as_bytes());
        out.extend_from_slice(places.position(k));
        out.extend_from_slice(b"}}");
        out.extend_from_slice(after);
    }
}

/// The properties of a path behind its beginning.
fn path_properties(out: &mut Vec<u8>, record: &PathRecord, places: &Places) {
    let PathRecord { path, ends: [from, to], .. } = record;
    let radii = [places.radius(path.from), places.radius(path.to)];
    out.extend_from_slice(b"\"curve\":\"");
    out.extend_from_slice(record.kind.name().as_bytes());
    out.extend_from_slice(b"\",\"length\":");
    number(out, record.length());
    let extreme = |out: &mut Vec<u8>, radius: f64| {
        // Mostly that of an end.
        match [from, to].iter().position(|k| k.radius.to_bits() == radius.to_bits()) {
            Some(end) => out.extend_from_slice(radii[end]),
            None => number(out, radius),
        }
    };
    out.extend_from_slice(b",\"radius_min\":");
    extreme(out, record.radius_min());
    out.extend_from_slice(b",\"radius_max\":");
    extreme(out, record.radius_max());
    out.extend_from_slice(b",\"radius_start\":");
    out.extend_from_slice(radii[0]);
    out.extend_from_slice(b",\"radius_end\":");
    out.extend_from_slice(radii[1]);
    out.extend_from_slice(b",\"kind_start\":\"");
    out.extend_from_slice(from.kind.name().as_bytes());
    out.extend_from_slice(b"\",\"kind_end\":\"");
    out.extend_from_slice(to.kind.name().as_bytes());
    out.push(b'"');
    let mut digits = itoa::Buffer::new();
    for (name, site) in ["left", "right"].into_iter().zip(record.governors()) {
        out.extend_from_slice(b",\"governor_");
        out.extend_from_slice(name.as_bytes());
        out.extend_from_slice(b"\":");
        let site = site.map_or("null", |site| digits.format(site));
        out.extend_from_slice(site.as_bytes());
    }
}

/// Radii and positions of the keypoints as they are written, each several times.
struct Places {
    text: Vec<u8>,
    /// Where the radius and the position of each keypoint end.
    ends: Vec<[usize; 2]>,
}

impl Places {
    fn new(axis: &MedialAxis, drawing: Drawing) -> Self {
        let n = axis.keypoints().len();
        let mut places = Self { text: Vec::with_capacity(PLACE_BYTES * n), ends: Vec::new() };
        places.ends.reserve_exact(n);
        for keypoint in axis.keypoints() {
            number(&mut places.text, keypoint.radius);
            let radius = places.text.len();
            position(
                &mut places.text,
                keypoint.position,
                drawing.radius_as_z.then_some(keypoint.radius),
            );
            places.ends.push([radius, places.text.len()]);
        }
        places
    }

    fn radius(&self, keypoint: u32) -> &[u8] {
        let start = keypoint.checked_sub(1).map_or(0, |last| self.ends[last as usize][1]);
        &self.text[start..self.ends[keypoint as usize][0]]
    }

    /// The coordinates in their brackets.
    fn position(&self, keypoint: u32) -> &[u8] {
        let [start, end] = self.ends[keypoint as usize];
        &self.text[start..end]
    }
}

/// How every feature of one axis begins, behind `before`: with the properties of the source,
/// renamed where the name `is_ours`, then `feature`, `source_id` and `engine`. Ends with a comma.
pub(crate) fn beginning(
    source: &Feature,
    engine: Option<Engine>,
    is_ours: impl Fn(&str) -> bool,
    before: &[u8],
) -> Vec<u8> {
    let mut out = Vec::with_capacity(COMMON_BYTES);
    out.extend_from_slice(before);
    out.extend_from_slice(b"{\"type\":\"Feature\",\"properties\":{");
    let properties = &source.properties;
    let is_name = |name: &str, n: usize| properties[..n].iter().any(|(other, _)| other == name);
    for (k, (name, value)) in properties.iter().enumerate() {
        let mut name = Cow::Borrowed(name.as_str());
        // Prefix until the name is free, so that no property hides another.
        while is_ours(&name) || is_name(&name, k) || {
            name != properties[k].0 && is_name(&name, properties.len())
        } {
            name.to_mut().insert_str(0, "source_");
        }
        push_quoted(&mut out, &name);
        out.push(b':');
        out.extend_from_slice(compact(value).as_bytes());
        out.push(b',');
    }
    out.extend_from_slice(b"\"feature\":");
    out.extend_from_slice(itoa::Buffer::new().format(source.index).as_bytes());
    out.extend_from_slice(b",\"source_id\":");
    match &source.id {
        Some(id) => out.extend_from_slice(compact(id).as_bytes()),
        None => out.extend_from_slice(b"null"),
    }
    if let Some(engine) = engine {
        out.extend_from_slice(b",\"engine\":\"");
        out.extend_from_slice(engine.name().as_bytes());
        out.push(b'"');
    }
    out.push(b',');
    out
}

/// The properties of every feature that [`beginning`] writes.
pub(crate) const COMMON: [&str; 3] = ["feature", "source_id", "engine"];

fn is_ours(name: &str, drawing: Drawing) -> bool {
    const KEYPOINT: [&str; 5] = ["keypoint", "kind", "radius", "degree", "governors"];
    COMMON.contains(&name)
        || drawing.side && name == "side"
        || PathRecord::COLUMNS.contains(&name)
        || drawing.keypoints && KEYPOINT.contains(&name)
}

pub(crate) fn position(out: &mut Vec<u8>, p: Point, radius: Option<f64>) {
    out.push(b'[');
    number(out, p.x);
    out.push(b',');
    number(out, p.y);
    if let Some(radius) = radius {
        out.push(b',');
        number(out, radius);
    }
    out.push(b']');
}

pub(crate) fn number(out: &mut Vec<u8>, value: f64) {
    decimal(value, |text| out.extend_from_slice(text.as_bytes()));
}
