//! A component of a graph as the nodes where ways part or end and the chains of pieces between them: shortest
//! ways are looked for among these few nodes.
//!
//! # Method
//! Dijkstra's algorithm over the nodes that are no joints. Distances are summed piece by piece, as if there
//! were no chains; those inside of a chain follow from its two ends in the end.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::graph::{Graph, NONE, Way};
use crate::ops::groups::Groups;

/// A component of a graph in which some nodes are no joints.
pub(super) struct Chains<'g, 'a> {
    graph: &'g Graph<'a>,
    /// The nodes: those that are no joints, then the joints, chain by chain.
    nodes: Vec<u32>,
    /// The number of each node in this order, by its place in the component.
    numbers: Vec<u32>,
    n_hubs: u32,
    chains: Vec<Chain>,
    /// The pieces of all chains and their lengths.
    pieces: Vec<u32>,
    lengths: Vec<f64>,
    /// The chains that leave each node that is no joint: where those of the first one start, and so on.
    first: Vec<u32>,
    leaving: Vec<Leaving>,
}

/// A chain as it leaves a node.
#[derive(Clone, Copy)]
struct Leaving {
    /// Where it leads.
    end: u32,
    /// Twice its number, and one more if it is passed from its end.
    way: u32,
    length: f64,
}

/// Pieces from one node that is no joint to the next one.
#[derive(Clone, Copy)]
struct Chain {
    ends: [u32; 2],
    /// Its first piece, and the number of its first joint, if it has any.
    first: u32,
    joint: u32,
    n_pieces: u32,
    length: f64,
}

/// A step from a node: the node to which it leads, by which piece, and how long that is.
#[derive(Clone, Copy)]
struct Step {
    to: u32,
    piece: u32,
    length: f64,
}

/// Distances from one node to all others, by their numbers here.
pub(super) struct Distances {
    pub start: u32,
    pub to: Vec<f64>,
}

impl<'g, 'a> Chains<'g, 'a> {
    /// That of these nodes.
    pub fn new(graph: &'g Graph<'a>, component: &[u32]) -> Self {
        let mut numbers = vec![NONE; component.len()];
        let mut nodes = Vec::with_capacity(component.len());
        for (place, &node) in component.iter().enumerate() {
            if graph.degree(node) != 2 {
                numbers[place] = nodes.len() as u32;
                nodes.push(node);
            }
        }
        let n_hubs = nodes.len() as u32;
        let (mut chains, mut pieces, mut lengths) = (Vec::new(), Vec::new(), Vec::new());
        for hub in 0..n_hubs {
            for first in graph.pieces_at(nodes[hub as usize]) {
                // Each chain is found from both of its ends, a single piece from a node to itself once.
                let (begin, joint) = (pieces.len() as u32, nodes.len() as u32);
                let mut node = nodes[hub as usize];
                let (mut piece, mut length) = (first, 0.0);
                let end = loop {
                    pieces.push(piece);
                    lengths.push(graph.length(piece));
                    length += graph.length(piece);
                    node = graph.other_end(piece, node);
                    let number = &mut numbers[graph.place(node)];
                    if *number < n_hubs {
                        break *number;
                    }
                    if *number != NONE {
                        break NONE;
                    }
                    *number = nodes.len() as u32;
                    nodes.push(node);
                    let Some(next) = graph.pieces_at(node).find(|&next| next != piece) else {
                        break NONE;
                    };
                    piece = next;
                };
                let n_pieces = pieces.len() as u32 - begin;
                // From its other end: what lies there has its numbers already.
                let is_known = end == NONE
                    || n_pieces == 1
                        && (end < hub || end == hub && is_passed(&chains, &pieces, first));
                if is_known {
                    pieces.truncate(begin as usize);
                    lengths.truncate(begin as usize);
                    continue;
                }
                chains.push(Chain { ends: [hub, end], first: begin, joint, n_pieces, length });
            }
        }
        let ends = || {
            (0..).zip(&chains).flat_map(|(k, chain): (u32, &Chain)| {
                [(chain.ends[0], 2 * k), (chain.ends[1], 2 * k + 1)]
            })
        };
        let ways = Groups::new(n_hubs as usize, ends);
        let leaving = |&way: &u32| {
            let chain: &Chain = &chains[way as usize / 2];
            let end = chain.ends[usize::from(way.is_multiple_of(2))];
            Leaving { end, way, length: chain.length }
        };
        let leaving = ways.all().iter().map(leaving).collect();
        let first = (0..n_hubs).map(|hub| ways.range(hub).start as u32);
        let first = first.chain([ways.all().len() as u32]).collect();
        Self { graph, nodes, numbers, n_hubs, chains, pieces, lengths, first, leaving }
    }

