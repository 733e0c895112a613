//! What the JSON formats share.

use crate::text::{offset, syntax_at};
use crate::{Error, Json};
use medial::geom::Point;
use serde::de::{Error as _, IgnoredAny, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use serde_json::value::RawValue;
use std::borrow::Cow;
use std::fmt;

/// Parses `part`, a slice of `text`, so that errors name the line of `text`.
pub(crate) fn parse<'a, T: Deserialize<'a>>(text: &str, part: &'a str) -> Result<T, Error> {
    serde_json::from_str(part).map_err(|error| locate(text, part, &error))
}

/// The error of the parser in terms of the whole text.
fn locate(text: &str, part: &str, error: &serde_json::Error) -> Error {
    let inside: usize =
        part.split_inclusive('\n').take(error.line().saturating_sub(1)).map(str::len).sum();
    let byte = offset(text, part) + inside + error.column().saturating_sub(1);
    let why = error.to_string();
    // The parser ends its message with its own place.
    let why = why.rsplit_once(" at line ").map_or(why.as_str(), |(why, _)| why);
    let why = why.replace("expected f64", "expected a number");
    syntax_at(text, byte, not_finite(part, byte - offset(text, part), &why).unwrap_or(why))
}

/// What to say of a number at this byte of `part` that is too large, or that JSON does not have:
/// the vertex it belongs to.
fn not_finite(part: &str, byte: usize, why: &str) -> Option<String> {
    let before = part.get(..byte.min(part.len()))?;
    // The parser may have begun with the token.
    let before = before.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let token =
        part[before.len()..].split(|c: char| !c.is_ascii_alphabetic()).next().unwrap_or_default();
    let why = if why == "number out of range" {
        "the number is out of range"
    } else if ["nan", "inf", "infinity"].contains(&token.to_ascii_lowercase().as_str()) {
        "a coordinate is not finite, and no JSON"
    } else if token == "null" {
        "a coordinate is nothing, or not finite"
    } else {
        return None;
    };
    // Bare arrays begin with their bracket, coordinates stand behind their name.
    let before = match before.rsplit_once("\"coordinates\"") {
        Some((_, coordinates)) => coordinates,
        None if before.trim_start().starts_with('[') => before,
        None => return None,
    };
    let mut places = Vec::new();
    for byte in before.bytes() {
        match byte {
            b'[' => places.push(0_usize),
            b']' => drop(places.pop()),
            b',' => *places.last_mut()? += 1,
            _ => {}
        }
    }
    match places[..] {
        [ring, vertex, _] => Some(format!("ring {ring}, vertex {vertex}: {why}")),
        [polygon, ring, vertex, _] => {
            Some(format!("polygon {polygon}, ring {ring}, vertex {vertex}: {why}"))
        }
        _ => None,
    }
}

/// JSON with `null` for the infinities, and numbers that are none, as many programs write them; `None` if
/// there are none.
pub(crate) fn without_infinities(text: &str) -> Option<String> {
    let bytes = text.as_bytes();
    let (mut finite, mut copied) = (String::new(), 0);
    let mut at = 0;
    while let Some(&byte) = bytes.get(at) {
        let start = at;
        at += 1;
        if byte == b'"' {
            // To the end of the string.
            while let Some(&byte) = bytes.get(at) {
                at += if byte == b'\\' { 2 } else { 1 };
                if byte == b'"' {
                    break;
                }
            }
        } else if byte.is_ascii_alphabetic() {
            let rest = bytes[start..].iter().take_while(|byte| byte.is_ascii_alphabetic());
            at = start + rest.count();
            if ["nan", "inf", "infinity"].contains(&text[start..at].to_ascii_lowercase().as_str()) {
                finite.push_str(text[copied..start].trim_end_matches('-'));
                finite.push_str("null");
                copied = at;
            }
        }
    }
    (copied > 0).then(|| finite + &text[copied..])
}

/// The `type` of a JSON object.
#[derive(Deserialize)]
#[serde(expecting = "a JSON object")]
pub(crate) struct Head<'a> {
    #[serde(borrow, default, rename = "type")]
    pub kind: Option<Cow<'a, str>>,
}

