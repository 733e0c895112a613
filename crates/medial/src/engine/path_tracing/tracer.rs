use std::ops::Range;

use super::contacts::{follows, from_least, three_from_least};
use super::finish::{Mark, Traced};
use super::gaps::{Gaps, Open};
use super::hand::{Arrival, Hand, openings, path};
use super::search::{Found, Search};
use crate::axis::{Engine, MedialAxis};
use crate::domain::{Corner, Domain, Site};
use crate::engine::EngineError;
use crate::engine::watch::Watch;

/// How a polygon is traced; each way takes longer than the one before and trusts less.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Care {
    /// Chains of transitions at once; that no ring was lost is counted in the end.
    Quick,
    /// The same, every piece of a path searched for whole rings.
    Rings,
    /// Every path by itself.
    Single,
}

impl Care {
    /// The way to take after this one has failed, if it was our fault and there is one.
    pub fn after(self, error: &EngineError) -> Option<Self> {
        match (error, self) {
            (EngineError::Internal { .. }, Self::Quick) => Some(Self::Rings),
            (EngineError::Internal { .. }, Self::Rings) => Some(Self::Single),
            _ => None,
        }
    }
}

/// More keypoints than there can be with that many edges: an edge and a corner govern at most three
/// each, holes and components some more.
pub(super) fn most_keypoints(n_edges: usize) -> usize {
    8 * n_edges + 64
}

/// The tracing, one path at a time; the paper's stack of paths instead of recursion.
pub(super) struct Tracer<'a> {
    /// Walks of each polygon.
    polygons: Vec<Range<usize>>,
    /// Polygon that is traced next; the hand searches in the one before.
    current: usize,
    pub hand: Hand<'a>,
    /// Convex corners where components of the current polygon start.
    seeds: Vec<u32>,
    /// Paths that wait to be traced.
    gaps: Gaps,
    /// Sites that define the disks of keypoints with open gaps, where these are not their governors.
    triples: Vec<(u32, [Site; 3])>,
    /// For each walk of a polygon with holes whether it governs anything.
    met: Vec<bool>,
    /// Number of the polygon's first walk.
    first_walk: u32,
    /// More keypoints than the current polygon can have.
    most: usize,
    /// What was traced before the current polygon.
    before: Mark,
    /// How the polygons are traced, and how the current one is.
    least_care: Care,
    care: Care,
}

/// The walks of each polygon of a domain.
pub(super) fn polygons(domain: &Domain) -> Result<Vec<Range<usize>>, EngineError> {
    let n_edges = domain.edges().len();
    if n_edges > (u32::MAX / 16) as usize {
        return Err(EngineError::TooLarge { n_edges });
    }
    let mut polygons: Vec<Range<usize>> = Vec::new();
    for (k, walk) in domain.walks().iter().enumerate() {
        match polygons.last_mut() {
            Some(last) if domain.walks()[last.start].polygon == walk.polygon => last.end = k + 1,
            _ => polygons.push(k..k + 1),
        }
    }
    Ok(polygons)
}

/// The convex corner at which a walk around a component is begun.
pub(super) fn seed(domain: &Domain, walk: usize) -> Option<u32> {
    let walk = &domain.walks()[walk];
    let mut corners = walk.edges();
    corners.find(|&k| domain.edge(k).corner == Corner::Convex).filter(|_| !walk.hole)
}

impl<'a> Tracer<'a> {
    pub fn new(domain: &'a Domain, watch: Watch<'a>) -> Result<Self, EngineError> {
        watch.check()?;
        let mut hand = Hand::new(domain, watch);
        let n_holes = domain.walks().iter().filter(|walk| walk.hole).count();
        hand.traced = Traced::with_room(domain.edges().len(), n_holes);
        Ok(Self::over(polygons(domain)?, hand))
    }

    /// The same, every path looked for by itself.
    pub fn one_by_one(domain: &'a Domain, watch: Watch<'a>) -> Result<Self, EngineError> {
        let tracer = Self::new(domain, watch)?;
        Ok(Self { least_care: Care::Single, care: Care::Single, ..tracer })
    }

    /// The tracing of some polygons.
    pub fn over(polygons: Vec<Range<usize>>, hand: Hand<'a>) -> Self {
        Self {
            polygons,
            current: 0,
            hand,
            seeds: Vec::new(),
            gaps: Gaps::default(),
            triples: Vec::new(),
            met: Vec::new(),
            first_walk: 0,
            most: 0,
            before: Mark::default(),
            least_care: Care::Quick,
            care: Care::Quick,
        }
    }

    /// Traces on to the next keypoint that is no plain transition; false when all is done.
    pub fn step(&mut self) -> Result<bool, EngineError> {
        loop {
            while let Some(gap) = self.gaps.pop() {
                match self.trace(gap) {
                    Ok(()) => return Ok(true),
                    Err(error) => self.start_again(error)?,
                }
            }
            if let Some(corner) = self.seeds.pop() {
                let keypoint = self.hand.add_end(corner);
                let (right, left, _) = self.hand.corner(corner);
                self.gaps.push(keypoint, right, left);
                continue;
            }
            if self.met.contains(&false) {
                // A ring that hides between two empty disks governs nothing.
                let place = self.hand.domain.edge(0).start;
                self.met.clear();
                self.start_again(EngineError::Internal { stage: "counting rings", place })?;
                continue;
            }
            self.care = self.least_care;
            let Some(walks) = self.polygons.get(self.current).cloned() else { return Ok(false) };
            self.current += 1;
            self.enter_polygon(walks);
            self.hand.watch.check_now()?;
        }
    }

