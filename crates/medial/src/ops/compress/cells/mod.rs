//! Masks in few numbers: chains of medial cells, few disks or squares, or the outline crack by crack.
//!
//! # Contract
//! What is rebuilt lies within the mask. [`CompressedMask::missing`] tells how many cells it lacks, and
//! [`CompressedMask::error`] how far both are apart: no cell of one is farther from the other than that, nor
//! any cell outside of the one from the outside of the other. Without a threshold ([`MaskOptions::residual`])
//! and with a coverage of 1 both are the same, cell for cell.
//!
//! # Method
//! 1. *Chain*: the medial cells of [`Skeleton`] with the squares of their distances, less what at free ends
//!    adds nothing to the union of the disks (`chain.rs`); within a given error, the highest threshold that
//!    keeps it, by bisection, as the error is measured.
//! 2. *Cover*: of all medial cells those whose disks gain most, one after the other (`cover.rs`) \[CHM08\].
//! 3. *Squares*: the same with maximal squares around cells \[ADMR78\], as \[VS87, II.A.3\] tells of them.
//! 4. *Crack*: the outline, [`crack_chains`]; always the mask itself.
//!
//! # Departures
//! Distances are counted in cells as if these were squares, also where they are higher than wide: the code
//! rebuilds the mask either way, and the axis that is read measures in the plane again. Errors are told in
//! units of the plane.

mod balls;
mod chain;
mod cover;
mod difference;

pub use balls::{Ball, BallShape};

use super::{CompressError, RebuildError};
use crate::axis::{MedialAxis, names};
use crate::engine::{self, Skeleton};
use crate::raster::{CrackChain, CrackError, Grid, Mask, MaskError, crack_chains, mask_of_cracks};
use balls::{MOST_CELLS, union};
use difference::Difference;

/// What stands for a mask.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MaskMethod {
    /// Chains of medial cells.
    Chain,
    /// Few disks that cover it.
    Cover,
    /// Few squares that cover it.
    Squares,
    /// Its outline.
    Crack,
}

names!(MaskMethod, "method", Chain => "chain", Cover => "cover", Squares => "squares", Crack => "crack");

/// How a mask is compressed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MaskOptions {
    /// By what.
    pub method: MaskMethod,
    /// For chains: the chord residual, in cells, above which cells are medial; without one, as many are as it
    /// takes for their disks to be the mask again.
    pub residual: Option<f64>,
    /// For chains with a threshold: into how many steps a cell is cut by radii, which are rounded down; 0
    /// keeps them as they are.
    pub radius_steps: u32,
    /// For covers and squares: the share of the mask that is to be covered, up to 1.
    pub coverage: f64,
    /// How far what is rebuilt and the mask may be apart, in units of the plane; then threshold, steps and
    /// coverage follow from it.
    pub max_error: Option<f64>,
}

impl Default for MaskOptions {
    fn default() -> Self {
        Self {
            method: MaskMethod::Chain,
            residual: engine::Options::default().residual,
            radius_steps: 4,
            coverage: 1.0,
            max_error: None,
        }
    }
}

/// What stands for the cells of a mask.
#[derive(Clone, Debug, PartialEq)]
pub enum CellCode {
    /// Medial cells, row by row, with the disks around them. Neighbours by sides and corners hang together.
    Chain(Vec<Ball>),
    /// Disks, row by row.
    Cover(Vec<Ball>),
    /// Squares, row by row.
    Squares(Vec<Ball>),
    /// The outline.
    Crack(Vec<CrackChain>),
}

/// A mask in few numbers.
#[derive(Clone, Debug, PartialEq)]
pub struct CompressedMask {
    /// Where the cells lie.
    pub grid: Grid,
    /// What stands for them.
    pub code: CellCode,
    /// How far what is rebuilt and the mask are apart at most, in units of the plane: the Hausdorff distance
    /// of both, or of what lies outside of them if that is larger. Infinite if nothing is left of the mask.
    pub error: f64,
    /// How many cells of the mask are not rebuilt. None is rebuilt that does not belong to it.
    pub missing: u64,
}

