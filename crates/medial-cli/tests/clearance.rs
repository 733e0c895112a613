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

#[test]
fn spacings_between_features_name_both() {
    let two = "POLYGON ((0 0, 2 0, 2 2, 0 2, 0 0))\n\
               MULTIPOLYGON (((9 9, 8 9, 9 8, 9 9)), ((5 0, 8 0, 8 3, 5 3, 5 0)))\n";
    let words = ["clearance", "-", "--side", "exterior", "--together", "--min", "3.5"];
    let spacings = features(&words, two);
    assert_eq!(spacings.len(), 1);
    let told = |name: &str| spacings[0]["properties"][name].as_u64().unwrap();
    let mut named = ["left", "right"]
        .map(|side| (told(&format!("{side}_feature")), told(&format!("{side}_polygon"))));
    named.sort_unstable();
    assert_eq!((named, &spacings[0]["properties"]["width"]), ([(0, 0), (1, 1)], &3.0.into()));
    // By itself none of them has a spacing of 3.
    let alone = features(&["clearance", "-", "--side", "exterior", "--min", "3.5"], two);
    assert_eq!(alone.len(), 0);
    // A bad feature is left out; features that cross are told.
    let bad = format!("{two}POLYGON ((0 0, 1 1))\n");
    let run = medial_with(&words, &bad);
    assert_eq!((run.status, run.json()["features"].as_array().unwrap().len()), (Some(3), 1));
    let crossing = format!("{two}POLYGON ((7 1, 12 1, 12 2, 7 2, 7 1))\n");
    let run = medial_with(&words, &crossing);
    assert_eq!((run.status, run.text()), (Some(1), ""));
    assert!(
        run.errors.contains("of feature 2") || run.errors.contains("of feature 1"),
        "{}",
        run.errors
    );
}

#[test]
fn a_profile_tells_the_width_along_the_main_line() {
    let stations = features(&["clearance", "-", "--profile"], DUMBBELL);
    let told = |name: &str| -> Vec<f64> {
        let told = |station: &Value| station["properties"][name].as_f64().unwrap();
        stations.iter().map(told).collect()
    };
    let (along, widths) = (told("station"), told("width"));
    assert!(along[0] == 0.0 && along.is_sorted(), "{along:?}");
    let neck = widths.iter().position(|&width| width == 2.0).unwrap();
    assert_eq!((told("x")[neck], told("y")[neck]), (5.0, 2.0));
    assert_eq!(stations[neck]["geometry"]["coordinates"], serde_json::json!([5.0, 2.0]));
    // The line is that of another command.
    let line = &features(&["centerline", "-"], DUMBBELL)[0]["properties"];
    assert!((line["length"].as_f64().unwrap() - along[along.len() - 1]).abs() < 1e-12);
    assert_eq!(line["width_min"].as_f64(), widths.iter().copied().reduce(f64::min));
    let count = |tolerance: &str| {
        let words = ["clearance", "-", "--profile", "--tolerance", tolerance, "--to", "csv"];
        let run = medial_with(&words, DUMBBELL);
        assert!(run.text().starts_with("WKT,feature,id,engine,station,x,y,width\nPOINT ("));
        run.text().lines().count()
    };
    assert!(count("1") < count("0.0001"), "{} {}", count("1"), count("0.0001"));
}

#[test]
fn a_plot_is_drawn_of_profiles_alone() {
    let two = format!("{DUMBBELL}\n{DUMBBELL}\n");
    let plot = medial_with(&["clearance", "-", "--profile", "--to", "svg"], &two);
    assert_eq!((plot.status, plot.errors.as_str()), (Some(0), ""));
    assert!(plot.text().starts_with("<svg") && plot.text().contains(">feature 1<"));
    assert!(plot.text().contains(">2 at "));
    let necks = medial_with(&["clearance", "-", "--to", "svg"], DUMBBELL);
    assert_eq!(necks.status, Some(2));
    assert!(necks.errors.contains("svg is the plot of --profile"), "{}", necks.errors);
    let wrong: [&[&str]; 4] = [
        &["--profile", "--min", "2"],
        &["--profile", "--largest"],
        &["--tolerance", "1"],
        &["--profile", "--side", "both"],
    ];
    for words in wrong {
        assert_eq!(medial_with(&[&["clearance", "-"], words].concat(), DUMBBELL).status, Some(2));
    }
}
