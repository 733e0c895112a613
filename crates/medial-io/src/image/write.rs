//! Masks, colours and labels as images.

use super::tiff::{Georeference, NO_DATA, georeference};
use crate::Crs;
use ::tiff::encoder::{Compression as TiffCompression, TiffEncoder, colortype};
use medial::raster::{Grid, Mask};
use png::{BitDepth, ColorType, Compression, DeflateCompression, Encoder, Filter};
use std::io::Cursor;

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

/// Colours, row by row, each of red, green and blue from 0 to 1, as a PNG image; what is not a number is
/// transparent.
///
/// # Panics
/// If there are not so many.
#[must_use]
pub fn write_colours(columns: u32, rows: u32, colours: &[[f32; 3]]) -> Vec<u8> {
    assert_eq!(
        colours.len() as u64,
        u64::from(columns) * u64::from(rows),
        "a colour for each pixel"
    );
    // PNG has no image without pixels.
    let pixels = (columns.max(1) as usize) * (rows.max(1) as usize);
    let byte = |value: f32| (255.0 * value.clamp(0.0, 1.0)).round() as u8;
    let pixel = |colour: &[f32; 3]| match colour.iter().any(|value| value.is_nan()) {
        true => [0; 4],
        false => [byte(colour[0]), byte(colour[1]), byte(colour[2]), 255],
    };
    let mut samples: Vec<u8> = colours.iter().flat_map(pixel).collect();
    samples.resize(4 * pixels, 0);
    let mut bytes = Vec::new();
    let mut encoder = Encoder::new(&mut bytes, columns.max(1), rows.max(1));
    encoder.set_color(ColorType::Rgba);
    encoder.set_depth(BitDepth::Eight);
    // Writing to memory does not fail.
    if let Ok(mut writer) = encoder.write_header() {
        let _ = writer.write_image_data(&samples).and_then(|()| writer.finish());
    }
    bytes
}

/// Numbers of pixels, row by row, as a TIFF image of 32 bits a pixel, with one that stands for no data. It lies where the
/// grid does: with all that another GeoTIFF of these pixels says, whose file is `like`, else with the code of the reference
/// system, if it has one.
///
/// # Panics
/// If there are not so many, or none.
#[must_use]
pub fn write_labels(
    grid: &Grid,
    crs: Option<&Crs>,
    labels: &[u32],
    no_data: u32,
    like: &[u8],
) -> Vec<u8> {
    let Grid { columns, rows, .. } = *grid;
    assert_eq!(labels.len() as u64, grid.n_cells(), "a label for each pixel");
    let mut bytes = Cursor::new(Vec::new());
    // Writing to memory does not fail.
    let _ = TiffEncoder::new(&mut bytes).and_then(|encoder| {
        let mut encoder = encoder.with_compression(TiffCompression::Lzw);
        let mut image = encoder.new_image::<colortype::Gray32>(columns, rows)?;
        let told = georeference(like);
        let is_placed = *grid != Grid::of_image(columns, rows);
        let of_grid = || Georeference::of(grid, crs);
        let Georeference { doubles, keys, text } =
            if told.doubles.is_empty() && is_placed { of_grid() } else { told };
        for (tag, numbers) in &doubles {
            image.encoder().write_tag(*tag, &numbers[..])?;
        }
        if let Some((tag, keys)) = &keys {
            image.encoder().write_tag(*tag, &keys[..])?;
        }
        if let Some((tag, text)) = &text {
            image.encoder().write_tag(*tag, text.trim_end_matches('\0'))?;
        }
        image.encoder().write_tag(NO_DATA, no_data.to_string().as_str())?;
        image.write_data(labels)
    });
    bytes.into_inner()
}
