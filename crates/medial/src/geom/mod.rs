//! Points, and the exact decisions everything else rests on.

mod point;
pub mod predicates;

pub use point::Point;
