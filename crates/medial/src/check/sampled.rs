use std::ops::{ControlFlow, Range};

use super::Defect;
use super::context::Context;
use crate::geom::{BoundsTree, Point, Rect, Visitor};

/// Checks the radii of an axis found from samples a distance `spacing` apart: each is the distance
/// from the boundary, up to `spacing`.
pub(super) fn check_radii(context: &Context, spacing: f64, defects: &mut Vec<Defect>) {
    for (number, keypoint) in context.axis.keypoints().iter().enumerate() {
        let at = keypoint.position;
        let mut distance = f64::INFINITY;
        let _ = context.tree.nearest_first(at, |edge| {
            distance = distance.min(context.distance(at, edge));
            ControlFlow::Continue(distance)
        });
        let off = (keypoint.radius - distance).abs();
        if off.is_nan() || off > spacing {
            let keypoint = number as u32;
            defects.push(Defect::SampledRadius { keypoint, off, at });
        }
    }
}

/// Checks that the disks of a complete axis leave no part of the boundary alone: points of it a distance
/// `spacing` apart have one of them within twice that.
pub(super) fn check_cover(context: &Context, spacing: f64, defects: &mut Vec<Defect>) {
    /// Points along one edge; those of longer ones are farther apart.
    const MOST: f64 = 1e6;
    let disks: Vec<(Point, f64)> =
        context.axis.keypoints().iter().map(|k| (k.position, k.radius)).collect();
    let boxed = |k: u32| {
        let (centre, radius) = disks[k as usize];
        let reach = Point::new(radius, radius);
        Rect { min: centre - reach, max: centre + reach }
    };
    let tree = BoundsTree::new(0, disks.len() as u32, boxed);
    for edge in context.n_walls..context.domain.edges().len() as u32 {
        let (start, end) = (context.domain.edge(edge).start, context.domain.end(edge));
        let pieces = ((end - start).norm() / spacing).ceil().clamp(1.0, MOST);
        let mut farthest = (0.0, start);
        for k in 0..pieces as u32 {
            let from = start + (end - start) * (f64::from(k) / pieces);
            let mut nearest =
                Nearest { disks: &disks, from, enough: 2.0 * spacing, away: f64::INFINITY };
            tree.visit(&mut nearest);
            if nearest.away > farthest.0 {
                farthest = (nearest.away, from);
            }
        }
        if farthest.0 > 2.0 * spacing {
            let (away, at) = farthest;
            defects.push(Defect::Uncovered { edge: context.name(edge), away, at });
        }
    }
}

/// Looks for the disk that is nearest to a point, or near enough.
struct Nearest<'a> {
    disks: &'a [(Point, f64)],
    from: Point,
    enough: f64,
    away: f64,
}

impl Visitor for Nearest<'_> {
    fn enters(&self, bounds: &Rect, _: Range<u32>) -> bool {
        self.away > self.enough && bounds.distance2(self.from) < self.away * self.away
    }

    fn item(&mut self, disk: u32) {
        let (centre, radius) = self.disks[disk as usize];
        self.away = self.away.min((centre - self.from).norm() - radius);
    }
}
