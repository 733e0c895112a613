//! Finds where a path ends: the nearest empty disk along the bisector of its governors.
//!
//! Doubles propose third governors; a certified disk, or where that is undecided the exact one,
//! disposes. An empty disk that touches right governor, third governor and left governor in
//! counterclockwise order is a keypoint however it was proposed, and the next one on the path
//! unless a whole ring lies between its disk and the one at the start ([`super::rings`]).

use std::cell::{Cell, OnceCell};
use std::collections::BTreeSet;
use std::sync::{Arc, OnceLock};

use super::chain::{POOR, Passed};
use super::contacts::Contacts;
use super::course::Course;
use super::finish::Traced;
use super::front::Front;
use super::gaps::Gaps;
use super::met::Met;
use super::nearby::Luck;
use super::rings::Rings;
use super::touch::{Seen, Touch, touch};
use super::verify::{Verdict, Verify};
use crate::domain::{Corner, Domain, Site};
use crate::engine::EngineError;
use crate::engine::watch::Watch;
use crate::geom::predicates::ExactDisk;
use crate::geom::{CapsuleTree, Governor, Pinned, Point, TouchingDisk};

/// A third governor that was tried, with its disk.
#[derive(Clone, Copy, Debug)]
pub struct Candidate {
    /// Site that would become the third governor.
    pub site: Site,
    /// Centre of the disk that touches it and both governors of the path.
    pub centre: Point,
    /// Radius of that disk.
    pub radius: f64,
}

/// Where a path starts.
#[derive(Clone, Copy, Debug)]
pub(super) struct Start {
    pub centre: Point,
    pub radius: f64,
    /// Bound on the error of both.
    pub doubt: f64,
    /// Governors whose exact disk this is; `None` at a convex corner.
    pub triple: Option<[Site; 3]>,
}

/// Where a path ends.
#[derive(Clone, Debug)]
pub(super) enum Found {
    /// In the convex corner at the start of this edge.
    Corner(u32),
    /// At a keypoint: its disk, three sites that define it, and all its governors in
    /// counterclockwise order; and the disk that doubles find for them alone, if that is known.
    Disk { disk: TouchingDisk, triple: [Site; 3], contacts: Contacts, own: Option<TouchingDisk> },
    /// At a keypoint that is known already, at its open gap between these governors.
    Known(u32),
}

/// What was traced before, for paths that may close a loop.
#[derive(Clone, Copy, Debug)]
pub(super) struct Before<'t> {
    pub gaps: &'t Gaps,
    pub traced: &'t Traced,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct Proposal {
    pub site: Site,
    pub disk: TouchingDisk,
    pub position: f64,
}

/// The path whose end is looked for, or a piece of it.
#[derive(Clone, Debug)]
pub(super) struct Gap {
    pub right: Site,
    pub left: Site,
    pub start: Start,
    pub front: Option<Front>,
    course: OnceCell<Course>,
}

impl Gap {
    pub fn new(right: Site, left: Site, start: Start, front: Option<Front>) -> Self {
        Self { right, left, start, front, course: OnceCell::new() }
    }

    /// The triple that `site` would complete, counterclockwise.
    pub fn triple(&self, site: Site) -> [Site; 3] {
        [self.right, site, self.left]
    }

    /// The bisector.
    #[inline(always)]
    pub fn course(&self, domain: &Domain) -> &Course {
        if let Some(course) = self.course.get() {
            return course;
        }
        // Mostly this is the first time, which `get_or_init` takes to be rare.
        let (right, left) = (domain.governor(self.right), domain.governor(self.left));
        let course = Course::new(&right, &left, self.start.centre);
        self.course.get_or_init(|| course)
    }

    /// The disk of the path at a position, if the bisector reaches it.
    pub fn disk_at(&self, domain: &Domain, position: f64) -> Option<TouchingDisk> {
        let (right, left) = (domain.governor(self.right), domain.governor(self.left));
        self.course(domain).disk_at(&right, &left, self.start.radius, position)
    }
}

/// Share of a radius by which a proposal may miss a zone, or lie behind the start.
///
/// Proposals only: what is proposed is certified or decided exactly afterwards.
pub(super) const SLACK: f64 = 1e-9;

/// Tries after which the engine gives up rather than hang; each one moves strictly backwards on
/// the path or bans a site, so none of the shapes met comes near.
const MOST_TRIES: usize = 100_000;

/// Bound of a disk, as a share of the size of the polygon, from which it is not looked into if it is larger
/// than the polygon.
const HAZY: f64 = 1.0 / (1 << 20) as f64;

