//! Coordinate reference systems, as far as they can be told without a library of projections.

mod agreement;
mod esri;
mod first;
mod methods;
mod node;
mod parts;
mod projjson;
mod wkt;

use crate::Json;
use node::Node;
use serde::Deserialize;
use serde_json::Value;
use std::borrow::Cow;

/// The reference system of a layer: what its format says of it, and what follows from that.
///
/// ```
/// use medial_io::Crs;
///
/// let crs = Crs::epsg(2193);
/// assert!(!crs.is_geographic());
/// assert_eq!(crs.to_string(), "EPSG:2193");
/// assert!(crs.wkt().is_some_and(|wkt| wkt.starts_with("PROJCS[\"NZGD2000 / New Zealand")));
/// ```
#[derive(Clone, Debug, Default)]
pub struct Crs {
    authority: Option<(String, String)>,
    wkt: Option<String>,
    projjson: Option<Json>,
    member: Option<Json>,
    is_assumed: bool,
}

/// The members of a `crs` of GeoJSON.
#[derive(Deserialize)]
struct Member {
    properties: Option<Properties>,
}

#[derive(Deserialize)]
struct Properties {
    name: Option<String>,
}

impl Crs {
    /// The one with a code of EPSG.
    #[must_use]
    pub fn epsg(code: u32) -> Self {
        Self::of_authority("EPSG", &code.to_string())
    }

    /// The one with a code of an authority.
    #[must_use]
    pub fn of_authority(authority: &str, code: &str) -> Self {
        let authority = (authority.to_ascii_uppercase(), code.to_owned());
        Self { authority: Some(authority), ..Self::default() }
    }

    /// WGS 84 as GeoJSON has it where it says nothing: longitudes before latitudes.
    #[must_use]
    pub fn of_geojson() -> Self {
        Self { is_assumed: true, ..Self::of_authority("OGC", "CRS84") }
    }

    /// What a `crs` member of GeoJSON says; it is kept as it is.
    #[must_use]
    pub fn of_member(member: Json) -> Self {
        let name = serde_json::from_str::<Member>(member.get()).ok();
        let name = name.and_then(|member| member.properties).and_then(|found| found.name);
        let authority = name.and_then(|name| named(&name));
        Self { authority, member: Some(member), ..Self::default() }
    }

    /// What well-known text says, of either version; of ESRI's names for them the most common ones are
    /// known, where what else is said agrees with them.
    #[must_use]
    pub fn of_wkt(wkt: &str) -> Self {
        let wkt = wkt.trim();
        let epsg = |code| ("EPSG".to_owned(), code);
        let of_name = || {
            let code = esri::code(&name_in(wkt)?)?;
            agreement::agree(wkt, &Self::epsg(code)).then(|| epsg(code.to_string()))
        };
        // A vertical system behind the first one makes another one of both.
        let is_one = Node::read_all(wkt).is_none_or(|nodes| nodes.len() == 1);
        let authority = if is_one { identifier(wkt).or_else(of_name) } else { None };
        Self { authority, wkt: Some(wkt.to_owned()), ..Self::default() }
    }

    /// What PROJJSON says.
    #[must_use]
    pub fn of_projjson(projjson: Json) -> Self {
        #[derive(Deserialize)]
        struct Head {
            id: Option<Id>,
        }
        #[derive(Deserialize)]
        struct Id {
            authority: String,
            code: Value,
        }
        let head = serde_json::from_str::<Head>(projjson.get()).ok();
        let authority = head.and_then(|head| head.id).map(|id| {
            let code = id.code.as_str().map_or_else(|| id.code.to_string(), ToOwned::to_owned);
            (id.authority.to_ascii_uppercase(), code)
        });
        Self { authority, projjson: Some(projjson), ..Self::default() }
    }

    /// The same with this text for it.
    #[must_use]
    pub fn with_wkt(self, wkt: &str) -> Self {
        Self { wkt: Some(wkt.trim().to_owned()), ..self }
    }

