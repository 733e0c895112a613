//! Shapes around a middle.

use std::f64::consts::TAU;

use medial::geom::Point;
use medial_bench::shapes::Random;

use super::grids::lattice_circle;
use super::{Polygons, Ring};

fn polar(turns: f64, radius: f64) -> Point {
    let (sin, cos) = (TAU * turns).sin_cos();
    Point::new(radius * cos, radius * sin)
}

/// A rounded rectangle with rounded holes, all of arcs with many corners.
pub fn fillets(random: &mut Random, edges: usize) -> Polygons {
    let holes = [0, 1, 4, edges / 100, edges / 40][random.below(5)].min(edges / 40);
    let each = edges / (holes + 1) / 4 + 1;
    let side = ((holes as f64).sqrt().ceil() as usize).max(1);
    let rectangle = |at: Point, w: f64, h: f64, radius: f64, steps: usize| -> Ring {
        let middles = [(w, h), (-w, h), (-w, -h), (w, -h)];
        let arc = |k: usize| {
            let (x, y) = middles[k];
            let middle = at + Point::new(x - x.signum() * radius, y - y.signum() * radius);
            (0..=steps).map(move |step| {
                middle + polar(0.25 * (k as f64 + step as f64 / steps as f64), radius)
            })
        };
        let mut ring: Ring = (0..4).flat_map(arc).collect();
        ring.dedup();
        ring
    };
    let half = 0.5 * side as f64;
    let radius = half * [0.1, 0.5, 1.0, 1e-3][random.below(4)];
    let mut rings = vec![rectangle(Point::new(half, half), half, half, radius, each)];
    // Holes keep away from the rounded corners of the frame.
    let out = if radius > 0.2 * half { 2.0 } else { 1.1 };
    rings[0]
        .iter_mut()
        .for_each(|p| *p = (*p - Point::new(half, half)) * out + Point::new(half, half));
    let equal = random.below(2) == 0;
    let (w, h) = (random.between(0.1, 0.45), random.between(0.1, 0.45));
    for k in 0..holes {
        let at = Point::new((k % side) as f64 + 0.5, (k / side) as f64 + 0.5);
        let (w, h) =
            if equal { (w, h) } else { (random.between(0.1, 0.45), random.between(0.1, 0.45)) };
        let radius = w.min(h) * [0.1, 0.5, 1.0][random.below(3)];
        let mut ring = rectangle(at, w, h, radius, each);
        ring.reverse();
        rings.push(ring);
    }
    vec![rings]
}

/// A star whose radii range over several orders of magnitude.
pub fn spikes(random: &mut Random, edges: usize) -> Polygons {
    let least = [-1.0, -4.0, -8.0][random.below(3)];
    let pair = random.below(2) == 0;
    let corner = |k: usize| {
        let power = if pair && k.is_multiple_of(2) { 0.0 } else { random.between(least, 0.0) };
        polar(k as f64 / edges as f64, 10f64.powf(power))
    };
    vec![vec![(0..edges).map(corner).collect()]]
}

/// Half a star and its mirror image; sometimes both mirror images.
pub fn mirrored(random: &mut Random, edges: usize) -> Polygons {
    let twice = random.below(2) == 0;
    let n = (edges / if twice { 4 } else { 2 }).max(2);
    let span = if twice { 0.25 } else { 0.5 };
    let rough = [0.0, 0.01, 0.7][random.below(3)];
    let mut part: Ring = (0..n)
        .map(|k| polar(span * (k as f64 + 0.5) / n as f64 - 0.25, 1.0 - random.between(0.0, rough)))
        .collect();
    let mirror = |ring: &Ring, x: f64, y: f64| -> Ring {
        ring.iter().rev().map(|p| Point::new(x * p.x, y * p.y)).collect()
    };
    if twice {
        part.extend(mirror(&part, 1.0, -1.0));
    }
    part.extend(mirror(&part, -1.0, 1.0));
    let mut rings = vec![part];
    if random.below(2) == 0 {
        let hole = [(0.0, 0.1), (0.05, 0.0), (0.0, -0.1), (-0.05, 0.0)];
        rings.push(hole.map(|(x, y)| Point::new(x, y)).to_vec());
    }
    vec![rings]
}

/// One sector and its images under turns: equal but for rounding.
pub fn turned(random: &mut Random, edges: usize) -> Polygons {
    let folds = [3, 4, 5, 6, 8, 12, 100][random.below(7)].min(edges / 2);
    let each = (edges / folds).max(1);
    let rough = [0.01, 0.3, 0.7][random.below(3)];
    let radii: Vec<f64> = (0..each).map(|_| 1.0 - random.between(0.0, rough)).collect();
    let n = folds * each;
    vec![vec![(0..n).map(|k| polar(k as f64 / n as f64, radii[k % each])).collect()]]
}

/// Corners nearly on one circle, from inside, from outside, or both.
pub fn nearly_round(random: &mut Random, edges: usize) -> Polygons {
    let off = 10f64.powf(random.between(-17.0, -3.0));
    let radius = [65.0, 325.0, 1105.0, 5525.0][random.below(4)];
    let exact = lattice_circle(radius);
    let (n, whole) = (edges.max(6), edges < 2 * exact.len());
    let base: Ring = if whole {
        exact.into_iter().filter(|_| random.below(4) > 0).collect()
    } else {
        (0..n).map(|k| polar((k as f64 + random.between(0.0, 0.9)) / n as f64, radius)).collect()
    };
    let spread = random.below(2) == 0;
    let ends = base.iter().zip(base.iter().cycle().skip(1));
    let mut ring: Ring = ends
        .flat_map(|(&a, &b)| {
            let far = (a + b) * random.between(0.6, 2.0);
            [Some(a * (1.0 + random.between(-off, off))), spread.then_some(far)]
        })
        .flatten()
        .collect();
    let mut rings = Vec::new();
    if random.below(3) == 0 {
        let s = 4.0 * radius;
        rings.push([(-s, -s), (s, -s), (s, s), (-s, s)].map(|(x, y)| Point::new(x, y)).to_vec());
        ring.reverse();
    }
    rings.push(ring);
    vec![rings]
}