    /// How many nodes there are.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// The number of a node here.
    pub fn number(&self, node: u32) -> u32 {
        self.numbers[self.graph.place(node)]
    }

    /// The node with a number here.
    pub fn node(&self, number: u32) -> u32 {
        self.nodes[number as usize]
    }

    /// The chains that leave a node that is no joint.
    fn leaving(&self, hub: u32) -> &[Leaving] {
        let [start, end] = [hub, hub + 1].map(|k| self.first[k as usize] as usize);
        &self.leaving[start..end]
    }

    fn lengths_of(&self, chain: &Chain) -> &[f64] {
        &self.lengths[chain.first as usize..][..chain.n_pieces as usize]
    }

    /// The chain of a joint, and how many come before it there.
    fn chain_of(&self, joint: u32) -> (usize, usize) {
        // Chains without joints come before the one whose joints are next.
        let chain = self.chains.partition_point(|chain| chain.joint <= joint) - 1;
        (chain, (joint - self.chains[chain].joint) as usize)
    }

    /// The distances from a node.
    pub fn from(&self, start: u32) -> Distances {
        let mut to = vec![f64::INFINITY; self.nodes.len()];
        let mut heap = BinaryHeap::new();
        to[start as usize] = 0.0;
        let inside = (start >= self.n_hubs).then(|| self.chain_of(start));
        match inside {
            None => heap.push(Reverse((0, start))),
            Some((chain, place)) => {
                let chain = &self.chains[chain];
                let (before, after) = self.lengths_of(chain).split_at(place + 1);
                let ways = [sum(0.0, before.iter().rev()), sum(0.0, after.iter())];
                for (end, way) in chain.ends.into_iter().zip(ways) {
                    if way < to[end as usize] {
                        to[end as usize] = way;
                        heap.push(Reverse((way.to_bits(), end)));
                    }
                }
            }
        }
        /// More than the rounding of a sum of lengths, as a factor.
        const NEARLY: f64 = 1.0 - 1e-8;
        // Positive numbers are in the order of their bits.
        while let Some(Reverse((bits, hub))) = heap.pop() {
            let distance = f64::from_bits(bits);
            if distance > to[hub as usize] {
                continue;
            }
            for &Leaving { end, way, length } in self.leaving(hub) {
                let there = &mut to[end as usize];
                if (distance + length) * NEARLY > *there {
                    continue;
                }
                let lengths = self.lengths_of(&self.chains[way as usize / 2]);
                let whole = match way.is_multiple_of(2) {
                    true => sum(distance, lengths.iter()),
                    false => sum(distance, lengths.iter().rev()),
                };
                if whole < *there {
                    *there = whole;
                    heap.push(Reverse((whole.to_bits(), end)));
                }
            }
        }
        for chain in self.chains.iter().filter(|chain| chain.n_pieces > 1) {
            let lengths = self.lengths_of(chain);
            let [mut before, mut after] = chain.ends.map(|end| to[end as usize]);
            let joints = &mut to[chain.joint as usize..][..lengths.len() - 1];
            for (joint, length) in joints.iter_mut().zip(lengths) {
                before += length;
                *joint = joint.min(before);
            }
            for (joint, length) in joints.iter_mut().zip(&lengths[1..]).rev() {
                after += length;
                *joint = joint.min(after);
            }
        }
        if let Some((chain, place)) = inside {
            let chain = &self.chains[chain];
            let lengths = self.lengths_of(chain);
            let joints = &mut to[chain.joint as usize..][..lengths.len() - 1];
            let mut way = 0.0;
            for (joint, length) in joints[..place].iter_mut().zip(&lengths[1..=place]).rev() {
                way += length;
                *joint = joint.min(way);
            }
            way = 0.0;
            for (joint, length) in joints[place + 1..].iter_mut().zip(&lengths[place + 1..]) {
                way += length;
                *joint = joint.min(way);
            }
        }
        Distances { start, to }
    }

