use smallvec::SmallVec;

use super::chain::{Passed, facing};
use super::contacts::follows;
use super::finish::Traced;
use super::gaps::Gaps;
use super::search::{Before, Found, Search, Start};
use crate::axis::{KeypointKind, Path};
use crate::domain::{Domain, Site};
use crate::engine::EngineError;
use crate::engine::draft::{Fixed, Place};
use crate::engine::watch::Watch;
use crate::geom::TouchingDisk;

/// Neighbouring contacts of a keypoint, between which a path leaves.
pub(super) type Openings = SmallVec<[(Site, Site); 4]>;

/// What traces one path after the other and takes note of it.
pub(super) struct Hand<'a> {
    pub domain: &'a Domain,
    pub search: Option<Search<'a>>,
    pub traced: Traced,
    /// Whether every path is looked for by itself.
    pub single: bool,
    pub watch: Watch<'a>,
}

/// Where a path ends that has passed some transitions.
pub(super) struct Arrival {
    /// The last keypoint before.
    pub from: u32,
    /// Governors since then.
    pub right: Site,
    pub left: Site,
    pub found: Found,
}

impl<'a> Hand<'a> {
    pub fn new(domain: &'a Domain, watch: Watch<'a>) -> Self {
        Self { domain, search: None, traced: Traced::default(), single: false, watch }
    }

    /// Follows the path that leaves `start`, which is keypoint number `from`, to the next keypoint
    /// that is no plain transition, and takes note of all but its last piece. Only with the open gaps
    /// it may end at a keypoint as known.
    #[inline(always)]
    pub fn follow(
        &mut self,
        mut from: u32,
        right: Site,
        left: Site,
        start: Start,
        gaps: Option<&Gaps>,
    ) -> Result<Arrival, EngineError> {
        self.watch.check()?;
        let broken = EngineError::Internal { stage: "preparing the search", place: start.centre };
        let search = self.search.as_mut().ok_or(broken)?;
        search.mend_tree();
        let before = gaps.map(|gaps| Before { gaps, traced: &self.traced });
        let chased = if self.single { None } else { search.chase(right, left, start, before) };
        let Some(found) = chased else {
            let found = search.find(right, left, start)?;
            return Ok(Arrival { from, right, left, found });
        };
        let (last_right, last_left) = search.link;
        for passed in &search.passed {
            let to = self.traced.add_transition(self.domain, passed)?;
            let Passed { right, left, .. } = *passed;
            self.traced.add_path(&path(from, to, right, left));
            from = to;
        }
        Ok(Arrival { from, right: last_right, left: last_left, found })
    }

    /// Adds the end keypoint in the convex corner at the start of an edge.
    pub fn add_end(&mut self, corner: u32) -> u32 {
        let edge = self.domain.edge(corner);
        let (a, b) = (Site::edge(edge.prev), Site::edge(corner));
        self.traced.add(edge.start, 0.0, KeypointKind::End, &[a.min(b), a.max(b)])
    }

    /// Adds a keypoint with these governors; `own` is the disk that doubles find for them alone, if that
    /// is known.
    pub fn add_keypoint(
        &mut self,
        disk: &TouchingDisk,
        triple: [Site; 3],
        list: &[Site],
        own: Option<TouchingDisk>,
    ) -> Result<u32, EngineError> {
        // The position depends on the governors only, not on how the keypoint was found.
        let (own, sought) = match *list {
            _ if own.is_some() => (own, false),
            [a, b, c] => (TouchingDisk::touching(&self.domain.governors([a, b, c])), true),
            _ => (facing(self.domain, list), false),
        };
        let disk = Fixed { own: own.as_ref(), sought, found: disk, triple };
        self.traced.add_disk(self.domain, &disk, KeypointKind::Junction, list)
    }

    /// What a keypoint with these openings is.
    pub fn set_kind(&mut self, keypoint: u32, n_openings: usize) {
        let transition = n_openings == 2;
        let kind = if transition { KeypointKind::Transition } else { KeypointKind::Junction };
        self.traced.keypoints.set_kind(keypoint, kind);
    }

    /// The start of the path in the convex corner at the start of an edge, and its governors.
    pub fn corner(&self, corner: u32) -> (Site, Site, Start) {
        let edge = self.domain.edge(corner);
        let start = Start { centre: edge.start, radius: 0.0, doubt: 0.0, triple: None };
        (Site::edge(corner), Site::edge(edge.prev), start)
    }
}

/// The neighbouring contacts of a keypoint that have a path between them, in the order given.
pub(super) fn openings(domain: &Domain, contacts: &[Site]) -> Openings {
    let mut openings = Openings::new();
    for (k, &right) in contacts.iter().enumerate() {
        let left = contacts[if k + 1 < contacts.len() { k + 1 } else { 0 }];
        // Neighbours on the boundary share their footpoint: one run, no path between them.
        if !follows(domain, right, left) {
            openings.push((right, left));
        }
    }
    openings
}

pub(super) fn path(from: u32, to: u32, right: Site, left: Site) -> Path {
    Path { from, to, left: left.0, right: right.0 }
}

impl Start {
    /// Where a path starts that leaves this disk.
    pub fn at(disk: &TouchingDisk) -> Self {
        let Place { centre, radius, doubt } = Place::of(disk);
        Self { centre, radius, doubt, triple: None }
    }
}
