//! The axis document: JSON Lines, one medial axis a line.
//!
//! Its JSON Schema is `schema/axis.schema.json` of this crate, also in [`SCHEMA`].

use crate::json::parse;
use crate::path::{PathRecord, records, shown_keypoints};
use crate::text::{lines, offset, syntax_at};
use crate::{Content, Drawing, Error, Feature, FeatureError, Format, Json, Layer, maxis};

use medial::axis::{
    Accuracy, CurveKind, Engine, Joining, KeypointKind, MedialAxis, Path, Side, Site,
};
use medial::axis::{SiteKind, UnknownName};
use medial::geom::Point;
use medial::ops::{Significance, polygons_of};
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::str::FromStr;

/// The JSON Schema of a document.
pub const SCHEMA: &str = include_str!("../schema/axis.schema.json");

/// An axis read from a document.
#[derive(Clone, Debug)]
pub struct AxisDocument {
    /// Number of the feature in the input it was computed from.
    pub feature: usize,
    /// Identifier of that feature.
    pub id: Option<Json>,
    /// The axis.
    pub axis: MedialAxis,
    /// How far its shape is at most from what it was made of, in units of the input, if that is known.
    pub error: Option<f64>,
}

#[derive(Serialize, Deserialize)]
#[serde(expecting = "an axis document")]
struct Document<'a> {
    #[serde(borrow, rename = "type")]
    kind: Cow<'a, str>,
    version: u32,
    #[serde(borrow)]
    engine: Cow<'a, str>,
    #[serde(borrow)]
    accuracy: AccuracyRecord<'a>,
    complete: bool,
    #[serde(borrow)]
    side: Cow<'a, str>,
    feature: usize,
    #[serde(borrow, default)]
    id: Option<&'a RawValue>,
    #[serde(borrow)]
    sites: Vec<SiteRecord<'a>>,
    #[serde(borrow)]
    keypoints: Vec<KeypointRecord<'a>>,
    #[serde(borrow)]
    paths: Vec<PathJson<'a>>,
}

#[derive(Serialize, Deserialize)]
#[serde(untagged, expecting = "`exact` or {\"sampled\": distance}")]
enum AccuracyRecord<'a> {
    Word(#[serde(borrow)] Cow<'a, str>),
    Sampled { sampled: f64 },
}

#[derive(Serialize, Deserialize)]
pub(crate) struct SiteRecord<'a> {
    #[serde(borrow)]
    kind: Cow<'a, str>,
    polygon: u32,
    ring: u32,
    index: u32,
    #[serde(default, skip_serializing_if = "is_zero")]
    part: u32,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    a: Option<[f64; 2]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    b: Option<[f64; 2]>,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    p: Option<[f64; 2]>,
}

#[derive(Serialize, Deserialize)]
struct KeypointRecord<'a> {
    x: f64,
    y: f64,
    radius: f64,
    #[serde(borrow)]
    kind: Cow<'a, str>,
    governors: Cow<'a, [u32]>,
}

#[derive(Serialize, Deserialize)]
struct PathJson<'a> {
    from: u32,
    to: u32,
    governors: [u32; 2],
    #[serde(borrow)]
    curve: Cow<'a, str>,
    /// Samples of a polyline, ends included: x, y, radius.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    points: Vec<[f64; 3]>,
    /// For each measure the largest value, that at the start and that at the end.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty", skip_deserializing)]
    measures: BTreeMap<&'static str, [Option<f64>; 3]>,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "the signature serde asks for")]
fn is_zero(part: &u32) -> bool {
    *part == 0
}

/// The document of one axis, with the values that were measured and its line end.
#[must_use]
pub fn write(source: &Feature, axis: &MedialAxis, measured: &[Significance]) -> String {
    // Samples are points of their path, not keypoints.
    let drawing = Drawing { by: Some(Joining::Governors), ..Drawing::default() };
    let shown = shown_keypoints(axis, drawing);
    let mut number = vec![0; axis.keypoints().len()];
    (0..).zip(&shown).for_each(|(new, &old)| number[old as usize] = new);
    let lines: Vec<PathRecord> = records(axis, drawing).collect();
    let document = Document {
        kind: "MedialAxis".into(),
        version: 1,
        engine: axis.engine.name().into(),
        accuracy: match axis.accuracy {
            Accuracy::Exact => AccuracyRecord::Word("exact".into()),
            Accuracy::Sampled(sampled) => AccuracyRecord::Sampled { sampled },
        },
        complete: axis.complete,
        side: axis.side.name().into(),
        feature: source.index,
        id: source.id.as_deref(),
        sites: axis.sites().iter().map(|site| site_record(&site)).collect(),
        keypoints: shown.iter().map(|&k| keypoint_record(axis, k)).collect(),
        paths: lines.iter().map(|line| path_record(axis, line, &number, measured)).collect(),
    };
    // Maps with string keys and finite numbers always have a JSON form.
    let mut line = serde_json::to_string(&document).unwrap_or_default();
    line.push('\n');
    line
}

