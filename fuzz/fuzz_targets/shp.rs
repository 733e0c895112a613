//! Any bytes as a shapefile: shapes, and after them the places, values and encoding.

#![no_main]

use libfuzzer_sys::fuzz_target;
use medial_fuzz::tables::read_table;
use medial_io::Format;

fuzz_target!(|data: &[u8]| read_table(Format::Shp, data));
