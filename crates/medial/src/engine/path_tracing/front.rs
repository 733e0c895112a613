use std::ops::Range;

use crate::domain::{Domain, Site};
use crate::geom::{Hidden, Point, Scope, TouchingDisk, U};

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

    /// First and last edge ahead; they wrap around the walk where the first one is greater.
    #[cfg(feature = "parallel")]
    pub fn ends(&self) -> (u32, u32) {
        (self.first, self.last)
    }

    /// Number of edges ahead.
    #[inline]
    pub fn len(&self) -> u32 {
        let (start, end) = self.walk;
        if self.first <= self.last {
            self.last - self.first + 1
        } else {
            (end - self.first) + (self.last - start + 1)
        }
    }

    /// The edges ahead, in one or two runs.
    #[inline]
    pub fn runs(&self) -> [Range<u32>; 2] {
        let (start, end) = self.walk;
        if self.first <= self.last {
            [self.first..self.last + 1, 0..0]
        } else {
            [self.first..end, start..self.last + 1]
        }
    }

    /// Whether an edge may be met.
    #[inline]
    pub fn holds(&self, edge: u32) -> bool {
        !self.hidden().holds(edge)
    }

    /// The edges that cannot be met.
    #[inline]
    pub fn hidden(&self) -> Hidden {
        let (start, end) = self.walk;
        Hidden(if self.first <= self.last {
            [(start, self.first), (self.last + 1, end)]
        } else {
            [(self.last + 1, self.first), (0, 0)]
        })
    }
}

/// Where anything must lie that cuts or touches a disk ahead of an empty one: within the disk, and
/// beyond the radical line of both.
///
/// `doubt` bounds the error of the empty disk's centre and radius. The disk ahead counts with its
/// bound; one without a bound is only a proposal.
pub(super) fn scope(start: Point, radius: f64, doubt: f64, disk: &TouchingDisk) -> Scope {
    let centre = disk.position();
    let extent = centre.x.abs().max(centre.y.abs()) + disk.radius;
    let certain = disk.bound.is_finite();
    let bound = if certain { disk.bound } else { 0.0 };
    let reach = (disk.radius + bound) * (1.0 + 64.0 * U) + 64.0 * U * extent;
    let way = disk.centre + (disk.origin - start);
    let length = way.norm();
    let size = disk.radius + radius + length;
    let bound = if certain { disk.bound } else { 1e-9 * disk.radius };
    // Each of four lengths of at most `size` is off by that much, and is squared.
    let margin = 8.0 * size * (bound + doubt + 16.0 * f64::EPSILON * size);
    let least = length * length - (disk.radius - radius) * (disk.radius + radius) - margin;
    let offset = least / (2.0 * length);
    if !offset.is_finite() {
        return Scope { centre, reach, normal: Point::default(), border: start };
    }
    let normal = way * (1.0 / length);
    Scope { centre, reach, normal, border: start + normal * offset }
}
