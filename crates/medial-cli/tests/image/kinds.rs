//! Images of every kind, and those that are none.

use super::*;

/// A JPEG image of 16 by 8 pixels in four inks: red, and cyan beside it.
const CMYK: &[u8] = b"\
    \xff\xd8\xff\xee\x00\x0e\x41\x64\x6f\x62\x65\x00\x64\x00\x00\x00\x00\x00\xff\xdb\x00\x43\x00\x0d\x09\x0a\
    \x0b\x0a\x08\x0d\x0b\x0a\x0b\x0e\x0e\x0d\x0f\x13\x20\x15\x13\x12\x12\x13\x27\x1c\x1e\x17\x20\x2e\x29\x31\
    \x30\x2e\x29\x2d\x2c\x33\x3a\x4a\x3e\x33\x36\x46\x37\x2c\x2d\x40\x57\x41\x46\x4c\x4e\x52\x53\x52\x32\x3e\
    \x5a\x61\x5a\x50\x60\x4a\x51\x52\x4f\xff\xc0\x00\x14\x08\x00\x08\x00\x10\x04\x43\x11\x00\x4d\x11\x00\x59\
    \x11\x00\x4b\x11\x00\xff\xc4\x00\x16\x00\x01\x01\x01\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\
    \x07\x08\x00\xff\xc4\x00\x14\x10\x01\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\xff\
    \xda\x00\x0e\x04\x43\x00\x4d\x00\x59\x00\x4b\x00\x00\x3f\x00\x4e\x18\x0c\x09\xc9\x89\x4e\xa9\xd6\x7f\xff\
    \xd9";

/// An image of every kind that readers meet, of 8 by 6 pixels: its name and its bytes.
fn kinds(folder: &Path) -> Vec<(&'static str, PathBuf, usize)> {
    let png_of = |name: &str,
                  color: png::ColorType,
                  depth: png::BitDepth,
                  palette: Option<Vec<u8>>,
                  data: Vec<u8>| {
        let path = folder.join(name);
        let mut encoder = png::Encoder::new(fs::File::create(&path).unwrap(), 8, 6);
        encoder.set_color(color);
        encoder.set_depth(depth);
        if let Some(palette) = palette {
            encoder.set_palette(palette);
        }
        encoder.write_header().unwrap().write_image_data(&data).unwrap();
        path
    };
    let is_in = |k: usize| (2..5).contains(&(k % 8)) && (1..4).contains(&(k / 8));
    let words = |k: usize| if is_in(k) { [0xFF, 0xFF, 0, 0, 0, 0] } else { [0, 0, 0, 0, 0x80, 0] };
    let inks = folder.join("inks.jpg");
    fs::write(&inks, CMYK).unwrap();
    vec![
        ("four inks", inks, 2),
        (
            "16 bits",
            png_of(
                "wide.png",
                png::ColorType::Rgb,
                png::BitDepth::Sixteen,
                None,
                (0..48).flat_map(words).collect(),
            ),
            2,
        ),
        (
            "a palette",
            png_of(
                "palette.png",
                png::ColorType::Indexed,
                png::BitDepth::Eight,
                Some(vec![0, 0, 128, 255, 0, 0]),
                (0..48).map(|k| u8::from(is_in(k))).collect(),
            ),
            2,
        ),
        (
            "grey",
            png_of(
                "grey.png",
                png::ColorType::Grayscale,
                png::BitDepth::Eight,
                None,
                (0..48).map(|k| if is_in(k) { 200 } else { 20 }).collect(),
            ),
            2,
        ),
        (
            "transparency",
            png_of(
                "clear.png",
                png::ColorType::Rgba,
                png::BitDepth::Eight,
                None,
                (0..48)
                    .flat_map(|k| if is_in(k) { [255, 0, 0, 255] } else { [0, 0, 0, 0] })
                    .collect(),
            ),
            1,
        ),
        (
            "one colour only",
            png_of(
                "flat.png",
                png::ColorType::Rgb,
                png::BitDepth::Eight,
                None,
                [9, 99, 200].repeat(48),
            ),
            1,
        ),
    ]
}

#[test]
fn images_of_every_kind_give_their_regions() {
    let folder = tempfile::tempdir().unwrap();
    for (kind, path, n_regions) in kinds(folder.path()) {
        let words = ["--method", "mean_shift", "--spatial", "3", "--min-region", "1"];
        let run = medial(&[&["image", path.to_str().unwrap()][..], &words].concat());
        assert_eq!((run.status, run.errors.as_str()), (Some(0), ""), "{kind}");
        assert_eq!(by_layer(run.text())["border"].len(), n_regions, "{kind}");
        assert!(by_layer(run.text()).contains_key("axis"), "{kind}");
    }
}

#[test]
fn images_without_data_or_cut_off_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let clear = picture(folder.path(), "clear.png", &["    ", "    "]);
    let run = medial(&["image", &clear]);
    assert_eq!(run.status, Some(1));
    assert!(run.errors.contains("has no pixel with data"), "{}", run.errors);
    let whole = picture(folder.path(), "whole.png", &BARS);
    let bytes = fs::read(&whole).unwrap();
    let broken = folder.path().join("broken.png");
    for length in [0, 7, 20, 40, bytes.len() / 2, bytes.len() - 14] {
        fs::write(&broken, &bytes[..length]).unwrap();
        let run = medial(&["image", broken.to_str().unwrap()]);
        assert_eq!((run.status, run.text()), (Some(1), ""), "{length}: {}", run.errors);
        assert!(
            run.errors.starts_with("error: ") && run.errors.lines().count() == 1,
            "{}",
            run.errors
        );
    }
    let cut = folder.path().join("cut.jpg");
    for length in [3, 60, 120, CMYK.len() / 2] {
        fs::write(&cut, &CMYK[..length]).unwrap();
        let run = medial(&["image", cut.to_str().unwrap()]);
        assert_eq!((run.status, run.text()), (Some(1), ""), "{length}: {}", run.errors);
        assert!(run.errors.contains("save it again as JPEG or PNG"), "{}", run.errors);
    }
    let run = medial_with(&["image", "-", "--from", "geojson"], "{}");
    assert_eq!(run.status, Some(1));
    assert!(run.errors.contains("is geojson, no image"), "{}", run.errors);
    let run = medial_with(&["image", "-"], "just text");
    assert_eq!(run.status, Some(1));
    assert!(run.errors.contains("no image"), "{}", run.errors);
}
