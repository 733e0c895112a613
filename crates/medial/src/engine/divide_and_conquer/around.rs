//! What the cells beside a merge curve have ahead where it is all around a ring.

use std::cmp::Ordering;

use super::diagram::{APEX, INFINITE, NONE};
use super::disks::Disk;
use super::elements::Member;
use super::look::{Ahead, Hand};
use super::merge::{Curve, Merge};

/// Up to where a cell is asked for arcs.
#[derive(Clone, Copy)]
enum Reach<'d> {
    /// Up to the first end that the other element does not take away.
    Near,
    /// Up to a disk on the curve.
    UpTo(&'d Disk),
    All,
}

/// What a cell was asked so far.
struct Scan {
    cell: Member,
    other: Member,
    hand: Hand,
    /// The first arc that the curve has not passed, and whether the next one may be passed as well.
    cursor: u32,
    passing: bool,
    /// The next arc to be asked, the far end of the last one, and whether the other element is known to
    /// take that away, or to touch it where the curve starts.
    half: u32,
    last: u32,
    is_lost: bool,
    /// The first arc that the curve meets, of those asked.
    first: Option<(Disk, Option<u32>, u32)>,
}

impl Scan {
    fn new(curve: &Curve, hand: Hand, is_lost: bool) -> Self {
        let (cell, other, cursor) = match hand {
            Hand::Left => (curve.left, curve.right, curve.left_cursor),
            Hand::Right => (curve.right, curve.left, curve.right_cursor),
        };
        let (passing, half, last, first) = (true, cursor, NONE, None);
        Self { cell, other, hand, cursor, passing, half, last, is_lost, first }
    }

    fn disk(&self) -> Option<&Disk> {
        self.first.as_ref().map(|(disk, ..)| disk)
    }

    fn ahead(self) -> Ahead {
        self.first.map_or(Ahead::Nothing, |(disk, vertex, half)| Ahead::Arc(disk, vertex, half))
    }
}

impl Merge<'_, '_> {
    /// What comes next where the curve is all around a ring: what either cell has ahead, and the order
    /// of the two.
    ///
    /// It may cross an arc more than once, and come to an end of one that only another part of the ring
    /// takes away. So each cell is asked for all arcs up to the place where the other one has something.
    pub(super) fn look_around(&self, curve: &mut Curve) -> (Ahead, Ahead) {
        let starts_at_curve = |half: u32, hand: Hand| {
            let near = if hand == Hand::Left {
                self.diagram.half(half).from
            } else {
                self.diagram.to(half)
            };
            half != NONE && near == self.diagram.half(curve.piece).from
        };
        let scan = |cursor, hand| Scan::new(curve, hand, starts_at_curve(cursor, hand));
        let mut left = scan(curve.left_cursor, Hand::Left);
        let mut right = scan(curve.right_cursor, Hand::Right);
        self.scan(curve, &mut left, Reach::Near);
        self.scan(curve, &mut right, Reach::Near);
        loop {
            let first = match (left.disk(), right.disk()) {
                (Some(l), Some(r)) => {
                    let order = self.members.order(l, r, curve.right, curve.left);
                    Some(if order.is_le() { *l } else { *r })
                }
                (first, None) | (None, first) => first.copied(),
            };
            let reach = || first.as_ref().map_or(Reach::All, Reach::UpTo);
            let sooner = [&mut left, &mut right].map(|scan| {
                let found = self.scan(curve, scan, reach());
                found
                    && first.as_ref().zip(scan.disk()).is_some_and(|(first, disk)| {
                        self.members.order(disk, first, curve.right, curve.left).is_lt()
                    })
            });
            if !sooner.contains(&true) {
                (curve.left_cursor, curve.right_cursor) = (left.cursor, right.cursor);
                return (left.ahead(), right.ahead());
            }
        }
    }

