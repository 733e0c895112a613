//! Boxes in single precision, eight to a node.

use crate::geom::{Point, Rect};

/// Children of a node, and items of a leaf.
pub(super) const FAN: usize = 8;

/// Boxes of the children of one node, or of the edges of a leaf, in the coordinates of a [`Map`].
#[derive(Clone, Copy)]
pub(super) struct Node {
    min_x: [f32; FAN],
    min_y: [f32; FAN],
    max_x: [f32; FAN],
    max_y: [f32; FAN],
}

/// A box in the coordinates of a [`Map`].
#[derive(Clone, Copy)]
pub(super) struct Bounds {
    pub(super) min: [f32; 2],
    pub(super) max: [f32; 2],
}

impl Bounds {
    pub(super) const EMPTY: Self = Self { min: [f32::INFINITY; 2], max: [f32::NEG_INFINITY; 2] };

    pub(super) fn of([a, b]: [f32; 2], [c, d]: [f32; 2]) -> Self {
        Self { min: [lesser(a, c), lesser(b, d)], max: [larger(a, c), larger(b, d)] }
    }
}

impl Node {
    pub(super) const EMPTY: Self = Self {
        min_x: [f32::INFINITY; FAN],
        min_y: [f32::INFINITY; FAN],
        max_x: [f32::NEG_INFINITY; FAN],
        max_y: [f32::NEG_INFINITY; FAN],
    };

    /// The boxes of eight consecutive edges.
    #[inline]
    pub(super) fn of_run(map: &Map, run: &[Point; FAN + 1]) -> Self {
        let (x, y) = (run.map(|p| map.x(p.x)), run.map(|p| map.y(p.y)));
        let of = |choose: fn(f32, f32) -> f32, list: &[f32; FAN + 1]| {
            std::array::from_fn(|k| choose(list[k], list[k + 1]))
        };
        Self {
            min_x: of(lesser, &x),
            min_y: of(lesser, &y),
            max_x: of(larger, &x),
            max_y: of(larger, &y),
        }
    }

    #[inline]
    pub(super) fn child(&self, k: usize) -> Bounds {
        Bounds { min: [self.min_x[k], self.min_y[k]], max: [self.max_x[k], self.max_y[k]] }
    }

    pub(super) fn set(&mut self, k: usize, b: Bounds) {
        [self.min_x[k], self.min_y[k]] = b.min;
        [self.max_x[k], self.max_y[k]] = b.max;
    }

    pub(super) fn cover(&self) -> Bounds {
        let least = |list: &[f32; FAN]| list.iter().fold(f32::INFINITY, |a, &b| lesser(a, b));
        let largest = |list: &[f32; FAN]| list.iter().fold(f32::NEG_INFINITY, |a, &b| larger(a, b));
        Bounds {
            min: [least(&self.min_x), least(&self.min_y)],
            max: [largest(&self.max_x), largest(&self.max_y)],
        }
    }

    /// The children whose closed boxes share a point with a box, one bit each.
    #[inline]
    pub(super) fn meets(&self, b: &Bounds, powers: &Powers) -> u32 {
        let lanes: [u32; FAN] = std::array::from_fn(|k| {
            let meets = (self.min_x[k] <= b.max[0])
                & (b.min[0] <= self.max_x[k])
                & (self.min_y[k] <= b.max[1])
                & (b.min[1] <= self.max_y[k]);
            if meets { powers[k] } else { 0 }
        });
        lanes.into_iter().fold(0, |all, lane| all | lane)
    }
}

/// 1, 2, 4 to 128: compilers keep to vector instructions if they are read from memory.
pub(super) type Powers = [u32; FAN];

// Comparisons that are one instruction each; there is no NaN.
#[inline]
fn lesser(a: f32, b: f32) -> f32 {
    if b < a { b } else { a }
}

#[inline]
fn larger(a: f32, b: f32) -> f32 {
    if b > a { b } else { a }
}

/// A map to small coordinates of single precision.
///
/// It never turns the order of two coordinates round, rounding included. So boxes that share a
/// point have images that share one: nothing is missed.
#[derive(Clone, Copy)]
pub(super) struct Map {
    origin: Point,
    scale: f64,
}

impl Map {
    pub(super) fn new(points: &[Point]) -> Self {
        let (mut min, mut max) = (Rect::EMPTY.min, Rect::EMPTY.max);
        for p in points {
            min.x = if p.x < min.x { p.x } else { min.x };
            min.y = if p.y < min.y { p.y } else { min.y };
            max.x = if p.x > max.x { p.x } else { max.x };
            max.y = if p.y > max.y { p.y } else { max.y };
        }
        let scale = 1.0 / (max.x - min.x).max(max.y - min.y);
        Self { origin: (min + max) * 0.5, scale }
    }

    #[inline]
    pub(super) fn x(&self, x: f64) -> f32 {
        ((x - self.origin.x) * self.scale) as f32
    }

    #[inline]
    pub(super) fn y(&self, y: f64) -> f32 {
        ((y - self.origin.y) * self.scale) as f32
    }

    #[inline]
    pub(super) fn point(&self, p: Point) -> [f32; 2] {
        [self.x(p.x), self.y(p.y)]
    }
}