impl<'a> Head<'a> {
    /// The head of the first document in `start`, a slice of `text`, and what follows it.
    pub fn first(text: &str, start: &'a str) -> Result<(Self, &'a str), Error> {
        let mut stream = serde_json::Deserializer::from_str(start).into_iter::<Self>();
        match stream.next() {
            Some(Ok(head)) => Ok((head, &start[stream.byte_offset()..])),
            Some(Err(error)) => Err(locate(text, start, &error)),
            None => Err(Error::Empty),
        }
    }
}

/// The members of an object in their order, values as written.
#[derive(Default)]
pub(crate) struct Members(pub Vec<(String, Json)>);

impl<'de> Deserialize<'de> for Members {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Each;
        impl<'de> Visitor<'de> for Each {
            type Value = Members;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object of properties")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Members, A::Error> {
                let mut members = Vec::new();
                while let Some(member) = map.next_entry()? {
                    members.push(member);
                }
                Ok(Members(members))
            }
        }
        deserializer.deserialize_map(Each)
    }
}

/// A position: its first two numbers; heights and measures are ignored.
pub(crate) struct Position(pub Point);

impl<'de> Deserialize<'de> for Position {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Numbers;
        impl<'de> Visitor<'de> for Numbers {
            type Value = Position;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a position [x, y]")
            }

            fn visit_seq<A: SeqAccess<'de>>(self, mut numbers: A) -> Result<Position, A::Error> {
                let mut next = || {
                    numbers
                        .next_element::<f64>()?
                        .ok_or_else(|| A::Error::custom("a position needs two numbers"))
                };
                let point = Point::new(next()?, next()?);
                while numbers.next_element::<IgnoredAny>()?.is_some() {}
                Ok(Position(point))
            }
        }
        deserializer.deserialize_seq(Numbers)
    }
}

/// A ring of positions.
pub(crate) type Ring = Vec<Position>;

/// The points of rings of positions.
pub(crate) fn points(rings: Vec<Ring>) -> Vec<Vec<Point>> {
    rings.into_iter().map(|ring| ring.into_iter().map(|p| p.0).collect()).collect()
}

/// A JSON value without white space between its tokens, so that it fits on one line.
pub(crate) fn compact(value: &RawValue) -> Cow<'_, str> {
    if !value.get().bytes().any(|byte| byte.is_ascii_whitespace()) {
        return value.get().into();
    }
    let (mut in_string, mut escaped) = (false, false);
    let keep = |c: &char| {
        if in_string {
            in_string = escaped || *c != '"';
            escaped = !escaped && *c == '\\';
            true
        } else {
            in_string = *c == '"';
            !c.is_ascii_whitespace()
        }
    };
    value.get().chars().filter(keep).collect()
}

/// A text as a JSON string.
pub(crate) fn quoted(text: &str) -> Json {
    raw(serde_json::to_string(text))
}

/// A number as JSON; `null` if it is not finite.
pub(crate) fn real(value: f64) -> Json {
    raw(serde_json::to_string(&value))
}

/// A whole number as JSON.
pub(crate) fn whole(value: i64) -> Json {
    raw(serde_json::to_string(&value))
}

fn raw(json: Result<String, serde_json::Error>) -> Json {
    // Texts and numbers always have a JSON form.
    json.and_then(RawValue::from_string).unwrap_or_else(|_| RawValue::NULL.to_owned())
}

/// Appends a text as a JSON string.
pub(crate) fn push_quoted(out: &mut Vec<u8>, text: &str) {
    // Text always has a JSON form, and memory takes all that is written.
    let _ = serde_json::to_writer(out, text);
}
