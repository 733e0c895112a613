//! Divide and conquer, after [Lee82], with diagrams of both sides.

mod diagram;
mod elements;
mod extract;
mod merge;

use super::EngineError;
use crate::axis::MedialAxis;
use crate::domain::{Domain, Walk};
use diagram::Diagram;
use elements::Members;
use merge::{Broken, Joint, Merge};

/// The exact medial axis of the interior of a domain.
///
/// # Errors
/// [`EngineError::Internal`] if an invariant of the engine breaks, which no input should cause.
pub fn divide_and_conquer(domain: &Domain) -> Result<MedialAxis, EngineError> {
    let members = Members { domain };
    let mut diagram = Diagram::of_edges(domain.edges().len() as u32);
    for walk in domain.walks() {
        of_walk(members, &mut diagram, walk)
            .map_err(|Broken { stage, place }| EngineError::Internal { stage, place })?;
    }
    extract::axis(members, &diagram)
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
