//! Features as they arrive, one after the other, in the memory of a few of them.
//!
//! # Contract
//! A stream gives the features that the whole text gives, with the same numbers, errors and places. Only
//! bytes that are no UTF-8 are the fault of the feature they stand in, not of the whole input.

use std::io::BufRead;
use std::iter;

use crate::text::{lines, text};
use crate::{Crs, Error, FeatureError, Format, Layer, Part, geojson, points, wkt};

/// Reads features from a source as they arrive, if the [format](Format::is_streamed) has one after the
/// other.
///
/// Not more of the text is held than the features that are asked for. A source that fails gives
/// [`Error::Interrupted`] as its last item.
///
/// ```
/// use medial_io::{Format, read_stream};
///
/// let lines = "POLYGON ((0 0, 4 0, 4 2, 0 0))\nPOLYGON EMPTY\n";
/// let layer = read_stream(Format::Wkt, lines.as_bytes())?;
/// assert_eq!(layer.filter(|feature| feature.is_ok()).count(), 2);
/// # Ok::<(), medial_io::Error>(())
/// ```
///
/// # Errors
/// If features of this format cannot be read one by one.
pub fn read_stream<'a>(
    format: Format,
    source: impl BufRead + Send + 'a,
) -> Result<Layer<'a>, Error> {
    let mut index = 0;
    let lines = Lines { source: Some(source), number: 0 };
    let parts: Box<dyn Iterator<Item = Part<'a>> + Send + 'a> = match format {
        Format::GeoJsonLines | Format::GeoJsonSeq => Box::new(lines.filter_map(move |line| {
            let part = part_of_line(line, index)?;
            index += 1;
            Some(part)
        })),
        Format::Wkt => Box::new(pieces(lines).flat_map(move |piece| {
            let parts = parts_of_piece(piece, index);
            index += parts.len();
            parts
        })),
        other => return Err(Error::Unreadable { format: other }),
    };
    // Lines have no place for it.
    let crs = (format != Format::Wkt).then(Crs::of_geojson);
    Ok(points::gathered(Layer { crs, ..Layer::of_parts(parts) }))
}

/// Whole lines of a source.
struct Piece {
    /// How many lines are before them.
    before: usize,
    text: Result<String, Error>,
}

/// The lines of a source, with their ends, up to its end or a failure.
struct Lines<R> {
    /// Gone once it has failed.
    source: Option<R>,
    number: usize,
}

impl<R: BufRead> Iterator for Lines<R> {
    type Item = Piece;

    fn next(&mut self) -> Option<Piece> {
        let before = self.number;
        let mut bytes = Vec::new();
        let text = match self.source.as_mut()?.read_until(b'\n', &mut bytes) {
            Ok(0) => return None,
            Ok(_) => {
                self.number += 1;
                // What has no byte order mark is not copied.
                match String::from_utf8(bytes) {
                    Ok(line) if before > 0 || !line.starts_with('\u{feff}') => Ok(line),
                    Ok(line) => text(line.as_bytes()).map(ToOwned::to_owned),
                    Err(_) => Err(Error::NotUtf8 { line: self.number }),
                }
            }
            Err(source) => {
                self.source = None;
                Err(Error::Interrupted { source })
            }
        };
        Some(Piece { before, text })
    }
}

/// The feature in a line, if there is something.
fn part_of_line(line: Piece, index: usize) -> Option<Part<'static>> {
    let text = match line.text {
        Ok(text) => text,
        Err(error) => return Some(Part::broken(index, error)),
    };
    lines(&text).next()?;
    Some(Part::of_text(text, line.before, index, |text, index| {
        let part = lines(text).next().unwrap_or_default();
        geojson::feature(text, part, index)
    }))
}

/// The features of geometries that follow one another.
fn parts_of_piece(piece: Piece, first: usize) -> Vec<Part<'static>> {
    let text = match piece.text {
        Ok(text) => text,
        Err(error) => return vec![Part::broken(first, error)],
    };
    let features = wkt::read(&text).map(|read| match read {
        Ok(mut feature) => {
            feature.index += first;
            Ok(feature)
        }
        Err(FeatureError { feature, id, error }) => {
            Err(FeatureError { feature: feature + first, id, error: error.after(piece.before) })
        }
    });
    features.map(Part::of_read).collect()
}

/// Lines put together so that each geometry, on one line or on several, lies within one piece.
fn pieces(mut lines: impl Iterator<Item = Piece>) -> impl Iterator<Item = Piece> {
    let mut ahead = None;
    iter::from_fn(move || {
        let mut piece: Piece = ahead.take().or_else(|| lines.next())?;
        let Ok(text) = &mut piece.text else { return Some(piece) };
        let mut open = depth(text);
        for line in lines.by_ref() {
            match &line.text {
                Ok(more) if !begins_anew(text, open, more) => {
                    open += depth(more);
                    text.push_str(more);
                }
                _ => {
                    ahead = Some(line);
                    break;
                }
            }
        }
        Some(piece)
    })
}

/// How many brackets a text opens more than it closes.
fn depth(text: &str) -> isize {
    let bracket = |byte| isize::from(byte == b'(') - isize::from(byte == b')');
    text.bytes().map(bracket).sum()
}

