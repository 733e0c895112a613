//! The exact feature transform: for each cell of a shape the cell outside that is nearest to it.
//!
//! # Contract
//! Distances are those between centres, cells may be higher than wide, and what lies around the array is
//! outside. The cell found is one of the nearest; of several, the same one for any number of threads.
//! Time is linear in the cells, four bytes each are kept.
//!
//! # Method
//! [MRH00] in two phases. Along columns, the nearest cell outside above or below. Then along each run of a
//! row: what is nearest in each column of the run, and the cells before and behind it, stand for parabolas
//! whose lower envelope is the answer. Nothing beyond can be nearer than these two, so runs are on their own,
//! and what lies outside costs nothing.
//!
//! Intersections of parabolas are quotients of whole numbers below 2³⁴ by such below 2¹⁷, rounded down: a
//! quotient of doubles is not off so far that this could change.

use super::Bits;
use std::num::NonZeroUsize;

/// For each cell, and a frame of one cell around them, a number of 32 bits.
///
/// Inside of the shape: columns and rows from there to the nearest cell outside. Outside: 0, or what
/// somebody else puts there.
#[derive(Debug)]
pub(crate) struct Features {
    pub stride: usize,
    pub cells: Vec<u32>,
}

/// Columns and rows to the nearest cell outside.
#[inline(always)]
pub(crate) fn offset(cell: u32) -> (i32, i32) {
    (i32::from(cell as u16 as i16), i32::from((cell >> 16) as u16 as i16))
}

#[inline(always)]
fn packed(dx: i32, dy: i32) -> u32 {
    u32::from(dx as u16) | u32::from(dy as u16) << 16
}

impl Features {
    /// The nearest cells outside, where the square of the height of a cell is so many of its width.
    pub fn new(bits: &Bits, aspect: f64, threads: NonZeroUsize) -> Self {
        let (columns, rows) = (bits.columns() as usize, bits.rows() as usize);
        let stride = columns + 2;
        let mut cells = vec![0_u32; stride * (rows + 2)];
        let inner = &mut cells[stride..stride * (rows + 1)];
        along_columns(bits, inner, stride);
        let bands = threads.get().min(rows.max(1));
        let height = rows.div_ceil(bands).max(1);
        let work = |first: usize, band: &mut [u32]| {
            let mut scratch = Envelope::default();
            for (y, row) in (first as u32..).zip(band.chunks_exact_mut(stride)) {
                bits.runs(y).for_each(|(from, to)| {
                    // With the cells before and behind it.
                    scratch.along(&mut row[from as usize..to as usize + 2], aspect);
                });
            }
        };
        if bands == 1 {
            work(0, inner);
        } else {
            std::thread::scope(|scope| {
                for (k, band) in inner.chunks_mut(height * stride).enumerate() {
                    scope.spawn(move || work(k * height, band));
                }
            });
        }
        Self { stride, cells }
    }

    /// The place of a cell, or of one in the frame.
    #[inline(always)]
    pub fn place(&self, x: i32, y: i32) -> usize {
        (y + 1) as usize * self.stride + (x + 1) as usize
    }

    /// Columns and rows from a cell inside to the nearest one outside.
    #[inline(always)]
    pub fn offset(&self, x: i32, y: i32) -> (i32, i32) {
        offset(self.cells[self.place(x, y)])
    }

    /// The square of the distance of a cell inside from the nearest one outside, in widths of a cell.
    #[inline(always)]
    pub fn squared(&self, x: i32, y: i32, aspect: f64) -> f64 {
        let (dx, dy) = self.offset(x, y);
        f64::from(dx * dx) + aspect * f64::from(dy * dy)
    }
}

/// Puts into each cell inside how many rows the nearest one outside of its column is away, upwards as a
/// negative number.
fn along_columns(bits: &Bits, cells: &mut [u32], stride: usize) {
    let rows = bits.rows();
    for y in 0..rows {
        let (above, own) = cells.split_at_mut(y as usize * stride);
        let above = above.rchunks_exact(stride).next();
        for (from, to) in bits.runs(y) {
            let span = from as usize + 1..to as usize + 1;
            match above {
                // Cells outside hold 0.
                Some(above) => own[span.clone()]
                    .iter_mut()
                    .zip(&above[span])
                    .for_each(|(cell, above)| *cell = above + 1),
                None => own[span].fill(1),
            }
        }
    }
    let (mut below, mut down) = (vec![0_u32; stride], vec![0_u32; stride]);
    for y in (0..rows).rev() {
        let row = &mut cells[y as usize * stride..][..stride];
        std::mem::swap(&mut below, &mut down);
        down.fill(0);
        for (from, to) in bits.runs(y) {
            let span = from as usize + 1..to as usize + 1;
            let own = row[span.clone()].iter_mut().zip(&mut down[span.clone()]);
            for ((cell, down), below) in own.zip(&below[span]) {
                *down = below + 1;
                let rows = if *cell <= *down { -(*cell as i32) } else { *down as i32 };
                // Farther than any cell is from the outside where that matters.
                *cell = rows.clamp(-FAR, FAR) as u32;
            }
        }
    }
}

