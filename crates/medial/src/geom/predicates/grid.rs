//! Doubles as integers: multiples of one power of two, relative to a local origin.

use dashu_int::IBig;

use crate::geom::Point;

/// A vector with integer components.
#[derive(Clone, Debug)]
pub(super) struct Vector {
    pub(super) x: IBig,
    pub(super) y: IBig,
}

impl Vector {
    pub(super) fn dot(&self, other: &Self) -> IBig {
        &self.x * &other.x + &self.y * &other.y
    }

    pub(super) fn cross(&self, other: &Self) -> IBig {
        &self.x * &other.y - &self.y * &other.x
    }

    pub(super) fn norm2(&self) -> IBig {
        self.dot(self)
    }

    /// The vector turned by a quarter turn to the left.
    pub(super) fn perp(&self) -> Self {
        Self { x: -&self.y, y: self.x.clone() }
    }

    pub(super) fn sub(&self, other: &Self) -> Self {
        Self { x: &self.x - &other.x, y: &self.y - &other.y }
    }

    pub(super) fn is_zero(&self) -> bool {
        self.x.is_zero() && self.y.is_zero()
    }

    /// A short positive multiple of the same direction: a unit vector if it is axis-parallel, and
    /// otherwise without common factors of two.
    pub(super) fn direction(self) -> Self {
        match (self.x.trailing_zeros(), self.y.trailing_zeros()) {
            (Some(x), Some(y)) => {
                let common = x.min(y);
                Self { x: self.x >> common, y: self.y >> common }
            }
            _ => Self { x: self.x.signum(), y: self.y.signum() },
        }
    }
}

/// The integer grid of spacing `2^unit` around an origin.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grid {
    /// A point of the grid.
    pub(super) origin: Point,
    /// No point converted has a bit below this exponent.
    pub(super) unit: i32,
}

impl Grid {
    /// The coarsest grid around an origin that holds all the given points.
    pub(super) fn new(origin: Point, points: &[Point]) -> Self {
        Self { origin, unit: finest(origin) }.refined(points)
    }

    /// The same grid, made as fine as the given points need.
    pub(super) fn refined(self, points: &[Point]) -> Self {
        let unit = points.iter().map(|&p| finest(p)).fold(self.unit, i32::min);
        Self { origin: self.origin, unit }
    }

    /// The same grid, with a unit no coarser than the given one.
    pub(super) fn at_most(self, unit: i32) -> Self {
        Self { origin: self.origin, unit: self.unit.min(unit) }
    }

    /// The difference of two points of the grid.
    pub(super) fn difference(self, from: Point, to: Point) -> Vector {
        Vector { x: difference(from.x, to.x, self.unit), y: difference(from.y, to.y, self.unit) }
    }

    /// A point of the grid relative to the origin.
    pub(super) fn local(self, point: Point) -> Vector {
        self.difference(self.origin, point)
    }
}

/// A vector with components of one machine word.
#[derive(Clone, Copy, Debug)]
pub(super) struct Integers {
    pub(super) x: i64,
    pub(super) y: i64,
}

impl Integers {
    pub(super) fn dot(self, other: Self) -> i128 {
        i128::from(self.x) * i128::from(other.x) + i128::from(self.y) * i128::from(other.y)
    }

    pub(super) fn cross(self, other: Self) -> i128 {
        i128::from(self.x) * i128::from(other.y) - i128::from(self.y) * i128::from(other.x)
    }

    pub(super) fn minus(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y }
    }

    /// A short positive multiple of the same direction: a unit vector if it is axis-parallel.
    pub(super) fn direction(self) -> Self {
        if self.x == 0 || self.y == 0 {
            Self { x: self.x.signum(), y: self.y.signum() }
        } else {
            let common = (self.x | self.y).trailing_zeros();
            Self { x: self.x >> common, y: self.y >> common }
        }
    }
}

