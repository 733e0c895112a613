//! What must hold for features with curves, whatever the bytes they come from.

use medial_io::{Feature, Format, ReadOptions, read_with};

/// Reads bytes in a format, and tells what is wrong with the pieces of curves.
///
/// # Errors
/// What is wrong, with the number of the feature.
pub fn check_features(format: Format, bytes: &[u8]) -> Result<(), String> {
    for text in [None, Some("AV fi".to_owned())] {
        let options = ReadOptions { text, ..ReadOptions::default() };
        let Ok(layer) = read_with(format, bytes, &options) else { continue };
        for feature in layer.flatten() {
            check(&feature).map_err(|fault| format!("feature {}: {fault}", feature.index))?;
        }
    }
    Ok(())
}

fn check(feature: &Feature) -> Result<(), String> {
    let Some(curves) = &feature.curves else { return Ok(()) };
    if curves.edges.len() != feature.polygons.len() {
        return Err("polygons and their edges are not as many".to_owned());
    }
    for (polygon, edges) in feature.polygons.iter().zip(&curves.edges) {
        let lens = |ring: usize| (polygon.get(ring).map(Vec::len), edges.get(ring).map(Vec::len));
        if let Some(ring) = (0..polygon.len().max(edges.len())).find(|k| lens(*k).0 != lens(*k).1) {
            return Err(format!("ring {ring} has not as many edges as points"));
        }
        let n = curves.pieces.len() as u32;
        let is_known = |piece: &u32| *piece < n || *piece == medial::domain::Curves::STRAIGHT;
        if !edges.iter().flatten().all(is_known) {
            return Err("an edge has a piece that is not there".to_owned());
        }
    }
    for piece in &curves.pieces {
        for end in [piece.start, piece.end] {
            if end.curvature.is_nan() || !((end.tangent.norm() - 1.0).abs() < 1e-6) {
                return Err(format!("a piece ends in {end:?}"));
            }
        }
    }
    Ok(())
}
