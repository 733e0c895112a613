//! How far a mask and a part of it are apart.

use crate::raster::{Bits, Features, Grid, Mask};
use std::num::NonZeroUsize;

/// What a part of a mask lacks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Difference {
    /// The Hausdorff distance of both, or of what lies outside of them if that is larger, in units of the
    /// plane; infinite if nothing is left.
    pub error: f64,
    /// Cells of the mask that do not belong to the part.
    pub missing: u64,
}

/// Cells around the array that are enough to find most distances.
const FRAME: u32 = 30;

/// Most cells around it, for memory: what is farther away than that is taken to be as far as can be.
const MOST: u32 = 2000;

/// The nearest cells outside; rows are asked for in their order.
fn of(bits: &Bits, aspect: f64) -> Features<'_> {
    Features::new(bits, aspect, NonZeroUsize::MIN, Features::usual_height(bits))
}

/// How far a part of a mask is from it.
///
/// As nothing is added, no cell of the part is away from the mask, nor any cell outside of the mask from the
/// outside of the part; so only what is missing counts: how far it is from the part, and from the outside of
/// the mask.
pub(super) fn difference(mask: &Mask, part: &Mask) -> Difference {
    let rows = mask.grid().rows;
    let lacks = |y: u32| mask.cells(y).filter(move |&x| !part.get(x, y));
    let missing: u64 = (0..rows).map(|y| lacks(y).count() as u64).sum();
    if missing == 0 {
        return Difference { error: 0.0, missing };
    }
    let (aspect, width) = (mask.grid().aspect(), mask.grid().cell[0].abs());
    if part.count() == 0 {
        return Difference { error: f64::INFINITY, missing };
    }
    let features = of(&mask.bits, aspect);
    let mut most = 0.0_f64;
    for y in 0..rows {
        lacks(y).for_each(|x| most = most.max(features.squared(x as i32, y as i32)));
    }
    drop(features);
    let mut frame = FRAME;
    loop {
        // Seen from outside of the part its cells are what is nearest, if the frame does not end before.
        let (bits, frame_squared) = outside(part, frame, aspect);
        let features = of(&bits, aspect);
        let mut farthest = 0.0_f64;
        for y in 0..rows {
            lacks(y).for_each(|x| {
                let at = [x + frame, y + frame].map(|place| place as i32);
                farthest = farthest.max(features.squared(at[0], at[1]));
            });
        }
        if farthest < frame_squared {
            return Difference { error: most.max(farthest).sqrt() * width, missing };
        }
        if frame == MOST {
            let Grid { columns, rows, cell: [width, height], .. } = *mask.grid();
            let error = (f64::from(columns) * width).hypot(f64::from(rows) * height);
            return Difference { error, missing };
        }
        frame = MOST.min(4 * frame);
    }
}

/// The cells that do not belong to a mask, with a frame around them, and the square of the least distance of
/// a cell of the array from what lies beyond the frame.
fn outside(mask: &Mask, frame: u32, aspect: f64) -> (Bits, f64) {
    let Grid { columns, rows, .. } = *mask.grid();
    let mut bits = Bits::new(columns + 2 * frame, rows + 2 * frame);
    for y in 0..rows + 2 * frame {
        bits.set_run(y, 0, columns + 2 * frame);
        if (frame..frame + rows).contains(&y) {
            for (from, to) in mask.bits.runs(y - frame) {
                bits.clear_run(y, from + frame, to + frame);
            }
        }
    }
    let least = f64::from(frame + 1).powi(2) * aspect.min(1.0);
    (bits, least)
}
