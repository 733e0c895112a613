//! Shapefile [ESRI 1998]: shapes in `.shp`, their places in `.shx`, values in `.dbf`, and beside them the
//! reference system in `.prj` and the name of the text encoding in `.cpg`.

mod dbf;
mod encoding;
mod read;
mod rings;
mod write;

pub use read::open;
pub(crate) use write::beside;
pub use write::write;

/// Types of shapes; those with heights are 10 more, those with measures 20 more.
mod kind {
    pub const NULL: i32 = 0;
    pub const POINT: i32 = 1;
    pub const POLYLINE: i32 = 3;
    pub const POLYGON: i32 = 5;
    pub const MULTIPOINT: i32 = 8;
    pub const MULTIPATCH: i32 = 31;
    /// What is added to a type with heights.
    pub const IN_SPACE: i32 = 10;
    /// What is added to a type with measures.
    pub const MEASURED: i32 = 20;
}

/// Bytes of the header of `.shp` and `.shx`.
const HEADER: usize = 100;
