//! From pixel to pixel along the ridges (III.A, A.3).

use super::nearest::{Searcher, Two};
use crate::engine::EngineError;
use crate::engine::watch::Watch;
use crate::geom::Point;
use crate::raster::{Bits, Grid};

/// A medial pixel: the `Medial_Node` of the report (A.1.e).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RidgePixel {
    /// Column in the array.
    pub column: u32,
    /// Row in the array.
    pub row: u32,
    /// Its centre; a better point within it where the rule of five by five pixels found one.
    pub position: Point,
    /// Distance of that point from the nearest edge, in units of the plane.
    pub radius: f64,
    /// By how much farther the second edge is: the lower, the nearer to the true axis.
    pub quality: f64,
}

/// The eight neighbours of a pixel.
const AROUND: [[i32; 2]; 8] =
    [[1, 0], [1, 1], [0, 1], [-1, 1], [-1, 0], [-1, -1], [0, -1], [1, -1]];

/// The maps of the report, and what was found so far.
pub(super) struct Field<'a> {
    pub grid: &'a Grid,
    /// Pixels of the side of the axis that are not on its boundary.
    pub open: Bits,
    /// The `Boundary_Map`.
    pub boundary: Bits,
    /// The `Checked_Map`.
    pub checked: Bits,
    pub searcher: Searcher<'a>,
    /// The quality below which a pixel is medial.
    pub tolerance: f64,
    pub watch: &'a Watch<'a>,
    pub found: Vec<RidgePixel>,
    /// Sets of medial pixels that steps lead through.
    pub components: u32,
    pub n_tested: u64,
    /// Pixels whose neighbours are still to be looked at.
    pub stack: Vec<[i32; 2]>,
}

