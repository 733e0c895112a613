//! Graphs whose edges are pieces of the paths of an axis, and ways through them.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::line::Centerline;
use crate::axis::MedialAxis;
use crate::geom::{DisjointSets, Point};
use crate::ops::groups::Groups;

/// A graph of pieces of paths.
pub(super) struct Graph<'a> {
    axis: &'a MedialAxis,
    pieces: Vec<Piece>,
    /// The pieces at each node.
    incidence: Groups,
    /// The steps that these are, in the same order.
    steps: Vec<Step>,
    lengths: Vec<f64>,
    used: Vec<bool>,
    /// The place of each node in its component, once that is known.
    places: Vec<u32>,
    /// Whether nothing was left out that could have made a better way.
    pub is_whole: bool,
}

/// A part of a path, between two nodes.
#[derive(Clone, Copy, Debug)]
struct Piece {
    path: u32,
    /// The parameters of its ends, in ascending order.
    span: [f64; 2],
    from: u32,
    to: u32,
}

/// A piece as it is passed from a node: where it leads, and how long it is.
#[derive(Clone, Copy, Debug)]
struct Step {
    piece: u32,
    to: u32,
    length: f64,
}

/// Pieces that are gathered for a graph. Keypoints are nodes under their own numbers; more nodes lie where
/// paths are cut.
pub(super) struct Pieces<'a> {
    axis: &'a MedialAxis,
    pieces: Vec<Piece>,
    n_nodes: u32,
}

/// A way through a graph.
#[derive(Default)]
pub(super) struct Way {
    /// Its pieces, each with whether it is run through from its start.
    pub pieces: Vec<(u32, bool)>,
    /// How good it is, to be compared with others.
    pub value: f64,
    /// Whether there is none better for sure.
    pub is_best: bool,
}

/// Shortest ways from one node to all others of its component, by their places there.
pub(super) struct Ways {
    start: u32,
    /// Infinite where there is none.
    distances: Vec<f64>,
    /// The piece by which each is reached.
    last: Vec<u32>,
}

pub(super) const NONE: u32 = u32::MAX;

impl<'a> Pieces<'a> {
    pub fn of(axis: &'a MedialAxis) -> Self {
        Self { axis, pieces: Vec::new(), n_nodes: axis.keypoints().len() as u32 }
    }

    /// Adds the part of a path from the first of some ascending parameters to the last one, cut at those in
    /// between; gives the nodes there.
    pub fn add(&mut self, path: u32, at: &[f64]) -> Vec<u32> {
        let ends = self.axis.paths().at(path);
        let mut node = |u: f64| {
            if u <= 0.0 {
                return ends.from;
            }
            if u >= 1.0 {
                return ends.to;
            }
            self.n_nodes += 1;
            self.n_nodes - 1
        };
        let nodes: Vec<u32> = at.iter().map(|&u| node(u)).collect();
        for (span, nodes) in at.windows(2).zip(nodes.windows(2)) {
            let (span, [from, to]) = ([span[0], span[1]], [nodes[0], nodes[1]]);
            self.pieces.push(Piece { path, span, from, to });
        }
        nodes
    }
}

impl<'a> Graph<'a> {
    /// The graph of some paths of an axis as they are, given their lengths.
    pub fn whole(axis: &'a MedialAxis, paths: &[u32], length: impl Fn(u32) -> f64) -> Self {
        let piece = |&path: &u32| {
            let [from, to] = axis.paths().ends(path);
            Piece { path, span: [0.0, 1.0], from, to }
        };
        let pieces = Pieces { pieces: paths.iter().map(piece).collect(), ..Pieces::of(axis) };
        Self::with_lengths(pieces, paths.iter().map(|&path| length(path)).collect())
    }

    pub fn new(pieces: Pieces<'a>) -> Self {
        let Pieces { axis, pieces, n_nodes } = pieces;
        let length = |piece: &Piece| {
            let path = axis.paths().at(piece.path);
            match piece.span {
                [0.0, 1.0] => axis.length_of(&path),
                [from, to] => axis.curve(&path).piece(from, to).length(),
            }
        };
        let lengths = pieces.iter().map(length).collect();
        Self::with_lengths(Pieces { axis, pieces, n_nodes }, lengths)
    }

