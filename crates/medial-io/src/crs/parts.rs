//! What systems of both versions of well-known text are made of, as PROJJSON.

use super::node::Node;
use serde_json::{Number, Value, json};

/// Words for units in either version.
const UNITS: [&str; 5] = ["LENGTHUNIT", "ANGLEUNIT", "SCALEUNIT", "PARAMETRICUNIT", "UNIT"];

/// How much a unit may be off a metre or a degree and still be one, relatively: factors are written with 15
/// digits, or fewer.
const SAME_UNIT: f64 = 1e-9;

pub(super) fn with_name_and_id(mut found: Value, node: &Node) -> Value {
    found["name"] = node.name().into();
    if let Some(id) = node.get(&["ID", "AUTHORITY"]).and_then(id_of) {
        found["id"] = id;
    }
    found
}

/// Something that has a type, a name, and perhaps an identifier.
pub(super) fn named(kind: &str, node: &Node) -> Value {
    with_name_and_id(json!({"type": kind}), node)
}

pub(super) fn id_of(node: &Node) -> Option<Value> {
    Some(identifier(node.text(0)?, node.text(1)?))
}

pub(super) fn identifier(authority: &str, code: &str) -> Value {
    let code = code.parse::<u32>().map_or_else(|_| code.into(), Value::from);
    json!({"authority": authority, "code": code})
}

/// A number as it is written.
pub(super) fn number(node: &Node, place: usize) -> Option<Value> {
    let text = node.text(place)?;
    let written: Option<Number> = serde_json::from_str(text).ok();
    written.or_else(|| Number::from_f64(node.number(place)?)).map(Value::Number)
}

/// The unit that a node has, with its factor.
pub(super) fn unit(node: &Node) -> Option<(Value, f64)> {
    let unit = node.get(&UNITS)?;
    let factor = unit.number(1)?;
    let is = |other: f64| (factor - other).abs() <= SAME_UNIT * other;
    let name = match unit.name() {
        "Foot_US" => "US survey foot",
        "Foot" => "foot",
        "Grad" => "grad",
        "Unknown_Unit" => "unknown",
        name => name,
    };
    let lower = name.to_ascii_lowercase();
    let kind = match (unit.word.as_str(), lower.as_str()) {
        ("LENGTHUNIT" | "UNIT", "metre" | "meter" | "m") if is(1.0) => {
            return Some(("metre".into(), 1.0));
        }
        ("ANGLEUNIT" | "UNIT", "degree" | "degrees" | "decimal degree") if is(DEGREE) => {
            return Some(("degree".into(), factor));
        }
        ("SCALEUNIT" | "UNIT", "unity") if is(1.0) => return Some(("unity".into(), 1.0)),
        ("ANGLEUNIT", _) => "AngularUnit",
        ("SCALEUNIT", _) => "ScaleUnit",
        ("UNIT", "grad" | "gon" | "radian" | "grade") => "AngularUnit",
        _ => "LinearUnit",
    };
    Some((json!({"type": kind, "name": name, "conversion_factor": factor}), factor))
}

pub(super) const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// Adds the datum of a geographic or geodetic system, or the ensemble of several, with the prime meridian.
pub(super) fn add_datum(found: &mut Value, node: &Node) -> Option<()> {
    if let Some(found_ensemble) = node.get(&["ENSEMBLE"]) {
        found["datum_ensemble"] = ensemble(found_ensemble)?;
        return Some(());
    }
    let datum = node.get(&["DATUM", "GEODETICDATUM", "TRF"])?;
    let mut of_datum = named("GeodeticReferenceFrame", datum);
    if datum.word == "DATUM" && node.word == "GEOGCS" || node.word == "GEOCCS" {
        of_datum["name"] = super::esri::datum(datum.name()).into();
    }
    if let Some(epoch) = node.get(&["DYNAMIC"]).and_then(|node| node.get(&["FRAMEEPOCH"])) {
        of_datum["type"] = "DynamicGeodeticReferenceFrame".into();
        of_datum["frame_reference_epoch"] = number(epoch, 0)?;
    }
    of_datum["ellipsoid"] = ellipsoid(datum.get(&["ELLIPSOID", "SPHEROID"])?)?;
    if let Some(meridian) = node.get(&["PRIMEM", "PRIMEMERIDIAN"])
        && (meridian.number(1)? != 0.0 || !meridian.name().eq_ignore_ascii_case("Greenwich"))
    {
        of_datum["prime_meridian"] = prime_meridian(meridian, node)?;
    }
    found["datum"] = of_datum;
    Some(())
}

