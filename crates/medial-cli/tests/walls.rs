//! `medial walls`, as a user meets it.

mod common;

use common::medial_with;

const BLOCK: &str = "POLYGON ((0 0, 4 0, 4 1, 9 1, 9 2, 4 2, 4 4, 0 4, 0 0))";

#[test]
fn a_wall_is_a_line_with_the_width_as_third_coordinate() {
    let run = medial_with(&["walls", "-", "--min", "0.5", "--max", "1"], BLOCK);
    let walls = run.json()["features"].as_array().unwrap().clone();
    assert_eq!(walls.len(), 1);
    let told = &walls[0]["properties"];
    let values = ["length", "width_min", "width_max", "width_mean"].map(|name| told[name].as_f64());
    assert_eq!((values, &told["closed"]), ([4.5, 1.0, 1.0, 1.0].map(Some), &false.into()));
    let line = serde_json::json!([[4.0, 1.5, 1.0], [8.5, 1.5, 1.0]]);
    assert_eq!(walls[0]["geometry"]["coordinates"], line);
    let wkt = medial_with(&["walls", "-", "--max", "1", "--to", "wkt"], BLOCK);
    assert_eq!(wkt.text(), "LINESTRING Z (4 1.5 1, 8.5 1.5 1)\n");
    let wkb = medial_with(&["walls", "-", "--max", "1", "--to", "wkb"], BLOCK);
    let numbers = [4.0, 1.5, 1.0, 8.5, 1.5, 1.0];
    let mut bytes = vec![1, 0xea, 3, 0, 0, 2, 0, 0, 0];
    bytes.extend(numbers.iter().flat_map(|v: &f64| v.to_le_bytes()));
    assert_eq!(wkb.out, bytes);
    let dot = "POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0))";
    let wkt = medial_with(&["walls", "-", "--max", "1", "--to", "wkt"], dot);
    assert_eq!(wkt.text(), "POINT Z (0.5 0.5 1)\n");
}

#[test]
fn ends_are_kept_on_request_and_limits_are_checked() {
    let count = |words: &[&str]| {
        let all = [&["walls", "-", "--max", "1"], words].concat();
        medial_with(&all, BLOCK).json()["features"].as_array().unwrap().len()
    };
    assert!(count(&["--ends", "0"]) > count(&[]));
    let run = medial_with(&["walls", "-", "--min", "2", "--max", "1"], BLOCK);
    assert_eq!(run.status, Some(2));
    assert!(run.errors.contains("--min 2 is more than --max 1"), "{}", run.errors);
    let run = medial_with(&["walls", "-", "--max", "1", "--to", "svg"], BLOCK);
    assert!(run.text().contains(">1 wall<") && run.text().contains("class=\"walls\""));
}
