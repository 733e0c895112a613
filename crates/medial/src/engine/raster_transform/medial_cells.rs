//! The integer medial axis [HR08] with a residual for each cell: which cells lie between two parts of the
//! outline, and how far these are from each other along it.

use std::ops::Range;

use crate::raster::{Band, Bits, Cracks, Offset, Side, ones};

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
#[derive(Clone, Copy, Debug, Default)]
struct Foot {
    contour: u32,
    /// Length along it.
    along: f64,
    /// The middle of the crack, in half cells.
    middle: (i32, i32),
}

/// What is known of a row of cells: of each of them by its place, and 64 to a word. Places are counted from
/// [`Bits::LEAD`] columns before the first one.
#[derive(Debug)]
struct Row {
    y: i32,
    /// Which cells are of the shape.
    inside: Vec<u64>,
    /// From cells of the shape to their feet, and 0 for others.
    offsets: Vec<Offset>,
    /// Which cells of the shape are in a pair whose feet are apart; these are looked up.
    paired: Vec<u64>,
    feet: Vec<Foot>,
    /// The greatest residual so far; negative for none.
    residuals: Vec<f32>,
}

/// Room that is made at once for what will be found: what is not needed of it is hardly touched.
const ROOM: usize = 1 << 20;

/// The residual where no foot is apart from another one.
const NONE: f32 = -1.0;

impl Row {
    /// The row before the first one.
    fn new(bits: &Bits) -> Self {
        let n_words = bits.n_framed_words();
        // One more, so that each has a next one.
        let n = 64 * (n_words + 1);
        Self {
            y: -1,
            inside: vec![0; n_words + 1],
            offsets: vec![Offset::default(); n],
            paired: vec![0; n_words + 1],
            feet: vec![Foot::default(); n],
            residuals: vec![NONE; n],
        }
    }

    /// Becomes another row.
    fn load(&mut self, bits: &Bits, band: &Band, y: i32) {
        self.y = y;
        for (number, word) in self.inside.iter_mut().enumerate().take(bits.n_framed_words()) {
            *word = bits.framed_word(y, number);
        }
        self.offsets.fill(Offset::default());
        if 0 <= y && y < bits.rows() as i32 {
            band.copy_row(bits, y as u32, &mut self.offsets[Bits::LEAD as usize..]);
        }
        self.paired.fill(0);
        self.residuals.fill(NONE);
    }

    #[inline(always)]
    fn is_inside(&self, place: usize) -> bool {
        self.inside[place / 64] >> (place % 64) & 1 != 0
    }

    #[inline(always)]
    fn raise(&mut self, place: usize, value: f32) {
        let at = &mut self.residuals[place];
        *at = at.max(value);
    }

    /// Looks up the feet of some cells of the shape, 64 of them in a word.
    #[inline(always)]
    fn look_up(&mut self, outline: &Outline<'_>, number: usize, cells: u64) {
        let cells = cells & self.inside[number] & !self.paired[number];
        self.paired[number] |= cells;
        for place in ones(64 * number as u32, cells) {
            let (dx, dy) = self.offsets[place as usize].both();
            let (x, y) = (place as i32 - Bits::LEAD + dx, self.y + dy);
            self.feet[place as usize] = outline.crack(x, y, Side::facing(-dx, -dy));
        }
    }

    /// The foot of a cell of the shape, or the crack of one outside at one side.
    #[inline(always)]
    fn foot(&self, outline: &Outline<'_>, place: usize, side: Side) -> Foot {
        match self.is_inside(place) {
            true => self.feet[place],
            false => outline.crack(place as i32 - Bits::LEAD, self.y, side),
        }
    }
}

/// What is asked of the outline.
struct Outline<'a> {
    cracks: &'a Cracks,
    aspect: f64,
}

impl Outline<'_> {
    /// The crack of a cell outside on one side.
    #[inline(always)]
    fn crack(&self, x: i32, y: i32, side: Side) -> Foot {
        let (contour, along) = self.cracks.position(x, y, side);
        Foot { contour, along, middle: middle(x, y, side) }
    }

    /// By how much the way along the outline between two feet is longer than the straight one.
    #[inline(always)]
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

    /// Which cells of a pair of neighbours are at least as near to the bisector of their feet as the other one,
    /// given the ways there; `step` leads from the first cell to the second.
    #[inline(always)]
    fn nearer(&self, a: Offset, b: Offset, [sx, sy]: [i32; 2]) -> [bool; 2] {
        // Both feet, from the first cell.
        let (a, b) = (a.both(), b.both());
        let b = (b.0 + sx, b.1 + sy);
        let along_x = f64::from(a.0 - b.0) * f64::from(a.0 + b.0 - sx);
        let along_y = f64::from(a.1 - b.1) * f64::from(a.1 + b.1 - sy);
        let side = along_x + self.aspect * along_y;
        [side >= 0.0, side <= 0.0]
    }
}

/// Whether the feet of two neighbours are neither the same nor side by side.
#[inline(always)]
fn are_apart(a: Offset, b: Offset, [sx, sy]: [i32; 2]) -> bool {
    let (a, b) = (a.both(), b.both());
    (a.0 - b.0 - sx).abs() + (a.1 - b.1 - sy).abs() > 1
}

