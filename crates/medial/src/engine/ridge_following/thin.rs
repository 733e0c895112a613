//! What becomes of medial pixels that are more than needed (III.D).

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use super::follow::{Field, RidgePixel};
use crate::axis::names;
use crate::engine::EngineError;
use crate::raster::{Bits, SIMPLE, WINDOW_RING, filled_ring, n_runs};

/// How excess medial pixels are taken away.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RidgeThinning {
    /// Simple pixels go, the worst of all first, until none is left.
    #[default]
    Queue,
    /// Simple pixels go that are worse than each of their neighbours, pass by pass, as in the report.
    Report,
    /// The best pixel stays and all others within five by five around it go, as DeSouza and Houghton did. What
    /// is left are single points.
    FiveByFive,
    /// All pixels stay.
    Full,
}

names!(
    RidgeThinning, "thinning",
    Queue => "queue", Report => "report", FiveByFive => "five_by_five", Full => "full",
);

/// Whether the pixel in the middle of a window is simple as the report has it: its neighbours, with corners set
/// where both sides beside them are, are one run of at least three.
static REMOVABLE: [bool; 512] = removable_table();

const fn removable_table() -> [bool; 512] {
    let mut table = [false; 512];
    let mut window = 0;
    while window < 512 {
        let ring = filled_ring(window as u16);
        let (mut set, mut k) = (0, 0);
        while k < 8 {
            set += ring[k] as u32;
            k += 1;
        }
        table[window] = set > 2 && n_runs(&ring) == 1;
        window += 1;
    }
    table
}

/// Medial pixels, row by row.
pub(super) struct Medial {
    pub pixels: Vec<RidgePixel>,
    /// The first pixel of each row, and the end.
    rows: Vec<usize>,
    pub bits: Bits,
    boundary: Bits,
    /// Whether ridges go on beyond the array.
    goes_on: bool,
}

/// The corners in a window, each with the two sides beside it.
const CORNERS: [(u16, u16); 4] =
    [(0, 1 << 1 | 1 << 3), (2, 1 << 1 | 1 << 5), (6, 1 << 3 | 1 << 7), (8, 1 << 5 | 1 << 7)];

impl Medial {
    /// The pixels by increasing column within increasing row.
    pub fn new(mut pixels: Vec<RidgePixel>, boundary: Bits, goes_on: bool) -> Self {
        pixels.sort_unstable_by_key(|pixel| (pixel.row, pixel.column));
        let mut bits = Bits::new(boundary.columns(), boundary.rows());
        let mut rows = Vec::with_capacity(boundary.rows() as usize + 1);
        for (number, pixel) in pixels.iter().enumerate() {
            rows.resize(rows.len().max(pixel.row as usize + 1), number);
            bits.set(pixel.column as i32, pixel.row as i32);
        }
        rows.resize(boundary.rows() as usize + 1, pixels.len());
        Self { pixels, rows, bits, boundary, goes_on }
    }

    /// The number of a pixel, medial once.
    pub fn number(&self, x: u32, y: u32) -> Option<usize> {
        let first = self.rows[y as usize];
        let row = &self.pixels[first..self.rows[y as usize + 1]];
        row.binary_search_by_key(&x, |pixel| pixel.column).ok().map(|k| first + k)
    }

    /// The radius at a medial pixel.
    pub fn radius(&self, [x, y]: [u32; 2]) -> f64 {
        self.number(x, y).map_or(0.0, |number| self.pixels[number].radius)
    }

    /// A pixel with its medial neighbours, without those across the boundary.
    fn window(&self, x: i32, y: i32) -> u16 {
        let drawn = self.boundary.window(x, y);
        let mut seen = self.bits.window(x, y);
        for (corner, sides) in CORNERS {
            if drawn & sides == sides {
                seen &= !(1 << corner);
            }
        }
        seen
    }

    /// The same where ridges go on beyond the array: as if its border were there once more.
    ///
    /// Otherwise a broad ridge that is cut off has two corners there, and would end in both.
    fn window_beyond(&self, x: i32, y: i32) -> u16 {
        let mut seen = self.window(x, y);
        let (last_x, last_y) = (self.bits.columns() as i32 - 1, self.bits.rows() as i32 - 1);
        let row = seen >> 3 & 0b111;
        for (is_last, by) in [(y == 0, 0), (y == last_y, 6)] {
            if is_last {
                seen = seen & !(0b111 << by) | row << by;
            }
        }
        let column = seen >> 1 & 0b1_001_001;
        for (is_last, by) in [(x == 0, 0), (x == last_x, 2)] {
            if is_last {
                seen = seen & !(0b1_001_001 << by) | column << by;
            }
        }
        seen
    }

    fn is_removable(&self, number: usize) -> bool {
        let RidgePixel { column, row, .. } = self.pixels[number];
        let (x, y) = (column as i32, row as i32);
        let window = if self.goes_on { self.window_beyond(x, y) } else { self.window(x, y) };
        let window = window as usize;
        debug_assert!(!REMOVABLE[window] || SIMPLE[window], "what is removable is simple");
        REMOVABLE[window]
    }

