//! What the cells beside a merge curve have ahead.

use std::cmp::Ordering;

use super::diagram::{APEX, Half, INFINITE, NONE};
use super::disks::Disk;
use super::elements::Member;
use super::infinity::Gap;
use super::merge::{Curve, Joint, Merge};

/// What a cell has for the curve.
#[derive(Debug)]
pub(super) enum Ahead {
    /// Nothing; the curve goes on through the cell for as long as the other cell lets it.
    Nothing,
    /// The list of arcs ends at the element itself.
    Element,
    /// The cell reaches infinity before this arc.
    Infinity(u32),
    /// This arc is met; at a vertex of the diagram, if it is its far end.
    Arc(Disk, Option<u32>, u32),
    /// The curve runs along an arc of a dropped corner up to a vertex.
    Rim(Disk, u32),
}

impl Ahead {
    pub(super) fn disk(&self) -> Option<&Disk> {
        match self {
            Self::Arc(disk, ..) | Self::Rim(disk, _) => Some(disk),
            _ => None,
        }
    }

    pub(super) fn vertex(&self) -> Option<u32> {
        match *self {
            Self::Arc(_, vertex, _) => vertex,
            Self::Rim(_, vertex) => Some(vertex),
            _ => None,
        }
    }
}

/// Left of the curve the arcs of a cell are met counterclockwise, right of it clockwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Hand {
    Left,
    Right,
}

impl Half {
    /// The one after this around the cell, in the direction in which the arcs to a hand are met.
    pub(super) fn after(&self, hand: Hand) -> u32 {
        if hand == Hand::Left { self.next } else { self.prev }
    }

    /// The one before it.
    pub(super) fn before(&self, hand: Hand) -> u32 {
        if hand == Hand::Left { self.prev } else { self.next }
    }
}

impl Merge<'_, '_> {
    pub(super) fn step(&self, half: u32, hand: Hand) -> u32 {
        self.diagram.half(half).after(hand)
    }

    pub(super) fn far(&self, half: u32, hand: Hand) -> u32 {
        if hand == Hand::Left { self.diagram.to(half) } else { self.diagram.half(half).from }
    }

    #[inline]
    pub(super) fn vertex(&self, vertex: u32) -> &Disk {
        &self.diagram.vertices[vertex as usize]
    }

    /// Whether a disk lies ahead of the start of the present piece.
    pub(super) fn is_ahead(&self, curve: &Curve, disk: &Disk) -> bool {
        self.is_after(curve.start.as_ref(), disk, (curve.right, curve.left))
    }

    #[inline]
    fn is_after(&self, start: Option<&Disk>, disk: &Disk, (right, left): (Member, Member)) -> bool {
        start.is_none_or(|start| self.members.order(disk, start, right, left).is_gt())
    }

    /// What both cells have ahead, left and right, as far as it comes into question.
    ///
    /// Of the cell that the curve entered before the other one only the part behind the last vertex lost
    /// is known: what the other cell has before that comes first, whatever this one has.
    pub(super) fn look_both(&self, curve: &mut Curve) -> (Ahead, Ahead) {
        match curve.entered {
            Hand::Left => {
                let left = self.look_left(curve);
                let is_first = self.is_before_lost(curve, Hand::Right, &left);
                let right = if is_first { Ahead::Nothing } else { self.look_right(curve) };
                (left, right)
            }
            Hand::Right => {
                let right = self.look_right(curve);
                let is_first = self.is_before_lost(curve, Hand::Left, &right);
                let left = if is_first { Ahead::Nothing } else { self.look_left(curve) };
                (left, right)
            }
        }
    }

    /// Whether something certainly comes before the last vertex lost in the cell to one hand.
    fn is_before_lost(&self, curve: &Curve, hand: Hand, ahead: &Ahead) -> bool {
        let lost = if hand == Hand::Left { curve.left_lost } else { curve.right_lost };
        let (Some(disk), true) = (ahead.disk(), lost != NONE) else { return false };
        self.is_onwards(curve, hand, disk, &self.diagram.vertices[lost as usize])
    }

    /// Whether the spoke to a vertex around the cell to one hand certainly lies beyond that to a disk
    /// ahead.
    fn is_onwards(&self, curve: &Curve, hand: Hand, disk: &Disk, vertex: &Disk) -> bool {
        let (cell, onwards) = match hand {
            Hand::Left => (curve.left, Some(Ordering::Greater)),
            Hand::Right => (curve.right, Some(Ordering::Less)),
        };
        let turn = |a: &Disk, b: &Disk| self.members.turn_around(cell, a, b) == onwards;
        // Around a corner both must lie within half a turn from the start.
        let is_near =
            || curve.start.as_ref().is_some_and(|start| turn(start, disk) && turn(start, vertex));
        turn(disk, vertex) && (!cell.is_corner() || is_near())
    }

