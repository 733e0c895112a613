//! Systems of well-known text of version 1, as PROJJSON.
//!
//! It is taken as GDAL and ESRI write it: their names of methods and parameters are those of
//! [`methods`](super::methods), angles are in the unit of the geographic system, and what is not said is as
//! usual: eastings before northings, nothing shifted, nothing scaled.

use super::methods::{self, Measure, Method};
use super::node::Node;
use super::parts::{
    add_datum, axis, direction, longitude, millionth, named, number, second, unit, with_name_and_id,
};
use serde_json::{Value, json};

/// A system with its shift to WGS 84: three or seven numbers.
pub(super) fn shifted(system: Value, shift: &Node) -> Option<Value> {
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

pub(super) fn first_geographic(node: &Node, is_known: bool) -> Option<Value> {
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

pub(super) fn first_geocentric(node: &Node) -> Option<Value> {
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

pub(super) fn first_vertical(node: &Node) -> Option<Value> {
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

pub(super) fn first_engineering(node: &Node) -> Option<Value> {
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

pub(super) fn first_projected(node: &Node) -> Option<Value> {
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
