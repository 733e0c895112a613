//! The exact feature transform: for each cell of a shape the cell outside that is nearest to it.
//!
//! # Contract
//! Distances are those between centres, cells may be higher than wide, and what lies around the array is
//! outside. The cell found is one of the nearest; of several, the same one for any number of threads and
//! any height of bands. Time is linear in the cells, and four bytes are kept for each cell of the shape in a
//! band, besides a bit and a half for each cell.
//!
//! # Method
//! [MRH00] in two phases. Along columns, the nearest cell outside above or below. Then along each run of a
//! row: what is nearest in each column of the run, and the cells before and behind it, stand for parabolas
//! whose lower envelope is the answer. Nothing beyond can be nearer than these two, so runs are on their own,
//! and what lies outside costs nothing.
//!
//! Rows are on their own as well once the first phase is known, so a band of them can be made at any time from
//! what its columns say just above and just below it.
//!
//! Intersections of parabolas are quotients of whole numbers below 2³⁴ by such below 2¹⁷, rounded down: a
//! quotient of doubles is not off so far that this could change.

use super::Bits;
use super::ranks::Ranks;
use std::num::NonZeroUsize;
use std::ops::Range;
use std::sync::{Mutex, PoisonError};

/// The nearest cells outside of all cells of a shape, in bands of rows of which one is kept at a time.
#[derive(Debug)]
pub(crate) struct Features<'b> {
    bits: &'b Bits,
    aspect: f64,
    threads: NonZeroUsize,
    /// Rows of a band.
    height: u32,
    /// What each band but the only one needs to be made.
    carries: Vec<Carry>,
    held: Held,
}

/// What is kept.
#[derive(Debug)]
enum Held {
    Whole(Band),
    /// The band that was asked for last.
    One(Mutex<Band>),
}

/// How far the nearest cell outside is along each column, from the row above a band upwards, and from the row
/// below it downwards; 0 for cells outside.
#[derive(Debug)]
struct Carry {
    above: Vec<u16>,
    below: Vec<u16>,
}

/// Rows that a band knows above and below its own, so that neighbours can be asked for.
const OVERLAP: u32 = 2;

/// A band of rows: for each cell of the shape the way to the nearest cell outside.
#[derive(Debug)]
pub(crate) struct Band {
    /// The rows that are known.
    rows: Range<u32>,
    aspect: f64,
    /// The places of the cells.
    ranks: Ranks,
    offsets: Vec<Offset>,
}

/// Columns and rows to the nearest cell outside.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Offset(u32);

impl Offset {
    #[inline(always)]
    pub fn both(self) -> (i32, i32) {
        (i32::from(self.0 as u16 as i16), i32::from((self.0 >> 16) as u16 as i16))
    }

    /// The square of the distance, in widths of a cell.
    #[inline(always)]
    pub fn squared(self, aspect: f64) -> f64 {
        let (dx, dy) = self.both();
        f64::from(dx * dx) + aspect * f64::from(dy * dy)
    }
}

#[inline(always)]
fn packed(dx: i32, dy: i32) -> Offset {
    Offset(u32::from(dx as u16) | u32::from(dy as u16) << 16)
}

impl<'b> Features<'b> {
    /// The nearest cells outside, where the square of the height of a cell is so many of its width, in bands of
    /// so many rows.
    pub fn new(bits: &'b Bits, aspect: f64, threads: NonZeroUsize, height: u32) -> Self {
        let rows = bits.rows();
        let height = height.max(1);
        let carries = if height < rows { carries(bits, height) } else { Vec::new() };
        let mut band = Band { rows: 0..0, aspect, ranks: Ranks::default(), offsets: Vec::new() };
        let held = if carries.is_empty() {
            band.make(bits, 0..rows, None, threads);
            Held::Whole(band)
        } else {
            Held::One(Mutex::new(band))
        };
        Self { bits, aspect, threads, height, carries, held }
    }

    /// As many rows as are kept at a time where nothing else is said.
    pub fn usual_height(bits: &Bits) -> u32 {
        /// Masks of no more cells are kept whole: at most 270 MB, if all belong to the shape.
        const WHOLE: u64 = 1 << 26;
        /// Cells of a band of larger ones: as few as cost little time.
        const CELLS: u64 = 1 << 24;
        let (columns, rows) = (u64::from(bits.columns()), bits.rows());
        if columns * u64::from(rows) <= WHOLE { rows } else { (CELLS / columns).max(64) as u32 }
    }

    /// The rows of each band.
    pub fn bands(&self) -> impl Iterator<Item = Range<u32>> + use<> {
        let (rows, height) = (self.bits.rows(), self.height);
        (0..rows).step_by(height as usize).map(move |y| y..rows.min(y.saturating_add(height)))
    }