    /// Asks a cell for arcs within reach, from the last one asked on; whether an earlier one was found.
    fn scan(&self, curve: &Curve, scan: &mut Scan, reach: Reach<'_>) -> bool {
        let hand = scan.hand;
        let (right, left) = (curve.right, curve.left);
        let is_vertex = |vertex: u32| vertex < INFINITE;
        let mut found = false;
        while scan.half != NONE {
            if let Reach::UpTo(disk) = reach
                && is_vertex(scan.last)
                && self.is_beyond(scan.cell, hand, disk, self.vertex(scan.last))
            {
                break;
            }
            let half = scan.half;
            self.diagram.count_arc();
            let far = self.far(half, hand);
            let vertex = is_vertex(far).then(|| self.vertex(far));
            scan.half = self.step(half, hand);
            scan.passing = scan.passing
                && vertex.zip(curve.start.as_ref()).is_some_and(|(vertex, start)| {
                    self.place_around(scan.cell, hand, vertex, start) == Some(Ordering::Less)
                });
            scan.last = far;
            if scan.passing {
                // The curve has passed its far end, so that is lost.
                scan.cursor = scan.half;
                scan.is_lost = false;
                continue;
            }
            let meets = match vertex {
                Some(vertex) => self.members.meets(vertex, scan.other),
                // A ring inside another one loses all that is far away.
                None if far == INFINITE => Ordering::Less,
                None => Ordering::Greater,
            };
            // Between two ends that the other element takes away it takes all.
            let is_lost = std::mem::replace(&mut scan.is_lost, meets.is_lt() && vertex.is_some());
            if is_lost && scan.is_lost && self.is_convex(half, scan.other) {
                continue;
            }
            let at_end = vertex.filter(|vertex| meets.is_eq() && self.is_ahead(curve, vertex));
            let met = match at_end {
                Some(vertex) => Some((*vertex, Some(far), half)),
                None => self.crossing(curve, half, scan.other).map(|disk| (disk, None, half)),
            };
            if let Some(met) = met
                && scan
                    .disk()
                    .is_none_or(|first| self.members.order(&met.0, first, right, left).is_lt())
            {
                scan.first = Some(met);
                found = true;
            }
            if matches!(reach, Reach::Near) && (at_end.is_some() || meets.is_gt()) {
                break;
            }
        }
        found
    }

    /// Whether the part of an arc that another element takes away is convex.
    ///
    /// The distance of the element is a convex function along a straight line, and the radius is linear
    /// between two edges and on a normal. Between two corners the difference of squared distances from
    /// corners is linear.
    fn is_convex(&self, half: u32, other: Member) -> bool {
        let (cell, beyond) = (self.diagram.half(half).cell, self.diagram.beyond(half));
        match (cell.is_corner(), beyond.is_corner()) {
            (false, false) => true,
            (true, true) => other.is_corner(),
            _ => self.members.is_normal(cell, beyond),
        }
    }

    /// The disk where the curve crosses an arc, ahead.
    fn crossing(&self, curve: &Curve, half: u32, other: Member) -> Option<Disk> {
        let disk = self.members.disk([curve.right, self.diagram.beyond(half), curve.left])?;
        // An arc lies in the zones of its own two elements.
        let in_zone = || {
            let zones = if self.members.touches { &disk.triple[..] } else { &[other] };
            zones.iter().all(|&member| self.members.in_zone_of_ring(&disk, member))
        };
        let is_there = self.is_ahead(curve, &disk) && self.is_on(half, &disk) && in_zone();
        is_there.then(|| self.members.sharp(disk))
    }

    /// Whether the centre of a disk that touches both elements of an arc lies on the arc, and not on
    /// another one of the same two.
    fn is_on(&self, half: u32, disk: &Disk) -> bool {
        let (left, right) = (self.diagram.half(half).cell, self.diagram.beyond(half));
        let order = |vertex: u32| self.members.order(disk, self.vertex(vertex), right, left);
        let is_vertex = |vertex: u32| vertex != APEX && vertex != INFINITE;
        let (from, to) = (self.diagram.half(half).from, self.diagram.to(half));
        (!is_vertex(from) || order(from).is_ge()) && (!is_vertex(to) || order(to).is_le())
    }

    /// Whether the spoke to a vertex around a cell certainly lies beyond that to a disk on the curve.
    fn is_beyond(&self, cell: Member, hand: Hand, disk: &Disk, vertex: &Disk) -> bool {
        let order = if cell.is_corner() {
            self.members.turn_in_zone(cell, disk, vertex)
        } else {
            self.members.turn_around(cell, disk, vertex)
        };
        order == Some(if hand == Hand::Left { Ordering::Greater } else { Ordering::Less })
    }

    /// Orders the spokes from an element to a vertex around its cell and to a disk on the curve, in the
    /// direction of the curve; `None` where it is not certain.
    fn place_around(
        &self,
        cell: Member,
        hand: Hand,
        vertex: &Disk,
        disk: &Disk,
    ) -> Option<Ordering> {
        let order = if cell.is_corner() {
            self.members.turn_in_zone(cell, disk, vertex)?
        } else {
            // Counterclockwise around the cell is against the direction of the edge.
            self.members.compare_along(disk, vertex, cell)
        };
        Some(if hand == Hand::Left { order } else { order.reverse() })
    }
}