    fn with_lengths(pieces: Pieces<'a>, lengths: Vec<f64>) -> Self {
        let Pieces { axis, pieces, n_nodes } = pieces;
        let ends = || (0..).zip(&pieces).flat_map(|(k, piece)| [(piece.from, k), (piece.to, k)]);
        let incidence = Groups::new(n_nodes as usize, ends);
        let mut steps = Vec::with_capacity(incidence.all().len());
        for node in 0..n_nodes {
            steps.extend(incidence.of(node).iter().map(|&piece| {
                let Piece { from, to, .. } = pieces[piece as usize];
                let to = if from == node { to } else { from };
                Step { piece, to, length: lengths[piece as usize] }
            }));
        }
        let (used, places) = (vec![false; pieces.len()], vec![NONE; n_nodes as usize]);
        Self { axis, pieces, incidence, steps, lengths, used, places, is_whole: true }
    }

    /// All nodes, also those without a piece.
    pub fn nodes(&self) -> std::ops::Range<u32> {
        0..self.places.len() as u32
    }

    /// The pieces at a node that are left.
    pub fn pieces_at(&self, node: u32) -> impl Iterator<Item = u32> {
        self.incidence.of(node).iter().copied().filter(|&piece| !self.used[piece as usize])
    }

    /// The steps from a node over pieces that are left.
    fn steps_from(&self, node: u32) -> impl Iterator<Item = Step> {
        let steps = &self.steps[self.incidence.range(node)];
        steps.iter().copied().filter(|step| !self.used[step.piece as usize])
    }

    /// The step from a node on, for who comes by a piece, if that is all there is.
    fn step_on(&self, node: u32, by: u32) -> Option<Step> {
        let mut others = self.steps_from(node).filter(|step| step.piece != by);
        others.next().filter(|_| others.next().is_none())
    }

    /// How many pieces end at a node, of those that are left.
    pub fn degree(&self, node: u32) -> usize {
        self.pieces_at(node).count()
    }

    /// Whether a node is no more than a joint of two pieces.
    pub fn is_joint(&self, node: u32) -> bool {
        self.pieces_at(node).take(3).count() == 2
    }

    /// Whether ways part at a node.
    pub fn is_branching(&self, node: u32) -> bool {
        self.pieces_at(node).take(3).count() == 3
    }

    pub fn length(&self, piece: u32) -> f64 {
        self.lengths[piece as usize]
    }

    /// Where the first piece at a node has it.
    pub fn position(&self, node: u32) -> Option<Point> {
        let number = *self.incidence.of(node).first()?;
        let Piece { path, span, .. } = self.pieces[number as usize];
        let end = usize::from(!self.starts_at(number, node));
        Some(self.axis.curve(&self.axis.paths().at(path)).point_at(span[end]))
    }

    pub fn starts_at(&self, piece: u32, node: u32) -> bool {
        self.pieces[piece as usize].from == node
    }

    pub fn other_end(&self, piece: u32, node: u32) -> u32 {
        let Piece { from, to, .. } = self.pieces[piece as usize];
        if from == node { to } else { from }
    }

    /// The place of a node in its component.
    pub fn place(&self, node: u32) -> usize {
        self.places[node as usize] as usize
    }

    /// Takes the pieces of a way out of the graph.
    pub fn take(&mut self, way: &Way) {
        for &(piece, _) in &way.pieces {
            self.used[piece as usize] = true;
        }
    }

    /// The components with a piece left in which these nodes lie. Whatever these nodes were joined to before
    /// is among them.
    pub fn components(&mut self, nodes: impl Iterator<Item = u32> + Clone) -> Vec<Vec<u32>> {
        let mut list = Vec::new();
        for node in nodes.clone() {
            self.places[node as usize] = NONE;
        }
        for start in nodes {
            if self.places[start as usize] != NONE || self.pieces_at(start).next().is_none() {
                continue;
            }
            self.places[start as usize] = 0;
            let mut component = vec![start];
            let mut next = 0;
            while let Some(&node) = component.get(next) {
                next += 1;
                for &piece in self.incidence.of(node) {
                    let other = self.other_end(piece, node);
                    if !self.used[piece as usize] && self.places[other as usize] == NONE {
                        self.places[other as usize] = component.len() as u32;
                        component.push(other);
                    }
                }
            }
            list.push(component);
        }
        list
    }

