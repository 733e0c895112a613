//! Which of the two governors of a path leaves it first.
//!
//! # Contract
//! Exact, without roots: where a governor leaves, the other one touches a disk whose centre lies on a
//! known normal, so its position is rational.
//!
//! # Method
//! A path has its right governor's contact moving forward along the boundary and its left governor's
//! contact moving backward. `v` is the place where the right one leaves and `d` the direction of the
//! edge whose normal at `v` the centre then crosses; `w` and `e` are the same on the left, and
//! `q = w - v`. A disk on the normal at `v` that touches the other governor has a known radius, which
//! says whether it comes before or after the normal at `w`.

use std::cmp::Ordering;

use dashu_int::IBig;

use super::counts::count;
use super::grid::{Grid, integers};
use super::tower::sign_of_integer;
use super::wide::Wide;
use crate::geom::Point;

/// How a governor leaves a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Leaving {
    /// The contact reaches an end of this governing edge: its second point on the right of the path,
    /// its first on the left.
    Edge(Point, Point),
    /// The governor is a corner and the contact moves on to this edge: the one that begins at the
    /// corner on the right of the path, the one that ends there on the left.
    Corner(Point, Point),
}

/// The governor of a path that leaves first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum First {
    /// The right one.
    Right,
    /// Both at once: an exact tie.
    Both,
    /// The left one.
    Left,
}

/// Tells which governor of a path leaves it first, where the path goes on far enough.
///
/// Ask this near a tie, when doubles cannot tell: between an edge and a corner the path is a parabola,
/// which may cross the normal at the end of the edge a second time far away, and there the answer is
/// about that crossing. The governors must be able to govern together: each lies in front of the other
/// where that is an edge, and edges that are parallel have opposite directions.
///
/// ```
/// use medial::geom::Point;
/// use medial::geom::predicates::{First, Leaving, two_ends};
/// // A corridor between y = 0 and y = 1; the path runs to the right.
/// let p = Point::new;
/// let floor = Leaving::Edge(p(0.0, 0.0), p(4.0, 0.0));
/// assert_eq!(two_ends(floor, Leaving::Edge(p(4.0, 1.0), p(0.0, 1.0))), First::Both);
/// assert_eq!(two_ends(floor, Leaving::Edge(p(5.0, 1.0), p(0.0, 1.0))), First::Right);
/// assert_eq!(two_ends(floor, Leaving::Edge(p(3.0, 1.0), p(0.0, 1.0))), First::Left);
/// ```
#[must_use]
pub fn two_ends(right: Leaving, left: Leaving) -> First {
    count(|counts| counts.two_ends += 1);
    let (Leaving::Edge(a, b) | Leaving::Corner(a, b)) = right;
    let (Leaving::Edge(f, g) | Leaving::Corner(f, g)) = left;
    let v = if matches!(right, Leaving::Edge(..)) { b } else { a };
    let w = if matches!(left, Leaving::Edge(..)) { f } else { g };
    if let Some(order) = axis_parallel(right, left) {
        return first(order);
    }
    let sign = match integers(v, [a, b, f, g, w], 61) {
        // Directions stay below 2^62, their products below 2^125, the sums of those below 2^251.
        Some([a, b, f, g, q]) => {
            let (d, e) = (b.minus(a).direction(), g.minus(f).direction());
            Products {
                turn: d.cross(e),
                d: [d.dot(d), d.dot(q), d.cross(q)],
                e: [e.dot(e), e.dot(q), e.cross(q)],
                square: q.dot(q),
            }
            .sign(right, left)
        }
        None => None,
    };
    let sign = sign.or_else(|| {
        let grid = Grid::new(v, &[a, b, f, g]);
        let (d, e) = (grid.difference(a, b).direction(), grid.difference(f, g).direction());
        let q = grid.local(w);
        Products {
            turn: d.cross(&e),
            d: [d.norm2(), d.dot(&q), d.cross(&q)],
            e: [e.norm2(), e.dot(&q), e.cross(&q)],
            square: q.norm2(),
        }
        .sign(right, left)
    });
    first(sign.unwrap_or(Ordering::Equal))
}

/// `Less` if the left governor leaves first.
fn first(sign: Ordering) -> First {
    match sign {
        Ordering::Greater => First::Right,
        Ordering::Less => First::Left,
        Ordering::Equal => First::Both,
    }
}

