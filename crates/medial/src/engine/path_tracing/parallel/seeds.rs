use std::ops::Range;

use super::super::front::Front;
use super::super::tracer::seed;
use crate::domain::{Corner, Domain, Site};

/// Where the tracing of a polygon begins: a corner for each component, and others.
#[derive(Debug)]
pub(super) struct Seeds {
    /// Edges that start at convex corners, those that begin components first, in their order.
    corners: Vec<u32>,
    n_components: usize,
    /// All of them in order.
    sorted: Vec<u32>,
    /// Whether loops may close.
    loops: bool,
}

impl Seeds {
    /// About that many convex corners at equal distances.
    pub fn new(domain: &Domain, walks: Range<usize>, wanted: usize) -> Self {
        let all = &domain.walks()[walks.clone()];
        let loops = all.iter().any(|w| w.hole);
        let mut corners: Vec<u32> = walks.filter_map(|walk| seed(domain, walk)).collect();
        let n_components = corners.len();
        let mut sorted = corners.clone();
        sorted.sort_unstable();
        let n_edges: usize = all.iter().map(|w| w.len as usize).sum();
        let step = (n_edges / wanted.max(1)).max(1);
        for walk in all {
            let end = walk.first + walk.len;
            let mut from = walk.first;
            while from < end {
                let to = end.min(from.saturating_add(step as u32));
                let convex = (from..to).find(|&k| domain.edge(k).corner == Corner::Convex);
                corners.extend(convex.filter(|k| sorted.binary_search(k).is_err()));
                from = to;
            }
        }
        sorted.clone_from(&corners);
        sorted.sort_unstable();
        Self { corners, n_components, sorted, loops }
    }

    /// The numbers of all seeds.
    pub fn all(&self) -> Range<usize> {
        0..self.corners.len()
    }

    /// The numbers of those that begin components, in their order.
    pub fn components(&self) -> Range<usize> {
        0..self.n_components
    }

    /// The edge that starts at a seed's corner.
    pub fn corner(&self, seed: usize) -> u32 {
        self.corners[seed]
    }

    /// The seed in the corner at the start of an edge.
    pub fn number(&self, corner: u32) -> Option<usize> {
        self.sorted.binary_search(&corner).ok()?;
        self.corners.iter().position(|&c| c == corner)
    }

    /// Whether nobody else can come to what lies beyond a path between these governors.
    pub fn is_private(&self, domain: &Domain, right: Site, left: Site) -> bool {
        let Some((first, last)) = Front::new(domain, right, left).map(|f| f.ends()) else {
            return false;
        };
        if self.loops {
            return false;
        }
        // The corner before the first edge is behind.
        let upto = |edge: u32| self.sorted.partition_point(|&c| c <= edge);
        if first <= last {
            upto(first) == upto(last)
        } else {
            let walk = domain.walks()[domain.edge(first).walk as usize];
            let before = |edge: u32| self.sorted.partition_point(|&c| c < edge);
            upto(first) == before(walk.first + walk.len) && before(walk.first) == upto(last)
        }
    }
}
