//! Pairs of a peninsula and a bay that it fits into: JSON lines.

use crate::{Feature, Json};
use medial::ops::LimbPair;
use serde::Serialize;

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
