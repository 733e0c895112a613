//! Long chains: corridors, nearly straight lines, steps that grow.

use std::f64::consts::TAU;

use medial::geom::Point;
use medial_bench::shapes::Random;

use super::{Polygons, Ring};

/// A wedge towards the origin with corners and small holes over twelve orders of magnitude.
pub fn scales(random: &mut Random, edges: usize) -> Polygons {
    let n = (edges / 5).max(2);
    let ratio = 10f64.powf(-12.0 / n as f64);
    let slope = random.between(0.1, 3.0);
    let same = random.below(2) == 0;
    let rough = random.between(0.0, 0.5) * (1.0 - ratio);
    let places: Vec<f64> = (0..n).map(|k| 1e6 * ratio.powi(k as i32)).collect();
    let mut side = |sign: f64| -> Ring {
        let at =
            |&x: &f64| Point::new(x, sign * slope * x * (1.0 + rough * random.between(-1.0, 1.0)));
        places.iter().map(at).collect()
    };
    let below = side(-1.0);
    let above =
        if same { below.iter().map(|p| Point::new(p.x, -p.y)).collect() } else { side(1.0) };
    let mut ring = below;
    ring.reverse();
    ring.extend(above);
    if random.below(2) == 0 {
        ring.push(Point::new(0.0, 0.0));
    }
    let mut rings = vec![ring];
    if random.below(3) > 0 {
        let size = random.between(0.01, 0.3) * (1.0 - ratio) * slope.min(1.0);
        for x in places.iter().filter(|&&x| x * size > 1e-15 && random.below(2) == 0) {
            let at = Point::new(x * (1.0 - 0.5 * (1.0 - ratio)), 0.0);
            let corners = [(1.0, 0.0), (0.0, -1.0), (-1.0, 0.5)];
            rings.push(corners.map(|(u, v)| at + Point::new(u, v) * (x * size)).to_vec());
        }
    }
    vec![rings]
}

/// A corridor along a spiral, much longer than wide.
pub fn thin_spiral(random: &mut Random, edges: usize) -> Polygons {
    let wall = (edges / 2).max(6);
    let turns = random.between(1.0, 30.0).min(wall as f64 / 6.0);
    let width = 10f64.powf(random.between(-6.0, -0.5)) * random.between(0.1, 0.9);
    let n = wall as f64;
    // Steps short enough that chords of the two sides keep apart.
    let point = |k: usize, shift: f64| {
        let t = 1.0 + turns * (k as f64 / (n - 1.0));
        let (sin, cos) = (TAU * t).sin_cos();
        Point::new((t + shift) * cos, (t + shift) * sin)
    };
    let outer = (0..wall).map(|k| point(k, width));
    vec![vec![outer.chain((0..wall).rev().map(|k| point(k, 0.0))).collect()]]
}

/// A corridor of unit width along a square spiral.
pub fn square_spiral(random: &mut Random, edges: usize) -> Polygons {
    let legs = (edges / 2).max(4);
    let (width, wall) = (1 + random.below(3), 1 + random.below(3));
    let pitch = (width + wall) as f64;
    let mut at = Point::new(0.0, 0.0);
    let mut side: Ring = vec![at];
    let ways = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)];
    for leg in 0..legs {
        let (x, y) = ways[leg % 4];
        at = at + Point::new(x, y) * (pitch * (leg / 2 + 2) as f64);
        side.push(at);
    }
    // The other side lies to the left of each leg.
    let w = width as f64;
    let n = side.len();
    let left = |k: usize| {
        let way = |leg: usize| Point::new(ways[leg % 4].0, ways[leg % 4].1).perp() * w;
        let shift = match k {
            0 => way(0),
            _ if k == n - 1 => way(k - 1),
            _ => way(k - 1) + way(k),
        };
        side[k] + shift
    };
    let other: Ring = (0..n).rev().map(left).collect();
    vec![vec![side.into_iter().chain(other).collect()]]
}

/// A rectangle or a triangle whose sides have corners within an ulp or so of straight.
pub fn hairs(random: &mut Random, edges: usize) -> Polygons {
    let corners = match random.below(4) {
        0 => vec![(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)],
        1 => vec![(0.0, 0.0), (3.0, 1.0), (2.0, 4.0), (-1.0, 3.0)],
        2 => vec![(1e6, 1e6), (1e6 + 7.0, 1e6 + 1.0), (1e6 + 6.0, 1e6 + 3.0)],
        _ => (0..4)
            .map(|_| (0, 0))
            .enumerate()
            .map(|(k, _)| {
                let (sin, cos) = (TAU * (k as f64 + random.between(0.0, 0.9)) / 4.0).sin_cos();
                (3.0 + cos, 5.0 + 0.2 * sin)
            })
            .collect(),
    };
    let sides = corners.len();
    let each = (edges / sides).max(1);
    let ulps = [0, 1, 1, 2, 50][random.below(5)];
    let even = random.below(2) == 0;
    let mut ring = Ring::new();
    for k in 0..sides {
        let point = |k: usize| Point::new(corners[k % sides].0, corners[k % sides].1);
        let (a, b) = (point(k), point(k + 1));
        let mut shares: Vec<f64> = (0..each)
            .map(|k| if even { k as f64 / each as f64 } else { random.between(0.0, 1.0) })
            .collect();
        shares[0] = 0.0;
        shares.sort_unstable_by(f64::total_cmp);
        for t in shares {
            let p = a + (b - a) * t;
            let mut hair = |v: f64| {
                let by = random.below(2 * ulps + 1) as i64 - ulps as i64;
                if v == 0.0 { v } else { f64::from_bits(v.to_bits().wrapping_add_signed(by)) }
            };
            ring.push(Point::new(hair(p.x), hair(p.y)));
        }
    }
    ring.dedup();
    vec![vec![ring]]
}

/// A winding road of even width, its two sides offset in doubles.
pub fn corridor(random: &mut Random, edges: usize) -> Polygons {
    let n = (edges / 2).max(3);
    let width = 10f64.powf(random.between(-5.0, -0.4));
    let amplitude = random.between(0.0, 1.5);
    let (step, wave) = (1.0 / random.between(1.0, 20.0), random.between(0.2, 1.0));
    let bend = |t: f64| amplitude * (wave * t).sin();
    let slope = |t: f64| amplitude * wave * (wave * t).cos();
    let side = |k: usize, shift: f64| {
        let t = k as f64 * step;
        let d = slope(t);
        let length = (1.0 + d * d).sqrt();
        Point::new(t - shift * d / length, bend(t) + shift / length)
    };
    let far = (0..n).rev().map(|k| side(k, 0.5 * width));
    vec![vec![(0..n).map(|k| side(k, -0.5 * width)).chain(far).collect()]]
}

/// Two equal zigzags, or one against a line.
pub fn zigzag(random: &mut Random, edges: usize) -> Polygons {
    let line = random.below(2) == 0;
    let n = if line { edges } else { edges / 2 }.max(3);
    let (w, h) = ((1 + random.below(4)) as f64, (1 + random.below(60)) as f64);
    let gap = (1 + random.below(20)) as f64;
    let point = |k: usize, up: f64| {
        Point::new(k as f64 * w, up + if k.is_multiple_of(2) { 0.0 } else { h })
    };
    let mut ring: Ring = if line {
        vec![Point::new(0.0, -gap), Point::new((n - 1) as f64 * w, -gap)]
    } else {
        (0..n).map(|k| point(k, -gap)).collect()
    };
    ring.extend((0..n).rev().map(|k| point(k, 0.0)));
    vec![vec![ring]]
}
