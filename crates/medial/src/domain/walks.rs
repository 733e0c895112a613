use super::Report;
use crate::geom::{Point, orient2d};

/// A boundary element: an open edge, or the corner at the start of an edge.
///
/// Sites are numbered along the boundary: corner 2k is the start of edge 2k + 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Site(pub u32);

impl Site {
    /// The site of edge number `edge`.
    #[inline]
    #[must_use]
    pub const fn edge(edge: u32) -> Self {
        Self(2 * edge + 1)
    }

    /// The site of the corner where edge number `edge` starts.
    #[inline]
    #[must_use]
    pub const fn corner(edge: u32) -> Self {
        Self(2 * edge)
    }

    /// Whether this is an edge.
    #[inline]
    #[must_use]
    pub const fn is_edge(self) -> bool {
        self.0 & 1 == 1
    }

    /// The number of the edge, or of the edge that starts at the corner.
    #[inline]
    #[must_use]
    pub const fn index(self) -> u32 {
        self.0 >> 1
    }
}

/// How the boundary turns at the start of an edge, seen from the interior.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Corner {
    /// The boundary turns left: an end of the axis.
    Convex,
    /// The boundary turns right: the corner is a site.
    Reflex,
    /// No turn. Only where rings touch: the pieces of a straight line stay separate sites.
    Straight,
}

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
    /// Ring of the incoming edge.
    pub ring: u32,
    /// Position of the corner in that ring as given; where the ring has no vertex there because
    /// another one touches its edge, the index of that edge.
    pub index: u32,
    /// 0, or, where another ring touches an edge of this one, which touch it is along that edge,
    /// counted from 1 in input direction.
    pub part: u32,
}

/// An edge of the boundary, directed so that the interior lies to its left. 64 bytes.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Edge {
    /// Where the edge starts; it ends where the next one starts.
    pub start: Point,
    /// Unit vector from start to end, rounded; exact for axis-parallel edges.
    pub direction: Point,
    /// Length, rounded.
    pub length: f64,
    /// The next edge along the boundary.
    pub next: u32,
    /// The edge before this one.
    pub prev: u32,
    /// The walk the edge belongs to.
    pub walk: u32,
    /// Edges on one supporting line, whatever their direction, share this number.
    pub line: u32,
    /// The corner at the start.
    pub corner: Corner,
}

/// A closed walk along the boundary: a ring, or what sectors make of rings that touch.
#[derive(Clone, Copy, Debug)]
pub struct Walk {
    /// Its first edge; the edges of a walk are consecutive.
    pub first: u32,
    /// Number of edges.
    pub len: u32,
    /// Whether the walk surrounds a hole of its component.
    pub hole: bool,
    /// Polygon of the feature.
    pub polygon: u32,
}

/// A valid polygonal domain: the closed boundary walks of one feature.
///
/// Immutable. Every engine takes one, and nothing else, as its shape.
#[derive(Clone, Debug)]
pub struct Domain {
    /// Walk by walk, in boundary order.
    edges: Vec<Edge>,
    origins: Vec<Origin>,
    walks: Vec<Walk>,
    report: Report,
}

impl Domain {
    /// Builds the records from closed walks of distinct consecutive points, interior on the left.
    ///
    /// The caller guarantees validity: simple up to touching, directed, without spikes.
    /// Edge k of a walk starts at point k; `polygon` is taken from the first origin of a walk.
    pub(super) fn from_walks(walks: &[Vec<(Point, Origin)>], report: Report) -> Self {
        let n = walks.iter().map(Vec::len).sum();
        let mut domain = Self {
            edges: Vec::with_capacity(n),
            origins: Vec::with_capacity(n),
            walks: Vec::with_capacity(walks.len()),
            report,
        };
        for walk in walks {
            let first = domain.edges.len() as u32;
            let len = walk.len() as u32;
            let id = domain.walks.len() as u32;
            let mut lowest = 0;
            for (k, &(start, origin)) in walk.iter().enumerate() {
                let k = k as u32;
                let before = walk[((k + len - 1) % len) as usize].0;
                let end = walk[((k + 1) % len) as usize].0;
                if start.lexicographic(walk[lowest].0).is_lt() {
                    lowest = k as usize;
                }
                let d = end - start;
                let length = d.norm();
                domain.edges.push(Edge {
                    start,
                    direction: Point::new(d.x / length, d.y / length),
                    length,
                    next: first + (k + 1) % len,
                    prev: first + (k + len - 1) % len,
                    walk: id,
                    line: first + k,
                    corner: turn(before, start, end),
                });
                domain.origins.push(origin);
            }
            domain.walks.push(Walk {
                first,
                len,
                // At its first point in lexicographic order an outer walk turns left.
                hole: domain.edges[first as usize + lowest].corner != Corner::Convex,
                polygon: walk[0].1.polygon,
            });
        }
        domain
    }

    /// All edges, walk by walk in boundary order.
    #[inline]
    #[must_use]
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// All boundary walks.
    #[inline]
    #[must_use]
    pub fn walks(&self) -> &[Walk] {
        &self.walks
    }

    /// Where edge number `edge` and the corner at its start come from.
    #[inline]
    #[must_use]
    pub fn origin(&self, edge: u32) -> Origin {
        self.origins[edge as usize]
    }

    /// Record of edge number `edge`.
    #[inline]
    #[must_use]
    pub fn edge(&self, edge: u32) -> &Edge {
        &self.edges[edge as usize]
    }

    /// Where edge number `edge` ends.
    #[inline]
    #[must_use]
    pub fn end(&self, edge: u32) -> Point {
        self.edges[self.edges[edge as usize].next as usize].start
    }

    /// What was changed to make the input valid.
    #[inline]
    #[must_use]
    pub fn report(&self) -> &Report {
        &self.report
    }

    /// Connected components of the open interior.
    #[must_use]
    pub fn n_components(&self) -> usize {
        self.walks.iter().filter(|w| !w.hole).count()
    }
}

fn turn(before: Point, at: Point, after: Point) -> Corner {
    let sign = orient2d(before, at, after);
    if sign > 0.0 {
        Corner::Convex
    } else if sign < 0.0 {
        Corner::Reflex
    } else {
        Corner::Straight
    }
}
