//! Shapes on lattices of small whole numbers, or near them.

use std::collections::HashMap;
use std::f64::consts::TAU;

use medial::geom::Point;
use medial_bench::shapes::Random;

use super::{Polygons, Ring};

/// Cells along each side, for that many edges a cell.
pub fn side(edges: usize, per_cell: usize) -> usize {
    ((edges as f64 / per_cell as f64).sqrt().round() as usize).max(1)
}

/// A box around `side` times `side` cells of a width, with a hole in each.
pub fn framed(side: usize, width: f64, mut hole: impl FnMut(Point) -> Option<Ring>) -> Polygons {
    let end = side as f64 * width;
    let frame = [(0.0, 0.0), (end, 0.0), (end, end), (0.0, end)];
    let mut rings: Vec<Ring> = vec![frame.map(|(x, y)| Point::new(x, y)).to_vec()];
    for k in 0..side * side {
        let at = Point::new((k % side) as f64 + 0.5, (k / side) as f64 + 0.5) * width;
        rings.extend(hole(at));
    }
    vec![rings]
}

/// Octagons whose gaps have eight corners on one circle; some are left out.
pub fn rooms(random: &mut Random, edges: usize) -> Polygons {
    let (a, b) = [(1.0, 3.0), (2.0, 5.0), (3.0, 4.0), (1.0, 2.0)][random.below(4)];
    let gap = 1 + random.below(3);
    let width = 2.0 * (b + gap as f64);
    let missing = [0.0, 0.0, 0.02, 0.3][random.below(4)];
    let corners = [(a, b), (b, a), (b, -a), (a, -b), (-a, -b), (-b, -a), (-b, a), (-a, b)];
    framed(side(edges, 8), width, |at| {
        (random.between(0.0, 1.0) >= missing)
            .then(|| corners.map(|(x, y)| at + Point::new(x, y)).to_vec())
    })
}

/// Regular polygons with four, eight or twelve corners, in doubles.
pub fn octagons(random: &mut Random, edges: usize) -> Polygons {
    let corners = [8, 8, 4, 12][random.below(4)];
    let start = [0.5 / corners as f64, 0.0, random.between(0.0, 1.0)][random.below(3)];
    let radius = random.between(0.1, 0.49);
    framed(side(edges, corners), 1.0, |at| {
        let corner = |k: usize| {
            let (sin, cos) = (-TAU * (k as f64 / corners as f64 + start)).sin_cos();
            at + Point::new(cos, sin) * radius
        };
        Some((0..corners).map(corner).collect())
    })
}

/// Holes with some of the twelve or more whole corners of one circle.
pub fn circles(random: &mut Random, edges: usize) -> Polygons {
    let radius = [5.0, 25.0, 65.0, 325.0][random.below(4)];
    let all = lattice_circle(radius);
    let share = random.between(0.3, 1.0);
    let width = 2.0 * radius + 2.0 * (1 + random.below(3)) as f64;
    framed(side(edges, (all.len() as f64 * share) as usize + 1), width, |at| {
        let kept = all.iter().filter(|_| random.between(0.0, 1.0) < share);
        let ring: Ring = kept.rev().map(|&p| at + p).collect();
        (ring.len() > 2).then_some(ring)
    })
}

/// Points with whole coordinates on a circle, counterclockwise.
pub fn lattice_circle(radius: f64) -> Ring {
    let quarter: Ring = (0..radius as u32)
        .map(|y| Point::new((radius * radius - f64::from(y * y)).sqrt(), f64::from(y)))
        .filter(|p| p.x.fract() == 0.0)
        .collect();
    let turn = |p: Point, turns: usize| (0..turns).fold(p, |p, _| Point::new(-p.y, p.x));
    (0..4).flat_map(|turns| quarter.iter().map(move |&p| turn(p, turns))).collect()
}

/// The outline of random cells of a grid: rings touch at corners.
pub fn cells(random: &mut Random, edges: usize) -> Polygons {
    let density = random.between(0.2, 0.8);
    // A cell has four sides, and each is on the outline if its neighbour differs.
    let share = 4.0 * density * (1.0 - density);
    let side = ((edges as f64 / share).sqrt() as usize).max(2);
    let full: Vec<bool> = (0..side * side).map(|_| random.between(0.0, 1.0) < density).collect();
    vec![outline(side, &|x, y| full[y * side + x], random.below(2) == 0)]
}

