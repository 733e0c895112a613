//! GeoJSON [RFC 7946], also with a `crs` member as older writers leave it.

mod centerline;
mod moved;
mod quick;
mod read;
mod voronoi;
mod write;

pub use centerline::{centerline_features, centerline_lines};
pub use moved::moved;
pub(crate) use read::feature;
pub use read::{read, read_lines};
pub use voronoi::{voronoi_features, voronoi_lines};
pub(crate) use write::{COMMON, beginning, number, position};
pub use write::{FOOTER, SEPARATOR, feature_lines, features, header};

#[cfg(test)]
mod tests;
