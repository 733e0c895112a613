//! Any bytes as a Parquet file.

#![no_main]

mod tables;

use libfuzzer_sys::fuzz_target;
use medial_io::Format;
use std::sync::Once;
use tables::read_table;

/// Panics of a library that the reader catches are no find: without the hook of the fuzzer they do not end
/// the process, and others still do.
fn quiet_panics() {
    static QUIET: Once = Once::new();
    QUIET.call_once(|| std::panic::set_hook(Box::new(|_| {})));
}

fuzz_target!(|data: &[u8]| {
    quiet_panics();
    read_table(Format::Parquet, data);
});
