//! The crack code: the outline of a mask as turns from one crack to the next, and back.
//!
//! # Contract
//! [`mask_of_cracks`] of [`crack_chains`] is the mask again, cell for cell. Linear in cells and cracks.
//!
//! # Method
//! A chain starts with the crack above a cell, to the right, and says at the end of each crack where the next
//! one leads: the code of [Fre74] on cracks instead of cells. It ends where the first crack would come again.
//! A row lies inside between each crack that goes down or up and the next one.

use super::outline::Cracks;
use super::{Bits, Grid, Mask, MaskError};

/// Where the outline goes at the end of a crack, with the shape on its left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    /// On as before.
    Straight,
    /// Around a cell of the shape.
    Left,
    /// Around a cell outside.
    Right,
}

/// A closed chain of cracks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CrackChain {
    /// Column and row of the corner where the first crack starts, which goes along the upper side of a cell
    /// to the next column.
    pub start: [u32; 2],
    /// The turn at the end of each crack; the last one leads into the first crack again.
    pub turns: Vec<Turn>,
}

/// Why chains of cracks bound no mask.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CrackError {
    /// The grid cannot have cells.
    #[error(transparent)]
    Mask(#[from] MaskError),
    /// A chain leaves the grid.
    #[error("a chain of cracks leaves the grid at column {}, row {}", at[0], at[1])]
    Outside {
        /// The corner where it does.
        at: [u32; 2],
    },
    /// A chain does not end where it started.
    #[error("the chain of cracks from column {}, row {} does not close", start[0], start[1])]
    Open {
        /// Where it starts.
        start: [u32; 2],
    },
}

/// A place on the way along cracks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CrackWalk {
    /// The corner where the next crack starts.
    pub at: [u32; 2],
    /// Its direction: 0 to the next column, then by quarter turns to the left.
    pub direction: u8,
}

/// Columns and rows of a crack; rows go down, so that left of the next column is the next row.
const STEPS: [[i32; 2]; 4] = [[1, 0], [0, 1], [-1, 0], [0, -1]];

impl CrackWalk {
    /// The way along the first crack of a chain.
    #[must_use]
    pub const fn new(start: [u32; 2]) -> Self {
        Self { at: start, direction: 0 }
    }

    /// Goes along a crack, and turns at its end; `None` if that leaves the grid.
    #[must_use]
    pub fn next(self, turn: Turn, grid: &Grid) -> Option<Self> {
        let [dx, dy] = STEPS[usize::from(self.direction)];
        let x = self.at[0].checked_add_signed(dx).filter(|&x| x <= grid.columns)?;
        let y = self.at[1].checked_add_signed(dy).filter(|&y| y <= grid.rows)?;
        let quarters = match turn {
            Turn::Straight => 0,
            Turn::Left => 1,
            Turn::Right => 3,
        };
        Some(Self { at: [x, y], direction: (self.direction + quarters) % 4 })
    }
}

/// The outline of a mask as chains of cracks, in the order of the rows in which they start.
///
/// ```
/// use medial::raster::{Grid, Mask, Turn, crack_chains, mask_of_cracks};
/// let mask = Mask::new(Grid::of_image(4, 3), |x, y| x > 0 && y == 1)?;
/// let chains = crack_chains(&mask);
/// // Three cells: around their bar it is eight cracks, with a turn at every corner.
/// assert_eq!((chains.len(), chains[0].turns.len()), (1, 8));
/// assert_eq!(chains[0].turns.iter().filter(|&&turn| turn == Turn::Left).count(), 4);
/// assert_eq!(mask_of_cracks(mask.grid(), &chains)?, mask);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn crack_chains(mask: &Mask) -> Vec<CrackChain> {
    let cracks = Cracks::contours_of(&mask.bits);
    let chain = |contour: u32| {
        let edges = cracks.edges_of(contour);
        let way = |k: usize| {
            let [from, to] = [k, k + 1].map(|k| edges[k % edges.len()].from());
            [0, 1].map(|axis| i64::from(to[axis]) - i64::from(from[axis]))
        };
        let mut turns = Vec::new();
        for k in 0..edges.len() {
            let ([dx, dy], [ex, ey]) = (way(k), way(k + 1));
            turns.resize(turns.len() + (dx.abs() + dy.abs() - 1) as usize, Turn::Straight);
            turns.push(if dx * ey - dy * ex > 0 { Turn::Left } else { Turn::Right });
        }
        CrackChain { start: edges[0].from(), turns }
    };
    (0..cracks.contours.len() as u32).map(chain).collect()
}

