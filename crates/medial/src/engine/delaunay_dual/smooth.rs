//! A border without the noise of pixels: averaged along itself, or drawn back to where its hairs begin.

use super::dual::Dual;
use super::residuals::Left;
use super::samples::Samples;
use crate::geom::{Delaunay, Point};

/// How far averages may move samples of a mask, in shorter sides of a cell: parts of an outline, or two outlines, are
/// seven tenths of that apart at least, so that two tenths are left.
const MOST: f64 = 0.25;

/// By how much the arcs that samples are moved to are flatter than the circles that they stand for, so that no branch
/// leads into them.
const FLATTER: f64 = 1.0 + 1.0 / 64.0;

/// Arcs of more than this many radians are ends of limbs, and no hairs.
const MOST_OF_A_TURN: f64 = 2.5;

/// Moves samples to averages of those around them along their rings, weighted by a Gaussian of that width; gives the
/// largest move, which is in proportion to the shorter side of the cells. Distances along rings are counted in steps
/// of their mean length.
pub(super) fn average(samples: &mut Samples, width: f64, shorter: f64) -> f64 {
    /// Where the weights end, in widths.
    const REACH: f64 = 3.0;
    let most = MOST * shorter;
    let given = samples.points.clone();
    let mut largest = 0.0_f64;
    for ring in &samples.rings {
        let points = &given[ring.start as usize..ring.end as usize];
        let n = points.len();
        let length: f64 = (0..n).map(|k| (points[(k + 1) % n] - points[k]).norm()).sum();
        let step = length / n as f64;
        let reach = ((REACH * width / step).ceil() as usize).min(n / 2);
        let weights: Vec<f64> =
            (0..=reach).map(|k| (-0.5 * (k as f64 * step / width).powi(2)).exp()).collect();
        let sum = weights[0] + 2.0 * weights[1..].iter().sum::<f64>();
        for (k, &point) in points.iter().enumerate() {
            let mut mean = point * weights[0];
            for (j, &weight) in weights.iter().enumerate().skip(1) {
                mean = mean + (points[(k + j) % n] + points[(k + n - j) % n]) * weight;
            }
            let way = mean * (1.0 / sum) - point;
            let share = (most / way.norm()).min(1.0);
            samples.points[ring.start as usize + k] = point + way * share;
            largest = largest.max(way.norm() * share);
        }
    }
    largest
}

/// Moves samples behind branches that were removed to arcs between the samples where these begin \[TG00\]; gives the
/// largest move.
pub(super) fn retract(
    samples: &mut Samples,
    triangles: &Delaunay,
    dual: &Dual,
    disks: &[(Point, f64)],
    left: &Left,
) -> f64 {
    let along = samples.along();
    let mut is_left = vec![false; dual.n_nodes()];
    let mut is_kept = vec![false; dual.edges.len()];
    left.alone.iter().for_each(|&node| is_left[node as usize] = true);
    for &edge in &left.edges {
        is_kept[edge as usize] = true;
        let edge = dual.edges[edge as usize];
        [edge.from, edge.to].into_iter().for_each(|node| is_left[node as usize] = true);
    }
    let given = samples.points.clone();
    let mut largest = 0.0_f64;
    for (edge, _) in dual.edges.iter().zip(&is_kept).filter(|&(_, &kept)| !kept) {
        let Some(&node) = [edge.from, edge.to].iter().find(|&&node| is_left[node as usize]) else {
            continue;
        };
        let Some(&(_, radius)) = disks.get(node as usize) else { continue };
        // The boundary behind the edge, seen from what is left: on to its second sample, as the first group is to its left.
        let ends = [edge.across, triangles.reversed(edge.across)];
        let [a, b] = ends.map(|edge| dual.sample_at(triangles, edge));
        let (a, b) = if node == edge.from { (a, b) } else { (b, a) };
        let ring = samples.ring_of(a).clone();
        if !ring.contains(&b) {
            continue;
        }
        let n = ring.end - ring.start;
        let last = ring.end - 1;
        let closing = (given[ring.start as usize] - given[last as usize]).norm();
        let length = along[last as usize] + closing;
        let way = |a: u32, b: u32| (along[b as usize] - along[a as usize]).rem_euclid(length);
        // What is left may be the lesser part.
        if way(a, b) > way(b, a) {
            continue;
        }
        let [from, to] = [a, b].map(|sample| given[sample as usize]);
        let half = (to - from) * 0.5;
        let radius = radius * FLATTER;
        let turn = 2.0 * (half.norm() / radius).min(1.0).asin();
        if turn > MOST_OF_A_TURN || half.norm() >= radius {
            continue;
        }
        // The shape is to the left, and in it the centre.
        let high = (radius * radius - half.norm2()).sqrt();
        let centre = from + half + half.perp() * (high / half.norm());
        let steps = (b + n - a) % n;
        for step in 1..steps {
            let sample = (ring.start + (a - ring.start + step) % n) as usize;
            let share = way(a, sample as u32) / way(a, b);
            let (sin, cos) = (turn * share).sin_cos();
            let spoke = from - centre;
            samples.points[sample] = centre + spoke * cos + spoke.perp() * sin;
            largest = largest.max((samples.points[sample] - given[sample]).norm());
        }
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_saw_of_samples_becomes_nearly_straight() {
        // Around a long rectangle, every other sample a quarter off.
        let saw = |k: u32| if k.is_multiple_of(2) { 0.25 } else { 0.0 };
        let below = (0..200).map(|k| Point::new(0.5 * f64::from(k), saw(k)));
        let above = (0..200).rev().map(|k| Point::new(0.5 * f64::from(k), 20.0 + saw(k)));
        let points: Vec<Point> = below.chain(above).collect();
        let n = points.len() as u32;
        let mut samples = Samples {
            points,
            elements: vec![[0; 2]; n as usize],
            rings: std::iter::once(0..n).collect(),
            ..Samples::default()
        };
        let moved = average(&mut samples, 1.0, 1.0);
        assert!((0.12..=MOST).contains(&moved), "{moved}");
        let inner = &samples.points[20..180];
        assert!(inner.iter().all(|p| (p.y - 0.125).abs() < 1e-3), "{inner:?}");
    }
}
