//! The contour is looked at first, and burns afterwards [AS78].
//!
//! A cell of the contour stays if it is *multiple*: the contour passes it more than once, or all its neighbours
//! are on the contour as well, or it has one at a side that the contour does not pass right before or after it.

use super::fire::{Fire, is_border};
use super::rules::is_simple_inside;
use crate::engine::EngineError;
use crate::raster::{Bits, SIMPLE};

/// How far away cells are that a cell goes or stays by.
pub(super) const REACH: i32 = 2;

/// One pass: marks all that is not multiple, and takes it away then.
///
/// Where several marked cells hold on to one that stayed before, one of them is needed when the others are
/// gone.
pub(super) fn pass(fire: &mut Fire<'_>) -> Result<(), EngineError> {
    let mut marked = Vec::new();
    for &[x, y] in &fire.active {
        fire.watch.check()?;
        if is_border(fire.cells.window(x, y)) && !is_multiple(&fire.cells, x, y) {
            marked.push([x, y]);
        }
    }
    marked.sort_unstable_by_key(|&[x, y]| (y, x));
    for [x, y] in marked {
        if is_simple_inside(fire.cells.window(x, y)) {
            fire.take([x, y]);
        }
    }
    Ok(())
}

/// Whether a cell of the contour is multiple.
fn is_multiple(cells: &Bits, x: i32, y: i32) -> bool {
    let window = cells.window(x, y);
    let is_set = |dx: i32, dy: i32| window >> (4 + dx + 3 * dy) & 1 != 0;
    // The contour passes a simple cell once.
    if !SIMPLE[window as usize] {
        return true;
    }
    let around = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (dx, dy)));
    let is_inner = |(dx, dy): (i32, i32)| {
        (dx, dy) != (0, 0) && is_set(dx, dy) && !is_border(cells.window(x + dx, y + dy))
    };
    if !around.clone().any(is_inner) {
        return true;
    }
    // Two cells side by side follow one another where both are open towards the same side of their line.
    [(1, 0), (0, 1), (-1, 0), (0, -1)].into_iter().any(|(dx, dy)| {
        let is_open = |sign: i32| {
            let (ux, uy) = (-dy * sign, dx * sign);
            !is_set(ux, uy) && !is_set(dx + ux, dy + uy)
        };
        is_set(dx, dy) && is_border(cells.window(x + dx, y + dy)) && !is_open(1) && !is_open(-1)
    })
}
