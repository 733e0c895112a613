use std::ops::Range;
use std::sync::atomic::Ordering;

use super::super::contacts::from_least;
use super::super::finish::Traced;
use super::super::hand::{Arrival, Hand, Openings, openings, path};
use super::super::search::{Found, Index, Search, Start};
use super::super::tracer::{Care, Tracer, most_keypoints};
use super::meetings::{Arrived, Gap, Place};
use super::{Large, Shared};
use crate::axis::Path;
use crate::domain::Site;
use crate::engine::EngineError;
use crate::engine::watch::Watch;

/// Paths traced before a thread hands something on once more, so that handing on costs little.
const PAUSE: u32 = 64;

/// A number that stands for a keypoint of another block.
const ELSEWHERE: u32 = u32::MAX;

/// Something to trace, by whatever thread.
#[derive(Clone, Copy, Debug)]
pub(super) enum Task {
    /// Some small polygons.
    Chunk(usize),
    /// What begins in a convex corner.
    Seed { polygon: usize, seed: usize },
    /// The path from a gap of a keypoint.
    Open { polygon: usize, gap: Gap, right: Site, left: Site, start: Start },
    /// A path handed on by another thread, with all that lies beyond.
    Given { polygon: usize, number: u32, from: Parent, right: Site, left: Site, start: Start },
}

/// Where a path starts that was handed on.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parent {
    pub thread: u32,
    /// Its block in the tables of that thread.
    pub block: u32,
    pub keypoint: u32,
}

/// Where a block begins.
#[derive(Clone, Copy, Debug)]
pub(super) enum Origin {
    Chunk(usize),
    Seed { polygon: usize, seed: usize, keypoint: u32 },
    Gap { polygon: usize, gap: Gap },
    Given { number: u32, from: Parent },
}

/// Where a block ends.
#[derive(Clone, Copy, Debug)]
pub(super) enum End {
    /// Nowhere: all that lies beyond its beginning is in it, or in blocks handed on.
    Beyond,
    /// In a convex corner, with its keypoint in the tables of the same thread.
    Corner(u32),
    /// At a gap.
    Gap(Gap),
}

/// Keypoints and paths that follow one another, in the tables of one thread.
#[derive(Clone, Debug)]
pub(super) struct Block {
    pub origin: Origin,
    /// New keypoints: all of them beyond, or the transitions of one path.
    pub keypoints: Range<u32>,
    pub paths: Range<u32>,
    pub end: End,
    /// Blocks handed on; the last one is to be traced first.
    pub given: Vec<u32>,
}

/// What one thread has traced.
pub(super) struct Share {
    pub traced: Traced,
    pub blocks: Vec<Block>,
}

/// A path that waits in the current block.
#[derive(Clone, Copy, Debug)]
struct Pending {
    keypoint: u32,
    right: Site,
    left: Site,
    start: Start,
}

/// One thread.
pub(super) struct Worker<'s, 'a> {
    shared: &'s Shared<'a>,
    number: u32,
    hand: Hand<'a>,
    /// Polygon in which the hand searches.
    polygon: Option<usize>,
    /// What waits in the current block.
    pending: Vec<Pending>,
    /// Beginnings of further blocks.
    tasks: Vec<Task>,
    blocks: Vec<Block>,
    /// Paths to trace before handing on again.
    pause: u32,
    /// More keypoints than there can be.
    most: usize,
}

impl<'s, 'a> Worker<'s, 'a> {
    pub fn new(shared: &'s Shared<'a>, number: u32, watch: Watch<'a>) -> Self {
        Self {
            shared,
            number,
            hand: Hand::new(shared.domain, watch),
            polygon: None,
            pending: Vec::new(),
            tasks: Vec::new(),
            blocks: Vec::new(),
            pause: 0,
            most: most_keypoints(shared.domain.edges().len()),
        }
    }

    pub fn into_share(self) -> Share {
        Share { traced: self.hand.traced, blocks: self.blocks }
    }

    /// Works until nothing is left to do.
    pub fn work(&mut self) {
        if let Err(error) = self.trace_all() {
            self.shared.pool.fail(error);
        }
    }

    fn trace_all(&mut self) -> Result<(), EngineError> {
        while let Some(task) = self.tasks.pop().or_else(|| self.shared.pool.take()) {
            match task {
                Task::Chunk(number) => self.chunk(number)?,
                Task::Seed { polygon, seed } => self.seed(polygon, seed)?,
                Task::Open { polygon, gap, right, left, start } => {
                    if self.shared.large[polygon].meetings.close(gap) {
                        self.enter(polygon);
                        let origin = Origin::Gap { polygon, gap };
                        self.begin(polygon, origin, ELSEWHERE, right, left, start)?;
                    }
                }
                Task::Given { polygon, number, from, right, left, start } => {
                    self.enter(polygon);
                    let origin = Origin::Given { number, from };
                    self.beyond(polygon, origin, ELSEWHERE, right, left, start)?;
                }
            }
        }
        Ok(())
    }

