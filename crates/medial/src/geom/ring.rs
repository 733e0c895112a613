//! Rings of points.

use super::Point;
use std::collections::HashMap;

/// The area within a ring, negative if it runs clockwise; rounded.
#[must_use]
pub fn signed_area(ring: &[Point]) -> f64 {
    let Some(&origin) = ring.first() else { return 0.0 };
    let twice: f64 = ring.windows(2).map(|p| (p[0] - origin).cross(p[1] - origin)).sum();
    0.5 * twice
}

/// A ring, parted where it comes back to a point: each part meets no point twice, and those of two points, which bound
/// nothing, are left out.
///
/// Of a ring with an area to its left all along, which touches itself but does not cross, the parts are the outer ring
/// of that area, or none, and holes.
pub(crate) fn parted(ring: Vec<Point>) -> Vec<Vec<Point>> {
    let bits = |p: Point| ((p.x + 0.0).to_bits(), (p.y + 0.0).to_bits());
    let mut parts = Vec::new();
    let mut open: Vec<Point> = Vec::new();
    let mut places = HashMap::new();
    for p in ring {
        if let Some(&place) = places.get(&bits(p)) {
            let part = open.split_off(place);
            for &q in &part {
                places.remove(&bits(q));
            }
            parts.push(part);
        }
        places.insert(bits(p), open.len());
        open.push(p);
    }
    parts.push(open);
    // Two points, there and back, bound nothing.
    parts.retain(|part| part.len() > 2);
    parts
}
