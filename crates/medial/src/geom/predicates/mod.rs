//! Exact decisions about disks that touch three boundary elements.

mod construct;
mod disk;
mod grid;
mod round;
mod tower;

pub use disk::ExactDisk;

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
