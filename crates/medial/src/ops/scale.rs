//! The scale axis [GMPW09]: which disks a larger one swallows when all of them grow.
//!
//! # Contract
//! The value of a disk is the least factor by which all disks have to grow about their centres until it
//! lies within a larger one: the distance of the centres over the difference of the radii. The larger disks
//! that are tried are those of keypoints, so that a value may be too large where a disk between two of them
//! would swallow a little sooner.
//!
//! # Departures
//! The paper takes the axis of the union of the grown disks, which may have another topology. Here the
//! values remove parts of this axis.

use std::ops::Range;

use crate::axis::MedialAxis;
use crate::geom::{BoundsTree, Point, Rect, Visitor};

/// The disks of the keypoints of an axis.
#[derive(Debug)]
pub(super) struct Swallowing {
    disks: Vec<(Point, f64)>,
    tree: BoundsTree,
    /// The greatest radius of eight disks in a row, of 64, and so on.
    greatest: Vec<Vec<f64>>,
}

/// Disks below a node of the tree.
const FAN: usize = 8;

impl Swallowing {
    pub fn new(axis: &MedialAxis) -> Self {
        let disks: Vec<_> = axis.keypoints().iter().map(|k| (k.position, k.radius)).collect();
        let tree =
            BoundsTree::new(0, disks.len() as u32, |k| Rect::EMPTY.with(disks[k as usize].0));
        let most = |radii: &[f64]| radii.iter().copied().fold(0.0, f64::max);
        let radii: Vec<f64> = disks.iter().map(|disk| disk.1).collect();
        let mut greatest = vec![radii.chunks(FAN).map(most).collect::<Vec<f64>>()];
        while let Some(last) = greatest.last()
            && last.len() > 1
        {
            greatest.push(last.chunks(FAN).map(most).collect());
        }
        Self { disks, tree, greatest }
    }

    /// The value of a disk.
    pub fn value(&self, centre: Point, radius: f64) -> f64 {
        let mut least = Least { all: self, centre, radius, value: f64::INFINITY };
        self.tree.visit(&mut least);
        least.value
    }
}

/// Looks for the disk that swallows soonest.
struct Least<'a> {
    all: &'a Swallowing,
    centre: Point,
    radius: f64,
    value: f64,
}

impl Visitor for Least<'_> {
    fn enters(&self, bounds: &Rect, items: Range<u32>) -> bool {
        let width = (items.end - items.start).max(1) as usize;
        let mut level = 0;
        while FAN.pow(level as u32 + 1) < width {
            level += 1;
        }
        let number = items.start as usize / FAN.pow(level as u32 + 1);
        let more = self.all.greatest[level][number] - self.radius;
        more > 0.0 && bounds.distance2(self.centre).sqrt() < self.value * more
    }

    fn item(&mut self, disk: u32) {
        let (centre, radius) = self.all.disks[disk as usize];
        let more = radius - self.radius;
        if more > 0.0 {
            self.value = self.value.min((centre - self.centre).norm() / more);
        }
    }
}
