use std::ops::ControlFlow;

use super::{Domain, Walk};
use crate::geom::{Point, Rect, hilbert};

/// Children of a node, and edges of a leaf.
const WIDTH: usize = 8;

/// Boxes around runs of the boundary, to find the edges near a point.
///
/// Along a walk each node covers a run of consecutive edges by a box in the run's own direction, so
/// that slivers and smooth curves are followed closely. Above the walks the nodes are packed along
/// a Hilbert curve, so that the order of the holes does not matter.
#[derive(Clone, Debug)]
pub(crate) struct EdgeTree {
    nodes: Vec<Node>,
    root: Option<u32>,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Oriented,
    /// First edge of a leaf, first child otherwise; they are consecutive.
    first: u32,
    count: u32,
    leaf: bool,
}

/// A box along a direction.
#[derive(Clone, Copy, Debug)]
struct Oriented {
    base: Point,
    /// Unit vector.
    along: Point,
    /// Range along the direction and, to its left, across it, from the base.
    min: Point,
    max: Point,
}

impl EdgeTree {
    /// A tree over the edges of some walks of a domain.
    pub(crate) fn new(domain: &Domain, walks: &[Walk]) -> Self {
        let mut tree = Self { nodes: Vec::new(), root: None };
        let mut tops: Vec<(Rect, Node)> = Vec::with_capacity(walks.len());
        for walk in walks {
            tops.push(tree.add_walk(domain, walk.first, walk.len));
        }
        tree.root = tree.add_tops(tops);
        tree
    }

    /// Adds the nodes of a walk but the topmost, which is given back with an upright box.
    fn add_walk(&mut self, domain: &Domain, first: u32, len: u32) -> (Rect, Node) {
        let point = |k: u32| domain.edge(first + k % len).start;
        let upright = (0..len).fold(Rect::EMPTY, |all, k| all.with(point(k)));
        // Edges from place k on; each level covers eight times as many.
        let mut span = WIDTH as u32;
        let mut level: Vec<Node> = (0..len)
            .step_by(WIDTH)
            .map(|k| {
                let count = span.min(len - k);
                let longest = (k..k + count)
                    .max_by(|&a, &b| {
                        domain.edge(first + a).length.total_cmp(&domain.edge(first + b).length)
                    })
                    .unwrap_or(k);
                let hint = domain.edge(first + longest).direction;
                let bounds = Oriented::around(point, k, count, hint);
                Node { bounds, first: first + k, count, leaf: true }
            })
            .collect();
        while level.len() > 1 {
            let below = self.nodes.len() as u32;
            self.nodes.extend_from_slice(&level);
            span = span.saturating_mul(WIDTH as u32);
            level = level
                .chunks(WIDTH)
                .enumerate()
                .map(|(k, children)| {
                    let from = k as u32 * span;
                    let hint = children[children.len() / 2].bounds.along;
                    Node {
                        bounds: Oriented::around(point, from, span.min(len - from), hint),
                        first: below + (k * WIDTH) as u32,
                        count: children.len() as u32,
                        leaf: false,
                    }
                })
                .collect();
        }
        (upright, level[0])
    }

    /// Packs the topmost nodes of the walks.
    fn add_tops(&mut self, mut tops: Vec<(Rect, Node)>) -> Option<u32> {
        let all = tops.iter().fold(Rect::EMPTY, |all, (rect, _)| all.union(*rect));
        tops.sort_by_cached_key(|(rect, _)| hilbert(&all, (rect.min + rect.max) * 0.5));
        while tops.len() > 1 {
            let below = self.nodes.len() as u32;
            self.nodes.extend(tops.iter().map(|(_, node)| *node));
            tops = tops
                .chunks(WIDTH)
                .enumerate()
                .map(|(k, children)| {
                    let rect = children.iter().fold(Rect::EMPTY, |all, (rect, _)| all.union(*rect));
                    let node = Node {
                        bounds: Oriented::upright(&rect),
                        first: below + (k * WIDTH) as u32,
                        count: children.len() as u32,
                        leaf: false,
                    };
                    (rect, node)
                })
                .collect();
        }
        let (_, root) = tops.first()?;
        self.nodes.push(*root);
        Some(self.nodes.len() as u32 - 1)
    }

