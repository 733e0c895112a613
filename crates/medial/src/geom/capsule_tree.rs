//! A packed tree over the edges of boundary walks, with bounds that follow the boundary.
//!
//! # Contract
//! A visit shows every edge that may lie within a disk and beyond a half-plane's border: a superset,
//! since all bounds are rounded outwards; what an edge really is to the disk the visitor decides.
//!
//! # Method
//! 1. Eight edges to a leaf and eight nodes to a node, in boundary order, so nothing is sorted; where
//!    that serves badly, in the order of a space-filling curve.
//! 2. A run of edges is bounded by a capsule: all points within a distance of a segment. It is thin
//!    where the boundary is smooth or straight, whatever its direction; for one edge it is the edge.
//! 3. The eight children of a node are kept side by side as numbers of 32 bits relative to the node's
//!    own origin, and are tested together.
//! 4. A visit takes the children near what the visitor names first, then those at both ends, then by
//!    halves: so a visitor that looks for less the more it has met soon does, whichever way the boundary
//!    leads.
//! 5. Where that leaves too much, runs are measured by circles near them as well ([`super::rims`]).
//!
//! # Departures
//! None.

use std::sync::OnceLock;

use super::lanes::{FAN, Lanes, Node, Query, SIZE, VANISHING, Wide};
use super::rims::{Hoop, Pinned, Rim, SOME, circle};
use super::{Point, Rect, hilbert};

/// Edges of a leaf, at most.
pub const LEAF: usize = FAN;

/// Edges that share a circle; a multiple of those of a leaf.
const RUN: u32 = 64;

/// Children of a node that are entered without another look at them.
const PAIR: u32 = 2;

/// Levels of nodes in a tree over 2^32 edges, at most, rounded up to a power of two.
const MOST_LEVELS: usize = 16;

/// The order in which children are visited, as far as the visitor has no wish.
const ORDER: [u8; FAN] = [7, 0, 4, 2, 6, 1, 5, 3];

/// The first of some children, given as bits, in that order; eight if there is none.
const NEXT: [u8; 1 << FAN] = {
    let mut next = [FAN as u8; 1 << FAN];
    let mut mask = 1;
    while mask < next.len() {
        let mut k = 0;
        while mask >> ORDER[k] & 1 == 0 {
            k += 1;
        }
        next[mask] = ORDER[k];
        mask += 1;
    }
    next
};

/// The disk and the half-plane of a visit.
#[derive(Clone, Copy, Debug)]
pub struct Scope {
    /// Centre of the disk.
    pub centre: Point,
    /// Its radius, with all margins.
    pub reach: f64,
    /// Unit normal of the half-plane, pointing to where things may lie; zero for no half-plane.
    pub normal: Point,
    /// A point on its border.
    pub border: Point,
}

/// Runs of edges that a visit leaves out, as half-open ranges of edge numbers.
#[derive(Clone, Copy, Debug, Default)]
pub struct Hidden(pub [(u32, u32); 2]);

impl Hidden {
    /// Whether an edge is left out.
    #[inline]
    #[must_use]
    pub fn holds(&self, edge: u32) -> bool {
        self.0.iter().any(|&(first, end)| first <= edge && edge < end)
    }
}

/// What a visit through a [`CapsuleTree`] does with the edges it meets.
pub trait Look {
    /// What is looked for now; it may shrink during a visit.
    fn scope(&self) -> &Scope;
    /// An edge near which to look first; any will do, only the time it takes depends on it.
    fn near(&self) -> u32;
    /// Takes one edge that may lie within.
    fn edge(&mut self, edge: u32);
    /// The disk outside which edges of a leaf need not be shown, as precisely as the tree can give it;
    /// asked only where several edges of a leaf may lie within.
    #[inline]
    fn pinned(&mut self) -> Option<&Pinned> {
        None
    }
    /// Is told when all edges of a leaf are taken.
    #[inline]
    fn leaf(&mut self) {}
}

