use super::{Picture, Values, flattened, most_bytes};
use crate::Error;
use png::{BitDepth, ColorType, Decoder, Limits, Transformations};
use std::io::Cursor;

/// Reads a PNG image: grey or coloured, with or without a palette and transparency, 1 to 16 bits.
pub(super) fn read(bytes: &[u8]) -> Result<Picture, Error> {
    let wrong = |error: png::DecodingError| {
        let why = format!("the image cannot be read: {error}; save it again as PNG");
        Error::File { why }
    };
    let most = most_bytes(bytes.len());
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), Limits { bytes: most });
    // Palettes become colours, fewer bits become eight, and what is transparent gets a sample.
    decoder.set_transformations(Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(wrong)?;
    let (columns, rows) = (reader.info().width, reader.info().height);
    let size = reader.output_buffer_size().filter(|&size| size <= most);
    let size = size.ok_or_else(|| {
        let why = format!("{columns} by {rows} pixels are too many; cut the image into tiles");
        Error::File { why }
    })?;
    let mut samples = vec![0; size];
    let frame = reader.next_frame(&mut samples).map_err(wrong)?;
    let (each, colours, has_alpha) = match frame.color_type {
        ColorType::Grayscale | ColorType::Indexed => (1, 1, false),
        ColorType::GrayscaleAlpha => (2, 1, true),
        ColorType::Rgb => (3, 3, false),
        ColorType::Rgba => (4, 3, true),
    };
    samples.truncate(frame.buffer_size());
    let values = if frame.bit_depth == BitDepth::Sixteen {
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
    };
    Ok(Picture { columns, rows, values, place: None })
}
