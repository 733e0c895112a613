//! Disks and squares of cells.

use super::CellError;
use crate::raster::{Grid, Mask};
use std::collections::HashMap;

/// Most cells of an array that is compressed: what is read again may fill so many bits of memory, however
/// short the file is.
pub(super) const MOST_CELLS: u64 = 1 << 30;

/// Most work for drawing disks, in rows of 256 cells: half a minute or so.
const MOST_ROWS: u64 = 1 << 32;

/// What lies around a cell: all cells nearer to it than a distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Ball {
    /// Row of the centre.
    pub y: u32,
    /// Column of the centre.
    pub x: u32,
    /// Of a disk the square of the distance, in cells, of a square the number of rows or columns: that of the
    /// nearest cell that does not belong to it. At least 1.
    pub size: u32,
}

/// The shape of a ball.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BallShape {
    /// Distances are those between centres.
    Disk,
    /// Distances are rows or columns, whichever are more.
    Square,
}

impl Ball {
    /// Whether it lies within the array.
    #[must_use]
    pub fn fits(&self, shape: BallShape, grid: &Grid) -> bool {
        if self.x >= grid.columns || self.y >= grid.rows || self.size == 0 {
            return false;
        }
        let sides = [self.x + 1, grid.columns - self.x, self.y + 1, grid.rows - self.y];
        let nearest = sides.map(u64::from).into_iter().min().unwrap_or(0);
        match shape {
            BallShape::Disk => u64::from(self.size) <= nearest * nearest,
            BallShape::Square => u64::from(self.size) <= nearest,
        }
    }
}

/// How many columns a ball goes to either side of its centre, for each row from that of the centre.
pub(super) fn half_widths(shape: BallShape, size: u32) -> Vec<u32> {
    match shape {
        BallShape::Square => vec![size - 1; size as usize],
        BallShape::Disk => {
            // The greatest number whose square is below what is left.
            let mut half = f64::from(size).sqrt().ceil() as u64;
            let rows = (0_u64..).take_while(|row| row * row < u64::from(size));
            let half_width = |row: u64| {
                while half * half + row * row >= u64::from(size) {
                    half -= 1;
                }
                half as u32
            };
            rows.map(half_width).collect()
        }
    }
}

/// Shows the cells of a ball that lies within the array, given its half widths: row by row, from a column up
/// to, but not with, another one.
#[inline]
pub(super) fn spans(ball: &Ball, half_widths: &[u32], mut show: impl FnMut(u32, u32, u32)) {
    let last = half_widths.len() as u32 - 1;
    for row in ball.y - last..=ball.y + last {
        let half = half_widths[row.abs_diff(ball.y) as usize];
        show(row, ball.x - half, ball.x + half + 1);
    }
}

/// The half widths of sizes, each computed once.
pub(super) struct Widths {
    shape: BallShape,
    of_size: HashMap<u32, Box<[u32]>>,
}

impl Widths {
    pub fn new(shape: BallShape) -> Self {
        Self { shape, of_size: HashMap::new() }
    }

    pub fn of(&mut self, size: u32) -> &[u32] {
        let shape = self.shape;
        self.of_size.entry(size).or_insert_with(|| half_widths(shape, size).into())
    }
}

/// The cells that balls cover.
///
/// # Errors
/// If one does not fit into the array, or they are too many.
pub(super) fn union(grid: &Grid, shape: BallShape, balls: &[Ball]) -> Result<Mask, CellError> {
    let wrong = |ball: &Ball| CellError::Outside { at: [ball.x, ball.y] };
    if let Some(ball) = balls.iter().find(|ball| !ball.fits(shape, grid)) {
        return Err(wrong(ball));
    }
    let radius = |ball: &Ball| match shape {
        BallShape::Disk => u64::from(ball.size.isqrt()) + 1,
        BallShape::Square => ball.size.into(),
    };
    let work: u64 = balls.iter().map(|ball| radius(ball) * (2 + radius(ball) / 128)).sum();
    if work > MOST_ROWS {
        return Err(CellError::TooManyDisks);
    }
    let mut mask = Mask::empty(*grid)?;
    let mut widths = Widths::new(shape);
    for ball in balls {
        spans(ball, widths.of(ball.size), |row, from, to| mask.fill(row, from, to));
    }
    Ok(mask)
}
