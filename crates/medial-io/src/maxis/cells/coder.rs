//! An adaptive binary range coder.
//!
//! What is coded here are decisions with much context, such as whether a line goes on straight: each costs a
//! fraction of a bit, which deflate cannot give, whose least is one bit a symbol. Crates for range coding
//! bring models of symbols, not of decisions; the coder itself is the carry-propagating one that LZMA made
//! usual [Mar79], some sixty lines.
//!
//! Coding and decoding are one function over [`Coder`]: a decoder does not look at what it is given, and
//! returns what was coded.

/// How likely a decision is 1: two estimates, one that goes on adapting fast and one that does so slowly. The
/// first decisions count most, so that little is lost on learning.
#[derive(Clone, Copy, Debug)]
pub struct Context {
    fast: u16,
    slow: u16,
    seen: u8,
}

impl Default for Context {
    fn default() -> Self {
        Self::likely(1 << 15)
    }
}

/// The least shares of what an estimate is off that are taken back after each decision: one of so many.
const FAST: u8 = 16;
const SLOW: u8 = 128;

/// The least share, of 2^16, that either outcome has.
const LEAST: u32 = 96;

impl Context {
    /// The outcome 1 is expected with a share, of 2^16.
    pub const fn likely(share: u16) -> Self {
        Self { fast: share, slow: share, seen: 0 }
    }

    /// The share, of 2^16, of the outcome 1.
    #[inline]
    fn share(self) -> u32 {
        let mean = (u32::from(self.fast) + u32::from(self.slow)) / 2;
        mean.clamp(LEAST, (1 << 16) - LEAST)
    }

    #[inline]
    fn learn(&mut self, bit: bool) {
        let step = |share: u16, most: u8| {
            let of = u16::from((self.seen + 2).min(most));
            if bit { share + (u16::MAX - share) / of } else { share - share / of }
        };
        (self.fast, self.slow) = (step(self.fast, FAST), step(self.slow, SLOW));
        self.seen = (self.seen + 1).min(SLOW);
    }
}

/// Writes decisions, or reads them.
pub trait Coder {
    /// Codes a decision, and returns it; a decoder returns the one that was coded.
    fn bit(&mut self, context: &mut Context, bit: bool) -> bool;

    /// Whether all was read that was written, and more is asked for.
    fn is_spent(&self) -> bool;

    /// Codes the low bits of a number, the high ones first, each as likely as not.
    fn plain(&mut self, number: u64, bits: u32) -> u64 {
        (0..bits).rev().fold(0, |read, bit| {
            let mut even = Context::default();
            read << 1 | u64::from(self.bit(&mut even, number >> bit & 1 != 0))
        })
    }
}

/// A range is kept at least so large.
const SMALL: u32 = 1 << 24;

/// Writes decisions as bytes.
pub struct Encoder {
    low: u64,
    range: u32,
    /// The last byte, which a carry may still change, and how many bytes `ff` follow it.
    last: u8,
    n_full: u64,
    bytes: Vec<u8>,
}

impl Encoder {
    pub fn new() -> Self {
        Self { low: 0, range: u32::MAX, last: 0, n_full: 0, bytes: Vec::new() }
    }

    fn shift(&mut self) {
        if self.low < 0xff00_0000 || self.low > 0xffff_ffff {
            let carry = (self.low >> 32) as u8;
            self.bytes.push(self.last.wrapping_add(carry));
            for _ in 0..self.n_full {
                self.bytes.push(0xff_u8.wrapping_add(carry));
            }
            (self.n_full, self.last) = (0, (self.low >> 24) as u8);
        } else {
            self.n_full += 1;
        }
        self.low = (self.low & 0x00ff_ffff) << 8;
    }

    /// The bytes: as few as tell all decisions, as zeros follow for the reader.
    pub fn finish(mut self) -> Vec<u8> {
        // The number in the range with the most zeros at its end.
        let last = self.low + u64::from(self.range) - 1;
        let zeros = (0..32).rev().find(|&zeros| last >> zeros << zeros >= self.low).unwrap_or(0);
        self.low = last >> zeros << zeros;
        for _ in 0..5 {
            self.shift();
        }
        let end = self.bytes.len();
        let zeros = self.bytes.iter().rev().take(SLACK).take_while(|&&byte| byte == 0).count();
        // The first byte is that of the carry of nothing.
        self.bytes.truncate(end - zeros);
        self.bytes.drain(..1.min(end - zeros));
        self.bytes
    }
}

impl Coder for Encoder {
    #[inline]
    fn bit(&mut self, context: &mut Context, bit: bool) -> bool {
        let bound = (self.range >> 16) * context.share();
        if bit {
            self.range = bound;
        } else {
            self.low += u64::from(bound);
            self.range -= bound;
        }
        context.learn(bit);
        while self.range < SMALL {
            self.range <<= 8;
            self.shift();
        }
        bit
    }

    fn is_spent(&self) -> bool {
        false
    }
}

/// How many zeros an encoder may leave out at the end.
const SLACK: usize = 4;

/// Reads decisions from bytes.
pub struct Decoder<'a> {
    bytes: &'a [u8],
    at: usize,
    code: u32,
    range: u32,
}

impl<'a> Decoder<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        let mut decoder = Self { bytes, at: 0, code: 0, range: u32::MAX };
        (0..4).for_each(|_| decoder.pull());
        decoder
    }

    #[inline]
    fn pull(&mut self) {
        let byte = self.bytes.get(self.at).copied().unwrap_or(0);
        self.code = self.code << 8 | u32::from(byte);
        self.at += 1;
    }

    /// Whether all bytes were looked at.
    pub fn is_done(&self) -> bool {
        self.at >= self.bytes.len()
    }
}

