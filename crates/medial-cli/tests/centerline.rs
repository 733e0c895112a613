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
        assert_eq!((&properties["closed"], &properties["is_best"]), (&json!(false), &json!(true)));
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
    for format in ["json", "wkb", "png"] {
        let run = medial_with(&["centerline", "-", "--to", format], T);
        assert_eq!((run.status, run.out.len()), (Some(2), 0), "{format}");
        assert!(run.errors.contains("centerlines are written as geojson"), "{}", run.errors);
    }
}

const L: &str = "POLYGON ((0 0, 10 0, 10 2, 2 2, 2 8, 0 8, 0 0))";

#[test]
fn a_label_stays_in_one_arm() {
    let short = "POLYGON ((0 0, 12 0, 12 2, 2 2, 2 4, 0 4, 0 0))";
    let labels = features(&["--for", "label", "--height", "1.9"], short);
    let longest = features(&[], short);
    let length = |line: &Value| line["properties"]["length"].as_f64().unwrap();
    assert_eq!(labels.len(), 1);
    assert!(length(&labels[0]) < 10.5 && length(&longest[0]) > 11.0);
    // Nothing is wide enough.
    let none = medial_with(&["centerline", "-", "--for", "label", "--height", "3"], L);
    assert_eq!(none.status, Some(1));
    assert!(none.errors.contains("feature 0: no line is wide enough"), "{}", none.errors);
}

#[test]
fn a_line_runs_between_points_and_on_to_them() {
    let ends = |args: &[&str]| {
        let line = features(args, L).remove(0);
        let points = line["geometry"]["coordinates"].as_array().unwrap().clone();
        let widths = line["properties"]["widths"].as_array().unwrap().clone();
        (points[0].clone(), points[points.len() - 1].clone(), widths)
    };
    let (first, last, widths) = ends(&["--between", "9,1.5,0,6", "--extend", "anchors"]);
    assert_eq!((first, last), (json!([9.0, 1.5]), json!([0.0, 6.0])));
    // Half of the way from the middle to the wall, and on it.
    assert_eq!((&widths[0], &widths[widths.len() - 1]), (&json!(1.0), &json!(0.0)));
    let anchors =
        ["--anchor", "5,0.5", "--anchor", "9,1.5", "--anchor", "0,6", "--extend", "anchors"];
    let (first, last, _) = ends(&anchors);
    assert_eq!((first, last), (json!([9.0, 1.5]), json!([0.0, 6.0])));
}

#[test]
fn a_feature_without_the_points_is_named() {
    let run = medial_with(&["centerline", "-", "--between", "-1,1,5,1"], L);
    assert_eq!((run.status, run.out.len()), (Some(1), 0));
    let told = "feature 0: the point (-1, 1) lies outside its box, from (0, 0) to (10, 8); \
                give a point inside";
    assert!(run.errors.contains(told), "{}", run.errors);
    let two = format!("{L}\nPOLYGON ((20 0, 26 0, 26 2, 20 2, 20 0))\n");
    let run = medial_with(&["centerline", "-", "--between", "3,1,9,1", "--to", "wkt"], &two);
    assert_eq!(run.status, Some(3));
    assert!(run.errors.contains("feature 1: the point (3, 1)"), "{}", run.errors);
    assert_eq!(run.text().lines().count(), 1);
}

#[test]
fn options_that_do_not_go_together_are_told() {
    let cases: [(&[&str], &str); 6] = [
        (&["--extend", "anchors"], "give them with --between or --anchor"),
        (&["--anchor", "1,1"], "give --anchor once more"),
        (&["--height", "1"], "say --for label too"),
        (&["--between", "1,1,2"], "X1,Y1,X2,Y2 is needed"),
        (&["--between", "1,1,2,2", "--count", "2"], "cannot be used with"),
        (&["--to", "svg", "--z", "radius"], "--z is for geojson"),
    ];
    for (args, told) in cases {
        let words = [&["centerline", "-"], args].concat();
        let run = medial_with(&words, L);
        assert_eq!((run.status, run.out.len()), (Some(2), 0), "{args:?}");
        assert!(run.errors.contains(told), "{}", run.errors);
    }
}

#[test]
fn smooth_and_simple_lines_have_their_own_widths() {
    let count = |args: &[&str]| {
        let line = features(args, L).remove(0);
        let n = line["geometry"]["coordinates"].as_array().unwrap().len();
        assert_eq!(line["properties"]["widths"].as_array().unwrap().len(), n);
        n
    };
    let exact = count(&[]);
    assert_eq!(count(&["--simplify", "0.5"]), 3);
    assert!(count(&["--smooth", "0.5"]) > 9);
    assert!(count(&["--smooth", "0.5", "--simplify", "0.01"]) < exact);
}

#[test]
fn tables_and_pictures_have_a_row_or_a_line_each() {
    let args = ["centerline", "-", "--count", "5", "--extend", "boundary"];
    let csv = medial_with(&[&args[..], &["--to", "csv"]].concat(), T);
    let rows: Vec<&str> = csv.text().lines().collect();
    assert_eq!(rows.len(), 3);
    assert!(rows[0].starts_with("WKT,feature,id,engine,rank,length,width_min"), "{}", rows[0]);
    assert!(rows[1].starts_with("\"LINESTRING ("), "{}", rows[1]);
    assert!(rows[2].contains(",0,,path_tracing,2,"), "{}", rows[2]);
    let svg = medial_with(&[&args[..], &["--to", "svg"]].concat(), T);
    assert!(svg.text().contains(">2 lines<"));
    let none =
        medial_with(&["centerline", "-", "--to", "csv", "--for", "label", "--height", "9"], T);
    assert_eq!((none.status, none.text()), (Some(1), ""));
}
