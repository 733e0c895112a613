//! One point of every hole of a polygon, in the cells of a grid.

use std::ops::Range;

use super::rings::Pockets;
use crate::domain::Domain;
use crate::geom::{Point, Rect};

/// Cells, and holes in them, that a question looks at before it is given up.
const MOST_CELLS: usize = 64;
const MOST_HOLES: usize = 64;

/// A point of a hole's boundary walk.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Hole {
    pub at: Point,
    pub walk: u32,
}

/// About one hole to a cell, if they are spread evenly.
#[derive(Debug)]
pub(super) struct Holes {
    /// Cell by cell, row by row.
    holes: Vec<Hole>,
    /// First hole of each cell, and the end of the last one.
    starts: Vec<u32>,
    columns: usize,
    rows: usize,
    corner: Point,
    /// Cells to a length, each way.
    scale: Point,
}

impl Holes {
    /// The holes among the given walks.
    pub fn new(domain: &Domain, walks: Range<usize>) -> Self {
        let of = |number: usize| {
            let walk = &domain.walks()[number];
            walk.hole.then(|| Hole { at: domain.edge(walk.first).start, walk: number as u32 })
        };
        let unsorted: Vec<Hole> = walks.filter_map(of).collect();
        let bounds = unsorted.iter().fold(Rect::EMPTY, |all, hole| all.with(hole.at));
        let size = bounds.max - bounds.min;
        let longer = size.x.max(size.y).max(f64::MIN_POSITIVE);
        // As many cells as holes, about square ones.
        let count = unsorted.len().max(1);
        let cell = (size.x / longer * (size.y / longer) / count as f64).sqrt();
        let cell = longer * cell.max(1.0 / count as f64);
        let number = |size: f64| ((size / cell).ceil() as usize).clamp(1, count);
        let (columns, rows) = (number(size.x), number(size.y));
        let mut grid = Self {
            holes: vec![Hole::default(); unsorted.len()],
            starts: vec![0; columns * rows + 2],
            columns,
            rows,
            corner: bounds.min,
            scale: Point::new(
                columns as f64 / size.x.max(f64::MIN_POSITIVE),
                rows as f64 / size.y.max(f64::MIN_POSITIVE),
            ),
        };
        let cell = |grid: &Self, at: Point| {
            let (column, row) = grid.cell(at);
            row * columns + column
        };
        for hole in &unsorted {
            let cell = cell(&grid, hole.at);
            grid.starts[cell + 2] += 1;
        }
        for k in 2..grid.starts.len() {
            grid.starts[k] += grid.starts[k - 1];
        }
        for hole in unsorted {
            let cell = cell(&grid, hole.at);
            let place = &mut grid.starts[cell + 1];
            grid.holes[*place as usize] = hole;
            *place += 1;
        }
        grid
    }

    /// Column and row of a point; those next to it for a point outside.
    #[inline]
    fn cell(&self, at: Point) -> (usize, usize) {
        let place = at - self.corner;
        let (x, y) = ((place.x * self.scale.x) as usize, (place.y * self.scale.y) as usize);
        (x.min(self.columns - 1), y.min(self.rows - 1))
    }

    /// All of them, in some order.
    pub fn all(&self) -> &[Hole] {
        &self.holes
    }

    /// Gives the walks of the holes that may lie in one of some pockets as a whole, until `suspect` says
    /// no; false, and nothing given, where that would take long.
    pub fn each(&self, pockets: &Pockets, suspect: &mut dyn FnMut(u32) -> bool) -> bool {
        let Rect { min, max } = pockets.bounds;
        let ((left, low), (right, high)) = (self.cell(min), self.cell(max));
        let width = (right + 1).saturating_sub(left);
        if (high + 1).saturating_sub(low) * width > MOST_CELLS {
            return false;
        }
        // Cells of a row lie side by side.
        let row = |row: usize| {
            let first = self.starts[row * self.columns + left] as usize;
            first..self.starts[row * self.columns + right + 1] as usize
        };
        if (low..=high).map(|k| row(k).len()).sum::<usize>() > MOST_HOLES {
            return false;
        }
        for k in low..=high {
            for hole in &self.holes[row(k)] {
                if pockets.may_hold(hole.at, hole.walk) && !suspect(hole.walk) {
                    return true;
                }
            }
        }
        true
    }
}
