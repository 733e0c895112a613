//! The offset document: JSON Lines, a parallel curve of one feature at one distance a line; arcs stay arcs.
//!
//! Its JSON Schema is `schema/offset.schema.json` of this crate, also in [`SCHEMA`].

use crate::Feature;
use medial::axis::Engine;
use medial::geom::Point;
use medial::ops::{Outline, Sense, Stroke};
use serde::Serialize;
use serde_json::value::RawValue;

/// JSON Schema of one document.
pub const SCHEMA: &str = include_str!("../schema/offset.schema.json");

#[derive(Serialize)]
struct Document<'a> {
    #[serde(rename = "type")]
    kind: &'static str,
    version: u32,
    engine: &'static str,
    feature: usize,
    id: Option<&'a RawValue>,
    distance: f64,
    area: f64,
    length: f64,
    /// Contours of strokes.
    polygons: Vec<Vec<Vec<Record>>>,
}

#[derive(Serialize)]
struct Record {
    kind: &'static str,
    from: [f64; 2],
    to: [f64; 2],
    #[serde(flatten)]
    circle: Option<Circle>,
}

#[derive(Serialize)]
struct Circle {
    centre: [f64; 2],
    radius: f64,
    sense: &'static str,
}

/// The document of one feature at one distance, with its line end.
#[must_use]
pub fn write(source: &Feature, engine: Engine, distance: f64, outline: &Outline) -> String {
    let pair = |p: Point| [p.x, p.y];
    let record = |stroke: Stroke| match stroke {
        Stroke::Line { from, to } => {
            Record { kind: "line", from: pair(from), to: pair(to), circle: None }
        }
        Stroke::Arc { from, to, centre, radius, sense, .. } => {
            let sense = match sense {
                Sense::Counterclockwise => "counterclockwise",
                Sense::Clockwise => "clockwise",
            };
            let circle = Circle { centre: pair(centre), radius, sense };
            Record { kind: "arc", from: pair(from), to: pair(to), circle: Some(circle) }
        }
    };
    let document = Document {
        kind: "Offset",
        version: 1,
        engine: engine.name(),
        feature: source.index,
        id: source.id.as_deref(),
        distance,
        area: outline.area(),
        length: outline.length(),
        polygons: outline
            .polygons
            .iter()
            .map(|polygon| {
                let contours = polygon.0.iter();
                contours.map(|c| c.strokes().into_iter().map(record).collect()).collect()
            })
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
    use medial::domain::{Domain, Options};
    use medial::ops::offsets;
    use serde_json::Value;

    #[test]
    fn documents_follow_the_schema() {
        let p = |x: f64, y: f64| Point::new(x, y);
        let l = [p(0., 0.), p(2., 0.), p(2., 1.), p(1., 1.), p(1., 2.), p(0., 2.)];
        let domain = Domain::from_polygons(&[vec![l.to_vec()]], &Options::default()).unwrap();
        let axis = medial::engine::path_tracing(&domain).unwrap();
        let outline = &offsets(&domain, &axis, &[0.25]).unwrap()[0];
        let text = write(&Feature::default(), Engine::PathTracing, 0.25, outline);
        let document: Value = serde_json::from_str(&text).unwrap();
        let schema = serde_json::from_str(SCHEMA).unwrap();
        let validator = jsonschema::validator_for(&schema).unwrap();
        assert!(validator.is_valid(&document), "{text}");
        let strokes = document["polygons"][0][0].as_array().unwrap();
        let arcs: Vec<&Value> = strokes.iter().filter(|s| s["kind"] == "arc").collect();
        assert_eq!((strokes.len(), arcs.len()), (7, 1));
        assert_eq!(arcs[0]["centre"], serde_json::json!([1.0, 1.0]));
        assert_eq!(arcs[0]["sense"], "clockwise");
        let mut wrong = document;
        wrong["polygons"][0][0][0]["kind"] = "curve".into();
        assert!(!validator.is_valid(&wrong));
    }
}
