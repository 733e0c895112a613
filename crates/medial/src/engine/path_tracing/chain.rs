//! Follows a path over many transitions with one query.
//!
//! # Contract
//! [`Search::chase`] gives the transitions of a path and the keypoint after them, all of them
//! proved; or nothing, and then [`Search::find`] must take the path one keypoint at a time.
//!
//! # Method
//! 1. From an empty disk, follow the two boundary chains of the governors: which of the two leaves
//!    first is decided by the zone of the other one, in doubles with a bound, else exactly.
//! 2. Where the boundary turns left, or the radius has grown, the disk there is looked into.
//! 3. If something cuts it, go back while the disks passed are cut as well; what cuts is then the
//!    third governor of an earlier disk, and that one is looked into.
//!
//! Two empty disks, their spokes, and the pieces of the chains between their footpoints close a
//! pocket. The chains turn right only, so inside the pocket the axis is their bisector, and only a
//! whole ring could change it ([`super::rings`]).
//!
//! # Departures
//! The paper looks for every transition by itself [JPV, §3.1].

use std::cmp::Ordering;

use super::contacts::follows;
use super::front::Front;
use super::rings::Round;
use super::search::{Before, Found, Gap, Proposal, SLACK, Search, Start};
use super::verify::cuts_clearly;
use crate::domain::{Corner, Domain, Edge, Site};
use crate::geom::predicates::{First, Leaving, two_ends};
use crate::geom::{Point, TouchingDisk, U, Unsure};

/// Transitions after which the disk is looked into, however little the radius grows.
const LONGEST: usize = 32;

/// Growth of the radius after which the disk is looked into.
pub(super) const GROWTH: f64 = 2.0;

/// Growth of the radius in one step before which a smaller disk is looked into first.
pub(super) const LEAP: f64 = 4.0;

/// Elements to either side that are tried where a disk is far away.
const FEW: usize = 3;

/// Way, in lengths of the edges there, beyond which the next elements are tried as well.
const FAR: f64 = 3.0;

/// Bound of a disk, as a share of its radius, above which exact arithmetic rounds it: what it leaves in
/// doubt would be asked of exact arithmetic one by one.
pub(super) const POOR: f64 = 1e-9;

/// The same for a disk that is known relative to a circle near it: towards edges near its governors it is
/// known far better than its bound tells.
pub(super) const POOR_RELATIVE: f64 = 1e-7;

/// A transition that was passed.
#[derive(Clone, Debug)]
pub(super) struct Passed {
    /// Governors of the path that ends here.
    pub right: Site,
    pub left: Site,
    pub disk: TouchingDisk,
    /// All governors, counterclockwise; the last one repeated if there are three.
    pub contacts: [Site; 4],
    pub n_contacts: u8,
    /// Whether the disk is fixed by its governors, and not by the way it was found.
    pub fixed: bool,
}

/// Where a piece of a path starts, after that many transitions; `anchor` is the start of the path.
pub(super) fn start_after(passed: &[Passed], anchor: &Start) -> Start {
    passed.last().map_or(*anchor, |last| Start::at(&last.disk))
}

/// Number of the first piece of a path whose end an edge clearly cuts, as do the ends of all later ones:
/// that after the last transition if it cuts none.
pub(super) fn first_piece_cut(domain: &Domain, passed: &[Passed], edge: u32) -> usize {
    let record = domain.edge(edge);
    let (a, b) = (record.start, domain.end(edge));
    let clear = |p: &Passed| !cuts_clearly(&p.disk, a, b, record);
    passed.iter().rposition(clear).map_or(0, |k| k + 1)
}

/// What happens next on a path.
#[derive(Clone, Copy, Debug)]
struct Event {
    disk: TouchingDisk,
    /// What is met, or governs in the place of a governor that leaves.
    site: Site,
    /// Whether a governor leaves, on the normal at its end; else the boundary turns left, and the edge
    /// beyond the corner is met.
    leaves: bool,
}

/// Where a governor of a path leaves: on the normal of an edge at a point, where the site takes over.
#[derive(Clone, Copy, Debug)]
struct Normal {
    edge: u32,
    at: Point,
    site: Site,
}

