//! How an axis burns away from its leaves, all at one speed [LCLJ11].
//!
//! # Method
//! 1. Each leaf is lit when a fire that starts at its own boundary would get there: at its radius. A
//!    keypoint burns when all of its paths but one have burnt up to it, and lights the last one.
//! 2. Where two fires meet, on a path or in a keypoint, is the root of a tree: the point that burns last.
//! 3. Cycles never burn, nor what joins them; outside, nor what joins paths to infinity.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use super::groups::Groups;
use crate::axis::{KeypointKind, MedialAxis};

/// Which way the fire runs through a path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Way {
    /// From its start to its end, or the other way.
    Forwards,
    Backwards,
    /// From both ends: they meet so far from the start.
    Both(f64),
    /// It does not.
    Never,
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
    /// Paths in the order in which they are lit.
    pub order: Vec<u32>,
    /// Keypoints that burn last in their tree.
    pub roots: Vec<u32>,
}

/// A fire that arrives at a keypoint by a path.
#[derive(PartialEq)]
struct Arrival {
    time: f64,
    path: u32,
    keypoint: u32,
}

impl Eq for Arrival {}

impl Ord for Arrival {
    fn cmp(&self, other: &Self) -> Ordering {
        let key = |a: &Self| (a.path, a.keypoint);
        self.time.total_cmp(&other.time).then_with(|| key(self).cmp(&key(other)))
    }
}

impl PartialOrd for Arrival {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Fire {
    pub fn new(axis: &MedialAxis) -> Self {
        let n = axis.keypoints().len();
        let lengths: Vec<f64> =
            axis.paths().iter().map(|path| axis.curve(&path).length()).collect();
        let incidence = Groups::paths_at_keypoints(axis);
        let mut fire = Self {
            times: vec![f64::INFINITY; n],
            ways: vec![Way::Never; lengths.len()],
            lengths,
            order: Vec::new(),
            roots: Vec::new(),
        };
        let mut left: Vec<u32> = (0..n as u32).map(|k| incidence.of(k).len() as u32).collect();
        // What has burnt up to a keypoint already.
        let mut burnt = vec![false; fire.ways.len()];
        let mut heap = BinaryHeap::new();
        for (k, keypoint) in (0..).zip(axis.keypoints().iter()) {
            match left[k as usize] {
                0 => {
                    fire.times[k as usize] = keypoint.radius;
                    fire.roots.push(k);
                }
                1 if keypoint.kind != KeypointKind::Clipped => {
                    let path = incidence.of(k)[0];
                    fire.light(axis, path, k, keypoint.radius, &mut heap);
                }
                _ => {}
            }
        }
        while let Some(Reverse(Arrival { time, path, keypoint })) = heap.pop() {
            if matches!(fire.ways[path as usize], Way::Both(_)) {
                continue;
            }
            burnt[path as usize] = true;
            let left = &mut left[keypoint as usize];
            *left -= 1;
            match *left {
                0 => {
                    fire.times[keypoint as usize] = time;
                    fire.roots.push(keypoint);
                }
                1 => {
                    let mut paths = incidence.of(keypoint).iter();
                    if let Some(&last) = paths.find(|&&path| !burnt[path as usize]) {
                        fire.light(axis, last, keypoint, time, &mut heap);
                    }
                }
                _ => {}
            }
        }
        fire
    }

    /// Lights a path at one end.
    fn light(
        &mut self,
        axis: &MedialAxis,
        path: u32,
        keypoint: u32,
        time: f64,
        heap: &mut BinaryHeap<Reverse<Arrival>>,
    ) {
        self.times[keypoint as usize] = time;
        let ends = axis.paths().at(path);
        let is_start = ends.from == keypoint;
        let other = if is_start { ends.to } else { ends.from };
        let (way, length) = (&mut self.ways[path as usize], self.lengths[path as usize]);
        if *way != Way::Never {
            // From the other end it is alight already; unless that fire is here, they meet on the way.
            let lead = time - self.times[other as usize];
            let gone = (length + lead) * 0.5;
            if gone < length {
                *way = Way::Both(if is_start { length - gone } else { gone });
            }
            return;
        }
        *way = if is_start { Way::Forwards } else { Way::Backwards };
        self.order.push(path);
        heap.push(Reverse(Arrival { time: time + length, path, keypoint: other }));
    }
}
