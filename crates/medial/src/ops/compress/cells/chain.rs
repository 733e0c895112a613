//! Chains of medial cells.

use super::CellError;
use super::balls::{Ball, BallShape, Widths, spans, union};
use super::difference::{Difference, difference};
use crate::engine::{Options, Skeleton};
use crate::raster::{Bits, Grid, Mask, SIMPLE, WINDOW_RING};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// The medial cells of a mask with their disks, row by row, and what they lack.
///
/// Radii are rounded down to steps of a cell, unless no threshold is given.
pub(super) fn of(
    mask: &Mask,
    residual: Option<f64>,
    radius_steps: u32,
) -> Result<(Vec<Ball>, Difference), CellError> {
    let balls = medial_balls(mask, residual)?;
    let steps = if residual.is_none() { 0 } else { radius_steps };
    let balls: Vec<Ball> =
        balls.into_iter().map(|ball| Ball { size: rounded(ball.size, steps), ..ball }).collect();
    let balls = without_idle_ends(mask, balls);
    let difference = match residual {
        None => Difference { error: 0.0, missing: 0 },
        Some(_) => difference(mask, &union(mask.grid(), BallShape::Disk, &balls)?),
    };
    Ok((balls, difference))
}

/// The medial cells of a mask with the squares of their distances, as if cells were squares.
pub(super) fn medial_balls(mask: &Mask, residual: Option<f64>) -> Result<Vec<Ball>, CellError> {
    let square = square(mask)?;
    let skeleton = Skeleton::new(&square, &Options { residual, ..Options::default() })?;
    let rows = 0..mask.grid().rows;
    let ball = |x, y| {
        let (dx, dy) = skeleton.foot(x, y).unwrap_or((1, 0));
        Ball { y, x, size: dx.unsigned_abs().pow(2) + dy.unsigned_abs().pow(2) }
    };
    Ok(rows
        .flat_map(|y| skeleton.cells().cells(y).map(move |x| (x, y)))
        .map(|(x, y)| ball(x, y))
        .collect())
}

/// The same cells, each of width and height 1.
fn square(mask: &Mask) -> Result<Mask, CellError> {
    let Grid { columns, rows, .. } = *mask.grid();
    Ok(Mask::empty(Grid::of_image(columns, rows))?.with_bits(mask.bits.clone()))
}

/// The square of a distance, rounded down to steps of a cell; never below 1.
fn rounded(squared: u32, steps: u32) -> u32 {
    if steps == 0 {
        return squared;
    }
    let steps = u64::from(steps);
    let k = (u64::from(squared) * steps * steps).isqrt().max(steps);
    // Whole squares of distances are below that of the step if they are below the next whole number.
    (k * k).div_ceil(steps * steps) as u32
}

/// Takes cells off free ends, smallest disks first, for as long as the union of the disks is the same.
fn without_idle_ends(mask: &Mask, balls: Vec<Ball>) -> Vec<Ball> {
    let Grid { columns, rows, .. } = *mask.grid();
    let mut widths = Widths::new(BallShape::Disk);
    // How many disks each cell lies in.
    let mut depth = vec![0_u32; columns as usize * rows as usize];
    let place = |row: u32, column: u32| row as usize * columns as usize + column as usize;
    let mut cells = Bits::new(columns, rows);
    for ball in &balls {
        cells.set(ball.x as i32, ball.y as i32);
        spans(ball, widths.of(ball.size), |row, from, to| {
            depth[place(row, from)..place(row, to)].iter_mut().for_each(|depth| *depth += 1);
        });
    }
    let may_go = |cells: &Bits, ball: &Ball| {
        let window = cells.window(ball.x as i32, ball.y as i32);
        SIMPLE[usize::from(window)] && (window & WINDOW_RING).count_ones() <= 2
    };
    let mut waiting: BinaryHeap<Reverse<(u32, usize)>> = (0..)
        .zip(&balls)
        .filter(|(_, ball)| may_go(&cells, ball))
        .map(|(number, ball)| Reverse((ball.size, number)))
        .collect();
    let mut dropped = vec![false; balls.len()];
    while let Some(Reverse((_, number))) = waiting.pop() {
        let ball = &balls[number];
        if dropped[number] || !may_go(&cells, ball) {
            continue;
        }
        let own = widths.of(ball.size);
        let mut idle = true;
        spans(ball, own, |row, from, to| {
            idle = idle && depth[place(row, from)..place(row, to)].iter().all(|&depth| depth > 1);
        });
        if !idle {
            continue;
        }
        spans(ball, own, |row, from, to| {
            depth[place(row, from)..place(row, to)].iter_mut().for_each(|depth| *depth -= 1);
        });
        cells.clear(ball.x as i32, ball.y as i32);
        dropped[number] = true;
        for dy in -1..=1 {
            for dx in -1..=1 {
                let (x, y) = (ball.x as i32 + dx, ball.y as i32 + dy);
                if !cells.get(x, y) {
                    continue;
                }
                let there = balls.binary_search_by_key(&(y as u32, x as u32), |b| (b.y, b.x));
                if let Some(there) = there.ok().filter(|&there| may_go(&cells, &balls[there])) {
                    waiting.push(Reverse((balls[there].size, there)));
                }
            }
        }
    }
    let mut dropped = dropped.into_iter();
    let mut balls = balls;
    balls.retain(|_| !dropped.next().unwrap_or(false));
    balls
}
