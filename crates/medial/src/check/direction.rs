use std::cmp::Ordering;

use super::maximal_disk::MaximalDisk;
use crate::domain::{Domain, Site};
use crate::geom::{Point, cross_directions, orient2d};

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
            (true, true) => {
                let turn = cross_directions(p, p_end, q, q_end);
                turn.partial_cmp(&0.0).unwrap_or(Ordering::Equal)
            }
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
            (true, false) => orient2d(p, p_end, q) == 0.0,
            (false, true) => orient2d(q, q_end, p) == 0.0,
            (false, false) => p == q,
        }
    }

    fn points(&self, site: Site) -> (Point, Point) {
        (self.domain.edge(site.index()).start, self.domain.end(site.index()))
    }
}