fn keypoint_record(axis: &MedialAxis, number: u32) -> KeypointRecord<'_> {
    let keypoint = axis.keypoints().at(number);
    KeypointRecord {
        x: keypoint.position.x,
        y: keypoint.position.y,
        radius: keypoint.radius,
        kind: keypoint.kind.name().into(),
        governors: axis.governors(number).into(),
    }
}

/// A line between keypoints that have new numbers.
fn path_record(
    axis: &MedialAxis,
    line: &PathRecord,
    number: &[u32],
    measured: &[Significance],
) -> PathJson<'static> {
    let Path { from, to, left, right } = line.path;
    let points = match axis.accuracy {
        Accuracy::Exact => Vec::new(),
        Accuracy::Sampled(_) => {
            let first = (line.ends[0].position, line.ends[0].radius);
            let rest = line.curves.iter().map(|curve| (curve.to(), curve.radius_to()));
            [first].into_iter().chain(rest).map(|(p, radius)| [p.x, p.y, radius]).collect()
        }
    };
    PathJson {
        from: number[from as usize],
        to: number[to as usize],
        governors: [left, right],
        curve: match axis.accuracy {
            Accuracy::Exact => line.kind,
            Accuracy::Sampled(_) => CurveKind::Polyline,
        }
        .name()
        .into(),
        points,
        measures: measured.iter().map(|m| (m.measure.name(), line.values(m))).collect(),
    }
}

/// A site as JSON documents have it.
pub(crate) fn site_record(site: &Site) -> SiteRecord<'static> {
    let xy = |p: Point| Some([p.x, p.y]);
    let (a, b, p) = match site.kind {
        SiteKind::Edge => (xy(site.a), xy(site.b), None),
        SiteKind::Vertex => (None, None, xy(site.a)),
    };
    SiteRecord {
        kind: site.kind.name().into(),
        polygon: site.polygon,
        ring: site.ring,
        index: site.index,
        part: site.part,
        a,
        b,
        p,
    }
}

/// Reads every document of a text, a line each.
pub fn read(text: &str) -> impl Iterator<Item = Result<AxisDocument, Error>> {
    lines(text).map(move |line| read_line(text, line))
}

/// The axes of documents, or of a [compressed](crate::maxis) file.
///
/// # Errors
/// If documents are no text, or a compressed file is damaged.
pub fn of_bytes<'a>(
    bytes: &'a [u8],
) -> Result<Box<dyn Iterator<Item = Result<AxisDocument, Error>> + Send + 'a>, Error> {
    Ok(match Format::of_content(bytes)? {
        Content::CompressedAxes => Box::new(maxis::read(bytes)?),
        _ => Box::new(read(crate::text(bytes)?)),
    })
}

/// The polygons of interior axes, which must be complete and exact. Exterior axes are left out, as `both`
/// sides write the interior of the same feature.
#[must_use]
pub fn polygons<'a>(
    axes: impl Iterator<Item = Result<AxisDocument, Error>> + Send + 'a,
) -> Layer<'a> {
    let mut next = 0;
    let feature = move |document: Result<AxisDocument, Error>| {
        let (feature, id, axis) = match document {
            Ok(AxisDocument { axis, .. }) if axis.side == Side::Exterior => return None,
            Ok(AxisDocument { feature, id, axis, .. }) => (feature, id, axis),
            Err(error) => {
                let feature =
                    if let Error::Document { feature, .. } = error { feature } else { next };
                next = feature + 1;
                return Some(Err(FeatureError { feature, id: None, error }));
            }
        };
        next = feature + 1;
        Some(match polygons_of(&axis) {
            Ok(polygons) => Ok(Feature {
                index: feature,
                id,
                polygons,
                geometry: "an axis".to_owned(),
                polygonal: true,
                ..Feature::default()
            }),
            Err(error) => {
                let (place, why) = ("axis".to_owned(), error.to_string());
                let error = Error::Value { place, why };
                Err(FeatureError { feature, id, error })
            }
        })
    };
    Layer::new(axes.filter_map(feature))
}

