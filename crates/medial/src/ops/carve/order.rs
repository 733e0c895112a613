//! The order of moves: trails through a graph of them, with few lifts between.
//!
//! # Method
//! 1. Where an odd number of moves meet, a trail begins or ends, or a move there is gone over once more. What
//!    is gone over again costs its length, a lift as much as it is said to. Over a spanning tree of each
//!    component the cheapest choice is found from the leaves inwards, the first trail being free.
//! 2. The places left over are joined in pairs, as they follow one another in the tree, by lifts. Then all
//!    is even, and one round tour takes every move (Hierholzer); cut at the lifts it is the trails.
//! 3. From the end of one component the bit goes on to that which starts nearest, of some thousands that
//!    follow one another along a space-filling curve.

use std::collections::HashMap;

use super::moves::{Move, Tip};
use crate::geom::{Point, Rect, hilbert};
use crate::ops::groups::Groups;

/// A move and whether it runs from its end to its start.
pub(super) type Turned = (u32, bool);

/// A graph of moves, by the places where they meet.
struct Graph {
    ends: Vec<[u32; 2]>,
    lengths: Vec<f64>,
    /// Moves at each node.
    at: Groups,
    places: Vec<Tip>,
}

/// Trails over some moves, each of them taken once at least, in the order in which they are to be cut.
pub(super) fn trails(moves: &[Move], lift: f64) -> Vec<Vec<Turned>> {
    let graph = Graph::new(moves);
    let mut is_met = vec![false; graph.places.len()];
    let mut tours = Vec::new();
    for root in 0..graph.places.len() as u32 {
        if !is_met[root as usize] {
            let tree = Tree::new(&graph, root, &mut is_met);
            tours.push(tour(&graph, &tree, lift));
        }
    }
    let end = |trail: Option<&Vec<Turned>>, last: bool| {
        let step = trail.and_then(|trail| if last { trail.last() } else { trail.first() });
        let place = step.map(|&(k, back)| graph.ends[k as usize][usize::from(back != last)]);
        place.map_or(Point::default(), |place| graph.places[place as usize].point)
    };
    let ends: Vec<[Point; 2]> =
        tours.iter().map(|tour| [end(tour.first(), false), end(tour.last(), true)]).collect();
    in_turn(&ends).into_iter().flat_map(|k| std::mem::take(&mut tours[k])).collect()
}

/// The numbers of some ways, each given by its ends, in an order in which they start near the end of the one
/// before.
pub(super) fn in_turn(ends: &[[Point; 2]]) -> Vec<usize> {
    /// Ways among which the nearest is looked for.
    const BLOCK: usize = 4096;
    let bounds = ends.iter().fold(Rect::EMPTY, |all, way| all.with(way[0]));
    let mut order: Vec<usize> = (0..ends.len()).collect();
    order.sort_by_cached_key(|&k| hilbert(&bounds, ends[k][0]));
    for block in order.chunks_mut(BLOCK) {
        for k in 1..block.len() {
            let here = ends[block[k - 1]][1];
            let away = |&way: &usize| (ends[way][0] - here).norm2();
            let left = block[k..].iter().map(away).enumerate();
            let nearest = left.min_by(|a, b| a.1.total_cmp(&b.1)).map_or(0, |(place, _)| place);
            block.swap(k, k + nearest);
        }
    }
    order
}

/// The numbers of the places where moves start and end, and the places.
pub(super) fn places<'m>(moves: impl Iterator<Item = &'m Move>) -> (Vec<[u32; 2]>, Vec<Tip>) {
    let mut numbers: HashMap<[u64; 3], u32> = HashMap::new();
    let mut places = Vec::new();
    let mut number = |tip: Tip| {
        let bits = [tip.point.x, tip.point.y, tip.z].map(|v| (v + 0.0).to_bits());
        *numbers.entry(bits).or_insert_with(|| {
            places.push(tip);
            places.len() as u32 - 1
        })
    };
    let ends = moves.map(|cut| [cut.from(), cut.to()].map(&mut number)).collect();
    (ends, places)
}

