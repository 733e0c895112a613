//! Images as masks, as a user meets them.

mod common;

use common::{fixture, medial};
use serde_json::Value;
use std::fs;
use std::path::PathBuf;

fn lines(text: &str) -> Vec<Value> {
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// A grey PNG image of rows of characters, `#` for 255.
fn png(folder: &tempfile::TempDir, name: &str, rows: &[&str]) -> PathBuf {
    let path = folder.path().join(name);
    let columns = rows[0].len() as u32;
    let file = fs::File::create(&path).unwrap();
    let mut encoder = png::Encoder::new(file, columns, rows.len() as u32);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_depth(png::BitDepth::Eight);
    let values: Vec<u8> = rows.concat().bytes().map(|b| if b == b'#' { 255 } else { 0 }).collect();
    encoder.write_header().unwrap().write_image_data(&values).unwrap();
    path
}

const PLUS: [&str; 11] = [
    "...........",
    "....###....",
    "....###....",
    "....###....",
    ".#########.",
    ".#########.",
    ".#########.",
    "....###....",
    "....###....",
    "....###....",
    "...........",
];

#[test]
fn an_image_has_branches() {
    let folder = tempfile::tempdir().unwrap();
    let image = png(&folder, "plus.png", &PLUS);
    let run = medial(&["axis", image.to_str().unwrap(), "--to", "geojsonl"]);
    assert_eq!(run.status, Some(0), "{}", run.errors);
    let read = lines(run.text());
    assert_eq!(read.len(), 4);
    for line in &read {
        let told = &line["properties"];
        assert_eq!(
            (&told["engine"], &told["curve"]),
            (&"raster_transform".into(), &"polyline".into())
        );
        assert_eq!(told["kind_end"].as_str().unwrap() == "junction", told["kind_start"] == "tip");
        assert!(told["radius_max"].as_f64().unwrap() >= 1.5);
        // Pixels from the upper left corner, y upwards.
        for point in line["geometry"]["coordinates"].as_array().unwrap() {
            let [x, y] = [0, 1].map(|k| point[k].as_f64().unwrap());
            assert!((1.0..10.0).contains(&x) && (-10.0..-1.0).contains(&y), "{x} {y}");
        }
    }
}

#[test]
fn the_exact_axis_of_the_outline_is_that_of_the_polygon() {
    let folder = tempfile::tempdir().unwrap();
    let image = png(&folder, "bar.png", &["......", ".####.", ".####.", "......"]);
    let exact = ["axis", image.to_str().unwrap(), "--engine", "path_tracing", "--to", "wkt"];
    let run = medial(&exact);
    assert_eq!(run.status, Some(0), "{}", run.errors);
    assert!(run.text().contains("(4 -2, 2 -2)"), "{}", run.text());
}

#[test]
fn documents_of_images_are_checked() {
    let folder = tempfile::tempdir().unwrap();
    let image = png(&folder, "plus.png", &PLUS);
    let document = folder.path().join("plus.json");
    for prune in [&[][..], &["--prune", "none"], &["--prune", "chord=0.5"]] {
        let (image, document) = (image.to_str().unwrap(), document.to_str().unwrap());
        let mut words = vec!["axis", image, "-o", document];
        words.extend(prune);
        let run = medial(&words);
        assert_eq!(run.status, Some(0), "{}", run.errors);
        let text = fs::read_to_string(document).unwrap();
        let read: Value = serde_json::from_str(&text).unwrap();
        assert_eq!(read["accuracy"]["sampled"], 1.0);
        let path = &read["paths"][0];
        assert!(path["points"].as_array().is_some_and(|points| points.len() > 1), "{path}");
        let run = medial(&["check", image, document]);
        assert_eq!(run.status, Some(0), "{prune:?}: {} {}", run.text(), run.errors);
    }
}

#[test]
fn thresholds_and_their_inverse_choose_the_shape() {
    let folder = tempfile::tempdir().unwrap();
    let image = png(&folder, "bar.png", &["######", "#....#", "######"]);
    let count = |more: &[&str]| {
        let mut words = vec!["axis", image.to_str().unwrap(), "--to", "geojsonl"];
        words.extend(more);
        let run = medial(&words);
        (run.status, run.text().lines().count())
    };
    // A ring; the bar in it, which is one line or a point; nothing.
    assert_eq!(count(&[]), (Some(0), 1));
    assert_eq!(count(&["--invert"]), (Some(0), 1));
    assert_eq!(count(&["--threshold", "300"]), (Some(1), 0));
}

#[test]
fn bands_and_outlines_that_nobody_needs_change_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let image = png(&folder, "plus.png", &PLUS);
    for format in ["geojson", "geojsonl", "json", "wkt", "csv", "dxf"] {
        let words = ["axis", image.to_str().unwrap(), "--to", format];
        let usual = medial(&words);
        assert_eq!(usual.status, Some(0), "{format}: {}", usual.errors);
        assert!(usual.text().len() > 100, "{format}");
        // To count vertices the outline is needed.
        for more in [&["--band-rows", "2"][..], &["--max-vertices", "1000"]] {
            let run = medial(&[&words[..], more].concat());
            assert_eq!(run.text(), usual.text(), "{format} {more:?}");
        }
    }
    let run = medial(&["axis", image.to_str().unwrap(), "--max-vertices", "11"]);
    assert_eq!(run.status, Some(1), "{}", run.errors);
    assert!(run.errors.contains("12 vertices"), "{}", run.errors);
}

