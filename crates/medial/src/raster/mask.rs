use super::{Bits, Grid};

/// Why cells are no mask.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MaskError {
    /// There are more columns or rows than distances are kept for.
    #[error(
        "{columns} by {rows} cells are too many; at most {} a side, cut it into tiles",
        Mask::MOST
    )]
    TooLarge {
        /// Number of columns.
        columns: u32,
        /// Number of rows.
        rows: u32,
    },
    /// The sides of the cells are not numbers other than 0, or the grid is not within the numbers.
    #[error("cells {} by {} from ({}, {}) make no grid; give numbers other than 0", cell[0], cell[1], origin[0], origin[1])]
    Cell {
        /// Width and height.
        cell: [f64; 2],
        /// Where the grid starts.
        origin: [f64; 2],
    },
}

/// A spatial occupancy array: which cells of a grid belong to a shape.
///
/// ```
/// use medial::raster::{Grid, Mask, topology};
/// let ring = ["####", "#..#", "####"].map(str::as_bytes);
/// let mask = Mask::new(Grid::of_image(4, 3), |x, y| ring[y as usize][x as usize] == b'#')?;
/// assert_eq!((mask.count(), topology(&mask).holes), (10, 1));
/// # Ok::<(), medial::raster::MaskError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Mask {
    grid: Grid,
    pub(crate) bits: Bits,
}

impl Mask {
    /// Most columns, and most rows.
    pub const MOST: u32 = 65_534;

    /// The mask of the cells, by column and row, for which something is true.
    ///
    /// # Errors
    /// If the grid is too large or its cells have no size.
    pub fn new(grid: Grid, mut is_inside: impl FnMut(u32, u32) -> bool) -> Result<Self, MaskError> {
        let mut mask = Self::empty(grid)?;
        for y in 0..grid.rows {
            for x in (0..grid.columns).filter(|&x| is_inside(x, y)) {
                mask.bits.set(x as i32, y as i32);
            }
        }
        Ok(mask)
    }

    /// The mask with no cell in it.
    ///
    /// # Errors
    /// If the grid is too large or its cells have no size.
    pub fn empty(grid: Grid) -> Result<Self, MaskError> {
        let Grid { columns, rows, origin, cell } = grid;
        if columns > Self::MOST || rows > Self::MOST {
            return Err(MaskError::TooLarge { columns, rows });
        }
        let far = grid.corner(columns, rows);
        let numbers = [origin.x, origin.y, far.x, far.y, cell[0].recip(), cell[1].recip()];
        if numbers.iter().any(|number| !number.is_finite()) {
            return Err(MaskError::Cell { cell, origin: [origin.x, origin.y] });
        }
        Ok(Self { grid, bits: Bits::new(columns, rows) })
    }

    /// Where the cells lie.
    #[must_use]
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Whether a cell belongs to the shape; never outside of the grid.
    #[must_use]
    pub fn get(&self, column: u32, row: u32) -> bool {
        column < self.grid.columns
            && row < self.grid.rows
            && self.bits.get(column as i32, row as i32)
    }

    /// Takes a cell into the shape, or out of it.
    ///
    /// # Panics
    /// If the grid has no such cell.
    pub fn put(&mut self, column: u32, row: u32, inside: bool) {
        assert!(column < self.grid.columns && row < self.grid.rows, "a cell of the grid");
        match inside {
            true => self.bits.set(column as i32, row as i32),
            false => self.bits.clear(column as i32, row as i32),
        }
    }

    /// Takes the cells of a row into the shape, from one column up to, but not with, another one.
    ///
    /// # Panics
    /// If the grid does not have them.
    pub fn fill(&mut self, row: u32, from: u32, to: u32) {
        assert!(row < self.grid.rows && to <= self.grid.columns, "cells of the grid");
        self.bits.set_run(row, from, to);
    }

    /// Takes over a row: one bit a cell, the first in the lowest bit of the first byte.
    ///
    /// # Panics
    /// If the grid has no such row, or the bytes are too few.
    pub fn put_row(&mut self, row: u32, bytes: &[u8]) {
        assert!(row < self.grid.rows, "a row of the grid");
        self.bits.put_row(row, bytes);
    }

    /// A row: one bit a cell, the first in the lowest bit of the first byte.
    ///
    /// # Panics
    /// If the grid has no such row.
    #[must_use]
    pub fn row(&self, row: u32) -> &[u8] {
        assert!(row < self.grid.rows, "a row of the grid");
        self.bits.row_bytes(row)
    }

    /// The columns of the cells in a row that belong to the shape.
    pub fn cells(&self, row: u32) -> impl Iterator<Item = u32> + '_ {
        self.bits.ones(row)
    }

    /// The number of cells that belong to the shape.
    #[must_use]
    pub fn count(&self) -> u64 {
        self.bits.count()
    }

    /// A mask of the same grid.
    pub(crate) fn with_bits(&self, bits: Bits) -> Self {
        Self { grid: self.grid, bits }
    }
}
