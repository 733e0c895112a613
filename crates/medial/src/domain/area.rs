//! Areas of closed chains of points: compensated values, exact signs.

use std::cmp::Ordering;

use dashu_int::IBig;

use crate::geom::{Double, Point};

/// Twice the signed area, right to well over 53 bits.
pub(super) fn twice_area(points: &[Point]) -> Double {
    let Some(&origin) = points.first() else { return Double::ZERO };
    let from_origin =
        |p: Point| (Double::difference(p.x, origin.x), Double::difference(p.y, origin.y));
    let (mut sum, mut size) = (Double::ZERO, 0.0);
    for_edges(points.iter().copied(), |a, b| {
        let ((ax, ay), (bx, by)) = (from_origin(a), from_origin(b));
        let (left, right) = (ax * by, bx * ay);
        sum = sum + left - right;
        size += left.value().abs() + right.value().abs();
    });
    if sum.value().abs() > CANCELLATION * (points.len() as f64) * size {
        return sum;
    }
    let exact = exact_twice_area(points).to_f64().value();
    Double::from(exact * SCALE)
}

/// Share of the sum of all terms below which `Double` no longer gives 53 bits: it adds with a
/// relative error of about 2^-100.
const CANCELLATION: f64 = 1.0 / (1u64 << 44) as f64;

/// 2^-504, the unit of exact areas.
const SCALE: f64 = f64::from_bits((1023 - 504) << 52);

/// The exact sign of the area: `Greater` for a counterclockwise ring.
pub(super) fn orientation(points: &[Point]) -> Ordering {
    let Some((&origin, rest)) = points.split_first() else { return Ordering::Equal };
    let (mut sum, mut size) = (0.0, 0.0);
    // Terms at the origin are 0.
    let mut before = Point::default();
    for &point in rest {
        let at = point - origin;
        let (left, right) = (before.x * at.y, before.y * at.x);
        sum += left - right;
        size += left.abs() + right.abs();
        before = at;
    }
    // Each term has a relative error below 4 roundings of its size, and n additions follow.
    let bound = (points.len() as f64 + 8.0) * f64::EPSILON * size;
    if sum > bound {
        Ordering::Greater
    } else if sum < -bound {
        Ordering::Less
    } else {
        exact_twice_area(points).cmp(&IBig::ZERO)
    }
}

/// Twice the area that a ring encloses, as a multiple of 2^-504.
pub(super) fn exact_size(points: &[Point]) -> IBig {
    let area = exact_twice_area(points);
    if area < IBig::ZERO { -area } else { area }
}

/// Twice the signed area as a multiple of 2^-504.
fn exact_twice_area(points: &[Point]) -> IBig {
    let mut sum = IBig::ZERO;
    for_edges(points.iter().copied(), |a, b| {
        sum += integer(a.x) * integer(b.y) - integer(b.x) * integer(a.y);
    });
    sum
}

/// A double of an allowed exponent as a multiple of 2^-252.
fn integer(value: f64) -> IBig {
    let bits = value.to_bits();
    let exponent = (bits >> 52 & 0x7ff) as usize;
    if exponent == 0 {
        return IBig::ZERO;
    }
    let mantissa = (bits & ((1 << 52) - 1) | 1 << 52) as i64;
    // The value is mantissa · 2^(exponent - 1075), and exponent - 1023 is at least -200.
    IBig::from(if value < 0.0 { -mantissa } else { mantissa }) << (exponent - 823)
}

fn for_edges(points: impl Iterator<Item = Point>, mut f: impl FnMut(Point, Point)) {
    let mut points = points;
    let Some(first) = points.next() else { return };
    let mut before = first;
    for point in points {
        f(before, point);
        before = point;
    }
    f(before, first);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn p(x: f64, y: f64) -> Point {
        Point::new(x, y)
    }

    #[test]
    fn the_area_of_a_small_square_far_away_is_exact() {
        let (o, s) = (2f64.powi(40) + 0.5, 2f64.powi(-10));
        let square = [p(o, o), p(o + s, o), p(o + s, o + s), p(o, o + s)];
        assert_eq!(twice_area(&square).value(), 2.0 * s * s);
    }

    #[test]
    fn the_area_of_a_speck_on_a_long_line_is_exact() {
        // (t, t + u), (t + u, t), (2t, 0): the determinant is exactly -u².
        let (t, s) = (0.1_f64, 0.1_f64.next_up());
        let speck = [p(t, s), p(s, t), p(2.0 * t, 0.0)];
        assert_eq!(twice_area(&speck).value(), -(s - t) * (s - t));
        assert_eq!(exact_size(&speck), IBig::ONE << (504 - 2 * 56));
    }

    #[test]
    fn the_orientation_of_a_sliver_one_ulp_wide_is_exact() {
        let (a, b) = (p(0.1, 0.1), p(0.3, 0.3));
        let up = p(0.2, 0.2_f64.next_up());
        assert_eq!(orientation(&[a, b, up]), Ordering::Greater);
        assert_eq!(orientation(&[a, up, b]), Ordering::Less);
        assert_eq!(orientation(&[a, b, p(0.2, 0.2)]), Ordering::Equal);
    }

    #[test]
    fn extreme_exponents_are_exact() {
        let (s, l) = (2f64.powi(-200), 2f64.powi(200));
        assert_eq!(orientation(&[p(0.0, 0.0), p(l, s), p(s, s)]), Ordering::Greater);
        assert_eq!(orientation(&[p(0.0, 0.0), p(l, l), p(l + 0.0, l), p(s, s)]), Ordering::Equal);
        assert_eq!(integer(-s), IBig::from(-1) << 52);
        assert_eq!(integer(s.next_up()) - integer(s), IBig::ONE);
    }

    #[test]
    fn sizes_ignore_direction_and_see_one_ulp() {
        let square = [p(0.0, 0.0), p(1.0, 0.0), p(1.0, 1.0), p(0.0, 1.0)];
        let mut other = square;
        other.reverse();
        assert_eq!(exact_size(&square), exact_size(&other));
        other[0].x = 1.0_f64.next_down();
        assert!(exact_size(&square) > exact_size(&other));
    }
}
