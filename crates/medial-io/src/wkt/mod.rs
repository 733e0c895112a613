//! Well-known text, one geometry after the other, each a feature; heights and measures are
//! ignored, an `SRID=…;` before a geometry is tolerated.

mod read;
mod scanner;
mod write;

pub(crate) use write::drawn_line;

pub use read::read;
pub(crate) use write::shape;
pub use write::{write, write_lines};

#[cfg(test)]
mod tests;
