//! Points, and the exact decisions everything else rests on.

mod bounds_tree;
mod disk;
mod double;
mod point;
pub mod predicates;

pub use bounds_tree::{BoundsTree, Rect, Visitor};
pub use disk::{Governor, TouchingDisk};
pub use double::Double;
pub use point::Point;
