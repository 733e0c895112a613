//! `medial check`, as a user meets it.

mod common;

use common::{Run, fixture, medial, medial_with};
use serde_json::{Value, json};

fn path(name: &str) -> String {
    fixture(name).display().to_string()
}

/// Checks a changed axis document of the L.
fn check_l(change: impl Fn(&mut Value), form: &str) -> Run {
    let text = std::fs::read_to_string(fixture("l_with_unit_arms.axis.json")).unwrap();
    let mut document: Value = serde_json::from_str(&text).unwrap();
    change(&mut document);
    let shape = path("shapes/l_with_unit_arms.wkt");
    medial_with(&["check", &shape, "-", "--to", form], &document.to_string())
}

#[test]
fn a_right_axis_has_no_defect() {
    let run = check_l(|_| (), "text");
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    let text = run.text();
    assert!(text.starts_with("feature 0: no defect\n"), "{text}");
    assert!(
        text.contains("6 edges, 5 convex and 1 reflex corners, 1 walks, 1 components"),
        "{text}"
    );
    assert!(
        text.contains("7 sites, 5 ends, 2 transitions, 3 junctions, 9 paths, 0 cycles"),
        "{text}"
    );
    assert!(text.contains("  holds: leaves: 5, expected 5\n"), "{text}");
}

#[test]
fn a_moved_keypoint_is_a_defect() {
    let run = check_l(|document| document["keypoints"][3]["x"] = json!(2.25), "json");
    assert_eq!(run.status, Some(4));
    let verdict = run.json();
    let defects = verdict["defects"].as_array().unwrap();
    assert!(!defects.is_empty());
    assert!(
        defects.iter().any(|d| d["defect"].as_str().unwrap().contains("keypoint 3")),
        "{defects:?}"
    );
    assert_eq!(verdict["counts"]["junctions"], 3);
}

#[test]
fn a_lost_path_is_a_defect() {
    let lose = |document: &mut Value| {
        document["paths"].as_array_mut().unwrap().pop();
    };
    let run = check_l(lose, "text");
    assert_eq!(run.status, Some(4));
    assert!(run.text().contains("  defect: "), "{}", run.text());
    assert!(run.text().contains("  broken: "), "{}", run.text());
}

#[test]
fn axes_are_matched_by_the_number_of_their_feature() {
    let run = check_l(|document| document["feature"] = json!(1), "text");
    assert_eq!(run.status, Some(4));
    let expected = "feature 0: 1 defect\n  defect: the document has no axis of this feature\n\
                    feature 1: 1 defect\n  defect: there is an axis, but no valid domain of this number\n";
    assert_eq!(run.text(), expected);
}

#[test]
fn a_repeated_axis_is_a_defect() {
    let text = std::fs::read_to_string(fixture("l_with_unit_arms.axis.json")).unwrap();
    let shape = path("shapes/l_with_unit_arms.wkt");
    let run = medial_with(&["check", &shape, "-"], &text.repeat(2));
    assert_eq!(run.status, Some(4));
    assert!(run.text().contains("several axes of one side of this feature"));
}

#[test]
fn an_axis_beside_one_that_cannot_be_read_is_judged() {
    let shape = path("shapes/l_with_unit_arms.wkt");
    let both = medial(&["axis", &shape, "--side", "both", "--to", "json"]);
    let (inside, outside) = both.text().split_once('\n').unwrap();
    let mut bad: Value = serde_json::from_str(outside).unwrap();
    bad["paths"][0]["from"] = json!(99_999);
    let run = medial_with(&["check", &shape, "-"], &format!("{inside}\n{bad}"));
    assert_eq!(run.status, Some(4));
    assert!(run.text().starts_with("feature 0: no defect\n"), "{}", run.text());
    assert!(run.text().contains("not listed"), "{}", run.text());
    assert!(!run.text().contains("several axes"), "{}", run.text());
}

#[test]
fn what_axis_writes_check_accepts() {
    for name in ["river.geojson", "mixed.geojson"] {
        let axes = medial(&["axis", &path(name), "--to", "json", "-q"]);
        let run = medial_with(&["check", &path(name), "-", "-q", "--to", "json"], axes.text());
        // Features that are left out have no axis, and that is no defect.
        assert_eq!(run.status, axes.status, "{name}: {}", run.text());
        assert_eq!(run.text().lines().count(), axes.text().lines().count());
    }
}

#[test]
fn a_malformed_document_is_no_result() {
    let shape = path("shapes/l_with_unit_arms.wkt");
    for (text, said) in [
        ("{\"type\":\"MedialAxis\"}", "line 1, column"),
        ("POINT (1 1)", "line 1, column 1"),
        ("[]", "found an array"),
    ] {
        let run = medial_with(&["check", &shape, "-"], text);
        assert_eq!(run.status, Some(1), "{text}");
        assert!(
            run.errors.starts_with("error: <stdin>: ") && run.errors.contains(said),
            "{}",
            run.errors
        );
        assert_eq!((run.errors.lines().count(), run.out.len()), (1, 0));
    }
}

#[test]
fn only_one_file_comes_from_standard_input() {
    let run = medial(&["check", "-", "-"]);
    assert_eq!(run.status, Some(2));
}
