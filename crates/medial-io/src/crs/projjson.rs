//! Reference systems of well-known text as PROJJSON, which has the model of version 2 [OGC 18-010r7].
//!
//! Version 1 is taken as GDAL and ESRI write it: their names of methods and parameters are those of
//! [`methods`](super::methods), angles are in the unit of the geographic system, and what is not said is as
//! usual: eastings before northings, nothing shifted, nothing scaled.

use super::methods::{self, Measure, Method};
use super::node::Node;
use serde_json::{Number, Value, json};

/// Words for units in either version.
const UNITS: [&str; 5] = ["LENGTHUNIT", "ANGLEUNIT", "SCALEUNIT", "PARAMETRICUNIT", "UNIT"];

/// How much a unit may be off a metre or a degree and still be one, relatively: factors are written with 15
/// digits, or fewer.
const SAME_UNIT: f64 = 1e-9;

/// The PROJJSON of a text; `id` is the identifier of the whole if it is known from elsewhere. None if the
/// text is malformed, or of a kind that is not known here: systems of time, derived ones, concatenations.
pub(super) fn of_text(text: &str, id: Option<(&str, &str)>) -> Option<Value> {
    let nodes = Node::read_all(text)?;
    let mut found = match &nodes[..] {
        [node] => system(node, id.is_some())?,
        // ESRI puts the vertical system behind the other.
        [first, second] if second.word == "VERTCS" => {
            let components = [system(first, id.is_some())?, system(second, false)?];
            let name = format!("{} + {}", first.name(), second.name());
            json!({"type": "CompoundCRS", "name": name, "components": components})
        }
        _ => return None,
    };
    if let Some((authority, code)) = id
        && found["type"] != "BoundCRS"
    {
        found["id"] = identifier(authority, code);
    }
    found["$schema"] = "https://proj.org/schemas/v0.7/projjson.schema.json".into();
    Some(found)
}

/// A system. Shifts to WGS 84, which version 1 has in the datum, are left out of one that is known by its
/// number, as its definition has none.
fn system(node: &Node, is_known: bool) -> Option<Value> {
    let found = match node.word.as_str() {
        "PROJCS" => first_projected(node)?,
        "GEOGCS" => first_geographic(node, is_known)?,
        "GEOCCS" => first_geocentric(node)?,
        "COMPD_CS" | "COMPOUNDCRS" => {
            let parts: Option<Vec<_>> = node
                .nodes()
                .filter(|part| part.get(&["UNIT", "CS", "PRIMEM"]).is_some() || is_bound(part))
                .map(|part| system(part, is_known))
                .collect();
            let parts = parts.filter(|parts| parts.len() >= 2)?;
            json!({"type": "CompoundCRS", "components": parts})
        }
        "VERT_CS" | "VERTCS" => first_vertical(node)?,
        "LOCAL_CS" => first_engineering(node)?,
        "PROJCRS" | "PROJECTEDCRS" => {
            let base = node.get(&["BASEGEOGCRS", "BASEGEODCRS"])?;
            json!({
                "type": "ProjectedCRS",
                "base_crs": base_of(base)?,
                "conversion": conversion(node.get(&["CONVERSION"])?, base)?,
                "coordinate_system": coordinates(node)?,
            })
        }
        "GEOGCRS" | "GEOGRAPHICCRS" | "GEODCRS" | "GEODETICCRS" => {
            // One that is derived from another.
            if node.get(&["BASEGEOGCRS", "BASEGEODCRS"]).is_some() {
                return None;
            }
            let coordinates = coordinates(node)?;
            let is_geographic = coordinates["subtype"] == "ellipsoidal";
            let kind = if is_geographic { "GeographicCRS" } else { "GeodeticCRS" };
            let mut found = json!({"type": kind, "coordinate_system": coordinates});
            add_datum(&mut found, node)?;
            found
        }
        "VERTCRS" | "VERTICALCRS" => {
            let mut found = json!({"type": "VerticalCRS", "coordinate_system": coordinates(node)?});
            match node.get(&["VDATUM", "VRF", "VERTICALDATUM"]) {
                Some(datum) => found["datum"] = named("VerticalReferenceFrame", datum),
                None => found["datum_ensemble"] = ensemble(node.get(&["ENSEMBLE"])?)?,
            }
            found
        }
        "ENGCRS" | "ENGINEERINGCRS" => {
            let datum = named("EngineeringDatum", node.get(&["EDATUM", "ENGINEERINGDATUM"])?);
            json!({"type": "EngineeringCRS", "datum": datum, "coordinate_system": coordinates(node)?})
        }
        "BOUNDCRS" => return bound(node),
        _ => return None,
    };
    let found = with_name_and_id(found, node);
    let shift = node.get(&["GEOGCS"]).unwrap_or(node).get(&["DATUM"]);
    match shift.and_then(|datum| datum.get(&["TOWGS84"])) {
        Some(shift) if !is_known && node.word != "GEOCCS" => shifted(found, shift),
        _ => Some(found),
    }
}

