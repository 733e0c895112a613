use std::ops::Range;
use std::sync::OnceLock;

use super::Report;
use super::area::twice_area;
use super::lines::supporting_lines;
use super::origins::Origins;
use crate::geom::{Double, Point, Rect};

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

/// An edge of the boundary, directed so that the interior lies to its left. 56 bytes.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Edge {
    /// Where the edge starts; it ends where the next one starts.
    pub start: Point,
    /// Unit vector from start to end: each coordinate within 3 · 2^-53 of the true one, as a share
    /// of it; exact for axis-parallel edges.
    pub direction: Point,
    /// Length, within 2 · 2^-53 of the true one, as a share of it.
    pub length: f64,
    /// The next edge along the boundary.
    pub next: u32,
    /// The edge before this one.
    pub prev: u32,
    /// The walk the edge belongs to.
    pub walk: u32,
    /// The corner at the start.
    pub corner: Corner,
}

impl Edge {
    /// The squared distance of the edge from a place, given relative to its start, rounded.
    ///
    /// Which part of an edge is nearest can rarely be foreseen, so nothing branches on it.
    #[inline(always)]
    #[must_use]
    pub(crate) fn distance2(&self, way: Point) -> f64 {
        let (along, across) = (self.direction.dot(way), self.direction.cross(way));
        let before = if along < 0.0 { along } else { 0.0 };
        let beyond = along - self.length;
        let beyond = if beyond > 0.0 { beyond } else { 0.0 };
        let outside = before + beyond;
        across * across + outside * outside
    }
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

impl Walk {
    /// The numbers of its edges.
    #[inline]
    #[must_use]
    pub fn edges(&self) -> Range<u32> {
        self.first..self.first + self.len
    }
}

/// A valid polygonal domain: the closed boundary walks of one feature.
///
/// Immutable. Every engine takes one, and nothing else, as its shape.
#[derive(Clone, Debug)]
pub struct Domain {
    /// Walk by walk, in boundary order.
    pub(super) edges: Vec<Edge>,
    pub(super) walks: Vec<Walk>,
    pub(super) origins: Origins,
    pub(super) report: Report,
    /// Supporting lines, once somebody asks.
    pub(super) lines: OnceLock<Vec<u32>>,
}

impl Domain {
    /// The components of the interior as valid polygons: for each the outer ring and the holes, all of
    /// them with the interior on their left.
    #[must_use]
    pub fn polygons(&self) -> Vec<Vec<Vec<Point>>> {
        let mut order: Vec<&Walk> = self.walks.iter().collect();
        order.sort_by_key(|walk| (walk.component, walk.hole));
        let ring = |walk: &&Walk| {
            let edges = walk.first as usize..(walk.first + walk.len) as usize;
            self.edges[edges].iter().map(|edge| edge.start).collect()
        };
        let of_one = |walks: &[&Walk]| walks.iter().map(ring).collect();
        order.chunk_by(|a, b| a.component == b.component).map(of_one).collect()
    }

    /// The box of all corners.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        self.edges().iter().fold(Rect::EMPTY, |all, edge| all.with(edge.start))
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

    /// The least edge on the supporting line of edge number `edge`: edges on one line, whatever
    /// their direction, share this number.
    ///
    /// The first call sorts all edges by their lines, in O(n log n).
    #[must_use]
    pub fn line(&self, edge: u32) -> u32 {
        self.lines()[edge as usize]
    }

    /// The numbers that [`line`](Self::line) gives, of all edges.
    pub fn lines(&self) -> &[u32] {
        self.lines.get_or_init(|| {
            let ends = (0..self.edges.len() as u32).map(|k| (self.edge(k).start, self.end(k)));
            supporting_lines(&ends.collect::<Vec<_>>())
        })
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
