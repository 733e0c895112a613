//! The shape: rings of doubles, validated once, as boundary walks with the interior on the left.

mod walks;

pub use walks::{Corner, CornerOrigin, Domain, Edge, Origin, Site, Walk};