/// Points relative to an origin, in multiples of some power of two, if all coordinates are below
/// `2^bits` in magnitude, with at most 62 bits.
pub(super) fn integers<const N: usize>(
    origin: Point,
    points: [Point; N],
    bits: u32,
) -> Option<[Integers; N]> {
    if let Some(result) = whole_numbers(origin, &points, bits) {
        return Some(result);
    }
    let Grid { unit, .. } = Grid::new(origin, &points);
    let (x, y) = (small(origin.x, unit)?, small(origin.y, unit)?);
    let mut result = [Integers { x: 0, y: 0 }; N];
    let limit = 1i128 << bits;
    for (local, point) in result.iter_mut().zip(points) {
        let (dx, dy) = (small(point.x, unit)? - x, small(point.y, unit)? - y);
        if dx.abs() >= limit || dy.abs() >= limit {
            return None;
        }
        *local = Integers { x: dx as i64, y: dy as i64 };
    }
    Some(result)
}

/// The same where all coordinates are whole numbers as they stand.
#[inline]
fn whole_numbers<const N: usize>(
    origin: Point,
    points: &[Point; N],
    bits: u32,
) -> Option<[Integers; N]> {
    const LARGEST: f64 = (1_u64 << 53) as f64;
    let whole = |value: f64| {
        let integer = value as i64;
        (integer as f64 == value && value.abs() <= LARGEST).then_some(integer)
    };
    let (x, y) = (whole(origin.x)?, whole(origin.y)?);
    let limit = 1_i64 << bits;
    let mut result = [Integers { x: 0, y: 0 }; N];
    for (local, point) in result.iter_mut().zip(points) {
        let (dx, dy) = (whole(point.x)? - x, whole(point.y)? - y);
        if dx.abs() >= limit || dy.abs() >= limit {
            return None;
        }
        *local = Integers { x: dx, y: dy };
    }
    Some(result)
}

/// The exponent of the lowest bit set in either coordinate.
pub(super) fn finest(point: Point) -> i32 {
    let exponent = |value: f64| {
        let (mantissa, exponent) = decompose(value);
        // Zero lies on every grid.
        if mantissa == 0 { i32::MAX } else { exponent + mantissa.trailing_zeros() as i32 }
    };
    exponent(point.x).min(exponent(point.y))
}

/// `to - from` in multiples of `2^unit`, which both must be.
fn difference(from: f64, to: f64, unit: i32) -> IBig {
    match (small(from, unit), small(to, unit)) {
        (Some(from), Some(to)) => IBig::from(to - from),
        _ => integer(to, unit) - integer(from, unit),
    }
}

/// The multiple of `2^unit` if it has at most 126 bits.
fn small(value: f64, unit: i32) -> Option<i128> {
    let (mantissa, exponent) = decompose(value);
    if mantissa == 0 {
        return Some(0);
    }
    let shift = exponent - unit;
    if shift > 126 - 53 {
        return None;
    }
    let mantissa = i128::from(mantissa);
    Some(if shift >= 0 { mantissa << shift } else { mantissa >> -shift })
}

/// A multiple of `2^unit` as an integer.
pub(super) fn integer(value: f64, unit: i32) -> IBig {
    let (mantissa, exponent) = decompose(value);
    if mantissa == 0 {
        return IBig::ZERO;
    }
    let shift = exponent - unit;
    let mantissa = IBig::from(mantissa);
    if shift >= 0 { mantissa << shift as usize } else { mantissa >> -shift as usize }
}

/// A finite double as signed mantissa and exponent.
fn decompose(value: f64) -> (i64, i32) {
    let bits = value.to_bits();
    let biased = ((bits >> 52) & 0x7ff) as i32;
    let fraction = (bits & ((1 << 52) - 1)) as i64;
    let (mantissa, exponent) =
        if biased == 0 { (fraction, -1074) } else { (fraction | (1 << 52), biased - 1075) };
    (if bits >> 63 == 0 { mantissa } else { -mantissa }, exponent)
}
