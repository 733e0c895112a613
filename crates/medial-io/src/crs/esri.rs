//! Names that ESRI's well-known text has for what others call differently.

/// The name of a datum: ESRI's begin with `D_`, and those of version 1 have no spaces. ESRI's names that
/// are not known here stay as they are, as other programs know them.
pub(super) fn datum(name: &str) -> String {
    const KNOWN: [(&str, &str); 16] = [
        ("WGS_1984", "World Geodetic System 1984"),
        ("WGS_1972", "World Geodetic System 1972"),
        ("ETRS_1989", "European Terrestrial Reference System 1989"),
        ("European_1950", "European Datum 1950"),
        ("OSGB_1936", "Ordnance Survey of Great Britain 1936"),
        ("RGF_1993", "Reseau Geodesique Francais 1993"),
        ("NTF", "Nouvelle Triangulation Francaise"),
        ("GDA_1994", "Geocentric Datum of Australia 1994"),
        ("GDA2020", "Geocentric Datum of Australia 2020"),
        ("NZGD_2000", "New Zealand Geodetic Datum 2000"),
        ("JGD_2011", "Japanese Geodetic Datum 2011"),
        ("JGD_2000", "Japanese Geodetic Datum 2000"),
        ("SIRGAS_2000", "Sistema de Referencia Geocentrico para las AmericaS 2000"),
        ("North_American_1983", "North American Datum 1983"),
        ("North_American_1927", "North American Datum 1927"),
        ("South_American_1969", "South American Datum 1969"),
    ];
    let plain = name.strip_prefix("D_").unwrap_or(name);
    let known = KNOWN.iter().find(|(known, _)| known.eq_ignore_ascii_case(plain));
    match known {
        Some((_, known)) => (*known).to_owned(),
        None if plain.len() < name.len() => name.to_owned(),
        None => name.replace('_', " "),
    }
}

/// The code at EPSG of a name as ESRI writes it, of the most common ones.
pub(super) fn code(name: &str) -> Option<u32> {
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