impl Graph {
    fn new(moves: &[Move]) -> Self {
        let (ends, places) = places(moves.iter());
        let at = || {
            (0..).zip(&ends).flat_map(|(k, &[from, to])| {
                [Some((from, k)), (from != to).then_some((to, k))].into_iter().flatten()
            })
        };
        let at = Groups::new(places.len(), at);
        Self { ends, lengths: moves.iter().map(Move::length).collect(), at, places }
    }

    fn other(&self, edge: u32, node: u32) -> u32 {
        let [from, to] = self.ends[edge as usize];
        if from == node { to } else { from }
    }
}

/// A tree over all nodes of a component.
struct Tree {
    /// Parents before children, each with the place of its parent and the move from there.
    nodes: Vec<(u32, Option<(u32, u32)>)>,
}

impl Tree {
    fn new(graph: &Graph, root: u32, is_met: &mut [bool]) -> Self {
        // Depth first, so that neighbours in the list are near each other.
        let (mut nodes, mut open) = (Vec::new(), vec![(root, None)]);
        while let Some((node, above)) = open.pop() {
            if std::mem::replace(&mut is_met[node as usize], true) {
                continue;
            }
            let place = nodes.len() as u32;
            nodes.push((node, above));
            for &edge in graph.at.of(node).iter().rev() {
                let to = graph.other(edge, node);
                if !is_met[to as usize] {
                    open.push((to, Some((place, edge))));
                }
            }
        }
        Self { nodes }
    }
}

/// What is least over the nodes below: by whether the number of moves gone over again is odd, and by how many
/// places (of two) are left over for free.
type Costs = [[f64; 3]; 2];

const NEVER: Costs = [[f64::INFINITY; 3]; 2];

/// How a node is made even: by what of its children, and with which place left over, if one is.
#[derive(Clone, Copy, Default)]
struct Choice {
    below: [u8; 2],
    is_left: bool,
}

/// The moves to go over once more, and the nodes where trails begin or end.
fn doubled(graph: &Graph, tree: &Tree, lift: f64) -> (Vec<u32>, Vec<u32>) {
    let n = tree.nodes.len();
    let above = || (0..).zip(&tree.nodes).filter_map(|(k, (_, above))| Some(((*above)?.0, k)));
    let children = Groups::new(n, above);
    let mut costs = vec![NEVER; n];
    let mut choices = vec![[[Choice::default(); 3]; 2]; n];
    // What of itself each child adds to the state of those before it and itself.
    let mut shares = vec![[[[0_u8; 2]; 3]; 2]; n];
    for place in (0..n).rev() {
        let (node, above) = tree.nodes[place];
        let mut sum = NEVER;
        sum[0][0] = 0.0;
        for &child in children.of(place as u32) {
            let (before, mut next) = (sum, NEVER);
            for (odd, free) in states() {
                for (twice, used) in states().filter(|&(_, used)| used <= free) {
                    let cost =
                        before[odd ^ twice][free - used] + costs[child as usize][twice][used];
                    if cost < next[odd][free] {
                        next[odd][free] = cost;
                        shares[child as usize][odd][free] = [twice as u8, used as u8];
                    }
                }
            }
            sum = next;
        }
        let loops = graph.at.of(node).iter().filter(|&&e| graph.other(e, node) == node).count();
        let is_odd = (graph.at.of(node).len() + loops) % 2;
        let length = above.map_or(0.0, |(_, edge)| graph.lengths[edge as usize]);
        for (twice, free) in states() {
            let mut options = vec![([is_odd ^ twice, free], false, 0.0)];
            options.push(([is_odd ^ twice ^ 1, free], true, 0.5 * lift));
            if free > 0 {
                options.push(([is_odd ^ twice ^ 1, free - 1], true, 0.0));
            }
            for (below, is_left, price) in options {
                let cost = sum[below[0]][below[1]] + price + twice as f64 * length;
                if cost < costs[place][twice][free] {
                    costs[place][twice][free] = cost;
                    let below = below.map(|v| v as u8);
                    choices[place][twice][free] = Choice { below, is_left };
                }
            }
        }
    }
    // Back from the root, over which nothing is doubled.
    let free = usize::from(costs[0][0][2] < costs[0][0][0]) * 2;
    let mut state = vec![[0_u8; 2]; n];
    state[0] = [0, free as u8];
    let (mut again, mut left) = (Vec::new(), Vec::new());
    for place in 0..n {
        let [twice, free] = state[place].map(usize::from);
        let (node, above) = tree.nodes[place];
        again.extend(above.filter(|_| twice == 1).map(|(_, edge)| edge));
        let choice = choices[place][twice][free];
        if choice.is_left {
            left.push(node);
        }
        let [mut odd, mut free] = choice.below.map(usize::from);
        for &child in children.of(place as u32).iter().rev() {
            let share = shares[child as usize][odd][free];
            state[child as usize] = share;
            odd ^= usize::from(share[0]);
            free -= usize::from(share[1]);
        }
    }
    (again, left)
}

