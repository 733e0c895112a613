//! Points with the exact decisions about them.

use std::cmp::Ordering;

use dashu_int::IBig;

use crate::geom::{Point, Rect, orient2d};

/// The vertex at infinity, which makes a triangle of each edge of the hull.
pub const INFINITY: u32 = u32::MAX;

/// Points, in the order in which they are inserted.
#[derive(Clone, Debug, Default)]
pub(super) struct Sites {
    /// Relative to `origin`, in units of `unit`, without rounding.
    local: Vec<Point>,
    origin: Point,
    unit: f64,
    /// The exponent of the last bit of all coordinates.
    last_bit: i32,
    arithmetic: Arithmetic,
}

/// How what doubles leave open is decided.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Arithmetic {
    /// Coordinates are whole numbers below 2^29.
    #[default]
    Lattice,
    /// Expansions, which neither overflow nor underflow.
    Doubles,
    /// Integers of any size.
    Integers,
}

/// Whole coordinates are below two to the power of this, so that the determinant of four points has 127 bits.
const LATTICE_BITS: i32 = 29;

/// Differences are below this where the determinant of four points has 63 bits: 12 D⁴ < 2^63.
const SMALL: f64 = 16_384.0;

/// Exponents of the last bits of coordinates, and of the first ones, of which products of four neither underflow
/// nor overflow.
const SAFE: std::ops::Range<i32> = -250..240;

/// Bounds on the relative errors of the determinants of three and of four points, as in [She97].
const ORIENT_ERROR: f64 = (3.0 + 16.0 * UNIT) * UNIT;
const CIRCLE_ERROR: f64 = (10.0 + 96.0 * UNIT) * UNIT;
const UNIT: f64 = f64::EPSILON / 2.0;

/// The same for the cosine of a sum of two angles, as a share of the longest ways: each scalar and each vector
/// product of differences is off by at most 4 units of its bound, and a product of two by 9 of theirs.
const ANGLE_ERROR: f64 = 24.0 * UNIT;

impl Sites {
    /// Points, which must be finite, in a given order.
    pub fn new(points: &[Point], order: &[u32]) -> Self {
        let bounds = points.iter().fold(Rect::EMPTY, |all, &p| all.with(p));
        let coordinates = || points.iter().flat_map(|p| [p.x, p.y]);
        let last = coordinates().filter_map(last_bit).min().unwrap_or(0);
        let size = (bounds.max - bounds.min).x.max((bounds.max - bounds.min).y);
        let first = coordinates().fold(0.0_f64, |most, value| most.max(value.abs()));
        let unit = 2.0_f64.powi(last);
        // The least corner is a multiple of the unit as well, so nothing is rounded.
        let is_lattice = SAFE.contains(&last) && size < unit * 2.0_f64.powi(LATTICE_BITS);
        let arithmetic = if is_lattice {
            Arithmetic::Lattice
        } else if SAFE.contains(&last) && first < 2.0_f64.powi(SAFE.end) {
            Arithmetic::Doubles
        } else {
            Arithmetic::Integers
        };
        let (origin, unit) = if is_lattice { (bounds.min, unit) } else { (Point::default(), 1.0) };
        let local = |&k: &u32| (points[k as usize] - origin) * (1.0 / unit);
        let local = order.iter().map(local).collect();
        let last_bit = if is_lattice { 0 } else { last };
        Self { local, origin, unit, last_bit, arithmetic }
    }

    #[inline]
    pub fn len(&self) -> u32 {
        self.local.len() as u32
    }

    pub fn swap(&mut self, a: u32, b: u32) {
        self.local.swap(a as usize, b as usize);
    }

    /// Gives a vertex the place of another one.
    #[inline]
    pub fn copy(&mut self, from: u32, to: u32) {
        self.local[to as usize] = self.local[from as usize];
    }

    pub fn truncate(&mut self, len: u32) {
        self.local.truncate(len as usize);
    }

    /// A point as it was given.
    #[inline]
    pub fn point(&self, vertex: u32) -> Point {
        self.origin + self.local[vertex as usize] * self.unit
    }

    /// The centre of the circle through three points, and its radius, rounded.
    pub fn circle(&self, [a, b, c]: [u32; 3]) -> (Point, f64) {
        let [mut a, mut b, mut c] = [a, b, c].map(|vertex| self.local[vertex as usize]);
        if self.arithmetic != Arithmetic::Lattice {
            // Seen from the corner of the two shorter sides: where two are very near one another, that is their way.
            let sides = [(c - b).norm2(), (a - c).norm2(), (b - a).norm2()];
            if sides[1] > sides[0] && sides[1] >= sides[2] {
                (a, b, c) = (b, c, a);
            } else if sides[2] > sides[0] {
                (a, b, c) = (c, a, b);
            }
        }
        let way = Point::circumcentre(b - a, c - a);
        (self.origin + (a + way) * self.unit, way.norm() * self.unit)
    }

