use super::node::FAN;
use super::tree::Tree;
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
    /// Sum of the sizes of `mid` and `half`.
    size: f64,
}

/// Bound on the rounding of a coordinate along or across a strip, as a share of all that is added
/// up on the way: less than twenty roundings, among them those of the unit vectors.
const SLACK: f64 = 32.0 * f64::EPSILON;

impl Strip {
    /// A strip around the edges of a leaf, along the longest.
    fn around(tree: &Tree, leaf: usize) -> Option<Self> {
        if let Some(points) = tree.chain(leaf) {
            let lines = Lines::new(&points);
            let longest = lines.longest();
            return Some(Self::along(lines.edge(longest), |frame| lines.range(frame)));
        }
        let edges: Vec<_> = tree.items(leaf).map(|item| tree.ends(item)).collect();
        let length2 = |&(a, b): &(Point, Point)| (b - a).norm2();
        let longest = edges.iter().max_by(|e, f| length2(e).total_cmp(&length2(f)))?;
        Some(Self::along(*longest, |frame| {
            edges.iter().flat_map(|&(a, b)| [a, b]).fold(Rect::EMPTY, |range, p| {
                let offset = p - frame.0;
                range.with(Point::new(frame.1.dot(offset), frame.1.cross(offset)))
            })
        }))
    }

    /// A strip along an edge, given the range of coordinates seen from its start and direction.
    fn along(edge: (Point, Point), range: impl Fn((Point, Point)) -> Rect) -> Self {
        let (along, _) = unit_vector(edge.0, edge.1);
        Self::within(edge.0, along, range((edge.0, along)))
    }

    fn within(origin: Point, along: Point, range: Rect) -> Self {
        let (mid, half) = ((range.min + range.max) * 0.5, (range.max - range.min) * 0.5);
        let half = half + Point::new(1.0, 1.0) * (SLACK * (norm1(mid) + norm1(half)));
        Self { origin, along, mid, half, size: norm1(mid) + norm1(half) }
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
        (mid, half, SLACK * (norm1(offset) + self.size + other.size))
    }

    /// Whether one of the four directions of two strips separates them for certain.
    #[inline]
    pub(super) fn misses(&self, other: &Self) -> bool {
        let (a, b) = (self, other);
        let offset = b.origin - a.origin;
        let (cos, sin) = (a.along.dot(b.along), a.along.cross(b.along));
        let slack = SLACK * (norm1(offset) + a.size + b.size);
        let apart = |mid: f64, near: f64, far: f64| mid.abs() > near + far + slack;
        // Across them first: strips are long.
        let spread = |half: Point| sin.abs() * half.x + cos.abs() * half.y;
        if apart(
            a.along.cross(offset) + sin * b.mid.x + cos * b.mid.y - a.mid.y,
            a.half.y,
            spread(b.half),
        ) || apart(
            b.along.cross(offset) + sin * a.mid.x - cos * a.mid.y + b.mid.y,
            b.half.y,
            spread(a.half),
        ) {
            return true;
        }
        let spread = |half: Point| cos.abs() * half.x + sin.abs() * half.y;
        apart(
            a.along.dot(offset) + cos * b.mid.x - sin * b.mid.y - a.mid.x,
            a.half.x,
            spread(b.half),
        ) || apart(
            b.along.dot(offset) - cos * a.mid.x - sin * a.mid.y + b.mid.x,
            b.half.x,
            spread(a.half),
        )
    }
}

fn norm1(p: Point) -> f64 {
    p.x.abs() + p.y.abs()
}

/// The vertices of eight consecutive edges in columns, the last one twice: processors like that.
pub(super) struct Lines {
    x: Column,
    y: Column,
}

type Column = [f64; FAN + 2];

/// As [`Powers`](super::node::Powers), for lanes as wide as doubles.
pub(super) type WidePowers = [u64; FAN];

/// Share of its terms that an orientation must exceed: its rounding is at most 3 · 2^-53 of them,
/// and the rest covers the second order, and the comparison.
const TURN_ERROR: f64 = 8.0 * f64::EPSILON / 2.0;

