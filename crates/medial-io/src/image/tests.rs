use super::*;
use ::tiff::encoder::{TiffEncoder, colortype};
use ::tiff::tags::Tag;
use std::io::Cursor;

fn png_of(
    columns: u32,
    rows: u32,
    color: ::png::ColorType,
    depth: ::png::BitDepth,
    data: &[u8],
) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = ::png::Encoder::new(&mut bytes, columns, rows);
    encoder.set_color(color);
    encoder.set_depth(depth);
    if color == ::png::ColorType::Indexed {
        encoder.set_palette(vec![0, 0, 0, 255, 255, 255, 200, 200, 200]);
        encoder.set_trns(vec![255, 255, 0]);
    }
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(data).unwrap();
    writer.finish().unwrap();
    bytes
}

fn drawn(format: Format, bytes: &[u8], options: &ReadOptions) -> Vec<String> {
    let (mask, _) = read_mask(format, bytes, options).unwrap();
    let grid = mask.grid();
    let cell = |x, y| if mask.get(x, y) { '#' } else { '.' };
    (0..grid.rows).map(|y| (0..grid.columns).map(|x| cell(x, y)).collect()).collect()
}

#[test]
fn png_images_of_all_kinds_are_masks() {
    use ::png::{BitDepth, ColorType};
    let plain = ReadOptions::default();
    let one_bit = png_of(3, 2, ColorType::Grayscale, BitDepth::One, &[0b1010_0000, 0b0100_0000]);
    assert_eq!(drawn(Format::Png, &one_bit, &plain), ["#.#", ".#."]);
    // What a file is called may be wrong.
    assert_eq!(drawn(Format::Tiff, &one_bit, &plain), ["#.#", ".#."]);
    let inverted = ReadOptions { invert: true, ..ReadOptions::default() };
    assert_eq!(drawn(Format::Png, &one_bit, &inverted), [".#.", "#.#"]);
    let grey = png_of(3, 1, ColorType::Grayscale, BitDepth::Eight, &[0, 100, 255]);
    assert_eq!(drawn(Format::Png, &grey, &plain), ["..#"]);
    let low = ReadOptions { threshold: Some(99.0), ..ReadOptions::default() };
    assert_eq!(drawn(Format::Png, &grey, &low), [".##"]);
    let words = png_of(2, 1, ColorType::Grayscale, BitDepth::Sixteen, &[0, 9, 0, 8]);
    assert_eq!(drawn(Format::Png, &words, &plain), ["#."]);
    // White, black, grey that is transparent.
    let palette = png_of(3, 1, ColorType::Indexed, BitDepth::Eight, &[1, 0, 2]);
    assert_eq!(drawn(Format::Png, &palette, &plain), ["#.."]);
    assert_eq!(drawn(Format::Png, &palette, &inverted), [".#."]);
    let clear = png_of(2, 1, ColorType::Rgba, BitDepth::Eight, &[9, 9, 9, 255, 255, 255, 255, 0]);
    assert_eq!(drawn(Format::Png, &clear, &plain), ["#."]);
}

#[test]
fn one_value_is_inside_above_zero() {
    use ::png::{BitDepth, ColorType};
    let of = |value| png_of(2, 1, ColorType::Grayscale, BitDepth::Eight, &[value; 2]);
    assert_eq!(drawn(Format::Png, &of(1), &ReadOptions::default()), ["##"]);
    assert_eq!(drawn(Format::Png, &of(0), &ReadOptions::default()), [".."]);
}

#[test]
fn damaged_images_are_refused_with_a_reason() {
    use ::png::{BitDepth, ColorType};
    let whole = png_of(40, 40, ColorType::Grayscale, BitDepth::Eight, &[7; 1600]);
    for end in [0, 4, 20, 40, whole.len() - 20] {
        let error = read_mask(Format::Png, &whole[..end], &ReadOptions::default()).unwrap_err();
        assert!(error.to_string().starts_with("the image cannot be read: "), "{end}: {error}");
    }
    let error =
        read_mask(Format::Tiff, b"II*\0\x08\0\0\0\x01", &ReadOptions::default()).unwrap_err();
    assert!(error.to_string().ends_with("as gdal_translate -co COMPRESS=DEFLATE does"), "{error}");
}

