//! Bits in rows, with a frame of zeros around them.

/// One bit for each cell of an array.
///
/// Rows start with a byte of zeros and end with at least one, and a row of zeros comes before the first and
/// after the last, so the neighbours of any cell can be asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Bits {
    columns: u32,
    rows: u32,
    /// Bytes from one row to the next.
    stride: usize,
    data: Vec<u8>,
}

/// Bytes behind the last row, so that words can be read from anywhere.
const SLACK: usize = 8;

impl Bits {
    pub fn new(columns: u32, rows: u32) -> Self {
        let stride = (columns as usize).div_ceil(8) + 2;
        let data = vec![0; stride * (rows as usize + 2) + SLACK];
        Self { columns, rows, stride, data }
    }

    pub fn columns(&self) -> u32 {
        self.columns
    }

    pub fn rows(&self) -> u32 {
        self.rows
    }

    #[inline(always)]
    fn byte(&self, x: i32, y: i32) -> usize {
        debug_assert!(
            (-8..=self.columns as i32).contains(&x) && (-1..=self.rows as i32).contains(&y)
        );
        (y + 1) as usize * self.stride + ((x + 8) >> 3) as usize
    }

    /// The bit of a cell, which may lie just outside of the array.
    #[inline(always)]
    pub fn get(&self, x: i32, y: i32) -> bool {
        self.data[self.byte(x, y)] >> (x & 7) & 1 != 0
    }

    #[inline(always)]
    pub fn set(&mut self, x: i32, y: i32) {
        let byte = self.byte(x, y);
        self.data[byte] |= 1 << (x & 7);
    }

    /// Sets a bit on a condition, without a branch.
    #[inline(always)]
    pub fn set_if(&mut self, x: i32, y: i32, is_set: bool) {
        let byte = self.byte(x, y);
        self.data[byte] |= u8::from(is_set) << (x & 7);
    }

    #[inline(always)]
    pub fn clear(&mut self, x: i32, y: i32) {
        let byte = self.byte(x, y);
        self.data[byte] &= !(1 << (x & 7));
    }

    /// Sets all cells of a row from one column up to, but not with, another one.
    pub fn set_run(&mut self, y: u32, from: u32, to: u32) {
        self.fill_run(y, from, to, 0xff, Self::set);
    }

    /// Clears all cells of a row from one column up to, but not with, another one.
    pub fn clear_run(&mut self, y: u32, from: u32, to: u32) {
        self.fill_run(y, from, to, 0, Self::clear);
    }

    /// Puts whole bytes of a run at once, and what is left of it cell by cell.
    #[inline(always)]
    fn fill_run(&mut self, y: u32, from: u32, to: u32, byte: u8, put: fn(&mut Self, i32, i32)) {
        let (mut x, to) = (from as i32, to as i32);
        while x < to && x & 7 != 0 {
            put(self, x, y as i32);
            x += 1;
        }
        let whole = ((to - x) / 8).max(0);
        let first = self.byte(x, y as i32);
        self.data[first..first + whole as usize].fill(byte);
        (x + 8 * whole..to).for_each(|x| put(self, x, y as i32));
    }

    /// A cell and its eight neighbours, three bits a row from the one above, each from the left.
    #[inline(always)]
    pub fn window(&self, x: i32, y: i32) -> u16 {
        let shift = (x + 7) & 7;
        let first = self.byte(x, y) - self.stride - usize::from(x & 7 == 0);
        let three = |at: usize| {
            let pair = [self.data[at], self.data[at + 1]];
            u16::from_le_bytes(pair) >> shift & 7
        };
        three(first) | three(first + self.stride) << 3 | three(first + 2 * self.stride) << 6
    }

