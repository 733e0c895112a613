//! Short ways from ring to ring, to show that they lie in one face.
//!
//! A way that leaves one ring on its outer side, arrives at the next one on its outer side, and
//! touches nothing on its way but its ends shows that the same lies around both rings.

use crate::domain::Corner;
use crate::domain::rings::{Ring, Rings};
use crate::geom::{Point, orient2d};

/// For each ring, in the given order, a vertex of it and a vertex of the ring before, seen from
/// which the other one is on the outer side of the ring; twice one vertex if none was found, as for
/// the first ring. Nothing at all for a single ring.
pub(super) fn links(rings: &Rings, order: &[u32]) -> Vec<[u32; 2]> {
    if order.len() < 2 {
        return Vec::new();
    }
    let mut before = None;
    let mut links = Vec::with_capacity(order.len());
    for &ring in order {
        let first = rings.rings[ring as usize].first;
        links.push(before.and_then(|other| link(rings, ring, other)).unwrap_or([first; 2]));
        before = Some(ring);
    }
    links
}

fn link(rings: &Rings, one: u32, other: u32) -> Option<[u32; 2]> {
    let (a, b) = (&rings.rings[one as usize], &rings.rings[other as usize]);
    let way = rings.point(b.first) - rings.point(a.first);
    let (from, to) = (farthest(rings, one, way), farthest(rings, other, -way));
    let (p, q) = (rings.point(from), rings.point(to));
    (leaves_outwards(rings, a, from, q) && leaves_outwards(rings, b, to, p)).then_some([from, to])
}

/// The vertex of a ring that is farthest in a direction, up to rounding.
fn farthest(rings: &Rings, ring: u32, way: Point) -> u32 {
    let first = rings.rings[ring as usize].first;
    let (mut best, mut most) = (first, f64::NEG_INFINITY);
    for (vertex, p) in (first..).zip(rings.ring_points(ring)) {
        let along = p.dot(way);
        if along > most {
            (best, most) = (vertex, along);
        }
    }
    best
}

/// Whether the way from a vertex of a ring to a point starts on the outer side of the ring.
fn leaves_outwards(rings: &Rings, ring: &Ring, vertex: u32, to: Point) -> bool {
    let end = ring.first + ring.len;
    let before = if vertex == ring.first { end - 1 } else { vertex - 1 };
    let after = if vertex + 1 == end { ring.first } else { vertex + 1 };
    let [a, p, b] = [before, vertex, after].map(|k| rings.point(k));
    let (one, other) = (orient2d(a, p, to), orient2d(p, b, to));
    // What a hole encloses is on the right of its ring, and so its outer side on the left.
    match (ring.hole, rings.corners[vertex as usize]) {
        (false, Corner::Convex) => one < 0.0 || other < 0.0,
        (false, _) => one < 0.0 && other < 0.0,
        (true, Corner::Reflex) => one > 0.0 || other > 0.0,
        (true, _) => one > 0.0 && other > 0.0,
    }
}
