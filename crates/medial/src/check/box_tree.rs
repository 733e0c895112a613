use std::ops::ControlFlow;

use crate::domain::Domain;
use crate::geom::Point;

/// Children of a node.
const WIDTH: usize = 8;

/// Boxes around the edges of a domain, packed along a Hilbert curve into a tree.
///
/// Finds the edges near a point in logarithmic time where boxes follow the boundary well.
pub(super) struct BoxTree {
    /// Edge numbers in the order of the leaves.
    edges: Vec<u32>,
    /// Boxes level by level, the leaves first; node k covers nodes 8k to 8k + 7 one level down.
    levels: Vec<Vec<Bounds>>,
}

#[derive(Clone, Copy)]
struct Bounds {
    low: Point,
    high: Point,
}

impl BoxTree {
    pub(super) fn new(domain: &Domain) -> Self {
        let n = domain.edges().len() as u32;
        let boxes: Vec<Bounds> =
            (0..n).map(|e| Bounds::around(domain.edge(e).start, domain.end(e))).collect();
        let Some(all) = boxes.iter().copied().reduce(Bounds::join) else {
            return Self { edges: Vec::new(), levels: Vec::new() };
        };
        let mut keyed: Vec<(u64, u32)> =
            (0..n).map(|e| (all.hilbert(boxes[e as usize].middle()), e)).collect();
        keyed.sort_unstable();
        let edges: Vec<u32> = keyed.into_iter().map(|(_, e)| e).collect();
        let mut levels = vec![edges.iter().map(|&e| boxes[e as usize]).collect::<Vec<_>>()];
        while let Some(last) = levels.last().filter(|level| level.len() > 1) {
            let next =
                last.chunks(WIDTH).filter_map(|c| c.iter().copied().reduce(Bounds::join)).collect();
            levels.push(next);
        }
        Self { edges, levels }
    }

    /// Calls `visit` with each edge whose box is no farther from `point` than `reach()` says at
    /// that moment, the nearer boxes of a node first, until it breaks.
    pub(super) fn near<S, B>(
        &self,
        point: Point,
        state: &mut S,
        reach: impl Fn(&S) -> f64,
        mut visit: impl FnMut(&mut S, u32) -> ControlFlow<B>,
    ) -> Option<B> {
        let top = self.levels.len().checked_sub(1)?;
        let mut stack = vec![(top, 0usize, 0.0f64)];
        while let Some((level, node, distance2)) = stack.pop() {
            let reach2 = reach(state).powi(2);
            if distance2 > reach2 {
                continue;
            }
            if level == 0 {
                if let ControlFlow::Break(found) = visit(state, self.edges[node]) {
                    return Some(found);
                }
                continue;
            }
            let below = &self.levels[level - 1];
            let first = node * WIDTH;
            let last = (first + WIDTH).min(below.len());
            let start = stack.len();
            for (child, inside) in below[first..last].iter().enumerate() {
                let distance2 = inside.distance2(point);
                if distance2 <= reach2 {
                    stack.push((level - 1, first + child, distance2));
                }
            }
            // The last one pushed is looked at first.
            stack[start..].sort_by(|a, b| b.2.total_cmp(&a.2));
        }
        None
    }
}

impl Bounds {
    fn around(a: Point, b: Point) -> Self {
        Self {
            low: Point::new(a.x.min(b.x), a.y.min(b.y)),
            high: Point::new(a.x.max(b.x), a.y.max(b.y)),
        }
    }

    fn join(self, other: Self) -> Self {
        Self {
            low: Point::new(self.low.x.min(other.low.x), self.low.y.min(other.low.y)),
            high: Point::new(self.high.x.max(other.high.x), self.high.y.max(other.high.y)),
        }
    }

    fn middle(self) -> Point {
        (self.low + self.high) * 0.5
    }

    /// Squared distance of the point from the box, rounded by less than one part in 2^49.
    fn distance2(&self, point: Point) -> f64 {
        let x = (self.low.x - point.x).max(point.x - self.high.x).max(0.0);
        let y = (self.low.y - point.y).max(point.y - self.high.y).max(0.0);
        x * x + y * y
    }

    /// Position of a point of this box along a Hilbert curve of 2^32 cells.
    fn hilbert(self, point: Point) -> u64 {
        const SIDE: u64 = 1 << 16;
        let size = self.high - self.low;
        let cell = |offset: f64, size: f64| {
            // The cast saturates, so an empty or infinite size does no harm.
            ((offset / size * SIDE as f64) as u64).min(SIDE - 1)
        };
        let mut x = cell(point.x - self.low.x, size.x);
        let mut y = cell(point.y - self.low.y, size.y);
        let mut key = 0;
        let mut half = SIDE / 2;
        while half > 0 {
            let (right, upper) = (u64::from(x & half > 0), u64::from(y & half > 0));
            key += half * half * ((3 * right) ^ upper);
            if upper == 0 {
                if right == 1 {
                    x = (SIDE - 1) - x;
                    y = (SIDE - 1) - y;
                }
                std::mem::swap(&mut x, &mut y);
            }
            half /= 2;
        }
        key
    }
}
