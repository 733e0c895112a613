use std::cmp::Ordering;

use smallvec::SmallVec;

use super::chain::{Passed, first_piece_cut, start_after};
use super::contacts::{self, Contacts};
use super::front::scope;
use super::search::{Gap, Proposal, SLACK, Search, Start};
use super::touch::{Seen, Touch};
use crate::domain::{Corner, Domain, Edge, Site, Walk};
use crate::geom::predicates::ExactDisk;
use crate::geom::{Hidden, LEAF, Look, Pinned, Point, Scope, TouchingDisk, U};

/// Doubtful edges up to which a disk is not made more precise for them.
const FEW: usize = 2;

/// Doubtful edges of one disk from which the boundary is taken to follow disks inside it.
const CROWD: usize = 32;

/// What became of a disk.
#[derive(Clone, Debug)]
pub(super) enum Verdict {
    /// Empty, and every governor is touched in its zone: all contacts, counterclockwise.
    Clear(Contacts),
    /// Something cuts it, and this comes earlier on the path.
    Better(Proposal),
    /// This site cuts it, exactly.
    Earlier(Site),
    /// Some of these sites cut it, or stand where a governor of the path ends.
    Cut(Vec<Site>),
    /// The third governor is touched beyond its end.
    OffEdge,
}

/// Edges that cut a disk after which it is given up.
const MANY_CUT: usize = 64;

/// Share of the radius of a proposal by which all that clearly cuts it does so.
const CLEAR: f64 = 0.999 * SLACK;

/// An edge that cuts a disk.
#[derive(Clone, Copy, Debug, Default)]
struct Cutting {
    edge: u32,
    /// Which part is nearest: its start if negative, its end if positive, or the edge itself.
    near: i8,
    /// About where on the path it is met, from 0 at the start to 1 at the disk.
    share: f64,
}

/// One walk through the tree with one disk.
pub(super) struct Verify<'s, 'a> {
    search: &'s Search<'a>,
    /// The path, and the piece of it that the disk looked into belongs to.
    gap: &'s Gap,
    /// That piece, if it is not the last one.
    earlier: Option<Gap>,
    /// Pieces of the path before, which follow the empty disk.
    passed: &'s [Passed],
    /// Number of the piece: that of the one after all passed, at first.
    link: usize,
    /// The empty disk at the start of all.
    anchor: &'s Start,
    /// Sites of the certified disk.
    triple: [Site; 3],
    certified: TouchingDisk,
    /// The disk that is looked into: the certified one, or a better proposal.
    disk: TouchingDisk,
    best: Option<Proposal>,
    /// Whether the disk looked into is only a proposal.
    hunting: bool,
    /// Whether doubles may propose.
    floating: bool,
    scope: Scope,
    cut: SmallVec<[u32; 8]>,
    /// Edges of the present leaf that cut, and which part of each is nearest.
    cutting: [Cutting; LEAF],
    n_cutting: usize,
    doubtful: SmallVec<[u32; 8]>,
    /// The certified disk as precisely as it can be had, once many edges may touch it.
    pinned: Option<Pinned>,
    /// What is looked into while it is only a proposal.
    hunted: Option<Pinned>,
    /// An edge that certainly cuts the sharp disk. Then that is the disk of this edge, which comes earlier.
    nearer: Option<u32>,
}

impl<'s, 'a> Verify<'s, 'a> {
    /// Looks for anything that cuts the certified disk of a triple, at the end of several pieces of a
    /// path, the last of which is `gap`; `anchor` is the empty disk at the start of the first one.
    #[inline(always)]
    pub fn certified(
        search: &'s Search<'a>,
        gap: &'s Gap,
        (anchor, passed): (&'s Start, &'s [Passed]),
        triple: [Site; 3],
        disk: TouchingDisk,
        floating: bool,
    ) -> Self {
        Self {
            search,
            gap,
            earlier: None,
            passed,
            link: passed.len(),
            anchor,
            triple,
            certified: disk,
            disk,
            best: None,
            hunting: false,
            floating,
            scope: scope(anchor.centre, anchor.radius, anchor.doubt, &disk),
            cut: SmallVec::new(),
            cutting: [Cutting::default(); LEAF],
            n_cutting: 0,
            doubtful: SmallVec::new(),
            pinned: None,
            hunted: None,
            nearer: None,
        }
    }

