//! One cell after another, each checked when it is to go [RK82].

use super::fire::{Fire, is_border};
use super::rules::is_simple_inside;
use crate::engine::EngineError;
use crate::raster::can_go;

/// One pass in the order of rows through strokes two cells wide, which are one cell wide then: what goes is
/// neither needed nor one of two cells beside each other that end a stroke.
pub(super) fn finish(fire: &mut Fire<'_>) -> Result<(), EngineError> {
    in_rows(fire, can_go)
}

/// One pass in the order of rows: whatever was border when it began goes, unless it is an end or needed by then.
pub(super) fn pass(fire: &mut Fire<'_>) -> Result<(), EngineError> {
    in_rows(fire, is_simple_inside)
}

fn in_rows(fire: &mut Fire<'_>, may_go: fn(u16) -> bool) -> Result<(), EngineError> {
    let cells = &fire.cells;
    let is_now = |&&[x, y]: &&[i32; 2]| is_border(cells.window(x, y));
    let mut border: Vec<[i32; 2]> = fire.active.iter().filter(is_now).copied().collect();
    border.sort_unstable_by_key(|&[x, y]| (y, x));
    for [x, y] in border {
        fire.watch.check()?;
        if may_go(fire.cells.window(x, y)) {
            fire.take([x, y]);
        }
    }
    Ok(())
}
