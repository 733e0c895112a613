//! A disk in doubles with a bound on its error, which answers all questions but near ties.

use std::cmp::Ordering;

use super::Element;
use super::homogeneous::{Homogeneous, Radius};
use super::rough::Rough;
use super::tower::Surd;
use crate::geom::{Governor, Point, TouchingDisk, U, cross_directions, orient2d};

/// Rounding of a product of two sums of two differences, relative to the sizes of its terms.
///
/// Two differences and a product make 3 or 4 half ulps, the sum of the terms one more; twice that covers
/// the higher orders.
const ROUNDING: f64 = 10.0 * U;

/// More than the length of a vector whose square underflows, and far below any length between doubles
/// with exponents of at most 200 in magnitude.
pub(super) const SHORT: f64 = f64::from_bits((1023 - 480) << 52);

/// A disk, each of its numbers within `error`.
///
/// An infinite error, or one that is not a number, leaves every question open.
#[derive(Clone, Copy, Debug)]
pub(super) struct Near {
    pub(super) origin: Point,
    /// Relative to the origin.
    pub(super) centre: Point,
    pub(super) radius: f64,
    pub(super) error: f64,
}

impl Near {
    /// The disk touching three elements where doubles find one, and whether they alone can prove that
    /// there is one; otherwise its error is infinite.
    pub(super) fn found(elements: &[Element; 3]) -> Option<Self> {
        let (guess, governors) = Self::guessed(elements)?;
        let Self { origin, centre, radius, error } = guess;
        let disk = TouchingDisk { origin, centre, radius, bound: error };
        Some(disk.certified(&governors).map_or(guess, |disk| Self::from(&disk)))
    }

    /// The disk that doubles guess, with an infinite error, and the elements as they compute with them.
    pub(super) fn guessed(elements: &[Element; 3]) -> Option<(Self, [Governor; 3])> {
        let governors = elements.map(|element| match element {
            Element::Corner(p) => Governor::Corner(p),
            Element::Edge(start, end) => {
                let d = end - start;
                let length = d.norm();
                let direction = Point::new(d.x / length, d.y / length);
                Governor::Edge { start, end, direction }
            }
        });
        let near = match elements[0] {
            Element::Corner(p) | Element::Edge(p, _) => p,
        };
        let guess = TouchingDisk::guess(&governors, near)?;
        Some((Self::from(&guess), governors))
    }

    /// Whether there certainly is such a disk.
    pub(super) fn is_certain(&self) -> bool {
        self.error < self.radius
    }

    /// A disk given exactly.
    pub(super) fn new(disk: &Homogeneous) -> Self {
        let rough = |number: &Surd| Rough::scaled(number.coefficients(), disk.tower.roots());
        let root = |n| Rough::scaled(std::slice::from_ref(n), &[]).root();
        let w = rough(&disk.w);
        let quotient = |number| rough(number).quotient(w);
        let radius = match &disk.radius {
            Radius::Over { part, n } => quotient(part).quotient(root(n)),
            Radius::Times { part, n } => quotient(part).product(root(n)),
        };
        let [x, y, r] = [quotient(&disk.x), quotient(&disk.y), radius]
            .map(|number| number.times_power(disk.grid.unit));
        Self {
            origin: disk.grid.origin,
            centre: Point::new(x.value, y.value),
            radius: r.value,
            // The largest of the three would hide one that is not a number.
            error: x.error + y.error + r.error,
        }
    }

    /// Centre and radius, rounded.
    pub(super) fn values(&self) -> (Point, f64) {
        (self.origin + self.centre, self.radius)
    }

    /// The centre relative to a point, and a bound on the error of its coordinates.
    fn centre_from(&self, p: Point) -> (Point, f64) {
        let local = p - self.origin;
        let size = local.x.abs() + local.y.abs() + self.centre.x.abs() + self.centre.y.abs();
        (self.centre - local, self.error + 2.0 * U * size)
    }

    /// The sign of `v·(c - p)` for the difference `v` of two points.
    pub(super) fn product(&self, v: Point, p: Point) -> Option<Ordering> {
        let (c, error) = self.centre_from(p);
        let sizes = (v.x.abs() + v.y.abs(), (v.x * c.x).abs() + (v.y * c.y).abs());
        sign(v.dot(c), 2.0 * sizes.0 * error + ROUNDING * sizes.1)
    }

