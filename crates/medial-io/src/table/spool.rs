use super::{Cell, Geometry, Row, Schema, line};
use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read, Seek, Write};

/// Rows in a temporary file, and what is known of all of them.
///
/// ```
/// use medial_io::table::{Cell, Spool};
///
/// let mut spool = Spool::new(tempfile::tempfile()?);
/// spool.add(
///     b"{\"type\":\"Feature\",\"properties\":{\"n\":1},\"geometry\":{\"type\":\"Point\",\"coordinates\":[1,2]}}\n\
///       {\"type\":\"Feature\",\"properties\":{\"n\":0.5},\"geometry\":null}\n",
/// )?;
/// let rows = spool.rows()?.collect::<Result<Vec<_>, _>>()?;
/// assert_eq!(rows[0].cells, [Cell::Real(1.0)], "as all values of a column are of one kind");
/// # Ok::<(), std::io::Error>(())
/// ```
pub struct Spool {
    file: BufWriter<File>,
    schema: Schema,
    record: Vec<u8>,
}

/// Bytes gathered before they are handed to the system.
const BUFFER: usize = 1 << 18;

impl Spool {
    /// A spool in a file, which is empty and may be read.
    #[must_use]
    pub fn new(file: File) -> Self {
        let file = BufWriter::with_capacity(BUFFER, file);
        Self { file, schema: Schema::default(), record: Vec::new() }
    }

    /// Adds features, each on a line of GeoJSON.
    ///
    /// # Errors
    /// If the system fails, or a line is no feature.
    pub fn add(&mut self, lines: &[u8]) -> io::Result<()> {
        line::split(lines).try_for_each(|line| {
            let (cells, geometry) = line::read(line)?;
            self.push(&cells, geometry.as_ref())
        })
    }

    /// Adds a feature.
    pub(super) fn push(
        &mut self,
        cells: &[(String, Cell)],
        geometry: Option<&Geometry>,
    ) -> io::Result<()> {
        self.record.clear();
        self.schema.n_rows += 1;
        put_count(&mut self.record, cells.len());
        for (name, cell) in cells {
            let number = self.schema.number(name);
            self.schema.note(number, cell);
            put_count(&mut self.record, number as usize);
            put(&mut self.record, cell);
        }
        if let Some(geometry) = geometry {
            let bounds = geometry.bounds();
            self.schema.note_geometry(geometry.kind(), bounds);
            bounds.iter().for_each(|value| self.record.extend(value.to_le_bytes()));
            geometry.to_wkb(&mut self.record);
        }
        let size = u32::try_from(self.record.len()).map_err(io::Error::other)?;
        self.file.write_all(&size.to_le_bytes())?;
        self.file.write_all(&self.record)
    }

    /// What is known of all rows.
    #[must_use]
    pub fn schema(&self) -> &Schema {
        &self.schema
    }

    /// All rows, in their order.
    ///
    /// # Errors
    /// If the system fails.
    pub fn rows(&mut self) -> io::Result<Rows<'_>> {
        self.file.flush()?;
        self.file.get_mut().rewind()?;
        let file = BufReader::with_capacity(BUFFER, self.file.get_ref());
        Ok(Rows { file, schema: &self.schema, left: self.schema.n_rows, record: Vec::new() })
    }
}

/// The rows of a spool.
pub struct Rows<'a> {
    file: BufReader<&'a File>,
    schema: &'a Schema,
    left: usize,
    record: Vec<u8>,
}

impl Iterator for Rows<'_> {
    type Item = io::Result<Row>;

    fn next(&mut self) -> Option<io::Result<Row>> {
        self.left = self.left.checked_sub(1)?;
        let row = self.row();
        if row.is_err() {
            self.left = 0;
        }
        Some(row)
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (self.left, Some(self.left))
    }
}

impl Rows<'_> {
    fn row(&mut self) -> io::Result<Row> {
        let mut size = [0; 4];
        self.file.read_exact(&mut size)?;
        self.record.resize(u32::from_le_bytes(size) as usize, 0);
        self.file.read_exact(&mut self.record)?;
        self.decoded().ok_or_else(|| io::Error::other("the temporary file was changed"))
    }

    fn decoded(&self) -> Option<Row> {
        let columns = self.schema.columns();
        let mut rest = self.record.as_slice();
        let mut cells = vec![Cell::Null; columns.len()];
        for _ in 0..take_count(&mut rest)? {
            let number = take_count(&mut rest)?;
            let kind = columns.get(number)?.kind;
            cells[number] = take(&mut rest)?.cast(kind);
        }
        let mut bounds = [0.0; 4];
        if rest.is_empty() {
            return Some(Row { cells, wkb: None, bounds });
        }
        for bound in &mut bounds {
            *bound = f64::from_le_bytes(*chunk(&mut rest)?);
        }
        Some(Row { cells, wkb: Some(rest.to_vec()), bounds })
    }
}

