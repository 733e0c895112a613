use super::{
    Header, Image, Place, Values, Wanted, banded, brightness, coloured, flattened, most_bytes,
};
use crate::{Crs, Error};
use medial::geom::Point;
use std::borrow::Cow;
use std::io::Cursor;
use tiff::decoder::{Decoder, DecodingResult, Limits};
use tiff::tags::Tag;
use tiff::{ColorType, TiffError};

/// The tags of GeoTIFF, and that of GDAL for the value of no data.
const PIXEL_SCALE: Tag = Tag::Unknown(33550);
const TIE_POINTS: Tag = Tag::Unknown(33922);
const TRANSFORMATION: Tag = Tag::Unknown(34264);
const GEO_KEYS: Tag = Tag::Unknown(34735);
const NO_DATA: Tag = Tag::Unknown(42113);

/// Keys of GeoTIFF whose values are codes of EPSG, and the one that says what coordinates are those of.
const GEOGRAPHIC_KEY: u16 = 2048;
const PROJECTED_KEY: u16 = 3072;
const RASTER_KEY: u16 = 1025;

/// The code for a system that the file describes in another way.
const USER_DEFINED: u16 = 32_767;

type Source<'a> = Decoder<Cursor<Cow<'a, [u8]>>>;

/// The first image of a TIFF file: 1 to 64 bits, whole numbers or floating-point ones; of several bands that
/// are no colours the first.
struct Tiff<'b> {
    decoder: Source<'b>,
    header: Header,
    kind: Kind,
}

/// What samples mean.
struct Kind {
    /// Bits of a sample.
    bits: u8,
    /// Samples of a pixel.
    each: usize,
    /// Those of them that make its colour.
    n_colours: usize,
    has_alpha: bool,
    /// Red, green and blue of each number, from 0 to 1.
    palette: Option<Vec<[f32; 3]>>,
    no_data: Option<f64>,
}

fn wrong(error: TiffError) -> Error {
    let why = format!("the image cannot be read: {error}; save it again as TIFF");
    Error::File { why }
}

/// Opens a TIFF image.
pub(super) fn open(bytes: &[u8]) -> Result<Box<dyn Image + '_>, Error> {
    let mut limits = Limits::default();
    limits.decoding_buffer_size = most_bytes(bytes.len());
    limits.intermediate_buffer_size = most_bytes(bytes.len());
    // The library reads no palettes: it is given the numbers of colours as if they were values.
    let as_grey = without_palette(bytes);
    let has_palette = as_grey.is_some();
    let source = as_grey.map_or(Cow::Borrowed(bytes), Cow::Owned);
    let mut decoder = Decoder::new(Cursor::new(source)).map_err(wrong)?.with_limits(limits);
    let (columns, rows) = decoder.dimensions().map_err(wrong)?;
    let colours = decoder.colortype().map_err(wrong)?;
    let place = place(&mut decoder)?;
    let no_data = decoder.get_tag_ascii_string(NO_DATA).ok();
    let no_data = no_data.and_then(|text| text.trim_matches(['\0', ' ']).parse::<f64>().ok());
    let palette = has_palette.then(|| palette(&mut decoder)).transpose().map_err(wrong)?;
    let bits = colours.bit_depth();
    let (each, n_colours, has_alpha) = match colours {
        ColorType::Gray(_) => (1, 1, false),
        ColorType::GrayA(_) => (2, 1, true),
        ColorType::RGB(_) => (3, 3, false),
        ColorType::RGBA(_) => (4, 3, true),
        ColorType::Multiband { num_samples, .. } => (usize::from(num_samples).max(1), 1, false),
        ColorType::CMYK(8) => (4, 4, false),
        other => {
            let why = format!("images of type {other:?} are not read; save it in grey or RGB");
            return Err(Error::File { why });
        }
    };
    let bits_each = (each * usize::from(bits)) as u64;
    let in_memory = (u64::from(columns) * u64::from(rows)).saturating_mul(bits_each) / 8;
    if in_memory > most_bytes(bytes.len()) as u64 {
        let why = format!("{columns} by {rows} pixels are too many; cut the image into tiles");
        return Err(Error::File { why });
    }
    // Whole numbers of up to two bytes are colours or grey, unless there are several that are none.
    let is_few = bits <= 16 && (each == 1 || n_colours > 1 || has_alpha);
    let n_bands = if has_palette { 3 } else { each - usize::from(has_alpha) };
    let header = Header { columns, rows, place, n_bands, is_colour: is_few || n_colours > 1 };
    let kind = Kind { bits, each, n_colours, has_alpha, palette, no_data };
    Ok(Box::new(Tiff { decoder, header, kind }))
}

