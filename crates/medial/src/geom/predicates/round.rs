//! The doubles next to the exact centre and radius.

use std::cmp::Ordering;

use dashu_int::ops::{BitTest, DivRem, SquareRoot};
use dashu_int::{IBig, Sign};

use super::grid::integer;
use super::homogeneous::{Homogeneous, Radius};
use super::tower::{Surd, Tower};
use crate::geom::Point;

impl Homogeneous {
    /// The centre and the radius, each coordinate rounded to the nearest double, or to the next one
    /// where that is too close to call.
    pub(super) fn nearest(&self) -> (Point, f64) {
        let unit = self.grid.unit;
        let origin = self.grid.origin;
        let coordinate = |local: &Surd, origin: f64| {
            let numerator = self.w.scale(&integer(origin, unit)).add(local);
            nearest(&self.tower, &numerator, &self.w, unit)
        };
        let centre = Point::new(coordinate(&self.x, origin.x), coordinate(&self.y, origin.y));
        let mut tower = self.tower.clone();
        let radius = match &self.radius {
            Radius::Over { part, n } => {
                let root = tower.root(Surd::integer(n.clone()));
                let denominator = tower.mul(&self.w, &root);
                nearest(&tower, part, &denominator, unit)
            }
            Radius::Times { part, n } => {
                let root = tower.root(Surd::integer(n.clone()));
                let numerator = tower.mul(part, &root);
                nearest(&tower, &numerator, &self.w, unit)
            }
        };
        (centre, radius)
    }
}

/// The double nearest to `numerator/denominator·2^unit`, for a positive denominator.
fn nearest(tower: &Tower, numerator: &Surd, denominator: &Surd, unit: i32) -> f64 {
    // Enough bits separate a quotient that is not zero from zero and, unless it is the middle of two
    // doubles, decide its rounding. Two attempts that see only two neighbours settle the rest.
    let mut neighbours = false;
    let mut may_be_zero = true;
    let mut bits = 64;
    loop {
        let roots = Interval::roots(tower, bits);
        let above = Interval::enclose(numerator.coefficients(), &roots, bits);
        let below = Interval::enclose(denominator.coefficients(), &roots, bits);
        bits *= 2;
        let Some((low, high)) = above.quotient(&below, unit) else { continue };
        if low == high {
            return low;
        }
        if may_be_zero && low <= 0.0 && high >= 0.0 {
            if tower.sign(numerator) == Ordering::Equal {
                return 0.0;
            }
            may_be_zero = false;
        }
        if low.next_up() == high {
            if neighbours {
                return low;
            }
            neighbours = true;
        }
    }
}

/// Two integers around a number times a power of two.
#[derive(Clone)]
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
            let root = |bound: IBig| match (bound << bits).into_parts() {
                (Sign::Positive, magnitude) => IBig::from(magnitude.sqrt()),
                (Sign::Negative, _) => IBig::ZERO,
            };
            roots.push(Self { low: root(square.low), high: root(square.high) + IBig::ONE });
        }
        roots
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

    fn mul(&self, other: &Self) -> Self {
        let products = [
            &self.low * &other.low,
            &self.low * &other.high,
            &self.high * &other.low,
            &self.high * &other.high,
        ];
        let [first, rest @ ..] = products;
        let mut product = Self { low: first.clone(), high: first };
        for value in rest {
            if value < product.low {
                product.low = value;
            } else if value > product.high {
                product.high = value;
            }
        }
        product
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
