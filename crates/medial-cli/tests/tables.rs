//! Tables of features, as a user meets them.

mod common;

use common::{fixture, medial, medial_with, names};

const SQUARES: &str = r#"{"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"EPSG:2193"}},"features":[
{"type":"Feature","id":7,"properties":{"name":"é"},"geometry":{"type":"Polygon","coordinates":[[[0,0],[4,0],[4,2],[0,0.1],[0,0]]]}},
{"type":"Feature","properties":{"name":null},"geometry":{"type":"Point","coordinates":[0,0]}},
{"type":"Feature","properties":{"n":0.1},"geometry":{"type":"Polygon","coordinates":[[[10,0],[14,0],[14,2],[10,2],[10,0]]]}}]}"#;

fn path(folder: &tempfile::TempDir, name: &str) -> String {
    folder.path().join(name).display().to_string()
}

#[test]
fn every_table_can_be_written_and_read() {
    let folder = tempfile::tempdir().unwrap();
    let lines = medial_with(&["axis", "-", "-q", "--to", "geojsonl"], SQUARES);
    let n_paths = lines.text().lines().count();
    for format in ["gpkg", "shp", "fgb", "parquet"] {
        let file = path(&folder, &format!("offset.{format}"));
        let run =
            medial_with(&["offset", "-", "--distance", "0.01", "-q", "-o", file.as_str()], SQUARES);
        assert_eq!(run.status, Some(3), "{format}: {}", run.errors);
        let run = medial(&["axis", &file, "-q", "--to", "geojsonl"]);
        assert_eq!(run.status, Some(0), "{format}: {}", run.errors);
        assert_eq!(run.text().lines().count(), n_paths, "{format}");
        assert!(run.text().contains("\"name\":\"é\""), "{format}");
        // The extension is not needed: the content tells.
        let other = path(&folder, "table");
        std::fs::copy(&file, &other).unwrap();
        if format != "shp" {
            let run = medial(&["axis", &other, "-q", "--to", "geojsonl"]);
            assert_eq!(run.text().lines().count(), n_paths, "{format}");
        }
    }
}

#[test]
fn other_commands_write_tables_too() {
    let folder = tempfile::tempdir().unwrap();
    let plus = fixture("shapes/plus_of_unit_squares.wkt").display().to_string();
    for command in ["branches", "centerline", "clearance", "smooth", "reconstruct", "voronoi"] {
        let file = path(&folder, &format!("{command}.gpkg"));
        let run = medial(&[command, &plus, "-o", &file]);
        assert_eq!((run.status, run.errors.as_str()), (Some(0), ""), "{command}");
        assert!(std::fs::read(&file).unwrap().starts_with(b"SQLite format 3\0"), "{command}");
    }
    let spaces: Vec<String> = names(folder.path());
    assert_eq!(spaces.len(), 6, "nothing else is left: {spaces:?}");
}

#[test]
fn the_reference_system_passes_through() {
    let folder = tempfile::tempdir().unwrap();
    for format in ["gpkg", "shp", "fgb"] {
        let file = path(&folder, &format!("a.{format}"));
        medial_with(&["smooth", "-", "-q", "-o", file.as_str()], SQUARES);
        let run = medial(&["axis", &file, "-q"]);
        let name = "urn:ogc:def:crs:EPSG::2193";
        assert_eq!(run.json()["crs"]["properties"]["name"], name, "{format}: {}", run.errors);
    }
}

#[test]
fn degrees_are_told_once() {
    let degrees =
        SQUARES.replace("\"crs\":{\"type\":\"name\",\"properties\":{\"name\":\"EPSG:2193\"}},", "");
    let run = medial_with(&["axis", "-", "--to", "wkt"], &degrees);
    assert_eq!(run.errors.matches("the coordinates are degrees (OGC:CRS84)").count(), 1);
    let metres = degrees.replace("[4,2]", "[4,2000]");
    let run = medial_with(&["axis", "-", "--to", "wkt"], &metres);
    assert!(!run.errors.contains("degrees"), "{}", run.errors);
    let run = medial_with(&["axis", "-", "--to", "wkt", "-q"], &degrees);
    assert!(!run.errors.contains("degrees"), "{}", run.errors);
}