#[test]
fn a_geotiff_lies_where_it_says() {
    let mut bytes = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut bytes).unwrap();
    let mut image = encoder.new_image::<colortype::Gray32Float>(3, 2).unwrap();
    let directory = image.encoder();
    directory.write_tag(Tag::Unknown(33550), &[10.0, 20.0, 0.0][..]).unwrap();
    directory.write_tag(Tag::Unknown(33922), &[0.0, 0.0, 0.0, 500.0, 900.0, 0.0][..]).unwrap();
    let keys: [u16; 12] = [1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, 25832];
    directory.write_tag(Tag::Unknown(34735), &keys[..]).unwrap();
    directory.write_tag(Tag::Unknown(42113), "-9999").unwrap();
    image.write_data(&[0.0, 1.0, -9999.0, f32::NAN, 1.0, 0.2]).unwrap();
    let bytes = bytes.into_inner();
    let (mask, crs) = read_mask(Format::Tiff, &bytes, &ReadOptions::default()).unwrap();
    assert_eq!(mask.grid().origin, Point::new(500.0, 900.0));
    assert_eq!(mask.grid().cell, [10.0, -20.0]);
    assert_eq!(crs.and_then(|crs| crs.epsg_code()), Some(25832));
    assert_eq!(drawn(Format::Tiff, &bytes, &ReadOptions::default()), [".#.", ".#."]);
    let feature = read(Format::Tiff, &bytes, &ReadOptions::default()).unwrap().next().unwrap();
    let ring = &feature.unwrap().polygons[0][0];
    assert!(ring.contains(&Point::new(510.0, 900.0)) && ring.contains(&Point::new(520.0, 860.0)));
}

#[test]
fn tiff_images_of_many_depths_are_masks() {
    fn of<C: colortype::ColorType>(columns: u32, data: &[C::Inner]) -> Vec<u8>
    where
        [C::Inner]: ::tiff::encoder::TiffValue,
    {
        let mut bytes = Cursor::new(Vec::new());
        let rows = data.len() as u32 / C::SAMPLE_FORMAT.len() as u32 / columns;
        TiffEncoder::new(&mut bytes).unwrap().write_image::<C>(columns, rows, data).unwrap();
        bytes.into_inner()
    }
    let plain = ReadOptions::default();
    assert_eq!(drawn(Format::Tiff, &of::<colortype::Gray8>(3, &[0, 255, 0]), &plain), [".#."]);
    assert_eq!(drawn(Format::Tiff, &of::<colortype::Gray16>(3, &[0, 1, 1]), &plain), [".##"]);
    let large = of::<colortype::Gray32>(2, &[u32::MAX, u32::MAX - 1]);
    assert_eq!(drawn(Format::Tiff, &large, &plain), ["#."]);
    assert_eq!(drawn(Format::Tiff, &of::<colortype::Gray64Float>(2, &[0.1, 0.9]), &plain), [".#"]);
    let colours = of::<colortype::RGB8>(2, &[0, 0, 255, 0, 255, 0]);
    assert_eq!(drawn(Format::Tiff, &colours, &plain), [".#"]);
    let clear = of::<colortype::RGBA8>(2, &[255, 255, 255, 0, 1, 1, 1, 255]);
    assert_eq!(drawn(Format::Tiff, &clear, &plain), [".#"]);
}

/// The smallest file with a palette, in either order of bytes: white, black, white.
fn palette_tiff(is_little: bool) -> Vec<u8> {
    let two = |v: u16| if is_little { v.to_le_bytes() } else { v.to_be_bytes() };
    let four = |v: u32| if is_little { v.to_le_bytes() } else { v.to_be_bytes() };
    let entries: [(u16, u16, u32, u32); 9] = [
        (256, 3, 1, 3),
        (257, 3, 1, 1),
        (258, 3, 1, 8),
        (259, 3, 1, 1),
        (262, 3, 1, 3),
        (273, 4, 1, 8),
        (278, 3, 1, 1),
        (279, 4, 1, 3),
        (320, 3, 768, 126),
    ];
    let mut bytes = if is_little { b"II".to_vec() } else { b"MM".to_vec() };
    bytes.extend(two(42));
    bytes.extend(four(12));
    bytes.extend([1, 0, 1, 0]);
    bytes.extend(two(9));
    for (tag, kind, count, value) in entries {
        bytes.extend([two(tag), two(kind)].concat());
        bytes.extend(four(count));
        if kind == 3 && count == 1 {
            bytes.extend([two(value as u16), two(0)].concat());
        } else {
            bytes.extend(four(value));
        }
    }
    bytes.extend(four(0));
    assert_eq!(bytes.len(), 126);
    for _ in 0..3 {
        (0..256).for_each(|k| bytes.extend(two(if k == 1 { 65_535 } else { 0 })));
    }
    bytes
}

#[test]
fn palettes_of_tiff_count_by_their_brightness() {
    for is_little in [true, false] {
        let bytes = palette_tiff(is_little);
        assert_eq!(drawn(Format::Tiff, &bytes, &ReadOptions::default()), ["#.#"], "{is_little}");
    }
}

