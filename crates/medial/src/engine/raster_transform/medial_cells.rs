//! The integer medial axis [HR08] with a residual for each cell: which cells lie between two parts of the
//! outline, and how far these are from each other along it.

use std::ops::Range;

use crate::raster::{Band, Bits, Cracks, Side};

/// A cell that lies between two parts of the outline.
#[derive(Clone, Copy, Debug)]
pub(super) struct MedialCell {
    pub x: u32,
    pub y: u32,
    /// The chord residual in widths of a cell: the length of the outline between the two feet, less their
    /// distance. Infinite between two contours.
    pub residual: f32,
    /// The square of the distance from the nearest cell outside, in widths of a cell.
    pub squared: f32,
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

/// Where on the outline a foot is.
#[derive(Clone, Copy, Debug)]
struct Foot {
    contour: u32,
    /// Length along it.
    along: f64,
    /// The middle of the crack, in half cells.
    middle: (i32, i32),
}

/// No foot has been looked up yet.
const UNKNOWN: Foot = Foot { contour: u32::MAX, along: 0.0, middle: (0, 0) };

/// A row of cells: what is known of each, from one column before the first.
#[derive(Debug)]
struct Row {
    y: i32,
    /// The greatest residual so far; negative for none.
    residuals: Vec<f32>,
    /// Feet that were asked for.
    feet: Vec<Foot>,
}

impl Row {
    fn new(columns: usize, y: i32) -> Self {
        Self { y, residuals: vec![-1.0; columns + 2], feet: vec![UNKNOWN; columns + 2] }
    }

    #[inline(always)]
    fn raise(&mut self, x: i32, value: f32) {
        let at = &mut self.residuals[(x + 1) as usize];
        *at = at.max(value);
    }
}

/// What the test of a pair of neighbours needs.
struct Pairs<'a> {
    band: &'a Band,
    cracks: &'a Cracks,
    aspect: f64,
}

impl Pairs<'_> {
    /// Columns and rows from a cell to the one outside that is nearest; none for a cell outside.
    #[inline(always)]
    fn offset(&self, x: i32, y: i32, inside: bool) -> (i32, i32) {
        if inside { self.band.offset(x, y) } else { (0, 0) }
    }

    /// The crack of a cell outside on one side.
    fn crack(&self, x: i32, y: i32, side: Side) -> Foot {
        let (contour, along) = self.cracks.position(x, y, side);
        Foot { contour, along, middle: middle(x, y, side) }
    }

    /// The foot of a cell of the shape, or the crack of one outside that faces such a cell so many columns
    /// and rows away.
    #[inline(always)]
    fn foot(&self, row: &mut Row, x: i32, (dx, dy): (i32, i32), to: [i32; 2]) -> Foot {
        if (dx, dy) == (0, 0) {
            return self.crack(x, row.y, Side::facing(to[0], to[1]));
        }
        let known = &mut row.feet[(x + 1) as usize];
        if known.contour == u32::MAX {
            *known = self.crack(x + dx, row.y + dy, Side::facing(-dx, -dy));
        }
        *known
    }

    /// By how much the way along the outline between two feet is longer than the straight one.
    fn residual(&self, a: Foot, b: Foot) -> f32 {
        if a.contour != b.contour {
            return f32::INFINITY;
        }
        let way = (a.along - b.along).abs();
        let way = way.min(self.cracks.contours[a.contour as usize].length - way);
        let (dx, dy) = (a.middle.0 - b.middle.0, a.middle.1 - b.middle.1);
        // Cracks along rows are as long as those along columns, whatever the shape of the cells: the
        // residual counts cells.
        let squared = i64::from(dx) * i64::from(dx) + i64::from(dy) * i64::from(dy);
        (way - 0.5 * (squared as f64).sqrt()) as f32
    }

    /// Which cells of a pair of neighbours lie between two feet that are apart; `step` leads from the first
    /// one to the second.
    #[inline(always)]
    fn between(
        &self,
        a: (i32, i32),
        b: (i32, i32),
        [sx, sy]: [i32; 2],
        [first, second]: [bool; 2],
    ) -> [bool; 2] {
        // Both feet, from the first cell.
        let b = (b.0 + sx, b.1 + sy);
        let (dx, dy) = (a.0 - b.0, a.1 - b.1);
        if dx.abs() + dy.abs() <= 1 {
            return [false; 2];
        }
        // Which of the two cells is nearer to the bisector of the feet.
        let along_x = f64::from(dx) * f64::from(a.0 + b.0 - sx);
        let along_y = f64::from(dy) * f64::from(a.1 + b.1 - sy);
        let side = along_x + self.aspect * along_y;
        [first && side >= 0.0, second && side <= 0.0]
    }

    /// Takes the pair of a cell and the next one of its row.
    #[inline(always)]
    fn across(&self, row: &mut Row, x: i32, inside: [bool; 2]) {
        let (a, b) = (self.offset(x, row.y, inside[0]), self.offset(x + 1, row.y, inside[1]));
        let [to_first, to_second] = self.between(a, b, [1, 0], inside);
        if to_first || to_second {
            let feet = (self.foot(row, x, a, [1, 0]), self.foot(row, x + 1, b, [-1, 0]));
            let residual = self.residual(feet.0, feet.1);
            row.raise(x, if to_first { residual } else { -1.0 });
            row.raise(x + 1, if to_second { residual } else { -1.0 });
        }
    }

    /// Takes the pair of a cell and the one below it.
    #[inline(always)]
    fn down(&self, row: &mut Row, below: &mut Row, x: i32, inside: [bool; 2]) {
        let (a, b) = (self.offset(x, row.y, inside[0]), self.offset(x, below.y, inside[1]));
        let [to_first, to_second] = self.between(a, b, [0, 1], inside);
        if to_first || to_second {
            let feet = (self.foot(row, x, a, [0, 1]), self.foot(below, x, b, [0, -1]));
            let residual = self.residual(feet.0, feet.1);
            row.raise(x, if to_first { residual } else { -1.0 });
            below.raise(x, if to_second { residual } else { -1.0 });
        }
    }
}