/// Sites that the last resort weighs before it takes in all there are.
const WIDEST: usize = 64;

/// Visits after which the tree may be rounded off or sorted anew, and nodes a visit from which it is.
const VISITS: u64 = 500;
const MANY: u64 = 32;
const NODES: u64 = 100;

/// Nodes of one visit that count, so that a few that go through all do not tell for many.
const MOST: u64 = 1024;

/// Tries before only exact arithmetic proposes.
const FLOATING_TRIES: usize = 48;

/// What is known about the boundary of one polygon of a domain; several searches may share it.
#[derive(Clone, Debug)]
pub(super) struct Index {
    tree: Arc<CapsuleTree>,
    /// The tree sorted anew, if anybody needs it.
    sorted: Arc<OnceLock<Arc<CapsuleTree>>>,
    rings: Option<Arc<Rings>>,
}

impl Index {
    /// The index over the walks with the given numbers.
    pub fn new(domain: &Domain, walks: std::ops::Range<usize>) -> Self {
        let first = domain.walks()[walks.start].first;
        let n: u32 = domain.walks()[walks.clone()].iter().map(|w| w.len).sum();
        let tree = CapsuleTree::new(first, n, |k| (domain.edge(k).start, domain.end(k)));
        let rings = Rings::new(domain, walks);
        Self { tree: Arc::new(tree), sorted: Arc::default(), rings: rings.map(Arc::new) }
    }
}

/// Looks for ends of paths in one polygon of a domain.
pub(super) struct Search<'a> {
    pub domain: &'a Domain,
    pub tree: Arc<CapsuleTree>,
    /// The tree sorted anew, once it is, and whether this search uses it.
    sorted: Arc<OnceLock<Arc<CapsuleTree>>>,
    mended: bool,
    /// Whether the tree was rounded off.
    rounded: bool,
    /// Nodes that visits went through, and visits.
    work: Cell<(u64, u64)>,
    /// No disk inside the polygon has a larger radius.
    pub largest: f64,
    /// Whether the boundary of the polygon is one walk.
    pub one_walk: bool,
    pub rings: Option<Arc<Rings>>,
    /// Whether edges nearby are worth a look before the tree is asked.
    pub luck: Luck,
    /// The same where an end is far away or not known.
    pub luck_far: Luck,
    pub banned: Vec<Site>,
    /// Whether every piece of a path is searched for whole rings, and not only counted on in the end
    /// that every ring governs something.
    pub careful: bool,
    /// Transitions of the last path that was chased.
    pub passed: Vec<Passed>,
    /// Governors of the piece of it that was looked at last.
    pub link: (Site, Site),
    /// What takes over from the governors where both leave at once.
    pub tie: Option<(Site, Site)>,
    /// Edges beyond convex corners that a path would have met before its last piece began.
    pub behind: Vec<u32>,
    /// Whether the proposed end of a path was made by the holes ahead of it.
    pub from_holes: bool,
    /// What was tried for the last path, for those who watch.
    pub tried: Vec<Candidate>,
    pub watch: Watch<'a>,
}

impl<'a> Search<'a> {
    /// Prepares the search in the polygon whose walks have the given numbers.
    pub fn new(domain: &'a Domain, walks: std::ops::Range<usize>, watch: Watch<'a>) -> Self {
        Self::over(domain, Index::new(domain, walks), watch)
    }

    /// The same with an index that is there already.
    pub fn over(domain: &'a Domain, index: Index, watch: Watch<'a>) -> Self {
        let Index { tree, sorted, rings } = index;
        let bounds = tree.bounds();
        let all = tree.items();
        let walk = domain.walks()[domain.edge(all.start).walk as usize];
        let one_walk = walk.len as usize == all.len();
        Self {
            domain,
            sorted,
            mended: false,
            rounded: false,
            work: Cell::new((0, 0)),
            largest: (bounds.max - bounds.min).norm(),
            one_walk,
            tree,
            rings,
            luck: Luck::default(),
            luck_far: Luck::default(),
            banned: Vec::new(),
            careful: false,
            passed: Vec::new(),
            link: (Site(0), Site(0)),
            tie: None,
            behind: Vec::new(),
            from_holes: false,
            tried: Vec::new(),
            watch,
        }
    }

