//! `medial axis`, as a user meets it.

mod common;

use common::{fixture, medial, medial_with, names};
use serde_json::{Value, json};

const RECTANGLE: &str = "POLYGON ((0 0, 4 0, 4 2, 0 2, 0 0))";

fn path(name: &str) -> String {
    fixture(name).display().to_string()
}

#[test]
fn a_rectangle_from_standard_input_gives_five_paths() {
    let run = medial_with(&["axis", "-"], RECTANGLE);
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    let whole = run.json();
    assert_eq!(whole["type"], "FeatureCollection");
    let features = whole["features"].as_array().unwrap();
    assert_eq!(features.len(), 5);
    let spine = features.iter().find(|f| f["properties"]["radius_min"] == 1.0).unwrap();
    assert_eq!(spine["properties"]["length"], 2.0);
    assert_eq!(spine["geometry"]["coordinates"], json!([[1.0, 1.0], [3.0, 1.0]]));
}

#[test]
fn every_format_of_input_gives_the_same_axis() {
    let inputs = [
        RECTANGLE,
        "[[[0,0],[4,0],[4,2],[0,2],[0,0]]]",
        r#"{"type":"Polygon","coordinates":[[[0,0],[4,0],[4,2],[0,2],[0,0]]]}"#,
        r#"{"type":"FeatureCollection","features":[{"type":"Feature","properties":null,"geometry":
            {"type":"MultiPolygon","coordinates":[[[[0,0],[4,0],[4,2],[0,2],[0,0]]]]}}]}"#,
        "\u{feff}SRID=3857;POLYGON Z ((0 0 1, 4 0 1,\n 4 2 1, 0 2 1, 0 0 1))\n",
    ];
    let first = medial_with(&["axis", "-", "--to", "json"], inputs[0]);
    assert_eq!(first.status, Some(0));
    assert!(first.text().starts_with("{\"type\":\"MedialAxis\",\"version\":1"));
    for input in inputs {
        let run = medial_with(&["axis", "-", "--to", "json"], input);
        assert_eq!(run.text(), first.text(), "{input}");
    }
}

#[test]
fn a_format_that_is_named_is_not_guessed() {
    let line = r#"{"type":"Polygon","coordinates":[[[0,0],[4,0],[4,2]]]}"#;
    let two = format!("{line}\n{line}\n");
    let run = medial_with(&["axis", "-", "--from", "geojsonl", "--to", "wkt"], &two);
    assert_eq!(run.text().lines().count(), 2);
    let run = medial_with(&["axis", "-", "--from", "rings"], RECTANGLE);
    assert_eq!(run.status, Some(1));
    assert_eq!(run.errors, "error: <stdin>: line 1, column 1: expected value\n");
}

#[test]
fn formats_of_files_come_from_their_extensions() {
    let folder = tempfile::tempdir().unwrap();
    let starts: [(&str, &[u8]); 9] = [
        ("a.wkb", b"\x01\x05\x00\x00\x00\x05\x00\x00\x00"),
        ("a.geojson", b"{\"type\":\"FeatureCollection\""),
        ("a.geojsonl", b"{\"type\":\"Feature\""),
        ("a.json", b"{\"type\":\"MedialAxis\""),
        ("a.jsonl", b"{\"type\":\"MedialAxis\""),
        ("a.wkt", b"MULTILINESTRING ((0 0, 1 1)"),
        ("a.csv", b"WKT,feature,id,path,"),
        ("a.svg", b"<svg xmlns=\"http://www.w3.org/2000/svg\""),
        ("a.PNG", b"\x89PNG\r\n\x1a\n"),
    ];
    for (name, start) in starts {
        let file = folder.path().join(name);
        let run = medial_with(&["axis", "-", "-o", file.to_str().unwrap()], RECTANGLE);
        assert_eq!((run.status, run.errors.as_str(), run.out.len()), (Some(0), "", 0), "{name}");
        assert!(std::fs::read(&file).unwrap().starts_with(start), "{name}");
    }
    assert_eq!(names(folder.path()).len(), 9, "nothing else is left behind");
}

