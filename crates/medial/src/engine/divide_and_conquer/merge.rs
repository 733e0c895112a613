//! The merge of the diagrams of two chains that share one corner, or both.
//!
//! The shared corners belong to the first chain, which also wins every tie: the second one counts where
//! it is strictly nearer. So the merge curve is one closed curve on the sphere through each shared
//! corner: where the boundary is convex it starts as the bisector of the two edges there, elsewhere as
//! the normal of the second chain's edge.

use std::cmp::Ordering;

use smallvec::SmallVec;

use super::diagram::{APEX, Diagram, INFINITE, NONE};
use super::disks::Disk;
use super::elements::{Flank, Member, Members};
use super::forest::Asked;
use super::infinity::{Gap, turn};
use super::look::{Ahead, Hand};
use crate::domain::Corner;
use crate::engine::EngineError;
use crate::engine::watch::Watch;

/// A corner in which the two chains meet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Joint {
    /// The corner as the first chain has it, and as the second one does.
    pub own: Member,
    dropped: Member,
    /// The edges of the first and the second chain there.
    first_edge: u32,
    second_edge: u32,
    /// Whether the first chain ends here, or starts.
    ends_first: bool,
    /// The corner between the two edges as seen from the left.
    corner: Corner,
    /// The sides on which the curve passes.
    flanks: &'static [Flank],
}

impl Joint {
    /// Where one chain ends with an edge and another starts with the next one.
    pub fn new(members: &Members<'_>, edges: [u32; 2], ends_first: bool) -> Self {
        let [end, start] = [Member::end(edges[0]), Member::start(edges[1])];
        let corners = if ends_first { [end, start] } else { [start, end] };
        let flanks = &[Flank::Left, Flank::Right];
        Self { flanks, ..Self::of_rings(members, edges, ends_first, corners) }
    }

    /// The side on which the boundary is convex, if it turns.
    pub fn convex(&self) -> Option<Flank> {
        match self.corner {
            Corner::Convex => Some(Flank::Left),
            Corner::Reflex => Some(Flank::Right),
            Corner::Straight => None,
        }
    }

    /// A sector of the interior between an edge of one ring and the next one of another ring, which it
    /// touches there; with the corner as the first ring and as the second one has it.
    pub fn of_rings(
        members: &Members<'_>,
        [before, after]: [u32; 2],
        ends_first: bool,
        [own, dropped]: [Member; 2],
    ) -> Self {
        let (a, b) = members.ends(Member::side(before, Flank::Left));
        let (_, c) = members.ends(Member::side(after, Flank::Left));
        let corner = match turn(a, b, c) {
            Ordering::Greater => Corner::Convex,
            Ordering::Less => Corner::Reflex,
            Ordering::Equal => Corner::Straight,
        };
        let (first_edge, second_edge) = if ends_first { (before, after) } else { (after, before) };
        let flanks = &[Flank::Left];
        Self { own, dropped, first_edge, second_edge, ends_first, corner, flanks }
    }

    /// The corner as seen from a side.
    fn corner(&self, flank: Flank) -> Corner {
        match (flank, self.corner) {
            (Flank::Left, corner) => corner,
            (Flank::Right, Corner::Convex) => Corner::Reflex,
            (Flank::Right, Corner::Reflex) => Corner::Convex,
            (Flank::Right, Corner::Straight) => Corner::Straight,
        }
    }

    /// The sides of the edges of the first and the second chain.
    fn sides(&self, flank: Flank) -> [Member; 2] {
        [self.first_edge, self.second_edge].map(|edge| Member::side(edge, flank))
    }

    /// The elements to the right and to the left where the curve leaves the corner on a side.
    fn outwards(&self, flank: Flank) -> (Member, Member) {
        let [side, second] = self.sides(flank);
        let first = if self.corner(flank) == Corner::Reflex { self.own } else { side };
        // On the left side the chain that comes first along the boundary lies to the left.
        if (flank == Flank::Left) == self.ends_first { (second, first) } else { (first, second) }
    }

    /// Whether no part of the plane belongs to a corner: what the second chain has for it belongs to the
    /// first one, and where the two edges go straight on nothing is nearest to it.
    pub fn drops(&self, corner: Member) -> bool {
        corner == self.dropped || (corner == self.own && self.corner == Corner::Straight)
    }

