//! Thinning without changing components and holes: what is to be kept is given, the rest goes in the order of
//! the distance, and what is thicker than one cell in the end loses its worst cells first.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::medial_cells::MedialCell;
use crate::raster::{Bits, SIMPLE, WINDOW_RING, can_go};

/// Steps of the distance within which cells go in the order in which they became removable.
const STEPS_PER_CELL: f32 = 4.0;

/// The eight neighbours of a cell, by their bits in a window.
const NEIGHBOURS: [(u16, i32, i32); 8] = [
    (1 << 0, -1, -1),
    (1 << 1, 0, -1),
    (1 << 2, 1, -1),
    (1 << 3, -1, 0),
    (1 << 5, 1, 0),
    (1 << 6, -1, 1),
    (1 << 7, 0, 1),
    (1 << 8, 1, 1),
];

/// A cell as its column and row.
fn packed(x: i32, y: i32) -> u32 {
    (y as u32) << 16 | x as u32
}

fn unpacked(cell: u32) -> (i32, i32) {
    ((cell & 0xffff) as i32, (cell >> 16) as i32)
}

/// Takes from a shape all cells that can go without changing components and holes, nearest to the boundary
/// first, but those to be kept. Squares of distances are given, in widths of a cell.
///
/// Every cell that was left over can go no more.
pub(super) fn thin(shape: &mut Bits, kept: &Bits, squared: impl Fn(i32, i32) -> f64) {
    // Cells that wait for their turn, by distance. Each comes in with the first of its neighbours that
    // goes, and is asked once it is its turn: then those nearer to the boundary are gone.
    let mut queues: Vec<Vec<u32>> = Vec::new();
    let mut waits = Bits::new(shape.columns(), shape.rows());
    let level = |x, y| ((squared(x, y) as f32).sqrt() * STEPS_PER_CELL) as usize;
    let push = |queues: &mut Vec<Vec<u32>>, at: usize, x, y| {
        if queues.len() <= at {
            queues.resize_with(at + 1, Vec::new);
        }
        queues[at].push(packed(x, y));
    };
    for y in 0..shape.rows() as i32 {
        for (from, to) in shape.runs(y as u32) {
            for x in from as i32..to as i32 {
                if shape.window(x, y) & WINDOW_RING != WINDOW_RING && !kept.get(x, y) {
                    waits.set(x, y);
                    push(&mut queues, level(x, y), x, y);
                }
            }
        }
    }
    let mut now = 0;
    while now < queues.len() {
        // Cells that come in meanwhile are behind those that are here.
        let mut next = 0;
        while let Some(&cell) = queues[now].get(next) {
            next += 1;
            let (x, y) = unpacked(cell);
            waits.clear(x, y);
            let window = shape.window(x, y);
            if !SIMPLE[window as usize] {
                continue;
            }
            shape.clear(x, y);
            let free = window & WINDOW_RING & !kept.window(x, y) & !waits.window(x, y);
            for (bit, dx, dy) in NEIGHBOURS {
                if free & bit != 0 {
                    let (u, v) = (x + dx, y + dy);
                    waits.set(u, v);
                    push(&mut queues, level(u, v).max(now), u, v);
                }
            }
        }
        queues[now] = Vec::new();
        now += 1;
    }
}

/// Takes from what is left those cells that are neither ends nor needed to hold the rest together, the worst
/// first: those of the least residual, then of the least distance.
pub(super) fn thin_further(
    shape: &mut Bits,
    medial: &[MedialCell],
    squared: impl Fn(i32, i32) -> f64,
) {
    let residual = |cell: u32| {
        let place = |medial: &MedialCell| packed(medial.x as i32, medial.y as i32);
        medial.binary_search_by_key(&cell, place).map_or(0.0, |found| medial[found].residual)
    };
    let quality = |cell: u32| {
        let (x, y) = unpacked(cell);
        // Neither is negative, so their bits are in their order.
        u64::from(residual(cell).to_bits()) << 32 | u64::from((squared(x, y) as f32).to_bits())
    };
    // What cannot go may be able to once a neighbour is gone.
    let mut waiting = BinaryHeap::new();
    for y in 0..shape.rows() {
        let may_go = |x: &u32| can_go(shape.window(*x as i32, y as i32));
        for x in shape.ones(y).filter(may_go) {
            let cell = packed(x as i32, y as i32);
            waiting.push(Reverse((quality(cell), cell)));
        }
    }
    while let Some(Reverse((_, cell))) = waiting.pop() {
        let (x, y) = unpacked(cell);
        let window = shape.window(x, y);
        if !shape.get(x, y) || !can_go(window) {
            continue;
        }
        shape.clear(x, y);
        for (_, dx, dy) in NEIGHBOURS.into_iter().filter(|(bit, ..)| window & bit != 0) {
            if can_go(shape.window(x + dx, y + dy)) {
                let cell = packed(x + dx, y + dy);
                waiting.push(Reverse((quality(cell), cell)));
            }
        }
    }
}
