//! Thinning without changing components and holes: what is to be kept is given, the rest goes in the order of
//! the distance, and what is thicker than one cell in the end loses its worst cells first.

use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::ops::Range;

use super::medial_cells::MedialCell;
use crate::raster::{Band, Bits, SIMPLE, WINDOW_RING, can_go, ones};

/// Steps of the distance within which cells go in the order in which they became removable.
const STEPS_PER_CELL: f32 = 4.0;

/// Those neighbours of a cell whose bits are set in a window.
#[inline(always)]
fn neighbours((x, y): (i32, i32), window: u16) -> impl Iterator<Item = (i32, i32)> {
    /// Columns and rows to each cell of a window.
    const WAYS: [(i32, i32); 9] =
        [(-1, -1), (0, -1), (1, -1), (-1, 0), (0, 0), (1, 0), (-1, 1), (0, 1), (1, 1)];
    ones(0, window.into()).map(move |k| (x + WAYS[k as usize].0, y + WAYS[k as usize].1))
}

/// A cell as its column and row.
fn packed(x: i32, y: i32) -> u32 {
    (y as u32) << 16 | x as u32
}

fn unpacked(cell: u32) -> (i32, i32) {
    ((cell & 0xffff) as i32, (cell >> 16) as i32)
}

/// The bits of the neighbours in the row below.
const BELOW: u16 = 0b111 << 6;

/// A shape that is thinned band by band.
#[derive(Debug)]
pub(super) struct Thinning {
    shape: Bits,
    /// Cells that wait for their turn, and those to be kept.
    waits: Bits,
    /// The same by distance. Each comes in with the first of its neighbours that goes, and is asked once it is
    /// its turn: then those nearer to the boundary are gone.
    queues: Vec<Vec<u32>>,
    left: Left,
}

/// Cells that were left over although they are not to be kept, row by row, with the squares of their
/// distances.
#[derive(Debug, Default)]
struct Left(Vec<(u32, f32)>);

impl Left {
    fn squared(&self, cell: u32) -> f32 {
        let place = self.0.binary_search_by_key(&cell, |&(cell, _)| cell);
        place.map_or(0.0, |place| self.0[place].1)
    }
}

impl Thinning {
    pub fn new(shape: &Bits) -> Self {
        let waits = Bits::new(shape.columns(), shape.rows());
        Self { shape: shape.clone(), waits, queues: Vec::new(), left: Left::default() }
    }

    /// The cells that are left.
    pub fn finish(self) -> Bits {
        self.shape
    }

    /// Takes from the shape all cells down to the last row of a band that can go without changing components
    /// and holes, nearest to the boundary first, but those to be kept.
    ///
    /// Bands come in their order. What an earlier one had to leave because of cells below it goes as soon as
    /// it can, so after the last band every cell that was left over can go no more.
    pub fn band(&mut self, kept: &Bits, band: &Band, rows: Range<u32>) {
        let Self { shape, waits, queues, left } = self;
        let (first, end) = (rows.start as i32, rows.end as i32);
        let level = |x, y| {
            let squared = match y >= first {
                true => band.squared(x, y) as f32,
                false => left.squared(packed(x, y)),
            };
            (squared.sqrt() * STEPS_PER_CELL) as usize
        };
        let push = |queues: &mut Vec<Vec<u32>>, at: usize, x, y| {
            if queues.len() <= at {
                queues.resize_with(at + 1, Vec::new);
            }
            queues[at].push(packed(x, y));
        };
        for y in rows.clone() {
            for (column, word) in shape.words(y) {
                let kept = kept.word(column, y);
                let outer = word & !shape.surrounded(column, y) & !kept;
                waits.set_word(column, y, outer | kept);
                for x in ones(column, outer) {
                    let (x, y) = (x as i32, y as i32);
                    push(queues, level(x, y), x, y);
                }
            }
        }
        let mut now = 0;
        while now < queues.len() {
            // Cells that come in meanwhile are behind those that are here.
            let mut next = 0;
            while let Some(&cell) = queues[now].get(next) {
                next += 1;
                let (x, y) = unpacked(cell);
                waits.clear(x, y);
                let window = shape.window(x, y);
                if !SIMPLE[window as usize] {
                    continue;
                }
                shape.clear(x, y);
                let mut free = window & WINDOW_RING & !waits.window(x, y);
                if y + 1 == end {
                    free &= !BELOW;
                }
                for (u, v) in neighbours((x, y), free) {
                    waits.set(u, v);
                    push(queues, level(u, v).max(now), u, v);
                }
            }
            queues[now] = Vec::new();
            now += 1;
        }
        queues.clear();
        for y in rows {
            for (column, word) in shape.words(y) {
                for x in ones(column, word & !kept.word(column, y)) {
                    let (x, y) = (x as i32, y as i32);
                    left.0.push((packed(x, y), band.squared(x, y) as f32));
                }
            }
        }
    }
}