    /// The authority and its code, if they are known.
    #[must_use]
    pub fn authority(&self) -> Option<(&str, &str)> {
        self.authority.as_ref().map(|(name, code)| (name.as_str(), code.as_str()))
    }

    /// The number at EPSG, if it is known; that of EPSG:4326 also for the same with longitudes first, as
    /// formats that fix the order of coordinates need no name for that.
    #[must_use]
    pub fn epsg_code(&self) -> Option<u32> {
        match self.authority()? {
            ("EPSG", code) => code.parse().ok(),
            ("OGC", "CRS84") => Some(4326),
            _ => None,
        }
    }

    /// Its well-known text: as it was read, as EPSG defines it (version 1), or as its PROJJSON says
    /// (version 2).
    #[must_use]
    pub fn wkt(&self) -> Option<Cow<'_, str>> {
        self.wkt.as_deref().map(Cow::Borrowed).or_else(|| self.defined()).or_else(|| {
            let projjson = serde_json::from_str(self.projjson.as_ref()?.get()).ok()?;
            Some(wkt::second(&projjson)?.to_string().into())
        })
    }

    /// Its well-known text of version 1, which is the one that older formats know: as it was read, as EPSG
    /// defines it, or as what was read says in other words.
    #[must_use]
    pub fn first_wkt(&self) -> Option<Cow<'_, str>> {
        const FIRST: [&str; 6] = ["PROJCS", "GEOGCS", "GEOCCS", "COMPD_CS", "LOCAL_CS", "VERT_CS"];
        let word =
            |wkt: &str| wkt.split(['[', '(']).next().unwrap_or_default().trim().to_uppercase();
        match &self.wkt {
            Some(wkt) if FIRST.contains(&word(wkt).as_str()) => Some(wkt.as_str().into()),
            // A definition may have the axes in another order than the input.
            None if self.projjson.is_none() => self.defined(),
            _ => {
                let projjson = self.projjson().and_then(|text| serde_json::from_str(&text).ok());
                let derived = projjson.and_then(|found| wkt::first(&found));
                derived.map(|node| node.to_string().into()).or_else(|| self.defined())
            }
        }
    }

    /// The text by which EPSG defines it, without the shifts to WGS 84 that are no part of that.
    fn defined(&self) -> Option<Cow<'_, str>> {
        let code = u16::try_from(self.epsg_code()?).ok()?;
        let text = crs_definitions::from_code(code)?.wkt;
        let mut node = Node::read_all(text)?.into_iter().next()?;
        if node.word == "BOUNDCRS" {
            let source = node.get(&["SOURCECRS"])?.nodes().next().cloned();
            node = source?;
        }
        node.remove("TOWGS84");
        Some(node.to_string().into())
    }

    /// Its PROJJSON: as it was read, or what follows from its well-known text, which its number at EPSG may
    /// stand for. None if neither tells enough.
    ///
    /// ```
    /// let crs = medial_io::Crs::epsg(27700);
    /// assert!(crs.projjson().is_some_and(|found| found.contains("\"Transverse Mercator\"")));
    /// ```
    #[must_use]
    pub fn projjson(&self) -> Option<Cow<'_, str>> {
        if let Some(projjson) = &self.projjson {
            return Some(projjson.get().into());
        }
        if self.epsg_code() == Some(4326) {
            return Some(WGS_84.into());
        }
        let id = self.authority();
        let of_text = |text: &str| projjson::of_text(text, id);
        let found = self.wkt.as_deref().and_then(of_text);
        let found = found.or_else(|| of_text(&self.defined()?))?;
        Some(found.to_string().into())
    }

    /// Its `crs` member in GeoJSON: as it was read, or by its authority; none where nothing has to be
    /// said, or nothing can be.
    #[must_use]
    pub fn member(&self) -> Option<Json> {
        if self.member.is_some() || self.is_assumed {
            return self.member.clone();
        }
        let name = match self.authority()? {
            // The order of the coordinates in every format that is read.
            ("OGC", "CRS84") | ("EPSG", "4326") => "urn:ogc:def:crs:OGC:1.3:CRS84".to_owned(),
            (authority, code) => format!("urn:ogc:def:crs:{authority}::{code}"),
        };
        let member = serde_json::json!({"type": "name", "properties": {"name": name}});
        serde_json::value::to_raw_value(&member).ok()
    }

    /// Whether coordinates are degrees of longitude and latitude, as far as that is known.
    #[must_use]
    pub fn is_geographic(&self) -> bool {
        if let Some(projjson) = &self.projjson {
            let found = serde_json::from_str::<Value>(projjson.get()).ok();
            return found.as_ref().is_some_and(is_geographic_object);
        }
        self.wkt().map_or_else(
            || {
                self.authority()
                    .is_some_and(|(name, code)| name == "OGC" && code.starts_with("CRS8"))
            },
            |wkt| is_geographic_text(&wkt),
        )
    }

    /// The name of the unit of longitudes and latitudes, if coordinates are these, and how many degrees it has.
    ///
    /// ```
    /// assert_eq!(medial_io::Crs::epsg(4326).angular_unit(), Some(("degree".to_owned(), 1.0)));
    /// let (name, degrees) = medial_io::Crs::epsg(4807).angular_unit().unwrap();
    /// assert_eq!((name.as_str(), (degrees * 10.0).round()), ("grad", 9.0));
    /// ```
    #[must_use]
    pub fn angular_unit(&self) -> Option<(String, f64)> {
        if !self.is_geographic() {
            return None;
        }
        let projjson = self.projjson().and_then(|text| serde_json::from_str::<Value>(&text).ok());
        let unit = projjson.as_ref().and_then(first_unit);
        let named = unit.and_then(|unit| {
            let degrees = unit["conversion_factor"].as_f64()?.to_degrees();
            // However the degree is called and rounded.
            let is_other = (degrees - 1.0).abs() > 1e-9;
            is_other.then_some((unit["name"].as_str()?.to_owned(), degrees))
        });
        Some(named.unwrap_or_else(|| ("degree".to_owned(), 1.0)))
    }

    /// Whether anything tells what its coordinates are.
    #[must_use]
    pub fn is_defined(&self) -> bool {
        self.projjson.is_some() || self.wkt().is_some()
    }

    /// Whether the input says nothing of it, and the rules of its format do.
    #[must_use]
    pub fn is_assumed(&self) -> bool {
        self.is_assumed
    }

    /// Whether it and another one are known to be different: by their numbers at EPSG, else by what their well-known
    /// texts say.
    ///
    /// ```
    /// use medial_io::Crs;
    /// assert!(Crs::epsg(32632).differs_from(&Crs::epsg(32633)));
    /// assert!(!Crs::epsg(4326).differs_from(&Crs::of_geojson()));
    /// ```
    #[must_use]
    pub fn differs_from(&self, other: &Self) -> bool {
        match (self.epsg_code(), other.epsg_code()) {
            (Some(code), Some(other)) => code != other,
            _ => self.wkt().is_some_and(|wkt| !agreement::agree(&wkt, other)),
        }
    }

    /// Its name, as far as it has one.
    #[must_use]
    pub fn name(&self) -> Option<String> {
        name_in(&self.wkt()?)
    }
}

