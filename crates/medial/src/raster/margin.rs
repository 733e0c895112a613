use super::Bits;

/// The cells just outside of a shape, numbered row by row: those that have one of its cells at a side.
///
/// A number is looked up in one place, and a bit and a half are kept for each cell of the array.
#[derive(Debug)]
pub(crate) struct Margin {
    /// Blocks of a row of cells, which starts eight columns before the first one, in the row before the first.
    blocks_each: usize,
    blocks: Vec<Block>,
    len: usize,
}

/// 64 cells of a row.
#[derive(Clone, Copy, Debug)]
struct Block {
    /// Cells of the margin before this block.
    before: u32,
    /// Which cells are in it, first and last 32.
    cells: [u32; 2],
}

/// Columns before the first one.
const LEAD: i32 = 8;

impl Margin {
    pub fn new(bits: &Bits) -> Self {
        let rows = bits.rows() as i32;
        let blocks_each = bits.framed_row(-1).len().div_ceil(8);
        let mut blocks = Vec::with_capacity(blocks_each * (rows as usize + 2));
        let mut before = 0_u32;
        for y in -1..=rows {
            let own = bits.framed_row(y);
            let nothing = &own[..0];
            let above = if y >= 0 { bits.framed_row(y - 1) } else { nothing };
            let below = if y < rows { bits.framed_row(y + 1) } else { nothing };
            for block in 0..blocks_each {
                let (cells, left) = (word(own, block), word(own, block.wrapping_sub(1)));
                let right = word(own, block + 1);
                let sides = [
                    cells << 1 | left >> 63,
                    cells >> 1 | right << 63,
                    word(above, block),
                    word(below, block),
                ];
                let margin = sides.iter().fold(0, |all, side| all | side) & !cells;
                blocks.push(Block { before, cells: [margin as u32, (margin >> 32) as u32] });
                before += margin.count_ones();
            }
        }
        Self { blocks_each, blocks, len: before as usize }
    }

    /// How many cells there are.
    pub fn len(&self) -> usize {
        self.len
    }

    /// The number of a cell of the margin.
    #[inline(always)]
    pub fn number(&self, x: i32, y: i32) -> usize {
        let column = (x + LEAD) as u32;
        let block = &self.blocks[(y + 1) as usize * self.blocks_each + (column / 64) as usize];
        let [first, last] = block.cells;
        let cells = u64::from(first) | u64::from(last) << 32;
        let before = cells & ((1 << (column % 64)) - 1);
        (block.before + before.count_ones()) as usize
    }
}

/// The bits of 64 cells; zeros beyond the row.
fn word(row: &[u8], block: usize) -> u64 {
    let from = block.saturating_mul(8).min(row.len());
    let to = (from + 8).min(row.len());
    let mut bytes = [0; 8];
    bytes[..to - from].copy_from_slice(&row[from..to]);
    u64::from_le_bytes(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::dice::dice;
    use crate::raster::{Grid, Mask};

    #[test]
    fn cells_beside_the_shape_are_numbered_row_by_row() {
        for seed in 0..200 {
            let mut dice = dice(seed + 1);
            let (columns, rows) = (dice() as u32 % 150, dice() as u32 % 6);
            let fill = dice() % 101;
            let grid = Grid::of_image(columns, rows);
            let mask = Mask::new(grid, |_, _| dice() % 100 < fill).unwrap();
            let margin = Margin::new(&mask.bits);
            let inside = |x: i32, y: i32| x >= 0 && y >= 0 && mask.get(x as u32, y as u32);
            let mut number = 0;
            for y in -1..=rows as i32 {
                for x in -1..=columns as i32 {
                    let sides = [(x - 1, y), (x + 1, y), (x, y - 1), (x, y + 1)];
                    if !inside(x, y) && sides.into_iter().any(|(x, y)| inside(x, y)) {
                        assert_eq!(margin.number(x, y), number, "{seed}: ({x}, {y})");
                        number += 1;
                    }
                }
            }
            assert_eq!(margin.len(), number, "{seed}");
        }
    }
}
