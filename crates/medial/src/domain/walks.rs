use super::Report;
use super::area::twice_area;
use super::assemble::Walks;
use super::unit::unit_vector;
use crate::geom::{Double, Point, orient2d};

/// A boundary element by its number: an open edge, or the corner at the start of an edge.
///
/// Along the boundary 2k is the corner where edge number k starts, and 2k + 1 that edge. Convex
/// corners have a number too, but govern nothing. What an axis lists is an
/// [`axis::Site`](crate::axis::Site), which carries coordinates and its place in the input.
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
    /// Connected component of the open interior, from 0 in the order of the outer walks.
    pub component: u32,
}

/// A valid polygonal domain: the closed boundary walks of one feature.
///
/// Immutable. Every engine takes one, and nothing else, as its shape.
#[derive(Clone, Debug)]
pub struct Domain {
    /// Walk by walk, in boundary order.
    pub(super) edges: Vec<Edge>,
    pub(super) origins: Vec<Origin>,
    pub(super) walks: Vec<Walk>,
    pub(super) report: Report,
}

impl Domain {
    /// Builds the records from closed walks, which are valid: simple up to touching, directed,
    /// without spikes. `lines` gives the supporting line of each source edge.
    pub(super) fn from_walks(walks: Walks, lines: &[u32], report: Report) -> Self {
        let n = walks.starts.len();
        let mut edges: Vec<Edge> = Vec::with_capacity(n);
        let mut records = Vec::with_capacity(walks.lens.len());
        let mut least_on_line = vec![u32::MAX; lines.len()];
        let mut first = 0;
        for (id, &len) in walks.lens.iter().enumerate() {
            let points = &walks.starts[first as usize..(first + len) as usize];
            let at = |k: u32| points[(if k < len { k } else { k - len }) as usize];
            for k in 0..len {
                let (start, end) = (at(k), at(k + 1));
                let (direction, length) = unit_vector(start, end);
                let edge = first + k;
                let line = lines[walks.sources[edge as usize] as usize] as usize;
                // Numbers rise, so the first one met is the least.
                least_on_line[line] = least_on_line[line].min(edge);
                edges.push(Edge {
                    start,
                    direction,
                    length,
                    next: if k + 1 < len { edge + 1 } else { first },
                    prev: if k > 0 { edge - 1 } else { first + len - 1 },
                    walk: id as u32,
                    line: least_on_line[line],
                    corner: turn(at(k + len - 1), start, end),
                });
            }
            let walk = &edges[first as usize..];
            let polygon = walks.origins[first as usize].polygon;
            let hole = surrounds_a_hole(walk);
            records.push(Walk { first, len, hole, polygon, component: 0 });
            first += len;
        }
        Self { edges, origins: walks.origins, walks: records, report }
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

    /// Connected components of the interior of each polygon.
    pub(super) fn parts(&self, polygons: usize) -> Vec<u32> {
        let mut parts = vec![0; polygons];
        for walk in self.walks.iter().filter(|w| !w.hole) {
            parts[walk.polygon as usize] += 1;
        }
        parts
    }

    /// Area of the domain, in squared units of the input, rounded once or twice.
    #[must_use]
    pub fn area(&self) -> f64 {
        let walks = 0..self.walks.len() as u32;
        0.5 * walks.fold(Double::ZERO, |sum, walk| sum + self.twice_area(walk)).value()
    }

    /// Area that one walk encloses, negative if it surrounds a hole; rounded once.
    #[must_use]
    pub fn signed_area(&self, walk: u32) -> f64 {
        0.5 * self.twice_area(walk).value()
    }

    fn twice_area(&self, walk: u32) -> Double {
        let Walk { first, len, .. } = self.walks[walk as usize];
        let edges = &self.edges[first as usize..(first + len) as usize];
        let points: Vec<Point> = edges.iter().map(|e| e.start).collect();
        twice_area(&points)
    }
}

/// Whether a walk surrounds a hole: an outer walk turns left wherever it passes its first point in
/// lexicographic order, and one around a hole turns right there once.
fn surrounds_a_hole(walk: &[Edge]) -> bool {
    let lowest = walk.iter().map(|e| e.start).min_by(|a, b| a.lexicographic(*b));
    walk.iter().any(|e| Some(e.start) == lowest && e.corner == Corner::Reflex)
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
