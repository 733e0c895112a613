//! Any bytes as a FlatGeobuf.

#![no_main]

use libfuzzer_sys::fuzz_target;
use medial_fuzz::tables::read_table;
use medial_io::Format;

fuzz_target!(|data: &[u8]| read_table(Format::Fgb, data));