/// A TIFF of grey bytes in tiles of 16 by 16, of which those at the right and at the bottom stick out.
fn tiled_tiff(columns: u32, rows: u32, value: impl Fn(u32, u32) -> u8) -> Vec<u8> {
    const TILE: u32 = 16;
    let (across, down) = (columns.div_ceil(TILE), rows.div_ceil(TILE));
    let n = across * down;
    let head = 8 + 2 + 12 * 10 + 4;
    let (offsets, counts) = (head, head + 4 * n);
    let data = counts + 4 * n;
    let entries: [(u16, u16, u32, u32); 10] = [
        (256, 4, 1, columns),
        (257, 4, 1, rows),
        (258, 3, 1, 8),
        (259, 3, 1, 1),
        (262, 3, 1, 1),
        (277, 3, 1, 1),
        (322, 4, 1, TILE),
        (323, 4, 1, TILE),
        (324, 4, n, if n == 1 { data } else { offsets }),
        (325, 4, n, if n == 1 { TILE * TILE } else { counts }),
    ];
    let mut bytes = b"II\x2a\0\x08\0\0\0".to_vec();
    bytes.extend(10_u16.to_le_bytes());
    for (tag, kind, count, value) in entries {
        bytes.extend([tag.to_le_bytes(), kind.to_le_bytes()].concat());
        bytes.extend([count.to_le_bytes(), value.to_le_bytes()].concat());
    }
    bytes.extend(0_u32.to_le_bytes());
    (0..n).for_each(|k| bytes.extend((data + k * TILE * TILE).to_le_bytes()));
    (0..n).for_each(|_| bytes.extend((TILE * TILE).to_le_bytes()));
    for (row, column) in (0..down).flat_map(|row| (0..across).map(move |column| (row, column))) {
        for (y, x) in (0..TILE).flat_map(|y| (0..TILE).map(move |x| (y, x))) {
            let (x, y) = (column * TILE + x, row * TILE + y);
            bytes.push(if x < columns && y < rows { value(x, y) } else { 77 });
        }
    }
    bytes
}

#[test]
fn tiles_are_put_together_row_by_row() {
    for (columns, rows) in [(16, 16), (5, 3), (37, 33), (16, 50), (50, 16)] {
        let bytes = tiled_tiff(columns, rows, |x, y| if (x * 7 + y * 3) % 5 < 2 { 9 } else { 1 });
        let drawn = drawn(Format::Tiff, &bytes, &ReadOptions::default());
        let cell = |x, y| if (x * 7 + y * 3) % 5 < 2 { '#' } else { '.' };
        let expected: Vec<String> =
            (0..rows).map(|y| (0..columns).map(|x| cell(x, y)).collect()).collect();
        assert_eq!(drawn, expected, "{columns} by {rows}");
    }
}

#[test]
fn strips_are_put_together_row_by_row() {
    let values: Vec<u8> = (0..23 * 31).map(|k| (k * 37 % 251) as u8).collect();
    let mut bytes = Cursor::new(Vec::new());
    let mut encoder = TiffEncoder::new(&mut bytes).unwrap();
    let mut image = encoder.new_image::<colortype::Gray8>(23, 31).unwrap();
    image.rows_per_strip(4).unwrap();
    image.write_data(&values).unwrap();
    let options = ReadOptions { threshold: Some(100.0), ..ReadOptions::default() };
    let (mask, _) = read_mask(Format::Tiff, &bytes.into_inner(), &options).unwrap();
    for (k, &value) in (0..).zip(&values) {
        assert_eq!(mask.get(k % 23, k / 23), value > 100, "{k}");
    }
}

#[test]
fn masks_may_come_without_their_outlines() {
    let bytes = tiled_tiff(20, 20, |x, y| u8::from(x > 3 && y > 4));
    let options = ReadOptions { masks_alone: true, ..ReadOptions::default() };
    let feature = read(Format::Tiff, &bytes, &options).unwrap().next().unwrap().unwrap();
    assert!(feature.polygons.is_empty() && feature.polygonal);
    assert_eq!(feature.mask.map(|mask| mask.count()), Some(16 * 15));
}

#[test]
fn what_is_transparent_has_no_bands() {
    use ::png::{BitDepth, ColorType};
    let clear = png_of(2, 1, ColorType::Rgba, BitDepth::Eight, &[9, 8, 7, 255, 6, 5, 4, 0]);
    let read = read_colours(Format::Png, &clear, &[2], &WorldFile::default()).unwrap();
    assert_eq!(read.values[0], [8.0, 0.0, 0.0]);
    assert!(read.values[1][0].is_nan() && read.are_bands);
}