    /// The shortest ways from a node of a component of so many. Takes O(n) in a tree.
    pub fn ways_from(&self, start: u32, n: usize) -> Ways {
        let mut ways = Ways { start, distances: vec![f64::INFINITY; n], last: vec![NONE; n] };
        ways.distances[self.place(start)] = 0.0;
        if self.only_ways(&mut ways) {
            return ways;
        }
        ways.distances.fill(f64::INFINITY);
        ways.distances[self.place(start)] = 0.0;
        // Positive numbers are in the order of their bits.
        let mut heap = BinaryHeap::from([Reverse((0_u64, start))]);
        while let Some(Reverse((bits, node))) = heap.pop() {
            let distance = f64::from_bits(bits);
            if distance > ways.distances[self.place(node)] {
                continue;
            }
            for mut step in self.steps_from(node) {
                // Where there is but one way on it is taken at once, without the heap.
                let (mut from, mut distance) = (node, distance);
                while self.offer(&mut ways, from, distance, step) {
                    (from, distance) = (step.to, distance + step.length);
                    let Some(next) = self.step_on(from, step.piece) else {
                        heap.push(Reverse((distance.to_bits(), from)));
                        break;
                    };
                    step = next;
                }
            }
        }
        ways
    }

    /// Takes a step from a node at some distance, if that is nearer than all before; true if it is. Of steps
    /// that come to the same the one from the nearer node counts, or from that with the lesser number.
    fn offer(&self, ways: &mut Ways, from: u32, distance: f64, step: Step) -> bool {
        let (place, there) = (self.place(step.to), distance + step.length);
        let known = ways.distances[place];
        if there < known {
            (ways.distances[place], ways.last[place]) = (there, step.piece);
            return true;
        }
        if there == known && distance < there && step.to != ways.start {
            let before = self.other_end(ways.last[place], step.to);
            if (distance, from) < (self.distance(ways, before), before) {
                ways.last[place] = step.piece;
            }
        }
        false
    }

    /// Follows the only way to each node of a tree; false, with some ways, if there is a cycle.
    fn only_ways(&self, ways: &mut Ways) -> bool {
        let mut open = vec![(ways.start, NONE)];
        while let Some((node, by)) = open.pop() {
            let distance = ways.distances[self.place(node)];
            for Step { piece, to, length } in self.steps_from(node).filter(|s| s.piece != by) {
                let place = self.place(to);
                if ways.distances[place] < f64::INFINITY {
                    return false;
                }
                (ways.distances[place], ways.last[place]) = (distance + length, piece);
                open.push((to, piece));
            }
        }
        true
    }

    /// How far a node is by these ways.
    pub fn distance(&self, ways: &Ways, node: u32) -> f64 {
        ways.distances[self.place(node)]
    }

    /// Of some nodes of a component the one that is farthest by these ways; of equal ones the first.
    pub fn farthest(&self, nodes: &[u32], ways: &Ways) -> (u32, f64) {
        let mut best = (nodes[0], 0.0);
        for &node in nodes {
            let distance = self.distance(ways, node);
            if distance > best.1 {
                best = (node, distance);
            }
        }
        best
    }

    /// The pieces on the way back from a node to where the ways start, each with the end nearer to the
    /// start.
    pub fn back(&self, ways: &Ways, from: u32) -> Vec<(u32, u32)> {
        let mut back = Vec::new();
        let mut node = from;
        while node != ways.start {
            let piece = ways.last[self.place(node)];
            node = self.other_end(piece, node);
            back.push((piece, node));
        }
        back
    }

    /// The way from the start of these ways to a node.
    pub fn way(&self, ways: &Ways, to: u32) -> Way {
        let back = self.back(ways, to).into_iter().rev();
        let pieces = back.map(|(piece, from)| (piece, self.starts_at(piece, from))).collect();
        Way { pieces, value: self.distance(ways, to), is_best: self.is_whole }
    }

