//! Well-known text of reference systems that are given in PROJJSON, of both versions.

use super::methods;
use super::node::{Node, Part};
use serde_json::{Value, json};

/// The text of version 2 of a system; none of a kind that is not known here.
pub(super) fn second(system: &Value) -> Option<Node> {
    let word = match system["type"].as_str()? {
        "ProjectedCRS" => "PROJCRS",
        "GeographicCRS" => "GEOGCRS",
        "GeodeticCRS" => "GEODCRS",
        "VerticalCRS" => "VERTCRS",
        "EngineeringCRS" => "ENGCRS",
        "CompoundCRS" => "COMPOUNDCRS",
        "BoundCRS" => return bound(system),
        _ => return None,
    };
    let mut node = named(word, system)?;
    match word {
        "COMPOUNDCRS" => {
            for component in system["components"].as_array()? {
                node.parts.push(second(component)?.into());
            }
        }
        "PROJCRS" => {
            let base = &system["base_crs"];
            let mut of_base = named("BASEGEOGCRS", base)?;
            of_base.parts.extend(datum(base)?);
            of_base.parts.extend(id(base));
            node.parts.push(of_base.into());
            node.parts.push(operation("CONVERSION", &system["conversion"])?.into());
        }
        "VERTCRS" if system["datum"].is_object() => {
            node.parts.push(named("VDATUM", &system["datum"])?.into());
        }
        "ENGCRS" => node.parts.push(named("EDATUM", &system["datum"])?.into()),
        _ => node.parts.extend(datum(system)?),
    }
    if word != "COMPOUNDCRS" {
        let coordinates = &system["coordinate_system"];
        let axes = coordinates["axis"].as_array()?;
        let subtype = Part::word(coordinates["subtype"].as_str()?);
        node.parts.push(Node::new("CS", vec![subtype, Part::word(axes.len())]).into());
        for (axis, place) in axes.iter().zip(1..) {
            node.parts.push(axis_of(axis, place)?.into());
        }
    }
    node.parts.extend(id(system));
    Some(node)
}

/// `WORD["name"`, open for what follows.
fn named(word: &str, of: &Value) -> Option<Node> {
    Some(Node::new(word, vec![Part::text(of["name"].as_str()?)]))
}

fn id(of: &Value) -> Option<Part> {
    let (authority, code) = authority(of)?;
    let code = code.parse::<u32>().map_or_else(|_| Part::text(&code), Part::word);
    Some(Node::new("ID", vec![Part::text(&authority), code]).into())
}

fn authority(of: &Value) -> Option<(String, String)> {
    let id = &of["id"];
    let code = id["code"].as_str().map_or_else(|| id["code"].to_string(), ToOwned::to_owned);
    Some((id["authority"].as_str()?.to_owned(), code))
}

/// A unit by its name, or with all that is to know: its word, its name and its factor.
pub(super) fn unit(of: &Value) -> Option<(&'static str, String, f64)> {
    Some(match of.as_str() {
        Some("metre") => ("LENGTHUNIT", "metre".to_owned(), 1.0),
        Some("degree") => ("ANGLEUNIT", "degree".to_owned(), 0.017_453_292_519_943_3),
        Some("unity") => ("SCALEUNIT", "unity".to_owned(), 1.0),
        Some(_) => return None,
        None => {
            let word = match of["type"].as_str()? {
                "LinearUnit" => "LENGTHUNIT",
                "AngularUnit" => "ANGLEUNIT",
                "ScaleUnit" => "SCALEUNIT",
                _ => return None,
            };
            (word, of["name"].as_str()?.to_owned(), of["conversion_factor"].as_f64()?)
        }
    })
}

fn unit_node(of: &Value) -> Option<Part> {
    let (word, name, factor) = unit(of)?;
    Some(Node::new(word, vec![Part::text(&name), Part::word(factor)]).into())
}

/// A value that may have a unit of its own, with that unit.
fn with_unit(value: &Value, usual: &str) -> Option<(f64, Value)> {
    match value.as_f64() {
        Some(number) => Some((number, usual.into())),
        None => Some((value["value"].as_f64()?, value["unit"].clone())),
    }
}

