//! Which of two elements is nearer to a point, and how far apart two elements are.

use std::cmp::Ordering;

use dashu_int::IBig;

use super::Element;
use super::grid::{Grid, finest};
use crate::geom::{Double, Point};

/// Orders the distances of two elements from a point, edges taken as their supporting lines.
///
/// The point is a double as given, no constructed one; exponents of all coordinates are within ±200.
///
/// ```
/// use std::cmp::Ordering;
/// use medial::geom::Point;
/// use medial::geom::predicates::{Element, compare_distances};
/// let (o, p) = (Point::new(0.0, 0.0), Point::new(0.3, 0.4));
/// let floor = Element::Edge(Point::new(-1.0, 0.9), Point::new(1.0, 0.9));
/// // Both are 0.5 in doubles, but the corner is a hair farther.
/// assert_eq!(compare_distances(p, floor, Element::Corner(o)), Ordering::Less);
/// assert_eq!(compare_distances(p, floor, floor), Ordering::Equal);
/// ```
#[must_use]
pub fn compare_distances(p: Point, first: Element, second: Element) -> Ordering {
    if first == second {
        return Ordering::Equal;
    }
    in_pairs(p, first, second).unwrap_or_else(|| in_integers(p, first, second))
}

/// Orders the distance of two elements, edges taken as their supporting lines, against a length; two edges
/// are parallel. The length is not negative, and exponents are within ±200.
///
/// ```
/// use std::cmp::Ordering;
/// use medial::geom::Point;
/// use medial::geom::predicates::{Element, compare_gap};
/// let corner = Element::Corner(Point::new(0.0, 0.0));
/// // The line 3x + 4y = 5 is 1 away.
/// let line = Element::Edge(Point::new(3.0, -1.0), Point::new(-1.0, 2.0));
/// assert_eq!(compare_gap(corner, line, 1.0), Ordering::Equal);
/// assert_eq!(compare_gap(corner, line, 1.0_f64.next_up()), Ordering::Less);
/// ```
#[must_use]
pub fn compare_gap(first: Element, second: Element, length: f64) -> Ordering {
    let (p, other) = match (first, second) {
        (Element::Corner(p) | Element::Edge(p, _), Element::Edge(..)) => (p, second),
        (Element::Edge(..), Element::Corner(p)) => (p, first),
        (Element::Corner(p), Element::Corner(_)) => (p, second),
    };
    if let Some((square, error)) = squared(p, other) {
        let length = Double::from(length);
        let wanted = length * length;
        let difference = (square - wanted).value();
        if difference.abs() > error + PAIRS * wanted.value() {
            return difference.partial_cmp(&0.0).unwrap_or(Ordering::Equal);
        }
    }
    let ends = match other {
        Element::Corner(q) => [q, q],
        Element::Edge(a, b) => [a, b],
    };
    let grid = Grid::new(p, &ends).at_most(finest(Point::new(length, 0.0)));
    let length = grid.difference(Point::default(), Point::new(length, 0.0)).x;
    let (square, over) = fraction(grid, other);
    square.cmp(&(&length * &length * over))
}

/// The squared distance of an element from the origin of a grid, as a fraction.
fn fraction(grid: Grid, element: Element) -> (IBig, IBig) {
    match element {
        Element::Corner(q) => (grid.local(q).norm2(), IBig::ONE),
        Element::Edge(a, b) => {
            let d = grid.difference(a, b);
            let cross = d.cross(&grid.local(a));
            (&cross * &cross, d.norm2())
        }
    }
}

/// Bound on the error of a squared distance in pairs of doubles, as a share of the size of its terms.
///
/// Differences are exact. Two products and a sum of them, a square, a squared length and a quotient
/// are each right to about 2^-100, which makes less than sixteen times that.
const PAIRS: f64 = f64::from_bits((1023 - 96) << 52);

/// No product of four differences of coordinates loses bits to underflow above this.
const LEAST: f64 = f64::from_bits((1023 - 700) << 52);

