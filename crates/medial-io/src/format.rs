use crate::json::Head;
use crate::{Error, dxf, font, gzip, maxis};
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
    /// A GeoJSON text sequence [RFC 8142]: the same, a record separator before each line.
    GeoJsonSeq,
    /// The axis document: JSON Lines.
    Json,
    /// Well-known text, one geometry after the other.
    Wkt,
    /// Well-known binary, one geometry after the other, or a line of hexadecimal digits each.
    Wkb,
    /// Comma-separated values: points in, a row each; a row a path out.
    Csv,
    /// A vector picture.
    Svg,
    /// A raster picture.
    Png,
    /// A raster image, with or without a place in the world.
    Tiff,
    /// A photograph.
    Jpeg,
    /// Bare JSON arrays `[[ring], [hole], …]`.
    Rings,
    /// The compressed axis.
    Maxis,
    /// A program for a machine tool.
    GCode,
    /// GeoPackage.
    Gpkg,
    /// Shapefile, with the files that belong to it.
    Shp,
    /// FlatGeobuf.
    Fgb,
    /// GeoParquet.
    Parquet,
    /// A drawing of a CAD program.
    Dxf,
    /// A font.
    Ttf,
}

const NAMES: &[(Format, &str, &[&str])] = &[
    (Format::GeoJson, "geojson", &["geojson"]),
    (Format::GeoJsonLines, "geojsonl", &["geojsonl", "ndgeojson"]),
    (Format::GeoJsonSeq, "geojsonseq", &["geojsonseq", "geojsons"]),
    (Format::Json, "json", &["json", "jsonl", "ndjson"]),
    (Format::Wkt, "wkt", &["wkt"]),
    (Format::Wkb, "wkb", &["wkb"]),
    (Format::Csv, "csv", &["csv"]),
    (Format::Svg, "svg", &["svg"]),
    (Format::Png, "png", &["png"]),
    (Format::Tiff, "tiff", &["tiff", "tif"]),
    (Format::Jpeg, "jpeg", &["jpg", "jpeg"]),
    (Format::Rings, "rings", &["rings"]),
    (Format::Maxis, "maxis", &["maxis"]),
    (Format::GCode, "gcode", &["gcode", "nc", "ngc", "tap"]),
    (Format::Gpkg, "gpkg", &["gpkg"]),
    (Format::Shp, "shp", &["shp"]),
    (Format::Fgb, "fgb", &["fgb"]),
    (Format::Parquet, "parquet", &["parquet", "geoparquet"]),
    (Format::Dxf, "dxf", &["dxf"]),
    (Format::Ttf, "ttf", &["ttf", "otf", "ttc", "otc"]),
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

    /// Whether its features are read one by one, as they arrive.
    #[must_use]
    pub fn is_streamed(self) -> bool {
        matches!(self, Self::GeoJsonLines | Self::GeoJsonSeq | Self::Wkt)
    }

    /// Whether it is a table of features in a file of its own, or several: read by
    /// [`open`](crate::open), written by [`table::write`](crate::table::write).
    #[must_use]
    pub fn is_table(self) -> bool {
        matches!(self, Self::Gpkg | Self::Shp | Self::Fgb | Self::Parquet)
    }

    /// The format in which features are encoded on their way into this one: GeoJSON lines for tables and
    /// text sequences, else itself.
    #[must_use]
    pub fn encoding(self) -> Self {
        if self.is_table() || self == Self::GeoJsonSeq { Self::GeoJsonLines } else { self }
    }

    /// Whether it has curves, which are read as edges within a tolerance.
    #[must_use]
    pub fn has_curves(self) -> bool {
        matches!(self, Self::Svg | Self::Dxf | Self::Ttf)
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

    /// The format of an input, told by its beginning: JSON by its `type`, else the compressed
    /// axis, a font, DXF, SVG, WKB or WKT.
    ///
    /// # Errors
    /// If the input is empty or begins like none of them.
    pub fn of_content(bytes: &[u8]) -> Result<Content, Error> {
        if let Some(format) = of_table(bytes) {
            return Ok(Content::Polygons(format));
        }
        if let Some(format) = of_image(bytes) {
            return Ok(Content::Polygons(format));
        }
        if font::begins(bytes) {
            return Ok(Content::Polygons(Self::Ttf));
        }
        if dxf::begins(bytes) {
            return Ok(Content::Polygons(Self::Dxf));
        }
        // Packed drawings are usual, nothing else is.
        if bytes.starts_with(&gzip::MAGIC) {
            return Ok(Content::Polygons(Self::Svg));
        }
        let packed: [(&[u8], &str); 2] = [
            (b"PK\x03\x04", "it is a ZIP archive; unpack it, and name a file in it"),
            (b"wOF", "it is a font packed for the web (WOFF); turn it into TrueType or OpenType"),
        ];
        if let Some((_, why)) = packed.iter().find(|(start, _)| bytes.starts_with(start)) {
            return Err(Error::File { why: (*why).to_owned() });
        }
        if let [0 | 1, ..] = bytes {
            return Ok(Content::Polygons(Self::Wkb));
        }
        // Without the version, and what else the reader has more to say of.
        if bytes.starts_with(&maxis::MAGIC[..6]) {
            return Ok(Content::CompressedAxes);
        }
        let text = crate::text(bytes)?;
        let start = text.trim_start_matches(|c: char| c.is_whitespace() || c == '\u{1e}');
        match start.as_bytes().first() {
            None => Err(Error::Empty),
            Some(b'[') => Ok(Content::Polygons(Self::Rings)),
            Some(b'{') => of_json(text, start),
            Some(b'<') => Ok(Content::Polygons(Self::Svg)),
            Some(b'0') => Ok(Content::Polygons(Self::Wkb)),
            Some(c) if c.is_ascii_alphabetic() => Ok(Content::Polygons(Self::Wkt)),
            Some(_) => Err(Error::Unknown),
        }
    }
}

/// What an input holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Content {
    /// Polygons, in this format.
    Polygons(Format),
    /// Medial axes.
    Axes,
    /// Compressed axes.
    CompressedAxes,
}

