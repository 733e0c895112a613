//! Boxes in single precision, eight to a node.

use crate::geom::{Point, Rect};

/// Children of a node, and items of a leaf.
pub(super) const FAN: usize = 8;

/// Boxes of the children of one node, or of the edges of a leaf, in the coordinates of a [`Map`].
///
/// No bound is infinite or -0, so that differences have the signs that comparisons tell.
#[derive(Clone, Copy)]
pub(super) struct Node {
    min_x: [f32; FAN],
    min_y: [f32; FAN],
    max_x: [f32; FAN],
    max_y: [f32; FAN],
}

/// A box in the coordinates of a [`Map`]; no bound is infinite or -0.
#[derive(Clone, Copy)]
pub(super) struct Bounds {
    pub(super) min: [f32; 2],
    pub(super) max: [f32; 2],
}

impl Bounds {
    pub(super) const EMPTY: Self = Self { min: [f32::MAX; 2], max: [f32::MIN; 2] };

    pub(super) fn of([a, b]: [f32; 2], [c, d]: [f32; 2]) -> Self {
        Self { min: [lesser(a, c), lesser(b, d)], max: [larger(a, c), larger(b, d)] }
    }
}

impl Node {
    pub(super) const EMPTY: Self = Self {
        min_x: [f32::MAX; FAN],
        min_y: [f32::MAX; FAN],
        max_x: [f32::MIN; FAN],
        max_y: [f32::MIN; FAN],
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
        let least = |list: &[f32; FAN]| list.iter().fold(f32::MAX, |a, &b| lesser(a, b));
        let largest = |list: &[f32; FAN]| list.iter().fold(f32::MIN, |a, &b| larger(a, b));
        Bounds {
            min: [least(&self.min_x), least(&self.min_y)],
            max: [largest(&self.max_x), largest(&self.max_y)],
        }
    }

    /// The children whose closed boxes share a point with a box, one bit each.
    #[inline]
    pub(super) fn meets(&self, b: &Bounds, powers: &Powers) -> u32 {
        let mut apart = *powers;
        for (k, lane) in apart.iter_mut().enumerate() {
            // Signs, not comparisons: compilers make branches of those, which nobody foresees.
            let gaps = (b.max[0] - self.min_x[k]).to_bits()
                | (self.max_x[k] - b.min[0]).to_bits()
                | (b.max[1] - self.min_y[k]).to_bits()
                | (self.max_y[k] - b.min[1]).to_bits();
            *lane &= (gaps.cast_signed() >> 31).cast_unsigned();
        }
        apart.into_iter().fold(ALL, |set, lane| set & !lane)
    }
}

/// All children of a node, one bit each.
pub(super) const ALL: u32 = (1 << FAN) - 1;

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
        // Adding zero turns -0 into 0.
        ((x - self.origin.x) * self.scale) as f32 + 0.0
    }

    #[inline]
    pub(super) fn y(&self, y: f64) -> f32 {
        ((y - self.origin.y) * self.scale) as f32 + 0.0
    }

    #[inline]
    pub(super) fn point(&self, p: Point) -> [f32; 2] {
        [self.x(p.x), self.y(p.y)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_meet_if_they_share_a_point_even_where_single_precision_vanishes() {
        // On both sides of the origin, closer to it than the least number of 32 bits.
        let ends = [Point::new(-1.0, -1.0), Point::new(1.0, 1.0)];
        let speck = [Point::new(-1e-50, 0.0), Point::new(1e-50, 0.0)];
        let map = Map::new(&ends);
        let bounds = |[a, b]: [Point; 2]| Bounds::of(map.point(a), map.point(b));
        let boxes = [
            bounds([ends[0], speck[0]]),
            bounds([speck[1], ends[1]]),
            bounds([Point::new(0.5, -1.0), Point::new(1.0, -0.5)]),
            bounds([Point::new(0.5, -0.5), Point::new(1.0, 0.0)]),
            bounds([Point::new(0.5, 0.1), Point::new(1.0, 0.2)]),
        ];
        let mut node = Node::EMPTY;
        for (k, &b) in boxes.iter().enumerate() {
            node.set(k, b);
        }
        let powers = std::array::from_fn(|k| 1 << k);
        // All else are lanes without a box, which meet nothing.
        assert_eq!(
            boxes.map(|b| node.meets(&b, &powers)),
            [0b11, 0b11011, 0b1100, 0b1110, 0b10010]
        );
        let all = Bounds { min: [-1.0, f32::MIN], max: [1.0; 2] };
        assert_eq!(node.meets(&all, &powers), 0b11111);
    }
}
