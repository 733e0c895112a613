//! The borders between objects, simplified or smoothed once for both sides.
//!
//! # Contract
//! What is left of the borders divides the plane as they did: the same objects with the same neighbours, components
//! and holes, and no two borders meet where they did not; parts of an object that meet at a corner have less than half a
//! turn there. Corners of pixels where three or four borders meet stay, and so
//! do the corners of the image. Every point of the borders before is within the tolerance of those after, and the other
//! way round; of smoothed borders every corner that does not stay is cut off before that, and no point moves by more
//! than 0.35 pixels.
//!
//! # Method of simplifying
//! Corners where a border turns leave it one by one, the one first whose way gets off the border least; of the same, the
//! one with the shorter way. A corner may leave if all corners that have left between its neighbours are within the
//! tolerance of the straight way between these, and if no other corner, of whatever border, lies in the triangle of
//! the three: then nothing is between the old way and the new one. That is decided in whole numbers.

mod arcs;
mod simplifier;
mod smoothing;

use crate::objects::Objects;
use crate::pixels::{Polygons, turned};
use arcs::{Arc, Cracks, Walk};
use medial::geom::Point;
use medial::raster::Grid;
use simplifier::Simplifier;
use smoothing::Moves;
use std::cmp::Ordering;

/// A corner between pixels: columns and rows from the origin.
type Corner = [u32; 2];

/// The corners that borders turn at, or some of them, and what they are between these where they are smoothed.
#[derive(Clone, Debug, PartialEq)]
pub struct Borders {
    /// Corners of pixels in a row.
    stride: usize,
    /// One bit for each corner of pixels.
    bits: Vec<u64>,
    /// Where the middles of cracks are moved to, if borders go through these.
    moves: Option<Moves>,
}

impl Objects {
    /// The borders of all objects, simplified within a tolerance, in units of the plane; with 0 only corners in whose
    /// place there is a straight line leave.
    #[must_use]
    pub fn borders(&self, tolerance: f64) -> Borders {
        let cracks = Cracks { objects: self };
        let Grid { columns, rows, cell, .. } = *self.grid();
        let mut borders = Borders::none(columns, rows);
        for corner in corners_of(columns, rows) {
            if cracks.is_node(corner) || cracks.is_turn(corner) {
                borders.set(corner, true);
            }
        }
        let arcs = self.arcs(&cracks, borders.corners(rows));
        let mut simplifier = Simplifier {
            cracks: &cracks,
            borders,
            straight: arcs.iter().filter(|arc| arc.corners.len() == 2).map(Arc::ends).collect(),
            cell: cell.map(f64::abs),
            most: tolerance * tolerance,
        };
        arcs.iter().for_each(|arc| simplifier.simplify(arc));
        simplifier.borders
    }

    /// The borders of all objects through the middles of the sides of pixels, smoothed by a Gaussian of this width along
    /// them, in pixels; corners where three or four borders meet, and those of the image, stay.
    #[must_use]
    pub fn smooth_borders(&self, width: f64) -> Borders {
        let cracks = Cracks { objects: self };
        let Grid { columns, rows, .. } = *self.grid();
        let mut borders = Borders::none(columns, rows);
        let is_fixed = |corner: &Corner| self.is_fixed(&cracks, *corner);
        corners_of(columns, rows).filter(is_fixed).for_each(|corner| borders.set(corner, true));
        let turns = corners_of(columns, rows).filter(|&corner| cracks.is_turn(corner));
        let starts = borders.corners(rows).chain(turns);
        let mut moves = Moves::none(borders.stride, rows);
        self.arcs(&cracks, starts).iter().for_each(|arc| moves.smooth(arc, width));
        Borders { moves: Some(moves), ..borders }
    }

    /// Whether a corner stays whatever is done with borders.
    fn is_fixed(&self, cracks: &Cracks<'_>, corner: Corner) -> bool {
        let Grid { columns, rows, .. } = *self.grid();
        let frame = [[0, 0], [columns, 0], [0, rows], [columns, rows]];
        cracks.is_node(corner) || frame.contains(&corner)
    }