    /// The steps from a node.
    fn steps(&self, number: u32) -> impl Iterator<Item = Step> {
        let step = |chain: &Chain, forwards: bool, from: usize| {
            // A piece lies between the joint before it and the one after it.
            let last = chain.n_pieces as usize - 1;
            let to = match (forwards, from) {
                (true, from) if from == last => chain.ends[1],
                (true, from) => chain.joint + from as u32,
                (false, 0) => chain.ends[0],
                (false, from) => chain.joint + from as u32 - 1,
            };
            let piece = chain.first as usize + from;
            Step { to, piece: self.pieces[piece], length: self.lengths[piece] }
        };
        let (around, inside) = if number < self.n_hubs {
            (self.leaving(number), None)
        } else {
            (&[][..], Some(self.chain_of(number)))
        };
        let of_hub = around.iter().map(move |&Leaving { way, .. }| {
            let chain = &self.chains[way as usize / 2];
            let forwards = way.is_multiple_of(2);
            step(chain, forwards, if forwards { 0 } else { chain.n_pieces as usize - 1 })
        });
        let of_joint = inside.into_iter().flat_map(move |(chain, place)| {
            let chain = &self.chains[chain];
            [step(chain, false, place), step(chain, true, place + 1)]
        });
        of_hub.chain(of_joint)
    }

    /// The steps back from a node to where distances are measured from: of several that come to the same
    /// the one from the nearer node, or from that with the lesser number. Each with the node where it leads.
    pub fn back(&self, distances: &Distances, from: u32) -> Vec<(u32, u32)> {
        let mut back = Vec::new();
        let mut node = from;
        while node != distances.start {
            let there = distances.to[node as usize];
            let best = |node: u32| {
                let steps = self.steps(node).filter(|step| {
                    let before = distances.to[step.to as usize];
                    before < there && before + step.length == there
                });
                steps.min_by(|a, b| {
                    let of = |step: &Step| {
                        (distances.to[step.to as usize], self.node(step.to), step.piece)
                    };
                    let (a, b) = (of(a), of(b));
                    a.0.total_cmp(&b.0).then((a.1, a.2).cmp(&(b.1, b.2)))
                })
            };
            match best(node) {
                Some(step) => {
                    back.push((step.piece, step.to));
                    node = step.to;
                }
                // By steps without length to a node from which one leads back.
                None => {
                    let way = self.level(distances, node, |node| best(node).is_some());
                    let Some(&(_, last)) = way.last() else { return back };
                    back.extend(way);
                    node = last;
                }
            }
        }
        back
    }

    /// The steps without length from a node to one that is wanted, or where distances are measured from.
    fn level(
        &self,
        distances: &Distances,
        from: u32,
        is_wanted: impl Fn(u32) -> bool,
    ) -> Vec<(u32, u32)> {
        let there = distances.to[from as usize];
        let mut open = vec![(from, NONE, 0)];
        let mut next = 0;
        while let Some(&(node, _, _)) = open.get(next) {
            if next > 0 && (node == distances.start || is_wanted(node)) {
                let mut way = Vec::new();
                while next > 0 {
                    let (node, piece, before) = open[next];
                    way.push((piece, node));
                    next = before;
                }
                way.reverse();
                return way;
            }
            for step in self.steps(node) {
                let is_level =
                    distances.to[step.to as usize] == there && there + step.length == there;
                if is_level && open.iter().all(|&(known, _, _)| known != step.to) {
                    open.push((step.to, step.piece, next));
                }
            }
            next += 1;
        }
        Vec::new()
    }

    /// The way from where distances are measured from to a node.
    pub fn way(&self, distances: &Distances, to: u32) -> Way {
        let back = self.back(distances, to).into_iter().rev();
        let pieces =
            back.map(|(piece, from)| (piece, self.graph.starts_at(piece, self.node(from))));
        let (value, is_best) = (distances.to[to as usize], self.graph.is_whole);
        Way { pieces: pieces.collect(), value, is_best }
    }
}

/// Whether a piece from a node to itself makes one of the last chains already.
fn is_passed(chains: &[Chain], pieces: &[u32], piece: u32) -> bool {
    let is_it = |chain: &Chain| chain.n_pieces == 1 && pieces[chain.first as usize] == piece;
    chains.last().is_some_and(|last| {
        let same = chains.iter().rev().take_while(|chain| chain.ends[0] == last.ends[0]);
        same.into_iter().any(is_it)
    })
}

/// Lengths added up one after the other.
fn sum<'l>(start: f64, lengths: impl Iterator<Item = &'l f64>) -> f64 {
    lengths.fold(start, |sum, length| sum + length)
}
