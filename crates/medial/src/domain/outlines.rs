//! Boundary walks before they are a domain.

use std::sync::OnceLock;

use super::origins::{Origins, Source};
use super::report::Report;
use super::rings::Rings;
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
pub(super) struct Outline {
    pub(super) first: u32,
    pub(super) len: u32,
    /// Where in its range it starts.
    pub(super) start: u32,
    pub(super) polygon: u32,
    pub(super) hole: bool,
    pub(super) source: Source,
}

impl Outlines {
    /// The rings, which are apart from one another.
    pub(super) fn of_rings(rings: Rings) -> Self {
        let mut given = Vec::new();
        let list = rings.rings.iter().map(|ring| {
            let source = ring_source(&rings, ring, &mut given);
            let (first, len, polygon, hole) = (ring.first, ring.len, ring.polygon, ring.hole);
            let start = ring.start();
            Outline { first, len, start, polygon, hole, source }
        });
        let list = list.collect();
        Self { points: rings.points, corners: rings.corners, list, given, records: Vec::new() }
    }

    /// The records, walks in the given order.
    pub(super) fn into_domain(self, order: &[u32], report: Report) -> Domain {
        let mut edges: Vec<Edge> = Vec::with_capacity(self.points.len());
        let mut walks = Vec::with_capacity(order.len());
        let mut sources = Vec::with_capacity(order.len());
        for (number, &outline) in (0..).zip(order) {
            let Outline { first, len, start, polygon, hole, source } = self.list[outline as usize];
            let range = first as usize..(first + len) as usize;
            let (points, corners) = (&self.points[range.clone()], &self.corners[range]);
            let begin = edges.len() as u32;
            let edge = |k: u32, at: usize, end: Point| {
                let (direction, length) = unit_vector(points[at], end);
                let corner = corners[at];
                // Wrong at both ends for now.
                let (next, prev) = (begin + k + 1, (begin + k).wrapping_sub(1));
                Edge { start: points[at], direction, length, next, prev, walk: number, corner }
            };
            let (begins, last) = (start as usize, points.len() - 1);
            edges.extend((begins..last).zip(0..).map(|(at, k)| edge(k, at, points[at + 1])));
            edges.push(edge(len - 1 - start, last, points[0]));
            edges.extend((0..begins).zip(len - start..).map(|(at, k)| edge(k, at, points[at + 1])));
            edges[begin as usize].prev = begin + len - 1;
            edges[(begin + len - 1) as usize].next = begin;
            walks.push(Walk { first: begin, len, hole, polygon, component: 0 });
            sources.push(source);
        }
        let origins = Origins { sources, given: self.given, records: self.records };
        Domain { edges, walks, origins, report, lines: OnceLock::new() }
    }
}

/// Names for a walk around a whole ring.
pub(super) fn ring_source(
    rings: &Rings,
    ring: &super::rings::Ring,
    given: &mut Vec<u32>,
) -> Source {
    let listed = match rings.cleaned.get(ring.cleaned as usize) {
        Some(cleaned) => {
            given.extend_from_slice(&cleaned.given);
            (given.len() - cleaned.given.len()) as u32
        }
        None => NONE,
    };
    Source::Ring { ring: ring.index, given: listed, reversed: ring.reversed }
}
