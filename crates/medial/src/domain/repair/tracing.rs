//! Rings from directed pieces of boundaries.

use std::collections::HashMap;

use crate::domain::DomainError;
use crate::geom::{Point, order_key, orient2d};

/// A piece of the boundary, with the inside on its left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Directed {
    pub(super) from: Point,
    pub(super) to: Point,
    /// What it comes from.
    pub(super) strand: u32,
}

/// Rings of pieces, as lists of their numbers. Where several pass a point each keeps to the same part of
/// the inside, so that rings touch there and none crosses another one, nor itself.
pub(super) fn rings(pieces: &[Directed]) -> Result<Vec<Vec<u32>>, DomainError> {
    let broken = DomainError::Internal { stage: "tracing" };
    let key = |p: Point| (order_key(p.x), order_key(p.y));
    let mut leaving: Vec<u32> = (0..pieces.len() as u32).collect();
    let from = |piece: u32| key(pieces[piece as usize].from);
    leaving.sort_unstable_by_key(|&piece| (from(piece), piece));
    let mut starts: HashMap<(i64, i64), (usize, usize)> = HashMap::with_capacity(pieces.len());
    let mut first = 0;
    for same in leaving.chunk_by(|&a, &b| from(a) == from(b)) {
        starts.insert(from(same[0]), (first, first + same.len()));
        first += same.len();
    }
    let mut is_done = vec![false; pieces.len()];
    let mut rings = Vec::new();
    for begin in 0..pieces.len() as u32 {
        if is_done[begin as usize] {
            continue;
        }
        let (mut ring, mut piece) = (Vec::new(), begin);
        loop {
            is_done[piece as usize] = true;
            ring.push(piece);
            let Directed { from, to, .. } = pieces[piece as usize];
            let &(first, last) = starts.get(&key(to)).ok_or(broken)?;
            let target = |next: u32| pieces[next as usize].to;
            let next = leaving[first..last].iter().copied().reduce(|best, next| {
                if is_clockwise_before(to, from, target(next), target(best)) { next } else { best }
            });
            piece = next.ok_or(broken)?;
            if piece == begin {
                break;
            }
            if is_done[piece as usize] {
                return Err(broken);
            }
        }
        rings.push(ring);
    }
    Ok(rings)
}

/// Whether, clockwise from the direction `at` → `from`, that to `a` comes before that to `b`.
fn is_clockwise_before(at: Point, from: Point, a: Point, b: Point) -> bool {
    // Less than half a turn, half a turn, or more.
    let part = |p: Point| {
        let turn = orient2d(at, from, p);
        if turn < 0.0 {
            0
        } else if turn == 0.0 {
            1
        } else {
            2
        }
    };
    let (of_a, of_b) = (part(a), part(b));
    if of_a == of_b { orient2d(at, b, a) > 0.0 } else { of_a < of_b }
}
