use std::cmp::Ordering;

use super::double::{two_product, two_sum};
use super::{Point, U};

/// The side of the line `a` → `b` on which `c` lies: positive to the left, 0 on it; the sign is
/// exact.
///
/// The magnitude approximates twice the area of the triangle. Exact as long as no product
/// underflows or overflows, which the exponents a [`Domain`](crate::domain::Domain) accepts
/// ensure.
///
/// ```
/// use medial::geom::{Point, orient2d};
/// let (a, b) = (Point::new(0.1, 0.1), Point::new(0.3, 0.3));
/// assert_eq!(orient2d(a, b, Point::new(0.2, 0.2)), 0.0);
/// assert!(orient2d(a, b, Point::new(0.2, 0.2_f64.next_up())) > 0.0);
/// ```
#[inline]
#[must_use]
pub fn orient2d(a: Point, b: Point, c: Point) -> f64 {
    let coord = |p: Point| robust::Coord { x: p.x, y: p.y };
    robust::orient2d(coord(a), coord(b), coord(c))
}

/// Where `d` lies to the circle through `a`, `b` and `c`, which follow one another counterclockwise: positive
/// inside, 0 on it; the sign is exact.
///
/// Exact as long as no product of four differences underflows or overflows.
///
/// ```
/// use medial::geom::{Point, in_circle};
/// let [a, b, c] = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0)].map(|(x, y)| Point::new(x, y));
/// assert_eq!(in_circle(a, b, c, Point::new(0.0, 1.0)), 0.0);
/// assert!(in_circle(a, b, c, Point::new(0.0, 1.0_f64.next_down())) > 0.0);
/// ```
#[inline]
#[must_use]
pub fn in_circle(a: Point, b: Point, c: Point, d: Point) -> f64 {
    let coord = |p: Point| robust::Coord { x: p.x, y: p.y };
    robust::incircle(coord(a), coord(b), coord(c), coord(d))
}

/// The turn from the direction `a` → `b` to the direction `c` → `d`: positive to the left, 0 if
/// they are parallel; the sign is exact.
///
/// ```
/// use medial::geom::{Point, cross_directions};
/// let p = Point::new;
/// assert!(cross_directions(p(0.0, 0.0), p(1.0, 0.0), p(5.0, 5.0), p(5.0, 6.0)) > 0.0);
/// assert_eq!(cross_directions(p(0.0, 0.0), p(1.0, 1.0), p(9.0, 7.0), p(8.0, 6.0)), 0.0);
/// ```
#[inline]
#[must_use]
pub fn cross_directions(a: Point, b: Point, c: Point, d: Point) -> f64 {
    let (u, v) = (b - a, d - c);
    let (left, right) = (u.x * v.y, u.y * v.x);
    let det = left - right;
    if det.abs() > CROSS_ERROR * (left.abs() + right.abs()) { det } else { exact_cross(a, b, c, d) }
}

/// Orders the length of the way `a` → `b` against that of `b` → `c`; exact.
pub(crate) fn compare_lengths(a: Point, b: Point, c: Point) -> Ordering {
    let (first, second) = ((b - a).norm2(), (c - b).norm2());
    // Three roundings of each square, one more of each sum, and the second order.
    if (first - second).abs() > 8.0 * U * (first + second) {
        return first.total_cmp(&second);
    }
    let mut sum = Expansion::default();
    for ((high, low), sign) in [
        (two_sum(b.x, -a.x), 1.0),
        (two_sum(b.y, -a.y), 1.0),
        (two_sum(c.x, -b.x), -1.0),
        (two_sum(c.y, -b.y), -1.0),
    ] {
        sum.add_product(sign * high, high);
        if low != 0.0 {
            sum.add_product(2.0 * sign * high, low);
            sum.add_product(sign * low, low);
        }
    }
    // Zero has two signs.
    sum.sign_value().partial_cmp(&0.0).unwrap_or(Ordering::Equal)
}

/// The scalar product of the directions `a` → `b` and `c` → `d`; the sign is exact.
///
/// ```
/// use medial::geom::{Point, dot_directions};
/// let p = Point::new;
/// assert!(dot_directions(p(0.0, 0.0), p(1.0, 0.0), p(5.0, 5.0), p(6.0, 9.0)) > 0.0);
/// assert_eq!(dot_directions(p(0.0, 0.0), p(1.0, 2.0), p(5.0, 5.0), p(7.0, 4.0)), 0.0);
/// ```
#[inline]
#[must_use]
pub fn dot_directions(a: Point, b: Point, c: Point, d: Point) -> f64 {
    cross_directions(a, b, c.perp(), d.perp())
}

/// Bound on the relative error of a cross product of two rounded differences.
///
/// Four differences, two products and one subtraction each add at most 2^-53 to first order:
/// 2 + 1 + 1 of them meet in one term, and the rest covers the second order.
const CROSS_ERROR: f64 = 6.0 * f64::EPSILON / 2.0;

