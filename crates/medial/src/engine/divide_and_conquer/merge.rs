//! The merge of the diagrams of two chains that share one corner, or both.
//!
//! The shared corners belong to the first chain, which also wins every tie: the second one counts where
//! it is strictly nearer. So the merge curve is one closed curve on the sphere through each shared
//! corner: where the boundary is convex it starts as the bisector of the two edges there, elsewhere as
//! the normal of the second chain's edge.

use std::cmp::Ordering;

use super::diagram::{APEX, Diagram, Half, INFINITE, NONE, Vertex};
use super::elements::{Disk, Flank, Member, Members};
use crate::geom::{Point, orient2d};

/// Sine of an angle from which doubles tell on which side of a spoke a vertex lies.
const CLEARLY: f64 = 1e-9;

/// What went wrong where.
#[derive(Clone, Copy, Debug)]
pub(super) struct Broken {
    pub stage: &'static str,
    pub place: Point,
}

/// A corner in which the two chains meet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Joint {
    /// The corner as the first chain has it, and as the second one does.
    pub own: Member,
    pub dropped: Member,
    /// The edges of the first and the second chain there.
    first_edge: u32,
    second_edge: u32,
    /// Whether the first chain ends here, or starts.
    ends_first: bool,
    /// The side on which the boundary is convex.
    convex: Flank,
}

impl Joint {
    /// Where one chain ends with an edge and another starts with the next one.
    pub fn new(members: &Members<'_>, before: u32, after: u32, ends_first: bool) -> Option<Self> {
        let (a, b) = members.ends(Member::side(before, Flank::Left));
        let (_, c) = members.ends(Member::side(after, Flank::Left));
        let convex = match turn(a, b, c) {
            Ordering::Greater => Flank::Left,
            Ordering::Less => Flank::Right,
            Ordering::Equal => return None,
        };
        let (end, start) = (Member::end(before), Member::start(after));
        let joint = Self {
            own: end,
            dropped: start,
            first_edge: before,
            second_edge: after,
            ends_first,
            convex,
        };
        Some(if ends_first {
            joint
        } else {
            Self { own: start, dropped: end, first_edge: after, second_edge: before, ..joint }
        })
    }

    /// The elements to the right and to the left where the curve leaves the corner on a side.
    fn outwards(&self, flank: Flank) -> (Member, Member) {
        let second = Member::side(self.second_edge, flank);
        let first =
            if flank == self.convex { Member::side(self.first_edge, flank) } else { self.own };
        // On the left side the chain that comes first along the boundary lies to the left.
        if (flank == Flank::Left) == self.ends_first { (second, first) } else { (first, second) }
    }
}

/// On which side of the line through two points a third one lies: `Greater` on the left.
fn turn(a: Point, b: Point, c: Point) -> Ordering {
    // Zero has two signs.
    orient2d(a, b, c).partial_cmp(&0.0).unwrap_or(Ordering::Equal)
}

/// What a cell has for the curve.
#[derive(Debug)]
enum Ahead {
    /// Nothing; the curve goes on through the cell for as long as the other cell lets it.
    Nothing,
    /// The list of arcs ends at the element itself.
    Element,
    /// The cell reaches infinity before this arc.
    Infinity(u32),
    /// This arc is met; at a vertex of the diagram, if it is its far end.
    Arc(Box<Disk>, Option<u32>, u32),
    /// The curve runs along an arc of a dropped corner up to a vertex.
    Rim(Box<Disk>, u32),
}

impl Ahead {
    fn disk(&self) -> Option<&Disk> {
        match self {
            Self::Arc(disk, ..) | Self::Rim(disk, _) => Some(disk),
            _ => None,
        }
    }

    fn vertex(&self) -> Option<u32> {
        match *self {
            Self::Arc(_, vertex, _) => vertex,
            Self::Rim(_, vertex) => Some(vertex),
            _ => None,
        }
    }
}

