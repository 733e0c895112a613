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
//!
//! # Departures
//! None.

use super::{Point, Rect, hilbert};

/// Children of a node, and edges of a leaf.
const FAN: usize = 8;

/// Levels of a tree over 2^32 edges, at most.
const MOST_LEVELS: usize = 12;

/// Share of the lengths involved by which a test in 32 bits may be wrong, with room to spare.
const ROUNDING: f32 = 1.0 / (1 << 19) as f32;

/// The same, of the distance of a disk that is far larger than what it is tested against.
const FAR_ROUNDING: f64 = 1.0 / (1_u64 << 44) as f64;

/// Radius of a disk, in sizes of what it is tested against, from which numbers of 32 bits are too
/// coarse for coordinates relative to its centre.
const FAR_OUT: f64 = 256.0;

/// Length, of a tree of size one, below which squares in 32 bits vanish.
const VANISHING: f32 = 1e-18;

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
    /// Takes one edge that may lie within.
    fn edge(&mut self, edge: u32);
}

/// All points within `width` of the segment from `centre - half` to `centre + half`.
#[derive(Clone, Copy, Debug)]
struct Capsule {
    centre: Point,
    half: Point,
    width: f64,
}

/// Segments, one to a lane, relative to an origin.
#[derive(Clone, Debug)]
struct Lanes {
    origin: Point,
    /// No lane reaches farther from the origin than this.
    extent: f32,
    x: [f32; FAN],
    y: [f32; FAN],
    half_x: [f32; FAN],
    half_y: [f32; FAN],
}

#[derive(Clone, Debug)]
struct Node {
    lanes: Lanes,
    width: [f32; FAN],
}

/// The tree; see the module.
#[derive(Clone, Debug)]
pub struct CapsuleTree {
    /// The edges in the order of the leaves, if that is not the order of the boundary.
    order: Option<Vec<u32>>,
    /// First edge.
    base: u32,
    n_edges: u32,
    /// Power of two that brings lengths to about one.
    scale: f64,
    /// Rounding of the coordinates themselves, in those lengths.
    slack: f32,
    bounds: Rect,
    leaves: Vec<Lanes>,
    /// Nodes above the leaves, level by level.
    nodes: Vec<Node>,
    /// Where each level of `nodes` starts, and how many nodes the level below has.
    levels: Vec<(u32, u32)>,
}

impl CapsuleTree {
    /// Builds the tree over the edges `base` to `base + n_edges - 1`, each given by its two ends.
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
        let ends = |k: u32| ends(order.as_ref().map_or(base + k, |order| order[k as usize]));
        let mut bounds = Rect::EMPTY;
        for k in 0..n_edges {
            let (a, b) = ends(k);
            bounds = bounds.with(a).with(b);
        }
        let size = (bounds.max.x - bounds.min.x).max(bounds.max.y - bounds.min.y);
        let scale = power_of_two_near(size);
        let largest = [bounds.min.x, bounds.min.y, bounds.max.x, bounds.max.y];
        let largest = largest.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
        let slack = (64.0 * f64::EPSILON * largest * scale) as f32 + VANISHING;
        let n_leaves = (n_edges as usize).div_ceil(FAN);
        let mut leaves = Vec::with_capacity(n_leaves);
        let mut runs: Vec<Capsule> = Vec::with_capacity(n_leaves);
        for first in (0..n_edges).step_by(FAN) {
            let mut group = [Capsule::POINT; FAN];
            let count = (n_edges - first).min(FAN as u32) as usize;
            for (slot, k) in group[..count].iter_mut().zip(first..) {
                let (a, b) = ends(k);
                let half = (b - a) * 0.5;
                *slot = Capsule { centre: a + half, half, width: 0.0 };
            }
            let group = &group[..count];
            leaves.push(Lanes::new(group, scale));
            runs.push(Capsule::around(group));
        }
        let mut nodes = Vec::with_capacity(n_leaves.div_ceil(FAN - 1) + 4);
        let mut levels = Vec::new();
        while runs.len() > 1 {
            levels.push((nodes.len() as u32, runs.len() as u32));
            let mut above = Vec::with_capacity(runs.len().div_ceil(FAN));
            for group in runs.chunks(FAN) {
                nodes.push(Node::new(group, scale));
                above.push(Capsule::around(group));
            }
            runs = above;
        }
        Self { order, base, n_edges, scale, slack, bounds, leaves, nodes, levels }
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

