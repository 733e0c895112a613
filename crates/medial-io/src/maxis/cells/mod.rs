//! Masks: chains of cells, disks, squares and outlines as decisions for the range coder.
//!
//! `docs/formats.md` describes what is coded. Each kind has one function that both codes and decodes: given
//! what there is to code, an encoder writes it; a decoder is given nothing and returns what it reads.

mod chain;
mod coder;
mod cracks;
mod points;
mod sizes;

use super::cursor::Fault;
use super::numbers::push;
use super::read::Body;
use super::write::Columns;
use super::{Column, MASK};
use coder::{Coder, Decoder, Encoder};
use medial::geom::Point;
use medial::ops::{Ball, BallShape, CellCode, CompressedMask, MaskMethod};
use medial::raster::{Grid, Mask};

/// Most cells of an array, so that no file fills the memory.
const MOST_CELLS: u64 = 1 << 30;

pub(super) fn write(columns: &mut Columns, mask: &CompressedMask) {
    let (detail, bytes) = coded(mask);
    let Grid { origin, cell, columns: n_columns, rows } = mask.grid;
    let is_plain = mask.grid == Grid::of_image(n_columns, rows);
    let is_exact = mask.missing == 0;
    let plan = columns.of(Column::Plan);
    plan.push(MASK);
    // Methods are few.
    let method =
        MaskMethod::ALL.iter().position(|&known| known == mask.method()).unwrap_or(0) as u8;
    plan.push(method | u8::from(!is_plain) << 4 | u8::from(!is_exact) << 5);
    push(plan, n_columns.into());
    push(plan, rows.into());
    if !is_plain {
        let place = [origin.x, origin.y, cell[0], cell[1]];
        plan.extend(place.into_iter().flat_map(f64::to_le_bytes));
    }
    if !is_exact {
        push(plan, mask.missing);
        plan.extend(mask.error.to_le_bytes());
    }
    plan.push(detail);
    push(plan, bytes.len() as u64);
    plan.extend(bytes);
}

/// The byte that tells how sizes or turns are coded, and what is coded: of all details the one that takes
/// fewest bytes.
fn coded(mask: &CompressedMask) -> (u8, Vec<u8>) {
    let grid = &mask.grid;
    let sorted = |balls: &[Ball]| {
        let mut balls = balls.to_vec();
        balls.sort_unstable();
        balls.dedup_by_key(|ball| (ball.y, ball.x));
        balls
    };
    let with = |detail: u8, code: &dyn Fn(&mut Encoder)| {
        let mut encoder = Encoder::new();
        code(&mut encoder);
        (detail, encoder.finish())
    };
    let all: Vec<(u8, Vec<u8>)> = match &mask.code {
        CellCode::Chain(balls) => {
            let balls = sorted(balls);
            let unit = sizes::Unit::of(BallShape::Disk, &balls);
            let shares = 0..=chain::MOST_SHARE;
            let coded = |share| {
                with(unit.detail() | share << 4, &|encoder| {
                    // Writing does not fail.
                    let _ = chain::code(encoder, grid, unit, share, &balls);
                })
            };
            shares.map(coded).collect()
        }
        CellCode::Cover(balls) | CellCode::Squares(balls) => {
            let balls = sorted(balls);
            let unit = sizes::Unit::of(shape(mask.method()), &balls);
            vec![with(unit.detail(), &|encoder| {
                let _ = points::code(encoder, grid, unit, &balls);
            })]
        }
        CellCode::Crack(chains) => {
            let mut chains = chains.clone();
            chains.sort_by_key(|chain| (chain.start[1], chain.start[0]));
            let coded = |order| {
                with(order, &|encoder| {
                    let _ = cracks::code(encoder, grid, order, &chains);
                })
            };
            (1..=cracks::MOST_ORDER).map(coded).collect()
        }
    };
    all.into_iter().min_by_key(|(_, bytes)| bytes.len()).unwrap_or_default()
}

fn shape(method: MaskMethod) -> BallShape {
    if method == MaskMethod::Squares { BallShape::Square } else { BallShape::Disk }
}

