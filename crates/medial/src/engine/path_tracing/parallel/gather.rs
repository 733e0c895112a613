//! The tables of the axis, copied from those of the threads by all of them.

use std::ops::Range;
use std::sync::atomic::{AtomicU32, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

use super::replay::Piece;
use super::worker::{End, Share};
use crate::axis::{self, Engine, KeypointTable, MedialAxis, Path, PathTable, SiteTable};
use crate::domain::{Domain, Site};
use crate::engine::EngineError;
use crate::engine::draft::{axis_of, site_record};
use crate::engine::watch::Watch;

/// Sites after which the clock is looked at.
const MANY: usize = 1 << 16;

/// A number of no site.
const NONE: u32 = u32::MAX;

/// Puts the pieces, in their order, into tables; `None` if a hole governs nothing.
pub(super) fn gather(
    domain: &Domain,
    shares: Vec<Share>,
    pieces: &[Piece],
    watch: &Watch<'_>,
) -> Result<Option<MedialAxis>, EngineError> {
    let threads = shares.len();
    let n_sites = 2 * domain.edges().len();
    let numbers: Vec<AtomicU32> = (0..n_sites).map(|_| AtomicU32::new(NONE)).collect();
    let groups = each(threads, split(pieces, &shares, threads), |group| {
        let mut copied = Group::default();
        let room = shares.iter().map(|s| s.traced.paths.len()).sum::<u32>() as usize / threads;
        // One keypoint for each path, and some more.
        let room = room + room / 16;
        copied.keypoints.reserve(room);
        copied.paths.reserve(room);
        for piece in group {
            copied.copy(piece, &shares);
        }
        copied.keypoints.show_governors(|site| numbers[site as usize].store(0, Ordering::Relaxed));
        copied
    });
    watch.check_now()?;
    let governs = |sites: Range<u32>| {
        sites.into_iter().any(|s| numbers[s as usize].load(Ordering::Relaxed) != NONE)
    };
    let mut holes = domain.walks().iter().filter(|w| w.hole);
    if !holes.all(|w| governs(2 * w.first..2 * (w.first + w.len))) {
        return Ok(None);
    }
    // Each thread makes the records of some sites, numbered from 0; what it traced is needed no more.
    let step = n_sites.div_ceil(threads).next_power_of_two();
    let ranges = (0..threads).map(|k| (k * step).min(n_sites)..((k + 1) * step).min(n_sites));
    let sites = each(threads, ranges.zip(shares).collect(), |(range, share)| {
        drop(share);
        let mut sites: Vec<axis::Site> = Vec::new();
        for site in range {
            if numbers[site].load(Ordering::Relaxed) != NONE {
                numbers[site].store(sites.len() as u32, Ordering::Relaxed);
                sites.push(site_record(domain, Site(site as u32)));
            }
        }
        sites
    });
    watch.check_now()?;
    let starts = |lengths: &mut dyn Iterator<Item = usize>| -> Vec<u32> {
        lengths.scan(0, |sum, length| Some(std::mem::replace(sum, *sum + length) as u32)).collect()
    };
    let first_sites = starts(&mut sites.iter().map(Vec::len));
    let shift = step.trailing_zeros();
    let number = |site: u32| {
        first_sites[(site >> shift) as usize] + numbers[site as usize].load(Ordering::Relaxed)
    };
    let groups = each(threads, groups, |mut group| {
        group.keypoints.renumber(number);
        for path in &mut group.paths {
            (path.left, path.right) = (number(path.left), number(path.right));
        }
        group
    });
    watch.check_now()?;
    let (mut keypoints, mut paths) = (KeypointTable::default(), Vec::new());
    keypoints.reserve(groups.iter().map(|group| group.keypoints.len() as usize).sum());
    for group in groups {
        keypoints.copy(&group.keypoints, 0..group.keypoints.len());
        paths.push(group.paths);
    }
    watch.check_now()?;
    let packed = each(threads, paths, |paths| PathTable::of(paths.into_iter(), &keypoints));
    let mut paths = PathTable::with_room(packed.iter().map(|paths| paths.len() as usize).sum());
    packed.iter().for_each(|some| paths.append(some));
    watch.check_now()?;
    let n_sites = sites.iter().map(Vec::len).sum();
    let n_edges = domain.edges().len();
    let mut table = SiteTable::with_room(n_sites, n_edges, domain.walks().len());
    for (k, site) in sites.into_iter().flatten().enumerate() {
        if k % MANY == 0 {
            watch.check_now()?;
        }
        table.push(&site).ok_or(EngineError::TooLarge { n_edges })?;
    }
    table.shrink();
    Ok(Some(axis_of(Engine::PathTracing, table, keypoints, paths)))
}

/// The pieces in as many groups of about the same size.
fn split<'p>(pieces: &'p [Piece], shares: &[Share], groups: usize) -> Vec<&'p [Piece]> {
    let total = shares.iter().map(|share| share.traced.paths.len() as usize).sum::<usize>();
    let mut split = Vec::with_capacity(groups);
    let (mut rest, mut seen) = (pieces, 0);
    for group in 1..groups {
        let mut count = 0;
        while seen < total * group / groups && count < rest.len() {
            if let Piece::Block { way, .. } = rest[count] {
                let share = &shares[way.id.thread as usize];
                seen += share.blocks[way.id.block as usize].paths.len();
            }
            count += 1;
        }
        let (group, others) = rest.split_at(count);
        split.push(group);
        rest = others;
    }
    split.push(rest);
    split
}

