//! `medial compare`, as a user meets it.

mod common;

use common::{fixture, medial, medial_with};
use serde_json::{Value, json};

const RECTANGLE: &str = "POLYGON ((0 0, 4 0, 4 2, 0 2, 0 0))";

/// The engines whose graphs are the same.
const EXACT: [&str; 2] = ["--engine", "path_tracing,divide_and_conquer"];

fn path(name: &str) -> String {
    fixture(name).display().to_string()
}

/// The rows of a run that wrote lines of JSON.
fn rows(text: &str) -> Vec<Value> {
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn each_engine_has_a_row() {
    let run = medial_with(&["compare", "-"], RECTANGLE);
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    let rows = rows(run.text());
    let engines: Vec<&Value> = rows.iter().map(|row| &row["engine"]).collect();
    let names: Vec<&str> = medial::axis::Engine::ALL.iter().map(|engine| engine.name()).collect();
    assert_eq!(engines, names);
    let (exact, sampled) = rows.split_at(2);
    for row in sampled {
        assert_eq!((&row["same_graph"], &row["position"]), (&Value::Null, &Value::Null));
        // A cell is a thousandth of the longer side. Fire from four sides takes the ways to the corners.
        assert!(row["distance"].as_f64().unwrap() < 0.006, "{row}");
        let corners = row["engine"] == "brushfire";
        assert!(row["missed"].as_f64().unwrap() < if corners { 1.5 } else { 0.05 }, "{row}");
    }
    for row in exact {
        assert_eq!((&row["feature"], &row["id"]), (&json!(0), &Value::Null));
        assert_eq!(
            (&row["edges"], &row["keypoints"], &row["paths"]),
            (&json!(4), &json!(6), &json!(5))
        );
        assert_eq!((&row["reference"], &row["same_graph"]), (&json!("path_tracing"), &json!(true)));
        for count in ["missing_keypoints", "extra_keypoints", "missing_paths", "extra_paths"] {
            assert_eq!(row[count], 0, "{count}");
        }
        for far in ["position", "radius", "distance", "missed"] {
            assert_eq!(row[far], 0.0, "{far}");
        }
        assert!(row["seconds"].as_f64().unwrap() > 0.0);
        assert_eq!((&row["code"], &row["message"]), (&Value::Null, &Value::Null));
    }
}

#[test]
fn memory_is_that_of_the_engine_and_grows_with_the_shape() {
    // A star of many corners: its axis alone takes some hundred bytes a corner.
    let star = |n: u32| {
        let corner = |k: u32| {
            let (sin, cos) = (f64::from(k) / f64::from(n) * std::f64::consts::TAU).sin_cos();
            let far = if k.is_multiple_of(2) { 1.0 } else { 0.7 };
            format!("{} {}", far * cos, far * sin)
        };
        let corners: Vec<String> = (0..=n).map(|k| corner(k % n)).collect();
        format!("POLYGON (({}))", corners.join(", "))
    };
    let bytes = |n: u32| -> Vec<u64> {
        let run = medial_with(&[&["compare", "-"][..], &EXACT].concat(), &star(n));
        rows(run.text()).iter().map(|row| row["memory_bytes"].as_u64().unwrap()).collect()
    };
    let (small, large) = (bytes(100), bytes(1000));
    assert_eq!(small, bytes(100), "a count depends on nothing but the shape");
    for (small, large) in small.iter().zip(&large) {
        assert!(*small > 100 * 40, "{small}");
        assert!(*large > 5 * small, "{small} and {large}");
    }
    // What other threads allocate is not seen, so nothing is said.
    let several = medial_with(&["compare", "-", "--threads", "2"], RECTANGLE);
    assert!(rows(several.text()).iter().all(|row| row["memory_bytes"].is_null()));
}

#[test]
fn engines_can_be_chosen() {
    let run = medial_with(&["compare", "-", "--engine", "divide-and-conquer"], RECTANGLE);
    let rows = rows(run.text());
    assert_eq!(rows.len(), 1);
    // The only exact engine is the reference.
    assert_eq!(rows[0]["reference"], "divide_and_conquer");
    let run = medial_with(
        &["compare", "-", "--engine", "divide_and_conquer,path_tracing", "--to", "csv"],
        RECTANGLE,
    );
    let engines: Vec<&str> =
        run.text().lines().skip(1).map(|line| line.split(',').nth(4).unwrap()).collect();
    assert_eq!(engines, ["divide_and_conquer", "path_tracing"]);
    let run = medial_with(&["compare", "-", "--engine", "delaunay_duel"], RECTANGLE);
    assert_eq!((run.status, run.out.len()), (Some(2), 0));
}

#[test]
fn an_engine_that_is_named_twice_runs_once() {
    let names = "divide_and_conquer,path_tracing,divide-and-conquer";
    let run = medial_with(&["compare", "-", "--engine", names], RECTANGLE);
    let rows = rows(run.text());
    let engines: Vec<&Value> = rows.iter().map(|row| &row["engine"]).collect();
    assert_eq!(engines, ["divide_and_conquer", "path_tracing"]);
}

#[test]
fn bad_features_are_left_out_and_the_others_compared() {
    let mixed = path("mixed.geojson");
    let run = medial(&[&["compare", &mixed, "-q"][..], &EXACT].concat());
    assert_eq!(run.status, Some(3));
    assert_eq!(run.errors.lines().count(), 4, "{}", run.errors);
    let rows = rows(run.text());
    let features: Vec<u64> = rows.iter().map(|row| row["feature"].as_u64().unwrap()).collect();
    assert_eq!(features, [0, 0, 5, 5, 6, 6]);
    assert!(rows.iter().all(|row| row["same_graph"] == true), "{}", run.text());
    let stopped = medial(&["compare", &path("mixed.geojson"), "-q", "--on-error", "stop"]);
    assert_eq!(stopped.status, Some(1));
    let none = medial_with(&["compare", "-"], "POINT (1 1)");
    assert_eq!((none.status, none.out.len()), (Some(1), 0));
}

#[test]
fn the_table_for_people_has_a_line_for_each_engine_and_one_for_all_features() {
    let asked = [&["compare", "-", "--to", "text"][..], &EXACT].concat();
    let run = medial_with(&asked, RECTANGLE);
    let lines: Vec<&str> = run.text().lines().collect();
    assert_eq!(lines.len(), 4, "{}", run.text());
    assert_eq!(lines[0], "feature 0: 4 edges");
    assert!(lines[1].starts_with("  engine "), "{}", lines[1]);
    let words: Vec<&str> = lines[2].split_whitespace().collect();
    assert_eq!((&words[..3], words[7]), (&["path_tracing", "6", "5"][..], "reference"));
    let words: Vec<&str> = lines[3].split_whitespace().collect();
    assert_eq!(words[7..], ["same", "0", "0", "0", "0"]);
    let two = format!("{RECTANGLE}\n{RECTANGLE}");
    let run = medial_with(&asked, &two);
    let all = run.text().split("all 2 features: 8 edges\n").nth(1).unwrap();
    let words: Vec<&str> = all.lines().nth(1).unwrap().split_whitespace().collect();
    assert_eq!(words[..3], ["path_tracing", "12", "10"]);
}

#[test]
fn both_sides_are_compared() {
    let l = path("shapes/l_with_unit_arms.wkt");
    let run = medial(&[&["compare", &l, "--side", "both"][..], &EXACT].concat());
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    let told: Vec<_> = rows(run.text())
        .iter()
        .map(|row| (row["side"].clone(), row["paths"].clone(), row["same_graph"].clone()))
        .collect();
    // Outside there is the path from the notch along the diagonal.
    let of = |side: &str, paths: u32| (json!(side), json!(paths), json!(true));
    let (inside, outside) = (of("interior", 9), of("exterior", told[2].1.as_u64().unwrap() as u32));
    assert_eq!(told, [inside.clone(), inside, outside.clone(), outside]);
    let run = medial(&["compare", &l, "--side", "exterior", "--frame", "2", "--to", "text"]);
    assert!(run.text().starts_with("feature 0, exterior: 6 edges\n"), "{}", run.text());
    let run = medial(&["compare", &l, "--frame", "2"]);
    assert_eq!((run.status, run.out.len()), (Some(2), 0));
}

#[test]
fn the_form_comes_from_the_extension() {
    let folder = tempfile::tempdir().unwrap();
    for (name, start) in [
        ("a.csv", "feature,id,edges,side,engine,keypoints,"),
        ("a.txt", "feature 0: 4 edges\n"),
        (
            "a.jsonl",
            "{\"feature\":0,\"id\":null,\"edges\":4,\"side\":\"interior\",\"engine\":\"path_tracing\",",
        ),
    ] {
        let file = folder.path().join(name);
        let run = medial_with(&["compare", "-", "-o", file.to_str().unwrap()], RECTANGLE);
        assert_eq!((run.status, run.errors.as_str(), run.out.len()), (Some(0), "", 0), "{name}");
        assert!(std::fs::read_to_string(&file).unwrap().starts_with(start), "{name}");
    }
}

#[test]
fn the_documentation_names_every_column() {
    let formats = std::fs::read_to_string(fixture("../docs/formats.md")).unwrap();
    let run = medial_with(&["compare", "-", "--to", "csv"], RECTANGLE);
    for column in run.text().lines().next().unwrap().split(',') {
        assert!(formats.contains(&format!("`{column}`")), "{column}");
    }
}
