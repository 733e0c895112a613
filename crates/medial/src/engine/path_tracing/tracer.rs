use std::ops::Range;

use super::chain::Passed;
use super::contacts::{Contacts, follows};
use super::finish::{Mark, Traced};
use super::gaps::Gaps;
use super::search::{Found, Search, Start};
use crate::axis::{KeypointKind, MedialAxis, Path};
use crate::domain::{Corner, Domain, Site};
use crate::engine::EngineError;
use crate::geom::{Point, TouchingDisk};

/// A path that waits to be traced.
#[derive(Clone, Copy, Debug)]
struct Pending {
    /// Keypoint where it starts.
    keypoint: u32,
    right: Site,
    left: Site,
    /// Number among the open gaps, where loops may close.
    gap: Option<u32>,
    start: Start,
}

/// How a polygon is traced; each way takes longer than the one before and trusts less.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Care {
    /// Chains of transitions at once; that no ring was lost is counted in the end.
    Quick,
    /// The same, every piece of a path searched for whole rings.
    Rings,
    /// Every path by itself.
    Single,
}

/// The tracing, one path at a time; the paper's stack of paths instead of recursion.
pub(super) struct Tracer<'a> {
    domain: &'a Domain,
    /// Walks of each polygon.
    polygons: Vec<Range<usize>>,
    /// Polygon that is traced next, and the search in the one before.
    current: usize,
    pub search: Option<Search<'a>>,
    /// Convex corners where components of the current polygon start.
    seeds: Vec<u32>,
    stack: Vec<Pending>,
    /// Open gaps by their governors; `None` where no loop can close.
    gaps: Option<Gaps>,
    /// For each walk of a polygon with holes whether it governs anything.
    met: Vec<bool>,
    /// Number of the polygon's first walk.
    first_walk: u32,
    /// More keypoints than the current polygon can have.
    most: usize,
    /// What was traced before the current polygon.
    before: Mark,
    pub traced: Traced,
    /// How the polygons are traced, and how the current one is.
    least_care: Care,
    care: Care,
}

impl<'a> Tracer<'a> {
    pub fn new(domain: &'a Domain) -> Result<Self, EngineError> {
        let n_edges = domain.edges().len();
        if n_edges > (u32::MAX / 16) as usize {
            return Err(EngineError::TooLarge { n_edges });
        }
        let mut polygons: Vec<Range<usize>> = Vec::new();
        for (k, walk) in domain.walks().iter().enumerate() {
            match polygons.last_mut() {
                Some(last) if domain.walks()[last.start].polygon == walk.polygon => {
                    last.end = k + 1;
                }
                _ => polygons.push(k..k + 1),
            }
        }
        let n_holes = domain.walks().iter().filter(|walk| walk.hole).count();
        Ok(Self {
            domain,
            polygons,
            current: 0,
            search: None,
            seeds: Vec::new(),
            stack: Vec::new(),
            gaps: None,
            met: Vec::new(),
            first_walk: 0,
            most: 0,
            before: Mark::default(),
            traced: Traced::with_room(n_edges, n_holes),
            least_care: Care::Quick,
            care: Care::Quick,
        })
    }

    /// The same, every path looked for by itself.
    pub fn one_by_one(domain: &'a Domain) -> Result<Self, EngineError> {
        let tracer = Self::new(domain)?;
        Ok(Self { least_care: Care::Single, care: Care::Single, ..tracer })
    }

