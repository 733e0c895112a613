//! The tables of the axis, copied from those of the threads by all of them.

use std::ops::Range;
use std::sync::atomic::{AtomicU32, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::thread;

use super::super::finish::{Traced, axis_of, site_record};
use super::replay::Piece;
use super::worker::{End, Share};
use crate::axis::{self, MedialAxis, Path, SiteTable};
use crate::domain::{Domain, Site};
use crate::engine::EngineError;
use crate::engine::watch::Watch;

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
        let mut traced = Traced::default();
        traced.reserve(shares.iter().map(|s| s.traced.paths.len()).sum::<usize>() / threads);
        for piece in group {
            copy(&mut traced, piece, &shares);
        }
        for &site in &traced.governors {
            numbers[site as usize].store(0, Ordering::Relaxed);
        }
        traced
    });
    watch.check()?;
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
    watch.check()?;
    let starts = |lengths: &mut dyn Iterator<Item = usize>| -> Vec<u32> {
        lengths.scan(0, |sum, length| Some(std::mem::replace(sum, *sum + length) as u32)).collect()
    };
    let first_sites = starts(&mut sites.iter().map(Vec::len));
    let first_governors = starts(&mut groups.iter().map(|group| group.governors.len()));
    let shift = step.trailing_zeros();
    let number = |site: u32| {
        first_sites[(site >> shift) as usize] + numbers[site as usize].load(Ordering::Relaxed)
    };
    let groups = each(threads, groups.into_iter().zip(first_governors).collect(), |group| {
        let (mut group, first_governor) = group;
        for keypoint in &mut group.keypoints {
            *keypoint = keypoint.with_governors(first_governor + keypoint.first_governor());
        }
        for site in &mut group.governors {
            *site = number(*site);
        }
        for path in &mut group.paths {
            (path.left, path.right) = (number(path.left), number(path.right));
        }
        group
    });
    watch.check()?;
    let (mut keypoints, mut governors, mut paths) = (Vec::new(), Vec::new(), Vec::new());
    for group in groups {
        keypoints.push(group.keypoints);
        governors.push(group.governors);
        paths.push(group.paths);
    }
    let n_sites = sites.iter().map(Vec::len).sum();
    let n_edges = domain.edges().len();
    let mut table = SiteTable::with_room(n_sites, n_edges, domain.walks().len());
    for site in sites.into_iter().flatten() {
        table.push(&site).ok_or(EngineError::TooLarge { n_edges })?;
    }
    table.shrink();
    axis_of(table, joined(keypoints), joined(governors), joined(paths)).map(Some)
}

/// The pieces in as many groups of about the same size.
fn split<'p>(pieces: &'p [Piece], shares: &[Share], groups: usize) -> Vec<&'p [Piece]> {
    let total: usize = shares.iter().map(|share| share.traced.paths.len()).sum();
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

fn copy(all: &mut Traced, piece: &Piece, shares: &[Share]) {
    let (way, from, to, first) = match *piece {
        Piece::Keypoint(place) => {
            let keypoints = place.keypoint..place.keypoint + 1;
            return all.copy_keypoints(&shares[place.thread as usize].traced, keypoints);
        }
        Piece::Block { way, from, to, first } => (way, from, to, first),
    };
    let share = &shares[way.id.thread as usize];
    let block = &share.blocks[way.id.block as usize];
    let paths = &share.traced.paths[block.paths.start as usize..block.paths.end as usize];
    let keypoints = block.keypoints.clone();
    if let End::Beyond = block.end {
        // What is not in the block is its beginning.
        let number = |k: u32| {
            if keypoints.contains(&k) { first + (k - keypoints.start) } else { from }
        };
        let renumbered = |p: &Path| Path { from: number(p.from), to: number(p.to), ..*p };
        all.paths.extend(paths.iter().map(renumbered));
        all.copy_keypoints(&share.traced, keypoints);
        return;
    }
    let n = paths.len() as u32;
    let at = |k: u32| match k {
        0 => from,
        k if k == n => to,
        k => first + k - 1,
    };
    let renumbered = |p: &Path, k: u32| Path { from: at(k), to: at(k + 1), ..*p };
    if way.backwards {
        all.paths.extend(paths.iter().rev().zip(0..).map(|(p, k)| {
            let Path { left, right, .. } = *p;
            renumbered(&Path { left: right, right: left, ..*p }, k)
        }));
        for k in keypoints.rev() {
            all.copy_keypoints(&share.traced, k..k + 1);
        }
    } else {
        all.paths.extend(paths.iter().zip(0..).map(|(p, k)| renumbered(p, k)));
        all.copy_keypoints(&share.traced, keypoints);
    }
}

/// One list of several.
fn joined<T: Copy>(parts: Vec<Vec<T>>) -> Vec<T> {
    let total: usize = parts.iter().map(Vec::len).sum();
    let mut parts = parts.into_iter();
    let mut all = parts.next().unwrap_or_default();
    all.reserve_exact(total - all.len());
    for part in parts {
        all.extend_from_slice(&part);
    }
    all
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
