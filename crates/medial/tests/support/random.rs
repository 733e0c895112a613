//! Random numbers and random shapes from a seed.

use medial::domain::Domain;
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

/// Ways to make shapes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// One ring, untangled, sometimes with small holes.
    Tangle,
    /// A large triangle or box full of small holes.
    Holes,
    /// The same with every hole hung on a corner of what is there.
    Hung,
    /// Some triangles of a lattice of split squares: touches, straight joints, several parts.
    Triangles,
    /// Some squares of a lattice.
    Squares,
}

/// A random shape of a family with few edges; it may be invalid.
///
/// Rings may touch themselves and one another, so they are to be regrouped by their depth.
pub fn shape(random: &mut Random, family: Family, ground: Ground) -> Polygons {
    large_shape(random, family, ground, 14)
}

/// The same with up to `most` edges in its tangles, and lattices of that many cells.
pub fn large_shape(random: &mut Random, family: Family, ground: Ground, most: u64) -> Polygons {
    // 14 edges come from lattices three and four cells wide.
    let cells = |n: u64| (n * most / 14) as i32;
    match family {
        Family::Tangle => {
            let outer = 3 + random.below(most - 2);
            let mut rings = vec![ring(random, ground, outer)];
            let mut left = most - outer;
            while left >= 3 && random.below(3) > 0 {
                let n = 3 + random.below(left.min(5) - 2);
                left -= n;
                rings.push(hole(random, ground, n));
            }
            vec![rings]
        }
        Family::Holes | Family::Hung => {
            let (corner, size) = match ground {
                Ground::Grid(size) => (Point::new(0.0, 0.0), size as f64),
                Ground::Square => (Point::new(-0.2, -0.3), 1.6),
            };
            let at = |x: f64, y: f64| corner + Point::new(x, y) * size;
            let mut outer = vec![at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)];
            if random.below(2) == 0 {
                outer.remove(random.below(4) as usize);
            }
            let n = 1 + random.below(most / 4);
            let mut rings = vec![outer];
            for _ in 0..n {
                let corners = 3 + random.below(2);
                let mut hole = hole(random, ground, corners);
                if family == Family::Hung {
                    let ring = &rings[random.below(rings.len() as u64) as usize];
                    let corner = ring[random.below(ring.len() as u64) as usize];
                    let by = corner - hole[0];
                    hole.iter_mut().for_each(|p| *p = *p + by);
                    hole[0] = corner;
                }
                rings.push(hole);
            }
            vec![rings]
        }
        Family::Triangles => vec![lattice(random, cells(3), true)],
        Family::Squares => vec![lattice(random, cells(4), false)],
    }
}

/// The boundary of some cells of a square lattice, each split in two if `split`.
fn lattice(random: &mut Random, size: i32, split: bool) -> Vec<Vec<Point>> {
    let mut edges: Vec<[(i32, i32); 2]> = Vec::new();
    let mut add = |random: &mut Random, cell: &[(i32, i32)]| {
        if random.below(20) < 9 {
            return;
        }
        for k in 0..cell.len() {
            let (a, b) = (cell[k], cell[(k + 1) % cell.len()]);
            match edges.iter().position(|&edge| edge == [b, a]) {
                Some(twin) => drop(edges.swap_remove(twin)),
                None => edges.push([a, b]),
            }
        }
    };
    for x in 0..size {
        for y in 0..size {
            let [a, b, c, d] = [(x, y), (x + 1, y), (x + 1, y + 1), (x, y + 1)];
            match (split, random.below(2)) {
                (false, _) => add(random, &[a, b, c, d]),
                (true, 0) => {
                    add(random, &[a, b, c]);
                    add(random, &[a, c, d]);
                }
                (true, _) => {
                    add(random, &[a, b, d]);
                    add(random, &[b, c, d]);
                }
            }
        }
    }
    let mut rings = Vec::new();
    while let Some([start, mut at]) = edges.pop() {
        let mut ring = vec![start];
        while at != start {
            ring.push(at);
            let next = edges.iter().position(|edge| edge[0] == at).expect("the boundary closes");
            at = edges.swap_remove(next)[1];
        }
        rings.push(ring.into_iter().map(|(x, y)| Point::new(x.into(), y.into())).collect());
    }
    rings
}

/// The same shape turned and scaled by small whole numbers and moved far, all without rounding.
///
/// Only for corners that are small whole numbers.
pub fn carried(random: &mut Random, polygons: &Polygons) -> Polygons {
    let (a, b) = (1.0 + random.below(3) as f64, random.below(7) as f64 - 3.0);
    let far = [0.0, 0.0, 1e7, -123_456_789.0][random.below(4) as usize];
    moved(polygons, |p| Point::new(a * p.x - b * p.y + far, b * p.x + a * p.y - far))
}

/// The same shape with one coordinate of one corner, or of all corners there, changed by the
/// smallest amount.
pub fn off_by_a_hair(random: &mut Random, polygons: &Polygons) -> Polygons {
    let corners: Vec<Point> = polygons.iter().flatten().flatten().copied().collect();
    let Some(&chosen) = corners.get(random.below(corners.len().max(1) as u64) as usize) else {
        return polygons.clone();
    };
    let (along_x, up) = (random.below(2) == 0, random.below(2) == 0);
    let step = |v: f64| if up { v.next_up() } else { v.next_down() };
    moved(polygons, |p| match p == chosen {
        true if along_x => Point::new(step(p.x), p.y),
        true => Point::new(p.x, step(p.y)),
        false => p,
    })
}

fn moved(polygons: &Polygons, by: impl Fn(Point) -> Point) -> Polygons {
    let ring = |ring: &Vec<Point>| ring.iter().map(|&p| by(p)).collect();
    polygons.iter().map(|rings| rings.iter().map(ring).collect()).collect()
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

/// Domains of some forty edges with holes and touches, of two kinds of ground, with their seeds.
pub fn random_domains(n: u64) -> impl Iterator<Item = (u64, Domain)> {
    (1..=n).filter_map(|seed| {
        let mut random = Random(seed);
        let family = [Family::Tangle, Family::Holes, Family::Squares][seed as usize % 3];
        let ground = [Ground::Square, Ground::Grid(20)][seed as usize % 2];
        let polygons = large_shape(&mut random, family, ground, 40);
        let options = medial::domain::Options { regroup: true, ..Default::default() };
        Domain::from_polygons(&polygons, &options).ok().map(|domain| (seed, domain))
    })
}
