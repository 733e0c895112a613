//! New numbers for some of many, in their order.

/// A number of nothing that is marked.
const NONE: u32 = u32::MAX;

/// Which numbers below a bound are marked, and how many marked ones are less than each of them.
pub(super) struct Numbers {
    numbers: Vec<u32>,
    len: u32,
}

impl Numbers {
    /// Marks these numbers, all less than `bound`.
    pub fn new(bound: usize, marked: &[u32]) -> Self {
        let mut numbers = vec![0; bound];
        for &k in marked {
            numbers[k as usize] = 1;
        }
        let mut len = 0;
        for number in &mut numbers {
            let next = len + *number;
            *number = if *number == 0 { NONE } else { len };
            len = next;
        }
        Self { numbers, len }
    }

    /// How many are marked.
    pub fn len(&self) -> usize {
        self.len as usize
    }

    /// How many marked numbers are less than this marked one.
    #[inline]
    pub fn of(&self, k: u32) -> u32 {
        self.numbers[k as usize]
    }

    /// Whether a number is marked.
    #[inline]
    pub fn has(&self, k: u32) -> bool {
        self.numbers[k as usize] != NONE
    }
}

#[cfg(test)]
mod tests {
    use super::Numbers;

    #[test]
    fn marked_numbers_are_counted_in_their_order() {
        let marked = [130, 0, 63, 64, 63, 199];
        let numbers = Numbers::new(200, &marked);
        let all = (0..200).filter(|&k| numbers.has(k));
        assert_eq!(all.collect::<Vec<u32>>(), [0, 63, 64, 130, 199]);
        assert_eq!([0, 63, 64, 130, 199].map(|k| numbers.of(k)), [0, 1, 2, 3, 4]);
        assert_eq!(numbers.len(), 5);
        assert_eq!(Numbers::new(0, &[]).len(), 0);
    }
}
