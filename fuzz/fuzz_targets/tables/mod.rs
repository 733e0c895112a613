//! Bytes as the files of a table of features.

use medial_io::{Format, ReadOptions, open};
use std::path::Path;

/// Features that are read at most.
const MOST: usize = 10_000;

/// Reads all features of a table: refused or read, nothing may panic but what the reader itself makes an
/// error of.
///
/// A shapefile is several files: the first four bytes, in 64ths of the rest, tell where `.shx`, `.dbf`,
/// `.cpg` and `.prj` begin; what would be empty is not there.
///
/// # Panics
/// If the temporary folder cannot be written.
pub fn read_table(format: Format, data: &[u8]) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("table");
    if format == Format::Shp {
        shapefile(&path, data);
    } else {
        std::fs::write(&path, data).expect("a temporary file");
    }
    if let Ok(layer) = open(format, &path, &ReadOptions::default()) {
        layer.take(MOST).for_each(drop);
    }
}

fn shapefile(path: &Path, data: &[u8]) {
    let (starts, rest) = data.split_at(data.len().min(4));
    let mut starts: Vec<usize> =
        starts.iter().map(|&start| rest.len() * usize::from(start % 65) / 64).collect();
    starts.resize(4, rest.len());
    starts.sort_unstable();
    let ends = starts.iter().copied().chain([rest.len()]);
    let begins = [0].into_iter().chain(starts.iter().copied());
    for ((begin, end), extension) in begins.zip(ends).zip(["", "shx", "dbf", "cpg", "prj"]) {
        let part = &rest[begin..end];
        if extension.is_empty() || !part.is_empty() {
            let path = path.with_extension(extension);
            std::fs::write(path, part).expect("a temporary file");
        }
    }
}