    /// The sign of `v·(c - c')` for the centre `c'` of another disk.
    pub(super) fn difference(&self, other: &Self, v: Point) -> Option<Ordering> {
        let (c, error) = self.centre_from(other.origin);
        let size = c.x.abs() + c.y.abs() + other.centre.x.abs() + other.centre.y.abs();
        let (c, error) = (c - other.centre, error + other.error + 2.0 * U * size);
        let sizes = (v.x.abs() + v.y.abs(), (v.x * c.x).abs() + (v.y * c.y).abs());
        sign(v.dot(c), 2.0 * sizes.0 * error + ROUNDING * sizes.1)
    }

    /// The sign of the distance of an element less the radius.
    pub(super) fn side(&self, element: Element) -> Option<Ordering> {
        let (distance, error) = match element {
            Element::Corner(p) => {
                let (c, error) = self.centre_from(p);
                (c.norm(), error)
            }
            Element::Edge(a, b) => {
                let (c, error) = self.centre_from(a);
                let d = b - a;
                let length = d.norm();
                let size = (d.x * c.y).abs() + (d.y * c.x).abs();
                (d.cross(c) / length, error + ROUNDING * size / length)
            }
        };
        // The error of a distance is at most √2 times that of a coordinate.
        let bound = 3.0 * error + self.error + ROUNDING * (distance.abs() + self.radius) + SHORT;
        sign(distance - self.radius, bound)
    }
}

impl From<&TouchingDisk> for Near {
    fn from(disk: &TouchingDisk) -> Self {
        let TouchingDisk { origin, centre, radius, bound } = *disk;
        Self { origin, centre, radius, error: bound }
    }
}

impl From<&Near> for TouchingDisk {
    fn from(near: &Near) -> Self {
        let Near { origin, centre, radius, error } = *near;
        Self { origin, centre, radius, bound: error }
    }
}

/// Whether there certainly is no disk that touches three elements, which are in the order that
/// [`corners_first`](super::construct::corners_first) gives, in their order.
pub(super) fn is_impossible(elements: &[Element; 3]) -> bool {
    use Element::{Corner, Edge};
    let is_equal = |(a, b): (Point, Point), (c, d): (Point, Point)| {
        cross_directions(a, b, c, d) == 0.0 && (b - a).dot(d - c) > 0.0
    };
    match *elements {
        [Corner(p), Corner(q), Corner(s)] => orient2d(p, q, s) <= 0.0,
        [Corner(p), Corner(q), Edge(a, b)] => {
            let (of_p, of_q) = (orient2d(a, b, p), orient2d(a, b, q));
            // Where both are as far away the contact lies between them.
            let is_turned = || cross_directions(a, b, p, q) == 0.0 && (b - a).dot(q - p) >= 0.0;
            of_p < 0.0 || of_q < 0.0 || of_p == 0.0 && of_q == 0.0 || is_turned()
        }
        [Corner(p), Edge(a, b), Edge(c, d)] => {
            let (first, second) = (orient2d(a, b, p), orient2d(c, d, p));
            let is_on_both = first == 0.0 && second == 0.0;
            first < 0.0 || second < 0.0 || is_on_both || is_equal((a, b), (c, d))
        }
        [Edge(a, b), Edge(c, d), Edge(e, f)] => {
            let [t, u, v] = [b - a, d - c, f - e].map(|d| d * (1.0 / d.norm()));
            let (tu, uv, vt) = (t.cross(u), u.cross(v), v.cross(t));
            // Twice the area of the triangle of the normals, and the radius times that.
            let (p, q) = (a - c, a - e);
            let (hu, hv) = (u.cross(p), v.cross(q));
            let size = p.x.abs() + p.y.abs() + q.x.abs() + q.y.abs();
            tu + uv + vt < -64.0 * U
                || hu * vt + hv * tu < -64.0 * U * size
                || [((a, b), (c, d)), ((c, d), (e, f)), ((e, f), (a, b))]
                    .iter()
                    .any(|&(e, f)| is_equal(e, f))
        }
        _ => false,
    }
}

/// The sign of a value if it is larger than its error.
///
/// The smallest normal number covers what underflows.
pub(crate) fn sign(value: f64, error: f64) -> Option<Ordering> {
    let error = error + f64::MIN_POSITIVE;
    if value > error {
        Some(Ordering::Greater)
    } else if value < -error {
        Some(Ordering::Less)
    } else {
        None
    }
}
