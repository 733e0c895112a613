//! Disks that touch three elements, and what is decided about them.
//!
//! # Method
//! The bound of a certified disk tells how far every distance from its centre may be off. What doubles
//! leave open is looked up in the elements touched: in a tie doubles never tell. What these leave open
//! is asked of the exact disk, which is kept for a while (`exact.rs`).

use std::cmp::Ordering;
use std::rc::Rc;

use super::elements::{Flank, Member, Members};
use super::infinity::turn;
use crate::geom::predicates::{Eighths, Element, ExactDisk, sign};
use crate::geom::{Point, TouchingDisk, U, Unsure};

/// Error of a disk, as a share of its radius, above which it is made sharper before more is asked.
const POOR: f64 = 1.0 / (1_u64 << 30) as f64;

/// A disk that touches three elements, counterclockwise, from the smallest on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Disk {
    pub triple: [Member; 3],
    /// Whether it is what doubles make of the three.
    pub is_plain: bool,
    pub disk: TouchingDisk,
}

impl Members<'_> {
    /// The disk that touches three elements counterclockwise in this order, edges within their ends or
    /// beyond; it may be missing where one is touched in a corner that does not end it.
    pub fn disk(&self, triple: [Member; 3]) -> Option<Disk> {
        let [a, b, c] = self.without_straight(triple);
        let triple = if a < b && a < c {
            [a, b, c]
        } else if b < c {
            [b, c, a]
        } else {
            [c, a, b]
        };
        let plain = match self.normal_in(&triple) {
            Some((corner, side, other)) => {
                let (v, direction) = (self.place(corner), self.direction(side));
                match TouchingDisk::on_normal(v, direction, &self.governor(other), f64::INFINITY) {
                    Ok(None) => return None,
                    Ok(found) => found,
                    Err(Unsure) => None,
                }
            }
            None => {
                let [a, b, c] = triple;
                TouchingDisk::apart(&[self.governor(a), self.governor(b), self.governor(c)])
            }
        };
        match plain {
            Some(disk) => Some(Disk { triple, is_plain: true, disk }),
            None => self.by_integers(triple),
        }
    }

    /// A corner of three elements, a side that ends there, and the third one.
    #[inline]
    fn normal_in(&self, &[a, b, c]: &[Member; 3]) -> Option<(Member, Member, Member)> {
        let is_normal = |corner: Member, side: Member| {
            !side.is_corner() && self.ends_in(side, self.place(corner))
        };
        for [corner, other, third] in [[a, b, c], [b, a, c], [c, a, b]] {
            if corner.is_corner() {
                if is_normal(corner, other) {
                    return Some((corner, other, third));
                }
                if is_normal(corner, third) {
                    return Some((corner, third, other));
                }
            }
        }
        None
    }

    #[inline]
    fn ends_in(&self, side: Member, p: Point) -> bool {
        let (start, end) = self.ends(side);
        p == start || p == end
    }

    /// The disk that doubles do not find.
    #[cold]
    fn by_integers(&self, triple: [Member; 3]) -> Option<Disk> {
        // A corner behind an edge has no disk with it; one on its line, but no end of it, has one that
        // does not touch the edge itself.
        let is_useless = |&corner: &Member| {
            let p = self.place(corner);
            triple.iter().any(|&side| {
                let (a, b) = self.ends(side);
                !side.is_corner() && p != a && p != b && turn(a, b, p).is_le()
            })
        };
        if triple.iter().filter(|m| m.is_corner()).any(is_useless) {
            return None;
        }
        let exact = ExactDisk::new(triple.map(|m| self.element(m)))?;
        let disk = exact.rounded();
        self.exacts.get(triple, || exact);
        (disk.radius > 0.0).then_some(Disk { triple, is_plain: false, disk })
    }

    /// A disk about which more will be asked, made sharper where it is poor; those on normals are so only
    /// where they are huge, and little is asked about them.
    #[inline]
    pub fn sharp(&self, disk: Disk) -> Disk {
        let is_poor = disk.disk.bound > POOR * disk.disk.radius;
        if is_poor && self.normal_in(&disk.triple).is_none() { self.sharper(disk) } else { disk }
    }

    #[cold]
    fn sharper(&self, disk: Disk) -> Disk {
        match self.exact(&disk).sharper() {
            Some(sharper) => Disk { is_plain: false, disk: sharper, ..disk },
            None => disk,
        }
    }

    /// The same disk exactly.
    pub fn exact(&self, disk: &Disk) -> Rc<ExactDisk> {
        self.exacts.get(disk.triple, || {
            ExactDisk::of_certified(disk.triple.map(|m| self.element(m)), &disk.disk)
        })
    }

    /// The same disk in eighths of whole numbers, if it is one of these: most ties are.
    fn in_eighths(&self, disk: &Disk) -> Option<Eighths> {
        Eighths::new(self.whole?, disk.triple.map(|m| self.element(m)), &disk.disk)
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
    #[inline]
    fn along(&self, disk: &Disk, side: Member, end: Point) -> Ordering {
        let (way, doubt) = self.way(&disk.disk, end);
        sign(self.direction(side).dot(way), doubt)
            .unwrap_or_else(|| self.along_exactly(disk, side, end))
    }

    #[cold]
    fn along_exactly(&self, disk: &Disk, side: Member, end: Point) -> Ordering {
        if self.touches_end(disk, side, end) {
            return Ordering::Equal;
        }
        let (a, b) = self.ends(side);
        match self.in_eighths(disk) {
            Some(disk) => disk.along(a, b, end),
            None => self.exact(disk).along(a, b, end),
        }
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
        let edge = member.edge();
        let (before, after) = if member == Member::start(edge) {
            (self.domain.edge(edge).prev, edge)
        } else {
            (edge, self.domain.edge(edge).next)
        };
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
            sign(way.norm() - disk.disk.radius, doubt).unwrap_or_else(|| self.side_of(disk, p))
        };
        if member.is_corner() {
            return corner(a);
        }
        let at_end = |p: Point| if corner(p).is_lt() { Ordering::Less } else { Ordering::Greater };
        let direction = self.direction(member);
        let along = |(way, doubt): (Point, f64), end: Point| {
            sign(direction.dot(way), doubt).unwrap_or_else(|| self.along_exactly(disk, member, end))
        };
        let from_a = self.way(&disk.disk, a);
        if along(from_a, a).is_lt() {
            return at_end(a);
        }
        if along(self.way(&disk.disk, b), b).is_gt() {
            return at_end(b);
        }
        // From either side.
        let (way, doubt) = from_a;
        let across = direction.cross(way).abs();
        if let Some(side) = sign(across - disk.disk.radius, doubt) {
            return side;
        }
        self.side_of_edge(disk, (a, b))
    }

    #[cold]
    fn side_of(&self, disk: &Disk, corner: Point) -> Ordering {
        match self.in_eighths(disk) {
            Some(disk) => disk.side(corner),
            None => self.exact(disk).side(Element::Corner(corner)),
        }
    }

    #[cold]
    fn side_of_edge(&self, disk: &Disk, (a, b): (Point, Point)) -> Ordering {
        let (front, side) =
            self.in_eighths(disk).and_then(|disk| disk.side_of_edge(a, b)).unwrap_or_else(|| {
                let exact = self.exact(disk);
                let front = exact.front(a, b);
                let (from, to) = if front.is_lt() { (b, a) } else { (a, b) };
                (front, exact.side(Element::Edge(from, to)))
            });
        // From behind the other side of the edge may be touched, not this one.
        if front.is_lt() && side.is_eq() { Ordering::Greater } else { side }
    }

    /// Orders the centres of two disks along a direction, or across it, to the left.
    fn compare(&self, disks: [&Disk; 2], (a, b): (Point, Point), across: bool) -> Ordering {
        let [d, e] = disks;
        let shift = d.disk.origin - e.disk.origin;
        let way = (d.disk.centre - e.disk.centre) + shift;
        let size = |p: Point| p.x.abs() + p.y.abs();
        let sizes = size(d.disk.centre) + size(e.disk.centre) + size(shift);
        let doubt = d.disk.bound + e.disk.bound + 8.0 * U * sizes;
        let direction = b - a;
        let length = direction.x.abs() + direction.y.abs();
        let product = if across { direction.cross(way) } else { direction.dot(way) };
        sign(product, length * (doubt + 8.0 * U * size(way)))
            .unwrap_or_else(|| self.compare_exactly(disks, (a, b), across))
    }

    #[cold]
    fn compare_exactly(
        &self,
        [d, e]: [&Disk; 2],
        (a, b): (Point, Point),
        across: bool,
    ) -> Ordering {
        if d.triple == e.triple {
            return Ordering::Equal;
        }
        if let Some(d) = self.in_eighths(d)
            && let Some(e) = self.in_eighths(e)
        {
            return d.compare(&e, (a, b), across);
        }
        if self.is_same(d, e) {
            return Ordering::Equal;
        }
        if !across {
            // Where one touches the edge at an end, that is where its centre is along it.
            match (self.end_touched(d, (a, b)), self.end_touched(e, (a, b))) {
                (Some(p), Some(q)) => return (p == b).cmp(&(q == b)),
                (Some(p), None) => return self.exact(e).along(a, b, p).reverse(),
                (None, Some(q)) => return self.exact(d).along(a, b, q),
                (None, None) => {}
            }
        }
        let (d, e) = (self.exact(d), self.exact(e));
        if across { d.compare_across(&e, a, b) } else { d.compare_along(&e, a, b) }
    }

    /// The end in which a disk touches the side with these ends, together with a corner there.
    fn end_touched(&self, disk: &Disk, (a, b): (Point, Point)) -> Option<Point> {
        let ends = |m: Member| if m.is_corner() { None } else { Some(self.ends(m)) };
        let touches_side =
            disk.triple.iter().any(|&m| ends(m).is_some_and(|e| e == (a, b) || e == (b, a)));
        let at = |p: &Point| disk.triple.iter().any(|&m| m.is_corner() && self.place(m) == *p);
        if touches_side { [a, b].into_iter().find(at) } else { None }
    }

    /// Orders the footpoints of two disks along a side that both touch.
    pub fn compare_along(&self, a: &Disk, b: &Disk, side: Member) -> Ordering {
        self.compare([a, b], self.ends(side), false)
    }

    /// Orders the spokes from an element to two centres counterclockwise, the second one against the
    /// first, where doubles can tell; around a corner by less than a quarter of a turn.
    #[inline]
    pub fn turn_around(&self, cell: Member, a: &Disk, b: &Disk) -> Option<Ordering> {
        if cell.is_corner() {
            return self.turn(cell, a, b);
        }
        let from = self.ends(cell).0;
        let ((to_a, doubt_a), (to_b, doubt_b)) = (self.way(&a.disk, from), self.way(&b.disk, from));
        let direction = self.direction(cell);
        sign(direction.dot(to_a) - direction.dot(to_b), doubt_a + doubt_b)
    }

    /// Orders the way from a corner to the centre of one disk against that to the centre of another one,
    /// counterclockwise, by less than a quarter of a turn; `None` where doubles do not tell.
    pub fn turn(&self, corner: Member, from: &Disk, to: &Disk) -> Option<Ordering> {
        let ([from, to], doubt) = self.ways(corner, [from, to]);
        sign(from.dot(to), doubt).filter(|towards| towards.is_gt())?;
        sign(from.cross(to), doubt)
    }

    /// The same for disks that touch a reflex corner in its zone, which is less than half a turn.
    pub fn turn_in_zone(&self, corner: Member, from: &Disk, to: &Disk) -> Option<Ordering> {
        let ([from, to], doubt) = self.ways(corner, [from, to]);
        sign(from.cross(to), doubt)
    }

    /// The ways from a corner to the centres of two disks, and a bound on the error of their products.
    #[inline]
    fn ways(&self, corner: Member, disks: [&Disk; 2]) -> ([Point; 2], f64) {
        let place = self.place(corner);
        let [(from, from_doubt), (to, to_doubt)] = disks.map(|d| self.way(&d.disk, place));
        let (from_length, to_length) = (from.norm(), to.norm());
        let doubt = from_length * to_doubt
            + to_length * from_doubt
            + from_doubt * to_doubt
            + 8.0 * U * from_length * to_length;
        ([from, to], doubt)
    }

    /// Whether two disks are the same by their elements: in one cyclic order, or in any if a corner and an
    /// edge that ends in it are touched in one place.
    fn is_same(&self, a: &Disk, b: &Disk) -> bool {
        // A corner in which two chains meet has two numbers.
        let [d, [x, y, z]] = [a, b].map(|disk| disk.triple.map(|m| self.element(m)));
        let [p, q, s] = a.triple;
        [[x, y, z], [y, z, x], [z, x, y]].contains(&d)
            || [[x, z, y], [z, y, x], [y, x, z]].contains(&d)
                && [(p, q), (q, s), (s, p)].iter().any(|&(m, n)| self.is_normal(m, n))
    }

    /// Whether the curve between two elements is the normal of an edge in its own end.
    pub fn is_normal(&self, a: Member, b: Member) -> bool {
        if self.is_straight(a, b) {
            return true;
        }
        let (corner, side) = if a.is_corner() { (a, b) } else { (b, a) };
        corner.is_corner() && !side.is_corner() && self.ends_in(side, self.place(corner))
    }

    /// Orders two disks along the curve between an element to the right and one to the left.
    #[inline]
    pub fn order(&self, a: &Disk, b: &Disk, right: Member, left: Member) -> Ordering {
        let (r, l) = (self.ends(right), self.ends(left));
        let (direction, across, is_reversed) = match (right.is_corner(), left.is_corner()) {
            (true, true) => ((l.0, r.0), true, false),
            // On the normal at an end of the edge: outwards or inwards.
            (true, false) if r.0 == l.1 => (l, true, false),
            (true, false) if r.0 == l.0 => (l, true, true),
            (false, true) if l.0 == r.0 => (r, true, false),
            (false, true) if l.0 == r.1 => (r, true, true),
            (false, false) if self.is_straight(right, left) => (l, true, l.1 != r.0),
            (false, _) => (r, false, false),
            (true, false) => (l, false, true),
        };
        let order = self.compare([a, b], direction, across);
        if is_reversed { order.reverse() } else { order }
    }
}