    /// The four cells around a corner, so many columns and rows from the origin: two bits a row from the upper
    /// one, each from the left.
    #[inline(always)]
    pub fn block(&self, x: i32, y: i32) -> usize {
        let shift = (x + 7) & 7;
        let at = self.byte(x - 1, y - 1);
        let two = |at: usize| u16::from_le_bytes([self.data[at], self.data[at + 1]]) >> shift & 3;
        usize::from(two(at) | two(at + self.stride) << 2)
    }

    /// How many corners the outline of the ones has; two where two cells touch at a corner only.
    pub fn n_corners(&self) -> usize {
        // Rows are apart by zeros, so they are one long row.
        let word =
            |at: usize| u64::from_le_bytes(self.data[at..at + 8].try_into().unwrap_or_default());
        let pair = |at: usize| [word(at), word(at) >> 1 | u64::from(self.data[at + 8]) << 63];
        let corners = |at: usize| {
            let ([a, b], [c, d]) = (pair(at), pair(at + self.stride));
            let twice = (a ^ b) & (a ^ c) & !(a ^ d);
            (a ^ b ^ c ^ d).count_ones() + 2 * twice.count_ones()
        };
        let end = self.stride * (self.rows as usize + 1);
        (0..end).step_by(8).map(|at| corners(at) as usize).sum()
    }

    /// Up to 64 bits of a row, or of the one behind the last, from a column that is a multiple of 8.
    #[inline(always)]
    pub fn word(&self, x: u32, y: u32) -> u64 {
        let at = self.byte(x as i32, y as i32);
        let word = u64::from_le_bytes(self.data[at..at + 8].try_into().unwrap_or_default());
        let left = self.columns - x;
        if left < 64 { word & ((1 << left) - 1) } else { word }
    }

    /// Sets those of 64 bits of a row, from a column that is a multiple of 8, that are set in a word.
    #[inline(always)]
    pub fn set_word(&mut self, x: u32, y: u32, word: u64) {
        debug_assert!(self.columns - x >= 64 || word >> (self.columns - x) == 0);
        let at = self.byte(x as i32, y as i32);
        for (byte, set) in self.data[at..at + 8].iter_mut().zip(word.to_le_bytes()) {
            *byte |= set;
        }
    }

    /// Clears all bits.
    pub fn clear_all(&mut self) {
        self.data.fill(0);
    }

    /// Of 64 cells of a row from a column that is a multiple of 8, those that are set with their eight
    /// neighbours.
    #[inline(always)]
    pub fn surrounded(&self, x: u32, y: u32) -> u64 {
        // What is set in all three rows, with a bit more at both ends.
        let at = self.byte(x as i32, y as i32);
        let [above, below] = [at - self.stride, at + self.stride];
        let word =
            |at: usize| u64::from_le_bytes(self.data[at..at + 8].try_into().unwrap_or_default());
        let set = word(above) & word(at) & word(below);
        let all =
            |places: [usize; 3]| places.iter().fold(0xff, |all, &place| all & self.data[place]);
        let before = u64::from(all([above - 1, at - 1, below - 1]) >> 7);
        let behind = u64::from(all([above + 8, at + 8, below + 8]) & 1);
        set & (set << 1 | before) & (set >> 1 | behind << 63)
    }