/// The search for cells between two parts of the outline, row by row.
#[derive(Debug)]
pub(super) struct Search {
    threshold: f32,
    own: Row,
    below: Row,
    /// Which cells are apart from the next one of the row at hand, and from the one below; a bit for each place.
    across: Vec<u64>,
    down: Vec<u64>,
    found: Vec<MedialCell>,
}

impl Search {
    /// Looks for cells whose residual is above a threshold.
    pub fn new(bits: &Bits, threshold: f32) -> Self {
        let [own, below] = [(); 2].map(|()| Row::new(bits));
        let [across, down] = [(); 2].map(|()| vec![0; bits.n_framed_words()]);
        let found = Vec::with_capacity(ROOM.min(bits.count() as usize / 2));
        Self { threshold, own, below, across, down, found }
    }

    /// What was found, row by row.
    pub fn found(self) -> Vec<MedialCell> {
        self.found
    }

    /// Takes the next rows, of which a band knows the first one behind them, too; marks what it finds.
    pub fn rows(
        &mut self,
        bits: &Bits,
        band: &Band,
        cracks: &Cracks,
        aspect: f64,
        rows: Range<u32>,
        marked: &mut Bits,
    ) {
        let outline = Outline { cracks, aspect };
        if rows.start == 0 {
            self.pairs(bits, band, &outline);
            std::mem::swap(&mut self.own, &mut self.below);
        }
        for _ in rows {
            self.pairs(bits, band, &outline);
            self.collect(marked, aspect);
            std::mem::swap(&mut self.own, &mut self.below);
        }
    }

    /// Takes the pairs of the row at hand with itself and the next one.
    fn pairs(&mut self, bits: &Bits, band: &Band, outline: &Outline<'_>) {
        let Self { own, below, across, down, .. } = self;
        below.load(bits, band, own.y + 1);
        // Which pairs count is hard to foresee, so each step goes through all of them.
        for (number, (across, down)) in across.iter_mut().zip(&mut *down).enumerate() {
            let [inside, next] = [own.inside[number], own.inside[number + 1]];
            (*across, *down) = (0, 0);
            for place in ones(0, inside | inside >> 1 | next << 63) {
                let [a, b] = [0, 1].map(|k| own.offsets[64 * number + place as usize + k]);
                *across |= u64::from(are_apart(a, b, [1, 0])) << place;
            }
            for place in ones(0, inside | below.inside[number]) {
                let at = 64 * number + place as usize;
                let (a, b) = (own.offsets[at], below.offsets[at]);
                *down |= u64::from(are_apart(a, b, [0, 1])) << place;
            }
        }
        let mut before = 0;
        for (number, (&across, &down)) in across.iter().zip(&*down).enumerate() {
            own.look_up(outline, number, across | across << 1 | before | down);
            below.look_up(outline, number, down);
            before = across >> 63;
        }
        let among = |is_one: bool, residual| if is_one { residual } else { NONE };
        for (number, (&across, &down)) in across.iter().zip(&*down).enumerate() {
            for place in ones(64 * number as u32, across) {
                let place = place as usize;
                let step = [1, 0];
                let nearer = outline.nearer(own.offsets[place], own.offsets[place + 1], step);
                let first = nearer[0] & own.is_inside(place);
                let second = nearer[1] & own.is_inside(place + 1);
                if first | second {
                    let a = own.foot(outline, place, Side::Right);
                    let b = own.foot(outline, place + 1, Side::Left);
                    let residual = outline.residual(a, b);
                    own.raise(place, among(first, residual));
                    own.raise(place + 1, among(second, residual));
                }
            }
            for place in ones(64 * number as u32, down) {
                let place = place as usize;
                let step = [0, 1];
                let nearer = outline.nearer(own.offsets[place], below.offsets[place], step);
                let first = nearer[0] & own.is_inside(place);
                let second = nearer[1] & below.is_inside(place);
                if first | second {
                    let a = own.foot(outline, place, Side::Below);
                    let b = below.foot(outline, place, Side::Above);
                    let residual = outline.residual(a, b);
                    own.raise(place, among(first, residual));
                    below.raise(place, among(second, residual));
                }
            }
        }
    }

    /// Takes what was found in the row at hand.
    fn collect(&mut self, marked: &mut Bits, aspect: f64) {
        let Self { threshold, own, found, .. } = self;
        for number in 0..self.across.len() {
            let mut above = 0;
            for place in ones(0, own.paired[number]) {
                let residual = own.residuals[64 * number + place as usize];
                above |= u64::from(residual > *threshold) << place;
            }
            marked.set_framed_word(own.y, number, above);
            for place in ones(64 * number as u32, above) {
                let (x, place) = (place - Bits::LEAD as u32, place as usize);
                let squared = own.offsets[place].squared(aspect) as f32;
                let residual = own.residuals[place];
                found.push(MedialCell { x, y: own.y as u32, residual, squared });
            }
        }
    }
}