/// The mask that chains of cracks are around: the cells inside an odd number of them.
///
/// # Errors
/// If a chain leaves the grid or does not close, or the grid is too large or has no cells.
pub fn mask_of_cracks(grid: &Grid, chains: &[CrackChain]) -> Result<Mask, CrackError> {
    let mut mask = Mask::empty(*grid)?;
    // The cracks on the left side of cells, one more column of them than there are cells.
    let mut sides = Bits::new(grid.columns + 1, grid.rows);
    for chain in chains {
        let start = CrackWalk::new(chain.start);
        if chain.start[0] >= grid.columns || chain.start[1] >= grid.rows {
            return Err(CrackError::Outside { at: chain.start });
        }
        let mut walk = start;
        for &turn in &chain.turns {
            let next = walk.next(turn, grid).ok_or(CrackError::Outside { at: walk.at })?;
            if walk.at[0] == next.at[0] {
                let (x, y) = (walk.at[0] as i32, walk.at[1].min(next.at[1]) as i32);
                if sides.get(x, y) { sides.clear(x, y) } else { sides.set(x, y) }
            }
            walk = next;
        }
        if walk != start {
            return Err(CrackError::Open { start: chain.start });
        }
    }
    for y in 0..grid.rows {
        let mut sides = sides.ones(y);
        // Closed chains come down as often as up.
        while let (Some(from), Some(to)) = (sides.next(), sides.next()) {
            mask.fill(y, from, to);
        }
    }
    Ok(mask)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::dice::dice;

    #[test]
    fn chains_of_cracks_are_the_mask_again() {
        for seed in 1..1000 {
            let mut dice = dice(seed);
            let (columns, rows, fill) = (dice() as u32 % 20, dice() as u32 % 20, dice() % 101);
            let grid = Grid::of_image(columns, rows);
            let mask = Mask::new(grid, |_, _| dice() % 100 < fill).unwrap();
            let chains = crack_chains(&mask);
            assert_eq!(mask_of_cracks(&grid, &chains).unwrap(), mask, "{seed}");
            // Each chain meets its first crack once.
            for chain in &chains {
                let mut walk = CrackWalk::new(chain.start);
                let met = chain.turns.iter().map(|&turn| {
                    walk = walk.next(turn, &grid).unwrap();
                    walk
                });
                assert_eq!(met.filter(|w| *w == CrackWalk::new(chain.start)).count(), 1, "{seed}");
            }
        }
    }

    #[test]
    fn chains_that_bound_nothing_are_refused() {
        let grid = Grid::of_image(3, 3);
        let chain = |start, turns: &[Turn]| CrackChain { start, turns: turns.to_vec() };
        let open = chain([0, 0], &[Turn::Left, Turn::Left]);
        assert_eq!(mask_of_cracks(&grid, &[open]), Err(CrackError::Open { start: [0, 0] }));
        let outside = chain([2, 0], &[Turn::Straight, Turn::Straight]);
        assert_eq!(mask_of_cracks(&grid, &[outside]), Err(CrackError::Outside { at: [3, 0] }));
        let beyond = chain([3, 0], &[]);
        assert_eq!(mask_of_cracks(&grid, &[beyond]), Err(CrackError::Outside { at: [3, 0] }));
    }
}
