//! Keypoint by keypoint: kind, governor list, exact disk, emptiness, position.

use super::Defect;
use super::context::{Context, one_contact};
use super::enclosure::Enclosure;
use super::maximal_disk::MaximalDisk;
use crate::axis::{Keypoint, KeypointKind, Side};
use crate::domain::{Corner, Site};
use crate::geom::Point;

/// What the checks of paths and of the boundary need to know about the keypoints.
pub(super) struct Keypoints {
    /// The disk of each inner keypoint that has one.
    pub(super) disks: Vec<Option<([Site; 3], Enclosure)>>,
    /// Whether the governor list could be read: known sites, each once, at least two contacts.
    pub(super) readable: Vec<bool>,
    /// The places where paths leave.
    pub(super) gaps: Vec<Gap>,
    /// How many chains of paths start along each site of the domain.
    pub(super) starts: Vec<u32>,
    /// How many chains of paths end along each site of the domain.
    pub(super) ends: Vec<u32>,
}

/// The place between two neighbouring contacts of a keypoint, where a path leaves.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Gap {
    pub(super) keypoint: u32,
    /// Site number of the governor to the right of the leaving path.
    pub(super) right: u32,
    /// Site number of the governor to its left.
    pub(super) left: u32,
}

/// Checks all keypoints.
pub(super) fn check(context: &Context, defects: &mut Vec<Defect>) -> Keypoints {
    let n = context.axis.keypoints().len();
    let elements = 2 * context.domain.edges().len();
    let mut found = Keypoints {
        disks: vec![None; n],
        readable: vec![false; n],
        gaps: Vec::with_capacity(2 * context.axis.paths().len()),
        starts: vec![0; elements],
        ends: vec![0; elements],
    };
    let mut degrees = vec![0; n];
    for path in context.axis.paths() {
        degrees[path.from as usize] += 1;
        degrees[path.to as usize] += 1;
    }
    // The keypoint that listed an element last, counted from 1.
    let mut listed_by = vec![0u32; elements];
    for (k, keypoint) in context.axis.keypoints().iter().enumerate() {
        let number = k as u32;
        let mut one = One { context, number, keypoint: &keypoint, degree: degrees[k], defects };
        one.check_kind();
        let Some(sites) = one.governors(&mut listed_by) else { continue };
        if keypoint.kind == KeypointKind::End {
            if one.check_end(&sites) {
                found.readable[k] = true;
                one.leave_end(&sites, &mut found);
            }
            continue;
        }
        let runs = one.runs(&sites);
        if runs.len() < 2 || sites.len() < 3 {
            let is_cut = one.is_clipped() || one.is_tip();
            if is_cut && one.degree < 2 && runs.len() == 2 {
                found.readable[k] = true;
                one.leave(&sites, &runs, &mut found);
                one.check_tip(&sites);
            } else {
                one.report_two_governors();
            }
            continue;
        }
        found.readable[k] = true;
        one.leave(&sites, &runs, &mut found);
        let three = three_sites(&sites, &runs);
        let guess = (keypoint.position, keypoint.radius);
        let Some(disk) = MaximalDisk::new(context.domain, three, guess) else {
            let at = keypoint.position;
            one.defects.push(Defect::NoDisk { keypoint: number, at });
            continue;
        };
        if one.check_contacts(&disk, &sites, &runs) {
            one.check_empty(&disk, &listed_by);
        }
        one.check_position(disk.enclosure());
        found.disks[k] = Some((disk.sites(), *disk.enclosure()));
    }
    check_repeated(context, defects);
    found
}

/// A run of governors with one contact: the place of its first in the list, and their number.
#[derive(Clone, Copy)]
pub(super) struct Run {
    pub(super) first: usize,
    pub(super) len: usize,
}

/// One keypoint under examination.
pub(super) struct One<'a, 'b> {
    pub(super) context: &'a Context<'a>,
    pub(super) number: u32,
    pub(super) keypoint: &'a Keypoint,
    degree: usize,
    pub(super) defects: &'b mut Vec<Defect>,
}

impl One<'_, '_> {
    /// Whether a path of an exterior axis is cut here.
    fn is_clipped(&self) -> bool {
        self.keypoint.kind == KeypointKind::Clipped && self.context.axis.side == Side::Exterior
    }

    /// Whether a path was cut or pruned away here.
    fn is_tip(&self) -> bool {
        self.keypoint.kind == KeypointKind::Tip && !self.context.axis.complete
    }

    fn check_kind(&mut self) {
        let kind = match self.degree {
            1 if self.is_clipped() => KeypointKind::Clipped,
            // Pruning and cutting leave tips, alone or at a path.
            0 | 1 if self.is_tip() => KeypointKind::Tip,
            1 => KeypointKind::End,
            2 => KeypointKind::Transition,
            _ => KeypointKind::Junction,
        };
        if self.keypoint.kind != kind || self.degree == 0 && !self.is_tip() {
            self.defects.push(Defect::Kind {
                keypoint: self.number,
                kind: self.keypoint.kind,
                degree: self.degree,
                at: self.keypoint.position,
            });
        }
    }

    /// The governors as elements of the domain, if all are known and none is listed twice.
    fn governors(&mut self, listed_by: &mut [u32]) -> Option<Vec<Site>> {
        let (keypoint, at) = (self.number, self.keypoint.position);
        let list = self.context.axis.governors(keypoint);
        if list.iter().min() != list.first() {
            self.defects.push(Defect::ListStart { keypoint, at });
        }
        let sites = self.context.governors(keypoint)?;
        let mut sound = true;
        for (site, &number) in sites.iter().zip(list) {
            let mark = &mut listed_by[site.0 as usize];
            if *mark == keypoint + 1 {
                self.defects.push(Defect::RepeatedGovernor { keypoint, site: number, at });
                sound = false;
            }
            *mark = keypoint + 1;
        }
        sound.then_some(sites)
    }