impl Image for Tiff<'_> {
    fn header(&self) -> &Header {
        &self.header
    }

    fn decode(
        mut self: Box<Self>,
        wanted: Wanted<'_>,
        take: &mut dyn FnMut(u32, Values),
    ) -> Result<(), Error> {
        let Header { columns, rows, .. } = self.header;
        /// Tag 284: samples of a pixel one after the other, or one plane after the other.
        const PLANES: u16 = 2;
        let planes: Option<u16> =
            self.decoder.find_tag_unsigned(Tag::PlanarConfiguration).map_err(wrong)?;
        if planes == Some(PLANES) && self.kind.each > 1 {
            // The library reads the first plane, which is all of a band that is no colour.
            if self.kind.n_colours > 1 || !matches!(wanted, Wanted::Value | Wanted::Bands([0])) {
                let why = "its bands lie one after the other; save it with the samples of each pixel \
                           together, as gdal_translate -co INTERLEAVE=PIXEL does";
                return Err(Error::File { why: why.to_owned() });
            }
            (self.kind.each, self.kind.has_alpha) = (1, false);
        }
        if planes == Some(PLANES) || columns == 0 || rows == 0 {
            let samples = self.decoder.read_image().map_err(wrong)?;
            take(0, self.kind.values(samples, columns, rows, wanted));
            return Ok(());
        }
        // Strips are as wide as the image, tiles are not.
        let (width, height) = self.decoder.chunk_dimensions();
        if width == 0 || height == 0 {
            let why = "the image has tiles without pixels; save it again as TIFF";
            return Err(Error::File { why: why.to_owned() });
        }
        let across = columns.div_ceil(width);
        for (row, first) in (0..rows).step_by(height as usize).enumerate() {
            let n_rows = height.min(rows - first);
            let mut whole: Option<Values> = None;
            for column in 0..across {
                let chunk = row as u32 * across + column;
                let (wide, high) = self.decoder.chunk_data_dimensions(chunk);
                let samples = self.decoder.read_chunk(chunk).map_err(wrong)?;
                let values = self.kind.values(samples, wide, high, wanted);
                if across == 1 {
                    whole = Some(values);
                } else {
                    let n = columns as usize * n_rows as usize;
                    let whole = whole.get_or_insert_with(|| values.blank(n));
                    let from = (column * width) as usize;
                    whole.paste(&values, columns as usize, from, wide as usize);
                }
            }
            whole.into_iter().for_each(|values| take(first, values));
        }
        Ok(())
    }
}

