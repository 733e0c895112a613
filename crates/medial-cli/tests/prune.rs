//! `medial prune`, as a user meets it.

mod common;

use common::{fixture, medial, medial_with};
use serde_json::Value;

const RECTANGLE: &str = "POLYGON ((0 0, 6 0, 6 2, 0 2, 0 0))";

fn axis(args: &[&str]) -> Value {
    let words = [&["prune", "-", "--to", "json"], args].concat();
    let run = medial_with(&words, RECTANGLE);
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    serde_json::from_str(run.text()).unwrap()
}

#[test]
fn branches_below_an_error_are_removed() {
    let pruned = axis(&["--max-error", "0.5"]);
    assert_eq!(pruned["complete"], false);
    let kinds: Vec<&Value> =
        pruned["keypoints"].as_array().unwrap().iter().map(|k| &k["kind"]).collect();
    assert_eq!(kinds, ["tip", "tip"]);
    assert_eq!(pruned, axis(&["--prune", "excess=0.5"]));
    // More than the corners are worth.
    assert_eq!(axis(&["--max-error", "0"])["complete"], true);
}

#[test]
fn every_measure_is_known() {
    let measures = "excess relative_excess potential chord circularity erosion length angle \
                    half_chord radius prominence";
    for name in measures.split_whitespace() {
        let pruned = axis(&["-q", "--prune", &format!("{name}=1e9")]);
        // The root stays.
        assert_eq!(pruned["keypoints"].as_array().unwrap().len(), 1, "{name}");
        assert_eq!(pruned["keypoints"][0]["x"], 3.0, "{name}");
    }
}

#[test]
fn what_is_pruned_to_a_point_is_a_point() {
    let source = r#"{"type": "Feature", "properties": {"kind": "shed"}, "geometry": {"type": "Polygon",
        "coordinates": [[[0, 0], [6, 0], [6, 2], [0, 2], [0, 0]]]},
        "crs": {"type": "name", "properties": {"name": "EPSG:3857"}}}"#;
    let run = medial_with(&["prune", "-", "--from", "geojson", "--max-error", "9"], source);
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    let all: Value = serde_json::from_str(run.text()).unwrap();
    let features = all["features"].as_array().unwrap();
    assert_eq!(features.len(), 1);
    assert_eq!(features[0]["geometry"]["type"], "Point");
    assert_eq!(features[0]["geometry"]["coordinates"], serde_json::json!([3.0, 1.0]));
    let properties = &features[0]["properties"];
    assert_eq!((&properties["kind"], &properties["source_kind"]), (&"tip".into(), &"shed".into()));
    assert_eq!((&properties["radius"], &properties["degree"]), (&1.0.into(), &0.into()));
}

#[test]
fn what_is_pruned_is_judged_like_any_axis() {
    let river = fixture("river.geojson").display().to_string();
    let pruned = medial(&[
        "axis",
        &river,
        "--side",
        "both",
        "--frame",
        "1e6",
        "--max-error",
        "3",
        "--to",
        "json",
    ]);
    assert_eq!((pruned.status, pruned.errors.as_str()), (Some(0), ""));
    let run = medial_with(&["check", &river, "-"], pruned.text());
    assert_eq!(run.status, Some(0), "{}", run.text());
    assert!(run.text().contains("tips where it was cut or pruned"), "{}", run.text());
}

#[test]
fn wrong_usage_is_told_in_one_line() {
    for (args, told) in [
        (&[][..], "say what to remove"),
        (&["--prune", "excess"][..], "MEASURE=VALUE is needed"),
        (&["--prune", "beauty=2"][..], "no measure; known are excess"),
        (&["--prune", "chord=-2"][..], "not negative"),
        (&["--prune", "chord=2", "--max-error", "1"][..], "cannot be used with"),
        (&["--max-error", "1", "--measures", "chord,angle,chord"][..], "has chord twice"),
    ] {
        let words = [&["prune", "-"], args].concat();
        let run = medial_with(&words, RECTANGLE);
        assert_eq!((run.status, run.out.len()), (Some(2), 0), "{args:?}");
        assert!(run.errors.contains(told) && run.errors.lines().count() == 1, "{}", run.errors);
    }
}

#[test]
fn both_sides_are_pruned_within_any_frame() {
    let dent = "POLYGON ((0 0, 100 0, 100 100, 50 99, 0 100, 0 0))";
    let pruned =
        medial_with(&["prune", "-", "--side", "both", "--max-error", "3", "--to", "json"], dent);
    assert_eq!((pruned.status, pruned.errors.as_str()), (Some(0), ""));
    assert_eq!(pruned.text().lines().count(), 2);
}

#[test]
fn axis_documents_are_pruned_like_their_polygons() {
    let whole = medial_with(&["axis", "-", "--to", "json"], RECTANGLE);
    let words = ["prune", "-", "--max-error", "0.5", "--to", "json"];
    let [one, other] = [whole.text(), RECTANGLE].map(|text| medial_with(&words, text));
    assert_eq!((one.status, one.errors.as_str(), one.text()), (Some(0), "", other.text()));
    // Values of what was pruned before are not known.
    let twice = medial_with(&words, one.text());
    assert_eq!(twice.status, Some(1));
    assert!(twice.errors.contains("pruned"), "{}", twice.errors);
}

#[test]
fn measures_that_do_not_grow_warn() {
    let angle = medial_with(&["prune", "-", "--prune", "angle=1", "--to", "wkt"], RECTANGLE);
    assert_eq!(angle.status, Some(0));
    assert!(angle.errors.starts_with("warning: angle does not grow"), "{}", angle.errors);
    let quiet = medial_with(&["prune", "-", "--prune", "angle=1", "-q", "--to", "wkt"], RECTANGLE);
    assert_eq!(quiet.errors, "");
}

#[test]
fn nodes_and_edges_are_tables() {
    let folder = tempfile::tempdir().unwrap();
    let nodes = folder.path().join("nodes.csv").display().to_string();
    let edges = medial_with(&["axis", "-", "--to", "csv", "--nodes", &nodes], RECTANGLE);
    assert_eq!((edges.status, edges.errors.as_str()), (Some(0), ""));
    let nodes = std::fs::read_to_string(nodes).unwrap();
    assert_eq!((edges.text().lines().count(), nodes.lines().count()), (1 + 5, 1 + 6));
    assert_eq!(nodes.lines().next(), Some("WKT,feature,id,keypoint,x,y,radius,kind,degree,side"));
    assert!(nodes.contains("POINT (1 1),0,,") && nodes.contains(",1,1,1,junction,3,interior"));
}
