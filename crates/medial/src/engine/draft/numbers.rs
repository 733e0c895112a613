//! New numbers for some of many, in their order.

/// Numbers in a block; less than `UNMARKED`.
const BLOCK: usize = 128;

const UNMARKED: u8 = u8::MAX;

/// Which numbers below a bound are marked, and how many marked ones are less than each of them.
pub(super) struct Numbers {
    /// For each number how many marked ones there are before it in its block, or [`UNMARKED`].
    within: Vec<u8>,
    /// How many there are before each block.
    before: Vec<u32>,
    len: u32,
}

/// Numbers that are marked already.
pub(super) struct Marks(Vec<u8>);

impl Marks {
    /// Marks a number.
    #[inline]
    pub fn mark(&mut self, k: u32) {
        self.0[k as usize] = 0;
    }
}

impl Numbers {
    /// Marks some numbers, all less than `bound`.
    pub fn new(bound: usize, mark: impl FnOnce(&mut Marks)) -> Self {
        let mut marks = Marks(vec![UNMARKED; bound]);
        mark(&mut marks);
        let Marks(mut within) = marks;
        let mut before = Vec::with_capacity(bound.div_ceil(BLOCK));
        let mut len = 0;
        for block in within.chunks_mut(BLOCK) {
            before.push(len);
            let mut count = 0;
            for number in block {
                if *number != UNMARKED {
                    *number = count;
                    count += 1;
                }
            }
            len += u32::from(count);
        }
        Self { within, before, len }
    }

    /// How many are marked.
    pub fn len(&self) -> usize {
        self.len as usize
    }

    /// How many marked numbers are less than this marked one.
    #[inline]
    pub fn of(&self, k: u32) -> u32 {
        self.before[k as usize / BLOCK] + u32::from(self.within[k as usize])
    }

    /// Whether a number is marked.
    #[inline]
    pub fn has(&self, k: u32) -> bool {
        self.within[k as usize] != UNMARKED
    }
}

#[cfg(test)]
mod tests {
    use super::Numbers;

    #[test]
    fn marked_numbers_are_counted_in_their_order() {
        let marked = [130, 0, 127, 128, 63, 64, 63, 199];
        let numbers = Numbers::new(200, |marks| marked.into_iter().for_each(|k| marks.mark(k)));
        let all = (0..200).filter(|&k| numbers.has(k));
        assert_eq!(all.collect::<Vec<u32>>(), [0, 63, 64, 127, 128, 130, 199]);
        assert_eq!([0, 63, 64, 127, 128, 130, 199].map(|k| numbers.of(k)), [0, 1, 2, 3, 4, 5, 6]);
        assert_eq!(numbers.len(), 7);
        assert_eq!(Numbers::new(0, |_| {}).len(), 0);
    }

    #[test]
    fn a_block_may_be_full() {
        let numbers = Numbers::new(1000, |marks| (0..1000).for_each(|k| marks.mark(k)));
        assert!((0..1000).all(|k| numbers.of(k) == k));
    }
}
