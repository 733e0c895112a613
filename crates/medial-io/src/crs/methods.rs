//! Methods of map projections and their parameters, by their names in EPSG's data set and in the
//! dialects of well-known text of version 1.

/// What a parameter is measured in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Measure {
    Angle,
    Length,
    Scale,
}

/// A parameter by its number at EPSG.
pub(super) struct Parameter {
    pub code: u32,
    pub name: &'static str,
    pub measure: Measure,
    /// Its names in version 1, in small letters; the first one is written.
    pub first: &'static [&'static str],
}

/// A method of projection.
pub(super) struct Method {
    /// Its number at EPSG, 0 without one.
    pub code: u32,
    pub name: &'static str,
    /// Its name in version 1, as GDAL has it.
    pub first: &'static str,
    /// Its names in the version 1 of ESRI, if they are others.
    pub esri: &'static [&'static str],
    /// Numbers of its parameters.
    pub parameters: &'static [u32],
}

/// The method with a name in version 1, of either dialect.
pub(super) fn of_first(name: &str) -> Option<&'static Method> {
    let is_name = |known: &&str| known.eq_ignore_ascii_case(name);
    METHODS
        .iter()
        .find(|method| is_name(&method.first))
        .or_else(|| METHODS.iter().find(|method| method.esri.iter().any(is_name)))
}

/// The method with a number at EPSG.
pub(super) fn of_code(code: u32) -> Option<&'static Method> {
    METHODS.iter().find(|method| method.code == code && code > 0)
}

/// The method with a name as EPSG has it, but for letter case and what is no letter.
pub(super) fn of_name(name: &str) -> Option<&'static Method> {
    METHODS.iter().find(|method| plain(method.name) == plain(name))
}

/// The parameter with a number at EPSG.
pub(super) fn parameter(code: u32) -> Option<&'static Parameter> {
    PARAMETERS.iter().find(|parameter| parameter.code == code)
}

/// The parameter with a name as EPSG has it, but for letter case and what is no letter.
pub(super) fn parameter_of_name(name: &str) -> Option<&'static Parameter> {
    PARAMETERS.iter().find(|parameter| plain(parameter.name) == plain(name))
}

impl Method {
    /// The name of a parameter in version 1: methods around a centre have names of their own.
    pub fn first_name(&self, parameter: &Parameter) -> &'static str {
        /// Lambert's azimuthal, both azimuthal equidistant, Albers and the equidistant conic.
        const CENTRED: [u32; 5] = [9820, 1125, 9832, 9822, 1119];
        let is_centred = CENTRED.contains(&self.code);
        parameter.first[usize::from(is_centred && parameter.first.len() > 1)]
    }
}

fn plain(name: &str) -> String {
    name.chars().filter(char::is_ascii_alphanumeric).map(|c| c.to_ascii_lowercase()).collect()
}

