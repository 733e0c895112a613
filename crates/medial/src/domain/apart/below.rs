//! What lies right below the rings of a feature.

use std::cmp::Ordering;

use super::Below;
use super::tree::{FAN, Tree};
use crate::geom::{Point, orient2d};

/// Nodes looked at for each ring, and to begin with, until it is too much.
const WORK: u64 = 64;
const FIRST_WORK: u64 = 4096;

/// Bound on the rounding of the ordinate of an edge at an abscissa, as a share of its ends'.
const SLACK: f64 = 8.0 * f64::EPSILON;

/// What lies right below each ring, which are apart; `None` if that takes too long.
pub(super) fn all(tree: &Tree) -> Option<Vec<Below>> {
    let rings = tree.rings;
    let mut work = 0;
    let mut allowed = FIRST_WORK;
    (0..rings.rings.len() as u32)
        .map(|ring| {
            allowed += WORK;
            let points = rings.ring_points(ring).iter().copied();
            let lowest = points.reduce(|a, b| if b.lexicographic(a).is_lt() { b } else { a })?;
            let mut search = Search { tree, from: lowest, best: None, work };
            search.run();
            work = search.work;
            (work <= allowed).then(|| search.found())
        })
        .collect()
}

/// An edge below the point: its left and right end, and a bound on how low it is there.
#[derive(Clone, Copy)]
struct Ground {
    left: Point,
    right: Point,
    floor: f64,
    ring: u32,
    forward: bool,
}

struct Search<'a> {
    tree: &'a Tree<'a>,
    from: Point,
    best: Option<Ground>,
    work: u64,
}

impl Search<'_> {
    /// Depth first, the highest nodes first.
    fn run(&mut self) {
        let mut stack = Vec::with_capacity(8 * FAN);
        stack.push((f64::INFINITY, self.tree.height() - 1, 0));
        while let Some((top, level, node)) = stack.pop() {
            if self.best.is_some_and(|b| top < b.floor) {
                continue;
            }
            self.work += 1;
            if level == 0 {
                self.leaf(node);
                continue;
            }
            let waiting = stack.len();
            for child in self.tree.children(level, node) {
                let bounds = self.tree.bounds(level - 1, child);
                let covers = bounds.min.x <= self.from.x && self.from.x <= bounds.max.x;
                if covers && bounds.min.y <= self.from.y {
                    stack.push((bounds.max.y.min(self.from.y), level - 1, child));
                }
            }
            stack[waiting..].sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        }
    }

    fn leaf(&mut self, leaf: usize) {
        let chain = self.tree.chain(leaf);
        for k in 0..chain.len {
            let (start, end) = chain.edge(k);
            let forward = start.x < end.x;
            let (left, right) = if forward { (start, end) } else { (end, start) };
            // An edge counts at its left end, but not at its right one: there it is over. Upright
            // ones never count.
            let covers = left.x <= self.from.x && self.from.x < right.x;
            if !covers || orient2d(left, right, self.from) <= 0.0 {
                continue;
            }
            let share = (self.from.x - left.x) / (right.x - left.x);
            let height = left.y + (right.y - left.y) * share;
            let floor = height - SLACK * (left.y.abs() + right.y.abs());
            let found = Ground { left, right, floor, ring: chain.ring, forward };
            if self.best.is_none_or(|best| lies_above(&found, &best)) {
                self.best = Some(found);
            }
        }
    }

    fn found(&self) -> Below {
        let Some(Ground { ring, forward, .. }) = self.best else { return Below::Nothing };
        // Above an edge that runs to the right lies what is left of its ring.
        if forward == self.tree.rings.rings[ring as usize].hole {
            Below::Outside(ring)
        } else {
            Below::Inside(ring)
        }
    }
}

/// Of two edges that at most start at one point, and end right of where the other one starts.
fn lies_above(a: &Ground, b: &Ground) -> bool {
    match a.left.lexicographic(b.left) {
        Ordering::Equal => orient2d(a.left, b.right, a.right) > 0.0,
        Ordering::Less => orient2d(a.left, a.right, b.left) < 0.0,
        Ordering::Greater => orient2d(b.left, b.right, a.left) > 0.0,
    }
}
