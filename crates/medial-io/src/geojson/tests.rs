use super::*;
use crate::{Drawing, Feature, FeatureError, samples};
use medial::geom::Point;
use serde_json::Value;

const SQUARE: &str = r#"{"type":"Polygon","coordinates":[[[0,0],[1,0],[1,1],[0,0]]]}"#;

fn features(text: &str) -> Vec<Result<Feature, FeatureError>> {
    read(text).unwrap().collect()
}

fn feature(geometry: &str) -> Feature {
    features(geometry).remove(0).unwrap()
}

fn sampled(properties: &str) -> Feature {
    let text = format!(
        r#"{{"type":"Feature","id":12345678901234567890123,"properties":{properties},"geometry":{SQUARE}}}"#
    );
    feature(&text)
}

/// The output as a JSON value.
fn written(source: &Feature, drawing: Drawing) -> Vec<Value> {
    let text = features_of(source, drawing);
    serde_json::from_str(&format!("[{text}]")).unwrap()
}

fn features_of(source: &Feature, drawing: Drawing) -> String {
    let mut out = Vec::new();
    super::features(&mut out, source, &samples::l_shape(), &[], drawing);
    String::from_utf8(out.split_off(SEPARATOR.len())).unwrap()
}

#[test]
fn a_bare_polygon_is_one_feature() {
    let read = feature(SQUARE);
    assert_eq!((read.index, read.polygons.len()), (0, 1));
    assert_eq!(read.polygons[0][0][2], Point::new(1.0, 1.0));
    assert!(read.polygonal);
}

#[test]
fn coordinates_are_read_exactly() {
    // Halfway cases and long tails, as GDAL prints them.
    let text = r#"{"type":"Polygon","coordinates":[[[5453786.599999999627471,9007199254740993],
        [0.1,1e-7,77.5],[123456789012345678901234567890,-0]]]}"#;
    let ring = &feature(text).polygons[0][0];
    assert_eq!(ring[0].x.to_bits(), 5453786.6_f64.to_bits());
    assert_eq!(ring[0].y, 9007199254740992.0);
    assert_eq!(ring[1], Point::new(0.1, 1e-7));
    assert_eq!(ring[2].x, 1.2345678901234568e29);
    assert!(ring[2].y == 0.0 && ring[2].y.is_sign_negative());
}

#[test]
fn members_may_come_in_any_order() {
    let text = format!(
        r#"{{"features":[{{"geometry":{SQUARE},"id":"a","type":"Feature","properties":null}}],
            "crs":{{"type":"name","properties":{{"name":"EPSG:2193"}}}},"type":"FeatureCollection"}}"#
    );
    let layer = read(&text).unwrap();
    let crs: Value =
        serde_json::from_str(layer.crs.as_ref().unwrap().member().unwrap().get()).unwrap();
    assert_eq!(crs["properties"]["name"], "EPSG:2193");
    assert_eq!(layer.len, Some(1));
    let read: Vec<_> = layer.map(Result::unwrap).collect();
    assert_eq!(read[0].id.as_ref().unwrap().get(), "\"a\"");
    assert_eq!(read[0].polygons.len(), 1);
}

#[test]
fn nested_collections_give_their_polygons() {
    let text = format!(
        r#"{{"type":"GeometryCollection","geometries":[{{"type":"Point","coordinates":[0,0]}},
           {{"type":"GeometryCollection","geometries":[{SQUARE}]}},
           {{"type":"MultiPolygon","coordinates":[[[[0,0],[1,0],[1,1]]],[[[5,0],[6,0],[6,1]]]]}}]}}"#
    );
    let read = feature(&text);
    assert_eq!(read.polygons.len(), 3);
    assert_eq!(read.notes.len(), 1);
    assert_eq!(read.notes[0].code, "part_not_polygon");
}

