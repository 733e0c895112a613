//! Where edges and corners come from in the input: a few numbers a walk, records where rings touch.

use super::status::NONE;
use super::{Domain, Site};

/// Where an edge, and the corner at its start, come from in the input.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Origin {
    /// Polygon of the feature, from 0.
    pub polygon: u32,
    /// Ring of the polygon, from 0; 0 is the outer ring.
    pub ring: u32,
    /// Position in the ring as given (before any reversal) of the edge's first vertex in input
    /// order; a merged edge counts from the vertex where it begins in input direction.
    pub index: u32,
    /// Piece of an edge split by touching corners, counted in input direction; 0 if unsplit.
    pub part: u32,
    /// Name of the corner at the start of the edge.
    pub corner: CornerOrigin,
}

/// Where a corner comes from: a wedge between two rings is named by the ring of its incoming edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct CornerOrigin {
    /// Polygon of the incoming edge: that of the outgoing one, unless polygons were united.
    pub polygon: u32,
    /// Ring of the incoming edge.
    pub ring: u32,
    /// Position of the corner in that ring as given; where the ring has no vertex there because
    /// another one touches its edge, the index of that edge.
    pub index: u32,
    /// 0, or, where another ring touches an edge of this one, which touch it is along that edge,
    /// counted from 1 in input direction.
    pub part: u32,
}

/// What names are made of.
#[derive(Clone, Debug, Default)]
pub(super) struct Origins {
    /// For each walk.
    pub(super) sources: Vec<Source>,
    /// Positions in rings as given.
    pub(super) given: Vec<u32>,
    /// Names of the edges of walks through several rings, or pieces of one.
    pub(super) records: Vec<Origin>,
}

/// What a walk is made of.
#[derive(Clone, Copy, Debug)]
pub(super) enum Source {
    /// A whole ring; it starts where its first edge, in input direction, starts in this direction.
    Ring {
        ring: u32,
        /// Where the positions of its vertices as given are listed, in input direction; `NONE` if
        /// no vertex was dropped.
        given: u32,
        reversed: bool,
    },
    /// Pieces, with records from this one on.
    Pieces { first: u32 },
}

impl Domain {
    /// Whether a site comes from that polygon, ring, position and part.
    #[inline]
    pub(crate) fn is_from(&self, site: Site, [polygon, ring, index, part]: [u32; 4]) -> bool {
        let edge = site.index();
        let walk = self.edge(edge).walk as usize;
        let (source, walk) = (self.origins.sources[walk], &self.walks[walk]);
        if let Source::Ring { ring: own, given: NONE, reversed: false } = source {
            // A corner has the position of the edge that starts there.
            return polygon == walk.polygon
                && ring == own
                && index == edge - walk.first
                && part == 0;
        }
        let Origin { corner, .. } = self.origin(edge);
        let own = if site.is_edge() {
            let Origin { polygon, ring, index, part, .. } = self.origin(edge);
            [polygon, ring, index, part]
        } else {
            [corner.polygon, corner.ring, corner.index, corner.part]
        };
        own == [polygon, ring, index, part]
    }

    /// Where edge number `edge` and the corner at its start come from.
    #[inline]
    #[must_use]
    pub fn origin(&self, edge: u32) -> Origin {
        let walk = self.edge(edge).walk as usize;
        let (source, walk) = (self.origins.sources[walk], &self.walks[walk]);
        let along = edge - walk.first;
        match source {
            Source::Ring { ring, given, reversed } => {
                // Backwards, the walk starts at the second vertex.
                let vertex = match (reversed, along) {
                    (false, _) => along,
                    (true, 0 | 1) => 1 - along,
                    (true, _) => walk.len + 1 - along,
                };
                let before = if vertex == 0 { walk.len - 1 } else { vertex - 1 };
                let position = |vertex: u32| match given {
                    NONE => vertex,
                    first => self.origins.given[(first + vertex) as usize],
                };
                let index = position(if reversed { before } else { vertex });
                let polygon = walk.polygon;
                let corner = CornerOrigin { polygon, ring, index: position(vertex), part: 0 };
                Origin { polygon, ring, index, part: 0, corner }
            }
            Source::Pieces { first } => self.origins.records[(first + along) as usize],
        }
    }
}
