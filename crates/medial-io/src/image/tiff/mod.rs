mod place;
mod samples;

pub(super) use place::{Georeference, georeference};

use super::{Header, Image, Values, Wanted, most_bytes};
use crate::Error;
use samples::Kind;
use std::borrow::Cow;
use std::io::Cursor;
use tiff::decoder::{Decoder, Limits};
use tiff::tags::Tag;
use tiff::{ColorType, TiffError};

/// The tag of GDAL for the value of no data.
pub(super) const NO_DATA: Tag = Tag::Unknown(42113);

/// What samples are [TIFF 6.0, tag 262]: values from black on, colours, numbers of a palette, inks, or a
/// brightness and two differences.
const BLACK: u16 = 1;
const RGB: u16 = 2;
const PALETTE: u16 = 3;
const INKS: u16 = 5;
const YCBCR: u16 = 6;

/// How samples are stored [TIFF 6.0, tag 339].
const UNSIGNED: u16 = 1;
const SIGNED: u16 = 2;
const FLOATING: u16 = 3;

/// Colours of floating point go up to 1, and beyond that by what resampling and lamps add. Those of an image
/// that go further are something else, such as bytes.
const MOST_OF_COLOUR: f32 = 2.0;

/// Tag 338: a sample beside the colour says how opaque a pixel is, and its colour is multiplied with that or not.
const OPAQUE: [u16; 2] = [1, 2];

type Source<'a> = Decoder<Cursor<Cow<'a, [u8]>>>;

/// The first image of a TIFF file: 1 to 64 bits, whole numbers or floating-point ones; of several bands that
/// are no colours the first.
struct Tiff<'b> {
    decoder: Source<'b>,
    header: Header,
    kind: Kind,
}

fn wrong(error: TiffError) -> Error {
    let way = match error {
        // What samples are, not how they are stored.
        TiffError::UnsupportedError(_) => {
            "save it in grey or RGB, of whole or floating-point numbers"
        }
        _ => "save it anew, as gdal_translate -co COMPRESS=DEFLATE does",
    };
    Error::File { why: format!("the image cannot be read: {error}; {way}") }
}

/// Opens a TIFF image.
pub(super) fn open(bytes: &[u8]) -> Result<Box<dyn Image + '_>, Error> {
    let mut limits = Limits::default();
    limits.decoding_buffer_size = most_bytes(bytes.len());
    limits.intermediate_buffer_size = most_bytes(bytes.len());
    let source = |bytes| {
        let decoder = Decoder::new(Cursor::new(bytes)).map_err(wrong)?;
        Ok::<Source<'_>, Error>(decoder.with_limits(limits.clone()))
    };
    let mut decoder = source(Cow::Borrowed(bytes))?;
    let (columns, rows) = decoder.dimensions().map_err(wrong)?;
    known(&mut decoder)?;
    let meaning: Option<u16> =
        decoder.find_tag_unsigned(Tag::PhotometricInterpretation).map_err(wrong)?;
    let meaning = meaning.unwrap_or(BLACK);
    let each: Option<usize> = decoder.find_tag_unsigned(Tag::SamplesPerPixel).map_err(wrong)?;
    let each = each.unwrap_or(1);
    // The library reads no palettes, and leaves out what lies beside a colour: it is given the samples as if they
    // were values.
    let is_whole = decoder.colortype().is_ok_and(|colours| samples_of(colours) == each);
    let has_more = n_colours(meaning) > 1 && each >= n_colours(meaning) && !is_whole;
    if (meaning == PALETTE || has_more)
        && let Some(values) = as_values(bytes)
    {
        decoder = source(Cow::Owned(values))?;
    }
    let colours = decoder.colortype().map_err(wrong)?;
    if samples_of(colours) != each {
        let why = format!("images of type {colours:?} are not read; save it in grey or RGB");
        return Err(Error::File { why });
    }
    let bits = colours.bit_depth();
    let beside: Option<Vec<u16>> =
        decoder.find_tag_unsigned_vec(Tag::ExtraSamples).map_err(wrong)?;
    let n_colours = n_colours(meaning);
    let alpha = match beside {
        Some(beside) => {
            let first = each.saturating_sub(beside.len());
            let place = beside.iter().position(|kind| OPAQUE.contains(kind));
            place.map(|place| first + place).filter(|&alpha| alpha >= n_colours)
        }
        None => (meaning == RGB && each == 4).then_some(3),
    };
    let (place, warnings) = place::place(&mut decoder)?;
    let no_data = decoder.get_tag_ascii_string(NO_DATA).ok();
    let no_data = no_data.and_then(|text| text.trim_matches(['\0', ' ']).parse::<f64>().ok());
    let palette = (meaning == PALETTE).then(|| palette(&mut decoder)).transpose().map_err(wrong)?;
    let bits_each = (each * usize::from(bits)) as u64;
    let in_memory = (u64::from(columns) * u64::from(rows)).saturating_mul(bits_each) / 8;
    if in_memory > most_bytes(bytes.len()) as u64 {
        let why = format!("{columns} by {rows} pixels are too many; cut the image into tiles");
        return Err(Error::File { why });
    }
    // Whole numbers of up to two bytes are grey, unless there are several: heights, temperatures or logarithms,
    // below 0 or of floating point, have no range that is black to white.
    let format: Option<Vec<u16>> =
        decoder.find_tag_unsigned_vec(Tag::SampleFormat).map_err(wrong)?;
    let format = format.and_then(|formats| formats.first().copied()).unwrap_or(UNSIGNED);
    let is_grey = format == UNSIGNED && bits <= 16 && each - usize::from(alpha.is_some()) == 1;
    let is_colour = is_grey || n_colours > 1 && format != SIGNED || palette.is_some();
    let n_bands = match palette {
        Some(_) => 3,
        None => each - usize::from(alpha == Some(each - 1)),
    };
    let is_wide = bits == 16 && format == UNSIGNED;
    let header = Header { columns, rows, place, n_bands, alpha, is_colour, is_wide, warnings };
    let is_ycbcr = meaning == YCBCR;
    let is_floating = format == FLOATING;
    let kind =
        Kind { bits, each, n_colours, alpha, is_colour, is_ycbcr, is_floating, palette, no_data };
    Ok(Box::new(Tiff { decoder, header, kind }))
}

