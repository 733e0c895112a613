//! GeoParquet, versions 1.0 and 1.1: columns of Apache Parquet, one of them of geometries.

mod geo;
mod read;
mod write;

pub use read::open;
pub use write::write;