/// Several datums that are taken for one; those of heights have no ellipsoid.
pub(super) fn ensemble(node: &Node) -> Option<Value> {
    let members = node.all(&["MEMBER"]).map(|member| with_name_and_id(json!({}), member));
    let mut found = json!({"members": members.collect::<Vec<_>>()});
    if let Some(of_ensemble) = node.get(&["ELLIPSOID", "SPHEROID"]) {
        found["ellipsoid"] = ellipsoid(of_ensemble)?;
    }
    if let Some(accuracy) = node.get(&["ENSEMBLEACCURACY"]).and_then(|node| node.text(0)) {
        found["accuracy"] = accuracy.into();
    }
    Some(with_name_and_id(found, node))
}

pub(super) fn prime_meridian(meridian: &Node, node: &Node) -> Option<Value> {
    /// Paris in degrees, which is what GDAL writes although the unit of the system is the grad.
    const PARIS: f64 = 2.337_229_17;
    let (of_system, _) = unit(node).unwrap_or_else(|| ("degree".into(), DEGREE));
    let value = meridian.number(1)?;
    let unit = match unit(meridian) {
        Some((unit, _)) => unit,
        None if (value - PARIS).abs() < 1e-6 => "degree".into(),
        None => of_system,
    };
    let mut longitude = number(meridian, 1)?;
    if unit != "degree" {
        longitude = json!({"value": longitude, "unit": unit});
    }
    Some(with_name_and_id(json!({"longitude": longitude}), meridian))
}

pub(super) fn ellipsoid(node: &Node) -> Option<Value> {
    let length = |value: Value| match unit(node) {
        Some((unit, _)) if unit != "metre" => json!({"value": value, "unit": unit}),
        _ => value,
    };
    let axis = length(number(node, 1)?);
    let found = if node.number(2)? == 0.0 {
        json!({"radius": axis})
    } else {
        json!({"semi_major_axis": axis, "inverse_flattening": number(node, 2)?})
    };
    Some(with_name_and_id(found, node))
}

pub(super) fn axis(name: &str, abbreviation: &str, direction: &str, unit: &Value) -> Value {
    json!({"name": name, "abbreviation": abbreviation, "direction": direction, "unit": unit})
}

pub(super) fn longitude(unit: &Value) -> Value {
    axis("Geodetic longitude", "Lon", "east", unit)
}

/// The direction of an axis, as PROJJSON spells it.
pub(super) fn direction(word: &str) -> String {
    const MIXED: [&str; 10] = [
        "northNorthEast",
        "northEast",
        "southEast",
        "southWest",
        "northWest",
        "geocentricX",
        "geocentricY",
        "geocentricZ",
        "columnPositive",
        "rowPositive",
    ];
    let same = MIXED.iter().find(|known| known.eq_ignore_ascii_case(word));
    same.map_or_else(|| word.to_ascii_lowercase(), ToString::to_string)
}

pub(super) fn second() -> Value {
    let factor = DEGREE / 3600.0;
    json!({"type": "AngularUnit", "name": "arc-second", "conversion_factor": factor})
}

pub(super) fn millionth() -> Value {
    json!({"type": "ScaleUnit", "name": "parts per million", "conversion_factor": 1e-6})
}
