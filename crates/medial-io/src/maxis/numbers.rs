//! Whole numbers in few bytes, and doubles as whole numbers.

/// Appends a number, seven bits a byte, the low ones first; all bytes but the last have the high bit.
pub fn push(bytes: &mut Vec<u8>, mut number: u64) {
    while number >= 0x80 {
        bytes.push(number as u8 | 0x80);
        number >>= 7;
    }
    bytes.push(number as u8);
}

/// The same for numbers of either sign: 0, -1, 1, -2, … are 0, 1, 2, 3, …
pub fn push_signed(bytes: &mut Vec<u8>, number: i64) {
    push(bytes, ((number << 1) ^ (number >> 63)) as u64);
}

/// The number of either sign that was written as this one.
pub fn signed(number: u64) -> i64 {
    (number >> 1) as i64 ^ -((number & 1) as i64)
}

/// What is expected after two numbers: a share of the last step, in quarters, is added to the last one.
pub fn expected(last: i64, before: i64, quarters: u8) -> i64 {
    last.wrapping_add(last.wrapping_sub(before).wrapping_mul(i64::from(quarters)) >> 2)
}

/// How doubles are whole numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Tenths, hundredths and so on: divided by ten to the power of this.
    Decimal(u8),
    /// Multiples of two to the power of this.
    Binary(i16),
    /// The bits of any double, turned so that they have the order of the numbers.
    Bits,
}

/// Most places after the point; powers of ten up to there are doubles.
pub const MOST_PLACES: u8 = 15;

/// Least exponent of a grid of multiples, and the largest.
pub const EXPONENTS: std::ops::RangeInclusive<i16> = -300..=300;

/// Doubles have all whole numbers up to this one.
const LARGEST: f64 = (1_u64 << 53) as f64;

impl Scale {
    /// The scale with the smallest numbers on which all these doubles lie, bit for bit.
    pub fn of(values: impl Iterator<Item = f64> + Clone) -> Self {
        let fits = |scale: Self| {
            let mut values = values.clone();
            values.all(|v| scale.value(scale.number(v)).to_bits() == v.to_bits())
        };
        let decimal = (0..=MOST_PLACES).map(Self::Decimal).find(|&scale| fits(scale));
        let lowest = values.clone().filter(|&v| v != 0.0).map(lowest_bit).min();
        let binary =
            lowest.filter(|e| EXPONENTS.contains(e)).map(Self::Binary).filter(|&scale| fits(scale));
        // Of two, the one with fewer digits.
        match (decimal, binary) {
            (Some(Self::Decimal(places)), Some(Self::Binary(exponent))) => {
                let finer = f64::from(places) * std::f64::consts::LOG2_10 > -f64::from(exponent);
                if finer { Self::Binary(exponent) } else { Self::Decimal(places) }
            }
            (Some(scale), _) | (None, Some(scale)) => scale,
            (None, None) => Self::Bits,
        }
    }

    /// The whole number of a double.
    pub fn number(self, value: f64) -> i64 {
        let whole = |v: f64| if v.abs() <= LARGEST { v.round() as i64 } else { 0 };
        match self {
            Self::Decimal(places) => whole(value * power_of_ten(places)),
            Self::Binary(exponent) => whole(value * power_of_two(-exponent)),
            Self::Bits => {
                let bits = value.to_bits() as i64;
                bits ^ (bits >> 63 & i64::MAX)
            }
        }
    }

    /// The double of a whole number.
    pub fn value(self, number: i64) -> f64 {
        match self {
            Self::Decimal(places) => number as f64 / power_of_ten(places),
            Self::Binary(exponent) => number as f64 * power_of_two(exponent),
            Self::Bits => f64::from_bits((number ^ (number >> 63 & i64::MAX)) as u64),
        }
    }
}

/// The exponent of the lowest bit of a double that is set.
fn lowest_bit(value: f64) -> i16 {
    let bits = value.to_bits();
    let (exponent, fraction) = ((bits >> 52 & 0x7ff) as i16, bits & ((1 << 52) - 1));
    // Of numbers that are too small, infinite or none, something out of range.
    let zeros = if fraction == 0 { 52 } else { fraction.trailing_zeros() as i16 };
    exponent - 1075 + zeros
}

fn power_of_ten(places: u8) -> f64 {
    // An exact double up to 10^22; the product of exact doubles is exact.
    (0..places).fold(1.0, |power, _| 10.0 * power)
}

fn power_of_two(exponent: i16) -> f64 {
    2.0_f64.powi(exponent.into())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_either_sign_come_back() {
        for number in [0, 1, -1, 63, -64, 64, i64::MAX, i64::MIN] {
            let mut bytes = Vec::new();
            push_signed(&mut bytes, number);
            let read = bytes.iter().rev().fold(0_u64, |n, b| n << 7 | u64::from(b & 0x7f));
            assert_eq!(signed(read), number);
            assert!(number.unsigned_abs() > 64 || bytes.len() == 1 || number == 64);
        }
    }

    #[test]
    fn doubles_find_their_scale() {
        let of = |values: &[f64]| Scale::of(values.iter().copied());
        assert_eq!(of(&[3.0, -7.0, 0.0]), Scale::Decimal(0));
        assert_eq!(of(&[3.25, 1e6]), Scale::Binary(-2));
        assert_eq!(of(&[1542.618, -3.1]), Scale::Decimal(3));
        assert_eq!(of(&[1.0 / 3.0, 1e-3]), Scale::Bits);
        assert_eq!(of(&[-0.0, 1.0]), Scale::Bits);
        assert_eq!(of(&[f64::INFINITY, 1.0]), Scale::Bits);
        for value in [0.1, -0.1, 1.0 / 3.0, 1e-300, -0.0, f64::MAX, 12345.678, 2.0_f64.powi(-40)] {
            let scale = of(&[value, 2.0]);
            assert_eq!(scale.value(scale.number(value)).to_bits(), value.to_bits(), "{scale:?}");
        }
    }

    #[test]
    fn bits_have_the_order_of_the_numbers() {
        let ordered = [-1e9, -1.0, -0.0, 0.0, 1e-9, 7.0];
        assert!(ordered.map(|v| Scale::Bits.number(v)).is_sorted_by(|a, b| a < b));
    }
}
