//! Whether two descriptions can be of one reference system.

use super::wkt::{ellipsoid, unit};
use super::{Crs, projjson};
use serde_json::Value;

/// How much numbers may differ that are the same, relatively: texts are written with 12 digits or more, and
/// angles are converted.
const SAME: f64 = 1e-8;

/// Whether nothing that a text says speaks against a known system: the unit, the ellipsoid, the method of
/// projection and its parameters. What is not said speaks against nothing.
pub(super) fn agree(wkt: &str, known: &Crs) -> bool {
    let known = known.projjson().and_then(|text| serde_json::from_str(&text).ok());
    let (Some(said), Some(known)) = (projjson::of_text(wkt, None), known) else { return true };
    let (said, known) = (unbound(&said), unbound(&known));
    said["type"] == known["type"]
        && both(unit_of(said), unit_of(known), same)
        && both(half_axes(said), half_axes(known), |a, b| same(a.0, b.0) && same(a.1, b.1))
        && agree_methods(&said["conversion"], &known["conversion"])
}

fn both<T>(a: Option<T>, b: Option<T>, are_same: impl Fn(T, T) -> bool) -> bool {
    match (a, b) {
        (Some(a), Some(b)) => are_same(a, b),
        _ => true,
    }
}

fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= SAME * a.abs().max(b.abs()).max(SAME)
}

/// The system itself, of one that is bound to WGS 84.
fn unbound(system: &Value) -> &Value {
    if system["type"] == "BoundCRS" { &system["source_crs"] } else { system }
}

/// How many metres or radians the unit of the first axis has.
fn unit_of(system: &Value) -> Option<f64> {
    unit(&system["coordinate_system"]["axis"][0]["unit"]).map(|(.., factor)| factor)
}

/// The longer half axis of the ellipsoid and its inverse flattening.
fn half_axes(system: &Value) -> Option<(f64, f64)> {
    let base = if system["base_crs"].is_object() { &system["base_crs"] } else { system };
    let datum = ["datum", "datum_ensemble"].map(|name| &base[name]);
    let (axis, of_axis, flattening) =
        ellipsoid(&datum.into_iter().find(|datum| datum.is_object())?["ellipsoid"])?;
    Some((axis * unit(&of_axis)?.2, flattening))
}

