use std::ops::Range;

use crate::domain::{Domain, Site};
use crate::geom::{Point, Rect, TouchingDisk};

/// The part of one boundary walk that a path can meet.
///
/// Where both governors lie on one walk, the two spokes of the start disk cut the domain apart:
/// ahead lies the walk from the right governor on to the left one, and no other part of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Front {
    /// Edges of the walk.
    walk: (u32, u32),
    /// First and last edge ahead; they wrap around the walk where `first > last`.
    first: u32,
    last: u32,
}

impl Front {
    pub fn new(domain: &Domain, right: Site, left: Site) -> Option<Self> {
        let (r, l) = (domain.edge(right.index()), domain.edge(left.index()));
        if r.walk != l.walk {
            return None;
        }
        let walk = domain.walks()[r.walk as usize];
        let last = if left.is_edge() { left.index() } else { l.prev };
        Some(Self { walk: (walk.first, walk.first + walk.len), first: right.index(), last })
    }

    /// Whether an edge may be met.
    #[inline]
    pub fn holds(&self, edge: u32) -> bool {
        if edge < self.walk.0 || edge >= self.walk.1 {
            true
        } else if self.first <= self.last {
            self.first <= edge && edge <= self.last
        } else {
            self.first <= edge || edge <= self.last
        }
    }

    /// Whether any of these edges may be met.
    #[inline]
    pub fn meets(&self, edges: &Range<u32>) -> bool {
        let (start, end) = (edges.start, edges.end);
        if start < self.walk.0 || end > self.walk.1 {
            true
        } else if self.first <= self.last {
            self.first < end && start <= self.last
        } else {
            self.first < end || start <= self.last
        }
    }
}

/// The half-plane beyond the radical line of the start disk and a disk ahead of it.
///
/// The start disk is empty, so only the rest of the other disk can hold anything.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lune {
    from: Point,
    /// Twice the way between the centres.
    step: Point,
    /// What `step · (p - from)` must reach.
    least: f64,
}

impl Lune {
    pub const EVERYTHING: Self =
        Self { from: Point::new(0.0, 0.0), step: Point::new(0.0, 0.0), least: -1.0 };

    /// `doubt` bounds the error of the start's centre and radius.
    pub fn new(start: Point, radius: f64, doubt: f64, disk: &TouchingDisk) -> Self {
        let way = disk.centre + (disk.origin - start);
        let size = disk.radius + radius + way.norm();
        let bound = if disk.bound.is_finite() { disk.bound } else { 1e-9 * disk.radius };
        // Each of four lengths of at most `size` is off by that much, and is squared.
        let margin = 8.0 * size * (bound + doubt + 16.0 * f64::EPSILON * size);
        let least = way.norm2() - (disk.radius - radius) * (disk.radius + radius) - margin;
        Self { from: start, step: way * 2.0, least }
    }

    #[inline]
    pub fn meets(&self, bounds: &Rect) -> bool {
        let x = if self.step.x > 0.0 { bounds.max.x } else { bounds.min.x };
        let y = if self.step.y > 0.0 { bounds.max.y } else { bounds.min.y };
        self.step.dot(Point::new(x, y) - self.from) >= self.least
    }
}
