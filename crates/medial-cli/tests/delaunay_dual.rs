//! The engine `delaunay_dual` as a user meets it: polygons, images, points.

mod common;

use common::{fixture, medial, medial_with};
use serde_json::Value;
use std::fs;

const RECTANGLE: &str = "POLYGON ((0 0, 6 0, 6 2, 0 2, 0 0))";

const ENGINE: [&str; 2] = ["--engine", "delaunay-dual"];

#[test]
fn a_polygon_has_the_branches_of_its_axis_and_no_defect() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (domain, axis, report) = (path("a.wkt"), path("a.json"), path("report.json"));
    fs::write(&domain, RECTANGLE).unwrap();
    let args = ["axis", &domain, "--spacing", "0.25", "-o", &axis, "--report", &report];
    let run = medial(&[&args[..], &ENGINE].concat());
    assert_eq!(run.status, Some(0), "{}", run.errors);
    let told: Value = serde_json::from_str(&fs::read_to_string(&axis).unwrap()).unwrap();
    assert_eq!(told["engine"], "delaunay_dual");
    assert_eq!(told["accuracy"]["sampled"], 0.25);
    let checked = medial(&["check", &domain, &axis]);
    assert_eq!(checked.status, Some(0), "{}", checked.text());
    let report: Value = serde_json::from_str(&fs::read_to_string(&report).unwrap()).unwrap();
    let entry = &report["features"][0]["entries"][0];
    assert_eq!((&entry["action"], &entry["code"]), (&"sampled".into(), &"sampling".into()));
    assert!(entry["message"].as_str().unwrap().starts_with("64 samples"), "{entry}");
    let lines = medial_with(
        &[&["axis", "-", "--spacing", "0.25", "--to", "geojsonl"][..], &ENGINE].concat(),
        RECTANGLE,
    );
    assert_eq!(lines.text().lines().count(), 5, "{}", lines.text());
}

#[test]
fn both_sides_are_found() {
    let notch = "POLYGON ((0 0, 4 0, 4 4, 2 1, 0 4, 0 0))";
    let args = ["axis", "-", "--side", "both", "--to", "json"];
    let run = medial_with(&[&args[..], &ENGINE].concat(), notch);
    assert_eq!(run.status, Some(0), "{}", run.errors);
    let sides: Vec<Value> =
        run.text().lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert_eq!((&sides[0]["side"], &sides[1]["side"]), (&"interior".into(), &"exterior".into()));
    let clipped = sides[1]["keypoints"].as_array().unwrap();
    assert_eq!(clipped.iter().filter(|keypoint| keypoint["kind"] == "clipped").count(), 1);
}

#[test]
fn hairs_of_images_go_in_several_ways() {
    let image = fixture("images/horse.png");
    let ends = |words: &[&str]| -> usize {
        let args = ["axis", image.to_str().unwrap(), "--invert", "--to", "json"];
        let run = medial(&[&args[..], &ENGINE, words].concat());
        assert_eq!(run.status, Some(0), "{}", run.errors);
        let axis: Value = serde_json::from_str(run.text()).unwrap();
        let keypoints = axis["keypoints"].as_array().unwrap();
        keypoints.iter().filter(|keypoint| keypoint["kind"] == "tip").count()
    };
    let (usual, all) = (ends(&[]), ends(&["--prune", "none"]));
    assert!((5..40).contains(&usual) && all > 10 * usual, "{usual} {all}");
    assert!(ends(&["--prune", "leaf"]) < all);
    assert!(ends(&["--prune", "chord=8"]) < usual);
    let fine = ends(&["--prune", "chord=0.1"]);
    assert!(2 * ends(&["--prune", "chord=0.1", "--smooth-border", "1.5"]) < fine);
    assert!(2 * ends(&["--prune", "chord=0.1", "--retract", "1"]) < fine);
}

#[test]
fn points_without_order_have_a_border_and_an_axis() {
    let points: String = (0..80)
        .map(|k| 7 * k % 80)
        .map(|k| {
            let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / 80.0).sin_cos();
            format!("{},{}\n", 4.0 * cos, 2.0 * sin)
        })
        .collect();
    let args = ["axis", "-", "--from", "csv", "--to", "json"];
    let run = medial_with(&[&args[..], &ENGINE].concat(), &format!("x,y\n{points}50,50\n"));
    assert_eq!(run.status, Some(0), "{}", run.errors);
    assert!(run.errors.contains("1 points lie on no closed border"), "{}", run.errors);
    let axis: Value = serde_json::from_str(run.text()).unwrap();
    // The ellipse has half axes of 4 and 2, so the middle disk has radius 2.
    let radii = axis["keypoints"].as_array().unwrap().iter();
    let largest = radii.map(|k| k["radius"].as_f64().unwrap()).fold(0.0, f64::max);
    assert!((largest - 2.0).abs() < 0.02, "{largest}");
    let line = medial_with(&["axis", "-", "--from", "csv"], "0,0\n1,1\n2,2\n");
    assert_eq!(line.status, Some(1));
    assert!(line.errors.contains("3 points without a closed border"), "{}", line.errors);
}

#[test]
fn smoothing_the_outline_of_an_image_is_for_images() {
    let rectangle = "POLYGON((0 0,4 0,4 2,0 2,0 0))";
    for command in ["axis", "branches"] {
        let args = [command, "-", "--from", "wkt", "--smooth-border", "2"];
        let run = medial_with(&[&args[..], &ENGINE].concat(), rectangle);
        assert_eq!((run.status, run.text()), (Some(2), ""), "{}", run.errors);
        let why = "--smooth-border is for images, whose outlines have steps; the input is wkt";
        assert!(run.errors.contains(why), "{}", run.errors);
    }
}
