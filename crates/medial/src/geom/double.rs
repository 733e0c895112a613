//! Arithmetic on unevaluated sums of two doubles, about 106 bits.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// An unevaluated sum `hi + lo` with `|lo|` at most half an ulp of `hi`.
///
/// Each operation is right to about 2^-100 of its result (a difference: of its operands).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Double {
    hi: f64,
    lo: f64,
}

impl Double {
    /// Zero.
    pub const ZERO: Self = Self { hi: 0.0, lo: 0.0 };

    /// The difference of two doubles, without error.
    #[inline]
    #[must_use]
    pub fn difference(a: f64, b: f64) -> Self {
        let (hi, lo) = two_sum(a, -b);
        Self { hi, lo }
    }

    /// The nearest double.
    #[inline]
    #[must_use]
    pub const fn value(self) -> f64 {
        self.hi
    }

    /// The square root; 0 for anything not positive.
    #[inline]
    #[must_use]
    pub fn sqrt(self) -> Self {
        if self.hi <= 0.0 {
            return Self::ZERO;
        }
        let root = self.hi.sqrt();
        let (p, e) = two_product(root, root);
        // The first difference is exact.
        let rest = ((self.hi - p) - e + self.lo) / (2.0 * root);
        let (hi, lo) = quick_two_sum(root, rest);
        Self { hi, lo }
    }

    /// The difference, right to about 2^-100 of the larger operand only.
    #[inline]
    #[must_use]
    pub fn minus(self, other: Self) -> Self {
        let (s, e) = two_sum(self.hi, -other.hi);
        let (hi, lo) = quick_two_sum(s, e + (self.lo - other.lo));
        Self { hi, lo }
    }

    /// `a * b + c * d`, right to about 2^-100 of the larger product.
    #[inline]
    #[must_use]
    pub fn sum_of_products(a: Self, b: Self, c: Self, d: Self) -> Self {
        let (p, e) = two_product(a.hi, b.hi);
        let (q, f) = two_product(c.hi, d.hi);
        let (s, g) = two_sum(p, q);
        let cross = (a.hi * b.lo + a.lo * b.hi) + (c.hi * d.lo + c.lo * d.hi);
        let (hi, lo) = quick_two_sum(s, g + (e + f + cross));
        Self { hi, lo }
    }

    /// `self - a * b`, rounded about once where both agree in their first digits.
    #[inline]
    #[must_use]
    pub fn less_product(self, a: Self, b: Self) -> f64 {
        let (p, e) = two_product(a.hi, b.hi);
        (self.hi - p) + (self.lo - e - (a.hi * b.lo + a.lo * b.hi))
    }
}

impl From<f64> for Double {
    #[inline]
    fn from(value: f64) -> Self {
        Self { hi: value, lo: 0.0 }
    }
}

impl Add for Double {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        let (s, e) = two_sum(self.hi, other.hi);
        let (t, f) = two_sum(self.lo, other.lo);
        let (s, e) = quick_two_sum(s, e + t);
        let (hi, lo) = quick_two_sum(s, e + f);
        Self { hi, lo }
    }
}

impl Neg for Double {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

impl Sub for Double {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Double {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        let (p, e) = two_product(self.hi, other.hi);
        let (hi, lo) = quick_two_sum(p, e + (self.hi * other.lo + self.lo * other.hi));
        Self { hi, lo }
    }
}

impl Div for Double {
    type Output = Self;
    #[inline]
    fn div(self, other: Self) -> Self {
        let q = self.hi / other.hi;
        let (hi, lo) = quick_two_sum(q, self.less_product(other, Self::from(q)) / other.hi);
        Self { hi, lo }
    }
}

/// The rounded sum and its exact error.
#[inline]
pub(super) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let bb = s - a;
    (s, (a - (s - bb)) + (b - bb))
}

#[inline]
fn quick_two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    (s, b - (s - a))
}

/// The rounded product and its exact error, if neither overflows nor underflows.
#[inline]
pub(super) fn two_product(a: f64, b: f64) -> (f64, f64) {
    let p = a * b;
    let (ah, al) = split(a);
    let (bh, bl) = split(b);
    (p, ((ah * bh - p) + ah * bl + al * bh) + al * bl)
}

/// Halves of a double with 26 bits each.
#[inline]
fn split(a: f64) -> (f64, f64) {
    let t = 134_217_729.0 * a;
    let hi = t - (t - a);
    (hi, a - hi)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_third_times_three_is_one_to_a_hundred_bits() {
        let third = Double::from(1.0) / Double::from(3.0);
        let error = third * Double::from(3.0) - Double::from(1.0);
        assert!(error.value().abs() < 1e-30);
    }

    #[test]
    fn the_square_of_the_root_of_two_is_two() {
        let root = Double::from(2.0).sqrt();
        let error = root * root - Double::from(2.0);
        assert!(error.value().abs() < 1e-30);
        assert_eq!(Double::from(-1.0).sqrt(), Double::ZERO);
    }

    #[test]
    fn differences_of_far_doubles_keep_everything() {
        let d = Double::difference(1e20, 1e-20) + Double::from(-1e20);
        assert_eq!(d.value(), -1e-20);
    }
}
