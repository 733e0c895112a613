//! Which of two chains is nearer at infinity: along unbounded arcs, and in all directions between two.

use std::cmp::Ordering;

use super::elements::Member;
use super::look::Hand;
use super::merge::Merge;
use crate::geom::{Point, orient2d};

/// The directions in which a cell reaches infinity.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gap {
    /// The unbounded arc before them, whose far end is lost to the other chain.
    pub half: u32,
    /// They are lost up to the one in which this point is as near as the cell.
    pub reached: Option<Point>,
}

/// On which side of the line through two points a third one lies: `Greater` on the left.
pub(super) fn turn(a: Point, b: Point, c: Point) -> Ordering {
    // Zero has two signs.
    orient2d(a, b, c).partial_cmp(&0.0).unwrap_or(Ordering::Equal)
}

impl Merge<'_, '_> {
    /// Two points on the line that an unbounded arc is perpendicular to, so that its far end lies to the
    /// left of it: the two corners between which it runs, or the ends of the edge whose normal it is.
    #[inline]
    fn base(&self, half: u32, hand: Hand) -> (Point, Point) {
        let (cell, beyond) = (self.diagram.half(half).cell, self.diagram.beyond(half));
        // Outwards with `left` to the left.
        let (left, right) = if hand == Hand::Left { (cell, beyond) } else { (beyond, cell) };
        match (left.is_corner(), right.is_corner()) {
            (true, true) => (self.members.place(left), self.members.place(right)),
            (false, _) => self.members.ends(left),
            (true, false) => self.members.ends(right),
        }
    }

    /// Whether an element is nearer than the two cells at the far end of an unbounded arc.
    pub(super) fn is_beaten(&self, half: u32, hand: Hand, by: Member) -> bool {
        let (l, r) = self.base(half, hand);
        let (u, v) = self.members.ends(by);
        let sides = [turn(l, r, u), turn(l, r, v)];
        if sides.iter().any(|s| s.is_gt()) {
            return true;
        }
        let is_normal =
            !self.diagram.half(half).cell.is_corner() || !self.diagram.beyond(half).is_corner();
        if is_normal || sides.iter().all(|s| s.is_lt()) {
            return false;
        }
        // On the line of the two corners what is between them is nearer.
        let after =
            |p: Point, q: Point| p.lexicographic(q).is_gt() == l.lexicographic(r).is_lt() && p != q;
        match sides {
            [Ordering::Equal, Ordering::Equal] if u != v => {
                let (first, last) = if after(v, u) { (u, v) } else { (v, u) };
                after(last, l) && after(r, first)
            }
            [Ordering::Equal, _] => after(u, l) && after(r, u),
            _ => after(v, l) && after(r, v),
        }
    }

    /// Whether the curve is known to be nearer than a cell in all directions between two unbounded arcs;
    /// if not, notes up to where an element makes it so.
    pub(super) fn is_gap_beaten(&self, gap: &mut Gap, after: u32, hand: Hand, by: Member) -> bool {
        let opposite = if hand == Hand::Left { Hand::Right } else { Hand::Left };
        let beyond = |(l, r): (Point, Point), p: Point| turn(l, r, p).is_gt();
        let place = self.members.ends(self.diagram.half(gap.half).cell).0;
        let (u, v) = self.members.ends(by);
        // Each end of the element may make the other one count.
        let points = if by.is_corner() { &[u][..] } else { &[u, v, u] };
        for &p in points {
            let counts = match gap.reached {
                None => beyond(self.base(gap.half, hand), p),
                Some(reached) => {
                    let turn = turn(place, reached, p);
                    if hand == Hand::Left { turn.is_gt() } else { turn.is_lt() }
                }
            };
            if counts && beyond(self.base(after, opposite), p) {
                return true;
            }
            if counts {
                gap.reached = Some(p);
            }
        }
        false
    }
}
