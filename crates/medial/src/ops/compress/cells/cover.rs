//! Few disks or squares that cover a mask.
//!
//! The ball that covers most of what is left uncovered comes next. What a ball gains only shrinks, so balls
//! wait with what they would have gained when they were looked at last: only the first one has to be looked
//! at again, and is taken if it is still first. In the end balls go that the others cover by themselves.

use super::CellError;
use super::balls::{Ball, BallShape, Widths, spans, union};
use super::chain::medial_balls;
use super::difference::{Difference, difference};
use crate::raster::{Grid, Mask};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Balls that cover a share of a mask, row by row, and what they lack.
pub(super) fn of(
    mask: &Mask,
    shape: BallShape,
    coverage: f64,
) -> Result<(Vec<Ball>, Difference), CellError> {
    let wanted = (coverage * mask.count() as f64).ceil() as u64;
    let mut taken = chosen(mask, shape, wanted.min(mask.count()))?;
    if wanted >= mask.count() {
        taken = needed(mask.grid(), shape, taken);
    }
    finished(mask, shape, taken)
}

/// Balls within an error of a mask, row by row, and what they lack.
pub(super) fn within(
    mask: &Mask,
    shape: BallShape,
    max_error: f64,
) -> Result<(Vec<Ball>, Difference), CellError> {
    let all = chosen(mask, shape, mask.count())?;
    // As many as are needed: the error shrinks with each of them.
    let (mut low, mut high) = (0, all.len());
    while low < high {
        let middle = usize::midpoint(low, high);
        let part = union(mask.grid(), shape, &all[..middle])?;
        if difference(mask, &part).error <= max_error {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    let taken = needed(mask.grid(), shape, all[..high].to_vec());
    finished(mask, shape, taken)
}

fn finished(
    mask: &Mask,
    shape: BallShape,
    mut taken: Vec<Ball>,
) -> Result<(Vec<Ball>, Difference), CellError> {
    taken.sort_unstable();
    let covered = union(mask.grid(), shape, &taken)?;
    Ok((taken, difference(mask, &covered)))
}

/// The balls that cover so many cells, in the order in which they are taken.
fn chosen(mask: &Mask, shape: BallShape, wanted: u64) -> Result<Vec<Ball>, CellError> {
    let balls = match shape {
        BallShape::Disk => medial_balls(mask, None)?,
        BallShape::Square => maximal_squares(mask),
    };
    let mut widths = Widths::new(shape);
    let mut left = Left::new(mask);
    let whole = |widths: &mut Widths, ball: &Ball| {
        let own = widths.of(ball.size);
        let rows = own.iter().map(|half| 2 * u64::from(2 * half + 1));
        rows.sum::<u64>() - u64::from(2 * own[0] + 1)
    };
    // Of equal gains the larger ball, then the one that comes first.
    let mut waiting: BinaryHeap<(u64, u32, Reverse<usize>)> = (0..)
        .zip(&balls)
        .map(|(number, ball)| (whole(&mut widths, ball), ball.size, Reverse(number)))
        .collect();
    let (mut taken, mut covered) = (Vec::new(), 0);
    while covered < wanted {
        let Some((_, size, Reverse(number))) = waiting.pop() else { break };
        let (ball, own) = (&balls[number], widths.of(size));
        let mut gain = 0;
        spans(ball, own, |row, from, to| gain += left.count(row, from, to));
        let now = (gain, size, Reverse(number));
        if waiting.peek().is_some_and(|next| *next > now) {
            if gain > 0 {
                waiting.push(now);
            }
            continue;
        }
        if gain == 0 {
            break;
        }
        spans(ball, own, |row, from, to| left.clear(row, from, to));
        covered += gain;
        taken.push(*ball);
    }
    Ok(taken)
}

/// What is left of balls without those that the others cover, the last ones first.
fn needed(grid: &Grid, shape: BallShape, taken: Vec<Ball>) -> Vec<Ball> {
    let columns = grid.columns as usize;
    let mut depth = vec![0_u32; columns * grid.rows as usize];
    let place = |row: u32, column: u32| row as usize * columns + column as usize;
    let mut widths = Widths::new(shape);
    for ball in &taken {
        spans(ball, widths.of(ball.size), |row, from, to| {
            depth[place(row, from)..place(row, to)].iter_mut().for_each(|depth| *depth += 1);
        });
    }
    let mut kept = Vec::new();
    for ball in taken.into_iter().rev() {
        let own = widths.of(ball.size);
        let mut idle = true;
        spans(&ball, own, |row, from, to| {
            idle = idle && depth[place(row, from)..place(row, to)].iter().all(|&depth| depth > 1);
        });
        if idle {
            spans(&ball, own, |row, from, to| {
                depth[place(row, from)..place(row, to)].iter_mut().for_each(|depth| *depth -= 1);
            });
        } else {
            kept.push(ball);
        }
    }
    kept
}

/// The largest squares around cells that lie in a mask, but for those that lie in others: the medial axis by
/// rows or columns.
fn maximal_squares(mask: &Mask) -> Vec<Ball> {
    let Grid { columns, rows, .. } = *mask.grid();
    let stride = columns as usize + 2;
    // The distance to the nearest cell outside, with a frame of zeros.
    let mut sizes = vec![0_u32; stride * (rows as usize + 2)];
    let place = |x: u32, y: u32| (y as usize + 1) * stride + x as usize + 1;
    let least = |sizes: &[u32], places: [usize; 4]| {
        places.into_iter().map(|place| sizes[place]).min().unwrap_or(0)
    };
    for y in 0..rows {
        for x in mask.cells(y) {
            let at = place(x, y);
            let before = [at - 1, at - stride - 1, at - stride, at - stride + 1];
            sizes[at] = 1 + least(&sizes, before);
        }
    }
    for y in (0..rows).rev() {
        let row: Vec<u32> = mask.cells(y).collect();
        for &x in row.iter().rev() {
            let at = place(x, y);
            let behind = [at + 1, at + stride - 1, at + stride, at + stride + 1];
            sizes[at] = sizes[at].min(1 + least(&sizes, behind));
        }
    }
    let mut found = Vec::new();
    for y in 0..rows {
        for x in mask.cells(y) {
            let at = place(x, y);
            let size = sizes[at];
            let mut around =
                [at - stride, at, at + stride].into_iter().flat_map(|at| [at - 1, at, at + 1]);
            if around.all(|near| sizes[near] <= size) {
                found.push(Ball { y, x, size });
            }
        }
    }
    found
}

/// Cells that are not covered yet, 64 to a word.
struct Left {
    stride: usize,
    words: Vec<u64>,
}

impl Left {
    fn new(mask: &Mask) -> Self {
        let Grid { columns, rows, .. } = *mask.grid();
        let stride = (columns as usize).div_ceil(64);
        let mut words = vec![0_u64; stride * rows as usize];
        for y in 0..rows {
            let row = &mut words[y as usize * stride..][..stride];
            for (word, bytes) in row.iter_mut().zip(mask.row(y).chunks(8)) {
                let mut eight = [0; 8];
                eight[..bytes.len()].copy_from_slice(bytes);
                *word = u64::from_le_bytes(eight);
            }
        }
        Self { stride, words }
    }

    /// The words of a row that hold some of its cells, and which bits of the first and the last one these are.
    #[inline]
    fn part(&self, row: u32, from: u32, to: u32) -> (std::ops::RangeInclusive<usize>, u64, u64) {
        let first = row as usize * self.stride;
        let words = first + from as usize / 64..=first + (to as usize - 1) / 64;
        (words, u64::MAX << (from % 64), u64::MAX >> (63 - (to - 1) % 64))
    }

    #[inline]
    fn count(&self, row: u32, from: u32, to: u32) -> u64 {
        let (range, low, high) = self.part(row, from, to);
        let ones = match &self.words[range] {
            [] => 0,
            [word] => (word & low & high).count_ones(),
            [first, middle @ .., last] => {
                let middle: u32 = middle.iter().map(|word| word.count_ones()).sum();
                (first & low).count_ones() + middle + (last & high).count_ones()
            }
        };
        ones.into()
    }

    #[inline]
    fn clear(&mut self, row: u32, from: u32, to: u32) {
        let (range, low, high) = self.part(row, from, to);
        match &mut self.words[range] {
            [] => {}
            [word] => *word &= !(low & high),
            [first, middle @ .., last] => {
                *first &= !low;
                middle.fill(0);
                *last &= !high;
            }
        }
    }
}
