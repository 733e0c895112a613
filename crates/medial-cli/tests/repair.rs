//! Features that are not valid, limits, and what is left when the command is told to end.

mod common;

use std::io::Write as _;
use std::process::{Command, Stdio};

use common::{medial, medial_with, names};
use serde_json::{Value, json};

const BOW: &str = "POLYGON ((0 0, 3 1, 3 0, 0 1, 0 0))\n";
const SQUARE: &str = "POLYGON ((0 0, 2 0, 2 2, 0 2, 0 0))\n";

fn report(path: &std::path::Path) -> Value {
    serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap()
}

#[test]
fn crossings_are_repaired_and_reported() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("report.json");
    let file = file.to_str().unwrap();
    let run = medial_with(&["axis", "-", "--from", "wkt", "--to", "wkt", "--report", file], BOW);
    assert_eq!(run.status, Some(0));
    let told = "warning: <stdin>: feature 0: ring 0, vertices 0, 2: edges are cut where they cross";
    assert!(run.errors.starts_with(told), "{}", run.errors);
    let report = report(file.as_ref());
    let entry = &report["features"][0]["entries"][0];
    assert_eq!(entry["code"], "crossing");
    assert_eq!(entry["action"], "repaired");
    assert_eq!(entry["points"], json!([[1.5, 0.5]]));
    assert!(entry["moved"].as_f64().unwrap() < 1e-15);
    // Documents of a repaired feature are judged like any others.
    let axis = folder.path().join("axis.json");
    let bow = folder.path().join("bow.wkt");
    std::fs::write(&bow, BOW).unwrap();
    let (bow, axis) = (bow.to_str().unwrap(), axis.to_str().unwrap());
    assert_eq!(medial(&["axis", bow, "-o", axis, "--side", "both", "-q"]).status, Some(0));
    assert_eq!(medial(&["check", bow, axis, "-q"]).status, Some(0));
    // And what is compressed gives the same axis again.
    let small = folder.path().join("axis.maxis");
    assert_eq!(
        medial(&["compress", bow, "-o", small.to_str().unwrap(), "--max-error", "0", "-q"]).status,
        Some(0)
    );
    let rebuilt = medial(&["reconstruct", small.to_str().unwrap(), "--to", "wkt"]);
    assert!(rebuilt.text().starts_with("MULTIPOLYGON ((("), "{}", rebuilt.text());
}

#[test]
fn strict_refuses_and_says_where() {
    let run = medial_with(&["axis", "-", "--from", "wkt", "--strict"], BOW);
    assert_eq!(run.status, Some(1));
    assert!(run.errors.contains("ring 0, edge 0: crosses ring 0, edge 2 at (1.5, 0.5)"));
}

#[test]
fn the_fill_rule_and_dissolving_are_options() {
    let area = |args: &[&str], text: &str| {
        let mut words = vec!["reconstruct", "-", "--from", "wkt", "-q"];
        words.extend(args);
        let run = medial_with(&words, text);
        (run.status, run.text().matches("Polygon").count(), run.text().matches("]],[[").count())
    };
    // The same way round twice.
    let nested = "POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (2 2, 4 2, 4 4, 2 4, 2 2))";
    let rings = |args: &[&str]| {
        let mut words = vec!["reconstruct", "-", "--from", "wkt", "--to", "wkt", "-q"];
        words.extend(args);
        medial_with(&words, nested).text().matches("), (").count()
    };
    assert_eq!(rings(&[]), 1);
    assert_eq!(rings(&["--fill", "nonzero"]), 0);
    let overlapping = "MULTIPOLYGON (((0 0, 2 0, 2 2, 0 2, 0 0)), ((1 1, 3 1, 3 3, 1 3, 1 1)))";
    assert_eq!(area(&[], overlapping).0, Some(1));
    assert_eq!(area(&["--dissolve"], overlapping).0, Some(0));
}

#[test]
fn features_beyond_a_limit_are_left_out_with_a_reason() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("report.json");
    let file = file.to_str().unwrap();
    let text = format!("{SQUARE}POLYGON ((0 0, 2 0, 3 1, 2 2, 1 3, 0 2, 0 0))\n");
    let mut words = vec!["axis", "-", "--from", "wkt", "--to", "wkt", "--report", file, "-q"];
    let mut with = |option: [&'static str; 2], text: &str| {
        words.truncate(9);
        words.extend(option);
        let run = medial_with(&words, text);
        let report = report(file.as_ref());
        let codes: Vec<String> = report["features"]
            .as_array()
            .unwrap()
            .iter()
            .flat_map(|f| f["entries"].as_array().unwrap())
            .map(|entry| entry["code"].as_str().unwrap().to_owned())
            .collect();
        (run.status, codes)
    };
    assert_eq!(with(["--max-vertices", "5"], &text), (Some(3), vec!["max_vertices".to_owned()]));
    // Too many crossings for any machine in that time.
    let mut scribble = String::from("POLYGON ((");
    let n = 20_000_u64;
    for k in 0..=n {
        let at = k % n;
        let (x, y) = (at * 7919 % 10_007, at * at * 104_729 % 10_009);
        scribble.push_str(&format!("{}{x} {y}", if k > 0 { ", " } else { "" }));
    }
    scribble.push_str("))\n");
    let scribble = format!("{SQUARE}{scribble}");
    assert_eq!(with(["--max-seconds", "0.2"], &scribble), (Some(3), vec!["time_limit".to_owned()]));
}