/// Rings around cells, walked with the cells to the left.
fn outline(side: usize, full: &dyn Fn(usize, usize) -> bool, left: bool) -> Vec<Ring> {
    type Node = (i32, i32);
    let is_full = |x: i32, y: i32| {
        let inside = |v: i32| (0..side as i32).contains(&v);
        inside(x) && inside(y) && full(x as usize, y as usize)
    };
    let mut next: HashMap<Node, Vec<Node>> = HashMap::new();
    let mut starts = Vec::new();
    for y in 0..side as i32 {
        for x in (0..side as i32).filter(|&x| is_full(x, y)) {
            let sides = [
                (is_full(x, y - 1), (x, y), (x + 1, y)),
                (is_full(x + 1, y), (x + 1, y), (x + 1, y + 1)),
                (is_full(x, y + 1), (x + 1, y + 1), (x, y + 1)),
                (is_full(x - 1, y), (x, y + 1), (x, y)),
            ];
            for &(_, a, b) in sides.iter().filter(|s| !s.0) {
                next.entry(a).or_default().push(b);
                starts.push(a);
            }
        }
    }
    let mut rings = Vec::new();
    for start in starts {
        let (mut at, mut way) = (start, (0, 0));
        let mut ring = Ring::new();
        while let Some(ends) = next.get_mut(&at) {
            // Where two cells meet at a corner either way is right.
            let turn = |b: Node| way.0 * (b.1 - at.1) - way.1 * (b.0 - at.0);
            let pick =
                (0..ends.len()).max_by_key(|&k| if left { turn(ends[k]) } else { -turn(ends[k]) });
            let Some(pick) = pick else { break };
            let to = ends.swap_remove(pick);
            let step = (to.0 - at.0, to.1 - at.1);
            if step != way {
                ring.push(Point::new(at.0.into(), at.1.into()));
            }
            (at, way) = (to, step);
        }
        if ring.len() > 2 {
            rings.push(ring);
        }
    }
    rings
}

/// Squares of a lattice as polygons of their own, that share corners with neighbours.
pub fn checkers(random: &mut Random, edges: usize) -> Polygons {
    let side = side(2 * edges, 4);
    let missing = [0.0, 0.1, 0.5][random.below(3)];
    let split = random.below(2) == 0;
    let mut polygons = Polygons::new();
    for k in (0..side * side).filter(|k| (k % side + k / side).is_multiple_of(2)) {
        if random.between(0.0, 1.0) < missing {
            continue;
        }
        let at = Point::new((k % side) as f64, (k / side) as f64) * 2.0;
        let corner = |x: f64, y: f64| at + Point::new(x, y);
        let mut ring = vec![corner(0.0, 0.0), corner(2.0, 0.0), corner(2.0, 2.0), corner(0.0, 2.0)];
        if split && random.below(3) == 0 {
            ring.remove(random.below(4));
        }
        polygons.push(vec![ring]);
    }
    polygons
}

/// Diamonds that touch at their tips, as holes.
pub fn diamonds(random: &mut Random, edges: usize) -> Polygons {
    let missing = random.between(0.1, 0.9);
    let flat = [1.0, 0.5, 0.25][random.below(3)];
    // Missing ones keep most of the inside connected.
    framed(side((edges as f64 / (1.0 - missing)) as usize, 4), 8.0, |at| {
        let corners = [(0.0, 4.0), (4.0, 0.0), (0.0, -4.0), (-4.0, 0.0)];
        (random.between(0.0, 1.0) >= missing)
            .then(|| corners.map(|(x, y)| at + Point::new(x, y * flat)).to_vec())
    })
}

/// Many small polygons of one feature, each with a hole or two.
pub fn crowd(random: &mut Random, edges: usize) -> Polygons {
    let side = side(edges, 10);
    let mut polygons = Polygons::new();
    for k in 0..side * side {
        let at = Point::new((k % side) as f64, (k / side) as f64) * 12.0;
        let (w, h) = (5 + random.below(6), 5 + random.below(6));
        let ring = |x: usize, y: usize, w: usize, h: usize| -> Ring {
            let corners = [(x, y), (x + w, y), (x + w, y + h), (x, y + h)];
            corners.map(|(x, y)| at + Point::new(x as f64, y as f64)).to_vec()
        };
        let mut rings = vec![ring(0, 0, w, h)];
        if random.below(4) > 0 {
            let x = 1 + random.below(w - 3);
            let y = 1 + random.below(h - 3);
            let (v, u) = (1 + random.below(w - x - 2), 1 + random.below(h - y - 2));
            let mut hole = ring(x, y, v, u);
            if random.below(3) == 0 {
                hole.remove(random.below(4));
            }
            rings.push(hole);
        }
        polygons.push(rings);
    }
    polygons
}

/// A blob of cells without touching corners: each row a run, rows next to one another overlap.
pub fn pixels(random: &mut Random, edges: usize) -> Polygons {
    let rows = (edges / 4).max(2);
    let most = 2 + random.below(30) as i64;
    let mut runs: Vec<(i64, i64)> = vec![(0, most)];
    while runs.len() < rows {
        let (l, r) = runs[runs.len() - 1];
        let by = |random: &mut Random| random.below(5) as i64 - 2;
        let (l, r) = (l + by(random), r + by(random));
        let (p, q) = runs[runs.len() - 1];
        if r - l > 0 && l < q && r > p {
            runs.push((l, r));
        }
    }
    let right = (0i64..).zip(&runs).flat_map(|(y, &(_, r))| [(r, y), (r, y + 1)]);
    let left: Vec<(i64, i64)> =
        (0i64..).zip(&runs).flat_map(|(y, &(l, _))| [(l, y), (l, y + 1)]).collect();
    let mut ring: Ring =
        right.chain(left.into_iter().rev()).map(|(x, y)| Point::new(x as f64, y as f64)).collect();
    ring.dedup();
    vec![vec![ring]]
}
