//! How many inputs are valid: a fuzzer that only meets invalid ones finds nothing.

use std::sync::atomic::{AtomicU64, Ordering};

/// Counts inputs, and says so on standard error at each power of two.
pub struct Tally {
    all: AtomicU64,
    accepted: AtomicU64,
}

impl Tally {
    pub const fn new() -> Self {
        Self { all: AtomicU64::new(0), accepted: AtomicU64::new(0) }
    }

    pub fn count(&self, accepted: bool) {
        let yes = self.accepted.fetch_add(u64::from(accepted), Ordering::Relaxed);
        let all = self.all.fetch_add(1, Ordering::Relaxed) + 1;
        if all.is_power_of_two() && all >= 1 << 12 || all.is_multiple_of(1 << 18) {
            eprintln!("accepted: {} of {all}", yes + u64::from(accepted));
        }
    }
}

impl Default for Tally {
    fn default() -> Self {
        Self::new()
    }
}
