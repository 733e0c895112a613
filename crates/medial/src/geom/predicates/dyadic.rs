//! Disks whose centre and squared radius are short binary fractions: integers answer for them.
//!
//! Axis-parallel edges and corners between them mostly make such disks, and with them nearly all ties
//! that are no accident.

use std::cmp::Ordering;

use super::Element;
use super::grid::{self, Integers};
use super::near::Near;
use super::wide::Wide;
use crate::geom::double::two_sum;
use crate::geom::{Point, U};

/// Binary digits of a centre below the last one of the coordinates.
const DIGITS: i32 = 3;

/// Bits of a coordinate relative to the origin, in units of the last digit.
const BITS: i32 = 40;

/// A disk on a grid: centre `(x, y)` and squared radius in multiples of a power of two and its square.
#[derive(Clone, Copy, Debug)]
pub(super) struct Dyadic {
    grid: Grid,
    centre: Integers,
    square: i128,
}

/// Multiples of a power of two around an origin.
#[derive(Clone, Copy, Debug)]
struct Grid {
    origin: Point,
    /// The power of two.
    unit: f64,
    /// The origin itself, if all coordinates are whole numbers.
    whole: Option<Integers>,
}

/// The distance of an element from a centre.
enum Distance {
    /// Squared.
    Corner(i128),
    /// Signed, times the length of a direction, and the square of that.
    Edge(i128, i128),
}

/// A whole number of moderate size, in units of the last digit.
fn whole(value: f64) -> Option<i64> {
    let whole = value as i64;
    // A conversion saturates, at a number that has no negative.
    (whole as f64 == value && whole.unsigned_abs() < 1 << 52).then_some(whole << DIGITS)
}

/// Two to the given exponent, which a normal double holds.
fn power(exponent: i32) -> Option<f64> {
    (-1000..=1000).contains(&exponent).then(|| f64::from_bits(((1023 + exponent) as u64) << 52))
}

impl Grid {
    fn new(origin: Point, elements: &[Element; 3]) -> Option<Self> {
        let is_whole = |p: Point| whole(p.x).is_some() && whole(p.y).is_some();
        let are_whole = elements.iter().all(|&element| match element {
            Element::Corner(p) => is_whole(p),
            Element::Edge(a, b) => is_whole(a) && is_whole(b),
        });
        if are_whole && is_whole(origin) {
            let whole = Some(Integers { x: whole(origin.x)?, y: whole(origin.y)? });
            return Some(Self { origin, unit: power(-DIGITS)?, whole });
        }
        let points = elements.map(|element| match element {
            Element::Corner(p) => [p, p],
            Element::Edge(a, b) => [a, b],
        });
        let exponent = grid::Grid::new(origin, points.as_flattened()).unit;
        Some(Self { origin, unit: power(exponent - DIGITS)?, whole: None })
    }

    /// A point relative to the origin.
    fn local(&self, p: Point) -> Option<Integers> {
        let fits = |multiple: i64| multiple.unsigned_abs() < 1 << BITS;
        let local = if let Some(origin) = self.whole {
            Integers { x: whole(p.x)? - origin.x, y: whole(p.y)? - origin.y }
        } else {
            let coordinate = |value: f64, origin: f64| {
                let (difference, rest) = two_sum(value, -origin);
                let multiple = difference / self.unit;
                let whole = multiple as i64;
                (rest == 0.0 && whole as f64 == multiple).then_some(whole)
            };
            Integers { x: coordinate(p.x, self.origin.x)?, y: coordinate(p.y, self.origin.y)? }
        };
        (fits(local.x) && fits(local.y)).then_some(local)
    }
}

