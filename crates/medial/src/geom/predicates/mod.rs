//! Exact decisions about disks that touch three boundary elements.

mod construct;
mod counts;
mod disk;
mod ends;
mod grid;
mod homogeneous;
mod near;
mod rough;
mod round;
mod stages;
mod tower;
mod transition;
mod wide;

pub use counts::{Counts, counts, reset_counts};
pub use disk::ExactDisk;
pub use ends::{First, Leaving, two_ends};
pub use stages::in_disk;

use crate::geom::Point;

/// A boundary element as a predicate sees it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Element {
    /// A corner of the boundary.
    Corner(Point),
    /// The supporting line of an edge, directed from the first point to the second; its front, where
    /// disks are, lies to the left.
    Edge(Point, Point),
}

#[cfg(test)]
mod tests;
