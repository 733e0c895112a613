//! What gzip has packed [RFC 1952].

use crate::Error;
use miniz_oxide::inflate::decompress_slice_iter_to_slice;
use std::borrow::Cow;

/// How packed bytes begin.
pub(crate) const MAGIC: [u8; 2] = [0x1f, 0x8b];

/// Most bytes that are unpacked; protects the memory against made-up input.
const MOST: usize = 1 << 28;

/// Bytes as they were before they were packed, if they are.
///
/// # Errors
/// If they are damaged, or become too many.
pub(crate) fn unpacked(bytes: &[u8]) -> Result<Cow<'_, [u8]>, Error> {
    if !bytes.starts_with(&MAGIC) {
        return Ok(bytes.into());
    }
    let damaged = || Error::File {
        why: "its packed content is damaged or cut off; copy it again".to_owned(),
    };
    let body = body(bytes).ok_or_else(damaged)?;
    let (body, end) = body.split_last_chunk::<8>().ok_or_else(damaged)?;
    let [a, b, c, d, size @ ..] = *end;
    let size = u32::from_le_bytes(size) as usize;
    if size > MOST {
        let why = format!("its content is {size} bytes, more than {MOST}; unpack it");
        return Err(Error::File { why });
    }
    // No more memory than it says, however much there is.
    let mut plain = vec![0; size];
    let n = decompress_slice_iter_to_slice(&mut plain, std::iter::once(body), false, true);
    let sum = u32::from_le_bytes([a, b, c, d]);
    if n != Ok(size) || sum != crc32fast::hash(&plain) {
        return Err(damaged());
    }
    Ok(plain.into())
}

/// What follows the header.
fn body(bytes: &[u8]) -> Option<&[u8]> {
    let &[_, _, 8, flags, _, _, _, _, _, _, ref rest @ ..] = bytes else { return None };
    let mut rest = rest;
    if flags & 4 != 0 {
        let (size, more) = rest.split_first_chunk()?;
        rest = more.get(usize::from(u16::from_le_bytes(*size))..)?;
    }
    // A name, and a comment.
    for flag in [8, 16] {
        if flags & flag != 0 {
            let end = rest.iter().position(|&byte| byte == 0)?;
            rest = &rest[end + 1..];
        }
    }
    if flags & 2 != 0 { rest.get(2..) } else { Some(rest) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `<svg/>` with all there can be in a header.
    fn packed() -> Vec<u8> {
        let plain = b"<svg/>";
        let mut bytes = vec![0x1f, 0x8b, 8, 2 | 4 | 8 | 16, 0, 0, 0, 0, 0, 255];
        bytes.extend([3, 0, 1, 2, 3]);
        bytes.extend(b"a.svg\0made by hand\0");
        bytes.extend([7, 7]);
        bytes.extend(miniz_oxide::deflate::compress_to_vec(plain, 6));
        bytes.extend(crc32fast::hash(plain).to_le_bytes());
        bytes.extend((plain.len() as u32).to_le_bytes());
        bytes
    }

    #[test]
    fn what_was_packed_is_unpacked() {
        assert_eq!(&*unpacked(&packed()).unwrap(), b"<svg/>");
        assert_eq!(&*unpacked(b"<svg/>").unwrap(), b"<svg/>");
    }

    #[test]
    fn what_is_larger_than_it_says_or_may_be_is_refused() {
        let with_size = |size: u32| {
            let mut packed = packed();
            let at = packed.len() - 4;
            packed[at..].copy_from_slice(&size.to_le_bytes());
            unpacked(&packed).map(|_| ()).map_err(|error| error.to_string())
        };
        assert_eq!(with_size(6), Ok(()));
        for size in [0, 5, 7, 1 << 28] {
            assert!(with_size(size).is_err_and(|why| why.contains("damaged")), "{size}");
        }
        assert!(with_size((1 << 28) + 1).is_err_and(|why| why.ends_with("; unpack it")));
    }

    #[test]
    fn what_is_damaged_is_refused() {
        let packed = packed();
        for end in 2..packed.len() {
            assert!(unpacked(&packed[..end]).is_err(), "{end}");
        }
        let mut wrong = packed;
        let at = wrong.len() - 8;
        wrong[at] ^= 1;
        assert!(unpacked(&wrong).is_err());
    }
}
