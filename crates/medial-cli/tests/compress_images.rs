//! Images compressed and rebuilt, as a user meets them.

mod common;

use common::{fixture, medial, medial_with, names};
use medial::raster::Mask;
use medial_io::{Format, ReadOptions, image};
use serde_json::Value;
use std::fs;
use std::path::Path;

fn mask(path: &Path, invert: bool) -> Mask {
    let options = ReadOptions { invert, ..ReadOptions::default() };
    image::read_mask(Format::Png, &fs::read(path).unwrap(), &options).unwrap().0
}

/// Compresses the horse and rebuilds it: the row of sizes, the bytes, and the cells that came back.
fn through(more: &[&str]) -> (Value, usize, Mask) {
    let folder = tempfile::tempdir().unwrap();
    let [file, back] = ["horse.maxis", "horse.png"].map(|name| folder.path().join(name));
    let horse = fixture("images/horse.png");
    let out = ["--invert", "-o", file.to_str().unwrap()];
    let words = [&["compress", horse.to_str().unwrap()][..], &out, more].concat();
    let run = medial(&words);
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""), "{more:?}");
    let row = serde_json::from_str(run.text().lines().next().unwrap()).unwrap();
    let run = medial(&["reconstruct", file.to_str().unwrap(), "-o", back.to_str().unwrap()]);
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""), "{more:?}");
    assert_eq!(names(folder.path()), ["horse.maxis", "horse.png"]);
    (row, fs::metadata(&file).unwrap().len() as usize, mask(&back, false))
}

#[test]
fn an_image_comes_back_cell_for_cell_where_nothing_is_pruned() {
    let horse = mask(&fixture("images/horse.png"), true);
    for more in [
        &["--prune", "none"][..],
        &["--max-error", "0"],
        &["--method", "cover"],
        &["--method", "squares"],
        &["--method", "crack"],
    ] {
        let (row, bytes, back) = through(more);
        assert!(back == horse, "{more:?}");
        assert_eq!((&row["error"], &row["xor"]), (&0.0.into(), &0.0.into()), "{more:?}");
        assert_eq!(row["maxis"], bytes, "{more:?}");
    }
}

#[test]
fn what_is_lost_is_told() {
    let horse = mask(&fixture("images/horse.png"), true);
    for (more, most) in [
        (&[][..], 0.02),
        (&["--max-error", "3"], 0.05),
        (&["--method", "cover", "--coverage", "0.99"], 0.010_000_1),
        (&["--method", "squares", "--max-error", "2"], 0.05),
    ] {
        let (row, _, back) = through(more);
        let lost = (horse.count() - back.count()) as f64 / horse.count() as f64;
        assert_eq!(row["xor"].as_f64(), Some(lost), "{more:?}");
        assert!(lost > 0.0 && lost < most, "{more:?}: {lost}");
        let rows = 0..horse.grid().rows;
        assert!(rows.into_iter().all(|y| back.cells(y).all(|x| horse.get(x, y))), "{more:?}");
        let error = row["error"].as_f64().unwrap();
        let asked = more.iter().position(|word| *word == "--max-error").map(|at| more[at + 1]);
        let most = asked.map_or(20.0, |word| word.parse().unwrap());
        assert!(error > 0.0 && error <= most, "{more:?}: {error}");
        assert!(row["png"].as_u64().unwrap() > 500);
    }
}

#[test]
fn an_outline_takes_the_fewest_bytes() {
    let sizes = ["chain", "cover", "squares", "crack"]
        .map(|method| through(&["--method", method]).0["maxis"].as_u64().unwrap());
    assert!(sizes[..3].iter().all(|&size| size > sizes[3]), "{sizes:?}");
}

#[test]
fn a_compressed_image_is_an_axis_and_an_outline() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("horse.maxis");
    let (horse, file) = (fixture("images/horse.png"), file.to_str().unwrap());
    medial(&["compress", horse.to_str().unwrap(), "--invert", "--method", "crack", "-o", file]);
    let run = medial(&["reconstruct", file, "--to", "csv"]);
    assert_eq!(run.status, Some(0), "{}", run.errors);
    let cells = mask(&horse, true).count();
    let row = run.text().lines().nth(1).unwrap();
    assert!(row.contains(&format!("crack,0,{cells}")), "{}", &row[..80]);
    medial(&["compress", horse.to_str().unwrap(), "--invert", "-o", file]);
    let axes: Vec<_> =
        medial_io::maxis::read(&fs::read(file).unwrap()).unwrap().map(Result::unwrap).collect();
    assert_eq!(axes.len(), 1);
    assert!(
        (axes[0].axis.keypoints().iter().map(|k| k.radius).fold(0.0, f64::max) - 52.8).abs() < 0.2
    );
}

#[test]
fn the_outline_of_an_image_is_compressed_by_an_exact_engine() {
    let horse = fixture("images/horse.png");
    let words = ["compress", horse.to_str().unwrap(), "--invert", "--engine", "path-tracing"];
    let run = medial(&[&words[..], &["--max-error", "0", "-o", "/dev/null"]].concat());
    let row: Value = serde_json::from_str(run.text().lines().next().unwrap()).unwrap();
    assert_eq!(
        (run.status, &row["stored"], &row["xor"]),
        (Some(0), &"corners".into(), &Value::Null)
    );
}

#[test]
fn wrong_usage_is_told_in_one_line() {
    let horse = fixture("images/horse.png");
    let horse = horse.to_str().unwrap();
    let square = "POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0))";
    for (words, told) in [
        (&["compress", horse, "--method", "hull"][..], "known are chain, cover, squares, crack"),
        (&["compress", horse, "--coverage", "0.9"], "--coverage is for --method cover and squares"),
        (
            &["compress", horse, "--method", "cover", "--prune", "none"],
            "--prune is for --method chain",
        ),
        (&["compress", horse, "--prune", "erosion=2"], "chord=VALUE or none"),
        (&["compress", horse, "--coverage", "1.5", "--method", "cover"], "from 0 to 1"),
        (&["compress", horse, "--simplify"], "--simplify is for corners"),
        (&["compress", "-", "--max-error", "1", "--method", "crack"], "are for cells of images"),
        (&["compress", "-"], "polygons need --max-error"),
    ] {
        let run = medial_with(words, square);
        assert_eq!((run.status, run.out.len()), (Some(2), 0), "{words:?}");
        assert!(run.errors.contains(told) && run.errors.lines().count() == 1, "{}", run.errors);
    }
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("square.maxis");
    let file = file.to_str().unwrap();
    medial_with(&["compress", "-", "--max-error", "0", "-o", file], square);
    let run = medial(&["reconstruct", file, "--to", "png"]);
    assert_eq!(run.status, Some(2));
    assert!(run.errors.contains("polygons are no PNG"), "{}", run.errors);
}

#[test]
fn damaged_files_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("horse.maxis");
    let (horse, path) = (fixture("images/horse.png"), file.to_str().unwrap());
    medial(&["compress", horse.to_str().unwrap(), "--invert", "-o", path]);
    let mut bytes = fs::read(&file).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    fs::write(&file, &bytes).unwrap();
    let out = folder.path().join("out.png");
    let run = medial(&["reconstruct", path, "-o", out.to_str().unwrap()]);
    assert_eq!(run.status, Some(1));
    assert!(run.errors.contains("checksum"), "{}", run.errors);
    assert_eq!(names(folder.path()), ["horse.maxis"]);
}
