use crate::image::{Colours, WorldFile, read_colours, read_mask, read_numbers, write_labels};
use crate::{Format, ReadOptions};
use medial::raster::Grid;

/// Values of a tag.
enum Field {
    Short(Vec<u16>),
    Long(Vec<u32>),
    Double(Vec<f64>),
    Text(&'static str),
}

use Field::{Double, Long, Short, Text};

/// A file of pixels of some samples, in one strip, with tags besides those of its size.
fn file(
    columns: u16,
    rows: u16,
    each: u16,
    bits: u16,
    data: &[u8],
    more: Vec<(u16, Field)>,
) -> Vec<u8> {
    strips(columns, rows, each, bits, &[data], more)
}

/// The same of several strips of all rows, which are planes.
fn strips(
    columns: u16,
    rows: u16,
    each: u16,
    bits: u16,
    data: &[&[u8]],
    more: Vec<(u16, Field)>,
) -> Vec<u8> {
    let mut bytes = b"II\x2a\0\0\0\0\0".to_vec();
    let starts = data.iter().map(|strip| {
        bytes.extend(*strip);
        (bytes.len() - strip.len()) as u32
    });
    let starts: Vec<u32> = starts.collect();
    let mut fields = vec![
        (256, Short(vec![columns])),
        (257, Short(vec![rows])),
        (258, Short(vec![bits; each.into()])),
        (273, Long(starts)),
        (277, Short(vec![each])),
        (278, Short(vec![rows])),
        (279, Long(data.iter().map(|strip| strip.len() as u32).collect())),
    ];
    let has_compression = more.iter().any(|field| field.0 == 259);
    fields.extend((!has_compression).then(|| (259, Short(vec![1]))));
    fields.extend(more);
    fields.sort_by_key(|field| field.0);
    let mut entries = (fields.len() as u16).to_le_bytes().to_vec();
    for (tag, field) in fields {
        let (kind, count, mut values): (u16, usize, Vec<u8>) = match field {
            Short(v) => (3, v.len(), v.iter().flat_map(|v| v.to_le_bytes()).collect()),
            Long(v) => (4, v.len(), v.iter().flat_map(|v| v.to_le_bytes()).collect()),
            Double(v) => (12, v.len(), v.iter().flat_map(|v| v.to_le_bytes()).collect()),
            Text(text) => (2, text.len() + 1, [text.as_bytes(), &[0]].concat()),
        };
        if values.len() > 4 {
            let place = bytes.len() as u32;
            bytes.extend(values);
            values = place.to_le_bytes().to_vec();
        }
        values.resize(4, 0);
        entries.extend([tag.to_le_bytes(), kind.to_le_bytes()].concat());
        entries.extend((count as u32).to_le_bytes());
        entries.extend(values);
    }
    let directory = bytes.len() as u32;
    bytes[4..8].copy_from_slice(&directory.to_le_bytes());
    bytes.extend(entries);
    bytes.extend([0; 4]);
    bytes
}

fn colours(bytes: &[u8], bands: &[usize]) -> Colours {
    read_colours(Format::Tiff, bytes, bands, &WorldFile::default()).unwrap()
}

/// The first value of each pixel; `None` where there is none.
fn firsts(read: &Colours) -> Vec<Option<f32>> {
    read.values.iter().map(|v| (!v[0].is_nan()).then_some(v[0])).collect()
}

/// The cells above a threshold.
fn cells(bytes: &[u8], threshold: f64) -> Vec<bool> {
    let options = ReadOptions { threshold: Some(threshold), ..ReadOptions::default() };
    let (mask, _) = read_mask(Format::Tiff, bytes, &options).unwrap();
    (0..mask.grid().columns).map(|x| mask.get(x, 0)).collect()
}

#[test]
fn grey_with_opacity_is_grey() {
    let bytes =
        file(2, 1, 2, 8, &[51, 255, 51, 0], vec![(262, Short(vec![1])), (338, Short(vec![2]))]);
    let read = colours(&bytes, &[]);
    assert!(!read.are_bands);
    assert_eq!(firsts(&read), [Some(0.2), None]);
    assert_eq!(firsts(&colours(&bytes, &[1])), [Some(51.0), None]);
    assert_eq!(cells(&bytes, 20.0), [true, false]);
    let error = read_colours(Format::Tiff, &bytes, &[2], &WorldFile::default()).unwrap_err();
    assert_eq!(error.to_string(), "the image has no band 2; they go from 1 to 1");
}

#[test]
fn bands_before_opacity_are_bands() {
    let more = vec![(262, Short(vec![1])), (338, Short(vec![0, 0, 2]))];
    let bytes = file(2, 1, 4, 8, &[1, 2, 3, 255, 4, 5, 6, 0], more);
    let read = colours(&bytes, &[]);
    assert_eq!((read.are_bands, read.values[0]), (true, [1.0, 2.0, 3.0]));
    assert_eq!(firsts(&read), [Some(1.0), None]);
}

#[test]
fn bands_beside_a_colour_are_read_whatever_they_are() {
    // Red, green, blue, infrared and opacity; the differences between pixels, as a predictor leaves them.
    let data = [10, 20, 30, 40, 255, 1, 1, 1, 1, 0, 1, 1, 1, 1, 1];
    let more = vec![(262, Short(vec![2])), (317, Short(vec![2])), (338, Short(vec![0, 2]))];
    let bytes = file(3, 1, 5, 8, &data, more);
    assert_eq!(firsts(&colours(&bytes, &[4])), [Some(40.0), Some(41.0), None]);
    let read = colours(&bytes, &[]);
    assert!(!read.are_bands);
    assert_eq!(read.values[1], [11.0, 21.0, 31.0].map(|v| v / 255.0));
    let error = read_colours(Format::Tiff, &bytes, &[5], &WorldFile::default()).unwrap_err();
    assert_eq!(error.to_string(), "the image has no band 5; they go from 1 to 4");
}

#[test]
fn planes_are_put_together() {
    let planes: [&[u8]; 4] = [&[0, 9], &[1, 1], &[2, 2], &[7, 8]];
    let of = |meaning| {
        let more = vec![
            (262, Short(vec![meaning])),
            (284, Short(vec![2])),
            (338, Short(vec![0; if meaning == 2 { 1 } else { 3 }])),
        ];
        strips(2, 1, 4, 8, &planes, more)
    };
    assert_eq!(cells(&of(1), 4.0), [false, true]);
    assert_eq!(firsts(&colours(&of(1), &[4])), [Some(7.0), Some(8.0)]);
    assert_eq!(colours(&of(2), &[]).values[1], [9.0, 1.0, 2.0].map(|v| v / 255.0));
    assert_eq!(colours(&of(2), &[4, 1]).values[0], [7.0, 0.0, 0.0]);
}

#[test]
fn no_data_is_a_number_of_a_palette() {
    let map: Vec<u16> = (0..768).map(|k| if k % 256 == 1 { 65_535 } else { 0 }).collect();
    let tags = || vec![(262, Short(vec![3])), (320, Short(map.clone()))];
    let mut more = tags();
    more.push((42113, Text("0")));
    let bytes = file(2, 1, 1, 8, &[0, 1], more);
    assert_eq!(firsts(&colours(&bytes, &[])), [None, Some(1.0)]);
    assert_eq!(firsts(&colours(&bytes, &[2])), [None, Some(1.0)]);
    assert_eq!(cells(&bytes, -1.0), [false, true]);
    let mut more = tags();
    more.push((338, Short(vec![2])));
    let bytes = file(2, 1, 2, 8, &[1, 0, 1, 255], more);
    assert_eq!(firsts(&colours(&bytes, &[])), [None, Some(1.0)]);
}

#[test]
fn a_colour_is_missing_if_all_of_it_is_no_data() {
    let more = || vec![(262, Short(vec![2])), (42113, Text("5"))];
    let bytes = file(3, 1, 3, 8, &[5, 5, 5, 5, 51, 5, 51, 5, 51], more());
    assert_eq!(firsts(&colours(&bytes, &[])), [None, Some(5.0 / 255.0), Some(0.2)]);
    assert_eq!(firsts(&colours(&bytes, &[1])), [None, Some(5.0), Some(51.0)]);
    assert_eq!(cells(&bytes, 1.0), [false, true, true]);
    // Bands that are no colours stand for themselves.
    let mut more = more();
    more[0] = (262, Short(vec![1]));
    let bytes = file(2, 1, 2, 8, &[1, 5, 5, 1], more);
    assert_eq!(firsts(&colours(&bytes, &[1])), [Some(1.0), None]);
    assert_eq!(firsts(&colours(&bytes, &[])), [None, None]);
}

#[test]
fn numbers_below_zero_or_of_floating_point_are_bands() {
    let of = |bits: u16, format: u16, data: &[u8]| {
        file(2, 1, 1, bits, data, vec![(262, Short(vec![1])), (339, Short(vec![format]))])
    };
    let words = [(-30_i16).to_le_bytes(), 12_i16.to_le_bytes()].concat();
    let read = colours(&of(16, 2, &words), &[]);
    assert_eq!((read.are_bands, firsts(&read)), (true, vec![Some(-30.0), Some(12.0)]));
    let read = colours(&of(8, 2, &[255, 3]), &[]);
    assert_eq!((read.are_bands, firsts(&read)), (true, vec![Some(-1.0), Some(3.0)]));
    // 1 and 512 in half precision.
    let halves = [0x3C00_u16.to_le_bytes(), 0x6000_u16.to_le_bytes()].concat();
    let read = colours(&of(16, 3, &halves), &[]);
    assert_eq!((read.are_bands, firsts(&read)), (true, vec![Some(1.0), Some(512.0)]));
    assert!(!colours(&of(16, 1, &words), &[]).are_bands);
}

#[test]
fn colours_of_floating_point_go_up_to_one() {
    let of = |colour: [f32; 3]| {
        let data: Vec<u8> = colour.iter().flat_map(|v| v.to_le_bytes()).collect();
        file(1, 1, 3, 32, &data, vec![(262, Short(vec![2])), (339, Short(vec![3; 3]))])
    };
    assert_eq!(colours(&of([0.5, 1.0, 0.0]), &[]).values, [[0.5, 1.0, 0.0]]);
    let error =
        read_colours(Format::Tiff, &of([0.5, 255.0, 0.0]), &[], &WorldFile::default()).unwrap_err();
    assert!(error.to_string().contains("such as 255, where 1 is the greatest"), "{error}");
    assert_eq!(colours(&of([0.5, 255.0, 0.0]), &[1, 2]).values, [[0.5, 255.0, 0.0]]);
}

/// Two pixels in a place, with keys of its reference system.
fn placed(keys: &[u16]) -> Vec<u8> {
    let more = vec![
        (262, Short(vec![1])),
        (33550, Double(vec![2.0, 2.0, 0.0])),
        (33922, Double(vec![0.0, 0.0, 0.0, 100.0, 50.0, 0.0])),
        (34735, Short([&[1, 1, 0, keys.len() as u16 / 4], keys].concat())),
        (34736, Double(vec![500_000.0])),
        (34737, Text("Somewhere|")),
    ];
    file(2, 1, 1, 8, &[1, 2], more)
}

#[test]
fn labels_lie_where_their_image_does() {
    let image = placed(&[1024, 0, 1, 1, 3072, 0, 1, 25832]);
    let Colours { grid, crs, .. } = colours(&image, &[]);
    let labels = write_labels(&grid, crs.as_ref(), &[1, 70_000], 0, &image);
    let read = colours(&labels, &[]);
    assert_eq!(firsts(&read), [Some(1.0), Some(70_000.0)]);
    assert_eq!(read.grid, grid);
    assert_eq!(read.crs.and_then(|crs| crs.epsg_code()), Some(25832));
    assert!(labels.windows(10).any(|bytes| bytes == b"Somewhere|"));
    let nowhere = Grid::of_image(2, 1);
    let read = colours(&write_labels(&nowhere, None, &[1, 2], 0, b""), &[]);
    assert_eq!(read.grid, nowhere);
    // A place that a file beside the image told, as corners and a size or, where rows go up, as a matrix.
    for (cell, code) in [([2.0, -3.0], 4326), ([2.0, 3.0], 25832), ([-0.5, -3.0], 2_000_000)] {
        let grid = Grid { origin: medial::geom::Point::new(7.0, 9.0), cell, ..nowhere };
        let crs = crate::Crs::epsg(code);
        let read = colours(&write_labels(&grid, Some(&crs), &[1, u32::MAX], u32::MAX, b""), &[]);
        assert_eq!(read.grid, grid);
        assert_eq!(firsts(&read), [Some(1.0), None]);
        // Codes that no key holds are left out.
        let known = (code < 65_536).then_some(code);
        assert_eq!(read.crs.and_then(|crs| crs.epsg_code()), known);
    }
}

#[test]
fn numbers_of_labels_are_exact() {
    let grid = Grid::of_image(3, 1);
    let labels = write_labels(&grid, None, &[0, 16_777_217, u32::MAX], u32::MAX, b"");
    let read = read_numbers(Format::Tiff, &labels, &WorldFile::default()).unwrap();
    assert_eq!(read.values[..2], [0.0, 16_777_217.0]);
    assert!(read.values[2].is_nan());
    let large =
        file(1, 1, 1, 64, &9_007_199_254_740_993_u64.to_le_bytes(), vec![(262, Short(vec![1]))]);
    let error = read_numbers(Format::Tiff, &large, &WorldFile::default()).unwrap_err().to_string();
    assert!(error.contains("too large to be told from the next one"), "{error}");
    let two = file(1, 1, 2, 8, &[1, 2], vec![(262, Short(vec![1])), (338, Short(vec![0]))]);
    let error = read_numbers(Format::Tiff, &two, &WorldFile::default()).unwrap_err().to_string();
    assert!(error.contains("2 bands; labels need an image of one, or of colours"), "{error}");
}

#[test]
fn what_is_not_used_of_a_place_is_told() {
    let read = colours(&placed(&[1024, 0, 1, 1, 3072, 0, 1, 32_767]), &[]);
    assert!(read.crs.is_none() && read.warnings[0].contains("no code of EPSG"));
    let more = vec![
        (262, Short(vec![1])),
        (33922, Double(vec![0.0, 0.0, 0.0, 9.0, 9.0, 0.0, 2.0, 0.0, 0.0, 9.0, 7.0, 0.0])),
    ];
    let points = file(2, 1, 1, 8, &[1, 2], more);
    let layer = crate::image::read(Format::Tiff, &points, &ReadOptions::default()).unwrap();
    assert!(layer.warnings[0].contains("tie points have no scale"), "{:?}", layer.warnings);
    assert!(colours(&placed(&[1024, 0, 1, 1, 3072, 0, 1, 25832]), &[]).warnings.is_empty());
}

#[test]
fn wide_values_that_are_nearly_black_are_told() {
    let of = |greatest: u16| {
        let data = [[0, 0], greatest.to_le_bytes()].concat();
        colours(&file(2, 1, 1, 16, &data, vec![(262, Short(vec![1]))]), &[]).warnings
    };
    assert!(of(4095)[0].contains("4095 of 65535"), "{:?}", of(4095));
    assert!(of(4096).is_empty() && of(0).is_empty());
}

#[test]
fn a_compression_that_is_not_read_is_named() {
    let more = vec![(259, Short(vec![50_000])), (262, Short(vec![1]))];
    let error =
        read_colours(Format::Tiff, &file(1, 1, 1, 8, &[1], more), &[], &WorldFile::default())
            .unwrap_err();
    assert!(error.to_string().contains("ZSTD (50000)"), "{error}");
    assert!(error.to_string().contains("COMPRESS=DEFLATE"), "{error}");
}

/// A JPEG stream of 8 by 8 pixels of red 200, green 60 and blue 30, as a brightness and two differences.
const JPEG: &str = "\
    ffd8ffdb004300020101010101020101010202020202040302020202050404030406050606060506060607 \
    0908060709070606080b08090a0a0a0a0a06080b0c0b0a0c090a0a0affdb00430102020202020205030305 \
    0a0706070a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a0a \
    0a0a0a0a0a0a0a0a0a0a0affc00011080008000803012200021101031101ffc40015000101000000000000 \
    00000000000000000007ffc40014100100000000000000000000000000000000ffc4001501010100000000 \
    000000000000000000000809ffc40014110100000000000000000000000000000000ffda000c0301000211 \
    0311003f00838031a903ffd9";

#[test]
fn brightness_and_differences_in_jpeg_become_colours() {
    let digit = |byte: u8| char::from(byte).to_digit(16).map(|digit| digit as u8);
    let digits: Vec<u8> = JPEG.bytes().filter_map(digit).collect();
    let stream: Vec<u8> = digits.chunks(2).map(|pair| 16 * pair[0] + pair[1]).collect();
    let of = |meaning: u16| {
        let more =
            vec![(259, Short(vec![7])), (262, Short(vec![meaning])), (530, Short(vec![2, 2]))];
        file(8, 8, 3, 8, &stream, more)
    };
    let is_near = |values: [f32; 3], expected: [f32; 3]| {
        values.iter().zip(expected).all(|(value, wanted)| (value - wanted).abs() < 2.0)
    };
    let read = colours(&of(6), &[]);
    assert_eq!((read.are_bands, read.values.len()), (false, 64));
    assert!(read.values.iter().all(|v| is_near(v.map(|v| 255.0 * v), [200.0, 60.0, 30.0])));
    assert!(is_near(colours(&of(6), &[1, 2, 3]).values[0], [200.0, 60.0, 30.0]));
    // 0.2126 of red, 0.7152 of green and 0.0722 of blue are 87.6.
    assert!(cells(&of(6), 85.0)[0] && !cells(&of(6), 90.0)[0]);
    // The same stream, if the file says that it is red, green and blue: nothing is turned into a colour.
    assert!(is_near(colours(&of(2), &[1, 2, 3]).values[0], [98.4, 89.4, 200.5]));
}

#[test]
fn samples_that_are_no_colours_are_told_with_a_way_out() {
    // Complex numbers, and the brightness and two differences of the eye.
    for more in [vec![(262, Short(vec![1])), (339, Short(vec![6]))], vec![(262, Short(vec![8]))]] {
        let each = if more.len() == 1 { 3 } else { 1 };
        let error = read_colours(
            Format::Tiff,
            &file(1, 1, each, 8, &[1; 3], more),
            &[],
            &WorldFile::default(),
        );
        let error = error.unwrap_err().to_string();
        assert!(
            error.ends_with("; save it in grey or RGB, of whole or floating-point numbers"),
            "{error}"
        );
    }
}
