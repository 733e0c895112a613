//! Walks that pass a place more than once: simple rings, merged where they touch.
//!
//! # Method
//! 1. A walk is cut wherever it comes back to a place, so that each part is a simple ring; a ring that is
//!    cut out starts at the place where it hangs on another one.
//! 2. The diagram of each ring is made as if there were no other.
//! 3. Two diagrams are merged at the one place that their rings share: two connected sets with a common
//!    corner, as two chains are. The curve leaves the corner in one of the two interior sectors between
//!    the rings, and comes back in the other.
//! 4. At most one sector at a place is reflex, so the place has one cell at most; it gets the number that
//!    the corner of this sector has anywhere else.

use std::cmp::Reverse;

use super::diagram::{Diagram, NONE};
use super::elements::{Member, Members};
use super::merge::{Joint, Merge};
use super::order;
use crate::domain::{Corner, Domain, Edge, Site, Walk};
use crate::engine::EngineError;
use crate::engine::watch::Watch;
use crate::geom::Point;

/// How often a place of the table of corners is found taken, per corner, before corners are sorted.
const MOST_PROBES: usize = 16;

/// The simple rings of a walk, each by its edges in boundary order; the last one is never cut out.
pub(super) fn simple_rings(members: Members<'_>, walk: &Walk) -> Vec<Vec<u32>> {
    let mut open: Vec<u32> = Vec::new();
    if !members.touches {
        open.extend(walk.edges());
        return vec![open];
    }
    let place = places(members.domain, walk);
    let place_of = |edge: u32| place[(edge - walk.first) as usize] as usize;
    let mut position = vec![NONE; place.len()];
    let mut rings = Vec::new();
    for edge in walk.edges() {
        let at = position[place_of(edge)];
        if at != NONE {
            let ring: Vec<u32> = open.drain(at as usize..).collect();
            for &edge in &ring {
                position[place_of(edge)] = NONE;
            }
            rings.push(ring);
        }
        position[place_of(edge)] = open.len() as u32;
        open.push(edge);
    }
    rings.push(open);
    rings
}

/// The place where each edge of a walk starts, by a number.
fn places(domain: &Domain, walk: &Walk) -> Vec<u32> {
    let start = |edge: u32| domain.edge(edge).start;
    let mut order: Vec<u32> = walk.edges().collect();
    order.sort_unstable_by(|&a, &b| start(a).lexicographic(start(b)));
    let mut place = vec![0; order.len()];
    for (number, run) in (0..).zip(order.chunk_by(|&a, &b| start(a) == start(b))) {
        for edge in run {
            place[(edge - walk.first) as usize] = number;
        }
    }
    place
}

/// A ring where it hangs on others.
struct Touch {
    /// Its first and its last edge.
    first: u32,
    last: u32,
    /// The edges before and after it, of rings that are merged already.
    before: u32,
    after: u32,
    /// The corner as the other rings have it.
    own: Member,
    /// The number of the place where it hangs.
    place: u32,
}

/// All rings that hang on others; at one place in boundary order.
///
/// Places come in rounds, so that the first ones lie everywhere along a ring: a ring that is added next
/// to another one is not compared with all that lies beyond that.
fn touches(domain: &Domain, walk: &Walk, rings: &[Vec<u32>]) -> Vec<Touch> {
    let mut last_of = vec![NONE; walk.len as usize];
    for ring in rings {
        if let (Some(first), Some(&last)) = (ring.first(), ring.last()) {
            last_of[(first - walk.first) as usize] = last;
        }
    }
    let mut touches = Vec::new();
    let mut place = 0;
    for (k, ring) in rings.iter().enumerate() {
        // What else hangs where a ring is cut out hangs on the ring that stays.
        let is_cut_out = k + 1 < rings.len();
        for at in usize::from(is_cut_out)..ring.len() {
            let (end, after) = (ring[(at + ring.len() - 1) % ring.len()], ring[at]);
            let own = if at == 0 { Member::start(after) } else { Member::end(end) };
            let mut before = end;
            loop {
                let first = domain.edge(before).next;
                if first == after {
                    break;
                }
                let last = last_of[(first - walk.first) as usize];
                touches.push(Touch { first, last, before, after, own, place });
                before = last;
            }
            place += 1;
        }
    }
    touches.sort_by_key(|touch: &Touch| Reverse(order::round(touch.place)));
    touches
}

