//! Which side of each piece of a noded arrangement is inside.
//!
//! A sweep from left to right, with no events but ends. The number above a piece is the number below it
//! and its weight, and what is below the lowest one is outside.

use crate::domain::DomainError;
use crate::domain::status::{Found, NONE, Status};
use crate::geom::{Point, orient2d};

/// A piece of boundaries, from its smaller end in lexicographic order to the larger one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Piece {
    pub(super) left: Point,
    pub(super) right: Point,
}

/// The numbers below and above each piece, if crossing it from below to above adds its weight.
///
/// The pieces share ends at most.
pub(super) fn numbers(pieces: &[Piece], weights: &[i32]) -> Result<Vec<[i32; 2]>, DomainError> {
    let broken = || DomainError::Internal { stage: "winding" };
    // Ends before starts.
    let mut events: Vec<(Point, bool, u32)> = Vec::with_capacity(2 * pieces.len());
    for (k, piece) in (0..).zip(pieces) {
        events.push((piece.left, true, k));
        events.push((piece.right, false, k));
    }
    events.sort_unstable_by(|a, b| a.0.lexicographic(b.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut numbers = vec![[0; 2]; pieces.len()];
    let mut nodes = vec![NONE; pieces.len()];
    let mut status = Status::new();
    let side = |piece: u32, p: Point| {
        let Piece { left, right } = pieces[piece as usize];
        orient2d(left, right, p)
    };
    let mut start = 0;
    while start < events.len() {
        let p = events[start].0;
        let len = events[start..].iter().take_while(|event| event.0 == p).count();
        let group = &mut events[start..start + len];
        start += len;
        let n_ends = group.iter().take_while(|event| !event.1).count();
        let (ends, starts) = group.split_at_mut(n_ends);
        for &(_, _, piece) in &*ends {
            status.remove(nodes[piece as usize]);
        }
        if starts.is_empty() {
            continue;
        }
        let Found::Above(mut below) = status.search(|piece| side(piece, p)) else {
            return Err(broken());
        };
        // From below to above.
        let right = |event: &(Point, bool, u32)| pieces[event.2 as usize].right;
        starts.sort_unstable_by(|a, b| 0.0_f64.total_cmp(&(orient2d(p, right(a), right(b)) + 0.0)));
        let mut number = if below == NONE { 0 } else { numbers[status.edge(below) as usize][1] };
        for &(_, _, piece) in &*starts {
            let above = number + weights[piece as usize];
            numbers[piece as usize] = [number, above];
            number = above;
            below = status.insert_after(below, piece);
            nodes[piece as usize] = below;
        }
    }
    Ok(numbers)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn piece(a: (f64, f64), b: (f64, f64)) -> (Piece, i32) {
        let [p, q] = [a, b].map(|(x, y)| Point::new(x, y));
        if p.lexicographic(q).is_lt() {
            (Piece { left: p, right: q }, 1)
        } else {
            (Piece { left: q, right: p }, -1)
        }
    }

    #[test]
    fn two_nested_squares_run_the_same_way_are_wound_around_twice() {
        let ring = |s: f64| {
            let c = [(-s, -s), (s, -s), (s, s), (-s, s)];
            (0..4).map(move |k| piece(c[k], c[(k + 1) % 4]))
        };
        let (pieces, weights): (Vec<_>, Vec<_>) = ring(2.0).chain(ring(1.0)).unzip();
        let found = numbers(&pieces, &weights).unwrap();
        for (k, (number, piece)) in found.iter().zip(&pieces).enumerate() {
            let (outside, inside) = if k < 4 { (0, 1) } else { (1, 2) };
            let middle = (piece.left + piece.right) * 0.5;
            // Above of what runs upwards is its left.
            let is_lower = middle.y < 0.0 || middle.x > 0.0;
            let expected = if is_lower { [outside, inside] } else { [inside, outside] };
            assert_eq!(*number, expected, "{piece:?}");
        }
    }
}
