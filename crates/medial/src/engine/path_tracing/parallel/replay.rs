//! Puts the blocks of all threads together as one thread would have traced them.
//!
//! The blocks are only brought into order here, which also gives every keypoint its number; what is in
//! them is copied by several threads ([`super::gather`]).

use super::meetings::{Gap, Meeting, Place, Shard};
use super::worker::{Block, End, Origin, Share};
use super::{Large, Part, Shared};
use crate::engine::EngineError;
use crate::engine::watch::Watch;
use crate::geom::Point;

const NONE: u32 = u32::MAX;

const BROKEN: EngineError =
    EngineError::Internal { stage: "putting blocks together", place: Point::new(0.0, 0.0) };

/// A block in the tables of a thread.
#[derive(Clone, Copy, Debug)]
pub(super) struct BlockId {
    pub thread: u32,
    pub block: u32,
}

const NO_BLOCK: BlockId = BlockId { thread: NONE, block: NONE };

/// How a path is traced from a gap.
#[derive(Clone, Copy, Debug)]
pub(super) struct Way {
    pub id: BlockId,
    /// Whether the block ends at the gap instead of beginning there.
    pub backwards: bool,
}

/// What waits to be put in its place.
#[derive(Clone, Copy, Debug)]
enum Todo {
    Gap(Gap),
    Given(u32),
}

/// A part of the result.
#[derive(Clone, Copy, Debug)]
pub(super) enum Piece {
    /// One keypoint.
    Keypoint(Place),
    /// A block from one numbered keypoint to another; to itself, if all beyond is in it.
    Block { way: Way, from: u32, to: u32, first: u32 },
}

/// A polygon traced by several threads, in its order.
struct Meetings {
    shards: Vec<Shard>,
    /// For each shard and gap the way from there, until it is used from either end.
    ways: Vec<Vec<Option<Way>>>,
    /// For each shard and keypoint its number in the result.
    numbers: Vec<Vec<u32>>,
}

/// The order of all pieces.
struct Order<'t> {
    shares: &'t [Share],
    given: Vec<BlockId>,
    /// Number in the result of the first keypoint of each block of each thread.
    firsts: Vec<Vec<u32>>,
    n_keypoints: u32,
    pieces: Vec<Piece>,
    todo: Vec<Todo>,
}

/// All pieces in the order in which one thread would have traced them.
pub(super) fn replay(
    shared: Shared<'_>,
    shares: &[Share],
    watch: &Watch<'_>,
) -> Result<Vec<Piece>, EngineError> {
    let Shared { large, chunks, order: parts, n_given, .. } = shared;
    let mut chunk_blocks = vec![NO_BLOCK; chunks.len()];
    let mut seed_blocks: Vec<Vec<BlockId>> =
        large.iter().map(|l| vec![NO_BLOCK; l.seeds.components().len()]).collect();
    let mut given = vec![NO_BLOCK; n_given.into_inner() as usize];
    let mut meetings: Vec<Meetings> = large.into_iter().map(Meetings::new).collect();
    for (share, thread) in shares.iter().zip(0..) {
        for (block, number) in share.blocks.iter().zip(0..) {
            let id = BlockId { thread, block: number };
            let polygon = match block.origin {
                Origin::Chunk(number) => {
                    chunk_blocks[number] = id;
                    continue;
                }
                Origin::Given { number, .. } => {
                    given[number as usize] = id;
                    continue;
                }
                Origin::Seed { polygon, seed, .. } => {
                    if let Some(slot) = seed_blocks[polygon].get_mut(seed) {
                        *slot = id;
                    }
                    polygon
                }
                Origin::Gap { polygon, gap } => {
                    meetings[polygon].set_way(gap, Way { id, backwards: false });
                    polygon
                }
            };
            if let End::Gap(gap) = block.end {
                meetings[polygon].set_way(gap, Way { id, backwards: true });
            }
        }
    }
    let firsts = shares.iter().map(|share| vec![NONE; share.blocks.len()]).collect();
    let mut order =
        Order { shares, given, firsts, n_keypoints: 0, pieces: Vec::new(), todo: Vec::new() };
    for part in parts {
        watch.check()?;
        match part {
            Part::Chunk(number) => order.beyond(chunk_blocks[number], NONE)?,
            Part::Large(polygon) => {
                for &id in &seed_blocks[polygon] {
                    order.component(id, &mut meetings[polygon], watch)?;
                }
            }
        }
    }
    Ok(order.pieces)
}

impl Meetings {
    fn new(large: Large) -> Self {
        let shards = large.meetings.into_shards();
        let unknown = Some(Way { id: NO_BLOCK, backwards: true });
        let ways = shards.iter().map(|s| vec![unknown; s.owners.len()]).collect();
        let numbers = shards.iter().map(|s| vec![NONE; s.meetings.len()]).collect();
        Self { shards, ways, numbers }
    }

