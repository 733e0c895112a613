//! Colour images in regions, as a user meets them.

mod common;

use common::medial;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// A picture of a red disk on a blue ground with a green bar, with an alpha channel: the last column is clear.
fn picture(folder: &Path) -> PathBuf {
    let path = folder.join("picture.png");
    let mut encoder = png::Encoder::new(fs::File::create(&path).unwrap(), 40, 30);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    let pixel = |k: i32| {
        let (x, y) = (k % 40, k / 40);
        let colour = match (x, y) {
            (39, _) => return [255, 255, 255, 0],
            (x, y) if (x - 12).pow(2) + (y - 12).pow(2) <= 64 => [200, 30, 30],
            (_, 24..27) => [30, 160, 40],
            _ => [30, 40, 180],
        };
        [colour[0], colour[1], colour[2], 255]
    };
    let samples: Vec<u8> = (0..40 * 30).flat_map(pixel).collect();
    encoder.write_header().unwrap().write_image_data(&samples).unwrap();
    path
}

fn features(text: &str) -> Vec<Value> {
    let read: Value = serde_json::from_str(text).unwrap();
    read["features"].as_array().unwrap().clone()
}

#[test]
fn every_method_finds_the_four_regions() {
    let folder = tempfile::tempdir().unwrap();
    let picture = picture(folder.path());
    let picture = picture.to_str().unwrap();
    for method in [
        &["--min-region", "5"][..],
        &["--method", "feature-space", "--resolution", "quantization", "--seed", "9"],
        &["--method", "mean_shift", "--spatial", "3"],
        &["--method", "colours", "--color", "c81e1e,1ea028,1e28b4"],
        &["--method", "threshold", "--limits", "30,42,57", "--min-region", "5"],
    ] {
        let run = medial(&[&["segment", picture], method].concat());
        assert_eq!(run.status, Some(0), "{method:?}: {}", run.errors);
        let found = features(run.text());
        // The ground above the bar, the disk, the bar, the ground below.
        assert_eq!(found.len(), 4, "{method:?}");
        let told = &found[1]["properties"];
        assert_eq!((&told["region"], &told["color"]), (&1.into(), &"#c81e1e".into()), "{method:?}");
        assert_eq!(found[0]["properties"]["n_holes"], 1);
        let pixels: u64 = found.iter().map(|f| f["properties"]["pixels"].as_u64().unwrap()).sum();
        assert_eq!(pixels, 39 * 30, "{method:?}");
        assert_eq!(found[2]["properties"]["pixels"], 39 * 3);
    }
}

#[test]
fn regions_have_axes() {
    let folder = tempfile::tempdir().unwrap();
    let picture = picture(folder.path());
    let regions = folder.path().join("regions.geojson");
    let run = medial(&["segment", picture.to_str().unwrap(), "-o", regions.to_str().unwrap()]);
    assert_eq!(run.status, Some(0), "{}", run.errors);
    let run = medial(&["axis", regions.to_str().unwrap(), "--to", "wkt"]);
    assert_eq!((run.status, run.text().lines().count()), (Some(0), 4), "{}", run.errors);
}

#[test]
fn labels_and_pictures_are_images() {
    let folder = tempfile::tempdir().unwrap();
    let picture = picture(folder.path());
    let [labels, smooth] = ["labels.tiff", "smooth.png"].map(|name| folder.path().join(name));
    let words = ["segment", picture.to_str().unwrap(), "--min-region", "5"];
    let (labels, smooth) = (labels.to_str().unwrap(), smooth.to_str().unwrap());
    let run = medial(&[&words[..], &["-o", smooth, "--labels", labels]].concat());
    assert_eq!((run.status, run.text()), (Some(0), ""), "{}", run.errors);
    // The picture is parted in the same way again.
    let again = medial(&["segment", smooth, "--min-region", "5", "--to", "wkt"]);
    let first = medial(&[&words[..], &["--to", "wkt"]].concat());
    assert_eq!(again.text(), first.text());
    // Numbers from 1 on: the lower ground is the fourth region.
    let mask = medial(&["axis", labels, "--threshold", "3.5", "--to", "wkt"]);
    assert_eq!((mask.status, mask.text().lines().count()), (Some(0), 1), "{}", mask.errors);
}

#[test]
fn wrong_words_and_files_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let picture = picture(folder.path());
    let picture = picture.to_str().unwrap();
    for (words, why) in [
        (&["--limits", "3"][..], "--limits is for --method threshold"),
        (&["--method", "threshold"], "needs --limits"),
        (&["--method", "threshold", "--limits", "3,1"], "increasing"),
        (&["--method", "colours"], "needs --color"),
        (&["--method", "colours", "--color", "red"], "hexadecimal"),
        (&["--to", "svg"], "regions are written as"),
    ] {
        let run = medial(&[&["segment", picture], words].concat());
        assert_eq!(run.status, Some(2), "{words:?}: {}", run.errors);
        assert!(run.errors.contains(why), "{words:?}: {}", run.errors);
    }
    let run = medial(&["segment", picture, "--bands", "1,9"]);
    assert_eq!(run.status, Some(1));
    assert!(run.errors.contains("no band 9; they go from 1 to 3"), "{}", run.errors);
    let broken = folder.path().join("broken.jpg");
    fs::write(&broken, b"\xff\xd8\xff\xe0\0\x10JFIF\0\x01\x01\0\0\x01\0\x01\0\0").unwrap();
    let run = medial(&["segment", broken.to_str().unwrap()]);
    assert_eq!(run.status, Some(1));
    assert!(run.errors.starts_with("error: ") && run.errors.lines().count() == 1, "{}", run.errors);
}

#[test]
fn bands_of_what_is_transparent_are_in_no_region() {
    let folder = tempfile::tempdir().unwrap();
    let picture = picture(folder.path());
    let run = medial(&["segment", picture.to_str().unwrap(), "--bands", "1"]);
    assert_eq!(run.status, Some(0), "{}", run.errors);
    let found = features(run.text());
    let pixels: u64 = found.iter().map(|f| f["properties"]["pixels"].as_u64().unwrap()).sum();
    assert_eq!(pixels, 39 * 30);
    let means = found.iter().map(|f| f["properties"]["mean_1"].as_f64().unwrap());
    let greatest = means.fold(0.0, f64::max);
    assert!(99.0 < greatest && greatest <= 100.0, "{greatest}");
}

#[test]
fn values_of_sixteen_bits_that_are_nearly_black_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("dark.png");
    let mut encoder = png::Encoder::new(fs::File::create(&path).unwrap(), 2, 1);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Sixteen);
    encoder.write_header().unwrap().write_image_data(&[0, 0, 15, 255]).unwrap();
    let words = ["segment", path.to_str().unwrap(), "--method", "threshold", "--limits", "1"];
    let run = medial(&words);
    assert_eq!(run.status, Some(0), "{}", run.errors);
    assert!(run.errors.contains("--bands 1 takes"), "{}", run.errors);
    let run = medial(&[&words[..], &["--quiet"]].concat());
    assert_eq!(run.status, Some(0), "{}", run.errors);
    assert!(!run.errors.contains("warning"), "{}", run.errors);
}
