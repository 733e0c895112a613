//! Any bytes as an image: a mask or an error, without a panic.

#![no_main]

use libfuzzer_sys::fuzz_target;
use medial_io::{Format, ReadOptions, image};

fuzz_target!(|data: &[u8]| {
    for format in [Format::Png, Format::Tiff] {
        let _ = image::read_mask(format, data, &ReadOptions::default());
    }
});
