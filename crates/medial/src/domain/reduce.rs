//! One ring by itself: repeated points, straight corners and spikes.

use super::{Corner, DomainError, Place};
use crate::geom::{Point, orient2d};

/// What is left of a ring, and what was taken from it, as positions in the ring as given.
#[derive(Default)]
pub(super) struct Reduced {
    pub(super) kept: Vec<u32>,
    pub(super) repeated: Vec<u32>,
    pub(super) spikes: Vec<u32>,
    pub(super) straight: Vec<u32>,
}

/// The corners of a ring that needs no cleaning, added to `corners`; `false`, with any number of
/// them added, if it needs some.
///
/// One pass: a ring is clean if it turns left or right at each of at least three points.
pub(super) fn append_corners(points: &[Point], corners: &mut Vec<Corner>) -> bool {
    let &[first, .., last] = points else { return false };
    let (mut before, mut at, mut into) = (last, first, first - last);
    for after in points[1..].iter().copied().chain([first]) {
        let out = after - at;
        let (left, right) = (into.x * out.y, into.y * out.x);
        let mut turn = left - right;
        if turn.abs() <= TURN_ERROR * (left.abs() + right.abs()) {
            turn = orient2d(before, at, after);
        }
        if turn == 0.0 {
            return false;
        }
        corners.push(if turn > 0.0 { Corner::Convex } else { Corner::Reflex });
        (before, at, into) = (at, after, out);
    }
    points.len() > 2
}

/// Bound on the relative error of a turn: two differences, a product and a difference each add at
/// most 2^-53 to first order, and the rest covers the second order.
const TURN_ERROR: f64 = 5.0 * f64::EPSILON / 2.0;

/// How many points a ring has without those at its end that only close it.
pub(super) fn open_len(points: &[Point]) -> usize {
    let mut end = points.len();
    while end > 1 && points[end - 1] == points[0] {
        end -= 1;
    }
    end
}

/// Drops repeated points, merges straight corners and removes spikes until none is left.
///
/// Linear: a removal can only concern its two neighbours, so the scan steps back by one.
pub(super) fn reduce(points: &[Point], at: Place) -> Result<Reduced, DomainError> {
    let mut reduced = Reduced::default();
    let end = open_len(points);
    // The last point only closes the ring.
    reduced.repeated.extend(end as u32..(points.len() as u32).saturating_sub(1));
    let mut kept: Vec<u32> = Vec::with_capacity(end);
    for (k, point) in points[..end].iter().enumerate() {
        match kept.last() {
            Some(&last) if points[last as usize] == *point => reduced.repeated.push(k as u32),
            _ => kept.push(k as u32),
        }
    }
    reduced.repeated.sort_unstable();
    let n = kept.len();
    if n < 3 {
        return Err(DomainError::TooFewPoints { at, found: n as u32 });
    }
    let point = |k: usize| points[kept[k] as usize];
    let is_corner =
        |k: usize| orient2d(point((k + n - 1) % n), point(k), point((k + 1) % n)) != 0.0;
    let Some(first) = (0..n).find(|&k| !is_corner(k)) else {
        reduced.kept = kept;
        return Ok(reduced);
    };

    let mut next: Vec<u32> = (0..n).map(|k| ((k + 1) % n) as u32).collect();
    let mut prev: Vec<u32> = (0..n).map(|k| ((k + n - 1) % n) as u32).collect();
    let mut live = n;
    let mut removed = vec![false; n];
    let (mut k, mut dirty) = (first, n - first);
    while dirty > 0 {
        let (before, after) = (prev[k] as usize, next[k] as usize);
        let (a, b, c) = (point(before), point(k), point(after));
        let drop = if b == c {
            // Keep the one that comes first in the ring.
            let twin = if kept[after] > kept[k] { after } else { k };
            reduced.repeated.push(kept[twin]);
            twin
        } else if orient2d(a, b, c) == 0.0 {
            let straight = a.lexicographic(b) == b.lexicographic(c);
            if straight { &mut reduced.straight } else { &mut reduced.spikes }.push(kept[k]);
            k
        } else {
            dirty -= 1;
            k = after;
            continue;
        };
        live -= 1;
        if live < 3 {
            let mut all: Vec<Point> = kept.iter().map(|&k| points[k as usize]).collect();
            all.sort_unstable_by(|p, q| p.lexicographic(*q));
            all.dedup();
            return Err(match all.len() {
                found @ ..3 => DomainError::TooFewPoints { at, found: found as u32 },
                _ => DomainError::Collinear { at },
            });
        }
        removed[drop] = true;
        let (before, after) = (prev[drop], next[drop]);
        next[before as usize] = after;
        prev[after as usize] = before;
        // Check the neighbours again, and what was still to be checked.
        dirty = (dirty + 2).min(live);
        k = before as usize;
    }
    reduced.kept = (0..n).filter(|&k| !removed[k]).map(|k| kept[k]).collect();
    for list in [&mut reduced.repeated, &mut reduced.spikes, &mut reduced.straight] {
        list.sort_unstable();
    }
    Ok(reduced)
}