    /// A row, 64 bits at a time, each with the column where it starts; nothing stands behind the last one.
    #[inline(always)]
    pub fn words(&self, y: u32) -> impl Iterator<Item = (u32, u64)> + '_ {
        (0..self.columns).step_by(64).map(move |x| (x, self.word(x, y)))
    }

    /// The runs of ones in a row: their first column, and the one behind their last.
    pub fn runs(&self, y: u32) -> Runs<'_> {
        Runs { bits: self, y, next: 0, word: 0, base: 0 }
    }

    /// The columns of the ones in a row.
    pub fn ones(&self, y: u32) -> impl Iterator<Item = u32> + '_ {
        self.words(y).flat_map(|(x, word)| ones(x, word))
    }

    /// The number of ones.
    pub fn count(&self) -> u64 {
        self.data.iter().map(|byte| u64::from(byte.count_ones())).sum()
    }

    /// The bytes of a row, the first cell in the lowest bit; nothing stands behind the last one.
    pub fn row_bytes(&self, y: u32) -> &[u8] {
        let at = self.byte(0, y as i32);
        &self.data[at..at + (self.columns as usize).div_ceil(8)]
    }

    /// Columns before the first one in framed rows, which have at least one behind the last, too.
    pub const LEAD: i32 = 8;

    /// How many words of 64 bits a framed row has.
    pub fn n_framed_words(&self) -> usize {
        self.stride.div_ceil(8)
    }

    /// 64 bits of a framed row, also of those just outside; zeros beyond it.
    #[inline(always)]
    pub fn framed_word(&self, y: i32, number: usize) -> u64 {
        let at = self.byte(-Self::LEAD, y) + 8 * number;
        let word = u64::from_le_bytes(self.data[at..at + 8].try_into().unwrap_or_default());
        let n_bytes = self.stride - 8 * number;
        if n_bytes < 8 { word & ((1 << (8 * n_bytes)) - 1) } else { word }
    }

    /// Sets those of 64 bits of a framed row that are set in a word.
    #[inline(always)]
    pub fn set_framed_word(&mut self, y: i32, number: usize, word: u64) {
        let at = self.byte(-Self::LEAD, y) + 8 * number;
        for (byte, set) in self.data[at..at + 8].iter_mut().zip(word.to_le_bytes()) {
            *byte |= set;
        }
    }

    /// Takes over a row, the first cell in the lowest bit.
    pub fn put_row(&mut self, y: u32, bytes: &[u8]) {
        let (at, n) = (self.byte(0, y as i32), (self.columns as usize).div_ceil(8));
        self.data[at..at + n].copy_from_slice(&bytes[..n]);
        if !self.columns.is_multiple_of(8) {
            self.data[at + n - 1] &= (1 << (self.columns % 8)) - 1;
        }
    }
}

/// The columns of the ones in a word that starts at a column.
#[inline(always)]
pub(crate) fn ones(column: u32, mut word: u64) -> impl Iterator<Item = u32> {
    std::iter::from_fn(move || {
        let place = word.trailing_zeros();
        word &= word.wrapping_sub(1);
        (place < 64).then_some(column + place)
    })
}

/// The runs of ones in a row.
pub(crate) struct Runs<'b> {
    bits: &'b Bits,
    y: u32,
    /// Where the next word starts.
    next: u32,
    /// What is left of the last word, and where that starts.
    word: u64,
    base: u32,
}

impl Runs<'_> {
    /// Goes on to the next word; whether there is one.
    #[inline(always)]
    fn advance(&mut self) -> bool {
        if self.next >= self.bits.columns {
            return false;
        }
        (self.base, self.word) = (self.next, self.bits.word(self.next, self.y));
        self.next += 64;
        true
    }
}

