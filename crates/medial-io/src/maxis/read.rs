use super::cursor::{Cursor, Fault};
use super::walk::Walk;
use super::{
    Anchor, COLUMNS, Column, DEFLATED, DISKS, HEAD, MAGIC, MASK, MOST_TIMES, PLAIN, Record, cells,
    corners, origin,
};
use crate::axis_document::AxisDocument;
use crate::{Error, Json};
use medial::axis::Engine;
use medial::ops::{Compressed, DiskGraph, GridDisk, Run};
use serde_json::value::RawValue;

/// The axes in a file, one for each feature: of disks as [`DiskGraph::axis`] tells, of corners computed
/// once more.
///
/// # Errors
/// As [`records`]; an item also if its corners bound no domain.
pub fn read(bytes: &[u8]) -> Result<impl Iterator<Item = Result<AxisDocument, Error>>, Error> {
    let axis = |record: Record| {
        let Record { feature, id, shape } = record;
        let wrong = |error: medial::ops::RebuildError| Error::Document {
            feature,
            place: "shape".to_owned(),
            why: error.to_string(),
        };
        let error = Some(shape.error());
        Ok(AxisDocument { feature, id, axis: shape.axis().map_err(wrong)?, error })
    };
    Ok(records(bytes)?.map(move |record| record.and_then(axis)))
}

/// The features in a file, read one after another. Whatever follows one that is malformed cannot be
/// found, so that is the last item.
pub struct Records {
    /// The reference system of the layer, as its format writes it.
    pub crs: Option<Json>,
    body: Body,
    left: usize,
    next: u64,
    anchor: Option<Anchor>,
}

/// Reads what a file says of itself, and proves its checksum.
///
/// # Errors
/// If it is no compressed axis, or of another version, or damaged.
pub fn records(bytes: &[u8]) -> Result<Records, Error> {
    let (magic, version) = (&MAGIC[..7], MAGIC[7]);
    if bytes.get(..7) != Some(magic) {
        let why = if bytes.starts_with(b"\x8dMAXIS") {
            "its line ends were changed on the way; copy the file as binary"
        } else {
            "this is no compressed axis: it does not begin as one"
        };
        return Err(wrong("byte 0", why));
    }
    match bytes.get(7) {
        Some(&found) if found == version => {}
        Some(found) => {
            return Err(wrong(
                "byte 7",
                format!("version {found} is not {version}, which is known here"),
            ));
        }
        None => return Err(wrong("byte 7", "the file ends too early")),
    }
    let Some((head, stored)) = bytes[8..].split_first_chunk::<4>() else {
        return Err(wrong("byte 8", "the file ends too early"));
    };
    if u32::from_le_bytes(*head) != crc32fast::hash(stored) {
        return Err(wrong("byte 8", "the checksum is wrong: the file is damaged or cut off"));
    }
    let body = match stored.split_first() {
        None => return Err(wrong("byte 12", "the file ends too early")),
        Some((&PLAIN, body)) => body.to_vec(),
        Some((&DEFLATED, body)) => {
            let most = MOST_TIMES.saturating_mul(bytes.len() - HEAD + 1);
            miniz_oxide::inflate::decompress_to_vec_with_limit(body, most).map_err(|error| {
                wrong("byte 13", format!("the body cannot be inflated: {error}"))
            })?
        }
        Some((other, _)) => {
            return Err(wrong("byte 12", format!("{other} is no way to store a body")));
        }
    };
    let malformed = |why: Fault| wrong("head", why);
    let mut body = Body::new(body).map_err(malformed)?;
    let crs = body.text().map_err(malformed)?;
    // A feature takes a few bytes of its plan.
    let left =
        body.number(Column::Plan).and_then(|n| body.fits(Column::Plan, n)).map_err(malformed)?;
    Ok(Records { crs, body, left, next: 0, anchor: None })
}

fn wrong(place: &str, why: impl Into<String>) -> Error {
    Error::Value { place: place.to_owned(), why: why.into() }
}

impl Iterator for Records {
    type Item = Result<Record, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        self.left = self.left.checked_sub(1)?;
        let mut feature = self.next as usize;
        let record = self.record(&mut feature);
        if record.is_err() {
            self.left = 0;
        } else if self.left == 0 && self.body.rest() > 0 {
            let why = format!("{} bytes follow the last feature", self.body.rest());
            return Some(Err(wrong("end", why)));
        }
        Some(record.map_err(|why| Error::Document { feature, place: "shape".to_owned(), why }))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (0, Some(self.left + 1))
    }
}

impl Records {
    fn record(&mut self, feature: &mut usize) -> Result<Record, Fault> {
        let skipped = self.body.number(Column::Plan)?;
        let number = self.next.checked_add(skipped).filter(|&n| n < u64::from(u32::MAX));
        let number = number.ok_or("its number is too large")?;
        self.next = number + 1;
        *feature = number as usize;
        let id = self.body.text()?;
        let shape = match self.body.byte(Column::Plan)? {
            MASK => Compressed::Mask(cells::read(&mut self.body)?),
            DISKS => Compressed::Disks(disks(&mut self.body, &mut self.anchor)?),
            kind => Compressed::Corners(corners::read(&mut self.body, kind, &mut self.anchor)?),
        };
        Ok(Record { feature: *feature, id, shape })
    }
}

