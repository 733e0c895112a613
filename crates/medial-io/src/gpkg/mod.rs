//! GeoPackage [OGC 12-128r17], version 1.3: tables of features in a database of SQLite.

mod blob;
mod read;
mod write;

pub use read::open;
pub(crate) use write::Package;
pub use write::write;

/// A name as SQL has it.
fn quoted(name: &str) -> String {
    format!("\"{}\"", name.replace('"', "\"\""))
}