impl Dyadic {
    /// The disk touching three elements that is known in doubles, if it is such a disk.
    pub(super) fn new(elements: &[Element; 3], near: &Near) -> Option<Self> {
        let Near { origin, centre, radius, error } = *near;
        // Thus at most one such centre is within the error.
        let is_sharp = |unit: f64| error <= unit / 4.0;
        let last = grid::finest(origin).min(BITS);
        if !is_sharp(power(last - DIGITS)?) {
            return None;
        }
        let grid = Grid::new(origin, elements)?;
        let unit = grid.unit;
        if !is_sharp(unit) {
            return None;
        }
        let multiple = |value: f64| {
            let multiple = (value / unit + 0.5f64.copysign(value)) as i64;
            let is_near = (multiple as f64 * unit - value).abs() <= error + U * value.abs();
            (is_near && multiple.unsigned_abs() < 2 << BITS).then_some(multiple)
        };
        let centre = Integers { x: multiple(centre.x)?, y: multiple(centre.y)? };
        let mut disk = Self { grid, centre, square: 0 };
        let [a, b, c] = *elements;
        let distances = [disk.distance(a)?, disk.distance(b)?, disk.distance(c)?];
        disk.square = distances.iter().find_map(|distance| match *distance {
            Distance::Corner(square) => Some(square),
            Distance::Edge(across, 1) => Some(across * across),
            Distance::Edge(..) => None,
        })?;
        let root = (disk.square as f64).sqrt() * unit;
        let is_near = (root - radius).abs() <= error + 8.0 * U * radius;
        let touches = |distance: &Distance| disk.order(distance).is_eq();
        (is_near && disk.square > 0 && distances.iter().all(touches)).then_some(disk)
    }

    /// The way to the centre.
    fn way(&self, from: Point) -> Option<Integers> {
        Some(self.centre.minus(self.grid.local(from)?))
    }

    fn direction(&self, a: Point, b: Point) -> Option<Integers> {
        Some(self.grid.local(b)?.minus(self.grid.local(a)?).direction())
    }

    /// Directions are below 2^41, ways to the centre below 2^42, and products of the two below 2^84.
    fn distance(&self, element: Element) -> Option<Distance> {
        Some(match element {
            Element::Corner(p) => {
                let way = self.way(p)?;
                Distance::Corner(way.dot(way))
            }
            Element::Edge(a, b) => {
                let a = self.grid.local(a)?;
                let direction = self.grid.local(b)?.minus(a).direction();
                let across = direction.cross(self.centre.minus(a));
                Distance::Edge(across, direction.dot(direction))
            }
        })
    }

    fn order(&self, distance: &Distance) -> Ordering {
        match *distance {
            Distance::Corner(square) => square.cmp(&self.square),
            Distance::Edge(across, _) if across < 0 => Ordering::Less,
            Distance::Edge(across, 1) => (across * across).cmp(&self.square),
            Distance::Edge(across, length) => {
                let radius = Wide::product(self.square, length);
                Wide::product(across, across).minus(radius).sign()
            }
        }
    }

    /// The order of the distance of a corner, or the signed one of a line, against the radius.
    pub(super) fn side(&self, element: Element) -> Option<Ordering> {
        Some(self.order(&self.distance(element)?))
    }

    /// The sign of `(b - a)·(c - p)`.
    pub(super) fn along(&self, a: Point, b: Point, p: Point) -> Option<Ordering> {
        Some(self.direction(a, b)?.dot(self.way(p)?).cmp(&0))
    }

    /// The sign of `(b - a)×(c - a)`.
    pub(super) fn front(&self, a: Point, b: Point) -> Option<Ordering> {
        Some(self.direction(a, b)?.cross(self.way(a)?).cmp(&0))
    }

    /// The way to this centre from that of another disk on an equal grid, and the direction from `a`
    /// to `b`.
    pub(super) fn way_from(
        &self,
        other: &Self,
        a: Point,
        b: Point,
    ) -> Option<(Integers, Integers)> {
        if self.grid.unit != other.grid.unit {
            return None;
        }
        Some((self.way(other.grid.origin)?.minus(other.centre), self.direction(a, b)?))
    }
}
