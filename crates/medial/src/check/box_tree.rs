use std::ops::ControlFlow;

use crate::domain::Domain;
use crate::geom::{Point, Rect};

/// Children of a node.
const WIDTH: usize = 8;

/// Boxes around the edges of a domain, packed along a Hilbert curve into a tree.
///
/// Finds the edges near a point in logarithmic time where boxes follow the boundary well.
pub(super) struct BoxTree {
    /// Edge numbers in the order of the leaves.
    edges: Vec<u32>,
    /// Boxes level by level, the leaves first; node k covers nodes 8k to 8k + 7 one level down.
    levels: Vec<Vec<Rect>>,
}

impl BoxTree {
    pub(super) fn new(domain: &Domain) -> Self {
        let n = domain.edges().len() as u32;
        let boxes: Vec<Rect> =
            (0..n).map(|e| Rect::EMPTY.with(domain.edge(e).start).with(domain.end(e))).collect();
        let Some(all) = boxes.iter().copied().reduce(Rect::union) else {
            return Self { edges: Vec::new(), levels: Vec::new() };
        };
        let mut keyed: Vec<(u64, u32)> =
            (0..n).map(|e| (hilbert(&all, &boxes[e as usize]), e)).collect();
        keyed.sort_unstable();
        let edges: Vec<u32> = keyed.into_iter().map(|(_, e)| e).collect();
        let mut levels = vec![edges.iter().map(|&e| boxes[e as usize]).collect::<Vec<_>>()];
        while let Some(last) = levels.last().filter(|level| level.len() > 1) {
            let next =
                last.chunks(WIDTH).filter_map(|c| c.iter().copied().reduce(Rect::union)).collect();
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

/// Position of the middle of a box along a Hilbert curve of 2^32 cells over another one.
fn hilbert(all: &Rect, inside: &Rect) -> u64 {
    const SIDE: u64 = 1 << 16;
    let size = all.max - all.min;
    let point = (inside.min + inside.max) * 0.5;
    let cell = |offset: f64, size: f64| {
        // The cast saturates, so an empty or infinite size does no harm.
        ((offset / size * SIDE as f64) as u64).min(SIDE - 1)
    };
    let mut x = cell(point.x - all.min.x, size.x);
    let mut y = cell(point.y - all.min.y, size.y);
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
