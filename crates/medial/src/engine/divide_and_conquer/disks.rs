//! Disks that touch three elements, and what is decided about them.
//!
//! # Method
//! The bound of a certified disk tells how far every distance from its centre may be off. What doubles
//! leave open is asked of the exact disk, which is made for the question.

use std::cmp::Ordering;

use super::elements::{Flank, Member, Members};
use crate::geom::predicates::{Element, ExactDisk, sign};
use crate::geom::{Point, TouchingDisk, U};

/// A disk that touches three elements, counterclockwise.
#[derive(Clone, Copy, Debug)]
pub(super) struct Disk {
    pub triple: [Member; 3],
    pub disk: TouchingDisk,
}

impl Members<'_> {
    /// The disk that touches three elements counterclockwise in this order.
    pub fn disk(&self, triple: [Member; 3]) -> Option<Disk> {
        let triple = self.without_straight(triple);
        if let Some(disk) = TouchingDisk::touching(&triple.map(|m| self.governor(m))) {
            return Some(Disk { triple, disk });
        }
        let disk = ExactDisk::new(triple.map(|m| self.element(m)))?.rounded();
        (disk.radius > 0.0).then_some(Disk { triple, disk })
    }

    /// The same disk exactly.
    pub fn exact(&self, disk: &Disk) -> ExactDisk {
        ExactDisk::of_certified(disk.triple.map(|m| self.element(m)), &disk.disk)
    }

    /// The way from a corner to the centre, and a bound on the error of its products with unit vectors
    /// and of its length less the radius.
    #[inline]
    fn way(&self, disk: &TouchingDisk, from: Point) -> (Point, f64) {
        let a = from - disk.origin;
        let q = disk.centre - a;
        (q, disk.doubt(a, q))
    }

    /// Whether a disk touches a side and a corner that ends it, so both in that corner.
    fn touches_end(&self, disk: &Disk, side: Member, end: Point) -> bool {
        disk.triple.contains(&side)
            && disk.triple.iter().any(|&m| m.is_corner() && self.place(m) == end)
    }

    /// Orders the centre along a side against one of its ends.
    fn along(&self, disk: &Disk, side: Member, end: Point) -> Ordering {
        if self.touches_end(disk, side, end) {
            return Ordering::Equal;
        }
        let (way, doubt) = self.way(&disk.disk, end);
        sign(self.direction(side).dot(way), doubt).unwrap_or_else(|| {
            let (a, b) = self.ends(side);
            self.exact(disk).along(a, b, end)
        })
    }

    /// Whether a disk that touches the line of a side does so within its ends, which count.
    pub fn in_zone(&self, disk: &Disk, member: Member) -> bool {
        if member.is_corner() {
            return true;
        }
        let (a, b) = self.ends(member);
        self.along(disk, member, a).is_ge() && self.along(disk, member, b).is_le()
    }

    /// Whether a disk that touches an element of closed rings does so in its zone, which is closed.
    pub fn in_zone_of_ring(&self, disk: &Disk, member: Member) -> bool {
        if !member.is_corner() {
            return self.in_zone(disk, member);
        }
        let after = self.site(member).index();
        let before = self.domain.edge(after).prev;
        let v = self.place(member);
        let side = |edge: u32| Member::side(edge, Flank::Left);
        self.along(disk, side(before), v).is_ge() && self.along(disk, side(after), v).is_le()
    }

    /// Orders the distance of the centre from an edge with its ends, or from a corner, against the
    /// radius; `Equal` only where the element itself is touched, and not just one of its ends.
    pub fn meets(&self, disk: &Disk, member: Member) -> Ordering {
        if disk.triple.contains(&member) {
            return Ordering::Equal;
        }
        let (a, b) = self.ends(member);
        let corner = |p: Point| {
            let (way, doubt) = self.way(&disk.disk, p);
            sign(way.norm() - disk.disk.radius, doubt)
                .unwrap_or_else(|| self.exact(disk).side(Element::Corner(p)))
        };
        if member.is_corner() {
            return corner(a);
        }
        let at_end = |p: Point| if corner(p).is_lt() { Ordering::Less } else { Ordering::Greater };
        if self.along(disk, member, a).is_lt() {
            return at_end(a);
        }
        if self.along(disk, member, b).is_gt() {
            return at_end(b);
        }
        let (way, doubt) = self.way(&disk.disk, a);
        // From either side.
        let across = self.direction(member).cross(way).abs();
        if let Some(side) = sign(across - disk.disk.radius, doubt) {
            return side;
        }
        let exact = self.exact(disk);
        if exact.front(a, b).is_lt() {
            // From behind: the other side of the edge may be touched, not this one.
            let behind = exact.side(Element::Edge(b, a));
            return if behind.is_eq() { Ordering::Greater } else { behind };
        }
        exact.side(Element::Edge(a, b))
    }

    /// Orders the centres of two disks along a direction, or across it, to the left.
    fn compare(&self, disks: [&Disk; 2], (a, b): (Point, Point), across: bool) -> Ordering {
        let [d, e] = disks;
        let way = (d.disk.centre - e.disk.centre) + (d.disk.origin - e.disk.origin);
        let size = |d: &TouchingDisk| {
            d.centre.x.abs() + d.centre.y.abs() + d.origin.x.abs() + d.origin.y.abs()
        };
        let doubt = d.disk.bound + e.disk.bound + 8.0 * U * (size(&d.disk) + size(&e.disk));
        let direction = b - a;
        let length = direction.x.abs() + direction.y.abs();
        let product = if across { direction.cross(way) } else { direction.dot(way) };
        sign(product, length * (doubt + 8.0 * U * (way.x.abs() + way.y.abs()))).unwrap_or_else(
            || {
                let (d, e) = (self.exact(d), self.exact(e));
                if across { d.compare_across(&e, a, b) } else { d.compare_along(&e, a, b) }
            },
        )
    }

    /// Orders the footpoints of two disks along a side that both touch.
    pub fn compare_along(&self, a: &Disk, b: &Disk, side: Member) -> Ordering {
        let (start, end) = self.ends(side);
        let at = |disk: &Disk, p: Point| self.touches_end(disk, side, p);
        if self.is_same(a, b) || [start, end].iter().any(|&p| at(a, p) && at(b, p)) {
            return Ordering::Equal;
        }
        self.compare([a, b], (start, end), false)
    }

    /// Orders the way from a corner to the centre of one disk against that to the centre of another one,
    /// counterclockwise, by less than a quarter of a turn; `None` where doubles do not tell.
    pub fn turn(&self, corner: Member, from: &Disk, to: &Disk) -> Option<Ordering> {
        let place = self.place(corner);
        let [(from, from_doubt), (to, to_doubt)] = [from, to].map(|d| self.way(&d.disk, place));
        let (from_length, to_length) = (from.norm(), to.norm());
        let doubt = from_length * to_doubt
            + to_length * from_doubt
            + from_doubt * to_doubt
            + 8.0 * U * from_length * to_length;
        sign(from.dot(to), doubt).filter(|towards| towards.is_gt())?;
        sign(from.cross(to), doubt)
    }

    /// Whether two disks are the same by their elements: in one cyclic order, or in any if a corner and an
    /// edge that ends in it are touched in one place.
    fn is_same(&self, a: &Disk, b: &Disk) -> bool {
        let [x, y, z] = a.triple;
        if [[x, y, z], [y, z, x], [z, x, y]].contains(&b.triple) {
            return true;
        }
        [[z, y, x], [y, x, z], [x, z, y]].contains(&b.triple)
            && [(x, y), (y, z), (z, x)].iter().any(|&(m, n)| self.is_normal(m, n))
    }

    /// Whether the curve between two elements is the normal of an edge in its own end.
    pub fn is_normal(&self, a: Member, b: Member) -> bool {
        if self.is_straight(a, b) {
            return true;
        }
        let (corner, side) = if a.is_corner() { (a, b) } else { (b, a) };
        let (start, end) = self.ends(side);
        corner.is_corner() && !side.is_corner() && [start, end].contains(&self.place(corner))
    }

    /// Orders two disks along the curve between an element to the right and one to the left.
    pub fn order(&self, a: &Disk, b: &Disk, right: Member, left: Member) -> Ordering {
        if self.is_same(a, b) {
            return Ordering::Equal;
        }
        let (r, l) = (self.ends(right), self.ends(left));
        let across = |ends| self.compare([a, b], ends, true);
        let along = |ends| self.compare([a, b], ends, false);
        match (right.is_corner(), left.is_corner()) {
            (true, true) => across((l.0, r.0)),
            // On the normal at an end of the edge: outwards or inwards.
            (true, false) if r.0 == l.1 => across(l),
            (true, false) if r.0 == l.0 => across(l).reverse(),
            (false, true) if l.0 == r.0 => across(r),
            (false, true) if l.0 == r.1 => across(r).reverse(),
            (false, false) if self.is_straight(right, left) && l.1 == r.0 => across(l),
            (false, false) if self.is_straight(right, left) => across(l).reverse(),
            (false, _) => along(r),
            (true, false) => along(l).reverse(),
        }
    }
}