    /// Calls `visit` with each edge that may be nearer to `point` than `reach`, until it breaks.
    ///
    /// An edge at that distance is visited if `reach` allows for rounding.
    pub(crate) fn near<B>(
        &self,
        point: Point,
        reach: f64,
        mut visit: impl FnMut(u32) -> ControlFlow<B>,
    ) -> Option<B> {
        if reach.is_nan() || reach < 0.0 {
            return None;
        }
        let reach2 = reach * reach;
        let mut stack = [0u32; 256];
        *stack.first_mut()? = self.root?;
        let mut depth = 1;
        while depth > 0 {
            depth -= 1;
            let node = &self.nodes[stack[depth] as usize];
            for child in node.first..node.first + node.count {
                if node.leaf {
                    if let ControlFlow::Break(found) = visit(child) {
                        return Some(found);
                    }
                } else if self.nodes[child as usize].bounds.distance2(point) <= reach2 {
                    // At most seven siblings wait on each of some twenty levels.
                    stack[depth] = child;
                    depth += 1;
                }
            }
        }
        None
    }

    /// Calls `visit` with edges, about in the order of their distance from `point`: every edge that
    /// may be as near as the distance `visit` gave last; until it breaks.
    pub(crate) fn nearest_first(
        &self,
        point: Point,
        mut visit: impl FnMut(u32) -> ControlFlow<(), f64>,
    ) -> ControlFlow<()> {
        let mut reach = f64::INFINITY;
        let mut stack: Vec<(f64, u32)> = self.root.iter().map(|&root| (0.0, root)).collect();
        while let Some((bound, node)) = stack.pop() {
            if bound > reach {
                continue;
            }
            let node = &self.nodes[node as usize];
            let children = node.first..node.first + node.count;
            if node.leaf {
                for edge in children {
                    reach = visit(edge)?;
                }
                continue;
            }
            let waiting = stack.len();
            let bound = |child: u32| self.nodes[child as usize].bounds.surely_beyond(point);
            stack.extend(children.map(|child| (bound(child), child)));
            // The nearest box is looked at first.
            stack[waiting..].sort_by(|a, b| b.0.total_cmp(&a.0));
        }
        ControlFlow::Continue(())
    }
}

impl Oriented {
    fn upright(rect: &Rect) -> Self {
        let along = Point::new(1.0, 0.0);
        Self { base: rect.min, along, min: Point::default(), max: rect.max - rect.min }
    }

    /// The least box around `count` edges from place `from` on: upright, along the chord, or along
    /// the hint.
    fn around(point: impl Fn(u32) -> Point, from: u32, count: u32, hint: Point) -> Self {
        let base = point(from);
        let chord = point(from + count) - base;
        let length = chord.norm();
        let chord = if length > 0.0 { chord * (1.0 / length) } else { hint };
        let fit = |along: Point| {
            let (mut min, mut max) = (Point::default(), Point::default());
            for k in from..=from + count {
                let q = point(k) - base;
                let (a, b) = (along.dot(q), along.cross(q));
                min = Point::new(min.x.min(a), min.y.min(b));
                max = Point::new(max.x.max(a), max.y.max(b));
            }
            Self { base, along, min, max }
        };
        let size = |fit: &Self| (fit.max.x - fit.min.x) + (fit.max.y - fit.min.y);
        [chord, hint].into_iter().map(fit).fold(fit(Point::new(1.0, 0.0)), |best, next| {
            if size(&next) < size(&best) { next } else { best }
        })
    }

    /// Squared distance from the point, rounded.
    #[inline]
    fn distance2(&self, point: Point) -> f64 {
        let q = point - self.base;
        let (a, b) = (self.along.dot(q), self.along.cross(q));
        let x = (self.min.x - a).max(a - self.max.x).max(0.0);
        let y = (self.min.y - b).max(b - self.max.y).max(0.0);
        x * x + y * y
    }

    /// A distance from the point within which certainly nothing of the box lies.
    ///
    /// Coordinates relative to the base are differences, products and sums, each within a few units
    /// in the last place of their sizes, and those of the direction are as well.
    fn surely_beyond(&self, point: Point) -> f64 {
        const ROUNDING: f64 = 16.0 * f64::EPSILON;
        let q = point - self.base;
        let size = q.x.abs() + q.y.abs() + self.min.x.abs() + self.max.x + self.min.y.abs();
        self.distance2(point).sqrt() - ROUNDING * (size + self.max.y)
    }
}