/// Fails if the image is compressed in a way that is not read.
fn known(decoder: &mut Source<'_>) -> Result<(), Error> {
    // Tag 259, as TIFF 6.0 and the registry of the library libtiff number them.
    let method: Option<u32> = decoder.find_tag_unsigned(Tag::Compression).map_err(wrong)?;
    let name = match method.unwrap_or(1) {
        1 | 4 | 5 | 7 | 8 | 32_773 | 32_946 => return Ok(()),
        2 => "CCITT RLE",
        3 => "CCITT Group 3",
        6 => "JPEG of its first kind",
        34_661 => "JBIG",
        34_712 => "JPEG 2000",
        34_887 => "LERC",
        34_925 => "LZMA",
        50_000 => "ZSTD",
        50_001 => "WebP",
        50_002 | 52_546 => "JPEG XL",
        _ => "of a kind that is not known",
    };
    let number = method.unwrap_or_default();
    let why = format!(
        "its compression is {name} ({number}), which is not read; save it with another one, as \
         gdal_translate -co COMPRESS=DEFLATE does"
    );
    Err(Error::File { why })
}

/// Fails if values are too great for colours.
fn bounded(values: &Values) -> Result<(), Error> {
    let Values::Triples(triples) = values else { return Ok(()) };
    let found = triples.iter().flatten().copied().find(|&value| value > MOST_OF_COLOUR);
    found.map_or(Ok(()), |value| {
        let why = format!(
            "its colours have floating-point numbers such as {value}, where 1 is the greatest; look at them as \
             bands (--bands 1,2,3), or save it as bytes, as gdal_translate -ot Byte -scale does"
        );
        Err(Error::File { why })
    })
}

/// Samples that make a colour.
fn n_colours(meaning: u16) -> usize {
    match meaning {
        RGB | YCBCR => 3,
        INKS => 4,
        _ => 1,
    }
}

/// Samples that the library gives of a pixel; none of what is not understood.
fn samples_of(colours: ColorType) -> usize {
    match colours {
        ColorType::Gray(_) => 1,
        ColorType::RGB(_) | ColorType::YCbCr(_) => 3,
        ColorType::RGBA(_) | ColorType::CMYK(_) => 4,
        ColorType::CMYKA(_) => 5,
        ColorType::Multiband { num_samples, .. } => usize::from(num_samples),
        _ => 0,
    }
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
        if columns == 0 || rows == 0 {
            return Ok(());
        }
        // Strips are as wide as the image, tiles are not.
        let (width, height) = self.decoder.chunk_dimensions();
        if width == 0 || height == 0 {
            let why = "the image has tiles without pixels; save it anew, in strips";
            return Err(Error::File { why: why.to_owned() });
        }
        let (across, down) = (columns.div_ceil(width), rows.div_ceil(height));
        let has_planes = planes == Some(PLANES) && self.kind.each > 1;
        let needed = self.kind.needed(wanted);
        for (row, first) in (0..rows).step_by(height as usize).enumerate() {
            let n_rows = height.min(rows - first);
            let mut whole: Option<Values> = None;
            for column in 0..across {
                let chunk = row as u32 * across + column;
                let (wide, high) = self.decoder.chunk_data_dimensions(chunk);
                let values = if has_planes {
                    let mut planes = Vec::new();
                    for &plane in &needed {
                        let before = (plane as u32).saturating_mul(across.saturating_mul(down));
                        let chunk = before.saturating_add(chunk);
                        planes.push((plane, self.decoder.read_chunk(chunk).map_err(wrong)?));
                    }
                    let size = [wide as usize, high as usize];
                    self.kind.values_of_planes(planes, size, wanted)
                } else {
                    let samples = self.decoder.read_chunk(chunk).map_err(wrong)?;
                    self.kind.values(samples, wide as usize, wanted)
                };
                if across == 1 {
                    whole = Some(values);
                } else {
                    let n = columns as usize * n_rows as usize;
                    let whole = whole.get_or_insert_with(|| values.blank(n));
                    let from = (column * width) as usize;
                    whole.paste(&values, columns as usize, from, wide as usize);
                }
            }
            let Some(values) = whole else { continue };
            if self.kind.is_floating && matches!(wanted, Wanted::Colour) {
                bounded(&values)?;
            }
            take(first, values);
        }
        Ok(())
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

/// The file with values from black on instead of what tag 262 says that the samples of its first image are.
fn as_values(bytes: &[u8]) -> Option<Vec<u8>> {
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
    number(place, 2)?;
    let mut values = bytes.to_vec();
    let black = if is_little { BLACK.to_le_bytes() } else { BLACK.to_be_bytes() };
    values[place..place + 2].copy_from_slice(&black);
    Some(values)
}

/// The colours of a palette, from 0 to 1.
fn palette(decoder: &mut Source<'_>) -> Result<Vec<[f32; 3]>, TiffError> {
    let map = decoder.get_tag_u16_vec(Tag::ColorMap)?;
    let n = map.len() / 3;
    let colour = |k: usize| [map[k], map[n + k], map[2 * n + k]].map(|v| f32::from(v) / 65_535.0);
    Ok((0..n).map(colour).collect())
}

#[cfg(test)]
mod tests;
