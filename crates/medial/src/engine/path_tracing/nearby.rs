//! Looks at the edges of the boundary next to a path, one by one, before the tree is asked.
//!
//! # Contract
//! [`Search::nearer`] only proposes. [`Search::end_among_few`] proves an end where doubles suffice,
//! or leaves it to [`super::verify`].
//!
//! # Method
//! The third governor of most paths is a few edges away from one of the other two along the boundary.
//! In a polygon of one walk nothing lies ahead but the boundary from the right governor on to the left
//! one; where that is a few edges only they are all there is to look at.

use std::ops::Range;

use super::chain::{POOR, Passed, first_piece_cut, start_after};
use super::contacts::Contacts;
use super::front::Front;
use super::search::{Found, Gap, Proposal, SLACK, Search, Start};
use super::verify::{clear_cut, share};
use crate::domain::{Corner, Domain, Edge, Site};
use crate::geom::{TouchingDisk, U};

/// Edges ahead up to which the tree is not asked.
const FEW: u32 = 48;

/// Edges after the right governor, and before the left one, that are looked at first otherwise.
const NEAR: u32 = 8;

/// Elements beyond the end of an edge that are proposed in its place.
const FOLLOWING: usize = 3;

/// Times that a proposal is replaced by a nearer one.
const MOST_TIMES: usize = 8;

/// How often a look at what is nearby has paid of late; what it costs is a third of what it saves.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Luck {
    balance: i32,
    skipped: u32,
}

impl Luck {
    /// The most that is remembered.
    const LONG: i32 = 32;
    /// Looks left out before one is taken all the same.
    const SELDOM: u32 = 16;

    /// Whether to look.
    #[inline]
    pub fn promises(&mut self) -> bool {
        if self.balance >= 0 || self.skipped >= Self::SELDOM {
            self.skipped = 0;
            return true;
        }
        self.skipped += 1;
        false
    }

    /// Takes note of a look.
    #[inline]
    pub fn note(&mut self, paid: bool) {
        let change = if paid { 4 } else { -1 };
        self.balance = (self.balance + change).clamp(-Self::LONG, Self::LONG);
    }
}

/// The edges next to a path.
#[derive(Clone, Copy, Debug)]
pub(super) enum Nearby {
    /// All that lie ahead.
    All(Front),
    /// The next few on either side.
    Some,
}

impl Nearby {
    /// The edges, in at most two runs.
    #[inline]
    fn runs(self, domain: &Domain, (right, left): (Site, Site)) -> [Range<u32>; 2] {
        match self {
            Self::All(front) => front.runs(),
            Self::Some => {
                let (r, l) = (right.index(), left.index());
                let walk = |k: u32| domain.walks()[domain.edge(k).walk as usize];
                let (after, before) = (walk(r), walk(l));
                let mut after = r + 1..(r + 1 + NEAR).min(after.first + after.len);
                let mut before = l.saturating_sub(NEAR).max(before.first)..l;
                // From one governor on to the other one, where they are that near.
                if r < l {
                    after.end = after.end.min(l);
                    before.start = before.start.max(after.end);
                }
                [after, before]
            }
        }
    }
}

/// Distance from the centre of a disk within which an edge clearly cuts it.
#[inline(always)]
fn clear(disk: &TouchingDisk) -> f64 {
    disk.radius * (1.0 - SLACK)
}

/// The edges of two runs, of at most 64 in all, that are within some distance of the centre of a disk.
#[derive(Clone)]
struct Within {
    runs: [Range<u32>; 2],
    /// A bit for each edge still to come.
    mask: u64,
}

impl Within {
    /// Which edges are near can rarely be foreseen, so nothing branches on it.
    #[inline(always)]
    fn new(domain: &Domain, runs: [Range<u32>; 2], disk: &TouchingDisk, reach: f64) -> Self {
        let of_run = |run: &Range<u32>| {
            let edges = &domain.edges()[run.start as usize..run.end as usize];
            edges.iter().enumerate().fold(0_u64, |mask, (k, edge)| {
                mask | u64::from(is_within(edge, disk, reach)) << (k & 63)
            })
        };
        let [first, second] = &runs;
        let mask = of_run(first) | of_run(second) << (first.len() & 63);
        Self { runs, mask }
    }

