//! Lengths and directions, rounded once.

use crate::geom::{Double, Point};

/// The unit vector from `a` to `b` and their distance, each coordinate within about half a unit
/// in the last place; (±1, 0) and (0, ±1) are exact.
///
/// Two points of allowed exponents keep all products in range.
pub(super) fn unit_vector(a: Point, b: Point) -> (Point, f64) {
    let (dx, dy) = (Double::difference(b.x, a.x), Double::difference(b.y, a.y));
    let (x, y) = (dx.value(), dy.value());
    if y == 0.0 {
        return (Point::new(1f64.copysign(x), 0.0), x.abs());
    }
    if x == 0.0 {
        return (Point::new(0.0, 1f64.copysign(y)), y.abs());
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
    fn pythagorean_directions_are_rounded_once() {
        let far = 2f64.powi(40);
        let (d, l) = unit_vector(Point::new(far, far), Point::new(far + 3.0, far - 4.0));
        assert_eq!((d.x, d.y, l), (0.6, -0.8, 5.0));
        let (s, t) = (2f64.powi(-200), 2f64.powi(200));
        let (d, l) = unit_vector(Point::new(0.0, 0.0), Point::new(5.0 * s, 12.0 * s));
        assert_eq!((d.x, d.y, l), (5.0 / 13.0, 12.0 / 13.0, 13.0 * s));
        let (d, l) = unit_vector(Point::new(t, t), Point::new(-t, -t));
        assert_eq!((d.x, d.y, l), (-(0.5f64.sqrt()), -(0.5f64.sqrt()), 8f64.sqrt() * t));
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