fn read_line(text: &str, line: &str) -> Result<AxisDocument, Error> {
    if line.starts_with('[') {
        let why = "expected an axis document, found an array";
        return Err(syntax_at(text, offset(text, line), why));
    }
    let document: Document = parse(text, line)?;
    let feature = document.feature;
    let wrong = |place: String, why: String| Error::Document { feature, place, why };
    if document.kind != "MedialAxis" {
        return Err(wrong("type".into(), format!("`{}` is no MedialAxis", document.kind)));
    }
    if document.version != 1 {
        return Err(wrong("version".into(), format!("{} is not 1", document.version)));
    }
    let accuracy = match document.accuracy {
        AccuracyRecord::Word(ref word) if word == "exact" => Accuracy::Exact,
        AccuracyRecord::Word(ref word) => {
            return Err(wrong("accuracy".into(), format!("`{word}` is not `exact`")));
        }
        AccuracyRecord::Sampled { sampled } => Accuracy::Sampled(sampled),
    };
    let sites = each(&document.sites, "site", &wrong, site)?;
    let kinds = each(&document.keypoints, "keypoint", &wrong, |k| named(&k.kind))?;
    let keypoints = document
        .keypoints
        .iter()
        .zip(kinds)
        .map(|(k, kind)| (Point::new(k.x, k.y), k.radius, kind, k.governors.as_ref()));
    // Samples are keypoints behind all others.
    let both: Vec<[u32; 2]> = document
        .paths
        .iter()
        .map(|p| [p.governors[0].min(p.governors[1]), p.governors[0].max(p.governors[1])])
        .collect();
    let between = |p: &'_ PathJson<'_>| 1..p.points.len().saturating_sub(1).max(1);
    let samples = document.paths.iter().zip(&both).flat_map(|(p, both)| {
        between(p).map(move |k| {
            let [x, y, radius] = p.points[k];
            (Point::new(x, y), radius, KeypointKind::Transition, &both[..])
        })
    });
    let mut next = document.keypoints.len() as u32;
    let mut paths: Vec<Path> = Vec::with_capacity(document.paths.len());
    for p in &document.paths {
        let [left, right] = p.governors;
        let mut from = p.from;
        for _ in between(p) {
            paths.push(Path { from, to: next, left, right });
            from = next;
            next += 1;
        }
        paths.push(Path { from, to: p.to, left, right });
    }
    let keypoints = keypoints.chain(samples);
    let axis = MedialAxis::from_parts(
        named::<Engine>(&document.engine).map_err(|why| wrong("engine".into(), why))?,
        named::<Side>(&document.side).map_err(|why| wrong("side".into(), why))?,
        accuracy,
        document.complete,
        sites,
        keypoints,
        paths,
    )
    .ok_or_else(|| {
        wrong("numbers".into(), "a site or keypoint is named that is not listed".to_owned())
    })?;
    each(&document.paths, "path", &wrong, |record| {
        let path = Path {
            from: record.from,
            to: record.to,
            left: record.governors[0],
            right: record.governors[1],
        };
        let (said, is) = (named::<CurveKind>(&record.curve)?, axis.curve_kind(&path));
        if said == is { Ok(()) } else { Err(format!("its governors make a {is}, not a {said}")) }
    })?;
    let id = document.id.map(ToOwned::to_owned);
    Ok(AxisDocument { feature: document.feature, id, axis, error: None })
}

fn site(record: &SiteRecord) -> Result<Site, String> {
    let point = |xy: Option<[f64; 2]>, name: &str| {
        xy.map(|[x, y]| Point::new(x, y)).ok_or_else(|| format!("`{name}` is missing"))
    };
    let kind = named(&record.kind)?;
    let (a, b) = match kind {
        SiteKind::Edge => (point(record.a, "a")?, point(record.b, "b")?),
        SiteKind::Vertex => (point(record.p, "p")?, point(record.p, "p")?),
    };
    let SiteRecord { polygon, ring, index, part, .. } = *record;
    Ok(Site { kind, polygon, ring, index, part, a, b })
}

fn named<T: FromStr<Err = UnknownName>>(word: &str) -> Result<T, String> {
    word.parse().map_err(|error: UnknownName| error.to_string())
}

/// `convert` for each record; the first failure names the record.
fn each<R, T>(
    records: &[R],
    thing: &str,
    wrong: &impl Fn(String, String) -> Error,
    convert: impl Fn(&R) -> Result<T, String>,
) -> Result<Vec<T>, Error> {
    records
        .iter()
        .enumerate()
        .map(|(k, record)| convert(record).map_err(|why| wrong(format!("{thing} {k}"), why)))
        .collect()
}

#[cfg(test)]
mod tests;