    /// The order of two points, by x, then by y.
    #[inline]
    pub fn compare(&self, a: u32, b: u32) -> Ordering {
        self.local[a as usize].lexicographic(self.local[b as usize])
    }

    /// Whether two points are the same.
    #[inline]
    pub fn is_same(&self, a: u32, b: u32) -> bool {
        self.local[a as usize] == self.local[b as usize]
    }

    /// The side of the way from `a` to `b` on which `c` lies, exactly: positive to the left.
    #[inline]
    pub fn orient(&self, a: u32, b: u32, c: u32) -> f64 {
        let [a, b, c] = [a, b, c].map(|vertex| self.local[vertex as usize]);
        let (left, right) = ((a.x - c.x) * (b.y - c.y), (a.y - c.y) * (b.x - c.x));
        let turn = left - right;
        let is_sure = turn.abs() > ORIENT_ERROR * (left.abs() + right.abs());
        if is_sure && self.arithmetic != Arithmetic::Integers {
            return turn;
        }
        self.orient_exactly(a, b, c)
    }

    #[cold]
    fn orient_exactly(&self, a: Point, b: Point, c: Point) -> f64 {
        match self.arithmetic {
            Arithmetic::Lattice => {
                let [a, b] = [a - c, b - c].map(|p| [p.x as i64, p.y as i64]);
                (a[0] * b[1] - a[1] * b[0]) as f64
            }
            Arithmetic::Doubles => orient2d(a, b, c),
            Arithmetic::Integers => {
                let [a, b] = [a, b].map(|p| self.big_way(c, p));
                sign(&cross(&a, &b))
            }
        }
    }

    /// Where `d` lies to the circle through `a`, `b` and `c`, which follow one another counterclockwise, exactly:
    /// positive inside.
    #[inline]
    pub fn in_circle(&self, a: u32, b: u32, c: u32, d: u32) -> f64 {
        let points = [a, b, c, d].map(|vertex| self.local[vertex as usize]);
        let [a, b, c] = [0, 1, 2].map(|k| points[k] - points[3]);
        let [bc, cb, ca] = [b.x * c.y, c.x * b.y, c.x * a.y];
        let [ac, ab, ba] = [a.x * c.y, a.x * b.y, b.x * a.y];
        let [la, lb, lc] = [a.norm2(), b.norm2(), c.norm2()];
        let sum = la * (bc - cb) + lb * (ca - ac) + lc * (ab - ba);
        let size =
            la * (bc.abs() + cb.abs()) + lb * (ca.abs() + ac.abs()) + lc * (ab.abs() + ba.abs());
        if sum.abs() > CIRCLE_ERROR * size && self.arithmetic != Arithmetic::Integers {
            return sum;
        }
        self.in_circle_exactly(&points)
    }

    #[inline(never)]
    fn in_circle_exactly(&self, points: &[Point; 4]) -> f64 {
        let [a, b, c, d] = *points;
        match self.arithmetic {
            Arithmetic::Lattice => {
                let ways = [a - d, b - d, c - d];
                if ways.iter().all(|way| is_small(*way)) {
                    let [a, b, c] = ways.map(|p| [p.x as i64, p.y as i64]);
                    let lift = |p: [i64; 2]| p[0] * p[0] + p[1] * p[1];
                    let turn = |p: [i64; 2], q: [i64; 2]| p[0] * q[1] - p[1] * q[0];
                    let sum = lift(a) * turn(b, c) + lift(b) * turn(c, a) + lift(c) * turn(a, b);
                    return sum.signum() as f64;
                }
                let [a, b, c] = ways.map(|p| [p.x as i128, p.y as i128]);
                let lift = |p: [i128; 2]| p[0] * p[0] + p[1] * p[1];
                let turn = |p: [i128; 2], q: [i128; 2]| p[0] * q[1] - p[1] * q[0];
                let sum = lift(a) * turn(b, c) + lift(b) * turn(c, a) + lift(c) * turn(a, b);
                sum.signum() as f64
            }
            Arithmetic::Doubles => {
                let [a, b, c, d] = points.map(|p| robust::Coord { x: p.x, y: p.y });
                robust::incircle(a, b, c, d)
            }
            Arithmetic::Integers => {
                let [a, b, c] = [a, b, c].map(|p| self.big_way(d, p));
                let lift = |p: &[IBig; 2]| dot(p, p);
                let (bc, ca, ab) = (cross(&b, &c), cross(&c, &a), cross(&a, &b));
                sign(&(lift(&a) * bc + lift(&b) * ca + lift(&c) * ab))
            }
        }
    }