impl Lines {
    #[inline]
    pub(super) fn new(points: &[Point; FAN + 1]) -> Self {
        let at = |k: usize| points[if k > FAN { FAN } else { k }];
        Self { x: std::array::from_fn(|k| at(k).x), y: std::array::from_fn(|k| at(k).y) }
    }

    #[inline]
    pub(super) fn edge(&self, k: usize) -> (Point, Point) {
        (Point::new(self.x[k], self.y[k]), Point::new(self.x[k + 1], self.y[k + 1]))
    }

    fn longest(&self) -> usize {
        let length2: [f64; FAN] = std::array::from_fn(|k| {
            let (x, y) = (self.x[k + 1] - self.x[k], self.y[k + 1] - self.y[k]);
            x * x + y * y
        });
        (0..FAN).fold(0, |best, k| if length2[k] > length2[best] { k } else { best })
    }

    /// Coordinates along and across a direction, from an origin, and the sum of all differences.
    #[inline]
    fn seen_from(&self, origin: Point, along: Point) -> (Column, Column, f64) {
        let dx = self.x.map(|x| x - origin.x);
        let dy = self.y.map(|y| y - origin.y);
        let x = std::array::from_fn(|k| along.x * dx[k] + along.y * dy[k]);
        let y = std::array::from_fn(|k| along.x * dy[k] - along.y * dx[k]);
        let sizes: Column = std::array::from_fn(|k| dx[k].abs() + dy[k].abs());
        (x, y, sum(&sizes))
    }

    fn range(&self, (origin, along): (Point, Point)) -> Rect {
        let (x, y, _) = self.seen_from(origin, along);
        let least = |list: &Column| list.iter().copied().fold(f64::INFINITY, lesser);
        let most = |list: &Column| list.iter().copied().fold(f64::NEG_INFINITY, larger);
        Rect { min: Point::new(least(&x), least(&y)), max: Point::new(most(&x), most(&y)) }
    }

    /// The edges that may reach into a strip, one bit each.
    #[inline]
    pub(super) fn within_reach(&self, strip: &Strip, powers: &WidePowers) -> u32 {
        let (x, y, size) = self.seen_from(strip.origin, strip.along);
        let slack = SLACK * (size + strip.mid.x.abs() + strip.mid.y.abs());
        let half = strip.half + Point::new(slack, slack);
        let (low, high) = (strip.mid - half, strip.mid + half);
        // Both ends beyond one side.
        marked(powers, |k| {
            (lesser(x[k], x[k + 1]) <= high.x)
                & (larger(x[k], x[k + 1]) >= low.x)
                & (lesser(y[k], y[k + 1]) <= high.y)
                & (larger(y[k], y[k + 1]) >= low.y)
        })
    }

    /// The edges that may have places on both sides of the line of an edge, or on it, one bit each.
    #[inline]
    pub(super) fn across(&self, (a, b): (Point, Point), powers: &WidePowers) -> u32 {
        let along = b - a;
        let up = self.y.map(|y| along.x * (y - a.y));
        let down = self.x.map(|x| along.y * (x - a.x));
        let bound: Column = std::array::from_fn(|k| TURN_ERROR * (up[k].abs() + down[k].abs()));
        let low: Column = std::array::from_fn(|k| up[k] - down[k] - bound[k]);
        let high: Column = std::array::from_fn(|k| up[k] - down[k] + bound[k]);
        marked(powers, |k| {
            (lesser(low[k], low[k + 1]) <= 0.0) & (larger(high[k], high[k + 1]) >= 0.0)
        })
    }
}

#[inline]
fn marked(powers: &WidePowers, is_marked: impl Fn(usize) -> bool) -> u32 {
    let lanes: [u64; FAN] = std::array::from_fn(|k| if is_marked(k) { powers[k] } else { 0 });
    lanes.into_iter().fold(0, |all, lane| all | lane) as u32
}

#[inline]
fn sum(list: &Column) -> f64 {
    let pairs: [f64; 2] = std::array::from_fn(|k| {
        (list[k] + list[k + 2]) + (list[k + 4] + list[k + 6]) + list[k + 8]
    });
    pairs[0] + pairs[1]
}

// Comparisons that are one instruction each; there is no NaN.
#[inline]
fn lesser(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

#[inline]
fn larger(a: f64, b: f64) -> f64 {
    if b > a { b } else { a }
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