/// The tree; see the module.
#[derive(Clone, Debug)]
pub struct CapsuleTree {
    /// The edges in the order of the leaves, if that is not the order of the boundary.
    order: Option<Vec<u32>>,
    /// First edge.
    base: u32,
    n_edges: u32,
    /// Power of two that brings lengths to about [`super::lanes::SIZE`].
    scale: f64,
    /// Rounding of the coordinates themselves, in those lengths.
    slack: f32,
    bounds: Rect,
    leaves: Vec<Lanes>,
    /// Nodes above the leaves, level by level.
    nodes: Vec<Node>,
    /// Where each level of `nodes` starts.
    levels: Vec<u32>,
    wide: Option<Wide>,
    /// The edges of each leaf relative to a circle, once somebody asks for that.
    rims: OnceLock<Vec<Rim>>,
    /// The runs below each level relative to circles, from then on.
    hoops: OnceLock<Vec<Vec<Hoop>>>,
}

impl CapsuleTree {
    /// Builds the tree over the edges `base` to `base + n_edges - 1`, each given by its two ends. They
    /// are closed walks: each end is the start of another edge.
    #[must_use]
    pub fn new(base: u32, n_edges: u32, ends: impl Fn(u32) -> (Point, Point)) -> Self {
        Self::over(base, n_edges, None, ends)
    }

    /// The same with edges sorted along a space-filling curve by their middles, for boundaries that
    /// wind so much that runs of them are bounded by nothing smaller than all.
    #[must_use]
    pub fn along_a_curve(base: u32, n_edges: u32, ends: impl Fn(u32) -> (Point, Point)) -> Self {
        let middle = |k: u32| {
            let (a, b) = ends(k);
            a + (b - a) * 0.5
        };
        let bounds = (base..base + n_edges).fold(Rect::EMPTY, |all, k| all.with(middle(k)));
        // Position along the curve, then number: 32 bits each.
        let mut order: Vec<u64> = (base..base + n_edges)
            .map(|k| hilbert(&bounds, middle(k)) << 32 | u64::from(k))
            .collect();
        order.sort_unstable();
        let order = order.into_iter().map(|key| key as u32).collect();
        Self::over(base, n_edges, Some(order), ends)
    }

    fn over(
        base: u32,
        n_edges: u32,
        order: Option<Vec<u32>>,
        ends: impl Fn(u32) -> (Point, Point),
    ) -> Self {
        let bounds = box_of((base..base + n_edges).map(|k| ends(k).0));
        let ends = |k: u32| ends(order.as_ref().map_or(base + k, |order| order[k as usize]));
        let size = (bounds.max.x - bounds.min.x).max(bounds.max.y - bounds.min.y);
        let scale = inverse_power_of_two(size) * SIZE;
        let largest = [bounds.min.x, bounds.min.y, bounds.max.x, bounds.max.y];
        let largest = largest.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let slack = (64.0 * f64::EPSILON * largest * scale) as f32 + VANISHING;
        let n_leaves = (n_edges as usize).div_ceil(FAN);
        let mut leaves = Vec::with_capacity(n_leaves);
        let mut runs = Vec::with_capacity(n_leaves);
        for first in (0..n_edges).step_by(FAN) {
            let last = (n_edges - first).min(FAN as u32) - 1;
            let origin = ends(first + last / 2).1;
            let relative = |end: Point| (end - origin) * scale;
            let group = std::array::from_fn(|k| {
                // Lanes to spare repeat the last one.
                let (a, b) = ends(first + last.min(k as u32));
                (relative(a), relative(b))
            });
            let leaf = Lanes::between(origin * scale, &group);
            runs.push(leaf.capsule(&[0.0; FAN]));
            leaves.push(leaf);
        }
        let mut nodes = Vec::with_capacity(n_leaves.div_ceil(FAN - 1) + 4);
        let mut levels = Vec::new();
        while runs.len() > 1 {
            levels.push(nodes.len() as u32);
            let mut above = Vec::with_capacity(runs.len().div_ceil(FAN));
            for group in runs.chunks(FAN) {
                let node = Node::new(group);
                above.push(node.capsule());
                nodes.push(node);
            }
            runs = above;
        }
        let wide = Wide::detect();
        let (rims, hoops) = (OnceLock::new(), OnceLock::new());
        Self {
            order,
            base,
            n_edges,
            scale,
            slack,
            bounds,
            leaves,
            nodes,
            levels,
            wide,
            rims,
            hoops,
        }
    }

