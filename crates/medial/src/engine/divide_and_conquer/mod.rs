//! Divide and conquer: diagrams of chains are merged two at a time, after [Lee82].
//!
//! # Contract
//! The exact medial axis of the interior, as `path_tracing` gives it: keypoints, paths, governors and
//! their order are those of the true axis of the coordinates as given. Any number of holes and of
//! components; rings may touch. It shares predicates, domain and axis with `path_tracing`, and the way in
//! which a governor list is ordered, placed and written down; no search.
//!
//! # Method
//! 1. An edge with its two corners is a chain; its diagram has five cells, with the normals at both ends
//!    between them. A side of an edge is an element, so a diagram covers the whole plane.
//! 2. The diagram of two edges that follow one another is written down (`pairs.rs`). Longer chains are
//!    merged two at a time, of one length and without recursion [Lee82, Fig. 8]; the last merge closes
//!    the ring (`merge.rs`).
//! 3. A merge follows the curve of all points as near to one chain as to the other [Lee82, §II]. Left of
//!    it the arcs of a cell are scanned counterclockwise, right of it clockwise, each from where the last
//!    scan ended; arcs whose far end the other chain takes away are dropped for good (`look.rs`). The
//!    nearer of the two arcs met ends the piece, is cut, and the next piece starts (`cut.rs`).
//! 4. A walk that passes a place more than once is cut into simple rings, whose diagrams are merged in the
//!    places where they touch, like chains in their corners (`touches.rs`).
//! 5. Holes are merged after those that they may lie in (`order.rs`), each with a closed curve around it,
//!    which starts where a normal of the walk, or another arc around its reflex corners, is lost to the
//!    others (`rings.rs`, `around.rs`).
//! 6. Several threads make subtrees of the merge tree apart (`forest.rs`). For both sides of the boundary
//!    the rings are made once, and what lies outside them gets the numbers of the complement
//!    (`turned.rs`), where steps 5 and 7 are done again.
//! 7. The axis is what the cells of the inner sides have for arcs, without the normals of edges at their
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
//! - Chains are pairs of edges: the diagram of a chain of reflex corners is not built directly, since on
//!   its other side it is no simpler than any. The last merge of a ring follows the curve on the left
//!   side only, unless the outside is asked for as well.
//! - Of the two cells beside a piece the one that the curve entered last is asked first. Where that has
//!   something before the last vertex which the other one was found to lose, the other one is not asked:
//!   a curve passes the arcs of a cell in their order.
//! - Holes are not in the paper. A ring that is merged after all rings whose boxes hold its own surrounds
//!   none that is there: rings whose cells are bounded by those of another one lie inside the hull of
//!   that. So what is nearer to the new ring is bounded by one closed curve.
//!   Along it an arc may be lost in the middle, or at both ends only; so every arc of a cell up to where
//!   the other cell has something is asked, and what is cut off an arc stays in the lists for as long as
//!   the curve may come back to it.
//! - Touching rings are not in the paper either. Two walks of one component share no place, and no two of
//!   the simple rings of one walk share more than one, nor do they touch in a circle: either would cut the
//!   interior. So the rings of a walk hang on one another like the parts of a tree, and whichever way they
//!   are merged, two connected sets with one common corner are: the proof for chains holds. What another
//!   component has in the same place is never merged with them, as both see only their own interior.
//! - Around a place where rings touch a merge curve runs in the two interior sectors next to the ring that
//!   is added, so on the left side of every edge there. What the diagrams say of right sides is not kept up
//!   after that: a curve which separates two sets on the boundary of one component never leaves it.
//! - Where an edge goes straight on the corner between has no cell: the curve starts as the normal of both
//!   edges, which is an arc between their two sides. A disk that touches both does so in the corner, and is
//!   made of one side and the corner. The cells that both chains have for the corner are passed over.

mod around;
mod chains;
mod cut;
mod diagram;
mod disks;
mod elements;
mod exact;
mod extract;
mod forest;
mod infinity;
mod look;
mod merge;
mod order;
mod pairs;
mod rings;
mod touches;
mod turned;
mod work;

pub use chains::{ArcEnd, Chain, ChainArc, ChainElement, ChainMerge, chain_diagram, chain_merge};
pub use work::Work;

use super::watch::Watch;
use super::{EngineError, Options, threads};
use crate::axis::MedialAxis;
use crate::domain::{Complement, Domain};
use crate::geom::Point;
use diagram::Diagram;
use elements::{Ground, Line};
use exact::Exacts;
use forest::Asked;
use merge::Merge;
use rings::Merged;

/// The exact medial axis of the interior of a domain: a second engine, which searches in another way.
///
/// # Errors
/// [`EngineError::Internal`] if an invariant of the engine breaks, which no input should cause;
/// [`EngineError::TooLarge`] if the domain has too many edges.
pub fn divide_and_conquer(domain: &Domain) -> Result<MedialAxis, EngineError> {
    divide_and_conquer_with(domain, &Options::default())
}

