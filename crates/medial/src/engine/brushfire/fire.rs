//! What all ways to burn share: the cells that are left, where the fire is, and when it came where.

use crate::engine::EngineError;
use crate::engine::watch::Watch;
use crate::raster::Bits;

/// A shape on fire.
///
/// A cell burns by what stands around it, so after a pass only cells near those that burnt may do so in the next.
pub(super) struct Fire<'w> {
    pub cells: Bits,
    /// Cells that may burn in this pass.
    pub active: Vec<[i32; 2]>,
    /// Whether a cell is in that list.
    listed: Bits,
    /// Cells that burnt in this pass.
    burnt: Vec<[i32; 2]>,
    /// How far from a cell that burnt others may be that burn now.
    reach: i32,
    /// The pass before which the fire stood at a side of each cell, row by row; 0 for none.
    times: Vec<u16>,
    /// Passes so far, with this one.
    pub passes: u16,
    pub watch: &'w Watch<'w>,
}

/// The four neighbours by sides.
const SIDES: [[i32; 2]; 4] = [[0, -1], [0, 1], [1, 0], [-1, 0]];

impl<'w> Fire<'w> {
    pub fn new(cells: Bits, watch: &'w Watch<'w>) -> Self {
        let (columns, rows) = (cells.columns(), cells.rows());
        let mut fire = Self {
            listed: Bits::new(columns, rows),
            active: Vec::new(),
            burnt: Vec::new(),
            reach: 1,
            times: vec![0; columns as usize * rows as usize],
            passes: 0,
            watch,
            cells,
        };
        for y in 0..rows as i32 {
            for (from, to) in fire.cells.runs(y as u32) {
                for x in from as i32..to as i32 {
                    if is_border(fire.cells.window(x, y)) {
                        let at = place(columns, [x, y]);
                        fire.times[at] = 1;
                    }
                }
            }
        }
        fire
    }

    /// Burns pass by pass until one takes nothing. A pass may have parts; what burns in one may make cells burn in
    /// the next.
    pub fn burn(
        &mut self,
        reach: i32,
        mut pass: impl FnMut(&mut Self) -> Result<(), EngineError>,
    ) -> Result<(), EngineError> {
        self.reach = reach;
        self.light();
        while !self.active.is_empty() {
            self.watch.check_now()?;
            self.passes = self.passes.saturating_add(1);
            pass(self)?;
            if self.burnt.is_empty() {
                self.passes -= 1;
            }
            self.spread();
        }
        Ok(())
    }

    /// Puts all cells that are not surrounded on the list.
    fn light(&mut self) {
        self.active.clear();
        for y in 0..self.cells.rows() as i32 {
            for (from, to) in self.cells.runs(y as u32) {
                for x in from as i32..to as i32 {
                    if self.cells.window(x, y) != 0x1ff {
                        self.active.push([x, y]);
                    }
                }
            }
        }
        for &[x, y] in &self.active {
            self.listed.set(x, y);
        }
    }

    /// Takes a cell away.
    pub fn take(&mut self, [x, y]: [i32; 2]) {
        self.cells.clear(x, y);
        self.burnt.push([x, y]);
        for [dx, dy] in SIDES {
            let (u, v) = (x + dx, y + dy);
            if self.cells.get(u, v) {
                let time = &mut self.times[place(self.cells.columns(), [u, v])];
                if *time == 0 {
                    *time = self.passes.saturating_add(1);
                }
            }
        }
    }

    /// Takes those cells of the list away at once that should go by what stands now.
    pub fn take_where(
        &mut self,
        mut goes: impl FnMut(&Bits, [i32; 2]) -> bool,
    ) -> Result<(), EngineError> {
        let mut going = Vec::new();
        for &[x, y] in &self.active {
            self.watch.check()?;
            if self.cells.get(x, y) && goes(&self.cells, [x, y]) {
                going.push([x, y]);
            }
        }
        let first = self.burnt.len();
        going.into_iter().for_each(|cell| self.take(cell));
        // What is beside them may go in the next part of the pass.
        for k in first..self.burnt.len() {
            self.list_around(k);
        }
        Ok(())
    }

    fn list_around(&mut self, burnt: usize) {
        let [x, y] = self.burnt[burnt];
        let (columns, rows) = (self.cells.columns() as i32, self.cells.rows() as i32);
        for v in (y - self.reach).max(0)..=(y + self.reach).min(rows - 1) {
            for u in (x - self.reach).max(0)..=(x + self.reach).min(columns - 1) {
                if self.cells.get(u, v) && !self.listed.get(u, v) {
                    self.listed.set(u, v);
                    self.active.push([u, v]);
                }
            }
        }
    }

    /// Makes the list of the next pass.
    fn spread(&mut self) {
        for &[x, y] in &self.active {
            self.listed.clear(x, y);
        }
        self.active.clear();
        for k in 0..self.burnt.len() {
            self.list_around(k);
        }
        self.burnt.clear();
    }

    /// What is left, when the fire came where, and how many passes there were.
    pub fn finish(mut self) -> (Bits, Vec<u16>, u16) {
        // In the middle of a cross the fire never stood at a side.
        for y in 0..self.cells.rows() {
            for x in self.cells.ones(y) {
                let at = [x as i32, y as i32];
                let own = place(self.cells.columns(), at);
                if self.times[own] != 0 {
                    continue;
                }
                let sides = SIDES.map(|[dx, dy]| [at[0] + dx, at[1] + dy]);
                let around = sides.iter().filter(|&&[u, v]| self.cells.get(u, v));
                let times = around.map(|&side| self.times[place(self.cells.columns(), side)]);
                let least = times.filter(|&time| time > 0).min();
                self.times[own] = least.unwrap_or(self.passes).saturating_add(1);
            }
        }
        (self.cells, self.times, self.passes)
    }
}

/// The place of a cell in a list of all, row by row.
pub(super) fn place(columns: u32, [x, y]: [i32; 2]) -> usize {
    y as usize * columns as usize + x as usize
}

/// The four sides in a window.
const WINDOW_SIDES: u16 = 1 << 1 | 1 << 3 | 1 << 5 | 1 << 7;

/// Whether a side of the cell in the middle of a window is not covered.
pub(super) fn is_border(window: u16) -> bool {
    window & WINDOW_SIDES != WINDOW_SIDES
}