/// Appends a count, small ones in a byte.
fn put_count(out: &mut Vec<u8>, count: usize) {
    match u8::try_from(count) {
        Ok(small) if small < u8::MAX => out.push(small),
        _ => {
            out.push(u8::MAX);
            out.extend((count as u64).to_le_bytes());
        }
    }
}

fn take_count(rest: &mut &[u8]) -> Option<usize> {
    match *chunk::<1>(rest)? {
        [u8::MAX] => usize::try_from(u64::from_le_bytes(*chunk(rest)?)).ok(),
        [small] => Some(small.into()),
    }
}

fn chunk<'a, const N: usize>(rest: &mut &'a [u8]) -> Option<&'a [u8; N]> {
    let (chunk, more) = rest.split_first_chunk()?;
    *rest = more;
    Some(chunk)
}

/// Appends a value behind a byte that says what it is.
fn put(out: &mut Vec<u8>, cell: &Cell) {
    match cell {
        Cell::Null => out.push(0),
        Cell::Boolean(value) => out.extend([1, u8::from(*value)]),
        Cell::Integer(value) => {
            out.push(2);
            out.extend(value.to_le_bytes());
        }
        Cell::Real(value) => {
            out.push(3);
            out.extend(value.to_le_bytes());
        }
        Cell::Text(text) => {
            out.push(4);
            put_count(out, text.len());
            out.extend(text.as_bytes());
        }
    }
}

fn take(rest: &mut &[u8]) -> Option<Cell> {
    Some(match *chunk::<1>(rest)? {
        [0] => Cell::Null,
        [1] => Cell::Boolean(*chunk::<1>(rest)? == [1]),
        [2] => Cell::Integer(i64::from_le_bytes(*chunk(rest)?)),
        [3] => Cell::Real(f64::from_le_bytes(*chunk(rest)?)),
        _ => {
            let size = take_count(rest)?;
            let (text, more) = rest.split_at_checked(size)?;
            *rest = more;
            Cell::Text(std::str::from_utf8(text).ok()?.to_owned())
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::{Geometry, Kind, Place};

    #[test]
    fn rows_come_back_with_the_kinds_of_their_columns() {
        let line = |properties: &str, geometry: &str| {
            format!(
                "{{\"type\":\"Feature\",\"properties\":{{{properties}}},\"geometry\":{geometry}}}\n"
            )
        };
        let point = "{\"type\":\"Point\",\"coordinates\":[0.1,2.0]}";
        let text = [
            line("\"a\":1,\"b\":true,\"c\":\"x\",\"d\":null,\"e\":7", point),
            line("\"e\":null,\"a\":0.25,\"f\":[1,2]", "null"),
            line("\"b\":3,\"c\":null,\"g\":-0,\"h\":12345678901234567890", point),
        ];
        let mut spool = Spool::new(tempfile::tempfile().unwrap());
        spool.add(text.concat().as_bytes()).unwrap();
        let kinds: Vec<(String, Kind)> =
            spool.schema().columns().iter().map(|c| (c.name.clone(), c.kind)).collect();
        let expected = [
            ("a", Kind::Real),
            ("b", Kind::Text),
            ("c", Kind::Text),
            ("d", Kind::Text),
            ("e", Kind::Integer),
            ("f", Kind::Text),
            ("g", Kind::Real),
            ("h", Kind::Real),
        ];
        assert_eq!(kinds, expected.map(|(name, kind)| (name.to_owned(), kind)));
        assert_eq!(spool.schema().extent(), Some([0.1, 2.0, 0.1, 2.0]));
        for _ in 0..2 {
            let rows: Vec<Row> = spool.rows().unwrap().map(Result::unwrap).collect();
            assert_eq!(rows.len(), 3);
            assert_eq!(rows[0].cells[..2], [Cell::Real(1.0), Cell::Text("true".to_owned())]);
            assert_eq!(rows[1].cells[0], Cell::Real(0.25));
            assert_eq!(rows[1].cells[5], Cell::Text("[1,2]".to_owned()));
            assert_eq!(rows[2].cells[1], Cell::Text("3".to_owned()));
            assert_eq!(rows[1].wkb, None);
            let place = Place { x: 0.1, y: 2.0, z: None };
            let found = Geometry::of_wkb(rows[2].wkb.as_ref().unwrap());
            assert_eq!(found, Some(Geometry::Point(place)));
        }
    }
}