/// The format of a table that begins so.
fn of_table(bytes: &[u8]) -> Option<Format> {
    let starts: [(Format, &[u8]); 4] = [
        (Format::Gpkg, b"SQLite format 3\0"),
        (Format::Shp, &[0, 0, 0x27, 0x0a, 0, 0, 0, 0]),
        (Format::Fgb, b"fgb\x03fgb"),
        (Format::Parquet, b"PAR1"),
    ];
    starts.iter().find(|(_, start)| bytes.starts_with(start)).map(|(format, _)| *format)
}

/// The format of an image that begins so.
fn of_image(bytes: &[u8]) -> Option<Format> {
    let starts: [(Format, &[u8]); 6] = [
        (Format::Png, b"\x89PNG"),
        (Format::Jpeg, b"\xff\xd8\xff"),
        (Format::Tiff, b"II*\0"),
        (Format::Tiff, b"MM\0*"),
        (Format::Tiff, b"II+\0"),
        (Format::Tiff, b"MM\0+"),
    ];
    starts.iter().find(|(_, start)| bytes.starts_with(start)).map(|(format, _)| *format)
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extensions_name_formats() {
        let of = |name: &str| Format::from_path(Path::new(name)).ok();
        assert_eq!(of("a/b.GeoJSON"), Some(Format::GeoJson));
        assert_eq!(of("axes.jsonl"), Some(Format::Json));
        assert_eq!(of("rings"), None);
        let error = Format::from_path(Path::new("a.xyz")).unwrap_err();
        assert!(error.to_string().starts_with("`xyz` is no known format; known are geojson, "));
    }

    #[test]
    fn content_is_told_by_its_beginning() {
        let of = |text: &str| Format::of_content(text.as_bytes()).ok();
        assert_eq!(of("[[[0,0]]]"), Some(Content::Polygons(Format::Rings)));
        assert_eq!(of(" POLYGON((0 0))"), Some(Content::Polygons(Format::Wkt)));
        let collection = "{\"features\":[],\n\"type\":\"FeatureCollection\"}";
        assert_eq!(of(collection), Some(Content::Polygons(Format::GeoJson)));
        let lines = "{\"type\":\"Feature\"}\n{\"type\":\"Feature\"}";
        assert_eq!(of(lines), Some(Content::Polygons(Format::GeoJsonLines)));
        assert_eq!(of("{\"version\":1,\"type\":\"MedialAxis\"}"), Some(Content::Axes));
        assert_eq!(of("{\"a\":1}"), None);
        assert_eq!(of("\u{2}"), None);
        assert_eq!(of("\u{1}\u{3}"), Some(Content::Polygons(Format::Wkb)));
        assert_eq!(of("0103"), Some(Content::Polygons(Format::Wkb)));
        assert_eq!(Format::of_content(b"\x8dMAXIS").ok(), Some(Content::CompressedAxes));
        assert!(matches!(Format::of_content(b" \n"), Err(Error::Empty)));
        let packed = [0x1f, 0x8b, 8];
        assert_eq!(Format::of_content(&packed).ok(), Some(Content::Polygons(Format::Svg)));
        let told = |bytes: &[u8]| Format::of_content(bytes).unwrap_err().to_string();
        assert!(told(b"wOF2\0\x01").contains("WOFF"));
        assert!(told(b"PK\x03\x04\x14").contains("ZIP"));
    }
}