/// Left of the curve the arcs of a cell are met counterclockwise, right of it clockwise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Hand {
    Left,
    Right,
}

/// A merge.
pub(super) struct Merge<'m, 'a> {
    members: Members<'a>,
    diagram: &'m mut Diagram,
    joints: &'m [Joint],
}

/// Where the curve around a ring crosses an arc of the ring's own diagram.
pub(super) struct Crossing {
    /// The arc as the cell sees it that the curve leaves; from there on it is lost.
    pub half: u32,
    /// The disk there.
    pub start: Disk,
    /// The element on the other side where the curve goes on.
    pub left: Member,
    /// An arc around that element's cell, behind the curve as seen from the element.
    pub left_cursor: u32,
}

/// Where a closed curve was begun.
struct Closing {
    half: u32,
    start: Disk,
    piece: u32,
    right: Member,
    left: Member,
}

/// Up to where a cell is asked for arcs.
#[derive(Clone, Copy)]
enum Reach<'d> {
    /// Up to the first end that the other element does not take away.
    Near,
    /// Up to a disk on the curve.
    UpTo(&'d Disk),
    All,
}

/// The curve on its way.
struct Curve {
    right: Member,
    left: Member,
    /// The next arc of either cell to be looked at.
    right_cursor: u32,
    left_cursor: u32,
    /// Where either cell reaches infinity before that arc.
    right_gap: Option<Gap>,
    left_gap: Option<Gap>,
    /// Where the present piece starts; `None` in a corner.
    start: Option<Disk>,
    /// The piece as the left cell sees it.
    piece: u32,
}

/// The directions in which a cell reaches infinity.
#[derive(Clone, Copy, Debug)]
struct Gap {
    /// The unbounded arc before them, whose far end is lost to the other chain.
    half: u32,
    /// They are lost up to the one in which this point is as near as the cell.
    reached: Option<Point>,
}

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

impl<'m, 'a> Merge<'m, 'a> {
    pub fn new(members: Members<'a>, diagram: &'m mut Diagram, joints: &'m [Joint]) -> Self {
        Self { members, diagram, joints }
    }