    fn way(&mut self, gap: Gap) -> &mut Option<Way> {
        &mut self.ways[gap.shard as usize][gap.number as usize]
    }

    fn set_way(&mut self, gap: Gap, way: Way) {
        let slot = self.way(gap);
        // Forwards is quicker to copy.
        if slot.is_none_or(|w| w.backwards) {
            *slot = Some(way);
        }
    }

    /// The keypoint of a gap, and its number in the result.
    fn owner(&mut self, gap: Gap) -> (Meeting, &mut u32) {
        let shard = gap.shard as usize;
        let owner = self.shards[shard].owners[gap.number as usize] as usize;
        (self.shards[shard].meetings[owner], &mut self.numbers[shard][owner])
    }
}

impl<'t> Order<'t> {
    fn block(&self, id: BlockId) -> Result<&'t Block, EngineError> {
        let share = self.shares.get(id.thread as usize).ok_or(BROKEN)?;
        share.blocks.get(id.block as usize).ok_or(BROKEN)
    }

    /// Gives a keypoint its number.
    fn keypoint(&mut self, place: Place) -> u32 {
        self.pieces.push(Piece::Keypoint(place));
        self.n_keypoints += 1;
        self.n_keypoints - 1
    }

    /// A whole component, from its first block on.
    fn component(
        &mut self,
        id: BlockId,
        meetings: &mut Meetings,
        watch: &Watch<'_>,
    ) -> Result<(), EngineError> {
        let Origin::Seed { keypoint, .. } = self.block(id)?.origin else { return Err(BROKEN) };
        if let End::Beyond = self.block(id)?.end {
            self.beyond(id, NONE)?;
        } else {
            let from = self.keypoint(Place { thread: id.thread, keypoint });
            self.block_from(Way { id, backwards: false }, from, meetings)?;
        }
        while let Some(todo) = self.todo.pop() {
            watch.check()?;
            match todo {
                Todo::Given(number) => {
                    let id = self.given[number as usize];
                    let Origin::Given { from, .. } = self.block(id)?.origin else {
                        return Err(BROKEN);
                    };
                    let parent = BlockId { thread: from.thread, block: from.block };
                    let first = self.block(parent)?.keypoints.start;
                    let parent = self.firsts[from.thread as usize][from.block as usize];
                    self.beyond(id, parent + (from.keypoint - first))?;
                }
                Todo::Gap(gap) => {
                    // It was closed since, if the way is taken.
                    if let Some(way) = meetings.way(gap).take() {
                        let from = *meetings.owner(gap).1;
                        self.block_from(way, from, meetings)?;
                    }
                }
            }
        }
        Ok(())
    }

    /// A block with all that lies beyond.
    fn beyond(&mut self, id: BlockId, from: u32) -> Result<(), EngineError> {
        let block = self.block(id)?;
        let first = self.n_keypoints;
        self.firsts[id.thread as usize][id.block as usize] = first;
        self.n_keypoints += block.keypoints.len() as u32;
        let way = Way { id, backwards: false };
        self.pieces.push(Piece::Block { way, from, to: NONE, first });
        self.todo.extend(block.given.iter().map(|&number| Todo::Given(number)));
        Ok(())
    }

    /// A block from a numbered keypoint.
    fn block_from(
        &mut self,
        way: Way,
        from: u32,
        meetings: &mut Meetings,
    ) -> Result<(), EngineError> {
        let Way { id, backwards } = way;
        let block = self.block(id)?;
        if let End::Beyond = block.end {
            return self.beyond(id, from);
        }
        let first = self.n_keypoints;
        self.n_keypoints += block.keypoints.len() as u32;
        let slot = self.pieces.len();
        self.pieces.push(Piece::Block { way, from, to: NONE, first });
        let thread = id.thread;
        let end = match (backwards, block.origin, block.end) {
            (true, Origin::Seed { keypoint, .. }, _) => End::Corner(keypoint),
            (true, Origin::Gap { gap, .. }, _) => End::Gap(gap),
            (true, ..) => return Err(BROKEN),
            (false, _, end) => end,
        };
        let end = match end {
            End::Beyond => return Err(BROKEN),
            End::Corner(keypoint) => self.keypoint(Place { thread, keypoint }),
            End::Gap(gap) => {
                if meetings.way(gap).take().is_none() {
                    // Two different paths through one gap: a ring was seen from one end only.
                    return Err(BROKEN);
                }
                let (Meeting { place, first_gap, n_gaps, .. }, number) = meetings.owner(gap);
                if *number == NONE {
                    *number = self.keypoint(place);
                    let arrived = gap.number - first_gap;
                    let others = (1..n_gaps).rev().map(|k| (arrived + k) % n_gaps);
                    self.todo
                        .extend(others.map(|k| Todo::Gap(Gap { number: first_gap + k, ..gap })));
                }
                *number
            }
        };
        if let Some(Piece::Block { to, .. }) = self.pieces.get_mut(slot) {
            *to = end;
        }
        Ok(())
    }
}