/// A squared distance with a bound on its error; `None` where it may underflow.
fn squared(p: Point, element: Element) -> Option<(Double, f64)> {
    let from = |q: Point| (Double::difference(p.x, q.x), Double::difference(p.y, q.y));
    match element {
        Element::Corner(q) => {
            let (x, y) = from(q);
            let square = x * x + y * y;
            let value = square.value();
            (value > LEAST).then_some((square, PAIRS * value))
        }
        Element::Edge(a, b) => {
            let (x, y) = from(a);
            let (dx, dy) = (Double::difference(b.x, a.x), Double::difference(b.y, a.y));
            let (s, t) = (dx * y, dy * x);
            let cross = s - t;
            let size = s.value().abs() + t.value().abs();
            let length2 = dx * dx + dy * dy;
            let square = cross * cross;
            (square.value() > LEAST && length2.value() > LEAST)
                .then(|| (square / length2, PAIRS * (size * size / length2.value())))
        }
    }
}

fn in_pairs(p: Point, first: Element, second: Element) -> Option<Ordering> {
    let ((a, a_error), (b, b_error)) = (squared(p, first)?, squared(p, second)?);
    let (difference, bound) = ((a - b).value(), a_error + b_error);
    if difference > bound {
        Some(Ordering::Greater)
    } else if difference < -bound {
        Some(Ordering::Less)
    } else {
        None
    }
}

fn in_integers(p: Point, first: Element, second: Element) -> Ordering {
    let corners = [first, second].map(|element| match element {
        Element::Corner(q) => [q, q],
        Element::Edge(a, b) => [a, b],
    });
    let grid = Grid::new(p, corners.as_flattened());
    let [(a, a_over), (b, b_over)] = [first, second].map(|element| fraction(grid, element));
    (a * b_over).cmp(&(b * a_over))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn p(x: f64, y: f64) -> Point {
        Point::new(x, y)
    }

    #[test]
    fn a_corner_and_a_line_at_one_distance_tie() {
        // 3-4-5: the origin is 5 away, and so is the line x = 8.
        let (at, wall) = (p(3.0, 4.0), Element::Edge(p(8.0, -1.0), p(8.0, 1.0)));
        assert_eq!(compare_distances(at, Element::Corner(p(0.0, 0.0)), wall), Ordering::Equal);
        let nearer = Element::Edge(p(8.0_f64.next_down(), -1.0), p(8.0_f64.next_down(), 1.0));
        assert_eq!(compare_distances(at, Element::Corner(p(0.0, 0.0)), nearer), Ordering::Greater);
    }

    #[test]
    fn slanted_lines_tie_exactly() {
        // Both lines are 1 away from the origin: 3x + 4y = 5 and 5x + 12y = 13.
        let first = Element::Edge(p(3.0, -1.0), p(-1.0, 2.0));
        let second = Element::Edge(p(5.0, -1.0), p(-7.0, 4.0));
        assert_eq!(compare_distances(p(0.0, 0.0), first, second), Ordering::Equal);
        let tiny = p(0.0, f64::from_bits((1023 - 190) << 52));
        assert_eq!(compare_distances(tiny, first, second), Ordering::Greater);
    }

    #[test]
    fn a_point_on_a_line_is_at_no_distance() {
        let line = Element::Edge(p(0.1, 0.1), p(0.3, 0.3));
        let on = p(0.2, 0.2);
        assert_eq!(compare_distances(on, line, Element::Corner(on)), Ordering::Equal);
        let off = Element::Corner(p(0.2, 0.2_f64.next_up()));
        assert_eq!(compare_distances(on, line, off), Ordering::Less);
    }

    #[test]
    fn pairs_of_doubles_never_contradict_integers() {
        let mut state = 7_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            // Few bits make ties, many none.
            let bits = if state >> 63 == 0 { 60 } else { 20 };
            (state >> bits) as f64 - (1_u64 << (63 - bits)) as f64
        };
        for _ in 0..2000 {
            let mut point = || p(next(), next());
            let at = point();
            let elements = [Element::Corner(point()), Element::Edge(point(), point())];
            let other = [Element::Corner(point()), Element::Edge(point(), point())];
            for first in elements {
                for second in other {
                    let exact = in_integers(at, first, second);
                    let told = in_pairs(at, first, second);
                    assert!(told.is_none_or(|told| told == exact), "{at:?} {first:?} {second:?}");
                }
            }
        }
    }
}