#[test]
fn a_layer_is_chosen_by_its_name() {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, "lakes.gpkg");
    medial_with(&["smooth", "-", "-q", "-o", file.as_str()], SQUARES);
    assert_eq!(medial(&["axis", &file, "--layer", "lakes"]).status, Some(0));
    let run = medial(&["axis", &file, "--layer", "rivers"]);
    assert_eq!(run.status, Some(2));
    assert!(run.errors.contains("no layer `rivers`") && run.errors.contains("`lakes`"));
    let plus = fixture("shapes/plus_of_unit_squares.wkt").display().to_string();
    assert_eq!(medial(&["axis", &plus, "--layer", "x"]).status, Some(2));
    assert_eq!(medial(&["axis", &plus, "--layer", "plus_of_unit_squares"]).status, Some(0));
}

#[test]
fn what_a_shapefile_cannot_hold_leaves_no_files() {
    let folder = tempfile::tempdir().unwrap();
    let plus = fixture("shapes/plus_of_unit_squares.wkt").display().to_string();
    let file = path(&folder, "plus.shp");
    assert_eq!(medial(&["axis", &plus, "--keypoints", "-o", &file]).status, Some(2));
    let run = medial(&["voronoi", &plus, "-o", &file]);
    assert_eq!(run.status, Some(1));
    assert!(run.errors.contains("one kind of geometry"), "{}", run.errors);
    assert!(names(folder.path()).is_empty(), "{:?}", names(folder.path()));
    std::fs::write(path(&folder, "plus.prj"), "that of another one").unwrap();
    let run = medial(&["axis", &plus, "-o", &file]);
    assert_eq!(run.status, Some(0));
    assert_eq!(names(folder.path()), ["plus.cpg", "plus.dbf", "plus.shp", "plus.shx"]);
}

#[test]
fn a_feature_that_is_pruned_to_a_point_is_no_reason_to_refuse_a_shapefile() {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, "pruned.shp");
    let input = "POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0))\nPOLYGON ((9 0, 29 0, 29 4, 9 4, 9 0))\n";
    let run = medial_with(&["prune", "-", "--max-error", "3", "-o", &file], input);
    assert_eq!(run.status, Some(0), "{}", run.errors);
    assert!(run.errors.contains("1 of 2 are points"), "{}", run.errors);
    assert_eq!(names(folder.path()), ["pruned.cpg", "pruned.dbf", "pruned.shp", "pruned.shx"]);
}

#[test]
fn a_damaged_table_is_the_fault_of_the_file() {
    let folder = tempfile::tempdir().unwrap();
    for format in ["gpkg", "shp", "fgb", "parquet"] {
        let file = path(&folder, &format!("a.{format}"));
        std::fs::write(&file, "no table").unwrap();
        let run = medial(&["axis", &file]);
        assert_eq!(run.status, Some(1), "{format}");
        assert_eq!(run.errors.lines().count(), 1, "{format}: {}", run.errors);
        let run = medial(&["axis", &path(&folder, &format!("missing.{format}"))]);
        assert_eq!(run.status, Some(1), "{format}");
        assert!(run.errors.contains("cannot read: no such file"), "{format}: {}", run.errors);
    }
}

#[test]
fn text_sequences_have_record_separators() {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, "a.geojsons");
    medial_with(&["axis", "-", "-q", "-o", file.as_str()], SQUARES);
    let bytes = std::fs::read(&file).unwrap();
    let count = |what: u8| bytes.iter().filter(|&&byte| byte == what).count();
    assert!(bytes.starts_with(b"\x1e{") && count(0x1e) == count(b'\n'));
    let run = medial_with(&["axis", "-", "-q", "--to", "geojsonseq"], SQUARES);
    assert_eq!(run.out, bytes);
}

