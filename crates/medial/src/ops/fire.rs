//! How an axis burns away from its leaves, all at one speed [LCLJ11].
//!
//! # Method
//! 1. Each leaf is lit when a fire that starts at its own boundary would get there: at its radius. A
//!    keypoint burns when all of its paths but one have burnt up to it, and lights the last one.
//! 2. Leaves are peeled off one after the other, whatever the time, up to a keypoint where a tree ends. The
//!    point of the tree that burns last, its root, lies where the fires of its two longest ways meet: from
//!    that keypoint the way to it is turned round.
//! 3. Cycles never burn, nor what joins them; outside, nor what joins paths to infinity.
//!
//! All of it takes O(n).

use crate::axis::{KeypointKind, MedialAxis, Path};

/// Which way the fire runs through a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Way {
    /// From its start to its end, or the other way.
    Forwards,
    Backwards,
    /// From both ends.
    Both,
    /// It does not.
    Never,
}

/// A path that burns from one end to the other, in that direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    /// Twice the number of the path, and one more if it burns from its end.
    pub dart: u32,
    /// The keypoints where it burns first and last.
    pub from: u32,
    pub to: u32,
    /// The sites to its left and to its right.
    pub left: u32,
    pub right: u32,
    /// The place of the keypoint where it ends.
    pub next: u32,
}

/// The fire through a whole axis.
#[derive(Debug)]
pub(super) struct Fire {
    /// When each keypoint burns; never is infinite.
    pub times: Vec<f64>,
    /// One for each path.
    pub ways: Vec<Way>,
    /// The length of each path.
    pub lengths: Vec<f64>,
    /// Paths in an order in which each one comes after those that light it.
    pub order: Vec<u32>,
    /// Those that burn from one end to the other, in the same order. The keypoint where each starts has its
    /// number for a place.
    pub steps: Vec<Step>,
    /// How many keypoints have a place.
    pub n_places: usize,
    /// Paths that burn from both ends, so far from the start as they meet, and the places of their ends.
    pub both: Vec<(u32, f64, [u32; 2])>,
    /// Keypoints that burn last in their tree.
    pub roots: Vec<u32>,
}

/// What has come to a keypoint so far.
#[derive(Clone, Copy)]
struct Arrivals {
    /// How many of its paths have not burnt, and the exclusive or of their numbers: that of the last one.
    left: u32,
    numbers: u32,
    /// The path by which the last fire comes, and when; a leaf is lit by itself.
    last: f64,
    by: u32,
    /// When the fire before that comes.
    before: f64,
}

/// No path.
const NONE: u32 = u32::MAX;

impl Arrivals {
    fn add(&mut self, time: f64, path: u32) {
        if time > self.last {
            (self.before, self.last, self.by) = (self.last, time, path);
        } else {
            self.before = self.before.max(time);
        }
    }
}

impl Fire {
    pub fn new(axis: &MedialAxis) -> Self {
        let keypoints = axis.keypoints();
        let nothing = f64::NEG_INFINITY;
        let none = Arrivals { left: 0, numbers: 0, last: nothing, by: NONE, before: nothing };
        let mut arrivals = vec![none; keypoints.len()];
        let mut paths = Vec::with_capacity(axis.paths().len());
        for (number, path) in (0..).zip(axis.paths()) {
            paths.push(path);
            for end in [path.from, path.to] {
                let arrivals = &mut arrivals[end as usize];
                arrivals.left += 1;
                arrivals.numbers ^= number;
            }
        }
        let lengths = axis.lengths(&paths);
        let mut fire = Self {
            times: vec![f64::INFINITY; keypoints.len()],
            ways: vec![Way::Never; lengths.len()],
            order: Vec::with_capacity(lengths.len()),
            lengths,
            steps: Vec::new(),
            n_places: 0,
            both: Vec::new(),
            roots: Vec::new(),
        };
        let is_clipped = |k: u32| keypoints.at(k).kind == KeypointKind::Clipped;
        let leaves: Vec<u32> = (0..arrivals.len() as u32)
            .filter(|&k| arrivals[k as usize].left <= 1 && !is_clipped(k))
            .collect();
        for &leaf in &leaves {
            arrivals[leaf as usize].last = keypoints.at(leaf).radius;
        }
        let mut turned = Vec::new();
        for leaf in leaves {
            let end = fire.peel(axis, leaf, &mut arrivals);
            match end {
                Some(end) if is_clipped(end) => {
                    fire.times[end as usize] = arrivals[end as usize].last;
                    fire.roots.push(end);
                }
                Some(end) => fire.find_root(axis, end, &mut arrivals, &mut turned),
                None => {}
            }
        }
        // What was turned round comes after all that lights it.
        let mut is_turned = vec![false; if turned.is_empty() { 0 } else { fire.ways.len() }];
        turned.iter().for_each(|&path| is_turned[path as usize] = true);
        if !turned.is_empty() {
            fire.order.retain(|&path| !is_turned[path as usize]);
            fire.order.extend(turned);
        }
        fire.find_places(&paths);
        fire
    }