/// How one governor of a path ends.
#[derive(Clone, Copy, Debug)]
enum Ending {
    /// On a normal.
    Normal(Normal),
    /// In a convex corner, before which this edge is met.
    Turn { edge: u32 },
}

/// Where a disk of the path lies to the end of a governor.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Reach {
    /// The governor has not left yet.
    Within,
    /// It leaves here, as far as doubles can tell.
    Level,
    /// It left before.
    Past,
}

impl Search<'_> {
    /// The end of the path that leaves `start` between `right` and `left`, with what it passes on
    /// the way in `self.passed`; `None` if doubles and a few exact questions cannot tell.
    pub fn chase(
        &mut self,
        right: Site,
        left: Site,
        start: Start,
        before: Option<Before<'_>>,
    ) -> Option<Found> {
        self.passed.clear();
        self.from_holes = false;
        if self.runs_into_corner(right, left) {
            return self.ends_in_corner(right, left, start);
        }
        self.banned.clear();
        let front = Front::new(self.domain, right, left);
        let (mut r, mut l) = (right, left);
        let mut here = start;
        let sizes = [right, left].map(|s| {
            if s.is_edge() { self.domain.edge(s.index()).length / 2.0 } else { f64::INFINITY }
        });
        let least = sizes[0].min(sizes[1]);
        let known = if least.is_finite() { start.radius.max(least) } else { start.radius };
        loop {
            if self.runs_into_corner(r, l) {
                return self.ends_in_corner(r, l, start);
            }
            let gap = Gap::new(r, l, here, front);
            if let Some(before) = before
                && let Some(known) = self.known_end(&gap, start, before)
            {
                self.link = (r, l);
                return Some(Found::Known(known));
            }
            let event = self.next_event(&gap);
            if let Ok(Some(Event { disk, site, leaves: true })) = event
                && disk.radius <= GROWTH * known
                && self.passed.len() < LONGEST
                && self.behind.is_empty()
                && !self.may_turn_back(&gap, &disk)
                && (!self.is_far(&gap, &disk) || self.next_elements(&gap, &disk).is_none())
            {
                (r, l) = self.pass(r, l, disk, site);
                here = Start::at(&disk);
                continue;
            }
            if event.is_err() && self.passed.is_empty() {
                return None;
            }
            // Beyond a transition the edges at the start tell nothing.
            let known = if self.passed.is_empty() { known } else { here.radius };
            return self.end_chain(start, &gap, event, known);
        }
    }

    /// The end of a path whose next event is none that can be passed.
    #[inline(never)]
    fn end_chain(
        &mut self,
        anchor: Start,
        gap: &Gap,
        event: Result<Option<Event>, Unsure>,
        known: f64,
    ) -> Option<Found> {
        let front = gap.front;
        let endless = matches!(event, Ok(None));
        let event = event.unwrap_or(None);
        let cut = |disk: &TouchingDisk| {
            self.behind.iter().any(|&e| {
                let edge = self.domain.edge(e);
                cuts_clearly(disk, edge.start, self.domain.end(e), edge)
            })
        };
        let doubted = self.passed.last().is_some_and(|last| event.is_none() || cut(&last.disk));
        let crossing = |last: &Passed| last.n_contacts == 4 && !cut(&last.disk);
        self.link = (gap.right, gap.left);
        if endless && self.passed.last().is_some_and(crossing) {
            // Out of a corridor whose sides end at once: what lies across it comes next.
            if let Some(end) = self.approach(anchor, gap, None, gap.start.radius) {
                return self.settle_chain(anchor, front, end);
            }
        }
        if doubted {
            // The last transition passed is none: something cuts its disk.
            if let Some(last) = self.passed.pop() {
                self.link = (last.right, last.left);
                // The second of its contacts is new, on whatever side.
                let end = Proposal { site: last.contacts[1], disk: last.disk, position: 0.0 };
                return self.settle_chain(anchor, front, end);
            }
        }
        let mut end = event.map(|Event { disk, site, .. }| Proposal {
            site,
            disk,
            position: gap.course(self.domain).position(&disk),
        });
        if end.is_none_or(|e| e.disk.radius > LEAP * known) {
            end = self.approach(anchor, gap, end, known);
        }
        if let Some(Proposal { disk, .. }) = end
            && self.link == (gap.right, gap.left)
            && self.is_far(gap, &disk)
            && let Some(nearer) = self.next_elements(gap, &disk)
        {
            end = Some(nearer);
        }
        self.settle_chain(anchor, front, end?)
    }

    /// The nearest keypoint ahead that waits for a path between these governors, if no ring lies
    /// before it.
    ///
    /// Both disks are empty and touch both governors, whose footpoints move on from one to the other:
    /// so this is the path between them, unless a whole ring lies in its pocket.
    #[inline(never)]
    fn known_end(&self, gap: &Gap, anchor: Start, before: Before<'_>) -> Option<u32> {
        let mut nearest: Option<(u32, TouchingDisk, f64)> = None;
        for keypoint in before.gaps.keypoints(gap.left, gap.right) {
            let disk = before.traced.disk(keypoint);
            let position = gap.course(self.domain).position(&disk);
            if position > disk.bound + gap.start.doubt + 64.0 * U * self.largest
                && nearest.is_none_or(|n| position < n.2)
            {
                nearest = Some((keypoint, disk, position));
            }
        }
        let (keypoint, disk, _) = nearest?;
        let advances = self.advances(gap, &disk, 1.0)
            && self.advances(gap, &disk, -1.0)
            && !self.may_turn_back(gap, &disk);
        (advances && self.is_open(gap.right, gap.left, anchor, Round::disk(&disk)))
            .then_some(keypoint)
    }

    /// The end of a path in the convex corner between its governors, if no ring lies before it.
    #[inline]
    fn ends_in_corner(&mut self, right: Site, left: Site, anchor: Start) -> Option<Found> {
        self.link = (right, left);
        let end = Round::corner(self.domain.edge(left.index()).start);
        self.may_be_open(right, left, anchor, end).then_some(Found::Corner(left.index()))
    }

    /// Whether a disk of the path is many edges away.
    #[inline(always)]
    fn is_far(&self, gap: &Gap, disk: &TouchingDisk) -> bool {
        let length = |s: Site| self.domain.edge(s.index()).length;
        let local = length(gap.right).min(length(gap.left));
        let way = disk.centre + (disk.origin - gap.start.centre);
        way.norm2() > (FAR * local) * (FAR * local)
    }

    /// A nearer disk than one of the path that the next elements of the boundary propose.
    #[inline(never)]
    fn next_elements(&self, gap: &Gap, disk: &TouchingDisk) -> Option<Proposal> {
        let mut disk = *disk;
        let mut best: Option<Proposal> = None;
        let (mut ahead, mut behind) = (gap.right, gap.left);
        for _ in 0..FEW {
            (ahead, behind) = (self.domain.ahead(ahead), self.domain.behind(behind));
            for site in [ahead, behind] {
                // What is met before a disk of the path cuts that disk.
                if !self.reaches_into(site, &disk) {
                    continue;
                }
                let nearest =
                    best.map_or_else(|| gap.course(self.domain).position(&disk), |b| b.position);
                if let Some(p) = self.propose(gap, site)
                    && p.position < nearest * (1.0 - SLACK)
                    && p.position > 0.0
                {
                    disk = p.disk;
                    best = Some(p);
                }
            }
        }
        best
    }

    /// Whether a corner, or an edge between its ends, reaches into a disk.
    #[inline]
    fn reaches_into(&self, site: Site, disk: &TouchingDisk) -> bool {
        let edge = self.domain.edge(site.index());
        let q = disk.centre - (edge.start - disk.origin);
        let limit = disk.radius * disk.radius;
        if !site.is_edge() {
            return q.norm2() < limit;
        }
        let along = edge.direction.dot(q);
        let across = edge.direction.cross(q);
        across * across < limit && along > 0.0 && along < edge.length
    }

    #[inline(always)]
    fn ending_right(&self, r: Site) -> Option<Ending> {
        let k = r.index();
        if !r.is_edge() {
            return Some(Ending::Normal(Normal {
                edge: k,
                at: self.domain.edge(k).start,
                site: Site::edge(k),
            }));
        }
        let next = self.domain.edge(k).next;
        let beyond = self.domain.edge(next);
        match beyond.corner {
            Corner::Reflex => {
                Some(Ending::Normal(Normal { edge: k, at: beyond.start, site: Site::corner(next) }))
            }
            Corner::Convex => Some(Ending::Turn { edge: next }),
            Corner::Straight => None,
        }
    }

    #[inline(always)]
    fn ending_left(&self, l: Site) -> Option<Ending> {
        let k = l.index();
        let edge = self.domain.edge(k);
        if !l.is_edge() {
            return Some(Ending::Normal(Normal {
                edge: edge.prev,
                at: edge.start,
                site: Site::edge(edge.prev),
            }));
        }
        match edge.corner {
            Corner::Reflex => {
                Some(Ending::Normal(Normal { edge: k, at: edge.start, site: Site::corner(k) }))
            }
            Corner::Convex => Some(Ending::Turn { edge: edge.prev }),
            Corner::Straight => None,
        }
    }

    /// The disk in which a governor leaves while `other` stays, if it ever leaves.
    #[inline(always)]
    fn leave(&self, normal: Normal, other: Site) -> Result<Option<Event>, Unsure> {
        let direction = self.domain.edge(normal.edge).direction;
        let other = self.domain.governor(other);
        let disk = TouchingDisk::on_normal(normal.at, direction, &other, self.largest)?;
        Ok(disk.map(|disk| Event { disk, site: normal.site, leaves: true }))
    }

    /// A proposal for the disk that meets the edge beyond a convex corner at an end of the right
    /// governor, or of the left one, if it lies ahead.
    #[inline(always)]
    fn meet(&mut self, gap: &Gap, edge: u32, on_right: bool) -> Option<Event> {
        let beyond = self.domain.edge(edge);
        let (v, incoming, outgoing, other) = if on_right {
            let before = self.domain.edge(gap.right.index());
            (beyond.start, before.direction, beyond.direction, gap.left)
        } else {
            let after = self.domain.edge(gap.left.index());
            (after.start, beyond.direction, after.direction, gap.right)
        };
        let site = Site::edge(edge);
        let other = self.domain.governor(other);
        let disk = TouchingDisk::in_corner(v, incoming, outgoing, &other)?;
        if disk.radius > self.largest {
            return None;
        }
        let ahead = gap.course(self.domain).position(&disk) > 0.0;
        if !ahead {
            self.behind.push(edge);
        }
        ahead.then_some(Event { disk, site, leaves: false })
    }

    /// Where a certified disk ahead lies to the normal on which a governor leaves, on the right of the
    /// path if `side` is 1 and on its left if it is -1.
    #[inline(always)]
    fn reach(
        &self,
        gap: &Gap,
        normal: Normal,
        disk: &TouchingDisk,
        side: f64,
    ) -> Result<Reach, Unsure> {
        // A proposal will be looked into, so its order needs no proof.
        let bound = error_of(disk);
        let along = |edge: &Edge, p: Point| {
            let a = p - disk.origin;
            let q = disk.centre - a;
            let x = edge.direction.dot(q);
            let size = 16.0 * (q.x.abs() + q.y.abs()) + a.x.abs() + a.y.abs() + 2.0 * disk.radius;
            (side * x, bound + U * size)
        };
        let (x, doubt) = along(self.domain.edge(normal.edge), normal.at);
        if x > doubt {
            return Ok(Reach::Past);
        }
        // The other border of the zone.
        let governor = if side > 0.0 { gap.right } else { gap.left };
        let k = governor.index();
        let (behind, from) = match (governor.is_edge(), side > 0.0) {
            (true, true) => (k, self.domain.edge(k).start),
            (true, false) => (k, self.domain.end(k)),
            (false, true) => (self.domain.edge(k).prev, normal.at),
            (false, false) => (k, normal.at),
        };
        let (y, back_doubt) = along(self.domain.edge(behind), from);
        if y < -back_doubt {
            return Err(Unsure);
        }
        if !self.advances(gap, disk, side) {
            // A corner's zone was left on the way and entered anew from behind.
            return if governor.is_edge() { Err(Unsure) } else { Ok(Reach::Past) };
        }
        Ok(if x < -doubt { Reach::Within } else { Reach::Level })
    }

    /// Whether the footpoint of a governor moves on to a disk as it must.
    #[inline(always)]
    fn advances(&self, gap: &Gap, disk: &TouchingDisk, side: f64) -> bool {
        let governor = if side > 0.0 { gap.right } else { gap.left };
        let edge = self.domain.edge(governor.index());
        if !governor.is_edge() {
            return self.turns(gap, edge.start, disk, side);
        }
        let step = disk.centre + (disk.origin - gap.start.centre);
        let size = step.x.abs() + step.y.abs() + gap.start.radius + disk.radius;
        side * edge.direction.dot(step) >= -(error_of(disk) + gap.start.doubt + 16.0 * U * size)
    }

    /// Whether the spoke of a corner turns on the way to a disk as it must, by less than half a turn:
    /// clockwise on the right, counterclockwise on the left.
    fn turns(&self, gap: &Gap, corner: Point, disk: &TouchingDisk, side: f64) -> bool {
        let (turn, doubt, along) = spokes(gap, corner, disk, side);
        turn < -doubt || turn <= doubt && along > 0.0
    }

    /// Whether the spoke of a corner that governs would have to turn back on the way to a disk: the
    /// path leaves the corner before.
    pub fn turns_back(&self, gap: &Gap, disk: &TouchingDisk) -> bool {
        [(gap.right, 1.0), (gap.left, -1.0)].into_iter().any(|(site, side)| {
            let corner = self.domain.edge(site.index()).start;
            let (turn, doubt, _) = spokes(gap, corner, disk, side);
            !site.is_edge() && turn > doubt
        })
    }

    /// Whether the spoke of a corner that governs is not certain to turn as it must on the way to a disk.
    /// Where doubles cannot tell, the path may have left the corner before and come back to it around a
    /// hole no larger than the doubt.
    pub fn may_turn_back(&self, gap: &Gap, disk: &TouchingDisk) -> bool {
        [(gap.right, 1.0), (gap.left, -1.0)].into_iter().any(|(site, side)| {
            let corner = self.domain.edge(site.index()).start;
            !site.is_edge() && {
                let (turn, doubt, _) = spokes(gap, corner, disk, side);
                turn.is_nan() || turn >= -doubt
            }
        })
    }

    /// What comes next between two governors, as far as their own chains tell.
    fn next_event(&mut self, gap: &Gap) -> Result<Option<Event>, Unsure> {
        let (r, l) = (gap.right, gap.left);
        self.tie = None;
        self.behind.clear();
        let endings = self.ending_right(r).zip(self.ending_left(l)).ok_or(Unsure)?;
        let (edge, normal, other, side) = match endings {
            (Ending::Turn { edge: e }, Ending::Turn { edge: f }) => {
                if e == f {
                    return Ok(self.meet(gap, e, true));
                }
                let (a, b) = (self.meet(gap, e, true), self.meet(gap, f, false));
                let position = |e: &Event| gap.course(self.domain).position(&e.disk);
                return Ok(match (a, b) {
                    (Some(a), Some(b)) => Some(if position(&b) < position(&a) { b } else { a }),
                    (a, b) => a.or(b),
                });
            }
            (Ending::Normal(right), Ending::Normal(left)) => {
                return self.next_leave(gap, right, left);
            }
            (Ending::Turn { edge }, Ending::Normal(normal)) => (edge, normal, r, -1.0),
            (Ending::Normal(normal), Ending::Turn { edge }) => (edge, normal, l, 1.0),
        };
        // The one that turns stays while the other one leaves.
        let meet = self.meet(gap, edge, side < 0.0);
        if let Some(meet) = &meet
            && self.reach(gap, normal, &meet.disk, side)? != Reach::Past
        {
            return Ok(Some(*meet));
        }
        let event = self.leave(normal, other)?.filter(|e| self.advances(gap, &e.disk, -side));
        if meet.is_some() && event.is_none() { Err(Unsure) } else { Ok(event) }
    }

    /// Which of two governors leaves first.
    #[inline(always)]
    fn next_leave(
        &mut self,
        gap: &Gap,
        right: Normal,
        left: Normal,
    ) -> Result<Option<Event>, Unsure> {
        let (r, l) = (gap.right, gap.left);
        let first = |this: &Self, event: Option<Event>, allowed: &[Reach]| match event {
            Some(b) if allowed.contains(&this.reach(gap, right, &b.disk, 1.0)?) => Ok(Some(b)),
            Some(_) => Err(Unsure),
            None => Ok(None),
        };
        let Some(a) = self.leave(right, l)? else {
            return first(self, self.leave(left, r)?, &[Reach::Within]);
        };
        match self.reach(gap, left, &a.disk, -1.0)? {
            Reach::Within => Ok(Some(a)),
            Reach::Past => {
                let b = self.leave(left, r)?.ok_or(Unsure)?;
                first(self, Some(b), &[Reach::Within])
            }
            Reach::Level => match self.level(r, l, &right, &left, &a.disk) {
                Ordering::Greater => Ok(Some(a)),
                Ordering::Less => {
                    let b = self.leave(left, r)?.ok_or(Unsure)?;
                    first(self, Some(b), &[Reach::Within, Reach::Level])
                }
                Ordering::Equal => {
                    self.tie = Some((right.site, left.site));
                    Ok(Some(a))
                }
            },
        }
    }

    /// Where the disk in which the right governor leaves lies to the normal on which the left one does,
    /// as seen along the boundary.
    fn level(
        &self,
        r: Site,
        l: Site,
        right: &Normal,
        left: &Normal,
        disk: &TouchingDisk,
    ) -> Ordering {
        let ends = |k: u32| (self.domain.edge(k).start, self.domain.end(k));
        let (from, to) = ends(left.edge);
        if r.is_edge() == l.is_edge() {
            // Their path is straight, and crosses each normal once.
            let of = if r.is_edge() { Leaving::Edge } else { Leaving::Corner };
            let (a, b) = ends(right.edge);
            return match two_ends(of(a, b), of(from, to)) {
                First::Right => Ordering::Greater,
                First::Both => Ordering::Equal,
                First::Left => Ordering::Less,
            };
        }
        self.certified(&[r, right.site, l], disk).along(from, to, left.at)
    }

    /// Takes note of a transition and gives the governors of the path beyond it.
    fn pass(&mut self, r: Site, l: Site, disk: TouchingDisk, site: Site) -> (Site, Site) {
        let (contacts, n_contacts, own, beyond) = match self.tie.take() {
            Some((new_r, new_l)) => {
                let contacts = [r, new_r, new_l, l];
                (contacts, 4, facing(self.domain, &contacts), (new_r, new_l))
            }
            None if follows(self.domain, r, site) => ([r, site, l, l], 3, Some(disk), (site, l)),
            None => ([r, site, l, l], 3, Some(disk), (r, site)),
        };
        let (disk, fixed) = (own.unwrap_or(disk), own.is_some());
        self.passed.push(Passed { right: r, left: l, disk, contacts, n_contacts, fixed });
        beyond
    }
}

