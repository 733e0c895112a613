//! Results that become a table of features in a file, or several.

use crate::failure::{Failure, plain};
use crate::output::Output;
use medial_io::table::{self, Layers, Spool, WriteError};
use medial_io::{Crs, Format};
use std::fs::{self, File};
use std::io::{self, Read as _};
use std::path::{Path, PathBuf};

/// Files of a shapefile that another program made of it, and that are wrong for another one.
const STALE: [&str; 5] = ["prj", "qix", "sbn", "sbx", "idm"];

/// What a database leaves behind when it is broken off; it would be taken for that of the new one.
const JOURNALS: [&str; 3] = ["-journal", "-wal", "-shm"];

/// The rows of a table on their way.
pub struct Table {
    format: Format,
    /// The name of the file as the user gave it.
    name: String,
    rows: Rows,
    quiet: bool,
}

/// The property of features that names their layer.
const LAYER: &str = "layer";

/// Rows of a layer with its name, or of several.
enum Rows {
    Layer(String, Spool),
    Layers(Layers),
}

impl Table {
    /// A table that is to become a file, or one for each of these layers if there are such.
    pub fn create(
        path: &Path,
        format: Format,
        layers: &[&str],
        quiet: bool,
    ) -> Result<Self, Failure> {
        let name = path.display().to_string();
        let failed = |error: io::Error| {
            let why = format_args!("cannot create a temporary file: {}", plain(&error));
            Failure::file(&name, why)
        };
        // Where the file is to be there is most likely room for it; not for a device.
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
        let folder = folder.unwrap_or(Path::new("."));
        let is_special = fs::metadata(path).is_ok_and(|found| !found.is_file());
        if is_special && format == Format::Shp {
            let why = "a shapefile is several files, and this is none; name another one";
            return Err(Failure::file(&name, why));
        }
        let spool = || {
            let file =
                if is_special { tempfile::tempfile() } else { tempfile::tempfile_in(folder) };
            file.map(Spool::new).map_err(failed)
        };
        let rows = if layers.is_empty() {
            let layer = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            Rows::Layer(layer, spool()?)
        } else {
            let mut all = Layers::new(LAYER);
            for &layer in layers {
                all.spools.push((layer.to_owned(), spool()?));
            }
            Rows::Layers(all)
        };
        Ok(Self { format, name, rows, quiet })
    }

    /// Adds features, each on a line of GeoJSON.
    pub fn add(&mut self, lines: &[u8]) -> Result<(), Failure> {
        let name = &self.name;
        let added = match &mut self.rows {
            Rows::Layer(_, spool) => spool.add(lines),
            Rows::Layers(layers) => layers.add(lines),
        };
        added.map_err(|error| Failure::write(name, &error))
    }

    /// Writes the table, and lets its files appear, the one with the name last.
    pub fn finish(mut self, mut output: Output, crs: Option<&Crs>) -> Result<(), Failure> {
        let Some(path) = output.place().map(Path::to_owned) else {
            let folder = tempfile::tempdir().map_err(|error| self.failed(&error))?;
            let path = folder.path().join("table");
            self.write(&path, crs)?;
            let mut file = File::open(&path).map_err(|error| self.failed(&error))?;
            let mut buffer = vec![0; 1 << 16];
            loop {
                match file.read(&mut buffer).map_err(|error| self.failed(&error))? {
                    0 => return output.finish(),
                    n => output.write(&buffer[..n])?,
                }
            }
        };
        let beside = Beside(self.write(&path, crs)?);
        let target = output.target().map(Path::to_owned).unwrap_or_default();
        if self.format == Format::Shp {
            for extension in STALE {
                let _ = fs::remove_file(target.with_extension(extension));
            }
        }
        for (from, extension) in &beside.0 {
            fs::rename(from, target.with_extension(extension))
                .map_err(|error| self.failed(&error))?;
        }
        output.finish()?;
        if self.format == Format::Gpkg {
            for ending in JOURNALS {
                let mut name = target.as_os_str().to_owned();
                name.push(ending);
                let _ = fs::remove_file(name);
            }
        }
        Ok(())
    }

    fn failed(&self, error: &io::Error) -> Failure {
        Failure::write(&self.name, error)
    }

    /// Writes the table to a path; gives the files beside it.
    fn write(
        &mut self,
        path: &Path,
        crs: Option<&Crs>,
    ) -> Result<Vec<(PathBuf, &'static str)>, Failure> {
        let found = match &mut self.rows {
            Rows::Layer(layer, spool) => table::write(self.format, path, layer, crs, spool),
            Rows::Layers(layers) => table::write_layers(path, crs, layers),
        };
        match found {
            Ok(written) => {
                if !self.quiet {
                    for warning in written.warnings {
                        crate::progress::line(&format!("warning: {}: {warning}", self.name));
                    }
                }
                Ok(written.beside)
            }
            Err(error) => {
                drop(Beside(table::beside(self.format, path)));
                Err(match error {
                    WriteError::System(error) => self.failed(&error),
                    error => Failure::file(&self.name, error),
                })
            }
        }
    }
}

/// Files that have not got their names yet, removed with this.
struct Beside(Vec<(PathBuf, &'static str)>);

impl Drop for Beside {
    fn drop(&mut self) {
        for (path, _) in &self.0 {
            let _ = fs::remove_file(path);
        }
    }
}
