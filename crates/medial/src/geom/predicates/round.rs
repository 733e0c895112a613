//! The doubles next to the exact centre and radius.

use dashu_int::ops::{BitTest, DivRem, SquareRoot};
use dashu_int::{IBig, Sign};

use super::grid::{Grid, integer};
use super::homogeneous::{Homogeneous, Radius};
use super::tower::{Surd, Tower};
use crate::geom::Point;

impl Homogeneous {
    /// The centre and the radius, each coordinate rounded to the nearest double, or to the next one
    /// where that is too close to call.
    pub(super) fn nearest(&self) -> (Point, f64) {
        let Grid { origin, unit } = self.grid;
        let from_zero = |local: &Surd, origin: f64| self.w.scale(&integer(origin, unit)).add(local);
        let (x, y) = (from_zero(&self.x, origin.x), from_zero(&self.y, origin.y));
        let (Radius::Over { part, n } | Radius::Times { part, n }) = &self.radius;
        let mut results = [Rounding::default(); 3];
        let mut bits = FIRST_BITS;
        loop {
            let roots = Interval::roots(&self.tower, bits);
            let enclose = |number: &Surd| Interval::enclose(number.coefficients(), &roots, bits);
            let w = enclose(&self.w);
            for (number, result) in [&x, &y, part].into_iter().zip(&mut results) {
                if result.value.is_some() {
                    continue;
                }
                let quotient = if !std::ptr::eq(number, part) {
                    enclose(number).quotient(&w, unit)
                } else {
                    let root = Interval::root(n << bits, n << bits, bits);
                    match &self.radius {
                        Radius::Over { .. } => {
                            enclose(number).shifted(bits).quotient(&w.mul(&root), unit)
                        }
                        Radius::Times { .. } => {
                            enclose(number).mul(&root).quotient(&w.shifted(bits), unit)
                        }
                    }
                };
                if let Some((low, high)) = quotient {
                    result.narrow(low, high, || self.tower.sign(number).is_eq());
                }
            }
            if let [Some(x), Some(y), Some(r)] = results.map(|result| result.value) {
                return (Point::new(x, y), r);
            }
            bits *= 2;
        }
    }
}

/// Fractional bits of the first attempt, which fixes all coordinates but those close to zero or to the
/// middle of two doubles.
const FIRST_BITS: usize = 64;

/// The search for the double nearest to a number, by bounds that close in on it.
///
/// Enough bits separate a number that is not zero from zero and, unless it is the middle of two doubles,
/// decide its rounding. Two attempts that see only two neighbours settle the rest.
#[derive(Clone, Copy, Debug, Default)]
struct Rounding {
    value: Option<f64>,
    not_zero: bool,
    neighbours: bool,
}

impl Rounding {
    /// Takes the rounded ends of bounds on the number.
    fn narrow(&mut self, low: f64, high: f64, is_zero: impl FnOnce() -> bool) {
        if low == high {
            self.value = Some(low);
            return;
        }
        if !self.not_zero && low <= 0.0 && high >= 0.0 {
            if is_zero() {
                self.value = Some(0.0);
                return;
            }
            self.not_zero = true;
        }
        if low.next_up() == high {
            if self.neighbours {
                self.value = Some(low);
            }
            self.neighbours = true;
        }
    }
}

/// Two integers around a number times a power of two.
struct Interval {
    low: IBig,
    high: IBig,
}

impl Interval {
    /// Encloses every root of a tower, times `2^bits`.
    fn roots(tower: &Tower, bits: usize) -> Vec<Self> {
        let mut roots = Vec::with_capacity(tower.radicands().len());
        for radicand in tower.radicands() {
            let square = Self::enclose(radicand.coefficients(), &roots, bits);
            roots.push(Self::root(square.low, square.high, bits));
        }
        roots
    }

    /// Encloses the root of a number between the bounds, which are times `2^bits` as it is.
    fn root(low: IBig, high: IBig, bits: usize) -> Self {
        let root = |bound: IBig| match (bound << bits).into_parts() {
            (Sign::Positive, magnitude) => IBig::from(magnitude.sqrt()),
            (Sign::Negative, _) => IBig::ZERO,
        };
        Self { low: root(low), high: root(high) + IBig::ONE }
    }

    /// Encloses an element given by its coefficients, times `2^bits`.
    fn enclose(coefficients: &[IBig], roots: &[Self], bits: usize) -> Self {
        if let [value] = coefficients {
            let value = value << bits;
            return Self { low: value.clone(), high: value };
        }
        let (low, high) = coefficients.split_at(coefficients.len() / 2);
        let level = high.len().trailing_zeros() as usize;
        let rest = Self::enclose(low, roots, bits);
        if high.iter().all(IBig::is_zero) {
            return rest;
        }
        let product = Self::enclose(high, roots, bits).mul(&roots[level]);
        // The shift rounds down.
        Self {
            low: rest.low + (product.low >> bits),
            high: rest.high + (product.high >> bits) + IBig::ONE,
        }
    }

    /// The product with a number that is not negative.
    fn mul(&self, other: &Self) -> Self {
        let is_negative = |bound: &IBig| bound.sign() == Sign::Negative;
        let for_low = if is_negative(&self.low) { &other.high } else { &other.low };
        let for_high = if is_negative(&self.high) { &other.low } else { &other.high };
        Self { low: &self.low * for_low, high: &self.high * for_high }
    }

    /// The product with a power of two.
    fn shifted(&self, bits: usize) -> Self {
        Self { low: &self.low << bits, high: &self.high << bits }
    }

    /// The rounded ends of the quotient times `2^unit`, once the divisor is clear of zero.
    fn quotient(&self, divisor: &Self, unit: i32) -> Option<(f64, f64)> {
        if divisor.low.sign() == Sign::Negative || divisor.low.is_zero() {
            return None;
        }
        let (for_low, for_high) = match (self.low.sign(), self.high.sign()) {
            (Sign::Positive, _) => (&divisor.high, &divisor.low),
            (Sign::Negative, Sign::Negative) => (&divisor.low, &divisor.high),
            (Sign::Negative, Sign::Positive) => (&divisor.low, &divisor.low),
        };
        Some((rounded(&self.low, for_low, unit), rounded(&self.high, for_high, unit)))
    }
}

/// `numerator/denominator·2^unit` rounded to the nearest double, for a positive denominator.
fn rounded(numerator: &IBig, denominator: &IBig, unit: i32) -> f64 {
    if numerator.is_zero() {
        return 0.0;
    }
    // A quotient of 65 or 66 bits, its last bit set if anything is left over.
    let shift = 66 + denominator.bit_len() as i64 - numerator.bit_len() as i64;
    let (sign, magnitude) = numerator.clone().into_parts();
    let (_, divisor) = denominator.clone().into_parts();
    let (quotient, rest) = if shift >= 0 {
        (magnitude << shift as usize).div_rem(divisor)
    } else {
        magnitude.div_rem(divisor << -shift as usize)
    };
    let bits = u128::try_from(quotient).unwrap_or(0) | u128::from(!rest.is_zero());
    let value = scaled(bits as f64, i64::from(unit) - shift);
    if sign == Sign::Negative { -value } else { value }
}

/// `value·2^exponent`.
fn scaled(mut value: f64, exponent: i64) -> f64 {
    // Beyond this range every double of a quotient above has become zero or infinite.
    let mut exponent = exponent.clamp(-2200, 2200);
    while exponent != 0 {
        let step = exponent.clamp(-1000, 1000);
        value *= f64::from_bits(((1023 + step) as u64) << 52);
        exponent -= step;
    }
    value
}