/// Whether what was read so far, with so many brackets open, is a geometry or nothing, and a line begins
/// another one. An error in the first one is no reason to look for its end in the others.
fn begins_anew(text: &str, open: isize, line: &str) -> bool {
    let has_word = line.trim_start().starts_with(char::is_alphabetic);
    let text = text.trim_end_matches(|c: char| c.is_whitespace() || c == ';');
    let is_empty = || {
        let start = text.len().saturating_sub("empty".len());
        text.get(start..).is_some_and(|end| end.eq_ignore_ascii_case("empty"))
    };
    has_word
        && match text.chars().next_back() {
            None => true,
            Some('(' | ',') => false,
            Some(')') => true,
            Some(_) => open > 0 || is_empty(),
        }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::{self, BufReader, Read};

    /// What a layer gives, told.
    fn told(layer: Layer<'_>) -> Vec<String> {
        let told = |read: Result<crate::Feature, FeatureError>| match read {
            Ok(f) => format!("{} {:?} {} {:?}", f.index, f.polygons, f.geometry, f.properties),
            Err(e) => format!("{}: {e}", e.feature),
        };
        layer.map(told).collect()
    }

    fn streamed(format: Format, text: &str) -> Vec<String> {
        // Lines that do not fit are read as well.
        told(read_stream(format, BufReader::with_capacity(3, text.as_bytes())).unwrap())
    }

    #[test]
    fn a_stream_gives_what_the_whole_text_gives() {
        let lines = "\u{feff}{\"type\":\"Feature\",\"properties\":{\"a\":1},\"geometry\":null}\r\n\n \
            \u{1e}{\"type\":\"Polygon\",\"coordinates\":[[[0,0],[4,0],[4,2],[0,0]]]}\n{\"type\":1}\n  \
            {\"type\":\"Polygon\",\"coordinates\":[[[0,0],[nan,0]]]}\n{\"type\":\"Point\"}";
        let whole = told(geojson::read_lines(text(lines.as_bytes()).unwrap()));
        assert_eq!(whole.len(), 5);
        assert_eq!(streamed(Format::GeoJsonLines, lines), whole);

        let geometries = "SRID=4326;\nPOLYGON\n((0 0, 4 0,\n4 2,0 0)\n)\nPOINT EMPTY\n\npolygon Z\n \
            ((0 0 1,4 0 1, 4 x 1, 0 0 1))\nPOLYGON ((0 0, 1 0, 1 1, 0 0));POLYGON ((1 1, 2 1, 2 2,1 1)) \n\
            GEOMETRYCOLLECTION (\nPOINT (1 1),\n POLYGON ((5 5, 6 5, 6 6, 5 5)))\nPOLYGON ((7 7, 8 7, 8 8))\n\
            foo\nPOLYGON ((0 0, 9 0, 9 9, 0 0";
        let whole = told(wkt::read(geometries));
        assert_eq!(streamed(Format::Wkt, geometries), whole);
        assert!(whole.len() > 7, "{whole:?}");
    }

    #[test]
    fn a_geometry_without_end_does_not_take_the_next_one_with_it() {
        let text = "POLYGON ((0 0, 1 0, 1 1, 0 0)\nPOLYGON ((0 0, 1 0, 1 1, 0 0))\nPOLYGON ((0 0";
        let streamed = streamed(Format::Wkt, text);
        assert_eq!(streamed.len(), 3);
        assert!(streamed[1].starts_with("1 [[["), "{streamed:?}");
        let whole = told(wkt::read(text));
        assert_eq!((whole.len(), &whole[1]), (3, &streamed[1]));
    }

    #[test]
    fn pieces_are_no_larger_than_they_must_be() {
        let text = "POLYGON ((0 0,\n1 1\nPOINT (1 1)\nPOINT EMPTY;\nPOINT (2\n2)\n";
        let lines = Lines { source: Some(text.as_bytes()), number: 0 };
        let texts: Vec<String> = pieces(lines).map(|piece| piece.text.unwrap()).collect();
        let expected =
            ["POLYGON ((0 0,\n1 1\n", "POINT (1 1)\n", "POINT EMPTY;\n", "POINT (2\n2)\n"];
        assert_eq!(texts, expected);
    }

    /// Ends with a failure.
    struct Failing<'a>(&'a [u8]);

    impl Read for Failing<'_> {
        fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
            match self.0.read(buffer)? {
                0 => Err(io::Error::other("the line is dead")),
                n => Ok(n),
            }
        }
    }

    #[test]
    fn faults_of_the_source_are_told_where_they_occur() {
        let bytes = b"{\"type\":\"Point\"}\n\xff\n{\"type\":\"Point\"}\n";
        for format in [Format::GeoJsonLines, Format::Wkt] {
            let source = BufReader::new(Failing(bytes));
            let items: Vec<_> = read_stream(format, source).unwrap().collect();
            let error = |k: usize| items[k].as_ref().unwrap_err().error.to_string();
            assert_eq!(items.len(), 4);
            assert_eq!(error(1), "line 2: the bytes are not UTF-8; save the file as UTF-8");
            assert_eq!(error(3), "the line is dead");
        }
        assert!(read_stream(Format::Rings, io::empty()).is_err());
    }
}
