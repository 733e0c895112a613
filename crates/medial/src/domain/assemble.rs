//! Boundary walks from rings and what the sweep found where they touch.

use super::origins::Source;
use super::outlines::{Outline, Outlines, ring_source};
use super::rings::Rings;
use super::sweep::{Arrangement, Piece};
use super::{Corner, CornerOrigin, DomainError, Origin};
use crate::geom::{Point, orient2d};

/// Follows links from piece to piece; walks are ordered by, and start at, their edge with the
/// smallest polygon, ring, index and part.
pub(super) fn assemble(rings: &Rings, found: &Arrangement) -> Result<Outlines, DomainError> {
    let pieces = Pieces::new(rings, found);
    let n = pieces.len();
    let mut next: Vec<u32> = (0..n).map(|k| pieces.next_in_ring(k)).collect();
    let mut done = vec![false; n as usize];
    for &piece in &found.removed {
        done[pieces.id(piece) as usize] = true;
    }
    for &(into, out) in &found.links {
        next[pieces.id(into) as usize] = pieces.id(out);
    }
    let (mut points, mut corners) =
        (Vec::with_capacity(n as usize), Vec::with_capacity(n as usize));
    let (mut list, mut given, mut records) = (Vec::new(), Vec::new(), Vec::new());
    for first in pieces.in_input_order() {
        if done[first as usize] {
            continue;
        }
        let (start, record) = (points.len(), records.len());
        let ring = rings.ring_of(pieces.edge(first));
        let mut k = first;
        let mut whole = true;
        loop {
            done[k as usize] = true;
            let follower = next[k as usize];
            whole &= follower == pieces.next_in_ring(k) && pieces.touches(pieces.edge(k)) == 0;
            points.push(pieces.start(k));
            if follower == first {
                break;
            }
            if done[follower as usize] {
                return Err(DomainError::Internal { stage: "walks" });
            }
            k = follower;
        }
        let walk = &points[start..];
        append_corners(walk, &mut corners);
        let source = if whole {
            ring_source(rings, ring, &mut given)
        } else {
            // Each corner is named by the piece that arrives there.
            let (mut into, mut at) = (k, first);
            records.extend(walk.iter().map(|_| {
                let origin = Origin { corner: pieces.end_name(into), ..pieces.origin(at) };
                (into, at) = (at, next[at as usize]);
                origin
            }));
            Source::Pieces { first: record as u32 }
        };
        list.push(Outline {
            first: start as u32,
            len: walk.len() as u32,
            start: 0,
            polygon: ring.polygon,
            hole: surrounds_a_hole(walk, &corners[start..]),
            source,
        });
    }
    Ok(Outlines { points, corners, list, given, records })
}

fn append_corners(walk: &[Point], corners: &mut Vec<Corner>) {
    let n = walk.len();
    corners.extend((0..n).map(|k| {
        let turn = orient2d(walk[(k + n - 1) % n], walk[k], walk[(k + 1) % n]);
        if turn > 0.0 {
            Corner::Convex
        } else if turn < 0.0 {
            Corner::Reflex
        } else {
            Corner::Straight
        }
    }));
}

/// Whether a walk surrounds a hole: an outer walk turns left wherever it passes its first point in
/// lexicographic order, and one around a hole turns right there once.
fn surrounds_a_hole(walk: &[Point], corners: &[Corner]) -> bool {
    let lowest = walk.iter().copied().min_by(|a, b| a.lexicographic(*b));
    walk.iter().zip(corners).any(|(p, &c)| Some(*p) == lowest && c == Corner::Reflex)
}

/// All edges of the rings, cut where corners touch them, numbered in boundary order.
struct Pieces<'a, 'b> {
    rings: &'a Rings<'b>,
    /// Touched edges with the point, edge by edge, in order from the smaller end.
    cuts: Vec<(u32, Point)>,
    /// First piece of each edge, if any edge is cut.
    first: Vec<u32>,
    /// Edge of each piece, if any edge is cut.
    edges: Vec<u32>,
}

