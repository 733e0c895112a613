//! The longest way through a graph.
//!
//! # Method
//! In a tree the node farthest from any node is an end of a longest path. With cycles the nodes far from
//! the middle of such a way are tried until no pair that is left can be farther apart, but for those so near
//! to one tried before that they cannot be either. The longest way of an axis without cycles is found while
//! its leaves are peeled off, in the order of its keypoints.

use std::borrow::Cow;

use super::chains::{Chains, Distances};
use super::graph::{Graph, NONE, Way};
use super::line::Centerline;
use crate::ops::rest::Rest;

/// More than the rounding of sums of lengths, as a factor.
const SURE: f64 = 1.0 + 1e-9;

/// Nodes whose distances are found at most to find the longest way around cycles, from all points together
/// that are tried as its end: about a tenth of a second.
const MOST_VISITED: usize = 1 << 20;

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
    if n_pieces >= n {
        return around_cycles(graph, component, &ends, lone);
    }
    let start = lone.unwrap_or_else(|| graph.farthest(&ends, &graph.ways_from(component[0], n)).0);
    let best = graph.ways_from(start, n);
    let (end, length) = graph.farthest(&ends, &best);
    (length > 0.0).then(|| graph.way(&best, end))
}

/// The same for a component with cycles.
fn around_cycles(graph: &Graph, component: &[u32], ends: &[u32], lone: Option<u32>) -> Option<Way> {
    let chains = Chains::new(graph, component);
    let ends = Ends::new(&chains, ends);
    // Of those that are as far the first one of the component counts.
    let place = |number: u32| graph.place(chains.node(number));
    let farthest = |distances: &Distances| {
        let there = ends.of(&distances.to);
        let most = there.iter().fold(0.0, |most, &d| if d > most { d } else { most });
        let all = (0..there.len()).filter(|&k| there[k] == most).map(|k| ends.number(k));
        (all.min_by_key(|&end| place(end)).unwrap_or(distances.start), most)
    };
    let start = match lone {
        Some(lone) => chains.number(lone),
        None => farthest(&chains.from(chains.number(component[0]))).0,
    };
    let mut best = chains.from(start);
    let (mut end, mut length) = farthest(&best);
    let mut is_best = true;
    if lone.is_none() {
        // From the middle of the way found, no two ends are farther apart than twice the farther of the two.
        let back = chains.back(&best, end);
        let mut middle = back.iter().map(|&(_, node)| node);
        let half = middle.find(|&node| best.to[node as usize] * 2.0 <= length);
        let around = chains.from(half.unwrap_or(end)).to;
        let around = ends.of(&around);
        // By way of those that were tried no end is farther than this from another one.
        let mut bounds = vec![f64::INFINITY; around.len()];
        let mut tried = 0;
        loop {
            // The farthest from the middle that may be farther from another one.
            let next =
                (0..).zip(around.iter().zip(&bounds)).fold(None, |best, (k, (&away, &bound))| {
                    if 2.0 * away <= length || bound * SURE <= length {
                        return best;
                    }
                    let node = |k: usize| chains.node(ends.number(k));
                    match best {
                        Some((other, far))
                            if far > away || far == away && node(other) < node(k) =>
                        {
                            best
                        }
                        _ => Some((k, away)),
                    }
                });
            let Some((next, _)) = next else { break };
            if tried * chains.len() > MOST_VISITED {
                is_best = false;
                break;
            }
            tried += 1;
            let distances = chains.from(ends.number(next));
            let (other, there) = farthest(&distances);
            for (bound, &away) in bounds.iter_mut().zip(&*ends.of(&distances.to)) {
                let by_there = away + there;
                *bound = if by_there < *bound { by_there } else { *bound };
            }
            bounds[next] = 0.0;
            if there > length {
                (best, end, length) = (distances, other, there);
            }
        }
    }
    (length > 0.0).then(|| {
        let way = chains.way(&best, end);
        Way { is_best: is_best && way.is_best, ..way }
    })
}

/// The nodes between which a way is looked for, by their numbers among the chains.
enum Ends {
    /// All of them.
    All,
    Some(Vec<u32>),
}

impl Ends {
    fn new(chains: &Chains, ends: &[u32]) -> Self {
        match ends.len() == chains.len() {
            true => Self::All,
            false => Self::Some(ends.iter().map(|&node| chains.number(node)).collect()),
        }
    }

    fn number(&self, k: usize) -> u32 {
        match self {
            Self::All => k as u32,
            Self::Some(ends) => ends[k],
        }
    }

    /// The values of these among those of all nodes.
    fn of<'v>(&self, all: &'v [f64]) -> Cow<'v, [f64]> {
        match self {
            Self::All => Cow::Borrowed(all),
            Self::Some(ends) => ends.iter().map(|&end| all[end as usize]).collect(),
        }
    }
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

/// The longest way between two ends of what is left of an axis, if there are no cycles, and its length, given the
/// lengths of paths that are whole.
///
/// # Errors
/// If there are.
pub(super) fn in_forest(
    rest: &Rest<'_>,
    length: impl Fn(u32) -> f64,
) -> Result<Option<(f64, Centerline)>, HasCycles> {
    let axis = rest.axis();
    let n_keypoints = axis.keypoints().len();
    let nothing = Peeled { left: 0, numbers: 0, reach: 0.0, by: NONE };
    let mut around = vec![nothing; n_keypoints];
    let mut n_paths = 0;
    // The ends of what is cut: tips are numbered after all keypoints.
    let mut cut: Vec<[u32; 2]> = vec![[NONE; 2]; rest.n_cut()];
    for (number, ends) in (0..).zip(axis.paths().all_ends()) {
        let mut ends = ends;
        if let Some((place, is_tip)) = rest.tips(number) {
            let Some(is_tip) = is_tip else { continue };
            for (end, _) in ends.iter_mut().zip(is_tip).filter(|(_, is_tip)| *is_tip) {
                *end = around.len() as u32;
                around.push(nothing);
            }
            cut[place] = ends;
        }
        for end in ends {
            let there = &mut around[end as usize];
            there.left += 1;
            there.numbers ^= number;
        }
        n_paths += 1;
    }
    let ends_of = |number: u32| match rest.tips(number) {
        None => axis.paths().ends(number),
        Some((place, _)) => cut[place],
    };
    // The length, the keypoint nearest to the root, and the paths by which both ways leave it.
    let mut best = (0.0, 0, [NONE; 2]);
    let mut gone = 0;
    for leaf in 0..around.len() as u32 {
        let mut keypoint = leaf;
        while around[keypoint as usize].left == 1 {
            let Peeled { numbers: number, reach, .. } = around[keypoint as usize];
            let [from, to] = ends_of(number);
            let other = if from == keypoint { to } else { from };
            let whole = rest.tips(number).is_none();
            let arm =
                reach + if whole { length(number) } else { rest.curve_of(number, true).length() };
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
    if gone < n_paths {
        return Err(HasCycles);
    }
    let (length, top, ways) = best;
    let down = |mut by: u32| {
        let (mut keypoint, mut curves) = (top, Vec::new());
        while by != NONE {
            let [from, to] = ends_of(by);
            let forwards = from == keypoint;
            curves.push(rest.curve_of(by, forwards));
            keypoint = if forwards { to } else { from };
            by = around[keypoint as usize].by;
        }
        curves
    };
    let mut curves: Vec<_> = down(ways[0]).iter().rev().map(|curve| curve.reversed()).collect();
    curves.extend(down(ways[1]));
    let line = Centerline { curves, extensions: [None; 2], is_best: true, is_free: [true; 2] };
    Ok((length > 0.0).then_some((length, line)))
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