    #[inline(never)]
    fn look_left(&self, curve: &mut Curve) -> Ahead {
        self.look(curve, Hand::Left)
    }

    #[inline(never)]
    fn look_right(&self, curve: &mut Curve) -> Ahead {
        self.look(curve, Hand::Right)
    }

    /// What the cell to one hand has ahead; compiled for either.
    #[inline(always)]
    fn look(&self, curve: &mut Curve, hand: Hand) -> Ahead {
        let (cell, other) = match hand {
            Hand::Left => (curve.left, curve.right),
            Hand::Right => (curve.right, curve.left),
        };
        let start = &curve.start;
        let is_ahead = |disk: &Disk| self.is_after(start.as_ref(), disk, (curve.right, curve.left));
        let (cursor, gap, lost) = match hand {
            Hand::Left => (&mut curve.left_cursor, &mut curve.left_gap, &mut curve.left_lost),
            Hand::Right => (&mut curve.right_cursor, &mut curve.right_gap, &mut curve.right_lost),
        };
        loop {
            if let Some(open) = gap {
                if !self.is_gap_beaten(open, *cursor, hand, other) {
                    return Ahead::Infinity(*cursor);
                }
                *gap = None;
            }
            let half = *cursor;
            if half == NONE {
                return Ahead::Element;
            }
            self.diagram.count_arc();
            let (beyond, far) = (self.diagram.beyond(half), self.far(half, hand));
            if self.joints.iter().any(|joint| joint.drops(beyond)) {
                // The other chain has this part of the plane; the curve may run along its rim.
                let mut joints = self.joints.iter().filter(|joint| joint.drops(beyond));
                let along = joints.any(|joint| joint.is_along(cell, other));
                match far {
                    APEX => return Ahead::Element,
                    INFINITE => {
                        if !along && !self.is_beaten(half, hand, other) {
                            return Ahead::Nothing;
                        }
                        let after = self.step(half, hand);
                        if along {
                            return Ahead::Infinity(after);
                        }
                        (*cursor, *gap) = (after, Some(Gap { half, reached: None }));
                        continue;
                    }
                    _ => {}
                }
                let vertex = self.vertex(far);
                // Where it comes to the rim in a vertex it leaves it at once.
                let meets = if along { Ordering::Equal } else { self.members.meets(vertex, other) };
                match meets {
                    Ordering::Less => {}
                    Ordering::Equal if is_ahead(vertex) => {
                        return Ahead::Rim(*vertex, far);
                    }
                    Ordering::Equal if along => {}
                    _ => return Ahead::Nothing,
                }
                *cursor = self.step(half, hand);
                continue;
            }
            match far {
                APEX => {
                    if self.is_lost_in_a_joint(cell, beyond, hand) {
                        return Ahead::Element;
                    }
                }
                INFINITE => {
                    if self.is_beaten(half, hand, other) {
                        *cursor = self.step(half, hand);
                        *gap = Some(Gap { half, reached: None });
                        continue;
                    }
                }
                _ => {
                    let vertex = self.vertex(far);
                    match self.members.meets(vertex, other) {
                        Ordering::Less => {
                            *lost = far;
                            *cursor = self.step(half, hand);
                            continue;
                        }
                        Ordering::Equal => {
                            if is_ahead(vertex) {
                                return Ahead::Arc(*vertex, Some(far), half);
                            }
                            *cursor = self.step(half, hand);
                            continue;
                        }
                        Ordering::Greater => {}
                    }
                }
            }
            let triple = [curve.right, beyond, curve.left];
            let Some(disk) = self.members.disk(triple) else { return Ahead::Nothing };
            if !self.members.in_zone(&disk, beyond) || !is_ahead(&disk) {
                return Ahead::Nothing;
            }
            return Ahead::Arc(self.members.sharp(disk), None, half);
        }
    }

    /// Whether the arc by which the list of a cell ends in a corner is lost there.
    fn is_lost_in_a_joint(&self, cell: Member, beyond: Member, hand: Hand) -> bool {
        let (start, end) = self.members.ends(cell);
        let place = if hand == Hand::Left { start } else { end };
        let is_there = |joint: &&Joint| self.members.place(joint.own) == place;
        self.joints.iter().filter(is_there).any(|joint| joint.takes(cell, beyond))
    }
}
