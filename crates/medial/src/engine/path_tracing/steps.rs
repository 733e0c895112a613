//! The tracing as values to look at, one path at a time.

use super::search::Candidate;
use super::tracer::Tracer;
use crate::domain::{Domain, Site};
use crate::engine::watch::Watch;
use crate::engine::{EngineError, Options};
use crate::geom::Point;

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
        let tracer = Tracer::one_by_one(domain, Watch::new(&Options::default()))?;
        Ok(Self { tracer, failed: false })
    }
}

impl Iterator for Steps<'_> {
    type Item = Result<Step, EngineError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.failed {
            return None;
        }
        let known = self.tracer.hand.traced.keypoints.len();
        match self.tracer.step() {
            Ok(false) => None,
            Err(error) => {
                self.failed = true;
                Some(Err(error))
            }
            Ok(true) => {
                let traced = &self.tracer.hand.traced;
                let path = traced.path(traced.paths.len().checked_sub(1)?);
                let disk = |k: u32| {
                    let keypoint = traced.keypoints.at(k);
                    (keypoint.position, keypoint.radius)
                };
                let search = self.tracer.hand.search.as_ref();
                Some(Ok(Step {
                    from: disk(path.from),
                    to: disk(path.to),
                    right: Site(path.right),
                    left: Site(path.left),
                    governors: traced.governors_of(path.to),
                    candidates: search.map_or_else(Vec::new, |s| s.tried.clone()),
                    closes_loop: path.to < known,
                }))
            }
        }
    }
}
