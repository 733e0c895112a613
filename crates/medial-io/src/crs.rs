//! Coordinate reference systems, as far as they can be told without a library of projections.

use crate::Json;
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
    /// known.
    #[must_use]
    pub fn of_wkt(wkt: &str) -> Self {
        let wkt = wkt.trim();
        let epsg = |code| ("EPSG".to_owned(), code);
        let authority =
            identifier(wkt).or_else(|| esri(&name_in(wkt)?).map(|code| epsg(code.to_string())));
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

    /// Its well-known text, as it was read or as EPSG defines it (version 1).
    #[must_use]
    pub fn wkt(&self) -> Option<Cow<'_, str>> {
        self.wkt.as_deref().map(Cow::Borrowed).or_else(|| self.defined())
    }

    /// Its well-known text of version 1, which is the one that older formats know.
    #[must_use]
    pub fn first_wkt(&self) -> Option<Cow<'_, str>> {
        const SECOND: [&str; 8] = [
            "PROJCRS",
            "GEOGCRS",
            "GEODCRS",
            "COMPOUNDCRS",
            "BOUNDCRS",
            "ENGCRS",
            "VERTCRS",
            "DERIVEDPROJCRS",
        ];
        let word =
            |wkt: &str| wkt.split(['[', '(']).next().unwrap_or_default().trim().to_uppercase();
        match &self.wkt {
            Some(wkt) if !SECOND.contains(&word(wkt).as_str()) => Some(wkt.as_str().into()),
            _ => self.defined(),
        }
    }

    /// The text by which EPSG defines it.
    fn defined(&self) -> Option<Cow<'_, str>> {
        let code = u16::try_from(self.epsg_code()?).ok()?;
        crs_definitions::from_code(code).map(|found| found.wkt.into())
    }

    /// Its PROJJSON, if it was read; that of EPSG:4326 is known besides.
    #[must_use]
    pub fn projjson(&self) -> Option<&str> {
        match &self.projjson {
            Some(projjson) => Some(projjson.get()),
            None if self.epsg_code() == Some(4326) => Some(WGS_84),
            None => None,
        }
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

    /// Whether the input says nothing of it, and the rules of its format do.
    #[must_use]
    pub fn is_assumed(&self) -> bool {
        self.is_assumed
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
            (None, None) => f.write_str("a reference system without a name"),
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

/// The same of PROJJSON.
fn is_geographic_object(crs: &Value) -> bool {
    match crs["type"].as_str() {
        Some("GeographicCRS") => true,
        Some("CompoundCRS") => is_geographic_object(&crs["components"][0]),
        Some("BoundCRS") => is_geographic_object(&crs["source_crs"]),
        _ => false,
    }
}

/// The code at EPSG of a name as ESRI writes it, of the most common ones.
fn esri(name: &str) -> Option<u32> {
    const KNOWN: [(&str, u32); 22] = [
        ("GCS_WGS_1984", 4326),
        ("GCS_North_American_1983", 4269),
        ("GCS_North_American_1927", 4267),
        ("GCS_ETRS_1989", 4258),
        ("GCS_GDA_1994", 4283),
        ("GCS_GDA2020", 7844),
        ("GCS_NZGD_2000", 4167),
        ("GCS_JGD_2011", 6668),
        ("WGS_1984_Web_Mercator_Auxiliary_Sphere", 3857),
        ("WGS_84_Pseudo_Mercator", 3857),
        ("NZGD_2000_New_Zealand_Transverse_Mercator", 2193),
        ("British_National_Grid", 27700),
        ("TM65_Irish_Grid", 29902),
        ("IRENET95_Irish_Transverse_Mercator", 2157),
        ("RGF_1993_Lambert_93", 2154),
        ("RD_New", 28992),
        ("Amersfoort_RD_New", 28992),
        ("Belge_Lambert_2008", 3812),
        ("CH1903+_LV95", 2056),
        ("S-JTSK_Krovak_East_North", 5514),
        ("ETRS_1989_LAEA", 3035),
        ("SWEREF99_TM", 3006),
    ];
    if let Some((_, code)) = KNOWN.iter().find(|(known, _)| *known == name) {
        return Some(*code);
    }
    let zone = |start: &str| -> Option<(u32, char)> {
        let zone = name.strip_prefix(start)?;
        let half = zone.chars().next_back()?;
        let number = zone.strip_suffix(half)?.parse().ok()?;
        (1..=60).contains(&number).then_some((number, half))
    };
    match (zone("WGS_1984_UTM_Zone_"), zone("ETRS_1989_UTM_Zone_"), zone("NAD_1983_UTM_Zone_")) {
        (Some((zone, 'N')), ..) => Some(32600 + zone),
        (Some((zone, 'S')), ..) => Some(32700 + zone),
        (_, Some((zone @ 28..=38, 'N')), _) => Some(25800 + zone),
        (.., Some((zone @ 1..=23, 'N'))) => Some(26900 + zone),
        _ => None,
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
}
