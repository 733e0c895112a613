//! Formats for the medial axis toolkit.
//!
//! One module a format, text or bytes in and out; only the tables of features ([`table`]: GeoPackage,
//! Shapefile, FlatGeobuf, GeoParquet) are files here.
//! [`read`] gives the features of an input in any format that holds polygons, [`open`] those of a file,
//! [`axis_document::read`] the axes of a document, [`maxis::read`] those of a compressed file, and each format's `write` the rest.
//!
//! ```
//! use medial::domain::{Domain, Options};
//! use medial::engine::path_tracing;
//! use medial_io::{Drawing, Format, read, wkt};
//!
//! let layer = read(Format::Wkt, b"POLYGON ((0 0, 4 0, 4 2, 0 2, 0 0))")?;
//! for feature in layer {
//!     let domain = Domain::from_polygons(&feature?.polygons, &Options::default())?;
//!     let axis = path_tracing(&domain)?;
//!     let lines = wkt::write(&axis, Drawing::default());
//!     assert!(lines.contains("(1 1, 3 1)"), "the spine of the rectangle");
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Every double is read exactly and written as the shortest text that reads back to it.

mod apart;
mod attribute;
mod crs;
mod curves;
mod error;
mod feature;
mod format;
mod gzip;
mod json;
mod number;
mod open;
mod options;
mod path;
mod stream;
mod text;

#[cfg(test)]
mod samples;

pub mod axis_document;
pub mod clicks;
pub mod csv;
pub mod dxf;
pub mod fgb;
pub mod font;
pub mod gcode;
pub mod geojson;
pub mod gpkg;
pub mod image;
pub mod limb_document;
pub mod location_document;
pub mod maxis;
pub mod offset_document;
pub mod parquet;
pub mod png;
pub mod points;
pub mod record;
pub mod rings;
pub mod shp;
pub mod svg;
pub mod table;
pub mod voronoi_document;
pub mod wkb;
pub mod wkt;

pub use crs::Crs;
pub use error::{Error, FeatureError};
pub use feature::{Feature, Json, Layer, Note, Part, Polygons};
pub use format::{Content, Format, UnknownFormat};
pub use open::open;
pub use options::ReadOptions;
pub use path::{
    Drawing, default_tolerance, domain_tolerance, line_columns, line_records, point_record,
};
pub use stream::read_stream;
pub use text::text;

/// Reads the features of the bytes of a format that holds polygons.
///
/// # Errors
/// If the format holds no polygons, or the bytes as a whole are not of that format. What is wrong
/// with one feature only is an item of the layer.
pub fn read(format: Format, bytes: &[u8]) -> Result<Layer<'_>, Error> {
    read_with(format, bytes, &ReadOptions::default())
}

/// The same, with options for formats that take some.
///
/// # Errors
/// As [`read`].
pub fn read_with<'a>(
    format: Format,
    bytes: &'a [u8],
    options: &ReadOptions,
) -> Result<Layer<'a>, Error> {
    match format {
        Format::Svg => svg::read(text(&gzip::unpacked(bytes)?)?, options),
        Format::Dxf => dxf::read(bytes, options),
        Format::Ttf => font::read(bytes, options),
        Format::Png | Format::Tiff | Format::Jpeg => image::read(format, bytes, options),
        Format::GeoJson => geojson::read(text(bytes)?).map(points::gathered),
        Format::GeoJsonLines | Format::GeoJsonSeq => {
            Ok(points::gathered(geojson::read_lines(text(bytes)?)))
        }
        Format::Wkt => Ok(points::gathered(wkt::read(text(bytes)?))),
        Format::Wkb => wkb::read(bytes),
        Format::Rings => rings::read(text(bytes)?),
        Format::Csv => points::read(text(bytes)?),
        other => Err(Error::Unreadable { format: other }),
    }
}
