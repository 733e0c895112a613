//! Any bytes as DXF: features or errors, without a panic, and edges that match their pieces.

#![no_main]

mod features;

use features::check_features;
use libfuzzer_sys::fuzz_target;
use medial_io::Format;

fuzz_target!(|data: &[u8]| {
    if let Err(fault) = check_features(Format::Dxf, data) {
        panic!("{fault}");
    }
});