    /// Rounds the tree off if visits go through many nodes of it, and sorts it anew if there are too
    /// many then.
    pub fn mend_tree(&mut self) {
        let (nodes, visits) = self.work.get();
        if self.mended || visits < VISITS || nodes < MANY * visits {
            return;
        }
        if !self.rounded {
            self.rounded = true;
            self.work.set((0, 0));
            self.follow_rims();
            return;
        }
        if nodes < NODES * visits {
            return;
        }
        self.mended = true;
        let (domain, items) = (self.domain, self.tree.items());
        let ends = |k| (domain.edge(k).start, domain.end(k));
        // What nobody else uses makes room for the other one.
        self.tree = Arc::new(CapsuleTree::new(items.start, 0, ends));
        let sort =
            || Arc::new(CapsuleTree::along_a_curve(items.start, items.end - items.start, ends));
        self.tree = self.sorted.get_or_init(sort).clone();
    }

    /// Measures the edges of the tree by circles near them as well.
    pub fn follow_rims(&self) {
        self.tree.follow_rims(|k| (self.domain.edge(k).start, self.domain.end(k)));
    }

    /// Takes note of a visit of the tree through that many nodes.
    #[inline]
    pub fn count_visit(&self, entered: u64) {
        let (nodes, visits) = self.work.get();
        self.work.set((nodes + entered.min(MOST), visits + 1));
    }

    /// The end of the path that leaves `start` between `right` and `left`.
    pub fn find(&mut self, right: Site, left: Site, start: Start) -> Result<Found, EngineError> {
        self.tried.clear();
        self.banned.clear();
        let gap = Gap::new(right, left, start, Front::new(self.domain, right, left));
        let mut found = if self.runs_into_corner(right, left) {
            Found::Corner(left.index())
        } else {
            let first = self.first_proposal(&gap);
            self.settle(&gap, first)?
        };
        let (mut last_hidden, mut last_left) = (None, None);
        // Each turn ends the path at an earlier site.
        for _ in 0..=2 * self.tree.items().len() {
            self.watch.check()?;
            if let Found::Disk { contacts, .. } = &found
                && let Some(behind) = contact_behind(contacts, right, left)
            {
                // A whole ring lies on the path and touches the disk from behind; what of it comes first
                // may be another part.
                let site = self
                    .exact_first(&gap, &behind)
                    .or_else(|| self.exact_first(&gap, &self.on_walks_of(&behind)))
                    .ok_or_else(|| self.broken(&gap))?;
                let next = self.proposal_or_exact(&gap, site);
                found = self.settle(&gap, next)?;
                continue;
            }
            let leaving = self.left_before(&gap, &found);
            if let Some(site) = self.first_on_path(&gap, &leaving)
                && last_left.replace(site) != Some(site)
            {
                self.banned.clear();
                let next = self.proposal_or_exact(&gap, site);
                found = self.settle(&gap, next)?;
                continue;
            }
            let Some(rings) = &self.rings else { return Ok(found) };
            let suspects = rings.suspects(self.domain, &gap, &found);
            let hidden: Vec<Site> =
                suspects.into_iter().filter(|&s| self.is_between(&gap, s, &found)).collect();
            self.watch.check()?;
            if hidden.is_empty() {
                return Ok(found);
            }
            self.banned.clear();
            let mut site = self.first_on_path(&gap, &hidden).ok_or_else(|| self.broken(&gap))?;
            if last_hidden.replace(site) == Some(site) {
                // Proposals led past the ring once: the first contact of all is the end.
                let all = self.everything(&gap);
                site = self.exact_first(&gap, &all).ok_or_else(|| self.broken(&gap))?;
            }
            let next = self.proposal_or_exact(&gap, site);
            found = self.settle(&gap, next)?;
        }
        Err(self.broken(&gap))
    }

    /// The edges at which corners that govern leave the path before its end, where doubles cannot tell that
    /// they do not: then the end lies around a hole that hangs at such a corner.
    fn left_before(&self, gap: &Gap, found: &Found) -> Vec<Site> {
        let is_doubtful =
            matches!(found, Found::Disk { disk, .. } if self.may_turn_back(gap, disk));
        if !is_doubtful {
            return Vec::new();
        }
        [(gap.right, self.domain.ahead(gap.right)), (gap.left, self.domain.behind(gap.left))]
            .into_iter()
            .filter(|(governor, _)| !governor.is_edge())
            .map(|(_, edge)| edge)
            .filter(|&edge| self.is_between(gap, edge, found))
            .collect()
    }

    fn broken(&self, gap: &Gap) -> EngineError {
        let place = gap.start.centre;
        self.watch.or(EngineError::Internal { stage: "tracing a path", place })
    }

