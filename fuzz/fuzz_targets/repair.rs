//! Any polygons against the contract of repair.

#![no_main]

use libfuzzer_sys::{Corpus, fuzz_target};
use medial_fuzz::{Tally, any_polygons, check_repair};

static TALLY: Tally = Tally::new();

fuzz_target!(|data: &[u8]| -> Corpus {
    match check_repair(&any_polygons(data)) {
        Ok(accepted) => {
            TALLY.count(accepted);
            Corpus::Keep
        }
        Err(fault) => panic!("{fault}"),
    }
});
