//! The holes of a polygon, in the cells of a grid: what may hide, and what a path may meet.

use std::ops::Range;

use smallvec::SmallVec;

use super::rings::Pockets;
use super::search::Start;
use crate::domain::{Domain, Walk};
use crate::geom::{Point, Rect, TouchingDisk};

/// Cells, and holes in them, that a question looks at before it is given up.
const MOST_CELLS: usize = 64;
const MOST_HOLES: usize = 64;

/// Edges of a hole that is looked at by itself, and such holes for one disk.
const MOST_EDGES: u32 = 16;
const MOST_AHEAD: usize = 3;

/// A hole, and about where it is.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Hole {
    /// Middle of its corners, from the corner of the grid, and about their distance from there; in
    /// sizes of the grid. The radius is negative if there are many.
    x: f32,
    y: f32,
    radius: f32,
    pub walk: u32,
}

/// A point of a hole's boundary walk.
pub(super) fn point(domain: &Domain, walk: u32) -> Point {
    domain.edge(domain.walks()[walk as usize].first).start
}

impl Hole {
    fn new(domain: &Domain, walk: u32, corner: Point, size: f64) -> Self {
        let Walk { first, len, .. } = domain.walks()[walk as usize];
        if len > MOST_EDGES {
            return Self { x: 0.0, y: 0.0, radius: -1.0, walk };
        }
        let at = domain.edge(first).start;
        let share = 1.0 / f64::from(len);
        let corners = || (first..first + len).map(|k| domain.edge(k).start - at);
        let centre = corners().fold(Point::default(), |sum, p| sum + p) * share;
        let radius = corners().map(|p| (p - centre).norm()).sum::<f64>() * share;
        let Point { x, y } = (centre + (at - corner)) * (1.0 / size);
        Self { x: x as f32, y: y as f32, radius: (radius / size) as f32, walk }
    }
}

/// Holes ahead of a path.
pub(super) type Ahead = SmallVec<[(f64, u32); 16]>;

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
    /// Length in which holes are measured.
    size: f64,
}

impl Holes {
    /// The holes among the given walks.
    pub fn new(domain: &Domain, walks: Range<usize>) -> Self {
        let walks = || {
            let holes = walks.clone().filter(|&walk| domain.walks()[walk].hole);
            holes.map(|walk| (walk as u32, point(domain, walk as u32)))
        };
        let (bounds, n_holes) =
            walks().fold((Rect::EMPTY, 0), |(all, n), (_, at)| (all.with(at), n + 1));
        let size = bounds.max - bounds.min;
        let longer = size.x.max(size.y).max(f64::MIN_POSITIVE);
        // As many cells as holes, about square ones.
        let count = n_holes.max(1);
        let cell = (size.x / longer * (size.y / longer) / count as f64).sqrt();
        let cell = longer * cell.max(1.0 / count as f64);
        let number = |size: f64| ((size / cell).ceil() as usize).clamp(1, count);
        let (columns, rows) = (number(size.x), number(size.y));
        let mut grid = Self {
            holes: vec![Hole::default(); n_holes],
            starts: vec![0; columns * rows + 2],
            columns,
            rows,
            corner: bounds.min,
            scale: Point::new(
                columns as f64 / size.x.max(f64::MIN_POSITIVE),
                rows as f64 / size.y.max(f64::MIN_POSITIVE),
            ),
            size: if size == Point::default() { 1.0 } else { longer },
        };
        let cell = |grid: &Self, at: Point| {
            let (column, row) = grid.cell(at);
            row * columns + column
        };
        for (_, at) in walks() {
            let cell = cell(&grid, at);
            grid.starts[cell + 2] += 1;
        }
        for k in 2..grid.starts.len() {
            grid.starts[k] += grid.starts[k - 1];
        }
        for (walk, at) in walks() {
            let cell = cell(&grid, at);
            let place = &mut grid.starts[cell + 1];
            grid.holes[*place as usize] = Hole::new(domain, walk, grid.corner, grid.size);
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

    /// See [`super::rings::Rings::ahead`].
    pub fn ahead(&self, start: &Start, disk: &TouchingDisk, own: [u32; 2]) -> Ahead {
        let mut ahead = Ahead::new();
        let per = 1.0 / self.size;
        let local = |p: Point| (p - self.corner) * per;
        let centre = disk.position();
        let reach = Point::new(disk.radius, disk.radius);
        let ((left, low), (right, high)) = (self.cell(centre - reach), self.cell(centre + reach));
        if (high + 1).saturating_sub(low) * (right + 1).saturating_sub(left) > MOST_CELLS {
            return ahead;
        }
        let (to, from) =
            ((local(centre), disk.radius * per), (local(start.centre), start.radius * per));
        for k in low..=high {
            let first = self.starts[k * self.columns + left] as usize;
            let end = self.starts[k * self.columns + right + 1] as usize;
            if end - first > MOST_HOLES {
                return Ahead::new();
            }
            for hole in &self.holes[first..end] {
                let at = Point::new(f64::from(hole.x), f64::from(hole.y));
                let size = f64::from(hole.radius);
                let (inner, outer) = (to.1 + size, from.1 + size);
                let inside = inner * inner - (to.0 - at).norm2();
                if inside > 0.0 && size >= 0.0 && !own.contains(&hole.walk) {
                    let outside = (from.0 - at).norm2() - outer * outer;
                    ahead.push((outside / (outside + inside), hole.walk));
                }
            }
        }
        ahead.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        ahead.truncate(MOST_AHEAD);
        ahead
    }

    /// All of them, in some order.
    pub fn all(&self) -> &[Hole] {
        &self.holes
    }

    /// Gives the walks of the holes that may lie in one of some pockets as a whole, until `suspect` says
    /// no; false, and nothing given, where that would take long.
    pub fn each(
        &self,
        domain: &Domain,
        pockets: &Pockets,
        suspect: &mut dyn FnMut(u32) -> bool,
    ) -> bool {
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
                if pockets.may_hold(point(domain, hole.walk), hole.walk) && !suspect(hole.walk) {
                    return true;
                }
            }
        }
        true
    }
}
