//! Points, and the exact decisions everything else rests on.

mod bounds_tree;
mod capsule_tree;
mod delaunay;
mod disjoint_sets;
mod disk;
mod double;
mod hilbert;
mod lanes;
mod orient;
mod point;
pub mod predicates;
mod rims;
mod ring;

pub use bounds_tree::{BoundsTree, Rect, Visitor};
pub use capsule_tree::{CapsuleTree, Hidden, LEAF, Look, Scope};
pub use delaunay::{Blocked, Delaunay, EdgeId, INFINITY};
pub use disjoint_sets::DisjointSets;
pub(crate) use disk::U;
pub use disk::{Governor, TouchingDisk, Unsure};
pub use double::Double;
pub(crate) use double::{Doubled, Fused};
pub use hilbert::hilbert;
pub(crate) use orient::compare_lengths;
pub use orient::{cross_directions, dot_directions, in_circle, orient2d};
pub use point::Point;
pub(crate) use point::order_key;
pub use rims::{Pinned, Rim};
pub(crate) use ring::parted;
pub use ring::signed_area;