    /// All borders, from one corner that stays to the next, and then loops, which have none.
    ///
    /// Corners out of which there are borders are given: all that stay, and one at least of each loop.
    fn arcs(&self, cracks: &Cracks<'_>, starts: impl Iterator<Item = Corner> + Clone) -> Vec<Arc> {
        let Grid { columns, rows, .. } = *self.grid();
        let stride = columns as usize + 1;
        let mut walk = Walk { cracks, seen: vec![0; stride * (rows as usize + 1)], stride };
        let is_fixed = |corner: Corner| self.is_fixed(cracks, corner);
        let mut arcs: Vec<Arc> = Vec::new();
        for start in starts.clone().filter(|&at| is_fixed(at)) {
            arcs.extend((0..4).filter_map(|way| walk.follow(start, way, &is_fixed)));
        }
        // What is left are loops without a corner that stays.
        for start in starts.filter(|&at| !is_fixed(at)) {
            arcs.extend((0..4).filter_map(|way| walk.follow(start, way, &is_fixed)));
        }
        arcs
    }

    /// The polygons of an object between these borders, with outer rings that run counterclockwise, and holes clockwise.
    ///
    /// # Panics
    /// If there is no such object.
    #[must_use]
    pub fn polygons_between(&self, object: u32, borders: &Borders) -> Polygons {
        let grid = self.grid();
        let along = |ring: &Vec<Corner>| -> Vec<Point> {
            let pairs = ring.iter().zip(ring.iter().cycle().skip(1));
            let places = pairs.flat_map(|(&from, &to)| borders.between(from, to));
            turned(grid, places.map(|[column, row]| grid.place(column, row)).collect())
        };
        let corners = self.windows(object).into_iter().flat_map(|window| window.corners());
        corners.map(|rings| rings.iter().map(along).collect()).collect()
    }
}

/// All corners of pixels, row by row.
fn corners_of(columns: u32, rows: u32) -> impl Iterator<Item = Corner> + Clone {
    (0..=rows).flat_map(move |row| (0..=columns).map(move |column| [column, row]))
}

impl Borders {
    fn none(columns: u32, rows: u32) -> Self {
        let stride = columns as usize + 1;
        let n_corners = stride * (rows as usize + 1);
        Self { stride, bits: vec![0; n_corners.div_ceil(64)], moves: None }
    }

    fn number(&self, [column, row]: Corner) -> usize {
        row as usize * self.stride + column as usize
    }

    fn has(&self, corner: Corner) -> bool {
        let number = self.number(corner);
        self.bits[number / 64] >> (number % 64) & 1 == 1
    }

    fn set(&mut self, corner: Corner, is_there: bool) {
        let number = self.number(corner);
        let bit = 1 << (number % 64);
        if is_there {
            self.bits[number / 64] |= bit;
        } else {
            self.bits[number / 64] &= !bit;
        }
    }

    /// All corners, row by row.
    fn corners(&self, rows: u32) -> impl Iterator<Item = Corner> + Clone + use<> {
        let (bits, stride) = (self.bits.clone(), self.stride);
        (0..stride * (rows as usize + 1))
            .filter(move |k| bits[k / 64] >> (k % 64) & 1 == 1)
            .map(move |k| [(k % stride) as u32, (k / stride) as u32])
    }

    /// What a border is on a way along a row or a column, without the corner that it leads to: columns and rows.
    fn between(&self, from: Corner, to: Corner) -> impl Iterator<Item = [f64; 2]> + '_ {
        steps(from, to).flat_map(|[at, next]| {
            let corner = self.has(at).then(|| at.map(f64::from));
            let middle = self.moves.as_ref().map(|moves| moves.middle([at, next]));
            corner.into_iter().chain(middle)
        })
    }
}

/// The sides of pixels on a way along a row or a column, each from corner to corner.
fn steps(from: Corner, to: Corner) -> impl Iterator<Item = [Corner; 2]> + Clone {
    let n = from[0].abs_diff(to[0]).max(from[1].abs_diff(to[1]));
    let at = move |k: u32| {
        [0, 1].map(|axis| match from[axis].cmp(&to[axis]) {
            Ordering::Less => from[axis] + k,
            Ordering::Equal => from[axis],
            Ordering::Greater => from[axis] - k,
        })
    };
    (0..n).map(move |k| [at(k), at(k + 1)])
}

#[cfg(test)]
mod tests;
