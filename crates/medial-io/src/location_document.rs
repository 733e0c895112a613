//! The location document: JSON Lines, what of the boundary of one feature is nearest to a point a line.
//!
//! Its JSON Schema is `schema/location.schema.json` of this crate, also in [`SCHEMA`].

use crate::Feature;
use crate::axis_document::{SiteRecord, site_record};
use medial::geom::Point;
use medial::ops::Located;
use serde::Serialize;
use serde_json::value::RawValue;

/// JSON Schema of one document.
pub const SCHEMA: &str = include_str!("../schema/location.schema.json");

#[derive(Serialize)]
struct Document<'a> {
    #[serde(rename = "type")]
    kind: &'static str,
    version: u32,
    feature: usize,
    id: Option<&'a RawValue>,
    point: [f64; 2],
    side: &'static str,
    distance: f64,
    nearest: Vec<Nearest>,
}

#[derive(Serialize)]
struct Nearest {
    site: SiteRecord<'static>,
    footpoint: [f64; 2],
}

/// The document of one point, with its line end.
#[must_use]
pub fn write(source: &Feature, point: Point, located: &Located) -> String {
    let document = Document {
        kind: "Location",
        version: 1,
        feature: source.index,
        id: source.id.as_deref(),
        point: [point.x, point.y],
        side: located.region.name(),
        distance: located.distance,
        nearest: located
            .contacts
            .iter()
            .map(|contact| Nearest {
                site: site_record(&contact.site),
                footpoint: [contact.footpoint.x, contact.footpoint.y],
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
    use crate::samples;

    #[test]
    fn a_point_on_a_diagonal_has_two_walls() {
        let point = Point::new(0.5, 0.5);
        let text = samples::with_voronoi(&samples::square_rings(), |voronoi| {
            write(&Feature::default(), point, &voronoi.locate(point).unwrap())
        });
        let expected = "{\"type\":\"Location\",\"version\":1,\"feature\":0,\"id\":null,\"point\":[0.5,0.5],\
            \"side\":\"interior\",\"distance\":0.5,\"nearest\":[\
            {\"site\":{\"kind\":\"edge\",\"polygon\":0,\"ring\":0,\"index\":0,\"a\":[0.0,0.0],\"b\":[2.0,0.0]},\
            \"footpoint\":[0.5,0.0]},\
            {\"site\":{\"kind\":\"edge\",\"polygon\":0,\"ring\":0,\"index\":3,\"a\":[0.0,2.0],\"b\":[0.0,0.0]},\
            \"footpoint\":[0.0,0.5]}]}\n";
        assert_eq!(text, expected);
    }
    #[test]
    fn documents_follow_the_schema() {
        let schema = serde_json::from_str(SCHEMA).unwrap();
        let validator = jsonschema::validator_for(&schema).unwrap();
        // Inside, at a corner and outside.
        for (x, y) in [(0.5, 0.5), (2.0, 2.0), (3.0, 1.0)] {
            let point = Point::new(x, y);
            let text = samples::with_voronoi(&samples::square_rings(), |voronoi| {
                write(&Feature::default(), point, &voronoi.locate(point).unwrap())
            });
            let document = serde_json::from_str(&text).unwrap();
            assert!(validator.is_valid(&document), "{text}");
        }
        assert!(!validator.is_valid(&serde_json::json!({ "type": "Location" })));
    }
}
