use super::Bits;

/// The numbers of some cells, counted row by row.
///
/// A number is looked up in one place, and a bit and a half are kept for each cell of the array.
#[derive(Debug, Default)]
pub(super) struct Ranks {
    /// Words of a framed row.
    words_each: usize,
    /// The first row that is known.
    first: i32,
    blocks: Vec<Block>,
    len: u32,
}

/// 64 cells of a row.
#[derive(Clone, Copy, Debug)]
struct Block {
    /// Cells before this block.
    before: u32,
    /// Which cells are in it, first and last 32.
    cells: [u32; 2],
}

impl Ranks {
    /// No cell of arrays like that, with room for so many rows from that one on.
    pub fn new(bits: &Bits, first: i32, rows: usize) -> Self {
        let words_each = bits.n_framed_words();
        Self { words_each, first, blocks: Vec::with_capacity(words_each * rows), len: 0 }
    }

    /// Takes the next 64 cells of a framed row, or the first ones of the next row.
    #[inline(always)]
    pub fn push(&mut self, word: u64) {
        let cells = [word as u32, (word >> 32) as u32];
        self.blocks.push(Block { before: self.len, cells });
        self.len += word.count_ones();
    }

    /// How many cells there are.
    pub fn len(&self) -> usize {
        self.len as usize
    }

    /// How many cells there are in rows before that one.
    pub fn before_row(&self, y: i32) -> usize {
        let block = self.blocks.get((y - self.first) as usize * self.words_each);
        block.map_or(self.len, |block| block.before) as usize
    }

    /// How many cells there are before one, and whether it is one of them.
    #[inline(always)]
    pub fn rank(&self, x: i32, y: i32) -> (usize, bool) {
        let column = (x + Bits::LEAD) as u32;
        let block =
            &self.blocks[(y - self.first) as usize * self.words_each + (column / 64) as usize];
        let [first, last] = block.cells;
        let cells = u64::from(first) | u64::from(last) << 32;
        let before = cells & ((1 << (column % 64)) - 1);
        ((block.before + before.count_ones()) as usize, cells >> (column % 64) & 1 != 0)
    }
}