pub(super) fn read(body: &mut Body) -> Result<CompressedMask, Fault> {
    let head = body.byte(Column::Plan)?;
    let method = MaskMethod::ALL.get(usize::from(head & 15)).copied();
    let method =
        method.filter(|_| head < 64).ok_or_else(|| format!("{head} is no kind of mask"))?;
    let mut side = || {
        let side = body.number(Column::Plan)?;
        let side = u32::try_from(side).ok().filter(|&side| side <= Mask::MOST);
        side.ok_or_else(|| "there are too many cells".to_owned())
    };
    let mut grid = Grid::of_image(side()?, side()?);
    if grid.n_cells() > MOST_CELLS {
        return Err("there are too many cells".to_owned());
    }
    if head & 16 != 0 {
        let mut double = || body.double(Column::Plan);
        grid.origin = Point::new(double()?, double()?);
        grid.cell = [double()?, double()?];
        Mask::empty(Grid { columns: 0, rows: 0, ..grid }).map_err(|error| error.to_string())?;
    }
    let (mut missing, mut error) = (0, 0.0);
    if head & 32 != 0 {
        (missing, error) = (body.number(Column::Plan)?, body.double(Column::Plan)?);
        if error.is_nan() || error < 0.0 || missing > grid.n_cells() {
            return Err("its error is out of range".to_owned());
        }
    }
    let detail = body.byte(Column::Plan)?;
    let length = body.number(Column::Plan)?;
    let length = body.fits(Column::Plan, length)?;
    let bytes = body.bytes(Column::Plan, length)?;
    let mut decoder = Decoder::new(bytes);
    let unit = || sizes::Unit::from_detail(shape(method), detail & 15);
    let code = match method {
        MaskMethod::Chain if detail >> 4 <= chain::MOST_SHARE => {
            CellCode::Chain(chain::code(&mut decoder, &grid, unit()?, detail >> 4, &[])?)
        }
        MaskMethod::Cover if detail < 16 => {
            CellCode::Cover(points::code(&mut decoder, &grid, unit()?, &[])?)
        }
        MaskMethod::Squares if detail < 16 => {
            CellCode::Squares(points::code(&mut decoder, &grid, unit()?, &[])?)
        }
        MaskMethod::Crack if (1..=cracks::MOST_ORDER).contains(&detail) => {
            CellCode::Crack(cracks::code(&mut decoder, &grid, detail, &[])?)
        }
        _ => return Err(format!("{detail} is no way to code a mask")),
    };
    if decoder.is_spent() || !decoder.is_done() {
        return Err("the code of its cells is damaged".to_owned());
    }
    Ok(CompressedMask { grid, code, error, missing })
}

/// Fails if more is asked for than was coded.
fn check(coder: &impl Coder) -> Result<(), Fault> {
    if coder.is_spent() { Err("the code of its cells ends too early".to_owned()) } else { Ok(()) }
}

/// Places row by row, each coded by how far it is from the one before.
struct Rows {
    columns: u32,
    rows: u32,
    last: Option<[u32; 2]>,
    down: coder::Numbers,
    along: coder::Numbers,
    across: coder::Places,
}

impl Rows {
    fn new(columns: u32, rows: u32) -> Self {
        let numbers = coder::Numbers::default;
        let across = coder::Places::below(columns);
        Self { columns, rows, last: None, down: numbers(), along: numbers(), across }
    }

    /// Codes the column and row of the next place.
    fn code(&mut self, coder: &mut impl Coder, at: [u32; 2]) -> Result<[u32; 2], Fault> {
        let (mut column, mut row) = (0, 0);
        let mut is_first = true;
        if let Some([x, y]) = self.last {
            (column, row, is_first) = (x + 1, y, false);
        }
        let down = self.down.code(coder, at[1].wrapping_sub(row).into());
        let y = u64::from(row).checked_add(down).filter(|&y| y < self.rows.into());
        let x = if down == 0 && !is_first {
            let along = self.along.code(coder, at[0].wrapping_sub(column).into());
            u64::from(column).checked_add(along)
        } else {
            Some(self.across.code(coder, at[0]).into())
        };
        let x = x.filter(|&x| x < self.columns.into());
        let (Some(x), Some(y)) = (x, y) else {
            return Err("a place lies outside of the cells".to_owned());
        };
        let place = [x as u32, y as u32];
        self.last = Some(place);
        Ok(place)
    }
}

#[cfg(test)]
mod tests;
