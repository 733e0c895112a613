//! Borders between objects, from one place where they meet to the next.

use super::Corner;
use crate::labels::Labels;
use crate::objects::Objects;
use medial::raster::Grid;

/// The sides of pixels between one object and another, or none.
pub(super) struct Cracks<'a> {
    pub objects: &'a Objects,
}

/// Ways along the sides of pixels: columns and rows; each next one is a turn, the one after it the way back.
const WAYS: [[i64; 2]; 4] = [[1, 0], [0, 1], [-1, 0], [0, -1]];

impl Cracks<'_> {
    /// The object of a pixel, by the corner at its lower right.
    fn object(&self, column: i64, row: i64) -> u32 {
        let Grid { columns, rows, .. } = *self.objects.grid();
        if column < 0 || row < 0 || column >= i64::from(columns) || row >= i64::from(rows) {
            return Labels::NONE;
        }
        let pixel = row as usize * columns as usize + column as usize;
        match self.objects.numbers()[pixel] {
            Objects::REST => Labels::NONE,
            number => number,
        }
    }

    /// The objects around a corner: to the right below it, to the left below, to the left above, to the right above.
    fn around(&self, [column, row]: Corner) -> [u32; 4] {
        let (x, y) = (i64::from(column), i64::from(row));
        [(x, y), (x - 1, y), (x - 1, y - 1), (x, y - 1)].map(|(x, y)| self.object(x, y))
    }

    /// Whether there is a border out of a corner along each way.
    fn ways(&self, corner: Corner) -> [bool; 4] {
        let [a, b, c, d] = self.around(corner);
        [d != a, a != b, b != c, c != d]
    }

    pub fn is_node(&self, corner: Corner) -> bool {
        self.ways(corner).iter().filter(|&&way| way).count() > 2
    }

    /// Whether two pixels of one object touch at a corner, and no sides join them there.
    pub fn is_pinched(&self, corner: Corner) -> bool {
        let [a, b, c, d] = self.around(corner);
        let is_apart = a != b && b != c && c != d && d != a;
        is_apart && ((a == c && a != Labels::NONE) || (b == d && b != Labels::NONE))
    }

    pub fn is_turn(&self, corner: Corner) -> bool {
        let ways = self.ways(corner);
        ways.iter().filter(|&&way| way).count() == 2 && ways[0] != ways[2]
    }
}

/// A border from one corner that stays to the next, or around to where it began.
pub(super) struct Arc {
    /// Where it turns, with both ends; a loop ends where it began.
    pub corners: Vec<Corner>,
    /// Whether it is a loop of which any corner may leave.
    pub is_loop: bool,
}

impl Arc {
    /// Its two ends, the lesser one first.
    pub fn ends(&self) -> [Corner; 2] {
        let mut ends = [self.corners[0], self.corners[self.corners.len() - 1]];
        ends.sort_unstable();
        ends
    }
}

/// Follows borders, each once.
pub(super) struct Walk<'a> {
    pub cracks: &'a Cracks<'a>,
    /// For each corner the ways out of it that were taken.
    pub seen: Vec<u8>,
    pub stride: usize,
}

impl Walk<'_> {
    /// The border out of a corner along a way, if there is one that was not followed yet.
    pub fn follow(
        &mut self,
        start: Corner,
        mut way: usize,
        is_fixed: &impl Fn(Corner) -> bool,
    ) -> Option<Arc> {
        let number = |[column, row]: Corner| row as usize * self.stride + column as usize;
        if !self.cracks.ways(start)[way] || self.seen[number(start)] >> way & 1 == 1 {
            return None;
        }
        let mut corners = vec![start];
        let mut at = start;
        loop {
            self.seen[number(at)] |= 1 << way;
            at = [0, 1].map(|axis| (i64::from(at[axis]) + WAYS[way][axis]) as u32);
            let back = (way + 2) % 4;
            self.seen[number(at)] |= 1 << back;
            if at == start || is_fixed(at) {
                corners.push(at);
                return Some(Arc { corners, is_loop: !is_fixed(start) });
            }
            let ways = self.cracks.ways(at);
            let on = (0..4).find(|&on| ways[on] && on != back)?;
            if on != way {
                corners.push(at);
            }
            way = on;
        }
    }
}
