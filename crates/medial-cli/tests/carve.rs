//! `medial carve`, as a user meets it.

mod common;

use common::medial_with;
use serde_json::Value;

const SQUARE: &str = "POLYGON ((0 0, 20 0, 20 20, 0 20, 0 0))";
const L: &str = "POLYGON ((0 0, 20 0, 20 10, 10 10, 10 20, 0 20, 0 0))";

/// The features that a command writes.
fn features(words: &[&str], text: &str) -> Vec<Value> {
    let run = medial_with(words, text);
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""), "{words:?}");
    run.json()["features"].as_array().unwrap().clone()
}

#[test]
fn moves_are_lines_in_space_in_the_order_of_passes() {
    let moves = features(&["carve", "-", "--angle", "90"], SQUARE);
    assert_eq!(moves.len(), 6, "four corners, two of them twice");
    let mut last: Option<Value> = None;
    for step in &moves {
        let points = step["geometry"]["coordinates"].as_array().unwrap();
        assert_eq!(step["properties"]["kind"], "line");
        let told = |name: &str| step["properties"][name].as_f64().unwrap();
        let first = [told("x_from"), told("y_from"), told("z_from")];
        assert_eq!(points[0], serde_json::json!(first));
        assert_eq!(told("z_from").min(told("z_to")), -10.0);
        if step["properties"]["step"] != 0 {
            assert_eq!(last.as_ref(), Some(&points[0]));
        }
        last = points.last().cloned();
    }
}

#[test]
fn curves_are_told_exactly_and_drawn_within_the_tolerance() {
    let count = |tolerance: &str| {
        let words = ["carve", "-", "--angle", "60", "--tolerance", tolerance];
        let moves = features(&words, L);
        let curved = moves.iter().find(|step| step["properties"]["kind"] == "quadratic").unwrap();
        assert_eq!(curved["properties"]["weight"], 1.0);
        assert!(curved["properties"]["z_control"].as_f64().unwrap() < 0.0);
        curved["geometry"]["coordinates"].as_array().unwrap().len()
    };
    assert!(count("1") < count("0.001"));
    let run = medial_with(&["carve", "-", "--angle", "60", "--to", "csv"], L);
    let header = "WKT,feature,id,engine,pass,step,role,kind,length,x_from,y_from,z_from,x_control,";
    assert!(run.text().starts_with(header) && run.text().contains("\"LINESTRING Z ("));
}

#[test]
fn a_floor_has_its_wall_and_its_rounds() {
    let words = ["carve", "-", "--angle", "90", "--depth", "2", "--clear", "1,1"];
    let moves = features(&words, L);
    let count = |role: &str| moves.iter().filter(|m| m["properties"]["role"] == role).count();
    assert_eq!((count("wall"), count("valley") >= 5, count("floor") > 6), (7, true, true));
    let arc = moves.iter().find(|m| m["properties"]["kind"] == "arc").unwrap();
    let centre = [&arc["properties"]["x_centre"], &arc["properties"]["y_centre"]];
    assert_eq!((centre, &arc["properties"]["sense"]), ([&10.0.into(); 2], &"clockwise".into()));
    let run = medial_with(&["carve", "-", "--angle", "90", "--clear", "1,1"], L);
    assert_eq!(run.status, Some(2), "a floor needs a depth");
    let tiny = ["carve", "-", "--angle", "90", "--depth", "2", "--clear", "0,1e-9"];
    let run = medial_with(&tiny, L);
    assert_eq!(run.status, Some(1));
    assert!(run.errors.contains("the step 0.000000001 is too small"), "{}", run.errors);
}

#[test]
fn a_program_needs_feed_and_height_and_is_one_for_all_features() {
    let both = format!("{SQUARE}\n{L}\n");
    let machine = ["carve", "-", "--angle", "90", "--to", "gcode", "--feed", "600"];
    let run = medial_with(&machine, &both);
    assert_eq!(run.status, Some(2));
    assert!(run.errors.contains("--safe-height"), "{}", run.errors);
    let full = [&machine[..], &["--safe-height", "5", "--units", "inch"]].concat();
    let run = medial_with(&full, &both);
    let text = run.text();
    assert!(text.starts_with("(Tool path)\nG20 G90 G94 G17 G40\nG0 Z5\n"), "{text}");
    assert!(text.ends_with("G0 Z5\nM2\n"));
    assert_eq!((text.matches("M2").count(), text.matches("G20").count()), (1, 1));
    assert!(text.contains(" F300\n") && text.contains(" F600\n"));
    let run = medial_with(&["carve", "-", "--angle", "90", "--feed", "9"], SQUARE);
    assert_eq!(run.status, Some(2));
    assert!(run.errors.contains("--feed is for gcode"), "{}", run.errors);
    let low = [&machine[..], &["--safe-height", "1e-6"]].concat();
    let run = medial_with(&low, SQUARE);
    assert_eq!(run.status, Some(2));
    assert!(run.errors.contains("the safe height 0.000001 is 0"), "{}", run.errors);
    // One that is too small is left out; the other is done.
    let tiny = format!("POLYGON ((0 0, 1e-5 0, 0 1e-5, 0 0))\n{SQUARE}\n");
    let run = medial_with(&full, &tiny);
    assert_eq!(run.status, Some(3));
    assert!(run.errors.contains("feature 0: the tool path is") && run.text().ends_with("M2\n"));
}

#[test]
fn pictures_show_the_path_and_bad_angles_are_refused() {
    let run = medial_with(&["carve", "-", "--angle", "60", "--to", "svg"], L);
    assert!(
        run.text().contains("<title>Tool path</title>") && run.text().contains("class=\"cuts\"")
    );
    for angle in ["0", "180", "-5", "1e-300", "x"] {
        let run = medial_with(&["carve", "-", &format!("--angle={angle}")], SQUARE);
        assert_eq!(run.status, Some(2), "{angle}");
    }
    // Without its corners a square is a point to drill.
    let drilled = features(&["carve", "-", "--angle", "90", "--leave", "5"], SQUARE);
    assert_eq!(drilled.len(), 1);
    assert_eq!(drilled[0]["geometry"]["type"], "Point");
    let run = medial_with(&["axis", "-", "--to", "gcode"], SQUARE);
    assert!(run.errors.contains("medial carve"), "{}", run.errors);
}
