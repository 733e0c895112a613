//! Replays the inputs that the fuzz targets have collected.

#[path = "../../../fuzz/src/lib.rs"]
#[allow(dead_code, unused_imports, reason = "the fuzz targets use the rest")]
mod fuzz;

use std::path::PathBuf;

/// All inputs of a target with their names, sorted.
fn inputs(target: &str) -> Vec<(String, Vec<u8>)> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/corpus").join(target);
    let mut files: Vec<PathBuf> = std::fs::read_dir(&folder)
        .unwrap_or_else(|e| panic!("{}: {e}", folder.display()))
        .map(|entry| entry.expect("the folder can be listed").path())
        .collect();
    files.sort();
    let read = |path: PathBuf| {
        let data = std::fs::read(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        (path.file_name().unwrap_or_default().to_string_lossy().into_owned(), data)
    };
    files.into_iter().map(read).collect()
}

#[test]
fn domains_of_the_corpus_keep_their_contract() {
    let inputs = inputs("domain");
    let mut accepted = 0;
    for (name, data) in &inputs {
        match fuzz::check_domain(&fuzz::any_polygons(data)) {
            Ok(yes) => accepted += usize::from(yes),
            Err(fault) => panic!("{name}: {fault}"),
        }
    }
    // A corpus of refused inputs would prove little.
    assert!(2 * accepted > inputs.len(), "{accepted} of {} accepted", inputs.len());
}

#[test]
fn axes_of_the_corpus_have_no_defect() {
    let inputs = inputs("axis");
    let mut accepted = 0;
    for (name, data) in &inputs {
        let Some(shape) = fuzz::shape(data) else { continue };
        accepted += 1;
        if let Err(fault) = fuzz::check_axis(&shape) {
            panic!("{name}: {fault}");
        }
    }
    assert!(2 * accepted > inputs.len(), "{accepted} of {} accepted", inputs.len());
}
