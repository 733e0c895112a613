//! Numbers taken one after the other from the input; zeros when it has run out.

use medial::geom::Point;

/// What is left of the input.
pub struct Bytes<'a>(pub &'a [u8]);

impl Bytes<'_> {
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub fn byte(&mut self) -> u8 {
        let Some((&first, rest)) = self.0.split_first() else { return 0 };
        self.0 = rest;
        first
    }

    /// A whole number below `n`, at most 256.
    pub fn below(&mut self, n: usize) -> usize {
        usize::from(self.byte()) % n
    }

    /// A whole number from 0 to 65535.
    pub fn short(&mut self) -> f64 {
        f64::from(u16::from_le_bytes([self.byte(), self.byte()]))
    }

    /// Any double, with nothing left out.
    pub fn double(&mut self) -> f64 {
        let bytes: [u8; 8] = std::array::from_fn(|_| self.byte());
        f64::from_le_bytes(bytes)
    }

    /// A double from 0 to 1 with all bits of its fraction in use.
    pub fn unit(&mut self) -> f64 {
        let coarse = self.short();
        // Spread two bytes over the fraction, so that short inputs give full doubles.
        (coarse + (coarse * 0.618_033_988_749_894_9).fract()) / 65537.0
    }

    /// A double from -1 to 1.
    pub fn signed(&mut self) -> f64 {
        2.0 * self.unit() - 1.0
    }

    pub fn grid_point(&mut self, size: usize) -> Point {
        let x = self.below(size + 1) as f64;
        Point::new(x, self.below(size + 1) as f64)
    }
}
