//! The sizes of disks and squares as small numbers.

use medial::ops::{Ball, BallShape};

/// What sizes are counted in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Squares of distances, by their number among all sums of two squares.
    Sums,
    /// Distances in steps of a cell, so many to one, whose squares are rounded up to whole numbers.
    Steps(u8),
    /// As they are.
    Plain,
}

/// Most sizes that are counted among sums of two squares: a table is made of them.
const MOST_SUM: u32 = 1 << 22;

/// Most steps of a cell.
const MOST_STEPS: u8 = 4;

impl Unit {
    /// The unit that makes the smallest numbers of the sizes of balls.
    pub fn of(shape: BallShape, balls: &[Ball]) -> Self {
        if shape == BallShape::Square {
            return Self::Plain;
        }
        let largest = balls.iter().map(|ball| ball.size).max().unwrap_or(1);
        let fits = |steps: &u8| {
            let sizes = Sizes::new(Self::Steps(*steps), largest);
            balls.iter().all(|ball| sizes.size(sizes.number(ball.size)) == Some(ball.size))
        };
        if let Some(steps) = (1..=MOST_STEPS).find(fits) {
            return Self::Steps(steps);
        }
        let sums = Sizes::new(Self::Sums, largest.min(MOST_SUM));
        let is_sum = |ball: &Ball| sums.size(sums.number(ball.size)) == Some(ball.size);
        if largest <= MOST_SUM && balls.iter().all(is_sum) { Self::Sums } else { Self::Plain }
    }

    /// Its number in files.
    pub fn detail(self) -> u8 {
        match self {
            Self::Sums => 0,
            Self::Steps(steps) => steps,
            Self::Plain => MOST_STEPS + 1,
        }
    }

    pub fn from_detail(shape: BallShape, detail: u8) -> Result<Self, String> {
        match (shape, detail) {
            (BallShape::Disk, 0) => Ok(Self::Sums),
            (BallShape::Disk, steps @ 1..=MOST_STEPS) => Ok(Self::Steps(steps)),
            (_, detail) if detail == MOST_STEPS + 1 => Ok(Self::Plain),
            _ => Err(format!("{detail} is no unit of sizes")),
        }
    }
}

/// Sizes and their numbers, from 0.
pub struct Sizes {
    unit: Unit,
    /// All sums of two squares up to the largest one.
    sums: Vec<u32>,
}

impl Sizes {
    pub fn new(unit: Unit, largest: u32) -> Self {
        let mut sums = Vec::new();
        if unit == Unit::Sums {
            let largest = largest.min(MOST_SUM);
            let mut is_sum = vec![false; largest as usize + 1];
            for a in (0_u32..).take_while(|a| a * a <= largest) {
                let others = (a..).map(|b| a * a + b * b).take_while(|&sum| sum <= largest);
                others.for_each(|sum| is_sum[sum as usize] = true);
            }
            sums = (1..=largest).filter(|&sum| is_sum[sum as usize]).collect();
        }
        Self { unit, sums }
    }

    /// The number of a size: of all that have one the greatest that is not above it.
    pub fn number(&self, size: u32) -> i64 {
        match self.unit {
            Unit::Plain => i64::from(size) - 1,
            Unit::Sums => self.sums.partition_point(|&sum| sum <= size) as i64 - 1,
            Unit::Steps(steps) => {
                let steps = u64::from(steps);
                ((u64::from(size) * steps * steps).isqrt() - steps) as i64
            }
        }
    }

    /// The size of a number.
    pub fn size(&self, number: i64) -> Option<u32> {
        match self.unit {
            Unit::Plain => u32::try_from(number.checked_add(1)?).ok().filter(|&size| size > 0),
            Unit::Sums => self.sums.get(usize::try_from(number).ok()?).copied(),
            Unit::Steps(steps) => {
                let steps = u64::from(steps);
                let k = u64::try_from(number).ok()?.checked_add(steps)?;
                u32::try_from(k.checked_mul(k)?.div_ceil(steps * steps)).ok()
            }
        }
    }
}
