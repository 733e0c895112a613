//! Reads GeoJSON as most programs write it, in one pass and without copies.
//!
//! # Contract
//! What it takes is valid, and it gives what the parser gives, number for number.
//! What is malformed, or only unusual, gives `None`: then the parser takes over and tells.

use medial::geom::Point;

/// A collection of features, values not yet looked into.
pub(super) struct Collection<'a> {
    pub features: Vec<&'a str>,
    pub crs: Option<&'a str>,
}

/// A feature with one polygon or several.
pub(super) struct Polygonal<'a> {
    pub id: Option<&'a str>,
    pub properties: Option<&'a str>,
    /// Whether it is a multipolygon.
    pub multi: bool,
    pub polygons: Vec<Vec<Vec<Point>>>,
}

/// The features of a collection, if the text is one.
pub(super) fn collection(text: &str) -> Option<Collection<'_>> {
    let mut cursor = Cursor { text, at: 0 };
    let (mut is_collection, mut features, mut crs) = (false, None, None);
    cursor.members(|cursor, name| match name {
        "type" if !is_collection => {
            is_collection = cursor.plain_string()? == "FeatureCollection";
            is_collection.then_some(())
        }
        "features" if features.is_none() => {
            features = Some(cursor.list(0, Cursor::value)?);
            Some(())
        }
        "crs" if crs.is_none() => {
            crs = Some(cursor.value()?);
            Some(())
        }
        _ => cursor.other(name),
    })?;
    cursor.space();
    (is_collection && cursor.at == text.len()).then_some(())?;
    Some(Collection { features: features?, crs: crs.filter(|&crs| crs != NULL) })
}

/// The feature in `part`, if it is polygonal.
pub(super) fn polygonal(part: &str) -> Option<Polygonal<'_>> {
    let mut cursor = Cursor { text: part, at: 0 };
    let (mut is_feature, mut id, mut properties, mut geometry) = (false, None, None, None);
    cursor.members(|cursor, name| match name {
        "type" if !is_feature => {
            is_feature = cursor.plain_string()? == "Feature";
            is_feature.then_some(())
        }
        "id" if id.is_none() => {
            id = Some(cursor.value()?);
            Some(())
        }
        "properties" if properties.is_none() => {
            properties = Some(cursor.value()?);
            Some(())
        }
        "geometry" if geometry.is_none() => {
            geometry = Some(cursor.polygons()?);
            Some(())
        }
        _ => cursor.other(name),
    })?;
    cursor.space();
    (is_feature && cursor.at == part.len()).then_some(())?;
    let (multi, polygons) = geometry?;
    let present = |value: Option<_>| value.filter(|&value| value != NULL);
    Some(Polygonal { id: present(id), properties: present(properties), multi, polygons })
}

const NULL: &str = "null";

/// Members that mean something; the parser tells what is wrong with them in an odd place.
const NAMES: [&str; 8] =
    ["type", "features", "geometry", "geometries", "coordinates", "properties", "id", "crs"];

/// Points to make room for in a ring, and in other lists.
const RING: usize = 16;
const FEW: usize = 1;

/// Deepest nesting that is followed.
const DEEPEST: u32 = u64::BITS;

/// Powers of ten that are doubles, as are their quotients into whole numbers up to 2^53, rounded
/// once.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19, 1e20, 1e21, 1e22,
];

/// Digits that a `u64` always holds.
const DIGITS: usize = 19;

/// A place in a text.
struct Cursor<'a> {
    text: &'a str,
    at: usize,
}

impl<'a> Cursor<'a> {
    #[inline]
    fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    #[inline]
    fn space(&mut self) {
        while let Some(b' ' | b'\n' | b'\r' | b'\t') = self.peek() {
            self.at += 1;
        }
    }

    /// Passes this byte, if it comes next behind white space.
    #[inline]
    fn has(&mut self, byte: u8) -> bool {
        self.space();
        let has = self.peek() == Some(byte);
        self.at += usize::from(has);
        has
    }

    #[inline]
    fn take(&mut self, byte: u8) -> Option<()> {
        self.has(byte).then_some(())
    }