    /// Whether the path ends in the convex corner between its two governors.
    pub fn runs_into_corner(&self, right: Site, left: Site) -> bool {
        right.is_edge()
            && left.is_edge()
            && self.domain.edge(right.index()).next == left.index()
            && self.domain.edge(left.index()).corner == Corner::Convex
    }

    /// The disk that would make `site` the third governor, if doubles find one ahead.
    #[inline(never)]
    pub fn propose(&self, gap: &Gap, site: Site) -> Option<Proposal> {
        self.proposal(gap, site)
    }

    /// The same, compiled for the place at hand.
    #[inline(always)]
    fn proposal(&self, gap: &Gap, site: Site) -> Option<Proposal> {
        if !self.may_be_third(gap, site) {
            return None;
        }
        let governors = self.domain.governors(gap.triple(site));
        let disk = TouchingDisk::guess(&governors, gap.start.centre)?;
        if let Governor::Edge { start, end, direction } = governors[1] {
            let x = direction.dot(disk.centre + (disk.origin - start));
            let back = direction.dot(disk.centre + (disk.origin - end));
            let slack = SLACK * disk.radius;
            if x < -slack || back > slack {
                return None;
            }
        }
        let position = gap.course(self.domain).position(&disk);
        let slack = SLACK * (disk.radius + gap.start.radius);
        (position >= -slack).then_some(Proposal { site, disk, position })
    }

    /// Sites of an edge that could become third governors: itself, and the corners at its ends.
    pub fn sites_of(&self, edge: u32) -> [Option<Site>; 3] {
        let next = self.domain.edge(edge).next;
        let corner =
            |k: u32| (self.domain.edge(k).corner != Corner::Convex).then_some(Site::corner(k));
        [Some(Site::edge(edge)), corner(edge), corner(next)]
    }

    /// The proposal of an edge that cuts a disk, if it comes before `last`: the disk at the end of the
    /// piece, which is that one or an earlier one. `near` tells which part of the edge is nearest: its
    /// start if negative, its end if positive, or the edge itself.
    #[inline(always)]
    pub fn proposal_before(
        &self,
        gap: &Gap,
        disk: &TouchingDisk,
        last: &TouchingDisk,
        edge: u32,
        near: i8,
    ) -> Option<Proposal> {
        // The radius is convex along a path: an earlier disk is no larger than both ends.
        let largest = disk.radius.max(gap.start.radius) * (1.0 + SLACK);
        let limit = gap.course(self.domain).position(last);
        let sites = self.sites_of(edge);
        let order = match near {
            ..0 => [1, 0, 2],
            0 => [0, 1, 2],
            1.. => [2, 0, 1],
        };
        for k in order {
            if let Some(site) = sites[k]
                && let Some(p) = self.proposal(gap, site)
                && p.position < limit
                && p.disk.radius <= largest
            {
                return Some(p);
            }
        }
        None
    }

    /// Whether a site can be met ahead: not the governors, and not what their footpoints have
    /// left behind.
    #[inline]
    pub fn may_be_third(&self, gap: &Gap, site: Site) -> bool {
        let (right, left) = (gap.right, gap.left);
        let left_behind = if site.is_edge() {
            (!right.is_edge() && site.index() == self.domain.edge(right.index()).prev)
                || (!left.is_edge() && site.index() == left.index())
        } else {
            (right.is_edge() && site.index() == right.index())
                || (left.is_edge() && site.index() == self.domain.edge(left.index()).next)
        };
        site != right && site != left && !left_behind && !self.banned.contains(&site)
    }

