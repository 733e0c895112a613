//! Hilditch's rule [Hil83]: sides in turn and all at once, as cells know which of their neighbours above and to the left go.

use super::fire::{Fire, is_border};
use super::rules::is_simple_inside;
use crate::engine::EngineError;
use crate::raster::{Bits, SIMPLE, WINDOW_RING};

/// One pass in the order of rows: marks what goes, and takes it away then. `marks` is empty before and after.
pub(super) fn pass(fire: &mut Fire<'_>, marks: &mut Bits) -> Result<(), EngineError> {
    fire.active.sort_unstable_by_key(|&[x, y]| (y, x));
    let mut marked = Vec::new();
    for &[x, y] in &fire.active {
        fire.watch.check()?;
        let window = fire.cells.window(x, y);
        if !is_border(window) || !is_simple_inside(window) {
            continue;
        }
        let gone = marks.window(x, y) & WINDOW_RING;
        let has_rest = window & WINDOW_RING & !gone != 0;
        // Above and to the left, each by itself.
        let stays_simple = [1 << 1, 1 << 3]
            .into_iter()
            .all(|bit| gone & bit == 0 || SIMPLE[(window & !bit) as usize]);
        if has_rest && stays_simple {
            marks.set(x, y);
            marked.push([x, y]);
        }
    }
    for [x, y] in marked {
        marks.clear(x, y);
        fire.take([x, y]);
    }
    Ok(())
}