#[test]
fn bad_features_are_left_out_and_named() {
    let input = path("mixed.geojson");
    let run = medial(&["axis", &input, "--to", "json"]);
    assert_eq!(run.status, Some(3));
    let numbers: Vec<Value> = run
        .text()
        .lines()
        .map(|line| serde_json::from_str::<Value>(line).unwrap()["feature"].take())
        .collect();
    assert_eq!(numbers, [0, 5, 6]);
    let expected = format!(
        "error: {input}: feature 1: is a LineString; only polygons have a medial axis, leave it out\n\
         error: {input}: feature 2: polygon 0: overlaps polygon 1 near (1, 1); dissolve the polygons first\n\
         error: {input}: feature 3: is without a geometry; only polygons have a medial axis, leave it out\n\
         error: {input}: feature 4: line 10, column 147: invalid type: string \"4\", expected a number\n\
         warning: {input}: feature 5: ring 0, vertex 3: spikes are removed\n\
         warning: {input}: feature 6: a Point in the collection is no polygon and is left out\n\
         warning: {input}: 4 of 7 features left out\n"
    );
    assert_eq!(run.errors, expected);
    let quiet = medial(&["axis", &input, "-q"]);
    assert_eq!(quiet.errors.lines().filter(|line| line.starts_with("warning")).count(), 0);
    assert_eq!(quiet.errors.lines().count(), 4);
}

#[test]
fn a_report_says_what_was_done_to_each_feature() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("report.json");
    medial(&["axis", &path("mixed.geojson"), "--report", file.to_str().unwrap()]);
    let text = std::fs::read_to_string(file).unwrap();
    let report: Value = serde_json::from_str(&text).unwrap();
    assert_eq!((&report["n_features"], &report["done"]), (&json!(7), &json!(3)));
    assert_eq!(report["left_out"], 4);
    let told: Vec<(Value, Value, Value)> = report["features"]
        .as_array()
        .unwrap()
        .iter()
        .flat_map(|f| {
            let entries = f["entries"].as_array().unwrap().iter();
            entries.map(|e| (f["feature"].clone(), e["action"].clone(), e["code"].clone()))
        })
        .collect();
    let expected = [
        (1, "refused", "not_polygon"),
        (2, "refused", "polygons_overlap"),
        (3, "refused", "not_polygon"),
        (4, "refused", "malformed"),
        (5, "dropped", "spike"),
        (5, "repaired", "reversed"),
        (6, "dropped", "part_not_polygon"),
    ];
    assert_eq!(told, expected.map(|(f, a, c)| (json!(f), json!(a), json!(c))));
    let overlap = &report["features"][1]["entries"][0];
    assert_eq!((&overlap["polygon"], &overlap["points"]), (&json!(0), &json!([[1.0, 1.0]])));
    assert!(text.contains("\"id\": 18446744073709551617,"));
}

#[test]
fn strict_refuses_what_would_be_repaired() {
    let spike = "POLYGON ((0 0, 4 0, 4 3, 4 2, 0 2, 0 0))";
    assert_eq!(medial_with(&["axis", "-"], spike).status, Some(0));
    let run = medial_with(&["axis", "-", "--strict"], spike);
    assert_eq!(run.status, Some(1));
    assert!(
        run.errors.starts_with("error: <stdin>: feature 0: ring 0, vertex 2: "),
        "{}",
        run.errors
    );
}

#[test]
fn stopping_leaves_no_output() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("axes.geojson");
    let args = ["axis", &path("mixed.geojson"), "--on-error", "stop", "-o", file.to_str().unwrap()];
    let run = medial(&args);
    assert_eq!(run.status, Some(1));
    assert_eq!(run.errors.lines().count(), 1, "{}", run.errors);
    assert_eq!(names(folder.path()), [""; 0]);
}

#[test]
fn without_a_usable_feature_an_older_file_stays_as_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("axes.wkt");
    std::fs::write(&file, "older").unwrap();
    let run = medial_with(&["axis", "-", "-o", file.to_str().unwrap()], "POINT (1 1)");
    assert_eq!(run.status, Some(1));
    assert_eq!(std::fs::read_to_string(&file).unwrap(), "older");
    assert_eq!(names(folder.path()), ["axes.wkt"]);
    let run = medial_with(&["axis", "-", "-o", file.to_str().unwrap()], RECTANGLE);
    assert_eq!(run.status, Some(0));
    assert!(std::fs::read_to_string(&file).unwrap().starts_with("MULTILINESTRING"));
}

