//! Masks as images.

use medial::raster::Mask;
use png::{BitDepth, ColorType, Compression, DeflateCompression, Encoder, Filter};

/// Filters of rows that are tried: which is best depends on the image.
const FILTERS: [Filter; 3] = [Filter::NoFilter, Filter::Up, Filter::Adaptive];

/// Deflate, as hard as it tries.
const HARDEST: u8 = 9;

/// The mask as a PNG image of one bit a pixel, in as few bytes as PNG allows: white for cells of the shape,
/// black for others. Where it lies in the plane is not told.
///
/// ```
/// use medial::raster::{Grid, Mask};
/// use medial_io::{Format, ReadOptions, image};
/// let mask = Mask::new(Grid::of_image(20, 10), |x, y| x > y)?;
/// let bytes = image::write_png(&mask);
/// assert_eq!(image::read_mask(Format::Png, &bytes, &ReadOptions::default())?.0, mask);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn write_png(mask: &Mask) -> Vec<u8> {
    // PNG has no image without pixels.
    let (columns, rows) = (mask.grid().columns.max(1), mask.grid().rows.max(1));
    let stride = (columns as usize).div_ceil(8);
    let mut samples = vec![0_u8; stride * rows as usize];
    for y in 0..mask.grid().rows {
        let row = samples[y as usize * stride..].iter_mut().zip(mask.row(y));
        row.for_each(|(to, from)| *to = from.reverse_bits());
    }
    let written = FILTERS.into_iter().filter_map(|filter| {
        let mut bytes = Vec::new();
        let mut encoder = Encoder::new(&mut bytes, columns, rows);
        encoder.set_color(ColorType::Grayscale);
        encoder.set_depth(BitDepth::One);
        encoder.set_compression(Compression::High);
        encoder.set_deflate_compression(DeflateCompression::Level(HARDEST));
        encoder.set_filter(filter);
        // Writing to memory does not fail.
        let mut writer = encoder.write_header().ok()?;
        writer.write_image_data(&samples).ok()?;
        writer.finish().ok()?;
        Some(bytes)
    });
    written.min_by_key(Vec::len).unwrap_or_default()
}