    /// The certified disk relative to a circle near it, where that is known already.
    #[inline]
    pub fn pin(&mut self, disk: Option<Pinned>) {
        self.pinned = disk;
    }

    /// Looks for the first proposal within an uncertified disk of the path.
    pub fn hunting(
        search: &'s Search<'a>,
        gap: &'s Gap,
        start: (&'s Start, &'s [Passed]),
        disk: TouchingDisk,
    ) -> Self {
        let triple = [gap.right, gap.right, gap.left];
        let mut verify = Self::certified(search, gap, start, triple, disk, true);
        verify.look_into(disk);
        verify
    }

    /// The piece of the path that the best proposal lies on.
    pub fn link(&self) -> usize {
        self.link
    }

    /// The best proposal met.
    pub fn best(&self) -> Option<Proposal> {
        self.best
    }

    /// Whether anything met cuts the first disk looked into.
    pub fn is_cut(&self) -> bool {
        !self.cut.is_empty()
    }

    pub fn run(&mut self) {
        let hidden = self.gap.front.map_or(Hidden::default(), |f| f.hidden());
        let search = self.search;
        search.count_visit(search.tree.visit(hidden, self));
    }

    /// Looks at the edges of one walk only.
    pub fn look_at(&mut self, walk: &Walk) {
        let end = walk.first + walk.len;
        for first in (walk.first..end).step_by(LEAF) {
            for edge in first..end.min(first + LEAF as u32) {
                self.edge(edge);
            }
            self.leaf();
        }
    }

    /// Looks into a disk that is only a proposal from now on.
    fn look_into(&mut self, disk: TouchingDisk) {
        self.hunting = true;
        self.disk = disk;
        self.hunted = None;
        let start = self.anchor;
        self.scope = scope(start.centre, start.radius, start.doubt, &disk);
        self.scope.reach -= CLEAR * disk.radius;
    }

    /// Takes note of an edge that cuts the disk looked into; `near` tells which part of it is nearest:
    /// its start if negative, its end if positive, or the edge itself.
    fn cuts(&mut self, edge: u32, near: i8) {
        if !self.floating {
            self.cut.push(edge);
            self.give_up_on_many();
            return;
        }
        self.cutting[self.n_cutting] = Cutting { edge, near, share: 0.0 };
        self.n_cutting += 1;
    }

    /// Ends the walk where many edges cut the disk and none of them makes a proposal: the disk is far too
    /// large.
    fn give_up_on_many(&mut self) {
        if self.best.is_none() && self.cut.len() >= MANY_CUT {
            self.scope.reach = 0.0;
        }
    }

    /// Proposes an end with an edge that cuts the disk looked into, and looks into that one from now
    /// on; tells whether it does.
    fn shrink(&mut self, edge: u32, near: i8) -> bool {
        self.cut.push(edge);
        let (search, link) = (self.search, self.link);
        let went_back = link > 0 && self.go_back(edge);
        let gap = self.earlier.as_ref().unwrap_or(self.gap);
        let last = if went_back { &self.passed[self.link].disk } else { &self.disk };
        if let Some(p) = search.proposal_before(gap, &self.disk, last, edge, near) {
            self.best = Some(p);
            self.look_into(p.disk);
            return true;
        }
        if went_back {
            // It cuts an earlier disk, but no proposal comes of it.
            self.link = link;
            self.earlier = (link < self.passed.len()).then(|| self.piece(link));
        }
        self.give_up_on_many();
        false
    }

    /// Takes the edges of a leaf that cut, the one first that looks as if it were met first.
    #[inline(never)]
    fn shrink_by_leaf(&mut self) {
        let mut cutting = self.cutting;
        let cutting = &mut cutting[..std::mem::take(&mut self.n_cutting)];
        let domain = self.search.domain;
        if cutting.len() > 1 {
            for cut in &mut *cutting {
                cut.share = share(domain, self.anchor, &self.disk, cut.edge, cut.near);
            }
            cutting.sort_unstable_by(|a, b| a.share.total_cmp(&b.share));
        }
        let mut shrunk = false;
        for &mut Cutting { edge, near, .. } in cutting {
            if !shrunk {
                shrunk = self.shrink(edge, near);
                continue;
            }
            let record = domain.edge(edge);
            if let Some(near) = clear_cut(&self.disk, record.start, || domain.end(edge), record) {
                self.shrink(edge, near);
            }
        }
    }

