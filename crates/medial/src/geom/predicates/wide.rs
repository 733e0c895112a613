//! Signed integers of 256 bits, as far as the special stages need them.

use std::cmp::Ordering;

use dashu_int::IBig;

use crate::geom::Double;

/// A signed integer of 256 bits in two's complement; sums wrap, so callers bound their terms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Wide {
    high: i128,
    low: u128,
}

impl Wide {
    pub(super) const ZERO: Self = Self { high: 0, low: 0 };

    /// The full product.
    pub(super) fn product(a: i128, b: i128) -> Self {
        let (high, low) = product(a.unsigned_abs(), b.unsigned_abs());
        // The magnitude is at most 2^254.
        let magnitude = Self { high: high as i128, low };
        if (a < 0) == (b < 0) { magnitude } else { magnitude.negated() }
    }

    pub(super) fn plus(self, other: Self) -> Self {
        let (low, carry) = self.low.overflowing_add(other.low);
        let high = self.high.wrapping_add(other.high).wrapping_add(i128::from(carry));
        Self { high, low }
    }

    pub(super) fn minus(self, other: Self) -> Self {
        let (low, borrow) = self.low.overflowing_sub(other.low);
        let high = self.high.wrapping_sub(other.high).wrapping_sub(i128::from(borrow));
        Self { high, low }
    }

    pub(super) fn negated(self) -> Self {
        Self::ZERO.minus(self)
    }

    /// The order against zero.
    pub(super) fn sign(self) -> Ordering {
        self.high.cmp(&0).then(self.low.cmp(&0))
    }

    /// The value as an integer of any size.
    pub(super) fn to_big(self) -> IBig {
        (IBig::from(self.high) << 128) + IBig::from(self.low)
    }

    /// The value to about 104 bits.
    pub(super) fn to_double(self) -> Double {
        let negative = self.high < 0;
        let magnitude = if negative { self.negated() } else { self };
        let high = magnitude.high as u128;
        let value = if high == 0 {
            double(magnitude.low)
        } else {
            // The upper 128 bits, from the first that is set, times their power of two.
            let shift = high.leading_zeros();
            let top =
                if shift == 0 { high } else { high << shift | magnitude.low >> (128 - shift) };
            let power = f64::from_bits(u64::from(1023 + 128 - shift) << 52);
            double(top) * Double::from(power)
        };
        if negative { -value } else { value }
    }
}

/// The value to about 106 bits.
pub(super) fn double(value: u128) -> Double {
    // Three pieces of at most 43 bits, each a double without error; so is the sum of the upper two.
    const MASK: u128 = (1 << 43) - 1;
    let upper = (value >> 85) as u64 as f64 * 2f64.powi(85);
    let middle = ((value >> 42) & MASK) as u64 as f64 * 2f64.powi(42);
    let lower = (value & (MASK >> 1)) as u64 as f64;
    Double::difference(upper, -middle) + Double::from(lower)
}

/// The product in two halves.
fn product(a: u128, b: u128) -> (u128, u128) {
    const MASK: u128 = u64::MAX as u128;
    let (a1, a0, b1, b0) = (a >> 64, a & MASK, b >> 64, b & MASK);
    let low = a0 * b0;
    let cross = a1 * b0 + (low >> 64);
    let other = a0 * b1 + (cross & MASK);
    (a1 * b1 + (cross >> 64) + (other >> 64), other << 64 | (low & MASK))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_square_of_the_smallest_integer_is_two_to_the_254() {
        let square = Wide::product(i128::MIN, i128::MIN);
        assert_eq!(square, Wide { high: 1 << 126, low: 0 });
        assert_eq!(square.to_double().value(), 2f64.powi(254));
    }

    #[test]
    fn products_distribute_over_sums() {
        // (2^100 + 3)(2^90 - 7) = 2^190 - 7·2^100 + 3·2^90 - 21
        let (a, b) = ((1i128 << 100) + 3, (1i128 << 90) - 7);
        let expanded = Wide::product(1 << 100, 1 << 90)
            .minus(Wide::product(7, 1 << 100))
            .plus(Wide::product(3, 1 << 90))
            .minus(Wide::product(3, 7));
        assert_eq!(Wide::product(a, b), expanded);
        assert_eq!(Wide::product(-a, b), expanded.negated());
        assert_eq!(Wide::product(-a, b).plus(expanded), Wide::ZERO);
    }

    #[test]
    fn signs_come_from_either_half() {
        assert_eq!(Wide::ZERO.sign(), Ordering::Equal);
        assert_eq!(Wide::product(1, 1).sign(), Ordering::Greater);
        assert_eq!(Wide::product(-1, 1).sign(), Ordering::Less);
        assert_eq!(Wide::product(-(1 << 100), 1 << 100).sign(), Ordering::Less);
    }

    #[test]
    fn doubles_keep_a_hundred_bits() {
        // 2^200 + 2^110 needs 91 bits: exact in a pair, not in one double.
        let value = Wide::product(1 << 100, 1 << 100).plus(Wide::product(1 << 100, 1 << 10));
        let rest = value.to_double() - Double::from(2f64.powi(200));
        assert_eq!(rest.value(), 2f64.powi(110));
        let rest = value.negated().to_double() + Double::from(2f64.powi(200));
        assert_eq!(rest.value(), -2f64.powi(110));
        assert_eq!(value.negated().to_big(), -(IBig::ONE << 200) - (IBig::ONE << 110));
        assert_eq!(double(u128::MAX).value(), 2f64.powi(128));
    }
}