    /// The sign of the cosine of the angle at `apex` between the ways to `a` and `b`, exactly.
    pub fn opening(&self, apex: u32, a: u32, b: u32) -> f64 {
        let points = [apex, a, b].map(|vertex| self.local[vertex as usize]);
        let [a, b] = [points[1] - points[0], points[2] - points[0]];
        let (x, y) = (a.x * b.x, a.y * b.y);
        let is_sure = (x + y).abs() > ORIENT_ERROR * (x.abs() + y.abs());
        if is_sure && self.arithmetic != Arithmetic::Integers {
            return x + y;
        }
        let [a, b] = [1, 2].map(|k| self.big_way(points[0], points[k]));
        sign(&dot(&a, &b))
    }

    /// The sign of the cosine of the sum of the angles at `left` and `right`, at which two triangles see their
    /// common side from `a` to `b`, exactly.
    pub fn opening_of_both(&self, [a, b]: [u32; 2], left: u32, right: u32) -> f64 {
        let points = [a, b, left, right].map(|vertex| self.local[vertex as usize]);
        let [a, b, left, right] = points;
        let ways = [a - left, b - left, b - right, a - right];
        let [la, lb, rb, ra] = ways;
        let (dots, crosses) = (la.dot(lb) * rb.dot(ra), la.cross(lb) * rb.cross(ra));
        let size = la.norm2().max(lb.norm2()) * rb.norm2().max(ra.norm2());
        // Each of the two products has an error of less than 8 units of the size, as have dots of 2 each.
        let value = dots - crosses;
        if value.abs() > ANGLE_ERROR * size && self.arithmetic != Arithmetic::Integers {
            return value;
        }
        let [la, lb] = [a, b].map(|p| self.big_way(left, p));
        let [rb, ra] = [b, a].map(|p| self.big_way(right, p));
        sign(&(dot(&la, &lb) * dot(&rb, &ra) - cross(&la, &lb) * cross(&rb, &ra)))
    }

    /// The sign of the cosine of twice the angle at `apex` between the ways to `a` and `b`, exactly.
    pub fn opening_twice(&self, apex: u32, a: u32, b: u32) -> f64 {
        let [apex, a, b] = [apex, a, b].map(|vertex| self.local[vertex as usize]);
        let (to_a, to_b) = (a - apex, b - apex);
        let (dot, cross) = (to_a.dot(to_b), to_a.cross(to_b));
        let value = dot * dot - cross * cross;
        let size = to_a.norm2() * to_b.norm2();
        if value.abs() > ANGLE_ERROR * size && self.arithmetic != Arithmetic::Integers {
            return value;
        }
        let [a, b] = [a, b].map(|p| self.big_way(apex, p));
        let (dot, cross) = (self::dot(&a, &b), self::cross(&a, &b));
        sign(&(&dot * &dot - &cross * &cross))
    }

    /// The way between two points in units of the last bit.
    fn big_way(&self, from: Point, to: Point) -> [IBig; 2] {
        let whole = |value: f64| {
            let bits = value.to_bits();
            let exponent = (bits >> 52 & 0x7ff) as i32;
            let mantissa = (bits & ((1 << 52) - 1)) as i64;
            let (mantissa, exponent) =
                if exponent == 0 { (mantissa, 1) } else { (mantissa | 1 << 52, exponent) };
            let mantissa = IBig::from(if value < 0.0 { -mantissa } else { mantissa });
            let shift = exponent - 1075 - self.last_bit;
            // What is shifted out are zeros.
            if shift < 0 {
                mantissa >> shift.unsigned_abs() as usize
            } else {
                mantissa << shift as usize
            }
        };
        [whole(to.x) - whole(from.x), whole(to.y) - whole(from.y)]
    }
}

fn is_small(way: Point) -> bool {
    way.x.abs() < SMALL && way.y.abs() < SMALL
}

fn dot(a: &[IBig; 2], b: &[IBig; 2]) -> IBig {
    &a[0] * &b[0] + &a[1] * &b[1]
}

fn cross(a: &[IBig; 2], b: &[IBig; 2]) -> IBig {
    &a[0] * &b[1] - &a[1] * &b[0]
}

