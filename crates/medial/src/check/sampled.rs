use std::ops::{ControlFlow, Range};

use super::Defect;
use super::context::Context;
use crate::geom::{BoundsTree, Point, Rect, Visitor, orient2d};

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

/// Checks that no path leaves the shape: one that crosses an edge is nowhere farther than twice `spacing` from
/// the disks at its ends.
pub(super) fn check_steps(context: &Context, spacing: f64, defects: &mut Vec<Defect>) {
    for (number, path) in (0..).zip(context.axis.paths()) {
        let [from, to] = [path.from, path.to].map(|end| context.axis.keypoints().at(end));
        let way = to.position - from.position;
        let between = way.norm() - from.radius - to.radius;
        if between <= 4.0 * spacing {
            continue;
        }
        let (middle, half) = (from.position + way * 0.5, 0.5 * way.norm());
        let end = context.tree.nearest_first(middle, |edge| {
            let sides = [context.domain.edge(edge).start, context.domain.end(edge)];
            let is_crossed = is_across([from.position, to.position], sides)
                && is_across(sides, [from.position, to.position]);
            if is_crossed { ControlFlow::Break(()) } else { ControlFlow::Continue(half) }
        });
        if end.is_break() || between.is_nan() {
            defects.push(Defect::Jump { path: number, between, at: from.position });
        }
    }
}

/// Whether two points lie on different sides of the line through two others.
fn is_across([a, b]: [Point; 2], [p, q]: [Point; 2]) -> bool {
    let (p, q) = (orient2d(a, b, p), orient2d(a, b, q));
    p < 0.0 && q > 0.0 || p > 0.0 && q < 0.0
}

/// Checks that the disks of a complete axis leave no part of the boundary alone: points of it a distance
/// `spacing` apart have one of them within twice that.
pub(super) fn check_cover(context: &Context, spacing: f64, defects: &mut Vec<Defect>) {
    /// Points along one edge; those of longer ones are farther apart.
    const MOST: f64 = 1e6;
    let axis = context.axis;
    let disk = |k: u32| {
        let keypoint = axis.keypoints().at(k);
        (keypoint.position, keypoint.radius)
    };
    // Disks by themselves, and all those between two of them.
    let alone = (0..axis.keypoints().len() as u32).map(|k| [disk(k); 2]);
    let between = axis.paths().iter().map(|path| [disk(path.from), disk(path.to)]);
    let runs: Vec<[(Point, f64); 2]> = between.chain(alone).collect();
    let boxed = |k: u32| {
        runs[k as usize].iter().fold(Rect::EMPTY, |all, &(centre, radius)| {
            let reach = Point::new(radius, radius);
            all.with(centre - reach).with(centre + reach)
        })
    };
    let tree = BoundsTree::new(0, runs.len() as u32, boxed);
    for edge in context.n_walls..context.domain.edges().len() as u32 {
        let (start, end) = (context.domain.edge(edge).start, context.domain.end(edge));
        let pieces = ((end - start).norm() / spacing).ceil().clamp(1.0, MOST);
        let mut farthest = (0.0, start);
        for k in 0..pieces as u32 {
            let from = start + (end - start) * (f64::from(k) / pieces);
            let mut nearest =
                Nearest { runs: &runs, from, enough: 2.0 * spacing, away: f64::INFINITY };
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
    runs: &'a [[(Point, f64); 2]],
    from: Point,
    enough: f64,
    away: f64,
}

impl Visitor for Nearest<'_> {
    fn enters(&self, bounds: &Rect, _: Range<u32>) -> bool {
        self.away > self.enough && bounds.distance2(self.from) < self.away * self.away
    }

    fn item(&mut self, run: u32) {
        let [(start, radius), (end, last)] = self.runs[run as usize];
        let (way, from) = (end - start, self.from - start);
        let length = way.norm();
        // The distance from the disk at s along the way is least where it neither grows nor falls.
        let (s, growth) = if length > 0.0 {
            let growth = (last - radius) / length;
            let (along, beside) = (way.dot(from) / length, (way.cross(from) / length).abs());
            let lean = growth / (1.0 - growth * growth).max(f64::MIN_POSITIVE).sqrt();
            ((along + beside * lean).clamp(0.0, length) / length, growth * length)
        } else {
            (0.0, 0.0)
        };
        self.away = self.away.min((start + way * s - self.from).norm() - (radius + growth * s));
    }
}
