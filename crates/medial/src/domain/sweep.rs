//! One plane sweep over all edges of a feature: crossings, touches, nesting.
//!
//! # Contract
//! Finds whether any two edges cross, or overlap in a way that is refused; otherwise every point
//! where boundaries touch, with what follows for the walks there. O(n log n) for n edges, each
//! decision exact.
//!
//! # Method
//! Bentley and Ottmann's sweep, with events at vertices only, in lexicographic order: the first
//! proper crossing is an error, and it is found when its edges become neighbours in the status.
//! At an event the edges through the point are a contiguous range of the status. The plain cases,
//! one vertex met by nothing else, are handled here; all others in `junction`.
//!
//! # Departures
//! The winding number just above each edge follows from the edge itself (inside, if it runs to the
//! right), so it is compared with that of the edge below once, where the edge starts; that is all
//! there is to nesting.

use super::rings::Rings;
use super::status::{Found, NONE, Status};
use super::{DomainError, NestingFault, Place};
use crate::geom::{Point, order_key, orient2d};

/// A piece of an edge between touches; parts count from the lexicographically smaller end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Piece {
    pub(super) edge: u32,
    pub(super) part: u32,
}

/// What the sweep finds.
#[derive(Default)]
pub(super) struct Arrangement {
    /// Edges touched in their inside, with the corners there, in order along each edge.
    pub(super) cuts: Vec<(u32, Point)>,
    /// Edges touched in their inside by corners of other polygons alone, which do not cut them.
    pub(super) touched: Vec<(u32, Point)>,
    /// Pieces that are run through both ways.
    pub(super) removed: Vec<Piece>,
    /// Which piece follows which one where that is not the next one of the ring.
    pub(super) links: Vec<(Piece, Piece)>,
    /// The smallest ring around each ring, or `NONE`.
    pub(super) parents: Vec<u32>,
    /// Edges that end or pass where their ring touches itself.
    pub(super) self_touches: Vec<u32>,
    /// First findings that only strictness refuses.
    pub(super) bridge: Option<DomainError>,
    pub(super) self_touch: Option<DomainError>,
    pub(super) shared_edge: Option<DomainError>,
}

/// What the sweep asks of the feature.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Purpose {
    /// Directions are final: the interior must lie to the left of every edge.
    Validate,
    /// All rings run counterclockwise: only find which ring lies in which.
    Nest,
}

pub(super) fn sweep(rings: &Rings, purpose: Purpose) -> Result<Arrangement, DomainError> {
    let mut sweep = Sweep::new(rings, purpose);
    let events = events(rings);
    let mut start = 0;
    while start < events.len() {
        let p = events[start].0;
        let len = events[start..].iter().take_while(|e| e.0 == p).count();
        sweep.event(p, &events[start..start + len])?;
        start += len;
    }
    match sweep.violation {
        Some(violation) => Err(sweep.explain(violation)),
        None => Ok(sweep.found),
    }
}

/// All vertices in lexicographic order.
fn events(rings: &Rings) -> Vec<(Point, u32)> {
    // Integers sort faster than points.
    let mut keys: Vec<(i64, u32)> =
        rings.points.iter().zip(0..).map(|(point, vertex)| (order_key(point.x), vertex)).collect();
    keys.sort_unstable();
    let y = |vertex: u32| order_key(rings.point(vertex).y);
    for same in keys.chunk_by_mut(|a, b| a.0 == b.0).filter(|same| same.len() > 1) {
        same.sort_unstable_by_key(|k| (y(k.1), k.1));
    }
    keys.into_iter().map(|(_, vertex)| (rings.point(vertex), vertex)).collect()
}

/// An edge as the sweep sees it.
pub(super) struct Segment {
    /// The lexicographically smaller end.
    pub(super) left: Point,
    /// The lexicographically larger end.
    pub(super) right: Point,
    pub(super) ring: u32,
    pub(super) polygon: u32,
    /// Node in the status.
    pub(super) node: u32,
    /// Number of touches met so far.
    pub(super) cuts: u32,
    /// Whether the edge runs from left to right, with the interior above it.
    pub(super) forward: bool,
    /// Whether what its own ring encloses lies above it.
    pub(super) enters_ring: bool,
    /// Whether another edge of the polygon runs back along the present piece.
    pub(super) bridged: bool,
    /// For a bridged piece: polygon just above it plus one, or 0.
    pub(super) state: u32,
}

/// Where the interior is not on the left of an edge.
#[derive(Clone, Copy)]
pub(super) struct Violation {
    pub(super) at: Point,
    pub(super) edge: u32,
    /// Edge just below it, or `NONE`.
    pub(super) below: u32,
}

pub(super) struct Sweep<'a, 'b> {
    pub(super) rings: &'a Rings<'b>,
    pub(super) purpose: Purpose,
    pub(super) segments: Vec<Segment>,
    pub(super) status: Status,
    pub(super) born: Vec<bool>,
    pub(super) found: Arrangement,
    pub(super) violation: Option<Violation>,
    /// First point where passages of one polygon cross at a corner.
    pub(super) corner_crossing: Option<DomainError>,
    /// Twice the area of rings, when asked for.
    pub(super) sizes: Vec<Option<dashu_int::IBig>>,
}

