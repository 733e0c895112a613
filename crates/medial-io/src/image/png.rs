use super::{Header, Image, Values, flattened, most_bytes};
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
    let header = Header { columns, rows, place: None };
    Ok(Box::new(Png { reader, header }))
}

impl Image for Png<'_> {
    fn header(&self) -> &Header {
        &self.header
    }

    fn decode(self: Box<Self>, take: &mut dyn FnMut(u32, Values)) -> Result<(), Error> {
        let mut reader = self.reader;
        let kind = reader.output_color_type();
        if reader.info().interlaced {
            // Its rows are not there before all of it is.
            let size = reader.output_buffer_size().unwrap_or_default();
            let mut samples = vec![0; size];
            let frame = reader.next_frame(&mut samples).map_err(|error| wrong(&error))?;
            samples.truncate(frame.buffer_size());
            take(0, values(samples, kind));
            return Ok(());
        }
        for row in 0..self.header.rows {
            let Some(samples) = reader.next_row().map_err(|error| wrong(&error))? else { break };
            take(row, values(samples.data().to_vec(), kind));
        }
        // What comes behind the pixels may be damaged, too.
        reader.finish().map_err(|error| wrong(&error))
    }
}

/// The values of pixels.
fn values(samples: Vec<u8>, (color, depth): (ColorType, BitDepth)) -> Values {
    let (each, colours, has_alpha) = match color {
        ColorType::Grayscale | ColorType::Indexed => (1, 1, false),
        ColorType::GrayscaleAlpha => (2, 1, true),
        ColorType::Rgb => (3, 3, false),
        ColorType::Rgba => (4, 3, true),
    };
    if depth == BitDepth::Sixteen {
        let pairs = samples.chunks_exact(2);
        let words: Vec<u16> = pairs.map(|pair| u16::from_be_bytes([pair[0], pair[1]])).collect();
        if each == 1 {
            Values::Words(words)
        } else {
            flattened(&words, each, colours, has_alpha.then_some(65_535.0))
        }
    } else if each == 1 {
        Values::Bytes(samples)
    } else {
        flattened(&samples, each, colours, has_alpha.then_some(255.0))
    }
}
