//! Exact decisions about disks that touch three boundary elements.
//!
//! # Contract
//! Coordinates are the exact numbers the doubles stand for, with exponents within ±200. Every answer is
//! the true sign of a real number, so `Equal` means an exact tie; no tolerance decides anything.
//! A zero is no conflict: a touching element does not invalidate a disk.
//! Elements are those of the domain, never constructed points. Nothing panics, whatever the input.
//!
//! # Method
//! Each stage answers what it can prove and leaves the rest to the next.
//!
//! 1. Structure: an element that governs the disk, or ends at its contact.
//! 2. Doubles with a bound on their error, for the disk ([`TouchingDisk`](super::TouchingDisk), else
//!    from pairs of doubles or the integers) and for the question.
//! 3. Forms for the ties that are common: integers for a centre that is a short binary fraction, four corners by one determinant, four edges by minors of 256
//!    bits, centres on the normal at the end of an edge by a product of 256 bits, and the order in which
//!    two governors leave a path by forms without roots ([`two_ends`]).
//! 4. Pairs of doubles with a bound, for near ties that are none.
//! 5. The tower. Doubles become integers by one power of two, relative to a local origin. The disk is
//!    kept as centre `(x, y)/w` and radius, with `w > 0`, whose numbers are integer combinations of
//!    products of square roots; so almost every question is one more such number, linear in the disk.
//!    The sign of `a + b·√c` comes from those of `a`, `b` and `a² - b²·c`, one level down. This always
//!    ends and needs no bound on how close to zero a number may come.
//!
//! The order of the three elements fixes every choice of a root: contacts follow one another
//! counterclockwise. Where a corner lies on the line of an edge, its distance is exactly zero without
//! being treated apart, and disks that touch an edge at its end, the transitions, are no special case
//! [Lee82, cor. 3].
//!
//! # Departures
//! - Four sites are not filtered as a whole; the disk is bounded once and serves all questions about it.
//! - An edge stands for its supporting line. Whether it is seen from its front and within its ends are
//!   questions of their own: [`ExactDisk::front`] and [`ExactDisk::along`].
//! - The special forms never decide alone: what they leave open goes to the tower, and tests compare
//!   them with it.

mod construct;
mod counts;
mod disk;
mod distance;
mod dyadic;
mod eighths;
mod ends;
mod fine;
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
pub use distance::{compare_distances, compare_gap};
pub(crate) use eighths::{Eighths, Whole};
pub use ends::{First, Leaving, two_ends};
pub(crate) use near::sign;
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