    /// Decides about an edge by the sharp disk, if there is one, and goes on with an earlier one where
    /// that is cut within the ends of the edge; tells whether it could.
    fn sharpen(&mut self, edge: u32, near: i8, x: f64, doubt: f64) -> bool {
        let (search, link) = (self.search, self.passed.len());
        let Some(disk) = self.pinned.filter(Pinned::is_solved) else { return false };
        let Some((rim, k)) = search.tree.rim(edge) else { return false };
        let (rest, error) = rim.rest(k, &disk);
        if rest > error {
            return true;
        }
        let record = search.domain.edge(edge);
        let within = near == 0 && x > doubt && x < record.length * (1.0 - 8.0 * U) - doubt;
        // From behind, where another component touches, the distance counts the other way round.
        let d = &self.certified;
        let in_front = record.direction.cross(d.centre - (record.start - d.origin)) > doubt;
        if rest >= -error
            || !within
            || !in_front
            || self.link != link
            || !search.may_be_third(self.gap, Site::edge(edge))
        {
            return false;
        }
        let triple = [self.triple[0], Site::edge(edge), self.triple[2]];
        let Some(earlier) = search.pinned(&triple) else { return false };
        self.pinned = Some(earlier);
        self.nearer = Some(edge);
        true
    }

    /// A piece of the path that was passed.
    fn piece(&self, link: usize) -> Gap {
        let Passed { right, left, .. } = self.passed[link];
        let start = start_after(&self.passed[..link], self.anchor);
        Gap::new(right, left, start, self.gap.front)
    }

    /// Goes back to the first piece of the path whose end an edge cuts, if that is an earlier one.
    fn go_back(&mut self, edge: u32) -> bool {
        let first = first_piece_cut(self.search.domain, &self.passed[..self.link], edge);
        if first == self.link {
            return false;
        }
        self.earlier = Some(self.piece(first));
        self.link = first;
        true
    }

    /// Whether a corner governor stands at an end of the edge, and at which.
    fn end_at_governor(&self, edge: u32) -> Option<bool> {
        let next = self.search.domain.edge(edge).next;
        self.triple.iter().find_map(|&s| {
            if s.is_edge() {
                None
            } else if s.index() == edge {
                Some(true)
            } else if s.index() == next {
                Some(false)
            } else {
                None
            }
        })
    }

