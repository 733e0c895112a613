//! Any bytes as a GeoPackage.

#![no_main]

mod tables;

use libfuzzer_sys::fuzz_target;
use medial_io::Format;
use tables::read_table;

fuzz_target!(|data: &[u8]| read_table(Format::Gpkg, data));
