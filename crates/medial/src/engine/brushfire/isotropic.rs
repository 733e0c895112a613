//! All sides at once, looking ahead [ACL74].
//!
//! Cells that are simple one by one need not be so together. By Ronse's theorem [Ron88] those go together that are simple,
//! of which any two side by side can go one after the other, and of which no component is made that lies within two
//! by two cells. Where two cannot go, neither does, so what is left turns and mirrors with the shape: strokes of one or two cells.

use super::fire::{Fire, is_border};
use super::rules::is_simple_inside;
use crate::engine::EngineError;
use crate::raster::{Bits, SIMPLE, WINDOW_RING};

/// How far away cells are that a cell goes or stays by.
pub(super) const REACH: i32 = 2;

/// Takes away at once what may go together. Strokes two cells wide stay.
pub(super) fn pass(fire: &mut Fire<'_>) -> Result<(), EngineError> {
    fire.take_where(|cells, [x, y]| {
        may_go(cells, x, y)
            && [(1, 0), (0, 1), (-1, 0), (0, -1)].into_iter().all(|(dx, dy)| {
                !may_go(cells, x + dx, y + dy) || can_both_go(cells, [x, y], dx, dy)
            })
            && !is_a_component_within_four(cells, x, y)
            && !ends_a_stroke_of_two(cells, x, y)
    })
}

/// Whether a cell may go by itself.
fn may_go(cells: &Bits, x: i32, y: i32) -> bool {
    if !is_within(cells, x, y) || !cells.get(x, y) {
        return false;
    }
    let window = cells.window(x, y);
    is_border(window) && is_simple_inside(window)
}

/// Whether the neighbour of a simple cell is simple without that cell.
fn can_both_go(cells: &Bits, [x, y]: [i32; 2], dx: i32, dy: i32) -> bool {
    let without = 1 << (4 - dx - 3 * dy);
    SIMPLE[(cells.window(x + dx, y + dy) & !without) as usize]
}

/// Whether a cell is one of the two at the end of a stroke two cells wide: it and its three neighbours are a
/// block, and across the stroke nothing follows. Without this, such strokes burn away from their ends.
fn ends_a_stroke_of_two(cells: &Bits, x: i32, y: i32) -> bool {
    let ring = cells.window(x, y) & WINDOW_RING;
    let is_set = |u: i32, v: i32| is_within(cells, u, v) && cells.get(u, v);
    let turns = [(1, 1), (1, -1), (-1, 1), (-1, -1)];
    ring.count_ones() == 3
        && turns.into_iter().any(|(dx, dy)| {
            let block = [(x + dx, y), (x, y + dy), (x + dx, y + dy)];
            let is_block = block.into_iter().all(|(u, v)| is_set(u, v));
            let along_row =
                (x - 1..=x + 1).all(|u| !is_set(u, y + 2 * dy)) && !is_set(x - dx, y + dy);
            let along_column =
                (y - 1..=y + 1).all(|v| !is_set(x + 2 * dx, v)) && !is_set(x + dx, y - dy);
            is_block && (along_row || along_column)
        })
}

/// Whether all that a cell is connected with lies within two by two cells.
fn is_a_component_within_four(cells: &Bits, x: i32, y: i32) -> bool {
    if (cells.window(x, y) & WINDOW_RING).count_ones() > 3 {
        return false;
    }
    let is_set = |u: i32, v: i32| is_within(cells, u, v) && cells.get(u, v);
    [(x - 1, y - 1), (x, y - 1), (x - 1, y), (x, y)].into_iter().any(|(left, top)| {
        let four = move || (top..top + 2).flat_map(move |v| (left..left + 2).map(move |u| (u, v)));
        // The neighbours of each cell in the block that is set.
        four().filter(|&(u, v)| is_set(u, v)).all(|(u, v)| {
            let mut around = (v - 1..=v + 1).flat_map(|t| (u - 1..=u + 1).map(move |s| (s, t)));
            around.all(|(s, t)| {
                let is_within = (left..left + 2).contains(&s) && (top..top + 2).contains(&t);
                is_within || !is_set(s, t)
            })
        })
    })
}

fn is_within(cells: &Bits, x: i32, y: i32) -> bool {
    (0..cells.columns() as i32).contains(&x) && (0..cells.rows() as i32).contains(&y)
}
