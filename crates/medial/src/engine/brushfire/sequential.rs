//! One cell after another, each checked when it is to go [RK82].

use super::fire::{Fire, is_border};
use super::rules::is_simple_inside;
use crate::engine::EngineError;

/// One pass in the order of rows: whatever was border when it began goes, unless it is an end or needed by then.
pub(super) fn pass(fire: &mut Fire<'_>) -> Result<(), EngineError> {
    let cells = &fire.cells;
    let is_now = |&&[x, y]: &&[i32; 2]| is_border(cells.window(x, y));
    let mut border: Vec<[i32; 2]> = fire.active.iter().filter(is_now).copied().collect();
    border.sort_unstable_by_key(|&[x, y]| (y, x));
    for [x, y] in border {
        fire.watch.check()?;
        if is_simple_inside(fire.cells.window(x, y)) {
            fire.take([x, y]);
        }
    }
    Ok(())
}
