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
use crate::geom::Point;

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
        let mut cells = vec![Member::side(k, Flank::Left)];
        if edge.corner == Corner::Reflex {
            cells.push(members.member(Site::corner(k)));
        }
        for cell in cells {
            let mut half = diagram.ends[cell.0 as usize][0];
            let mut left = diagram.halves.len();
            while half != NONE {
                left = left.checked_sub(1).ok_or(EngineError::Internal {
                    stage: "reading a cell",
                    place: members.ends(cell).0,
                })?;
                let beyond = diagram.beyond(half);
                if half & 1 == 0 && !members.is_normal(cell, beyond) {
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
    let Disk { triple, disk } = diagram.disk(vertex).ok_or(broken)?;
    let around = diagram.around(half);
    let cells = around.iter().map(|&h| members.site(diagram.half(h).cell));
    let contacts: Contacts = cells.collect();
    let is_normal = |&&h: &&u32| members.is_normal(diagram.half(h).cell, diagram.beyond(h));
    let normals = around.iter().filter(is_normal).count();
    let kind = if contacts.len() - normals == 2 {
        KeypointKind::Transition
    } else {
        KeypointKind::Junction
    };
    let triple = triple.map(|m| members.site(m));
    let is_own = contacts.len() == 3 && triple.iter().all(|site| contacts.contains(site));
    let own = is_own.then_some(&disk);
    let fixed = Fixed { own, sought: false, found: &disk, triple };
    let keypoint = traced.add_disk(domain, &fixed, kind, &from_least(&contacts))?;
    number[vertex as usize] = keypoint;
    Ok(keypoint)
}