/// The columns of a body, read from their beginnings.
pub(super) struct Body {
    bytes: Vec<u8>,
    cursors: [Cursor; COLUMNS],
}

impl Body {
    fn new(bytes: Vec<u8>) -> Result<Self, Fault> {
        let mut head = Cursor { at: 0, end: bytes.len() };
        let mut lengths = [0; COLUMNS];
        for length in &mut lengths {
            *length = head.count(&bytes, bytes.len())?;
        }
        let mut at = head.at;
        let cursors = lengths.map(|length| {
            let cursor = Cursor { at, end: at.saturating_add(length) };
            at = cursor.end;
            cursor
        });
        if at == bytes.len() {
            Ok(Self { bytes, cursors })
        } else {
            Err("its columns do not fit".to_owned())
        }
    }

    /// How many bytes are left in all columns.
    fn rest(&self) -> usize {
        self.cursors.iter().map(Cursor::left).sum()
    }

    pub fn byte(&mut self, column: Column) -> Result<u8, Fault> {
        self.cursors[column as usize].byte(&self.bytes)
    }

    pub fn number(&mut self, column: Column) -> Result<u64, Fault> {
        self.cursors[column as usize].number(&self.bytes)
    }

    pub fn signed(&mut self, column: Column) -> Result<i64, Fault> {
        self.cursors[column as usize].signed(&self.bytes)
    }

    pub fn double(&mut self, column: Column) -> Result<f64, Fault> {
        let bytes = self.cursors[column as usize].bytes(&self.bytes, 8)?;
        Ok(bytes.first_chunk().copied().map_or(0.0, f64::from_le_bytes))
    }

    pub fn bytes(&mut self, column: Column, n: usize) -> Result<&[u8], Fault> {
        self.cursors[column as usize].bytes(&self.bytes, n)
    }

    /// A number of things that take a byte of a column each, or more.
    pub fn fits(&self, column: Column, count: u64) -> Result<usize, Fault> {
        let left = self.cursors[column as usize].left();
        let count = usize::try_from(count).ok().filter(|&count| count <= left);
        count.ok_or_else(|| "a count is more than there is".to_owned())
    }

    /// A piece of JSON, or nothing.
    fn text(&mut self) -> Result<Option<Json>, Fault> {
        let plan = &mut self.cursors[Column::Plan as usize];
        let left = plan.left();
        let length = plan.count(&self.bytes, left)?;
        let text = std::str::from_utf8(plan.bytes(&self.bytes, length)?);
        let text = text.map_err(|_| "a text is not UTF-8".to_owned())?;
        if text.is_empty() {
            return Ok(None);
        }
        RawValue::from_string(text.to_owned())
            .map(Some)
            .map_err(|error| format!("no JSON: {error}"))
    }

    pub fn engine(&mut self) -> Result<Engine, Fault> {
        let number = self.byte(Column::Plan)?;
        let engine = Engine::ALL.get(usize::from(number)).copied();
        engine.ok_or_else(|| format!("{number} is no engine"))
    }
}

fn disks(body: &mut Body, anchor: &mut Option<Anchor>) -> Result<DiskGraph, Fault> {
    let engine = body.engine()?;
    let exponent = body.signed(Column::Plan)?;
    let exponent = i32::try_from(exponent).map_err(|_| "its grid is out of range".to_owned())?;
    let error = body.number(Column::Plan)?;
    let quarters = body.byte(Column::Plan)?;
    let n_runs = body.number(Column::Plan)?;
    let n_runs = body.fits(Column::Plan, n_runs)?;
    let grid = (DISKS, exponent);
    let mut walk = Walk::new(origin(*anchor, grid));
    let mut runs = Vec::with_capacity(n_runs);
    let mut known: u32 = 0;
    for _ in 0..n_runs {
        let head = body.number(Column::Plan)?;
        let own = body.fits(Column::X, head >> 1)?;
        let back = |back: u64, known: u32| {
            let number = u32::try_from(back).ok().filter(|&back| back > 0);
            let number = number.and_then(|back| known.checked_sub(back));
            number.ok_or_else(|| "a disk is named that is not there".to_owned())
        };
        let from = match body.number(Column::Plan)? {
            0 => None,
            number => Some(back(number, known)?),
        };
        walk.begin(from);
        for _ in 0..own {
            let [x, y, radius] = walk.guess(quarters);
            walk.add(GridDisk {
                x: x.wrapping_add(body.signed(Column::X)?),
                y: y.wrapping_add(body.signed(Column::Y)?),
                radius: radius.wrapping_add(body.signed(Column::Radius)?),
            });
        }
        let len = u32::try_from(own).ok().filter(|&len| known.checked_add(len).is_some());
        let len = len.ok_or("there are too many disks")?;
        known += len;
        let to = match head & 1 {
            0 => None,
            _ => Some(back(body.number(Column::Plan)?, known)?),
        };
        runs.push(Run { from, len, to });
    }
    let disks = walk.into_disks();
    if let Some(first) = disks.first() {
        *anchor = Some(Anchor { grid, x: first.x, y: first.y });
    }
    let graph = DiskGraph::from_parts(engine, exponent, error, disks, runs);
    graph.ok_or_else(|| "its disks are off the grid".to_owned())
}
