//! Ends a piece of a merge curve where it meets an arc, and starts the next one.

use super::diagram::{Half, INFINITE, NONE};
use super::elements::Member;
use super::infinity::Gap;
use super::look::{Ahead, Hand};
use super::merge::{Curve, Merge};

/// How a piece ends and the next one starts in a cell.
struct Cut {
    /// The half beside the old piece, if that ends, and beside the new one.
    old: u32,
    new: u32,
    cell: Member,
    cursor: u32,
    /// What follows after the arc, if its rest is unbounded.
    gap: Option<Gap>,
}

impl Merge<'_, '_> {
    /// Ends the present piece where an arc of either cell, or of both, is met, and starts the next.
    ///
    /// The next piece may be there already, where the curve closes.
    pub(super) fn cross(
        &mut self,
        curve: &mut Curve,
        left: Option<Ahead>,
        right: Option<Ahead>,
        next: Option<u32>,
    ) {
        for (met, cursor) in [(&left, &mut curve.left_cursor), (&right, &mut curve.right_cursor)] {
            if let Some(Ahead::Arc(_, _, half)) = met {
                *cursor = *half;
            }
        }
        let of = |ahead: &Option<Ahead>| ahead.as_ref().and_then(Ahead::vertex);
        let begun = next.map(|piece| self.diagram.half(piece).from);
        let vertex = match (of(&left), of(&right).or(begun)) {
            (Some(l), Some(r)) => {
                if l != r {
                    let half = self.far_half(curve, Hand::Left);
                    self.diagram.replace(half, r);
                }
                r
            }
            (Some(vertex), None) | (None, Some(vertex)) => vertex,
            (None, None) => {
                let disk = left.as_ref().or(right.as_ref()).and_then(Ahead::disk);
                let Some(&disk) = disk else { return };
                self.diagram.vertex(disk)
            }
        };
        let to_left =
            left.as_ref().and_then(|a| self.cut(curve.left_cursor, a, vertex, Hand::Left));
        let to_right =
            right.as_ref().and_then(|a| self.cut(curve.right_cursor, a, vertex, Hand::Right));
        if to_left.is_none() && left.is_some() {
            curve.left_cursor = self.step(curve.left_cursor, Hand::Left);
        }
        if to_right.is_none() && right.is_some() {
            curve.right_cursor = self.step(curve.right_cursor, Hand::Right);
        }
        let old = curve.piece;
        self.diagram.halves[old as usize ^ 1].from = vertex;
        if let Some(cut) = &to_left {
            (curve.left, curve.left_cursor, curve.left_gap) = (cut.cell, cut.cursor, cut.gap);
            (curve.left_lost, curve.entered) = (NONE, Hand::Left);
        }
        if let Some(cut) = &to_right {
            (curve.right, curve.right_cursor, curve.right_gap) = (cut.cell, cut.cursor, cut.gap);
            (curve.right_lost, curve.entered) = (NONE, Hand::Right);
        }
        let new = next.unwrap_or_else(|| self.diagram.arc(curve.left, curve.right, vertex));
        match to_left {
            Some(cut) => {
                self.diagram.link(old, cut.old);
                self.diagram.link(cut.new, new);
            }
            None => self.diagram.link(old, new),
        }
        match to_right {
            Some(cut) => {
                self.diagram.link(cut.old, old ^ 1);
                self.diagram.link(new ^ 1, cut.new);
            }
            None => self.diagram.link(new ^ 1, old ^ 1),
        }
        curve.piece = new;
        curve.start = match (left, right) {
            (Some(Ahead::Arc(disk, ..) | Ahead::Rim(disk, _)), _)
            | (_, Some(Ahead::Arc(disk, ..) | Ahead::Rim(disk, _))) => Some(disk),
            _ => None,
        };
    }

    /// A half that leaves the vertex at the far end of the arc that is met.
    fn far_half(&self, curve: &Curve, hand: Hand) -> u32 {
        match hand {
            Hand::Left => curve.left_cursor ^ 1,
            Hand::Right => curve.right_cursor,
        }
    }

