use super::{Header, Image, Values, Wanted, banded, coloured, flattened, most_bytes};
use crate::Error;
use png::{BitDepth, ColorType, Decoder, DecodingError, Limits, Reader, Transformations};
use std::io::Cursor;

/// A PNG image: grey or coloured, with or without a palette and transparency, 1 to 16 bits.
struct Png<'b> {
    reader: Reader<Cursor<&'b [u8]>>,
    header: Header,
}

fn wrong(error: &DecodingError) -> Error {
    let why = format!("the image cannot be read: {error}; save it again as PNG");
    Error::File { why }
}

/// Opens a PNG image.
pub(super) fn open(bytes: &[u8]) -> Result<Box<dyn Image + '_>, Error> {
    let most = most_bytes(bytes.len());
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), Limits { bytes: most });
    // Palettes become colours, fewer bits become eight, and what is transparent gets a sample.
    decoder.set_transformations(Transformations::EXPAND);
    let reader = decoder.read_info().map_err(|error| wrong(&error))?;
    let (columns, rows) = (reader.info().width, reader.info().height);
    if reader.output_buffer_size().is_none_or(|size| size > most) {
        let why = format!("{columns} by {rows} pixels are too many; cut the image into tiles");
        return Err(Error::File { why });
    }
    let (color, depth) = reader.output_color_type();
    let (each, _, has_alpha) = samples_of(color);
    let header = Header {
        columns,
        rows,
        place: None,
        n_bands: each - usize::from(has_alpha),
        alpha: None,
        is_colour: true,
        is_wide: depth == BitDepth::Sixteen,
        warnings: Vec::new(),
    };
    Ok(Box::new(Png { reader, header }))
}

impl Image for Png<'_> {
    fn header(&self) -> &Header {
        &self.header
    }

    fn decode(
        self: Box<Self>,
        wanted: Wanted<'_>,
        take: &mut dyn FnMut(u32, Values),
    ) -> Result<(), Error> {
        let mut reader = self.reader;
        let kind = reader.output_color_type();
        if reader.info().interlaced {
            // Its rows are not there before all of it is.
            let size = reader.output_buffer_size().unwrap_or_default();
            let mut samples = vec![0; size];
            let frame = reader.next_frame(&mut samples).map_err(|error| wrong(&error))?;
            samples.truncate(frame.buffer_size());
            take(0, values(samples, kind, wanted));
            return Ok(());
        }
        for row in 0..self.header.rows {
            let Some(samples) = reader.next_row().map_err(|error| wrong(&error))? else { break };
            take(row, values(samples.data().to_vec(), kind, wanted));
        }
        // What comes behind the pixels may be damaged, too.
        reader.finish().map_err(|error| wrong(&error))
    }
}

/// Samples of a pixel, those of its colour, and whether the last one is how opaque it is.
fn samples_of(color: ColorType) -> (usize, usize, bool) {
    match color {
        ColorType::Grayscale | ColorType::Indexed => (1, 1, false),
        ColorType::GrayscaleAlpha => (2, 1, true),
        ColorType::Rgb => (3, 3, false),
        ColorType::Rgba => (4, 3, true),
    }
}

/// The values of pixels.
fn values(samples: Vec<u8>, (color, depth): (ColorType, BitDepth), wanted: Wanted<'_>) -> Values {
    let (each, colours, has_alpha) = samples_of(color);
    let is_wide = depth == BitDepth::Sixteen;
    let words = || {
        samples
            .chunks_exact(2)
            .map(|pair| u16::from_be_bytes([pair[0], pair[1]]))
            .collect::<Vec<_>>()
    };
    let numbers = || match is_wide {
        true => words().into_iter().map(f32::from).collect::<Vec<_>>(),
        false => samples.iter().copied().map(f32::from).collect(),
    };
    let greatest = if is_wide { 65_535.0 } else { 255.0 };
    match wanted {
        Wanted::Colour => coloured(&numbers(), each, colours, has_alpha, greatest),
        Wanted::Bands(bands) => banded(&numbers(), each, bands, has_alpha, greatest),
        Wanted::Value if is_wide && each == 1 => Values::Words(words()),
        Wanted::Value if is_wide => {
            flattened(&words(), each, colours, has_alpha.then_some(65_535.0))
        }
        Wanted::Value if each == 1 => Values::Bytes(samples),
        Wanted::Value => flattened(&samples, each, colours, has_alpha.then_some(255.0)),
    }
}
