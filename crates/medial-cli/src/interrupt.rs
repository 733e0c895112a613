//! What happens when the user ends the command: files that are not complete go with it.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use tempfile::NamedTempFile;

/// Files that are not complete yet.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// The exit status after Ctrl-C, as shells have it.
const STATUS: i32 = 130;

/// From now on unfinished files are removed when the process is told to end.
pub fn install() {
    // Without a handler the system ends the process, as it would anyway.
    let _ = ctrlc::set_handler(|| {
        // Held to the end, so that no further file is begun.
        let unfinished = UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner);
        unfinished.iter().for_each(|path| remove(path));
        std::process::exit(STATUS);
    });
}

/// Removes a file and those beside it whose names begin like its own: journals of databases, parts of
/// shapefiles. Those that are complete by now have other names.
fn remove(path: &Path) {
    let (Some(folder), Some(name)) = (path.parent(), path.file_name()) else { return };
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        if entry.file_name().as_encoded_bytes().starts_with(name.as_encoded_bytes()) {
            let _ = std::fs::remove_file(entry.path());
        }
    }
}

/// Makes a file that is removed if the process is told to end before it gets its name.
pub fn unfinished(create: impl FnOnce() -> io::Result<NamedTempFile>) -> io::Result<NamedTempFile> {
    let mut unfinished = UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner);
    let file = create()?;
    unfinished.push(file.path().to_owned());
    Ok(file)
}