    /// Looks into the band with a row, which knows two rows above and below its own, too.
    pub fn with_band<R>(&self, row: u32, look: impl FnOnce(&Band) -> R) -> R {
        match &self.held {
            Held::Whole(band) => look(band),
            Held::One(band) => {
                let mut band = band.lock().unwrap_or_else(PoisonError::into_inner);
                self.make(&mut band, row);
                look(&band)
            }
        }
    }

    /// Makes the band with a row, unless it is there.
    fn make(&self, band: &mut Band, row: u32) {
        let number = row / self.height;
        let rows = around(number, self.height, self.bits.rows());
        if band.rows != rows {
            let carry = &self.carries[number as usize];
            band.make(self.bits, rows, Some(carry), self.threads);
        }
    }

    /// Columns and rows from a cell inside to the nearest one outside. Quick if rows are asked for in their
    /// order, or there is one band.
    #[inline(always)]
    pub fn offset(&self, x: i32, y: i32) -> (i32, i32) {
        match &self.held {
            Held::Whole(band) => band.offset(x, y),
            Held::One(band) => {
                let mut band = band.lock().unwrap_or_else(PoisonError::into_inner);
                if !band.has(y) {
                    self.make(&mut band, y as u32);
                }
                band.offset(x, y)
            }
        }
    }

    /// The square of the distance of a cell inside from the nearest one outside, in widths of a cell.
    #[inline(always)]
    pub fn squared(&self, x: i32, y: i32) -> f64 {
        let (dx, dy) = self.offset(x, y);
        packed(dx, dy).squared(self.aspect)
    }
}

impl Band {
    #[inline(always)]
    fn at(&self, x: i32, y: i32) -> Offset {
        let (place, is_inside) = self.ranks.rank(x, y);
        if is_inside { self.offsets[place] } else { Offset::default() }
    }

    /// Columns and rows from a cell inside to the nearest one outside; from one outside that is 0.
    #[inline(always)]
    pub fn offset(&self, x: i32, y: i32) -> (i32, i32) {
        self.at(x, y).both()
    }

    /// The square of the distance of a cell inside from the nearest one outside, in widths of a cell.
    #[inline(always)]
    pub fn squared(&self, x: i32, y: i32) -> f64 {
        self.at(x, y).squared(self.aspect)
    }

    /// Copies what is known of the cells of the shape in a row, each to its column.
    pub fn copy_row(&self, bits: &Bits, y: u32, to: &mut [Offset]) {
        let mut next = self.ranks.before_row(y as i32);
        for (from, end) in bits.runs(y) {
            let n = (end - from) as usize;
            to[from as usize..end as usize].copy_from_slice(&self.offsets[next..next + n]);
            next += n;
        }
    }

    /// Whether it knows a row.
    fn has(&self, y: i32) -> bool {
        self.rows.contains(&(y as u32))
    }

    /// Finds the nearest cells of other rows.
    fn make(
        &mut self,
        bits: &Bits,
        rows: Range<u32>,
        carry: Option<&Carry>,
        threads: NonZeroUsize,
    ) {
        let aspect = self.aspect;
        self.rows = rows.clone();
        self.ranks = Ranks::new(bits, rows.start as i32, rows.len());
        for y in rows.clone() {
            for number in 0..bits.n_framed_words() {
                self.ranks.push(bits.framed_word(y as i32, number));
            }
        }
        self.offsets.clear();
        along_columns(bits, &mut self.offsets, &self.ranks, rows.clone(), carry);
        let shares = threads.get().min(rows.len().max(1));
        let height = rows.len().div_ceil(shares).max(1);
        let work = |rows: Range<u32>, mut share: &mut [Offset]| {
            let mut scratch = Envelope::default();
            for y in rows {
                for (from, to) in bits.runs(y) {
                    let (run, rest) = share.split_at_mut((to - from) as usize);
                    scratch.along(run, aspect);
                    share = rest;
                }
            }
        };
        if shares == 1 {
            return work(rows, &mut self.offsets);
        }
        let (ranks, mut rest) = (&self.ranks, &mut self.offsets[..]);
        std::thread::scope(|scope| {
            for start in rows.clone().step_by(height) {
                let end = rows.end.min(start + height as u32);
                let n = ranks.before_row(end as i32) - ranks.before_row(start as i32);
                let (share, others) = std::mem::take(&mut rest).split_at_mut(n);
                rest = others;
                scope.spawn(move || work(start..end, share));
            }
        });
    }
}

/// The rows that a band knows.
fn around(number: u32, height: u32, rows: u32) -> Range<u32> {
    let first = number * height;
    first.saturating_sub(OVERLAP)..rows.min(first.saturating_add(height).saturating_add(OVERLAP))
}

