//! Pairs of a peninsula and a bay that it fits into: JSON lines.
//!
//! The JSON Schema of a line is `schema/limb_pair.schema.json` of this crate, also in [`SCHEMA`].

use crate::{Feature, Json};
use medial::ops::LimbPair;
use serde::Serialize;

/// JSON Schema of one pair.
pub const SCHEMA: &str = include_str!("../schema/limb_pair.schema.json");

#[derive(Serialize)]
struct Document<'a> {
    #[serde(rename = "type")]
    kind: &'static str,
    version: u32,
    /// The feature of the input, and its identifier.
    feature: usize,
    id: Option<&'a Json>,
    /// The feature of the other input.
    other_feature: usize,
    /// Whether the peninsula is that of the input, and the bay that of the other one.
    moves: &'static str,
    peninsula: usize,
    bay: usize,
    gap: f64,
    depth: f64,
    fill: f64,
    turn: f64,
    shift: [f64; 2],
}

/// Appends one pair: limbs of a feature and of feature number `other` of another input; the peninsula is
/// that of the first one, or else of the other one.
pub fn write(out: &mut Vec<u8>, feature: &Feature, other: usize, of_first: bool, pair: &LimbPair) {
    let LimbPair { peninsula, bay, gap, depth, fill, turn, shift } = *pair;
    let document = Document {
        kind: "LimbPair",
        version: 1,
        feature: feature.index,
        id: feature.id.as_ref(),
        other_feature: other,
        moves: if of_first { "feature" } else { "other_feature" },
        peninsula,
        bay,
        gap,
        depth,
        fill,
        turn,
        shift: [shift.x, shift.y],
    };
    // Memory takes all that is written.
    let _ = serde_json::to_writer(&mut *out, &document);
    out.push(b'\n');
}

#[cfg(test)]
mod tests {
    use super::*;
    use medial::geom::Point;

    #[test]
    fn pairs_follow_the_schema() {
        let schema = serde_json::from_str(SCHEMA).unwrap();
        let validator = jsonschema::validator_for(&schema).unwrap();
        let shift = Point::new(1.0, -2.0);
        let pair =
            LimbPair { peninsula: 0, bay: 3, gap: 0.0, depth: 2.0, fill: 0.5, turn: -1.0, shift };
        let mut line = Vec::new();
        write(&mut line, &Feature::default(), 4, true, &pair);
        let mut document = serde_json::from_slice(&line).unwrap();
        assert!(validator.is_valid(&document), "{document}");
        document["moves"] = "both".into();
        assert!(!validator.is_valid(&document));
    }
}
