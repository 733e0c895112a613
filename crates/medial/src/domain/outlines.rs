//! Boundary walks before they are a domain.

use std::sync::OnceLock;

use super::origins::{Origins, Source};
use super::report::Report;
use super::rings::{Ring, Rings};
use super::status::NONE;
use super::unit::unit_vector;
use super::{Corner, Domain, Edge, Walk};
use crate::geom::Point;

/// Closed walks, which are valid: simple up to touching, directed, without spikes.
pub(super) struct Outlines {
    /// Where their edges start.
    pub(super) points: Vec<Point>,
    /// How they turn there.
    pub(super) corners: Vec<Corner>,
    pub(super) list: Vec<Outline>,
    pub(super) given: Vec<u32>,
    pub(super) records: Vec<super::Origin>,
}

/// One walk, a range of points.
#[derive(Clone, Copy)]
pub(super) struct Outline {
    pub(super) first: u32,
    pub(super) len: u32,
    /// Where in its range it starts.
    pub(super) start: u32,
    pub(super) polygon: u32,
    pub(super) hole: bool,
    pub(super) source: Source,
}

/// The tables of a domain, to which walks are added.
///
/// What stays is best allocated before what does not: then no gaps are left in memory.
pub(super) struct Draft {
    edges: Vec<Edge>,
    walks: Vec<Walk>,
    sources: Vec<Source>,
}

impl Draft {
    /// Nothing yet, with room.
    pub(super) fn with_room(n_edges: usize, n_walks: usize) -> Self {
        Self {
            edges: Vec::with_capacity(n_edges),
            walks: Vec::with_capacity(n_walks),
            sources: Vec::with_capacity(n_walks),
        }
    }

    /// The domain of rings in the given order, which are apart from one another.
    pub(super) fn rings(mut self, rings: &Rings, order: &[u32], report: Report) -> Domain {
        let mut given = Vec::new();
        for &number in order {
            let ring = &rings.rings[number as usize];
            let source = ring_source(rings, ring, &mut given);
            let (first, len, polygon, hole) = (ring.first, ring.len, ring.polygon, ring.hole);
            let outline = Outline { first, len, start: ring.start(), polygon, hole, source };
            self.add(&rings.points, &rings.corners, outline);
        }
        self.finish(given, Vec::new(), report)
    }

    /// The domain of walks in the given order.
    pub(super) fn outlines(mut self, all: Outlines, order: &[u32], report: Report) -> Domain {
        // There may be more than there was room for, where rings touch edges.
        self.edges.reserve_exact(all.points.len());
        self.walks.reserve_exact(order.len());
        self.sources.reserve_exact(order.len());
        for &number in order {
            self.add(&all.points, &all.corners, all.list[number as usize]);
        }
        self.finish(all.given, all.records, report)
    }

    #[inline]
    fn add(&mut self, points: &[Point], corners: &[Corner], outline: Outline) {
        let Outline { first, len, start, polygon, hole, source } = outline;
        let range = first as usize..(first + len) as usize;
        let (points, corners) = (&points[range.clone()], &corners[range]);
        let (begin, walk) = (self.edges.len() as u32, self.walks.len() as u32);
        let edge = |k: u32, at: usize, end: Point| {
            let (direction, length) = unit_vector(points[at], end);
            let corner = corners[at];
            // Wrong at both ends for now.
            let (next, prev) = (begin + k + 1, (begin + k).wrapping_sub(1));
            Edge { start: points[at], direction, length, next, prev, walk, corner }
        };
        let (begins, last) = (start as usize, points.len() - 1);
        self.edges.extend((begins..last).zip(0..).map(|(at, k)| edge(k, at, points[at + 1])));
        self.edges.push(edge(len - 1 - start, last, points[0]));
        let wrapped = (0..begins).zip(len - start..);
        self.edges.extend(wrapped.map(|(at, k)| edge(k, at, points[at + 1])));
        self.edges[begin as usize].prev = begin + len - 1;
        self.edges[(begin + len - 1) as usize].next = begin;
        self.walks.push(Walk { first: begin, len, hole, polygon, component: 0 });
        self.sources.push(source);
    }

    fn finish(self, given: Vec<u32>, records: Vec<super::Origin>, report: Report) -> Domain {
        let Self { edges, walks, sources } = self;
        let origins = Origins { sources, given, records };
        Domain { edges, walks, origins, report, lines: OnceLock::new() }
    }
}

/// Names for a walk around a whole ring.
pub(super) fn ring_source(rings: &Rings, ring: &Ring, given: &mut Vec<u32>) -> Source {
    let listed = match rings.cleaned.get(ring.cleaned as usize) {
        Some(cleaned) => {
            given.extend_from_slice(&cleaned.given);
            (given.len() - cleaned.given.len()) as u32
        }
        None => NONE,
    };
    Source::Ring { ring: ring.index, given: listed, reversed: ring.reversed }
}
