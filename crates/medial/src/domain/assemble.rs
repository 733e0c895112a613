//! Boundary walks from rings and what the sweep found where they touch.

use super::rings::Rings;
use super::sweep::{Arrangement, Piece};
use super::{CornerOrigin, DomainError, Origin};
use crate::geom::Point;

/// Walks, one after another: where each edge starts, and what it comes from.
#[derive(Default)]
pub(super) struct Walks {
    pub(super) starts: Vec<Point>,
    pub(super) origins: Vec<Origin>,
    /// Edge of the cleaned rings that each edge is a piece of.
    pub(super) sources: Vec<u32>,
    /// Number of edges of each walk.
    pub(super) lens: Vec<u32>,
}

/// Follows links from piece to piece; walks are ordered by, and start at, their edge with the
/// smallest polygon, ring, index and part.
pub(super) fn assemble(rings: &Rings, found: &Arrangement) -> Result<Walks, DomainError> {
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
    let mut walks = Walks::default();
    walks.sources.reserve(n as usize);
    walks.starts.reserve(n as usize);
    walks.origins.reserve(n as usize);
    for first in pieces.in_input_order() {
        if done[first as usize] {
            continue;
        }
        let before = walks.starts.len();
        let mut k = first;
        loop {
            done[k as usize] = true;
            let follower = next[k as usize];
            walks.starts.push(pieces.start(k));
            walks.origins.push(pieces.origin(k));
            walks.sources.push(pieces.edge(k));
            if follower == first {
                break;
            }
            if done[follower as usize] {
                return Err(DomainError::Internal { stage: "walks" });
            }
            k = follower;
        }
        let walk = &mut walks.origins[before..];
        // Each corner is named by the piece that arrives there.
        let mut into = k;
        let mut at = first;
        for origin in walk {
            origin.corner = pieces.end_name(into);
            (into, at) = (at, next[at as usize]);
        }
        walks.lens.push((walks.starts.len() - before) as u32);
    }
    Ok(walks)
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
        let corner = CornerOrigin { ring: ring.index, index, part };
        Origin { polygon: ring.polygon, ring: ring.index, index, part, corner }
    }

    /// Name of the corner where a piece ends.
    fn end_name(&self, piece: u32) -> CornerOrigin {
        let edge = self.edge(piece);
        let ring = self.rings.ring_of(edge);
        let touches = self.touches(edge);
        let along = piece - self.first(edge);
        if along == touches {
            let index = self.rings.given[self.rings.next(edge) as usize];
            return CornerOrigin { ring: ring.index, index, part: 0 };
        }
        let part = if ring.reversed { touches - along } else { along + 1 };
        CornerOrigin { ring: ring.index, index: self.rings.edge_index(edge), part }
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
