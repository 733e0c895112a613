//! Degrees of longitude and latitude as metres, one feature at a time.

use crate::args::Common;
use crate::failure::Failure;
use crate::report::Entry;
use medial::geom::Point;
use medial_io::{Crs, Feature, geojson};

/// Metres of a degree along the equator of the WGS 84 ellipsoid.
const DEGREE: f64 = 6_378_137.0 * std::f64::consts::PI / 180.0;

/// How many metres a degree of longitude and one of latitude have, by the cosine of the latitude.
#[derive(Clone, Copy, Debug)]
pub struct Metric {
    x: f64,
    y: f64,
}

impl Metric {
    /// Fails if an option is asked for along with metres that takes coordinates itself.
    pub fn refuse(common: &Common, option: &str) -> Result<(), Failure> {
        if common.metric {
            let why = format!(
                "--metric does not go with {option}, whose coordinates are those of the file"
            );
            return Err(Failure::Usage(why));
        }
        Ok(())
    }

    /// Fails if coordinates in this reference system are known to be no degrees.
    pub fn check(crs: Option<&Crs>, input: &str) -> Result<(), Failure> {
        let Some(crs) = crs.filter(|crs| crs.is_defined()) else { return Ok(()) };
        let why = match crs.angular_unit() {
            Some((_, 1.0)) => return Ok(()),
            Some((unit, _)) => format!("{unit}s; project them, or make degrees of them, first"),
            None => "no longitudes and latitudes; measure without --metric".to_owned(),
        };
        let why = format!("--metric is for degrees; the coordinates of {input} ({crs}) are {why}");
        Err(Failure::Usage(why))
    }

    /// The scale in the middle of the box of a feature, whose coordinates become metres.
    pub fn of(feature: &mut Feature) -> Result<Self, Entry> {
        let points = || feature.polygons.iter().flatten().flatten().filter(|p| p.y.is_finite());
        let low = points().map(|p| p.y).fold(f64::INFINITY, f64::min);
        let high = points().map(|p| p.y).fold(f64::NEG_INFINITY, f64::max);
        let middle = if low <= high { 0.5 * (low + high) } else { 0.0 };
        if middle.abs() >= 90.0 {
            let why = format!("is at latitude {middle}; --metric is for degrees between the poles");
            return Err(Entry::refused("latitude", why));
        }
        // Nothing else has them.
        feature.curves = None;
        let metric = Self { x: DEGREE * middle.to_radians().cos(), y: DEGREE };
        for point in feature.polygons.iter_mut().flatten().flatten() {
            *point = Point::new(point.x * metric.x, point.y * metric.y);
        }
        Ok(metric)
    }

    /// Makes degrees of the coordinates of GeoJSON features, behind a place in these bytes.
    pub fn restore(&self, bytes: &mut Vec<u8>, from: usize) -> Result<(), Entry> {
        let written = geojson::moved(&bytes[from..], |[x, y]| [x / self.x, y / self.y])
            .map_err(|error| Entry::internal(&error))?;
        bytes.truncate(from);
        bytes.extend(written);
        Ok(())
    }
}
