//! Random points joined to rings that do not cross, and holes in corners.

use std::f64::consts::TAU;

use medial::domain::{Domain, Options};
use medial::geom::{Point, orient2d};
use medial_bench::shapes::Random;

use super::grids::{framed, side};
use super::{Polygons, Ring};

/// Points of the unit square, untangled.
pub fn tangle(random: &mut Random, edges: usize) -> Polygons {
    let mut ring: Ring = (0..edges.max(3)).map(|_| anywhere(random)).collect();
    untangle(&mut ring);
    vec![vec![ring]]
}

/// Points of a small grid, untangled, with a few holes.
pub fn grid_tangle(random: &mut Random, edges: usize) -> Polygons {
    let size = 2 + random.below(2 * edges);
    let mut whole = || Point::new(random.below(size + 1) as f64, random.below(size + 1) as f64);
    let mut ring: Ring = (0..edges.max(3)).map(|_| whole()).collect();
    untangle(&mut ring);
    vec![vec![ring]]
}

/// Points of a grid a few units wide, untangled: one ring with or without holes, or where that has
/// no room for the edges, a box with a small ring in each cell of a lattice.
pub fn tiny_grid(random: &mut Random, edges: usize) -> Polygons {
    let size = 2 + random.below(9);
    let ring = |random: &mut Random, corners: usize| -> Ring {
        let mut whole = || random.below(size + 1) as f64;
        let mut ring: Ring = (0..corners).map(|_| Point::new(whole(), whole())).collect();
        untangle(&mut ring);
        ring
    };
    if edges <= 4 * size {
        let holes = random.below(1 + edges / 6);
        let mut rings = vec![ring(random, edges.saturating_sub(3 * holes).max(3))];
        rings.extend((0..holes).map(|k| ring(random, 3 + k % 2)));
        return vec![rings];
    }
    let each = 3 + random.below(6);
    let width = 2.0 * (size + 2) as f64;
    framed(side(edges, each), width, |middle| {
        let twice = |ring: Ring| -> Ring { ring.into_iter().map(|p| p * 2.0).collect() };
        let tried = (0..8).map(|_| ring(random, each)).find(bounds_a_domain);
        let corner = middle - Point::new(width, width) * 0.5 + Point::new(1.0, 1.0);
        tried.map(|ring| twice(ring).into_iter().map(|p| corner + p).collect())
    })
}

fn bounds_a_domain(ring: &Ring) -> bool {
    Domain::from_polygons(&[vec![ring.clone()]], &Options::default()).is_ok()
}

/// A box with a tangle in each cell of a lattice.
pub fn tangles(random: &mut Random, edges: usize) -> Polygons {
    let each = 3 + random.below(20);
    let side = ((edges as f64 / each as f64).sqrt() as usize).max(1);
    let end = side as f64;
    let frame = [(0.0, 0.0), (end, 0.0), (end, end), (0.0, end)];
    let mut rings: Vec<Ring> = vec![frame.map(|(x, y)| Point::new(x, y)).to_vec()];
    for k in 0..side * side {
        let at = Point::new((k % side) as f64 + 0.01, (k / side) as f64 + 0.01);
        let size = 10f64.powf(random.between(-3.0, 0.0)) * 0.98;
        let mut ring: Ring = (0..each).map(|_| at + anywhere(random) * size).collect();
        untangle(&mut ring);
        rings.push(ring);
    }
    vec![rings]
}

fn anywhere(random: &mut Random) -> Point {
    let x = random.between(0.0, 1.0);
    Point::new(x, random.between(0.0, 1.0))
}

/// Turns round the part between two edges that cross, until none do or it takes too long.
fn untangle(ring: &mut Ring) {
    let n = ring.len();
    let cross = |a: Point, b: Point, c: Point, d: Point| {
        let side = |p: Point, q: Point, r: Point| (q - p).cross(r - p);
        side(a, b, c) * side(a, b, d) < 0.0
            && side(c, d, a) * side(c, d, b) < 0.0
            && orient2d(a, b, c) * orient2d(a, b, d) < 0.0
    };
    for _ in 0..100 {
        let mut done = true;
        for i in 0..n {
            for j in i + 2..n {
                if (j + 1) % n != i && cross(ring[i], ring[i + 1], ring[j], ring[(j + 1) % n]) {
                    ring[i + 1..=j].reverse();
                    done = false;
                }
            }
        }
        if done {
            return;
        }
    }
}

/// A star with sharp tips, and holes in them that are small where the tip is narrow.
pub fn hidden(random: &mut Random, edges: usize) -> Polygons {
    let tips = (edges / 9).max(3);
    let turn = |k: f64| {
        let (sin, cos) = (TAU * k / tips as f64).sin_cos();
        Point::new(cos, sin)
    };
    let inner = random.between(0.1, 0.9) * (TAU / 2.0 / tips as f64).cos();
    let mut ring = Ring::new();
    let mut holes = Vec::new();
    for k in 0..tips {
        let tip = turn(k as f64) * random.between(1.0, 3.0);
        let (before, after) = (turn(k as f64 - 0.5) * inner, turn(k as f64 + 0.5) * inner);
        ring.extend([tip, after]);
        let middle = (before + after) * 0.5;
        let width = (after - before).norm();
        let height = (middle - tip).norm();
        let mut share = 1.0;
        for _ in 0..1 + random.below(3) {
            // At a share of the way from the tip the tip is that share of its width wide; each
            // hole is at most half as far as the one before.
            share *= 10f64.powf(-random.between(0.3, 6.0));
            let sideways = random.between(-0.45, 0.45);
            let at = tip + (middle - tip) * share + (after - before) * (share * sideways);
            let room = share * (width * (0.5 - f64::abs(sideways))).min(0.5 * height);
            let size = room * random.between(0.0, 0.3) * (height / (height + width));
            let start = random.between(0.0, 1.0);
            let corner = |k: usize| {
                let (sin, cos) = (-TAU * (k as f64 / 3.0 + start)).sin_cos();
                at + Point::new(cos, sin) * size
            };
            let hole: Ring = (0..3).map(corner).collect();
            // Near the tip doubles are too coarse for a hole.
            if orient2d(hole[0], hole[1], hole[2]) < 0.0 && size > 1e-13 {
                holes.push(hole);
            }
        }
    }
    let mut rings = vec![ring];
    rings.extend(holes);
    vec![rings]
}
