//! Points, and the exact decisions everything else rests on.

mod point;

pub use point::Point;