impl Kind {
    /// The values of so many pixels.
    fn values(
        &self,
        samples: DecodingResult,
        columns: u32,
        rows: u32,
        wanted: Wanted<'_>,
    ) -> Values {
        let Self { bits, each, n_colours, has_alpha, .. } = *self;
        let samples = match samples {
            DecodingResult::U8(samples) if bits < 8 => {
                DecodingResult::U8(unpacked(&samples, bits, columns as usize * each, rows as usize))
            }
            samples => samples,
        };
        if !matches!(wanted, Wanted::Value) {
            return self.triples(samples, wanted);
        }
        // Transparency by its greatest value; that of floating-point samples is 1.
        let alpha = |greatest: f64| has_alpha.then_some(greatest);
        let values = match samples {
            DecodingResult::U8(samples) => match &self.palette {
                Some(palette) => {
                    let light = |rgb: &[f32; 3]| brightness(rgb.map(|v| f64::from(v) * 65_535.0));
                    // No data is a number of a colour.
                    let has_data = |k: u8| self.no_data != Some(f64::from(k));
                    let colour = |&k: &u8| {
                        let rgb = palette.get(usize::from(k)).filter(|_| has_data(k));
                        rgb.map_or(f32::NAN, |rgb| light(rgb) as f32)
                    };
                    return Values::Numbers(samples.iter().map(colour).collect());
                }
                None if n_colours == 4 => Values::Numbers(
                    samples
                        .chunks_exact(4)
                        .map(|cmyk| uninked([cmyk[0], cmyk[1], cmyk[2], cmyk[3]]))
                        .collect(),
                ),
                None if each == 1 => Values::Bytes(samples),
                None => flattened(&samples, each, n_colours, alpha(255.0)),
            },
            DecodingResult::U16(samples) if each == 1 => Values::Words(samples),
            DecodingResult::U16(samples) => flattened(&samples, each, n_colours, alpha(65_535.0)),
            DecodingResult::U32(samples) => {
                let opaque = alpha(f64::from(u32::MAX));
                doubles(samples.chunks_exact(each), n_colours, opaque, f64::from)
            }
            DecodingResult::I8(samples) => flattened(&samples, each, n_colours, alpha(127.0)),
            DecodingResult::I16(samples) => flattened(&samples, each, n_colours, alpha(32_767.0)),
            DecodingResult::I32(samples) => {
                let opaque = alpha(f64::from(i32::MAX));
                doubles(samples.chunks_exact(each), n_colours, opaque, f64::from)
            }
            DecodingResult::U64(samples) => {
                let opaque = alpha(u64::MAX as f64);
                doubles(samples.chunks_exact(each), n_colours, opaque, |v| v as f64)
            }
            DecodingResult::I64(samples) => {
                let opaque = alpha(i64::MAX as f64);
                doubles(samples.chunks_exact(each), n_colours, opaque, |v| v as f64)
            }
            DecodingResult::F16(samples) => {
                let samples: Vec<f32> = samples.into_iter().map(f32::from).collect();
                flattened(&samples, each, n_colours, alpha(1.0))
            }
            DecodingResult::F32(samples) => flattened(&samples, each, n_colours, alpha(1.0)),
            DecodingResult::F64(samples) => {
                doubles(samples.chunks_exact(each), n_colours, alpha(1.0), |v| v)
            }
        };
        without(values, self.no_data)
    }

    /// The colours, or some bands, of pixels.
    fn triples(&self, samples: DecodingResult, wanted: Wanted<'_>) -> Values {
        let Self { bits, each, n_colours, has_alpha, no_data, .. } = *self;
        let (mut numbers, greatest) = numbers(samples, bits);
        if let Some(no_data) = no_data {
            numbers
                .iter_mut()
                .filter(|number| **number == no_data as f32)
                .for_each(|number| *number = f32::NAN);
        }
        let of_palette = |&number: &f32| {
            let palette = self.palette.as_deref().unwrap_or_default();
            palette.get(number as usize).copied().unwrap_or([f32::NAN; 3])
        };
        match wanted {
            _ if self.palette.is_none() => match wanted {
                Wanted::Bands(bands) => banded(&numbers, each, bands),
                _ => coloured(&numbers, each, n_colours, has_alpha, greatest),
            },
            Wanted::Bands(bands) => {
                let colours: Vec<f32> = numbers.iter().flat_map(of_palette).collect();
                banded(&colours, 3, bands)
            }
            _ => Values::Triples(numbers.iter().map(of_palette).collect()),
        }
    }
}

/// Samples as numbers, and the greatest that whole ones can be.
fn numbers(samples: DecodingResult, bits: u8) -> (Vec<f32>, f32) {
    fn of<T: Copy>(samples: &[T], number: impl Fn(T) -> f32) -> Vec<f32> {
        samples.iter().map(|&sample| number(sample)).collect()
    }
    match samples {
        DecodingResult::U8(s) => {
            (of(&s, f32::from), if bits < 8 { ((1_u16 << bits) - 1).into() } else { 255.0 })
        }
        DecodingResult::U16(s) => (of(&s, f32::from), 65_535.0),
        DecodingResult::U32(s) => (of(&s, |v| v as f32), u32::MAX as f32),
        DecodingResult::U64(s) => (of(&s, |v| v as f32), u64::MAX as f32),
        DecodingResult::I8(s) => (of(&s, f32::from), 127.0),
        DecodingResult::I16(s) => (of(&s, f32::from), 32_767.0),
        DecodingResult::I32(s) => (of(&s, |v| v as f32), i32::MAX as f32),
        DecodingResult::I64(s) => (of(&s, |v| v as f32), i64::MAX as f32),
        DecodingResult::F16(s) => (of(&s, f32::from), 1.0),
        DecodingResult::F32(s) => (s, 1.0),
        DecodingResult::F64(s) => (of(&s, |v| v as f32), 1.0),
    }
}

