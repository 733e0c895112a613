//! Short cuts for the ties that are common: they answer as the tower does, or not at all.

use std::cmp::Ordering;

use dashu_int::IBig;
use dashu_int::ops::Gcd;

use super::Element;
use super::counts::count;
use super::disk::ExactDisk;
use super::grid::{Integers, integers};
use super::tower::sign_of_integer;
use super::wide::{Wide, double};
use crate::geom::{Double, Point};

/// The side of an element for the disk of three others, by the cheapest stage that can tell.
///
/// Answers as [`ExactDisk::side`] does, provided that the three elements make a disk; for three that
/// make none the answer means nothing.
///
/// ```
/// use std::cmp::Ordering;
/// use medial::geom::Point;
/// use medial::geom::predicates::{Element, in_disk};
/// let corner = |x, y| Element::Corner(Point::new(x, y));
/// let circle = [corner(1.0, 0.0), corner(0.0, 1.0), corner(-1.0, 0.0)];
/// assert_eq!(in_disk(circle, corner(0.0, -1.0)), Ordering::Equal);
/// assert_eq!(in_disk(circle, corner(0.0, -0.9)), Ordering::Less);
/// ```
#[must_use]
pub fn in_disk(elements: [Element; 3], t: Element) -> Ordering {
    if elements.contains(&t) {
        count(|counts| counts.structure += 1);
        return Ordering::Equal;
    }
    // Without a disk nothing is cut.
    special_side(elements, t)
        .unwrap_or_else(|| ExactDisk::new(elements).map_or(Ordering::Greater, |d| d.side(t)))
}

/// The side of an element by a special stage, if there is one for its kind and it can tell.
pub(super) fn special_side(elements: [Element; 3], t: Element) -> Option<Ordering> {
    use Element::{Corner, Edge};
    match (elements, t) {
        ([Corner(p), Corner(q), Corner(s)], Corner(t)) => {
            four_corners(p, q, s, t).inspect(|_| count(|counts| counts.corners += 1))
        }
        ([Edge(a, b), Edge(c, d), Edge(e, f)], Edge(g, h)) => {
            four_edges([(a, b), (c, d), (e, f), (g, h)])
                .inspect(|_| count(|counts| counts.edges += 1))
        }
        _ => None,
    }
}

/// The side of `t` for the circle through three corners in counterclockwise order; `None` if the
/// exponents are too far from 1.
fn four_corners(p: Point, q: Point, s: Point, t: Point) -> Option<Ordering> {
    let points = [p, q, s, t];
    if let Some([a, b, c]) = integers(t, [p, q, s], 30) {
        // Squares and cross products stay below 2^61, so the sum stays below 2^124.
        let term = |u: Integers, v: Integers, w: Integers| u.dot(u) * v.cross(w);
        let inside = term(a, b, c) + term(b, c, a) + term(c, a, b);
        return Some(0.cmp(&inside));
    }
    // No product of four coordinates underflows or overflows, nor do the errors of the roundings.
    let safe =
        |value: f64| value == 0.0 || (2f64.powi(-180)..2f64.powi(200)).contains(&value.abs());
    points.iter().all(|point| safe(point.x) && safe(point.y)).then(|| {
        let [p, q, s, t] = points.map(|point| robust::Coord { x: point.x, y: point.y });
        let inside = robust::incircle(p, q, s, t);
        0.0.partial_cmp(&inside).unwrap_or(Ordering::Equal)
    })
}

