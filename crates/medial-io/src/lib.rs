//! Formats for the medial axis toolkit.
//!
//! One module a format, text or bytes in and out; no file is touched here.
//! [`read`] gives the features of a text in any format that holds polygons,
//! [`axis_document::read`] the axes of a document, and each format's `write` the rest.
//!
//! Every double is read exactly and written as the shortest text that reads back to it.

mod error;
mod feature;
mod format;
mod json;
mod number;
mod path;
mod text;

#[cfg(test)]
mod samples;

pub mod axis_document;
pub mod csv;
pub mod geojson;
pub mod png;
pub mod rings;
pub mod svg;
pub mod wkt;

pub use error::{Error, FeatureError};
pub use feature::{Feature, Json, Layer, Note, Polygons};
pub use format::{Content, Format, UnknownFormat};
pub use path::{Drawing, default_tolerance};
pub use text::text;

/// Reads the features of a text in a format that holds polygons.
///
/// # Errors
/// If the format holds no polygons, or the text as a whole is not of that format. What is wrong
/// with one feature only is an item of the layer.
pub fn read(format: Format, text: &str) -> Result<Layer<'_>, Error> {
    match format {
        Format::GeoJson => geojson::read(text),
        Format::GeoJsonLines => Ok(geojson::read_lines(text)),
        Format::Wkt => Ok(wkt::read(text)),
        Format::Rings => rings::read(text),
        other => Err(Error::Unreadable { format: other }),
    }
}
