//! Boundary elements seen from both sides.

use std::cmp::Ordering;

use crate::domain::{Domain, Site};
use crate::geom::predicates::{Element, ExactDisk};
use crate::geom::{Governor, Point, TouchingDisk};

/// An element of a two-sided diagram.
///
/// Of edge number k: 4k is the corner at its start, 4k + 1 its left side, where the interior is, 4k + 2
/// its right side, and 4k + 3 the corner at its end. So a corner has two numbers, one for each of the
/// chains that meet in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Member(pub u32);

/// A side of the boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Flank {
    Left,
    Right,
}

impl Member {
    pub const fn start(edge: u32) -> Self {
        Self(4 * edge)
    }

    pub const fn end(edge: u32) -> Self {
        Self(4 * edge + 3)
    }

    pub const fn side(edge: u32, flank: Flank) -> Self {
        match flank {
            Flank::Left => Self(4 * edge + 1),
            Flank::Right => Self(4 * edge + 2),
        }
    }

    pub const fn edge(self) -> u32 {
        self.0 >> 2
    }

    pub const fn is_corner(self) -> bool {
        matches!(self.0 & 3, 0 | 3)
    }

    /// The side of the edge; the right one only where it is that.
    pub const fn flank(self) -> Flank {
        if self.0 & 3 == 2 { Flank::Right } else { Flank::Left }
    }
}

/// The elements of a domain.
#[derive(Clone, Copy, Debug)]
pub(super) struct Members<'a> {
    pub domain: &'a Domain,
}

impl Members<'_> {
    /// Where a corner is.
    pub fn place(&self, corner: Member) -> Point {
        let edge = corner.edge();
        if corner.0 & 3 == 0 { self.domain.edge(edge).start } else { self.domain.end(edge) }
    }

    /// The ends of a side, so that it is seen from its left; a corner twice.
    pub fn ends(&self, member: Member) -> (Point, Point) {
        let edge = member.edge();
        let (a, b) = (self.domain.edge(edge).start, self.domain.end(edge));
        match member.0 & 3 {
            0 => (a, a),
            1 => (a, b),
            2 => (b, a),
            _ => (b, b),
        }
    }

    pub fn element(&self, member: Member) -> Element {
        let (a, b) = self.ends(member);
        if member.is_corner() { Element::Corner(a) } else { Element::Edge(a, b) }
    }

    pub fn governor(&self, member: Member) -> Governor {
        let (start, end) = self.ends(member);
        if member.is_corner() {
            return Governor::Corner(start);
        }
        let direction = self.domain.edge(member.edge()).direction;
        let direction = if member.flank() == Flank::Left { direction } else { -direction };
        Governor::Edge { start, end, direction }
    }

    /// The site of the interior that an element is.
    pub fn site(&self, member: Member) -> Site {
        let edge = member.edge();
        match member.0 & 3 {
            0 => Site::corner(edge),
            3 => Site::corner(self.domain.edge(edge).next),
            _ => Site::edge(edge),
        }
    }

    /// The disk that touches three elements counterclockwise in this order.
    pub fn disk(&self, triple: [Member; 3]) -> Option<Disk> {
        let elements = || triple.map(|m| self.element(m));
        if let Some(disk) = TouchingDisk::touching(&triple.map(|m| self.governor(m))) {
            return Some(Disk { triple, disk, exact: ExactDisk::of_certified(elements(), &disk) });
        }
        let exact = ExactDisk::new(elements())?;
        let disk = exact.rounded();
        (disk.radius > 0.0).then_some(Disk { triple, disk, exact })
    }

    /// A disk found before.
    pub fn known(&self, triple: [Member; 3], disk: TouchingDisk) -> Disk {
        let exact = ExactDisk::of_certified(triple.map(|m| self.element(m)), &disk);
        Disk { triple, disk, exact }
    }

    /// Whether a disk that touches the line of a side does so within its ends, which count.
    pub fn in_zone(&self, disk: &ExactDisk, member: Member) -> bool {
        if member.is_corner() {
            return true;
        }
        let (a, b) = self.ends(member);
        disk.along(a, b, a).is_ge() && disk.along(a, b, b).is_le()
    }

    /// Whether a disk that touches an element of closed rings does so in its zone, which is closed.
    pub fn in_zone_of_ring(&self, disk: &ExactDisk, member: Member) -> bool {
        if !member.is_corner() {
            return self.in_zone(disk, member);
        }
        let Site(corner) = self.site(member);
        let after = corner >> 1;
        let (before, v) = (self.domain.edge(after).prev, self.place(member));
        disk.along(self.domain.edge(before).start, v, v).is_ge()
            && disk.along(v, self.domain.end(after), v).is_le()
    }

    /// Orders the distance of the centre from an edge with its ends, or from a corner, against the
    /// radius; `Equal` only where the element itself is touched, and not just one of its ends.
    pub fn meets(&self, disk: &ExactDisk, member: Member) -> Ordering {
        let (a, b) = self.ends(member);
        if member.is_corner() {
            return disk.side(Element::Corner(a));
        }
        let at_end = |p: Point| {
            if disk.side(Element::Corner(p)).is_lt() { Ordering::Less } else { Ordering::Greater }
        };
        if disk.along(a, b, a).is_lt() {
            return at_end(a);
        }
        if disk.along(a, b, b).is_gt() {
            return at_end(b);
        }
        if disk.front(a, b).is_lt() {
            // From behind: the other side of the edge may be touched, not this one.
            let behind = disk.side(Element::Edge(b, a));
            return if behind.is_eq() { Ordering::Greater } else { behind };
        }
        disk.side(Element::Edge(a, b))
    }

    /// Orders two disks along the curve between an element to the right and one to the left.
    pub fn order(&self, a: &ExactDisk, b: &ExactDisk, right: Member, left: Member) -> Ordering {
        let ((r0, r1), (l0, l1)) = (self.ends(right), self.ends(left));
        match (right.is_corner(), left.is_corner()) {
            (true, true) => a.compare_across(b, l0, r0),
            // On the normal at an end of the edge: outwards or inwards.
            (true, false) if r0 == l1 => a.compare_across(b, l0, l1),
            (true, false) if r0 == l0 => a.compare_across(b, l0, l1).reverse(),
            (false, true) if l0 == r0 => a.compare_across(b, r0, r1),
            (false, true) if l0 == r1 => a.compare_across(b, r0, r1).reverse(),
            (false, _) => a.compare_along(b, r0, r1),
            (true, false) => a.compare_along(b, l0, l1).reverse(),
        }
    }
}

/// A disk that touches three elements, counterclockwise.
#[derive(Clone, Debug)]
pub(super) struct Disk {
    pub triple: [Member; 3],
    pub disk: TouchingDisk,
    pub exact: ExactDisk,
}
