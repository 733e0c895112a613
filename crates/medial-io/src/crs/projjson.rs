//! Reference systems of well-known text as PROJJSON, which has the model of version 2 [OGC 18-010r7].

use super::first::{
    first_engineering, first_geocentric, first_geographic, first_projected, first_vertical, shifted,
};
use super::methods::{self, Measure};
use super::node::Node;
use super::parts::{
    add_datum, axis, direction, ensemble, id_of, identifier, longitude, millionth, named, number,
    second, unit, with_name_and_id,
};
use serde_json::{Value, json};

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
