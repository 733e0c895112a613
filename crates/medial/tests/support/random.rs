//! Random numbers and random shapes from a seed.

use medial::geom::Point;

use super::shapes::Polygons;

/// SplitMix64.
#[derive(Clone)]
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A whole number below `n`.
    pub fn below(&mut self, n: u64) -> u64 {
        self.next() % n
    }

    /// A double from 0 to 1.
    pub fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1u64 << 53) as f64
    }
}

/// Where the corners of random shapes lie.
#[derive(Clone, Copy, Debug)]
pub enum Ground {
    /// Whole numbers from 0 to this: full of ties.
    Grid(u64),
    /// Any doubles of the unit square.
    Square,
}

impl Ground {
    fn point(self, random: &mut Random) -> Point {
        match self {
            Self::Grid(size) => {
                let mut whole = || random.below(size + 1) as f64;
                Point::new(whole(), whole())
            }
            Self::Square => Point::new(random.unit(), random.unit()),
        }
    }
}

/// A polygon with at most `most` edges, now and then with holes; it may be invalid, and rings may
/// touch themselves and one another.
pub fn polygon(random: &mut Random, ground: Ground, most: u64) -> Polygons {
    let outer = 3 + random.below(most - 2);
    let mut rings = vec![ring(random, ground, outer)];
    let mut left = most - outer;
    while left >= 3 && random.below(4) > 0 {
        let n = 3 + random.below(left.min(5) - 2);
        left -= n;
        rings.push(hole(random, ground, n));
    }
    vec![rings]
}

/// A random ring, untangled by turning round the part between two edges that cross.
fn ring(random: &mut Random, ground: Ground, n: u64) -> Vec<Point> {
    let mut points: Vec<Point> = (0..n).map(|_| ground.point(random)).collect();
    let n = points.len();
    for _ in 0..100 {
        let crossing = (0..n).find_map(|i| {
            (i + 2..n)
                .filter(|&j| (j + 1) % n != i)
                .find(|&j| cross(points[i], points[i + 1], points[j], points[(j + 1) % n]))
                .map(|j| (i, j))
        });
        let Some((i, j)) = crossing else { break };
        points[i + 1..=j].reverse();
    }
    points
}

/// A small ring somewhere.
fn hole(random: &mut Random, ground: Ground, n: u64) -> Vec<Point> {
    match ground {
        Ground::Grid(size) => {
            let corner = ground.point(random);
            let span = 1 + random.below(2.max(size / 3));
            let mut small = ring(random, Ground::Grid(span), n);
            small.iter_mut().for_each(|p| *p = *p + corner);
            small
        }
        Ground::Square => {
            let corner = ground.point(random);
            let span = 0.3 * random.unit();
            ring(random, ground, n).into_iter().map(|p| corner + p * span).collect()
        }
    }
}

/// Whether two segments cross in their inner points.
fn cross(a: Point, b: Point, c: Point, d: Point) -> bool {
    let side = |p: Point, q: Point, r: Point| medial::geom::orient2d(p, q, r);
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}
