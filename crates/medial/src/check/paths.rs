//! Path by path: governors, gaps at both ends, direction, one inner point.

use std::cmp::Ordering;
use std::ops::ControlFlow;

use super::context::{Context, one_contact};
use super::enclosure::norm1;
use super::keypoints::{Gap, Keypoints};
use super::maximal_disk::MaximalDisk;
use super::{Defect, Name};
use crate::axis::{KeypointKind, Path};
use crate::domain::Site;
use crate::geom::Point;

/// Relative error that covers the few operations on doubles behind an inner point.
const ROUNDING: f64 = 1.0 / (1u64 << 44) as f64;

/// Least difference of the two normals at an inner point for which its rounding is bounded well.
///
/// Where a parabola runs far out both normals nearly agree, and the point is left unchecked.
const LEAST_OPENING: f64 = 1e-6;

/// Checks all paths; `found` is what the keypoints told.
pub(super) fn check(context: &Context, found: &Keypoints, defects: &mut Vec<Defect>) {
    check_gaps(context, found, defects);
    for (number, path) in context.axis.paths().iter().enumerate() {
        let number = number as u32;
        let at = context.position(path.from);
        let sites = (context.sites[path.left as usize], context.sites[path.right as usize]);
        let (Some(left), Some(right)) = sites else { continue };
        let same = |a, b| a == b || one_contact(context.domain, a, b);
        if same(left, right) || same(right, left) {
            defects.push(Defect::OwnEdge { path: number, at });
            continue;
        }
        match direction(context, found, &path, left, right) {
            Some(Ordering::Equal) => defects.push(Defect::Uncontracted { path: number, at }),
            Some(Ordering::Less) => defects.push(Defect::Reversed { path: number, at }),
            _ => {}
        }
        check_middle(context, number, &path, left, right, defects);
    }
}

/// Every gap between contacts is taken by one path end, and every path end takes a gap.
fn check_gaps(context: &Context, found: &Keypoints, defects: &mut Vec<Defect>) {
    let mut gaps = found.gaps.clone();
    gaps.sort_unstable();
    let mut ends: Vec<(Gap, u32)> = Vec::with_capacity(2 * context.axis.paths().len());
    for (number, path) in context.axis.paths().iter().enumerate() {
        let (left, right) = (path.left, path.right);
        ends.push((Gap { keypoint: path.from, right, left }, number as u32));
        // Seen from its end a path leaves with its sides swapped.
        ends.push((Gap { keypoint: path.to, right: left, left: right }, number as u32));
    }
    ends.sort_unstable();
    let mut rest = ends.as_slice();
    // Of the two gaps where a path is cut one is left.
    let is_cut = |k: u32| context.axis.keypoints().at(k).kind == KeypointKind::Clipped;
    let stray = |defects: &mut Vec<Defect>, &(gap, path): &(Gap, u32)| {
        if found.readable[gap.keypoint as usize] {
            let at = context.position(gap.keypoint);
            defects.push(Defect::Gap { path, keypoint: gap.keypoint, at });
        }
    };
    for gap in gaps {
        let strays = rest.partition_point(|(end, _)| *end < gap);
        rest[..strays].iter().for_each(|end| stray(defects, end));
        let taken = rest.partition_point(|(end, _)| *end <= gap);
        let at = context.position(gap.keypoint);
        match &rest[strays..taken] {
            [] if context.axis.complete && !is_cut(gap.keypoint) => {
                let Gap { keypoint, right, left } = gap;
                defects.push(Defect::EmptyGap { keypoint, right, left, at });
            }
            [(_, first), others @ ..] => {
                for &(_, second) in others {
                    let keypoint = gap.keypoint;
                    defects.push(Defect::CrowdedGap { keypoint, first: *first, second, at });
                }
            }
            [] => {}
        }
        rest = &rest[taken..];
    }
    rest.iter().for_each(|end| stray(defects, end));
}

/// `Greater` if the path runs in the direction of its governors, `Equal` if both ends have one
/// disk; `None` if an end has none.
fn direction(
    context: &Context,
    found: &Keypoints,
    path: &Path,
    left: Site,
    right: Site,
) -> Option<Ordering> {
    let domain = context.domain;
    let disk = |keypoint: u32| {
        found.disks[keypoint as usize]
            .map(|(sites, enclosure)| MaximalDisk::again(domain, sites, enclosure))
    };
    let (from, to) = (disk(path.from)?, disk(path.to)?);
    let (l, r) = (domain.edge(left.index()).start, domain.edge(right.index()).start);
    Some(if right.is_edge() {
        // The right footpoint moves along its edge.
        to.compare(&from, r, domain.end(right.index()), false)
    } else if left.is_edge() {
        from.compare(&to, l, domain.end(left.index()), false)
    } else {
        // The path crosses the way from the right corner to the left one from its left side.
        from.compare(&to, r, l, true)
    })
}

/// No site is nearer to an inner point of the path than its governors.
fn check_middle(
    context: &Context,
    number: u32,
    path: &Path,
    left: Site,
    right: Site,
    defects: &mut Vec<Defect>,
) {
    let (from, to) = (context.position(path.from), context.position(path.to));
    let Some(middle) = middle(context, left, right, from, to) else { return };
    let (to_left, n_left) = nearest(context, left, middle);
    let (to_right, n_right) = nearest(context, right, middle);
    let opening = (n_left - n_right).norm();
    let noise = ROUNDING * (norm1(middle) + context.size + to_left);
    if opening.is_nan() || opening < LEAST_OPENING {
        return;
    }
    // The inner point is at most this far from the bisector.
    let off = 2.0 * ((to_left - to_right).abs() + noise) / opening;
    let free = to_left.min(to_right) - 2.0 * off - noise;
    let mut crowd = context.crowd();
    let found = context.tree.near(middle, free, |edge| {
        if crowd.is_over() {
            ControlFlow::Break(None)
        } else if context.distance(middle, edge) < free {
            ControlFlow::Break(Some(Site::edge(edge)))
        } else {
            ControlFlow::Continue(())
        }
    });
    if free > 0.0
        && let Some(site) = found.flatten()
    {
        let by = Name::of(context.domain, site);
        defects.push(Defect::PathCut { path: number, by, at: middle });
    }
}

/// An inner point of a path: half-way along the natural parameter of its curve.
fn middle(context: &Context, left: Site, right: Site, from: Point, to: Point) -> Option<Point> {
    let domain = context.domain;
    let (edge, corner) = match (left.is_edge(), right.is_edge()) {
        (true, false) => (left, right),
        (false, true) => (right, left),
        _ => return Some((from + to) * 0.5),
    };
    let edge = domain.edge(edge.index());
    let focus = domain.edge(corner.index()).start;
    let (t, n) = (edge.direction, edge.direction.perp());
    let d = n.dot(focus - edge.start);
    if d <= 0.0 {
        return None;
    }
    let x = 0.5 * (t.dot(from - focus) + t.dot(to - focus));
    // Height above the directrix, less that of the focus.
    let y = (x * x - d * d) / (2.0 * d);
    Some(focus + t * x + n * y)
}

/// Distance of a point from a governor, and the unit vector from there to the point.
fn nearest(context: &Context, site: Site, point: Point) -> (f64, Point) {
    let edge = context.domain.edge(site.index());
    if site.is_edge() {
        let n = edge.direction.perp();
        (n.dot(point - edge.start), n)
    } else {
        let v = point - edge.start;
        let distance = v.norm();
        (distance, v * (1.0 / distance))
    }
}