/// The search for cells between two parts of the outline, row by row.
#[derive(Debug)]
pub(super) struct Search {
    threshold: f32,
    own: Row,
    below: Row,
    found: Vec<MedialCell>,
}

impl Search {
    /// Looks for cells whose residual is above a threshold.
    pub fn new(columns: u32, threshold: f32) -> Self {
        let row = |y| Row::new(columns as usize, y);
        Self { threshold, own: row(-1), below: row(0), found: Vec::new() }
    }

    /// What was found, row by row.
    pub fn found(self) -> Vec<MedialCell> {
        self.found
    }

    /// Takes the next rows, of which a band knows the first one behind them, too; gives what it found.
    pub fn rows(
        &mut self,
        bits: &Bits,
        band: &Band,
        cracks: &Cracks,
        aspect: f64,
        rows: Range<u32>,
    ) -> &[MedialCell] {
        let pairs = Pairs { band, cracks, aspect };
        let before = self.found.len();
        let first = if rows.start == 0 { -1 } else { rows.start as i32 };
        for y in first..rows.end as i32 {
            self.row(bits, &pairs, y);
        }
        &self.found[before..]
    }

    /// Takes the pairs of a row with itself and the next one.
    fn row(&mut self, bits: &Bits, pairs: &Pairs<'_>, y: i32) {
        let Self { threshold, own, below, found } = self;
        if y >= 0 {
            for (from, to) in bits.runs(y as u32) {
                let (from, to) = (from as i32, to as i32);
                // Pairs within the row, with the cells before and behind the run.
                for x in from - 1..to {
                    pairs.across(own, x, [x >= from, x + 1 < to]);
                }
                for x in from..to {
                    pairs.down(own, below, x, [true, bits.get(x, y + 1)]);
                }
            }
        }
        // Pairs of a cell outside with one of the shape below it.
        if y + 1 < bits.rows() as i32 {
            for (from, to) in bits.runs((y + 1) as u32) {
                for x in (from as i32..to as i32).filter(|&x| !bits.get(x, y)) {
                    pairs.down(own, below, x, [false, true]);
                }
            }
        }
        if y >= 0 {
            for (from, to) in bits.runs(y as u32) {
                let span = from as usize + 1..to as usize + 1;
                for (x, residual) in (from..).zip(&mut own.residuals[span.clone()]) {
                    if *residual > *threshold {
                        let squared = pairs.band.squared(x as i32, y) as f32;
                        found.push(MedialCell { x, y: y as u32, residual: *residual, squared });
                    }
                    *residual = -1.0;
                }
                own.feet[span].fill(UNKNOWN);
            }
        }
        own.y = y + 2;
        std::mem::swap(own, below);
    }
}