impl Coder for Decoder<'_> {
    #[inline]
    fn bit(&mut self, context: &mut Context, _: bool) -> bool {
        let bound = (self.range >> 16) * context.share();
        let bit = self.code < bound;
        if bit {
            self.range = bound;
        } else {
            self.code -= bound;
            self.range -= bound;
        }
        context.learn(bit);
        while self.range < SMALL {
            self.range <<= 8;
            self.pull();
        }
        bit
    }

    #[inline]
    fn is_spent(&self) -> bool {
        self.at > self.bytes.len() + SLACK
    }
}

/// Numbers of any size, of which small ones, or those of one size, are likely.
#[derive(Clone, Debug)]
pub struct Numbers {
    lengths: [Context; 65],
    /// The bits behind the first one, the high ones by the bits before them.
    bits: Vec<[Context; 8]>,
}

impl Default for Numbers {
    fn default() -> Self {
        Self { lengths: [Context::default(); 65], bits: vec![[Context::default(); 8]; 65] }
    }
}

impl Numbers {
    /// Codes a number below 2^63.
    pub fn code(&mut self, coder: &mut impl Coder, number: u64) -> u64 {
        // One more than the number has a first bit.
        let number = number.wrapping_add(1);
        let own = 63 - number.max(1).leading_zeros();
        let mut length = 0;
        while length < 63 && coder.bit(&mut self.lengths[length as usize], length < own) {
            length += 1;
        }
        let mut read = 1_u64;
        for k in (0..length).rev() {
            let given = number >> k & 1 != 0;
            // The two bits after the first have contexts, by the bit before them; the rest is even.
            let bit = if length - k <= 2 {
                coder.bit(
                    &mut self.bits[length as usize]
                        [(read & 3) as usize + 4 * usize::from(length - k == 2)],
                    given,
                )
            } else {
                coder.plain(u64::from(given), 1) != 0
            };
            read = read << 1 | u64::from(bit);
        }
        read - 1
    }

    /// Codes a number of either sign.
    pub fn signed(&mut self, coder: &mut impl Coder, sign: &mut Context, number: i64) -> i64 {
        let size = self.code(coder, number.unsigned_abs()) as i64;
        if size != 0 && coder.bit(sign, number < 0) { size.wrapping_neg() } else { size }
    }
}

/// Numbers below a limit, of which some parts of the range may be likelier than others.
#[derive(Clone, Debug)]
pub struct Places {
    /// How many bits the limit has.
    bits: u32,
    /// For the first bits, by those before them.
    high: Vec<Context>,
}

/// How many bits have contexts.
const HIGH: u32 = 5;

impl Places {
    pub fn below(limit: u32) -> Self {
        let bits = 32 - limit.saturating_sub(1).leading_zeros();
        Self { bits, high: vec![Context::default(); 1 << HIGH] }
    }

    pub fn code(&mut self, coder: &mut impl Coder, number: u32) -> u32 {
        let mut read = 1_u32;
        let high = self.bits.min(HIGH);
        for k in (self.bits - high..self.bits).rev() {
            let bit = coder.bit(&mut self.high[read as usize], number >> k & 1 != 0);
            read = read << 1 | u32::from(bit);
        }
        let low = self.bits - high;
        (read - (1 << high)) << low | coder.plain(number.into(), low) as u32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn dice(seed: u64) -> impl FnMut() -> u64 {
        let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
        move || {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            state.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 33
        }
    }

    #[test]
    fn decisions_come_back_however_likely_they_are() {
        for seed in 1..400 {
            let mut next = dice(seed);
            let (n, share) = (next() as usize % 3000, next() % 1001);
            let bits: Vec<(usize, bool)> =
                (0..n).map(|_| (next() as usize % 3, next() % 1000 < share)).collect();
            let mut encoder = Encoder::new();
            let mut contexts = [Context::default(); 3];
            bits.iter().for_each(|&(k, bit)| {
                encoder.bit(&mut contexts[k], bit);
            });
            let bytes = encoder.finish();
            let mut decoder = Decoder::new(&bytes);
            let mut contexts = [Context::default(); 3];
            for &(k, bit) in &bits {
                assert_eq!(decoder.bit(&mut contexts[k], false), bit, "{seed}");
                assert!(!decoder.is_spent(), "{seed}");
            }
            assert!(decoder.is_done(), "{seed}");
        }
    }

    #[test]
    fn a_sure_thing_costs_next_to_nothing() {
        let mut encoder = Encoder::new();
        let mut context = Context::default();
        (0..10_000).for_each(|_| {
            encoder.bit(&mut context, true);
        });
        // Learning takes a byte or two; then each costs log2(1 / (1 - 96 / 2^16)) bits, which is 0.0021.
        assert!(encoder.finish().len() < 32);
    }

    #[test]
    fn numbers_come_back() {
        let numbers = [0, 1, 2, 3, 7, 8, 1000, 1 << 40, (1 << 62) - 2];
        let mut encoder = Encoder::new();
        let (mut model, mut sign, mut places) =
            (Numbers::default(), Context::default(), Places::below(1000));
        for &number in &numbers {
            model.code(&mut encoder, number);
            model.signed(&mut encoder, &mut sign, -(number as i64));
            places.code(&mut encoder, number as u32 % 1000);
        }
        let bytes = encoder.finish();
        let mut decoder = Decoder::new(&bytes);
        let (mut model, mut sign, mut places) =
            (Numbers::default(), Context::default(), Places::below(1000));
        for &number in &numbers {
            assert_eq!(model.code(&mut decoder, 0), number);
            assert_eq!(model.signed(&mut decoder, &mut sign, 0), -(number as i64));
            assert_eq!(places.code(&mut decoder, 0), number as u32 % 1000);
        }
        assert!(!decoder.is_spent());
    }
}