    /// Calls `member` with the name of each member of an object, at its value.
    fn members(&mut self, mut member: impl FnMut(&mut Self, &'a str) -> Option<()>) -> Option<()> {
        self.take(b'{')?;
        loop {
            let name = self.plain_string()?;
            self.take(b':')?;
            member(self, name)?;
            if !self.has(b',') {
                return self.take(b'}');
            }
        }
    }

    /// Passes the value of a member that means nothing.
    fn other(&mut self, name: &str) -> Option<()> {
        (!NAMES.contains(&name)).then_some(())?;
        self.value().map(drop)
    }

    fn list<T>(
        &mut self,
        room: usize,
        mut item: impl FnMut(&mut Self) -> Option<T>,
    ) -> Option<Vec<T>> {
        self.take(b'[')?;
        if self.has(b']') {
            return Some(Vec::new());
        }
        let mut items = Vec::with_capacity(room);
        loop {
            items.push(item(self)?);
            if !self.has(b',') {
                self.take(b']')?;
                return Some(items);
            }
        }
    }

    /// A geometry of polygons, and whether it is a multipolygon.
    fn polygons(&mut self) -> Option<(bool, Vec<Vec<Vec<Point>>>)> {
        let (mut multi, mut polygons) = (None, None);
        self.members(|cursor, name| match name {
            "type" if multi.is_none() => {
                multi = Some(match cursor.plain_string()? {
                    "Polygon" => false,
                    "MultiPolygon" => true,
                    _ => return None,
                });
                Some(())
            }
            "coordinates" if polygons.is_none() => {
                // Only of use if the type stands before them.
                polygons = Some(match multi? {
                    false => vec![cursor.rings()?],
                    true => cursor.list(FEW, Self::rings)?,
                });
                Some(())
            }
            _ => cursor.other(name),
        })?;
        multi.zip(polygons)
    }

    fn rings(&mut self) -> Option<Vec<Vec<Point>>> {
        self.list(FEW, |cursor| cursor.list(RING, Self::position))
    }

    /// A position: its first two numbers.
    #[inline]
    fn position(&mut self) -> Option<Point> {
        self.take(b'[')?;
        let x = self.coordinate()?;
        self.take(b',')?;
        let y = self.coordinate()?;
        while self.has(b',') {
            self.value()?;
        }
        self.take(b']')?;
        Some(Point::new(x, y))
    }

    /// A number as the double nearest to it.
    #[inline]
    fn coordinate(&mut self) -> Option<f64> {
        self.space();
        let start = self.at;
        let negative = self.peek() == Some(b'-');
        self.at += usize::from(negative);
        let mut whole = 0;
        let first = self.at;
        self.digits(&mut whole)?;
        let mut n_digits = self.at - first;
        // No number begins with a zero that means nothing.
        (n_digits == 1 || self.text.as_bytes()[first] != b'0').then_some(())?;
        let mut places = 0;
        if self.peek() == Some(b'.') {
            self.at += 1;
            let point = self.at;
            self.digits(&mut whole)?;
            places = self.at - point;
            n_digits += places;
        }
        let exponent = self.exponent()?;
        if !exponent && n_digits <= DIGITS && whole <= 1 << 53 {
            // Both are doubles, and the quotient is rounded once.
            let size = whole as f64 / POWERS[places];
            return Some(if negative { -size } else { size });
        }
        self.text.get(start..self.at)?.parse().ok().filter(|value: &f64| value.is_finite())
    }

    /// Passes one digit or more, and appends them to `whole`, which may overflow.
    #[inline]
    fn digits(&mut self, whole: &mut u64) -> Option<()> {
        let first = self.at;
        while let Some(byte @ b'0'..=b'9') = self.peek() {
            *whole = whole.wrapping_mul(10).wrapping_add(u64::from(byte - b'0'));
            self.at += 1;
        }
        (first < self.at).then_some(())
    }

    /// Passes an exponent; whether there is one.
    #[inline]
    fn exponent(&mut self) -> Option<bool> {
        let Some(b'e' | b'E') = self.peek() else { return Some(false) };
        self.at += 1;
        self.at += usize::from(matches!(self.peek(), Some(b'+' | b'-')));
        self.digits(&mut 0)?;
        Some(true)
    }

    /// A string without escapes, without its quotes.
    #[inline]
    fn plain_string(&mut self) -> Option<&'a str> {
        self.take(b'"')?;
        let start = self.at;
        self.unescaped();
        let string = self.text.get(start..self.at)?;
        (self.peek()? == b'"').then_some(())?;
        self.at += 1;
        Some(string)
    }

    /// Passes what stands in a string up to its end, an escape or a control character.
    #[inline]
    fn unescaped(&mut self) {
        self.at = unescaped_end(self.text.as_bytes(), self.at);
    }