/// Takes from what is left those cells that are neither ends nor needed to hold the rest together, the worst
/// first: those of the least residual, then of the least distance.
pub(super) fn thin_further(thinning: Thinning, medial: &[MedialCell]) -> Bits {
    let Thinning { mut shape, mut waits, left, .. } = thinning;
    waits.clear_all();
    // Neither is negative, so their bits are in their order.
    let quality = |residual: f32, squared: f32| {
        u64::from(residual.to_bits()) << 32 | u64::from(squared.to_bits())
    };
    let place = |medial: &MedialCell| packed(medial.x as i32, medial.y as i32);
    let quality_of = |cell: u32| match medial.binary_search_by_key(&cell, place) {
        Ok(found) => quality(medial[found].residual, medial[found].squared),
        Err(_) => quality(0.0, left.squared(cell)),
    };
    // What can go at once is put into order at once; both lists are row by row.
    let mut first: Vec<(u64, u32)> = Vec::new();
    let (mut next_medial, mut next_left) = (medial.iter().peekable(), left.0.iter().peekable());
    for y in 0..shape.rows() {
        for x in shape.ones(y) {
            let (column, row) = (x as i32, y as i32);
            if !can_go(shape.window(column, row)) {
                continue;
            }
            let cell = packed(column, row);
            waits.set(column, row);
            while next_medial.next_if(|medial| place(medial) < cell).is_some() {}
            while next_left.next_if(|&&(at, _)| at < cell).is_some() {}
            let quality = match (next_medial.peek(), next_left.peek()) {
                (Some(medial), _) if place(medial) == cell => {
                    quality(medial.residual, medial.squared)
                }
                (_, Some(&&(at, squared))) if at == cell => quality(0.0, squared),
                _ => quality(0.0, 0.0),
            };
            first.push((quality, cell));
        }
    }
    sort(&mut first);
    // What cannot go in its turn may be able to once a neighbour is gone.
    let mut again = BinaryHeap::new();
    let mut first = first.into_iter().peekable();
    loop {
        let is_again = match (first.peek(), again.peek()) {
            (Some(first), Some(Reverse(again))) => again < first,
            (None, Some(_)) => true,
            (_, None) => false,
        };
        let next = if is_again { again.pop().map(|Reverse(next)| next) } else { first.next() };
        let Some((_, cell)) = next else { break };
        let (x, y) = unpacked(cell);
        waits.clear(x, y);
        let window = shape.window(x, y);
        if !can_go(window) {
            continue;
        }
        shape.clear(x, y);
        let free = window & WINDOW_RING & !waits.window(x, y);
        for (x, y) in neighbours((x, y), free) {
            if can_go(shape.window(x, y)) {
                let cell = packed(x, y);
                waits.set(x, y);
                again.push(Reverse((quality_of(cell), cell)));
            }
        }
    }
    shape
}

/// Sorts cells by their quality; those of the same one stay in their order.
fn sort(cells: &mut Vec<(u64, u32)>) {
    /// So many are sorted faster by comparing them.
    const FEW: usize = 256;
    if cells.len() < FEW {
        return cells.sort_by_key(|&(quality, _)| quality);
    }
    // How often each value of each byte occurs; a byte that has one value says nothing.
    let mut counts = vec![[0_u32; 256]; 8];
    for (quality, _) in &*cells {
        let bytes = quality.to_le_bytes();
        counts.iter_mut().zip(bytes).for_each(|(counts, byte)| counts[usize::from(byte)] += 1);
    }
    let mut other = vec![(0, 0); cells.len()];
    for (place, counts) in counts.iter_mut().enumerate() {
        if counts.iter().any(|&count| count as usize == cells.len()) {
            continue;
        }
        let mut first = 0;
        for count in &mut *counts {
            first += std::mem::replace(count, first);
        }
        for &cell in &*cells {
            let next = &mut counts[usize::from(cell.0.to_le_bytes()[place])];
            other[*next as usize] = cell;
            *next += 1;
        }
        std::mem::swap(cells, &mut other);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::dice::dice;

    #[test]
    fn cells_are_sorted_by_quality_and_keep_their_order() {
        for seed in 1..40 {
            let mut dice = dice(seed);
            let n = dice() as u32 % 900;
            let most = 1 << (dice() % 50);
            let mut cells: Vec<(u64, u32)> = (0..n).map(|cell| (dice() % most, cell)).collect();
            let mut expected = cells.clone();
            sort(&mut cells);
            expected.sort_unstable();
            assert_eq!(cells, expected, "{seed}");
        }
    }
}