/// The disk of two runs of two governors that face each other, if these four are: the same from
/// whichever side it was found.
pub(super) fn facing(domain: &Domain, list: &[Site]) -> Option<TouchingDisk> {
    let &[a, b, c, d] = list else { return None };
    let run = |p, q| follows(domain, p, q);
    let (one, other) = if run(a, b) && run(c, d) {
        ([a, b], [c, d])
    } else if run(b, c) && run(d, a) {
        ([b, c], [d, a])
    } else {
        return None;
    };
    let (run, third) = if one[0] < other[0] { (one, other[0]) } else { (other, one[0]) };
    TouchingDisk::touching(&domain.governors([run[0], run[1], third]))
}

/// Bound on the error of a disk; for a proposal, which will be looked into, what it may be off.
fn error_of(disk: &TouchingDisk) -> f64 {
    if disk.bound.is_finite() { disk.bound } else { SLACK * disk.radius }
}

/// The turn of a corner's spoke from the start of a path to a disk, the bound on its error, and whether
/// both spokes point to one side; negative where it turns as it must on this side of the path.
fn spokes(gap: &Gap, corner: Point, disk: &TouchingDisk, side: f64) -> (f64, f64, f64) {
    let from = gap.start.centre - corner;
    let to = disk.centre + (disk.origin - corner);
    let sizes = from.x.abs() + from.y.abs() + to.x.abs() + to.y.abs();
    let doubt = gap.start.doubt + error_of(disk) + 8.0 * U * sizes;
    (side * from.cross(to), 2.0 * doubt * sizes, from.dot(to))
}