/// What each band of so many rows needs to be made.
fn carries(bits: &Bits, height: u32) -> Vec<Carry> {
    let (columns, rows) = (bits.columns() as usize, bits.rows());
    let n = rows.div_ceil(height);
    let known: Vec<Range<u32>> = (0..n).map(|number| around(number, height, rows)).collect();
    let mut carries: Vec<Carry> =
        known.iter().map(|_| Carry { above: vec![0; columns], below: vec![0; columns] }).collect();
    let mut counts = vec![0; columns];
    let mut next = known.iter().zip(&mut carries).peekable();
    for y in 0..rows {
        while let Some((_, carry)) = next.next_if(|(known, _)| known.start == y) {
            carry.above.copy_from_slice(&counts);
        }
        further(bits, &mut counts, y);
    }
    counts.fill(0);
    let mut next = known.iter().zip(&mut carries).rev().peekable();
    for y in (0..rows).rev() {
        while let Some((_, carry)) = next.next_if(|(known, _)| known.end == y + 1) {
            carry.below.copy_from_slice(&counts);
        }
        further(bits, &mut counts, y);
    }
    carries
}

/// Goes on to a row: how many cells of the shape are in each column, since the last one outside. As many as there
/// can be fit into 16 bits.
fn further(bits: &Bits, counts: &mut [u16], y: u32) {
    let mut last = 0;
    for (from, to) in bits.runs(y) {
        counts[last..from as usize].fill(0);
        counts[from as usize..to as usize].iter_mut().for_each(|count| *count += 1);
        last = to as usize;
    }
    counts[last..].fill(0);
}

/// Lists for each cell of the shape in some rows how many rows the nearest one outside of its column is away,
/// upwards as a negative number.
fn along_columns(
    bits: &Bits,
    cells: &mut Vec<Offset>,
    ranks: &Ranks,
    rows: Range<u32>,
    carry: Option<&Carry>,
) {
    let none = || vec![0; bits.columns() as usize];
    let mut counts = carry.map_or_else(none, |carry| carry.above.clone());
    cells.reserve_exact(ranks.len());
    for y in rows.clone() {
        further(bits, &mut counts, y);
        for (from, to) in bits.runs(y) {
            let run = &counts[from as usize..to as usize];
            cells.extend(run.iter().map(|&count| Offset(count.into())));
        }
    }
    let mut counts = carry.map_or_else(none, |carry| carry.below.clone());
    for y in rows.rev() {
        further(bits, &mut counts, y);
        let mut next = ranks.before_row(y as i32);
        for (from, to) in bits.runs(y) {
            let run = &counts[from as usize..to as usize];
            for (cell, &below) in cells[next..].iter_mut().zip(run) {
                let (above, below) = (cell.0 as i32, i32::from(below));
                let rows = if above <= below { -above } else { below };
                // Farther than any cell is from the outside where that matters.
                *cell = Offset(rows.clamp(-FAR, FAR) as u32);
            }
            next += run.len();
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
    /// Finds the nearest cells for a run, which holds rows to the nearest cell of its column.
    fn along(&mut self, run: &mut [Offset], aspect: f64) {
        // Columns are counted from the cell before the run.
        let last = run.len() + 1;
        if let [cell] = run {
            // One cell, with one outside on both sides.
            let rows = cell.0 as i32;
            let is_nearer = aspect * f64::from(rows * rows) < 1.0;
            *cell = if is_nearer { packed(0, rows) } else { packed(-1, 0) };
            return;
        }
        let stack = &mut self.parabolas;
        stack.clear();
        stack.push(Parabola { column: 0, rows: 0, height: 0.0, first: 1 });
        let top_column = |column: usize| if column == last { 0 } else { run[column - 1].0 as i32 };
        for column in 1..=last {
            let rows = top_column(column);
            let height = aspect * f64::from(rows * rows);
            let at = column as i32;
            let first = loop {
                let Some(top) = stack.last() else { break 1 };
                // Where the new one becomes lower than the top one.
                let span = f64::from(at - top.column);
                let rise = span * f64::from(at + top.column) + (height - top.height);
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
                run[at as usize - 1] = packed(parabola.column - at, parabola.rows);
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
            let height = [u32::MAX, 1, 2, 5][seed as usize % 4];
            let features = Features::new(&mask.bits, aspect, threads, height);
            assert!(
                rows == 0 || features.bands().map(|rows| rows.len() as u32).sum::<u32>() == rows
            );
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
                    assert_eq!(features.squared(x, y), least, "{seed}: ({x}, {y})");
                }
            }
        }
    }
}
