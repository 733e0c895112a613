use super::quick::{self, Collection, Polygonal};
use crate::json::{Members, Position, Ring, parse, points, without_infinities};
use crate::text::{lines, offset, syntax_at};
use crate::{Crs, Error, Feature, FeatureError, Json, Layer, Part};
use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_json::value::RawValue;
use std::borrow::Cow;
use std::ops::Range;
use std::sync::Arc;

/// Deepest nesting of geometry collections; protects the stack against made-up input.
const MAX_NESTING: u32 = 32;

/// Any GeoJSON object: the members that matter, values not yet looked into.
#[derive(Deserialize)]
#[serde(expecting = "a GeoJSON object")]
struct Object<'a> {
    #[serde(borrow, rename = "type")]
    kind: Cow<'a, str>,
    #[serde(borrow, default)]
    features: Option<Vec<&'a RawValue>>,
    #[serde(borrow, default)]
    geometry: Option<&'a RawValue>,
    #[serde(borrow, default)]
    geometries: Option<Vec<&'a RawValue>>,
    #[serde(borrow, default)]
    coordinates: Option<&'a RawValue>,
    #[serde(borrow, default)]
    properties: Option<&'a RawValue>,
    #[serde(borrow, default)]
    id: Option<&'a RawValue>,
    #[serde(borrow, default)]
    crs: Option<&'a RawValue>,
}

/// Reads a collection, a feature or a bare geometry. Numbers that JSON does not have, such as `NaN`, are
/// nothing among properties, and the fault of their feature among coordinates.
///
/// # Errors
/// If the text is no JSON or no GeoJSON object. A feature that is malformed in itself is an item
/// of the layer, and the others are still read.
pub fn read(text: &str) -> Result<Layer<'_>, Error> {
    if text.trim().is_empty() {
        return Err(Error::Empty);
    }
    match slices(text) {
        Ok((crs, slices)) => {
            let len = Some(slices.len());
            Ok(Layer { crs, len, ..Layer::of_slices(text, slices.into_iter(), feature) })
        }
        Err(error) => {
            let finite = without_infinities(text).and_then(|text| of_its_own(text).ok());
            finite.ok_or(error)
        }
    }
}

/// The reference system of a document, and its features unread.
fn slices(text: &str) -> Result<(Option<Crs>, Vec<&str>), Error> {
    if let Some(Collection { features, crs }) = quick::collection(text) {
        let crs = reference(crs.map(|crs| parse(text, crs)).transpose()?);
        return Ok((crs, features));
    }
    let object = parse_object(text, text)?;
    let slices = if object.kind == "FeatureCollection" {
        let why = "the FeatureCollection has no `features`";
        object.features.ok_or_else(|| syntax_at(text, 0, why))?
    } else {
        vec![parse(text, text)?]
    };
    let crs = reference(object.crs.map(ToOwned::to_owned));
    Ok((crs, slices.into_iter().map(RawValue::get).collect()))
}

/// A layer of a text that nobody else has.
fn of_its_own<'a>(text: String) -> Result<Layer<'a>, Error> {
    let (crs, slices) = slices(&text)?;
    let place = |slice: &str| {
        let start = offset(&text, slice);
        start..start + slice.len()
    };
    let places: Vec<Range<usize>> = slices.into_iter().map(place).collect();
    let len = Some(places.len());
    let text: Arc<str> = text.into();
    let parts = places.into_iter().enumerate().map(move |(index, place)| {
        let text = Arc::clone(&text);
        Part::of_row(place.len(), move || feature(&text, &text[place], index))
    });
    Ok(Layer { crs, len, ..Layer::of_parts(parts) })
}

/// Reads one feature or geometry a line; record separators [RFC 8142] and empty lines are
/// skipped, and a malformed line is an item of the layer.
#[must_use]
pub fn read_lines(text: &str) -> Layer<'_> {
    let crs = reference(None);
    Layer { crs, ..Layer::of_slices(text, lines(text), feature) }
}

/// What a `crs` member says, or what holds where there is none.
fn reference(member: Option<Json>) -> Option<Crs> {
    member.map_or_else(|| Some(Crs::of_geojson()), |member| Some(Crs::of_member(member)))
}