#[test]
fn a_format_without_a_place_for_the_reference_system_says_so() {
    let folder = tempfile::tempdir().unwrap();
    for format in ["geojsonl", "geojsonseq"] {
        let file = path(&folder, &format!("out.{format}"));
        let run = medial_with(&["axis", "-", "--to", format, "-o", &file], SQUARES);
        let lost: Vec<&str> =
            run.errors.lines().filter(|line| line.contains("reference system")).collect();
        let expected = format!(
            "warning: {file}: the reference system EPSG:2193 is not written: {format} has no place for it"
        );
        assert_eq!(lost, [expected], "{format}: {}", run.errors);
        let run = medial_with(&["axis", "-", "-q", "--to", format, "-o", &file], SQUARES);
        assert!(!run.errors.contains("reference system"), "{format}: quiet");
    }
    // Bare coordinates and pictures have none, which is no loss.
    for format in ["wkt", "csv", "json", "dxf", "svg"] {
        let run = medial_with(&["axis", "-", "--to", format], SQUARES);
        assert!(!run.errors.contains("reference system"), "{format}: {}", run.errors);
    }
    let run = medial_with(&["axis", "-"], SQUARES);
    assert!(run.text().contains("EPSG:2193") && !run.errors.contains("reference system"));
    let degrees = SQUARES.replace("EPSG:2193", "urn:ogc:def:crs:OGC:1.3:CRS84");
    let run = medial_with(&["axis", "-", "--to", "csv"], &degrees);
    assert!(!run.errors.contains("is not written"), "{}", run.errors);
    let other = SQUARES.replace("EPSG:2193", "something");
    let run = medial_with(&["axis", "-", "--to", "geojson"], &other);
    assert!(run.text().contains("something") && !run.errors.contains("is not written"));
}

#[test]
fn of_a_table_that_breaks_off_the_beginning_is_used() {
    let folder = tempfile::tempdir().unwrap();
    let squares: String = (0..2000)
        .map(|k| {
            let (x, y) = (10 * (k % 50), 10 * (k / 50));
            format!("POLYGON (({x} {y}, {} {y}, {} {}, {x} {y}))\n", x + 4, x + 4, y + 2)
        })
        .collect();
    for (format, size) in [("fgb", 0.7), ("gpkg", 0.6), ("shp", 0.5)] {
        let file = path(&folder, &format!("whole.{format}"));
        let run = medial_with(&["reconstruct", "-", "-q", "-o", &file], &squares);
        assert_eq!(run.status, Some(0), "{}", run.errors);
        let mut bytes = std::fs::read(&file).unwrap();
        let end = (bytes.len() as f64 * size) as usize;
        if format == "gpkg" {
            // Cut off it has no table of contents; a fifth of its pages is wiped out instead.
            let wiped = bytes.len() / 5;
            bytes[end - wiped..end].fill(0xff);
        } else {
            bytes.truncate(end);
        }
        std::fs::write(&file, &bytes).unwrap();
        let report = path(&folder, "report.json");
        let out = path(&folder, "out.geojsonl");
        let run = medial(&["reconstruct", &file, "--report", &report, "-o", &out]);
        assert_eq!(run.status, Some(3), "{format}: {}", run.errors);
        let n = std::fs::read_to_string(&out).unwrap().lines().count();
        assert!((100..2000).contains(&n), "{format}: {n}");
        let report: serde_json::Value =
            serde_json::from_slice(&std::fs::read(&report).unwrap()).unwrap();
        let last = &report["features"].as_array().unwrap().last().unwrap()["entries"][0];
        // The index of a shapefile still knows the records that are missing, and each is told.
        let code = if format == "shp" { "malformed" } else { "broken_off" };
        assert_eq!(last["code"], code, "{format}: {}", run.errors);
    }
}