impl std::fmt::Display for Crs {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match (self.authority(), self.name()) {
            (Some((authority, code)), _) => write!(f, "{authority}:{code}"),
            (None, Some(name)) => f.write_str(&name),
            (None, None) => f.write_str("without a name"),
        }
    }
}

/// The authority and the code in a name such as `EPSG:4326` or `urn:ogc:def:crs:EPSG::4326`.
fn named(name: &str) -> Option<(String, String)> {
    let parts: Vec<&str> = name.split(':').collect();
    let is_urn = parts.first().is_some_and(|first| first.eq_ignore_ascii_case("urn"));
    let (authority, code) = match parts[..] {
        [authority, code] => (authority, code),
        [_, _, _, _, authority, _, code] if is_urn => (authority, code),
        _ => return None,
    };
    (!code.is_empty()).then(|| (authority.to_ascii_uppercase(), code.to_owned()))
}

/// The name of the system in well-known text.
fn name_in(wkt: &str) -> Option<String> {
    let name = wkt.split('"').nth(1)?.trim();
    (!name.is_empty()).then(|| name.to_owned())
}

/// The identifier of the whole in well-known text: `AUTHORITY["EPSG","2193"]` or `ID["EPSG",2193]`
/// one level below the outermost bracket.
fn identifier(wkt: &str) -> Option<(String, String)> {
    let (mut depth, mut in_quotes, mut found) = (0_usize, false, None);
    for (k, c) in wkt.char_indices() {
        match c {
            '"' => in_quotes = !in_quotes,
            _ if in_quotes => {}
            '[' | '(' => {
                depth += 1;
                if depth == 2 {
                    let before = wkt[..k].trim_end();
                    let word = before.rsplit(|c: char| !c.is_ascii_alphabetic()).next();
                    let word = word.unwrap_or_default().to_ascii_uppercase();
                    if word == "AUTHORITY" || word == "ID" {
                        found = Some(&wkt[k + 1..]);
                    }
                }
            }
            ']' | ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
    }
    let inner = found?.split([']', ')']).next()?;
    let mut parts = inner.split(',').map(|part| part.trim().trim_matches('"'));
    let (authority, code) = (parts.next()?, parts.next()?);
    (!code.is_empty()).then(|| (authority.to_ascii_uppercase(), code.to_owned()))
}

/// Whether well-known text is of degrees: of a compound system its first part counts, and what a projected
/// one is based on comes behind its own word.
fn is_geographic_text(wkt: &str) -> bool {
    let wkt = wkt.to_ascii_uppercase();
    let first = |words: &[&str]| words.iter().filter_map(|word| wkt.find(word)).min();
    let degrees = first(&["GEOGCS", "GEOGCRS", "GEODCRS", "GEOGRAPHICCRS", "GEODETICCRS"]);
    let others = first(&["PROJCS", "PROJCRS", "PROJECTEDCRS", "GEOCCS", "LOCAL_CS", "ENGCRS"]);
    degrees.is_some_and(|at| others.is_none_or(|other| at < other))
}

/// The unit of the first axis of a system in PROJJSON.
fn first_unit(crs: &Value) -> Option<&Value> {
    match crs["type"].as_str() {
        Some("CompoundCRS") => first_unit(crs["components"].get(0)?),
        Some("BoundCRS") => first_unit(crs.get("source_crs")?),
        _ => crs["coordinate_system"]["axis"].get(0)?.get("unit"),
    }
}

/// The same of PROJJSON.
fn is_geographic_object(crs: &Value) -> bool {
    match crs["type"].as_str() {
        Some("GeographicCRS") => true,
        Some("CompoundCRS") => is_geographic_object(&crs["components"][0]),
        Some("BoundCRS") => is_geographic_object(&crs["source_crs"]),
        _ => false,
    }
}

/// EPSG:4326, as PROJ writes it.
const WGS_84: &str = r#"{"$schema":"https://proj.org/schemas/v0.7/projjson.schema.json","type":"GeographicCRS","name":"WGS 84","datum_ensemble":{"name":"World Geodetic System 1984 ensemble","members":[{"name":"World Geodetic System 1984 (Transit)"},{"name":"World Geodetic System 1984 (G730)"},{"name":"World Geodetic System 1984 (G873)"},{"name":"World Geodetic System 1984 (G1150)"},{"name":"World Geodetic System 1984 (G1674)"},{"name":"World Geodetic System 1984 (G1762)"},{"name":"World Geodetic System 1984 (G2139)"}],"ellipsoid":{"name":"WGS 84","semi_major_axis":6378137,"inverse_flattening":298.257223563},"accuracy":"2.0","id":{"authority":"EPSG","code":6326}},"coordinate_system":{"subtype":"ellipsoidal","axis":[{"name":"Geodetic latitude","abbreviation":"Lat","direction":"north","unit":"degree"},{"name":"Geodetic longitude","abbreviation":"Lon","direction":"east","unit":"degree"}]},"scope":"Horizontal component of 3D system.","area":"World.","bbox":{"south_latitude":-90,"west_longitude":-180,"north_latitude":90,"east_longitude":180},"id":{"authority":"EPSG","code":4326}}"#;

#[cfg(test)]
mod tests {
    use super::*;

    fn json(text: &str) -> Json {
        serde_json::value::RawValue::from_string(text.to_owned()).unwrap()
    }

    #[test]
    fn names_of_members_are_understood() {
        for (name, expected) in [
            ("urn:ogc:def:crs:EPSG::2193", Some(("EPSG", "2193"))),
            ("urn:ogc:def:crs:OGC:1.3:CRS84", Some(("OGC", "CRS84"))),
            ("EPSG:28992", Some(("EPSG", "28992"))),
            ("something", None),
        ] {
            let text = format!("{{\"type\": \"name\", \"properties\": {{\"name\": \"{name}\"}}}}");
            let crs = Crs::of_member(json(&text));
            assert_eq!(crs.authority(), expected);
            assert_eq!(crs.member().unwrap().get(), text, "as it was");
        }
    }

    #[test]
    fn the_identifier_of_a_text_is_the_outer_one() {
        let wkt = Crs::epsg(2193).wkt().unwrap().into_owned();
        let crs = Crs::of_wkt(&wkt);
        assert_eq!((crs.epsg_code(), crs.is_geographic()), (Some(2193), false));
        let inner = "PROJCS[\"mine\",GEOGCS[\"g\",AUTHORITY[\"EPSG\",\"4326\"]],UNIT[\"m\",1]]";
        assert_eq!(Crs::of_wkt(inner).authority(), None);
        assert_eq!(Crs::of_wkt(inner).to_string(), "mine");
        let second = "GEOGCRS[\"WGS 84\",DATUM[\"d\",ID[\"EPSG\",6326]],ID[\"EPSG\",4326]]";
        assert_eq!(Crs::of_wkt(second).epsg_code(), Some(4326));
        assert!(Crs::of_wkt(second).is_geographic());
        assert!(Crs::of_wkt(second).first_wkt().is_some_and(|wkt| wkt.starts_with("GEOGCS")));
        assert!(Crs::of_wkt("PROJCRS[\"mine\"]").first_wkt().is_none());
        assert!(Crs::of_wkt("PROJCRS[\"mine\"]").projjson().is_none());
    }

    #[test]
    fn degrees_are_found_in_compound_systems() {
        let of = |wkt: &str| Crs::of_wkt(wkt).is_geographic();
        assert!(of("COMPD_CS[\"a\",GEOGCS[\"b\"],VERT_CS[\"c\"]]"));
        assert!(of("BOUNDCRS[SOURCECRS[GEOGCRS[\"b\"]],TARGETCRS[GEOGCRS[\"c\"]]]"));
        assert!(!of("COMPD_CS[\"a\",PROJCS[\"b\",GEOGCS[\"c\"]],VERT_CS[\"d\"]]"));
        assert!(!of("LOCAL_CS[\"a\"]"));
        let of = |text: &str| Crs::of_projjson(json(text)).is_geographic();
        assert!(of(r#"{"type":"CompoundCRS","components":[{"type":"GeographicCRS"},{}]}"#));
        assert!(!of(r#"{"type":"CompoundCRS","components":[{"type":"ProjectedCRS"},{}]}"#));
        assert!(of(r#"{"type":"BoundCRS","source_crs":{"type":"GeographicCRS"}}"#));
    }

    #[test]
    fn names_of_esri_are_known() {
        let of = |name: &str| Crs::of_wkt(&format!("PROJCS[\"{name}\"]")).epsg_code();
        assert_eq!(of("WGS_1984_UTM_Zone_33N"), Some(32633));
        assert_eq!(of("WGS_1984_UTM_Zone_5S"), Some(32705));
        assert_eq!(of("ETRS_1989_UTM_Zone_32N"), Some(25832));
        assert_eq!(of("RD_New"), Some(28992));
        assert_eq!(of("WGS_1984_UTM_Zone_99N"), None);
        let both = Crs::of_wkt("PROJCS[\"RD_New\"],VERTCS[\"NAP\"]");
        assert_eq!(both.epsg_code(), None, "that is of the first one only");
    }

    /// As the command line of ESRI writes them; the datum of a name is that of the geographic system.
    #[test]
    fn names_of_esri_stand_for_a_code_only_where_all_agrees() {
        const UTM: &str = "PROJCS[\"WGS_1984_UTM_Zone_33N\",GEOGCS[\"GCS_WGS_1984\",\
            DATUM[\"D_WGS_1984\",SPHEROID[\"WGS_1984\",6378137.0,298.257223563]],\
            PRIMEM[\"Greenwich\",0.0],UNIT[\"Degree\",0.0174532925199433]],\
            PROJECTION[\"Transverse_Mercator\"],PARAMETER[\"False_Easting\",500000.0],\
            PARAMETER[\"False_Northing\",0.0],PARAMETER[\"Central_Meridian\",15.0],\
            PARAMETER[\"Scale_Factor\",0.9996],PARAMETER[\"Latitude_Of_Origin\",0.0],UNIT[\"Meter\",1.0]]";
        assert_eq!(Crs::of_wkt(UTM).epsg_code(), Some(32633));
        for (from, to) in [
            ("UNIT[\"Meter\",1.0]", "UNIT[\"Foot_US\",0.304800609601219]"),
            ("Transverse_Mercator", "Mercator"),
            ("Central_Meridian\",15.0", "Central_Meridian\",9.0"),
            ("6378137.0,298.257223563", "6377397.155,299.1528128"),
        ] {
            let other = UTM.replace(from, to);
            assert_ne!(other, UTM);
            assert_eq!(Crs::of_wkt(&other).epsg_code(), None, "{to}");
        }
    }

    #[test]
    fn projjson_has_a_type_and_an_identifier() {
        let crs = Crs::of_projjson(json(WGS_84));
        assert_eq!((crs.epsg_code(), crs.is_geographic()), (Some(4326), true));
        let crs = Crs::of_projjson(json("{\"type\":\"ProjectedCRS\",\"name\":\"x\"}"));
        assert_eq!((crs.authority(), crs.is_geographic()), (None, false));
    }

    #[test]
    fn what_geojson_does_not_say_is_not_said_again() {
        let crs = Crs::of_geojson();
        assert!(crs.is_geographic() && crs.is_assumed() && crs.member().is_none());
        assert_eq!(crs.epsg_code(), Some(4326));
        let member = Crs::epsg(4326).member().unwrap();
        assert!(member.get().contains("OGC:1.3:CRS84"));
        assert!(Crs::epsg(28992).member().unwrap().get().contains("EPSG::28992"));
    }

    /// What pyproj makes of the same texts is compared in `tests/foreign`.
    #[test]
    fn dialects_of_well_known_text_tell_the_same() {
        let gdal = "PROJCS[\"x\",GEOGCS[\"g\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563]],\
            PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]],\
            PROJECTION[\"Polar_Stereographic\"],PARAMETER[\"latitude_of_origin\",-71],\
            PARAMETER[\"central_meridian\",0],UNIT[\"metre\",1],\
            AXIS[\"Easting\",NORTH],AXIS[\"Northing\",NORTH]]";
        let esri = "PROJCS[\"x\",GEOGCS[\"g\",DATUM[\"D_WGS_1984\",SPHEROID[\"WGS 84\",6378137.0,298.257223563]],\
            PRIMEM[\"Greenwich\",0.0],UNIT[\"Degree\",0.0174532925199433]],\
            PROJECTION[\"Stereographic_South_Pole\"],PARAMETER[\"Central_Meridian\",0.0],\
            PARAMETER[\"Standard_Parallel_1\",-71.0],UNIT[\"Meter\",1.0]]";
        let of = |text: &str| -> Value {
            serde_json::from_str(&Crs::of_wkt(text).projjson().unwrap()).unwrap()
        };
        let (gdal, esri) = (of(gdal), of(esri));
        let method = &gdal["conversion"]["method"];
        assert_eq!(method["name"], "Polar Stereographic (variant B)");
        assert_eq!(esri["conversion"]["method"], *method);
        assert_eq!(gdal["conversion"]["parameters"][0]["value"], -71);
        assert_eq!(gdal["coordinate_system"], esri["coordinate_system"]);
        let meridians = ["0", "1"].map(|k| {
            let axis = &gdal["coordinate_system"]["axis"][k.parse::<usize>().unwrap()];
            axis["meridian"]["longitude"].as_f64().unwrap()
        });
        assert_eq!(meridians, [90.0, 0.0]);
        assert_eq!(gdal["base_crs"]["datum"]["name"], "World Geodetic System 1984");
        assert_eq!(esri["base_crs"]["datum"]["name"], "World Geodetic System 1984");
    }

    #[test]
    fn shifts_to_wgs_84_bind_a_system_without_a_number() {
        let wkt = |id: &str| {
            format!(
                "GEOGCS[\"g\",DATUM[\"d\",SPHEROID[\"s\",6377397.155,299.15],TOWGS84[1,2,3,0,0,0,0]],\
                 PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]{id}]"
            )
        };
        let of = |text: &str| -> Value {
            serde_json::from_str(&Crs::of_wkt(text).projjson().unwrap()).unwrap()
        };
        let bound = of(&wkt(""));
        assert_eq!(
            (&bound["type"], &bound["source_crs"]["name"]),
            (&"BoundCRS".into(), &"g".into())
        );
        assert_eq!(bound["transformation"]["parameters"].as_array().unwrap().len(), 3);
        let known = of(&wkt(",AUTHORITY[\"EPSG\",\"4289\"]"));
        assert_eq!((&known["type"], &known["id"]["code"]), (&"GeographicCRS".into(), &4289.into()));
    }

    #[test]
    fn projjson_becomes_text_of_both_versions() {
        let of_code = Crs::epsg(5070);
        let own = of_code.projjson().unwrap().replace("5070", "990001").replace("EPSG", "mine");
        let crs = Crs::of_projjson(json(&own));
        let second = crs.wkt().unwrap();
        assert!(second.starts_with("PROJCRS[\"NAD83 / Conus Albers\",BASEGEOGCRS["), "{second}");
        assert!(second.contains("METHOD[\"Albers Equal Area\""), "{second}");
        let first = crs.first_wkt().unwrap();
        assert!(first.contains("PARAMETER[\"latitude_of_center\",23]"), "{first}");
        let again = Crs::of_wkt(&second).projjson().unwrap().into_owned();
        let value = |text: &str| -> Value { serde_json::from_str(text).unwrap() };
        let (again, own) = (value(&again), value(&own));
        assert_eq!(again["coordinate_system"], own["coordinate_system"]);
        let numbers = |of: &Value| -> Vec<f64> {
            let parameters = of["conversion"]["parameters"].as_array().unwrap();
            parameters.iter().map(|found| found["value"].as_f64().unwrap()).collect()
        };
        assert_eq!(numbers(&again), numbers(&own));
    }
}
