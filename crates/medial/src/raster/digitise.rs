use super::{Grid, Mask, MaskError};
use crate::domain::Domain;
use crate::geom::{Point, Rect, orient2d};

/// Why a domain cannot be put into cells.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DigitiseError {
    /// The size of a cell is no number above 0.
    #[error("a cell of size {0} has no room; give a number above 0")]
    Cell(f64),
    /// There would be too many cells.
    #[error(
        "cells of size {cell} make {columns} columns and {rows} rows; at most {} a side, give a larger cell",
        Mask::MOST
    )]
    TooMany {
        /// The size of a cell.
        cell: f64,
        /// How many columns there would be.
        columns: f64,
        /// How many rows.
        rows: f64,
    },
    /// The grid cannot be used.
    #[error(transparent)]
    Mask(#[from] MaskError),
}

/// The size of a cell where none is given: a thousandth of the longer side of the box around a domain.
#[must_use]
pub fn default_cell(domain: &Domain) -> f64 {
    let bounds = domain.bounds();
    let size = bounds.max - bounds.min;
    size.x.max(size.y) / 1000.0
}

/// A grid of square cells over the box around a domain, with so many cells more on every side; corners of
/// cells are at multiples of their size.
///
/// # Errors
/// If the size is no positive number, or makes too many cells.
pub fn grid_around(domain: &Domain, cell: f64, margin: u32) -> Result<Grid, DigitiseError> {
    if !(cell > 0.0 && cell.is_finite()) {
        return Err(DigitiseError::Cell(cell));
    }
    let Rect { min: low, max: high } = domain.bounds();
    let margin = f64::from(margin);
    let first = [low.x, low.y].map(|low| (low / cell).floor() - margin);
    let last = [high.x, high.y].map(|high| (high / cell).ceil() + margin);
    let [columns, rows] = [last[0] - first[0], last[1] - first[1]];
    let most = f64::from(Mask::MOST);
    if !(columns <= most && rows <= most) {
        return Err(DigitiseError::TooMany { cell, columns, rows });
    }
    let origin = Point::new(first[0] * cell, first[1] * cell);
    Ok(Grid { origin, cell: [cell; 2], columns: columns as u32, rows: rows as u32 })
}

/// The cells of a grid whose centres lie in a domain, decided exactly for the centres as doubles.
///
/// A centre on the boundary belongs to the shape if the shape lies to the right of it, or above.
///
/// # Errors
/// If the grid has too many cells.
pub fn digitise(domain: &Domain, grid: &Grid) -> Result<Mask, MaskError> {
    let mut mask = Mask::empty(*grid)?;
    let mut crossings: Vec<Vec<u32>> = vec![Vec::new(); grid.rows as usize];
    let forwards = grid.cell[0] > 0.0;
    for (number, edge) in (0..).zip(domain.edges()) {
        let (a, b) = (edge.start, domain.end(number));
        let (low, high) = if a.y <= b.y { (a, b) } else { (b, a) };
        for row in rows_between(grid, low.y, high.y) {
            let y = grid.centre(0, row).y;
            if !(low.y <= y && y < high.y) {
                continue;
            }
            let is_beyond = |column: u32| {
                let right = orient2d(low, high, grid.centre(column, row)) <= 0.0;
                right == forwards
            };
            let share = (y - low.y) / (high.y - low.y);
            let x = low.x + (high.x - low.x) * share;
            let [guess, _] = grid.locate(Point::new(x, y));
            let mut column = (guess - 0.5).clamp(0.0, f64::from(grid.columns)) as u32;
            while column > 0 && is_beyond(column - 1) {
                column -= 1;
            }
            while column < grid.columns && !is_beyond(column) {
                column += 1;
            }
            crossings[row as usize].push(column);
        }
    }
    for (row, mut columns) in (0..).zip(crossings) {
        columns.sort_unstable();
        for pair in columns.chunks_exact(2).filter(|pair| pair[0] < pair[1]) {
            mask.fill(row, pair[0], pair[1]);
        }
    }
    Ok(mask)
}

/// Rows whose centres may lie between two heights.
fn rows_between(grid: &Grid, low: f64, high: f64) -> std::ops::Range<u32> {
    let row = |y: f64| grid.locate(Point::new(grid.origin.x, y))[1];
    let (first, last) = (row(low).min(row(high)), row(low).max(row(high)));
    let within = |row: f64| row.clamp(0.0, f64::from(grid.rows)) as u32;
    within((first - 1.0).floor())..within((last + 2.0).ceil())
}

