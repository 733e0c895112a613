//! What happens when the user ends the command: files that are not complete go with it.

use std::io;
use std::path::PathBuf;
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
        for path in &*unfinished {
            // Those that are complete by now have another name.
            let _ = std::fs::remove_file(path);
        }
        std::process::exit(STATUS);
    });
}

/// Makes a file that is removed if the process is told to end before it gets its name.
pub fn unfinished(create: impl FnOnce() -> io::Result<NamedTempFile>) -> io::Result<NamedTempFile> {
    let mut unfinished = UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner);
    let file = create()?;
    unfinished.push(file.path().to_owned());
    Ok(file)
}