impl Field<'_> {
    /// The centre of a pixel, from the origin of the grid.
    fn centre(&self, x: i32, y: i32) -> Point {
        let [width, height] = self.grid.cell;
        Point::new((f64::from(x) + 0.5) * width, (f64::from(y) + 0.5) * height)
    }

    /// The quality of a pixel, which is checked now; it waits on the stack if it is medial.
    fn test(&mut self, x: i32, y: i32) -> Result<f64, EngineError> {
        if self.searcher.takes_long() {
            self.watch.check_now()?
        } else {
            self.watch.check()?
        }
        self.checked.set(x, y);
        self.n_tested += 1;
        let two = self.searcher.two(self.centre(x, y));
        let quality = two.quality();
        if quality < self.tolerance {
            let (column, row) = (x as u32, y as u32);
            let position = self.grid.centre(column, row);
            let radius = two.first.squared.sqrt();
            self.found.push(RidgePixel { column, row, position, radius, quality });
            self.stack.push([x, y]);
        }
        Ok(quality)
    }

    /// The two nearest edges of a place within a pixel, given by its shares of the sides.
    pub fn two_within(&mut self, x: i32, y: i32, [u, v]: [f64; 2]) -> (Point, Two) {
        let [width, height] = self.grid.cell;
        let at = self.centre(x, y) + Point::new((u - 0.5) * width, (v - 0.5) * height);
        let position = self.grid.place(f64::from(x) + u, f64::from(y) + v);
        (position, self.searcher.two(at))
    }

    /// Whether a step goes diagonally over the boundary, both pixels beside it being drawn.
    pub fn crosses(&self, [x, y]: [i32; 2], [dx, dy]: [i32; 2]) -> bool {
        dx != 0 && dy != 0 && self.boundary.get(x + dx, y) && self.boundary.get(x, y + dy)
    }

    /// Finds the medial pixels that steps lead to from the ones on the stack: one set of them.
    fn follow(&mut self) -> Result<(), EngineError> {
        self.components += 1;
        while let Some([x, y]) = self.stack.pop() {
            for [dx, dy] in AROUND {
                let (u, v) = (x + dx, y + dy);
                if self.open.get(u, v) && !self.checked.get(u, v) && !self.crosses([x, y], [dx, dy])
                {
                    self.test(u, v)?;
                }
            }
        }
        Ok(())
    }

    /// The pixel with the interior point that the report finds; where that is on the boundary, the middle of
    /// the longest run in the row of pixels halfway up.
    fn seed(&self, point: Point, [low, high]: [Point; 2]) -> Option<[i32; 2]> {
        let [width, height] = self.grid.cell;
        let pixel = |p: Point| [(p.x / width).floor() as i32, (p.y / height).floor() as i32];
        let within = |[x, y]: [i32; 2]| {
            (0..self.open.columns() as i32).contains(&x)
                && (0..self.open.rows() as i32).contains(&y)
        };
        let own = pixel(point);
        if within(own) && self.open.get(own[0], own[1]) {
            return Some(own);
        }
        let ([left, _], [right, _]) = (pixel(low), pixel(high));
        let row = pixel((low + high) * 0.5)[1];
        if !within([0, row]) {
            return None;
        }
        let (left, right) = (left.min(right), left.max(right));
        let runs = self.open.runs(row as u32).map(|(from, to)| (from as i32, to as i32));
        let inside = runs.filter(|&(from, to)| left <= from && to <= right + 1);
        let longest = inside.max_by_key(|&(from, to)| (to - from, -from))?;
        Some([(longest.0 + longest.1) / 2, row])
    }

    /// Looks for the first medial pixel above and below an interior point, and leaves it on the stack.
    pub fn first(&mut self, point: Point, bounds: [Point; 2]) -> Result<(), EngineError> {
        let Some([x, y]) = self.seed(point, bounds) else { return Ok(()) };
        let mut heights = [Some(y), Some(y - 1)];
        while heights.iter().any(Option::is_some) {
            for (height, step) in heights.iter_mut().zip([1, -1]) {
                let Some(at) = *height else { continue };
                if !self.open.get(x, at) {
                    *height = None;
                    continue;
                }
                *height = Some(at + step);
                // What was checked for another seed belongs to what that led to.
                if !self.checked.get(x, at) && self.test(x, at)? < self.tolerance {
                    return Ok(());
                }
            }
        }
        Ok(())
    }

    /// Follows ridges from the pixel on the stack, if there is one.
    pub fn rest(&mut self) -> Result<(), EngineError> {
        if self.stack.is_empty() { Ok(()) } else { self.follow() }
    }

    /// Finds all medial pixels that no step led to, and what they lead to.
    ///
    /// Both distances change by no more than the way one goes, so after a pixel that is far from medial comes
    /// none for a while.
    pub fn scan(&mut self) -> Result<(), EngineError> {
        let width = self.grid.cell[0].abs();
        let mut runs = Vec::new();
        for y in 0..self.open.rows() {
            runs.clear();
            runs.extend(self.open.runs(y));
            for &(from, to) in &runs {
                let (mut x, to, y) = (from as i32, to as i32, y as i32);
                while x < to {
                    let is_new = !self.checked.get(x, y);
                    let quality = if is_new { self.test(x, y)? } else { self.tolerance };
                    self.rest()?;
                    let idle = (quality - self.tolerance) / (2.0 * width);
                    let idle = if idle > 0.0 && idle.is_finite() { idle.floor() } else { 0.0 };
                    x = (f64::from(x) + idle + 1.0).min(f64::from(to)) as i32;
                }
            }
        }
        Ok(())
    }

    /// Takes in what medial pixels enclose: pixels inside from which no way along sides leads to the boundary but
    /// over medial ones. They are no holes of the shape, only not as good as those around them.
    pub fn take_islands(&mut self) -> Result<(), EngineError> {
        let mut islands = self.open.clone();
        for pixel in &self.found {
            islands.clear(pixel.column as i32, pixel.row as i32);
        }
        let sides = [[1, 0], [0, 1], [-1, 0], [0, -1]];
        let mut stack = Vec::new();
        for y in 0..self.open.rows() as i32 {
            self.watch.check()?;
            for (from, to) in self.open.runs(y as u32) {
                for x in from as i32..to as i32 {
                    let is_last = sides.iter().any(|[dx, dy]| !self.open.get(x + dx, y + dy));
                    if is_last && islands.get(x, y) {
                        islands.clear(x, y);
                        stack.push([x, y]);
                    }
                }
            }
            while let Some([x, y]) = stack.pop() {
                for [dx, dy] in sides {
                    if islands.get(x + dx, y + dy) {
                        islands.clear(x + dx, y + dy);
                        stack.push([x + dx, y + dy]);
                    }
                }
            }
        }
        for row in 0..islands.rows() {
            self.watch.check()?;
            for column in islands.ones(row) {
                let (position, two) = self.two_within(column as i32, row as i32, [0.5; 2]);
                let (radius, quality) = (two.first.squared.sqrt(), two.quality());
                self.found.push(RidgePixel { column, row, position, radius, quality });
            }
        }
        Ok(())
    }
}
