use super::tree::{FAN, Tree};
use crate::domain::unit::unit_vector;
use crate::geom::{Point, Rect};

/// A box in any direction around a run of edges: all of them have coordinates from `mid - half` to
/// `mid + half` along and, to the left, across it, seen from the origin.
#[derive(Clone, Copy)]
pub(super) struct Strip {
    /// A vertex, so that nothing is lost in large coordinates.
    origin: Point,
    /// Unit vector, as rounded.
    along: Point,
    mid: Point,
    half: Point,
}

/// Bound on the rounding of a coordinate along or across a strip, as a share of all that is added
/// up on the way: less than twenty roundings, among them those of the unit vectors.
const SLACK: f64 = 32.0 * f64::EPSILON;

impl Strip {
    /// A strip around the edges of a leaf, along the longest.
    fn around(tree: &Tree, leaf: usize) -> Option<Self> {
        let mut edges = [(Point::default(), Point::default()); FAN];
        let mut len = 0;
        while len < FAN && leaf * FAN + len < tree.rings.points.len() {
            edges[len] = tree.ends(tree.locate(leaf, len));
            len += 1;
        }
        let edges = &edges[..len];
        let length2 = |&(a, b): &(Point, Point)| (b - a).norm2();
        let (mut longest, mut most) = (edges.first()?, 0.0);
        for edge in edges {
            let length2 = length2(edge);
            if length2 > most {
                (longest, most) = (edge, length2);
            }
        }
        let &(origin, end) = longest;
        let (along, _) = unit_vector(origin, end);
        let range = edges.iter().flat_map(|&(a, b)| [a, b]).fold(Rect::EMPTY, |range, p| {
            let offset = p - origin;
            range.with(Point::new(along.dot(offset), along.cross(offset)))
        });
        Some(Self::within(origin, along, range))
    }

    fn within(origin: Point, along: Point, range: Rect) -> Self {
        let (mid, half) = ((range.min + range.max) * 0.5, (range.max - range.min) * 0.5);
        let slack = SLACK * (mid.x.abs() + mid.y.abs() + half.x + half.y);
        Self { origin, along, mid, half: half + Point::new(slack, slack) }
    }

    /// A strip around strips, along the longest of them.
    fn cover(strips: &[Self]) -> Option<Self> {
        let longest = strips.iter().max_by(|a, b| a.half.x.total_cmp(&b.half.x))?;
        let (origin, along) = (longest.origin, longest.along);
        let range = strips.iter().fold(Rect::EMPTY, |range, strip| {
            let (mid, half, slack) = longest.see(strip);
            let half = half + Point::new(slack, slack);
            let mid = mid + longest.mid;
            range.with(mid - half).with(mid + half)
        });
        Some(Self::within(origin, along, range))
    }

    /// The range of coordinates of another strip, from the middle of this one, and their error.
    #[inline]
    fn see(&self, other: &Self) -> (Point, Point, f64) {
        let offset = other.origin - self.origin;
        let cos = self.along.dot(other.along);
        let sin = self.along.cross(other.along);
        let mid = Point::new(
            self.along.dot(offset) + cos * other.mid.x - sin * other.mid.y - self.mid.x,
            self.along.cross(offset) + sin * other.mid.x + cos * other.mid.y - self.mid.y,
        );
        let half = Point::new(
            cos.abs() * other.half.x + sin.abs() * other.half.y,
            sin.abs() * other.half.x + cos.abs() * other.half.y,
        );
        let size = |p: Point| p.x.abs() + p.y.abs();
        let all = size(offset) + size(self.mid) + size(other.mid) + size(other.half);
        (mid, half, SLACK * all)
    }

    /// Whether one of the four directions of two strips separates them for certain.
    #[inline]
    pub(super) fn misses(&self, other: &Self) -> bool {
        let beyond = |one: &Self, other: &Self| {
            let (mid, half, slack) = one.see(other);
            mid.x.abs() > one.half.x + half.x + slack || mid.y.abs() > one.half.y + half.y + slack
        };
        beyond(self, other) || beyond(other, self)
    }
}

/// The vertices of eight consecutive edges, in an order that processors like.
pub(super) struct Lines {
    x: [f64; FAN + 2],
    y: [f64; FAN + 2],
}

/// Share of its terms that an orientation must exceed: its rounding is at most 3 · 2^-53 of them,
/// and the rest covers the second order.
const TURN_ERROR: f64 = 4.0 * f64::EPSILON / 2.0;

impl Lines {
    #[inline]
    pub(super) fn new(points: &[Point; FAN + 1]) -> Self {
        let at = |k: usize| points[k.min(FAN)];
        Self { x: std::array::from_fn(|k| at(k).x), y: std::array::from_fn(|k| at(k).y) }
    }

    pub(super) fn edge(&self, k: usize) -> (Point, Point) {
        (Point::new(self.x[k], self.y[k]), Point::new(self.x[k + 1], self.y[k + 1]))
    }

    /// The edges that may reach into a strip, one bit each.
    #[inline]
    pub(super) fn within_reach(&self, strip: &Strip) -> u32 {
        let mut sides = [0; 4];
        let fixed = SLACK * (strip.mid.x.abs() + strip.mid.y.abs());
        for k in 0..=FAN {
            let (dx, dy) = (self.x[k] - strip.origin.x, self.y[k] - strip.origin.y);
            let x = strip.along.x * dx + strip.along.y * dy - strip.mid.x;
            let y = strip.along.x * dy - strip.along.y * dx - strip.mid.y;
            let slack = SLACK * (dx.abs() + dy.abs()) + fixed;
            let (half_x, half_y) = (strip.half.x + slack, strip.half.y + slack);
            sides[0] |= u32::from(x < -half_x) << k;
            sides[1] |= u32::from(x > half_x) << k;
            sides[2] |= u32::from(y < -half_y) << k;
            sides[3] |= u32::from(y > half_y) << k;
        }
        // Both ends of an edge beyond one side.
        let beyond = sides.into_iter().fold(0, |all, side| all | side & side >> 1);
        !beyond & 0xff
    }

    /// The edges that lie on one side of the line of an edge for certain, one bit each.
    #[inline]
    pub(super) fn one_side(&self, (a, b): (Point, Point)) -> u32 {
        let along = b - a;
        let (mut left, mut right) = (0, 0);
        for k in 0..=FAN {
            let up = along.x * (self.y[k] - a.y);
            let down = along.y * (self.x[k] - a.x);
            let (turn, bound) = (up - down, TURN_ERROR * (up.abs() + down.abs()));
            left |= u32::from(turn > bound) << k;
            right |= u32::from(-turn > bound) << k;
        }
        (left & left >> 1 | right & right >> 1) & 0xff
    }
}

/// Strips around all nodes of a tree, in the order of its nodes.
pub(super) fn strips(tree: &Tree) -> Vec<Strip> {
    let mut strips: Vec<Strip> = Vec::with_capacity(tree.nodes.len());
    strips.extend((0..tree.n_leaves()).filter_map(|leaf| Strip::around(tree, leaf)));
    let mut first = 0;
    while strips.len() - first > 1 {
        let last = strips.len();
        for start in (first..last).step_by(FAN) {
            let cover = Strip::cover(&strips[start..(start + FAN).min(last)]);
            strips.extend(cover);
        }
        first = last;
    }
    strips
}