    /// Measures runs by circles as well, for boundaries that follow the rims of the disks looked into;
    /// `ends` gives the two ends of an edge.
    pub fn follow_rims(&self, ends: impl Fn(u32) -> (Point, Point)) {
        if self.order.is_some() {
            return;
        }
        let rims = self.rims.get_or_init(|| {
            let mut rims = Vec::with_capacity(self.leaves.len());
            let at = |k: u32| ends(self.base + k);
            for run in (0..self.n_edges).step_by(RUN as usize) {
                let last = (run + RUN).min(self.n_edges) - 1;
                let middle = at(run + (last - run).div_ceil(2));
                let circle = circle(at(run).0, middle, at(last).1);
                for first in (run..=last).step_by(FAN) {
                    // Lanes to spare repeat the last one.
                    let edges = std::array::from_fn(|k| at((first + k as u32).min(last)));
                    rims.push(Rim::new(circle, &edges));
                }
            }
            rims
        });
        self.hoops.get_or_init(|| {
            let mut levels: Vec<Vec<Hoop>> = Vec::with_capacity(self.levels.len());
            for _ in &self.levels {
                levels.push(match levels.last() {
                    None => rims.chunks(FAN).map(Hoop::over_rims).collect(),
                    Some(below) => below.chunks(FAN).map(Hoop::over_hoops).collect(),
                });
            }
            levels
        });
    }

    /// An edge relative to the circle of its leaf, and its place there, if there are such circles.
    #[inline]
    #[must_use]
    pub fn rim(&self, edge: u32) -> Option<(&Rim, usize)> {
        let place = edge.wrapping_sub(self.base) as usize;
        Some((self.rims.get()?.get(place / FAN)?, place % FAN))
    }

    /// The numbers of the edges.
    #[must_use]
    pub fn items(&self) -> std::ops::Range<u32> {
        self.base..self.base + self.n_edges
    }

    /// The box of all edges.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        self.bounds
    }

    /// Shows every edge that may be within the scope of `look` and is not hidden, in a fixed order;
    /// gives the number of nodes it went through.
    #[inline]
    pub fn visit(&self, hidden: Hidden, look: &mut impl Look) -> u64 {
        if self.n_edges == 0 {
            return 0;
        }
        // In another order nothing is known of whole runs.
        let runs = if self.order.is_some() { Hidden::default() } else { hidden };
        let runs = Shown::new(runs, self.base, self.n_edges);
        // A level is that of the children: that of a leaf is zero.
        let mut level = self.levels.len() as u32;
        let mut number = 0_u32;
        match runs.count {
            0 => return 0,
            1 => {
                // The lowest node that holds all that is shown.
                let (low, high) = runs.runs[0];
                let differ = u32::BITS - ((low ^ high) >> 3).leading_zeros();
                level = level.min(differ.div_ceil(3));
                number = low >> (3 * level) >> 3;
            }
            _ => {}
        }
        let mut aim = Aim::new(self, look.scope());
        let near = look.near().wrapping_sub(self.base);
        // Waiting children of a node: number of the first, a bit for each, and their level.
        let mut waiting = [(0_u32, 0_u8, 0_u8); MOST_LEVELS];
        let mut depth = 0_usize;
        let mut entered = 0_u64;
        loop {
            entered += 1;
            // Enter node `number` of `level`.
            let first = number * FAN as u32;
            let mut mask = runs.among(level, first);
            if level == 0 {
                let leaf = &self.leaves[number as usize];
                mask &= leaf.within(&aim.query, &[0.0; FAN], self.wide) & 0xff;
                if mask.count_ones() > SOME
                    && let Some(rims) = self.rims.get()
                    && let Some(disk) = look.pinned()
                {
                    mask = rims[number as usize].sift(disk, mask, self.wide);
                }
                if mask != 0 {
                    self.show(first, mask, &hidden, look);
                    look.leaf();
                    aim.follow(self, look.scope());
                }
            } else {
                let node = &self.nodes[(self.levels[level as usize - 1] + number) as usize];
                mask &= node.lanes.within(&aim.query, &node.width, self.wide);
                mask &= 0xff;
                if mask.count_ones() > PAIR
                    && let Some(hoops) = self.hoops.get()
                    && let Some(disk) = look.pinned()
                {
                    let hoop = &hoops[level as usize - 1][number as usize];
                    mask = hoop.sift(disk, mask, self.wide);
                }
                if mask != 0 {
                    let mut child = (near >> (3 * level)).wrapping_sub(first);
                    if child >= FAN as u32 || mask >> child & 1 == 0 {
                        child = NEXT[mask as usize & 0xff].into();
                    }
                    mask &= !(1 << child);
                    if mask != 0 {
                        waiting[depth % MOST_LEVELS] = (first, mask as u8, level as u8);
                        depth += 1;
                    }
                    number = first + child;
                    level -= 1;
                    continue;
                }
            }
            // Go on with the next waiting child.
            if depth == 0 {
                return entered;
            }
            let (first, mask, above) = &mut waiting[(depth - 1) % MOST_LEVELS];
            let child = NEXT[usize::from(*mask)];
            number = *first + u32::from(child);
            level = u32::from(*above) - 1;
            *mask &= !(1 << child);
            if *mask == 0 {
                depth -= 1;
            }
        }
    }

    /// Shows some edges of a leaf.
    #[inline]
    fn show(&self, first: u32, mask: u32, hidden: &Hidden, look: &mut impl Look) {
        let mut mask = mask & 0xff;
        let mut next = || {
            let child = NEXT[mask as usize];
            mask &= !(1 << child);
            (child < FAN as u8).then(|| first + u32::from(child))
        };
        if let Some(order) = &self.order {
            while let Some(place) = next() {
                let edge = order[place as usize];
                if !hidden.holds(edge) {
                    look.edge(edge);
                }
            }
        } else {
            while let Some(place) = next() {
                look.edge(self.base + place);
            }
        }
    }
}