/// The length of the longer half axis, its unit, and the inverse flattening, 0 for a sphere.
pub(super) fn ellipsoid(of: &Value) -> Option<(f64, Value, f64)> {
    if let Some((radius, unit)) = with_unit(&of["radius"], "metre") {
        return Some((radius, unit, 0.0));
    }
    let (axis, unit) = with_unit(&of["semi_major_axis"], "metre")?;
    let flattening = match with_unit(&of["semi_minor_axis"], "metre") {
        Some((other, _)) if other == axis => 0.0,
        Some((other, _)) => axis / (axis - other),
        None => of["inverse_flattening"].as_f64()?,
    };
    Some((axis, unit, flattening))
}

/// The datum or the ensemble, with the prime meridian if it is another than that of Greenwich.
fn datum(of: &Value) -> Option<Vec<Part>> {
    let ensemble = &of["datum_ensemble"];
    let is_ensemble = ensemble.is_object();
    let datum = if is_ensemble { ensemble } else { &of["datum"] };
    let mut node = named(if is_ensemble { "ENSEMBLE" } else { "DATUM" }, datum)?;
    for member in ensemble["members"].as_array().into_iter().flatten() {
        let mut of_member = named("MEMBER", member)?;
        of_member.parts.extend(id(member));
        node.parts.push(of_member.into());
    }
    // Datums of heights have none.
    if datum["ellipsoid"].is_object() || !is_ensemble {
        let (axis, unit, flattening) = ellipsoid(&datum["ellipsoid"])?;
        let mut of_ellipsoid = named("ELLIPSOID", &datum["ellipsoid"])?;
        of_ellipsoid.parts.extend([Part::word(axis), Part::word(flattening), unit_node(&unit)?]);
        of_ellipsoid.parts.extend(id(&datum["ellipsoid"]));
        node.parts.push(of_ellipsoid.into());
    }
    if is_ensemble {
        let accuracy = ensemble["accuracy"].as_str()?;
        node.parts.push(Node::new("ENSEMBLEACCURACY", vec![Part::word(accuracy)]).into());
    }
    node.parts.extend(id(datum));
    let mut parts = Vec::new();
    if let Some(epoch) = datum["frame_reference_epoch"].as_f64() {
        let epoch = Node::new("FRAMEEPOCH", vec![Part::word(epoch)]);
        parts.push(Node::new("DYNAMIC", vec![epoch.into()]).into());
    }
    parts.push(node.into());
    if let Some((longitude, unit)) = prime_meridian(datum) {
        let mut node = named("PRIMEM", &datum["prime_meridian"])?;
        node.parts.extend([Part::word(longitude), unit_node(&unit)?]);
        parts.push(node.into());
    }
    Some(parts)
}

fn prime_meridian(datum: &Value) -> Option<(f64, Value)> {
    with_unit(&datum["prime_meridian"]["longitude"], "degree")
}

fn axis_of(axis: &Value, place: usize) -> Option<Node> {
    let abbreviation = axis["abbreviation"].as_str()?;
    let mut letters = axis["name"].as_str()?.chars();
    let first = letters.next().map(|first| first.to_ascii_lowercase());
    let name: String = first.into_iter().chain(letters).collect();
    let text = Part::text(&format!("{name} ({abbreviation})"));
    let mut node = Node::new("AXIS", vec![text, Part::word(axis["direction"].as_str()?)]);
    if let Some((longitude, unit)) = with_unit(&axis["meridian"]["longitude"], "degree") {
        let parts = vec![Part::word(longitude), unit_node(&unit)?];
        node.parts.push(Node::new("MERIDIAN", parts).into());
    }
    node.parts.push(Node::new("ORDER", vec![Part::word(place)]).into());
    node.parts.extend(unit_node(&axis["unit"]));
    Some(node)
}

/// A conversion or a transformation.
fn operation(word: &str, of: &Value) -> Option<Node> {
    let mut node = named(word, of)?;
    let mut method = named("METHOD", &of["method"])?;
    method.parts.extend(id(&of["method"]));
    node.parts.push(method.into());
    for parameter in of["parameters"].as_array().into_iter().flatten() {
        let value = &parameter["value"];
        let is_file = value.is_string();
        let word = if is_file { "PARAMETERFILE" } else { "PARAMETER" };
        let mut of_parameter = named(word, parameter)?;
        match value.as_str() {
            Some(file) => of_parameter.parts.push(Part::text(file)),
            None => {
                of_parameter.parts.push(Part::word(value.as_f64()?));
                of_parameter.parts.extend(unit_node(&parameter["unit"]));
            }
        }
        of_parameter.parts.extend(id(parameter));
        node.parts.push(of_parameter.into());
    }
    node.parts.extend(id(of));
    Some(node)
}

