//! First proposals for the end of a path.

use super::search::{Gap, Proposal, SLACK, Search};
use super::verify::Verify;
use crate::domain::Site;
use crate::geom::TouchingDisk;
use crate::geom::predicates::{First, Leaving, two_ends};

/// More probes than exponents of doubles: each is four times as far as the one before.
const MOST_PROBES: usize = 1100;

/// Step, as a share of position and radius, at which halving the way to an obstacle stops.
///
/// Proposals only: where none is found, exact arithmetic looks at every site.
const SMALLEST_STEP: f64 = 1e-9;

/// What a probe sees.
enum Look {
    /// A third governor.
    Hit(Proposal),
    /// The disk is cut by what makes no third governor, or does not exist.
    Blocked,
    /// Nothing.
    Clear,
}

impl Search<'_> {
    /// The best of the proposals that the boundary itself makes: each governor's neighbour, and
    /// what a growing probe meets before it.
    pub(super) fn first_proposal(&mut self, gap: &Gap) -> Option<Proposal> {
        let (ahead, behind) = (self.domain.ahead(gap.right), self.domain.behind(gap.left));
        let best = match (self.propose(gap, ahead), self.propose(gap, behind)) {
            (Some(right), Some(left)) => {
                let near = SLACK * (right.disk.radius + gap.start.radius);
                let right_first = if (right.position - left.position).abs() > near {
                    right.position < left.position
                } else {
                    // Too close for doubles: facing corners of a corridor, most often.
                    self.leaving(gap.right, ahead)
                        .zip(self.leaving(gap.left, behind))
                        .map_or(right.position <= left.position, |(r, l)| {
                            two_ends(r, l) != First::Left
                        })
                };
                Some(if right_first { right } else { left })
            }
            (right, left) => right.or(left),
        };
        self.probe(gap, best)
    }

    /// How a governor leaves the path for its neighbour on the boundary, if it does so on a normal.
    fn leaving(&self, governor: Site, neighbour: Site) -> Option<Leaving> {
        let ends = |k: u32| (self.domain.edge(k).start, self.domain.end(k));
        match (governor.is_edge(), neighbour.is_edge()) {
            (true, false) => {
                let (a, b) = ends(governor.index());
                Some(Leaving::Edge(a, b))
            }
            (false, true) => {
                let (a, b) = ends(neighbour.index());
                Some(Leaving::Corner(a, b))
            }
            // Around a convex corner the neighbour is met, not passed.
            _ => None,
        }
    }

    /// Grows a disk along the path until it meets something or passes `best`.
    fn probe(&mut self, gap: &Gap, best: Option<Proposal>) -> Option<Proposal> {
        let shorter = |a: f64, b: Option<f64>| b.map_or(a, |b| a.min(b));
        let length = |s: Site| s.is_edge().then(|| self.domain.edge(s.index()).length);
        let mut reach = if gap.start.radius > 0.0 {
            2.0 * gap.start.radius
        } else {
            shorter(length(gap.right).unwrap_or(1.0), length(gap.left)) / 2.0
        };
        let is_near = |reach: f64| best.is_some_and(|b| b.position <= 2.0 * reach);
        if is_near(reach) {
            return best;
        }
        let limit = self.limit(gap);
        // Up to where the disks seen are clear, and where the first one is cut by what makes no
        // third governor, or does not exist.
        let (mut clear, mut blocked) = (0.0, f64::INFINITY);
        for _ in 0..MOST_PROBES {
            // Farther away the path would have left the polygon.
            if is_near(reach) || reach > 4.0 * self.largest {
                return best;
            }
            let at_limit = limit.filter(|l| l.1 <= reach);
            let position = at_limit.map_or(reach, |l| l.1);
            let disk = at_limit.map_or_else(|| gap.disk_at(self.domain, position), |l| Some(l.0));
            match self.look(gap, disk) {
                Look::Hit(hit) => return Some(hit),
                Look::Clear if blocked == f64::INFINITY => clear = position,
                Look::Clear => {}
                Look::Blocked => blocked = blocked.min(position),
            }
            if at_limit.is_some() || disk.is_none() {
                break;
            }
            reach *= 4.0;
        }
        // What blocks the path lies between two probes.
        while blocked < f64::INFINITY
            && blocked - clear > SMALLEST_STEP * (blocked + gap.start.radius)
        {
            let position = (clear + blocked) / 2.0;
            match self.look(gap, gap.disk_at(self.domain, position)) {
                Look::Hit(hit) => return Some(hit),
                Look::Clear => clear = position,
                Look::Blocked => blocked = position,
            }
        }
        best
    }

    fn look(&self, gap: &Gap, disk: Option<TouchingDisk>) -> Look {
        let Some(disk) = disk.filter(|_| !self.watch.is_over()) else { return Look::Blocked };
        let mut verify = Verify::hunting(self, gap, (&gap.start, &[]), disk);
        verify.run();
        match verify.best() {
            Some(hit) => Look::Hit(hit),
            None if verify.is_cut() => Look::Blocked,
            None => Look::Clear,
        }
    }

    /// Where the path leaves the zone of a governor, whatever stands there.
    fn limit(&self, gap: &Gap) -> Option<(TouchingDisk, f64)> {
        let end_of = |site: Site| self.domain.edge(site.index()).next;
        let corners = [
            gap.right.is_edge().then(|| Site::corner(end_of(gap.right))),
            gap.left.is_edge().then(|| Site::corner(gap.left.index())),
        ];
        let mut first: Option<(TouchingDisk, f64)> = None;
        for site in corners.into_iter().flatten() {
            let governors = self.domain.governors(gap.triple(site));
            let Some(disk) = TouchingDisk::guess(&governors, gap.start.centre) else { continue };
            let position = gap.course(self.domain).position(&disk);
            if position > 0.0 && first.is_none_or(|f| position < f.1) {
                first = Some((disk, position));
            }
        }
        first
    }
}