#[test]
fn wrong_usage_is_told_in_one_line() {
    for (args, said) in [
        (vec!["axis"], "<INPUT>"),
        (vec!["axis", "a.wkt", "--side", "outside"], "interior, exterior, both"),
        (vec!["axis", "a.wkt", "--frame", "2"], "--side exterior"),
        (vec!["axis", "a.wkt", "--side", "both", "--frame", "0"], "a positive number"),
        (vec!["axis", "a.wkt", "--engine", "delaunay_duel"], "delaunay_dual"),
        (vec!["axis", "a.wkt", "--spacing", "1"], "--engine delaunay_dual"),
        (vec!["axis", "a.wkt", "--prune", "leaf"], "--engine delaunay_dual"),
        (vec!["axis", "a.wkt", "--tolerance", "-1"], "positive number"),
        (vec!["axis", "a.wkt", "--tolerance", "nan"], "positive number"),
        (vec!["axis", "a.wkt", "--to", "xyz"], "no known format"),
        (vec!["axis", "a.wkt", "--to", "shp"], "name it with -o"),
        (vec!["axis", "-", "--from", "gpkg"], "not from standard input"),
        (vec!["axis", "a.wkt", "--to", "rings"], "no axes"),
        (vec!["axis", "a.wkt", "--threads", "0"], "0"),
        (vec!["axis", "a.wkt", "-o", "b.xyz"], "say it with --to"),
        (vec!["axis", "a.wkt", "--draw", "disks"], "svg and png"),
        (vec!["axis", "a.wkt", "--draw", "circles", "--to", "svg"], "disks"),
        (vec!["axis", "a.wkt", "--z", "radius", "--to", "json"], "not for json"),
        (vec!["axis", "a.wkt", "--frobnicate"], "--frobnicate"),
        (vec!["frobnicate"], "frobnicate"),
        (vec![], "command is missing"),
    ] {
        let run = medial(&args);
        assert_eq!(run.status, Some(2), "{args:?}");
        assert_eq!(run.errors.lines().count(), 1, "{args:?}: {}", run.errors);
        assert!(run.errors.starts_with("error: ") && run.errors.contains(said), "{}", run.errors);
        assert!(run.out.is_empty());
    }
}

#[test]
fn input_that_cannot_be_read_names_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("none.wkt").display().to_string();
    let run = medial(&["axis", &missing]);
    assert_eq!(run.status, Some(1));
    assert_eq!(run.errors, format!("error: {missing}: cannot read: no such file or directory\n"));
    for (input, said) in [
        ("", "the input is empty"),
        ("{\"type\":\"FeatureCollection\",\n\"features\":[}", "line 2, column 13: expected value"),
        ("{\"type\":\"MedialAxis\"}", "polygons are needed here"),
        ("\u{2}", "name it with --from"),
    ] {
        let run = medial_with(&["axis", "-"], input);
        assert_eq!(run.status, Some(1), "{input}");
        assert!(
            run.errors.starts_with("error: <stdin>: ") && run.errors.contains(said),
            "{}",
            run.errors
        );
        assert_eq!((run.errors.lines().count(), run.out.len()), (1, 0));
    }
}

#[test]
fn an_empty_collection_gives_an_empty_collection() {
    let run = medial_with(&["axis", "-"], r#"{"type":"FeatureCollection","features":[]}"#);
    assert_eq!(run.status, Some(0));
    assert_eq!(run.json()["features"], json!([]));
    assert_eq!(run.errors, "warning: <stdin>: there are no features\n");
}

#[test]
fn a_folder_that_does_not_exist_is_named_before_any_work() {
    let run = medial_with(&["axis", "-", "-o", "/nonexistent/a.svg"], RECTANGLE);
    assert_eq!(run.status, Some(1));
    assert_eq!(run.errors, "error: /nonexistent/a.svg: cannot create: no such file or directory\n");
}

#[test]
fn a_side_file_that_cannot_be_written_stops_before_any_work() {
    for option in ["--timings", "--report"] {
        let run = medial_with(&["axis", "-", option, "/nonexistent/a.json"], RECTANGLE);
        assert_eq!(run.status, Some(1));
        let told = "error: /nonexistent/a.json: cannot create: no such file or directory\n";
        assert_eq!((run.text(), run.errors.as_str()), ("", told));
    }
}

#[test]
fn output_does_not_depend_on_the_number_of_threads() {
    let many: String = (2..200)
        .map(|k| format!("POLYGON ((0 0, {k} 0, {k} 2, 0 {}, 0 0))\n", 2 + k % 7))
        .collect();
    let one = medial_with(&["axis", "-", "--threads", "1", "--to", "json"], &many);
    let four = medial_with(&["axis", "-", "--threads", "4", "--to", "json"], &many);
    assert_eq!(one.text().lines().count(), 198);
    assert!(one.out == four.out);
}

#[test]
fn timings_name_every_stage() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("timings.json");
    let args = ["axis", &path("river.geojson"), "--to", "svg", "--timings", file.to_str().unwrap()];
    assert_eq!(medial(&args).status, Some(0));
    let timings: Value = serde_json::from_slice(&std::fs::read(file).unwrap()).unwrap();
    for stage in ["read", "domain", "engine", "write", "cpu"] {
        assert!(timings[stage].as_f64().unwrap() > 0.0, "{stage}");
    }
    assert_eq!(timings["operations"], 0.0);
    #[cfg(target_os = "linux")]
    assert!(timings["peak_bytes"].as_u64().unwrap() > 1_000_000);
}