    /// Traces on to the next keypoint that is no plain transition; false when all is done.
    pub fn step(&mut self) -> Result<bool, EngineError> {
        loop {
            while let Some(pending) = self.stack.pop() {
                let taken = match (&mut self.gaps, pending.gap) {
                    (Some(gaps), Some(gap)) => gaps.take(gap),
                    _ => true,
                };
                if taken {
                    match self.trace(pending) {
                        Ok(()) => return Ok(true),
                        Err(error) => self.start_again(error)?,
                    }
                }
            }
            if let Some(corner) = self.seeds.pop() {
                let keypoint = self.add_end(corner);
                let edge = self.domain.edge(corner);
                let start = Start { centre: edge.start, radius: 0.0, doubt: 0.0, triple: None };
                let (right, left) = (Site::edge(corner), Site::edge(edge.prev));
                self.stack.push(Pending { keypoint, right, left, gap: None, start });
                continue;
            }
            if self.met.contains(&false) {
                // A ring that hides between two empty disks governs nothing.
                let place = self.domain.edge(0).start;
                self.met.clear();
                self.start_again(EngineError::Internal { stage: "counting rings", place })?;
                continue;
            }
            self.care = self.least_care;
            let Some(walks) = self.polygons.get(self.current).cloned() else { return Ok(false) };
            self.current += 1;
            self.enter_polygon(walks);
        }
    }

    /// Goes back to the start of the current polygon, to take more care.
    fn start_again(&mut self, error: EngineError) -> Result<(), EngineError> {
        self.care = match (&error, self.care) {
            (EngineError::Internal { .. }, Care::Quick) => Care::Rings,
            (EngineError::Internal { .. }, Care::Rings) => Care::Single,
            _ => return Err(error),
        };
        self.traced.go_back(self.before);
        self.stack.clear();
        self.seeds.clear();
        self.met.clear();
        let Some(walks) = self.polygons.get(self.current - 1).cloned() else { return Err(error) };
        self.enter_polygon(walks);
        Ok(())
    }

    fn enter_polygon(&mut self, walks: Range<usize>) {
        let domain = self.domain;
        self.before = self.traced.mark();
        let all = &domain.walks()[walks.clone()];
        let loops = all.iter().any(|w| w.hole);
        self.gaps = loops.then(|| {
            let n_edges: u32 = all.iter().map(|w| w.len).sum();
            Gaps::new(2 * all[0].first, 2 * n_edges)
        });
        for walk in all.iter().rev().filter(|w| !w.hole) {
            let convex = (walk.first..walk.first + walk.len)
                .find(|&k| domain.edge(k).corner == Corner::Convex);
            self.seeds.extend(convex);
        }
        self.met.clear();
        if loops {
            // Outer rings meet the axis at their convex corners.
            self.met.extend(all.iter().map(|w| !w.hole));
        }
        self.first_walk = walks.start as u32;
        // An edge and a corner govern at most three each, holes and components some more.
        let n_edges: u32 = all.iter().map(|w| w.len).sum();
        self.most = 8 * n_edges as usize + 64;
        let mut search = Search::new(domain, walks);
        search.careful = self.care > Care::Quick;
        self.search = Some(search);
    }

    fn trace(&mut self, pending: Pending) -> Result<(), EngineError> {
        let Pending { mut keypoint, mut right, mut left, start, .. } = pending;
        let broken = |stage| EngineError::Internal { stage, place: start.centre };
        let search = self.search.as_mut().ok_or(broken("preparing the search"))?;
        let chased =
            if self.care == Care::Single { None } else { search.chase(right, left, start) };
        let found = match chased {
            Some(found) => {
                (right, left) = search.link;
                for passed in &search.passed {
                    let to = self.traced.add_transition(passed);
                    let Passed { right, left, .. } = *passed;
                    self.traced.paths.push(path(keypoint, to, right, left));
                    keypoint = to;
                }
                found
            }
            None => search.find(right, left, start)?,
        };
        let to = match found {
            Found::Corner(corner) => self.add_end(corner),
            Found::Disk { disk, triple, contacts, fixed } => {
                let list: Contacts = from_least(&contacts).copied().collect();
                // The path seen from its other end has its governors the other way round.
                let known = self.gaps.as_mut().and_then(|gaps| {
                    gaps.close(left, right, |k| self.traced.has_governors(k, &list))
                });
                match known {
                    Some(to) => to,
                    None => {
                        let to = self.add_keypoint(&disk, triple, &list, fixed);
                        self.leave(to, &disk, triple, &contacts, right, left)
                            .ok_or(broken("closing a path"))?;
                        to
                    }
                }
            }
        };
        self.traced.paths.push(path(keypoint, to, right, left));
        if self.traced.since(self.before) > self.most {
            return Err(broken("counting keypoints"));
        }
        Ok(())
    }