    /// Splits an arc at a vertex; gives what is lost of it as the cell beyond sees it.
    pub(super) fn split(&mut self, half: u32, vertex: u32, hand: Hand) -> u32 {
        let twin = half ^ 1;
        let (old, new) = (*self.diagram.half(half), *self.diagram.half(twin));
        let lost = self.diagram.halves.len() as u32;
        for (end, member) in [(half, old.cell), (twin, new.cell)] {
            // Where an arc is the first or the last one of a cell, so is what is lost of it.
            let ends = &mut self.diagram.ends[member.0 as usize];
            let k = usize::from((hand == Hand::Right) == (end == half));
            if ends[k] == end {
                ends[k] = lost + (end ^ half);
            }
        }
        match hand {
            Hand::Left => {
                self.diagram.halves.push(Half { next: NONE, ..old });
                self.diagram.halves.push(Half { from: vertex, prev: NONE, ..new });
                self.diagram.halves[half as usize].from = vertex;
                self.relink(old.prev, lost, lost ^ 1, new.next);
            }
            Hand::Right => {
                self.diagram.halves.push(Half { from: vertex, prev: NONE, ..old });
                self.diagram.halves.push(Half { next: NONE, ..new });
                self.diagram.halves[twin as usize].from = vertex;
                self.relink(new.prev, lost ^ 1, lost, old.next);
            }
        }
        lost ^ 1
    }

    fn relink(&mut self, before: u32, first: u32, last: u32, after: u32) {
        if before != NONE {
            self.diagram.halves[before as usize].next = first;
        }
        if after != NONE {
            self.diagram.halves[after as usize].prev = last;
        }
    }

    /// Cuts the arc that is met at a vertex.
    fn cut(&mut self, half: u32, ahead: &Ahead, vertex: u32, hand: Hand) -> Option<Cut> {
        if self.joints.is_empty()
            && let Ahead::Arc(_, None, _) = ahead
        {
            // The curve may come back to the rest of it.
            let cell = self.diagram.beyond(half);
            let cursor = self.split(half, vertex, hand);
            return Some(Cut { old: half, new: half ^ 1, cell, cursor, gap: None });
        }
        let twin = half ^ 1;
        let d = &mut *self.diagram;
        let near = if hand == Hand::Left { half } else { twin };
        let unbounded = d.half(near).from == INFINITE;
        let gap = unbounded.then_some(Gap { half: twin, reached: None });
        let (cell, old, new) = (d.half(twin).cell, *d.half(half), *d.half(twin));
        let cursor = new.after(hand);
        match ahead {
            Ahead::Arc(_, None, _) => {
                d.halves[near as usize].from = vertex;
                Some(Cut { old: half, new: twin, cell, cursor, gap })
            }
            Ahead::Arc(_, Some(_), _) => {
                let mut cursor = cursor;
                if self.joints.is_empty() {
                    // All of it is lost here, but the curve may come back to it.
                    cursor = twin;
                    match hand {
                        Hand::Left => {
                            d.halves[half as usize].next = NONE;
                            d.halves[twin as usize].prev = NONE;
                        }
                        Hand::Right => {
                            d.halves[half as usize].prev = NONE;
                            d.halves[twin as usize].next = NONE;
                        }
                    }
                }
                let (old, new) = (old.after(hand), new.before(hand));
                Some(Cut { old, new, cell, cursor, gap })
            }
            Ahead::Rim(..) => {
                let own = old.cell;
                // Around the vertex over the dropped corners.
                let mut turned = twin;
                let rim = loop {
                    let arc = d.half(turned).before(hand);
                    let cell = d.beyond(arc);
                    if cell == own {
                        return None;
                    }
                    if !self.joints.iter().any(|joint| joint.drops(cell)) {
                        break arc ^ 1;
                    }
                    turned = arc ^ 1;
                };
                let new = d.half(rim);
                let (cell, new) = (new.cell, new.before(hand));
                Some(Cut { old: old.after(hand), new, cell, cursor: rim, gap: None })
            }
            _ => None,
        }
    }
}
