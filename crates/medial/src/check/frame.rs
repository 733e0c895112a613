//! Where an exterior axis is cut: all cuts lie on one frame, which is the box of the polygons grown on
//! all sides by one margin, and nothing lies beyond.

use super::Defect;
use super::context::Context;
use crate::axis::{KeypointKind, Side};
use crate::geom::{Point, Rect};

/// How far a position may be off a frame, as a share of the largest number at hand: what rounding the
/// frame and the position comes to.
const OFF: f64 = 16.0 * f64::EPSILON;

/// Finds keypoints that are cut elsewhere than on the frame, or lie beyond it.
pub(super) fn check(context: &Context, defects: &mut Vec<Defect>) {
    let axis = context.axis;
    if axis.side != Side::Exterior {
        return;
    }
    let edges = context.domain.edges().iter().skip(context.n_walls as usize);
    let bounds = edges.fold(Rect::EMPTY, |all, edge| all.with(edge.start));
    // How far the box must grow to reach a point.
    let margin = |p: Point| {
        let (low, high) = (bounds.min - p, p - bounds.max);
        low.x.max(low.y).max(high.x).max(high.y)
    };
    let is_cut = |kind: KeypointKind| kind == KeypointKind::Clipped;
    let cuts = axis.keypoints().iter().filter(|k| is_cut(k.kind));
    let Some(frame) = cuts.map(|k| margin(k.position)).reduce(f64::max) else { return };
    for (number, keypoint) in (0..).zip(axis.keypoints().iter()) {
        let at = keypoint.position;
        let off = OFF * (context.size + frame + at.x.abs().max(at.y.abs()));
        let own = margin(at);
        if own > frame + off || is_cut(keypoint.kind) && own < frame - off {
            defects.push(Defect::OffFrame { keypoint: number, margin: own, frame, at });
        }
    }
}
