//! The functions that lengths of parabolas need, from square roots alone: the same on every platform, and
//! several times faster than those of the system's library, which every operation on an axis waits for.

/// Whether the root of a sum of squares is the length of a way.
#[inline]
pub(super) fn is_usual(square: f64) -> bool {
    const LEAST: f64 = f64::from_bits((1023 - 900) << 52);
    const MOST: f64 = f64::from_bits((1023 + 1000) << 52);
    (LEAST < square) & (square < MOST)
}

/// The length of the way `(x, y)`, also where squares overflow or vanish.
#[inline]
pub(super) fn hypot(x: f64, y: f64) -> f64 {
    let square = x * x + y * y;
    if is_usual(square) { square.sqrt() } else { x.hypot(y) }
}

/// The inverse of the hyperbolic sine, within 4 ulp.
#[inline]
pub(super) fn asinh(x: f64) -> f64 {
    if is_little(x) { asinh_of_little(x) } else { x.asinh() }
}

/// Whether a series is long enough for the inverse of the hyperbolic sine.
#[inline]
pub(super) fn is_little(x: f64) -> bool {
    x.abs() <= 1.0
}

/// The inverse of the hyperbolic sine of what is little.
#[inline]
pub(super) fn asinh_of_little(x: f64) -> f64 {
    // With tanh of half and of a quarter of it: asinh x = 2 artanh t = 4 artanh v, |v| < 0.217.
    let t = x / (1.0 + (1.0 + x * x).sqrt());
    let v = t / (1.0 + (1.0 - t * t).sqrt());
    // artanh v = v (1 + v²/3 + v⁴/5 + …), summed in pairs, so that few steps wait for one another.
    let s = v * v;
    let (s2, s4) = (s * s, s * s * (s * s));
    let low = (1.0 / 3.0 + s * (1.0 / 5.0)) + s2 * (1.0 / 7.0 + s * (1.0 / 9.0));
    let middle = (1.0 / 11.0 + s * (1.0 / 13.0)) + s2 * (1.0 / 15.0 + s * (1.0 / 17.0));
    let high = (1.0 / 19.0 + s * (1.0 / 21.0)) + s2 * (1.0 / 23.0 + s * (1.0 / 25.0));
    let rest = s * (low + s4 * (middle + s4 * high));
    4.0 * (v + v * rest)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn asinh_is_that_of_the_library() {
        let mut x = 1e-300;
        while x < 1e300 {
            for x in [x, -x] {
                let (ours, theirs) = (asinh(x), x.asinh());
                assert!((ours - theirs).abs() <= 8.0 * f64::EPSILON * theirs.abs(), "{x}");
            }
            x *= if (1e-3..2.0).contains(&x) { 1.0007 } else { 1.7 };
        }
        assert_eq!((asinh(0.0), asinh(f64::INFINITY)), (0.0, f64::INFINITY));
        assert!(asinh(-0.0).is_sign_negative() && asinh(f64::NAN).is_nan());
        // The hyperbolic sine of a half.
        assert!((asinh(0.521_095_305_493_747_4) - 0.5).abs() <= f64::EPSILON);
    }

    #[test]
    fn hypot_neither_overflows_nor_vanishes() {
        for (x, y) in [(3.0, 4.0), (3e200, 4e200), (3e-200, 4e-200), (0.0, 5e-324)] {
            let ours: f64 = hypot(x, y);
            assert!((ours - f64::hypot(x, y)).abs() <= 2.0 * f64::EPSILON * ours, "{x} {y}");
        }
        assert_eq!(hypot(0.0, 0.0), 0.0);
        assert!(hypot(f64::NAN, 1.0).is_nan());
    }
}
