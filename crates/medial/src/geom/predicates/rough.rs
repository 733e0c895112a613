//! Elements of a tower in doubles with a bound on the error, which decides all signs but near ties.

use std::cmp::Ordering;

use dashu_int::{IBig, Sign};

use crate::geom::U;

/// Bits of a word of an integer.
const WORD: usize = dashu_int::Word::BITS as usize;

/// Exponents beyond this are not represented: larger numbers become infinite, which decides nothing,
/// and smaller ones zero, within [`TINY`].
const RANGE: i64 = 900;

/// More than what is lost when a number below the range is taken for zero.
const TINY: f64 = f64::from_bits((1023 - 800) << 52);

/// A number within `error` of `value`; a value or an error that is infinite or NaN decides nothing.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rough {
    pub(super) value: f64,
    pub(super) error: f64,
}

/// A number with a separate power of two.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scaled {
    rough: Rough,
    exponent: i64,
}

impl Rough {
    /// The sign of an element given by its coefficients, if the doubles can tell.
    pub(super) fn sign(coefficients: &[IBig], roots: &[Self]) -> Option<Ordering> {
        let Self { value, error } = Self::of(coefficients, roots, excess(coefficients));
        if value > error {
            Some(Ordering::Greater)
        } else if value < -error {
            Some(Ordering::Less)
        } else {
            None
        }
    }

    /// An element divided by a power of two: as many words as are dropped.
    pub(super) fn of(coefficients: &[IBig], roots: &[Self], dropped: usize) -> Self {
        if let [value] = coefficients {
            let value = rounded(value, dropped);
            return Self { value, error: 4.0 * U * value.abs() + TINY };
        }
        let (low, high) = coefficients.split_at(coefficients.len() / 2);
        let low = Self::of(low, roots, dropped);
        if high.iter().all(IBig::is_zero) {
            return low;
        }
        let root = roots[high.len().trailing_zeros() as usize];
        let high = Self::of(high, roots, dropped);
        let product = high.value * root.value;
        let value = low.value + product;
        // The errors of the parts, and twice the roundings of the product and the sum.
        let error = low.error
            + high.error * (root.value + root.error)
            + high.value.abs() * root.error
            + 2.0 * U * (product.abs() + value.abs());
        Self { value, error: error * (1.0 + 16.0 * U) }
    }

    /// An element with a power of two of its own.
    pub(super) fn scaled(coefficients: &[IBig], roots: &[Self]) -> Scaled {
        let dropped = excess(coefficients);
        Scaled { rough: Self::of(coefficients, roots, dropped), exponent: (dropped * WORD) as i64 }
    }

    /// The square root of a number known to be positive.
    pub(super) fn root(self) -> Self {
        if self.value > 2.0 * self.error {
            let value = self.value.sqrt();
            Self { value, error: self.error / value + 2.0 * U * value }
        } else {
            Self { value: 0.0, error: f64::INFINITY }
        }
    }
}

impl Scaled {
    /// The quotient by a positive number.
    pub(super) fn quotient(self, divisor: Self) -> Self {
        let (a, b) = (self.rough, divisor.rough);
        let value = a.value / b.value;
        let error = (a.error + value.abs() * b.error) / (b.value - b.error) + 2.0 * U * value.abs();
        let error = if b.value > b.error { error * (1.0 + 16.0 * U) } else { f64::INFINITY };
        Self { rough: Rough { value, error }, exponent: self.exponent - divisor.exponent }
    }

    /// The product with a positive number.
    pub(super) fn product(self, other: Self) -> Self {
        let (a, b) = (self.rough, other.rough);
        let value = a.value * b.value;
        let error = a.value.abs() * b.error + a.error * (b.value + b.error) + 2.0 * U * value.abs();
        let rough = Rough { value, error: error * (1.0 + 16.0 * U) };
        Self { rough, exponent: self.exponent + other.exponent }
    }

    /// The square root of a number known to be positive.
    pub(super) fn root(self) -> Self {
        // The exponent is a multiple of 64.
        Self { rough: self.rough.root(), exponent: self.exponent / 2 }
    }

    /// The number times one more power of two.
    pub(super) fn times_power(self, exponent: i32) -> Rough {
        let exponent = self.exponent + i64::from(exponent);
        let Rough { value, error } = self.rough;
        if exponent.abs() > RANGE {
            return Rough { value: 0.0, error: f64::INFINITY };
        }
        let power = power(exponent);
        Rough { value: value * power, error: error * power + TINY }
    }
}

/// Words to drop from coefficients so that the largest keeps at most about 450 bits.
fn excess(coefficients: &[IBig]) -> usize {
    let words = |c: &IBig| c.as_sign_words().1.len();
    coefficients.iter().map(words).max().unwrap_or(0).saturating_sub(7)
}

/// An integer divided by a power of two: as many words as are dropped.
fn rounded(value: &IBig, dropped: usize) -> f64 {
    let (sign, words) = value.as_sign_words();
    let magnitude = match *words {
        [] => return 0.0,
        [only] => only as f64,
        // What follows the two upper words is less than 2^-63 of them.
        [.., second, first] => first as f64 + second as f64 * power(-(WORD as i64)),
    };
    let exponent = (words.len() as i64 - 1 - dropped as i64) * WORD as i64;
    let magnitude = if exponent > RANGE {
        f64::INFINITY
    } else if exponent < -RANGE {
        0.0
    } else {
        magnitude * power(exponent)
    };
    if sign == Sign::Negative { -magnitude } else { magnitude }
}

/// Two to the given exponent, which a double holds.
fn power(exponent: i64) -> f64 {
    f64::from_bits(((1023 + exponent) as u64) << 52)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn root_of_two() -> Rough {
        Rough::of(&[IBig::from(2)], &[], 0).root()
    }

    #[test]
    fn small_differences_of_long_numbers_are_left_open() {
        // 10^40·√2 against its integer part: the difference is below 1.
        let digits: IBig = IBig::from(14_142_135_623_730_950_488u128) * IBig::from(10u128.pow(21))
            + IBig::from(16_887_242_096_980_785_696u128) * IBig::from(10u8);
        let power = IBig::from(10u128.pow(20)) * IBig::from(10u128.pow(20));
        assert_eq!(Rough::sign(&[-&digits, power.clone()], &[root_of_two()]), None);
        let larger = digits * IBig::from(1_000_001) / IBig::from(1_000_000);
        assert_eq!(Rough::sign(&[-larger, power], &[root_of_two()]), Some(Ordering::Less));
    }

    #[test]
    fn numbers_of_any_length_have_a_sign() {
        for bits in [0, 1, 63, 64, 65, 500, 5000, 50_000] {
            let value = IBig::ONE << bits;
            let two = &value << 1;
            let less = [-&two, value.clone()];
            assert_eq!(Rough::sign(&less, &[root_of_two()]), Some(Ordering::Less), "{bits}");
            let greater = [-&value, value];
            assert_eq!(Rough::sign(&greater, &[root_of_two()]), Some(Ordering::Greater), "{bits}");
        }
    }

    #[test]
    fn roots_too_long_for_a_double_decide_nothing() {
        let root = Rough::of(&[IBig::ONE << 3000], &[], 0).root();
        assert_eq!(Rough::sign(&[IBig::from(-1), IBig::ONE], &[root]), None);
    }
}
