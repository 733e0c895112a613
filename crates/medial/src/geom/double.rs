//! Arithmetic on unevaluated sums of two doubles, about 106 bits.
//!
//! A product and its error take 17 operations, or two where the machine multiplies and adds at once.
//! Both give the same bits, so what is computed often is compiled for either and chooses by
//! [`Fused::detect`].

use std::ops::{Add, Div, Mul, Neg, Sub};

/// An unevaluated sum `hi + lo` with `|lo|` at most half an ulp of `hi`.
///
/// Each operation is right to about 2^-100 of its result (a difference: of its operands).
pub type Double = Doubled<false>;

/// A [`Double`]; `FUSED` tells whether to multiply and add at once, which only functions should that
/// are compiled for machines which can.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Doubled<const FUSED: bool> {
    hi: f64,
    lo: f64,
}

/// Witness that the machine multiplies and adds at once.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fused(());

impl Fused {
    /// The witness, if it is so.
    #[inline]
    pub fn detect() -> Option<Self> {
        #[cfg(target_arch = "x86_64")]
        if std::arch::is_x86_feature_detected!("fma") {
            return Some(Self(()));
        }
        None
    }
}

impl<const FUSED: bool> Doubled<FUSED> {
    /// Zero.
    pub const ZERO: Self = Self { hi: 0.0, lo: 0.0 };

    /// The same number, to be computed with in that way.
    #[inline(always)]
    pub(crate) const fn cast<const OTHER: bool>(self) -> Doubled<OTHER> {
        Doubled { hi: self.hi, lo: self.lo }
    }

    /// The rounded product and its exact error, if neither overflows nor underflows.
    #[inline(always)]
    fn product(a: f64, b: f64) -> (f64, f64) {
        if FUSED {
            let p = a * b;
            (p, a.mul_add(b, -p))
        } else {
            two_product(a, b)
        }
    }

    /// The difference of two doubles, without error.
    #[inline(always)]
    #[must_use]
    pub fn difference(a: f64, b: f64) -> Self {
        let (hi, lo) = two_sum(a, -b);
        Self { hi, lo }
    }

    /// The nearest double.
    #[inline(always)]
    #[must_use]
    pub const fn value(self) -> f64 {
        self.hi
    }

    /// The square root; 0 for anything not positive.
    #[inline(always)]
    #[must_use]
    pub fn sqrt(self) -> Self {
        if self.hi <= 0.0 {
            return Self::ZERO;
        }
        let root = self.hi.sqrt();
        let (p, e) = Self::product(root, root);
        // The first difference is exact.
        let rest = ((self.hi - p) - e + self.lo) / (2.0 * root);
        let (hi, lo) = quick_two_sum(root, rest);
        Self { hi, lo }
    }

    /// The difference, right to about 2^-100 of the larger operand only.
    #[inline(always)]
    #[must_use]
    pub fn minus(self, other: Self) -> Self {
        let (s, e) = two_sum(self.hi, -other.hi);
        let (hi, lo) = quick_two_sum(s, e + (self.lo - other.lo));
        Self { hi, lo }
    }

    /// `a * b + c * d`, right to about 2^-100 of the larger product.
    #[inline(always)]
    #[must_use]
    pub fn sum_of_products(a: Self, b: Self, c: Self, d: Self) -> Self {
        let (p, e) = Self::product(a.hi, b.hi);
        let (q, f) = Self::product(c.hi, d.hi);
        let (s, g) = two_sum(p, q);
        let cross = (a.hi * b.lo + a.lo * b.hi) + (c.hi * d.lo + c.lo * d.hi);
        let (hi, lo) = quick_two_sum(s, g + (e + f + cross));
        Self { hi, lo }
    }

    /// `self - a * b`, rounded about once where both agree in their first digits.
    #[inline(always)]
    #[must_use]
    pub fn less_product(self, a: Self, b: Self) -> f64 {
        let (p, e) = Self::product(a.hi, b.hi);
        (self.hi - p) + (self.lo - e - (a.hi * b.lo + a.lo * b.hi))
    }
}

impl<const FUSED: bool> From<f64> for Doubled<FUSED> {
    #[inline(always)]
    fn from(value: f64) -> Self {
        Self { hi: value, lo: 0.0 }
    }
}

impl<const FUSED: bool> Add for Doubled<FUSED> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        let (s, e) = two_sum(self.hi, other.hi);
        let (t, f) = two_sum(self.lo, other.lo);
        let (s, e) = quick_two_sum(s, e + t);
        let (hi, lo) = quick_two_sum(s, e + f);
        Self { hi, lo }
    }
}

impl<const FUSED: bool> Neg for Doubled<FUSED> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

impl<const FUSED: bool> Sub for Doubled<FUSED> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl<const FUSED: bool> Mul for Doubled<FUSED> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let (p, e) = Self::product(self.hi, other.hi);
        let (hi, lo) = quick_two_sum(p, e + (self.hi * other.lo + self.lo * other.hi));
        Self { hi, lo }
    }
}

impl<const FUSED: bool> Div for Doubled<FUSED> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let q = self.hi / other.hi;
        let (hi, lo) = quick_two_sum(q, self.less_product(other, Self::from(q)) / other.hi);
        Self { hi, lo }
    }
}

/// The rounded sum and its exact error.
#[inline(always)]
pub(super) fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let bb = s - a;
    (s, (a - (s - bb)) + (b - bb))
}

#[inline(always)]
fn quick_two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    (s, b - (s - a))
}

/// The rounded product and its exact error, if neither overflows nor underflows.
#[inline(always)]
pub(super) fn two_product(a: f64, b: f64) -> (f64, f64) {
    let p = a * b;
    let (ah, al) = split(a);
    let (bh, bl) = split(b);
    (p, ((ah * bh - p) + ah * bl + al * bh) + al * bl)
}

/// Halves of a double with 26 bits each.
#[inline(always)]
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

    #[test]
    fn products_are_the_same_whichever_way_they_are_computed() {
        fn all<const FUSED: bool>(a: f64, b: f64) -> [Doubled<FUSED>; 4] {
            let (a, b) = (Doubled::<FUSED>::from(a), Doubled::<FUSED>::from(b));
            let (root, share) = (a.sqrt(), b / a);
            [root, share, root * share, Doubled::sum_of_products(root, b, share, a)]
        }
        let mut state = 1_u64;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 11) as f64 * 2.0_f64.powi((state >> 5) as i32 % 60 - 60)
        };
        for _ in 0..1000 {
            let (a, b) = (next() + 1.0, next());
            assert_eq!(all::<false>(a, b), all::<true>(a, b).map(Doubled::cast));
        }
    }
}
