//! How far two boundaries are from one another.
//!
//! # Contract
//! The Hausdorff distance of two sets of segments, within a tolerance: no point of one is farther from the
//! other than is told, and some point is as far but for the tolerance.
//!
//! # Method
//! Each segment is halved until no point between two can matter: the distance changes by no more than a
//! point is moved, and to one segment it is convex, so that it is largest at an end where both ends are
//! nearest to the same segment.

use std::ops::Range;

use super::outline::foot_on;
use crate::geom::{BoundsTree, Point, Rect, Visitor};

/// The Hausdorff distance between the boundaries of two lists of rings, in units of the input, too large by
/// the tolerance at most; infinite if one of them is empty.
///
/// ```
/// use medial::geom::Point;
/// use medial::ops::boundary_distance;
///
/// let square = |side: f64| [(0., 0.), (side, 0.), (side, side), (0., side)].map(|(x, y)| Point::new(x, y));
/// let distance = boundary_distance(&[square(4.0).to_vec()], &[square(5.0).to_vec()], 1e-9);
/// assert!((distance - 2.0_f64.sqrt()).abs() <= 1e-9);
/// ```
#[must_use]
pub fn boundary_distance(one: &[Vec<Point>], other: &[Vec<Point>], tolerance: f64) -> f64 {
    let (one, other) = (Segments::of(one), Segments::of(other));
    if one.ends.is_empty() || other.ends.is_empty() {
        return f64::INFINITY;
    }
    let (far, bound) = one.farthest_from(&other, 0.0, tolerance);
    bound.max(other.farthest_from(&one, far, tolerance).1)
}

/// Segments, with a tree over them.
struct Segments {
    ends: Vec<(Point, Point)>,
    tree: BoundsTree,
}

impl Segments {
    fn of(rings: &[Vec<Point>]) -> Self {
        let next = |ring: &Vec<Point>, k: usize| ring[if k + 1 < ring.len() { k + 1 } else { 0 }];
        let ends: Vec<(Point, Point)> = rings
            .iter()
            .flat_map(|ring| (0..ring.len()).map(move |k| (ring[k], next(ring, k))))
            .collect();
        let bounds = |k: u32| {
            let (a, b) = ends[k as usize];
            Rect::EMPTY.with(a).with(b)
        };
        let tree = BoundsTree::new(0, ends.len() as u32, bounds);
        Self { ends, tree }
    }

    /// The nearest segment to a point, looked for from one that may be near.
    fn nearest(&self, p: Point, near: u32) -> (f64, u32) {
        let mut nearest = Nearest { segments: self, p, distance: f64::INFINITY, segment: near };
        nearest.item(near);
        self.tree.visit(&mut nearest);
        (nearest.distance, nearest.segment)
    }

    /// The largest distance of a point from others that was found, or `least` if that is more, and a bound
    /// of all distances.
    fn farthest_from(&self, others: &Self, least: f64, tolerance: f64) -> (f64, f64) {
        let mut far = least;
        let mut near = 0;
        let mut open = Vec::new();
        for &(a, b) in &self.ends {
            let start = others.nearest(a, near);
            let end = others.nearest(b, start.1);
            near = end.1;
            far = far.max(start.0).max(end.0);
            open.push((a, start, b, end));
        }
        let mut bound = far;
        while let Some((a, start, b, end)) = open.pop() {
            // From one segment no point between is farther than the farther end.
            let from_one = |k: u32| others.distance(a, k).max(others.distance(b, k));
            let convex = from_one(start.1).min(from_one(end.1));
            if convex <= start.0.max(end.0) {
                continue;
            }
            let most = convex.min(0.5 * (start.0 + end.0 + (b - a).norm()));
            let middle = a + (b - a) * 0.5;
            if most <= far + tolerance || middle == a || middle == b {
                bound = bound.max(most);
                continue;
            }
            let half = others.nearest(middle, start.1);
            far = far.max(half.0);
            open.push((a, start, middle, half));
            open.push((middle, half, b, end));
        }
        (far, bound.max(far))
    }

    /// The distance of a point from one segment.
    fn distance(&self, p: Point, segment: u32) -> f64 {
        let (a, b) = self.ends[segment as usize];
        if p == a || p == b {
            return 0.0;
        }
        // Ends are met exactly.
        (p - foot_on(a, b, p)).norm()
    }
}

/// Looks for the nearest segment.
struct Nearest<'a> {
    segments: &'a Segments,
    p: Point,
    distance: f64,
    segment: u32,
}

impl Visitor for Nearest<'_> {
    fn enters(&self, bounds: &Rect, _: Range<u32>) -> bool {
        bounds.distance2(self.p) < self.distance * self.distance
    }

    fn item(&mut self, segment: u32) {
        let distance = self.segments.distance(self.p, segment);
        if distance < self.distance {
            (self.distance, self.segment) = (distance, segment);
        }
    }
}
