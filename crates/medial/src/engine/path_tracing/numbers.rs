//! New numbers for a few of many, in their order.

/// Which numbers below a bound are marked: a bit each, and how many are marked before each word.
pub(super) struct Numbers {
    words: Vec<u64>,
    before: Vec<u32>,
}

impl Numbers {
    /// Marks these numbers, all less than `bound`.
    pub fn new(bound: usize, marked: &[u32]) -> Self {
        let mut words = vec![0_u64; bound.div_ceil(64)];
        for &k in marked {
            words[k as usize / 64] |= 1 << (k % 64);
        }
        let mut sum = 0;
        let mut before = Vec::with_capacity(words.len() + 1);
        before.push(0);
        before.extend(words.iter().map(|word| {
            sum += word.count_ones();
            sum
        }));
        Self { words, before }
    }

    /// How many are marked.
    pub fn len(&self) -> usize {
        self.before.last().map_or(0, |&n| n as usize)
    }

    /// How many marked numbers are less than this one.
    pub fn of(&self, k: u32) -> u32 {
        let word = k as usize / 64;
        let less = self.words[word] & ((1 << (k % 64)) - 1);
        self.before[word] + less.count_ones()
    }

    /// The marked numbers in order.
    pub fn marked(&self) -> impl Iterator<Item = u32> {
        (0_u32..).zip(&self.words).flat_map(|(k, &word)| {
            let mut rest = word;
            std::iter::from_fn(move || {
                let bit = (rest != 0).then(|| rest.trailing_zeros())?;
                rest &= rest - 1;
                Some(64 * k + bit)
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Numbers;

    #[test]
    fn marked_numbers_are_counted_across_words() {
        let marked = [130, 0, 63, 64, 63, 199];
        let numbers = Numbers::new(200, &marked);
        assert_eq!(numbers.marked().collect::<Vec<u32>>(), [0, 63, 64, 130, 199]);
        assert_eq!([0, 63, 64, 130, 199].map(|k| numbers.of(k)), [0, 1, 2, 3, 4]);
        assert_eq!((numbers.of(129), numbers.len()), (3, 5));
        assert_eq!(Numbers::new(0, &[]).len(), 0);
    }
}
