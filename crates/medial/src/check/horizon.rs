//! Far away: an exterior axis goes to infinity just where the convex hull has its gaps.

use super::context::Context;
use super::{Defect, Name};
use crate::axis::KeypointKind;
use crate::domain::Site;

/// Matches the cut paths of a complete exterior axis with the gaps of the hull.
pub(super) fn check(context: &Context, defects: &mut Vec<Defect>) {
    let Some(horizon) = &context.horizon else { return };
    let axis = context.axis;
    let is_cut = |k: u32| axis.keypoints().at(k).kind == KeypointKind::Clipped;
    let mut cuts: Vec<((Site, Site), u32)> = Vec::new();
    for path in axis.paths() {
        let site = |number: u32| context.sites[number as usize];
        let (Some(left), Some(right)) = (site(path.left), site(path.right)) else { continue };
        // As seen outwards; that is the other way round at the start.
        cuts.extend(is_cut(path.to).then_some(((right, left), path.to)));
        cuts.extend(is_cut(path.from).then_some(((left, right), path.from)));
    }
    cuts.sort_unstable();
    let mut gaps = horizon.gaps.clone();
    gaps.sort_unstable();
    let mut rest = cuts.as_slice();
    let stray = |defects: &mut Vec<Defect>, &(_, keypoint): &((Site, Site), u32)| {
        defects.push(Defect::StrayCut { keypoint, at: context.position(keypoint) });
    };
    for gap in gaps {
        let strays = rest.partition_point(|(cut, _)| *cut < gap);
        rest[..strays].iter().for_each(|cut| stray(defects, cut));
        rest = &rest[strays..];
        if rest.first().is_some_and(|(cut, _)| *cut == gap) {
            rest = &rest[1..];
        } else {
            let place = |site: Site| context.domain.edge(site.index()).start;
            let (right, left) = gap;
            let at = (place(right) + place(left)) * 0.5;
            let name = |site| Name::of(context.domain, site);
            defects.push(Defect::LostGap { right: name(right), left: name(left), at });
        }
    }
    rest.iter().for_each(|cut| stray(defects, cut));
}
