//! The integer medial axis [HR08] with a residual for each cell: which cells lie between two parts of the
//! outline, and how far these are from each other along it.

use crate::raster::{Bits, Cracks, Features, Side};

/// A cell that lies between two parts of the outline.
#[derive(Clone, Copy, Debug)]
pub(super) struct MedialCell {
    pub x: u32,
    pub y: u32,
    /// The chord residual in widths of a cell: the length of the outline between the two feet, less their
    /// distance. Infinite between two contours.
    pub residual: f32,
}

/// Where the middle of a crack is, in half cells.
#[inline(always)]
fn middle(x: i32, y: i32, side: Side) -> (i32, i32) {
    match side {
        Side::Right => (2 * x + 2, 2 * y + 1),
        Side::Below => (2 * x + 1, 2 * y + 2),
        Side::Left => (2 * x, 2 * y + 1),
        Side::Above => (2 * x + 1, 2 * y),
    }
}

/// What the test of a pair of neighbours needs.
struct Pairs<'a> {
    features: &'a Features,
    cracks: &'a Cracks,
    aspect: f64,
}

impl Pairs<'_> {
    /// A cell outside that is nearest to one: columns and rows to it, which are none for a cell outside.
    #[inline(always)]
    fn foot(&self, place: usize, inside: bool) -> (i32, i32) {
        if inside { crate::raster::offset(self.features.cells[place]) } else { (0, 0) }
    }

    /// The residual between the feet of two cells.
    ///
    /// `from` is a cell, and `to` another one; both with the way to their foot. A cell outside is its own
    /// foot, and faces the other one.
    #[cold]
    fn residual(&self, from: ([i32; 2], (i32, i32)), to: ([i32; 2], (i32, i32))) -> f32 {
        let crack = |[x, y]: [i32; 2], (dx, dy): (i32, i32), [u, v]: [i32; 2]| {
            let (foot_x, foot_y) = (x + dx, y + dy);
            let side = if (dx, dy) == (0, 0) {
                Side::facing(u - x, v - y)
            } else {
                Side::facing(-dx, -dy)
            };
            let record = self.features.cells[self.features.place(foot_x, foot_y)];
            let (contour, along) = self.cracks.position(self.cracks.at(record, side));
            (contour, along, middle(foot_x, foot_y, side))
        };
        let (contour, along, (x1, y1)) = crack(from.0, from.1, to.0);
        let (other, beside, (x2, y2)) = crack(to.0, to.1, from.0);
        if contour != other {
            return f32::INFINITY;
        }
        let way = (along - beside).abs();
        let way = way.min(self.cracks.contours[contour as usize].length - way);
        let (dx, dy) = (0.5 * f64::from(x1 - x2), 0.5 * f64::from(y1 - y2));
        // Cracks along rows are as long as those along columns, whatever the shape of the cells: the
        // residual counts cells.
        (way - (dx * dx + dy * dy).sqrt()) as f32
    }

    /// The residuals that a pair of neighbours, the second so many columns and rows after the first one,
    /// gives to each of them; negative for none.
    #[inline(always)]
    fn pair(&self, x: i32, y: i32, [sx, sy]: [i32; 2], first: bool, second: bool) -> [f32; 2] {
        let place = self.features.place(x, y);
        let next = self.features.place(x + sx, y + sy);
        let (a, b) = (self.foot(place, first), self.foot(next, second));
        // Both feet, from the first cell.
        let b_from_first = (b.0 + sx, b.1 + sy);
        let (dx, dy) = (a.0 - b_from_first.0, a.1 - b_from_first.1);
        if dx * dx + dy * dy <= 1 {
            return [-1.0; 2];
        }
        // Which of the two cells is nearer to the bisector of the feet.
        let along_x = f64::from(dx * (a.0 + b_from_first.0 - sx));
        let along_y = f64::from(dy * (a.1 + b_from_first.1 - sy));
        let side = along_x + self.aspect * along_y;
        let (to_first, to_second) = (first && side >= 0.0, second && side <= 0.0);
        if !to_first && !to_second {
            return [-1.0; 2];
        }
        let residual = self.residual(([x, y], a), ([x + sx, y + sy], b));
        [if to_first { residual } else { -1.0 }, if to_second { residual } else { -1.0 }]
    }
}

/// The cells between two parts of the outline whose residual is above a threshold, row by row.
pub(super) fn medial_cells(
    bits: &Bits,
    features: &Features,
    cracks: &Cracks,
    aspect: f64,
    threshold: f32,
) -> Vec<MedialCell> {
    let pairs = Pairs { features, cracks, aspect };
    let columns = bits.columns() as usize;
    let mut found = Vec::new();
    // Residuals of a row and of the next one, from one column before the first.
    let (mut own, mut below) = (vec![-1.0_f32; columns + 2], vec![-1.0_f32; columns + 2]);
    let raise = |row: &mut [f32], x: i32, value: f32| {
        let at = &mut row[(x + 1) as usize];
        *at = at.max(value);
    };
    for y in -1..bits.rows() as i32 {
        if y >= 0 {
            for (from, to) in bits.runs(y as u32) {
                // Pairs within the row, with the cells before and behind the run.
                for x in from as i32 - 1..to as i32 {
                    let (first, second) = (x >= from as i32, x + 1 < to as i32);
                    let [a, b] = pairs.pair(x, y, [1, 0], first, second);
                    raise(&mut own, x, a);
                    raise(&mut own, x + 1, b);
                }
                // Pairs with the cells below.
                for x in from as i32..to as i32 {
                    let [a, b] = pairs.pair(x, y, [0, 1], true, bits.get(x, y + 1));
                    raise(&mut own, x, a);
                    raise(&mut below, x, b);
                }
            }
        }
        // Pairs of a cell outside with one of the shape below it.
        if y + 1 < bits.rows() as i32 {
            for (from, to) in bits.runs((y + 1) as u32) {
                for x in (from as i32..to as i32).filter(|&x| !bits.get(x, y)) {
                    let [_, b] = pairs.pair(x, y, [0, 1], false, true);
                    raise(&mut below, x, b);
                }
            }
        }
        if y >= 0 {
            for (from, to) in bits.runs(y as u32) {
                for x in from..to {
                    let residual = &mut own[x as usize + 1];
                    if *residual > threshold {
                        found.push(MedialCell { x, y: y as u32, residual: *residual });
                    }
                    *residual = -1.0;
                }
            }
        }
        std::mem::swap(&mut own, &mut below);
    }
    found
}