    fn large(&self, polygon: usize) -> &'s Large {
        &self.shared.large[polygon]
    }

    fn enter(&mut self, polygon: usize) {
        if self.polygon.replace(polygon) != Some(polygon) {
            let (domain, large) = (self.shared.domain, self.large(polygon));
            let index = large.index.get_or_init(|| Index::new(domain, large.walks.clone()));
            let mut search = Search::over(domain, index.clone(), self.hand.watch.clone());
            search.careful = self.shared.care > Care::Quick;
            self.hand.single = self.shared.care == Care::Single;
            self.hand.search = Some(search);
        }
    }

    fn block(&mut self, origin: Origin) {
        let [keypoints, paths] = self.ends();
        self.blocks.push(Block {
            origin,
            keypoints: keypoints..keypoints,
            paths: paths..paths,
            end: End::Beyond,
            given: Vec::new(),
        });
    }

    fn ends(&self) -> [u32; 2] {
        let Traced { keypoints, paths, .. } = &self.hand.traced;
        [keypoints.len(), paths.len()]
    }

    /// Ends the current block with all that was traced since.
    fn end_beyond(&mut self) {
        let [keypoints, paths] = self.ends();
        if let Some(block) = self.blocks.last_mut() {
            block.keypoints.end = keypoints;
            block.paths.end = paths;
        }
    }

    /// Traces some polygons as if alone.
    fn chunk(&mut self, number: usize) -> Result<(), EngineError> {
        self.block(Origin::Chunk(number));
        self.polygon = None;
        let fresh = Hand::new(self.shared.domain, self.hand.watch.clone());
        let hand = std::mem::replace(&mut self.hand, fresh);
        let mut tracer = Tracer::over(self.shared.chunks[number].clone(), hand);
        while tracer.step()? {}
        self.hand = tracer.hand;
        self.end_beyond();
        Ok(())
    }

    fn seed(&mut self, polygon: usize, seed: usize) -> Result<(), EngineError> {
        let large = self.large(polygon);
        if large.met[seed].swap(true, Ordering::Relaxed)
            && !large.seeds.components().contains(&seed)
        {
            return Ok(());
        }
        self.enter(polygon);
        let corner = large.seeds.corner(seed);
        let keypoint = self.hand.add_end(corner);
        let (right, left, start) = self.hand.corner(corner);
        let origin = Origin::Seed { polygon, seed, keypoint };
        self.begin(polygon, origin, keypoint, right, left, start)
    }

    /// Traces a path, and all beyond it if nobody else can come there.
    fn begin(
        &mut self,
        polygon: usize,
        origin: Origin,
        from: u32,
        right: Site,
        left: Site,
        start: Start,
    ) -> Result<(), EngineError> {
        if self.large(polygon).seeds.is_private(self.shared.domain, right, left) {
            return self.beyond(polygon, origin, from, right, left, start);
        }
        self.block(origin);
        self.link(polygon, from, right, left, start)
    }

    /// Traces one path with its transitions, up to a keypoint that others may come to.
    fn link(
        &mut self,
        polygon: usize,
        mut from: u32,
        mut right: Site,
        mut left: Site,
        mut start: Start,
    ) -> Result<(), EngineError> {
        let large = self.large(polygon);
        let end = loop {
            let broken = EngineError::Internal { stage: "following a path", place: start.centre };
            self.count(start)?;
            let arrival = self.hand.follow(from, right, left, start, None)?;
            let last = path(arrival.from, ELSEWHERE, arrival.right, arrival.left);
            let (disk, triple, contacts, own) = match arrival.found {
                Found::Disk { disk, triple, contacts, own } => (disk, triple, contacts, own),
                Found::Known(_) => return Err(broken),
                Found::Corner(corner) => {
                    if let Some(seed) = large.seeds.number(corner) {
                        large.met[seed].store(true, Ordering::Relaxed);
                    }
                    self.end_link(last);
                    break End::Corner(self.hand.add_end(corner));
                }
            };
            let list = from_least(&contacts);
            let openings = openings(self.shared.domain, &list);
            let arrived = openings.iter().position(|&o| o == (arrival.left, arrival.right));
            let arrived = arrived.ok_or(broken)?;
            let next = Start { triple: Some(triple), ..Start::at(&disk) };
            if let [one, other] = openings[..] {
                // A transition of a path that goes on.
                from = self.hand.add_keypoint(&disk, triple, &list, own)?;
                self.hand.set_kind(from, 2);
                self.hand.traced.add_path(&Path { to: from, ..last });
                (right, left) = if arrived == 0 { other } else { one };
                start = next;
                continue;
            }
            let [keypoint, _] = self.ends();
            self.end_link(last);
            let place = Place { thread: self.number, keypoint };
            let n_gaps = openings.len() as u32;
            let gap = arrived as u32;
            break match large.meetings.arrive(&list, n_gaps, gap, place) {
                Arrived::Known(gap) => End::Gap(gap),
                Arrived::New(first) => {
                    let keypoint = self.hand.add_keypoint(&disk, triple, &list, own)?;
                    self.hand.set_kind(keypoint, openings.len());
                    self.open(polygon, first, &openings, arrived, next);
                    End::Gap(Gap { number: first.number + gap, ..first })
                }
            };
        };
        if let Some(block) = self.blocks.last_mut() {
            block.end = end;
        }
        self.hand_on(polygon);
        Ok(())
    }

    /// Fails where more was traced than there can be.
    fn count(&self, near: Start) -> Result<(), EngineError> {
        if self.hand.traced.keypoints.len() as usize > self.most {
            let place = near.centre;
            return Err(EngineError::Internal { stage: "counting keypoints", place });
        }
        Ok(())
    }

    /// Ends the current block with its last path and the transitions before it.
    fn end_link(&mut self, last: Path) {
        self.hand.traced.add_path(&last);
        let [keypoints, paths] = self.ends();
        if let Some(block) = self.blocks.last_mut() {
            block.keypoints = keypoints - (paths - block.paths.start - 1)..keypoints;
            block.paths.end = paths;
        }
    }

    /// Takes note of the paths that leave a new keypoint; what follows the arrival is traced first.
    fn open(
        &mut self,
        polygon: usize,
        first: Gap,
        openings: &Openings,
        arrived: usize,
        start: Start,
    ) {
        let n = openings.len();
        for k in (1..n).rev().map(|k| (arrived + k) % n) {
            let (right, left) = openings[k];
            let gap = Gap { number: first.number + k as u32, ..first };
            self.tasks.push(Task::Open { polygon, gap, right, left, start });
        }
    }

    /// Traces all that lies beyond a path, where nobody else can come.
    fn beyond(
        &mut self,
        polygon: usize,
        origin: Origin,
        keypoint: u32,
        right: Site,
        left: Site,
        start: Start,
    ) -> Result<(), EngineError> {
        self.block(origin);
        if let Some(block) = self.blocks.last_mut()
            && keypoint != ELSEWHERE
        {
            block.keypoints.start = keypoint;
        }
        self.pending.push(Pending { keypoint, right, left, start });
        while let Some(Pending { keypoint, right, left, start }) = self.pending.pop() {
            let Arrival { from, right, left, found } =
                self.hand.follow(keypoint, right, left, start, None)?;
            let to = match found {
                Found::Corner(corner) => self.hand.add_end(corner),
                Found::Known(to) => to,
                Found::Disk { disk, triple, contacts, own } => {
                    let list = from_least(&contacts);
                    let to = self.hand.add_keypoint(&disk, triple, &list, own)?;
                    let openings = openings(self.shared.domain, &list);
                    let arrived = openings.iter().position(|&o| o == (left, right)).ok_or(
                        EngineError::Internal { stage: "closing a path", place: start.centre },
                    )?;
                    let n = openings.len();
                    self.hand.set_kind(to, n);
                    let start = Start { triple: Some(triple), ..Start::at(&disk) };
                    for (right, left) in (1..n).rev().map(|k| openings[(arrived + k) % n]) {
                        self.pending.push(Pending { keypoint: to, right, left, start });
                    }
                    to
                }
            };
            self.hand.traced.add_path(&path(from, to, right, left));
            self.count(start)?;
            self.hand_on(polygon);
        }
        self.end_beyond();
        Ok(())
    }

    /// Hands on half of what waits, from where it waits longest, if another thread has nothing to do.
    #[inline]
    fn hand_on(&mut self, polygon: usize) {
        if self.pause > 0 {
            self.pause -= 1;
        } else if self.shared.pool.is_hungry() {
            self.hand_half_on(polygon);
        }
    }

    #[cold]
    fn hand_half_on(&mut self, polygon: usize) {
        // The last task is kept where nothing else is left.
        let half = (self.tasks.len() + usize::from(!self.pending.is_empty())) / 2;
        if half > 0 {
            self.shared.pool.give(self.tasks.drain(..half));
            self.pause = PAUSE;
            return;
        }
        let half = self.pending.len() / 2;
        let Some(block) = self.blocks.len().checked_sub(1) else { return };
        if half == 0 {
            return;
        }
        let first = self.shared.n_given.fetch_add(half as u32, Ordering::Relaxed);
        self.blocks[block].given.extend(first..first + half as u32);
        let thread = self.number;
        let tasks = self.pending.drain(..half).zip(first..).map(|(pending, number)| {
            let Pending { keypoint, right, left, start } = pending;
            let from = Parent { thread, block: block as u32, keypoint };
            Task::Given { polygon, number, from, right, left, start }
        });
        self.shared.pool.give(tasks);
        self.pause = PAUSE;
    }
}
