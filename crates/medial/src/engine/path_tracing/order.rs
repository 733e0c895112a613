//! The order of disks along a path, decided exactly.

use std::cmp::Ordering;

use super::search::{Found, Gap, Search};
use crate::domain::Site;
use crate::geom::predicates::ExactDisk;
use crate::geom::{Point, TouchingDisk};

/// Way from the start, as a share of both radii, that needs no exact proof.
///
/// The position of a certified disk is off by its bound and by the rounding of the start, which
/// are far smaller.
const CLEARLY_AHEAD: f64 = 1e-6;

impl Search<'_> {
    /// Of some sites the one whose exact disk comes first on the path, ahead of the start, and
    /// touches all three in their zones.
    pub(super) fn exact_first(&self, gap: &Gap, sites: &[Site]) -> Option<Site> {
        self.first_where(gap, sites, |disk, site| {
            [gap.right, site, gap.left].iter().all(|&s| self.in_zone(disk, s))
        })
    }

    /// Of some corners the one whose exact disk comes first on the path, ahead of the start.
    pub(super) fn first_on_path(&self, gap: &Gap, corners: &[Site]) -> Option<Site> {
        self.first_where(gap, corners, |_, _| true)
    }

    fn first_where(
        &self,
        gap: &Gap,
        sites: &[Site],
        holds: impl Fn(&ExactDisk, Site) -> bool,
    ) -> Option<Site> {
        let start = gap.start.triple.and_then(|t| self.exact(&t));
        let mut first: Option<(Site, ExactDisk)> = None;
        for &site in sites {
            if self.watch.is_over() {
                return None;
            }
            if !self.may_be_third(gap, site) {
                continue;
            }
            let Some(disk) = self.exact(&gap.triple(site)) else { continue };
            if !holds(&disk, site) {
                continue;
            }
            if let Some(start) = &start
                && self.along_path(gap, start, &disk) != Ordering::Less
            {
                continue;
            }
            let nearer = first
                .as_ref()
                .is_none_or(|(_, f)| self.along_path(gap, &disk, f) == Ordering::Less);
            if nearer {
                first = Some((site, disk));
            }
        }
        first.map(|(site, _)| site)
    }

    /// Whether a disk touches a site within the site's zone.
    fn in_zone(&self, disk: &ExactDisk, site: Site) -> bool {
        let edge = self.domain.edge(site.index());
        let (a, b) = (edge.start, self.domain.end(site.index()));
        if site.is_edge() {
            disk.along(a, b, a) != Ordering::Less && disk.along(a, b, b) != Ordering::Greater
        } else {
            let before = self.domain.edge(edge.prev).start;
            disk.along(before, a, a) != Ordering::Less && disk.along(a, b, a) != Ordering::Greater
        }
    }

    /// Orders two exact disks of the path along it.
    fn along_path(&self, gap: &Gap, first: &ExactDisk, second: &ExactDisk) -> Ordering {
        let ends = |s: Site| (self.domain.edge(s.index()).start, self.domain.end(s.index()));
        if gap.right.is_edge() {
            let (a, b) = ends(gap.right);
            first.compare_along(second, a, b)
        } else if gap.left.is_edge() {
            let (a, b) = ends(gap.left);
            first.compare_along(second, b, a)
        } else {
            // Forwards is a quarter turn to the right of the vector between the corners.
            let (p, q) = (ends(gap.right).0, ends(gap.left).0);
            first.compare_along(second, Point::new(p.y, q.x), Point::new(q.y, p.x))
        }
    }

    /// Whether a verified disk lies ahead of the start; needed only where rings may hide.
    pub(super) fn is_ahead(&self, gap: &Gap, disk: &TouchingDisk, triple: &[Site; 3]) -> bool {
        let Some(start) = gap.start.triple else { return true };
        let position = gap.course(self.domain).position(disk);
        let bounds = self.tree.bounds();
        let size = (bounds.max - bounds.min).norm() + disk.radius;
        let doubt = disk.bound + gap.start.doubt + 64.0 * f64::EPSILON * size;
        if position > CLEARLY_AHEAD * (disk.radius + gap.start.radius) + doubt {
            return true;
        }
        match (self.exact(&start), self.exact(triple)) {
            (Some(a), Some(b)) => self.along_path(gap, &a, &b) == Ordering::Less,
            _ => false,
        }
    }

    /// Whether the disk through a corner of a whole ring lies between start and end of a path.
    pub(super) fn is_between(&self, gap: &Gap, site: Site, found: &Found) -> bool {
        if self.watch.is_over() {
            return false;
        }
        let Some(disk) = self.exact(&gap.triple(site)) else { return false };
        if let Some(start) = gap.start.triple.and_then(|t| self.exact(&t))
            && self.along_path(gap, &start, &disk) != Ordering::Less
        {
            return false;
        }
        match found {
            Found::Corner(_) => true,
            Found::Known(_) => false,
            Found::Disk { triple, .. } => self
                .exact(triple)
                .is_some_and(|end| self.along_path(gap, &disk, &end) == Ordering::Less),
        }
    }
}