    /// The verdict on the certified disk, once the walk is done; `exact` is the same disk exactly, if
    /// anybody has it or needs it.
    pub fn verdict(&self, exact: &mut Option<ExactDisk>) -> Verdict {
        let search = self.search;
        if let Some(best) = self.best {
            return Verdict::Better(best);
        }
        if !self.cut.is_empty() {
            return Verdict::Cut(
                self.cut.iter().flat_map(|&k| search.sites_of(k)).flatten().collect(),
            );
        }
        let mut contacts = Contacts::new();
        let domain = search.domain;
        let of_certified = || match self.pinned.filter(Pinned::is_precise) {
            Some(disk) => ExactDisk::of_pinned(self.triple.map(|s| domain.element(s)), &disk),
            None => search.certified(&self.triple, &self.certified),
        };
        // The three sites themselves, each touched within its zone.
        for (role, &site) in self.triple.iter().enumerate() {
            if !site.is_edge() {
                if domain.edge(site.index()).corner == Corner::Reflex {
                    contacts.push(site);
                }
                continue;
            }
            let edge = site.index();
            let next = domain.edge(edge).next;
            let corner_at = |k: u32| self.triple.contains(&Site::corner(k));
            let (at_start, at_end) = if corner_at(edge) {
                (Ordering::Equal, Ordering::Less)
            } else if corner_at(next) {
                (Ordering::Greater, Ordering::Equal)
            } else {
                let Seen { start, end, .. } = self.seen(edge);
                match (start, end) {
                    (Some(s), Some(e)) => (s, e),
                    _ => {
                        let (a, b) = (domain.edge(edge).start, domain.end(edge));
                        let disk = exact.get_or_insert_with(of_certified);
                        let ask = |p| disk.along(a, b, p);
                        (start.unwrap_or_else(|| ask(a)), end.unwrap_or_else(|| ask(b)))
                    }
                }
            };
            if at_start == Ordering::Less || at_end == Ordering::Greater {
                return match (role, at_end) {
                    (0, Ordering::Greater) => Verdict::Cut(vec![domain.ahead(site)]),
                    (2, _) if at_start == Ordering::Less => Verdict::Cut(vec![domain.behind(site)]),
                    _ => Verdict::OffEdge,
                };
            }
            contacts.push(site);
            let reflex = |k: u32| domain.edge(k).corner == Corner::Reflex;
            for (side, corner) in [(at_start, edge), (at_end, next)] {
                if side == Ordering::Equal && reflex(corner) && !corner_at(corner) {
                    contacts.push(Site::corner(corner));
                }
            }
        }
        if let Some(edge) = self.nearer {
            return Verdict::Earlier(Site::edge(edge));
        }
        if !self.doubtful.is_empty() {
            let exact = exact.get_or_insert_with(of_certified);
            if self.doubtful.len() > FEW {
                exact.sharpen();
            }
        }
        // Of nearly equal disks the smallest: each one that cuts the present one replaces it.
        let mut earlier: Option<(Site, ExactDisk)> = None;
        for &edge in &self.doubtful {
            if search.watch.is_over() {
                return Verdict::OffEdge;
            }
            let (disk, seen) = match (&earlier, &*exact) {
                (Some((_, disk)), _) => (disk, Seen::default()),
                (None, Some(disk)) => (disk, self.seen(edge)),
                (None, None) => return Verdict::OffEdge,
            };
            match search.touch(disk, edge, seen) {
                Touch::Clear => {}
                Touch::Cut(part) => {
                    let triple = [self.triple[0], part, self.triple[2]];
                    let third = if search.may_be_third(self.gap, part) {
                        search.exact(&triple)
                    } else {
                        None
                    };
                    let Some(third) = third else { return Verdict::Earlier(part) };
                    earlier = Some((part, third));
                }
                Touch::Contact { edge: on_edge, corner } => {
                    contacts.extend(on_edge.then_some(Site::edge(edge)));
                    contacts.extend(corner);
                }
            }
        }
        if let Some((site, _)) = earlier {
            return Verdict::Earlier(site);
        }
        contacts::sort(domain, &self.certified, exact.as_ref(), &self.triple, &mut contacts);
        Verdict::Clear(contacts)
    }

    /// Where the certified centre lies to an edge, as far as doubles can tell.
    fn seen(&self, edge: u32) -> Seen {
        let domain = self.search.domain;
        let direction = domain.edge(edge).direction;
        let from = |p: Point| {
            let a = p - self.certified.origin;
            let q = self.certified.centre - a;
            (q, self.certified.doubt(a, q))
        };
        let sign = |x: f64, doubt: f64| {
            (x.abs() > doubt).then_some(if x > 0.0 { Ordering::Greater } else { Ordering::Less })
        };
        let (q, doubt) = from(domain.edge(edge).start);
        let (to_end, doubt_at_end) = from(domain.end(edge));
        Seen {
            start: sign(direction.dot(q), doubt),
            end: sign(direction.dot(to_end), doubt_at_end),
            front: sign(direction.cross(q), doubt),
        }
    }
}

/// About the share of the way to a disk after which an edge that cuts it is met: that of the disk
/// through the edge's nearest point in the pencil of the disk at the start and this one.
#[inline(always)]
pub(super) fn share(
    domain: &Domain,
    start: &Start,
    disk: &TouchingDisk,
    edge: u32,
    near: i8,
) -> f64 {
    let record = domain.edge(edge);
    let point = match near {
        ..0 => record.start,
        0 => {
            let way = disk.centre - (record.start - disk.origin);
            record.start + record.direction * record.direction.dot(way)
        }
        1.. => domain.end(edge),
    };
    let outside = (point - start.centre).norm2() - start.radius * start.radius;
    let inside = disk.radius * disk.radius - (disk.centre - (point - disk.origin)).norm2();
    outside / (outside + inside)
}

