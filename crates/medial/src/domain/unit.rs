//! Lengths and directions, rounded.

use crate::geom::{Double, Point};

/// The unit vector from `a` to `b` and their distance; (±1, 0) and (0, ±1) are exact.
///
/// With u = 2^-53, each coordinate has a relative error of at most 3 u, and the length one of 2 u,
/// to first order: the squares have one rounding, their sum two, so its root one, and two with
/// its own; the quotient adds another one. If a difference does not fit a double, all is computed
/// with about a hundred bits and rounded about once. Two points of allowed exponents keep all
/// products in range.
#[inline]
pub(super) fn unit_vector(a: Point, b: Point) -> (Point, f64) {
    let (x, y) = (b.x - a.x, b.y - a.y);
    if !fits(b.x, a.x, x) || !fits(b.y, a.y, y) {
        return long_unit_vector(a, b);
    }
    if x == 0.0 || y == 0.0 {
        return axis_parallel(x, y);
    }
    let length = (x * x + y * y).sqrt();
    (Point::new(x / length, y / length), length)
}

/// Whether `difference`, which is `b - a` rounded, is exact.
#[inline]
fn fits(b: f64, a: f64, difference: f64) -> bool {
    // One of them is exact in any case: the one with the larger operand.
    b - difference == a && difference + a == b
}

fn axis_parallel(x: f64, y: f64) -> (Point, f64) {
    if y == 0.0 {
        (Point::new(1f64.copysign(x), 0.0), x.abs())
    } else {
        (Point::new(0.0, 1f64.copysign(y)), y.abs())
    }
}

#[cold]
fn long_unit_vector(a: Point, b: Point) -> (Point, f64) {
    let (dx, dy) = (Double::difference(b.x, a.x), Double::difference(b.y, a.y));
    if dx.value() == 0.0 || dy.value() == 0.0 {
        return axis_parallel(dx.value(), dy.value());
    }
    let length = (dx * dx + dy * dy).sqrt();
    let quotient = |d: Double| {
        let q = d.value() / length.value();
        q + (d - length * Double::from(q)).value() / length.value()
    };
    (Point::new(quotient(dx), quotient(dy)), length.value())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axis_parallel_directions_are_exact() {
        let o = Point::new(0.1, 0.3);
        for (to, x, y) in [(Point::new(7.7, 0.3), 1.0, 0.0), (Point::new(0.1, -1e60), 0.0, -1.0)] {
            let (d, _) = unit_vector(o, to);
            assert_eq!((d.x, d.y), (x, y));
        }
    }

    #[test]
    fn pythagorean_directions_and_lengths_are_the_nearest() {
        let far = 2f64.powi(40);
        let (d, l) = unit_vector(Point::new(far, far), Point::new(far + 3.0, far - 4.0));
        assert_eq!((d.x, d.y, l), (0.6, -0.8, 5.0));
        let s = 2f64.powi(-200);
        let (d, l) = unit_vector(Point::new(0.0, 0.0), Point::new(5.0 * s, 12.0 * s));
        assert_eq!((d.x, d.y, l), (5.0 / 13.0, 12.0 / 13.0, 13.0 * s));
    }

    #[test]
    fn directions_and_lengths_keep_their_bounds_at_all_sizes() {
        let o = Point::new(0.0, 0.0);
        let near = |one: f64, exact: Double, units: f64| {
            let error = (Double::from(one) - exact).value().abs();
            error <= units * 0.5 * f64::EPSILON * exact.value().abs()
        };
        for (size, k) in [2f64.powi(-200), 1.0, 2f64.powi(170)].into_iter().zip([1, 3, 7]) {
            for at in 1..2000 {
                let (x, y) = (f64::from(at * k) / 3.0 * size, f64::from(at * at) / 7.0 * size);
                let ((d, l), (x, y)) =
                    (unit_vector(o, Point::new(x, y)), (Double::from(x), Double::from(y)));
                let exact = (x * x + y * y).sqrt();
                assert!(near(l, exact, 2.01));
                assert!(near(d.x, x / exact, 3.01) && near(d.y, y / exact, 3.01));
            }
        }
    }

    #[test]
    fn a_difference_that_does_not_fit_a_double_is_used_in_full() {
        // (2^53 + 1, 2^53 + 1) rounds to (2^53, 2^53), or to 2^53 + 2, when subtracted.
        let big = 2f64.powi(53);
        let (d, _) = unit_vector(Point::new(-1.0, -1.0), Point::new(big, big));
        assert_eq!(d.x, 0.5f64.sqrt());
        assert_eq!(d.x, d.y);
    }
}