fn is_bound(node: &Node) -> bool {
    node.word == "BOUNDCRS"
}

fn with_name_and_id(mut found: Value, node: &Node) -> Value {
    found["name"] = node.name().into();
    if let Some(id) = node.get(&["ID", "AUTHORITY"]).and_then(id_of) {
        found["id"] = id;
    }
    found
}

/// Something that has a type, a name, and perhaps an identifier.
fn named(kind: &str, node: &Node) -> Value {
    with_name_and_id(json!({"type": kind}), node)
}

fn id_of(node: &Node) -> Option<Value> {
    Some(identifier(node.text(0)?, node.text(1)?))
}

fn identifier(authority: &str, code: &str) -> Value {
    let code = code.parse::<u32>().map_or_else(|_| code.into(), Value::from);
    json!({"authority": authority, "code": code})
}

/// A number as it is written.
fn number(node: &Node, place: usize) -> Option<Value> {
    let text = node.text(place)?;
    let written: Option<Number> = serde_json::from_str(text).ok();
    written.or_else(|| Number::from_f64(node.number(place)?)).map(Value::Number)
}

/// The unit that a node has, with its factor.
fn unit(node: &Node) -> Option<(Value, f64)> {
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

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// Adds the datum of a geographic or geodetic system, or the ensemble of several, with the prime meridian.
fn add_datum(found: &mut Value, node: &Node) -> Option<()> {
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
fn ensemble(node: &Node) -> Option<Value> {
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

fn prime_meridian(meridian: &Node, node: &Node) -> Option<Value> {
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

fn ellipsoid(node: &Node) -> Option<Value> {
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

/// The geographic system that a projected one of version 2 is based on.
fn base_of(node: &Node) -> Option<Value> {
    // Where it says nothing of its unit, its prime meridian does.
    let own = unit(node).or_else(|| unit(node.get(&["PRIMEM", "PRIMEMERIDIAN"])?));
    let unit = own.map_or_else(|| "degree".into(), |(unit, _)| unit);
    let axes = [axis("Geodetic latitude", "Lat", "north", &unit), longitude(&unit)];
    let mut found = json!({
        "type": "GeographicCRS",
        "coordinate_system": {"subtype": "ellipsoidal", "axis": axes},
    });
    add_datum(&mut found, node)?;
    Some(with_name_and_id(found, node))
}

fn axis(name: &str, abbreviation: &str, direction: &str, unit: &Value) -> Value {
    json!({"name": name, "abbreviation": abbreviation, "direction": direction, "unit": unit})
}

fn longitude(unit: &Value) -> Value {
    axis("Geodetic longitude", "Lon", "east", unit)
}

/// The coordinate system of version 2.
fn coordinates(node: &Node) -> Option<Value> {
    let subtype = node.get(&["CS"])?.name().to_ascii_lowercase();
    let subtype = if subtype == "cartesian" { "Cartesian" } else { subtype.as_str() };
    let of_all = unit(node).map(|(unit, _)| unit);
    let axes: Option<Vec<Value>> = node
        .all(&["AXIS"])
        .map(|axis| {
            let (name, abbreviation) = names_of_axis(axis.name());
            let mut found = json!({
                "name": name,
                "abbreviation": abbreviation,
                "direction": direction(axis.text(1)?),
            });
            if let Some(unit) = unit(axis).map(|(unit, _)| unit).or_else(|| of_all.clone()) {
                found["unit"] = unit;
            }
            if let Some(meridian) = axis.get(&["MERIDIAN"]) {
                found["meridian"] = json!({"longitude": number(meridian, 0)?});
            }
            Some(found)
        })
        .collect();
    let axes = axes.filter(|axes| !axes.is_empty())?;
    Some(json!({"subtype": subtype, "axis": axes}))
}

/// The direction of an axis, as PROJJSON spells it.
fn direction(word: &str) -> String {
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

/// `easting (E)` as name and abbreviation; either may be missing.
fn names_of_axis(text: &str) -> (String, String) {
    let (name, rest) = text.split_once('(').unwrap_or((text, ""));
    let (name, abbreviation) = (name.trim(), rest.trim_end_matches(')').trim());
    let full = match abbreviation {
        "E" => "Easting",
        "N" => "Northing",
        "Lat" => "Geodetic latitude",
        "Lon" => "Geodetic longitude",
        "h" => "Ellipsoidal height",
        "H" => "Gravity-related height",
        other => other,
    };
    let mut letters = if name.is_empty() { full } else { name }.chars();
    let first = letters.next().map(|first| first.to_ascii_uppercase());
    let name: String = first.into_iter().chain(letters).collect();
    let abbreviation = if abbreviation.is_empty() { name.clone() } else { abbreviation.to_owned() };
    (name, abbreviation)
}

/// The conversion of version 2; what has no unit has that of the geographic system, or is in metres.
fn conversion(node: &Node, base: &Node) -> Option<Value> {
    let method = node.get(&["METHOD", "PROJECTION"])?;
    let mut parameters = Vec::new();
    for parameter in node.all(&["PARAMETER"]) {
        let mut found = json!({"value": number(parameter, 1)?});
        let id = parameter.get(&["ID", "AUTHORITY"]).and_then(id_of);
        let code = id.as_ref().and_then(|id| id["code"].as_u64()).unwrap_or_default();
        let known = methods::parameter(u32::try_from(code).unwrap_or_default())
            .or_else(|| methods::parameter_of_name(parameter.name()));
        found["unit"] = match (unit(parameter), known.map(|known| known.measure)) {
            (Some((unit, _)), _) => unit,
            (None, Some(Measure::Angle)) => {
                unit(base).map_or_else(|| "degree".into(), |(unit, _)| unit)
            }
            (None, Some(Measure::Scale) | None) => "unity".into(),
            (None, Some(Measure::Length)) => "metre".into(),
        };
        parameters.push(with_name_and_id(found, parameter));
    }
    let found = json!({"method": with_name_and_id(json!({}), method), "parameters": parameters});
    Some(with_name_and_id(found, node))
}

/// A system with a transformation to another one.
fn bound(node: &Node) -> Option<Value> {
    let inside = |word: &str| node.get(&[word])?.nodes().next();
    let transformation = node.get(&["ABRIDGEDTRANSFORMATION"])?;
    let method = with_name_and_id(json!({}), transformation.get(&["METHOD"])?);
    let mut parameters = Vec::new();
    for parameter in transformation.all(&["PARAMETER", "PARAMETERFILE"]) {
        let id = parameter.get(&["ID"]).and_then(id_of);
        let code = id.as_ref().and_then(|id| id["code"].as_u64()).unwrap_or_default();
        let found = if parameter.word == "PARAMETERFILE" {
            json!({"value": parameter.text(1)?})
        } else {
            match (unit(parameter), code) {
                (Some((unit, _)), _) => json!({"value": number(parameter, 1)?, "unit": unit}),
                // Here a scale is what coordinates are multiplied by.
                (None, 8611) => {
                    let millionths = ((parameter.number(1)? - 1.0) * 1e12).round() / 1e6;
                    json!({"value": millionths, "unit": millionth()})
                }
                (None, 8608..=8610) => json!({"value": number(parameter, 1)?, "unit": second()}),
                (None, _) => json!({"value": number(parameter, 1)?, "unit": "metre"}),
            }
        };
        parameters.push(with_name_and_id(found, parameter));
    }
    let found = json!({"method": method, "parameters": parameters});
    Some(json!({
        "type": "BoundCRS",
        "source_crs": system(inside("SOURCECRS")?, true)?,
        "target_crs": system(inside("TARGETCRS")?, true)?,
        "transformation": with_name_and_id(found, transformation),
    }))
}

fn second() -> Value {
    let factor = DEGREE / 3600.0;
    json!({"type": "AngularUnit", "name": "arc-second", "conversion_factor": factor})
}

fn millionth() -> Value {
    json!({"type": "ScaleUnit", "name": "parts per million", "conversion_factor": 1e-6})
}

/// A system with its shift to WGS 84: three or seven numbers.
fn shifted(system: Value, shift: &Node) -> Option<Value> {
    const NAMES: [&str; 7] = [
        "X-axis translation",
        "Y-axis translation",
        "Z-axis translation",
        "X-axis rotation",
        "Y-axis rotation",
        "Z-axis rotation",
        "Scale difference",
    ];
    const FIRST: usize = 8605;
    let turns = (3..7).any(|place| shift.number(place).is_some_and(|value| value != 0.0));
    let (n, method, code) = if turns {
        (7, "Position Vector transformation (geog2D domain)", 9606)
    } else {
        (3, "Geocentric translations (geog2D domain)", 9603)
    };
    let parameters: Option<Vec<Value>> = (0..n)
        .map(|k| {
            let unit = match k {
                0..3 => "metre".into(),
                3..6 => second(),
                _ => millionth(),
            };
            let id = json!({"authority": "EPSG", "code": FIRST + k});
            Some(json!({"name": NAMES[k], "value": number(shift, k)?, "unit": unit, "id": id}))
        })
        .collect();
    let name = format!("Transformation from {} to WGS84", system["name"].as_str()?);
    let target: Value = serde_json::from_str(super::WGS_84).ok()?;
    Some(json!({
        "type": "BoundCRS",
        "source_crs": system,
        "target_crs": target,
        "transformation": {
            "name": name,
            "method": {"name": method, "id": {"authority": "EPSG", "code": code}},
            "parameters": parameters?,
        },
    }))
}

fn first_geographic(node: &Node, is_known: bool) -> Option<Value> {
    let unit = unit(node).map_or_else(|| "degree".into(), |(unit, _)| unit);
    let latitude = axis("Geodetic latitude", "Lat", "north", &unit);
    // Those with a number have latitudes first; of the others only the axes tell.
    let first = node.all(&["AXIS"]).next().and_then(|axis| axis.text(1));
    let is_known = is_known || node.get(&["AUTHORITY"]).is_some_and(|id| id.name() == "EPSG");
    let axes = match first {
        Some(first) if first.eq_ignore_ascii_case("NORTH") => [latitude, longitude(&unit)],
        None if is_known => [latitude, longitude(&unit)],
        _ => [longitude(&unit), latitude],
    };
    let mut found = json!({
        "type": "GeographicCRS",
        "coordinate_system": {"subtype": "ellipsoidal", "axis": axes},
    });
    add_datum(&mut found, node)?;
    Some(found)
}

fn first_geocentric(node: &Node) -> Option<Value> {
    let (unit, _) = unit(node)?;
    let axes = ["X", "Y", "Z"]
        .map(|name| axis(&format!("Geocentric {name}"), name, &format!("geocentric{name}"), &unit));
    let mut found = json!({
        "type": "GeodeticCRS",
        "coordinate_system": {"subtype": "Cartesian", "axis": axes},
    });
    add_datum(&mut found, node)?;
    Some(found)
}

fn first_vertical(node: &Node) -> Option<Value> {
    let (unit, _) = unit(node)?;
    let datum = named("VerticalReferenceFrame", node.get(&["VERT_DATUM", "VDATUM", "DATUM"])?);
    let is_down = node.get(&["AXIS"]).and_then(|axis| axis.text(1)).map_or_else(
        || {
            let mut signs = node.all(&["PARAMETER"]).filter(|found| found.name() == "Direction");
            signs.any(|found| found.number(1) == Some(-1.0))
        },
        |way| way.eq_ignore_ascii_case("DOWN"),
    );
    let axis = if is_down {
        axis("Depth", "D", "down", &unit)
    } else {
        axis("Gravity-related height", "H", "up", &unit)
    };
    Some(json!({
        "type": "VerticalCRS",
        "datum": datum,
        "coordinate_system": {"subtype": "vertical", "axis": [axis]},
    }))
}

fn first_engineering(node: &Node) -> Option<Value> {
    let (unit, _) = unit(node)?;
    let datum = node.get(&["LOCAL_DATUM"]);
    let unknown = || json!({"type": "EngineeringDatum", "name": "Unknown engineering datum"});
    let datum = datum.map_or_else(unknown, |datum| named("EngineeringDatum", datum));
    Some(json!({
        "type": "EngineeringCRS",
        "datum": datum,
        "coordinate_system": {"subtype": "Cartesian", "axis": plane_axes(node, &unit, Usual::EastNorth)?},
    }))
}

fn first_projected(node: &Node) -> Option<Value> {
    let base = node.get(&["GEOGCS"])?;
    let (length, _) = unit(node)?;
    let angle = unit(base).map_or_else(|| "degree".into(), |(unit, _)| unit);
    let parameters = First::of(node)?;
    let name = node.get(&["PROJECTION"])?.name();
    let method = method(node, name, &parameters);
    let unit_of = |measure: Measure| match measure {
        Measure::Angle => angle.clone(),
        Measure::Length => length.clone(),
        Measure::Scale => "unity".into(),
    };
    let conversion = match method {
        Some(method) => {
            let found = parameters.by_method(method, unit_of)?;
            let mut of_method = json!({"name": method.name});
            if method.code > 0 {
                of_method["id"] = json!({"authority": "EPSG", "code": method.code});
            }
            json!({"method": of_method, "parameters": found})
        }
        // Programs that know the name know what it means.
        None => json!({"method": {"name": name}, "parameters": parameters.as_written(unit_of)}),
    };
    let mut conversion = conversion;
    conversion["name"] = node.name().split_once(" / ").map_or("unnamed", |(_, name)| name).into();
    let base = with_name_and_id(first_geographic(base, true)?, base);
    let usual = method.map_or(Usual::EastNorth, |method| parameters.usual_axes(method));
    Some(json!({
        "type": "ProjectedCRS",
        "base_crs": base,
        "conversion": conversion,
        "coordinate_system": {"subtype": "Cartesian", "axis": plane_axes(node, &length, usual)?},
    }))
}

/// The method of a projected system of version 1; names that stand for several are told apart by their
/// parameters.
fn method(node: &Node, name: &str, parameters: &First) -> Option<&'static Method> {
    let value = |name: &str| parameters.value(name);
    let code = match name.to_ascii_lowercase().as_str() {
        "polar_stereographic" => {
            let is_scaled = value("scale_factor").is_some_and(|scale| scale != 1.0);
            if is_scaled { 9810 } else { 9829 }
        }
        "lambert_conformal_conic" => {
            let origin = value("latitude_of_origin");
            let is_scaled = value("scale_factor").is_some_and(|scale| scale != 1.0);
            match (value("standard_parallel_1"), value("standard_parallel_2")) {
                (Some(_), Some(_)) if !is_scaled => 9802,
                (first, None) if first == origin => 9801,
                _ => return None,
            }
        }
        "mercator_1sp" => {
            let extension = node.get(&["EXTENSION"]).and_then(|found| found.text(1));
            let is_web = |text: &str| {
                let has = |word: &str| text.split_whitespace().any(|found| found == word);
                has("+proj=merc") && has("+a=6378137") && has("+b=6378137")
            };
            if extension.is_some_and(is_web) { 1024 } else { 9804 }
        }
        "mercator_auxiliary_sphere" => match value("auxiliary_sphere_type") {
            Some(0.0) | None => 1024,
            _ => return None,
        },
        "krovak" => {
            let first = node.all(&["AXIS"]).next().and_then(|axis| axis.text(1));
            let is_south = first.is_some_and(|way| way.eq_ignore_ascii_case("SOUTH"));
            let is_plain = value("x_scale") == Some(1.0);
            if is_south || is_plain { 9819 } else { 1041 }
        }
        _ => return methods::of_first(name),
    };
    methods::of_code(code)
}

/// The parameters of version 1: name, value, and the value as it is written.
struct First(Vec<(String, f64, Value)>);

impl First {
    fn of(node: &Node) -> Option<Self> {
        let read =
            |found: &Node| Some((found.name().to_owned(), found.number(1)?, number(found, 1)?));
        node.all(&["PARAMETER"]).map(read).collect::<Option<_>>().map(Self)
    }

    fn find(&self, names: &[&str]) -> Option<&(String, f64, Value)> {
        let is = |(name, ..): &&(String, f64, Value)| {
            names.iter().any(|known| known.eq_ignore_ascii_case(name))
        };
        self.0.iter().find(is)
    }

    fn value(&self, name: &str) -> Option<f64> {
        self.find(&[name]).map(|(_, value, _)| *value)
    }

    /// Those of a method; none if there are more that mean something.
    fn by_method(&self, method: &Method, unit: impl Fn(Measure) -> Value) -> Option<Vec<Value>> {
        /// What tells Krovak's axes, and the sphere of Mercator's, and is no parameter at EPSG.
        const TOLD: [&str; 5] =
            ["x_scale", "y_scale", "xy_plane_rotation", "auxiliary_sphere_type", "option"];
        /// The latitude of Mercator's projection with a standard parallel, which moves nothing.
        const MERCATOR: u32 = 9805;
        let known = || method.parameters.iter().filter_map(|&code| methods::parameter(code));
        for (name, value, _) in &self.0 {
            let is = |names: &[&str]| names.iter().any(|known| known.eq_ignore_ascii_case(name));
            let neutral = if is(&["scale_factor"]) { 1.0 } else { 0.0 };
            // A single standard parallel at the origin says so once more.
            let is_again =
                is(&["standard_parallel_1"]) && Some(*value) == self.value("latitude_of_origin");
            let is_used = known().any(|parameter| is(parameter.first));
            if !is_used && !is(&TOLD) && !is_again && *value != neutral && method.code != MERCATOR {
                return None;
            }
        }
        let found = known().map(|parameter| {
            let neutral = if parameter.measure == Measure::Scale { 1.into() } else { 0.into() };
            // Where grids are not turned, their angle is that of the line.
            let other = if parameter.code == 8814 { self.find(&["azimuth"]) } else { None };
            let value = self.find(parameter.first).or(other).map(|(.., value)| value.clone());
            json!({
                "name": parameter.name,
                "value": value.unwrap_or(neutral),
                "unit": unit(parameter.measure),
                "id": {"authority": "EPSG", "code": parameter.code},
            })
        });
        Some(found.collect())
    }

    /// All of them, with the units that their names suggest.
    fn as_written(&self, unit: impl Fn(Measure) -> Value) -> Vec<Value> {
        const ANGLES: [&str; 6] =
            ["latitude", "longitude", "meridian", "parallel", "azimuth", "angle"];
        let found = self.0.iter().map(|(name, _, value)| {
            let lower = name.to_ascii_lowercase();
            let measure = if lower.starts_with("false") || lower.ends_with("height") {
                Measure::Length
            } else if ANGLES.iter().any(|part| lower.contains(part)) {
                Measure::Angle
            } else {
                Measure::Scale
            };
            json!({"name": name, "value": value, "unit": unit(measure)})
        });
        found.collect()
    }

    /// The axes that a method has where nothing is said of them.
    fn usual_axes(&self, method: &Method) -> Usual {
        const SOUTH_ORIENTATED: u32 = 9808;
        const STEREOGRAPHIC: [u32; 2] = [9810, 9829];
        const EQUAL_AREA: u32 = 9820;
        let names = ["latitude_of_origin", "latitude_of_center", "standard_parallel_1"];
        let latitude = self.find(&names).map_or(0.0, |&(_, latitude, _)| latitude);
        match method.code {
            SOUTH_ORIENTATED => Usual::WestSouth,
            code if STEREOGRAPHIC.contains(&code) && latitude > 0.0 => Usual::NorthPole,
            code if STEREOGRAPHIC.contains(&code) => Usual::SouthPole,
            EQUAL_AREA if latitude == 90.0 => Usual::NorthPole,
            EQUAL_AREA if latitude == -90.0 => Usual::SouthPole,
            _ => Usual::EastNorth,
        }
    }
}

/// Axes of projections. Around a pole both point to it or away from it, along meridians.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Usual {
    EastNorth,
    WestSouth,
    NorthPole,
    SouthPole,
}

/// Both axes of a plane system of version 1.
fn plane_axes(node: &Node, unit: &Value, usual: Usual) -> Option<Vec<Value>> {
    let given: Vec<(&str, String)> = node
        .all(&["AXIS"])
        .map(|axis| Some((axis.name(), direction(axis.text(1)?))))
        .collect::<Option<_>>()?;
    let [first, second] = match usual {
        Usual::EastNorth => [("Easting", "east"), ("Northing", "north")],
        Usual::WestSouth => [("Westing", "west"), ("Southing", "south")],
        Usual::NorthPole => [("Easting", "south"), ("Northing", "south")],
        Usual::SouthPole => [("Easting", "north"), ("Northing", "north")],
    };
    let axes = match given.len() {
        2 => given,
        _ => vec![(first.0, first.1.to_owned()), (second.0, second.1.to_owned())],
    };
    let is_polar = [Usual::NorthPole, Usual::SouthPole].contains(&usual);
    let is_along = is_polar && axes.iter().all(|(_, way)| way == first.1);
    let put = |(name, way): &(&str, String)| {
        let abbreviation = match name.chars().next()?.to_ascii_uppercase() {
            letter @ ('E' | 'N' | 'W' | 'S' | 'X' | 'Y') => letter.to_string(),
            _ => (*name).to_owned(),
        };
        let mut found = axis(name, &abbreviation, way, unit);
        if is_along {
            let is_easting = ["E", "X"].contains(&abbreviation.as_str());
            let longitude = match (is_easting, usual) {
                (true, _) => 90,
                (false, Usual::NorthPole) => 180,
                (false, _) => 0,
            };
            found["meridian"] = json!({"longitude": longitude});
        }
        Some(found)
    };
    axes.iter().map(put).collect()
}
