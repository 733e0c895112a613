//! Numbers in sets that are joined.

/// The numbers from 0 on, each in a set of its own until sets are joined.
///
/// ```
/// use medial::geom::DisjointSets;
///
/// let mut sets = DisjointSets::new(4);
/// assert!(sets.join(3, 1));
/// assert!(!sets.join(1, 3));
/// assert_eq!([0, 1, 2, 3].map(|k| sets.first(k)), [0, 1, 2, 1]);
/// assert_eq!(sets.count(), 3);
/// ```
#[derive(Clone, Debug, Default)]
pub struct DisjointSets {
    /// A number of the same set that is not larger; of the least the number itself.
    below: Vec<u32>,
}

impl DisjointSets {
    /// So many numbers.
    ///
    /// # Panics
    /// If they are no numbers of 32 bits.
    #[must_use]
    pub fn new(n: usize) -> Self {
        assert!(u32::try_from(n).is_ok(), "{n} numbers");
        Self { below: (0..n as u32).collect() }
    }

    /// Adds the next number, in a set of its own.
    pub fn push(&mut self) {
        self.below.push(self.below.len() as u32);
    }

    /// The least number of the set of a number.
    ///
    /// # Panics
    /// If there is no such number.
    #[inline]
    pub fn first(&mut self, mut k: u32) -> u32 {
        while self.below[k as usize] != k {
            let further = self.below[self.below[k as usize] as usize];
            self.below[k as usize] = further;
            k = further;
        }
        k
    }

    /// Makes one set of those of two numbers; false if they are one already.
    ///
    /// # Panics
    /// If there is no such number.
    #[inline]
    pub fn join(&mut self, a: u32, b: u32) -> bool {
        let (a, b) = (self.first(a), self.first(b));
        self.below[a.max(b) as usize] = a.min(b);
        a != b
    }

    /// How many numbers there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.below.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.below.is_empty()
    }

    /// How many sets there are.
    #[must_use]
    pub fn count(&self) -> usize {
        (0..).zip(&self.below).filter(|&(k, &below)| k == below).count()
    }
}