#[test]
fn the_layer_passes_through() {
    let run = medial(&["axis", &path("mixed.geojson"), "-q", "--keypoints", "--z", "radius"]);
    let whole = run.json();
    assert_eq!(whole["crs"]["properties"]["name"], "urn:ogc:def:crs:EPSG::2193");
    let features = whole["features"].as_array().unwrap();
    let first = &features[0]["properties"];
    assert_eq!(first["name"], "rectangle 4 by 2");
    assert_eq!((&first["source_length"], &first["source_id"]), (&json!(4), &json!("rectangle")));
    assert!(run.text().contains("\"source_id\":18446744073709551617,"));
    // The rectangle has 5 paths and 6 keypoints.
    let points = features.iter().filter(|f| f["properties"]["source_id"] == "rectangle");
    let kinds: Vec<&str> = points.map(|f| f["geometry"]["type"].as_str().unwrap()).collect();
    assert_eq!(kinds, [["LineString"; 5].as_slice(), &["Point"; 6]].concat());
    assert_eq!(features[0]["geometry"]["coordinates"][0].as_array().unwrap().len(), 3);
}

#[cfg(unix)]
#[test]
fn a_reader_that_leaves_is_no_error() {
    let command = format!(
        "{} axis {} --to json | head -c 10; exit ${{PIPESTATUS[0]}}",
        env!("CARGO_BIN_EXE_medial"),
        path("river.geojson")
    );
    let output = std::process::Command::new("bash").args(["-c", &command]).output().unwrap();
    assert_eq!(output.stdout, b"{\"type\":\"M");
    assert_eq!((output.status.code(), output.stderr.as_slice()), (Some(0), b"".as_slice()));
}

#[cfg(unix)]
#[test]
fn a_link_stays_a_link() {
    let folder = tempfile::tempdir().unwrap();
    let (file, link) = (folder.path().join("a.wkt"), folder.path().join("b.wkt"));
    std::fs::write(&file, "older").unwrap();
    std::os::unix::fs::symlink(&file, &link).unwrap();
    let run = medial_with(&["axis", "-", "-o", link.to_str().unwrap()], RECTANGLE);
    assert_eq!(run.status, Some(0));
    assert!(link.is_symlink());
    assert!(std::fs::read_to_string(&file).unwrap().starts_with("MULTI"));
}

#[cfg(unix)]
#[test]
fn a_device_is_written_as_it_is() {
    let run = medial_with(&["axis", "-", "--to", "wkt", "-o", "/dev/null"], RECTANGLE);
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
}

#[test]
fn progress_is_told_in_lines_where_there_is_no_terminal() {
    let args = ["axis", &path("mixed.geojson"), "-q", "--progress", "always"];
    let run = medial(&args);
    assert_eq!(run.errors.lines().last(), Some("progress: 7 of 7 features"));
    let silent = medial(&["axis", &path("river.geojson")]);
    assert_eq!(silent.errors, "");
}

const NOTCH: &str = "POLYGON ((0 0, 2 0, 2 1, 1 1, 1 2, 0 2, 0 0))";

#[test]
fn both_sides_come_one_after_the_other() {
    let run = medial_with(&["axis", "-", "--side", "both", "--to", "json"], NOTCH);
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    let documents: Vec<Value> =
        run.text().lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let sides: Vec<_> = documents.iter().map(|d| (&d["side"], &d["feature"])).collect();
    assert_eq!(sides, [(&json!("interior"), &json!(0)), (&json!("exterior"), &json!(0))]);
    // In the notch: its bottom, where its edges end, and where the frame cuts the path.
    let kinds: Vec<_> =
        documents[1]["keypoints"].as_array().unwrap().iter().map(|k| &k["kind"]).collect();
    assert_eq!(kinds, ["transition", "end", "clipped"]);
    let folder = tempfile::tempdir().unwrap();
    let shape = folder.path().join("notch.wkt");
    std::fs::write(&shape, NOTCH).unwrap();
    let judged = medial_with(&["check", shape.to_str().unwrap(), "-"], run.text());
    assert_eq!((judged.status, judged.errors.as_str()), (Some(0), ""));
    assert!(judged.text().contains("feature 0, exterior: no defect"), "{}", judged.text());
}

