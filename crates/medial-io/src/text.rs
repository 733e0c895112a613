use crate::Error;

/// The bytes of a file as text, without a byte order mark.
///
/// # Errors
/// If they are not UTF-8, naming the first line that is not.
pub fn text(bytes: &[u8]) -> Result<&str, Error> {
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let before = &bytes[..error.valid_up_to()];
        Error::NotUtf8 { line: 1 + before.iter().filter(|&&b| b == b'\n').count() }
    })?;
    Ok(text.strip_prefix('\u{feff}').unwrap_or(text))
}

/// The error `why` at this byte of the text.
pub(crate) fn syntax_at(text: &str, byte: usize, why: impl Into<String>) -> Error {
    let before = &text.as_bytes()[..byte.min(text.len())];
    let line = 1 + before.iter().filter(|&&b| b == b'\n').count();
    let line_start = before.iter().rposition(|&b| b == b'\n').map_or(0, |k| k + 1);
    Error::Syntax { line, column: 1 + before.len() - line_start, why: why.into() }
}

/// Where `part`, a slice of `text`, begins in it.
pub(crate) fn offset(text: &str, part: &str) -> usize {
    (part.as_ptr() as usize).saturating_sub(text.as_ptr() as usize).min(text.len())
}

/// The lines of a text that hold something, each with the byte where it begins.
pub(crate) fn lines(text: &str) -> impl Iterator<Item = &str> {
    text.lines()
        .map(|line| line.trim_matches(|c: char| c.is_whitespace() || c == '\u{1e}'))
        .filter(|line| !line.is_empty())
}

/// A text fit to stand in XML.
pub(crate) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            // Control characters have no place in XML 1.0.
            c if c.is_control() => out.push(' '),
            c => out.push(c),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_byte_order_mark_is_no_content() {
        assert_eq!(text(b"\xef\xbb\xbfPOINT").unwrap(), "POINT");
    }

    #[test]
    fn bytes_that_are_no_text_name_their_line() {
        let error = text(b"a\nb\xff").unwrap_err();
        assert_eq!(error.to_string(), "line 2: the bytes are not UTF-8; save the file as UTF-8");
    }
}
