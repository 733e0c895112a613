//! Points, and the exact decisions everything else rests on.

mod orient;
mod point;

pub use orient::{cross_directions, orient2d};
pub use point::Point;
