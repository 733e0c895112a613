//! Settles where a chain of transitions ends: looks into the disk proposed until nothing cuts it.
//!
//! Ends far away, or not known, are approached by ever larger disks first. What cuts a disk is the
//! third governor of this one or of one that was passed, and that one is looked into next.

use super::chain::{GROWTH, LEAP, POOR, POOR_RELATIVE, start_after};
use super::front::Front;
use super::nearby::Nearby;
use super::rings::{Link, Round};
use super::search::{Found, Gap, Proposal, Search, Start, contact_behind};
use super::verify::{Verdict, Verify};
use crate::domain::Site;
use crate::geom::{TouchingDisk, U};

/// Elements to either side of one that was met beyond its end that are proposed instead.
const FEW: usize = 3;

/// Disks looked into before the path is left to exact arithmetic.
const MOST_ROUNDS: usize = 64;

impl Search<'_> {
    /// Looks into ever larger disks before an end that is far away or not known, and proposes what
    /// they meet.
    pub fn approach(
        &mut self,
        anchor: Start,
        gap: &Gap,
        end: Option<Proposal>,
        known: f64,
    ) -> Option<Proposal> {
        let mut reach = GROWTH * known;
        // Beyond that the path would have left the polygon.
        let farthest = LEAP * self.largest;
        while end.is_none_or(|e| 2.0 * reach < e.position) && reach <= farthest {
            if self.watch.is_over() {
                return None;
            }
            let Some(disk) = gap.disk_at(self.domain, reach) else { break };
            if end.is_some_and(|e| disk.radius * LEAP > e.disk.radius) {
                break;
            }
            if let Some((link, hit)) = self.among_holes(anchor, gap.front, &disk) {
                self.go_back(link);
                self.from_holes = true;
                return Some(hit);
            }
            let few = self.few_ahead(gap.front);
            if few.is_some() || self.luck_far.promises() {
                let nearby = few.map_or(Nearby::Some, Nearby::All);
                let hit = self.hit(&anchor, gap.front, &disk, nearby);
                self.luck_far.note(hit.is_some());
                if hit.is_some() {
                    return hit;
                }
            }
            let start = (&anchor, &self.passed[..]);
            let mut verify = Verify::hunting(self, gap, start, disk);
            verify.run();
            let (link, hit, cut) = (verify.link(), verify.best(), verify.is_cut());
            if hit.is_some() {
                self.go_back(link);
                return hit;
            }
            if cut {
                return None;
            }
            reach *= LEAP;
        }
        end
    }

    /// A better proposal than the disk at the end of a path, and the link that it lies on, if the holes
    /// nearby make one.
    fn among_holes(
        &self,
        anchor: Start,
        front: Option<Front>,
        disk: &TouchingDisk,
    ) -> Option<(usize, Proposal)> {
        let rings = self.rings.as_ref()?;
        let (right, left) = self.link;
        let own = [right, left].map(|s| self.domain.edge(s.index()).walk);
        let ahead = rings.ahead(&anchor, disk, own);
        if ahead.is_empty() {
            return None;
        }
        let here = start_after(&self.passed, &anchor);
        let gap = Gap::new(right, left, here, front);
        let mut verify = Verify::hunting(self, &gap, (&anchor, &self.passed[..]), *disk);
        for (_, walk) in ahead {
            verify.look_at(&self.domain.walks()[walk as usize]);
        }
        verify.best().map(|best| (verify.link(), best))
    }

    /// Drops what was passed from a link on, whose governors are then in `self.link`.
    #[inline]
    pub fn go_back(&mut self, link: usize) {
        if let Some(passed) = self.passed.get(link) {
            self.link = (passed.right, passed.left);
            self.passed.truncate(link);
        }
    }

    /// Looks into the proposed end until nothing cuts it.
    pub fn settle_chain(
        &mut self,
        anchor: Start,
        front: Option<Front>,
        mut end: Proposal,
    ) -> Option<Found> {
        // The exact disk of the proposal, where only exact arithmetic made it.
        let mut exact = None;
        // Its certified disk, if doubles have one, where they were asked already.
        let mut sought = None;
        if !std::mem::take(&mut self.from_holes)
            && let Some((link, nearer)) = self.among_holes(anchor, front, &end.disk)
        {
            self.go_back(link);
            end = nearer;
        }
        if let Some(few) = self.few_ahead(front) {
            // With one edge between the governors' there is nothing to choose.
            if few.len() > 3 || !end.site.is_edge() {
                end = self.nearer(&anchor, front, end, Nearby::All(few));
            }
            match self.end_among_few(few, &end) {
                Ok(found) => return Some(found),
                Err(disk) => sought = Some(disk),
            }
        } else if self.luck.promises() {
            let site = end.site;
            end = self.nearer(&anchor, front, end, Nearby::Some);
            self.luck.note(end.site != site);
        }
        for _ in 0..MOST_ROUNDS {
            if self.watch.is_over() {
                return None;
            }
            let (right, left) = self.link;
            let here = start_after(&self.passed, &anchor);
            let gap = Gap::new(right, left, here, front);
            let triple = gap.triple(end.site);
            let sought = sought.take();
            let mut pinned = None;
            let (disk, own) = if end.disk.bound.is_finite() {
                (end.disk, exact.is_none().then_some(end.disk))
            } else {
                let governors = self.domain.governors(triple);
                let found = sought.unwrap_or_else(|| TouchingDisk::touching(&governors));
                if found.is_none_or(|disk| disk.bound > POOR * disk.radius) {
                    pinned = self.pinned(&triple);
                }
                let sharp = pinned.as_ref().map(TouchingDisk::from);
                let poor = if sharp.is_some() { POOR_RELATIVE } else { POOR };
                let disk = match [found, sharp].into_iter().flatten().reduce(sharper) {
                    Some(disk) if disk.bound <= poor * disk.radius => disk,
                    Some(disk) if found.is_some() => {
                        exact.insert(self.certified(&triple, &disk)).rounded()
                    }
                    _ => exact.insert(self.exact(&triple)?).rounded(),
                };
                (disk, found)
            };
            let start = (&anchor, &self.passed[..]);
            let mut verify = Verify::certified(self, &gap, start, triple, disk, true);
            verify.pin(pinned);
            verify.run();
            let link = verify.link();
            let own = own.filter(|_| exact.is_none());
            let verdict = verify.verdict(&mut exact);
            exact = None;
            match verdict {
                Verdict::Better(next) => {
                    self.go_back(link);
                    end = next;
                }
                Verdict::Clear(contacts) => {
                    self.leave_out_those_in(&contacts);
                    let (right, left) = self.link;
                    let here = start_after(&self.passed, &anchor);
                    let gap = Gap::new(right, left, here, front);
                    if self.may_turn_back(&gap, &disk) {
                        return None;
                    }
                    if self.rings.is_some() {
                        let slack = disk.bound + here.doubt + 64.0 * U * self.largest;
                        if gap.course(self.domain).position(&disk) <= slack
                            || contact_behind(&contacts, right, left).is_some()
                            || !self.may_be_open(right, left, anchor, Round::disk(&disk))
                        {
                            return None;
                        }
                    }
                    let own = own.filter(|_| contacts.len() == 3);
                    return Some(Found::Disk { disk, triple, contacts, own });
                }
                Verdict::OffEdge => {
                    self.banned.push(end.site);
                    end = self.beside(&gap, end.site)?;
                }
                Verdict::Earlier(site) if self.may_be_third(&gap, site) => {
                    let smaller = self.exact(&gap.triple(site))?;
                    end = Proposal { site, disk: smaller.rounded(), position: 0.0 };
                    exact = Some(smaller);
                }
                Verdict::Cut(_) | Verdict::Earlier(_) => return None,
            }
        }
        None
    }

    /// Goes back over the last transitions passed that are in a disk with these contacts.
    pub fn leave_out_those_in(&mut self, contacts: &[Site]) {
        while let Some(last) = self.passed.pop_if(|p| {
            let n = usize::from(p.n_contacts);
            p.contacts[..n].iter().all(|s| contacts.contains(s))
        }) {
            self.link = (last.right, last.left);
        }
    }

    /// The nearest proposal that the boundary makes around an edge that is met beyond its end.
    fn beside(&self, gap: &Gap, site: Site) -> Option<Proposal> {
        let mut best: Option<Proposal> = None;
        let (mut ahead, mut behind) = (site, site);
        for _ in 0..FEW {
            (ahead, behind) = (self.domain.ahead(ahead), self.domain.behind(behind));
            for site in [ahead, behind] {
                let proposal = self.propose(gap, site);
                if let Some(p) = proposal
                    && best.is_none_or(|b| p.position < b.position)
                {
                    best = Some(p);
                }
            }
            if best.is_some() {
                break;
            }
        }
        best
    }

    /// The same, asked only where care is taken.
    #[inline]
    pub fn may_be_open(&self, r: Site, l: Site, anchor: Start, end: Round) -> bool {
        !self.careful || self.is_open(r, l, anchor, end)
    }

    /// Whether no ring can lie in the pocket of the path passed and one more piece.
    pub fn is_open(&self, r: Site, l: Site, anchor: Start, end: Round) -> bool {
        let Some(rings) = self.rings.as_ref() else { return true };
        let first = Round::start(&anchor);
        let passed = &self.passed;
        let start = move |k: usize| if k == 0 { first } else { Round::disk(&passed[k - 1].disk) };
        let links = (0..=passed.len()).map(move |k| match passed.get(k) {
            Some(p) => {
                Link { right: p.right, left: p.left, start: start(k), end: Round::disk(&p.disk) }
            }
            None => Link { right: r, left: l, start: start(k), end },
        });
        !rings.any(self.domain, links)
    }
}

/// Of two forms of one disk the one with the smaller bound.
fn sharper(a: TouchingDisk, b: TouchingDisk) -> TouchingDisk {
    if b.bound < a.bound { b } else { a }
}