    /// Merges the diagrams.
    pub fn run(mut self) -> Result<(), Broken> {
        let joints = self.joints;
        let mut met: Vec<(usize, Flank)> = Vec::new();
        for (k, joint) in joints.iter().enumerate() {
            for flank in [Flank::Left, Flank::Right] {
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
    fn walk(&mut self, right: Member, left: Member) -> Result<Option<(usize, Flank)>, Broken> {
        let ends = |d: &Diagram, m: Member| d.ends[m.0 as usize];
        let (left_cursor, right_cursor) =
            (ends(self.diagram, left)[0], ends(self.diagram, right)[1]);
        let piece = self.diagram.arc(left, right, APEX);
        self.diagram.ends[left.0 as usize][0] = piece;
        self.diagram.ends[right.0 as usize][1] = piece ^ 1;
        let mut curve = Curve {
            right,
            left,
            right_cursor,
            left_cursor,
            right_gap: None,
            left_gap: None,
            start: None,
            piece,
        };
        self.follow(&mut curve, None)
    }

    /// Follows the curve to a joint, to infinity, or until it closes.
    fn follow(
        &mut self,
        curve: &mut Curve,
        closing: Option<&Closing>,
    ) -> Result<Option<(usize, Flank)>, Broken> {
        let most = 16 * self.diagram.ends.len() + 64;
        for _ in 0..most {
            self.diagram.merged += 1;
            let (to_left, to_right) = if closing.is_some() {
                self.look_around(curve)
            } else {
                (self.look(curve, Hand::Left), self.look(curve, Hand::Right))
            };
            if std::env::var("DC").is_ok() { let f = |a: &Ahead| match a { Ahead::Arc(d, v, _) => format!("arc {:?} c {:?} r {} v {v:?}", d.triple.map(|t| (t.0>>2, t.0&3)), d.disk.position(), d.disk.radius), Ahead::Rim(d, v) => format!("rim {:?} {v}", d.triple.map(|t| (t.0>>2, t.0&3))), o => format!("{o:?}") }; let g = |c: u32| if c == NONE { "none".to_owned() } else { let h = self.diagram.half(c); format!("{}:{:?}", c, (self.diagram.beyond(c).0>>2, self.diagram.beyond(c).0&3, h.from as i32, self.diagram.to(c) as i32)) }; eprintln!("left {:?} right {:?} | L {} ({}) | R {} ({})", (curve.left.0>>2, curve.left.0&3), (curve.right.0>>2, curve.right.0&3), f(&to_left), g(curve.left_cursor), f(&to_right), g(curve.right_cursor)); }
            let order = match (to_left.disk(), to_right.disk()) {
                (Some(l), Some(r)) => {
                    self.members.order(&l.exact, &r.exact, curve.right, curve.left)
                }
                (Some(_), None) => Ordering::Less,
                (None, Some(_)) => Ordering::Greater,
                (None, None) => return self.end(curve, &to_left, &to_right),
            };
            let closes = closing.filter(|closing| {
                order.is_ge()
                    && matches!(to_right, Ahead::Arc(_, _, half) if half == closing.half)
                    && to_right.disk().is_some_and(|disk| {
                        let start = &closing.start.exact;
                        self.members.order(&disk.exact, start, curve.right, curve.left).is_eq()
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
    pub fn close(mut self, crossing: Crossing) -> Result<(), Broken> {
        let Crossing { half, start, left, left_cursor } = crossing;
        let right = self.diagram.beyond(half);
        let vertex = self.diagram.vertices.len() as u32;
        self.diagram.vertices.push(Vertex { triple: start.triple, disk: start.disk });
        let right_cursor = self.split(half, vertex, Hand::Right);
        let piece = self.diagram.arc(left, right, vertex);
        let mut curve = Curve {
            right,
            left,
            right_cursor,
            left_cursor,
            right_gap: None,
            left_gap: None,
            start: Some(start.clone()),
            piece,
        };
        // Seen from the cell that it comes back through, it ends where the lost part starts.
        let kept = half;
        let half = right_cursor ^ 1;
        self.diagram.halves[half as usize].prev = kept;
        self.diagram.halves[right_cursor as usize].next = kept ^ 1;
        self.follow(&mut curve, Some(&Closing { half, start, piece, right, left })).map(|_| ())
    }

    fn broken(&self, curve: &Curve, stage: &'static str) -> Broken {
        let place = match &curve.start {
            Some(start) => start.disk.position(),
            None => self.members.ends(curve.left).0,
        };
        Broken { stage, place }
    }

    fn step(&self, half: u32, hand: Hand) -> u32 {
        let half = self.diagram.half(half);
        if hand == Hand::Left { half.next } else { half.prev }
    }

    fn far(&self, half: u32, hand: Hand) -> u32 {
        if hand == Hand::Left { self.diagram.to(half) } else { self.diagram.half(half).from }
    }

    fn joint_that_dropped(&self, member: Member) -> Option<&Joint> {
        self.joints.iter().find(|j| j.dropped == member)
    }

    fn vertex(&self, vertex: u32) -> Disk {
        let Vertex { triple, disk } = self.diagram.vertices[vertex as usize];
        self.members.known(triple, disk)
    }

    /// Whether a disk lies ahead of the start of the present piece.
    fn is_ahead(&self, curve: &Curve, disk: &Disk) -> bool {
        curve.start.as_ref().is_none_or(|start| {
            self.members.order(&disk.exact, &start.exact, curve.right, curve.left).is_gt()
        })
    }

    /// What comes next where the curve is all around a ring: what either cell has ahead, and the order
    /// of the two.
    ///
    /// It may cross an arc more than once, and come to an end of one that only another part of the ring
    /// takes away. So each cell is asked for all arcs up to the place where the other one has something.
    fn look_around(&mut self, curve: &mut Curve) -> (Ahead, Ahead) {
        let mut left = self.look_up_to(curve, Hand::Left, Reach::Near);
        let mut right = self.look_up_to(curve, Hand::Right, Reach::Near);
        loop {
            let first = match (left.disk(), right.disk()) {
                (Some(l), Some(r)) => {
                    let order = self.members.order(&l.exact, &r.exact, curve.right, curve.left);
                    Some(if order.is_le() { l } else { r })
                }
                (first, None) | (None, first) => first,
            };
            let first = first.cloned();
            let reach = || first.as_ref().map_or(Reach::All, Reach::UpTo);
            left = self.look_up_to(curve, Hand::Left, reach());
            right = self.look_up_to(curve, Hand::Right, reach());
            let Some(first) = &first else { return (left, right) };
            let is_new = |ahead: &Ahead| {
                ahead.disk().is_some_and(|disk| {
                    self.members
                        .order(&disk.exact, &first.exact, curve.right, curve.left)
                        .is_lt()
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
            self.diagram.looked_at += 1;
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
                (Some(vertex), _) => self.members.meets(&vertex.exact, other),
                // A ring inside another one loses all that is far away.
                (None, INFINITE) => Ordering::Less,
                (None, _) => Ordering::Greater,
            };
            let is_at_end =
                meets.is_eq() && vertex.as_ref().is_some_and(|vertex| self.is_ahead(curve, vertex));
            let met = if is_at_end {
                vertex.clone().map(|vertex| (vertex, Some(far), half))
            } else {
                let disk =
                    self.members.disk([curve.right, self.diagram.beyond(half), curve.left]);
                disk.filter(|disk| {
                    let in_zone = |&m: &Member| self.members.in_zone_of_ring(&disk.exact, m);
                    disk.triple.iter().all(in_zone)
                        && self.is_ahead(curve, disk)
                        && self.is_on(half, disk)
                })
                .map(|disk| (disk, None, half))
            };
            if let Some(met) = met {
                let (right, left) = (curve.right, curve.left);
                let order = |d: &Disk, e: &Disk| self.members.order(&d.exact, &e.exact, right, left);
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
        first.map_or(Ahead::Nothing, |(disk, vertex, half)| {
            Ahead::Arc(Box::new(disk), vertex, half)
        })
    }

    /// Whether the centre of a disk that touches both elements of an arc lies on the arc, and not on
    /// another one of the same two.
    fn is_on(&self, half: u32, disk: &Disk) -> bool {
        let (left, right) = (self.diagram.half(half).cell, self.diagram.beyond(half));
        let order = |vertex: u32| {
            let vertex = self.vertex(vertex);
            self.members.order(&disk.exact, &vertex.exact, right, left)
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
        let (a, b) = self.members.ends(cell);
        let order = if cell.is_corner() {
            let (way, to) = (disk.disk.position() - a, vertex.disk.position() - a);
            let turn = way.cross(to);
            if turn.abs() <= CLEARLY * way.norm() * to.norm() || way.dot(to) < 0.0 {
                return None;
            }
            turn.total_cmp(&0.0)
        } else {
            // Counterclockwise around the cell is against the direction of the edge.
            disk.exact.compare_along(&vertex.exact, a, b)
        };
        Some(if hand == Hand::Left { order } else { order.reverse() })
    }

    /// What the cell to one hand has ahead.
    fn look(&mut self, curve: &mut Curve, hand: Hand) -> Ahead {
        let (cell, other) = match hand {
            Hand::Left => (curve.left, curve.right),
            Hand::Right => (curve.right, curve.left),
        };
        let (mut cursor, mut gap) = match hand {
            Hand::Left => (curve.left_cursor, curve.left_gap),
            Hand::Right => (curve.right_cursor, curve.right_gap),
        };
        let ahead = loop {
            if let Some(gap) = &mut gap
                && !self.is_gap_beaten(gap, cursor, hand, other)
            {
                break Ahead::Infinity(cursor);
            }
            gap = None;
            let half = cursor;
            if half == NONE {
                break Ahead::Element;
            }
            self.diagram.looked_at += 1;
            let (beyond, far) = (self.diagram.beyond(half), self.far(half, hand));
            if let Some(joint) = self.joint_that_dropped(beyond) {
                // The first chain keeps this part of the plane; the curve may run along its rim.
                let along = joint.own == other;
                match far {
                    APEX => break Ahead::Element,
                    INFINITE => {
                        if !along && !self.is_beaten(half, hand, other) {
                            break Ahead::Nothing;
                        }
                        let after = self.step(half, hand);
                        if along {
                            break Ahead::Infinity(after);
                        }
                        (cursor, gap) = (after, Some(Gap { half, reached: None }));
                        continue;
                    }
                    _ => {}
                }
                let vertex = self.vertex(far);
                // Where it comes to the rim in a vertex it leaves it at once.
                let meets = if along {
                    Ordering::Equal
                } else {
                    self.members.meets(&vertex.exact, other)
                };
                match meets {
                    Ordering::Less => {}
                    Ordering::Equal if self.is_ahead(curve, &vertex) => {
                        break Ahead::Rim(Box::new(vertex), far);
                    }
                    Ordering::Equal if along => {}
                    _ => break Ahead::Nothing,
                }
                cursor = self.step(half, hand);
                continue;
            }
            match far {
                APEX => {
                    if self.is_dead_wall(cell, beyond) {
                        break Ahead::Element;
                    }
                }
                INFINITE => {
                    if self.is_beaten(half, hand, other) {
                        cursor = self.step(half, hand);
                        gap = Some(Gap { half, reached: None });
                        continue;
                    }
                }
                _ => {
                    let vertex = self.vertex(far);
                    match self.members.meets(&vertex.exact, other) {
                        Ordering::Less => {
                            cursor = self.step(half, hand);
                            continue;
                        }
                        Ordering::Equal => {
                            if self.is_ahead(curve, &vertex) {
                                break Ahead::Arc(Box::new(vertex), Some(far), half);
                            }
                            cursor = self.step(half, hand);
                            continue;
                        }
                        Ordering::Greater => {}
                    }
                }
            }
            let disk = self.members.disk([curve.right, beyond, curve.left]).filter(|disk| {
                self.members.in_zone(&disk.exact, beyond) && self.is_ahead(curve, disk)
            });
            break disk.map_or(Ahead::Nothing, |disk| Ahead::Arc(Box::new(disk), None, half));
        };
        match hand {
            Hand::Left => (curve.left_cursor, curve.left_gap) = (cursor, gap),
            Hand::Right => (curve.right_cursor, curve.right_gap) = (cursor, gap),
        }
        ahead
    }

    /// Whether the arc between two cells is the normal at a joint on its convex side, where another
    /// edge is nearer.
    fn is_dead_wall(&self, a: Member, b: Member) -> bool {
        let (corner, side) = if a.is_corner() { (a, b) } else { (b, a) };
        !side.is_corner() && self.joints.iter().any(|j| j.own == corner && j.convex == side.flank())
    }

    /// Two points on the line that an unbounded arc is perpendicular to, so that its far end lies to the
    /// left of it: the two corners between which it runs, or the ends of the edge whose normal it is.
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
    fn is_beaten(&self, half: u32, hand: Hand, by: Member) -> bool {
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
        let after = |p: Point, q: Point| p.lexicographic(q).is_gt() == l.lexicographic(r).is_lt() && p != q;
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
    fn is_gap_beaten(&self, gap: &mut Gap, after: u32, hand: Hand, by: Member) -> bool {
        let opposite = if hand == Hand::Left { Hand::Right } else { Hand::Left };
        let beyond = |(l, r): (Point, Point), p: Point| turn(l, r, p).is_gt();
        let place = self.members.ends(self.diagram.half(gap.half).cell).0;
        let (u, v) = self.members.ends(by);
        // Each end of the element may make the other one count.
        for p in [u, v, u] {
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

    /// Ends the present piece where an arc of either cell, or of both, is met, and starts the next.
    ///
    /// The next piece may be there already, where the curve closes.
    fn cross(
        &mut self,
        curve: &mut Curve,
        left: Option<Ahead>,
        right: Option<Ahead>,
        next: Option<u32>,
    ) {
        for (met, cursor) in
            [(&left, &mut curve.left_cursor), (&right, &mut curve.right_cursor)]
        {
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
                    for half in self.diagram.around(half) {
                        self.diagram.halves[half as usize].from = r;
                    }
                }
                r
            }
            (Some(vertex), None) | (None, Some(vertex)) => vertex,
            (None, None) => {
                let disk = left.as_ref().or(right.as_ref()).and_then(Ahead::disk);
                let Some(Disk { triple, disk, .. }) = disk else { return };
                self.diagram.vertices.push(Vertex { triple: *triple, disk: *disk });
                self.diagram.vertices.len() as u32 - 1
            }
        };
        let to_left = left
            .as_ref()
            .and_then(|a| self.cut(curve.left_cursor, a, vertex, Hand::Left));
        let to_right = right
            .as_ref()
            .and_then(|a| self.cut(curve.right_cursor, a, vertex, Hand::Right));
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
        }
        if let Some(cut) = &to_right {
            (curve.right, curve.right_cursor, curve.right_gap) = (cut.cell, cut.cursor, cut.gap);
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
            | (_, Some(Ahead::Arc(disk, ..) | Ahead::Rim(disk, _))) => Some(*disk),
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
    fn split(&mut self, half: u32, vertex: u32, hand: Hand) -> u32 {
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
    fn cut(
        &mut self,
        half: u32,
        ahead: &Ahead,
        vertex: u32,
        hand: Hand,
    ) -> Option<Cut> {
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
        let cursor = if hand == Hand::Left { new.next } else { new.prev };
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
                let (old, new) = match hand {
                    Hand::Left => (old.next, new.prev),
                    Hand::Right => (old.prev, new.next),
                };
                Some(Cut { old, new, cell, cursor, gap })
            }
            Ahead::Rim(..) => {
                let own = old.cell;
                // Around the vertex over the dropped corners.
                let mut turned = twin;
                let rim = loop {
                    let turned_half = d.half(turned);
                    let arc =
                        if hand == Hand::Left { turned_half.prev } else { turned_half.next };
                    let cell = d.beyond(arc);
                    if cell == own {
                        return None;
                    }
                    if self.joints.iter().all(|j| j.dropped != cell) {
                        break arc ^ 1;
                    }
                    turned = arc ^ 1;
                };
                let new = *d.half(rim);
                let (old, new_half) = match hand {
                    Hand::Left => (old.next, new.prev),
                    Hand::Right => (old.prev, new.next),
                };
                Some(Cut { old, new: new_half, cell: new.cell, cursor: rim, gap: None })
            }
            _ => None,
        }
    }

    /// Ends the curve at infinity or in a joint.
    fn end(
        &mut self,
        curve: &Curve,
        left: &Ahead,
        right: &Ahead,
    ) -> Result<Option<(usize, Flank)>, Broken> {
        let piece = curve.piece;
        if let (&Ahead::Infinity(left), &Ahead::Infinity(right)) = (left, right) {
            self.diagram.halves[piece as usize ^ 1].from = INFINITE;
            self.diagram.link(piece, left);
            self.diagram.link(right, piece ^ 1);
            return Ok(None);
        }
        let met = self.joints.iter().enumerate().find_map(|(k, joint)| {
            // Inwards, left and right are those of outwards exchanged.
            let flanks = [Flank::Left, Flank::Right];
            let flank = flanks.into_iter().find(|&f| joint.outwards(f) == (curve.left, curve.right));
            flank.map(|flank| (k, flank))
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
