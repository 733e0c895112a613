//! `medial compress`, as a user meets it.

mod common;

use common::{fixture, medial, medial_with, names};
use medial::axis::Accuracy;
use medial::ops::Compressed;
use medial_io::maxis;
use serde_json::Value;

const RECTANGLE: &str = "POLYGON ((0 0, 6 0, 6 2, 0 2, 0 0))";

/// The rows of sizes, and the file.
fn compressed(input: &str, max_error: &str) -> (Vec<Value>, Vec<u8>) {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("out.maxis");
    let words = ["compress", input, "--max-error", max_error, "-o", file.to_str().unwrap()];
    let run = medial(&words);
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    let rows = run.text().lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    (rows, std::fs::read(file).unwrap())
}

#[test]
fn the_river_takes_a_fraction_of_its_wkb() {
    let river = fixture("river.geojson").display().to_string();
    for (max_error, least, stored) in
        [("0", 5.0, "corners"), ("0.1", 8.0, "disks"), ("1", 30.0, "disks")]
    {
        let (rows, file) = compressed(&river, max_error);
        let [feature, all] = &rows[..] else { panic!("{rows:?}") };
        assert_eq!((&feature["stored"], &all["feature"]), (&stored.into(), &Value::Null));
        assert_eq!(all["maxis"], file.len());
        assert!(all["deflated_ratio"].as_f64().unwrap() > least, "{all}");
        let error = feature["error"].as_f64().unwrap();
        assert!(error <= max_error.parse().unwrap(), "{feature}");
        let axis = maxis::read(&file).unwrap().next().unwrap().unwrap().axis;
        match stored {
            "disks" => assert_eq!(axis.accuracy, Accuracy::Sampled(error)),
            _ => assert!(axis.complete && axis.accuracy == Accuracy::Exact),
        }
    }
}

#[test]
fn without_an_error_every_corner_is_kept_bit_for_bit() {
    for (name, format) in [
        ("river.geojson", medial_io::Format::GeoJson),
        ("lake.rings", medial_io::Format::Rings),
        ("boost_failures.wkt", medial_io::Format::Wkt),
    ] {
        let path = fixture(name);
        let (rows, file) = compressed(path.to_str().unwrap(), "0");
        let bytes = std::fs::read(&path).unwrap();
        let mut records = maxis::records(&file).unwrap();
        for feature in medial_io::read(format, &bytes).unwrap() {
            let (feature, record) = (feature.unwrap(), records.next().unwrap().unwrap());
            let Compressed::Corners(corners) = record.shape else { panic!("{name} has disks") };
            assert_eq!(corners.polygons, feature.polygons);
            assert_eq!(record.feature, feature.index);
        }
        assert!(records.next().is_none());
        let all = rows.last().unwrap();
        assert!(all["deflated_ratio"].as_f64().unwrap() > 1.0, "{name}: {all}");
    }
}

#[test]
fn what_is_left_out_has_no_number() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("out.maxis");
    let mixed = fixture("mixed.geojson").display().to_string();
    let run =
        medial(&["compress", &mixed, "--max-error", "0.1", "-q", "-o", file.to_str().unwrap()]);
    assert_eq!(run.status, Some(3));
    let file = std::fs::read(file).unwrap();
    let numbers: Vec<usize> = maxis::records(&file).unwrap().map(|r| r.unwrap().feature).collect();
    let rows: Vec<Value> =
        run.text().lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let told: Vec<usize> =
        rows.iter().filter_map(|row| row["feature"].as_u64()).map(|n| n as usize).collect();
    assert!(numbers == told && numbers.len() == 3, "{numbers:?} {told:?}");
}

#[test]
fn sizes_come_in_three_forms() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("out.maxis");
    let told = |form: &str| {
        let out = ["-o", file.to_str().unwrap(), "--sizes", form];
        let words = [&["compress", "-", "--max-error", "0.5"][..], &out].concat();
        let run = medial_with(&words, RECTANGLE);
        assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
        run.text().to_owned()
    };
    assert!(told("csv").starts_with("feature,id,stored,error,corners,disks,maxis,wkb,"));
    assert_eq!(told("csv").lines().count(), 3);
    assert!(told("text").lines().last().unwrap().starts_with("all: "));
    assert_eq!(told("json").lines().count(), 2);
    assert_eq!(names(folder.path()), ["out.maxis"]);
}

#[test]
fn without_a_file_the_bytes_go_to_standard_output() {
    let run = medial_with(&["compress", "-", "--max-error", "0"], RECTANGLE);
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    assert_eq!(maxis::records(&run.out).unwrap().count(), 1);
}

#[test]
fn wrong_usage_is_told_in_one_line() {
    for (args, told) in [
        (&["compress", "-"][..], "--max-error"),
        (&["compress", "-", "--max-error", "-1"][..], "not negative"),
        (&["compress", "-", "--max-error", "1", "-o", "a.json"][..], "written as maxis"),
        (&["axis", "-", "-o", "a.maxis"][..], "written by `medial compress`"),
    ] {
        let run = medial_with(args, RECTANGLE);
        assert_eq!((run.status, run.out.len()), (Some(2), 0), "{args:?}");
        assert!(run.errors.contains(told) && run.errors.lines().count() == 1, "{}", run.errors);
    }
}

#[test]
fn a_compressed_axis_is_no_polygon() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("out.maxis");
    let file = file.to_str().unwrap();
    medial_with(&["compress", "-", "--max-error", "0", "-o", file], RECTANGLE);
    let run = medial(&["axis", file]);
    assert_eq!(run.status, Some(1));
    assert!(run.errors.contains("is a compressed axis; polygons are needed"), "{}", run.errors);
}

#[test]
fn simplified_corners_take_fewer_bytes_where_that_is_wanted() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("out.maxis");
    let lake = fixture("lake.rings").display().to_string();
    let all = |more: &[&str]| {
        let out = ["--max-error", "0.5", "-o", file.to_str().unwrap()];
        let words = [&["compress", &lake][..], &out, more].concat();
        let run = medial(&words);
        assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
        let rows: Vec<Value> =
            run.text().lines().map(|line| serde_json::from_str(line).unwrap()).collect();
        (rows[0]["stored"].clone(), rows[1]["maxis"].as_u64().unwrap())
    };
    let (plain, simplified) = (all(&[]), all(&["--simplify"]));
    assert!(simplified.1 <= plain.1, "{plain:?} {simplified:?}");
}

#[test]
fn points_that_many_polygons_share_are_found_again() {
    let strip = |k: u32| {
        let at = |x: u32, y: u32| format!("{} {}", f64::from(x).sqrt(), f64::from(y).sqrt() / 3.0);
        let corners = [at(k, 2), at(k + 1, 2), at(k + 1, 7), at(k, 7), at(k, 2)];
        format!("(({}))", corners.join(", "))
    };
    let polygons: Vec<String> = (1..40).map(strip).collect();
    let text = format!("MULTIPOLYGON ({})", polygons.join(", "));
    let run = medial_with(&["compress", "-", "--max-error", "0"], &text);
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    let record = maxis::records(&run.out).unwrap().next().unwrap().unwrap();
    let Compressed::Corners(corners) = record.shape else { panic!("these are no corners") };
    let given = medial_io::wkt::read(&text).next().unwrap().unwrap();
    assert_eq!(corners.polygons, given.polygons);
    // The numbers of a point take 16 bytes, and each is there in two polygons.
    assert!(run.out.len() < 40 * 2 * 16 + 600, "{}", run.out.len());
}