impl<'a, 'b> Pieces<'a, 'b> {
    fn new(rings: &'a Rings<'b>, found: &Arrangement) -> Self {
        let mut cuts = found.cuts.clone();
        let (mut first, mut edges) = (Vec::new(), Vec::new());
        if !cuts.is_empty() {
            // Stable, so the order along each edge stays.
            cuts.sort_by_key(|c| c.0);
            let mut at = 0;
            for edge in 0..rings.points.len() as u32 {
                first.push(edges.len() as u32);
                edges.push(edge);
                while at < cuts.len() && cuts[at].0 == edge {
                    edges.push(edge);
                    at += 1;
                }
            }
        }
        Self { rings, cuts, first, edges }
    }

    fn len(&self) -> u32 {
        (self.rings.points.len() + self.cuts.len()) as u32
    }

    fn edge(&self, piece: u32) -> u32 {
        if self.cuts.is_empty() { piece } else { self.edges[piece as usize] }
    }

    fn first(&self, edge: u32) -> u32 {
        if self.cuts.is_empty() { edge } else { self.first[edge as usize] }
    }

    /// Number of touches inside an edge.
    fn touches(&self, edge: u32) -> u32 {
        if self.cuts.is_empty() {
            0
        } else if edge + 1 == self.first.len() as u32 {
            self.len() - self.first(edge) - 1
        } else {
            self.first(edge + 1) - self.first(edge) - 1
        }
    }

    fn forward(&self, edge: u32) -> bool {
        let (from, to) = (self.rings.point(edge), self.rings.point(self.rings.next(edge)));
        from.lexicographic(to).is_lt()
    }

    fn id(&self, piece: Piece) -> u32 {
        let Piece { edge, part } = piece;
        let along = if self.forward(edge) { part } else { self.touches(edge) - part };
        self.first(edge) + along
    }

    fn next_in_ring(&self, piece: u32) -> u32 {
        let edge = self.edge(piece);
        if piece < self.first(edge) + self.touches(edge) {
            piece + 1
        } else {
            self.first(self.rings.next(edge))
        }
    }

    fn start(&self, piece: u32) -> Point {
        let edge = self.edge(piece);
        let along = piece - self.first(edge);
        if along == 0 {
            return self.rings.point(edge);
        }
        let touches = self.touches(edge);
        let cut = if self.forward(edge) { along - 1 } else { touches - along };
        self.cuts[(self.first(edge) - edge + cut) as usize].1
    }

    fn origin(&self, piece: u32) -> Origin {
        let edge = self.edge(piece);
        let ring = self.rings.ring_of(edge);
        let along = piece - self.first(edge);
        let part = if ring.reversed { self.touches(edge) - along } else { along };
        let index = self.rings.edge_index(edge);
        let corner = CornerOrigin { polygon: ring.polygon, ring: ring.index, index, part };
        Origin { polygon: ring.polygon, ring: ring.index, index, part, corner }
    }

    /// Name of the corner where a piece ends.
    fn end_name(&self, piece: u32) -> CornerOrigin {
        let edge = self.edge(piece);
        let ring = self.rings.ring_of(edge);
        let touches = self.touches(edge);
        let along = piece - self.first(edge);
        if along == touches {
            let index = self.rings.given(self.rings.next(edge));
            return CornerOrigin { polygon: ring.polygon, ring: ring.index, index, part: 0 };
        }
        let part = if ring.reversed { touches - along } else { along + 1 };
        CornerOrigin {
            polygon: ring.polygon,
            ring: ring.index,
            index: self.rings.edge_index(edge),
            part,
        }
    }

    /// All pieces by polygon, ring, index and part.
    fn in_input_order(&self) -> impl Iterator<Item = u32> {
        self.rings.rings.iter().flat_map(move |ring| {
            let (first, len) = (ring.first, ring.len);
            (0..len).flat_map(move |k| {
                // Backwards, edge `len - 2` comes first: the last one runs over the start.
                let edge = match (ring.reversed, k + 1 < len) {
                    (false, _) => first + k,
                    (true, true) => first + (len - 2 - k),
                    (true, false) => first + len - 1,
                };
                let touches = self.touches(edge);
                (0..=touches).map(move |part| {
                    self.first(edge) + if ring.reversed { touches - part } else { part }
                })
            })
        })
    }
}
