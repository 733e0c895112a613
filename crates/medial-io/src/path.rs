use medial::axis::{Curve, CurveKind, Keypoint, MedialAxis, Path};
use medial::domain::Domain;
use medial::geom::Point;
use medial::ops::{Measure, Significance};

/// How axes become lines.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Drawing {
    /// Largest distance between a curve and its polyline; by default [`default_tolerance`].
    pub tolerance: Option<f64>,
    /// Whether the radius is the third coordinate.
    pub radius_as_z: bool,
    /// Whether keypoints are written as points.
    pub keypoints: bool,
    /// Whether the side of the boundary is written (GeoJSON and CSV).
    pub side: bool,
}

/// Tolerance of drawn curves, as a share of the longer side of the box around the feature.
///
/// Drawing only. A tenth of it makes about three times as many points.
pub(crate) const RELATIVE_TOLERANCE: f64 = 1e-4;

/// The tolerance for an axis: 1e-4 of the longer side of its box.
///
/// The box around the governors and the keypoints is the box of the shape, but for exterior axes; there
/// [`domain_tolerance`] is the one to take.
#[must_use]
pub fn default_tolerance(axis: &MedialAxis) -> f64 {
    axis.bounds()
        .map_or(0.0, |(low, high)| RELATIVE_TOLERANCE * f64::max(high.x - low.x, high.y - low.y))
}

/// The tolerance for any axis of a domain: 1e-4 of the longer side of its box.
#[must_use]
pub fn domain_tolerance(domain: &Domain) -> f64 {
    let bounds = domain.bounds();
    let size = bounds.max - bounds.min;
    RELATIVE_TOLERANCE * f64::max(size.x, size.y)
}

impl Drawing {
    /// The tolerance that holds for this axis.
    #[must_use]
    pub fn tolerance(&self, axis: &MedialAxis) -> f64 {
        self.tolerance.unwrap_or_else(|| default_tolerance(axis))
    }

    /// Whether a curve is drawn by its two ends whatever the tolerance.
    pub(crate) fn is_straight(&self, curve: &Curve) -> bool {
        curve.kind() == CurveKind::Line && !self.radius_as_z
    }

    /// The points of a curve with their radii.
    pub(crate) fn points(&self, curve: &Curve, tolerance: f64) -> Vec<(Point, f64)> {
        if self.radius_as_z {
            curve.polyline_in_space(tolerance)
        } else {
            curve.polyline(tolerance)
        }
    }
}

/// What the formats say of a path.
pub(crate) struct PathRecord {
    pub path: Path,
    pub curve: Curve,
    pub ends: [Keypoint; 2],
}

impl PathRecord {
    /// The columns GeoJSON and CSV share, from `curve` to `governor_right`.
    pub const COLUMNS: [&'static str; 10] = [
        "curve",
        "length",
        "radius_min",
        "radius_max",
        "radius_start",
        "radius_end",
        "kind_start",
        "kind_end",
        "governor_left",
        "governor_right",
    ];
}

/// The columns of a measure: the largest value on a path, and those at its start and its end.
pub(crate) fn measure_columns(measured: &Significance) -> [String; 3] {
    let name = match measured.measure {
        // Paths have a length and radii of their own, which come from nothing behind them.
        Measure::Length => "branch_length",
        Measure::Radius => "running_radius",
        measure => measure.name(),
    };
    ["", "_start", "_end"].map(|end| format!("{name}{end}"))
}

/// A record for every path, in their order.
pub(crate) fn records(axis: &MedialAxis) -> impl Iterator<Item = PathRecord> {
    let keypoints = axis.keypoints();
    axis.paths().iter().map(move |path| PathRecord {
        path,
        curve: axis.curve(&path),
        ends: [path.from, path.to].map(|k| keypoints.at(k)),
    })
}
