use std::ops::{Add, Div, Mul, Neg, Sub};

/// Twice the doubles: the unevaluated sum of two, about 31 decimal digits.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct DoubleDouble {
    hi: f64,
    lo: f64,
}

/// Relative error that covers every short formula of this module, ten operations and more.
///
/// One operation errs by at most 16·2^-106.
pub(super) const EPSILON: f64 = 1.0 / (1u128 << 98) as f64;

impl DoubleDouble {
    /// The difference of two doubles, without error.
    #[inline]
    pub(super) fn difference(a: f64, b: f64) -> Self {
        two_sum(a, -b)
    }

    /// The double nearest to the value.
    #[inline]
    pub(super) fn value(self) -> f64 {
        self.hi
    }

    /// Magnitude, rounded.
    #[inline]
    pub(super) fn magnitude(self) -> f64 {
        self.hi.abs()
    }

    /// The square root; 0 of what is not positive.
    #[inline]
    pub(super) fn sqrt(self) -> Self {
        if self.hi <= 0.0 {
            return Self::default();
        }
        // One Newton step from the double root.
        let root = self.hi.sqrt();
        let rest = self - two_product(root, root);
        two_sum(root, rest.hi / (2.0 * root))
    }
}

impl From<f64> for DoubleDouble {
    #[inline]
    fn from(value: f64) -> Self {
        Self { hi: value, lo: 0.0 }
    }
}

impl Add for DoubleDouble {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        let s = two_sum(self.hi, other.hi);
        let t = two_sum(self.lo, other.lo);
        let s = fast_two_sum(s.hi, s.lo + t.hi);
        fast_two_sum(s.hi, s.lo + t.lo)
    }
}

impl Neg for DoubleDouble {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

impl Sub for DoubleDouble {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for DoubleDouble {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        let p = two_product(self.hi, other.hi);
        fast_two_sum(p.hi, p.lo + (self.hi * other.lo + self.lo * other.hi))
    }
}

impl Div for DoubleDouble {
    type Output = Self;
    #[inline]
    fn div(self, other: Self) -> Self {
        let first = self.hi / other.hi;
        let rest = self - Self::from(first) * other;
        let second = rest.hi / other.hi;
        let rest = rest - Self::from(second) * other;
        fast_two_sum(first, second) + Self::from(rest.hi / other.hi)
    }
}

#[inline]
fn two_sum(a: f64, b: f64) -> DoubleDouble {
    let hi = a + b;
    let from_b = hi - a;
    DoubleDouble { hi, lo: (a - (hi - from_b)) + (b - from_b) }
}

#[inline]
fn fast_two_sum(a: f64, b: f64) -> DoubleDouble {
    let hi = a + b;
    DoubleDouble { hi, lo: b - (hi - a) }
}

#[inline]
fn two_product(a: f64, b: f64) -> DoubleDouble {
    let hi = a * b;
    DoubleDouble { hi, lo: a.mul_add(b, -hi) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// |value - expected| relative to the expected value.
    fn off(value: DoubleDouble, hi: f64, lo: f64) -> f64 {
        let rest = value - DoubleDouble { hi, lo };
        (rest.hi / hi).abs()
    }

    #[test]
    fn root_of_two_has_thirty_digits() {
        let root = DoubleDouble::from(2.0).sqrt();
        assert!(off(root * root, 2.0, 0.0) < 16.0 * EPSILON / 256.0);
        // The second double of the root of two is -9.667293313452913e-17.
        assert!(off(root, std::f64::consts::SQRT_2, -9.667_293_313_452_913e-17) < 1e-31);
    }

    #[test]
    fn a_third_times_three_is_one_to_thirty_digits() {
        let third = DoubleDouble::from(1.0) / DoubleDouble::from(3.0);
        assert!(off(third * DoubleDouble::from(3.0), 1.0, 0.0) < 1e-31);
        assert!((third.value() - 1.0 / 3.0).abs() < 1e-16);
    }

    #[test]
    fn differences_of_doubles_lose_nothing() {
        let d = DoubleDouble::difference(1.0, 1e-30);
        assert_eq!((d + DoubleDouble::from(-1.0)).value(), -1e-30);
    }
}