/// The cells of a grid that the boundary of a domain meets, with their sides and corners, decided exactly for
/// the corners as doubles: a supercover.
///
/// # Errors
/// If the grid has too many cells.
pub fn boundary_cells(domain: &Domain, grid: &Grid) -> Result<Mask, MaskError> {
    let mut mask = Mask::empty(*grid)?;
    for (number, edge) in (0..).zip(domain.edges()) {
        let (a, b) = (edge.start, domain.end(number));
        for row in rows_between(grid, a.y.min(b.y), a.y.max(b.y)) {
            let sides = [grid.corner(0, row).y, grid.corner(0, row + 1).y];
            let (bottom, top) = (sides[0].min(sides[1]), sides[0].max(sides[1]));
            if a.y.max(b.y) < bottom || a.y.min(b.y) > top {
                continue;
            }
            // Where the edge is within the row, with a cell to spare on both sides.
            let at = |y: f64| {
                let share = ((y - a.y) / (b.y - a.y)).clamp(0.0, 1.0);
                let share = if share.is_nan() { 0.0 } else { share };
                a.x + (b.x - a.x) * share
            };
            let ends = if a.y == b.y { [a.x, b.x] } else { [at(bottom), at(top)] };
            let [u, v] = ends.map(|x| grid.locate(Point::new(x, bottom))[0]);
            let within = |column: f64| column.clamp(0.0, f64::from(grid.columns)) as u32;
            let columns = within((u.min(v) - 1.0).floor())..within((u.max(v) + 2.0).ceil());
            for column in columns.filter(|&column| meets(grid, column, row, a, b)) {
                mask.put(column, row, true);
            }
        }
    }
    Ok(mask)
}

/// The cells that the boundary of a domain is drawn with: one for each column of a flat edge, one for each row
/// of a steep one, the nearest to the edge, after Bresenham; and those with its ends.
///
/// Cells of one edge are neighbours by sides or corners. Edges are drawn from where they end, not from the
/// centres of the cells there, so no cell drawn is farther than half a cell from its edge, counted across.
///
/// ```
/// use medial::domain::{Domain, Options};
/// use medial::geom::Point;
/// use medial::raster::{grid_around, line_cells};
/// let triangle = [(0., 0.), (4., 0.), (4., 4.)].map(|(x, y)| Point::new(x, y));
/// let domain = Domain::from_polygons(&[vec![triangle.to_vec()]], &Options::default())?;
/// let mask = line_cells(&domain, &grid_around(&domain, 1.0, 1)?)?;
/// // On the diagonal one cell in each row, beside that of the upright side.
/// assert_eq!(mask.cells(2).collect::<Vec<_>>(), [2, 5]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If the grid has too many cells.
pub fn line_cells(domain: &Domain, grid: &Grid) -> Result<Mask, MaskError> {
    let mut mask = Mask::empty(*grid)?;
    for (number, edge) in (0..).zip(domain.edges()) {
        draw(&mut mask, grid.locate(edge.start), grid.locate(domain.end(number)));
    }
    Ok(mask)
}

/// Draws a line between two places, given as columns and rows from the origin.
fn draw(mask: &mut Mask, from: [f64; 2], to: [f64; 2]) {
    let Grid { columns, rows, .. } = *mask.grid();
    let mut put = |column: f64, row: f64| {
        let (x, y) = (column.floor(), row.floor());
        if 0.0 <= x && x < f64::from(columns) && 0.0 <= y && y < f64::from(rows) {
            mask.bits.set(x as i32, y as i32);
        }
    };
    put(from[0], from[1]);
    put(to[0], to[1]);
    // Along the columns of a flat line, along the rows of a steep one.
    let is_steep = (to[1] - from[1]).abs() > (to[0] - from[0]).abs();
    let (long, short) = if is_steep { (1, 0) } else { (0, 1) };
    let (a, b) = if from[long] <= to[long] { (from, to) } else { (to, from) };
    if a[long] == b[long] {
        return;
    }
    let slope = (b[short] - a[short]) / (b[long] - a[long]);
    let n = f64::from(if is_steep { rows } else { columns });
    let mut at = (a[long] - 0.5).ceil().max(0.0) + 0.5;
    while at <= b[long] && at < n {
        let across = a[short] + (at - a[long]) * slope;
        if is_steep {
            put(across, at)
        } else {
            put(at, across)
        }
        at += 1.0;
    }
}

/// Whether a closed cell meets a closed segment.
fn meets(grid: &Grid, column: u32, row: u32, a: Point, b: Point) -> bool {
    let corners = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(x, y)| grid.corner(column + x, row + y));
    let (p, q) = (corners[0], corners[2]);
    let apart = |a: f64, b: f64, p: f64, q: f64| a.max(b) < p.min(q) || a.min(b) > p.max(q);
    if apart(a.x, b.x, p.x, q.x) || apart(a.y, b.y, p.y, q.y) {
        return false;
    }
    let sides = corners.map(|corner| orient2d(a, b, corner));
    !sides.iter().all(|&side| side > 0.0) && !sides.iter().all(|&side| side < 0.0)
}
