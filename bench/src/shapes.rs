//! Polygons of about a wanted number of edges, with whole coordinates that fit 32 bits.

use std::f64::consts::TAU;

/// Half the width of a drawing.
const SIZE: f64 = 1e9;

type Ring = Vec<(i32, i32)>;

/// The rings of a shape, the outer one first.
pub fn draw(shape: &str, edges: usize) -> Option<Vec<Ring>> {
    let random = &mut Random(edges as u64);
    Some(match shape {
        "koch" => vec![koch(random, edges)],
        "star" => vec![star(random, edges)],
        "maze" => vec![maze(random, edges)],
        "comb" => vec![comb(edges)],
        "holes" => holes(random, edges),
        _ => return None,
    })
}

/// SplitMix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn between(&mut self, least: f64, most: f64) -> f64 {
        least + (most - least) * (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }

    fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }
}

fn whole(x: f64, y: f64) -> (i32, i32) {
    (x.round() as i32, y.round() as i32)
}

/// Koch's coast with thirds and heights jittered; the last round divides only some edges.
fn koch(random: &mut Random, edges: usize) -> Ring {
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
    ring.into_iter().map(|(x, y)| whole(x, y)).collect()
}

/// Corners at equal angles and any distance from the middle.
fn star(random: &mut Random, edges: usize) -> Ring {
    let corner = |k: usize| {
        let (sin, cos) = (TAU * k as f64 / edges as f64).sin_cos();
        let radius = SIZE * random.between(0.3, 1.0);
        whole(radius * cos, radius * sin)
    };
    (0..edges).map(corner).collect()
}

/// The outline of the corridors of a random maze without loops, its corners jittered.
fn maze(random: &mut Random, edges: usize) -> Ring {
    // A room has about 4/3 corners.
    let side = ((edges as f64 * 0.75).sqrt() as usize).max(2);
    let mut seen = vec![false; side * side];
    // Passages to the right of each room, and above it.
    let mut open = vec![[false; 2]; side * side];
    let mut stack = vec![0];
    seen[0] = true;
    while let Some(&room) = stack.last() {
        let (x, y) = (room % side, room / side);
        let neighbours: Vec<(usize, usize, usize)> = [
            (x + 1 < side).then(|| (room + 1, room, 0)),
            (y + 1 < side).then(|| (room + side, room, 1)),
            (x > 0).then(|| (room - 1, room.wrapping_sub(1), 0)),
            (y > 0).then(|| (room - side, room.wrapping_sub(side), 1)),
        ]
        .into_iter()
        .flatten()
        .filter(|n| !seen[n.0])
        .collect();
        if neighbours.is_empty() {
            stack.pop();
            continue;
        }
        let (next, owner, way) = neighbours[random.below(neighbours.len())];
        seen[next] = true;
        open[owner][way] = true;
        stack.push(next);
    }
    // Rooms and passages are full cells of a grid twice as fine, with walls between.
    let cells = 2 * side + 1;
    let full = |x: i64, y: i64| {
        if x < 1 || y < 1 || x >= cells as i64 || y >= cells as i64 {
            return false;
        }
        let (x, y) = (x as usize, y as usize);
        match (x % 2, y % 2) {
            (1, 1) => true,
            (0, 1) => open[(y / 2) * side + x / 2 - 1][0],
            (1, 0) => open[(y / 2 - 1) * side + x / 2][1],
            _ => false,
        }
    };
    // Walk around with the full cells to the left.
    let steps = [(1, 0), (0, 1), (-1, 0), (0, -1)];
    let ahead = |(x, y): (i64, i64), way: usize| match way {
        0 => [full(x, y), full(x, y - 1)],
        1 => [full(x - 1, y), full(x, y)],
        2 => [full(x - 1, y - 1), full(x - 1, y)],
        _ => [full(x, y - 1), full(x - 1, y - 1)],
    };
    let unit = 2.0 * SIZE / cells as f64;
    let mut place = |(x, y): (i64, i64)| {
        let mut jittered = |v: i64| (v as f64 + random.between(-0.2, 0.2)) * unit - SIZE;
        let x = jittered(x);
        whole(x, jittered(y))
    };
    let mut ring = Vec::new();
    let (mut at, mut way) = ((1i64, 1i64), 0);
    loop {
        at = (at.0 + steps[way].0, at.1 + steps[way].1);
        let turned = match ahead(at, way) {
            [_, true] => (way + 3) % 4,
            [false, false] => (way + 1) % 4,
            [true, false] => way,
        };
        if turned != way {
            ring.push(place(at));
            way = turned;
        }
        if at == (1, 1) {
            return ring;
        }
    }
}

/// Equal teeth on a bar, everything parallel to the axes.
fn comb(edges: usize) -> Ring {
    let teeth = (edges / 4).max(1);
    let unit = (SIZE / teeth as f64).floor() as i32;
    let (foot, tip) = (unit, 40 * unit.min(10_000_000));
    let mut ring = vec![(0, 0), ((2 * teeth as i32 - 1) * unit, 0)];
    for tooth in (0..teeth as i32).rev() {
        let x = 2 * tooth * unit;
        ring.extend([(x + unit, tip), (x, tip)]);
        if tooth > 0 {
            ring.extend([(x, foot), (x - unit, foot)]);
        }
    }
    ring
}

/// A square with a lattice of jittered holes of twelve corners.
fn holes(random: &mut Random, edges: usize) -> Vec<Ring> {
    let side = ((edges as f64 / 12.0).sqrt().round() as usize).max(1);
    let unit = 2.0 * SIZE / side as f64;
    let s = SIZE as i32;
    let mut rings = vec![vec![(-s, -s), (s, -s), (s, s), (-s, s)]];
    for k in 0..side * side {
        let mut shifted = |v: usize| (v as f64 + random.between(0.4, 0.6)) * unit - SIZE;
        let (x, y) = (shifted(k % side), shifted(k / side));
        let corner = |k: usize| {
            let (sin, cos) = (-TAU * k as f64 / 12.0).sin_cos();
            let radius = unit * random.between(0.15, 0.35);
            whole(x + radius * cos, y + radius * sin)
        };
        rings.push((0..12).map(corner).collect());
    }
    rings
}
