//! Keypoints at which the paths of several threads may meet.

use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::domain::Site;

/// Parts of the table, each with a lock of its own; a power of two.
const SHARDS: usize = 64;

const NONE: u32 = u32::MAX;

/// Room for a path at a keypoint: its number in one part of the table.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gap {
    pub shard: u32,
    pub number: u32,
}

/// A keypoint of one thread's tables.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub thread: u32,
    pub keypoint: u32,
}

/// A keypoint where paths may meet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Meeting {
    pub place: Place,
    /// Its gaps, counterclockwise from that after its least governor.
    pub first_gap: u32,
    pub n_gaps: u32,
    /// Its governors in the list of the part.
    first_governor: u32,
    n_governors: u32,
    /// Another one with the same hash.
    next: u32,
}

/// A part of the table.
#[derive(Debug, Default)]
pub(super) struct Shard {
    heads: HashMap<u64, u32, BuildHasherDefault<Plain>>,
    pub meetings: Vec<Meeting>,
    governors: Vec<Site>,
    /// For each gap its keypoint.
    pub owners: Vec<u32>,
    /// Whether a path goes through each gap, or is being traced.
    closed: Vec<bool>,
}

/// What an arriving path finds.
pub(super) enum Arrived {
    /// A keypoint known already, at this gap.
    Known(Gap),
    /// A new one, whose first gap this is.
    New(Gap),
}

/// The table, by governors.
#[derive(Debug)]
pub(super) struct Meetings {
    shards: Vec<Mutex<Shard>>,
}

impl Meetings {
    pub fn new() -> Self {
        Self { shards: (0..SHARDS).map(|_| Mutex::default()).collect() }
    }

    fn lock(&self, shard: usize) -> MutexGuard<'_, Shard> {
        self.shards[shard].lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Closes a gap; false if it was closed already.
    pub fn close(&self, gap: Gap) -> bool {
        let mut shard = self.lock(gap.shard as usize);
        !std::mem::replace(&mut shard.closed[gap.number as usize], true)
    }

    /// Closes gap number `gap` of the `n_gaps` of the keypoint with these governors, from the least
    /// one on. If it is not known yet it is from now on, in that place.
    pub fn arrive(&self, governors: &[Site], n_gaps: u32, gap: u32, place: Place) -> Arrived {
        let hash = hash(governors);
        let number = (hash >> 32) as usize % SHARDS;
        let mut guard = self.lock(number);
        let shard = &mut *guard;
        let head = shard.heads.entry(hash).or_insert(NONE);
        let mut known = *head;
        while known != NONE {
            let meeting = &shard.meetings[known as usize];
            let first = meeting.first_governor as usize;
            if shard.governors[first..first + meeting.n_governors as usize] == *governors {
                let gap = meeting.first_gap + gap;
                shard.closed[gap as usize] = true;
                return Arrived::Known(Gap { shard: number as u32, number: gap });
            }
            known = meeting.next;
        }
        let first_gap = shard.owners.len() as u32;
        let next = std::mem::replace(head, shard.meetings.len() as u32);
        shard.owners.extend((0..n_gaps).map(|_| shard.meetings.len() as u32));
        shard.closed.extend((0..n_gaps).map(|k| k == gap));
        shard.meetings.push(Meeting {
            place,
            first_gap,
            n_gaps,
            first_governor: shard.governors.len() as u32,
            n_governors: governors.len() as u32,
            next,
        });
        shard.governors.extend_from_slice(governors);
        Arrived::New(Gap { shard: number as u32, number: first_gap })
    }

    /// The parts, when all is traced.
    pub fn into_shards(self) -> Vec<Shard> {
        let inner =
            |shard: Mutex<Shard>| shard.into_inner().unwrap_or_else(PoisonError::into_inner);
        self.shards.into_iter().map(inner).collect()
    }
}

fn hash(sites: &[Site]) -> u64 {
    let mut hash = 0_u64;
    for site in sites {
        hash = (hash.rotate_left(5) ^ u64::from(site.0)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    }
    // The upper bits are the best.
    hash ^ (hash >> 32)
}

/// Takes numbers that are hashes already.
#[derive(Debug, Default)]
pub(super) struct Plain(u64);

impl Hasher for Plain {
    fn finish(&self) -> u64 {
        self.0
    }

    fn write(&mut self, bytes: &[u8]) {
        for &byte in bytes {
            self.0 = self.0.rotate_left(8) ^ u64::from(byte);
        }
    }

    fn write_u64(&mut self, number: u64) {
        self.0 = number;
    }
}
