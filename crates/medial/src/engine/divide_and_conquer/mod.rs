//! Divide and conquer: diagrams of chains are merged two at a time, after [Lee82].
//!
//! # Contract
//! The exact medial axis of the interior, as `path_tracing` gives it: keypoints, paths, governors and
//! their order are those of the true axis of the coordinates as given. Any number of holes and of
//! components. Rings that touch are refused for now ([`EngineError::Touching`]). It shares predicates,
//! domain and axis with `path_tracing`, and the way in which a governor list is ordered, placed and
//! written down; no search.
//!
//! # Method
//! 1. An edge with its two corners is a chain; its diagram has five cells, with the normals at both ends
//!    between them. A side of an edge is an element, so a diagram covers the whole plane.
//! 2. Chains that follow one another are merged two at a time, level by level and without recursion
//!    [Lee82, Fig. 8]; the last merge closes the ring (`merge.rs`).
//! 3. A merge follows the curve of all points as near to one chain as to the other [Lee82, §II]. Left of
//!    it the arcs of a cell are scanned counterclockwise, right of it clockwise, each from where the last
//!    scan ended; arcs whose far end the other chain takes away are dropped for good (`look.rs`). The
//!    nearer of the two arcs met ends the piece, is cut, and the next piece starts (`cut.rs`).
//! 4. Rings are merged the largest first, each with a closed curve around it, which starts where a normal
//!    of the ring, or another arc around its reflex corners, is lost to the others (`rings.rs`,
//!    `around.rs`).
//! 5. The axis is what the cells of the inner sides have for arcs, without the normals of edges at their
//!    own ends [Lee82, cor. 3] (`extract.rs`).
//!
//! # Departures
//! - [Lee82] keeps the side to the left of a chain only. That is not well defined: half-planes and wedges
//!   of an open chain reach infinity through other parts of it. Here both sides are kept, and every
//!   corner is an element, as in Lee and Drysdale. The cell of an element is then connected through the
//!   element, so for two chains with a common corner the part of the plane nearer to either of them is
//!   connected, and on the sphere one closed curve separates the two.
//! - A shared corner belongs to the first chain, which also wins every tie: the second chain counts where
//!   it is strictly nearer. So the cell that the second chain has for the corner is never entered; where
//!   the first one is nearest with the corner the curve runs along the rim of that cell, and into the
//!   corner along the normal of the second chain's edge. Where the boundary is convex at the corner it
//!   starts as the bisector of the two edges instead. Each corner thus has two places where the curve
//!   starts or ends, one on each side of the boundary, and whatever it does in between, at infinity too,
//!   is no special case.
//! - There is no stopping condition by the line of two elements: a walk ends in a shared corner or where
//!   both cells reach infinity. There the directions of a cell are scanned like one more arc: they are
//!   lost up to the one in which a point of the other chain is no nearer (`infinity.rs`).
//! - Ties are not broken arbitrarily. A vertex of a diagram that lies on the curve becomes one vertex of
//!   higher degree: contacts of two connected sets do not interleave around a disk, so the contacts of
//!   the other chain lie between two neighbouring ones, and exactly the arc between those is lost.
//! - Chains are single edges: the diagram of a chain of reflex corners is not built directly, since on its
//!   other side it is no simpler than any.
//! - Holes are not in the paper. Of a ring that is merged after all rings at least as wide, none there
//!   already can be surrounded: a ring whose cells are bounded by those of another one lies inside the
//!   hull of that, and is narrower. So what is nearer to the new ring is bounded by one closed curve.
//!   Along it an arc may be lost in the middle, or at both ends only; so every arc of a cell up to where
//!   the other cell has something is asked, and what is cut off an arc stays in the lists for as long as
//!   the curve may come back to it.
//! - Where the curve around a ring starts beside the cell of a reflex corner, doubles choose the arc at
//!   which the first scan of that cell begins. A wrong choice ends in an internal error or in a defect that
//!   the judge sees, and none was met; an exact choice is to come.

mod around;
mod cut;
mod diagram;
mod disks;
mod elements;
mod extract;
mod infinity;
mod look;
mod merge;
mod rings;

use super::watch::Watch;
use super::{EngineError, Options};
use crate::axis::MedialAxis;
use crate::domain::{Corner, Domain, Walk};
use crate::geom::{BoundsTree, Rect};
use diagram::Diagram;
use elements::Members;
use merge::{Joint, Merge};
use rings::Merged;