impl<'a, 'b> Sweep<'a, 'b> {
    fn new(rings: &'a Rings<'b>, purpose: Purpose) -> Self {
        let segment = |edge: u32| {
            let (from, to) = (rings.point(edge), rings.point(rings.next(edge)));
            let forward = from.lexicographic(to).is_lt();
            let (left, right) = if forward { (from, to) } else { (to, from) };
            let ring = rings.ring_of(edge);
            Segment {
                left,
                right,
                ring: rings.ring[edge as usize],
                polygon: ring.polygon,
                node: NONE,
                cuts: 0,
                forward,
                enters_ring: forward != ring.hole,
                bridged: false,
                state: 0,
            }
        };
        let n_rings = rings.rings.len();
        Self {
            rings,
            purpose,
            segments: (0..rings.points.len() as u32).map(segment).collect(),
            status: Status::new(),
            born: vec![false; n_rings],
            found: Arrangement { parents: vec![NONE; n_rings], ..Arrangement::default() },
            violation: None,
            corner_crossing: None,
            sizes: Vec::new(),
        }
    }

    fn event(&mut self, p: Point, group: &[(Point, u32)]) -> Result<(), DomainError> {
        if let &[(_, vertex)] = group
            && self.plain_event(p, vertex)?
        {
            return Ok(());
        }
        self.junction(p, group)
    }

    /// Handles a vertex through which nothing else passes; says whether it was one.
    fn plain_event(&mut self, p: Point, vertex: u32) -> Result<bool, DomainError> {
        let before = self.before(vertex);
        let ends = [before, vertex].map(|e| self.segment(e).node != NONE);
        match ends {
            [false, false] => {
                let Found::Above(below) = self.status.search(|e| self.side(e, p)) else {
                    return Ok(false);
                };
                let turn = orient2d(p, self.segment(before).right, self.segment(vertex).right);
                let (low, high) = if turn > 0.0 { (before, vertex) } else { (vertex, before) };
                if turn == 0.0 {
                    return Ok(false);
                }
                let above = self.status.after(below);
                let low_node = self.insert_after(below, low);
                let high_node = self.insert_after(low_node, high);
                self.enter_above(p, below, &[low, high]);
                self.check_order(below, low_node)?;
                self.check_order(high_node, above)?;
            }
            [true, true] => {
                let nodes = [before, vertex].map(|e| self.segment(e).node);
                let (low, high) = if self.status.above(nodes[0]) == nodes[1] {
                    (nodes[0], nodes[1])
                } else {
                    (nodes[1], nodes[0])
                };
                let (below, above) = (self.status.below(low), self.status.above(high));
                if self.status.above(low) != high || self.meets(below, p) || self.meets(above, p) {
                    return Ok(false);
                }
                self.remove(low);
                self.remove(high);
                self.check_order(below, above)?;
            }
            [ends_before, _] => {
                let (old, new) = if ends_before { (before, vertex) } else { (vertex, before) };
                let node = self.segment(old).node;
                let (below, above) = (self.status.below(node), self.status.above(node));
                if self.meets(below, p) || self.meets(above, p) {
                    return Ok(false);
                }
                self.replace(node, new);
                self.check_order(below, node)?;
                self.check_order(node, above)?;
            }
        }
        Ok(true)
    }

    pub(super) fn segment(&self, edge: u32) -> &Segment {
        &self.segments[edge as usize]
    }

    /// The edge that ends at a vertex.
    pub(super) fn before(&self, vertex: u32) -> u32 {
        let ring = self.rings.ring_of(vertex);
        if vertex == ring.first { ring.first + ring.len - 1 } else { vertex - 1 }
    }

    /// Positive if the point lies above the edge's line.
    pub(super) fn side(&self, edge: u32, p: Point) -> f64 {
        let segment = self.segment(edge);
        orient2d(segment.left, segment.right, p)
    }

    /// Whether the edge of a node, if there is one, contains the point.
    pub(super) fn meets(&self, node: u32, p: Point) -> bool {
        node != NONE && self.side(self.status.edge(node), p) == 0.0
    }

    pub(super) fn insert_after(&mut self, node: u32, edge: u32) -> u32 {
        let node = self.status.insert_after(node, edge);
        self.segments[edge as usize].node = node;
        node
    }

    pub(super) fn replace(&mut self, node: u32, edge: u32) {
        self.status.set_edge(node, edge);
        self.segments[edge as usize].node = node;
    }

    pub(super) fn remove(&mut self, node: u32) {
        self.status.remove(node);
    }

