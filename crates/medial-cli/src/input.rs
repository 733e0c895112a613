use crate::failure::{Failure, plain};
use crate::guard::guarded;
use crate::output::reads;
use medial_io::axis_document::{self, AxisDocument};
use medial_io::image::WorldFile;
use medial_io::{Content, Crs, Error, Format, Layer, ReadOptions, maxis, svg};
use std::cell::RefCell;
use std::fs::{self, File};
use std::io::{self, BufRead, BufReader, Cursor, Read as _};
use std::path::{Path, PathBuf};

/// An input, read whole.
pub struct Input {
    /// How messages name it.
    pub name: String,
    bytes: Vec<u8>,
}

type Source = Box<dyn BufRead + Send>;

/// An input of polygons in a format that is known.
pub struct Polygons {
    /// How messages name it.
    pub name: String,
    /// The format that was named or found out.
    pub format: Format,
    options: ReadOptions,
    content: Features,
}

/// What an input holds.
pub enum Opened {
    Polygons(Polygons),
    Axes(Input),
}

/// What to do with axis documents where polygons are expected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Documents {
    /// Nothing can be done with them.
    Refused,
    /// Take the polygons that complete axes are made of.
    AsPolygons,
}

/// The reference system and the records of a compressed file.
type Stored = (Option<Crs>, Vec<maxis::Record>);

/// The features of an input.
enum Features {
    Whole(Vec<u8>),
    /// In a file that is read by its path.
    File(PathBuf),
    /// Axis documents.
    Axes(Vec<u8>),
    /// Not read yet, or being read.
    Stream(RefCell<Option<Source>>),
}

impl Input {
    /// Reads a file, or standard input for `-`.
    pub fn read(path: &Path) -> Result<Self, Failure> {
        let name = name(path);
        reads(path)?;
        let mut bytes = Vec::new();
        open(path)
            .and_then(|mut source| source.read_to_end(&mut bytes))
            .map_err(|error| unreadable(&name, &error))?;
        Ok(Self { name, bytes })
    }

    /// All of it.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    pub fn text(&self) -> Result<&str, Failure> {
        medial_io::text(&self.bytes).map_err(|error| self.wrong(error))
    }

    /// The axes in documents or a compressed file.
    pub fn axes(
        &self,
    ) -> Result<impl Iterator<Item = Result<AxisDocument, Error>> + Send + '_, Failure> {
        axis_document::of_bytes(&self.bytes).map_err(|error| self.wrong(error))
    }

    /// What a compressed file stores, with the reference system that it names; `None` for other content.
    pub fn compressed(&self) -> Result<Option<Stored>, Failure> {
        if !matches!(Format::of_content(&self.bytes), Ok(Content::CompressedAxes)) {
            return Ok(None);
        }
        let records = maxis::records(&self.bytes).map_err(|error| self.wrong(error))?;
        let crs = records.crs.clone().map(Crs::of_member);
        let records = records.collect::<Result<_, _>>().map_err(|error| self.wrong(error))?;
        Ok(Some((crs, records)))
    }

    /// The failure that the content is wrong.
    pub fn wrong(&self, why: impl ToString) -> Failure {
        Failure::file(&self.name, why)
    }
}

impl Opened {
    /// Opens a file, or standard input for `-`. The format is the one asked for, else that of the
    /// extension, else told by the content. What has one feature after the other is read later, as it is
    /// needed.
    ///
    /// A layer can be chosen of what has layers; else it must have the name of the file. Text of drawings
    /// takes the fonts in these files, or without any those of the system.
    pub fn new(
        path: &Path,
        from: Option<Format>,
        mut options: ReadOptions,
        fonts: &[PathBuf],
    ) -> Result<Self, Failure> {
        let name = name(path);
        reads(path)?;
        let known = from.or_else(|| Format::from_path(path).ok());
        if let Some(format) = known.filter(|format| format.is_table()) {
            return table(path, name, format, options);
        }
        let stem = path.file_stem().unwrap_or_default();
        let failed = |error: io::Error| unreadable(&name, &error);
        let mut source = open(path).map_err(failed)?;
        let mut bytes = Vec::new();
        let format = match known {
            Some(format) if !matches!(format, Format::Json | Format::Maxis) => format,
            _ => {
                bytes = beginning(&mut source).map_err(failed)?;
                match Format::of_content(&bytes) {
                    Ok(Content::Polygons(format)) if format.is_table() => {
                        return table(path, name, format, options);
                    }
                    Ok(Content::Polygons(format)) if format.is_streamed() => format,
                    _ => {
                        source.read_to_end(&mut bytes).map_err(failed)?;
                        match Format::of_content(&bytes) {
                            Ok(Content::Polygons(format)) => format,
                            Ok(Content::Axes | Content::CompressedAxes) => {
                                if options.text.is_some() {
                                    let why = "--text is for fonts; the input is an axis";
                                    return Err(Failure::Usage(why.to_owned()));
                                }
                                return Ok(Self::Axes(Input { name, bytes }));
                            }
                            Err(error) => return Err(Failure::file(&name, error)),
                        }
                    }
                }
            }
        };
        if let Some(layer) = options.layer.as_deref()
            && !matches!(format, Format::Dxf | Format::Ttf)
            && *stem != *layer
        {
            let why = format!("--layer {layer}: the format {format} has no layers with names");
            return Err(Failure::Usage(why));
        }
        if options.text.is_some() && format != Format::Ttf {
            let why = format!("--text is for fonts; the input is {format}");
            return Err(Failure::Usage(why));
        }
        if matches!(format, Format::Png | Format::Tiff | Format::Jpeg) {
            options.world = Box::new(world_of(path)?);
        }
        let content = if format.is_streamed() {
            let source: Source = Box::new(Cursor::new(bytes).chain(source));
            Features::Stream(RefCell::new(Some(source)))
        } else {
            source.read_to_end(&mut bytes).map_err(failed)?;
            if format == Format::Svg && svg::has_text(&bytes) {
                options.fonts = self::fonts(fonts)?;
            }
            Features::Whole(bytes)
        };
        Ok(Self::Polygons(Polygons { name, format, options, content }))
    }

