use std::cmp::Ordering;

use super::maximal_disk::MaximalDisk;
use crate::domain::{Domain, Site};
use crate::geom::Point;

/// The contacts of one disk as directions from its centre, compared exactly.
pub(super) struct Contacts<'a> {
    domain: &'a Domain,
    disk: &'a MaximalDisk<'a>,
}

impl<'a> Contacts<'a> {
    pub(super) fn new(domain: &'a Domain, disk: &'a MaximalDisk<'a>) -> Self {
        Self { domain, disk }
    }

    /// Where the contact with `b` lies, turning counterclockwise from that with `a`: 0 at the same
    /// place, 1 less than half a turn, 2 half a turn, 3 more.
    pub(super) fn half(&self, a: Site, b: Site) -> u8 {
        match self.turn(a, b) {
            Ordering::Greater => 1,
            Ordering::Less => 3,
            Ordering::Equal if self.same(a, b) => 0,
            Ordering::Equal => 2,
        }
    }

    /// The sign of the cross product of the directions to the contacts with `a` and `b`.
    pub(super) fn turn(&self, a: Site, b: Site) -> Ordering {
        let (p, p_end) = self.points(a);
        let (q, q_end) = self.points(b);
        match (a.is_edge(), b.is_edge()) {
            // Both directions turned by a quarter turn are those of the edges.
            (true, true) => cross_sign(p, p_end, q, q_end),
            // The contact with an edge lies along -n = (d.y, -d.x): its cross product with q - c is
            // d·(q - c).
            (true, false) => self.disk.along(p, p_end, q).reverse(),
            (false, true) => self.disk.along(q, q_end, p),
            // (p - c) × (q - c)
            (false, false) => self.disk.across(p, q),
        }
    }

    /// Whether two contacts on one line through the centre are the same.
    fn same(&self, a: Site, b: Site) -> bool {
        let (p, p_end) = self.points(a);
        let (q, q_end) = self.points(b);
        match (a.is_edge(), b.is_edge()) {
            (true, true) => (p_end - p).dot(q_end - q) > 0.0,
            (true, false) => on_line(p, p_end, q),
            (false, true) => on_line(q, q_end, p),
            (false, false) => p == q,
        }
    }

    fn points(&self, site: Site) -> (Point, Point) {
        (self.domain.edge(site.index()).start, self.domain.end(site.index()))
    }
}

#[expect(clippy::float_cmp, reason = "the sign is exact")]
fn on_line(a: Point, b: Point, p: Point) -> bool {
    let c = |p: Point| robust::Coord { x: p.x, y: p.y };
    robust::orient2d(c(a), c(b), c(p)) == 0.0
}

/// The exact sign of `(b - a) × (d - c)`.
fn cross_sign(a: Point, b: Point, c: Point, d: Point) -> Ordering {
    let (u, v) = (b - a, d - c);
    let (left, right) = (u.x * v.y, u.y * v.x);
    let value = left - right;
    // Each difference, product and sum errs by one part in 2^53.
    if value.abs() > 8.0 * f64::EPSILON * (left.abs() + right.abs()) {
        return value.total_cmp(&0.0);
    }
    // (b.x - a.x)(d.y - c.y) - (b.y - a.y)(d.x - c.x), multiplied out.
    let mut sum = Expansion::default();
    for (p, q) in [
        (b.x, d.y),
        (-b.x, c.y),
        (-a.x, d.y),
        (a.x, c.y),
        (-b.y, d.x),
        (b.y, c.x),
        (a.y, d.x),
        (-a.y, c.x),
    ] {
        let product = p * q;
        sum.add(p.mul_add(q, -product));
        sum.add(product);
    }
    sum.sign()
}

/// An exact sum of doubles that do not overlap, smallest first.
#[derive(Default)]
struct Expansion(Vec<f64>);

impl Expansion {
    fn add(&mut self, value: f64) {
        let mut carry = value;
        for part in &mut self.0 {
            let sum = carry + *part;
            let virtual_part = sum - carry;
            *part = (carry - (sum - virtual_part)) + (*part - virtual_part);
            carry = sum;
        }
        self.0.push(carry);
    }

    fn sign(&self) -> Ordering {
        let largest = self.0.iter().rev().find(|part| **part != 0.0);
        largest.map_or(Ordering::Equal, |part| part.total_cmp(&0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sign_of_nearly_parallel_edges_is_exact() {
        let o = Point::new(0.1, 0.7);
        let far = Point::new(12345.6, 0.3);
        let b = Point::new(0.4, 0.9);
        // The same vector twice, and its end moved by one unit in the last place.
        assert_eq!(cross_sign(o, b, o, b), Ordering::Equal);
        assert_eq!(cross_sign(o, b, b, o), Ordering::Equal);
        let left = Point::new(0.4, 0.9f64.next_up());
        assert_eq!(cross_sign(o, b, o, left), Ordering::Greater);
        assert_eq!(cross_sign(o, left, o, b), Ordering::Less);
        assert_eq!(cross_sign(o, far, far, o), Ordering::Equal);
        let up = Point::new(12345.6, 0.3f64.next_up());
        assert_eq!(cross_sign(o, far, o, up), Ordering::Greater);
    }
}