    /// Any value, as it is written.
    fn value(&mut self) -> Option<&'a str> {
        self.space();
        let start = self.at;
        // What is open: one bit each, the innermost last, set for an object.
        let (mut open, mut depth) = (0_u64, 0);
        loop {
            self.space();
            let byte = self.peek()?;
            match byte {
                b'[' if let Some(end) = pair_end(self.text.as_bytes(), self.at) => self.at = end,
                b'[' | b'{' => {
                    self.at += 1;
                    let object = byte == b'{';
                    if !self.has(if object { b'}' } else { b']' }) {
                        (depth < DEEPEST).then_some(())?;
                        open = open << 1 | u64::from(object);
                        depth += 1;
                        if object {
                            self.name()?;
                        }
                        continue;
                    }
                }
                b'"' => self.string()?,
                b'-' | b'0'..=b'9' => self.number()?,
                b't' => self.word("true")?,
                b'f' => self.word("false")?,
                b'n' => self.word(NULL)?,
                _ => return None,
            }
            // What ends with this value.
            loop {
                if depth == 0 {
                    return self.text.get(start..self.at);
                }
                let object = open & 1 == 1;
                if self.has(b',') {
                    if object {
                        self.name()?;
                    }
                    break;
                }
                self.take(if object { b'}' } else { b']' })?;
                open >>= 1;
                depth -= 1;
            }
        }
    }

    fn name(&mut self) -> Option<()> {
        self.space();
        self.string()?;
        self.take(b':')
    }

    fn word(&mut self, word: &str) -> Option<()> {
        self.text.get(self.at..)?.starts_with(word).then_some(())?;
        self.at += word.len();
        Some(())
    }

    #[inline]
    fn number(&mut self) -> Option<()> {
        self.at = number_end(self.text.as_bytes(), self.at)?;
        Some(())
    }

    #[inline]
    fn string(&mut self) -> Option<()> {
        (self.peek()? == b'"').then_some(())?;
        self.at += 1;
        loop {
            self.unescaped();
            let byte = self.peek()?;
            self.at += 1;
            match byte {
                b'"' => return Some(()),
                b'\\' => self.escape()?,
                _ => return None,
            }
        }
    }

    #[cold]
    fn escape(&mut self) -> Option<()> {
        let byte = self.peek()?;
        self.at += 1;
        match byte {
            b'"' | b'\\' | b'/' | b'b' | b'f' | b'n' | b'r' | b't' => Some(()),
            b'u' => {
                let digits = self.text.as_bytes().get(self.at..self.at + 4)?;
                self.at += 4;
                digits.iter().all(u8::is_ascii_hexdigit).then_some(())
            }
            _ => None,
        }
    }
}

/// Where the position `[x, y]` at this byte ends, if it is one.
#[inline]
fn pair_end(bytes: &[u8], at: usize) -> Option<usize> {
    let comma = number_end(bytes, at + 1)?;
    let tail = bytes.get(comma..)?;
    let second = match tail {
        [b',', b' ', ..] => comma + 2,
        [b',', ..] => comma + 1,
        _ => return None,
    };
    let end = number_end(bytes, second)?;
    (bytes.get(end) == Some(&b']')).then_some(end + 1)
}

/// Where the number at this byte ends, if it is one.
#[inline]
fn number_end(bytes: &[u8], at: usize) -> Option<usize> {
    let first = at + usize::from(bytes.get(at) == Some(&b'-'));
    let mut end = digits_end(bytes, first);
    // No number begins with a zero that means nothing.
    (first < end && (end == first + 1 || bytes[first] != b'0')).then_some(())?;
    if bytes.get(end) == Some(&b'.') {
        let places = end + 1;
        end = digits_end(bytes, places);
        (places < end).then_some(())?;
    }
    if let Some(b'e' | b'E') = bytes.get(end) {
        let power = end + 1 + usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
        end = digits_end(bytes, power);
        (power < end).then_some(())?;
    }
    Some(end)
}

/// A word with 1 in each byte.
const ONES: u64 = u64::MAX / 255;

/// Where an end of a string, an escape or a control character comes first.
#[inline]
fn unescaped_end(bytes: &[u8], mut at: usize) -> usize {
    // Eight at once: the highest bit of a byte tells that it is one, at least of the first.
    while let Some(eight) = bytes.get(at..).and_then(|rest| rest.first_chunk()) {
        let word = u64::from_le_bytes(*eight);
        let below = |word: u64, limit: u8| word.wrapping_sub(ONES * u64::from(limit)) & !word;
        let is = |byte: u8| below(word ^ (ONES * u64::from(byte)), 1);
        let special = below(word, b' ') | is(b'"') | is(b'\\');
        let n = (special & (ONES << 7)).trailing_zeros() / 8;
        at += n as usize;
        if n < 8 {
            return at;
        }
    }
    while bytes.get(at).is_some_and(|&byte| byte >= b' ' && byte != b'"' && byte != b'\\') {
        at += 1;
    }
    at
}

