//! DXF, the drawing interchange format of CAD programs, as text or in binary.

mod chain;
mod entity;
mod groups;
mod hatch;
mod nest;
mod read;
mod write;

pub use read::read;
pub use write::{Entities, FOOTER, header, number};

/// Whether bytes begin like a drawing.
pub(crate) fn begins(bytes: &[u8]) -> bool {
    if bytes.starts_with(groups::BINARY) {
        return true;
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut lines = bytes.split(|b| *b == b'\n').map(|line| line.trim_ascii());
    // Comments may come first.
    let mut head = std::iter::from_fn(|| Some((lines.next()?, lines.next()?)));
    head.find(|(code, _)| *code != b"999") == Some((b"0", b"SECTION"))
}

#[cfg(test)]
mod tests;
