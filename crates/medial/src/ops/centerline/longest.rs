//! The longest way through a graph.
//!
//! # Method
//! In a tree the node farthest from any node is an end of a longest path. With cycles the nodes far from
//! the middle of such a way are tried until no pair that is left can be farther apart, but for those so near
//! to one tried before that they cannot be either. The longest way of an axis without cycles is found while
//! its leaves are peeled off, in the order of its keypoints.

use super::graph::{Graph, NONE, Way};
use super::line::Centerline;
use crate::axis::MedialAxis;

/// More than the rounding of sums of lengths, as a factor.
const SURE: f64 = 1.0 + 1e-9;

/// Nodes that are visited at most to find the longest way around cycles, from all points together that
/// are tried as its end: about a second.
const MOST_VISITED: usize = 1 << 22;

/// The way between those two ends of a component that are farthest apart. If it has one end only, from
/// there to the farthest node; if none, between the farthest two, or all of it, if it is a single cycle.
pub(super) fn way(graph: &Graph, component: &[u32]) -> Option<Way> {
    let n = component.len();
    let n_pieces = component.iter().map(|&k| graph.degree(k)).sum::<usize>() / 2;
    if component.iter().all(|&k| graph.degree(k) == 2) {
        return Some(cycle(graph, component[0]));
    }
    let mut ends: Vec<u32> = component.iter().copied().filter(|&k| graph.degree(k) == 1).collect();
    let lone = (ends.len() == 1).then(|| ends[0]);
    if ends.len() < 2 {
        ends = component.to_vec();
    }
    let start = lone.unwrap_or_else(|| graph.farthest(&ends, &graph.ways_from(component[0], n)).0);
    let mut best = graph.ways_from(start, n);
    let (mut end, mut length) = graph.farthest(&ends, &best);
    let mut is_best = true;
    if n_pieces >= n && lone.is_none() {
        // Around cycles: from the middle of the way found, no two ends are farther apart than twice
        // the farther of the two.
        let back = graph.back(&best, end);
        let mut middle = back.iter().map(|&(_, node)| node);
        let half = middle.find(|&node| graph.distance(&best, node) * 2.0 <= length);
        let around = graph.ways_from(half.unwrap_or(end), n);
        let distance = |node: u32| graph.distance(&around, node);
        let mut order = ends.clone();
        order.sort_by(|&a, &b| distance(b).total_cmp(&distance(a)).then(a.cmp(&b)));
        // By way of those that were tried no end is farther than this from another one.
        let mut bounds = vec![f64::INFINITY; n];
        for (tried, &node) in order.iter().enumerate() {
            if 2.0 * distance(node) <= length {
                break;
            }
            if tried * n > MOST_VISITED {
                is_best = false;
                break;
            }
            if bounds[graph.place(node)] * SURE <= length {
                continue;
            }
            let ways = graph.ways_from(node, n);
            let (other, there) = graph.farthest(&ends, &ways);
            for &end in &ends {
                let bound = &mut bounds[graph.place(end)];
                *bound = bound.min(graph.distance(&ways, end) + there);
            }
            if there > length {
                (best, end, length) = (ways, other, there);
            }
        }
    }
    (length > 0.0).then(|| Way { is_best, ..graph.way(&best, end) })
}

/// What has been peeled off around a keypoint.
#[derive(Clone, Copy)]
struct Peeled {
    /// How many of its paths are left, and the exclusive or of their numbers: that of the last one.
    left: u32,
    numbers: u32,
    /// The longest way to an end through what is gone, and the path by which it starts.
    reach: f64,
    by: u32,
}

/// The longest way between two ends of an axis, given the lengths of its paths, if there are no cycles.
///
/// # Errors
/// If there are.
pub(super) fn in_forest(
    axis: &MedialAxis,
    length: impl Fn(u32) -> f64,
) -> Result<Option<Centerline>, HasCycles> {
    let nothing = Peeled { left: 0, numbers: 0, reach: 0.0, by: NONE };
    let mut around = vec![nothing; axis.keypoints().len()];
    for (number, ends) in (0..).zip(axis.paths().all_ends()) {
        for end in ends {
            around[end as usize].left += 1;
            around[end as usize].numbers ^= number;
        }
    }
    // The length, the keypoint nearest to the root, and the paths by which both ways leave it.
    let mut best = (0.0, 0, [NONE; 2]);
    let mut gone = 0;
    for leaf in 0..around.len() as u32 {
        let mut keypoint = leaf;
        while around[keypoint as usize].left == 1 {
            let Peeled { numbers: number, reach, .. } = around[keypoint as usize];
            let [from, to] = axis.paths().ends(number);
            let other = if from == keypoint { to } else { from };
            let arm = reach + length(number);
            around[keypoint as usize].left = 0;
            let there = &mut around[other as usize];
            there.left -= 1;
            there.numbers ^= number;
            if there.reach + arm > best.0 {
                best = (there.reach + arm, other, [there.by, number]);
            }
            if arm > there.reach {
                (there.reach, there.by) = (arm, number);
            }
            gone += 1;
            keypoint = other;
        }
    }
    if gone < axis.paths().len() {
        return Err(HasCycles);
    }
    let (length, top, ways) = best;
    let down = |mut by: u32| {
        let (mut keypoint, mut curves) = (top, Vec::new());
        while by != NONE {
            let path = axis.paths().at(by);
            let path = if path.from == keypoint { path } else { path.reversed() };
            curves.push(axis.curve(&path));
            keypoint = path.to;
            by = around[keypoint as usize].by;
        }
        curves
    };
    let mut curves: Vec<_> = down(ways[0]).iter().rev().map(|curve| curve.reversed()).collect();
    curves.extend(down(ways[1]));
    let line = Centerline { curves, extensions: [None; 2], is_best: true, is_free: [true; 2] };
    Ok((length > 0.0).then_some(line))
}

/// Some paths of an axis make a cycle.
pub(super) struct HasCycles;

/// A closed way through nodes with two pieces each.
fn cycle(graph: &Graph, start: u32) -> Way {
    let mut way = Way { is_best: true, ..Way::default() };
    let mut node = start;
    loop {
        let last = way.pieces.last().map(|&(piece, _)| piece);
        let next = graph.pieces_at(node).find(|&piece| Some(piece) != last);
        let Some(piece) = next.or_else(|| graph.pieces_at(node).next()) else { return way };
        way.pieces.push((piece, graph.starts_at(piece, node)));
        way.value += graph.length(piece);
        node = graph.other_end(piece, node);
        if node == start {
            return way;
        }
    }
}
