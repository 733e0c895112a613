//! Polygons of any kind, most of them invalid: for the domain.

use medial::domain::{Domain, Options};
use medial::geom::Point;

use super::bytes::Bytes;
use super::{Polygons, Ring};

/// Most points in all.
const LIMIT: usize = 200;

/// Polygons from a list of commands, one to three bytes each, or more for a full double.
pub fn any_polygons(data: &[u8]) -> Polygons {
    let bytes = &mut Bytes(data);
    let style = bytes.byte();
    let size = [3, 5, 9, 255][usize::from(style & 3)];
    let step = [1.0, 0.1, 2f64.powi(-170), 2e7 + 0.125][usize::from(style >> 2 & 3)];
    let mut polygons: Polygons = vec![vec![Vec::new()]];
    let mut all: Ring = Vec::new();
    while !bytes.is_empty() && all.len() < LIMIT {
        let command = bytes.byte();
        let last = all.last().copied().unwrap_or(Point::new(0.0, 0.0));
        let point = match command % 16 {
            0..=4 => bytes.grid_point(size) * step,
            // Along the grid.
            5..=7 => {
                let by = f64::from(command >> 6) + 1.0;
                let (dx, dy) = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)]
                    [usize::from(command >> 4 & 3)];
                last + Point::new(dx * by, dy * by) * step
            }
            8 => pick(&all, bytes),
            9 => (pick(&all, bytes) + pick(&all, bytes)) * 0.5,
            10 => nudge(pick(&all, bytes), bytes.byte()),
            11 => match command >> 4 {
                0 => Point::new(bytes.double(), bytes.double()),
                1 => Point::new(bytes.double(), last.y),
                2 => Point::new(f64::NAN, last.y),
                3 => Point::new(last.x, f64::INFINITY),
                4 => Point::new(last.x * 2f64.powi(190), last.y),
                5 => Point::new(2f64.powi(-200), last.y),
                6 => Point::new(-0.0, last.y),
                _ => Point::new(bytes.signed(), bytes.signed()),
            },
            // A box, a triangle, a ring again: smaller, shifted or reversed.
            12 => {
                let (a, b) = (bytes.grid_point(size) * step, bytes.grid_point(size) * step);
                let ring = [a, Point::new(b.x, a.y), b, Point::new(a.x, b.y)];
                all.extend(ring);
                add_ring(&mut polygons, ring.to_vec());
                continue;
            }
            13 => {
                let ring = echo(&polygons, bytes, step);
                if all.len() + ring.len() < LIMIT {
                    all.extend(&ring);
                    add_ring(&mut polygons, ring);
                }
                continue;
            }
            14 => {
                add_ring(&mut polygons, Vec::new());
                continue;
            }
            _ => {
                polygons.push(vec![Vec::new()]);
                continue;
            }
        };
        all.push(point);
        if let Some(ring) = polygons.last_mut().and_then(|p| p.last_mut()) {
            ring.push(point);
        }
    }
    if style & 64 != 0 {
        polygons.iter_mut().flatten().filter(|r| r.len() < 20).for_each(untangle);
    }
    if style & 128 != 0 {
        // A lot of inputs end in an empty ring, which is refused at once.
        polygons.iter_mut().for_each(|p| p.retain(|r| r.len() > 2));
        polygons.retain(|p| !p.is_empty());
    }
    if style & 32 != 0 {
        polygons = sifted(polygons);
    }
    polygons
}

/// What is left without the rings that make the feature invalid.
fn sifted(polygons: Polygons) -> Polygons {
    let valid = |polygons: &Polygons| Domain::from_polygons(polygons, &Options::default()).is_ok();
    let mut kept: Polygons = Vec::new();
    for polygon in polygons {
        kept.push(Vec::new());
        for ring in polygon {
            let last = kept.len() - 1;
            kept[last].push(ring);
            if !valid(&kept) {
                kept[last].pop();
            }
        }
        if kept.last().is_some_and(Vec::is_empty) {
            kept.pop();
        }
    }
    kept
}

/// Starts a ring; one without points is filled first.
fn add_ring(polygons: &mut Polygons, ring: Ring) {
    let Some(polygon) = polygons.last_mut() else { return };
    match polygon.last_mut() {
        Some(last) if last.is_empty() => *last = ring,
        _ => polygon.push(ring),
    }
}

fn pick(points: &[Point], bytes: &mut Bytes) -> Point {
    let back = bytes.below(256);
    let default = Point::new(0.0, 0.0);
    points.iter().rev().nth(back % points.len().max(1)).copied().unwrap_or(default)
}

/// A copy of a ring already there.
fn echo(polygons: &Polygons, bytes: &mut Bytes, step: f64) -> Ring {
    let rings: Vec<&Ring> = polygons.iter().flatten().collect();
    let Some(&ring) = rings.get(bytes.below(rings.len().clamp(1, 256))) else { return Vec::new() };
    let mut ring = ring.clone();
    let Some(&first) = ring.first() else { return ring };
    let how = bytes.byte();
    let scale = [1.0, 0.5, 0.25, -1.0][usize::from(how & 3)];
    let shift = [Point::new(0.0, 0.0), bytes.grid_point(9) * step][usize::from(how >> 2 & 1)];
    ring.iter_mut().for_each(|p| *p = first + (*p - first) * scale + shift);
    if how & 8 != 0 {
        ring.reverse();
    }
    if how & 16 != 0 {
        // Around a point already there.
        let back = (pick(&ring, bytes) - first) * 1.0;
        ring.iter_mut().for_each(|p| *p = *p - back);
    }
    ring
}

/// A neighbour of a point in the set of doubles.
pub fn nudge(p: Point, how: u8) -> Point {
    let by = i64::from(how >> 2 & 7) - 3;
    let moved = |x: f64| {
        if !x.is_finite() || x == 0.0 {
            return x;
        }
        f64::from_bits(x.to_bits().wrapping_add_signed(by))
    };
    Point::new(
        if how & 1 == 0 { moved(p.x) } else { p.x },
        if how & 2 == 0 { moved(p.y) } else { p.y },
    )
}

/// Turns round the part between two edges that cross, until none do or it takes too long.
pub fn untangle(ring: &mut Ring) {
    let n = ring.len();
    for _ in 0..100 {
        let crossing = (0..n).find_map(|i| {
            (i + 2..n)
                .filter(|&j| (j + 1) % n != i)
                .find(|&j| cross(ring[i], ring[i + 1], ring[j], ring[(j + 1) % n]))
                .map(|j| (i, j))
        });
        let Some((i, j)) = crossing else { return };
        ring[i + 1..=j].reverse();
    }
}

/// Whether two segments cross in their inner points, nearly enough.
fn cross(a: Point, b: Point, c: Point, d: Point) -> bool {
    let side = |p: Point, q: Point, r: Point| (q - p).cross(r - p);
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}
