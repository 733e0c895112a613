//! `medial clearance`, as a user meets it.

mod common;

use common::medial_with;
use serde_json::Value;

const DUMBBELL: &str = "POLYGON ((0 0, 4 0, 5 1, 6 0, 10 0, 10 4, 6 4, 5 3, 4 4, 0 4, 0 0))";

fn features(words: &[&str], text: &str) -> Vec<Value> {
    let run = medial_with(words, text);
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""), "{words:?}");
    run.json()["features"].as_array().unwrap().clone()
}

#[test]
fn a_neck_is_a_line_between_two_named_elements() {
    let necks = features(&["clearance", "-"], DUMBBELL);
    assert_eq!(necks.len(), 1);
    let told = |name: &str| necks[0]["properties"][name].clone();
    assert_eq!((told("width"), told("x"), told("y")), (2.0.into(), 5.0.into(), 2.0.into()));
    assert_eq!((told("left_kind"), told("right_kind")), ("vertex".into(), "vertex".into()));
    let mut named = [told("left_index").as_u64(), told("right_index").as_u64()];
    named.sort_unstable();
    assert_eq!(named, [Some(2), Some(7)]);
    assert_eq!(necks[0]["geometry"]["type"], "LineString");
    assert_eq!(features(&["clearance", "-", "--min", "2"], DUMBBELL).len(), 0);
}

#[test]
fn spacings_and_largest_disks_are_told_on_request() {
    let two = "MULTIPOLYGON (((0 0, 2 0, 2 2, 0 2, 0 0)), ((5 0, 8 0, 8 3, 5 3, 5 0)))";
    let spacings = features(&["clearance", "-", "--side", "exterior"], two);
    assert_eq!((spacings.len(), &spacings[0]["properties"]["width"]), (1, &3.0.into()));
    let polygon = |name: &str| spacings[0]["properties"][name].as_u64().unwrap();
    assert_eq!(polygon("left_polygon") + polygon("right_polygon"), 1);
    let largest = features(&["clearance", "-", "--largest"], two);
    assert_eq!(largest.len(), 1);
    assert_eq!(largest[0]["geometry"]["coordinates"], serde_json::json!([6.5, 1.5]));
    let wkt = medial_with(&["clearance", "-", "--largest", "--to", "wkt"], two);
    assert_eq!(wkt.text(), "POINT (6.5 1.5)\n");
    // All of the spine of a rectangle is as wide.
    let spine = features(&["clearance", "-", "--largest"], "POLYGON ((0 0, 6 0, 6 2, 0 2, 0 0))");
    let told = |name: &str| spine[0]["properties"][name].as_f64();
    let known = [2.0, 4.0, 3.0, 1.0].map(Some);
    assert_eq!((spine.len(), ["width", "length", "x", "y"].map(told)), (1, known));
    assert_eq!(spine[0]["geometry"]["type"], "LineString");
    assert_eq!(spine[0]["geometry"]["coordinates"].as_array().unwrap().len(), 2);
    let both = medial_with(&["clearance", "-", "--largest", "--min", "2"], two);
    assert_eq!(both.status, Some(2));
}
