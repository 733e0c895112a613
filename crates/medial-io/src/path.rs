use crate::record::{Record, Shape, Value};
use medial::axis::{Accuracy, Curve, CurveKind, Joining, Keypoint, MedialAxis, Path, Polyline};
use medial::domain::Domain;
use medial::geom::Point;
use medial::ops::{Measure, Significance};
use smallvec::{SmallVec, smallvec};

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
    /// What makes one line; by default paths of an exact axis, and branches of a sampled one.
    pub by: Option<Joining>,
}

/// Tolerance of drawn curves, as a share of the longer side of the box around the feature.
///
/// Drawing only. A tenth of it makes about three times as many points.
pub(crate) const RELATIVE_TOLERANCE: f64 = 1e-4;

/// The tolerance for an axis: 1e-4 of the longer side of its box.
///
/// The box around the governors and the keypoints is the box of the shape, but for exterior axes; there
/// [`domain_tolerance`] is the one to take. Governors of a sampled axis may be no part of the shape, so there it
/// is the box of its disks, too.
#[must_use]
pub fn default_tolerance(axis: &MedialAxis) -> f64 {
    let Some((mut low, mut high)) = axis.bounds() else { return 0.0 };
    if axis.accuracy != Accuracy::Exact {
        for Keypoint { position, radius, .. } in axis.keypoints() {
            let reach = Point::new(radius, radius);
            let (least, greatest) = (position - reach, position + reach);
            low = Point::new(low.x.min(least.x), low.y.min(least.y));
            high = Point::new(high.x.max(greatest.x), high.y.max(greatest.y));
        }
    }
    RELATIVE_TOLERANCE * f64::max(high.x - low.x, high.y - low.y)
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

    /// What makes one line of an axis.
    pub(crate) fn joining(&self, axis: &MedialAxis) -> Joining {
        let usual = match axis.accuracy {
            Accuracy::Exact => Joining::Governors,
            Accuracy::Sampled(_) => Joining::Branches,
        };
        self.by.unwrap_or(usual)
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

/// What the formats say of a path, or of paths that follow one another.
pub(crate) struct PathRecord {
    pub path: Path,
    pub curves: SmallVec<[Curve; 1]>,
    /// The paths, and whether each is passed from its start.
    pub paths: SmallVec<[(u32, bool); 1]>,
    pub ends: [Keypoint; 2],
    /// What kind of curve it is.
    pub kind: CurveKind,
    /// Whether its governors are those of all of it.
    pub is_governed: bool,
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

    /// One path.
    fn of(axis: &MedialAxis, number: u32, path: Path) -> Self {
        let curve = axis.curve(&path);
        Self {
            path,
            curves: smallvec![curve],
            paths: smallvec![(number, true)],
            ends: [path.from, path.to].map(|k| axis.keypoints().at(k)),
            kind: curve.kind(),
            is_governed: true,
        }
    }

    /// Several.
    fn joined(axis: &MedialAxis, line: Polyline) -> Self {
        let Polyline { path, paths, is_governed, .. } = line;
        let curve = |&(number, forwards): &(u32, bool)| {
            let curve = axis.curve(&axis.paths().at(number));
            if forwards { curve } else { curve.reversed() }
        };
        let curves: SmallVec<[Curve; 1]> = paths.iter().map(curve).collect();
        let kind = match (&curves[..], axis.accuracy) {
            ([curve], Accuracy::Exact) => curve.kind(),
            _ => CurveKind::Polyline,
        };
        let ends = [path.from, path.to].map(|k| axis.keypoints().at(k));
        Self { path, curves, paths: paths.into(), ends, kind, is_governed }
    }

    pub fn length(&self) -> f64 {
        self.curves.iter().map(Curve::length).sum()
    }

    pub fn radius_min(&self) -> f64 {
        self.curves.iter().map(Curve::radius_min).fold(f64::INFINITY, f64::min)
    }

    pub fn radius_max(&self) -> f64 {
        self.curves.iter().map(Curve::radius_max).fold(0.0, f64::max)
    }

    /// The governors to the left and right, if they are those of all of it.
    pub fn governors(&self) -> [Option<u32>; 2] {
        [self.path.left, self.path.right].map(|site| self.is_governed.then_some(site))
    }

    /// The points of the line with their radii.
    pub fn points(&self, drawing: Drawing, tolerance: f64) -> Vec<(Point, f64)> {
        let mut points = Vec::new();
        for curve in &self.curves {
            let skip = usize::from(!points.is_empty());
            points.extend(drawing.points(curve, tolerance).into_iter().skip(skip));
        }
        points
    }

    /// The largest value of a measure, that at the start and that at the end.
    pub fn values(&self, measured: &Significance) -> [Option<f64>; 3] {
        let at = |&(path, forwards): &(u32, bool)| {
            let [most, start, end] = measured.paths[path as usize].values();
            if forwards { [most, start, end] } else { [most, end, start] }
        };
        let [mut most, start, mut end] = self.paths.first().map_or([None; 3], at);
        for [other, _, last] in self.paths.iter().skip(1).map(at) {
            // Without a bound on one path there is none on all.
            most = most.zip(other).map(|(a, b)| a.max(b));
            end = last;
        }
        [most, start, end]
    }
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

/// A record for every line of an axis, in the order of paths.
pub(crate) fn records(
    axis: &MedialAxis,
    drawing: Drawing,
) -> Box<dyn Iterator<Item = PathRecord> + '_> {
    match (drawing.joining(axis), axis.accuracy) {
        (Joining::Governors, Accuracy::Exact) => Box::new(
            (0..).zip(axis.paths()).map(|(number, path)| PathRecord::of(axis, number, path)),
        ),
        (joining, _) => {
            let lines = axis.polylines(joining).into_iter();
            Box::new(lines.map(|line| PathRecord::joined(axis, line)))
        }
    }
}

/// What the first values of [`line_records`] are; after them three for each measure, by [`line_columns`].
const LINE_COLUMNS: [&str; 7] =
    ["length", "radius_min", "radius_max", "radius_start", "radius_end", "kind_start", "kind_end"];

/// The names of the values of [`line_records`].
#[must_use]
pub fn line_columns(measures: &[Measure]) -> Vec<String> {
    let of = |&measure: &Measure| measure_columns(&Significance { measure, paths: Vec::new() });
    LINE_COLUMNS.map(str::to_owned).into_iter().chain(measures.iter().flat_map(of)).collect()
}

/// The lines of an axis as records, and keypoints that no path joins as points: with their length, radii and ends, and the
/// measures of each, the largest value and those at the start and the end.
#[must_use]
pub fn line_records(axis: &MedialAxis, measured: &[Significance], drawing: Drawing) -> Vec<Record> {
    let tolerance = drawing.tolerance(axis);
    let line = |line: PathRecord| {
        let radii =
            [line.radius_min(), line.radius_max(), line.ends[0].radius, line.ends[1].radius];
        let numbers = std::iter::once(line.length()).chain(radii).map(Value::from);
        let kinds = line.ends.iter().map(|end| Value::from(end.kind.name()));
        let measures = measured.iter().flat_map(|of| line.values(of));
        let measures = measures.map(|value| value.map_or(Value::None, Value::from));
        let points = line.points(drawing, tolerance);
        let shape = match drawing.radius_as_z {
            true => Shape::LineInSpace(points),
            false => Shape::Line(points.into_iter().map(|(point, _)| point).collect()),
        };
        Record { values: numbers.chain(kinds).chain(measures).collect(), shape }
    };
    let alone = (0..).zip(axis.degrees()).filter(|&(_, degree)| degree == 0);
    let point = |(keypoint, _): (u32, u32)| {
        let Keypoint { position, radius, kind } = axis.keypoints().at(keypoint);
        let shape = match drawing.radius_as_z {
            true => Shape::PointInSpace(position, radius),
            false => Shape::Point(position),
        };
        point_record(radius, kind.name(), measured.len(), shape)
    };
    let lines: Vec<Record> = records(axis, drawing).map(line).collect();
    lines.into_iter().chain(alone.map(point)).collect()
}

/// The same of a point, which has no length and no values of measures.
#[must_use]
pub fn point_record(radius: f64, kind: &str, n_measures: usize, shape: Shape) -> Record {
    let radii = [Value::from(radius), radius.into(), radius.into(), radius.into()];
    let kinds = [Value::from(kind), kind.into()];
    let measures = vec![Value::None; 3 * n_measures];
    let values = std::iter::once(Value::from(0.0)).chain(radii).chain(kinds).chain(measures);
    Record { values: values.collect(), shape }
}

/// The keypoints that are written as points: those where lines end if that is asked for, else what pruning left without
/// a path.
pub(crate) fn written_keypoints(axis: &MedialAxis, drawing: Drawing) -> Vec<u32> {
    if drawing.keypoints {
        return shown_keypoints(axis, drawing);
    }
    if axis.complete {
        return Vec::new();
    }
    let alone = (0..).zip(axis.degrees()).filter(|&(_, degree)| degree == 0);
    alone.map(|(keypoint, _)| keypoint).collect()
}

/// The keypoints that are shown: all, or those where lines end.
pub(crate) fn shown_keypoints(axis: &MedialAxis, drawing: Drawing) -> Vec<u32> {
    let all = 0..axis.keypoints().len() as u32;
    match (drawing.joining(axis), axis.accuracy) {
        (Joining::Governors, Accuracy::Exact) => all.collect(),
        (joining, _) => {
            let mut hidden = vec![false; axis.keypoints().len()];
            for line in axis.polylines(joining) {
                line.between.iter().for_each(|&keypoint| hidden[keypoint as usize] = true);
            }
            all.filter(|&keypoint| !hidden[keypoint as usize]).collect()
        }
    }
}