fn exact_cross(a: Point, b: Point, c: Point, d: Point) -> f64 {
    let ux = two_sum(b.x, -a.x);
    let uy = two_sum(b.y, -a.y);
    let vx = two_sum(d.x, -c.x);
    let vy = two_sum(d.y, -c.y);
    if [ux, uy, vx, vy].iter().all(|v| v.1 == 0.0) {
        // Rounding is monotonic: the errors of the products count only if the products are equal.
        let (left, right) = (two_product(ux.0, vy.0), two_product(uy.0, vx.0));
        return if left.0 == right.0 { left.1 - right.1 } else { left.0 - right.0 };
    }
    let mut sum = Expansion::default();
    for (i, j) in [(ux.0, vy.0), (ux.0, vy.1), (ux.1, vy.0), (ux.1, vy.1)] {
        sum.add_product(i, j);
    }
    for (i, j) in [(uy.0, vx.0), (uy.0, vx.1), (uy.1, vx.0), (uy.1, vx.1)] {
        sum.add_product(-i, j);
    }
    sum.sign_value()
}

/// An exact sum of up to 24 doubles, as nonoverlapping parts of increasing size.
#[derive(Default)]
struct Expansion {
    parts: [f64; 24],
    len: usize,
}

impl Expansion {
    fn add_product(&mut self, a: f64, b: f64) {
        let (high, low) = two_product(a, b);
        self.add(low);
        self.add(high);
    }

    fn add(&mut self, value: f64) {
        let mut carry = value;
        let mut kept = 0;
        for k in 0..self.len {
            let (high, low) = two_sum(carry, self.parts[k]);
            carry = high;
            if low != 0.0 {
                self.parts[kept] = low;
                kept += 1;
            }
        }
        if carry != 0.0 {
            self.parts[kept] = carry;
            kept += 1;
        }
        self.len = kept;
    }

    /// The largest part, which has the sign of the sum.
    fn sign_value(&self) -> f64 {
        if self.len == 0 { 0.0 } else { self.parts[self.len - 1] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn p(x: f64, y: f64) -> Point {
        Point::new(x, y)
    }

    #[test]
    fn parallel_directions_far_from_each_other_cross_to_exactly_zero() {
        // (1/3, 1/7) is not exact, but twice the same difference is.
        let (x, y) = (1.0 / 3.0, 1.0 / 7.0);
        assert_eq!(cross_directions(p(0.0, 0.0), p(x, y), p(-x, -y), p(x, y)), 0.0);
        assert!(cross_directions(p(0.0, 0.0), p(x, y), p(-x, -y), p(x, y.next_up())) > 0.0);
        assert!(cross_directions(p(0.0, 0.0), p(x, y), p(-x, -y), p(x.next_up(), y)) < 0.0);
    }

    #[test]
    fn lengths_that_round_to_the_same_are_told_apart() {
        // 2^60 + 1 needs 61 bits.
        let big = 2f64.powi(60);
        let (a, b) = (p(-1.0, 0.0), p(big, 0.0));
        assert_eq!(compare_lengths(a, b, p(big, big)), Ordering::Greater);
        assert_eq!(compare_lengths(a, b, a), Ordering::Equal);
        assert_eq!(compare_lengths(p(0.0, 0.0), p(3.0, 4.0), p(8.0, 4.0)), Ordering::Equal);
        assert_eq!(
            compare_lengths(p(0.0, 0.0), p(3.0, 4.0), p(8f64.next_up(), 4.0)),
            Ordering::Less
        );
    }

    #[test]
    fn a_difference_that_rounds_still_has_an_exact_cross() {
        // b - a = (2^60 + 1, 1) needs 61 bits; c - d repeats it, then misses by the 1.
        let big = 2f64.powi(60);
        let (a, b) = (p(-1.0, 0.0), p(big, 1.0));
        assert_eq!(cross_directions(a, b, a, b), 0.0);
        assert!(cross_directions(a, b, p(0.0, 0.0), p(big, 1.0)) > 0.0);
        assert!(cross_directions(p(0.0, 0.0), p(big, 1.0), a, b) < 0.0);
    }

    #[test]
    fn the_cross_of_the_smallest_allowed_numbers_does_not_underflow() {
        let tiny = 2f64.powi(-200);
        let step = tiny.next_up() - tiny;
        assert!(
            cross_directions(p(0.0, 0.0), p(tiny, tiny), p(0.0, 0.0), p(tiny, tiny + step)) > 0.0
        );
        assert_eq!(orient2d(p(0.0, 0.0), p(tiny, tiny), p(tiny + step, tiny + step)), 0.0);
        assert!(orient2d(p(0.0, 0.0), p(tiny, tiny), p(tiny, tiny + step)) > 0.0);
    }
}