/// Disks so many that uniting them takes far longer than a second, which nothing in it notices.
#[test]
fn what_does_not_come_back_in_time_is_left_out_alone() {
    let folder = tempfile::tempdir().unwrap();
    let report = folder.path().join("report.json").display().to_string();
    let corner = |k: u32| {
        let (sin, cos) = (f64::from(k) * std::f64::consts::TAU / 800.0).sin_cos();
        let radius = if k.is_multiple_of(2) { 100.0 } else { 1.0 + f64::from(k % 37) };
        format!("{} {}", radius * cos, radius * sin)
    };
    let ring: Vec<String> = (0..=800).map(|k| corner(k % 800)).collect();
    let star = format!("POLYGON (({}))\n", ring.join(", "));
    let input = format!("{SQUARE}{star}{SQUARE}");
    let args = ["reconstruct", "-", "--method", "disks", "--step", "0.05", "--to", "wkt"];
    let args = [&args[..], &["--max-seconds", "1", "--threads", "1", "--report", &report]].concat();
    let run = medial_with(&args, &input);
    assert_eq!(run.status, Some(3), "{}", run.errors);
    assert_eq!(run.text().lines().count(), 2, "both squares are there");
    assert!(run.errors.contains("feature 1: "), "{}", run.errors);
    let report: serde_json::Value =
        serde_json::from_slice(&std::fs::read(report).unwrap()).unwrap();
    assert_eq!(report["features"][0]["feature"], 1);
    assert_eq!(report["features"][0]["entries"][0]["code"], "time_limit");
}

/// The middle of a rectangle of a degree by a tenth, 60 degrees north: half as wide as on the equator.
#[test]
fn degrees_are_metres_on_request() {
    let degree = 6_378_137.0 * std::f64::consts::PI / 180.0;
    let polygon = "{\"type\":\"Polygon\",\"coordinates\":[[[7,59.95],[8,59.95],[8,60.05],[7,60.05],[7,59.95]]]}";
    let run = medial_with(&["clearance", "-", "--metric", "--largest"], polygon);
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    let disk = &run.json()["features"][0];
    let width = disk["properties"]["width"].as_f64().unwrap();
    assert!((width / (0.1 * degree) - 1.0).abs() < 1e-9, "{width}");
    let axis = medial_with(&["axis", "-", "--metric", "--keypoints"], polygon).json();
    let ends: Vec<[f64; 2]> = axis["features"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|f| f["properties"]["kind"] == "end")
        .map(|f| [0, 1].map(|k| f["geometry"]["coordinates"][k].as_f64().unwrap()))
        .collect();
    assert_eq!(ends.len(), 4);
    for [x, y] in ends {
        assert!((x - 7.5).abs() - 0.5 < 1e-12 && ((y - 60.0).abs() - 0.05).abs() < 1e-12);
    }
    // A picture is in metres.
    let text = medial_with(&["axis", "-", "--metric", "--to", "wkt"], polygon);
    let longest =
        text.text().split(['(', ',', ' ']).filter_map(|w| w.trim_end_matches(')').parse().ok());
    assert!(longest.fold(0.0, f64::max) > 1e6);
    // What is known to be no degrees is not taken for them.
    let of = |code: u32| {
        let crs = format!("urn:ogc:def:crs:EPSG::{code}");
        format!(
            r#"{{"type":"FeatureCollection","crs":{{"type":"name","properties":{{"name":"{crs}"}}}},"features":[{{"type":"Feature","properties":{{}},"geometry":{{"type":"Polygon","coordinates":[[[0,0],[10,0],[10,5],[0,5],[0,0]]]}}}}]}}"#
        )
    };
    let metres = medial_with(&["axis", "-", "--metric"], &of(2056));
    assert_eq!(metres.status, Some(2));
    assert!(metres.errors.contains("no longitudes and latitudes"), "{}", metres.errors);
    let grads = medial_with(&["axis", "-", "--metric"], &of(4807));
    assert!(grads.status == Some(2) && grads.errors.contains("are grads"), "{}", grads.errors);
    let told = medial_with(&["axis", "-"], &of(4807)).errors;
    assert!(told.contains("the coordinates are grads"), "{told}");
    let refused = medial_with(&["locate", "-", "7.5", "60", "--metric"], polygon);
    assert_eq!(refused.status, Some(2));
    let pole = polygon.replace("59.95", "89.99").replace("60.05", "90.5");
    assert!(medial_with(&["axis", "-", "--metric"], &pole).errors.contains("between the poles"));
}

#[cfg(unix)]
#[test]
fn a_command_told_to_end_leaves_no_file() {
    let folder = tempfile::tempdir().unwrap();
    let output = folder.path().join("axes.geojson");
    let mut child = Command::new(env!("CARGO_BIN_EXE_medial"))
        .args(["axis", "-", "--from", "wkt", "-o", output.to_str().unwrap()])
        .stdin(Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = child.stdin.take().unwrap();
    // It waits for more.
    writeln!(input, "{SQUARE}").unwrap();
    while names(folder.path()).is_empty() {
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    let id = child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert!(names(folder.path()).is_empty());
    drop(input);
}
