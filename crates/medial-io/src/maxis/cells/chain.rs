//! Chains of cells: from a first cell on, each one tells which of its neighbours belong to the chain and were
//! not met before, from the one straight ahead to the one behind, and how their disks differ from its own.
//!
//! That is the chain code of [Fre74], whose eight directions are decisions here, so that a junction is no case
//! of its own: a cell with several new neighbours has several ways to go on.

use super::coder::{Coder, Context, Numbers};
use super::sizes::{Sizes, Unit};
use super::{Fault, Rows, check};
use medial::ops::{Ball, BallShape};
use medial::raster::Grid;

/// The share of the last difference of sizes that is expected again, in quarters, is at most one.
pub const MOST_SHARE: u8 = 4;

/// The eight directions, by eighths of a turn.
const STEPS: [[i32; 2]; 8] = [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1]];

/// In which order neighbours are asked for, in eighths of a turn from straight ahead.
const ORDER: [usize; 8] = [0, 1, 7, 2, 6, 3, 5, 4];

/// A cell whose neighbours are still to be asked for.
#[derive(Clone, Copy)]
struct Front {
    at: [u32; 2],
    /// How it was come to, and places in the order of the last turns.
    direction: usize,
    turns: [usize; 2],
    /// The number of its size, and that of the cell before it.
    number: i64,
    before: i64,
    /// What the last number was off what was expected.
    off: i64,
}

/// What is learnt on the way.
struct Models {
    neighbours: Vec<Context>,
    off: [Numbers; 5],
    sign: [Context; 3],
}

/// How a turn counts for those that follow: straight, slightly to a side, or sharply.
fn kind(turn: usize) -> usize {
    turn.min(3)
}

impl Models {
    fn new() -> Self {
        let mut neighbours = Vec::new();
        for place in 0..ORDER.len() {
            for found in 0..3 {
                // A line goes on, and seldom parts.
                let share = match (place, found) {
                    (0..=2, 0) => 1 << 15,
                    (_, 0) => 1 << 12,
                    _ => 1 << 11,
                };
                neighbours.extend([Context::likely(share); 16]);
            }
        }
        Self { neighbours, off: Default::default(), sign: Default::default() }
    }

    fn neighbour(&mut self, place: usize, found: usize, turns: [usize; 2]) -> &mut Context {
        &mut self.neighbours[16 * (3 * place + found.min(2)) + 4 * turns[0] + turns[1]]
    }
}

/// Cells that were asked for, in rows that are there once they are needed.
struct Known {
    rows: Vec<Vec<u64>>,
    words: usize,
}

impl Known {
    fn new(grid: &Grid) -> Self {
        let words = (grid.columns as usize).div_ceil(64);
        Self { rows: vec![Vec::new(); grid.rows as usize], words }
    }

    /// Whether a cell is there and is asked for the first time.
    fn is_new(&mut self, [x, y]: [u32; 2]) -> bool {
        let row = &mut self.rows[y as usize];
        if row.is_empty() {
            row.resize(self.words, 0);
        }
        let (word, bit) = (&mut row[x as usize / 64], 1_u64 << (x % 64));
        let is_new = *word & bit == 0;
        *word |= bit;
        is_new
    }
}

/// Codes cells with their disks; given are those to be coded, row by row.
pub fn code(
    coder: &mut impl Coder,
    grid: &Grid,
    unit: Unit,
    share: u8,
    balls: &[Ball],
) -> Result<Vec<Ball>, Fault> {
    let mut header = Numbers::default();
    let largest = balls.iter().map(|ball| ball.size).max().unwrap_or(1);
    let largest = header.code(coder, largest.into());
    let largest = u32::try_from(largest).map_err(|_| "a disk is too large".to_owned())?;
    let sizes = Sizes::new(unit, largest);
    let find = |at: [u32; 2]| {
        balls.binary_search_by_key(&(at[1], at[0]), |ball| (ball.y, ball.x)).ok().map(|k| &balls[k])
    };
    let (mut known, mut models) = (Known::new(grid), Models::new());
    let (mut starts, mut first) = (Rows::new(grid.columns, grid.rows), Numbers::default());
    let mut goes_on = Context::default();
    let mut found = Vec::new();
    let mut next = balls.iter();
    // Those asked for are known, so each cell starts a chain at most once.
    let mut is_met = Known::new(grid);
    loop {
        let start = next.find(|ball| is_met.is_new([ball.x, ball.y]));
        if !coder.bit(&mut goes_on, start.is_some()) {
            break;
        }
        check(coder)?;
        let at = starts.code(coder, start.map_or([0, 0], |ball| [ball.x, ball.y]))?;
        if !known.is_new(at) {
            return Err("a chain starts where another one was".to_owned());
        }
        let number =
            first.code(coder, start.map_or(0, |ball| sizes.number(ball.size)) as u64) as i64;
        found.push(ball(grid, &sizes, at, number)?);
        let start = Front { at, direction: 0, turns: [0, 0], number, before: number, off: 0 };
        let mut stack = vec![start];
        while let Some(front) = stack.pop() {
            check(coder)?;
            let begin = stack.len();
            for (place, turn) in (0..).zip(ORDER) {
                let direction = (front.direction + turn) % 8;
                let [dx, dy] = STEPS[direction];
                let x = front.at[0].checked_add_signed(dx).filter(|&x| x < grid.columns);
                let y = front.at[1].checked_add_signed(dy).filter(|&y| y < grid.rows);
                let (Some(x), Some(y)) = (x, y) else { continue };
                if !known.is_new([x, y]) {
                    continue;
                }
                let there = find([x, y]);
                let context = models.neighbour(place, stack.len() - begin, front.turns);
                if !coder.bit(context, there.is_some()) {
                    continue;
                }
                is_met.is_new([x, y]);
                let guess =
                    front.number + (((front.number - front.before) * i64::from(share)) >> 2);
                let own = there.map_or(0, |ball| sizes.number(ball.size));
                let was = front.off.unsigned_abs().min(8);
                let numbers = &mut models.off[(u64::BITS - was.leading_zeros()) as usize];
                let sign = &mut models.sign[(front.off.signum() + 1) as usize];
                let off = numbers.signed(coder, sign, own - guess);
                let number = guess.checked_add(off).ok_or("a disk is too large")?;
                found.push(ball(grid, &sizes, [x, y], number)?);
                stack.push(Front {
                    at: [x, y],
                    direction,
                    turns: [kind(place), front.turns[0]],
                    number,
                    before: front.number,
                    off,
                });
            }
            // The straightest way comes first.
            stack[begin..].reverse();
        }
    }
    found.sort_unstable();
    Ok(found)
}

/// The disk of a number, which must lie within the array.
fn ball(grid: &Grid, sizes: &Sizes, [x, y]: [u32; 2], number: i64) -> Result<Ball, Fault> {
    let ball = sizes.size(number).map(|size| Ball { y, x, size });
    let ball = ball.filter(|ball| ball.fits(BallShape::Disk, grid));
    ball.ok_or_else(|| format!("the disk at column {x}, row {y} lies outside of the cells"))
}
