//! The best way for a label: long, straight, and wide enough.
//!
//! # Contract
//! A text of height `h` fits where the radius is `h/2` at least. Along a way that turns by an angle `θ` its
//! letters lose `θ h/2` on the inner side, and as much of a gap opens on the outer one, so the way is worth
//! its length less `θ h`. No way through the part of the axis where the text fits is worth more, each cycle
//! being opened where it is narrowest. Takes O(n log n) for n pieces but for the straightening.
//!
//! # Method
//! 1. Paths are cut where the text no longer fits, and where they bend. In every cycle the narrowest path
//!    is left out (a spanning forest, the widest paths first).
//! 2. What lies between branchings is straightened within `h/4`, which leaves *legs*. Between branchings
//!    nearer than `h/2` directions mean nothing: they count as one.
//! 3. The best way that ends with a leg is the leg with the best of those that lead to it, or alone: from the
//!    leaves to a root, and back. Which one leads best to each of the legs around a branching is found in
//!    two rounds each way, as a turn costs the same for each radian.
//!
//! # Departures
//! Papers on labels along skeletons weigh length, straightness and room in ways of their own; here one
//! length, the height of the text, says all of it.

use std::f64::consts::{PI, TAU};

use super::graph::{Graph, NONE, Pieces, Way};
use super::simplify::kept;
use crate::axis::{Curve, MedialAxis};
use crate::geom::{DisjointSets, Point};

/// How far a way is straightened before its turns are counted, as a share of the height of the text.
const STRAIGHTENED: f64 = 0.25;

/// How far branchings are apart at least to count as two, as a share of the height of the text.
const APART: f64 = 0.5;

/// How far curves may be from the chords that stand for them, as a share of the height of the text.
const CHORD_ERROR: f64 = 0.125;

/// The graph of those parts of paths where a text of this height fits, without cycles.
pub(super) fn graph<'a>(axis: &'a MedialAxis, paths: &[u32], height: f64) -> Graph<'a> {
    let curve = |path: u32| axis.curve(&axis.paths().at(path));
    let mut order: Vec<(f64, u32)> =
        paths.iter().map(|&path| (curve(path).radius_min(), path)).collect();
    order.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut trees = DisjointSets::new(axis.keypoints().len());
    let mut pieces = Pieces::of(axis);
    let mut is_whole = true;
    for (least, path) in order {
        let ends = axis.paths().at(path);
        let curve = curve(path);
        if least >= 0.5 * height {
            match trees.join(ends.from, ends.to) {
                true => bent(&mut pieces, path, &curve, [0.0, 1.0], height),
                false => is_whole = false,
            }
            continue;
        }
        // The radius falls from each end to the least.
        let falls = curve.radius_from() > curve.radius_to();
        let parts = match curve.parameters_at_radius(0.5 * height) {
            [Some(first), Some(second)] => [Some([0.0, first]), Some([second, 1.0])],
            [Some(only), None] if falls => [Some([0.0, only]), None],
            [Some(only), None] => [Some([only, 1.0]), None],
            _ => [None; 2],
        };
        for part in parts.into_iter().flatten() {
            bent(&mut pieces, path, &curve, part, height);
        }
    }
    let mut graph = Graph::new(pieces);
    graph.is_whole = is_whole;
    graph
}

/// Adds a part of a path in pieces that are nearly straight.
fn bent(pieces: &mut Pieces, path: u32, curve: &Curve, [from, to]: [f64; 2], height: f64) {
    let n = curve.piece(from, to).polyline(CHORD_ERROR * height).len() as u32 - 1;
    let at = |k: u32| if k == n { to } else { from + (to - from) * f64::from(k) / f64::from(n) };
    let at: Vec<f64> = (0..=n).map(at).collect();
    pieces.add(path, &at);
}

/// The best way through a component, which is a tree.
pub(super) fn way(graph: &Graph, component: &[u32], height: f64) -> Option<Way> {
    let mut clusters = DisjointSets::new(component.len());
    let mut legs = Vec::new();
    for chain in chains(graph, component) {
        let ends = [chain.nodes[0], chain.nodes[chain.nodes.len() - 1]];
        let is_between = ends.iter().all(|&node| graph.is_branching(node));
        let length: f64 = chain.lengths.iter().sum();
        if is_between && length < APART * height {
            let [a, b] = ends.map(|node| graph.place(node) as u32);
            clusters.join(a, b);
            continue;
        }
        legs.extend(straightened(graph, &chain, height));
    }
    for leg in &mut legs {
        leg.clusters = leg.nodes.map(|node| clusters.first(graph.place(node) as u32));
    }
    let best = best(component.len(), &legs, height)?;
    let ways = graph.ways_from(best.from, component.len());
    Some(Way { value: best.value, ..graph.way(&ways, best.to) })
}

/// What lies between two nodes that are no mere joints.
struct Chain {
    nodes: Vec<u32>,
    /// The length from each node to the next.
    lengths: Vec<f64>,
}