    /// Whether the curve runs along the rim of what is dropped, with a cell of the one chain to one hand
    /// and one of the other chain to the other.
    pub fn is_along(&self, cell: Member, other: Member) -> bool {
        let is_normal = |&flank: &Flank| {
            let [first, second] = self.sides(flank);
            (cell, other) == (first, second) || (cell, other) == (second, first)
        };
        other == self.own || (self.corner == Corner::Straight && self.flanks.iter().any(is_normal))
    }

    /// Whether the arc between two cells is lost where it ends in the corner.
    pub fn takes(&self, cell: Member, beyond: Member) -> bool {
        self.flanks.iter().any(|&flank| {
            let (sides, is_reflex) = (self.sides(flank), self.corner(flank) == Corner::Reflex);
            if cell == self.own {
                beyond == sides[0] && !is_reflex
            } else {
                sides.contains(&cell) && !(is_reflex && beyond == self.own)
            }
        })
    }
}

/// A merge.
pub(super) struct Merge<'m, 'a> {
    pub members: Members<'a>,
    pub diagram: &'m mut Diagram,
    pub joints: &'m [Joint],
    pub watch: &'m Watch<'m>,
    /// What is asked of the last merge of a ring.
    pub asked: Asked,
}

/// Where the curve around a ring crosses an arc of the ring's own diagram.
pub(super) struct Crossing {
    /// The arc as the cell sees it that the curve leaves; from there on it is lost.
    pub half: u32,
    /// The disk there.
    pub start: Disk,
    /// The element on the other side where the curve goes on.
    pub left: Member,
}

/// Where a closed curve was begun.
struct Closing {
    half: u32,
    start: Disk,
    piece: u32,
    right: Member,
    left: Member,
}

/// The curve on its way.
pub(super) struct Curve {
    pub right: Member,
    pub left: Member,
    /// The next arc of either cell to be looked at.
    pub right_cursor: u32,
    pub left_cursor: u32,
    /// Where either cell reaches infinity before that arc.
    pub right_gap: Option<Gap>,
    pub left_gap: Option<Gap>,
    /// The last vertex of either cell that the other chain was found to take away.
    pub right_lost: u32,
    pub left_lost: u32,
    /// In which cell the curve has come last.
    pub entered: Hand,
    /// Where the present piece starts; `None` in a corner.
    pub start: Option<Disk>,
    /// The piece as the left cell sees it.
    pub piece: u32,
}

impl Curve {
    /// A curve between two cells, each with the arc to be looked at first.
    fn new(
        (right, right_cursor): (Member, u32),
        (left, left_cursor): (Member, u32),
        start: Option<Disk>,
        piece: u32,
    ) -> Self {
        Self {
            right,
            left,
            right_cursor,
            left_cursor,
            right_gap: None,
            left_gap: None,
            right_lost: NONE,
            left_lost: NONE,
            entered: Hand::Left,
            start,
            piece,
        }
    }
}

impl<'m, 'a> Merge<'m, 'a> {
    pub fn new(
        members: Members<'a>,
        diagram: &'m mut Diagram,
        joints: &'m [Joint],
        watch: &'m Watch<'m>,
    ) -> Self {
        Self { members, diagram, joints, watch, asked: Asked::Left }
    }

    /// Merges the diagrams.
    pub fn run(mut self) -> Result<(), EngineError> {
        let joints = self.joints;
        let mut met: SmallVec<[(usize, Flank); 4]> = SmallVec::new();
        for (k, joint) in joints.iter().enumerate() {
            let both = joints.len() == 1 || self.asked == Asked::Both;
            let is_asked = |flank: &&Flank| both || **flank == Flank::Left;
            for &flank in joint.flanks.iter().filter(is_asked) {
                if met.contains(&(k, flank)) {
                    continue;
                }
                met.push((k, flank));
                let (right, left) = joint.outwards(flank);
                met.extend(self.walk(right, left)?);
            }
        }
        Ok(())
    }

    /// Follows the curve from a joint to another one, or the same on its other side, or to infinity.
    fn walk(&mut self, right: Member, left: Member) -> Result<Option<(usize, Flank)>, EngineError> {
        let piece = self.diagram.arc(left, right, APEX);
        let ends = &mut self.diagram.ends;
        let left_cursor = std::mem::replace(&mut ends[left.0 as usize][0], piece);
        let right_cursor = std::mem::replace(&mut ends[right.0 as usize][1], piece ^ 1);
        let mut curve = Curve::new((right, right_cursor), (left, left_cursor), None, piece);
        self.follow(&mut curve, None)
    }

