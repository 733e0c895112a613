use super::tree::{Chain, FAN, Tree};
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
    fn around(chain: &Chain) -> Self {
        let length2 = |k: usize| {
            let (a, b) = chain.edge(k);
            (b - a).norm2()
        };
        let longest = (0..chain.len).max_by(|&j, &k| length2(j).total_cmp(&length2(k)));
        let (origin, end) = chain.edge(longest.unwrap_or(0));
        let (along, _) = unit_vector(origin, end);
        let range = chain.points().iter().fold(Rect::EMPTY, |range, &p| {
            let offset = p - origin;
            range.with(Point::new(along.dot(offset), along.cross(offset)))
        });
        Self::within(origin, along, range)
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

    /// Beyond which sides of the strip a point lies for certain, one bit each.
    #[inline]
    pub(super) fn code(&self, p: Point) -> u8 {
        let offset = p - self.origin;
        let x = self.along.dot(offset) - self.mid.x;
        let y = self.along.cross(offset) - self.mid.y;
        let size = offset.x.abs() + offset.y.abs() + self.mid.x.abs() + self.mid.y.abs();
        let half = self.half + Point::new(SLACK * size, SLACK * size);
        u8::from(x < -half.x)
            | u8::from(x > half.x) << 1
            | u8::from(y < -half.y) << 2
            | u8::from(y > half.y) << 3
    }
}

/// Strips around all nodes of a tree, in the order of its boxes.
pub(super) fn strips(tree: &Tree) -> Vec<Strip> {
    let mut strips: Vec<Strip> = Vec::with_capacity(tree.boxes.len());
    strips.extend((0..tree.leaves.len()).map(|leaf| Strip::around(&tree.chain(leaf))));
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