    /// The numbers of the medial neighbours of a pixel.
    fn neighbours(&self, number: usize) -> impl Iterator<Item = usize> + '_ {
        let RidgePixel { column, row, .. } = self.pixels[number];
        let ring = self.window(column as i32, row as i32) & WINDOW_RING;
        (0..9).filter(move |k| ring >> k & 1 != 0).filter_map(move |k| {
            self.number((column + k % 3).wrapping_sub(1), (row + k / 3).wrapping_sub(1))
        })
    }

    fn take(&mut self, number: usize) {
        let RidgePixel { column, row, .. } = self.pixels[number];
        self.bits.clear(column as i32, row as i32);
    }

    /// The rule of the report (A.3.d).
    pub fn thin_by_passes(&mut self, field: &Field<'_>) -> Result<(), EngineError> {
        let mut left: Vec<usize> = (0..self.pixels.len()).collect();
        loop {
            let before = left.len();
            let mut kept = Vec::with_capacity(before);
            for number in left {
                field.watch.check()?;
                let quality = self.pixels[number].quality;
                let is_worst = self.neighbours(number).all(|k| self.pixels[k].quality < quality);
                if is_worst && self.is_removable(number) {
                    self.take(number);
                } else {
                    kept.push(number);
                }
            }
            left = kept;
            if left.len() == before {
                return Ok(());
            }
        }
    }

    /// The worst pixel first, of equal ones that in the later row and column.
    pub fn thin_by_queue(&mut self, field: &Field<'_>) -> Result<(), EngineError> {
        let waiting = |medial: &Self, number: usize| Waiting {
            quality: medial.pixels[number].quality,
            number,
        };
        let mut queue: BinaryHeap<Waiting> = (0..self.pixels.len())
            .filter(|&number| self.is_removable(number))
            .map(|number| waiting(self, number))
            .collect();
        while let Some(Waiting { number, .. }) = queue.pop() {
            field.watch.check()?;
            let RidgePixel { column, row, .. } = self.pixels[number];
            // A pixel may wait more than once, and may be needed by now.
            if !self.bits.get(column as i32, row as i32) || !self.is_removable(number) {
                continue;
            }
            let around: Vec<usize> = self.neighbours(number).collect();
            self.take(number);
            let next = around.into_iter().filter(|&k| self.is_removable(k));
            queue.extend(next.map(|k| waiting(self, k)));
        }
        Ok(())
    }

    /// The rule of DeSouza and Houghton: the best of 16 points in each pixel that is kept.
    pub fn thin_five_by_five(&mut self, field: &mut Field<'_>) -> Result<(), EngineError> {
        let mut order: Vec<usize> = (0..self.pixels.len()).collect();
        let quality = |k: usize| self.pixels[k].quality;
        order.sort_by(|&a, &b| quality(a).total_cmp(&quality(b)));
        for number in order {
            field.watch.check()?;
            let RidgePixel { column, row, .. } = self.pixels[number];
            let (x, y) = (column as i32, row as i32);
            if !self.bits.get(x, y) {
                continue;
            }
            for v in (y - 2).max(0)..=(y + 2).min(self.bits.rows() as i32 - 1) {
                for u in (x - 2).max(0)..=(x + 2).min(self.bits.columns() as i32 - 1) {
                    self.bits.clear(u, v);
                }
            }
            self.bits.set(x, y);
            for k in 0..16 {
                let share = |k: i32| (f64::from(k) + 0.5) / 4.0;
                let (position, two) = field.two_within(x, y, [share(k % 4), share(k / 4)]);
                let pixel = &mut self.pixels[number];
                if two.quality() < pixel.quality {
                    let (radius, quality) = (two.first.squared.sqrt(), two.quality());
                    *pixel = RidgePixel { position, radius, quality, ..*pixel };
                }
            }
        }
        Ok(())
    }

    /// Drops what was taken away.
    pub fn shrink(self) -> Self {
        let Self { mut pixels, bits, boundary, goes_on, .. } = self;
        pixels.retain(|pixel| bits.get(pixel.column as i32, pixel.row as i32));
        Self::new(pixels, boundary, goes_on)
    }
}

/// A pixel in the queue.
struct Waiting {
    quality: f64,
    number: usize,
}

impl Ord for Waiting {
    fn cmp(&self, other: &Self) -> Ordering {
        self.quality.total_cmp(&other.quality).then(self.number.cmp(&other.number))
    }
}

impl PartialOrd for Waiting {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Waiting {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Waiting {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rule_of_the_report_takes_simple_pixels_that_are_no_ends() {
        for window in 0..512_usize {
            if REMOVABLE[window] {
                assert!(SIMPLE[window], "{window:09b}");
            }
        }
        let with = |bits: &[u32]| REMOVABLE[bits.iter().map(|k| 1 << k).sum::<usize>()];
        // One neighbour, two beside each other, two at a right angle, three in a row.
        assert!(!with(&[4, 5]) && !with(&[4, 5, 2]));
        assert!(with(&[4, 5, 1]) && with(&[4, 5, 2, 8]));
        // Between two others, and in the middle of a plus.
        assert!(!with(&[4, 3, 5]) && !with(&[4, 1, 3, 5, 7]));
    }
}
