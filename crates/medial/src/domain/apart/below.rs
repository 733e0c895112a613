//! What lies right below the rings of a feature.

use std::cmp::Ordering;

use super::Below;
use super::join::bits;
use super::tree::{Bounds, FAN, Tree};
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
            let [x, y] = [tree.map.x(lowest.x), tree.map.y(lowest.y)];
            let ray = Bounds { min: [x, f32::NEG_INFINITY], max: [x, y] };
            let mut search = Search { tree, from: lowest, ray, best: None, work };
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
    /// In the coordinates of the tree's map.
    floor: f32,
    ring: u32,
    forward: bool,
}

struct Search<'a> {
    tree: &'a Tree<'a>,
    from: Point,
    /// All that is below the point.
    ray: Bounds,
    best: Option<Ground>,
    work: u64,
}

impl Search<'_> {
    /// Depth first, the highest nodes first.
    fn run(&mut self) {
        // At most seven nodes wait on each of eleven levels.
        let mut stack = [(f32::INFINITY, 0_u8, 0_u32); 96];
        stack[0].1 = self.tree.height() as u8 - 1;
        let mut len = 1;
        while len > 0 {
            len -= 1;
            let (top, level, place) = stack[len];
            if self.best.is_some_and(|b| top < b.floor) {
                continue;
            }
            self.work += 1;
            let node = self.tree.node(usize::from(level), place as usize);
            let reached = node.meets(&self.ray, &self.tree.powers);
            if level == 0 {
                for k in bits(reached) {
                    self.edge(place as usize, k);
                }
                continue;
            }
            let waiting = len;
            for k in bits(reached) {
                let top = node.child(k).max[1].min(self.ray.max[1]);
                // Insertion sort, the highest last.
                let mut at = len;
                while at > waiting && stack[at - 1].0 > top {
                    stack[at] = stack[at - 1];
                    at -= 1;
                }
                stack[at] = (top, level - 1, place * FAN as u32 + k as u32);
                len += 1;
            }
        }
    }

    fn edge(&mut self, leaf: usize, k: usize) {
        let located = self.tree.locate(leaf, k);
        let (start, end) = self.tree.ends(located);
        let forward = start.x < end.x;
        let (left, right) = if forward { (start, end) } else { (end, start) };
        // An edge counts at its left end, but not at its right one: there it is over. Upright ones
        // never count.
        let covers = left.x <= self.from.x && self.from.x < right.x;
        if !covers || orient2d(left, right, self.from) <= 0.0 {
            return;
        }
        let share = (self.from.x - left.x) / (right.x - left.x);
        let height = left.y + (right.y - left.y) * share;
        let floor = self.tree.map.y(height - SLACK * (left.y.abs() + right.y.abs()));
        let found = Ground { left, right, floor, ring: located.ring, forward };
        if self.best.is_none_or(|best| lies_above(&found, &best)) {
            self.best = Some(found);
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
