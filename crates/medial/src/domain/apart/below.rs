//! What lies right below the rings of a feature.

use std::cmp::Ordering;

use super::Around;
use super::join::bits;
use super::node::{Bounds, FAN};
use super::tree::Tree;
use crate::geom::{Point, orient2d};

/// Nodes looked at for each ring, and to begin with, until it is too much.
const WORK: u64 = 64;
const FIRST_WORK: u64 = 4096;

/// Bound on the rounding of the ordinate of an edge at an abscissa, as a share of its ends'.
const SLACK: f64 = 8.0 * f64::EPSILON;

/// What lies around each ring, which are apart; `None` if that takes too long. Rings joined by links
/// that are not broken have the same around them, which is what lies right below the lowest of
/// their leftmost vertices.
pub(super) fn all(tree: &Tree, broken: &[bool]) -> Option<Vec<Around>> {
    let rings = tree.rings;
    let mut search = Search::new(tree);
    let mut allowed = FIRST_WORK;
    let mut around = vec![Around::Nothing; rings.rings.len()];
    let joined = |rank: usize| tree.links[rank][0] != tree.links[rank][1] && !broken[rank];
    let mut rank = 0;
    while rank < tree.order.len() {
        let mut end = rank + 1;
        while end < tree.order.len() && joined(end) {
            end += 1;
        }
        let run = &tree.order[rank..end];
        let points = run.iter().flat_map(|&ring| rings.ring_points(ring)).copied();
        let left = |a: Point, b: Point| a.x < b.x || a.x == b.x && a.y < b.y;
        let found = search.below(points.reduce(|a, b| if left(b, a) { b } else { a })?);
        run.iter().for_each(|&ring| around[ring as usize] = found);
        rank = end;
        allowed += WORK;
        if search.work > allowed {
            return None;
        }
    }
    Some(around)
}

/// An edge below the point: its left and right end.
#[derive(Clone, Copy)]
struct Ground {
    left: Point,
    right: Point,
    ring: u32,
    forward: bool,
}

struct Search<'a> {
    tree: &'a Tree<'a>,
    from: Point,
    /// What lies below the point, as far as is looked at.
    ray: Bounds,
    best: Option<Ground>,
    work: u64,
    /// Nodes to look at: their upper end, level and number. At most seven wait on each of eleven
    /// levels.
    stack: [(f32, u32, u32); 96],
}

impl<'a> Search<'a> {
    fn new(tree: &'a Tree<'a>) -> Self {
        let ray = Bounds { min: [f32::MIN; 2], max: [f32::MIN; 2] };
        let (from, stack) = (Point::default(), [(0.0, 0, 0); 96]);
        Self { tree, from, ray, best: None, work: 0, stack }
    }

    /// What lies right below the leftmost vertex of a ring.
    fn below(&mut self, from: Point) -> Around {
        let (x, y) = (self.tree.map.x(from.x), self.tree.map.y(from.y));
        self.ray = Bounds { min: [x, f32::MIN], max: [x, y] };
        (self.from, self.best) = (from, None);
        self.search();
        let Some(Ground { ring, forward, .. }) = self.best else { return Around::Nothing };
        // Above an edge that runs to the right lies what is left of its ring.
        if forward == self.tree.rings.rings[ring as usize].hole {
            Around::Outside(ring)
        } else {
            Around::Inside(ring)
        }
    }

    /// Looks at all edges along the ray, which ends at the best one, the highest nodes first.
    fn search(&mut self) {
        self.stack[0] = (f32::MAX, self.tree.height() as u32 - 1, 0);
        let mut len = 1;
        while len > 0 {
            len -= 1;
            let (top, level, place) = self.stack[len];
            if top < self.ray.min[1] {
                continue;
            }
            self.work += 1;
            let node = self.tree.node(level as usize, place as usize);
            let waiting = len;
            for k in bits(node.meets(&self.ray, &self.tree.powers)) {
                let top = node.child(k).max[1];
                if level == 0 {
                    // The ray may be shorter by now.
                    if top >= self.ray.min[1] {
                        self.edge(place as usize, k);
                    }
                    continue;
                }
                let mut at = len;
                while at > waiting && self.stack[at - 1].0 > top {
                    self.stack[at] = self.stack[at - 1];
                    at -= 1;
                }
                self.stack[at] = (top, level - 1, place * FAN as u32 + k as u32);
                len += 1;
            }
        }
    }

    fn edge(&mut self, leaf: usize, k: usize) {
        let item = self.tree.item(leaf, k);
        if item.is_link {
            return;
        }
        let (start, end) = self.tree.ends(item);
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
        let found = Ground { left, right, ring: self.tree.order[item.rank as usize], forward };
        if self.best.is_none_or(|best| lies_above(&found, &best)) {
            self.best = Some(found);
            self.ray.min[1] = floor;
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
