use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::ops::Range;

use super::contacts::follows;
use super::positions::position;
use super::search::{Candidate, Found, Search, Start};
use crate::axis::{self, Accuracy, Engine, KeypointKind, MedialAxis, Path, Side, SiteKind};
use crate::domain::{Corner, Domain, Site};
use crate::engine::EngineError;
use crate::geom::{Point, TouchingDisk};

/// A keypoint while the axis grows.
#[derive(Clone, Debug)]
struct Knot {
    centre: Point,
    radius: f64,
    /// Bound on the error of both.
    doubt: f64,
    /// Sites that define its exact disk; `None` at a convex corner.
    triple: Option<[Site; 3]>,
    /// Its contacts, counterclockwise, in the common list.
    contacts: Range<usize>,
    /// Its gaps in the common list.
    gaps: Range<usize>,
}

/// Room for a path between two neighbouring contact runs of a keypoint.
#[derive(Clone, Copy, Debug)]
struct GapRecord {
    knot: u32,
    right: Site,
    left: Site,
    /// No path has used it yet.
    open: bool,
}

/// A path between two knots.
#[derive(Clone, Copy, Debug)]
struct Traced {
    from: u32,
    to: u32,
    right: Site,
    left: Site,
}

/// The tracing, one path at a time; the paper's stack of paths instead of recursion.
pub(super) struct Tracer<'a> {
    domain: &'a Domain,
    /// Walks of each polygon.
    polygons: Vec<Range<usize>>,
    /// Polygon that is being traced, and its search.
    current: usize,
    search: Option<Search<'a>>,
    /// Convex corners where components of the current polygon start.
    seeds: Vec<u32>,
    stack: Vec<u32>,
    knots: Vec<Knot>,
    contacts: Vec<Site>,
    gaps: Vec<GapRecord>,
    paths: Vec<Traced>,
    /// Knots by the hash of their cyclic governor list; only looked up, never iterated.
    known: HashMap<u64, Vec<u32>>,
    loops_possible: bool,
}

