//! Disks on a grid, and which of them are linked.

use crate::axis::Engine;
use crate::geom::Point;

/// Largest whole number of a grid: doubles have all of them, and their multiples of powers of two.
const LARGEST: u64 = 1 << 52;

/// The error is kept in parts of the grid: two to the power of this make up one step of it.
const ERROR_PARTS: i32 = 4;

/// Exponents of grids whose points are ordinary doubles.
const EXPONENTS: std::ops::RangeInclusive<i32> = -300..=300;

/// A disk on a grid, in steps of that grid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct GridDisk {
    /// Abscissa of the centre.
    pub x: i64,
    /// Ordinate of the centre.
    pub y: i64,
    /// Radius; 0 is a point.
    pub radius: i64,
}

/// Disks that are linked one after another.
///
/// Disks are numbered from 0, in the order of the runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Run {
    /// The disk of an earlier run where it begins; `None` if it begins with a disk of its own.
    pub from: Option<u32>,
    /// How many disks are its own.
    pub len: u32,
    /// A disk that is there already, its own ones included, to which its last disk is linked.
    pub to: Option<u32>,
}

/// A shape as the union of disks on a grid, and of those between disks that are linked: their centres
/// and radii are linear from one to the other.
#[derive(Clone, Debug, PartialEq)]
pub struct DiskGraph {
    engine: Engine,
    /// A step of the grid is two to the power of this.
    exponent: i32,
    /// The error in sixteenths of a step.
    error: u64,
    /// As many as the runs have; no coordinate is larger than 2^52 steps and no radius is negative.
    disks: Vec<GridDisk>,
    /// Each begins and ends with a disk that is there by then, and holds at least one disk or link.
    runs: Vec<Run>,
}

impl DiskGraph {
    /// The graph of these disks, which are within `error` of a shape, in units of the input; it is
    /// rounded up to a sixteenth of a step of the grid, which is two to the power of `exponent`.
    ///
    /// Returns `None` if a disk is off the grid, or a run names a disk that is not there, or has none,
    /// or if the exponent is not between -300 and 300, or the error out of range.
    #[must_use]
    pub fn new(
        engine: Engine,
        exponent: i32,
        error: f64,
        disks: Vec<GridDisk>,
        runs: Vec<Run>,
    ) -> Option<Self> {
        let parts = (error / part(exponent)?).ceil();
        let fits = (0.0..=LARGEST as f64).contains(&parts);
        fits.then(|| Self::from_parts(engine, exponent, parts as u64, disks, runs)).flatten()
    }

    /// The same with the error in sixteenths of a step, as files have it.
    #[must_use]
    pub fn from_parts(
        engine: Engine,
        exponent: i32,
        error: u64,
        disks: Vec<GridDisk>,
        runs: Vec<Run>,
    ) -> Option<Self> {
        part(exponent)?;
        let fits = |disk: &GridDisk| {
            let largest = disk.x.unsigned_abs().max(disk.y.unsigned_abs());
            largest.max(disk.radius.unsigned_abs()) <= LARGEST && disk.radius >= 0
        };
        if error > LARGEST || u32::try_from(disks.len()).is_err() || !disks.iter().all(fits) {
            return None;
        }
        let mut known: u32 = 0;
        for run in &runs {
            let begins = run.from.is_none_or(|disk| disk < known);
            known = known.checked_add(run.len)?;
            let ends = run.to.is_none_or(|disk| disk < known);
            let holds =
                if run.from.is_some() { run.len > 0 || run.to.is_some() } else { run.len > 0 };
            if !(begins && ends && holds) {
                return None;
            }
        }
        (known as usize == disks.len()).then_some(Self { engine, exponent, error, disks, runs })
    }

    /// The largest error up to this one that a graph can have, in units of the input.
    pub(super) fn whole_error(exponent: i32, error: f64) -> Option<f64> {
        let part = part(exponent)?;
        Some((error / part).floor() * part)
    }

    /// Who computed the axis of which the disks are.
    #[must_use]
    pub fn engine(&self) -> Engine {
        self.engine
    }

    /// A step of the grid is two to the power of this, in units of the input.
    #[must_use]
    pub fn exponent(&self) -> i32 {
        self.exponent
    }

    /// The error in sixteenths of a step of the grid.
    #[must_use]
    pub fn error_parts(&self) -> u64 {
        self.error
    }

