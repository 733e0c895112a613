//! Any bytes as a font: features or errors, without a panic, and edges that match their pieces.

#![no_main]

mod features;

use features::check_features;
use libfuzzer_sys::fuzz_target;
use medial_io::Format;
use std::sync::Once;

/// Panics of a library that the reader catches are no find: without the hook of the fuzzer they do not end
/// the process, and others still do.
fn quiet_panics() {
    static QUIET: Once = Once::new();
    QUIET.call_once(|| std::panic::set_hook(Box::new(|_| {})));
}

fuzz_target!(|data: &[u8]| {
    quiet_panics();
    if let Err(fault) = check_features(Format::Ttf, data) {
        eprintln!("{fault}");
        std::process::abort();
    }
});
