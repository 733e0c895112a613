//! Any bytes as a Parquet file.

#![no_main]

use libfuzzer_sys::fuzz_target;
use medial_fuzz::tables::read_table;
use medial_io::Format;

fuzz_target!(|data: &[u8]| read_table(Format::Parquet, data));