    /// Puts the paths that leave a new keypoint onto the stack: all but the one between `right` and
    /// `left`, which has arrived.
    fn leave(
        &mut self,
        keypoint: u32,
        disk: &TouchingDisk,
        triple: [Site; 3],
        contacts: &[Site],
        right: Site,
        left: Site,
    ) -> Option<()> {
        if self.gaps.is_some() {
            for site in contacts {
                let walk = self.domain.edge(site.index()).walk;
                self.met[(walk - self.first_walk) as usize] = true;
            }
        }
        let n = contacts.len();
        let start = Start { triple: Some(triple), ..Start::at(disk) };
        let mut arrived = false;
        let mut n_gaps = 0;
        // What follows the arrival is traced first.
        for k in (0..n).rev() {
            let (r, l) = (contacts[k], contacts[(k + 1) % n]);
            // Neighbours on the boundary share their footpoint: one run, no path between them.
            if follows(self.domain, r, l) {
                continue;
            }
            n_gaps += 1;
            if (r, l) == (left, right) && !arrived {
                arrived = true;
                continue;
            }
            let gap = self.gaps.as_mut().map(|gaps| gaps.open(keypoint, r, l));
            self.stack.push(Pending { keypoint, right: r, left: l, gap, start });
        }
        self.traced.keypoints[keypoint as usize].kind =
            if n_gaps == 2 { KeypointKind::Transition } else { KeypointKind::Junction };
        arrived.then_some(())
    }

    /// Adds the end keypoint in the convex corner at the start of an edge.
    fn add_end(&mut self, corner: u32) -> u32 {
        let edge = self.domain.edge(corner);
        let (a, b) = (Site::edge(edge.prev), Site::edge(corner));
        self.traced.add(edge.start, 0.0, KeypointKind::End, &[a.min(b), a.max(b)])
    }

    fn add_keypoint(
        &mut self,
        disk: &TouchingDisk,
        triple: [Site; 3],
        list: &[Site],
        fixed: bool,
    ) -> u32 {
        // The position depends on the governors only, not on how the keypoint was found.
        let own = match *list {
            _ if fixed => Some(*disk),
            [a, b, c] => TouchingDisk::touching(&self.domain.governors([a, b, c])),
            _ => None,
        };
        self.traced.add_disk(own.as_ref(), disk, triple, list)
    }

    /// The axis: every position computed as precisely as promised.
    pub fn finish(self) -> Result<MedialAxis, EngineError> {
        // What is not needed any more makes room for the answer.
        let Self { domain, traced, search, gaps, stack, .. } = self;
        drop((search, gaps, stack));
        traced.finish(domain)
    }
}

fn path(from: u32, to: u32, right: Site, left: Site) -> Path {
    Path { from, to, left: left.0, right: right.0 }
}

/// A cyclic list from its smallest member on.
pub(super) fn from_least(list: &[Site]) -> impl Iterator<Item = &Site> {
    let least = (0..list.len()).min_by_key(|&k| list[k]).unwrap_or(0);
    list[least..].iter().chain(&list[..least])
}

impl Start {
    /// Where a path starts that leaves this disk.
    pub fn at(disk: &TouchingDisk) -> Self {
        let centre = disk.position();
        let size = |p: Point| p.x.abs() + p.y.abs();
        let rounding = f64::EPSILON * (size(centre) + size(disk.origin));
        Self { centre, radius: disk.radius, doubt: disk.bound + rounding, triple: None }
    }
}
