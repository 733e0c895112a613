//! Tables of dBase, as far as shapefiles have them.

use super::encoding::Encoding;
use crate::table::told_apart;
use crate::{Json, attribute};
use std::io::{self, Read};

/// The values of a table, row after row.
pub(super) struct Reader<R> {
    source: R,
    fields: Vec<Field>,
    encoding: Encoding,
    row: usize,
    /// Rows that are still to come.
    left: u32,
}

struct Field {
    name: String,
    kind: u8,
    size: usize,
    decimals: u8,
}

/// A row.
pub(super) enum Row {
    Deleted,
    Values(Vec<(String, Json)>),
}

impl<R: Read> Reader<R> {
    /// A table, in the encoding that a `.cpg` names, else that which the table itself names; with a warning
    /// for each that is not known.
    ///
    /// # Errors
    /// If it is no such table.
    pub(super) fn new(
        mut source: R,
        encoding: Option<&str>,
        warnings: &mut Vec<String>,
    ) -> Result<Self, String> {
        let wrong = |why: &str| format!("its .dbf is no table of dBase: {why}");
        let mut head = [0; 32];
        source.read_exact(&mut head).map_err(|_| wrong("it has no header"))?;
        let left = u32::from_le_bytes([head[4], head[5], head[6], head[7]]);
        let [size, row] = [[head[8], head[9]], [head[10], head[11]]].map(u16::from_le_bytes);
        let size = usize::from(size);
        let mut described = vec![0; size.saturating_sub(32)];
        source.read_exact(&mut described).map_err(|_| wrong("its header ends too early"))?;
        let encoding = Encoding::of(encoding, head[29], warnings);
        let mut fields = Vec::new();
        let mut total = 1;
        for bytes in described.chunks_exact(32) {
            if bytes[0] == b'\r' {
                break;
            }
            let name = bytes[..11].split(|&byte| byte == 0).next().unwrap_or_default();
            let (kind, decimals) = (bytes[11].to_ascii_uppercase(), bytes[17]);
            // Long texts keep the upper half of their size where numbers have their decimals.
            let size =
                usize::from(bytes[16]) + if kind == b'C' { 256 * usize::from(decimals) } else { 0 };
            fields.push(Field { name: encoding.decode(name), kind, size, decimals });
            total += size;
        }
        let names = fields.iter().map(|field: &Field| field.name.clone()).collect();
        for (field, name) in fields.iter_mut().zip(told_apart(names, warnings)) {
            field.name = name;
        }
        if total > usize::from(row) {
            return Err(wrong("its fields are longer than its rows"));
        }
        Ok(Self { source, fields, encoding, row: usize::from(row), left })
    }

    /// The next row, `None` behind the last one.
    pub(super) fn row(&mut self) -> io::Result<Option<Row>> {
        if self.left == 0 {
            return Ok(None);
        }
        self.left -= 1;
        let mut row = vec![0; self.row];
        match self.source.read_exact(&mut row) {
            Ok(()) => {}
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => {
                self.left = 0;
                return Ok(None);
            }
            Err(error) => return Err(error),
        }
        if row.first() == Some(&b'*') {
            return Ok(Some(Row::Deleted));
        }
        let mut values = Vec::with_capacity(self.fields.len());
        let mut at = 1;
        for field in &self.fields {
            let bytes = &row[at..at + field.size];
            at += field.size;
            values.push((field.name.clone(), value(bytes, field, &self.encoding)));
        }
        Ok(Some(Row::Values(values)))
    }
}

