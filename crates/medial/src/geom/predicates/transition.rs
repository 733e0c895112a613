//! Disks that touch an edge at its end, whose centre has at most one root.

use std::cmp::Ordering;

use dashu_int::IBig;

use super::Element;
use super::grid::{Integers, integers};
use super::tower::sign_with_root;
use super::wide::Wide;
use crate::geom::Point;

/// A disk that touches an edge of direction `d` at its end `v` and a third element.
///
/// Its centre is `v + d⊥·s/(m + f·√k)` with a positive divisor, where for a third corner `w` from `v`
/// `s = w·w`, `m = 2d×w`, `f = 0`, and for a third edge of direction `e`, from whose line `v` has the
/// distance `h/√(e·e)`, `s = h`, `m = -d·e`, `f = 1`, `k = (d·d)(e·e)`.
struct Transition {
    d: Integers,
    s: i128,
    m: i128,
    /// The squares of both lengths, if the divisor has a root.
    squares: Option<(i128, i128)>,
}

/// The sign of `(b - a)·(c - p)` for the centre `c` of such a disk; `None` for other disks, and if the
/// differences of the points are too long.
pub(super) fn product_along(
    elements: &[Element; 3],
    [a, b]: [Point; 2],
    p: Point,
) -> Option<Ordering> {
    let (transition, [a, b, p]) = Transition::new(elements, [a, b, p])?;
    let direction = b.minus(a).direction();
    Some(transition.sign(-direction.dot(p), transition.d.cross(direction)))
}

/// The sign of `(b - a)×(c - a)` likewise.
pub(super) fn product_across(elements: &[Element; 3], [a, b]: [Point; 2]) -> Option<Ordering> {
    let (transition, [a, b, _]) = Transition::new(elements, [a, b, b])?;
    let direction = b.minus(a).direction();
    Some(transition.sign(-direction.cross(a), transition.d.dot(direction)))
}

/// The side of a corner likewise: the sign of `w·w - 2w·(c - v)` for the corner `w` from `v`.
pub(super) fn side_of_corner(elements: &[Element; 3], p: Point) -> Option<Ordering> {
    let (transition, [w, ..]) = Transition::new(elements, [p; 3])?;
    Some(transition.sign(w.dot(w), -2 * transition.d.cross(w)))
}

impl Transition {
    /// The disk if it is one, and the points of a question from `v`.
    ///
    /// Coordinates are below 2^60, differences and directions below 2^61, their products below 2^123
    /// and twice those below 2^124.
    fn new(elements: &[Element; 3], [p, q, s]: [Point; 3]) -> Option<(Self, [Integers; 3])> {
        let (v, [a, b], third) = touching_end(elements)?;
        let (e, f) = match third {
            Element::Corner(w) => (w, w),
            Element::Edge(e, f) => (e, f),
        };
        let [a, b, e, f, p, q, s] = integers(v, [a, b, e, f, p, q, s], 60)?;
        let d = b.minus(a).direction();
        let transition = match third {
            Element::Corner(_) => Self { d, s: e.dot(e), m: 2 * d.cross(e), squares: None },
            Element::Edge(..) => {
                let direction = f.minus(e).direction();
                let squares = Some((d.dot(d), direction.dot(direction)));
                Self { d, s: e.cross(direction), m: -d.dot(direction), squares }
            }
        };
        Some((transition, [p, q, s]))
    }

    /// The sign of `x + y·s/(m + f·√k)`.
    fn sign(&self, x: i128, y: i128) -> Ordering {
        let divisor = match self.squares {
            None => self.m,
            // Opposite ends of equal edges, and all that are axis-parallel: the root is an integer.
            Some((n, k)) if n == k => self.m + n,
            Some((n, k)) => {
                let [x, y, m, s, n, k] = [x, y, self.m, self.s, n, k].map(IBig::from);
                return sign_with_root(&(&x * m + y * s), &x, &(n * k));
            }
        };
        Wide::product(x, divisor).plus(Wide::product(y, self.s)).sign()
    }
}

/// A corner that governs with an edge that ends there, the edge, and the third element.
pub(super) fn touching_end(elements: &[Element; 3]) -> Option<(Point, [Point; 2], Element)> {
    for i in 0..3 {
        let Element::Corner(v) = elements[i] else { continue };
        for j in 0..3 {
            if let Element::Edge(a, b) = elements[j]
                && (a == v || b == v)
            {
                return Some((v, [a, b], elements[3 - i - j]));
            }
        }
    }
    None
}
