//! Ties among axis-parallel edges and corners in whole numbers, decided without building anything.
//!
//! Most ties that are no accident are of this kind. [`Dyadic`](super::dyadic::Dyadic) answers all of
//! these and many more, but is made to be kept; this is made anew for each question.

use std::cmp::Ordering;

use super::Element;
use super::counts::count;
use super::grid::Integers;
use crate::geom::{Point, TouchingDisk, U};

/// Eighths, in binary digits.
const DIGITS: u32 = 3;

/// Bits of a coordinate, in units.
const BITS: u32 = 37;

/// Witness that all points at hand have whole numbers of moderate size for coordinates.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Whole(());

impl Whole {
    /// The witness for some points.
    pub(crate) fn all(mut points: impl Iterator<Item = Point>) -> Option<Self> {
        // A conversion saturates, at numbers that are too large.
        let is_whole = |value: f64| {
            let whole = value as i64;
            whole as f64 == value && whole.unsigned_abs() < 1 << BITS
        };
        points.all(|p| is_whole(p.x) && is_whole(p.y)).then_some(Self(()))
    }

    /// A point in eighths.
    #[inline]
    fn place(self, p: Point) -> Integers {
        Integers { x: (p.x as i64) << DIGITS, y: (p.y as i64) << DIGITS }
    }
}

/// A disk whose centre is a whole number of eighths, with its squared radius.
///
/// Coordinates are below 2^40 in eighths, ways to the centre below 2^43, and products of two below 2^87.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Eighths {
    whole: Whole,
    centre: Integers,
    square: i128,
}

impl Eighths {
    /// The disk touching three elements that is known in doubles, if it is such a disk; its origin is one
    /// of the points.
    #[inline]
    pub(crate) fn new(whole: Whole, [a, b, c]: [Element; 3], disk: &TouchingDisk) -> Option<Self> {
        const EIGHTH: f64 = 1.0 / (1_u32 << DIGITS) as f64;
        const WORD: f64 = (1_u128 << u64::BITS) as f64;
        let TouchingDisk { origin, centre, radius, bound } = *disk;
        // Thus at most one such centre is within the bound.
        if bound.is_nan() || bound > EIGHTH / 4.0 {
            return None;
        }
        let nearest = |value: f64| {
            let multiple = (value / EIGHTH + 0.5f64.copysign(value)) as i64;
            let is_near = (multiple as f64 * EIGHTH - value).abs() <= bound + U * value.abs();
            (is_near && multiple.unsigned_abs() < 2 << (BITS + DIGITS)).then_some(multiple)
        };
        let origin = whole.place(origin);
        let (x, y) = (origin.x + nearest(centre.x)?, origin.y + nearest(centre.y)?);
        let mut disk = Self { whole, centre: Integers { x, y }, square: 0 };
        disk.square = disk.distance2(a)?;
        // Words are converted much faster than pairs of them.
        let high = (disk.square >> u64::BITS) as i64;
        let size = high as f64 * WORD + disk.square as u64 as f64;
        let is_near = (size.sqrt() * EIGHTH - radius).abs() <= bound + 8.0 * U * radius;
        let touches = |element| disk.distance2(element) == Some(disk.square);
        (is_near && disk.square > 0 && touches(b) && touches(c)).then_some(disk)
    }

    #[inline]
    fn way(&self, from: Point) -> Integers {
        self.centre.minus(self.whole.place(from))
    }

    /// The signed distance from the line of an axis-parallel edge.
    #[inline]
    fn across(&self, a: Point, b: Point) -> Option<i64> {
        let way = self.way(a);
        if a.y == b.y {
            Some(if a.x < b.x { way.y } else { -way.y })
        } else if a.x == b.x {
            Some(if a.y < b.y { -way.x } else { way.x })
        } else {
            None
        }
    }

    /// The squared distance from an element, if that is not behind.
    #[inline]
    fn distance2(&self, element: Element) -> Option<i128> {
        match element {
            Element::Corner(p) => {
                let way = self.way(p);
                Some(way.dot(way))
            }
            Element::Edge(a, b) => {
                let across = self.across(a, b).filter(|&across| across >= 0)?;
                Some(i128::from(across) * i128::from(across))
            }
        }
    }