/// A part of the result.
#[derive(Default)]
struct Group {
    keypoints: KeypointTable,
    /// Between keypoints by their numbers in the result.
    paths: Vec<Path>,
}

impl Group {
    fn copy(&mut self, piece: &Piece, shares: &[Share]) {
        let (way, from, to, first) = match *piece {
            Piece::Keypoint(place) => {
                let keypoints = place.keypoint..place.keypoint + 1;
                let traced = &shares[place.thread as usize].traced;
                return self.keypoints.copy(&traced.keypoints, keypoints);
            }
            Piece::Block { way, from, to, first } => (way, from, to, first),
        };
        let share = &shares[way.id.thread as usize];
        let block = &share.blocks[way.id.block as usize];
        let paths = block.paths.clone().map(|path| share.traced.path(path));
        let keypoints = block.keypoints.clone();
        if let End::Beyond = block.end {
            // What is not in the block is its beginning.
            let number = |k: u32| {
                if keypoints.contains(&k) { first + (k - keypoints.start) } else { from }
            };
            let renumbered = |p: Path| Path { from: number(p.from), to: number(p.to), ..p };
            self.paths.extend(paths.map(renumbered));
            self.keypoints.copy(&share.traced.keypoints, keypoints);
            return;
        }
        let n = paths.len() as u32;
        let at = |k: u32| match k {
            0 => from,
            k if k == n => to,
            k => first + k - 1,
        };
        let renumbered = |p: Path, k: u32| Path { from: at(k), to: at(k + 1), ..p };
        if way.backwards {
            self.paths.extend(paths.rev().zip(0..).map(|(p, k)| {
                let Path { left, right, .. } = p;
                renumbered(Path { left: right, right: left, ..p }, k)
            }));
            for k in keypoints.rev() {
                self.keypoints.copy(&share.traced.keypoints, k..k + 1);
            }
        } else {
            self.paths.extend(paths.zip(0..).map(|(p, k)| renumbered(p, k)));
            self.keypoints.copy(&share.traced.keypoints, keypoints);
        }
    }
}

/// Does some work for each item, on several threads if there are, and gives the results in order.
fn each<T: Send, R: Send>(threads: usize, items: Vec<T>, work: impl Fn(T) -> R + Sync) -> Vec<R> {
    let results: Vec<Mutex<Option<R>>> = items.iter().map(|_| Mutex::new(None)).collect();
    let items: Vec<Mutex<Option<T>>> = items.into_iter().map(|t| Mutex::new(Some(t))).collect();
    let next = AtomicUsize::new(0);
    let run = || {
        loop {
            let number = next.fetch_add(1, Ordering::Relaxed);
            let Some(item) = items.get(number) else { break };
            let item = item.lock().unwrap_or_else(PoisonError::into_inner).take();
            let result = item.map(&work);
            *results[number].lock().unwrap_or_else(PoisonError::into_inner) = result;
        }
    };
    thread::scope(|scope| {
        for _ in 1..threads {
            // Without another thread this one does everything.
            let _ = thread::Builder::new().spawn_scoped(scope, run);
        }
        run();
    });
    let inner = |r: Mutex<Option<R>>| r.into_inner().unwrap_or_else(PoisonError::into_inner);
    results.into_iter().filter_map(inner).collect()
}