    /// From a first proposal to the verified end of the path.
    fn settle(&mut self, gap: &Gap, first: Option<Proposal>) -> Result<Found, EngineError> {
        let mut best = first;
        // Sites seen to cut a disk, or to stand at the end of a governor.
        let mut seen = Met::default();
        // How many of them the last resort has weighed; all there are, if the greatest number.
        let mut known = 0;
        // Sites whose disks were looked into exactly, and whether all sites have been weighed since.
        let (mut asked, mut weighed) = (Met::default(), false);
        for round in 0..MOST_TRIES {
            self.watch.check()?;
            let Some(proposal) = best else {
                best = self.last_resort(gap, &mut seen, &mut known)?;
                continue;
            };
            let triple = gap.triple(proposal.site);
            self.tried.push(Candidate {
                site: proposal.site,
                centre: proposal.disk.position(),
                radius: proposal.disk.radius,
            });
            let Some((disk, mut exact)) = self.certify(&triple, &proposal.disk) else {
                self.banned.push(proposal.site);
                seen.remove(proposal.site);
                best = None;
                continue;
            };
            let floating = round < FLOATING_TRIES;
            if !floating && !asked.insert(proposal.site) {
                // Disks far outside the polygon may cut each other: what cuts one need not come before it.
                if std::mem::replace(&mut weighed, true) {
                    return Err(self.broken(gap));
                }
                asked = Met::default();
                let all = self.everything(gap);
                let first = self.exact_first(gap, &all).ok_or_else(|| self.broken(gap))?;
                best = self.proposal_or_exact(gap, first);
                continue;
            }
            if disk.bound > HAZY * self.largest && disk.radius > 2.0 * self.largest + disk.bound {
                // Too large to lie in the polygon, and so much that nearly all edges are in doubt.
                self.rule_out(proposal.site, &mut seen);
                best = None;
                continue;
            }
            let position = gap.course(self.domain).position(&disk);
            let start = (&gap.start, &[][..]);
            let mut verify = Verify::certified(self, gap, start, triple, disk, floating);
            verify.run();
            let verdict = verify.verdict(&mut exact);
            match verdict {
                Verdict::Better(next) => best = Some(next),
                Verdict::Earlier(site) => {
                    best = self
                        .may_be_third(gap, site)
                        .then(|| self.proposal_or_exact(gap, site))
                        .flatten();
                    if best.is_none() {
                        seen.insert(site);
                    }
                }
                Verdict::Cut(sites) => {
                    best = None;
                    let cutting = sites.iter().find_map(|&s| {
                        let tries = floating && s != proposal.site && !self.watch.is_over();
                        tries.then(|| self.propose(gap, s)).flatten()
                    });
                    for s in sites {
                        self.watch.check()?;
                        seen.insert(s);
                    }
                    if let Some(next) = cutting
                        && next.position < position
                    {
                        best = Some(next);
                    }
                }
                Verdict::OffEdge => {
                    self.rule_out(proposal.site, &mut seen);
                    best = None;
                }
                Verdict::Clear(contacts) => {
                    if self.rings.is_some()
                        && (self.turns_back(gap, &disk) || !self.is_ahead(gap, &disk, &triple))
                    {
                        self.banned.push(proposal.site);
                        seen.remove(proposal.site);
                        best = None;
                        continue;
                    }
                    return Ok(Found::Disk { disk, triple, contacts, own: None });
                }
            }
        }
        Err(self.broken(gap))
    }

    /// Takes note that the line of a third governor is touched beyond its end.
    fn rule_out(&mut self, site: Site, seen: &mut Met) {
        self.banned.push(site);
        seen.remove(site);
        if site.is_edge() {
            let edge = Site::edge(site.index());
            for next in [self.domain.ahead(edge), self.domain.behind(edge)] {
                if !self.banned.contains(&next) {
                    seen.insert(next);
                }
            }
        }
    }

    /// Exact arithmetic over all sites near the path, farther out with every round.
    fn last_resort(
        &mut self,
        gap: &Gap,
        seen: &mut Met,
        known: &mut usize,
    ) -> Result<Option<Proposal>, EngineError> {
        for site in [self.domain.ahead(gap.right), self.domain.behind(gap.left)] {
            if !self.banned.contains(&site) {
                seen.insert(site);
            }
        }
        // Something new was met since the last time: the earliest of it may be the end.
        if seen.len() != std::mem::replace(known, seen.len())
            && let Some(site) = self.exact_first(gap, seen)
        {
            return Ok(self.proposal_or_exact(gap, site));
        }
        // Nothing that was met will do: take in what comes before and after it on the boundary.
        while seen.len() < WIDEST {
            self.widen(gap, seen);
            if seen.len() == std::mem::replace(known, seen.len()) {
                break;
            }
            if let Some(site) = self.exact_first(gap, seen) {
                return Ok(self.proposal_or_exact(gap, site));
            }
        }
        *known = usize::MAX;
        *seen = self.everything(gap).into();
        match self.exact_first(gap, seen) {
            Some(site) => Ok(self.proposal_or_exact(gap, site)),
            None => Err(self.broken(gap)),
        }
    }

    /// Adds the neighbours along the boundary of some sites.
    fn widen(&self, gap: &Gap, sites: &mut Met) {
        for k in 0..sites.len() {
            for site in [self.domain.ahead(sites[k]), self.domain.behind(sites[k])] {
                if self.may_be_met(gap, site) {
                    sites.insert(site);
                }
            }
        }
    }