/// What is looked for now.
struct Aim {
    query: Query,
    centre: Point,
    reach: f64,
}

impl Aim {
    #[inline]
    fn new(tree: &CapsuleTree, scope: &Scope) -> Self {
        let query = Query::new(scope, tree.scale, tree.slack);
        Self { query, centre: scope.centre, reach: scope.reach }
    }

    /// Looks for what is looked for after edges were shown.
    #[inline]
    fn follow(&mut self, tree: &CapsuleTree, scope: &Scope) {
        if scope.reach != self.reach || scope.centre != self.centre {
            *self = Self::new(tree, scope);
        }
    }
}

/// The runs of edges that a visit shows, each by its first and its last edge, relative to the tree.
struct Shown {
    runs: [(u32, u32); 3],
    count: usize,
}

impl Shown {
    /// What is not hidden of some edges.
    #[inline]
    fn new(hidden: Hidden, base: u32, n_edges: u32) -> Self {
        let [a, b] = hidden.0.map(|(first, end)| {
            let relative = |edge: u32| edge.saturating_sub(base).min(n_edges);
            (relative(first), relative(end))
        });
        if a.0 == 0 && a.1 < b.0 && b.1 == n_edges {
            return Self { runs: [(a.1, b.0 - 1), (0, 0), (0, 0)], count: 1 };
        }
        let (a, b) = if a.0 <= b.0 { (a, b) } else { (b, a) };
        let mut shown = Self { runs: [(0, 0); 3], count: 0 };
        let mut from = 0;
        for (first, end) in [a, b, (n_edges, n_edges)] {
            if from < first {
                shown.runs[shown.count] = (from, first - 1);
                shown.count += 1;
            }
            from = from.max(end);
        }
        shown
    }

    /// A bit for each of eight nodes, from `first`, of a level below which anything is shown; below all
    /// eight together there is something.
    #[inline]
    fn among(&self, level: u32, first: u32) -> u32 {
        let part = |low: u32, high: u32| (0xff << low) & (0xff >> (7 - high.min(7)));
        let [(low, high), ..] = self.runs;
        let shift = 3 * level;
        if self.count == 1 {
            if low >> shift <= first && first + FAN as u32 <= high >> shift {
                return 0xff;
            }
            return part((low >> shift).saturating_sub(first), (high >> shift) - first);
        }
        let mut mask = 0;
        for &(low, high) in &self.runs[..self.count] {
            let (low, high) = ((low >> shift).saturating_sub(first), high >> shift);
            if low < FAN as u32 && high >= first {
                mask |= part(low, high - first);
            }
        }
        mask
    }
}