fn chains(graph: &Graph, component: &[u32]) -> Vec<Chain> {
    let mut chains = Vec::new();
    for &start in component.iter().filter(|&&node| !graph.is_joint(node)) {
        for piece in graph.pieces_at(start) {
            let mut chain = Chain { nodes: vec![start], lengths: Vec::new() };
            let (mut piece, mut node) = (piece, start);
            loop {
                node = graph.other_end(piece, node);
                chain.nodes.push(node);
                chain.lengths.push(graph.length(piece));
                let last = piece;
                match graph.pieces_at(node).find(|&next| next != last) {
                    Some(next) if graph.is_joint(node) => piece = next,
                    _ => break,
                }
            }
            // Each is found from both ends.
            if graph.place(start) < graph.place(node) {
                chains.push(chain);
            }
        }
    }
    chains
}

/// A straight stretch of a way.
#[derive(Clone, Copy, Debug)]
struct Leg {
    nodes: [u32; 2],
    /// What its ends count as.
    clusters: [u32; 2],
    /// The length of what it stands for.
    length: f64,
    /// The direction from its first end to its second.
    heading: f64,
}

/// The legs of a chain.
fn straightened(graph: &Graph, chain: &Chain, height: f64) -> Vec<Leg> {
    let points: Vec<Point> = chain.nodes.iter().filter_map(|&node| graph.position(node)).collect();
    let kept = kept(&points, STRAIGHTENED * height, |_, _| true);
    let leg = |ends: &[usize]| {
        let (from, to) = (ends[0], ends[1]);
        let way = points[to] - points[from];
        Leg {
            nodes: [chain.nodes[from], chain.nodes[to]],
            clusters: [NONE; 2],
            length: chain.lengths[from..to].iter().sum(),
            heading: way.y.atan2(way.x),
        }
    };
    kept.windows(2).map(leg).collect()
}

/// The best way through a tree of legs.
#[derive(Clone, Copy, Debug)]
struct Best {
    value: f64,
    from: u32,
    to: u32,
}

/// A leg in one of its directions: twice its number, and one more if it is run through backwards.
type Run = usize;

/// The best way that ends with a run.
#[derive(Clone, Copy, Debug)]
struct Ending {
    value: f64,
    start: u32,
}

/// The best way through legs that form a tree, between clusters below a number.
fn best(n_clusters: usize, legs: &[Leg], height: f64) -> Option<Best> {
    let mut runs_from: Vec<Vec<Run>> = vec![Vec::new(); n_clusters];
    for (k, leg) in legs.iter().enumerate() {
        runs_from[leg.clusters[0] as usize].push(2 * k);
        runs_from[leg.clusters[1] as usize].push(2 * k + 1);
    }
    let target = |run: Run| legs[run / 2].clusters[1 - run % 2] as usize;
    // Away from a root: each run is met after those that lead to its start.
    let root = legs.first()?.clusters[0] as usize;
    let mut order: Vec<(usize, Option<Run>)> = vec![(root, None)];
    let mut next = 0;
    while let Some(&(cluster, came)) = order.get(next) {
        next += 1;
        let onwards = runs_from[cluster].iter().filter(|&&run| Some(run ^ 1) != came);
        order.extend(onwards.map(|&run| (target(run), Some(run))));
    }
    let mut endings: Vec<Option<Ending>> = vec![None; 2 * legs.len()];
    // Towards the root.
    for &(cluster, came) in order.iter().rev() {
        if let Some(came) = came {
            lead(legs, &runs_from[cluster], &[came ^ 1], height, &mut endings);
        }
    }
    for &(cluster, came) in &order {
        let onwards: Vec<Run> =
            runs_from[cluster].iter().copied().filter(|&run| Some(run ^ 1) != came).collect();
        lead(legs, &runs_from[cluster], &onwards, height, &mut endings);
    }
    let mut best: Option<Best> = None;
    for (run, ending) in endings.iter().enumerate() {
        let Some(Ending { value, start }) = *ending else { continue };
        if best.is_none_or(|best| value > best.value) {
            best = Some(Best { value, from: start, to: legs[run / 2].nodes[1 - run % 2] });
        }
    }
    best
}

