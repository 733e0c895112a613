use super::*;
use crate::samples;
use serde_json::{Value, json};

fn source() -> Feature {
    let id = RawValue::from_string("18446744073709551617".to_owned()).ok();
    Feature { index: 3, id, ..Feature::default() }
}

fn read_one(text: &str) -> Result<AxisDocument, Error> {
    read(text).next().unwrap()
}

fn error(change: impl Fn(&mut Value)) -> String {
    let mut value: Value =
        serde_json::from_str(&write(&Feature::default(), &samples::l_shape(), &[])).unwrap();
    change(&mut value);
    read_one(&value.to_string()).unwrap_err().to_string()
}

#[test]
fn a_document_reads_back_bit_for_bit() {
    for axis in [samples::rectangle(), samples::l_shape()] {
        let text = write(&source(), &axis, &[]);
        assert_eq!(text.matches('\n').count(), 1);
        let document = read_one(&text).unwrap();
        assert_eq!(document.axis, axis);
        assert_eq!(document.feature, 3);
        assert_eq!(document.id.unwrap().get(), "18446744073709551617");
    }
}

#[test]
fn documents_follow_the_contract() {
    let text = write(&Feature::default(), &samples::l_shape(), &[]);
    let value: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(value["type"], "MedialAxis");
    assert_eq!(value["version"], 1);
    assert_eq!(value["engine"], "path_tracing");
    assert_eq!(value["accuracy"], "exact");
    assert_eq!(value["id"], Value::Null);
    assert_eq!(
        value["sites"][0],
        json!({"kind": "edge", "polygon": 0, "ring": 0, "index": 0, "a": [0.0, 0.0], "b": [3.0, 0.0]})
    );
    assert_eq!(
        value["sites"][6],
        json!({"kind": "vertex", "polygon": 0, "ring": 0, "index": 3, "p": [1.0, 1.0]})
    );
    assert_eq!(
        value["keypoints"][5],
        json!({"x": 2.5, "y": 0.5, "radius": 0.5, "kind": "junction", "governors": [0, 1, 2]})
    );
    assert_eq!(
        value["paths"][1],
        json!({"from": 7, "to": 8, "governors": [6, 0], "curve": "parabola"})
    );
}

#[test]
fn documents_satisfy_their_schema() {
    let schema: Value = serde_json::from_str(SCHEMA).unwrap();
    let validator = jsonschema::validator_for(&schema).unwrap();
    let mut document: Value =
        serde_json::from_str(&write(&source(), &samples::l_shape(), &[])).unwrap();
    let errors: Vec<_> = validator.iter_errors(&document).map(|e| e.to_string()).collect();
    assert_eq!(errors, [""; 0]);
    // The schema does refuse what is wrong.
    document["sites"][0].as_object_mut().unwrap().remove("b");
    assert!(!validator.is_valid(&document));
}

