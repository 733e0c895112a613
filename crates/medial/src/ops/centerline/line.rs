use crate::axis::Curve;
use crate::geom::Point;

/// A line through an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Centerline {
    /// The curves it consists of, each starting where the one before ends.
    pub curves: Vec<Curve>,
    /// The points before its start and after its end up to which it goes on straight, each with its
    /// distance from the boundary; 0 on the boundary and outside.
    pub extensions: [Option<(Point, f64)>; 2],
    /// Whether there is no better line for sure, of what the lines before left; else it was only not
    /// found, or not looked for, because of cycles.
    pub is_best: bool,
    /// Whether it starts, or ends, where the axis does, and not on another line or a cycle.
    pub is_free: [bool; 2],
}

/// The width of a shape along a line: twice the distance of the boundary, in units of the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Widths {
    /// The least.
    pub least: f64,
    /// The greatest.
    pub greatest: f64,
    /// The mean along the length.
    pub mean: f64,
}

impl Centerline {
    /// Whether it ends where it starts, and not just where two ends of the axis share a corner in which
    /// boundaries touch.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        let ends = self.curves.first().map(Curve::from).zip(self.curves.last().map(Curve::to));
        self.is_free == [false; 2] && ends.is_some_and(|(from, to)| from == to)
    }

    /// Its length inside the axis and, if it goes on straight, beyond.
    #[must_use]
    pub fn length(&self) -> f64 {
        let inside: f64 = self.curves.iter().map(Curve::length).sum();
        let ends = [self.curves.first().map(Curve::from), self.curves.last().map(Curve::to)];
        let beyond = self.extensions.iter().zip(ends);
        inside + beyond.map(|(p, q)| p.zip(q).map_or(0.0, |(p, q)| (p.0 - q).norm())).sum::<f64>()
    }

    /// Its points and the distance of the boundary there, no farther than a tolerance from the curves, in
    /// units of the input.
    #[must_use]
    pub fn polyline(&self, tolerance: f64) -> Vec<(Point, f64)> {
        let mut points: Vec<(Point, f64)> = Vec::new();
        points.extend(self.extensions[0]);
        for (k, curve) in self.curves.iter().enumerate() {
            points.extend(curve.polyline(tolerance).into_iter().skip(usize::from(k > 0)));
        }
        points.extend(self.extensions[1]);
        points
    }

    /// The widths inside the axis.
    #[must_use]
    pub fn widths(&self) -> Widths {
        Widths::along(&self.curves)
    }
}

impl Widths {
    /// Those along some curves.
    pub(in crate::ops) fn along(curves: &[Curve]) -> Self {
        let least = curves.iter().map(Curve::radius_min).fold(f64::INFINITY, f64::min);
        let greatest = curves.iter().map(Curve::radius_max).fold(0.0, f64::max);
        let (mut sum, mut length) = (0.0, 0.0);
        for curve in curves {
            sum += curve.length() * curve.radius_mean();
            length += curve.length();
        }
        let mean = if length > 0.0 { (sum / length).clamp(least, greatest) } else { greatest };
        Self { least: 2.0 * least, greatest: 2.0 * greatest, mean: 2.0 * mean }
    }
}