    /// Follows the curve to a joint, to infinity, or until it closes.
    fn follow(
        &mut self,
        curve: &mut Curve,
        closing: Option<&Closing>,
    ) -> Result<Option<(usize, Flank)>, EngineError> {
        let most = 16 * self.diagram.ends.len() + 64;
        for _ in 0..most {
            self.watch.check()?;
            self.diagram.pieces += 1;
            let (to_left, to_right) =
                if closing.is_some() { self.look_around(curve) } else { self.look_both(curve) };
            let order = match (to_left.disk(), to_right.disk()) {
                (Some(l), Some(r)) => self.members.order(l, r, curve.right, curve.left),
                (Some(_), None) => Ordering::Less,
                (None, Some(_)) => Ordering::Greater,
                (None, None) => return self.end(curve, &to_left, &to_right),
            };
            let closes = closing.filter(|closing| {
                order.is_ge()
                    && matches!(to_right, Ahead::Arc(_, _, half) if half == closing.half)
                    && to_right.disk().is_some_and(|disk| {
                        let start = &closing.start;
                        self.members.order(disk, start, curve.right, curve.left).is_eq()
                    })
            });
            self.cross(
                curve,
                order.is_le().then_some(to_left),
                order.is_ge().then_some(to_right),
                closes.map(|closing| closing.piece),
            );
            if let Some(closing) = closes {
                return if (curve.right, curve.left) == (closing.right, closing.left) {
                    Ok(None)
                } else {
                    Err(self.broken(curve, "closing a merge curve"))
                };
            }
        }
        Err(self.broken(curve, "following a merge curve"))
    }

    /// Merges the diagram of a ring into that of others around it, given where the curve crosses an arc
    /// of the ring.
    pub fn close(mut self, crossing: Crossing) -> Result<(), EngineError> {
        let Crossing { half, start, left } = crossing;
        let right = self.diagram.beyond(half);
        // Arcs that the curve does not see are passed over.
        let left_cursor = self.diagram.ends[left.0 as usize][0];
        let vertex = self.diagram.vertex(start);
        let right_cursor = self.split(half, vertex, Hand::Right);
        let piece = self.diagram.arc(left, right, vertex);
        let mut curve = Curve::new((right, right_cursor), (left, left_cursor), Some(start), piece);
        // Seen from the cell that it comes back through, it ends where the lost part starts.
        let kept = half;
        let half = right_cursor ^ 1;
        self.diagram.halves[half as usize].prev = kept;
        self.diagram.halves[right_cursor as usize].next = kept ^ 1;
        self.follow(&mut curve, Some(&Closing { half, start, piece, right, left })).map(|_| ())
    }

    fn broken(&self, curve: &Curve, stage: &'static str) -> EngineError {
        let place = match &curve.start {
            Some(start) => start.disk.position(),
            None => self.members.ends(curve.left).0,
        };
        self.watch.or(EngineError::Internal { stage, place })
    }

    /// Ends the curve at infinity or in a joint.
    fn end(
        &mut self,
        curve: &Curve,
        left: &Ahead,
        right: &Ahead,
    ) -> Result<Option<(usize, Flank)>, EngineError> {
        let piece = curve.piece;
        if let (&Ahead::Infinity(left), &Ahead::Infinity(right)) = (left, right) {
            self.diagram.halves[piece as usize ^ 1].from = INFINITE;
            self.diagram.link(piece, left);
            self.diagram.link(right, piece ^ 1);
            return Ok(None);
        }
        let met = self.joints.iter().enumerate().find_map(|(k, joint)| {
            // Inwards, left and right are those of outwards exchanged.
            let is_met = |&&f: &&Flank| joint.outwards(f) == (curve.left, curve.right);
            joint.flanks.iter().find(is_met).map(|&flank| (k, flank))
        });
        let at_element = |ahead: &Ahead| matches!(ahead, Ahead::Element);
        match met {
            Some(met) if at_element(left) && at_element(right) => {
                self.diagram.halves[piece as usize ^ 1].from = APEX;
                self.diagram.ends[curve.left.0 as usize][1] = piece;
                self.diagram.ends[curve.right.0 as usize][0] = piece ^ 1;
                self.diagram.halves[piece as usize].next = NONE;
                self.diagram.halves[piece as usize ^ 1].prev = NONE;
                Ok(Some(met))
            }
            _ => Err(self.broken(curve, "ending a merge curve")),
        }
    }
}
