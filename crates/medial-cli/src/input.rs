use crate::failure::{Failure, plain};
use medial_io::{Content, Format};
use std::io::Read as _;
use std::path::Path;

/// An input, read whole.
pub struct Input {
    /// How messages name it.
    pub name: String,
    bytes: Vec<u8>,
}

impl Input {
    /// Reads a file, or standard input for `-`.
    pub fn read(path: &Path) -> Result<Self, Failure> {
        let name = name(path);
        let bytes = if path.as_os_str() == "-" {
            let mut bytes = Vec::new();
            std::io::stdin().lock().read_to_end(&mut bytes).map(|_| bytes)
        } else {
            std::fs::read(path)
        };
        match bytes {
            Ok(bytes) => Ok(Self { name, bytes }),
            Err(error) => Err(Failure::file(&name, format_args!("cannot read: {}", plain(&error)))),
        }
    }

    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    pub fn text(&self) -> Result<&str, Failure> {
        medial_io::text(&self.bytes).map_err(|error| self.wrong(error))
    }

    /// The failure that the content is wrong.
    pub fn wrong(&self, why: impl ToString) -> Failure {
        Failure::file(&self.name, why)
    }
}

fn name(path: &Path) -> String {
    if path.as_os_str() == "-" { "<stdin>".to_owned() } else { path.display().to_string() }
}

/// What a compressed axis is in the place of polygons.
const COMPRESSED: &str = "is a compressed axis; polygons are needed here";

/// The format of the polygons in an input: as asked for, by the extension, else by the content.
pub fn polygon_format(input: &Input, path: &Path, from: Option<Format>) -> Result<Format, Failure> {
    match from.or_else(|| Format::from_path(path).ok()) {
        Some(Format::Json) | None => match Format::of_content(input.bytes()) {
            Ok(Content::Polygons(format)) => Ok(format),
            Ok(Content::Axes) => Err(input.wrong("is an axis document; polygons are needed here")),
            Ok(Content::CompressedAxes) => Err(input.wrong(COMPRESSED)),
            Err(error) => Err(input.wrong(error)),
        },
        Some(Format::Maxis) => Err(input.wrong(COMPRESSED)),
        Some(format @ (Format::Csv | Format::Svg | Format::Png)) => {
            let why = format!(
                "the format {format} is written only; polygons come as geojson, geojsonl, wkt, wkb or rings"
            );
            Err(if from.is_some() { Failure::Usage(why) } else { input.wrong(why) })
        }
        Some(format) => Ok(format),
    }
}