    /// Goes back to the start of the current polygon, to take more care.
    fn start_again(&mut self, error: EngineError) -> Result<(), EngineError> {
        self.care = self.care.after(&error).ok_or(error)?;
        self.hand.traced.go_back(self.before);
        self.seeds.clear();
        self.met.clear();
        let Some(walks) = self.polygons.get(self.current - 1).cloned() else { return Err(error) };
        self.enter_polygon(walks);
        Ok(())
    }

    fn enter_polygon(&mut self, walks: Range<usize>) {
        self.before = self.hand.traced.mark();
        let Hand { domain, watch, .. } = &self.hand;
        let all = &domain.walks()[walks.clone()];
        let loops = all.iter().any(|w| w.hole);
        let n_edges: u32 = all.iter().map(|w| w.len).sum();
        self.gaps.reset(2 * all[0].first, 2 * n_edges, loops);
        self.triples.clear();
        self.seeds.extend(walks.clone().rev().filter_map(|walk| seed(domain, walk)));
        self.met.clear();
        if loops {
            // Outer rings meet the axis at their convex corners.
            self.met.extend(all.iter().map(|w| !w.hole));
        }
        self.first_walk = walks.start as u32;
        self.most = most_keypoints(n_edges as usize);
        let mut search = Search::new(domain, walks, watch.clone());
        search.careful = self.care > Care::Quick;
        self.hand.single = self.care == Care::Single;
        self.hand.search = Some(search);
    }

    fn trace(&mut self, gap: Open) -> Result<(), EngineError> {
        let Open { keypoint, right, left, .. } = gap;
        let triple = self.triple(keypoint);
        let start = self.hand.traced.start(keypoint, triple);
        let Arrival { from, right, left, found } =
            self.hand.follow(keypoint, right, left, start, self.gaps.closing())?;
        let to = match found {
            Found::Corner(corner) => self.hand.add_end(corner),
            Found::Known(to) => {
                self.gaps.close(left, right, |k| k == to);
                to
            }
            Found::Disk { disk, triple, contacts, own } => {
                let list = from_least(&contacts);
                // The path seen from its other end has its governors the other way round.
                let traced = &self.hand.traced;
                match self.gaps.close(left, right, |k| traced.has_governors(k, &list)) {
                    Some(to) => to,
                    None => {
                        let to = self.hand.add_keypoint(&disk, triple, &list, own)?;
                        let place = disk.position();
                        self.leave(to, triple, &list, right, left)
                            .ok_or(EngineError::Internal { stage: "closing a path", place })?;
                        to
                    }
                }
            }
        };
        self.hand.traced.add_path(&path(from, to, right, left));
        if self.hand.traced.since(self.before) > self.most {
            let place = start.centre;
            return Err(EngineError::Internal { stage: "counting keypoints", place });
        }
        Ok(())
    }

    /// Sites that define the disk of a keypoint from which a path leaves, which was the last to wait.
    fn triple(&mut self, keypoint: u32) -> [Site; 3] {
        // What was noted since then is not needed any more.
        while self.triples.last().is_some_and(|(noted, _)| *noted > keypoint) {
            self.triples.pop();
        }
        match (self.triples.last(), self.hand.traced.keypoints.governors(keypoint)) {
            (Some((noted, triple)), _) if *noted == keypoint => *triple,
            (_, &[a, b, c]) => [a, b, c].map(Site),
            // In a convex corner none is needed.
            (_, list) => [0, 0, 0].map(|k| Site(list[k])),
        }
    }

    /// Puts the paths that leave a new keypoint onto the stack: all but the one between `right` and
    /// `left`, which has arrived.
    fn leave(
        &mut self,
        keypoint: u32,
        triple: [Site; 3],
        list: &[Site],
        right: Site,
        left: Site,
    ) -> Option<()> {
        if self.gaps.closing().is_some() {
            for site in list {
                let walk = self.hand.domain.edge(site.index()).walk;
                self.met[(walk - self.first_walk) as usize] = true;
            }
        }
        let n_openings = self.push_openings(keypoint, list, right, left)?;
        if three_from_least(triple)[..] != *list {
            self.triples.push((keypoint, triple));
        }
        self.hand.set_kind(keypoint, n_openings);
        Some(())
    }

    /// The same for the stack only; gives the number of paths that meet in the keypoint.
    #[inline]
    fn push_openings(
        &mut self,
        keypoint: u32,
        list: &[Site],
        right: Site,
        left: Site,
    ) -> Option<usize> {
        let domain = self.hand.domain;
        if let [Site(a), Site(b), Site(c)] = *list {
            let third = Site(a ^ b ^ c ^ right.0 ^ left.0);
            if three_from_least([left, right, third])[..] == *list && !follows(domain, left, right)
            {
                let mut n_openings = 1;
                // What follows the arrival is traced first.
                for (right, left) in [(third, left), (right, third)] {
                    if !follows(domain, right, left) {
                        self.gaps.push(keypoint, right, left);
                        n_openings += 1;
                    }
                }
                return Some(n_openings);
            }
        }
        let openings = openings(domain, list);
        let arrived = openings.iter().position(|&o| o == (left, right))?;
        let (before, after) = (&openings[..arrived], &openings[arrived + 1..]);
        for &(right, left) in before.iter().rev().chain(after.iter().rev()) {
            self.gaps.push(keypoint, right, left);
        }
        Some(openings.len())
    }

    /// The axis: every position computed as precisely as promised.
    pub fn finish(self) -> Result<MedialAxis, EngineError> {
        // What is not needed any more makes room for the answer.
        let Self { hand: Hand { domain, traced, watch, search, .. }, gaps, triples, .. } = self;
        drop((search, gaps, triples));
        traced.finish(domain, &watch, Engine::PathTracing)
    }
}
