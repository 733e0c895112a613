//! Squares with a lattice of holes.

use std::f64::consts::TAU;

use super::random::Random;
use super::{Ring, SIZE};

/// Holes with that many corners, their places and radii jittered.
pub fn holes(random: &mut Random, edges: usize, corners: usize) -> Vec<Ring> {
    let side = ((edges as f64 / corners as f64).sqrt().round() as usize).max(1);
    let unit = 2.0 * SIZE / side as f64;
    let s = SIZE;
    let mut rings = vec![vec![(-s, -s), (s, -s), (s, s), (-s, s)]];
    for k in 0..side * side {
        let mut shifted = |v: usize| (v as f64 + random.between(0.4, 0.6)) * unit - SIZE;
        let (x, y) = (shifted(k % side), shifted(k / side));
        let corner = |k: usize| {
            let (sin, cos) = (-TAU * k as f64 / corners as f64).sin_cos();
            let radius = unit * random.between(0.15, 0.35);
            (x + radius * cos, y + radius * sin)
        };
        rings.push((0..corners).map(corner).collect());
    }
    rings
}

/// Equal squares at equal distances, parallel to the axes.
pub fn lattice(edges: usize) -> Vec<Ring> {
    let side = ((edges as f64 / 4.0).sqrt().round() as usize).max(1);
    let half = (SIZE / (2 * side + 1) as f64).floor();
    let at = |k: usize| -SIZE + k as f64 * 2.0 * half;
    let square = |x: f64, y: f64, s: f64| vec![(x, y), (x, y + s), (x + s, y + s), (x + s, y)];
    let mut outer = square(-SIZE, -SIZE, at(2 * side + 1) + SIZE);
    outer.reverse();
    let mut rings = vec![outer];
    for k in 0..side * side {
        rings.push(square(at(2 * (k % side) + 1), at(2 * (k / side) + 1), 2.0 * half));
    }
    rings
}
