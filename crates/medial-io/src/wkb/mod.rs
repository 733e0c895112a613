//! Well-known binary, one geometry after the other, each a feature; also as hexadecimal text, a
//! geometry a line. Heights, measures and reference system numbers (EWKB) are ignored.

mod polygons;
mod read;
mod write;

pub use polygons::write_polygons;
pub use read::read;
pub(crate) use read::read_alone;
pub(crate) use write::shape;
pub use write::write;

#[cfg(test)]
mod tests;
