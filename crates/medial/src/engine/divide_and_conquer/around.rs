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

impl Merge<'_, '_> {
    /// What comes next where the curve is all around a ring: what either cell has ahead, and the order
    /// of the two.
    ///
    /// It may cross an arc more than once, and come to an end of one that only another part of the ring
    /// takes away. So each cell is asked for all arcs up to the place where the other one has something.
    pub(super) fn look_around(&mut self, curve: &mut Curve) -> (Ahead, Ahead) {
        let mut left = self.look_up_to(curve, Hand::Left, Reach::Near);
        let mut right = self.look_up_to(curve, Hand::Right, Reach::Near);
        loop {
            let first = match (left.disk(), right.disk()) {
                (Some(l), Some(r)) => {
                    let order = self.members.order(l, r, curve.right, curve.left);
                    Some(if order.is_le() { l } else { r })
                }
                (first, None) | (None, first) => first,
            };
            let first = first.copied();
            let reach = || first.as_ref().map_or(Reach::All, Reach::UpTo);
            left = self.look_up_to(curve, Hand::Left, reach());
            right = self.look_up_to(curve, Hand::Right, reach());
            let Some(first) = &first else { return (left, right) };
            let is_new = |ahead: &Ahead| {
                ahead.disk().is_some_and(|disk| {
                    self.members.order(disk, first, curve.right, curve.left).is_lt()
                })
            };
            if !is_new(&left) && !is_new(&right) {
                return (left, right);
            }
        }
    }

    /// What the cell to one hand has ahead, of the arcs within reach.
    fn look_up_to(&mut self, curve: &mut Curve, hand: Hand, reach: Reach<'_>) -> Ahead {
        let (cell, other) = match hand {
            Hand::Left => (curve.left, curve.right),
            Hand::Right => (curve.right, curve.left),
        };
        let mut cursor = if hand == Hand::Left { curve.left_cursor } else { curve.right_cursor };
        let mut passing = true;
        let mut first: Option<(Disk, Option<u32>, u32)> = None;
        let mut half = cursor;
        while half != NONE {
            self.diagram.work.arcs += 1;
            let far = self.far(half, hand);
            let vertex = (far != APEX && far != INFINITE).then(|| self.vertex(far));
            let place = |disk: Option<&Disk>| {
                let (vertex, disk) = (vertex.as_ref()?, disk?);
                self.place_around(cell, hand, vertex, disk)
            };
            passing = passing && place(curve.start.as_ref()) == Some(Ordering::Less);
            let after = self.step(half, hand);
            if passing {
                // The curve has passed its far end, so that is lost.
                (cursor, half) = (after, after);
                continue;
            }
            let meets = match (&vertex, far) {
                (Some(vertex), _) => self.members.meets(vertex, other),
                // A ring inside another one loses all that is far away.
                (None, INFINITE) => Ordering::Less,
                (None, _) => Ordering::Greater,
            };
            let is_at_end =
                meets.is_eq() && vertex.as_ref().is_some_and(|vertex| self.is_ahead(curve, vertex));
            let met = if is_at_end {
                vertex.map(|vertex| (vertex, Some(far), half))
            } else {
                let disk = self.members.disk([curve.right, self.diagram.beyond(half), curve.left]);
                disk.filter(|disk| {
                    let in_zone = |&m: &Member| self.members.in_zone_of_ring(disk, m);
                    disk.triple.iter().all(in_zone)
                        && self.is_ahead(curve, disk)
                        && self.is_on(half, disk)
                })
                .map(|disk| (disk, None, half))
            };
            if let Some(met) = met {
                let (right, left) = (curve.right, curve.left);
                let order = |d: &Disk, e: &Disk| self.members.order(d, e, right, left);
                if first.as_ref().is_none_or(|first| order(&met.0, &first.0).is_lt()) {
                    first = Some(met);
                }
            }
            let is_far = match reach {
                Reach::Near => is_at_end || meets.is_gt(),
                // What is proposed may lie on a wall that the curve has left behind.
                Reach::UpTo(disk) => {
                    !cell.is_corner() && place(Some(disk)) == Some(Ordering::Greater)
                }
                Reach::All => false,
            };
            if is_far {
                break;
            }
            half = after;
        }
        match hand {
            Hand::Left => curve.left_cursor = cursor,
            Hand::Right => curve.right_cursor = cursor,
        }
        first.map_or(Ahead::Nothing, |(disk, vertex, half)| Ahead::Arc(disk, vertex, half))
    }

    /// Whether the centre of a disk that touches both elements of an arc lies on the arc, and not on
    /// another one of the same two.
    fn is_on(&self, half: u32, disk: &Disk) -> bool {
        let (left, right) = (self.diagram.half(half).cell, self.diagram.beyond(half));
        let order = |vertex: u32| {
            let vertex = self.vertex(vertex);
            self.members.order(disk, &vertex, right, left)
        };
        let is_vertex = |vertex: u32| vertex != APEX && vertex != INFINITE;
        let (from, to) = (self.diagram.half(half).from, self.diagram.to(half));
        (!is_vertex(from) || order(from).is_ge()) && (!is_vertex(to) || order(to).is_le())
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
            self.members.turn(cell, disk, vertex)?
        } else {
            // Counterclockwise around the cell is against the direction of the edge.
            self.members.compare_along(disk, vertex, cell)
        };
        Some(if hand == Hand::Left { order } else { order.reverse() })
    }
}