pub(crate) fn feature(text: &str, part: &str, index: usize) -> Result<Feature, FeatureError> {
    let mut feature = Feature::numbered(index);
    let Err(error) = read_feature(text, part, &mut feature) else { return Ok(feature) };
    // Values may be what JSON does not have, coordinates may not.
    if let Some(finite) = without_infinities(part) {
        let mut feature = Feature::numbered(index);
        if read_feature(&finite, &finite, &mut feature).is_ok() {
            return Ok(feature);
        }
    }
    Err(FeatureError { feature: index, id: feature.id, error })
}

fn read_feature(text: &str, part: &str, feature: &mut Feature) -> Result<(), Error> {
    if let Some(Polygonal { id, properties, multi, polygons }) = quick::polygonal(part) {
        feature.id = id.map(|id| parse(text, id)).transpose()?;
        if let Some(properties) = properties {
            feature.properties = parse::<Members>(text, properties)?.0;
        }
        let described = if multi { "a MultiPolygon" } else { "a Polygon" };
        feature.geometry = described.to_owned();
        feature.polygonal = true;
        feature.polygons = polygons;
        return Ok(());
    }
    let object = parse_object(text, part)?;
    if object.kind != "Feature" {
        return read_geometry(text, part, &object, feature, 0);
    }
    feature.id = object.id.map(ToOwned::to_owned);
    if let Some(properties) = object.properties {
        feature.properties = parse::<Members>(text, properties.get())?.0;
    }
    match object.geometry {
        Some(raw) => {
            let geometry = parse_object(text, raw.get())?;
            read_geometry(text, raw.get(), &geometry, feature, 0)?;
        }
        None => feature.geometry = "without a geometry".to_owned(),
    }
    Ok(())
}

/// A JSON object; the parser alone would take an array for one.
fn parse_object<'a>(text: &str, part: &'a str) -> Result<Object<'a>, Error> {
    if part.trim_start().starts_with('[') {
        let why = "expected a GeoJSON object, found an array; bare arrays are of the format rings";
        return Err(syntax_at(text, offset(text, part), why));
    }
    parse(text, part)
}

fn read_geometry(
    text: &str,
    part: &str,
    object: &Object,
    feature: &mut Feature,
    depth: u32,
) -> Result<(), Error> {
    let missing = |member: &str| {
        let why = format!("the {} has no `{member}`", object.kind);
        syntax_at(text, offset(text, part), why)
    };
    let coordinates = || object.coordinates.ok_or_else(|| missing("coordinates"));
    if depth == 0 {
        feature.geometry = described(&object.kind);
    }
    match object.kind.as_ref() {
        "Polygon" => {
            feature.add_polygon(points(parse::<Vec<Ring>>(text, coordinates()?.get())?));
        }
        "MultiPolygon" => {
            feature.polygonal = true;
            for rings in parse::<Vec<Vec<Ring>>>(text, coordinates()?.get())? {
                feature.add_polygon(points(rings));
            }
        }
        "GeometryCollection" => {
            if depth == MAX_NESTING {
                let why = format!("geometry collections are nested deeper than {MAX_NESTING}");
                return Err(syntax_at(text, offset(text, part), why));
            }
            for raw in object.geometries.as_ref().ok_or_else(|| missing("geometries"))? {
                let inner = parse_object(text, raw.get())?;
                read_geometry(text, raw.get(), &inner, feature, depth + 1)?;
            }
        }
        "Point" if depth == 0 => {
            let at = coordinates()?.get();
            let is_empty = parse::<Vec<IgnoredAny>>(text, at)?.is_empty();
            let point = || parse::<Position>(text, at).map(|position| vec![position.0]);
            feature.points = Some(if is_empty { Vec::new() } else { point()? });
        }
        "MultiPoint" if depth == 0 => {
            let read = parse::<Ring>(text, coordinates()?.get())?;
            feature.points = Some(read.into_iter().map(|position| position.0).collect());
        }
        kind @ ("Point" | "MultiPoint" | "LineString" | "MultiLineString") => {
            if depth > 0 {
                feature.leave_out(kind);
            }
        }
        kind => {
            let why = format!("`{kind}` is no GeoJSON geometry");
            return Err(syntax_at(text, offset(text, part), why));
        }
    }
    Ok(())
}

fn described(kind: &str) -> String {
    format!("a {kind}")
}
