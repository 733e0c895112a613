//! A file of Parquet whose pages are looked at before the library makes room for what they claim to hold.

use bytes::Bytes;
use parquet::errors::{ParquetError, Result};
use parquet::file::reader::{ChunkReader, Length};
use std::fs::File;
use std::io::{BufReader, Read};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Bytes that any page may have, however few it takes compressed; writers make pages of about one
/// mebibyte.
const PAGE_BYTES: i64 = 64 << 20;

/// How many times the bytes it takes compressed a larger page may have: a little more than deflate can do.
const RATIO: i64 = 1100;

/// Bytes of a header that are looked at; texts of statistics in it are a few at most.
const HEADER_BYTES: u64 = 1 << 20;

/// A file from which nothing but pages is read by [`ChunkReader::get_read`] once its metadata is.
pub(super) struct Pages {
    file: File,
    are_pages: Arc<AtomicBool>,
}

impl Pages {
    /// The file, and what is to be set as soon as pages are read.
    pub fn new(file: File) -> (Self, Arc<AtomicBool>) {
        let are_pages = Arc::new(AtomicBool::new(false));
        (Self { file, are_pages: Arc::clone(&are_pages) }, are_pages)
    }
}

impl Length for Pages {
    fn len(&self) -> u64 {
        Length::len(&self.file)
    }
}

impl ChunkReader for Pages {
    type T = BufReader<File>;

    fn get_read(&self, start: u64) -> Result<Self::T> {
        if self.are_pages.load(Ordering::Relaxed) {
            let mut source = self.file.get_read(start)?.take(HEADER_BYTES);
            // What is no header is for the library to tell.
            if let Some(header) = Header::read(&mut source) {
                header.check().map_err(ParquetError::General)?;
            }
        }
        self.file.get_read(start)
    }

    fn get_bytes(&self, start: u64, length: usize) -> Result<Bytes> {
        self.file.get_bytes(start, length)
    }
}

/// What a page says of its size.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Header {
    uncompressed: i64,
    compressed: i64,
    /// The number of values, if it is a dictionary.
    n_dictionary: i64,
}

impl Header {
    fn read(source: &mut impl Read) -> Option<Self> {
        let mut header = Self::default();
        fields(source, 0, &mut |path, value| match path {
            [2] => header.uncompressed = value,
            [3] => header.compressed = value,
            [7, 1] => header.n_dictionary = value,
            _ => {}
        })?;
        Some(header)
    }

    fn check(&self) -> std::result::Result<(), String> {
        let Self { uncompressed, compressed, n_dictionary } = *self;
        let most = PAGE_BYTES.max(compressed.saturating_mul(RATIO));
        if uncompressed > most {
            return Err(format!(
                "a page of {compressed} bytes claims to hold {uncompressed}, which is more than {most}"
            ));
        }
        if n_dictionary > uncompressed {
            return Err(format!(
                "a dictionary of {uncompressed} bytes claims to hold {n_dictionary} values"
            ));
        }
        Ok(())
    }
}

/// Deepest nesting of structures; those of Parquet are three deep.
const MAX_NESTING: usize = 8;

/// Reads a structure in Thrift's compact protocol, and tells all numbers in it and in those directly in it,
/// each behind the numbers of its fields.
fn fields(source: &mut impl Read, depth: usize, tell: &mut dyn FnMut(&[i64], i64)) -> Option<()> {
    if depth == MAX_NESTING {
        return None;
    }
    let mut field = 0_i64;
    loop {
        let head = byte(source)?;
        if head == 0 {
            return Some(());
        }
        field = match head >> 4 {
            0 => zigzag(varint(source)?),
            step => field + i64::from(step),
        };
        match head & 15 {
            4..=6 => tell(&[field], zigzag(varint(source)?)),
            12 => fields(source, depth + 1, &mut |path, value| {
                if let [inner] = path {
                    tell(&[field, *inner], value);
                }
            })?,
            kind => skip(source, kind, depth)?,
        }
    }
}

/// Passes over a value of a kind.
fn skip(source: &mut impl Read, kind: u8, depth: usize) -> Option<()> {
    match kind {
        1 | 2 => {}
        3 => drop(byte(source)?),
        4..=6 => drop(varint(source)?),
        7 => (0..8).try_for_each(|_| byte(source).map(drop))?,
        8 => {
            let size = varint(source)?;
            let passed = std::io::copy(&mut source.take(size), &mut std::io::sink()).ok()?;
            (passed == size).then_some(())?;
        }
        9 | 10 => {
            let head = byte(source)?;
            let count = if head >> 4 == 15 { varint(source)? } else { u64::from(head >> 4) };
            elements(source, count, &[head & 15], depth)?;
        }
        11 => {
            let count = varint(source)?;
            if count > 0 {
                let kinds = byte(source)?;
                elements(source, count, &[kinds >> 4, kinds & 15], depth)?;
            }
        }
        12 => fields(source, depth + 1, &mut |_, _| {})?,
        _ => return None,
    }
    Some(())
}

fn elements(source: &mut impl Read, count: u64, kinds: &[u8], depth: usize) -> Option<()> {
    if depth == MAX_NESTING {
        return None;
    }
    // Each takes a byte at least, booleans as well.
    (0..count).try_for_each(|_| {
        kinds.iter().try_for_each(|&kind| match kind {
            1 | 2 => byte(source).map(drop),
            kind => skip(source, kind, depth + 1),
        })
    })
}

fn byte(source: &mut impl Read) -> Option<u8> {
    let mut byte = [0];
    source.read_exact(&mut byte).ok()?;
    Some(byte[0])
}

fn varint(source: &mut impl Read) -> Option<u64> {
    let mut value = 0;
    for shift in (0..64).step_by(7) {
        let byte = byte(source)?;
        value |= u64::from(byte & 0x7f) << shift;
        if byte < 0x80 {
            return Some(value);
        }
    }
    None
}

fn zigzag(value: u64) -> i64 {
    (value >> 1) as i64 ^ -((value & 1) as i64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_header_tells_its_sizes() {
        // A dictionary page: type 2, 200 bytes, 40 compressed, then `{3 values, plain}`.
        let header = [0x15, 4, 0x15, 0x90, 3, 0x15, 80, 0x4c, 0x15, 6, 0x15, 0, 0, 0];
        let found = Header::read(&mut &header[..]).unwrap();
        assert_eq!(found, Header { uncompressed: 200, compressed: 40, n_dictionary: 3 });
        assert!(found.check().is_ok());
        assert_eq!(Header::read(&mut &header[..header.len() - 1]), None);
    }

    #[test]
    fn claims_beyond_any_ratio_are_refused() {
        let page = |uncompressed, compressed, n_dictionary| {
            Header { uncompressed, compressed, n_dictionary }.check().is_ok()
        };
        assert!(page(64 << 20, 100, 0));
        assert!(!page((64 << 20) + 1, 100, 0));
        assert!(page(1 << 30, 1 << 20, 0), "1024 times");
        assert!(!page(i64::from(i32::MAX), 1 << 20, 0));
        assert!(!page(100, 100, 101));
    }

    #[test]
    fn lists_and_texts_are_passed_over() {
        // Field 1: a list of two structures with a text each; field 3: the number 5.
        let bytes = [0x19, 0x2c, 0x18, 1, b'a', 0, 0x18, 0, 0, 0x25, 10, 0];
        let found = Header::read(&mut &bytes[..]).unwrap();
        assert_eq!(found, Header { compressed: 5, ..Header::default() });
        assert_eq!(Header::read(&mut [0x1c; 1000].as_slice()), None, "too deep");
    }
}
