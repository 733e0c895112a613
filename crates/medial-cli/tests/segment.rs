//! Colour images in regions, as a user meets them.

mod common;

use common::{medial, medial_with};
use serde_json::Value;
use std::collections::BTreeSet;
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
        (&["--method", "labels", "--min-region", "3"], "--min-region is not for --method labels"),
        (
            &["--method", "mean_shift", "--palette", "p.csv"],
            "--palette is for methods with classes",
        ),
        (&["--no-data", "blue"], "--no-data blue is no colour"),
        (&["--labels", "-"], "--labels needs a file of its own"),
        (&["--palette", "-"], "--palette needs a file of its own"),
        (&["--palette", "p.png"], "--palette writes files .csv and .gpl, not .png"),
        (&["--labels", "l.png"], "--labels writes files .tif and .tiff, not .png"),
        (&["-o", "x.png", "--palette", "x.pgw"], "--palette needs a file of its own"),
        (&["-o", "x.png", "--report", "x.prj"], "--report needs a file of its own"),
        (&["--bands", "1", "--no-data", "blue"], "--no-data blue is no number"),
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

/// The properties of regions by name.
fn told(words: &[&str], name: &str) -> Vec<Value> {
    let run = medial(&[&["segment"][..], words].concat());
    assert_eq!(run.status, Some(0), "{words:?}: {}", run.errors);
    features(run.text()).iter().map(|f| f["properties"][name].clone()).collect()
}

#[test]
fn the_palette_has_the_classes_of_regions() {
    let folder = tempfile::tempdir().unwrap();
    let picture = picture(folder.path());
    let picture = picture.to_str().unwrap();
    let [table, gimp] = ["palette.csv", "palette.gpl"]
        .map(|name| folder.path().join(name).to_str().unwrap().to_owned());
    let colours = ["--method", "colours", "--color", "c81e1e,1ea028"];
    let words = [&[picture], &colours[..], &["--palette", &table]].concat();
    // The ground, on both sides of the bar, is near to none.
    assert_eq!(told(&words, "class"), [2, 0, 1, 2]);
    let text = fs::read_to_string(&table).unwrap();
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows[0], ["class", "color", "mean_1", "mean_2", "mean_3", "pixels", "regions"]);
    let row = |k: usize| (rows[k][0], rows[k][1], rows[k][5], rows[k][6]);
    assert_eq!(row(1), ("0", "#c81e1e", "197", "1"));
    assert_eq!(row(2), ("1", "#1ea028", "117", "1"));
    assert_eq!(row(3), ("2", "#1e28b4", "856", "2"));
    let words = [picture, "--min-region", "5", "--palette", &gimp];
    let classes = told(&words, "class");
    assert_eq!(classes[0], classes[3], "the ground above the bar and below it");
    let text = fs::read_to_string(&gimp).unwrap();
    assert!(text.starts_with("GIMP Palette\nName: picture\n"), "{text}");
    assert_eq!(text.lines().filter(|line| line.contains("\tclass ")).count(), 3, "{text}");
    assert!(text.contains("200  30  30\t"), "{text}");
    assert_eq!(
        told(&[picture, "--method", "mean_shift", "--spatial", "3"], "class"),
        [(); 4].map(|()| Value::Null)
    );
}

#[test]
fn labels_are_regions_connected_or_not() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("labels.png");
    let mut encoder = png::Encoder::new(fs::File::create(&path).unwrap(), 5, 2);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Eight);
    let samples = [7, 7, 0, 7, 255, 0, 0, 0, 3, 3];
    encoder.write_header().unwrap().write_image_data(&samples).unwrap();
    let labels = [path.to_str().unwrap(), "--method", "labels"];
    assert_eq!(told(&labels, "mean_1"), [0.0, 3.0, 7.0, 255.0]);
    assert_eq!(told(&labels, "mean_2"), [(); 4].map(|()| Value::Null));
    assert_eq!(told(&labels, "pixels"), [4, 2, 3, 1]);
    assert_eq!(told(&labels, "n_polygons"), [1, 1, 2, 1]);
    // Each has a colour of its own.
    let colours: BTreeSet<String> =
        told(&labels, "color").iter().map(|colour| colour.as_str().unwrap().to_owned()).collect();
    assert_eq!(colours.len(), 4);
    let known = [&labels[..], &["--no-data", "0"]].concat();
    assert_eq!(told(&known, "pixels"), [2, 3, 1]);
    // What was written is read again; each of four colours is one region, ground on both sides of the bar.
    let picture = picture(folder.path());
    let picture = picture.to_str().unwrap();
    let kept = folder.path().join("kept.tiff").to_str().unwrap().to_owned();
    let pixels = told(&[picture, "--min-region", "5", "--labels", &kept], "pixels");
    assert_eq!(told(&[&kept, "--method", "labels"], "pixels"), pixels);
    assert_eq!(told(&[picture, "--method", "labels"], "pixels"), [856, 117, 197]);
    assert_eq!(
        told(&[picture, "--method", "labels"], "color"),
        ["#1e28b4", "#1ea028", "#c81e1e"].map(Value::from)
    );
    let run = medial_with(&["segment", "-", "--mask", "-"], "");
    assert_eq!(run.status, Some(2), "{}", run.errors);
    assert!(run.errors.contains("standard input is named twice"), "{}", run.errors);
    // The ground is chosen by a click alone.
    let words = ["--method", "labels", "--layers", "border", "--to", "csv"];
    let run = medial(&[&["image", path.to_str().unwrap()], &words[..]].concat());
    assert_eq!((run.status, run.text().lines().count()), (Some(0), 4), "{}", run.errors);
    let run =
        medial(&[&["image", path.to_str().unwrap(), "--at", "2.5,-0.5"], &words[..]].concat());
    assert_eq!((run.status, run.text().lines().count()), (Some(0), 2), "{}", run.errors);
}

#[test]
fn masks_and_values_leave_pixels_out() {
    let folder = tempfile::tempdir().unwrap();
    let picture = picture(folder.path());
    let picture = picture.to_str().unwrap();
    let mask = folder.path().join("mask.png");
    let write = |columns: u32, is_in: &dyn Fn(u32) -> bool| {
        let mut encoder = png::Encoder::new(fs::File::create(&mask).unwrap(), columns, 30);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.set_depth(png::BitDepth::Eight);
        let samples: Vec<u8> = (0..columns * 30).map(|k| u8::from(is_in(k))).collect();
        encoder.write_header().unwrap().write_image_data(&samples).unwrap();
    };
    // Without the lower part.
    write(40, &|k| k / 40 < 24);
    let words = [picture, "--min-region", "5", "--mask", mask.to_str().unwrap()];
    assert_eq!(told(&words, "pixels"), [39 * 24 - 197, 197]);
    write(39, &|_| true);
    let run = medial(&[&["segment"], &words[..]].concat());
    assert_eq!((run.status, run.text()), (Some(1), ""));
    assert!(run.errors.contains("mask.png: has 39 by 30 pixels, "), "{}", run.errors);
    write(40, &|_| false);
    let run = medial(&[&["segment"], &words[..]].concat());
    assert_eq!(run.status, Some(1));
    assert!(run.errors.contains("has no pixel with data"), "{}", run.errors);
    // Without the ground.
    let words = [picture, "--min-region", "5", "--no-data", "1e28b4"];
    assert_eq!(told(&words, "pixels"), [197, 117]);
    let words = [picture, "--bands", "1", "--no-data", "30", "--min-region", "5"];
    assert_eq!(told(&words, "pixels"), [197]);
}