    #[inline]
    fn query<'s>(&self, scope: &'s Scope) -> Query<'s> {
        Query {
            scope,
            scale: self.scale,
            reach: scope.reach * self.scale,
            slack: self.slack,
            halved: scope.normal.x != 0.0 || scope.normal.y != 0.0,
        }
    }

    /// The first and the last edge shown, relative to the tree, if they are one run.
    fn only(&self, &[(a, b), (c, d)]: &[(u64, u64); 2]) -> Option<(u64, u64)> {
        (a == 0 && d >= u64::from(self.n_edges) && b < c).then(|| (b, c - 1))
    }

    /// Shows every edge that may be within the scope of `look` and is not hidden, in a fixed order;
    /// gives the number of nodes it went through.
    #[inline]
    pub fn visit(&self, hidden: Hidden, look: &mut impl Look) -> u64 {
        if self.n_edges == 0 {
            return 0;
        }
        let all_hidden = hidden;
        // In another order nothing is known of whole runs.
        let hidden = if self.order.is_some() { Hidden::default() } else { hidden };
        let hidden = hidden.0.map(|(first, end)| {
            (u64::from(first.max(self.base) - self.base), u64::from(end.max(self.base) - self.base))
        });
        // Waiting children of a level: number of the parent, and a bit for each child.
        let mut waiting = [(0_u32, 0_u32); MOST_LEVELS];
        let mut top = self.levels.len();
        let mut number = 0_u32;
        if let Some((low, high)) = self.only(&hidden) {
            // The lowest node that holds all that is shown.
            let differ = 64 - ((low ^ high) >> 3).leading_zeros();
            top = top.min(differ.div_ceil(3) as usize);
            number = (low >> (3 * (top as u32 + 1))) as u32;
        }
        // A level is that of the children: `top` for the node where the visit begins.
        let mut level = top;
        let mut entered = 0_u64;
        loop {
            entered += 1;
            // Enter node `number` of `level`.
            if level == 0 {
                let leaf = &self.leaves[number as usize];
                let first = number * FAN as u32;
                let mut mask = leaf.within(&self.query(look.scope()), &[0.0; FAN])
                    & shown(&hidden, 0, first, self.n_edges);
                while mask != 0 {
                    let k = mask.trailing_zeros();
                    mask &= mask - 1;
                    match &self.order {
                        None => look.edge(self.base + first + k),
                        Some(order) => {
                            let edge = order[(first + k) as usize];
                            if !all_hidden.holds(edge) {
                                look.edge(edge);
                            }
                        }
                    }
                }
            } else {
                let (start, count) = self.levels[level - 1];
                let node = &self.nodes[(start + number) as usize];
                let first = number * FAN as u32;
                let mask = shown(&hidden, level as u32, first, count);
                let mask = mask & node.lanes.within(&self.query(look.scope()), &node.width);
                waiting[level] = (first, mask);
            }
            if level == 0 {
                level = 1;
            }
            // Go on with the next waiting child.
            loop {
                if level > top {
                    return entered;
                }
                let (first, mask) = waiting[level];
                if mask != 0 {
                    waiting[level].1 = mask & (mask - 1);
                    number = first + mask.trailing_zeros();
                    level -= 1;
                    break;
                }
                level += 1;
            }
        }
    }
}

/// A bit for each of eight children that exists and is not wholly hidden.
#[inline]
fn shown(hidden: &[(u64, u64); 2], level: u32, first: u32, count: u32) -> u32 {
    let left = count - first;
    let mut mask = if left >= FAN as u32 { 0xff } else { (1 << left) - 1 };
    let shift = 3 * level;
    let first = u64::from(first);
    for &(from, end) in hidden {
        let low = ((from + (1 << shift) - 1) >> shift).saturating_sub(first).min(8);
        let high = (end >> shift).saturating_sub(first).min(8);
        if low < high {
            mask &= !((1_u32 << high) - (1_u32 << low));
        }
    }
    mask
}