    /// The polygons, also those of axis documents if they may be; else that they are none.
    pub fn polygons(self, documents: Documents) -> Result<Polygons, Failure> {
        match self {
            Self::Polygons(polygons) => Ok(polygons),
            Self::Axes(Input { name, bytes }) if documents == Documents::AsPolygons => {
                let options = ReadOptions::default();
                let content = Features::Axes(bytes);
                Ok(Polygons { name, format: Format::Json, options, content })
            }
            Self::Axes(input) => {
                let what = match Format::of_content(&input.bytes) {
                    Ok(Content::CompressedAxes) => "a compressed axis",
                    _ => "an axis document",
                };
                Err(input.wrong(format_args!("is {what}; polygons are needed here")))
            }
        }
    }
}

impl Polygons {
    /// The features; those of a stream can be had once.
    pub fn layer(&self) -> Result<Layer<'_>, Failure> {
        let layer = match &self.content {
            Features::File(path) => medial_io::open(self.format, path, &self.options),
            // Parsers of fonts may panic, which the reader catches.
            Features::Whole(bytes) => {
                guarded(|| medial_io::read_with(self.format, bytes, &self.options))
                    .map_err(|panic| Failure::file(&self.name, panic))?
            }
            Features::Axes(bytes) => axis_document::of_bytes(bytes).map(axis_document::polygons),
            Features::Stream(source) => {
                let source = source.take().unwrap_or_else(|| Box::new(io::empty()));
                medial_io::read_stream(self.format, source)
            }
        };
        layer.map_err(|error| match error {
            Error::Layer { why } => Failure::Usage(format!("{}: {why}", self.name)),
            Error::Interrupted { source } => unreadable(&self.name, &source),
            error => Failure::file(&self.name, error),
        })
    }
}

/// An input that is read by its path.
fn table(
    path: &Path,
    name: String,
    format: Format,
    options: ReadOptions,
) -> Result<Opened, Failure> {
    if path.as_os_str() == "-" {
        let why = format!("{format} is read from a file, not from standard input; name the file");
        return Err(Failure::Usage(why));
    }
    if options.text.is_some() {
        return Err(Failure::Usage(format!("--text is for fonts; the input is {format}")));
    }
    let content = Features::File(path.to_owned());
    Ok(Opened::Polygons(Polygons { name, format, options, content }))
}

/// What files beside an image say of where it lies; nothing that is told takes their place.
pub fn world_of(image: &Path) -> Result<WorldFile, Failure> {
    let world = WorldFile::of(image).map_err(|error| Failure::file(&name(image), error))?;
    let files = world.world.iter().chain(&world.prj);
    files.map(|(name, _)| reads(Path::new(name))).collect::<Result<Vec<()>, _>>()?;
    Ok(world)
}

fn fonts(files: &[PathBuf]) -> Result<svg::Fonts, Failure> {
    if files.is_empty() {
        return Ok(svg::Fonts::of_system());
    }
    let with = |fonts: svg::Fonts, file: &PathBuf| {
        Ok(fonts.with(fs::read(file).map_err(|error| unreadable(&name(file), &error))?))
    };
    files.iter().try_fold(svg::Fonts::default(), with)
}

fn open(path: &Path) -> io::Result<Source> {
    Ok(if path.as_os_str() == "-" {
        Box::new(BufReader::new(io::stdin()))
    } else {
        Box::new(BufReader::new(File::open(path)?))
    })
}

/// So many lines of a source that two hold something, if there are as many: the second one tells lines
/// of JSON from a single document.
fn beginning(source: &mut Source) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut n_lines = 0;
    while n_lines < 2 {
        let start = bytes.len();
        if source.read_until(b'\n', &mut bytes)? == 0 {
            break;
        }
        n_lines += usize::from(!bytes[start..].trim_ascii().is_empty());
    }
    Ok(bytes)
}

fn unreadable(name: &str, error: &io::Error) -> Failure {
    Failure::file(name, format_args!("cannot read: {}", plain(error)))
}

fn name(path: &Path) -> String {
    if path.as_os_str() == "-" { "<stdin>".to_owned() } else { path.display().to_string() }
}