/// The exact medial axis of the interior of a domain: a second engine, which searches in another way.
///
/// # Errors
/// [`EngineError::Touching`] if the boundary touches itself; [`EngineError::Internal`] if an invariant of
/// the engine breaks, which no input should cause.
pub fn divide_and_conquer(domain: &Domain) -> Result<MedialAxis, EngineError> {
    divide_and_conquer_with(domain, &Options::default())
}

/// The same within limits, on one thread.
///
/// # Errors
/// As [`divide_and_conquer`]; and [`EngineError::Cancelled`] or [`EngineError::TimeLimit`].
pub fn divide_and_conquer_with(
    domain: &Domain,
    options: &Options<'_>,
) -> Result<MedialAxis, EngineError> {
    let n_edges = domain.edges().len();
    // Four elements an edge, and some arcs for each.
    let n = u32::try_from(n_edges).ok().filter(|n| *n < u32::MAX / 64);
    let n = n.ok_or(EngineError::TooLarge { n_edges })?;
    refuse_touches(domain)?;
    let watch = Watch::new(options);
    let members = Members { domain };
    let mut diagram = Diagram::of_edges(n);
    for walk in domain.walks() {
        close_ring(members, &mut diagram, walk, &watch)?;
    }
    if domain.walks().iter().any(|walk| walk.hole) {
        merge_rings(members, &mut diagram, &watch)?;
    }
    extract::axis(members, &diagram, &watch)
}

/// Fails where two corners share a place.
fn refuse_touches(domain: &Domain) -> Result<(), EngineError> {
    let mut corners: Vec<_> = domain.edges().iter().map(|edge| edge.start).collect();
    corners.sort_unstable_by(|a, b| a.lexicographic(*b));
    let pair = corners.windows(2).find(|pair| pair[0] == pair[1]).map(|pair| pair[0]);
    let straight = || domain.edges().iter().find(|e| e.corner == Corner::Straight).map(|e| e.start);
    match pair.or_else(straight) {
        Some(place) => Err(EngineError::Touching { place }),
        None => Ok(()),
    }
}

/// Merges the edges of a closed walk, chains of one length two at a time [Lee82, Fig. 8].
fn close_ring(
    members: Members<'_>,
    diagram: &mut Diagram,
    walk: &Walk,
    watch: &Watch<'_>,
) -> Result<(), EngineError> {
    let end = walk.first + walk.len;
    let joint = |before: u32, after: u32, ends_first: bool| {
        let place = members.domain.edge(after).start;
        let straight = EngineError::Touching { place };
        Joint::new(&members, before, after, ends_first).ok_or(straight)
    };
    let mut size = 1;
    while size < walk.len {
        for first in (walk.first..end).step_by(2 * size as usize) {
            let middle = first + size;
            if middle >= end {
                continue;
            }
            let mut joints = vec![joint(middle - 1, middle, true)?];
            if 2 * size >= walk.len {
                joints.push(joint(end - 1, walk.first, false)?);
            }
            Merge::new(members, diagram, &joints, watch).run()?;
        }
        size *= 2;
    }
    Ok(())
}

/// Merges the diagrams of rings, the widest first: so no ring surrounds one that is there already.
fn merge_rings(
    members: Members<'_>,
    diagram: &mut Diagram,
    watch: &Watch<'_>,
) -> Result<(), EngineError> {
    let domain = members.domain;
    let tree = BoundsTree::new(0, domain.edges().len() as u32, |k| {
        Rect::EMPTY.with(domain.edge(k).start).with(domain.end(k))
    });
    let mut order: Vec<(f64, u32)> = Vec::with_capacity(domain.walks().len());
    for (k, walk) in domain.walks().iter().enumerate() {
        let edges = walk.edges();
        let bounds = edges.fold(Rect::EMPTY, |all, e| all.with(domain.edge(e).start));
        order.push((bounds.max.x - bounds.min.x, k as u32));
    }
    order.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut merged = Merged::new(members, &tree);
    for (_, k) in order {
        let walk = &domain.walks()[k as usize];
        if walk.hole {
            let crossing = merged.crossing(diagram, walk)?;
            Merge::new(members, diagram, &[], watch).close(crossing)?;
        }
        merged.add(k);
    }
    Ok(())
}
