//! Polygons with fewer corners, on a grid, within an error [DP73].
//!
//! # Contract
//! The boundary that is left and the one that was given are within the error of one another, in both
//! directions. There are as many polygons and rings as before, and they bound a domain that needs no
//! repairs; if that cannot be had with the error or a part of it there is no result.
//! O(n log n) for n corners as a rule, O(n²) at worst.
//!
//! # Method
//! Each ring is cut at its first corner and at the one farthest from it; both chains are simplified after
//! Douglas and Peucker, and corners are rounded to the grid.
//!
//! The corners of a chain that are dropped are within the tolerance of the chord that replaces it, and so
//! is all of the chain, as the distance from a chord is convex. The nearest points on the chord move from
//! one of its ends to the other as one goes along the chain, so each point of the chord has one of the
//! chain within the tolerance. Rounding moves each chord by no more than its ends.

use super::rebuild::Corners;
use crate::domain::{Domain, Options, Repair};
use crate::geom::Point;

/// How far the grid moves corners at most, as a share of the error.
///
/// Size only. A finer grid takes more bits for each corner, a coarser one leaves more corners.
const GRID_SHARE: f64 = 0.2;

/// How often half of the error is tried, where rings collapse, touch or cross with all of it.
const MOST_HALVINGS: i32 = 5;

/// Steps of the grid that a coordinate may have at most.
const MOST_STEPS: f64 = (1_u64 << 40) as f64;

impl Corners {
    /// The corners that are left of these polygons if their boundary may move by `max_error`, in units of
    /// the input, or the next smaller number of single precision.
    ///
    /// Where what is left would bound no domain as it is, or have fewer rings, less of the error is used.
    /// Returns `None` if that does not help, or if the error is too small for a grid.
    ///
    /// ```
    /// use medial::axis::Engine;
    /// use medial::geom::Point;
    /// use medial::ops::Corners;
    ///
    /// let ring = [(0., 0.), (3., 0.1), (6., 0.), (6., 2.), (0., 2.)].map(|(x, y)| Point::new(x, y));
    /// let polygons = vec![vec![ring.to_vec()]];
    /// let corners = Corners { engine: Engine::PathTracing, regroup: false, error: 0.0, polygons };
    /// let left = corners.simplified(0.5).ok_or("no domain")?;
    /// assert_eq!((left.polygons[0][0].len(), left.error), (4, 0.5));
    /// # Ok::<(), &str>(())
    /// ```
    #[must_use]
    pub fn simplified(&self, max_error: f64) -> Option<Self> {
        (0..MOST_HALVINGS)
            .map(|k| max_error * 0.5_f64.powi(k))
            .find_map(|error| self.simplified_by(single(error)))
    }

    /// The same for just this error.
    fn simplified_by(&self, max_error: f64) -> Option<Self> {
        let points = self.polygons.iter().flatten().flatten();
        let size = points.map(|p| p.x.abs().max(p.y.abs())).fold(0.0, f64::max);
        let step =
            2.0_f64.powi((std::f64::consts::SQRT_2 * GRID_SHARE * max_error).log2().floor() as i32);
        if !(0.0..f64::INFINITY).contains(&max_error) || step == 0.0 || size / step > MOST_STEPS {
            return None;
        }
        // Half a diagonal of the grid, and what rounding adds to distances.
        let tolerance = max_error - std::f64::consts::FRAC_1_SQRT_2 * step - super::ROUNDING * size;
        let on_grid =
            |p: Point| Point::new((p.x / step).round() * step, (p.y / step).round() * step);
        let ring = |ring: &Vec<Point>| {
            let mut left: Vec<Point> =
                simplified(ring, tolerance).into_iter().map(on_grid).collect();
            left.dedup();
            while left.len() > 1 && left.first() == left.last() {
                left.pop();
            }
            (left.len() > 2).then_some(left)
        };
        let polygon = |rings: &Vec<Vec<Point>>| rings.iter().map(ring).collect::<Option<Vec<_>>>();
        let polygons = self.polygons.iter().map(polygon).collect::<Option<Vec<_>>>()?;
        let options = Options { strict: true, regroup: self.regroup, ..Options::default() };
        let domain = Domain::from_polygons(&polygons, &options).ok()?;
        let harmless = |repair| {
            matches!(repair, Repair::StraightCorner | Repair::Reversed | Repair::Regrouped)
        };
        let is_sound = domain.report().entries().iter().all(|entry| harmless(entry.repair));
        let Self { engine, regroup, error, .. } = *self;
        is_sound.then_some(Self { engine, regroup, error: error + max_error, polygons })
    }
}

