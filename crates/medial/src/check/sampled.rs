use std::ops::ControlFlow;

use super::Defect;
use super::context::Context;

/// Checks the radii of an axis found from samples a distance `spacing` apart: each is the distance
/// from the boundary, up to `spacing`.
pub(super) fn check(context: &Context, spacing: f64, defects: &mut Vec<Defect>) {
    for (number, keypoint) in context.axis.keypoints().iter().enumerate() {
        let mut distance = f64::INFINITY;
        context.tree.near(
            keypoint.position,
            &mut distance,
            |distance| *distance,
            |distance, edge| {
                *distance = distance.min(context.distance(keypoint.position, edge));
                ControlFlow::<()>::Continue(())
            },
        );
        let off = (keypoint.radius - distance).abs();
        if off.is_nan() || off > spacing {
            let (keypoint, at) = (number as u32, keypoint.position);
            defects.push(Defect::SampledRadius { keypoint, off, at });
        }
    }
}