impl Values {
    /// So many values of the same kind.
    fn blank(&self, n: usize) -> Self {
        match self {
            Self::Bytes(_) => Self::Bytes(vec![0; n]),
            Self::Words(_) => Self::Words(vec![0; n]),
            Self::Numbers(_) => Self::Numbers(vec![0.0; n]),
            Self::Doubles(_) => Self::Doubles(vec![0.0; n]),
            Self::Triples(_) => Self::Triples(vec![[0.0; 3]; n]),
        }
    }

    /// Takes over the rows of a tile, which starts at a column and is so wide.
    fn paste(&mut self, tile: &Self, columns: usize, from: usize, width: usize) {
        fn of<T: Copy>(whole: &mut [T], tile: &[T], columns: usize, from: usize, width: usize) {
            let rows = whole.chunks_exact_mut(columns).zip(tile.chunks_exact(width.max(1)));
            rows.for_each(|(row, tile)| row[from..from + width].copy_from_slice(tile));
        }
        match (self, tile) {
            (Self::Bytes(whole), Self::Bytes(tile)) => of(whole, tile, columns, from, width),
            (Self::Words(whole), Self::Words(tile)) => of(whole, tile, columns, from, width),
            (Self::Numbers(whole), Self::Numbers(tile)) => of(whole, tile, columns, from, width),
            (Self::Doubles(whole), Self::Doubles(tile)) => of(whole, tile, columns, from, width),
            (Self::Triples(whole), Self::Triples(tile)) => of(whole, tile, columns, from, width),
            _ => {}
        }
    }
}

/// The first value of each pixel, or its brightness, in double precision.
fn doubles<'a, T: Copy + 'a>(
    pixels: impl Iterator<Item = &'a [T]>,
    colours: usize,
    opaque: Option<f64>,
    number: impl Fn(T) -> f64,
) -> Values {
    let hidden = |pixel: &[T]| {
        let last = pixel.last().map(|&last| number(last));
        opaque.zip(last).is_some_and(|(opaque, last)| last < 0.5 * opaque)
    };
    let value = |pixel: &[T]| match colours {
        _ if hidden(pixel) => f64::NAN,
        3 => brightness([number(pixel[0]), number(pixel[1]), number(pixel[2])]),
        _ => number(pixel[0]),
    };
    Values::Doubles(pixels.map(value).collect())
}

/// The brightness of paper with these four inks.
fn uninked([cyan, magenta, yellow, black]: [u8; 4]) -> f32 {
    let light = |ink: u8| f64::from(255 - ink) * f64::from(255 - black) / 255.0;
    brightness([light(cyan), light(magenta), light(yellow)]) as f32
}

/// Samples of fewer than eight bits, a byte each; rows start at bytes.
fn unpacked(packed: &[u8], bits: u8, each_row: usize, rows: usize) -> Vec<u8> {
    let row_bytes = (each_row * usize::from(bits)).div_ceil(8);
    if packed.len() == each_row * rows || row_bytes * rows != packed.len() {
        // A byte each already, or nothing that is known.
        return packed.to_vec();
    }
    let in_byte = usize::from(8 / bits);
    let sample = |row: &[u8], k: usize| {
        let shift = usize::from(bits) * (in_byte - 1 - k % in_byte);
        row[k / in_byte] >> shift & ((1 << bits) - 1)
    };
    packed
        .chunks_exact(row_bytes.max(1))
        .flat_map(|row| (0..each_row).map(move |k| sample(row, k)))
        .collect()
}

/// The values, with those for no data not a number.
fn without(values: Values, no_data: Option<f64>) -> Values {
    let Some(no_data) = no_data.filter(|no_data| !no_data.is_nan()) else { return values };
    let kept = |value: f64| if value == no_data { f32::NAN } else { value as f32 };
    match values {
        Values::Bytes(values) => {
            Values::Numbers(values.into_iter().map(|v| kept(v.into())).collect())
        }
        Values::Words(values) => {
            Values::Numbers(values.into_iter().map(|v| kept(v.into())).collect())
        }
        Values::Numbers(values) => {
            // What was written in double precision was rounded as the values were.
            let is_no_data = |v: f32| v == no_data as f32;
            Values::Numbers(
                values.into_iter().map(|v| if is_no_data(v) { f32::NAN } else { v }).collect(),
            )
        }
        Values::Doubles(values) => Values::Doubles(
            values.into_iter().map(|v| if v == no_data { f64::NAN } else { v }).collect(),
        ),
        triples @ Values::Triples(_) => triples,
    }
}

