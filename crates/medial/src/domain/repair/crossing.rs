//! Where two edges cross, rounded from the exact place.

use dashu_int::IBig;
use dashu_int::ops::{BitTest as _, UnsignedAbs as _};

use crate::geom::Point;

/// Coordinates other than 0 below this are taken for 0: a domain has none of them.
pub(super) const LEAST: f64 = 1.0 / 1.606_938_044_258_990_3e60;

/// Bits of a quotient before it is rounded to a double, which has 53.
const BITS: usize = 64;

/// The place where two edges cross, which they do in a point inside both.
pub(super) struct Crossing {
    x: Fraction,
    y: Fraction,
}

/// The quotient of two whole numbers, of which the second one is positive, times a power of two.
struct Fraction {
    numerator: IBig,
    denominator: IBig,
    exponent: i32,
}

impl Crossing {
    pub(super) fn of([a, b]: [Point; 2], [c, d]: [Point; 2]) -> Self {
        let all = [a, b, c, d].map(|p| [p.x, p.y]);
        let exponent =
            all.as_flattened().iter().copied().filter_map(exponent_of).min().unwrap_or(0);
        let [a, b, c, d] = all.map(|p| p.map(|v| multiple(v, exponent)));
        let minus = |p: &[IBig; 2], q: &[IBig; 2]| [&p[0] - &q[0], &p[1] - &q[1]];
        let cross = |p: &[IBig; 2], q: &[IBig; 2]| &p[0] * &q[1] - &p[1] * &q[0];
        let (along, other) = (minus(&b, &a), minus(&d, &c));
        let mut denominator = cross(&along, &other);
        let mut share = cross(&minus(&c, &a), &other);
        if denominator < IBig::ZERO {
            (denominator, share) = (-denominator, -share);
        }
        let [x, y] = [0, 1].map(|k| Fraction {
            numerator: &a[k] * &denominator + &share * &along[k],
            denominator: denominator.clone(),
            exponent,
        });
        Self { x, y }
    }

    /// The nearest point with doubles as coordinates.
    pub(super) fn rounded(&self) -> Point {
        let of = |fraction: &Fraction| {
            let value = fraction.rounded();
            if value.abs() < LEAST { 0.0 } else { value }
        };
        Point::new(of(&self.x), of(&self.y))
    }

    /// The nearest point of a grid of multiples of a power of two.
    pub(super) fn on_grid(&self, exponent: i32) -> Point {
        Point::new(self.x.on_grid(exponent), self.y.on_grid(exponent))
    }
}

impl Fraction {
    fn rounded(&self) -> f64 {
        let size = |n: &IBig| n.unsigned_abs().bit_len();
        let shift = (BITS + size(&self.denominator)).saturating_sub(size(&self.numerator));
        let shifted = &self.numerator << shift;
        let (quotient, rest) = divided(&shifted, &self.denominator);
        // What is cut off shows in the last bit, so that the double is the nearest one.
        let sticky = if rest == IBig::ZERO { quotient } else { (quotient << 1) + IBig::ONE };
        let shift = if rest == IBig::ZERO { shift } else { shift + 1 };
        scaled(sticky.to_f64().value(), self.exponent - shift as i32)
    }

    fn on_grid(&self, exponent: i32) -> f64 {
        // Half a cell is added, and the rest cut off.
        let up = (self.exponent - exponent).max(0) as usize;
        let down = (exponent - self.exponent).max(0) as usize;
        let cells = &self.numerator << (up + 1);
        let whole = &self.denominator << down;
        let (quotient, _) = divided(&(cells + &whole), &(whole << 1));
        scaled(quotient.to_f64().value(), exponent)
    }
}

/// The quotient rounded down, and the rest.
fn divided(numerator: &IBig, denominator: &IBig) -> (IBig, IBig) {
    use dashu_int::ops::DivRemEuclid as _;
    let (quotient, rest) = numerator.div_rem_euclid(denominator);
    (quotient, IBig::from(rest))
}

/// The power of two that a double other than 0 is a whole multiple of.
fn exponent_of(value: f64) -> Option<i32> {
    let bits = value.to_bits();
    let exponent = (bits >> 52 & 0x7ff) as i32;
    (exponent > 0).then(|| {
        let mantissa = bits & ((1 << 52) - 1) | 1 << 52;
        exponent - 1075 + mantissa.trailing_zeros() as i32
    })
}

/// A double as a multiple of a power of two, which it is.
fn multiple(value: f64, exponent: i32) -> IBig {
    let Some(own) = exponent_of(value) else { return IBig::ZERO };
    let mantissa = scaled(value, -own) as i64;
    IBig::from(mantissa) << (own - exponent) as usize
}

/// A double times a power of two.
pub(super) fn scaled(value: f64, exponent: i32) -> f64 {
    // In two steps, as the power alone may be out of range.
    let half = exponent / 2;
    let power = |exponent: i32| f64::from_bits(((1023 + i64::from(exponent)) as u64) << 52);
    value * power(half) * power(exponent - half)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(ends: [f64; 8]) -> Crossing {
        let [a, b, c, d, e, f, g, h] = ends;
        let p = Point::new;
        Crossing::of([p(a, b), p(c, d)], [p(e, f), p(g, h)])
    }

    #[test]
    fn places_are_rounded_to_the_nearest_double() {
        let third = of([0.0, 0.0, 3.0, 1.0, 1.0, 0.0, 1.0, 7.0]);
        assert_eq!(third.rounded(), Point::new(1.0, 1.0 / 3.0));
        let thirds = of([0.0, 0.0, -3.0, -2.0, -1.0, 0.0, -1.0, -7.0]);
        assert_eq!(thirds.rounded(), Point::new(-1.0, -2.0 / 3.0));
        // The diagonals of a square of an ulp: in the middle, so to even.
        let ulp = f64::EPSILON;
        let tie = of([1.0, 1.0, 1.0 + ulp, 1.0 + ulp, 1.0, 1.0 + ulp, 1.0 + ulp, 1.0]);
        assert_eq!(tie.rounded(), Point::new(1.0, 1.0));
    }

    #[test]
    fn the_largest_and_the_smallest_numbers_stay_in_range() {
        let s = scaled(1.0, 200);
        let large = of([-s, -s, s, s, -s, s, s, -s]);
        assert_eq!(large.rounded(), Point::new(0.0, 0.0));
        let t = scaled(1.0, -200);
        let small = of([0.0, 0.0, t, t, 0.0, t, t, 0.0]);
        assert_eq!(small.rounded(), Point::new(0.0, 0.0));
        let mixed = of([-t, s, 3.0 * t, s, t, -s, t, s.next_up()]);
        assert_eq!(mixed.rounded(), Point::new(t, s));
    }

    #[test]
    fn on_a_grid_halves_go_up() {
        let third = of([0.0, 0.0, 3.0, 1.0, 1.0, 0.0, 1.0, 7.0]);
        assert_eq!(third.on_grid(-2), Point::new(1.0, 0.25));
        assert_eq!(third.on_grid(2), Point::new(0.0, 0.0));
        let half = of([0.0, 0.0, 2.0, 2.0, 0.0, 1.0, 2.0, 0.0]);
        // (2/3, 2/3) on a grid of ones, and on one of sixteenths.
        assert_eq!(half.on_grid(0), Point::new(1.0, 1.0));
        assert_eq!(half.on_grid(-4), Point::new(0.6875, 0.6875));
        let negative = of([0.0, 0.0, -1.0, -1.0, 0.0, -1.0, -1.0, 0.0]);
        assert_eq!(negative.on_grid(0), Point::new(0.0, 0.0));
    }
}
