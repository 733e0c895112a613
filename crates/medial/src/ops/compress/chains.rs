//! The chains of an axis: its paths between keypoints of degree other than two, in a depth-first order.

use super::super::groups::Groups;
use crate::axis::{MedialAxis, Path};

/// What is met next on the way through all of an axis.
pub(super) enum Step {
    /// A keypoint that nothing leads to so far.
    Begin(u32),
    /// Paths one after another, from a keypoint that was met to one that may be new.
    Chain(Vec<Path>),
}

/// The way through an axis: every path once, every keypoint of degree other than two.
///
/// Chains to a leaf come first at each keypoint, so that the way back to it is short.
pub(super) fn layout(axis: &MedialAxis) -> Vec<Step> {
    let n = axis.keypoints().len();
    let mut way = Way {
        axis,
        degrees: axis.degrees(),
        at: Groups::paths_at_keypoints(axis),
        gone: vec![false; axis.paths().len()],
        met: vec![false; n],
        steps: Vec::new(),
    };
    // Leaves and lone points first, then what has none, then cycles without any keypoint that counts.
    let begins: [fn(u32) -> bool; 3] = [|degree| degree < 2, |degree| degree > 2, |_| true];
    for begins in begins {
        for keypoint in 0..n as u32 {
            if begins(way.degrees[keypoint as usize]) && !way.is_done(keypoint) {
                way.component(keypoint);
            }
        }
    }
    way.steps
}

struct Way<'a> {
    axis: &'a MedialAxis,
    degrees: Vec<u32>,
    at: Groups,
    /// Paths that were gone along.
    gone: Vec<bool>,
    /// Keypoints where a chain began or ended.
    met: Vec<bool>,
    steps: Vec<Step>,
}

impl Way<'_> {
    /// Whether a keypoint was met, also on the way between two others.
    fn is_done(&self, keypoint: u32) -> bool {
        let paths = self.at.of(keypoint);
        self.met[keypoint as usize] || (!paths.is_empty() && self.gone[paths[0] as usize])
    }

    fn component(&mut self, first: u32) {
        self.steps.push(Step::Begin(first));
        self.met[first as usize] = true;
        // Keypoints with the number of their paths that were looked at, once for leaves, once for all.
        let mut stack = vec![(first, 0)];
        while let Some((keypoint, looked_at)) = stack.last_mut() {
            let (keypoint, place) = (*keypoint, *looked_at);
            let paths = self.at.of(keypoint);
            if place == 2 * paths.len() {
                stack.pop();
                continue;
            }
            *looked_at += 1;
            let path = paths[place % paths.len()];
            if self.gone[path as usize] || (place < paths.len() && !self.is_leaf(keypoint, path)) {
                continue;
            }
            let chain = self.chain(keypoint, path);
            let end = chain.last().map_or(keypoint, |path| path.to);
            self.steps.push(Step::Chain(chain));
            if !std::mem::replace(&mut self.met[end as usize], true) {
                stack.push((end, 0));
            }
        }
    }

    /// A path as it leaves a keypoint.
    fn leaving(&self, keypoint: u32, path: u32) -> Path {
        let path = self.axis.paths().at(path);
        if path.from == keypoint { path } else { path.reversed() }
    }

    /// Whether a path ends at a leaf, so that its chain is short.
    fn is_leaf(&self, keypoint: u32, path: u32) -> bool {
        self.degrees[self.leaving(keypoint, path).to as usize] == 1
    }

    /// The chain that leaves a keypoint by a path.
    fn chain(&mut self, keypoint: u32, path: u32) -> Vec<Path> {
        let (mut number, mut path) = (path, self.leaving(keypoint, path));
        let mut chain = Vec::new();
        loop {
            self.gone[number as usize] = true;
            chain.push(path);
            let here = path.to;
            if self.degrees[here as usize] != 2 || self.met[here as usize] {
                return chain;
            }
            let Some(&next) = self.at.of(here).iter().find(|&&next| !self.gone[next as usize])
            else {
                return chain;
            };
            (number, path) = (next, self.leaving(here, next));
        }
    }
}