/// The box of some points.
fn box_of(points: impl Iterator<Item = Point>) -> Rect {
    let Rect { mut min, mut max } = Rect::EMPTY;
    for p in points {
        // Not `f64::min`, which spends three instructions on numbers that are none.
        min.x = if p.x < min.x { p.x } else { min.x };
        min.y = if p.y < min.y { p.y } else { min.y };
        max.x = if p.x > max.x { p.x } else { max.x };
        max.y = if p.y > max.y { p.y } else { max.y };
    }
    Rect { min, max }
}

/// A power of two whose product with `size` is about one.
fn inverse_power_of_two(size: f64) -> f64 {
    let exponent = (size.to_bits() >> 52) & 0x7ff;
    // The largest size is below 2^202, the least above 2^-254.
    f64::from_bits((2046_u64.saturating_sub(exponent)).clamp(1, 2046) << 52)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Notes what it is shown.
    struct Seen {
        scope: Scope,
        edges: Vec<u32>,
    }

    impl Look for Seen {
        fn scope(&self) -> &Scope {
            &self.scope
        }

        fn near(&self) -> u32 {
            6
        }

        fn edge(&mut self, edge: u32) {
            self.edges.push(edge);
        }
    }

    /// Numbers from zero to one, always the same.
    fn numbers() -> impl FnMut() -> f64 {
        let mut state = 88_172_645_463_325_252_u64;
        move || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 11) as f64 / (1_u64 << 53) as f64
        }
    }

    /// A closed walk with runs that are straight, smooth, and neither.
    fn walk(n: usize, origin: Point, size: f64) -> Vec<Point> {
        let mut number = numbers();
        let point = |k: usize| {
            let t = k as f64 / n as f64;
            let (sin, cos) = (t * std::f64::consts::TAU).sin_cos();
            let rough = if t < 0.3 { 0.2 * number() } else { 0.0 };
            let x = if t < 0.7 { cos } else { 3.0 * t - 3.0 };
            origin + Point::new(x + rough, sin + rough) * size
        };
        (0..n).map(point).collect()
    }

    fn distance(p: Point, a: Point, b: Point) -> f64 {
        let (way, along) = (p - a, b - a);
        let t = (way.dot(along) / along.norm2()).clamp(0.0, 1.0);
        (way - along * t).norm()
    }

    /// Scopes about a walk: of all sizes, half of them with a half-plane.
    fn scopes(origin: Point, size: f64) -> Vec<Scope> {
        let mut number = numbers();
        let mut scopes = Vec::new();
        for k in 0..600 {
            let from = Point::new(4.0 * number() - 2.0, 4.0 * number() - 2.0);
            let reach = 0.5_f64.powi(k % 20) * 2.0;
            // Every third is far out, and as large as it must be to come near.
            let away = if k % 3 == 0 { 10_f64.powi(k % 9) } else { 0.0 };
            let direction = Point::new(0.6, if k % 2 == 0 { 0.8 } else { -0.8 });
            let normal = if k % 4 < 2 { direction } else { Point::default() };
            scopes.push(Scope {
                centre: origin + (from + direction * away) * size,
                reach: (reach + away) * size,
                normal,
                border: origin + from * (0.5 * size),
            });
        }
        scopes
    }

    fn shows_what_is_within(origin: Point, size: f64) {
        for n in [3, 7, 8, 9, 64, 65, 700] {
            let points = walk(n, origin, size);
            let ends = |k: u32| (points[k as usize - 5], points[(k as usize - 4) % n]);
            let trees = [
                CapsuleTree::new(5, n as u32, ends),
                CapsuleTree::along_a_curve(5, n as u32, ends),
            ];
            let plain = trees.clone().map(|tree| CapsuleTree { wide: None, ..tree });
            for scope in scopes(origin, size) {
                let hidden =
                    Hidden([(5, 5 + n as u32 / 8), (5 + n as u32 / 2, 5 + n as u32 / 4 * 3)]);
                for (tree, plain_tree) in trees.iter().zip(&plain) {
                    let mut seen = Seen { scope, edges: Vec::new() };
                    tree.visit(hidden, &mut seen);
                    seen.edges.sort_unstable();
                    assert!(seen.edges.windows(2).all(|w| w[0] < w[1]));
                    for k in 5..5 + n as u32 {
                        let (a, b) = ends(k);
                        let high = |p| scope.normal.dot(p - scope.border);
                        let within = distance(scope.centre, a, b) <= scope.reach
                            && high(a).max(high(b)) >= 0.0;
                        let shown = seen.edges.binary_search(&k).is_ok();
                        assert!(!shown || !hidden.holds(k));
                        assert!(shown || hidden.holds(k) || !within, "{n} edges, {k}: {scope:?}");
                    }
                    let mut plain = Seen { scope, edges: Vec::new() };
                    plain_tree.visit(hidden, &mut plain);
                    plain.edges.sort_unstable();
                    assert_eq!(plain.edges, seen.edges);
                }
            }
        }
    }

    #[test]
    fn a_visit_shows_all_that_is_within_and_not_hidden() {
        shows_what_is_within(Point::new(0.0, 0.0), 1.0);
    }

    #[test]
    fn a_visit_shows_all_that_is_within_far_from_the_origin_at_any_scale() {
        shows_what_is_within(Point::new(1e9, -3e9), 1e3);
        shows_what_is_within(Point::new(-7.0, 5.0), 1e-6);
        shows_what_is_within(Point::new(1e30, 0.0), 1e30);
        shows_what_is_within(Point::new(0.0, 0.0), 1e-30);
    }

    #[test]
    fn a_small_disk_is_shown_little_of_a_long_walk() {
        let points = walk(4096, Point::new(0.0, 0.0), 1.0);
        let ends = |k: u32| (points[k as usize], points[(k as usize + 1) % 4096]);
        let tree = CapsuleTree::new(0, 4096, ends);
        // On the smooth part, where edges are about 1/650 long.
        let scope = Scope {
            centre: points[2048],
            reach: 1e-4,
            normal: Point::default(),
            border: Point::default(),
        };
        let mut seen = Seen { scope, edges: Vec::new() };
        let entered = tree.visit(Hidden::default(), &mut seen);
        seen.edges.sort_unstable();
        assert_eq!(seen.edges, [2047, 2048]);
        assert!(entered <= 9, "{entered} nodes");
    }

    #[test]
    fn a_small_disk_is_shown_little_of_a_walk_over_thirty_decades() {
        // A wedge towards the origin, with sixteen corners while the distance from it halves.
        let n = 3200_u32;
        let away = |step: u32| (f64::from(step) / -16.0).exp2();
        let corner = |k: u32| {
            let (step, y) = if k < n / 2 { (k, 1.0) } else { (n - 1 - k, -1.0) };
            Point::new(2.0, y) * away(step)
        };
        let tree = CapsuleTree::new(0, n, |k| (corner(k), corner((k + 1) % n)));
        for step in [16, 500, 1000, 1500] {
            let scope = Scope {
                centre: corner(step),
                reach: 0.01 * away(step),
                normal: Point::default(),
                border: Point::default(),
            };
            let mut seen = Seen { scope, edges: Vec::new() };
            let entered = tree.visit(Hidden::default(), &mut seen);
            seen.edges.sort_unstable();
            assert_eq!(seen.edges, [step - 1, step]);
            assert!(entered <= 40, "{entered} nodes at corner {step}");
        }
    }

    #[test]
    fn a_flat_disk_enters_few_nodes_of_equal_steps() {
        // Steps down to the right, whose inner corners are 2k for the whole numbers k.
        let corner = |k: u32| Point::new(f64::from(k.div_ceil(2)), -f64::from(k / 2));
        let tree = CapsuleTree::new(0, 4096, |k| (corner(k), corner(k + 1)));
        let touched = corner(2048);
        let radius = 1e5;
        let inwards = Point::new(-0.5_f64.sqrt(), -0.5_f64.sqrt());
        let scope = Scope {
            centre: touched + inwards * radius,
            reach: radius + 1e-6,
            normal: Point::default(),
            border: Point::default(),
        };
        let mut seen = Seen { scope, edges: Vec::new() };
        let entered = tree.visit(Hidden::default(), &mut seen);
        assert!(seen.edges.contains(&2047) && seen.edges.contains(&2048));
        // Two of each of the three levels above the leaves, or three, and the leaves beside the corner.
        assert!(entered <= 12, "{entered} nodes");
    }
}
