//! Bounds of runs of edges by circles, for boundaries that follow the disks inside them.
//!
//! # Contract
//! Whatever is left out is farther from a disk's centre than the radius asked for.
//!
//! # Method
//! For a run seen from any point `o` under directions of a narrow cone, with no part nearer than
//! `least`, the distance from another point `c` is at least `least` less the largest product of `c - o`
//! with a unit vector of the cone. With `o` the middle of the circle through three points of the run
//! this is as sharp as the run is round: segments and boxes of a run on the rim of a disk reach into the
//! disk by far more than the run itself.
//!
//! # Departures
//! None.

use super::{Point, U};

/// Radius of a circle, in lengths of the run, beyond which rounding blurs more than the circle tells.
const FLAT: f64 = (1_u64 << 24) as f64;

/// A run as it is seen from a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Round {
    /// The point.
    from: Point,
    /// No part of the run is nearer; negative where the point tells nothing.
    least: f64,
    /// The middle of the cone, and sine and cosine of half its angle.
    middle: Point,
    sine: f64,
    cosine: f64,
}

impl Round {
    const NONE: Self = Self {
        from: Point::new(0.0, 0.0),
        least: f64::NEG_INFINITY,
        middle: Point::new(0.0, 0.0),
        sine: 0.0,
        cosine: 0.0,
    };

    /// The bound of some edges, each given by its ends.
    pub(super) fn around(edges: impl ExactSizeIterator<Item = (Point, Point)> + Clone) -> Self {
        let n = edges.len();
        let at = |k: usize| edges.clone().nth(k);
        let (Some((p, _)), Some((q, _)), Some((_, s))) =
            (at(0), at(n / 2), at(n.saturating_sub(1)))
        else {
            return Self::NONE;
        };
        let (a, b) = (q - p, s - p);
        let way = Point::circumcentre(a, b);
        let near = way.norm2() <= FLAT * FLAT * (a.norm2() + b.norm2());
        if !near {
            return Self::NONE;
        }
        let from = p + way;
        let middle = q - from;
        let middle = middle * (1.0 / middle.norm());
        let (mut least, mut sine, mut size): (f64, f64, f64) = (f64::INFINITY, 0.0, 0.0);
        for (a, b) in edges {
            // A corner may end an edge and begin none of these.
            let (from_a, from_b) = (a - from, b - from);
            for to in [from_a, from_b] {
                if middle.dot(to).is_nan() || middle.dot(to) <= 0.0 {
                    return Self::NONE;
                }
                let across = middle.cross(to);
                sine = sine.max(across * across / to.norm2());
            }
            size = size.max(b.x.abs() + b.y.abs()).max(a.x.abs() + a.y.abs());
            let d = b - a;
            let share = (-d.dot(from_a) / d.norm2()).clamp(0.0, 1.0);
            let nearest = if share < 1.0 { from_a + d * share } else { from_b };
            least = least.min(nearest.norm2());
        }
        let sine = sine.sqrt() + 32.0 * U;
        let size = size + from.x.abs() + from.y.abs();
        let least = least.sqrt() * (1.0 - 16.0 * U) - 32.0 * U * size;
        if least.is_nan() || sine.is_nan() || sine > 1.0 {
            return Self::NONE;
        }
        Self { from, least, middle, sine, cosine: (1.0 - sine * sine).sqrt() }
    }

    /// Whether all of the run is certainly farther from a point than that.
    #[inline]
    pub(super) fn is_beyond(&self, centre: Point, reach: f64) -> bool {
        let way = centre - self.from;
        let (along, across) = (self.middle.dot(way), self.middle.cross(way).abs());
        // Within the cone the way itself is the largest.
        let within = along > 0.0 && across * self.cosine <= along * self.sine;
        let most = if within { way.norm() } else { self.cosine * along + self.sine * across };
        let size = centre.x.abs() + centre.y.abs() + self.from.x.abs() + self.from.y.abs();
        self.least - most > reach + 16.0 * U * (size + self.least)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edges(corners: &[Point]) -> Vec<(Point, Point)> {
        corners.windows(2).map(|pair| (pair[0], pair[1])).collect()
    }

    fn arc(from: f64, to: f64, n: usize) -> Vec<(Point, Point)> {
        let corner = |k: usize| {
            let (sin, cos) = (from + (to - from) * k as f64 / n as f64).sin_cos();
            Point::new(3.0 + cos, 5.0 + sin)
        };
        edges(&(0..=n).map(corner).collect::<Vec<Point>>())
    }

    #[test]
    fn a_run_on_the_rim_of_a_disk_is_beyond_a_slightly_smaller_one() {
        // 64 edges over an eighth of the circle are nearer by 1 - cos(π/512) at most, 1.9e-5.
        let round = Round::around(arc(0.0, std::f64::consts::FRAC_PI_4, 64).iter().copied());
        let centre = Point::new(3.0, 5.0);
        assert!(round.is_beyond(centre, 1.0 - 1.9e-5));
        assert!(!round.is_beyond(centre, 1.0 - 1.8e-5));
        // Moved away from the run, a larger disk fits; towards it, only a smaller one.
        assert!(round.is_beyond(centre + Point::new(-1e-3, -1e-3), 1.0 + 0.9e-3));
        assert!(!round.is_beyond(centre + Point::new(1e-3, 1e-3), 1.0 - 1e-3));
    }

    #[test]
    fn no_bound_claims_more_than_the_nearest_corner_or_edge() {
        let run = arc(1.0, 2.0, 9);
        let round = Round::around(run.iter().copied());
        for (x, y) in [(3.0, 5.0), (3.1, 5.2), (0.0, 0.0), (2.9, 7.5), (9.0, 4.0)] {
            let c = Point::new(x, y);
            let nearest = run.iter().map(|&(p, _)| (p - c).norm()).fold(f64::INFINITY, f64::min);
            assert!(!round.is_beyond(c, nearest), "{c:?}");
        }
    }

    #[test]
    fn straight_runs_are_left_to_other_bounds() {
        let line: Vec<Point> =
            (0..9).map(|k| Point::new(f64::from(k), 2.0 * f64::from(k))).collect();
        let round = Round::around(edges(&line).into_iter());
        assert!(!round.is_beyond(Point::new(1e9, 0.0), 1.0));
    }
}
