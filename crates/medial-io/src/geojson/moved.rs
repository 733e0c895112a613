//! Features with other coordinates.

use serde::Deserialize;
use serde_json::value::RawValue;

use crate::Error;
use crate::number::decimal;

#[derive(Deserialize)]
struct Head<'a> {
    #[serde(borrow)]
    geometry: Option<&'a RawValue>,
}

/// Features as they are written here, one after the other, each with the first two coordinates of all
/// positions of its geometry changed; all else stays as it is, byte by byte.
///
/// # Errors
/// If the bytes are no features.
pub fn moved(bytes: &[u8], map: impl Fn([f64; 2]) -> [f64; 2]) -> Result<Vec<u8>, Error> {
    let text = crate::text(bytes)?;
    let mut out = String::with_capacity(text.len());
    let mut rest = text;
    loop {
        let start = rest.find('{').unwrap_or(rest.len());
        out.push_str(&rest[..start]);
        rest = &rest[start..];
        if rest.is_empty() {
            return Ok(out.into_bytes());
        }
        let mut heads = serde_json::Deserializer::from_str(rest).into_iter::<Head>();
        let head = match heads.next() {
            Some(Ok(head)) => head,
            Some(Err(error)) => return Err(wrong(&error)),
            None => return Ok(out.into_bytes()),
        };
        let (feature, more) = rest.split_at(heads.byte_offset());
        match head.geometry {
            Some(geometry) => {
                // A part of the same text.
                let geometry = geometry.get();
                let at = geometry.as_ptr() as usize - feature.as_ptr() as usize;
                out.push_str(&feature[..at]);
                push_moved(&mut out, geometry, &map);
                out.push_str(&feature[at + geometry.len()..]);
            }
            None => out.push_str(feature),
        }
        rest = more;
    }
}

fn wrong(error: &serde_json::Error) -> Error {
    Error::Syntax { line: error.line(), column: error.column(), why: error.to_string() }
}

/// A geometry, which has no texts but its types, and no arrays of numbers but positions.
fn push_moved(out: &mut String, geometry: &str, map: impl Fn([f64; 2]) -> [f64; 2]) {
    let is_number = |c: char| matches!(c, '0'..='9' | '-' | '+' | '.' | 'e' | 'E');
    let mut rest = geometry;
    // A position begins with a bracket before a number.
    while let Some(start) = rest.find('[') {
        let (before, after) = rest.split_at(start + 1);
        out.push_str(before);
        rest = after;
        let inner = rest.trim_start();
        if !inner.starts_with(|c: char| c == '-' || c.is_ascii_digit()) {
            continue;
        }
        let next = |text: &str| -> Option<(f64, usize)> {
            let skipped = text.len() - text.trim_start_matches([' ', ',']).len();
            let len = text[skipped..].find(|c| !is_number(c))?;
            Some((text[skipped..skipped + len].parse().ok()?, skipped + len))
        };
        let Some((x, first)) = next(rest) else { continue };
        let Some((y, second)) = next(&rest[first..]) else { continue };
        let [x, y] = map([x, y]);
        decimal(x, |text| out.push_str(text));
        out.push(',');
        decimal(y, |text| out.push_str(text));
        rest = &rest[first + second..];
    }
    out.push_str(rest);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_positions_of_geometries_change() {
        let text = concat!(
            ",\n{\"type\":\"Feature\",\"properties\":{\"geometry\":[1,2],\"s\":\"\\\"coordinates\\\":[1,2]\"},",
            "\"geometry\":{\"type\":\"LineString\",\"coordinates\":[[1.0,2.0,9.5],[3e0,-4.0]]}}",
            ",\n{\"type\":\"Feature\",\"properties\":{},\"geometry\":{\"type\":\"Polygon\",\"coordinates\":",
            "[[[0.0, 0.5],[1.0,0.0]]]}},\n{\"type\":\"Feature\",\"geometry\":null,\"properties\":{}}\n",
        );
        let twice = moved(text.as_bytes(), |[x, y]| [2.0 * x, 4.0 * y]).unwrap();
        let expected = text
            .replace("[1.0,2.0,9.5]", "[2.0,8.0,9.5]")
            .replace("[3e0,-4.0]", "[6.0,-16.0]")
            .replace("[0.0, 0.5]", "[0.0,2.0]")
            .replace("[1.0,0.0]", "[2.0,0.0]");
        assert_eq!(String::from_utf8(twice).unwrap(), expected);
        assert!(moved(b"{\"geometry\":", |p| p).is_err());
    }
}
