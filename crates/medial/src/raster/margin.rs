use super::Bits;
use super::ranks::Ranks;

/// The cells just outside of a shape, numbered row by row: those that have one of its cells at a side.
#[derive(Debug)]
pub(crate) struct Margin(Ranks);

impl Margin {
    pub fn new(bits: &Bits) -> Self {
        let rows = bits.rows() as i32;
        let mut ranks = Ranks::new(bits, -1, rows as usize + 2);
        let last = bits.n_framed_words() - 1;
        for y in -1..=rows {
            let word = |y: i32, number: usize| match -1 <= y && y <= rows {
                true => bits.framed_word(y, number),
                false => 0,
            };
            let (mut left, mut cells) = (0, word(y, 0));
            for number in 0..=last {
                let right = if number < last { word(y, number + 1) } else { 0 };
                let beside = cells << 1 | left >> 63 | cells >> 1 | right << 63;
                let around = beside | word(y - 1, number) | word(y + 1, number);
                ranks.push(around & !cells);
                (left, cells) = (cells, right);
            }
        }
        Self(ranks)
    }

    /// How many cells there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// The number of a cell of the margin.
    #[inline(always)]
    pub fn number(&self, x: i32, y: i32) -> usize {
        self.0.rank(x, y).0
    }
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