/// Why cells are no mask, or a mask cannot be compressed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CellError {
    /// The array is larger than what is read again.
    #[error("{columns} by {rows} cells are too many to be compressed; cut the mask into tiles")]
    TooLarge {
        /// Number of columns.
        columns: u32,
        /// Number of rows.
        rows: u32,
    },
    /// A disk or a square goes beyond the array.
    #[error("a disk at column {}, row {} lies outside of the cells", at[0], at[1])]
    Outside {
        /// Its centre.
        at: [u32; 2],
    },
    /// There are so many large disks that it would take too long to draw them.
    #[error("there are too many large disks; cut the mask into tiles")]
    TooManyDisks,
    /// The grid cannot have cells.
    #[error(transparent)]
    Mask(#[from] MaskError),
    /// The outline bounds nothing.
    #[error(transparent)]
    Crack(#[from] CrackError),
    /// The engine gave up.
    #[error(transparent)]
    Engine(#[from] engine::EngineError),
}

impl CompressedMask {
    /// By what it was compressed.
    #[must_use]
    pub fn method(&self) -> MaskMethod {
        match self.code {
            CellCode::Chain(_) => MaskMethod::Chain,
            CellCode::Cover(_) => MaskMethod::Cover,
            CellCode::Squares(_) => MaskMethod::Squares,
            CellCode::Crack(_) => MaskMethod::Crack,
        }
    }

    /// The disks or squares; none for an outline.
    #[must_use]
    pub fn balls(&self) -> &[Ball] {
        match &self.code {
            CellCode::Chain(balls) | CellCode::Cover(balls) | CellCode::Squares(balls) => balls,
            CellCode::Crack(_) => &[],
        }
    }

    /// The cells again.
    ///
    /// # Errors
    /// If a disk or the outline leaves the grid, or they are too many; what [`compress_mask`] gives has none of
    /// these faults.
    pub fn mask(&self) -> Result<Mask, CellError> {
        let Grid { columns, rows, .. } = self.grid;
        if self.grid.n_cells() > MOST_CELLS {
            return Err(CellError::TooLarge { columns, rows });
        }
        let shape = match &self.code {
            CellCode::Chain(_) | CellCode::Cover(_) => BallShape::Disk,
            CellCode::Squares(_) => BallShape::Square,
            CellCode::Crack(chains) => return Ok(mask_of_cracks(&self.grid, chains)?),
        };
        union(&self.grid, shape, self.balls())
    }

    /// The sampled axis of the cells again: at the cells of a chain, else as
    /// [`raster_transform`](engine::raster_transform) finds it.
    ///
    /// # Errors
    /// If the cells are none, or too many for an axis.
    pub fn axis(&self) -> Result<MedialAxis, RebuildError> {
        let mask = self.mask()?;
        let options = engine::Options::default();
        let skeleton = match &self.code {
            CellCode::Chain(balls) => Skeleton::of_cells(&mask, balls.iter().map(|b| [b.x, b.y])),
            _ => Skeleton::new(&mask, &options)?,
        };
        Ok(skeleton.axis()?)
    }
}

/// Halvings of the interval of thresholds in which the best one is looked for.
///
/// Size only: the error is measured for whatever is kept.
const HALVINGS: u32 = 6;

/// The thresholds between which it is looked for: the least one in cells, the highest one in errors that are
/// allowed.
///
/// Size only. A branch that the error allows to take has no longer residual in practice.
const LEAST: f64 = 0.25;
const HIGHEST: f64 = 8.0;

/// Steps of a cell that radii are rounded down to, the coarsest first, and none.
const STEPS: [u32; 4] = [1, 2, 4, 0];

/// The mask in few numbers.
///
/// ```
/// use medial::ops::{MaskOptions, compress_mask};
/// use medial::raster::{Grid, Mask};
/// let mask = Mask::new(Grid::of_image(40, 20), |x, y| (x / 5 + y / 7) % 3 > 0)?;
/// let exact = compress_mask(&mask, &MaskOptions { residual: None, ..MaskOptions::default() })?;
/// assert_eq!((exact.error, exact.missing), (0.0, 0));
/// assert_eq!(exact.mask()?, mask);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If the mask is too large.
pub fn compress_mask(mask: &Mask, options: &MaskOptions) -> Result<CompressedMask, CompressError> {
    let Grid { columns, rows, .. } = *mask.grid();
    if mask.grid().n_cells() > MOST_CELLS {
        return Err(CellError::TooLarge { columns, rows }.into());
    }
    let with = |code, difference: Difference| {
        let Difference { error, missing } = difference;
        CompressedMask { grid: *mask.grid(), code, error, missing }
    };
    Ok(match options.method {
        MaskMethod::Crack => {
            with(CellCode::Crack(crack_chains(mask)), Difference { error: 0.0, missing: 0 })
        }
        MaskMethod::Chain => {
            let (balls, difference) = match options.max_error {
                None => chain::of(mask, options.residual, options.radius_steps)?,
                Some(error) => chain_within(mask, error)?,
            };
            with(CellCode::Chain(balls), difference)
        }
        MaskMethod::Cover | MaskMethod::Squares => {
            let is_cover = options.method == MaskMethod::Cover;
            let shape = if is_cover { BallShape::Disk } else { BallShape::Square };
            let (balls, difference) = match options.max_error {
                None => cover::of(mask, shape, options.coverage)?,
                Some(error) => cover::within(mask, shape, error)?,
            };
            let code = if is_cover { CellCode::Cover(balls) } else { CellCode::Squares(balls) };
            with(code, difference)
        }
    })
}

/// The chain with the coarsest radii, and the highest threshold for them, that is within an error.
fn chain_within(mask: &Mask, max_error: f64) -> Result<(Vec<Ball>, Difference), CellError> {
    let cells = max_error / mask.grid().cell_size();
    for radius_steps in STEPS {
        let of = |residual| chain::of(mask, Some(residual), radius_steps);
        let mut best = of(LEAST)?;
        if best.1.error > max_error {
            continue;
        }
        let (mut low, mut high) = (LEAST, LEAST.max(HIGHEST * cells));
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            let found = of(middle)?;
            if found.1.error <= max_error {
                (low, best) = (middle, found);
            } else {
                high = middle;
            }
        }
        return Ok(best);
    }
    chain::of(mask, None, 0)
}

#[cfg(test)]
mod tests;