/// Merges the diagrams of the rings of one walk.
pub(super) fn merge(
    members: Members<'_>,
    diagram: &mut Diagram,
    walk: &Walk,
    rings: &[Vec<u32>],
    watch: &Watch<'_>,
) -> Result<(), EngineError> {
    let touches = touches(members.domain, walk, rings);
    for &Touch { first, last, before, after, own, .. } in &touches {
        let corners = [own, Member::start(first)];
        let joints = [
            Joint::of_rings(&members, [before, first], true, corners),
            Joint::of_rings(&members, [last, after], false, corners),
        ];
        Merge::new(members, diagram, &joints, watch).run()?;
    }
    for touch in &touches {
        for edge in [touch.first, touch.after] {
            if members.domain.edge(edge).corner == Corner::Reflex {
                diagram.rename(touch.own, members.member(Site::corner(edge)));
            }
        }
    }
    Ok(())
}

/// Whether any two corners share a place, or an edge goes straight on.
pub(super) fn any(domain: &Domain) -> bool {
    let edges = domain.edges();
    if edges.iter().any(|edge| edge.corner == Corner::Straight) {
        return true;
    }
    // A table of corners by hash, at most half full.
    let bits = (2 * edges.len()).next_power_of_two().trailing_zeros().max(1);
    let mut table = vec![NONE; 1 << bits];
    let mut left = MOST_PROBES * edges.len();
    for (k, edge) in (0..).zip(edges) {
        let mut at = (hash(edge.start) >> (u64::BITS - bits)) as usize;
        while table[at] != NONE {
            if domain.edge(table[at]).start == edge.start {
                return true;
            }
            if left == 0 {
                return any_in_order(edges);
            }
            left -= 1;
            at = (at + 1) & (table.len() - 1);
        }
        table[at] = k;
    }
    false
}

/// The same by sorting.
fn any_in_order(edges: &[Edge]) -> bool {
    let mut corners: Vec<Point> = edges.iter().map(|edge| edge.start).collect();
    corners.sort_unstable_by(|a, b| a.lexicographic(*b));
    corners.windows(2).any(|pair| pair[0] == pair[1])
}

/// A number whose first bits depend on all bits of a point; the same for either zero.
fn hash(p: Point) -> u64 {
    const ODD: u64 = 0x9e37_79b9_7f4a_7c15;
    let [x, y] = [p.x, p.y].map(|v| (v + 0.0).to_bits());
    let mixed = (x.wrapping_mul(ODD) ^ y.rotate_left(32)).wrapping_mul(ODD);
    (mixed ^ mixed >> 29).wrapping_mul(ODD)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Options;

    #[test]
    fn corners_in_one_place_are_found_by_table_and_in_order() {
        let ring = |corners: &[(f64, f64)]| -> Vec<Point> {
            corners.iter().map(|&(x, y)| Point::new(x, y)).collect()
        };
        let outer = ring(&[(-4., 0.), (4., -1.), (0., 6.)]);
        let hole = |x: f64| ring(&[(x, 1.), (0., 3.), (x / 2., 2.5)]);
        let domain = |rings: &[Vec<Point>]| {
            Domain::from_polygons(&[rings.to_vec()], &Options::default()).unwrap()
        };
        let apart = domain(&[outer.clone(), hole(-1.)]);
        let touching = domain(&[outer, hole(-1.), hole(1.)]);
        assert!(!any(&apart) && !any_in_order(apart.edges()));
        assert!(any(&touching) && any_in_order(touching.edges()));
    }
}
