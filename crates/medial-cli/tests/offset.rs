//! `medial offset`, as a user meets it.

mod common;

use common::medial_with;
use serde_json::Value;

const TWO: &str = "MULTIPOLYGON (((0 0, 6 0, 6 2, 0 2, 0 0)), ((8 0, 10 0, 10 2, 8 2, 8 0)))";

#[test]
fn distances_are_written_in_their_order() {
    let run = medial_with(&["offset", "-", "--distance", "-1,0.5,5,0,-0.5"], TWO);
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    let all: Value = serde_json::from_str(run.text()).unwrap();
    let told = |name: &str| -> Vec<f64> {
        let features = all["features"].as_array().unwrap().iter();
        features.map(|f| f["properties"][name].as_f64().unwrap()).collect()
    };
    // At 5 nothing is left.
    assert_eq!(told("distance"), [-1.0, 0.5, 0.0, -0.5]);
    assert_eq!(told("n_polygons"), [1.0, 2.0, 2.0, 2.0]);
    assert_eq!(told("area")[1..3], [6.0, 16.0]);
    assert_eq!(told("length")[1], 16.0);
}

#[test]
fn arcs_are_flattened_within_the_tolerance() {
    let lengths = ["0.1", "1e-6"].map(|tolerance| {
        let words = ["offset", "-", "--distance=-1", "--tolerance", tolerance, "--to", "rings"];
        let rings: Value = serde_json::from_str(medial_with(&words, TWO).text()).unwrap();
        rings[0].as_array().map(Vec::len)
    });
    assert!(lengths[0] < lengths[1], "{lengths:?}");
}

#[test]
fn documents_and_pictures_keep_arcs() {
    let json = medial_with(&["offset", "-", "--distance=-0.5", "--to", "json"], TWO);
    let document: Value = serde_json::from_str(json.text()).unwrap();
    assert_eq!(document["polygons"].as_array().unwrap().len(), 2);
    let strokes = document["polygons"][0][0].as_array().unwrap();
    assert_eq!(strokes.iter().filter(|stroke| stroke["kind"] == "arc").count(), 4);
    let svg = medial_with(&["offset", "-", "--distance=-0.5,0.25", "--to", "svg"], TWO);
    assert!(svg.text().contains("<g class=\"offsets\""), "{}", svg.text());
    let both = medial_with(
        &["offset", "-", "--distance=-0.5", "--to", "json", "--engine", "divide_and_conquer"],
        TWO,
    );
    let other: Value = serde_json::from_str(both.text()).unwrap();
    assert_eq!(other["polygons"], document["polygons"]);
}

#[test]
fn wrong_usage_is_told_in_one_line() {
    for (args, told) in [
        (&[][..], "--distance"),
        (&["--distance", "a"][..], "a finite number is needed"),
        (&["--distance", "1e-99"][..], "2^-200"),
        (&["--distance", "1", "--to", "json", "--tolerance", "1"][..], "arcs are exact in json"),
        (&["--distance", "1", "--to", "png"][..], "not as png"),
    ] {
        let words = [&["offset", "-"], args].concat();
        let run = medial_with(&words, TWO);
        assert_eq!((run.status, run.out.len()), (Some(2), 0), "{args:?}");
        assert!(run.errors.contains(told) && run.errors.lines().count() == 1, "{}", run.errors);
    }
}
