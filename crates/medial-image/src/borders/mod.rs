//! The borders between objects, simplified once for both sides.
//!
//! # Contract
//! What is left of the borders divides the plane as they did: the same objects with the same neighbours, components
//! and holes, and no two borders meet where they did not. Corners of pixels where three or four borders meet stay, and so
//! do the corners of the image. Every point of the borders before is within the tolerance of those after, and the other
//! way round.
//!
//! # Method
//! Corners where a border turns leave it one by one, the one first whose way gets off the border least; of the same, the
//! one with the shorter way. A corner may leave if all corners that have left between its neighbours are within the
//! tolerance of the straight way between these, and if no other corner, of whatever border, lies in the triangle of
//! the three: then nothing is between the old way and the new one. That is decided in whole numbers.

mod arcs;
mod simplifier;

use crate::objects::Objects;
use crate::pixels::{Polygons, placed};
use arcs::{Arc, Cracks, Walk};
use medial::raster::Grid;
use simplifier::Simplifier;
use std::cmp::Ordering;

/// A corner between pixels: columns and rows from the origin.
type Corner = [u32; 2];

/// The corners that borders turn at, or some of them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Borders {
    /// Corners of pixels in a row.
    stride: usize,
    /// One bit for each corner of pixels.
    bits: Vec<u64>,
}

impl Objects {
    /// The borders of all objects, simplified within a tolerance, in units of the plane; with 0 only corners in whose
    /// place there is a straight line leave.
    #[must_use]
    pub fn borders(&self, tolerance: f64) -> Borders {
        let cracks = Cracks { objects: self };
        let Grid { columns, rows, cell, .. } = *self.grid();
        let stride = columns as usize + 1;
        let n_corners = stride * (rows as usize + 1);
        let mut borders = Borders { stride, bits: vec![0; n_corners.div_ceil(64)] };
        let frame = [[0, 0], [columns, 0], [0, rows], [columns, rows]];
        let is_fixed = |corner: Corner| cracks.is_node(corner) || frame.contains(&corner);
        for row in 0..=rows {
            for column in 0..=columns {
                let corner = [column, row];
                if cracks.is_node(corner) || cracks.is_turn(corner) {
                    borders.set(corner, true);
                }
            }
        }
        let mut walk = Walk { cracks: &cracks, seen: vec![0; n_corners], stride };
        let mut arcs: Vec<Arc> = Vec::new();
        let is_start = |at: &Corner| is_fixed(*at);
        for start in borders.corners(rows).filter(is_start) {
            arcs.extend((0..4).filter_map(|way| walk.follow(start, way, &is_fixed)));
        }
        // What is left are loops without a corner that stays.
        for start in borders.corners(rows).filter(|at| !is_fixed(*at)) {
            arcs.extend((0..4).filter_map(|way| walk.follow(start, way, &is_fixed)));
        }
        let mut simplifier = Simplifier {
            borders,
            straight: arcs.iter().filter(|arc| arc.corners.len() == 2).map(Arc::ends).collect(),
            cell: cell.map(f64::abs),
            most: tolerance * tolerance,
        };
        arcs.iter().for_each(|arc| simplifier.simplify(arc));
        simplifier.borders
    }

    /// The polygons of an object between these borders.
    ///
    /// # Panics
    /// If there is no such object.
    #[must_use]
    pub fn polygons_between(&self, object: u32, borders: &Borders) -> Polygons {
        let along = |ring: &Vec<Corner>| {
            let pairs = ring.iter().zip(ring.iter().cycle().skip(1));
            pairs.flat_map(|(&from, &to)| borders.between(from, to)).collect()
        };
        let corners = self.windows(object).into_iter().flat_map(|window| window.corners());
        let polygons: Vec<Vec<Vec<Corner>>> =
            corners.map(|rings| rings.iter().map(along).collect()).collect();
        placed(self.grid(), &polygons)
    }
}

impl Borders {
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
    fn corners(&self, rows: u32) -> impl Iterator<Item = Corner> + use<> {
        let (bits, stride) = (self.bits.clone(), self.stride);
        (0..stride * (rows as usize + 1))
            .filter(move |k| bits[k / 64] >> (k % 64) & 1 == 1)
            .map(move |k| [(k % stride) as u32, (k / stride) as u32])
    }

    /// Those on a way along a row or a column, without the one it leads to.
    fn between(&self, from: Corner, to: Corner) -> impl Iterator<Item = Corner> + '_ {
        let n = from[0].abs_diff(to[0]).max(from[1].abs_diff(to[1]));
        let at = move |k: u32| {
            [0, 1].map(|axis| match from[axis].cmp(&to[axis]) {
                Ordering::Less => from[axis] + k,
                Ordering::Equal => from[axis],
                Ordering::Greater => from[axis] - k,
            })
        };
        (0..n).map(at).filter(|&corner| self.has(corner))
    }
}

#[cfg(test)]
mod tests;
