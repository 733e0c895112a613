//! Any polygons against the contract of the domain.

#![no_main]

use libfuzzer_sys::{Corpus, fuzz_target};
use medial_fuzz::{Tally, any_polygons, check_domain};

static TALLY: Tally = Tally::new();

fuzz_target!(|data: &[u8]| -> Corpus {
    match check_domain(&any_polygons(data)) {
        Ok(accepted) => {
            TALLY.count(accepted);
            Corpus::Keep
        }
        Err(fault) => panic!("{fault}"),
    }
});
