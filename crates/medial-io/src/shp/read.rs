use super::encoding::Encoding;
use super::{HEADER, dbf, kind, rings};
use crate::{Crs, Error, Feature, FeatureError, Layer, Note, Part};
use medial::geom::Point;
use std::fs::File;
use std::io::{self, BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

/// Opens a shapefile by its `.shp`. The other files lie beside it; only the values are missing without
/// `.dbf`, and the reference system without `.prj`. Rows that are marked as deleted are left out.
///
/// An index (`.shx`) that is shorter than its header says is not used, with a warning, nor is one without a
/// header; a `.shp` that is shorter than its header says breaks off there.
///
/// # Errors
/// If a file cannot be read, or is no such file.
pub fn open(path: &Path) -> Result<Layer<'static>, Error> {
    let failed = |source| Error::Interrupted { source };
    let wrong = |why: &str| Error::File { why: format!("it is no shapefile: {why}") };
    let mut shapes = BufReader::new(File::open(path).map_err(failed)?);
    let mut header = [0; HEADER];
    shapes.read_exact(&mut header).map_err(|_| wrong("it has no header"))?;
    if header[..4] != [0, 0, 0x27, 0x0a] {
        return Err(wrong("it does not begin like one"));
    }
    let mut warnings = Vec::new();
    let index = match beside(path, "shx") {
        Some(found) => index(File::open(found).map_err(failed)?, &mut warnings),
        None => None,
    };
    let (places, len) = index.unzip();
    let table = match beside(path, "dbf") {
        Some(found) => {
            let encoding = beside(path, "cpg").and_then(|path| std::fs::read(path).ok());
            let encoding = encoding.as_deref().map(String::from_utf8_lossy);
            let file = BufReader::new(File::open(found).map_err(failed)?);
            let table = dbf::Reader::new(file, encoding.as_deref(), &mut warnings);
            Some(table.map_err(|why| Error::File { why })?)
        }
        None => None,
    };
    let crs = beside(path, "prj").and_then(|path| std::fs::read(path).ok());
    let crs = crs.and_then(|bytes| reference(&bytes, &mut warnings));
    let (at, end) = (HEADER as u64, length(&header));
    let rows = Shapes { shapes, at, end, places, table, n_records: 0, index: 0, is_over: false };
    Ok(Layer { crs, len, warnings, ..Layer::of_parts(rows) })
}

/// The reference system that a `.prj` names, in UTF-8 or else in Windows-1252; `None` with a warning for a
/// text that is none.
fn reference(bytes: &[u8], warnings: &mut Vec<String>) -> Option<Crs> {
    let text = Encoding::Guessed.decode(bytes);
    let text = text.trim_start_matches('\u{feff}').trim();
    if text.is_empty() {
        return None;
    }
    if !text.contains(['[', '(']) {
        let start: String = text.chars().take(20).collect();
        warnings.push(format!(
            "the `.prj` is not used, as `{start}` begins no well-known text of a reference system; write it anew"
        ));
        return None;
    }
    Some(Crs::of_wkt(text))
}

/// The length of a file in bytes, as its header has it.
fn length(header: &[u8; HEADER]) -> u64 {
    let words = header[24..].first_chunk().map_or(0, |bytes| u32::from_be_bytes(*bytes));
    2 * u64::from(words)
}

/// An index behind its header, and how many places it has; `None` with a warning if it is not complete, as
/// such a one is no better than none.
fn index(file: File, warnings: &mut Vec<String>) -> Option<(BufReader<File>, usize)> {
    let size = file.metadata().map_or(0, |found| found.len());
    let mut places = BufReader::new(file);
    let mut header = [0; HEADER];
    let has_header = places.read_exact(&mut header).is_ok();
    let expected = if has_header { length(&header) } else { HEADER as u64 };
    if size < expected {
        warnings.push(format!(
            "the index `.shx` has {size} of {expected} bytes and is not used; shapes are read one after the other"
        ));
        return None;
    }
    Some((places, (size as usize).saturating_sub(HEADER) / 8))
}

/// The file beside a `.shp` with another extension, in lower or upper case.
fn beside(path: &Path, extension: &str) -> Option<PathBuf> {
    let names = [extension.to_owned(), extension.to_uppercase()];
    names.iter().map(|name| path.with_extension(name)).find(|path| path.is_file())
}

/// The records of a shapefile.
struct Shapes {
    shapes: BufReader<File>,
    /// Where the next record begins, if there is no index.
    at: u64,
    /// Where the last record ends by the header.
    end: u64,
    places: Option<BufReader<File>>,
    table: Option<dbf::Reader<BufReader<File>>>,
    /// Records so far, with those that are deleted.
    n_records: u64,
    index: usize,
    is_over: bool,
}

impl Iterator for Shapes {
    type Item = Part<'static>;

    fn next(&mut self) -> Option<Part<'static>> {
        while !self.is_over {
            let found = match self.record() {
                Ok(Some(found)) => found,
                Ok(None) => {
                    self.is_over = true;
                    return None;
                }
                Err(source) => {
                    self.is_over = true;
                    return Some(Part::broken(self.index, Error::Interrupted { source }));
                }
            };
            self.n_records += 1;
            let row = match self.table.as_mut().map(dbf::Reader::row).transpose() {
                Ok(row) => row.flatten(),
                Err(source) => {
                    self.is_over = true;
                    return Some(Part::broken(self.index, Error::Interrupted { source }));
                }
            };
            let mut feature = Feature::numbered(self.index);
            match row {
                Some(dbf::Row::Deleted) => continue,
                Some(dbf::Row::Values(values)) => feature.properties = values,
                None if self.table.is_some() => feature.notes.push(Note {
                    code: "values_missing",
                    text:
                        "the `.dbf` ends before its row, so it has no values; copy the `.dbf` anew"
                            .to_owned(),
                }),
                None => {}
            }
            self.index += 1;
            return Some(part(found, feature));
        }
        None
    }
}

