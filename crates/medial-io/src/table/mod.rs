//! Tables of features on their way into a file that must know its columns beforehand.
//!
//! Results arrive as lines of GeoJSON. A [`Spool`] keeps them in a temporary file while it learns the
//! [`Schema`], and [`write()`] makes the file of them, row after row.

mod geometry;
mod layers;
mod line;
mod names;
mod schema;
mod spool;

pub use geometry::{Geometry, GeometryKind, Place};
pub use layers::Layers;
pub use schema::{Cell, Column, Kind, Row, Schema};
pub use spool::{Rows, Spool};

pub(crate) use names::{told_apart, unique};

use crate::{Crs, Format, fgb, gpkg, parquet, shp};
use std::io;
use std::path::{Path, PathBuf};

/// A table to be written.
pub struct Table<'a> {
    /// The name of the layer.
    pub name: &'a str,
    /// The reference system of its coordinates.
    pub crs: Option<&'a Crs>,
    /// Its columns and geometries.
    pub schema: &'a Schema,
}

/// What writing gave.
#[derive(Debug, Default)]
pub struct Written {
    /// What the format could not keep, for people.
    pub warnings: Vec<String>,
    /// Files that belong to the one that was asked for: where each is, and its extension.
    pub beside: Vec<(PathBuf, &'static str)>,
}

/// Why a table could not be written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum WriteError {
    /// The format cannot hold it.
    #[error("{why}")]
    Unfit {
        /// What it cannot hold, and what to do.
        why: String,
    },
    /// The system failed.
    #[error("{0}")]
    System(#[from] io::Error),
}

impl WriteError {
    pub(crate) fn unfit(why: impl Into<String>) -> Self {
        Self::Unfit { why: why.into() }
    }

    /// A failure of a library, which wraps those of the system.
    pub(crate) fn of(error: &impl ToString) -> Self {
        Self::System(io::Error::other(error.to_string()))
    }
}

/// The files that [`write()`] writes beside a path, with their extensions, whether it succeeds or not.
#[must_use]
pub fn beside(format: Format, path: &Path) -> Vec<(PathBuf, &'static str)> {
    match format {
        Format::Shp => shp::beside(path),
        _ => Vec::new(),
    }
}

/// Writes the rows of a spool in a format that [is a table](Format::is_table) to a path, where a file of
/// no bytes may be already. Other files of the format are written beside it, with an extension that is put
/// behind the whole name.
///
/// # Errors
/// If the format cannot hold the table, or the system fails; what was written is then no file of the
/// format.
pub fn write(
    format: Format,
    path: &Path,
    name: &str,
    crs: Option<&Crs>,
    spool: &mut Spool,
) -> Result<Written, WriteError> {
    let schema = spool.schema().clone();
    let table = Table { name, crs, schema: &schema };
    let rows = spool.rows()?;
    match format {
        Format::Gpkg => gpkg::write(path, &table, rows),
        Format::Shp => shp::write(path, &table, rows),
        Format::Fgb => fgb::write(path, &table, rows),
        Format::Parquet => parquet::write(path, &table, rows),
        other => Err(WriteError::unfit(format!("the format {other} is no table"))),
    }
}

/// Writes the rows of several layers, each as a table of its own, to a GeoPackage, which is the one format of tables
/// that has layers; else as [`write()`].
///
/// # Errors
/// If the system fails, or the name of a layer is reserved; what was written is then no GeoPackage.
pub fn write_layers(
    path: &Path,
    crs: Option<&Crs>,
    layers: &mut Layers,
) -> Result<Written, WriteError> {
    let mut package = gpkg::Package::create(path, crs)?;
    for (name, spool) in &mut layers.spools {
        let schema = spool.schema().clone();
        package.add(&Table { name, crs, schema: &schema }, spool.rows()?)?;
    }
    package.finish()
}
