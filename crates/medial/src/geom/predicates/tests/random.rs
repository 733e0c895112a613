//! Reproducible points and elements of many kinds.

use crate::geom::Point;
use crate::geom::predicates::Element;

/// A small generator (xorshift), so that every run sees the same cases.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1)
    }

    pub fn bits(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    pub fn below(&mut self, n: u64) -> u64 {
        (self.bits() >> 11) % n
    }

    /// Uniform in -1 to 1, with a full mantissa.
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

/// The families of coordinates the tests run over.
#[derive(Clone, Copy, Debug)]
pub enum Family {
    /// Full mantissas around the origin.
    Full,
    /// Full mantissas around a far place.
    Offset,
    /// Degrees with seven decimals.
    Degrees,
    /// Small integers: many exact ties.
    Small,
    /// Integers of 24 bits.
    Grid,
    /// Exponents that vary between points.
    Scales,
}

impl Family {
    pub const ALL: [Self; 6] =
        [Self::Full, Self::Offset, Self::Degrees, Self::Small, Self::Grid, Self::Scales];

    pub fn point(self, random: &mut Random) -> Point {
        let mut pair = |f: &mut dyn FnMut(&mut Random) -> f64| Point::new(f(random), f(random));
        match self {
            Self::Full => pair(&mut Random::unit),
            Self::Offset => pair(&mut |r| 2e7 + r.unit()),
            Self::Degrees => {
                pair(&mut |r| (7.0 + r.below(2000) as f64 * 1e-7 * 1e7).round() / 1e7 + 47.0)
            }
            Self::Small => pair(&mut |r| r.below(7) as f64 - 3.0),
            Self::Grid => pair(&mut |r| r.below(1 << 24) as f64),
            Self::Scales => pair(&mut |r| {
                let exponent = r.below(60) as i32 - 30;
                r.unit() * 2f64.powi(exponent)
            }),
        }
    }

    pub fn element(self, random: &mut Random, corner: bool) -> Element {
        if corner {
            Element::Corner(self.point(random))
        } else {
            Element::Edge(self.point(random), self.point(random))
        }
    }
}