/// The file with values instead of a palette, if its first image has one: tag 262 says what samples mean, 3
/// that they are numbers of colours, 1 that they are values from black on.
fn without_palette(bytes: &[u8]) -> Option<Vec<u8>> {
    let is_little = bytes.starts_with(b"II");
    let number = |at: usize, n: usize| -> Option<usize> {
        let bytes = bytes.get(at..at.checked_add(n)?)?;
        let digits = |sum: u64, &byte: &u8| sum << 8 | u64::from(byte);
        let value = if is_little {
            bytes.iter().rev().fold(0, digits)
        } else {
            bytes.iter().fold(0, digits)
        };
        usize::try_from(value).ok()
    };
    // Both kinds of the format: with places in the file of four bytes, and of eight.
    let (directory, count, entry, value) = match number(2, 2)? {
        42 => (number(4, 4)?, 2, 12, 8),
        43 => (number(8, 8)?, 8, 20, 12),
        _ => return None,
    };
    let first = directory.checked_add(count)?;
    let places =
        (0..number(directory, count)?).map_while(|k| first.checked_add(k.checked_mul(entry)?));
    let place =
        places.take_while(|&at| at < bytes.len()).find(|&at| number(at, 2) == Some(262))? + value;
    if number(place, 2)? != 3 {
        return None;
    }
    let mut grey = bytes.to_vec();
    let one = if is_little { 1_u16.to_le_bytes() } else { 1_u16.to_be_bytes() };
    grey[place..place + 2].copy_from_slice(&one);
    Some(grey)
}

/// The colours of a palette, from 0 to 1.
fn palette(decoder: &mut Source<'_>) -> Result<Vec<[f32; 3]>, TiffError> {
    let map = decoder.get_tag_u16_vec(Tag::ColorMap)?;
    let n = map.len() / 3;
    let colour = |k: usize| [map[k], map[n + k], map[2 * n + k]].map(|v| f32::from(v) / 65_535.0);
    Ok((0..n).map(colour).collect())
}

/// Where the image lies, if it says so.
fn place(decoder: &mut Source<'_>) -> Result<Option<Place>, Error> {
    let numbers = |decoder: &mut Source<'_>, tag| decoder.get_tag_f64_vec(tag).ok();
    let keys = decoder.get_tag_u16_vec(GEO_KEYS).unwrap_or_default();
    // Four numbers a key, behind four of the directory: key, where its value is, how many, value.
    let key = |wanted: u16| {
        let mut keys = keys.chunks_exact(4).skip(1);
        keys.find(|key| key[0] == wanted && key[1] == 0).map(|key| key[3])
    };
    let (origin, cell) = if let Some(matrix) = numbers(decoder, TRANSFORMATION) {
        let [a, b, _, d, e, f, _, h] = matrix[..].first_chunk::<8>().copied().unwrap_or_default();
        if b != 0.0 || e != 0.0 {
            let why = "the image is turned or sheared in its coordinate system; warp it first, as with gdalwarp";
            return Err(Error::File { why: why.to_owned() });
        }
        (Point::new(d, h), [a, f])
    } else {
        let scale = numbers(decoder, PIXEL_SCALE);
        let tie = numbers(decoder, TIE_POINTS);
        let (Some([width, height, ..]), Some([i, j, _, x, y, ..])) =
            (scale.as_deref(), tie.as_deref())
        else {
            return Ok(None);
        };
        // Rows go down.
        (Point::new(x - i * width, y + j * height), [*width, -height])
    };
    // The numbers are those of the centre of the first pixel.
    let is_point = key(RASTER_KEY) == Some(2);
    let shift = if is_point { 0.5 } else { 0.0 };
    let origin = Point::new(origin.x - shift * cell[0], origin.y - shift * cell[1]);
    let code = key(PROJECTED_KEY).or_else(|| key(GEOGRAPHIC_KEY));
    let code = code.filter(|&code| code != 0 && code != USER_DEFINED);
    Ok(Some(Place { origin, cell, crs: code.map(|code| Crs::epsg(u32::from(code))) }))
}