const fn angle(code: u32, name: &'static str, first: &'static [&'static str]) -> Parameter {
    Parameter { code, name, measure: Measure::Angle, first }
}

const fn length(code: u32, name: &'static str, first: &'static [&'static str]) -> Parameter {
    Parameter { code, name, measure: Measure::Length, first }
}

const fn scale(code: u32, name: &'static str) -> Parameter {
    Parameter { code, name, measure: Measure::Scale, first: &["scale_factor"] }
}

const EASTING: &[&str] = &["false_easting"];
const NORTHING: &[&str] = &["false_northing"];
const LATITUDE: &[&str] = &["latitude_of_origin", "latitude_of_center", "latitude_of_centre"];
const LONGITUDE: &[&str] =
    &["central_meridian", "longitude_of_center", "longitude_of_centre", "longitude_of_origin"];
const CENTRE_LATITUDE: &[&str] =
    &["latitude_of_center", "latitude_of_center", "latitude_of_centre", "latitude_of_origin"];
const CENTRE_LONGITUDE: &[&str] =
    &["longitude_of_center", "longitude_of_center", "longitude_of_centre", "central_meridian"];

const PARAMETERS: [Parameter; 23] = [
    angle(8801, "Latitude of natural origin", LATITUDE),
    angle(8802, "Longitude of natural origin", LONGITUDE),
    scale(8805, "Scale factor at natural origin"),
    length(8806, "False easting", EASTING),
    length(8807, "False northing", NORTHING),
    angle(8811, "Latitude of projection centre", CENTRE_LATITUDE),
    angle(8812, "Longitude of projection centre", CENTRE_LONGITUDE),
    angle(8813, "Azimuth at projection centre", &["azimuth"]),
    angle(
        8814,
        "Angle from Rectified to Skew Grid",
        &["rectified_grid_angle", "xy_plane_rotation"],
    ),
    scale(8815, "Scale factor at projection centre"),
    length(8816, "Easting at projection centre", EASTING),
    length(8817, "Northing at projection centre", NORTHING),
    angle(8818, "Latitude of pseudo standard parallel", &["pseudo_standard_parallel_1"]),
    scale(8819, "Scale factor on pseudo standard parallel"),
    angle(8821, "Latitude of false origin", LATITUDE),
    angle(8822, "Longitude of false origin", LONGITUDE),
    angle(8823, "Latitude of 1st standard parallel", &["standard_parallel_1"]),
    angle(8824, "Latitude of 2nd standard parallel", &["standard_parallel_2"]),
    length(8826, "Easting at false origin", EASTING),
    length(8827, "Northing at false origin", NORTHING),
    angle(8832, "Latitude of standard parallel", &["latitude_of_origin", "standard_parallel_1"]),
    angle(8833, "Longitude of origin", LONGITUDE),
    angle(1036, "Co-latitude of cone axis", &["azimuth"]),
];

const fn method(
    code: u32,
    name: &'static str,
    first: &'static str,
    esri: &'static [&'static str],
    parameters: &'static [u32],
) -> Method {
    Method { code, name, first, esri, parameters }
}

/// One with a scale at its origin, one without, and one with a meridian only.
const SCALED: &[u32] = &[8801, 8802, 8805, 8806, 8807];
const UNSCALED: &[u32] = &[8801, 8802, 8806, 8807];
const OF_MERIDIAN: &[u32] = &[8802, 8806, 8807];
/// Conics with two standard parallels.
const CONIC: &[u32] = &[8821, 8822, 8823, 8824, 8826, 8827];
const KROVAK: &[u32] = &[8811, 8833, 1036, 8818, 8819, 8806, 8807];

#[rustfmt::skip]
const METHODS: [Method; 41] = [
    method(9807, "Transverse Mercator", "Transverse_Mercator", &["Gauss_Kruger"], SCALED),
    method(9808, "Transverse Mercator (South Orientated)", "Transverse_Mercator_South_Orientated", &[], SCALED),
    method(9801, "Lambert Conic Conformal (1SP)", "Lambert_Conformal_Conic_1SP", &[], SCALED),
    method(9802, "Lambert Conic Conformal (2SP)", "Lambert_Conformal_Conic_2SP", &[], CONIC),
    method(9803, "Lambert Conic Conformal (2SP Belgium)", "Lambert_Conformal_Conic_2SP_Belgium", &[], CONIC),
    method(9804, "Mercator (variant A)", "Mercator_1SP", &["Mercator_Variant_A"], SCALED),
    method(9805, "Mercator (variant B)", "Mercator_2SP", &["Mercator"], &[8823, 8802, 8806, 8807]),
    method(1024, "Popular Visualisation Pseudo Mercator", "Popular_Visualisation_Pseudo_Mercator", &["Mercator_Auxiliary_Sphere"], UNSCALED),
    method(9810, "Polar Stereographic (variant A)", "Polar_Stereographic", &["Polar_Stereographic_Variant_A"], SCALED),
    method(9829, "Polar Stereographic (variant B)", "Polar_Stereographic", &["Stereographic_North_Pole", "Stereographic_South_Pole", "Polar_Stereographic_Variant_B"], &[8832, 8833, 8806, 8807]),
    method(9809, "Oblique Stereographic", "Oblique_Stereographic", &["Double_Stereographic"], SCALED),
    method(0, "Stereographic", "Stereographic", &[], SCALED),
    method(9812, "Hotine Oblique Mercator (variant A)", "Hotine_Oblique_Mercator", &["Hotine_Oblique_Mercator_Azimuth_Natural_Origin", "Rectified_Skew_Orthomorphic_Natural_Origin"], &[8811, 8812, 8813, 8814, 8815, 8806, 8807]),
    method(9815, "Hotine Oblique Mercator (variant B)", "Hotine_Oblique_Mercator_Azimuth_Center", &["Rectified_Skew_Orthomorphic_Center"], &[8811, 8812, 8813, 8814, 8815, 8816, 8817]),
    method(9813, "Laborde Oblique Mercator", "Laborde_Oblique_Mercator", &[], &[8811, 8812, 8813, 8815, 8806, 8807]),
    method(9819, "Krovak", "Krovak", &[], KROVAK),
    method(1041, "Krovak (North Orientated)", "Krovak", &[], KROVAK),
    method(9806, "Cassini-Soldner", "Cassini_Soldner", &["Cassini"], UNSCALED),
    method(9820, "Lambert Azimuthal Equal Area", "Lambert_Azimuthal_Equal_Area", &[], UNSCALED),
    method(9822, "Albers Equal Area", "Albers_Conic_Equal_Area", &["Albers"], CONIC),
    method(9835, "Lambert Cylindrical Equal Area", "Cylindrical_Equal_Area", &[], &[8823, 8802, 8806, 8807]),
    method(1028, "Equidistant Cylindrical", "Equirectangular", &["Equidistant_Cylindrical", "Plate_Carree"], &[8823, 8801, 8802, 8806, 8807]),
    method(9818, "American Polyconic", "Polyconic", &[], UNSCALED),
    method(9811, "New Zealand Map Grid", "New_Zealand_Map_Grid", &[], UNSCALED),
    method(9816, "Tunisia Mining Grid", "Tunisia_Mining_Grid", &[], &[8821, 8822, 8826, 8827]),
    method(1125, "Azimuthal Equidistant", "Azimuthal_Equidistant", &[], UNSCALED),
    method(9832, "Modified Azimuthal Equidistant", "Azimuthal_Equidistant", &[], UNSCALED),
    method(9840, "Orthographic", "Orthographic", &[], UNSCALED),
    method(1119, "Equidistant Conic", "Equidistant_Conic", &[], CONIC),
    method(1078, "Equal Earth", "Equal_Earth", &[], OF_MERIDIAN),
    method(0, "Gnomonic", "Gnomonic", &[], UNSCALED),
    method(0, "Sinusoidal", "Sinusoidal", &[], OF_MERIDIAN),
    method(0, "Robinson", "Robinson", &[], OF_MERIDIAN),
    method(0, "Mollweide", "Mollweide", &[], OF_MERIDIAN),
    method(0, "Miller Cylindrical", "Miller_Cylindrical", &[], OF_MERIDIAN),
    method(0, "Van Der Grinten", "VanDerGrinten", &["Van_der_Grinten_I"], OF_MERIDIAN),
    method(0, "Goode Homolosine", "Goode_Homolosine", &[], OF_MERIDIAN),
    method(0, "Natural Earth", "Natural_Earth", &[], OF_MERIDIAN),
    method(0, "Eckert IV", "Eckert_IV", &[], OF_MERIDIAN),
    method(0, "Eckert VI", "Eckert_VI", &[], OF_MERIDIAN),
    method(0, "Gall Stereographic", "Gall_Stereographic", &[], OF_MERIDIAN),
];