fn sign(value: &IBig) -> f64 {
    match value.cmp(&IBig::ZERO) {
        Ordering::Less => -1.0,
        Ordering::Equal => 0.0,
        Ordering::Greater => 1.0,
    }
}

/// The exponent of the last bit of a number that is not zero.
fn last_bit(value: f64) -> Option<i32> {
    let bits = value.to_bits();
    let exponent = (bits >> 52 & 0x7ff) as i32;
    let mantissa = bits & ((1 << 52) - 1);
    let (mantissa, exponent) =
        if exponent == 0 { (mantissa, 1) } else { (mantissa | 1 << 52, exponent) };
    (mantissa != 0).then(|| exponent - 1075 + mantissa.trailing_zeros() as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sites(points: &[(f64, f64)]) -> Sites {
        let points: Vec<Point> = points.iter().map(|&(x, y)| Point::new(x, y)).collect();
        let order: Vec<u32> = (0..points.len() as u32).collect();
        Sites::new(&points, &order)
    }

    /// A square, the point opposite of its middle circle moved by a unit in the last place, in every arithmetic.
    fn checked(size: f64, offset: f64, step: f64, arithmetic: Arithmetic) {
        let at = |x: f64, y: f64| (offset + x * size, offset + y * size);
        let (x, y) = at(0.0, 1.0);
        let all =
            [at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0), (x - step, y), (x + step, y)];
        let sites = sites(&all);
        assert_eq!(sites.arithmetic, arithmetic);
        let side = |d: u32| sites.in_circle(0, 1, 2, d).partial_cmp(&0.0).unwrap();
        assert_eq!([3, 4, 5].map(side), [Ordering::Equal, Ordering::Less, Ordering::Greater]);
        let turn = |c: u32| sites.orient(0, 3, c).partial_cmp(&0.0).unwrap();
        assert_eq!([3, 4, 5].map(turn), [Ordering::Equal, Ordering::Greater, Ordering::Less]);
        // The corner of a square sees its diagonal under a right angle.
        let opening = |apex: u32| sites.opening(apex, 2, 0).partial_cmp(&0.0).unwrap();
        assert_eq!([3, 4, 5].map(opening), [Ordering::Equal, Ordering::Greater, Ordering::Less]);
        // Two of them make 180 degrees, and with half of that from the outside 135 and 90.
        assert!(sites.opening_of_both([2, 0], 3, 1) < 0.0);
        assert_eq!(
            (0..6).map(|k| sites.point(k)).collect::<Vec<_>>(),
            all.map(|(x, y)| Point::new(x, y))
        );
    }

    #[test]
    fn ties_are_told_from_the_nearest_misses_in_every_arithmetic() {
        checked(8.0, -3.0, 1.0, Arithmetic::Lattice);
        checked(1e6, 0.0, 0.5, Arithmetic::Lattice);
        checked(1.0, 0.0, 2f64.powi(-50), Arithmetic::Doubles);
        checked(1e3, 1e9, 2f64.powi(-23), Arithmetic::Doubles);
        checked(2f64.powi(-300), 0.0, 2f64.powi(-330), Arithmetic::Integers);
        checked(2f64.powi(300), 0.0, 2f64.powi(-200), Arithmetic::Integers);
    }

    #[test]
    fn two_angles_are_a_right_one_together_or_nearly() {
        // The side from (0, 0) to (2, 0): seen from (1, 1) under 90 degrees, from far below under less and less.
        let points = [
            (0.0, 0.0),
            (2.0, 0.0),
            (1.0, 2.0),
            (1.0, -0.5),
            (1.0, -0.5 - 1e-15),
            (1.0, -0.5 + 1e-15),
        ];
        let sites = sites(&points);
        // tan of half the angles: 1/2 and 2, so that the angles make 180 degrees together, which is too much.
        assert!(sites.opening_of_both([0, 1], 2, 3) < 0.0);
        let flat = self::sites(&[
            (0.0, 0.0),
            (2.0, 0.0),
            (0.0, 1.0),
            (0.0, -4.0),
            (0.0, -4.0 - 1e-15),
            (0.0, -3.9999999999999996),
        ]);
        // tan 2 and 1/2: a right angle.
        assert_eq!(flat.opening_of_both([0, 1], 2, 3), 0.0);
        assert!(flat.opening_of_both([0, 1], 2, 4) > 0.0);
        assert!(flat.opening_of_both([0, 1], 2, 5) < 0.0);
    }
}
