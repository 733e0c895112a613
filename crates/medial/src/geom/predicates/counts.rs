//! How often each stage of the decisions answers.

use std::cell::Cell;

/// Questions that each stage answered on this thread since [`reset_counts`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// The element tested governs the disk, or ends an edge that does.
    pub structure: u64,
    /// Doubles with a bound on their error, for a disk already built.
    pub rounded: u64,
    /// Short integers, for a disk whose numbers are binary fractions.
    pub dyadic: u64,
    /// Four corners, by one determinant.
    pub corners: u64,
    /// Four edges, by minors of 256 bits.
    pub edges: u64,
    /// A disk on the normal at the end of an edge, by a form with at most one root.
    pub transitions: u64,
    /// Which of two governors leaves a path first.
    pub two_ends: u64,
    /// Pairs of doubles with a bound on their error.
    pub fine: u64,
    /// Exact disks built.
    pub disks: u64,
    /// The tower of roots, for a disk already built.
    pub tower: u64,
}

thread_local! {
    static COUNTS: Cell<Counts> = const {
        Cell::new(Counts { structure: 0, rounded: 0, dyadic: 0, corners: 0, edges: 0, transitions: 0, two_ends: 0, fine: 0, disks: 0, tower: 0 })
    };
}

/// The counts of this thread.
#[must_use]
pub fn counts() -> Counts {
    COUNTS.get()
}

/// Sets the counts of this thread to zero.
pub fn reset_counts() {
    COUNTS.set(Counts::default());
}

/// Changes the counts of this thread.
#[inline]
pub(super) fn count(change: impl FnOnce(&mut Counts)) {
    let mut counts = COUNTS.get();
    change(&mut counts);
    COUNTS.set(counts);
}