impl Iterator for Runs<'_> {
    type Item = (u32, u32);

    #[inline]
    fn next(&mut self) -> Option<(u32, u32)> {
        while self.word == 0 {
            if !self.advance() {
                return None;
            }
        }
        let first = self.word.trailing_zeros();
        let start = self.base + first;
        // Zeros where the run goes on.
        let mut rest = !(self.word | ((1_u64 << first) - 1));
        while rest == 0 {
            if !self.advance() {
                self.word = 0;
                return Some((start, self.bits.columns));
            }
            rest = !self.word;
        }
        let end = rest.trailing_zeros();
        self.word &= !((1_u64 << end) - 1);
        Some((start, (self.base + end).min(self.bits.columns)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::dice::dice;
    use crate::raster::{Grid, Mask};

    fn drawn(rows: &[&str]) -> Bits {
        let mut bits = Bits::new(rows[0].len() as u32, rows.len() as u32);
        for (y, row) in rows.iter().enumerate() {
            for (x, _) in row.bytes().enumerate().filter(|&(_, b)| b == b'#') {
                bits.set(x as i32, y as i32);
            }
        }
        bits
    }

    #[test]
    fn runs_go_over_words() {
        for n in [1, 7, 8, 63, 64, 65, 127, 128, 129, 200] {
            let mut bits = Bits::new(n, 1);
            bits.set_run(0, 0, n);
            assert_eq!(bits.runs(0).collect::<Vec<_>>(), [(0, n)]);
            assert_eq!(bits.count(), u64::from(n));
            for hole in 0..n {
                let mut bits = bits.clone();
                bits.clear(hole as i32, 0);
                let expected: Vec<(u32, u32)> =
                    [(0, hole), (hole + 1, n)].into_iter().filter(|(a, b)| a < b).collect();
                assert_eq!(bits.runs(0).collect::<Vec<_>>(), expected, "{n} {hole}");
                let ones: Vec<u32> = (0..n).filter(|&x| x != hole).collect();
                assert_eq!(bits.ones(0).collect::<Vec<_>>(), ones);
            }
        }
    }

    #[test]
    fn a_window_is_the_cell_and_its_neighbours() {
        let bits = drawn(&["#..#..#..#.#", ".##..#.#.##.", "#...###...#."]);
        for y in 0..3 {
            for x in 0..12 {
                let mut expected = 0;
                for (k, (dy, dx)) in (0..9).map(|k| (k, (k / 3 - 1, k % 3 - 1))) {
                    expected |= u16::from(bits.get(x + dx, y + dy)) << k;
                }
                assert_eq!(bits.window(x, y), expected, "{x} {y}");
            }
        }
    }

    #[test]
    fn words_know_the_neighbours_of_their_cells() {
        for seed in 1..300 {
            let mut dice = dice(seed);
            let (columns, rows, fill) = (dice() as u32 % 150, dice() as u32 % 6, dice() % 101);
            let grid = Grid::of_image(columns, rows);
            let bits = Mask::new(grid, |_, _| dice() % 100 < fill).unwrap().bits;
            let mut n_corners = 0;
            let mut copy = Bits::new(columns, rows);
            for y in -1..=rows as i32 {
                for x in -1..=columns as i32 {
                    if x < columns as i32 && y < rows as i32 {
                        let [a, b] = [0, 1].map(|dx| bits.get(x + dx, y));
                        let [c, d] = [0, 1].map(|dx| bits.get(x + dx, y + 1));
                        let block = [a, b, c, d]
                            .iter()
                            .rev()
                            .fold(0, |all, &is| all << 1 | usize::from(is));
                        assert_eq!(bits.block(x + 1, y + 1), block, "{seed}");
                        n_corners += match [a, b, c, d].iter().filter(|is| **is).count() {
                            1 | 3 => 1,
                            2 if a == d => 2,
                            _ => 0,
                        };
                    }
                    let place = (x + Bits::LEAD) as usize;
                    let framed = bits.framed_word(y, place / 64) >> (place % 64) & 1 != 0;
                    assert_eq!(framed, bits.get(x, y), "{seed}: {x} {y}");
                }
            }
            assert_eq!(bits.n_corners(), n_corners, "{seed}");
            for y in 0..rows {
                for (column, word) in bits.words(y) {
                    let surrounded = bits.surrounded(column, y);
                    for x in column..columns.min(column + 64) {
                        let is_one = surrounded >> (x - column) & 1 != 0;
                        assert_eq!(
                            is_one,
                            bits.window(x as i32, y as i32) == 0x1ff,
                            "{seed}: {x} {y}"
                        );
                    }
                    copy.set_word(column, y, word);
                }
            }
            assert_eq!(copy, bits, "{seed}");
            copy.clear_all();
            for number in 0..bits.n_framed_words() {
                (0..rows as i32)
                    .for_each(|y| copy.set_framed_word(y, number, bits.framed_word(y, number)));
            }
            assert_eq!(copy, bits, "{seed}");
        }
    }
}
