//! Traces the axis path by path, from a convex corner, after [JPV].
//!
//! # Contract
//! The exact medial axis of the interior: keypoints, paths, governors and their order are those
//! of the true axis of the coordinates as given; positions and radii are within 4 ulp of
//! max(|x|, |y|, radius). Any number of holes, rings that touch, several polygons. About
//! O(n log n) on shapes met in practice; no worst-case bound is proved.
//!
//! # Method
//! 1. Start in a convex corner with its two edges as governors [JPV, §3.2].
//! 2. Find the end of the path: the next empty disk that touches a third element [JPV, §3.1].
//!    The right governor is *isooriented*: its footpoint runs along with the boundary; the left
//!    one is *counteroriented*.
//! 3. From the keypoint found, one new path leaves between each two neighbouring contacts
//!    [JPV, §3.3]; they go onto a stack. A path that arrives at a keypoint known already, told by
//!    its cyclic governor list, closes a loop.
//!
//! # Departures
//! - Decisions are exact: doubles propose a disk, a certificate or exact arithmetic decides
//!   whether it is empty, what touches it and in which zone.
//! - The paper looks for every transition; here a chain of them is proved by the empty disk at its
//!   end (`chain.rs`).
//! - The paper checks the end of a path only; a whole ring between two empty disks would be lost.
//!   Here every ring must have been met in the end; if not, the polygon is traced again, and an index
//!   over one corner of each hole is asked what lies between the disks of each piece.
//! - A keypoint known already that waits for a path between the same two governors ahead is its end
//!   without any search, unless a whole ring lies in between (`gaps.rs`).
//! - Contacts that tie are collected at once, so no path has length zero.
//! - Where no half-line bounds a path [JPV, Fig. 12] a growing probe finds the third governor.

mod chain;
mod course;
mod finish;
mod front;
mod gaps;
mod hand;
mod holes;
mod met;
mod nearby;
mod order;
#[cfg(feature = "parallel")]
mod parallel;
mod probe;
mod rings;
mod search;
mod settle;
mod steps;
mod touch;
mod tracer;
mod verify;

pub use search::Candidate;
pub use steps::{Step, Steps};

use super::draft::contacts;
use super::watch::Watch;
use super::{EngineError, Options};
use crate::axis::MedialAxis;
use crate::domain::Domain;
use tracer::Tracer;

/// The exact medial axis of the interior of a domain.
///
/// # Errors
/// [`EngineError::Internal`] if an invariant of the engine breaks, which no input should cause.
pub fn path_tracing(domain: &Domain) -> Result<MedialAxis, EngineError> {
    path_tracing_with(domain, &Options::default())
}

/// The same on several threads, and within limits. The axis is the same bit for bit.
///
/// # Errors
/// As [`path_tracing`]; and [`EngineError::Cancelled`] or [`EngineError::TimeLimit`].
pub fn path_tracing_with(
    domain: &Domain,
    options: &Options<'_>,
) -> Result<MedialAxis, EngineError> {
    #[cfg(feature = "parallel")]
    if options.threads.get() > 1 && domain.edges().len() >= options.alone_below {
        // What several hands could not finish, one finishes with more care.
        match parallel::trace(domain, options) {
            Err(EngineError::Internal { .. }) => {}
            done => return done,
        }
    }
    let mut tracer = Tracer::new(domain, Watch::new(options))?;
    while tracer.step()? {}
    tracer.finish()
}

/// The same, one path at a time, as values to look at: for a picture or an animation.
///
/// # Errors
/// As [`path_tracing`].
pub fn path_tracing_steps(domain: &Domain) -> Result<Steps<'_>, EngineError> {
    Steps::new(domain)
}
