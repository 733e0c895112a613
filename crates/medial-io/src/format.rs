use crate::Error;
use crate::json::Head;
use std::fmt;
use std::path::Path;
use std::str::FromStr;

/// A format that is read or written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Format {
    /// GeoJSON: a collection, a feature or a bare geometry.
    GeoJson,
    /// One GeoJSON feature or geometry a line.
    GeoJsonLines,
    /// The axis document: JSON Lines.
    Json,
    /// Well-known text, one geometry after the other.
    Wkt,
    /// Comma-separated values, a row a path.
    Csv,
    /// A vector picture.
    Svg,
    /// A raster picture.
    Png,
    /// Bare JSON arrays `[[ring], [hole], …]`.
    Rings,
}

const NAMES: &[(Format, &str, &[&str])] = &[
    (Format::GeoJson, "geojson", &["geojson"]),
    (Format::GeoJsonLines, "geojsonl", &["geojsonl", "geojsons", "geojsonseq", "ndgeojson"]),
    (Format::Json, "json", &["json", "jsonl", "ndjson"]),
    (Format::Wkt, "wkt", &["wkt"]),
    (Format::Csv, "csv", &["csv"]),
    (Format::Svg, "svg", &["svg"]),
    (Format::Png, "png", &["png"]),
    (Format::Rings, "rings", &["rings"]),
];

/// A word or a file extension that names no format.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("`{word}` is no known format; known are {known}")]
pub struct UnknownFormat {
    /// The word.
    pub word: String,
    /// The formats there are, separated by commas.
    pub known: String,
}

impl Format {
    /// Its name in commands.
    #[must_use]
    pub fn name(self) -> &'static str {
        NAMES.iter().find(|(format, ..)| *format == self).map_or("", |(_, name, _)| name)
    }

    /// The format a file's extension stands for; letter case does not matter.
    ///
    /// # Errors
    /// If there is no extension or it names no format.
    pub fn from_path(path: &Path) -> Result<Self, UnknownFormat> {
        let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        NAMES
            .iter()
            .find(|(.., extensions)| extensions.contains(&extension.as_str()))
            .map(|(format, ..)| *format)
            .ok_or_else(|| unknown(&extension))
    }

    /// The format of a text, told by its beginning: JSON by its `type`, else WKT.
    ///
    /// # Errors
    /// If the text is empty or begins like none of them.
    pub fn of_text(text: &str) -> Result<Content, Error> {
        let start = text.trim_start_matches(|c: char| c.is_whitespace() || c == '\u{1e}');
        match start.as_bytes().first() {
            None => Err(Error::Empty),
            Some(b'[') => Ok(Content::Polygons(Self::Rings)),
            Some(b'{') => of_json(text, start),
            Some(c) if c.is_ascii_alphabetic() => Ok(Content::Polygons(Self::Wkt)),
            Some(_) => Err(Error::Unknown),
        }
    }
}

/// What a text holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Content {
    /// Polygons, in this format.
    Polygons(Format),
    /// Medial axes.
    Axes,
}

fn of_json(text: &str, start: &str) -> Result<Content, Error> {
    // The first document decides; what follows it tells lines from a whole.
    let (head, rest) = Head::first(text, start)?;
    match head.kind.as_deref() {
        Some("MedialAxis") => Ok(Content::Axes),
        Some("FeatureCollection") => Ok(Content::Polygons(Format::GeoJson)),
        Some(_) if rest.trim().is_empty() => Ok(Content::Polygons(Format::GeoJson)),
        Some(_) => Ok(Content::Polygons(Format::GeoJsonLines)),
        None => Err(Error::Unknown),
    }
}

fn unknown(word: &str) -> UnknownFormat {
    let known = NAMES.iter().map(|(_, name, _)| *name).collect::<Vec<_>>().join(", ");
    UnknownFormat { word: word.to_owned(), known }
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Format {
    type Err = UnknownFormat;

    fn from_str(word: &str) -> Result<Self, UnknownFormat> {
        NAMES
            .iter()
            .find(|(_, name, _)| *name == word)
            .map(|(format, ..)| *format)
            .ok_or_else(|| unknown(word))
    }
}