/// Finds the best ways that end with some of the runs from a cluster, from those known that end with the
/// opposite of one of all.
fn lead(legs: &[Leg], all: &[Run], wanted: &[Run], height: f64, endings: &mut [Option<Ending>]) {
    let heading = |run: Run| (legs[run / 2].heading + PI * (run % 2) as f64).rem_euclid(TAU);
    // Those that arrive, with what they are worth, and those that leave, by heading.
    let arriving = all.iter().map(|&run| run ^ 1);
    let arriving = arriving.filter_map(|run| endings[run].map(|ending| (run, Some(ending))));
    let leaving = wanted.iter().map(|&run| (run, None));
    let mut around: Vec<(f64, Run, Option<Ending>)> =
        arriving.chain(leaving).map(|(run, ending)| (heading(run), run, ending)).collect();
    around.sort_by(|a, b| a.0.total_cmp(&b.0));
    for &run in wanted {
        endings[run] = Some(Ending { value: 0.0, start: legs[run / 2].nodes[run % 2] });
    }
    for turns_left in [true, false] {
        if !turns_left {
            around.reverse();
        }
        // The best two so far, with what they are worth in this direction: nothing goes on with its own
        // leg.
        let mut leading: [Option<(usize, Ending)>; 2] = [None; 2];
        let mut last = around.first().map_or(0.0, |first| first.0);
        for &(heading, run, ending) in around.iter().chain(&around) {
            let turn = if turns_left { heading - last } else { last - heading };
            for known in leading.iter_mut().flatten() {
                known.1.value -= height * turn.rem_euclid(TAU);
            }
            last = heading;
            if let Some(ending) = ending {
                insert(&mut leading, (run / 2, ending));
                continue;
            }
            let other = leading.into_iter().flatten().find(|known| known.0 != run / 2);
            if let (Some((_, other)), Some(own)) = (other, &mut endings[run])
                && other.value > own.value
            {
                *own = other;
            }
        }
    }
    for &run in wanted {
        if let Some(ending) = &mut endings[run] {
            ending.value += legs[run / 2].length;
        }
    }
}

/// Puts an ending among the best two of different legs.
fn insert([first, second]: &mut [Option<(usize, Ending)>; 2], new: (usize, Ending)) {
    let is_better = |old: &Option<(usize, Ending)>| old.is_none_or(|old| new.1.value > old.1.value);
    let is_same = first.is_some_and(|first| first.0 == new.0);
    match (is_same, is_better(first)) {
        (true, true) => *first = Some(new),
        (false, true) => (*first, *second) = (Some(new), *first),
        (false, false) if is_better(second) => *second = Some(new),
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers below 1 that look random.
    struct Random(u64);

    impl Random {
        fn unit(&mut self) -> f64 {
            self.0 = self
                .0
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 11) as f64 / (1_u64 << 53) as f64
        }
    }

    /// A tree of legs between nodes that count as themselves.
    fn tree(random: &mut Random, n: u32) -> Vec<Leg> {
        let leg = |k: u32| {
            let to = (random.unit() * f64::from(k)) as u32;
            let nodes = if random.unit() < 0.5 { [k, to] } else { [to, k] };
            // Some headings are the same.
            let heading = (random.unit() * 16.0).floor() * TAU / 16.0 - PI;
            Leg { nodes, clusters: nodes, length: random.unit(), heading }
        };
        (1..n).map(leg).collect()
    }

    /// The most that a way is worth that goes on from here, by trying all.
    fn tried(legs: &[Leg], node: u32, came: Option<(usize, f64)>, height: f64) -> f64 {
        let mut best = 0.0_f64;
        for (k, leg) in legs.iter().enumerate() {
            let Some(end) = leg.clusters.iter().position(|&cluster| cluster == node) else {
                continue;
            };
            if came.is_some_and(|(came, _)| came == k) {
                continue;
            }
            let heading = leg.heading + PI * end as f64;
            let turn = came.map_or(0.0, |(_, before)| {
                let turn = (heading - before).rem_euclid(TAU);
                turn.min(TAU - turn)
            });
            let on = tried(legs, leg.clusters[1 - end], Some((k, heading)), height);
            best = best.max(leg.length - height * turn + on);
        }
        best
    }

    #[test]
    fn no_way_through_a_random_tree_is_worth_more() {
        let random = &mut Random(605);
        for k in 0..400 {
            let n = 2 + k % 14;
            let legs = tree(random, n);
            let height = [0.0, 0.05, 0.3, 1.0][k as usize / 14 % 4];
            let found = best(n as usize, &legs, height).unwrap();
            let all = (0..n).map(|node| tried(&legs, node, None, height)).fold(0.0, f64::max);
            assert!((found.value - all).abs() < 1e-9, "{} {all}: {legs:?}", found.value);
            // Its ends are those of such a way.
            let from = tried_between(&legs, found.from, found.to, None, height);
            assert!((found.value - from.unwrap()).abs() < 1e-9);
        }
    }

    /// What the way from one node to another is worth.
    fn tried_between(
        legs: &[Leg],
        node: u32,
        to: u32,
        came: Option<(usize, f64)>,
        height: f64,
    ) -> Option<f64> {
        if node == to {
            return Some(0.0);
        }
        legs.iter().enumerate().find_map(|(k, leg)| {
            let end = leg.clusters.iter().position(|&cluster| cluster == node)?;
            if came.is_some_and(|(came, _)| came == k) {
                return None;
            }
            let heading = leg.heading + PI * end as f64;
            let turn = came.map_or(0.0, |(_, before)| {
                let turn = (heading - before).rem_euclid(TAU);
                turn.min(TAU - turn)
            });
            let on = tried_between(legs, leg.clusters[1 - end], to, Some((k, heading)), height)?;
            Some(leg.length - height * turn + on)
        })
    }
}