fn agree_methods(said: &Value, known: &Value) -> bool {
    let code = |of: &Value| of["id"]["code"].as_u64();
    let method = |of: &Value| code(&of["method"]);
    if !both(method(said), method(known), |a, b| a == b) {
        return false;
    }
    // A name that no method has is another one.
    if method(said).is_none() && said.is_object() {
        return method(known).is_none();
    }
    let parameters = |of: &Value| of["parameters"].as_array().cloned().unwrap_or_default();
    let value = |of: &Value| Some(of["value"].as_f64()? * unit(&of["unit"])?.2);
    let known = parameters(known);
    parameters(said).iter().all(|said| {
        let other = known.iter().find(|known| code(known).is_some() && code(known) == code(said));
        other.is_none_or(|known| both(value(said), value(known), same))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn geographic(name: &str, ellipsoid: &str) -> String {
        format!(
            "GEOGCS[\"{name}\",DATUM[\"d\",SPHEROID[\"s\",{ellipsoid}]],PRIMEM[\"Greenwich\",0.0],\
             UNIT[\"Degree\",0.0174532925199433]]"
        )
    }

    #[test]
    fn names_of_esri_agree_with_what_their_files_say() {
        for (code, name, ellipsoid, method, parameters) in [
            (
                3857,
                "WGS_1984_Web_Mercator_Auxiliary_Sphere",
                "6378137.0,298.257223563",
                "Mercator_Auxiliary_Sphere",
                "False_Easting=0.0 False_Northing=0.0 Central_Meridian=0.0 Standard_Parallel_1=0.0 Auxiliary_Sphere_Type=0.0",
            ),
            (
                2193,
                "NZGD_2000_New_Zealand_Transverse_Mercator",
                "6378137.0,298.257222101",
                "Transverse_Mercator",
                "False_Easting=1600000.0 False_Northing=10000000.0 Central_Meridian=173.0 Scale_Factor=0.9996 Latitude_Of_Origin=0.0",
            ),
            (
                27700,
                "British_National_Grid",
                "6377563.396,299.3249646",
                "Transverse_Mercator",
                "False_Easting=400000.0 False_Northing=-100000.0 Central_Meridian=-2.0 Scale_Factor=0.9996012717 Latitude_Of_Origin=49.0",
            ),
            (
                29902,
                "TM65_Irish_Grid",
                "6377340.189,299.3249646",
                "Transverse_Mercator",
                "False_Easting=200000.0 False_Northing=250000.0 Central_Meridian=-8.0 Scale_Factor=1.000035 Latitude_Of_Origin=53.5",
            ),
            (
                2157,
                "IRENET95_Irish_Transverse_Mercator",
                "6378137.0,298.257222101",
                "Transverse_Mercator",
                "False_Easting=600000.0 False_Northing=750000.0 Central_Meridian=-8.0 Scale_Factor=0.99982 Latitude_Of_Origin=53.5",
            ),
            (
                2154,
                "RGF_1993_Lambert_93",
                "6378137.0,298.257222101",
                "Lambert_Conformal_Conic",
                "False_Easting=700000.0 False_Northing=6600000.0 Central_Meridian=3.0 Standard_Parallel_1=49.0 Standard_Parallel_2=44.0 Latitude_Of_Origin=46.5",
            ),
            (
                28992,
                "RD_New",
                "6377397.155,299.1528128",
                "Double_Stereographic",
                "False_Easting=155000.0 False_Northing=463000.0 Central_Meridian=5.38763888888889 Scale_Factor=0.9999079 Latitude_Of_Origin=52.1561605555556",
            ),
            (
                3812,
                "Belge_Lambert_2008",
                "6378137.0,298.257222101",
                "Lambert_Conformal_Conic",
                "False_Easting=649328.0 False_Northing=665262.0 Central_Meridian=4.35921583333333 Standard_Parallel_1=49.8333333333333 Standard_Parallel_2=51.1666666666667 Latitude_Of_Origin=50.797815",
            ),
            (
                2056,
                "CH1903+_LV95",
                "6377397.155,299.1528128",
                "Hotine_Oblique_Mercator_Azimuth_Center",
                "False_Easting=2600000.0 False_Northing=1200000.0 Scale_Factor=1.0 Azimuth=90.0 Longitude_Of_Center=7.43958333333333 Latitude_Of_Center=46.9524055555556",
            ),
            (
                5514,
                "S-JTSK_Krovak_East_North",
                "6377397.155,299.1528128",
                "Krovak",
                "False_Easting=0.0 False_Northing=0.0 Pseudo_Standard_Parallel_1=78.5 Scale_Factor=0.9999 Azimuth=30.28813975277778 Longitude_Of_Center=24.83333333333333 Latitude_Of_Center=49.5 X_Scale=-1.0 Y_Scale=1.0 XY_Plane_Rotation=90.0",
            ),
            (
                3035,
                "ETRS_1989_LAEA",
                "6378137.0,298.257222101",
                "Lambert_Azimuthal_Equal_Area",
                "False_Easting=4321000.0 False_Northing=3210000.0 Central_Meridian=10.0 Latitude_Of_Origin=52.0",
            ),
            (
                3006,
                "SWEREF99_TM",
                "6378137.0,298.257222101",
                "Transverse_Mercator",
                "False_Easting=500000.0 False_Northing=0.0 Central_Meridian=15.0 Scale_Factor=0.9996 Latitude_Of_Origin=0.0",
            ),
            (
                32705,
                "WGS_1984_UTM_Zone_5S",
                "6378137.0,298.257223563",
                "Transverse_Mercator",
                "False_Easting=500000.0 False_Northing=10000000.0 Central_Meridian=-153.0 Scale_Factor=0.9996 Latitude_Of_Origin=0.0",
            ),
            (
                25832,
                "ETRS_1989_UTM_Zone_32N",
                "6378137.0,298.257222101",
                "Transverse_Mercator",
                "False_Easting=500000.0 False_Northing=0.0 Central_Meridian=9.0 Scale_Factor=0.9996 Latitude_Of_Origin=0.0",
            ),
            (
                26910,
                "NAD_1983_UTM_Zone_10N",
                "6378137.0,298.257222101",
                "Transverse_Mercator",
                "False_Easting=500000.0 False_Northing=0.0 Central_Meridian=-123.0 Scale_Factor=0.9996 Latitude_Of_Origin=0.0",
            ),
        ] {
            let mut text = format!("PROJCS[\"{name}\",{}", geographic("g", ellipsoid));
            text += &format!(",PROJECTION[\"{method}\"]");
            for (name, value) in parameters.split(' ').filter_map(|pair| pair.split_once('=')) {
                text += &format!(",PARAMETER[\"{name}\",{value}]");
            }
            assert_eq!(Crs::of_wkt(&(text + ",UNIT[\"Meter\",1.0]]")).epsg_code(), Some(code));
        }
        for (code, name, ellipsoid) in [
            (4326, "GCS_WGS_1984", "6378137.0,298.257223563"),
            (4269, "GCS_North_American_1983", "6378137.0,298.257222101"),
            (4267, "GCS_North_American_1927", "6378206.4,294.978698213898"),
            (4258, "GCS_ETRS_1989", "6378137.0,298.257222101"),
            (4283, "GCS_GDA_1994", "6378137.0,298.257222101"),
            (7844, "GCS_GDA2020", "6378137.0,298.257222101"),
            (4167, "GCS_NZGD_2000", "6378137.0,298.257222101"),
            (6668, "GCS_JGD_2011", "6378137.0,298.257222101"),
        ] {
            assert_eq!(Crs::of_wkt(&geographic(name, ellipsoid)).epsg_code(), Some(code));
        }
    }
}