/// A power of two whose product with `size` is about one.
fn power_of_two_near(size: f64) -> f64 {
    let exponent = (size.to_bits() >> 52) & 0x7ff;
    // The largest size is below 2^202, the least above 2^-254.
    f64::from_bits((2046_u64.saturating_sub(exponent)).clamp(1, 2046) << 52)
}

impl Capsule {
    const POINT: Self =
        Self { centre: Point::new(0.0, 0.0), half: Point::new(0.0, 0.0), width: 0.0 };

    fn ends(&self) -> [Point; 2] {
        [self.centre - self.half, self.centre + self.half]
    }

    /// A capsule around a run of others, along its chord or the longer side of its box.
    fn around(run: &[Self]) -> Self {
        let first = run[0].ends()[0];
        let last = run[run.len() - 1].ends()[1];
        let chord = last - first;
        let length = chord.norm();
        let upright = Frame::around(run, first, Point::new(1.0, 0.0));
        let mut frame = upright;
        if length > 0.0 {
            let along = Frame::around(run, first, chord * (1.0 / length));
            if along.half.x + along.half.y < upright.half.x + upright.half.y {
                frame = along;
            }
        }
        let (axis, long, wide) = if frame.half.x >= frame.half.y {
            (frame.axis, frame.half.x, frame.half.y)
        } else {
            (frame.axis.perp(), frame.half.y, frame.half.x)
        };
        let half = axis * (long - wide);
        let centre = frame.centre;
        let reach = long - wide;
        let mut width: f64 = 0.0;
        for capsule in run {
            for end in capsule.ends() {
                let way = end - centre;
                let along = axis.dot(way).clamp(-reach, reach);
                width = width.max((way - axis * along).norm() + capsule.width);
            }
        }
        // What rounding of coordinates adds is in the slack of the tree.
        Self { centre, half, width: width * (1.0 + 1e-12) }
    }
}

/// A box along an axis.
#[derive(Clone, Copy)]
struct Frame {
    axis: Point,
    centre: Point,
    half: Point,
}

impl Frame {
    fn around(run: &[Capsule], from: Point, axis: Point) -> Self {
        let (mut min, mut max) = (Rect::EMPTY.min, Rect::EMPTY.max);
        for capsule in run {
            for end in capsule.ends() {
                let way = end - from;
                let (x, y) = (axis.dot(way), axis.cross(way));
                min = Point::new(min.x.min(x - capsule.width), min.y.min(y - capsule.width));
                max = Point::new(max.x.max(x + capsule.width), max.y.max(y + capsule.width));
            }
        }
        let middle = (min + max) * 0.5;
        let centre = from + axis * middle.x + axis.perp() * middle.y;
        Self { axis, centre, half: (max - min) * 0.5 }
    }
}

impl Lanes {
    fn new(group: &[Capsule], scale: f64) -> Self {
        let bounds = group
            .iter()
            .fold(Rect::EMPTY, |all, c| c.ends().into_iter().fold(all, |all, end| all.with(end)));
        let origin = (bounds.min + bounds.max) * 0.5;
        let mut lanes = Self {
            origin,
            extent: 0.0,
            x: [0.0; FAN],
            y: [0.0; FAN],
            half_x: [0.0; FAN],
            half_y: [0.0; FAN],
        };
        for (k, capsule) in group.iter().enumerate() {
            let at = (capsule.centre - origin) * scale;
            let half = capsule.half * scale;
            lanes.x[k] = at.x as f32;
            lanes.y[k] = at.y as f32;
            lanes.half_x[k] = half.x as f32;
            lanes.half_y[k] = half.y as f32;
            let reach = at.x.abs() + at.y.abs() + half.x.abs() + half.y.abs();
            let reach = reach + scale * capsule.width;
            lanes.extent = lanes.extent.max(reach as f32 * (1.0 + ROUNDING));
        }
        lanes
    }