#[test]
fn every_operation_takes_images() {
    let folder = tempfile::tempdir().unwrap();
    let image = png(&folder, "plus.png", &PLUS);
    let image = image.to_str().unwrap();
    for words in [
        &["prune", image, "--max-error", "0.5"][..],
        &["branches", image, "--to", "csv"],
        &["axis", image, "--measures", "erosion,chord"],
        &["axis", image, "--engine", "raster-transform", "--prune", "erosion=0.5"],
        &["centerline", image],
        &["smooth", image],
        &["reconstruct", image],
        &["offset", image, "--distance", "0.5"],
        &["clearance", image],
        &["walls", image, "--max", "4"],
        &["compare", image, "--to", "text"],
        &["axis", image, "--to", "svg"],
    ] {
        let run = medial(words);
        assert_eq!(run.status, Some(0), "{words:?}: {}", run.errors);
        assert!(!run.text().is_empty(), "{words:?}");
    }
}

#[test]
fn polygons_are_put_into_cells() {
    let file = fixture("shapes/l_with_unit_arms.wkt");
    let file = file.to_str().unwrap();
    let run =
        medial(&["axis", file, "--engine", "raster-transform", "--cell", "0.02", "--to", "wkt"]);
    assert_eq!(run.status, Some(0), "{}", run.errors);
    let run = medial(&["axis", file, "--engine", "raster-transform", "--cell", "1e-9"]);
    assert_eq!(run.status, Some(1));
    assert!(run.errors.contains("give a larger cell"), "{}", run.errors);
    let run = medial(&["axis", file, "--engine", "raster-transform", "--side", "exterior"]);
    assert!(run.errors.contains("use path_tracing"), "{}", run.errors);
}

#[test]
fn a_silhouette_has_few_branches() {
    let horse = fixture("images/horse.png");
    let run = medial(&["branches", horse.to_str().unwrap(), "--invert", "--to", "geojsonl"]);
    assert_eq!(run.status, Some(0), "{}", run.errors);
    let read = lines(run.text());
    assert!((20..40).contains(&read.len()), "{}", read.len());
    // The body is the thickest part.
    let most = read.iter().filter_map(|line| line["properties"]["radius_max"].as_f64());
    assert!((most.fold(0.0, f64::max) - 52.8).abs() < 0.2);
    let exact =
        ["axis", horse.to_str().unwrap(), "--invert", "--engine", "path_tracing", "--to", "csv"];
    assert!(medial(&exact).text().lines().count() > 1000);
}

#[test]
fn all_engines_on_cells_take_images_and_polygons() {
    let folder = tempfile::tempdir().unwrap();
    let image = png(&folder, "plus.png", &PLUS);
    let l = fixture("shapes/l_with_unit_arms.wkt");
    for options in [
        &["--engine", "ridge-following"][..],
        &["--engine", "ridge-following", "--search", "sorted", "--thinning", "report"],
        &["--engine", "brushfire"],
        &["--engine", "brushfire", "--burning", "zhang-suen"],
    ] {
        for (file, cell) in [(&image, None), (&l, Some("0.02"))] {
            let mut words = vec!["axis", file.to_str().unwrap(), "--to", "geojsonl"];
            words.extend(options);
            words.extend(cell.iter().flat_map(|&cell| ["--cell", cell]));
            let run = medial(&words);
            assert_eq!(run.status, Some(0), "{words:?}: {}", run.errors);
            assert!(lines(run.text()).iter().all(|line| line["properties"]["curve"] == "polyline"));
        }
    }
    let outside = ["axis", l.to_str().unwrap(), "--engine", "ridge-following", "--side", "both"];
    assert_eq!(medial(&outside).status, Some(0));
    let run = medial(&["axis", l.to_str().unwrap(), "-o", "l.tiff"]);
    assert_eq!(run.status, Some(2), "{}", run.errors);
    let run = medial(&["axis", l.to_str().unwrap(), "--burning", "isotropic"]);
    assert_eq!(run.status, Some(2));
    assert!(run.errors.contains("--burning is for --engine brushfire"), "{}", run.errors);
}
