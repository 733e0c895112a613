//! Outer rings and holes by depth.

use super::rings::Rings;
use super::status::NONE;
use super::{Repair, Report};

/// Makes each ring an outer ring or a hole by the number of rings of its polygon around it, given
/// the smallest ring around each.
pub(super) fn regroup(rings: &mut Rings, parents: &[u32], report: &mut Report) {
    for (ring, hole) in odd_depths(rings, parents).into_iter().enumerate() {
        if hole {
            rings.reverse(ring);
            rings.rings[ring].hole = true;
        }
        let record = &rings.rings[ring];
        let mut note = |repair| report.push(repair, record.polygon, record.index, Vec::new());
        if hole != (record.index > 0) {
            note(Repair::Regrouped);
        }
        if record.reversed {
            note(Repair::Reversed);
        }
    }
}

/// Whether an odd number of rings of the same polygon is around each ring.
fn odd_depths(rings: &Rings, parents: &[u32]) -> Vec<bool> {
    let mut children: Vec<(u32, u32)> = parents.iter().copied().zip(0..).collect();
    children.sort_unstable();
    let below = |parent: u32| {
        let start = children.partition_point(|c| c.0 < parent);
        children[start..].iter().take_while(move |c| c.0 == parent).map(|c| c.1)
    };
    let polygons = rings.rings.last().map_or(0, |r| r.polygon as usize + 1);
    // Rings of each polygon on the way from the outside to the present ring, modulo two.
    let mut odd = vec![false; polygons];
    let mut result = vec![false; parents.len()];
    let mut stack: Vec<(u32, bool)> = below(NONE).map(|r| (r, true)).collect();
    while let Some((ring, enter)) = stack.pop() {
        let odd = &mut odd[rings.rings[ring as usize].polygon as usize];
        if enter {
            result[ring as usize] = *odd;
            stack.push((ring, false));
            stack.extend(below(ring).map(|r| (r, true)));
        }
        *odd = !*odd;
    }
    result
}