    /// A bit for each lane that may be within the scope.
    #[inline]
    fn within(&self, query: &Query, width: &[f32; FAN]) -> u32 {
        let scope = query.scope;
        let p = (scope.centre - self.origin) * query.scale;
        let extent = self.extent;
        let mut far = [false; FAN];
        let distance = if query.reach > FAR_OUT * f64::from(extent) { p.norm() } else { 0.0 };
        if distance > 4.0 * f64::from(extent) {
            // Seen from the node the disk is nearly a half-plane: a point q of it is within the
            // disk if n·q - q·q/2d is at least (d² - r²)/2d, for the distance d and the direction
            // n of the centre. All of this is as small as the node.
            let inverse = 1.0 / distance;
            let (nx, ny) = ((p.x * inverse) as f32, (p.y * inverse) as f32);
            let reach = query.reach;
            let level = (distance - reach) * (distance + reach) * (0.5 * inverse);
            let margin =
                f64::from(ROUNDING * extent + query.slack) + FAR_ROUNDING * (distance + reach);
            let level = (level - margin) as f32;
            let (d, bend) = (distance as f32, (0.5 * inverse) as f32);
            let widen = (reach * inverse) as f32 * (1.0 + ROUNDING);
            for k in 0..FAN {
                let (cx, cy) = (self.x[k], self.y[k]);
                let (hx, hy) = (self.half_x[k], self.half_y[k]);
                let square = (hx * hx + hy * hy).max(f32::MIN_POSITIVE);
                let t = (d * (nx * hx + ny * hy) - (cx * hx + cy * hy)) / square;
                let t = t.clamp(-1.0, 1.0);
                let (qx, qy) = (cx + t * hx, cy + t * hy);
                let w = width[k];
                let value = nx * qx + ny * qy - bend * (qx * qx + qy * qy) + w * (widen + bend * w);
                far[k] = value < level;
            }
        } else {
            let (px, py) = (p.x as f32, p.y as f32);
            let reach = query.reach as f32;
            let limit = reach + ROUNDING * (extent + reach) + query.slack;
            for k in 0..FAN {
                let (dx, dy) = (px - self.x[k], py - self.y[k]);
                let (hx, hy) = (self.half_x[k], self.half_y[k]);
                let square = (hx * hx + hy * hy).max(f32::MIN_POSITIVE);
                let t = ((dx * hx + dy * hy) / square).clamp(-1.0, 1.0);
                let (ex, ey) = (dx - t * hx, dy - t * hy);
                let limit = limit + width[k];
                far[k] = ex * ex + ey * ey > limit * limit;
            }
        }
        let mut mask = !bits(&far);
        if mask & 0xff != 0 && query.halved {
            let (nx, ny) = (scope.normal.x as f32, scope.normal.y as f32);
            let from = (scope.border - self.origin) * query.scale;
            let level = scope.normal.dot(from);
            let rounding = 8.0 * f64::EPSILON * (from.x.abs() + from.y.abs());
            let least = (level - rounding) as f32;
            let least = least - ROUNDING * (least.abs() + extent) - query.slack;
            for k in 0..FAN {
                let at = nx * self.x[k] + ny * self.y[k];
                let half = (nx * self.half_x[k] + ny * self.half_y[k]).abs();
                far[k] = at + half + width[k] * (1.0 + ROUNDING) < least;
            }
            mask &= !bits(&far);
        }
        mask
    }
}

/// A scope in the lengths of the tree.
struct Query<'s> {
    scope: &'s Scope,
    scale: f64,
    reach: f64,
    slack: f32,
    halved: bool,
}

#[inline]
fn bits(lanes: &[bool; FAN]) -> u32 {
    let mut mask = 0;
    for (k, &lane) in lanes.iter().enumerate() {
        mask |= u32::from(lane) << k;
    }
    mask
}

impl Node {
    fn new(group: &[Capsule], scale: f64) -> Self {
        let mut width = [0.0; FAN];
        for (slot, capsule) in width.iter_mut().zip(group) {
            *slot = (capsule.width * scale) as f32 * (1.0 + ROUNDING);
        }
        Self { lanes: Lanes::new(group, scale), width }
    }
}
