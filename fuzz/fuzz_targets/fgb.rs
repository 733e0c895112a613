//! Any bytes as a FlatGeobuf.

#![no_main]

mod tables;

use libfuzzer_sys::fuzz_target;
use medial_io::Format;
use tables::read_table;

fuzz_target!(|data: &[u8]| read_table(Format::Fgb, data));
