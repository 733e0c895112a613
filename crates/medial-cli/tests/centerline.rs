//! `medial centerline`, as a user meets it.

mod common;

use common::{fixture, medial, medial_with};
use serde_json::{Value, json};

const T: &str = "POLYGON ((0 10, 0 8, 9 8, 9 0, 11 0, 11 8, 20 8, 20 10, 0 10))";

fn features(args: &[&str], input: &str) -> Vec<Value> {
    let words = [&["centerline", "-"], args].concat();
    let run = medial_with(&words, input);
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    let collection: Value = serde_json::from_str(run.text()).unwrap();
    collection["features"].as_array().unwrap().clone()
}

#[test]
fn lines_come_with_their_widths() {
    let lines = features(&["--count", "5", "--extend", "boundary"], T);
    assert_eq!(lines.len(), 2);
    for (rank, line) in (1..).zip(&lines) {
        let properties = &line["properties"];
        assert_eq!(properties["rank"], rank);
        assert_eq!(
            (&properties["closed"], &properties["is_longest"]),
            (&json!(false), &json!(true))
        );
        let n = line["geometry"]["coordinates"].as_array().unwrap().len();
        assert_eq!(properties["widths"].as_array().unwrap().len(), n);
        assert!((properties["width_min"].as_f64().unwrap() - 2.0).abs() < 1e-9, "{properties}");
        assert!(properties["width_mean"].as_f64().unwrap() < 2.3);
    }
    let length = |k: usize| lines[k]["properties"]["length"].as_f64().unwrap();
    assert!(length(0) > 19.9 && length(1) > 8.0 && length(1) < 9.5);
}

#[test]
fn the_river_has_one_line_in_every_format() {
    let river = fixture("river.geojson").display().to_string();
    let run = medial(&["centerline", &river, "--to", "wkt", "--z", "radius"]);
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    assert!(run.text().starts_with("MULTILINESTRING Z (("), "{}", run.text());
    assert_eq!(run.text().lines().count(), 1);
    let lines = medial(&["centerline", &river, "--to", "geojsonl"]);
    assert_eq!(lines.text().lines().count(), 1);
    let line: Value = serde_json::from_str(lines.text()).unwrap();
    assert_eq!(line["geometry"]["type"], "LineString");
}

#[test]
fn what_has_no_lines_is_no_format_for_them() {
    for format in ["csv", "svg", "json", "wkb"] {
        let run = medial_with(&["centerline", "-", "--to", format], T);
        assert_eq!((run.status, run.out.len()), (Some(2), 0), "{format}");
        assert!(run.errors.contains("centerlines are written as geojson"), "{}", run.errors);
    }
}