    /// Leaves out those that are not within some distance of the centre of another disk.
    #[inline(always)]
    fn keep(&mut self, domain: &Domain, disk: &TouchingDisk, reach: f64) {
        let mut left = self.mask;
        while left != 0 {
            let place = left.trailing_zeros();
            left &= left - 1;
            let within = is_within(domain.edge(self.edge_at(place)), disk, reach);
            self.mask &= !(u64::from(!within) << place);
        }
    }

    #[inline(always)]
    fn edge_at(&self, place: u32) -> u32 {
        let [first, second] = &self.runs;
        let n_first = first.len() as u32;
        if place < n_first { first.start + place } else { second.start + (place - n_first) }
    }
}

impl Iterator for Within {
    type Item = u32;

    #[inline(always)]
    fn next(&mut self) -> Option<u32> {
        if self.mask == 0 {
            return None;
        }
        let place = self.mask.trailing_zeros();
        self.mask &= self.mask - 1;
        Some(self.edge_at(place))
    }
}

#[inline(always)]
fn is_within(edge: &Edge, disk: &TouchingDisk, reach: f64) -> bool {
    edge.distance2(disk.centre - (edge.start - disk.origin)) <= reach * reach
}

impl Search<'_> {
    /// The edges ahead, if they are few and all that a path can meet.
    #[inline]
    pub fn few_ahead(&self, front: Option<Front>) -> Option<Front> {
        front.filter(|f| self.one_walk && f.len() <= FEW)
    }

    /// A proposal of what clearly cuts a disk of the path. What was passed is shortened if it lies on an
    /// earlier piece.
    #[inline(never)]
    pub fn hit(
        &mut self,
        anchor: &Start,
        front: Option<Front>,
        disk: &TouchingDisk,
        nearby: Nearby,
    ) -> Option<Proposal> {
        let near = Within::new(self.domain, nearby.runs(self.domain, self.link), disk, clear(disk));
        self.hit_among(anchor, front, disk, near)
    }

    /// The same among these edges.
    #[inline(always)]
    fn hit_among(
        &mut self,
        anchor: &Start,
        front: Option<Front>,
        disk: &TouchingDisk,
        near: Within,
    ) -> Option<Proposal> {
        let (edge, near) = self.first_cut(anchor, disk, near)?;
        let (link, hit) = self.before(anchor, front, disk, edge, near)?;
        self.go_back(link);
        Some(hit)
    }

    /// A proposal that no edge nearby clearly cuts, from one that some may cut. What was passed is
    /// shortened if it lies on an earlier piece.
    #[inline(never)]
    pub fn nearer(
        &mut self,
        anchor: &Start,
        front: Option<Front>,
        mut end: Proposal,
        nearby: Nearby,
    ) -> Proposal {
        if let Some(beside) = self.beyond_end(anchor, front, &end) {
            end = beside;
        }
        let domain = self.domain;
        let runs = nearby.runs(domain, self.link);
        let mut near = Within::new(domain, runs, &end.disk, clear(&end.disk));
        for _ in 0..MOST_TIMES {
            let Some(nearer) = self.hit_among(anchor, front, &end.disk, near.clone()) else {
                break;
            };
            end = nearer;
            // What cuts an earlier disk of a path, and not the empty one at its start, cuts this one.
            near.keep(domain, &end.disk, clear(&end.disk));
        }
        end
    }

    /// Where a proposed edge is met beyond one of its ends, the proposal of what follows there.
    #[inline]
    fn beyond_end(&self, anchor: &Start, front: Option<Front>, end: &Proposal) -> Option<Proposal> {
        if !end.site.is_edge() {
            return None;
        }
        let domain = self.domain;
        let edge = domain.edge(end.site.index());
        let along = edge.direction.dot(end.disk.centre + (end.disk.origin - edge.start));
        let slack = SLACK * end.disk.radius;
        let before = along < -slack;
        if !before && along <= edge.length + slack {
            return None;
        }
        let here = start_after(&self.passed, anchor);
        let gap = Gap::new(self.link.0, self.link.1, here, front);
        let mut site = end.site;
        (0..FOLLOWING).find_map(|_| {
            site = if before { domain.behind(site) } else { domain.ahead(site) };
            self.propose(&gap, site)
        })
    }

    /// The edge that looks as if it were met first of those that clearly cut a disk, and which part of it
    /// is nearest.
    #[inline(always)]
    fn first_cut(&self, anchor: &Start, disk: &TouchingDisk, near: Within) -> Option<(u32, i8)> {
        let domain = self.domain;
        let (right, left) = self.link;
        let own = |s: Site, k: u32, next: u32| {
            s == Site::edge(k) || !s.is_edge() && (s.index() == k || s.index() == next)
        };
        let mut first: Option<(u32, i8)> = None;
        let mut least = f64::NAN;
        for k in near {
            let edge = domain.edge(k);
            let Some(near) = clear_cut(disk, edge.start, || domain.end(k), edge) else {
                continue;
            };
            if own(right, k, edge.next) || own(left, k, edge.next) {
                continue;
            }
            let Some((edge, part)) = first else {
                first = Some((k, near));
                continue;
            };
            if least.is_nan() {
                least = share(domain, anchor, disk, edge, part);
            }
            let share = share(domain, anchor, disk, k, near);
            if share < least {
                least = share;
                first = Some((k, near));
            }
        }
        first
    }

    /// The proposal of an edge that cuts a disk of the path, if it comes before it, and the piece that it
    /// lies on.
    #[inline(always)]
    fn before(
        &self,
        anchor: &Start,
        front: Option<Front>,
        disk: &TouchingDisk,
        edge: u32,
        near: i8,
    ) -> Option<(usize, Proposal)> {
        let link = first_piece_cut(self.domain, &self.passed, edge);
        let last = self.passed.get(link);
        let (right, left) = last.map_or(self.link, |p: &Passed| (p.right, p.left));
        let gap = Gap::new(right, left, start_after(&self.passed[..link], anchor), front);
        let last = last.map_or(disk, |p| &p.disk);
        self.proposal_before(&gap, disk, last, edge, near).map(|p| (link, p))
    }

    /// The end of a path that was proposed, if doubles can tell that nothing of the few edges ahead comes
    /// before it.
    ///
    /// # Errors
    /// Else the certified disk of the proposal, if doubles have one.
    #[inline]
    pub fn end_among_few(
        &mut self,
        front: Front,
        end: &Proposal,
    ) -> Result<Found, Option<TouchingDisk>> {
        let (right, left) = self.link;
        let triple = [right, end.site, left];
        let disk = if end.disk.bound.is_finite() {
            end.disk
        } else {
            TouchingDisk::touching(&self.domain.governors(triple)).ok_or(None)?
        };
        if disk.bound > POOR * disk.radius || !self.is_clear_of_few(front, &triple, &disk) {
            return Err(Some(disk));
        }
        self.leave_out_those_in(&triple);
        let contacts = Contacts::from_slice(&triple);
        Ok(Found::Disk { disk, triple, contacts, own: Some(disk) })
    }

    /// Whether a certified disk of three governors touches them within their zones, and nothing else
    /// among the edges ahead is near it; false if doubles cannot tell.
    #[inline]
    fn is_clear_of_few(&self, front: Front, triple: &[Site; 3], disk: &TouchingDisk) -> bool {
        let domain = self.domain;
        let is_reflex = |k: u32| domain.edge(k).corner == Corner::Reflex;
        if !triple.iter().all(|s| s.is_edge() || is_reflex(s.index())) {
            return false;
        }
        let [a, b, c] = *triple;
        let has = |site: Site| a == site || b == site || c == site;
        // Bound on the error of any length below: one for all edges, as all lie in the polygon's box.
        let far = disk.centre.x.abs() + disk.centre.y.abs();
        let doubt = disk.bound + U * (16.0 * far + 32.0 * self.largest + 2.0 * disk.radius);
        let reach = disk.radius + doubt;
        // A governor that is not near is met beyond one of its ends.
        let mut to_come = triple.iter().filter(|s| s.is_edge()).count();
        for k in Within::new(domain, front.runs(), disk, reach) {
            let edge = domain.edge(k);
            let along = edge.direction.dot(disk.centre - (edge.start - disk.origin));
            let (at_start, at_end) = (has(Site::corner(k)), has(Site::corner(edge.next)));
            let clear = if has(Site::edge(k)) {
                to_come -= 1;
                at_start || at_end || doubt < along && along < edge.length - doubt
            } else if at_start {
                along < -doubt
            } else {
                at_end && along > edge.length + doubt
            };
            if !clear {
                return false;
            }
        }
        to_come == 0
    }
}