    /// All sites that the path can meet.
    fn everything(&self, gap: &Gap) -> Vec<Site> {
        let all = self.domain.sites_among(self.tree.items());
        all.filter(|&s| self.may_be_met(gap, s)).collect()
    }

    /// All sites of the walks that some of them lie on.
    fn on_walks_of(&self, sites: &[Site]) -> Vec<Site> {
        let walks: BTreeSet<u32> = sites.iter().map(|s| self.domain.edge(s.index()).walk).collect();
        let edges = walks.into_iter().flat_map(|walk| self.domain.walks()[walk as usize].edges());
        self.domain.sites_among(edges).collect()
    }

    /// Whether a site is not banned and lies on a part of the boundary that is ahead.
    fn may_be_met(&self, gap: &Gap, site: Site) -> bool {
        // A corner may end the part ahead.
        let edge = site.index();
        let ahead =
            |f: Front| f.holds(edge) || !site.is_edge() && f.holds(self.domain.edge(edge).prev);
        gap.front.is_none_or(ahead) && !self.banned.contains(&site)
    }

    /// The certified disk of a triple, and the exact one where doubles would not certify.
    fn certify(
        &self,
        triple: &[Site; 3],
        guess: &TouchingDisk,
    ) -> Option<(TouchingDisk, Option<ExactDisk>)> {
        let governors = self.domain.governors(*triple);
        let exact = match guess.certified(&governors) {
            Some(disk) if disk.bound <= POOR * disk.radius => return Some((disk, None)),
            // Edges by the thousand may be in doubt about a disk that is off by more than its radius.
            Some(disk) => self.certified(triple, &disk),
            None => self.exact(triple)?,
        };
        Some((exact.rounded(), Some(exact)))
    }

    /// The exact disk of a triple that was certified.
    pub fn certified(&self, triple: &[Site; 3], disk: &TouchingDisk) -> ExactDisk {
        let elements = triple.map(|s| self.domain.element(s));
        match self.pinned(triple).filter(Pinned::is_precise) {
            Some(disk) => ExactDisk::of_pinned(elements, &disk),
            None => ExactDisk::of_certified(elements, disk),
        }
    }

    /// The disk of three edges relative to a circle near them, if the tree has such circles.
    pub fn pinned(&self, triple: &[Site; 3]) -> Option<Pinned> {
        let [a, b, c] = *triple;
        if !(a.is_edge() && b.is_edge() && c.is_edge()) {
            return None;
        }
        let rim = |s: Site| self.tree.rim(s.index());
        Pinned::touching([rim(a)?, rim(b)?, rim(c)?])
    }

    /// The exact disk of a triple; `None` if there is none, or its radius is zero.
    pub fn exact(&self, triple: &[Site; 3]) -> Option<ExactDisk> {
        if let Some(disk) = self.pinned(triple).filter(Pinned::is_precise) {
            return Some(ExactDisk::of_pinned(triple.map(|s| self.domain.element(s)), &disk));
        }
        let disk = ExactDisk::new(triple.map(|s| self.domain.element(s)))?;
        // Three edges may end at one point; their disk has its centre on each of them.
        let (edge, all_edges) = (triple[0].index(), triple.iter().all(|s| s.is_edge()));
        let zero = || disk.front(self.domain.edge(edge).start, self.domain.end(edge)).is_eq();
        (!all_edges || !zero()).then_some(disk)
    }

    fn proposal_or_exact(&self, gap: &Gap, site: Site) -> Option<Proposal> {
        let triple = gap.triple(site);
        let disk = self.exact(&triple)?.rounded();
        Some(Proposal { site, disk, position: gap.course(self.domain).position(&disk) })
    }

    /// What an edge is to an exact disk; the governors themselves are not asked.
    pub fn touch(&self, disk: &ExactDisk, edge: u32, seen: Seen) -> Touch {
        touch(self.domain, disk, edge, seen)
    }
}

/// Contacts strictly between the left and the right governor at the back of an arriving path.
pub(super) fn contact_behind(contacts: &[Site], right: Site, left: Site) -> Option<Vec<Site>> {
    let n = contacts.len();
    let at = |s: Site| contacts.iter().position(|&c| c == s);
    let (l, r) = (at(left)?, at(right)?);
    let between = (r + n - l) % n;
    // Directly after the left governor comes the right one, or pieces of the same contact run.
    (between > 1).then(|| (1..between).map(|k| contacts[(l + k) % n]).collect())
}