    /// A way as a line that goes on nowhere. Pieces of one path make one curve.
    pub fn line(&self, way: &Way) -> Centerline {
        let mut curves = Vec::new();
        let mut pieces =
            way.pieces.iter().map(|&(k, forwards)| (self.pieces[k as usize], forwards));
        let mut next = pieces.next();
        while let Some((piece, forwards)) = next {
            let [mut low, mut high] = piece.span;
            next = pieces.next();
            while let Some((more, same)) = next
                && (more.path, same) == (piece.path, forwards)
                && more.span[usize::from(!forwards)] == [low, high][usize::from(forwards)]
            {
                (low, high) = (low.min(more.span[0]), high.max(more.span[1]));
                next = pieces.next();
            }
            let curve = self.axis.curve(&self.axis.paths().at(piece.path)).piece(low, high);
            curves.push(if forwards { curve } else { curve.reversed() });
        }
        let is_end = |piece: Option<&(u32, bool)>, first: bool| {
            piece.is_some_and(|&(k, forwards)| {
                let Piece { from, to, .. } = self.pieces[k as usize];
                self.incidence.of(if forwards == first { from } else { to }).len() == 1
            })
        };
        let is_free = [is_end(way.pieces.first(), true), is_end(way.pieces.last(), false)];
        Centerline { curves, extensions: [None; 2], is_best: way.is_best, is_free }
    }
}

/// The paths that are left of an axis, but for components of which no more is left than a length that is tiny,
/// a single point mostly; and all paths of these.
pub(super) fn parts(pruned: &MedialAxis, axis: &MedialAxis, tiny: f64) -> [Vec<u32>; 2] {
    let n = pruned.keypoints().len();
    let mut sets = DisjointSets::new(n);
    for [from, to] in pruned.paths().all_ends() {
        sets.join(from, to);
    }
    let mut lengths = vec![0.0; n];
    for [from, to] in pruned.paths().all_ends() {
        let chord = (pruned.disk(from).0 - pruned.disk(to).0).norm();
        lengths[sets.first(from) as usize] += if from == to { f64::INFINITY } else { chord };
    }
    let is_long: Vec<bool> =
        (0..n as u32).map(|k| lengths[sets.first(k) as usize] > tiny).collect();
    let left = (0..).zip(pruned.paths().all_ends());
    let left =
        left.filter(|(_, [from, _])| is_long[*from as usize]).map(|(path, _)| path).collect();
    let points = (0..).zip(&is_long).filter(|(_, is_long)| !**is_long).map(|(k, _)| k);
    [left, paths_around(points, pruned, axis)]
}

/// All paths of an axis in the components of some keypoints of what is left of it.
fn paths_around(
    keypoints: impl Iterator<Item = u32>,
    pruned: &MedialAxis,
    axis: &MedialAxis,
) -> Vec<u32> {
    let mut keypoints = keypoints.peekable();
    if keypoints.peek().is_none() {
        return Vec::new();
    }
    let mut path_of = vec![NONE; axis.sites().len()];
    for (number, path) in (0..).zip(axis.paths()) {
        path_of[path.left as usize] = number;
        path_of[path.right as usize] = number;
    }
    // Sites that are left are in the same order.
    let mut all = (0_u32..).zip(axis.sites().in_order());
    let same = |site| all.find(|(_, other)| *other == site).map(|(number, _)| number);
    let numbers: Vec<Option<u32>> = pruned.sites().in_order().map(same).collect();
    let sites = keypoints.map(|keypoint| pruned.governors(keypoint)[0]);
    let paths = sites.filter_map(|site| numbers[site as usize].map(|k| path_of[k as usize]));
    let starts = paths.filter(|&path| path != NONE).map(|path| axis.paths().at(path).from);
    let incidence = Groups::paths_at_keypoints(axis);
    let mut is_met = vec![false; axis.paths().len()];
    let mut left: Vec<u32> = starts.collect();
    while let Some(keypoint) = left.pop() {
        for &number in incidence.of(keypoint) {
            if !std::mem::replace(&mut is_met[number as usize], true) {
                let path = axis.paths().at(number);
                left.extend([path.from, path.to]);
            }
        }
    }
    (0..).zip(is_met).filter(|(_, is_met)| *is_met).map(|(path, _)| path).collect()
}