impl<'a> Tracer<'a> {
    pub fn new(domain: &'a Domain) -> Result<Self, EngineError> {
        let n_edges = domain.edges().len();
        if n_edges > (u32::MAX / 8) as usize {
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
        Ok(Self {
            domain,
            polygons,
            current: 0,
            search: None,
            seeds: Vec::new(),
            stack: Vec::new(),
            knots: Vec::with_capacity(2 * n_edges),
            contacts: Vec::with_capacity(6 * n_edges),
            gaps: Vec::with_capacity(4 * n_edges),
            paths: Vec::with_capacity(2 * n_edges),
            known: HashMap::new(),
            loops_possible: false,
        })
    }

    /// Traces one more path; false when all is done.
    pub fn step(&mut self) -> Result<bool, EngineError> {
        loop {
            while let Some(gap) = self.stack.pop() {
                if self.gaps[gap as usize].open {
                    self.trace(gap)?;
                    return Ok(true);
                }
            }
            if let Some(corner) = self.seeds.pop() {
                let knot = self.add_end(corner);
                self.stack.extend(self.knots[knot as usize].gaps.clone().map(|g| g as u32));
                continue;
            }
            let Some(walks) = self.polygons.get(self.current).cloned() else { return Ok(false) };
            self.current += 1;
            self.enter_polygon(walks);
        }
    }

    fn enter_polygon(&mut self, walks: Range<usize>) {
        let domain = self.domain;
        self.known.clear();
        self.loops_possible = domain.walks()[walks.clone()].iter().any(|w| w.hole);
        for walk in domain.walks()[walks.clone()].iter().rev().filter(|w| !w.hole) {
            let convex = (walk.first..walk.first + walk.len)
                .find(|&k| domain.edge(k).corner == Corner::Convex);
            self.seeds.extend(convex);
        }
        self.search = Some(Search::new(domain, walks));
    }

    fn trace(&mut self, gap: u32) -> Result<(), EngineError> {
        let GapRecord { knot, right, left, .. } = self.gaps[gap as usize];
        let from = &self.knots[knot as usize];
        let Knot { centre, radius, doubt, triple, .. } = *from;
        let start = Start { centre, radius, doubt, triple };
        let broken = |stage| EngineError::Internal { stage, place: start.centre };
        let search = self.search.as_mut().ok_or(broken("preparing the search"))?;
        let found = search.find(right, left, start)?;
        self.gaps[gap as usize].open = false;
        let to = match found {
            Found::Corner(corner) => {
                let to = self.add_end(corner);
                let gaps = self.knots[to as usize].gaps.clone();
                self.gaps[gaps.start].open = false;
                to
            }
            Found::Disk { disk, triple, contacts } => {
                let to = match self.known_knot(&contacts) {
                    Some(to) => to,
                    None => {
                        let to = self.add_knot(&disk, triple, &contacts);
                        // The path that continues this one is traced first.
                        let gaps = self.knots[to as usize].gaps.clone();
                        self.stack.extend(gaps.rev().map(|g| g as u32));
                        to
                    }
                };
                // The path seen from its other end has its governors the other way round.
                let gaps = self.knots[to as usize].gaps.clone();
                let arrival = self.gaps[gaps.clone()]
                    .iter()
                    .position(|g| g.open && g.right == left && g.left == right)
                    .ok_or(broken("closing a path"))?;
                self.gaps[gaps.start + arrival].open = false;
                to
            }
        };
        self.paths.push(Traced { from: knot, to, right, left });
        Ok(())
    }

    /// Adds the end keypoint in the convex corner at the start of an edge.
    fn add_end(&mut self, corner: u32) -> u32 {
        let edge = self.domain.edge(corner);
        let first = self.contacts.len();
        self.contacts.extend([Site::edge(edge.prev), Site::edge(corner)]);
        let knot = self.knots.len() as u32;
        let gap = self.gaps.len();
        self.gaps.push(GapRecord {
            knot,
            right: Site::edge(corner),
            left: Site::edge(edge.prev),
            open: true,
        });
        self.knots.push(Knot {
            centre: edge.start,
            radius: 0.0,
            doubt: 0.0,
            triple: None,
            contacts: first..first + 2,
            gaps: gap..gap + 1,
        });
        knot
    }

    fn add_knot(&mut self, disk: &TouchingDisk, triple: [Site; 3], contacts: &[Site]) -> u32 {
        let centre = disk.position();
        let rounding = centre.x.abs() + centre.y.abs() + disk.origin.x.abs() + disk.origin.y.abs();
        let knot = self.knots.len() as u32;
        let first = self.contacts.len();
        self.contacts.extend_from_slice(contacts);
        let first_gap = self.gaps.len();
        let n = contacts.len();
        for k in 0..n {
            let (right, left) = (contacts[k], contacts[(k + 1) % n]);
            // Neighbours on the boundary share their footpoint: one run, no path between them.
            if !follows(self.domain, right, left) {
                self.gaps.push(GapRecord { knot, right, left, open: true });
            }
        }
        if self.loops_possible {
            self.known.entry(hash(contacts)).or_default().push(knot);
        }
        self.knots.push(Knot {
            centre,
            radius: disk.radius,
            doubt: disk.bound + f64::EPSILON * rounding,
            triple: Some(triple),
            contacts: first..first + n,
            gaps: first_gap..self.gaps.len(),
        });
        knot
    }

    /// The keypoint with the same cyclic governor list, if there is one.
    fn known_knot(&self, contacts: &[Site]) -> Option<u32> {
        if !self.loops_possible {
            return None;
        }
        self.known.get(&hash(contacts))?.iter().copied().find(|&k| {
            let list = &self.contacts[self.knots[k as usize].contacts.clone()];
            list.len() == contacts.len() && from_least(list).eq(from_least(contacts))
        })
    }

    /// The axis: every position computed once more, as precisely as promised.
    pub fn finish(self) -> Result<MedialAxis, EngineError> {
        let domain = self.domain;
        // Sites that govern something, numbered in boundary order.
        let mut number = vec![u32::MAX; 2 * domain.edges().len()];
        for site in &self.contacts {
            number[site.0 as usize] = 0;
        }
        let mut used: Vec<Site> = Vec::new();
        for (site, slot) in (0_u32..).map(Site).zip(&mut number) {
            if *slot == 0 {
                *slot = used.len() as u32;
                used.push(site);
            }
        }
        let number = |s: &Site| number[s.0 as usize];
        let governors: Vec<u32> = self
            .knots
            .iter()
            .flat_map(|knot| from_least(&self.contacts[knot.contacts.clone()]))
            .map(number)
            .collect();
        let mut keypoints = Vec::with_capacity(self.knots.len());
        for knot in &self.knots {
            let list = &self.contacts[knot.contacts.clone()];
            let (centre, radius) = match &knot.triple {
                None => (knot.centre, 0.0),
                Some(triple) => {
                    position(domain, list, triple, knot.centre, knot.radius, knot.doubt).ok_or(
                        EngineError::Internal { stage: "placing a keypoint", place: knot.centre },
                    )?
                }
            };
            let kind = match knot.gaps.len() {
                1 => KeypointKind::End,
                2 => KeypointKind::Transition,
                _ => KeypointKind::Junction,
            };
            keypoints.push((centre, radius, kind, &governors[knot.contacts.clone()]));
        }
        let paths = self
            .paths
            .iter()
            .map(|p| Path {
                from: p.from,
                to: p.to,
                left: number(&p.left),
                right: number(&p.right),
            })
            .collect();
        let sites = used.iter().map(|&s| site_record(domain, s)).collect();
        MedialAxis::from_parts(
            Engine::PathTracing,
            Side::Interior,
            Accuracy::Exact,
            true,
            sites,
            keypoints,
            paths,
        )
        .ok_or(EngineError::Internal { stage: "numbering sites", place: Point::default() })
    }
}

/// A cyclic list from its smallest member on.
fn from_least(list: &[Site]) -> impl Iterator<Item = &Site> {
    let least = (0..list.len()).min_by_key(|&k| list[k]).unwrap_or(0);
    list[least..].iter().chain(&list[..least])
}

fn hash(contacts: &[Site]) -> u64 {
    let mut hasher = DefaultHasher::new();
    for site in from_least(contacts) {
        site.hash(&mut hasher);
    }
    hasher.finish()
}

fn site_record(domain: &Domain, site: Site) -> axis::Site {
    let k = site.index();
    let origin = domain.origin(k);
    let a = domain.edge(k).start;
    if site.is_edge() {
        axis::Site {
            kind: SiteKind::Edge,
            polygon: origin.polygon,
            ring: origin.ring,
            index: origin.index,
            part: origin.part,
            a,
            b: domain.end(k),
        }
    } else {
        axis::Site {
            kind: SiteKind::Vertex,
            polygon: origin.polygon,
            ring: origin.corner.ring,
            index: origin.corner.index,
            part: origin.corner.part,
            a,
            b: a,
        }
    }
}

/// One traced path, as a value to look at.
///
/// Centres and radii are those of the tracing, within their bounds; `path_tracing` places keypoints
/// once more, to within 4 ulp.
#[derive(Clone, Debug)]
pub struct Step {
    /// Centre and radius where the path starts.
    pub from: (Point, f64),
    /// Centre and radius where the path ends.
    pub to: (Point, f64),
    /// Isooriented governor: to the right of the motion.
    pub right: Site,
    /// Counteroriented governor: to the left of the motion.
    pub left: Site,
    /// All governors at the end of the path, counterclockwise by footpoint.
    pub governors: Vec<Site>,
    /// Third governors that were tried, in order, each with the disk proposed for it; the last one
    /// held. None where nothing but a convex corner was met.
    pub candidates: Vec<Candidate>,
    /// Whether the path ended at a keypoint known already.
    pub closes_loop: bool,
}

/// The paths of a domain's axis in the order of their tracing.
pub struct Steps<'a> {
    tracer: Tracer<'a>,
    failed: bool,
}

impl<'a> Steps<'a> {
    pub(super) fn new(domain: &'a Domain) -> Result<Self, EngineError> {
        Ok(Self { tracer: Tracer::new(domain)?, failed: false })
    }
}

impl Iterator for Steps<'_> {
    type Item = Result<Step, EngineError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.failed {
            return None;
        }
        let known = self.tracer.knots.len();
        match self.tracer.step() {
            Ok(false) => None,
            Err(error) => {
                self.failed = true;
                Some(Err(error))
            }
            Ok(true) => {
                let path = *self.tracer.paths.last()?;
                let knot = |k: u32| &self.tracer.knots[k as usize];
                let (from, to) = (knot(path.from), knot(path.to));
                let search = self.tracer.search.as_ref();
                Some(Ok(Step {
                    from: (from.centre, from.radius),
                    to: (to.centre, to.radius),
                    right: path.right,
                    left: path.left,
                    governors: self.tracer.contacts[to.contacts.clone()].to_vec(),
                    candidates: search.map_or_else(Vec::new, |s| s.tried.clone()),
                    closes_loop: (path.to as usize) < known,
                }))
            }
        }
    }
}
