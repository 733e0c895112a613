//! Shapes around a middle.

use std::f64::consts::TAU;

use super::random::Random;
use super::{Ring, SIZE};

/// Corners at equal angles and any distance from the middle.
pub fn star(random: &mut Random, edges: usize) -> Ring {
    let corner = |k: usize| {
        let (sin, cos) = (TAU * k as f64 / edges as f64).sin_cos();
        let radius = SIZE * random.between(0.3, 1.0);
        (radius * cos, radius * sin)
    };
    (0..edges).map(corner).collect()
}

/// Long thin spikes around a disk, by turns with straight sides and with four corners on each.
pub fn slivers(random: &mut Random, edges: usize) -> Ring {
    let spikes = edges / 12 * 2;
    // Corners as multiples of the angle between two spikes, and shares of the size.
    let mut corners = Vec::with_capacity(6 * spikes);
    for spike in 0..spikes {
        let middle = spike as f64;
        let (root, tip) = (random.between(0.3, 0.35), random.between(0.8, 1.0));
        let mut corner = |side: f64, step: usize| {
            let share = (step as f64 + random.between(-0.3, 0.3)) / 5.0;
            let width = 0.45 * (1.0 - share) * random.between(0.8, 1.0);
            (middle + side * width, root + share * (tip - root))
        };
        let steps = if spike % 2 == 0 { 0 } else { 4 };
        corners.push((middle - 0.5, root));
        corners.extend((1..=steps).map(|step| corner(-1.0, step)));
        corners.push((middle, tip));
        corners.extend((1..=steps).rev().map(|step| corner(1.0, step)));
    }
    let place = |(turns, radius): (f64, f64)| {
        let (sin, cos) = (turns * TAU / spikes as f64).sin_cos();
        (SIZE * radius * cos, SIZE * radius * sin)
    };
    corners.into_iter().map(place).collect()
}

/// The corners of a regular polygon, squeezed to a height.
pub fn ellipse(edges: usize, height: f64) -> Ring {
    let corner = |k: usize| {
        let (sin, cos) = (TAU * k as f64 / edges as f64).sin_cos();
        (SIZE * cos, height * sin)
    };
    (0..edges).map(corner).collect()
}

/// A corridor along a spiral of Archimedes; its edges are about a fifth as long as it is wide,
/// whatever their number.
pub fn spiral(edges: usize) -> Ring {
    let wall = edges / 2;
    let turns = (edges as f64).sqrt() / 8.0;
    let pitch = SIZE / (turns + 1.0);
    let ends = (TAU, TAU * (turns + 0.5));
    // Nearly equal steps: the length grows like the square of the angle.
    let angle = |k: usize| {
        let t = k as f64 / (wall - 1) as f64;
        (ends.0 * ends.0 + t * (ends.1 * ends.1 - ends.0 * ends.0)).sqrt()
    };
    let point = |k: usize, shift: f64| {
        let radius = pitch * (angle(k) / TAU + shift);
        let (sin, cos) = angle(k).sin_cos();
        (radius * cos, radius * sin)
    };
    let outer = (0..wall).map(|k| point(k, 0.5));
    outer.chain((0..wall).rev().map(|k| point(k, 0.0))).collect()
}

/// Koch's coast with thirds and heights jittered; the last round divides only some edges.
pub fn koch(random: &mut Random, edges: usize) -> Ring {
    let corner = |k: usize| {
        let (sin, cos) = (TAU * k as f64 / 3.0).sin_cos();
        (0.7 * SIZE * cos, 0.7 * SIZE * sin)
    };
    let mut ring: Vec<(f64, f64)> = (0..3).map(corner).collect();
    while ring.len() + 3 <= edges {
        let n = ring.len();
        let wanted = n.min((edges - n) / 3);
        let mut finer = Vec::with_capacity(4 * n);
        for k in 0..n {
            let ((ax, ay), (bx, by)) = (ring[k], ring[(k + 1) % n]);
            finer.push((ax, ay));
            // Spread the divided edges evenly.
            if (k + 1) * wanted / n == k * wanted / n {
                continue;
            }
            let (dx, dy) = (bx - ax, by - ay);
            let at = |t: f64, h: f64| (ax + t * dx + h * dy, ay + t * dy - h * dx);
            let (t, s) = (random.between(0.30, 0.36), random.between(0.64, 0.70));
            let height = random.between(0.18, 0.26);
            finer.extend([at(t, 0.0), at((t + s) / 2.0, height), at(s, 0.0)]);
        }
        ring = finer;
    }
    ring
}