impl Shapes {
    /// The content of the next record, or what is wrong with it; `None` at the end.
    fn record(&mut self) -> io::Result<Option<Result<Vec<u8>, String>>> {
        if let Some(places) = &mut self.places {
            let mut place = [0; 8];
            match places.read_exact(&mut place) {
                Ok(()) => {}
                Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => {
                    self.is_over = true;
                    return Ok(None);
                }
                Err(error) => return Err(error),
            }
            let words = u32::from_be_bytes([place[0], place[1], place[2], place[3]]);
            let (here, there) = (self.shapes.stream_position()?, 2 * u64::from(words));
            // A move by nothing keeps what was read ahead.
            match i64::try_from(there).ok().and_then(|there| there.checked_sub_unsigned(here)) {
                Some(step) => self.shapes.seek_relative(step)?,
                None => drop(self.shapes.seek(SeekFrom::Start(there))?),
            }
        }
        let mut head = Vec::new();
        self.shapes.by_ref().take(8).read_to_end(&mut head)?;
        let &[_, _, _, _, a, b, c, d] = head.as_slice() else {
            if self.places.is_some() {
                return Ok(Some(Err("the record lies behind the end of the file".to_owned())));
            }
            let (at, end) = (self.at, self.end);
            // Bytes behind the last record are no record.
            if at >= end {
                return Ok(None);
            }
            return Err(io::Error::new(
                io::ErrorKind::UnexpectedEof,
                match head.is_empty() {
                    true => format!("the `.shp` ends after {at} of {end} bytes"),
                    false => "the `.shp` ends in the record".to_owned(),
                },
            ));
        };
        let size = 2 * u64::from(u32::from_be_bytes([a, b, c, d]));
        let mut content = Vec::new();
        self.shapes.by_ref().take(size).read_to_end(&mut content)?;
        if (content.len() as u64) < size {
            let why = "the `.shp` ends in the record";
            return match self.places {
                Some(_) => Ok(Some(Err(why.to_owned()))),
                None => Err(io::Error::new(io::ErrorKind::UnexpectedEof, why)),
            };
        }
        self.at += 8 + size;
        Ok(Some(Ok(content)))
    }
}

/// A record as a feature.
fn part(content: Result<Vec<u8>, String>, mut feature: Feature) -> Part<'static> {
    let size = content.as_ref().map_or(0, Vec::len);
    Part::of_row(size, move || {
        let index = feature.index;
        match content.and_then(|content| shape(&content, &mut feature)) {
            Ok(()) => Ok(feature),
            Err(why) => {
                let error = Error::Value { place: "shape".to_owned(), why };
                Err(FeatureError { feature: index, id: None, error })
            }
        }
    })
}

/// Reads the content of a record.
fn shape(content: &[u8], feature: &mut Feature) -> Result<(), String> {
    let early = || "it ends too early".to_owned();
    let kind = i32::from_le_bytes(*content.first_chunk().ok_or_else(early)?);
    let plain = match kind {
        kind::MULTIPATCH => kind,
        21 | 23 | 25 | 28 => kind - kind::MEASURED,
        11 | 13 | 15 | 18 => kind - kind::IN_SPACE,
        other => other,
    };
    feature.geometry = match plain {
        kind::NULL => "without a geometry",
        kind::POINT => "a Point",
        kind::POLYLINE => "a PolyLine",
        kind::POLYGON => "a Polygon",
        kind::MULTIPOINT => "a MultiPoint",
        kind::MULTIPATCH => "a MultiPatch",
        other => return Err(format!("shapes of type {other} are not known")),
    }
    .to_owned();
    if plain != kind::POLYGON {
        return Ok(());
    }
    feature.polygonal = true;
    // The type and the box are before the counts.
    let counts = content.get(36..44).ok_or_else(early)?;
    let count = |at: usize| {
        counts
            .get(at..)
            .and_then(<[u8]>::first_chunk)
            .map_or(0, |bytes| u32::from_le_bytes(*bytes) as usize)
    };
    let (n_parts, n_points) = (count(0), count(4));
    let rest = &content[44..];
    let more = |what: &str, n: usize| format!("{n} {what} are more than there is");
    let starts = n_parts.checked_mul(4).and_then(|size| rest.get(..size));
    let starts = starts.ok_or_else(|| more("rings", n_parts))?;
    let points = n_points.checked_mul(16).and_then(|size| rest[starts.len()..].get(..size));
    let points = points.ok_or_else(|| more("points", n_points))?;
    let number = |bytes: &[u8]| bytes.first_chunk().map_or(0.0, |bytes| f64::from_le_bytes(*bytes));
    let points: Vec<Point> = points
        .chunks_exact(16)
        .map(|pair| Point::new(number(&pair[..8]), number(&pair[8..])))
        .collect();
    let starts: Vec<usize> = starts
        .chunks_exact(4)
        .map(|start| start.first_chunk().map_or(0, |bytes| u32::from_le_bytes(*bytes) as usize))
        .collect();
    let ends = starts.iter().skip(1).copied().chain([points.len()]);
    let rings: Result<Vec<Vec<Point>>, String> = starts
        .iter()
        .zip(ends)
        .enumerate()
        .map(|(ring, (&start, end))| {
            let found = points.get(start..end).map(<[Point]>::to_vec);
            found.ok_or_else(|| {
                format!("ring {ring} runs from point {start} to {end} of {n_points}")
            })
        })
        .collect();
    feature.polygons = rings::grouped(rings?);
    Ok(())
}
