//! Reading a column.

use super::numbers::signed;

/// What is left to read of a column.
pub struct Cursor {
    pub at: usize,
    pub end: usize,
}

/// Why a column cannot be read on, in words.
pub type Fault = String;

impl Cursor {
    /// How many bytes are left.
    pub fn left(&self) -> usize {
        self.end - self.at
    }

    /// The next bytes.
    pub fn bytes<'a>(&mut self, body: &'a [u8], n: usize) -> Result<&'a [u8], Fault> {
        if n > self.left() {
            return Err("it ends too early".to_owned());
        }
        self.at += n;
        Ok(&body[self.at - n..self.at])
    }

    pub fn byte(&mut self, body: &[u8]) -> Result<u8, Fault> {
        self.bytes(body, 1).map(|byte| byte[0])
    }

    /// The next number.
    pub fn number(&mut self, body: &[u8]) -> Result<u64, Fault> {
        let mut number = 0;
        for shift in (0..64).step_by(7) {
            let byte = self.byte(body)?;
            let bits = u64::from(byte & 0x7f);
            if bits << shift >> shift != bits {
                break;
            }
            number |= bits << shift;
            if byte < 0x80 {
                return Ok(number);
            }
        }
        Err("a number has more than 64 bits".to_owned())
    }

    /// The next number of either sign.
    pub fn signed(&mut self, body: &[u8]) -> Result<i64, Fault> {
        self.number(body).map(signed)
    }

    /// A count of things that take at least so many bytes of a column each.
    pub fn count(&mut self, body: &[u8], left: usize) -> Result<usize, Fault> {
        let count = self.number(body)?;
        let fits = usize::try_from(count).ok().filter(|&count| count <= left);
        fits.ok_or_else(|| format!("a count of {count} is more than there is"))
    }
}