#[test]
fn the_side_is_a_property_where_it_is_not_the_interior() {
    let sides = |side: &str| {
        let run = medial_with(&["axis", "-", "--side", side], NOTCH);
        let whole = run.json();
        let features = whole["features"].as_array().unwrap();
        let mut sides: Vec<_> = features.iter().map(|f| f["properties"]["side"].clone()).collect();
        sides.dedup();
        sides
    };
    assert_eq!(sides("interior"), [Value::Null]);
    assert_eq!(sides("exterior"), [json!("exterior")]);
    assert_eq!(sides("both"), [json!("interior"), json!("exterior")]);
    let run = medial_with(&["axis", "-", "--side", "exterior", "--to", "csv"], NOTCH);
    assert!(
        run.text()
            .starts_with("WKT,feature,id,path,from,to,x_start,y_start,x_end,y_end,engine,side,")
    );
}

#[test]
fn the_frame_is_as_far_away_as_it_is_said_to_be() {
    let run = medial_with(
        &["axis", "-", "--side", "exterior", "--frame", "0.5", "--to", "wkt", "--keypoints"],
        NOTCH,
    );
    assert!(run.text().contains("MULTIPOINT ((2 2), (1 1), (2.5 2.5))"), "{}", run.text());
    let run = medial_with(&["axis", "-", "--side", "exterior", "--frame", "1e80"], NOTCH);
    assert_eq!(run.status, Some(1));
    assert!(run.errors.contains("a frame 1e80 away"), "{}", run.errors);
}

#[test]
fn a_convex_polygon_has_no_paths_outside() {
    let run = medial_with(&["axis", "-", "--side", "exterior", "--to", "wkt"], RECTANGLE);
    assert_eq!((run.status, run.text()), (Some(0), "MULTILINESTRING EMPTY\n"));
    let run = medial_with(&["axis", "-", "--side", "exterior", "--to", "svg"], RECTANGLE);
    assert_eq!(run.status, Some(0));
}

#[test]
fn two_outputs_are_two_files() {
    let folder = tempfile::tempdir().unwrap();
    let file = fixture("shapes/l_with_unit_arms.wkt").display().to_string();
    let target = folder.path().join("all.json").display().to_string();
    for option in ["--report", "--timings"] {
        let run = medial(&["axis", &file, "-o", &target, option, &target]);
        assert_eq!(run.status, Some(2), "{}", run.errors);
        assert!(run.errors.contains("is named for two outputs"), "{}", run.errors);
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
    // Neither may be one of the files of a shapefile, or the input.
    let shapes = folder.path().join("all.shp").display().to_string();
    let table = folder.path().join("all.dbf").display().to_string();
    let run = medial(&["axis", &file, "-o", &shapes, "--report", &table]);
    assert_eq!(run.status, Some(2), "{}", run.errors);
    let copy = folder.path().join("l.wkt").display().to_string();
    std::fs::copy(&file, &copy).unwrap();
    for option in ["--report", "--timings", "--nodes"] {
        let run = medial(&["axis", &copy, "--to", "csv", option, &copy]);
        assert_eq!(run.status, Some(2), "{}", run.errors);
        assert!(run.errors.contains("is the input"), "{}", run.errors);
        assert_eq!(std::fs::read(&copy).unwrap(), std::fs::read(&file).unwrap());
    }
}

#[cfg(unix)]
#[test]
fn a_link_to_no_file_yet_gets_one() {
    let folder = tempfile::tempdir().unwrap();
    let (link, target) = (folder.path().join("link.json"), folder.path().join("all.json"));
    std::os::unix::fs::symlink("all.json", &link).unwrap();
    let file = fixture("shapes/l_with_unit_arms.wkt").display().to_string();
    let run = medial(&["axis", &file, "-o", &link.display().to_string()]);
    assert_eq!(run.status, Some(0), "{}", run.errors);
    assert!(target.is_file() && link.is_symlink());
}