fn value(bytes: &[u8], field: &Field, encoding: &Encoding) -> Json {
    let trimmed = bytes.split(|&byte| byte == 0).next().unwrap_or_default().trim_ascii();
    let chunk = bytes.first_chunk::<8>();
    match field.kind {
        b'N' | b'F' => {
            let text = std::str::from_utf8(trimmed).unwrap_or_default();
            let text = text.strip_prefix('+').unwrap_or(text);
            if field.decimals == 0
                && let Ok(whole) = text.parse::<i64>()
            {
                return attribute::integer(whole);
            }
            // Stars stand for nothing, or for what did not fit.
            text.parse().map_or_else(|_| attribute::null(), attribute::real)
        }
        b'L' => match trimmed {
            [b'T' | b't' | b'Y' | b'y'] => attribute::boolean(true),
            [b'F' | b'f' | b'N' | b'n'] => attribute::boolean(false),
            _ => attribute::null(),
        },
        b'D' => {
            let is_date = trimmed.len() == 8 && trimmed.iter().all(u8::is_ascii_digit);
            if !is_date || trimmed == b"00000000" {
                return attribute::null();
            }
            let digits = String::from_utf8_lossy(trimmed);
            let (year, day) = digits.split_at(4);
            let (month, day) = day.split_at(2);
            attribute::text(&format!("{year}-{month}-{day}"))
        }
        b'I' | b'+' if bytes.len() == 4 => {
            let whole = bytes.first_chunk::<4>().map_or(0, |bytes| i32::from_le_bytes(*bytes));
            attribute::integer(whole)
        }
        b'O' | b'B' if bytes.len() == 8 => {
            chunk.map_or_else(attribute::null, |bytes| attribute::real(f64::from_le_bytes(*bytes)))
        }
        b'@' | b'T' if bytes.len() == 8 => {
            // The Julian day, and milliseconds since midnight.
            let Some(&[a, b, c, d, e, f, g, h]) = chunk else { return attribute::null() };
            let [day, time] = [[a, b, c, d], [e, f, g, h]].map(i32::from_le_bytes);
            if day == 0 {
                return attribute::null();
            }
            const EPOCH: i64 = 2_440_588;
            let units = (i64::from(day) - EPOCH) * 86_400_000 + i64::from(time);
            attribute::text(&attribute::moment(units, 1000, false))
        }
        // Spaces before a text are its own.
        _ => match encoding.decode(bytes.split(|&byte| byte == 0).next().unwrap_or_default()) {
            text if text.trim_end().is_empty() => attribute::null(),
            text => attribute::text(text.trim_end()),
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A table of one row.
    fn table(fields: &[(&str, u8, u8, u8)], row: &[u8], driver: u8) -> Vec<u8> {
        let mut out = vec![3, 126, 1, 1];
        out.extend(1_u32.to_le_bytes());
        out.extend((33 + 32 * fields.len() as u16).to_le_bytes());
        out.extend((row.len() as u16).to_le_bytes());
        out.resize(32, 0);
        out[29] = driver;
        for (name, kind, size, decimals) in fields {
            let mut field = [0; 32];
            field[..name.len()].copy_from_slice(name.as_bytes());
            (field[11], field[16], field[17]) = (*kind, *size, *decimals);
            out.extend(field);
        }
        out.push(b'\r');
        out.extend(row);
        out
    }

    fn values(bytes: &[u8], encoding: Option<&str>) -> Vec<String> {
        match Reader::new(bytes, encoding, &mut Vec::new()).unwrap().row().unwrap().unwrap() {
            Row::Values(values) => {
                values.into_iter().map(|(name, value)| format!("{name}={value}")).collect()
            }
            Row::Deleted => Vec::new(),
        }
    }

    #[test]
    fn values_have_the_types_of_their_fields() {
        let fields = [
            ("n", b'N', 4, 0),
            ("f", b'N', 6, 2),
            ("l", b'L', 1, 0),
            ("d", b'D', 8, 0),
            ("c", b'C', 4, 0),
        ];
        let bytes = table(&fields, b"   42  1.50T20261129ab  ", 0);
        assert_eq!(
            values(&bytes, None),
            ["n=42", "f=1.5", "l=true", "d=\"2026-11-29\"", "c=\"ab\""]
        );
        let bytes = table(&fields, b" ****      ?00000000    ", 0);
        assert_eq!(values(&bytes, None), ["n=null", "f=null", "l=null", "d=null", "c=null"]);
        assert!(values(&table(&fields, b"*               20261129    ", 0)[..], None).is_empty());
    }

    #[test]
    fn texts_are_in_the_encoding_that_is_named() {
        let fields = [("c", b'C', 2, 0)];
        let latin = table(&fields, b" \xe9 ", 0);
        assert_eq!(values(&latin, None), ["c=\"é\""]);
        assert_eq!(values(&latin, Some("ISO-8859-1\n")), ["c=\"é\""]);
        assert_eq!(values(&latin, Some("1251")), ["c=\"й\""]);
        assert_eq!(values(&table(&fields, b" \xe9 ", 0xc9), None), ["c=\"й\""]);
        let utf_8 = table(&fields, " é".as_bytes(), 0);
        assert_eq!(values(&utf_8, None), ["c=\"é\""]);
        assert_eq!(values(&utf_8, Some("UTF-8")), ["c=\"é\""]);
        assert_eq!(values(&latin, Some("ISO 88597")), ["c=\"ι\""]);
    }

    #[test]
    fn texts_of_dos_are_in_their_code_page() {
        // ü is 0x81 in all of these, and no letter in Windows-1252.
        let name = |driver: u8| table(&[("c", b'C', 6, 0)], b" Z\x81rich", driver);
        for (driver, cpg) in
            [(1, None), (2, None), (0, Some("CP437")), (0, Some("850")), (0, Some("LDID/100"))]
        {
            assert_eq!(values(&name(driver), cpg), ["c=\"Zürich\""], "{driver} {cpg:?}");
        }
        let russian = table(&[("c", b'C', 2, 0)], b" \xa9 ", 0x65);
        assert_eq!(values(&russian, None), ["c=\"й\""]);
    }

    #[test]
    fn an_encoding_that_is_not_known_is_told() {
        let warnings = |driver: u8, cpg: Option<&str>| {
            let mut warnings = Vec::new();
            let bytes = table(&[("c", b'C', 1, 0)], b" a", driver);
            assert!(Reader::new(&bytes[..], cpg, &mut warnings).is_ok());
            warnings
        };
        assert!(warnings(0, None).is_empty() && warnings(1, Some("UTF-8")).is_empty());
        // The code page 895, which only Czech programs had.
        assert!(warnings(0x68, None)[0].contains("language driver 104"));
        let both = warnings(0x68, Some("nonsense\n"));
        assert!(both.len() == 2 && both[0].contains("`nonsense`"), "{both:?}");
    }

    #[test]
    fn fields_of_one_name_are_told_apart() {
        let bytes = table(&[("a", b'N', 1, 0), ("a", b'N', 1, 0)], b" 12", 0);
        assert_eq!(values(&bytes, None), ["a=1", "a_1=2"]);
    }

    #[test]
    fn a_table_that_makes_no_sense_is_refused() {
        let mut bytes = table(&[("c", b'C', 9, 0)], b" 123456789", 0);
        bytes[10] = 3;
        assert!(Reader::new(&bytes[..], None, &mut Vec::new()).is_err());
        assert!(Reader::new(&b"x"[..], None, &mut Vec::new()).is_err());
    }
}
