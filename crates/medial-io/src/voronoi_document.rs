//! The Voronoi document: JSON Lines, the Voronoi diagram of one feature a line.
//!
//! Its JSON Schema is `schema/voronoi.schema.json` of this crate, also in [`SCHEMA`].

use crate::Feature;
use crate::axis_document::{SiteRecord, site_record};
use medial::ops::Voronoi;
use serde::Serialize;
use serde_json::value::RawValue;

/// The JSON Schema of a document.
pub const SCHEMA: &str = include_str!("../schema/voronoi.schema.json");

#[derive(Serialize)]
struct Document<'a> {
    #[serde(rename = "type")]
    kind: &'static str,
    version: u32,
    engine: &'static str,
    sides: Vec<&'static str>,
    feature: usize,
    id: Option<&'a RawValue>,
    sites: Vec<SiteRecord<'static>>,
    points: Vec<PointRecord>,
    edges: Vec<EdgeRecord>,
    cells: Vec<CellRecord<'a>>,
}

#[derive(Serialize)]
struct PointRecord {
    x: f64,
    y: f64,
    radius: f64,
    kind: &'static str,
}

#[derive(Serialize)]
struct EdgeRecord {
    kind: &'static str,
    side: &'static str,
    from: u32,
    to: u32,
    governors: [Option<u32>; 2],
    curve: &'static str,
}

#[derive(Serialize)]
struct CellRecord<'a> {
    site: u32,
    side: &'static str,
    edges: &'a [u32],
}

/// The document of one diagram, with its line end.
#[must_use]
pub fn write(source: &Feature, voronoi: &Voronoi) -> String {
    let document = Document {
        kind: "Voronoi",
        version: 1,
        engine: voronoi.axes().next().map_or("", |axis| axis.engine.name()),
        sides: voronoi.axes().map(|axis| axis.side.name()).collect(),
        feature: source.index,
        id: source.id.as_deref(),
        sites: voronoi.sites().iter().map(site_record).collect(),
        points: voronoi
            .points()
            .iter()
            .map(|point| PointRecord {
                x: point.position.x,
                y: point.position.y,
                radius: point.radius,
                kind: point.kind.name(),
            })
            .collect(),
        edges: voronoi
            .edges()
            .iter()
            .map(|edge| EdgeRecord {
                kind: edge.kind.name(),
                side: edge.side.name(),
                from: edge.from,
                to: edge.to,
                governors: [Some(edge.left), edge.right],
                curve: voronoi.curve(edge).kind().name(),
            })
            .collect(),
        cells: voronoi
            .cells()
            .map(|cell| CellRecord { site: cell.site, side: cell.side.name(), edges: cell.edges })
            .collect(),
    };
    // Maps with string keys and finite numbers always have a JSON form.
    let mut line = serde_json::to_string(&document).unwrap_or_default();
    line.push('\n');
    line
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples;
    use serde_json::{Value, json};

    #[test]
    fn a_square_is_written_whole() {
        let text = samples::with_voronoi(&samples::square_rings(), |voronoi| {
            write(&Feature { index: 2, ..Feature::default() }, voronoi)
        });
        let found: Value = serde_json::from_str(&text).unwrap();
        let corner = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]];
        let edge = |k: usize| {
            json!({"kind": "edge", "polygon": 0, "ring": 0, "index": k,
                   "a": corner[k], "b": corner[(k + 1) % 4]})
        };
        assert_eq!(found["sites"], json!([edge(0), edge(1), edge(2), edge(3)]));
        assert_eq!((&found["type"], &found["version"]), (&json!("Voronoi"), &json!(1)));
        assert_eq!((&found["feature"], &found["id"]), (&json!(2), &Value::Null));
        assert_eq!(
            (&found["engine"], &found["sides"]),
            (&json!("path_tracing"), &json!(["interior"]))
        );
        let centre = json!({"x": 1.0, "y": 1.0, "radius": 1.0, "kind": "junction"});
        assert_eq!(found["points"].as_array().unwrap().iter().filter(|p| **p == centre).count(), 1);
        let is_path = |edge: &Value| edge["kind"] == "path" && edge["side"] == "interior";
        let edges = found["edges"].as_array().unwrap();
        assert_eq!((edges.len(), edges.iter().filter(|edge| is_path(edge)).count()), (4, 4));
        assert_eq!(found["cells"].as_array().unwrap().len(), 4);
        for cell in found["cells"].as_array().unwrap() {
            assert_eq!(cell["edges"].as_array().unwrap().len(), 2);
        }
    }

    #[test]
    fn documents_obey_their_schema() {
        let schema: Value = serde_json::from_str(SCHEMA).unwrap();
        let validator = jsonschema::validator_for(&schema).unwrap();
        for rings in [samples::square_rings(), samples::l_rings()] {
            let text =
                samples::with_both_sides(&rings, |voronoi| write(&Feature::default(), voronoi));
            let found: Value = serde_json::from_str(&text).unwrap();
            let errors: Vec<String> =
                validator.iter_errors(&found).map(|error| error.to_string()).collect();
            assert!(errors.is_empty(), "{errors:?}");
            let mut wrong = found;
            wrong["edges"][0]["kind"] = json!("spoke");
            assert!(!validator.is_valid(&wrong));
        }
    }
}