    /// Refuses two neighbours that cross farther right.
    pub(super) fn check_order(&self, low: u32, high: u32) -> Result<(), DomainError> {
        if low == NONE || high == NONE {
            return Ok(());
        }
        let (low, high) = (self.status.edge(low), self.status.edge(high));
        let (a, b) = (self.segment(low), self.segment(high));
        let crosses = match a.right.lexicographic(b.right) {
            std::cmp::Ordering::Less => orient2d(b.left, b.right, a.right) > 0.0,
            std::cmp::Ordering::Greater => orient2d(a.left, a.right, b.right) < 0.0,
            std::cmp::Ordering::Equal => false,
        };
        if !crosses {
            return Ok(());
        }
        let (from, to) =
            (orient2d(a.left, a.right, b.left).abs(), orient2d(a.left, a.right, b.right).abs());
        let at = b.left + (b.right - b.left) * (from / (from + to));
        Err(self.crossing(low, high, at))
    }

    pub(super) fn crossing(&self, one: u32, other: u32, at: Point) -> DomainError {
        let (first, second) = self.places(one, other);
        if first.polygon == second.polygon {
            DomainError::Crossing { first, second, at }
        } else {
            DomainError::PolygonsOverlap { first, second, at }
        }
    }

    /// Places of two edges, the smaller first.
    pub(super) fn places(&self, one: u32, other: u32) -> (Place, Place) {
        let (a, b) = (self.rings.edge_place(one), self.rings.edge_place(other));
        (a.min(b), a.max(b))
    }

    /// Takes note of rings that start, and of winding numbers, for edges that start at `p` one
    /// above the other, just above the edge of node `below`.
    pub(super) fn enter_above(&mut self, p: Point, below: u32, edges: &[u32]) {
        let mut under = if below == NONE { NONE } else { self.status.edge(below) };
        let mut label = self.label_above(under);
        let mut state = self.state_above(under);
        for &edge in edges {
            self.enter(p, under, edge, &mut label, &mut state);
            under = edge;
        }
    }

    /// One step of [`enter_above`](Self::enter_above).
    pub(super) fn enter(
        &mut self,
        at: Point,
        below: u32,
        edge: u32,
        label: &mut u32,
        state: &mut u32,
    ) {
        let ring = self.segment(edge).ring;
        if !self.born[ring as usize] {
            self.born[ring as usize] = true;
            self.found.parents[ring as usize] = *label;
        }
        *label = self.label_above(edge);
        let segment = &mut self.segments[edge as usize];
        if segment.bridged {
            segment.state = *state;
            return;
        }
        let inside = segment.polygon + 1;
        let (under, over) = if segment.forward { (0, inside) } else { (inside, 0) };
        if *state != under && self.purpose == Purpose::Validate {
            let _ = self.violation.get_or_insert(Violation { at, edge, below });
        }
        *state = over;
    }

    /// The smallest ring around the places just above an edge.
    pub(super) fn label_above(&self, edge: u32) -> u32 {
        if edge == NONE {
            return NONE;
        }
        let segment = self.segment(edge);
        if segment.enters_ring { segment.ring } else { self.found.parents[segment.ring as usize] }
    }

    /// The polygon just above an edge plus one, or 0.
    pub(super) fn state_above(&self, edge: u32) -> u32 {
        if edge == NONE {
            return 0;
        }
        let segment = self.segment(edge);
        match (segment.bridged, segment.forward) {
            (true, _) => segment.state,
            (false, true) => segment.polygon + 1,
            (false, false) => 0,
        }
    }

    /// Says what is behind the interior being on the wrong side somewhere.
    fn explain(&self, violation: Violation) -> DomainError {
        if let Some(error) = self.corner_crossing {
            return error;
        }
        let place = |ring: u32| self.rings.edge_place(self.rings.rings[ring as usize].first);
        let mut outer = NONE;
        for (ring, &parent) in self.found.parents.iter().enumerate() {
            let own = &self.rings.rings[ring];
            if !own.hole {
                outer = ring as u32;
            }
            let around = (parent != NONE).then(|| &self.rings.rings[parent as usize]);
            let fault = match around {
                None if own.hole => NestingFault::HoleOutside,
                Some(around) if around.polygon == own.polygon => match (own.hole, around.hole) {
                    (true, true) => NestingFault::HoleInHole,
                    (false, true) => NestingFault::OuterInHole,
                    _ => continue,
                },
                Some(around) if !own.hole && !around.hole => {
                    let (first, second) = (place(ring as u32), place(parent));
                    let at = self.rings.point(own.first);
                    return DomainError::PolygonsOverlap {
                        first: first.min(second),
                        second: first.max(second),
                        at,
                    };
                }
                Some(_) if own.hole => NestingFault::HoleOutside,
                _ => continue,
            };
            let other = if fault == NestingFault::HoleOutside { outer } else { parent };
            let ring = ring as u32;
            let other = if other == NONE { ring } else { other };
            return DomainError::BadNesting { ring: place(ring), fault, other: place(other) };
        }
        let Violation { at, edge, below } = violation;
        let (first, second) = self.places(edge, if below == NONE { edge } else { below });
        if first.polygon == second.polygon {
            DomainError::BadNesting { ring: second, fault: NestingFault::Sides, other: first }
        } else {
            DomainError::PolygonsOverlap { first, second, at }
        }
    }
}