/// The largest number of single precision that is no more, so that files keep it in few bytes.
fn single(error: f64) -> f64 {
    let near = error as f32;
    f64::from(if f64::from(near) > error { near.next_down() } else { near })
}

/// The corners of a ring that Douglas and Peucker leave; closed or not, the result is not.
fn simplified(ring: &[Point], tolerance: f64) -> Vec<Point> {
    let ring = match ring {
        [first, .., last] if first == last => &ring[..ring.len() - 1],
        ring => ring,
    };
    let Some(&first) = ring.first() else { return Vec::new() };
    let far = |k: &usize| (ring[*k] - first).norm2();
    let far = (0..ring.len()).max_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(0);
    let n = ring.len();
    let mut kept = vec![false; n + 1];
    (kept[0], kept[far]) = (true, true);
    let at = |k: usize| ring[if k < n { k } else { 0 }];
    let mut chains = vec![(0, far), (far, n)];
    while let Some((a, b)) = chains.pop() {
        let away = |k: usize| from_chord(at(k), at(a), at(b));
        let most = (a + 1..b).map(|k| (away(k), k)).max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((_, k)) = most.filter(|&(away, _)| away > tolerance) {
            kept[k] = true;
            chains.extend([(a, k), (k, b)]);
        }
    }
    (0..n).filter(|&k| kept[k]).map(at).collect()
}

/// The distance of a point from a chord.
fn from_chord(p: Point, a: Point, b: Point) -> f64 {
    let along = b - a;
    let share = along.dot(p - a) / along.norm2();
    // A chord of no length is a point.
    let share = if share.is_nan() { 0.0 } else { share.clamp(0.0, 1.0) };
    (p - (a + along * share)).norm()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::axis::Engine;

    fn left(ring: &[(f64, f64)], tolerance: f64) -> usize {
        let ring: Vec<Point> = ring.iter().map(|&(x, y)| Point::new(x, y)).collect();
        simplified(&ring, tolerance).len()
    }

    #[test]
    fn corners_near_a_chord_go() {
        let ring =
            [(0.0, 0.0), (1.0, 0.1), (2.0, 0.0), (2.0, 2.0), (1.0, 2.3), (0.0, 2.0), (0.0, 0.0)];
        assert_eq!((left(&ring, 0.05), left(&ring, 0.2), left(&ring, 0.4)), (6, 5, 4));
        assert_eq!((left(&ring, 9.0), left(&[], 1.0), left(&ring[..1], 1.0)), (2, 0, 1));
    }

    #[test]
    fn what_would_collapse_or_cross_is_kept() {
        let ring =
            |ring: &[(f64, f64)]| ring.iter().map(|&(x, y)| Point::new(x, y)).collect::<Vec<_>>();
        let corners = |rings: &[&[(f64, f64)]]| {
            let polygons = vec![rings.iter().map(|r| ring(r)).collect()];
            Corners { engine: Engine::PathTracing, regroup: false, error: 0.0, polygons }
        };
        let square: &[(f64, f64)] = &[(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)];
        assert!(corners(&[square]).simplified(1.0).is_some());
        assert!(corners(&[square]).simplified_by(20.0).is_none());
        assert_eq!(corners(&[square]).simplified(20.0).map(|left| left.error), Some(5.0));
        // A hole under a bulge of the boundary.
        let bulge: &[(f64, f64)] = &[(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (4.5, 10.0), (0.0, 9.0)];
        let hole: &[(f64, f64)] = &[(4.0, 8.0), (4.0, 9.5), (5.0, 9.5), (5.0, 8.0)];
        assert!(corners(&[bulge, hole]).simplified(0.1).is_some());
        assert!(corners(&[bulge, hole]).simplified_by(1.4).is_none());
        for error in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-14] {
            assert!(corners(&[square]).simplified(error).is_none(), "{error}");
        }
    }
}