fn bound(system: &Value) -> Option<Node> {
    let inside =
        |word: &str, of: &str| Some(Part::from(Node::new(word, vec![second(&system[of])?.into()])));
    // Here a scale is what coordinates are multiplied by.
    let mut transformation = system["transformation"].clone();
    for parameter in transformation["parameters"].as_array_mut()? {
        if let Some(("SCALEUNIT", _, factor)) = unit(&parameter["unit"]) {
            parameter["value"] = json!(1.0 + parameter["value"].as_f64()? * factor);
        }
        parameter["unit"] = Value::Null;
    }
    let parts = vec![
        inside("SOURCECRS", "source_crs")?,
        inside("TARGETCRS", "target_crs")?,
        operation("ABRIDGEDTRANSFORMATION", &transformation)?.into(),
    ];
    Some(Node::new("BOUNDCRS", parts))
}

/// The text of version 1 of a system, as GDAL writes it; none if that version has no words for it.
/// Transformations to another system are left out.
pub(super) fn first(system: &Value) -> Option<Node> {
    let mut node = match system["type"].as_str()? {
        "ProjectedCRS" => first_projected(system)?,
        "GeographicCRS" => first_geographic(system)?,
        "VerticalCRS" => {
            let mut node = named("VERT_CS", system)?;
            let ensemble = &system["datum_ensemble"];
            let of_datum = if ensemble.is_object() { ensemble } else { &system["datum"] };
            let mut datum = named("VERT_DATUM", of_datum)?;
            // The only type that is in use.
            datum.parts.push(Part::word(2005));
            datum.parts.extend(authority_node(of_datum));
            node.parts.push(datum.into());
            first_axes(&mut node, system)?;
            node
        }
        "EngineeringCRS" => {
            let mut node = named("LOCAL_CS", system)?;
            first_axes(&mut node, system)?;
            node
        }
        "CompoundCRS" => {
            let mut node = named("COMPD_CS", system)?;
            for component in system["components"].as_array()? {
                node.parts.push(first(component)?.into());
            }
            node
        }
        "BoundCRS" => return first(&system["source_crs"]),
        _ => return None,
    };
    node.parts.extend(authority_node(system));
    Some(node)
}

fn authority_node(of: &Value) -> Option<Part> {
    let (authority, code) = authority(of)?;
    Some(Node::new("AUTHORITY", vec![Part::text(&authority), Part::text(&code)]).into())
}

/// The unit of all axes of a system.
fn unit_of_axes(system: &Value) -> Option<(&'static str, String, f64)> {
    let mut units =
        system["coordinate_system"]["axis"].as_array()?.iter().map(|axis| &axis["unit"]);
    let first = units.next()?;
    units.all(|other| other == first).then(|| unit(first))?
}

fn first_unit(system: &Value) -> Option<(Part, f64)> {
    let (_, name, factor) = unit_of_axes(system)?;
    Some((Node::new("UNIT", vec![Part::text(&name), Part::word(factor)]).into(), factor))
}

/// Adds the unit and the axes of a system.
fn first_axes(node: &mut Node, system: &Value) -> Option<()> {
    node.parts.push(first_unit(system)?.0);
    for axis in system["coordinate_system"]["axis"].as_array()? {
        let name = Part::text(axis["name"].as_str()?);
        let direction = Part::word(axis["direction"].as_str()?.to_ascii_uppercase());
        node.parts.push(Node::new("AXIS", vec![name, direction]).into());
    }
    Some(())
}