/// Where the digits at this byte end.
#[inline]
fn digits_end(bytes: &[u8], mut at: usize) -> usize {
    // Eight at once: the highest bit of a byte tells that it is no digit, at least of the first.
    while let Some(eight) = bytes.get(at..).and_then(|rest| rest.first_chunk()) {
        let digits = u64::from_le_bytes(*eight) ^ (ONES * u64::from(b'0'));
        let others = digits | digits.wrapping_add(ONES * 118);
        let n = (others & (ONES << 7)).trailing_zeros() / 8;
        at += n as usize;
        if n < 8 {
            return at;
        }
    }
    while bytes.get(at).is_some_and(u8::is_ascii_digit) {
        at += 1;
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::value::RawValue;

    fn value(text: &str) -> Option<&str> {
        let mut cursor = Cursor { text, at: 0 };
        let value = cursor.value()?;
        cursor.space();
        (cursor.at == text.len()).then_some(value)
    }

    #[test]
    fn values_are_those_of_the_parser() {
        let pieces = [
            "{",
            "}",
            "[",
            "]",
            ",",
            ":",
            " ",
            "\n",
            "\"a\"",
            "\"\\\"é\\u00e9\"",
            "\"\\x\"",
            "\"",
            "\"\\u12g4\"",
            "\"\t\"",
            "0",
            "-",
            "01",
            "1.",
            "-2.5e+3",
            "1e",
            ".5",
            "1E5",
            "true",
            "nul",
            "null",
            "false",
            "\"b\":",
            "[1,2]",
            "[1.5, -12345678901.25]",
            "[01, 2]",
            "[1,2,3]",
            "{\"c\":[]}",
            "NaN",
            "\u{a0}",
        ];
        let mut state = 1_u64;
        let mut taken = 0;
        for _ in 0..200_000 {
            let mut text = String::new();
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            for k in 0..1 + (state >> 60) % 6 {
                text += pieces[(state >> (8 + 8 * k)) as usize % 256 % pieces.len()];
            }
            let parsed = serde_json::from_str::<&RawValue>(&text).ok().map(RawValue::get);
            assert_eq!(value(&text), parsed, "{text}");
            taken += u32::from(parsed.is_some());
        }
        assert!(taken > 1000, "{taken}");
    }

    #[test]
    fn coordinates_are_those_of_the_parser() {
        let mut state = 1_u64;
        let same = |text: &str| {
            let read = Cursor { text, at: 0 }.coordinate();
            let parsed = serde_json::from_str::<f64>(text).ok();
            assert_eq!(read.map(f64::to_bits), parsed.map(f64::to_bits), "{text}");
        };
        for _ in 0..100_000 {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            let digits = (state >> 8).to_string();
            let sign = if state >> 63 == 0 { "" } else { "-" };
            let point = (state >> 16) as usize % digits.len();
            let (whole, places) = digits.split_at(point.max(1));
            let places = &places[..places.len().min((state >> 24) as usize % 20)];
            let places = if places.is_empty() { "0" } else { places };
            same(&format!("{sign}{whole}.{places}"));
            same(&format!("{sign}{whole}"));
            same(&format!("{sign}{whole}.{places}e{}", (state >> 32) as i8));
        }
        for text in [
            "0",
            "-0",
            "-0.0",
            "0.5",
            "9007199254740992",
            "9007199254740993",
            "1e308",
            "1e309",
            "123456789012345678901234567890",
            "0.00000000000000000000001",
            "4.35",
            "5e-324",
            "5453786.599999999627471",
            "00.0",
            "-",
            "1.",
            "1e",
            "18446744073709551616.0",
        ] {
            same(text);
        }
    }

    #[test]
    fn what_is_unusual_is_left_to_the_parser() {
        let ring = "[[[0,0],[1,0,7],[1,1]]]";
        let feature = |members: &str| {
            format!("{{\"type\":\"Feature\",\"properties\":null,\"geometry\":{{{members}}}}}")
        };
        let usual = feature(&format!("\"type\":\"Polygon\",\"coordinates\":{ring}"));
        let read = polygonal(&usual).expect("usual");
        assert_eq!(read.polygons[0][0][1], Point::new(1.0, 0.0));
        assert!(!read.multi && read.properties.is_none());
        for members in [
            format!("\"coordinates\":{ring},\"type\":\"Polygon\""),
            format!("\"type\":\"Polygon\",\"type\":\"Polygon\",\"coordinates\":{ring}"),
            "\"type\":\"Polygon\"".to_owned(),
            "\"type\":\"Polygon\",\"coordinates\":[[[0,0],[1]]]".to_owned(),
            "\"type\":\"Point\",\"coordinates\":[0,0]".to_owned(),
            String::new(),
        ] {
            assert!(polygonal(&feature(&members)).is_none(), "{members}");
        }
        assert!(polygonal(&(usual.clone() + "]")).is_none());
        let whole = format!("{{\"type\":\"FeatureCollection\",\"features\":[{usual}, {usual}]}} ");
        assert_eq!(collection(&whole).expect("usual").features, [&usual, &usual]);
        assert!(collection(&(whole.clone() + ",")).is_none());
        assert!(collection(&whole.replace("Collection", "collection")).is_none());
    }
}
