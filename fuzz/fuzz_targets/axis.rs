//! The axis of every valid shape against the judge.

#![no_main]

use libfuzzer_sys::{Corpus, fuzz_target};
use medial_fuzz::{Tally, check_axis, shape};

static TALLY: Tally = Tally::new();

fuzz_target!(|data: &[u8]| -> Corpus {
    let shape = shape(data);
    TALLY.count(shape.is_some());
    let Some(shape) = shape else { return Corpus::Reject };
    match check_axis(&shape) {
        Ok(()) => Corpus::Keep,
        Err(fault) => panic!("{fault}"),
    }
});