fn first_geographic(system: &Value) -> Option<Node> {
    let ensemble = &system["datum_ensemble"];
    let datum = if ensemble.is_object() { ensemble } else { &system["datum"] };
    let mut node = named("GEOGCS", system)?;
    let name = datum["name"].as_str()?.trim_end_matches(" ensemble");
    let name = if name == "World Geodetic System 1984" { "WGS 1984" } else { name };
    let mut of_datum = Node::new("DATUM", vec![Part::text(&name.replace([' ', '-'], "_"))]);
    let (axis, unit_of_axis, flattening) = ellipsoid(&datum["ellipsoid"])?;
    let (_, _, metres) = unit(&unit_of_axis)?;
    let mut spheroid = named("SPHEROID", &datum["ellipsoid"])?;
    spheroid.parts.extend([Part::word(axis * metres), Part::word(flattening)]);
    spheroid.parts.extend(authority_node(&datum["ellipsoid"]));
    of_datum.parts.push(spheroid.into());
    of_datum.parts.extend(authority_node(datum));
    node.parts.push(of_datum.into());
    let (unit_node, factor) = first_unit(system)?;
    let meridian = match prime_meridian(datum) {
        Some((longitude, of)) => {
            let (_, _, own) = unit(&of)?;
            let mut node = named("PRIMEM", &datum["prime_meridian"])?;
            node.parts.push(Part::word(converted(longitude, own, factor)));
            node
        }
        None => Node::new("PRIMEM", vec![Part::text("Greenwich"), Part::word(0)]),
    };
    node.parts.extend([meridian.into(), unit_node]);
    // Coordinates are in the order of the plane, whatever the definition says.
    for (name, direction) in [("Longitude", "EAST"), ("Latitude", "NORTH")] {
        let parts = vec![Part::text(name), Part::word(direction)];
        node.parts.push(Node::new("AXIS", parts).into());
    }
    Some(node)
}

/// A number in another unit; the same one if it is that.
fn converted(value: f64, from: f64, to: f64) -> f64 {
    if from == to { value } else { value * from / to }
}

fn first_projected(system: &Value) -> Option<Node> {
    let mut node = named("PROJCS", system)?;
    let base = &system["base_crs"];
    let mut base = base.clone();
    if base["coordinate_system"].is_null() {
        let axes = [json!({"unit": "degree"}), json!({"unit": "degree"})];
        base["coordinate_system"] = json!({"axis": axes});
    }
    let mut of_base = first_geographic(&base)?;
    // The axes of the base say nothing of the coordinates.
    of_base.parts.retain(|part| !matches!(part, Part::Node(node) if node.word == "AXIS"));
    of_base.parts.extend(authority_node(&base));
    node.parts.push(of_base.into());
    let (_, _, angle) = unit_of_axes(&base)?;
    let (_, _, length) = unit_of_axes(system)?;
    let conversion = &system["conversion"];
    let of_method = &conversion["method"];
    let is_epsg = of_method["id"]["authority"] == "EPSG";
    let code = of_method["id"]["code"].as_u64().filter(|_| is_epsg).unwrap_or_default();
    let method = methods::of_code(u32::try_from(code).ok()?)
        .or_else(|| methods::of_name(of_method["name"].as_str()?))?;
    const WEB_MERCATOR: u32 = 1024;
    let is_web = method.code == WEB_MERCATOR;
    let name = if is_web { "Mercator_1SP" } else { method.first };
    node.parts.push(Node::new("PROJECTION", vec![Part::text(name)]).into());
    for parameter in conversion["parameters"].as_array()? {
        let code = parameter["id"]["code"].as_u64().unwrap_or_default();
        let known = methods::parameter(u32::try_from(code).ok()?)
            .or_else(|| methods::parameter_of_name(parameter["name"].as_str()?))
            .filter(|known| method.parameters.contains(&known.code))?;
        let (_, _, own) = unit(&parameter["unit"])?;
        let to = match known.measure {
            methods::Measure::Angle => angle,
            methods::Measure::Length => length,
            methods::Measure::Scale => 1.0,
        };
        let value = Part::word(converted(parameter["value"].as_f64()?, own, to));
        let name = Part::text(method.first_name(known));
        node.parts.push(Node::new("PARAMETER", vec![name, value]).into());
    }
    if is_web {
        let scale = vec![Part::text("scale_factor"), Part::word(1)];
        node.parts.push(Node::new("PARAMETER", scale).into());
    }
    first_axes(&mut node, system)?;
    if is_web {
        const EXTENSION: &str = "+proj=merc +a=6378137 +b=6378137 +lat_ts=0 +lon_0=0 +x_0=0 +y_0=0 \
                                 +k=1 +units=m +nadgrids=@null +wktext +no_defs";
        let parts = vec![Part::text("PROJ4"), Part::text(EXTENSION)];
        node.parts.push(Node::new("EXTENSION", parts).into());
    }
    Some(node)
}