#[test]
fn deep_nesting_is_refused_and_not_followed() {
    let (open, close) = (r#"{"type":"GeometryCollection","geometries":["#, "]}");
    let text = format!("{}{SQUARE}{}", open.repeat(60), close.repeat(60));
    let error = features(&text).remove(0).unwrap_err();
    assert!(error.to_string().contains("nested deeper than 32"), "{error}");
}

#[test]
fn other_geometries_are_not_polygonal() {
    let line = feature(r#"{"type":"LineString","coordinates":[[0,0],[1,1]]}"#);
    assert!(!line.polygonal && line.polygons.is_empty());
    assert_eq!(line.geometry, "a LineString");
    let null = feature(r#"{"type":"Feature","properties":null,"geometry":null}"#);
    assert_eq!((null.polygonal, null.geometry.as_str()), (false, "without a geometry"));
    let empty = feature(r#"{"type":"Polygon","coordinates":[]}"#);
    assert!(empty.polygonal && empty.polygons.concat().is_empty());
}

#[test]
fn a_malformed_feature_spoils_no_other() {
    let text = format!(
        "{{\"type\":\"FeatureCollection\",\"features\":[\n\
         {{\"type\":\"Feature\",\"properties\":null,\"geometry\":{{\"type\":\"Polygon\",\
         \"coordinates\":[[[0,\"x\"]]]}}}},\n\
         {{\"type\":\"Feature\",\"properties\":null,\"geometry\":{SQUARE}}}]}}"
    );
    let read = features(&text);
    let error = read[0].as_ref().unwrap_err();
    assert_eq!(error.feature, 0);
    let said = error.to_string();
    assert!(said.starts_with("line 2, column 87: invalid type: string"), "{said}");
    assert_eq!(read[1].as_ref().unwrap().index, 1);
}

#[test]
fn broken_json_names_line_and_column() {
    let error = read("{\"type\":\"FeatureCollection\",\n\"features\":[}").err().unwrap();
    assert_eq!(error.to_string(), "line 2, column 13: expected value");
    let error = read("[1,2]").err().unwrap();
    assert!(error.to_string().contains("a GeoJSON object"), "{error}");
    assert!(read("  ").is_err());
}

#[test]
fn lines_are_features() {
    let text = format!("{SQUARE}\n\n\u{1e}{{\"type\":\"Feature\"}}\n{{\n");
    let read: Vec<_> = read_lines(&text).collect();
    assert_eq!(read.len(), 3);
    assert!(read[0].is_ok() && read[1].is_ok());
    assert!(read[2].as_ref().unwrap_err().to_string().starts_with("line 4, column"));
}

#[test]
fn a_path_says_everything_about_itself() {
    let out = written(&sampled(r#"{"a":1}"#), Drawing::default());
    assert_eq!(out.len(), 9);
    let spine = &out[2]; // from the transition (1, 0.5) to the junction (2.5, 0.5)
    let told = &spine["properties"];
    assert_eq!(told["engine"], "path_tracing");
    assert_eq!(told["curve"], "line");
    assert_eq!(told["length"], 1.5);
    for name in ["radius_min", "radius_max", "radius_start", "radius_end"] {
        assert_eq!(told[name], 0.5, "{name}");
    }
    assert_eq!(
        (&told["kind_start"], &told["kind_end"]),
        (&"transition".into(), &"junction".into())
    );
    assert_eq!((&told["governor_left"], &told["governor_right"]), (&2.into(), &0.into()));
    assert_eq!(spine["geometry"]["type"], "LineString");
    assert_eq!(spine["geometry"]["coordinates"], serde_json::json!([[1.0, 0.5], [2.5, 0.5]]));
}

#[test]
fn parabolas_are_drawn_within_the_tolerance() {
    let coarse = written(&sampled("{}"), Drawing { tolerance: Some(1.0), ..Drawing::default() });
    let fine = written(&sampled("{}"), Drawing { tolerance: Some(1e-6), ..Drawing::default() });
    let points = |f: &Value| f["geometry"]["coordinates"].as_array().unwrap().len();
    assert_eq!(points(&coarse[1]), 2);
    // x runs from 0 to √2-1 over d = 1: ceil(0.41421356 / √8e-6) = 147 pieces.
    assert_eq!(points(&fine[1]), 148);
}

#[test]
fn source_properties_keep_their_order_and_digits() {
    let source = sampled(r#"{"z":1.10, "big":123456789012345678901, "list":[1, {"k":"a b"}]}"#);
    let text = features_of(&source, Drawing::default());
    assert!(
        text.contains(
            r#""z":1.10,"big":123456789012345678901,"list":[1,{"k":"a b"}],"feature":0,"#
        ),
        "{text}"
    );
    assert!(text.contains(r#""source_id":12345678901234567890123,"#));
}

#[test]
fn names_that_are_ours_get_a_prefix() {
    let source = sampled(r#"{"length":5,"source_id":7,"curve":"c","source_curve":"d"}"#);
    let out = written(&source, Drawing::default());
    let told = &out[0]["properties"];
    assert_eq!(told["source_length"], 5);
    assert_eq!(told["source_source_id"], 7);
    assert_eq!(told["source_curve"], "d");
    assert_eq!(told["source_source_curve"], "c");
    assert_eq!(told["curve"], "line");
}

#[test]
fn the_radius_is_the_third_coordinate_on_request() {
    let drawing = Drawing { radius_as_z: true, keypoints: true, ..Drawing::default() };
    let out = written(&sampled("{}"), drawing);
    assert_eq!(
        out[3]["geometry"]["coordinates"],
        serde_json::json!([[2.5, 0.5, 0.5], [3.0, 0.0, 0.0]])
    );
    let points: Vec<_> = out.iter().filter(|f| f["geometry"]["type"] == "Point").collect();
    assert_eq!(points.len(), 10);
    let junction = points[5];
    assert_eq!(junction["geometry"]["coordinates"], serde_json::json!([2.5, 0.5, 0.5]));
    assert_eq!(junction["properties"]["kind"], "junction");
    assert_eq!(junction["properties"]["degree"], 3);
    assert_eq!(junction["properties"]["governors"], serde_json::json!([0, 1, 2]));
}

#[test]
fn a_collection_is_valid_json_and_keeps_its_crs() {
    let member = serde_json::value::RawValue::from_string("{\"type\": \"name\"}".into());
    let crs = crate::Crs::of_member(member.unwrap());
    let text = header(Some(&crs)) + &features_of(&sampled("{}"), Drawing::default()) + FOOTER;
    let whole: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(whole["type"], "FeatureCollection");
    assert_eq!(whole["crs"]["type"], "name");
    assert_eq!(whole["features"].as_array().unwrap().len(), 9);
    let empty: Value = serde_json::from_str(&(header(None) + FOOTER)).unwrap();
    assert_eq!(empty["features"], serde_json::json!([]));
}

#[test]
fn a_line_holds_one_feature_whatever_the_source_looked_like() {
    let source = sampled("{\"a\":[1,\n2],\"b\":\"x,\\ny\"}");
    let mut lines = Vec::new();
    feature_lines(&mut lines, &source, &samples::l_shape(), &[], Drawing::default());
    let lines = String::from_utf8(lines).unwrap();
    assert_eq!(lines.lines().count(), 9);
    for line in lines.lines() {
        let value: Value = serde_json::from_str(line).unwrap();
        assert_eq!(value["properties"]["b"], "x,\ny");
    }
}

#[test]
fn a_number_out_of_range_names_its_vertex() {
    let text = r#"{"type":"Polygon","coordinates":[[[0,0],[9,0],[9,9]],[[1,1],[2,1e999],[2,2]]]}"#;
    let error = read(text).unwrap().next().unwrap().unwrap_err();
    let told = "line 1, column 68: ring 1, vertex 1: the number is out of range";
    assert_eq!(error.to_string(), told);
    let text = r#"{"type":"MultiPolygon","coordinates":[[[[0,0],[9,0],[-1e999,9]]]]}"#;
    let error = read(text).unwrap().next().unwrap().unwrap_err();
    assert!(error.to_string().contains("polygon 0, ring 0, vertex 2: "), "{error}");
}

#[test]
fn a_coordinate_that_is_no_number_names_its_vertex() {
    for token in ["NaN", "nan", "Infinity", "-Infinity", "-inf"] {
        let text = format!(
            r#"{{"type":"FeatureCollection","features":[{{"type":"Feature","properties":{{"a":[1,2]}},
            "geometry":{{"type":"Polygon","coordinates":[[[0,0],[9,0],[{token},9]]]}}}}]}}"#
        );
        let error = read(&text).unwrap().next().unwrap().unwrap_err();
        let told = "ring 0, vertex 2: a coordinate is nothing, or not finite";
        assert!(error.to_string().ends_with(told), "{token}: {error}");
        assert!(error.to_string().starts_with("line 2, column "), "{token}: {error}");
    }
}

#[test]
fn numbers_that_json_does_not_have_are_nothing_among_properties() {
    let feature = |properties: &str, x: &str| {
        format!(
            "{{\"type\":\"Feature\",\"properties\":{properties},\"geometry\":{{\"type\":\"Polygon\",\
             \"coordinates\":[[[{x},0],[9,0],[9,9]]]}}}}"
        )
    };
    let good = feature("{\"NaN\":NaN,\"b\\\"\":-Infinity,\"c\":\"a NaN\"}", "0");
    let features = [good.clone(), feature("{}", "NaN"), feature("{}", "1")];
    let text = format!("{{\"type\":\"FeatureCollection\",\"features\":[{}]}}", features.join(","));
    let found: Vec<_> = read(&text).unwrap().collect();
    assert_eq!(found.len(), 3);
    let values = |feature: &Feature| -> Vec<String> {
        feature.properties.iter().map(|(name, value)| format!("{name}={value}")).collect()
    };
    let expected = ["NaN=null", "b\"=null", "c=\"a NaN\""];
    assert_eq!(values(found[0].as_ref().unwrap()), expected);
    assert!(found[1].is_err() && found[2].is_ok());
    let lines = features.join("\n");
    let found: Vec<_> = read_lines(&lines).collect();
    assert_eq!(values(found[0].as_ref().unwrap()), expected);
    let told = found[1].as_ref().unwrap_err().to_string();
    assert!(told.starts_with("line 2, ") && told.contains("ring 0, vertex 0: "), "{told}");
    assert!(found[2].is_ok());
}