    /// Whether every path burns: the axis has no cycles, and none of its paths leads to infinity.
    pub fn is_all(&self) -> bool {
        self.order.len() == self.ways.len()
    }

    /// Lists the steps, and gives places to the keypoints on their ways.
    fn find_places(&mut self, paths: &[Path]) {
        let mut places = vec![NONE; self.times.len()];
        self.steps.reserve(self.order.len());
        for &number in &self.order {
            let backwards = match self.ways[number as usize] {
                Way::Forwards => false,
                Way::Backwards => true,
                Way::Both | Way::Never => continue,
            };
            let path = paths[number as usize];
            let Path { from, to, left, right } = if backwards { path.reversed() } else { path };
            places[from as usize] = self.steps.len() as u32;
            let dart = 2 * number + u32::from(backwards);
            self.steps.push(Step { dart, from, to, left, right, next: NONE });
        }
        let mut n_places = self.steps.len() as u32;
        let mut place = |keypoint: u32| {
            let place = &mut places[keypoint as usize];
            if *place == NONE {
                *place = n_places;
                n_places += 1;
            }
            *place
        };
        for step in &mut self.steps {
            step.next = place(step.to);
        }
        for (number, _, ends) in &mut self.both {
            let Path { from, to, .. } = paths[*number as usize];
            *ends = [place(from), place(to)];
        }
        self.n_places = n_places as usize;
    }

    /// Burns from a leaf as far as nothing else has to come before; gives the keypoint where a whole tree
    /// has burnt, if it has.
    fn peel(&mut self, axis: &MedialAxis, leaf: u32, arrivals: &mut [Arrivals]) -> Option<u32> {
        let mut keypoint = leaf;
        loop {
            let Arrivals { left, numbers: number, last: time, .. } = arrivals[keypoint as usize];
            match left {
                // A fire from elsewhere has ended here before, or it is all there is.
                0 => return (self.times[keypoint as usize] == f64::INFINITY).then_some(keypoint),
                1 => {}
                _ => return None,
            }
            self.times[keypoint as usize] = time;
            let [from, to] = axis.paths().ends(number);
            let forwards = from == keypoint;
            self.ways[number as usize] = if forwards { Way::Forwards } else { Way::Backwards };
            self.order.push(number);
            arrivals[keypoint as usize].left = 0;
            keypoint = if forwards { to } else { from };
            let there = &mut arrivals[keypoint as usize];
            there.left -= 1;
            there.numbers ^= number;
            there.add(time + self.lengths[number as usize], number);
        }
    }

    /// Looks for the root of a tree that has burnt up to a keypoint, and turns the way there round.
    fn find_root(
        &mut self,
        axis: &MedialAxis,
        end: u32,
        arrivals: &mut [Arrivals],
        turned: &mut Vec<u32>,
    ) {
        let mut keypoint = end;
        loop {
            let Arrivals { last, by, before, .. } = arrivals[keypoint as usize];
            self.times[keypoint as usize] = last;
            if by == NONE || last == before {
                // It burns by itself, or two fires come at once.
                self.roots.push(keypoint);
                return;
            }
            // Without the last fire it burns before, and sends one the other way.
            self.times[keypoint as usize] = before;
            let path = axis.paths().at(by);
            let length = self.lengths[by as usize];
            let child = if path.from == keypoint { path.to } else { path.from };
            let lead = before - self.times[child as usize];
            let gone = 0.5 * (length + lead);
            if gone > 0.0 {
                if gone < length {
                    let gone = if path.from == child { gone } else { length - gone };
                    self.ways[by as usize] = Way::Both;
                    self.both.push((by, gone, [NONE; 2]));
                    turned.push(by);
                } else {
                    self.times[keypoint as usize] = last;
                    self.roots.push(keypoint);
                }
                return;
            }
            self.ways[by as usize] =
                if path.from == keypoint { Way::Forwards } else { Way::Backwards };
            turned.push(by);
            arrivals[child as usize].add(before + length, by);
            keypoint = child;
        }
    }
}