/// Whether an edge clearly cuts a disk, by more than what merely touches can be off.
pub(super) fn cuts_clearly(disk: &TouchingDisk, a: Point, b: Point, edge: &Edge) -> bool {
    clear_cut(disk, a, || b, edge).is_some()
}

/// Which part of an edge is nearest to the centre, if it clearly cuts the disk: its start if negative,
/// its end if positive, or the edge itself.
#[inline(always)]
pub(super) fn clear_cut(
    disk: &TouchingDisk,
    a: Point,
    b: impl FnOnce() -> Point,
    edge: &Edge,
) -> Option<i8> {
    let q = disk.centre - (a - disk.origin);
    let clear = disk.radius * (1.0 - SLACK);
    let limit = clear * clear;
    let across = edge.direction.cross(q);
    if across * across >= limit {
        return None;
    }
    let x = edge.direction.dot(q);
    if x <= 0.0 {
        (q.norm2() < limit).then_some(-1)
    } else if x >= edge.length {
        ((disk.centre - (b() - disk.origin)).norm2() < limit).then_some(1)
    } else {
        Some(0)
    }
}

impl Look for Verify<'_, '_> {
    #[inline]
    fn leaf(&mut self) {
        if self.n_cutting > 0 {
            self.shrink_by_leaf();
        }
        if self.doubtful.len() > CROWD {
            self.search.follow_rims();
        }
    }

    #[inline]
    fn scope(&self) -> &Scope {
        &self.scope
    }

    #[inline]
    fn near(&self) -> u32 {
        self.gap.left.index()
    }

    #[inline]
    fn pinned(&mut self) -> Option<&Pinned> {
        if self.hunting {
            let disk = &self.disk;
            // Only what clearly cuts it counts.
            let bound = -CLEAR * disk.radius;
            let hunted = || Pinned::from(&TouchingDisk { bound, ..*disk });
            return Some(self.hunted.get_or_insert_with(hunted));
        }
        Some(self.pinned.get_or_insert_with(|| {
            self.search.pinned(&self.triple).unwrap_or_else(|| Pinned::from(&self.certified))
        }))
    }

    #[inline]
    fn edge(&mut self, edge: u32) {
        let domain = self.search.domain;
        let site = Site::edge(edge);
        let gap = self.earlier.as_ref().unwrap_or(self.gap);
        if site == gap.right || site == gap.left {
            return;
        }
        let record = domain.edge(edge);
        let d = self.disk;
        if self.hunting {
            let next = record.next;
            let own = |s: Site| !s.is_edge() && (s.index() == edge || s.index() == next);
            if let Some(near) = clear_cut(&d, record.start, || domain.end(edge), record)
                && !own(gap.right)
                && !own(gap.left)
            {
                self.cuts(edge, near);
            }
            return;
        }
        let a = record.start - d.origin;
        let q = d.centre - a;
        let x = record.direction.dot(q);
        if site == self.triple[1] {
            return;
        }
        let doubt = self.certified.doubt(a, q);
        if let Some(at_start) = self.end_at_governor(edge) {
            // The nearest point is at most the corner itself: only its wall counts.
            let b = domain.end(edge) - d.origin;
            let x = if at_start { x } else { -record.direction.dot(d.centre - b) };
            if x > doubt {
                self.cuts(edge, 0);
            } else if x >= -doubt {
                self.doubtful.push(edge);
            }
            return;
        }
        let (distance, near) = if x <= 0.0 {
            (q.norm(), -1)
        } else if x >= record.length {
            ((d.centre - (domain.end(edge) - d.origin)).norm(), 1)
        } else {
            (record.direction.cross(q).abs(), 0)
        };
        if distance > d.radius + doubt {
        } else if distance < d.radius - doubt {
            self.cuts(edge, near);
        } else if !self.sharpen(edge, near, x, doubt) {
            self.doubtful.push(edge);
        }
    }
}
