//! `medial voronoi` and `medial locate`, as a user meets them.

mod common;

use common::{fixture, medial, medial_with, names};
use serde_json::{Value, json};

const SQUARE: &str = "POLYGON ((0 0, 2 0, 2 2, 0 2, 0 0))";

fn path(name: &str) -> String {
    fixture(name).display().to_string()
}

/// The lines of a result, each as JSON.
fn lines(text: &str) -> Vec<Value> {
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

#[test]
fn a_square_gives_four_cells_and_four_edges() {
    let run = medial_with(&["voronoi", "-"], SQUARE);
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    let whole = run.json();
    assert_eq!(whole["type"], "FeatureCollection");
    let features = whole["features"].as_array().unwrap();
    let polygons = features.iter().filter(|f| f["geometry"]["type"] == "Polygon").count();
    assert_eq!((features.len(), polygons), (8, 4));
    assert_eq!(
        features[1]["geometry"]["coordinates"],
        json!([[[2.0, 0.0], [2.0, 2.0], [1.0, 1.0], [2.0, 0.0]]])
    );
}

#[test]
fn the_formats_of_diagrams_come_from_their_extensions() {
    let folder = tempfile::tempdir().unwrap();
    let starts: [(&str, &str); 4] = [
        ("a.geojson", "{\"type\":\"FeatureCollection\""),
        ("a.geojsonl", "{\"type\":\"Feature\""),
        ("a.json", "{\"type\":\"Voronoi\",\"version\":1,"),
        ("a.svg", "<svg xmlns=\"http://www.w3.org/2000/svg\""),
    ];
    for (name, start) in starts {
        let file = folder.path().join(name);
        let run = medial_with(&["voronoi", "-", "-o", file.to_str().unwrap()], SQUARE);
        assert_eq!((run.status, run.errors.as_str(), run.out.len()), (Some(0), "", 0), "{name}");
        assert!(std::fs::read_to_string(&file).unwrap().starts_with(start), "{name}");
    }
    assert_eq!(names(folder.path()).len(), 4, "nothing else is left behind");
}

#[test]
fn the_same_bytes_come_from_any_number_of_threads() {
    let river = path("river.geojson");
    for format in ["geojson", "json", "svg"] {
        let one = medial(&["voronoi", &river, "--to", format, "--threads", "1"]);
        let three = medial(&["voronoi", &river, "--to", format, "--threads", "3"]);
        assert_eq!(one.status, Some(0));
        assert!(one.out == three.out, "{format}");
    }
}

#[test]
fn curves_are_drawn_within_the_tolerance() {
    let shape = path("shapes/l_with_unit_arms.wkt");
    let points = |tolerance: &str| {
        let run = medial(&["voronoi", &shape, "--tolerance", tolerance, "--to", "geojsonl"]);
        let features = lines(run.text());
        let paths = features.iter().filter(|f| f["properties"]["curve"] == "parabola");
        paths.map(|f| f["geometry"]["coordinates"].as_array().unwrap().len()).max().unwrap()
    };
    assert_eq!(points("1"), 2);
    assert!(points("1e-6") > 20);
}

#[test]
fn documents_of_diagrams_come_in_input_order() {
    let run = medial(&["voronoi", &path("mixed.geojson"), "--to", "json", "-q"]);
    assert_eq!(run.status, Some(3));
    let features: Vec<Value> = lines(run.text()).iter().map(|l| l["feature"].clone()).collect();
    assert_eq!(features, [0, 5, 6]);
}

#[test]
fn cells_outside_are_closed_at_the_frame() {
    let run =
        medial_with(&["voronoi", "-", "--side", "both", "--frame", "1", "--to", "json"], SQUARE);
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    let found = run.json();
    assert_eq!(found["sides"], json!(["interior", "exterior"]));
    // Four cells inside; outside four strips and four corners.
    assert_eq!(found["cells"].as_array().unwrap().len(), 12);
    let points = found["points"].as_array().unwrap();
    let far = json!({"x": -1.0, "y": 3.0, "radius": 2.0_f64.sqrt(), "kind": "frame"});
    assert!(points.contains(&far), "{points:?}");
    let run = medial_with(&["voronoi", "-", "--frame", "1"], SQUARE);
    assert_eq!(run.errors, "error: --frame is for --side exterior and both\n");
}

#[test]
fn what_a_diagram_has_no_form_for_is_refused() {
    for (args, expected) in [
        (
            ["voronoi", "-", "--to", "csv"],
            "error: diagrams are written as geojson, geojsonl, json, svg, gpkg, shp, fgb or parquet, not as csv\n",
        ),
        (
            ["voronoi", "-", "--tolerance=-1", "-q"],
            "error: invalid value '-1' for '--tolerance <T>': a positive number is needed; see --help\n",
        ),
    ] {
        let run = medial_with(&args, SQUARE);
        assert_eq!((run.status, run.errors.as_str()), (Some(2), expected));
    }
    let run = medial_with(&["voronoi", "-", "--to", "svg", "--tolerance", "1"], SQUARE);
    assert_eq!(run.status, Some(2));
    assert!(run.errors.contains("curves are exact in svg"));
}

#[test]
fn a_point_is_located_with_its_footpoint() {
    let run = medial(&["locate", "2", "0.75", &path("shapes/l_with_unit_arms.wkt")]);
    assert_eq!((run.status, run.errors.as_str()), (Some(0), ""));
    let expected = "{\"type\":\"Location\",\"version\":1,\"feature\":0,\"id\":null,\"point\":[2.0,0.75],\
        \"side\":\"interior\",\"distance\":0.25,\"nearest\":[{\"site\":{\"kind\":\"edge\",\"polygon\":0,\
        \"ring\":0,\"index\":2,\"a\":[3.0,1.0],\"b\":[1.0,1.0]},\"footpoint\":[2.0,1.0]}]}\n";
    assert_eq!(run.text(), expected);
}

#[test]
fn points_outside_and_on_the_boundary_have_their_side() {
    let side = |x: &str, y: &str| {
        let run = medial_with(&["locate", x, y, "-"], SQUARE);
        assert_eq!((run.status, run.errors.as_str()), (Some(0), ""), "{x} {y}");
        let found = run.json();
        let distance = found["distance"].as_f64().unwrap();
        (found["side"].as_str().unwrap().to_owned(), distance)
    };
    assert_eq!(side("1", "1"), ("interior".to_owned(), 1.0));
    assert_eq!(side("-3", "-4"), ("exterior".to_owned(), 5.0));
    assert_eq!(side("2", "0.5"), ("boundary".to_owned(), 0.0));
}

#[test]
fn every_feature_has_its_own_answer() {
    let two = format!("{SQUARE}\nPOLYGON ((10 0, 12 0, 12 2, 10 2, 10 0))");
    let run = medial_with(&["locate", "5", "1", "-"], &two);
    let found = lines(run.text());
    let told: Vec<(&Value, &Value)> =
        found.iter().map(|l| (&l["feature"], &l["distance"])).collect();
    assert_eq!(told, [(&json!(0), &json!(3.0)), (&json!(1), &json!(5.0))]);
}

#[test]
fn coordinates_must_be_numbers_that_a_polygon_may_have() {
    for (x, why) in [
        ("nan", "a finite number is needed"),
        ("inf", "a finite number is needed"),
        ("two", "a finite number is needed"),
        ("1e300", "it must be 0 or between 2^-200 and 2^200 in magnitude"),
    ] {
        let run = medial_with(&["locate", x, "0", "-"], SQUARE);
        let expected = format!("error: invalid value '{x}' for '<X>': {why}; see --help\n");
        assert_eq!((run.status, run.errors), (Some(2), expected));
    }
    let run = medial(&["locate", "1", "2"]);
    assert_eq!(run.status, Some(2));
}
