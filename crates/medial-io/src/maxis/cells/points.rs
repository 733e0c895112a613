//! Disks or squares, row by row.

use super::coder::{Coder, Numbers};
use super::sizes::{Sizes, Unit};
use super::{Fault, Rows, check};
use medial::ops::{Ball, BallShape};
use medial::raster::Grid;

/// Codes balls; given are those to be coded, row by row.
pub fn code(
    coder: &mut impl Coder,
    grid: &Grid,
    unit: Unit,
    balls: &[Ball],
) -> Result<Vec<Ball>, Fault> {
    let mut header = Numbers::default();
    let largest = balls.iter().map(|ball| ball.size).max().unwrap_or(1);
    let largest = header.code(coder, largest.into());
    let largest = u32::try_from(largest).map_err(|_| "a disk is too large".to_owned())?;
    let sizes = Sizes::new(unit, largest);
    // What does not count squares of distances is no disk.
    let shape = if unit == Unit::Plain { None } else { Some(BallShape::Disk) };
    let n = header.code(coder, balls.len() as u64);
    let (mut rows, mut numbers) = (Rows::new(grid.columns, grid.rows), Numbers::default());
    let mut found = Vec::new();
    for k in 0..n {
        check(coder)?;
        let given = balls.get(k as usize);
        let [x, y] = rows.code(coder, given.map_or([0, 0], |ball| [ball.x, ball.y]))?;
        let number = numbers.code(coder, given.map_or(0, |ball| sizes.number(ball.size)) as u64);
        let ball = sizes.size(number as i64).map(|size| Ball { y, x, size });
        let fits = |ball: &Ball| shape.is_none_or(|shape| ball.fits(shape, grid));
        let ball = ball
            .filter(fits)
            .ok_or_else(|| format!("the disk at column {x}, row {y} lies outside of the cells"))?;
        found.push(ball);
    }
    Ok(found)
}
