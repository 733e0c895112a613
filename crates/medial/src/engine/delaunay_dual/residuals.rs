//! The chord residual of each edge of the dual graph, and what is left above a threshold.

use super::dual::Dual;
use super::samples::Samples;
use crate::geom::Delaunay;

/// How much longer the boundary between both samples across an edge of the dual graph is than their distance
/// \[OK95\], the shorter way around; infinite between two rings, towards infinity, and next to a vertex where the boundary
/// touches itself.
pub(super) fn residuals(triangles: &Delaunay, samples: &Samples, dual: &Dual) -> Vec<f64> {
    let along = samples.along();
    let n_groups = dual.groups.len() as u32;
    let length = |ring: &std::ops::Range<u32>| {
        let last = ring.end - 1;
        let way = samples.points[ring.start as usize] - samples.points[last as usize];
        along[last as usize] + way.norm()
    };
    let lengths: Vec<f64> = samples.rings.iter().map(length).collect();
    let ring_of = |sample: u32| samples.rings.partition_point(|ring| ring.end <= sample);
    let residual = |edge: &super::dual::DualEdge| {
        if edge.from >= n_groups || edge.to >= n_groups {
            return f64::INFINITY;
        }
        let ends = [edge.across, triangles.reversed(edge.across)];
        let [a, b] = ends.map(|edge| dual.sample_at(triangles, edge));
        let ring = ring_of(a);
        if !samples.rings[ring].contains(&b) {
            return f64::INFINITY;
        }
        let way = (along[a as usize] - along[b as usize]).abs();
        let chord = (samples.points[a as usize] - samples.points[b as usize]).norm();
        way.min(lengths[ring] - way) - chord
    };
    dual.edges.iter().map(residual).collect()
}

/// What is left of a dual graph: edges, and nodes without any.
#[derive(Clone, Debug, Default)]
pub(super) struct Left {
    pub edges: Vec<u32>,
    pub alone: Vec<u32>,
}

impl Left {
    /// All of it.
    pub fn all(dual: &Dual) -> Self {
        Self::without(dual, |_| false)
    }

    /// What is left without leaves beside a node with more than two edges [ASM09, §VII].
    pub fn without_leaves(dual: &Dual) -> Self {
        let degrees = dual.degrees();
        Self::without(dual, |number| {
            let edge = dual.edges[number as usize];
            let [a, b] = [edge.from, edge.to].map(|node| degrees[node as usize]);
            a.min(b) == 1 && a.max(b) > 2
        })
    }

    /// What is left if leaves go, one after the other, as long as there is one whose edge is to be taken. No component
    /// and no cycle is broken, and a node of each component stays.
    pub fn without(dual: &Dual, takes: impl Fn(u32) -> bool) -> Self {
        let n = dual.n_nodes();
        let mut degrees = dual.degrees();
        // Of a leaf, the only edge that is left is the sum of all that were, less those that went.
        let mut sums = vec![0_u32; n];
        for (number, edge) in (0_u32..).zip(&dual.edges) {
            for node in [edge.from, edge.to] {
                sums[node as usize] = sums[node as usize].wrapping_add(number);
            }
        }
        let mut is_gone = vec![false; dual.edges.len()];
        let mut leaves: Vec<u32> =
            (0..n as u32).filter(|&node| degrees[node as usize] == 1).collect();
        let mut at = 0;
        while let Some(&leaf) = leaves.get(at) {
            at += 1;
            if degrees[leaf as usize] != 1 {
                continue;
            }
            let number = sums[leaf as usize];
            let edge = dual.edges[number as usize];
            let other = if edge.from == leaf { edge.to } else { edge.from };
            if !takes(number) {
                continue;
            }
            is_gone[number as usize] = true;
            degrees[leaf as usize] = 0;
            // It is no node of its own that is left.
            sums[leaf as usize] = u32::MAX;
            degrees[other as usize] -= 1;
            sums[other as usize] = sums[other as usize].wrapping_sub(number);
            if degrees[other as usize] == 1 {
                leaves.push(other);
            }
        }
        let edges = (0..dual.edges.len() as u32).filter(|&edge| !is_gone[edge as usize]).collect();
        let is_alone = |&node: &u32| degrees[node as usize] == 0 && sums[node as usize] != u32::MAX;
        let groups = dual.groups.len() as u32;
        Self { edges, alone: (0..groups).filter(is_alone).collect() }
    }
}