    /// The order of the distance of a corner against the radius.
    pub(crate) fn side(&self, p: Point) -> Ordering {
        let way = self.way(p);
        told(way.dot(way).cmp(&self.square))
    }

    /// On which side of an axis-parallel edge the centre lies, `Greater` in front of it, and the order of
    /// the distance of its line against the radius.
    pub(crate) fn side_of_edge(&self, a: Point, b: Point) -> Option<(Ordering, Ordering)> {
        let across = i128::from(self.across(a, b)?);
        Some((told(across.cmp(&0)), (across * across).cmp(&self.square)))
    }

    /// The sign of `(b - a)·(c - p)`.
    pub(crate) fn along(&self, a: Point, b: Point, p: Point) -> Ordering {
        let direction = self.whole.place(b).minus(self.whole.place(a));
        told(direction.dot(self.way(p)).cmp(&0))
    }

    /// The sign of `(b - a)·(c - c')` for the centre `c'` of another disk, or of `(b - a)×(c - c')`.
    pub(crate) fn compare(&self, other: &Self, (a, b): (Point, Point), across: bool) -> Ordering {
        let direction = self.whole.place(b).minus(self.whole.place(a));
        let way = self.centre.minus(other.centre);
        let product = if across { direction.cross(way) } else { direction.dot(way) };
        told(product.cmp(&0))
    }
}

/// Notes an answer.
#[inline]
fn told(answer: Ordering) -> Ordering {
    count(|counts| counts.dyadic += 1);
    answer
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::predicates::ExactDisk;

    #[test]
    fn they_answer_as_the_exact_disk_does() {
        let p = |x: i32, y: i32| Point::new(f64::from(x), f64::from(y));
        let edge = |a: (i32, i32), b: (i32, i32)| Element::Edge(p(a.0, a.1), p(b.0, b.1));
        let (up, down) = (edge((0, 0), (8, 0)), edge((8, 6), (0, 6)));
        let (left, right) = (edge((0, 6), (0, 0)), edge((7, 0), (7, 6)));
        let corner = |x, y| Element::Corner(p(x, y));
        let triples = [
            [up, down, left],
            [up, right, left],
            [up, corner(5, 5), left],
            [up, right, corner(1, 2)],
            [up, corner(3, 4), corner(1, 4)],
            [corner(0, 0), corner(6, 0), corner(6, 4)],
        ];
        assert!(Whole::all([Point::new(0.5, 0.0)].into_iter()).is_none());
        let whole = Whole::all([p(0, 0), p(8, 8)].into_iter()).unwrap();
        let mut disks = Vec::new();
        for elements in triples {
            let exact = ExactDisk::new(elements).unwrap();
            if let Some(disk) = Eighths::new(whole, elements, &exact.rounded()) {
                disks.push((disk, exact));
            }
        }
        assert!(disks.len() >= 4, "{}", disks.len());
        let mut n_ties = 0;
        for (x, y) in (-1..10).flat_map(|x| (-1..8).map(move |y| (x, y))) {
            let (q, a) = (p(x, y), p(2, 3));
            for (disk, exact) in &disks {
                let side = exact.side(Element::Corner(q));
                n_ties += u32::from(side.is_eq());
                assert_eq!(disk.side(q), side);
                for b in [p(2, 5), p(2, 1), p(9, 3), p(1, 3)] {
                    let d = b - a;
                    assert_eq!(disk.along(a, b, q), exact.along(a, b, q));
                    let front = exact.front(q, q + d);
                    let (from, to) = if front.is_lt() { (q + d, q) } else { (q, q + d) };
                    let size = exact.side(Element::Edge(from, to));
                    assert_eq!(disk.side_of_edge(q, q + d), Some((front, size)));
                }
                for (other, exact_other) in &disks {
                    let along = exact.compare_along(exact_other, a, q);
                    assert_eq!(disk.compare(other, (a, q), false), along);
                    let across = exact.compare_across(exact_other, a, q);
                    assert_eq!(disk.compare(other, (a, q), true), across);
                }
            }
        }
        assert!(n_ties > 0);
    }
}