/// The same on several threads, and within limits. The axis is the same bit for bit.
///
/// # Errors
/// As [`divide_and_conquer`]; and [`EngineError::Cancelled`] or [`EngineError::TimeLimit`].
pub fn divide_and_conquer_with(
    domain: &Domain,
    options: &Options<'_>,
) -> Result<MedialAxis, EngineError> {
    run(domain, options).map(|(axis, _)| axis)
}

/// The same, with the work that its merges took.
///
/// # Errors
/// As [`divide_and_conquer`].
///
/// ```
/// use medial::domain::{Domain, Options};
/// use medial::engine::divide_and_conquer_counted;
/// use medial::geom::Point;
/// // Two chains of two edges are merged from two of one, and with both ends to a square; the last
/// // curve has two pieces inside, from corner to corner through the centre.
/// let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)].map(|(x, y)| Point::new(x, y));
/// let domain = Domain::from_polygons(&[vec![square.to_vec()]], &Options::default())?;
/// let (axis, work) = divide_and_conquer_counted(&domain)?;
/// assert_eq!(axis.paths().len(), 4);
/// assert!(work.pieces >= 2 && work.arcs >= work.pieces && work.starts == 0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn divide_and_conquer_counted(domain: &Domain) -> Result<(MedialAxis, Work), EngineError> {
    run(domain, &Options::default())
}

/// The exact medial axes of the interior of a domain and of the outside within walls, whose edges come
/// first, from diagrams of rings that are made once; `None` where boundaries touch, since the outside has
/// other walks then.
pub(super) fn both_sides(
    domain: &Domain,
    outside: &Complement,
    options: &Options<'_>,
) -> Result<Option<[MedialAxis; 2]>, EngineError> {
    if outside.touches() {
        return Ok(None);
    }
    let watch = Watch::new(options);
    let [lines, lines_outside] = [domain, outside.domain()].map(Line::all);
    let ground = Ground::new(domain, &lines)?;
    let ground_outside = Ground::new(outside.domain(), &lines_outside)?;
    let rings = forest::of_all(ground, Asked::Both, options, &watch)?;
    let (exacts, exacts_outside) = (Exacts::new(), Exacts::new());
    let members = [ground.members(&exacts), ground_outside.members(&exacts_outside)];
    let turned = turned::outside(members[0], &rings, outside, members[1]);
    let place = domain.edges().first().map_or(Point::default(), |edge| edge.start);
    let turned = turned.ok_or(EngineError::Internal { stage: "turning a diagram", place })?;
    // The walls come first, and have no diagram yet.
    let sides = vec![(ground, rings, 0), (ground_outside, turned, 1)];
    let finish = |(ground, diagram, first_made): (Ground<'_>, _, _), watch: &Watch<'_>| {
        finish(ground, diagram, first_made, watch).map(|(axis, _)| axis)
    };
    let axes = threads::each(options, &watch, sides, finish)?;
    Ok(<[MedialAxis; 2]>::try_from(axes).ok())
}

fn run(domain: &Domain, options: &Options<'_>) -> Result<(MedialAxis, Work), EngineError> {
    let watch = Watch::new(options);
    let lines = Line::all(domain);
    let ground = Ground::new(domain, &lines)?;
    let n = domain.edges().len();
    if threads::number(options) > 1 && n >= options.alone_below {
        finish(ground, forest::of_all(ground, Asked::Left, options, &watch)?, 0, &watch)
    } else {
        finish(ground, Diagram::with_room(0..n as u32), domain.walks().len(), &watch)
    }
}

/// The axis of a domain, given a diagram of all walks from one of them on, by themselves.
fn finish(
    ground: Ground<'_>,
    mut diagram: Diagram,
    first_made: usize,
    watch: &Watch<'_>,
) -> Result<(MedialAxis, Work), EngineError> {
    let domain = ground.domain;
    let exacts = Exacts::new();
    let members = ground.members(&exacts);
    let has_holes = domain.walks().iter().any(|walk| walk.hole);
    let mut merged = has_holes.then(|| Merged::new(members));
    for k in order::of_walks(domain) {
        let walk = &domain.walks()[k as usize];
        if (k as usize) < first_made {
            forest::close_walk(members, &mut diagram, walk, Asked::Left, watch)?;
        }
        if let Some(merged) = &mut merged {
            if walk.hole {
                let crossing = merged.crossing(&diagram, walk)?;
                Merge::new(members, &mut diagram, &[], watch).close(crossing)?;
            }
            merged.add(k);
        }
    }
    let axis = extract::axis(members, &diagram, watch)?;
    let starts = merged.map_or(0, |merged| merged.looked());
    Ok((axis, Work { pieces: diagram.pieces, arcs: diagram.arcs.get(), starts }))
}
