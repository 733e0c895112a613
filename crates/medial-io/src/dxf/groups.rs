//! The pairs of a group code and a value that a DXF file is made of, as text or in binary.

use crate::Error;
use std::borrow::Cow;

/// What every binary file begins with.
pub(super) const BINARY: &[u8] = b"AutoCAD Binary DXF\r\n\x1a\0";

/// A group code with its value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Group<'a> {
    pub code: i32,
    value: Value<'a>,
    /// Line of the value, from 1; in binary files the byte.
    pub line: usize,
}

#[derive(Clone, Copy, Debug)]
enum Value<'a> {
    Text(&'a [u8]),
    Real(f64),
    Whole(i64),
}

impl<'a> Group<'a> {
    /// The value as text; bytes that are no UTF-8 are taken for Latin 1.
    pub fn text(&self) -> Cow<'a, str> {
        match self.value {
            Value::Text(bytes) => match std::str::from_utf8(bytes) {
                Ok(text) => Cow::Borrowed(text.trim()),
                Err(_) => bytes.iter().map(|b| char::from(*b)).collect::<String>().into(),
            },
            Value::Real(value) => value.to_string().into(),
            Value::Whole(value) => value.to_string().into(),
        }
    }

    pub fn is(&self, code: i32, text: &str) -> bool {
        self.code == code
            && matches!(self.value, Value::Text(bytes) if bytes.trim_ascii() == text.as_bytes())
    }

    pub fn real(&self) -> Result<f64, Error> {
        match self.value {
            Value::Real(value) => Ok(value),
            Value::Whole(value) => Ok(value as f64),
            Value::Text(_) => self.parsed("number"),
        }
    }

    /// The tangent of a quarter of the angle of an arc.
    pub fn bulge(&self) -> Result<f64, Error> {
        /// Far more than a full circle but for rounding, and what can be computed with.
        const MOST: f64 = 1e100;
        let bulge = self.real()?;
        match (-MOST..=MOST).contains(&bulge) {
            true => Ok(bulge),
            false => Err(self.wrong(format!("`{bulge}` is no bulge; correct it"))),
        }
    }

    pub fn whole(&self) -> Result<i64, Error> {
        match self.value {
            Value::Real(value) => Ok(value as i64),
            Value::Whole(value) => Ok(value),
            Value::Text(_) => self.parsed("whole number"),
        }
    }

    fn parsed<T: std::str::FromStr>(&self, what: &str) -> Result<T, Error> {
        let text = self.text();
        text.parse().map_err(|_| {
            let shown: String = text.chars().take(20).collect();
            self.wrong(format!("`{shown}` is no {what}"))
        })
    }

    /// The error that the value is wrong.
    pub fn wrong(&self, why: impl Into<String>) -> Error {
        Error::Value { place: format!("line {}, group {}", self.line, self.code), why: why.into() }
    }
}

/// All groups of a file, up to its end or the first that breaks the rules.
pub(super) fn groups(bytes: &[u8]) -> Result<Vec<Group<'_>>, Error> {
    match bytes.strip_prefix(BINARY) {
        Some(rest) => {
            Binary { bytes, at: bytes.len() - rest.len(), wide: rest.get(1) == Some(&0) }.all()
        }
        None => of_text(bytes),
    }
}

fn of_text(bytes: &[u8]) -> Result<Vec<Group<'_>>, Error> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let mut groups = Vec::new();
    let mut lines = bytes.split(|b| *b == b'\n').map(|line| line.trim_ascii()).zip(1..);
    while let Some((code, line)) = lines.next() {
        let number = std::str::from_utf8(code).ok().and_then(|text| text.parse::<i32>().ok());
        let Some(number) = number else {
            // Nothing may follow the end but white space.
            if code.is_empty() && lines.all(|(line, _)| line.is_empty()) {
                break;
            }
            let shown: String = String::from_utf8_lossy(code).chars().take(20).collect();
            let why = format!("a group code is needed here, not `{shown}`");
            return Err(Error::Syntax { line, column: 1, why });
        };
        let Some((value, line)) = lines.next() else {
            let why = "the value of the group is missing; the file is cut off".to_owned();
            return Err(Error::Syntax { line, column: 1, why });
        };
        groups.push(Group { code: number, value: Value::Text(value), line });
        if number == 0 && value == b"EOF" {
            break;
        }
    }
    Ok(groups)
}

struct Binary<'a> {
    bytes: &'a [u8],
    at: usize,
    /// Whether codes have two bytes.
    wide: bool,
}

impl<'a> Binary<'a> {
    fn all(mut self) -> Result<Vec<Group<'a>>, Error> {
        let mut groups = Vec::new();
        while self.at < self.bytes.len() {
            let line = self.at;
            let mut code = if self.wide {
                i32::from(i16::from_le_bytes(self.array()?))
            } else {
                i32::from(self.array::<1>()?[0])
            };
            if !self.wide && code == 255 {
                code = i32::from(i16::from_le_bytes(self.array()?));
            }
            let value = self.value(code)?;
            groups.push(Group { code, value, line });
            if groups.last().is_some_and(|group| group.is(0, "EOF")) {
                break;
            }
        }
        Ok(groups)
    }

    fn value(&mut self, code: i32) -> Result<Value<'a>, Error> {
        Ok(match code {
            10..=59 | 110..=149 | 210..=239 | 460..=469 | 1010..=1059 => {
                Value::Real(f64::from_le_bytes(self.array()?))
            }
            60..=79 | 170..=179 | 270..=289 | 370..=389 | 400..=409 | 1060..=1070 => {
                Value::Whole(i16::from_le_bytes(self.array()?).into())
            }
            90..=99 | 420..=429 | 440..=459 | 1071 => {
                Value::Whole(i32::from_le_bytes(self.array()?).into())
            }
            160..=169 => Value::Whole(i64::from_le_bytes(self.array()?)),
            290..=299 => Value::Whole(self.array::<1>()?[0].into()),
            310..=319 | 1004 => {
                let n = self.array::<1>()?[0];
                Value::Text(self.take(n.into())?)
            }
            0..=9 | 100..=105 | 300..=369 | 390..=399 | 410..=439 | 470..=481 | 999..=1009 => {
                let rest = &self.bytes[self.at..];
                let Some(n) = rest.iter().position(|b| *b == 0) else { return Err(self.cut()) };
                let text = self.take(n)?;
                self.at += 1;
                Value::Text(text)
            }
            _ => return Err(self.wrong(format!("there is no group code {code}"))),
        })
    }

    fn take(&mut self, n: usize) -> Result<&'a [u8], Error> {
        let taken = self.bytes.get(self.at..self.at + n).ok_or_else(|| self.cut())?;
        self.at += n;
        Ok(taken)
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], Error> {
        let taken = self.take(N)?;
        taken.try_into().map_err(|_| self.cut())
    }

    fn cut(&self) -> Error {
        self.wrong("the file is cut off".to_owned())
    }

    fn wrong(&self, why: String) -> Error {
        Error::Value { place: format!("byte {}", self.at), why }
    }
}
