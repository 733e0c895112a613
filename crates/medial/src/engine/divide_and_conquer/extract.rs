//! The axis of the interior, read off a finished diagram.

use super::diagram::{APEX, Diagram, NONE};
use super::disks::Disk;
use super::elements::{Flank, Member, Members};
use crate::axis::{Engine, KeypointKind, MedialAxis, Path};
use crate::domain::{Corner, Site};
use crate::engine::EngineError;
use crate::engine::draft::contacts::{Contacts, from_least};
use crate::engine::draft::{Fixed, Traced};
use crate::engine::watch::Watch;
use crate::geom::{Point, TouchingDisk};

/// The axis, with keypoints and paths in boundary order.
pub(super) fn axis(
    members: Members<'_>,
    diagram: &Diagram,
    watch: &Watch<'_>,
) -> Result<MedialAxis, EngineError> {
    let domain = members.domain;
    let n_holes = domain.walks().iter().filter(|walk| walk.hole).count();
    let mut traced = Traced::with_room(domain.edges().len(), n_holes);
    let mut number = vec![NONE; diagram.vertices.len()];
    for (k, edge) in domain.edges().iter().enumerate() {
        watch.check()?;
        let k = k as u32;
        let corner = (edge.corner == Corner::Reflex).then(|| members.member(Site::corner(k)));
        for cell in std::iter::once(Member::side(k, Flank::Left)).chain(corner) {
            let mut half = diagram.ends[cell.0 as usize][0];
            let mut left = diagram.halves.len();
            while half != NONE {
                left = left.checked_sub(1).ok_or(EngineError::Internal {
                    stage: "reading a cell",
                    place: members.ends(cell).0,
                })?;
                let beyond = diagram.beyond(half);
                // Once, as seen from the smaller one, whichever was there first.
                if cell < beyond && !members.is_normal(cell, beyond) {
                    let (left, right) = (members.site(cell), members.site(beyond));
                    let ends = [
                        keypoint(members, diagram, &mut traced, &mut number, half)?,
                        keypoint(members, diagram, &mut traced, &mut number, half ^ 1)?,
                    ];
                    traced.add_path(&Path {
                        from: ends[0],
                        to: ends[1],
                        left: left.0,
                        right: right.0,
                    });
                }
                half = diagram.half(half).next;
            }
        }
    }
    traced.finish(domain, watch, Engine::DivideAndConquer)
}

/// The keypoint where a half starts.
fn keypoint(
    members: Members<'_>,
    diagram: &Diagram,
    traced: &mut Traced,
    number: &mut [u32],
    half: u32,
) -> Result<u32, EngineError> {
    let vertex = diagram.half(half).from;
    let domain = members.domain;
    if vertex == APEX {
        let (before, after) = (diagram.half(half).cell, diagram.beyond(half));
        let (a, b) = (members.site(before), members.site(after));
        let corner = if domain.edge(a.index()).next == b.index() { b } else { a };
        let at: Point = domain.edge(corner.index()).start;
        let list = from_least(&[a, b]);
        return Ok(traced.add(at, 0.0, KeypointKind::End, &list));
    }
    if let Some(&known) = number.get(vertex as usize)
        && known != NONE
    {
        return Ok(known);
    }
    let place = members.ends(diagram.half(half).cell).0;
    let broken = EngineError::Internal { stage: "reading a path", place };
    let Disk { triple, is_plain, disk } = diagram.disk(vertex).ok_or(broken)?;
    let (mut contacts, mut normals) = (Contacts::new(), 0);
    for half in diagram.around(half) {
        let cell = diagram.half(half).cell;
        contacts.push(members.site(cell));
        normals += usize::from(members.is_normal(cell, diagram.beyond(half)));
    }
    let kind = if contacts.len() - normals == 2 {
        KeypointKind::Transition
    } else {
        KeypointKind::Junction
    };
    let triple = triple.map(|m| members.site(m));
    // The place depends on the governors only.
    let is_own = contacts.len() == 3 && triple.iter().all(|site| contacts.contains(site));
    let own = match contacts[..] {
        [a, b, c] if is_own && !is_plain => TouchingDisk::touching(&domain.governors([a, b, c])),
        _ => is_own.then_some(disk),
    };
    let sought = is_own && !is_plain;
    let fixed = Fixed { own: own.as_ref(), sought, found: &disk, triple };
    let keypoint = traced.add_disk(domain, &fixed, kind, &from_least(&contacts))?;
    number[vertex as usize] = keypoint;
    Ok(keypoint)
}