    /// How far the boundary of the shape of the disks and the original one are apart at most, in units
    /// of the input.
    #[must_use]
    pub fn error(&self) -> f64 {
        self.error as f64 * step(self.exponent - ERROR_PARTS)
    }

    /// The disks in steps of the grid.
    #[must_use]
    pub fn disks(&self) -> &[GridDisk] {
        &self.disks
    }

    /// The runs in which they are linked.
    #[must_use]
    pub fn runs(&self) -> &[Run] {
        &self.runs
    }

    /// About how many bits the graph takes in a file: to choose between graphs.
    pub(super) fn cost(&self) -> u64 {
        /// What begins a run, and what a number takes besides its own bits.
        const RUN: u64 = 12;
        const NUMBER: u64 = 2;
        let bits = |number: i64| u64::from(64 - number.unsigned_abs().leading_zeros()) + NUMBER;
        let step = |[a, b]: [u32; 2]| {
            let (a, b) = (self.disks[a as usize], self.disks[b as usize]);
            bits(b.x - a.x) + bits(b.y - a.y) + bits(b.radius - a.radius)
        };
        RUN * self.runs.len() as u64 + self.links().map(step).sum::<u64>()
    }

    /// Centre and radius of a disk, in units of the input.
    ///
    /// # Panics
    /// If there is no such disk.
    #[must_use]
    pub fn disk(&self, number: u32) -> (Point, f64) {
        let GridDisk { x, y, radius } = self.disks[number as usize];
        let [x, y, radius] = [x, y, radius].map(|steps| steps as f64 * step(self.exponent));
        (Point::new(x, y), radius)
    }

    /// All pairs of disks that are linked, in the order of the runs.
    pub fn links(&self) -> impl Iterator<Item = [u32; 2]> {
        let mut known = 0;
        self.runs.iter().flat_map(move |run| {
            let own = known..known + run.len;
            known = own.end;
            let disks = run.from.into_iter().chain(own).chain(run.to);
            disks.clone().zip(disks.skip(1)).map(|(a, b)| [a, b])
        })
    }
}

/// Two to the power of an exponent in range, or a little below.
fn step(exponent: i32) -> f64 {
    2.0_f64.powi(exponent)
}

/// A sixteenth of a step of the grid, if the exponent is in range.
fn part(exponent: i32) -> Option<f64> {
    EXPONENTS.contains(&exponent).then(|| step(exponent - ERROR_PARTS))
}

#[cfg(test)]
mod tests {
    use super::*;

    const DISK: GridDisk = GridDisk { x: 3, y: -1, radius: 2 };

    fn graph(disks: usize, runs: &[Run]) -> Option<DiskGraph> {
        DiskGraph::from_parts(Engine::PathTracing, -1, 5, vec![DISK; disks], runs.to_vec())
    }

    #[test]
    fn a_loop_with_a_branch_has_its_links() {
        let around = Run { from: None, len: 3, to: Some(0) };
        let branch = Run { from: Some(1), len: 1, to: None };
        let graph = graph(4, &[around, branch]).unwrap();
        assert_eq!(graph.links().collect::<Vec<_>>(), [[0, 1], [1, 2], [2, 0], [1, 3]]);
        assert_eq!(graph.disk(2), (Point::new(1.5, -0.5), 1.0));
        assert_eq!(graph.error(), 5.0 / 32.0);
    }

    #[test]
    fn runs_name_only_disks_that_are_there() {
        let run = |from, len, to| Run { from, len, to };
        for (disks, runs) in [
            (1, [run(Some(0), 1, None)]),
            (2, [run(None, 2, Some(2))]),
            (3, [run(None, 2, None)]),
            (0, [run(None, 0, None)]),
            (0, [run(None, u32::MAX, None)]),
        ] {
            assert_eq!(graph(disks, &runs), None, "{runs:?}");
        }
        assert!(graph(0, &[]).is_some());
    }

    #[test]
    fn errors_are_rounded_up() {
        let graph = |error| DiskGraph::new(Engine::PathTracing, 4, error, Vec::new(), Vec::new());
        assert_eq!(graph(3.0).unwrap().error(), 3.0);
        assert_eq!(graph(3.2).unwrap().error(), 4.0);
        assert_eq!((graph(f64::NAN), graph(-1.0), graph(1e300)), (None, None, None));
    }
}
