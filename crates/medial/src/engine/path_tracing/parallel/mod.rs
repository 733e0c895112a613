//! The same tracing on several threads, with the same result bit for bit.
//!
//! # Contract
//! The axis is that of one thread, whatever the number of threads: its keypoints, paths and their
//! numbers do not depend on who traced what and when.
//!
//! # Method
//! 1. A polygon is begun in several convex corners at once. Without holes, what lies ahead of a path
//!    is a range of the boundary; where no other beginning is in it, all beyond that path is traced
//!    by one thread, as if it were alone, into one block.
//! 2. Elsewhere paths may meet. Each keypoint there is kept in a table under its governors, with its
//!    gaps. A block is then one path with its transitions, from a gap to the next keypoint. Two
//!    threads may trace it from both ends; one of the two blocks is left out in the end.
//! 3. Who has nothing to do gets half of what another thread would do last.
//! 4. At last the blocks are put together in the order in which one thread would have traced them
//!    ([`replay`]).
//!
//! Every decision is exact and every position depends on the governors only, so a path is the same
//! from whichever end it is traced.

mod gather;
mod meetings;
mod pool;
mod replay;
mod seeds;
mod worker;

use std::ops::Range;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, AtomicU32};
use std::thread;

use self::meetings::Meetings;
use self::pool::{Pool, StopOnPanic};
use self::seeds::Seeds;
use self::worker::{Share, Task, Worker};
use super::search::Index;
use super::tracer::{Care, polygons};
use crate::axis::MedialAxis;
use crate::domain::Domain;
use crate::engine::watch::Watch;
use crate::engine::{EngineError, Options, threads};
use crate::geom::Point;

/// Beginnings for each thread.
const SEEDS: usize = 4;

/// Edges of small polygons that make one task.
const CHUNK: usize = 1000;

/// What the threads share.
struct Shared<'a> {
    domain: &'a Domain,
    care: Care,
    /// Polygons that several threads trace together.
    large: Vec<Large>,
    /// The others, in groups.
    chunks: Vec<Vec<Range<usize>>>,
    /// What makes up the axis, in order.
    order: Vec<Part>,
    pool: Pool<Task>,
    /// Blocks that were handed on so far.
    n_given: AtomicU32,
}

/// A polygon traced by several threads.
struct Large {
    walks: Range<usize>,
    /// Made by the first who needs it.
    index: OnceLock<Index>,
    seeds: Seeds,
    /// Whether each of the seeds was met by a path.
    met: Vec<AtomicBool>,
    meetings: Meetings,
}

/// One or more polygons.
#[derive(Clone, Copy, Debug)]
enum Part {
    Large(usize),
    Chunk(usize),
}

/// The axis, computed by several threads.
pub(super) fn trace(domain: &Domain, options: &Options<'_>) -> Result<MedialAxis, EngineError> {
    let watch = Watch::new(options);
    watch.check()?;
    let mut care = Care::Quick;
    loop {
        let error = match attempt(domain, options, &watch, care) {
            Ok(Some(axis)) => return Ok(axis),
            // A ring that hides between two empty disks governs nothing.
            Ok(None) => EngineError::Internal {
                stage: "counting rings",
                place: domain.edges().first().map_or(Point::default(), |e| e.start),
            },
            Err(error) => error,
        };
        care = care.after(&error).ok_or(error)?;
    }
}

/// The axis; `None` if a hole was overlooked.
fn attempt(
    domain: &Domain,
    options: &Options<'_>,
    watch: &Watch<'_>,
    care: Care,
) -> Result<Option<MedialAxis>, EngineError> {
    let threads = threads::number(options);
    let shared = Shared::new(domain, polygons(domain)?, options.alone_below, threads, care);
    let mut workers: Vec<Worker<'_, '_>> = (0..threads)
        .map(|number| Worker::new(&shared, number as u32, watch.with(&shared.pool.stop)))
        .collect();
    let (own, others) = workers.split_at_mut(1);
    thread::scope(|scope| {
        let _stop = StopOnPanic(&shared.pool);
        for worker in others {
            let work = || {
                let _stop = StopOnPanic(&shared.pool);
                worker.work();
            };
            if thread::Builder::new().spawn_scoped(scope, work).is_err() {
                shared.pool.leave();
            }
        }
        own[0].work();
    });
    let shares: Vec<Share> = workers.into_iter().map(Worker::into_share).collect();
    if let Some(error) = shared.pool.error() {
        return Err(watch.or(error));
    }
    let pieces = replay::replay(shared, &shares, watch)?;
    gather::gather(domain, shares, &pieces, watch)
}

impl<'a> Shared<'a> {
    fn new(
        domain: &'a Domain,
        polygons: Vec<Range<usize>>,
        alone_below: usize,
        threads: usize,
        care: Care,
    ) -> Self {
        let (mut large, mut chunks, mut order) = (Vec::new(), Vec::new(), Vec::new());
        let mut room = 0;
        for walks in polygons {
            let n_edges: usize = domain.walks()[walks.clone()].iter().map(|w| w.len as usize).sum();
            if n_edges >= alone_below {
                order.push(Part::Large(large.len()));
                large.push(Large::new(domain, walks, SEEDS * threads));
                room = 0;
                continue;
            }
            if room < n_edges {
                order.push(Part::Chunk(chunks.len()));
                chunks.push(Vec::new());
                room = CHUNK.max(n_edges);
            }
            room -= n_edges;
            if let Some(chunk) = chunks.last_mut() {
                chunk.push(walks);
            }
        }
        let mut tasks: Vec<Task> = (0..chunks.len()).map(Task::Chunk).collect();
        for (polygon, large) in large.iter().enumerate().rev() {
            tasks.extend(large.seeds.all().rev().map(|seed| Task::Seed { polygon, seed }));
        }
        let pool = Pool::new(tasks, threads);
        Self { domain, care, large, chunks, order, pool, n_given: AtomicU32::new(0) }
    }
}

impl Large {
    fn new(domain: &Domain, walks: Range<usize>, n_seeds: usize) -> Self {
        let seeds = Seeds::new(domain, walks.clone(), n_seeds);
        let met = seeds.all().map(|_| AtomicBool::new(false)).collect();
        Self { walks, index: OnceLock::new(), seeds, met, meetings: Meetings::new() }
    }
}