#[test]
fn a_piece_of_a_split_edge_carries_its_part() {
    let mut sites: Vec<Site> = samples::rectangle().sites().iter().collect();
    sites[0].part = 2;
    let axis = MedialAxis::from_parts(
        Engine::PathTracing,
        Side::Interior,
        Accuracy::Sampled(0.25),
        false,
        sites,
        [],
        Vec::new(),
    )
    .unwrap();
    let text = write(&Feature::default(), &axis, &[]);
    assert!(text.contains(r#""part":2"#) && text.contains(r#""accuracy":{"sampled":0.25}"#));
    assert_eq!(read_one(&text).unwrap().axis, axis);
}

#[test]
fn what_is_wrong_is_named() {
    assert_eq!(error(|d| d["version"] = json!(2)), "feature 0: version: 2 is not 1");
    assert_eq!(
        error(|d| d["type"] = json!("Feature")),
        "feature 0: type: `Feature` is no MedialAxis"
    );
    assert_eq!(
        error(|d| d["keypoints"][4]["kind"] = json!("knot")),
        "feature 0: keypoint 4: `knot` is no kind of keypoint; known are end, transition, junction, tip, clipped"
    );
    assert_eq!(
        error(|d| d["paths"][1]["curve"] = json!("line")),
        "feature 0: path 1: its governors make a parabola, not a line"
    );
    assert_eq!(
        error(|d| d["paths"][1]["to"] = json!(10)),
        "feature 0: numbers: a site or keypoint is named that is not listed"
    );
    assert_eq!(error(|d| d["sites"][6]["p"] = Value::Null), "feature 0: site 6: `p` is missing");
    assert!(error(|d| d["accuracy"] = json!("good")).ends_with("`good` is not `exact`"));
}

#[test]
fn broken_lines_name_themselves() {
    let good = write(&Feature::default(), &samples::rectangle(), &[]);
    let text = format!("{good}\n{{\"type\": \"MedialAxis\", }}\n");
    let read: Vec<_> = read(&text).collect();
    assert_eq!(read.len(), 2);
    let said = read[1].as_ref().unwrap_err().to_string();
    assert!(said.starts_with("line 3, column 24: "), "{said}");
}

#[test]
fn samples_are_points_of_their_paths_and_come_back() {
    use medial::engine::{Options, raster_transform};
    use medial::raster::{Grid, Mask};
    let schema: Value = serde_json::from_str(SCHEMA).unwrap();
    let validator = jsonschema::validator_for(&schema).unwrap();
    let grid = Grid { origin: Point::new(7.0, 3.0), cell: [0.5, -0.5], columns: 40, rows: 30 };
    // A ring with a tail: a closed line and one with an end.
    let is_inside = |x: u32, y: u32| {
        let (dx, dy) = (x as i32 - 15, y as i32 - 15);
        (30..=130).contains(&(dx * dx + dy * dy)) || (dy.abs() < 2 && x > 18)
    };
    let mask = Mask::new(grid, is_inside).unwrap();
    for residual in [Some(2.0), None] {
        let options = Options { residual, ..Options::default() };
        let axis = raster_transform(&mask, &options).unwrap();
        let text = write(&source(), &axis, &[]);
        let value: Value = serde_json::from_str(&text).unwrap();
        let errors: Vec<_> = validator.iter_errors(&value).map(|error| error.to_string()).collect();
        assert_eq!(errors, [""; 0]);
        let read = read_one(&text).unwrap().axis;
        assert_eq!(read.accuracy, Accuracy::Sampled(0.5));
        let counts = |axis: &MedialAxis| (axis.keypoints().len(), axis.paths().len());
        assert_eq!(counts(&read), counts(&axis));
        let disks = |axis: &MedialAxis| {
            let disk = |k: medial::axis::Keypoint| [k.position.x, k.position.y, k.radius];
            let mut all: Vec<[f64; 3]> = axis.keypoints().iter().map(disk).collect();
            all.sort_by(|a, b| a.partial_cmp(b).unwrap());
            all
        };
        assert_eq!(disks(&read), disks(&axis));
        assert_eq!(write(&source(), &read, &[]), text, "what was read is written as it was");
    }
}

#[test]
fn a_corner_of_a_ring_without_edges_is_named() {
    use medial::domain::{Domain, Options};
    use medial::engine::path_tracing;
    let square = |low: f64, high: f64| {
        [(low, low), (high, low), (high, high), (low, high)].map(|(x, y)| Point::new(x, y)).to_vec()
    };
    let rings = vec![square(0.0, 6.0), square(2.0, 4.0)];
    let axis =
        path_tracing(&Domain::from_polygons(&[rings], &Options::default()).unwrap()).unwrap();
    let mut document: Value = serde_json::from_str(&write(&source(), &axis, &[])).unwrap();
    let sites = document["sites"].as_array_mut().unwrap();
    let corner = sites.iter_mut().find(|site| site["kind"] == "vertex").unwrap();
    corner["ring"] = json!(7);
    let axis = read_one(&document.to_string()).unwrap().axis;
    let error = medial::ops::polygons_of(&axis).unwrap_err().to_string();
    assert!(error.ends_with("is of a ring without edges") && error.contains("ring 7"), "{error}");
}