/// The side of the last edge for the disk touching the first three, whose contacts follow one another
/// counterclockwise; `None` if 256 bits or a double-double cannot tell.
///
/// The answer is the sign of a sum `Σ kᵢ√nᵢ` over the four edges. Equal radicands are added up first,
/// so that true ties, whose roots are dependent, mostly end in sums of zero.
fn four_edges(edges: [(Point, Point); 4]) -> Option<Ordering> {
    let [(a, b), (c, d), (e, f), (g, h)] = edges;
    // Coordinates below 2^61 make directions below 2^62, their cross products and squares below 2^125,
    // distances below 2^124, a factor below 3·2^249, and the sum of all four below 2^253.
    let [a, b, c, d, e, f, g, h] = integers(shared_end(&edges), [a, b, c, d, e, f, g, h], 61)?;
    let lines = [(a, b), (c, d), (e, f), (g, h)].map(|(a, b)| {
        let d = b.minus(a).direction();
        (d, d.dot(d).unsigned_abs(), a.cross(d))
    });
    let [h1, h2, h3, h4] = lines.map(|line| line.2);
    let cross = |i: usize, j: usize| lines[i].0.cross(lines[j].0);
    let (c12, c23, c31) = (cross(0, 1), cross(1, 2), cross(2, 0));
    let (c41, c42, c43) = (cross(3, 0), cross(3, 1), cross(3, 2));
    let sum = |a: i128, b: i128, c: i128, d: i128, e: i128, f: i128| {
        Wide::product(a, b).plus(Wide::product(c, d)).plus(Wide::product(e, f))
    };
    let factors = [
        sum(h3, c42, -h2, c43, h4, c23),
        sum(h1, c43, -h3, c41, h4, c31),
        sum(h2, c41, -h1, c42, h4, c12),
        sum(h1, c23, h2, c31, h3, c12).negated(),
    ];
    let mut terms: [(u128, Wide); 4] = [0, 1, 2, 3].map(|i| (lines[i].1, factors[i]));
    for i in 1..4 {
        if let Some(j) = (0..i).find(|&j| terms[j].0 == terms[i].0) {
            terms[j].1 = terms[j].1.plus(terms[i].1);
            terms[i].1 = Wide::ZERO;
        }
    }
    let some = |sign| terms.iter().any(|term| term.1.sign() == sign);
    match (some(Ordering::Less), some(Ordering::Greater)) {
        (false, false) => Some(Ordering::Equal),
        (true, false) => Some(Ordering::Less),
        (false, true) => Some(Ordering::Greater),
        (true, true) => sign_of_sum(&terms).or_else(|| sign_by_classes(&terms)),
    }
}

/// Share of the absolute sum that bounds the rounding of [`sign_of_sum`].
///
/// A conversion, a root, a product and up to four sums of pairs of doubles, each right to 2^-100, add
/// less than 10·2^-100, about 8e-30.
const SUM_ERROR: f64 = 1e-29;

/// The sign of the sum of the factors times the roots of the radicands, if pairs of doubles can tell.
fn sign_of_sum(terms: &[(u128, Wide); 4]) -> Option<Ordering> {
    let mut sum = Double::ZERO;
    let mut size = 0.0;
    for (radicand, factor) in terms.iter().filter(|term| term.1 != Wide::ZERO) {
        let term = factor.to_double() * double(*radicand).sqrt();
        sum = sum + term;
        size += term.value().abs();
    }
    let value = sum.value();
    if value > SUM_ERROR * size {
        Some(Ordering::Greater)
    } else if value < -SUM_ERROR * size {
        Some(Ordering::Less)
    } else {
        None
    }
}

/// The sign of the sum, if radicands whose quotients are squares leave at most one root.
///
/// Roots of different classes are independent over the rationals: the sum is zero only if it is zero in
/// each class.
fn sign_by_classes(terms: &[(u128, Wide); 4]) -> Option<Ordering> {
    // A radicand m with a numerator s and a positive denominator t, for the sum s·√m/t.
    let mut classes: Vec<(u128, IBig, IBig)> = Vec::new();
    for (radicand, factor) in terms {
        let factor = factor.to_big();
        let known = classes.iter_mut().find_map(|class| {
            let root = root_of_quotient(*radicand, class.0)?;
            Some((class, root))
        });
        match known {
            // s·√m/t + k·√n = (s·q + k·p·t)·√m/(t·q) with √(n/m) = p/q
            Some(((_, s, t), (p, q))) => {
                *s = &*s * q + factor * p * &*t;
                *t *= q;
            }
            None => classes.push((*radicand, factor, IBig::ONE)),
        }
    }
    let mut signs = classes.iter().map(|(_, s, _)| sign_of_integer(s)).filter(|sign| sign.is_ne());
    let first = signs.next().unwrap_or(Ordering::Equal);
    signs.all(|sign| sign == first).then_some(first)
}

/// The root of the quotient of two positive numbers as a fraction, if it is one.
fn root_of_quotient(a: u128, b: u128) -> Option<(u128, u128)> {
    let common = a.gcd(b);
    let root = |value: u128| {
        let root = value.isqrt();
        (root * root == value).then_some(root)
    };
    Some((root(a / common)?, root(b / common)?))
}

/// An end that two of the edges share, which makes their distances to it zero.
fn shared_end(edges: &[(Point, Point); 4]) -> Point {
    let shared = |&(a, b): &(Point, Point)| {
        let others = |p: Point| edges.iter().filter(|(c, d)| *c == p || *d == p).count();
        if others(a) > 1 {
            Some(a)
        } else if others(b) > 1 {
            Some(b)
        } else {
            None
        }
    };
    edges.iter().find_map(shared).unwrap_or(edges[0].0)
}
