//! Divide and conquer, after [Lee82], with diagrams of both sides.

mod diagram;
mod elements;
mod extract;
mod merge;
mod rings;

use super::EngineError;
use crate::axis::MedialAxis;
use crate::domain::{Domain, Walk};
use diagram::Diagram;
use elements::Members;
use crate::geom::{BoundsTree, Rect};
use merge::{Broken, Joint, Merge};
use rings::Merged;

/// The exact medial axis of the interior of a domain.
///
/// # Errors
/// [`EngineError::Internal`] if an invariant of the engine breaks, which no input should cause.
pub fn divide_and_conquer(domain: &Domain) -> Result<MedialAxis, EngineError> {
    let members = Members { domain };
    let mut diagram = Diagram::of_edges(domain.edges().len() as u32);
    let broken = |Broken { stage, place }: Broken| EngineError::Internal { stage, place };
    for walk in domain.walks() {
        of_walk(members, &mut diagram, walk).map_err(broken)?;
    }
    if domain.walks().iter().any(|walk| walk.hole) {
        of_rings(members, &mut diagram).map_err(broken)?;
    }
    extract::axis(members, &diagram)
}

/// Merges the diagrams of rings, the largest ones first: then no ring is all around one that is there
/// already, and the curve is a single one.
fn of_rings(members: Members<'_>, diagram: &mut Diagram) -> Result<(), Broken> {
    let domain = members.domain;
    let tree = BoundsTree::new(0, domain.edges().len() as u32, |k| {
        Rect::EMPTY.with(domain.edge(k).start).with(domain.end(k))
    });
    let mut order: Vec<(f64, u32)> = Vec::new();
    for (k, walk) in domain.walks().iter().enumerate() {
        let edges = walk.first..walk.first + walk.len;
        let bounds = edges.fold(Rect::EMPTY, |all, e| all.with(domain.edge(e).start));
        order.push((bounds.max.x - bounds.min.x, k as u32));
    }
    order.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut merged = Merged::new(members, &tree);
    for (_, k) in order {
        let walk = &domain.walks()[k as usize];
        if walk.hole {
            let crossing = merged.crossing(diagram, walk)?;
            Merge::new(members, diagram, &[]).close(crossing)?;
        }
        merged.add(k);
    }
    Ok(())
}

/// The diagram of a closed walk: chains are merged two at a time, as in [Lee82, Fig. 8].
fn of_walk(members: Members<'_>, diagram: &mut Diagram, walk: &Walk) -> Result<(), Broken> {
    let mut size = 1;
    while size < walk.len {
        let closes = 2 * size >= walk.len;
        for first in (0..walk.len).step_by(2 * size as usize) {
            let middle = walk.first + first + size;
            if first + size >= walk.len {
                continue;
            }
            let straight = |after: u32| Broken {
                stage: "joining two straight edges",
                place: members.domain.edge(after).start,
            };
            let mut joints = vec![
                Joint::new(&members, middle - 1, middle, true).ok_or_else(|| straight(middle))?,
            ];
            if closes {
                let last = walk.first + walk.len - 1;
                joints.push(
                    Joint::new(&members, last, walk.first, false)
                        .ok_or_else(|| straight(walk.first))?,
                );
            }
            Merge::new(members, diagram, &joints).run()?;
        }
        size *= 2;
    }
    Ok(())
}