/// As many rows as are kept. Farther than half of the most there can be.
const FAR: i32 = i16::MAX as i32;

/// A parabola of the envelope: whose it is, and from where on it is lowest.
#[derive(Clone, Copy, Debug)]
struct Parabola {
    column: i32,
    rows: i32,
    /// Height of its apex, in squared widths of a cell.
    height: f64,
    /// First column where it is lowest.
    first: i32,
}

#[derive(Debug, Default)]
struct Envelope {
    parabolas: Vec<Parabola>,
}

impl Envelope {
    /// Finds the nearest cells for a run with the cells before and behind it; the run holds rows to the
    /// nearest cell of its column.
    fn along(&mut self, run: &mut [u32], aspect: f64) {
        let last = run.len() - 1;
        if last == 2 {
            // One cell, with one outside on both sides.
            let rows = run[1] as i32;
            let is_nearer = aspect * f64::from(rows * rows) < 1.0;
            run[1] = if is_nearer { packed(0, rows) } else { packed(-1, 0) };
            return;
        }
        let stack = &mut self.parabolas;
        stack.clear();
        stack.push(Parabola { column: 0, rows: 0, height: 0.0, first: 1 });
        let top_column = |column: usize| if column == last { 0 } else { run[column] as i32 };
        for column in 1..=last {
            let rows = top_column(column);
            let height = aspect * f64::from(rows * rows);
            let at = column as i32;
            let first = loop {
                let Some(top) = stack.last() else { break 1 };
                // Where the new one becomes lower than the top one.
                let span = f64::from(at - top.column);
                let rise = f64::from(at * at - top.column * top.column) + (height - top.height);
                // Rounded down, but for what lies before the first column anyway.
                let meet = ((rise / (2.0 * span)) as i32).saturating_add(1);
                if meet > top.first {
                    break meet;
                }
                stack.pop();
            };
            if first < last as i32 {
                stack.push(Parabola { column: at, rows, height, first });
            }
        }
        let mut end = last as i32;
        for parabola in stack.iter().rev() {
            for at in parabola.first.max(1)..end {
                run[at as usize] = packed(parabola.column - at, parabola.rows);
            }
            end = parabola.first;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::dice::dice;
    use crate::raster::{Grid, Mask};

    #[test]
    fn every_cell_finds_one_of_the_nearest() {
        for seed in 0..300 {
            let mut dice = dice(seed + 1);
            let (columns, rows) = (dice() as u32 % 24, dice() as u32 % 24);
            let fill = dice() % 101;
            let aspect = [1.0, 1.0, 4.0, 0.25, 2.0][seed as usize % 5];
            let grid = Grid::of_image(columns, rows);
            let mask = Mask::new(grid, |_, _| dice() % 100 < fill).unwrap();
            let threads = NonZeroUsize::new(1 + seed as usize % 3).unwrap();
            let features = Features::new(&mask.bits, aspect, threads);
            for y in 0..rows as i32 {
                for x in (0..columns as i32).filter(|&x| mask.bits.get(x, y)) {
                    let mut least = f64::INFINITY;
                    for v in -1..=rows as i32 {
                        for u in (-1..=columns as i32).filter(|&u| !mask.bits.get(u, v)) {
                            let (dx, dy) = (f64::from(u - x), f64::from(v - y));
                            least = least.min(dx * dx + aspect * dy * dy);
                        }
                    }
                    let (dx, dy) = features.offset(x, y);
                    assert!(!mask.bits.get(x + dx, y + dy), "{seed}: ({x}, {y}) + ({dx}, {dy})");
                    assert_eq!(features.squared(x, y, aspect), least, "{seed}: ({x}, {y})");
                }
            }
        }
    }
}
