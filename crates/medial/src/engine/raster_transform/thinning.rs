//! Thinning without changing components and holes: what is to be kept is given, the rest goes in the order of
//! the distance, and what is thicker than one cell in the end loses its worst cells first.

use super::medial_cells::MedialCell;
use crate::raster::{Bits, SIMPLE, WINDOW_RING};

/// Steps of the distance within which cells go in the order in which they became removable.
const STEPS_PER_CELL: f64 = 4.0;

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

/// Takes from a shape all cells that can go without changing components and holes, nearest to the boundary
/// first, but those to be kept.
///
/// Every cell that was left over can go no more.
pub(super) fn thin(shape: &mut Bits, kept: &Bits, distance: impl Fn(i32, i32) -> f64) {
    // Cells that wait for their turn, by distance.
    let mut queues: Vec<Vec<(i32, i32)>> = Vec::new();
    let mut waits = Bits::new(shape.columns(), shape.rows());
    let level = |x, y| (distance(x, y) * STEPS_PER_CELL) as usize;
    let push = |queues: &mut Vec<Vec<(i32, i32)>>, at: usize, cell| {
        if queues.len() <= at {
            queues.resize_with(at + 1, Vec::new);
        }
        queues[at].push(cell);
    };
    for y in 0..shape.rows() as i32 {
        for (from, to) in shape.runs(y as u32) {
            for x in from as i32..to as i32 {
                if !kept.get(x, y) && SIMPLE[shape.window(x, y) as usize] {
                    waits.set(x, y);
                    push(&mut queues, level(x, y), (x, y));
                }
            }
        }
    }
    let mut now = 0;
    while now < queues.len() {
        // Cells that come in meanwhile are behind those that are here.
        let mut next = 0;
        while let Some(&(x, y)) = queues[now].get(next) {
            next += 1;
            waits.clear(x, y);
            let window = shape.window(x, y);
            if !SIMPLE[window as usize] {
                continue;
            }
            shape.clear(x, y);
            let free = window & WINDOW_RING & !kept.window(x, y) & !waits.window(x, y);
            for (bit, dx, dy) in NEIGHBOURS {
                let (u, v) = (x + dx, y + dy);
                if free & bit != 0 && SIMPLE[shape.window(u, v) as usize] {
                    waits.set(u, v);
                    push(&mut queues, level(u, v).max(now), (u, v));
                }
            }
        }
        queues[now] = Vec::new();
        now += 1;
    }
}

/// Takes from what is left those cells that are neither ends nor needed to hold the rest together, the worst
/// first, until none is left.
pub(super) fn thin_further(
    shape: &mut Bits,
    medial: &[MedialCell],
    distance: impl Fn(i32, i32) -> f64,
) {
    let mut cells: Vec<(f32, f32, i32, i32)> = Vec::new();
    let mut medial = medial.iter().peekable();
    for y in 0..shape.rows() {
        for x in shape.ones(y) {
            let is_before = |cell: &&MedialCell| (cell.y, cell.x) < (y, x);
            while medial.next_if(is_before).is_some() {}
            let own = medial.peek().filter(|cell| (cell.y, cell.x) == (y, x));
            let residual = own.map_or(0.0, |cell| cell.residual);
            let (x, y) = (x as i32, y as i32);
            cells.push((residual, distance(x, y) as f32, y, x));
        }
    }
    cells.sort_unstable_by(|a, b| {
        a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)).then((a.2, a.3).cmp(&(b.2, b.3)))
    });
    // What cannot go may be able to once what comes later is gone.
    loop {
        let before = cells.len();
        cells.retain(|&(_, _, y, x)| {
            let goes = can_go(shape.window(x, y));
            if goes {
                shape.clear(x, y);
            }
            !goes
        });
        if cells.len() == before {
            break;
        }
    }
}

/// Whether the cell in the middle of a window is neither an end nor needed.
///
/// An end has one neighbour, or two that are beside each other.
fn can_go(window: u16) -> bool {
    if !SIMPLE[window as usize] {
        return false;
    }
    let ring = window & WINDOW_RING;
    match ring.count_ones() {
        0 | 1 => false,
        2 => !ENDS.contains(&ring),
        _ => true,
    }
}

/// Pairs of neighbours beside each other.
const ENDS: [u16; 8] = [
    1 << 0 | 1 << 1,
    1 << 1 | 1 << 2,
    1 << 2 | 1 << 5,
    1 << 5 | 1 << 8,
    1 << 8 | 1 << 7,
    1 << 7 | 1 << 6,
    1 << 6 | 1 << 3,
    1 << 3 | 1 << 0,
];