fn states() -> impl Iterator<Item = (usize, usize)> {
    (0..2).flat_map(|odd| (0..3).map(move |free| (odd, free)))
}

/// The trails of one component.
fn tour(graph: &Graph, tree: &Tree, lift: f64) -> Vec<Vec<Turned>> {
    let (again, left) = doubled(graph, tree, lift);
    // Edges of the tour: moves, some twice, and lifts.
    let nodes: HashMap<u32, u32> =
        (0..).zip(&tree.nodes).map(|(k, &(node, _))| (node, k)).collect();
    let mut edges: Vec<([u32; 2], Option<u32>)> = Vec::new();
    for &(node, _) in &tree.nodes {
        let first = graph.at.of(node).iter().filter(|&&e| graph.ends[e as usize][0] == node);
        edges.extend(first.map(|&e| (graph.ends[e as usize], Some(e))));
    }
    edges.extend(again.iter().map(|&e| (graph.ends[e as usize], Some(e))));
    edges.extend(left.chunks_exact(2).map(|pair| ([pair[0], pair[1]], None)));
    let mut at = vec![Vec::new(); tree.nodes.len()];
    for (k, (ends, _)) in (0_u32..).zip(&edges) {
        ends.iter().for_each(|node| at[nodes[node] as usize].push(k));
    }
    // Hierholzer: walk until stuck, and back up to where something is left.
    let start = left.first().copied().unwrap_or_else(|| shallowest(graph, tree));
    let mut is_used = vec![false; edges.len()];
    let (mut stack, mut round) = (vec![(start, None)], Vec::new());
    while let Some(&(node, arrival)) = stack.last() {
        let list = &mut at[nodes[&node] as usize];
        match list.pop() {
            Some(edge) if is_used[edge as usize] => {}
            Some(edge) => {
                is_used[edge as usize] = true;
                let ([from, to], number) = edges[edge as usize];
                let next = if from == node { to } else { from };
                stack.push((next, Some((number, from != node))));
            }
            None => {
                stack.pop();
                round.extend(arrival);
            }
        }
    }
    round.reverse();
    // From behind a lift on, if there is one.
    let lifted = round.iter().position(|step| step.0.is_none());
    round.rotate_left(lifted.map_or(0, |k| k + 1));
    let parts = round.split(|step| step.0.is_none());
    let trail = |part: &[(Option<u32>, bool)]| {
        part.iter().filter_map(|&(number, back)| Some((number?, back))).collect::<Vec<_>>()
    };
    parts.map(trail).filter(|trail| !trail.is_empty()).collect()
}