    /// Whether an end is a convex corner with its two edges, bit for bit.
    fn check_end(&mut self, sites: &[Site]) -> bool {
        let domain = self.context.domain;
        let at = self.keypoint.position;
        let corner = end_corner(self.context, sites);
        let sound = corner.is_some_and(|corner| {
            let place = domain.edge(corner).start;
            place.x.to_bits() == at.x.to_bits()
                && place.y.to_bits() == at.y.to_bits()
                && self.keypoint.radius.to_bits() == 0
        });
        if !sound {
            self.defects.push(Defect::End { keypoint: self.number, at });
        }
        corner.is_some()
    }

    fn leave_end(&self, sites: &[Site], found: &mut Keypoints) {
        let list = self.context.axis.governors(self.number);
        let Some(corner) = end_corner(self.context, sites) else { return };
        let out = usize::from(sites[0] != Site::edge(corner));
        found.gaps.push(Gap { keypoint: self.number, right: list[out], left: list[1 - out] });
        found.starts[sites[out].0 as usize] += 1;
        found.ends[sites[1 - out].0 as usize] += 1;
    }

    /// Groups the list into runs with one contact each.
    fn runs(&self, sites: &[Site]) -> Vec<Run> {
        let n = sites.len();
        let joined = |k: usize| one_contact(self.context.domain, sites[k], sites[(k + 1) % n]);
        // Start behind a place where the contact changes.
        let Some(start) = (0..n).find(|&k| !joined(k)).map(|k| k + 1) else { return Vec::new() };
        let mut runs: Vec<Run> = Vec::with_capacity(n);
        for step in 0..n {
            let k = (start + step) % n;
            match runs.last_mut() {
                Some(run) if joined((k + n - 1) % n) => run.len += 1,
                _ => runs.push(Run { first: k, len: 1 }),
            }
        }
        runs
    }

    /// Records where paths leave an inner keypoint and where chains along the boundary change.
    fn leave(&self, sites: &[Site], runs: &[Run], found: &mut Keypoints) {
        let list = self.context.axis.governors(self.number);
        let last = |run: Run| (run.first + run.len - 1) % list.len();
        for (k, &run) in runs.iter().enumerate() {
            let next = runs[(k + 1) % runs.len()];
            found.gaps.push(Gap {
                keypoint: self.number,
                right: list[last(run)],
                left: list[next.first],
            });
            if run.len > 1 {
                found.starts[sites[last(run)].0 as usize] += 1;
                found.ends[sites[run.first].0 as usize] += 1;
            }
        }
    }

    /// A keypoint with fewer than two contacts, or with two and nothing that changes.
    fn report_two_governors(&mut self) {
        let (keypoint, at) = (self.number, self.keypoint.position);
        if self.degree == 2 {
            self.defects.push(Defect::FakeTransition { keypoint, at });
        } else {
            self.defects.push(Defect::NoDisk { keypoint, at });
        }
    }
}

/// The edge that leaves the convex corner whose two edges these are.
fn end_corner(context: &Context, sites: &[Site]) -> Option<u32> {
    let &[a, b] = sites else { return None };
    if !a.is_edge() || !b.is_edge() {
        return None;
    }
    let follows = |a: Site, b: Site| {
        context.domain.edge(a.index()).next == b.index()
            && context.domain.edge(b.index()).corner == Corner::Convex
    };
    if follows(a, b) {
        Some(b.index())
    } else if follows(b, a) {
        Some(a.index())
    } else {
        None
    }
}

/// Three elements that fix the disk: of three contacts, or a contact at a corner and another one.
fn three_sites(sites: &[Site], runs: &[Run]) -> [Site; 3] {
    let member = |run: Run, k: usize| sites[(run.first + k) % sites.len()];
    if let [first, second] = *runs {
        let (run, other) = if first.len > 1 { (first, second) } else { (second, first) };
        let (a, b) = (member(run, 0), member(run, 1));
        // At a straight joint the corner stands for the first edge.
        let a = if a.is_edge() && b.is_edge() { Site::corner(b.index()) } else { a };
        // A corner allows exact numbers of lower degree.
        let other = (0..other.len).map(|k| member(other, k)).min_by_key(|site| site.is_edge());
        return [a, b, other.unwrap_or(b)];
    }
    let n = runs.len();
    [0, n / 3, 2 * n / 3].map(|k| {
        let run = runs[k];
        (0..run.len).map(|k| member(run, k)).min_by_key(|site| site.is_edge()).unwrap_or(sites[0])
    })
}

/// No two keypoints have one list, but for places where a path is cut.
fn check_repeated(context: &Context, defects: &mut Vec<Defect>) {
    let keypoints = context.axis.keypoints();
    let mut order: Vec<u32> = (0..keypoints.len() as u32).collect();
    order.retain(|&k| !matches!(keypoints.at(k).kind, KeypointKind::Clipped | KeypointKind::Tip));
    order.sort_by_key(|&k| context.axis.governors(k));
    for pair in order.windows(2) {
        let (first, second) = (pair[0], pair[1]);
        if context.axis.governors(first) == context.axis.governors(second) {
            let at: Point = context.position(first);
            defects.push(Defect::RepeatedKeypoint { first, second, at });
        }
    }
}