/// The answer for edges parallel to one axis, which takes comparisons of coordinates only.
#[inline]
fn axis_parallel(right: Leaving, left: Leaving) -> Option<Ordering> {
    let (Leaving::Edge(a, b) | Leaving::Corner(a, b)) = right;
    let (Leaving::Edge(f, g) | Leaving::Corner(f, g)) = left;
    // From here on x runs along the edges: a mirror image if that was y.
    let mirrored = a.y != b.y || f.y != g.y;
    if mirrored && (a.x != b.x || f.x != g.x) {
        return None;
    }
    let of = |p: Point| if mirrored { (p.y, p.x) } else { (p.x, p.y) };
    let sign = |p: f64, q: f64| i32::from(q > p) - i32::from(q < p);
    let [(ax, ay), (bx, _), (fx, _), (gx, gy)] = [of(a), of(b), of(f), of(g)];
    let (d, e) = (sign(ax, bx), sign(fx, gx));
    let answer = match (right, left) {
        // d·q
        (Leaving::Edge(..), Leaving::Edge(..)) => d * sign(bx, fx),
        // (d·q)(e·p) + (e·q)(d·p), where p is q turned: both products have the same sign.
        (Leaving::Corner(..), Leaving::Corner(..)) => {
            let answer = -d * e * sign(ax, gx) * sign(ay, gy);
            if mirrored { -answer } else { answer }
        }
        _ => return None,
    };
    Some(answer.cmp(&0))
}

/// The products of the three vectors that the forms are made of.
struct Products<T> {
    /// `d×e`
    turn: T,
    /// `d·d`, `d·q`, `d×q`
    d: [T; 3],
    /// `e·e`, `e·q`, `e×q`
    e: [T; 3],
    /// `q·q`
    square: T,
}

impl<T: Number> Products<T> {
    /// `Less` if the left governor leaves first; `None` if the numbers are too small for the answer.
    fn sign(&self, right: Leaving, left: Leaving) -> Option<Ordering> {
        let Self { turn, d: [n, dq, d_q], e: [m, eq, e_q], square } = self;
        let e_q = &e_q.negated();
        match (right, left) {
            (Leaving::Edge(..), Leaving::Edge(..)) => {
                // The radius where the right one leaves, against that where the left one leaves.
                let radii = match turn.order() {
                    Ordering::Equal => return Some(dq.order()),
                    _ if n == m => e_q.cmp(d_q),
                    _ => {
                        T::sum(&[(&e_q.signed_square()?, n), (&d_q.signed_square()?.negated(), m)])
                    }
                };
                // The path shrinks where the two edges converge.
                Some(if turn.order().is_gt() { radii } else { radii.reverse() })
            }
            // e·(c - w) for the disk on the normal at v, times 2d×q.
            (Leaving::Edge(..), Leaving::Corner(..)) => {
                let (d_q, eq) = (d_q.negated(), eq);
                Some(T::sum(&[(&d_q, eq), (&d_q, eq), (square, turn)]))
            }
            // d·(c - v) for the disk on the normal at w, times -2e×q.
            (Leaving::Corner(..), Leaving::Edge(..)) => {
                Some(T::sum(&[(e_q, dq), (e_q, dq), (&square.negated(), turn)]))
            }
            // Both positions on the line halfway between the corners.
            (Leaving::Corner(..), Leaving::Corner(..)) => {
                Some(T::sum(&[(dq, e_q), (eq, &d_q.negated())]))
            }
        }
    }
}

/// An integer, of fixed size or not.
trait Number: Ord {
    /// The order against zero.
    fn order(&self) -> Ordering;
    fn negated(&self) -> Self;
    /// The square with the sign of the number, if it fits.
    fn signed_square(&self) -> Option<Self>
    where
        Self: Sized;
    /// The order of a sum of products against zero.
    fn sum(terms: &[(&Self, &Self)]) -> Ordering;
}

impl Number for i128 {
    fn order(&self) -> Ordering {
        self.cmp(&0)
    }

    fn negated(&self) -> Self {
        -self
    }

    fn signed_square(&self) -> Option<Self> {
        // One bit is left, so that two products with numbers below 2^125 fit 256 bits.
        self.checked_mul(self.checked_abs()?)
    }

    fn sum(terms: &[(&Self, &Self)]) -> Ordering {
        terms.iter().fold(Wide::ZERO, |sum, (a, b)| sum.plus(Wide::product(**a, **b))).sign()
    }
}

impl Number for IBig {
    fn order(&self) -> Ordering {
        sign_of_integer(self)
    }

    fn negated(&self) -> Self {
        -self
    }

    fn signed_square(&self) -> Option<Self> {
        let square = self * self;
        Some(if sign_of_integer(self).is_lt() { -square } else { square })
    }

    fn sum(terms: &[(&Self, &Self)]) -> Ordering {
        sign_of_integer(&terms.iter().map(|(a, b)| *a * *b).sum())
    }
}