/// The node of a component that is nearest to the surface; of several the first.
fn shallowest(graph: &Graph, tree: &Tree) -> u32 {
    let z = |node: u32| graph.places[node as usize].z;
    let mut best = tree.nodes[0].0;
    for &(node, _) in &tree.nodes {
        if z(node) > z(best) {
            best = node;
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(from: (f64, f64), to: (f64, f64)) -> Move {
        let tip = |(x, y)| Tip { point: Point::new(x, y), z: -1.0 };
        Move::Line { from: tip(from), to: tip(to) }
    }

    /// Every move is taken, and each trail goes on from where the move before ends.
    fn checked(moves: &[Move], lift: f64) -> (usize, f64) {
        let trails = trails(moves, lift);
        let mut times = vec![0; moves.len()];
        let mut length = 0.0;
        for trail in &trails {
            let turned = |&(k, back): &Turned| {
                let step = moves[k as usize];
                if back { step.reversed() } else { step }
            };
            for pair in trail.windows(2) {
                assert_eq!(turned(&pair[0]).to(), turned(&pair[1]).from());
            }
            for &(k, _) in trail {
                times[k as usize] += 1;
                length += moves[k as usize].length();
            }
        }
        assert!(times.iter().all(|&n| n == 1 || n == 2), "{times:?}");
        (trails.len(), length)
    }

    #[test]
    fn a_single_move_is_one_trail_however_dear_lifts_are() {
        assert_eq!(checked(&[line((0., 0.), (1., 0.))], 1e9), (1, 1.0));
    }

    #[test]
    fn short_spurs_are_gone_over_again_and_long_ones_are_not() {
        // A spine of length 10 with a fork of two arms at either end.
        let fork = |x: f64, arm: f64| [line((x, 0.), (x, arm)), line((x, -arm), (x, 0.))];
        let moves = |arm| {
            let mut moves = vec![line((0., 0.), (10., 0.))];
            moves.extend(fork(0., arm));
            moves.extend(fork(10., arm));
            moves
        };
        // Two arms are gone over again, the others are where the trail begins and ends.
        assert_eq!(checked(&moves(1.0), 4.0), (1, 16.0));
        // Two lifts cost less than two arms of length 3.
        assert_eq!(checked(&moves(3.0), 2.5), (3, 22.0));
        assert_eq!(checked(&moves(1.0), 0.0), (3, 14.0));
    }

    #[test]
    fn rings_and_grids_are_one_trail_if_all_is_even() {
        let square = [(0., 0.), (1., 0.), (1., 1.), (0., 1.)];
        let ring: Vec<Move> = (0..4).map(|k| line(square[k], square[(k + 1) % 4])).collect();
        assert_eq!(checked(&ring, 0.0), (1, 4.0));
        let mut grid = Vec::new();
        for k in 0..4 {
            for j in 0..3 {
                let (a, b) = (f64::from(k), f64::from(j));
                grid.extend([line((b, a), (b + 1., a)), line((a, b), (a, b + 1.))]);
            }
        }
        // Eight places of degree three on the sides: four trails, or fewer and something twice.
        assert_eq!(checked(&grid, 0.0), (4, 24.0));
        let (n, length) = checked(&grid, 2.5);
        assert!(n == 1 && (27.0..=28.0).contains(&length), "{length}");
    }

    #[test]
    fn ways_follow_one_another_nearby() {
        // Circles around two centres, larger and larger, that start on their left.
        let starts: Vec<[Point; 2]> = (1..=20)
            .flat_map(|k| [0.0, 100.0].map(|x| [Point::new(x - f64::from(k), 0.0); 2]))
            .collect();
        let order = in_turn(&starts);
        let jumps = order.windows(2).map(|pair| (starts[pair[1]][0] - starts[pair[0]][1]).norm());
        let far = jumps.filter(|&jump| jump > 20.0).count();
        assert!(far <= 1, "{far} jumps: {order:?}");
        let mut all = order;
        all.sort_unstable();
        assert!(all.into_iter().eq(0..40));
    }

    #[test]
    fn every_component_is_cut() {
        let moves: Vec<Move> = (0..50)
            .map(|k| line((f64::from(k), 0.), (f64::from(k), 1.)))
            .chain([line((0.5, 7.0), (0.5, 8.0))])
            .collect();
        assert_eq!(checked(&moves, 1.0), (51, 51.0));
    }
}
