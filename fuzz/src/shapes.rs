//! Shapes of several families, nearly all of them valid: for the engine.

use medial::domain::{Domain, Options};
use medial::geom::Point;

use super::bytes::Bytes;
use super::polygons::{nudge, untangle};
use super::{Polygons, Ring};

/// How many families there are; the first byte picks one.
pub const FAMILIES: usize = 11;

/// A shape before it is validated.
struct Draft {
    /// The outer ring and candidates for holes.
    rings: Vec<Ring>,
    /// Find the holes by depth.
    regroup: bool,
    /// Another polygon, placed beside this one.
    beside: Option<Ring>,
}

impl From<Vec<Ring>> for Draft {
    fn from(rings: Vec<Ring>) -> Self {
        Self { rings, regroup: false, beside: None }
    }
}

/// A valid shape.
pub struct Shape {
    /// The polygons as given.
    pub polygons: Polygons,
    /// How they are understood.
    pub options: Options,
    /// Their domain.
    pub domain: Domain,
}

/// The shape that bytes stand for, if it is valid.
pub fn shape(data: &[u8]) -> Option<Shape> {
    let bytes = &mut Bytes(data);
    let family = bytes.below(FAMILIES);
    let (scale, place, pose) = (bytes.byte(), bytes.byte(), bytes.byte());
    let mut draft = match family {
        0 => grid(bytes).into(),
        1 => star(bytes).into(),
        2 => Draft { rings: cells(bytes), regroup: true, beside: None },
        3 => round(bytes).into(),
        4 => sliver(bytes).into(),
        5 => fixture(bytes),
        6 => wedge(bytes).into(),
        7 => scatter(bytes).into(),
        8 => coast(bytes).into(),
        9 => comb(bytes).into(),
        _ => pair(bytes),
    };
    for ring in draft.rings.iter_mut().chain(&mut draft.beside) {
        ring.iter_mut().for_each(|p| *p = moved(*p, scale, place, pose));
        if pose & 16 != 0 {
            ring.reverse();
        }
        // Some points pass to neighbouring doubles.
        if pose & 32 != 0 {
            for p in ring {
                if bytes.byte() & 192 == 192 {
                    *p = nudge(*p, bytes.byte());
                }
            }
        }
    }
    accept(draft)
}

/// An exact turn, scale and mirror image; a shift that rounds.
fn moved(p: Point, scale: u8, place: u8, pose: u8) -> Point {
    let p = match pose & 3 {
        0 => p,
        1 => Point::new(-p.y, p.x),
        2 => Point::new(p.y, p.x),
        // A turn by the angle of 3, 4, 5, which keeps whole numbers whole.
        _ => Point::new(3.0 * p.x - 4.0 * p.y, 4.0 * p.x + 3.0 * p.y),
    };
    let p = p * match pose >> 2 & 3 {
        0 | 1 => 1.0,
        2 => 0.1,
        _ => 1.0 / 3.0,
    };
    let scale = if scale & 128 == 0 { 0 } else { i32::from(scale & 127) % 61 - 30 };
    let p = p * 2f64.powi(scale);
    p + match place % 8 {
        0..=4 => Point::new(0.0, 0.0),
        5 => Point::new(2e7, 2e7),
        6 => Point::new(2e7 + 0.3, -3e6),
        _ => Point::new(-1e6 / 3.0, 7.0),
    }
}

/// Adds the holes that leave the polygon valid, one after the other.
fn accept(draft: Draft) -> Option<Shape> {
    let options = Options { regroup: draft.regroup, ..Options::default() };
    let build = |polygons: &Polygons| Domain::from_polygons(polygons, &options).ok();
    let mut polygons = vec![draft.rings];
    polygons.extend(draft.beside.map(|ring| vec![ring]));
    if let Some(domain) = build(&polygons) {
        return Some(Shape { polygons, options, domain });
    }
    let rings = polygons.swap_remove(0);
    let mut polygons = vec![vec![rings.first()?.clone()]];
    let mut domain = build(&polygons)?;
    for hole in rings.into_iter().skip(1) {
        polygons[0].push(hole);
        match build(&polygons) {
            Some(larger) => domain = larger,
            None => drop(polygons[0].pop()),
        }
    }
    Some(Shape { polygons, options, domain })
}

/// Whole numbers from 0 to at most 16: ties, touching rings, rings that touch themselves.
fn grid(bytes: &mut Bytes) -> Vec<Ring> {
    let size = 2 + bytes.below(15);
    let mut outer: Ring = (0..3 + bytes.below(28)).map(|_| bytes.grid_point(size)).collect();
    untangle(&mut outer);
    let mut rings = vec![outer];
    for _ in 0..bytes.below(8) {
        let corner = bytes.grid_point(size);
        let span = 1 + bytes.below(2.max(size / 3));
        let mut hole: Ring =
            (0..3 + bytes.below(4)).map(|_| corner + bytes.grid_point(span)).collect();
        untangle(&mut hole);
        rings.push(hole);
    }
    rings
}

/// A polygon seen whole from the origin, with small holes.
fn star(bytes: &mut Bytes) -> Vec<Ring> {
    let n = 3 + bytes.below(40);
    let steps: Vec<(f64, f64)> = (0..n).map(|_| (0.02 + bytes.unit(), bytes.unit())).collect();
    let all: f64 = steps.iter().map(|s| s.0).sum();
    let flat = [0.02, 0.5, 0.98, 0.999_999][bytes.below(4)];
    let mut angle = 0.0;
    let outer = steps.iter().map(|&(step, radius)| {
        angle += step / all;
        on_circle(angle) * (flat + (1.0 - flat) * radius)
    });
    let mut rings: Vec<Ring> = vec![outer.collect()];
    for _ in 0..bytes.below(6) {
        let centre = on_circle(bytes.unit()) * bytes.unit();
        let span = bytes.unit() * 2f64.powi(-(bytes.below(20) as i32));
        let corners = 3 + bytes.below(4);
        let corner = |k: usize| centre + on_circle(k as f64 / corners as f64) * span;
        rings.push((0..corners).map(corner).collect());
    }
    rings
}

/// The point of the unit circle at a share of the full turn, from rational functions only.
fn on_circle(turn: f64) -> Point {
    let turn = turn.fract() * 4.0;
    let t = turn.fract();
    let t = t * (1.0 + t) * 0.5;
    let (x, y) = ((1.0 - t * t) / (1.0 + t * t), 2.0 * t / (1.0 + t * t));
    match turn as u8 {
        0 => Point::new(x, y),
        1 => Point::new(-y, x),
        2 => Point::new(-x, -y),
        _ => Point::new(y, -x),
    }
}

/// The outline of cells of a grid, each corner moved by at most one unit.
fn cells(bytes: &mut Bytes) -> Vec<Ring> {
    let (width, height) = (1 + bytes.below(8), 1 + bytes.below(8));
    let rows: Vec<u8> = (0..height).map(|_| bytes.byte()).collect();
    let full = |x: usize, y: usize| {
        // Indices run from 1, so that a border of empty cells surrounds the grid.
        (1..=width).contains(&x) && (1..=height).contains(&y) && rows[y - 1] >> (x - 1) & 1 == 1
    };
    let spacing = [4.0, 10.0, 1000.0, 1e6][bytes.below(4)];
    let uneven = bytes.below(3) as f64;
    let place = |k: usize| k as f64 * spacing + uneven * ((k * k) as f64 % 5.0);
    // Edges around full cells, the cell to their left.
    let mut next: Vec<((usize, usize), (usize, usize))> = Vec::new();
    for x in 0..=width + 1 {
        for y in 0..=height + 1 {
            if full(x, y) {
                let around = [
                    (y > 0 && !full(x, y - 1), (x, y), (x + 1, y)),
                    (!full(x + 1, y), (x + 1, y), (x + 1, y + 1)),
                    (!full(x, y + 1), (x + 1, y + 1), (x, y + 1)),
                    (x > 0 && !full(x - 1, y), (x, y + 1), (x, y)),
                ];
                next.extend(around.iter().filter(|e| e.0).map(|e| (e.1, e.2)));
            }
        }
    }
    let (nudges, seldom) = (bytes.below(4), bytes.below(5));
    let mut rings: Vec<Ring> = Vec::new();
    while let Some((start, mut at)) = next.pop() {
        let mut corners = vec![start];
        while at != start {
            corners.push(at);
            // Where two cells meet at a corner either way is right.
            let Some(k) = next.iter().position(|e| e.0 == at) else { break };
            at = next.swap_remove(k).1;
        }
        let ring = corners.iter().map(|&(x, y)| {
            let p = Point::new(place(x), place(y));
            if nudges == 0 || bytes.below(5) < seldom {
                return p;
            }
            let by = bytes.byte();
            p + Point::new(f64::from(by % 3) - 1.0, f64::from(by / 3 % 3) - 1.0)
        });
        rings.push(ring.collect());
    }
    rings
}

/// Corners on or next to one circle, from inside, from outside, or both.
fn round(bytes: &mut Bytes) -> Vec<Ring> {
    let radius = [25.0, 65.0, 1105.0][bytes.below(3)];
    let choice = bytes.below(4);
    let all = lattice_circle(radius);
    let mut kept = Vec::new();
    while kept.len() < 3 {
        let seldom = 1 + bytes.below(9) as u8;
        kept =
            all.iter().filter(|_| bytes.byte().is_multiple_of(seldom)).copied().collect::<Ring>();
        if bytes.is_empty() {
            kept = all.clone();
        }
    }
    // Leave the circle by a little at some corners.
    let off = 2f64.powi(-(bytes.below(40) as i32));
    for p in &mut kept {
        if bytes.byte() & 7 == 7 {
            *p = *p + Point::new(bytes.signed(), bytes.signed()) * off;
        }
    }
    let out = 2.0 + bytes.below(3) as f64;
    let spread = |ring: &Ring| -> Ring {
        // A far point between each two neighbours.
        let ends = ring.iter().zip(ring.iter().cycle().skip(1));
        ends.flat_map(|(&a, &b)| [a, (a + b) * (0.5 * out)]).collect()
    };
    let side = radius * 2.0;
    let frame = [(-side, -side), (side, -side), (side, side), (-side, side)];
    let frame: Ring = frame.iter().map(|&(x, y)| Point::new(x, y)).collect();
    match choice {
        0 => vec![kept],
        1 => vec![spread(&kept)],
        2 => vec![frame, kept],
        _ => {
            let inner = kept.iter().map(|&p| p * 0.5).collect();
            vec![kept, inner]
        }
    }
}

/// Points with whole coordinates on a circle, counterclockwise.
fn lattice_circle(radius: f64) -> Ring {
    let quarter: Ring = (0..radius as u32)
        .map(|y| Point::new((radius * radius - f64::from(y * y)).sqrt(), f64::from(y)))
        .filter(|p| p.x.fract() == 0.0)
        .collect();
    let turned = |turns: usize| {
        quarter.iter().map(move |&p| match turns {
            0 => p,
            1 => Point::new(-p.y, p.x),
            2 => Point::new(-p.x, -p.y),
            _ => Point::new(p.y, -p.x),
        })
    };
    (0..4).flat_map(turned).collect()
}

/// Two chains close together.
fn sliver(bytes: &mut Bytes) -> Vec<Ring> {
    let thin = 2f64.powi(-(bytes.below(46) as i32));
    let (width, lean) = (1.0 + bytes.short(), bytes.below(3) as f64 / 3.0);
    let (n, m) = (bytes.below(12), 1 + bytes.below(12));
    let mut chain = |sign: f64, n: usize| -> Ring {
        let mut x = 0.0;
        let mut points = Vec::new();
        for _ in 0..n {
            x += 0.001 + bytes.unit();
            points.push(Point::new(x, sign * thin * (1.0 + f64::from(bytes.byte()))));
        }
        let scale = width / (x + 0.5);
        points.iter_mut().for_each(|p| p.x *= scale);
        points
    };
    let (lower, upper) = (chain(-1.0, n), chain(1.0, m));
    let mut ring = vec![Point::new(0.0, 0.0)];
    ring.extend(lower);
    ring.push(Point::new(width, 0.0));
    ring.extend(upper.into_iter().rev());
    ring.iter_mut().for_each(|p| p.y += lean * p.x);
    vec![ring]
}

/// A long triangle or a box with small holes far apart in size.
fn wedge(bytes: &mut Bytes) -> Vec<Ring> {
    let half = [1.0, 23.0, 40.0, 0.01][bytes.below(4)];
    let corners = match bytes.below(3) {
        0 => vec![(0.0, 0.0), (40.0, -half), (40.0, half)],
        1 => vec![(0.0, -half), (40.0, -half), (40.0, half), (0.0, half)],
        _ => vec![(0.0, 0.0), (40.0, -half), (30.0, 0.0), (40.0, half)],
    };
    let mut rings: Vec<Ring> = vec![corners.iter().map(|&(x, y)| Point::new(x, y)).collect()];
    for _ in 0..1 + bytes.below(12) {
        let how = bytes.byte();
        let x = 40.0 * if how & 1 == 0 { bytes.unit() } else { bytes.unit() * bytes.unit() };
        let y = if how & 2 == 0 { 0.0 } else { half * bytes.signed() * x / 40.0 };
        let span = x * 2f64.powi(-2 - i32::from(how >> 4));
        let ring = if how & 4 == 0 {
            vec![(span, 0.5 * span), (span, -0.5 * span), (0.0, 0.0)]
        } else {
            vec![(bytes.signed() * span, 0.0), (0.0, span * bytes.signed()), (-span, -span)]
        };
        rings.push(ring.iter().map(|&(u, v)| Point::new(x + u, y + v)).collect());
    }
    rings
}

/// Any doubles of the unit square, in an order that is made simple.
fn scatter(bytes: &mut Bytes) -> Vec<Ring> {
    let n = 3 + bytes.below(30);
    let mut outer: Ring = (0..n).map(|_| Point::new(bytes.unit(), bytes.unit())).collect();
    untangle(&mut outer);
    let mut rings = vec![outer];
    for _ in 0..bytes.below(6) {
        let corner = Point::new(bytes.unit(), bytes.unit());
        let span = 0.3 * bytes.unit();
        let n = 3 + bytes.below(4);
        let mut hole: Ring =
            (0..n).map(|_| corner + Point::new(bytes.unit(), bytes.unit()) * span).collect();
        untangle(&mut hole);
        rings.push(hole);
    }
    rings
}

/// A fractal coast: a triangle whose edges get bays and headlands.
fn coast(bytes: &mut Bytes) -> Vec<Ring> {
    let mut ring: Ring = (0..3).map(|k| on_circle(f64::from(k) / 3.0) * 1000.0).collect();
    let whole = bytes.below(2) == 0;
    let height = 0.1 + 0.25 * bytes.unit();
    for _ in 0..1 + bytes.below(3) {
        let ends = ring.iter().zip(ring.iter().cycle().skip(1));
        let finer = ends.flat_map(|(&a, &b)| {
            let by = bytes.byte();
            let d = b - a;
            let (t, s) = (0.3 + f64::from(by & 15) / 200.0, 0.6 + f64::from(by >> 4) / 200.0);
            let tip =
                a + d * (0.5 * (t + s)) - d.perp() * (height * if by & 1 == 0 { 1. } else { -1. });
            [a, a + d * t, tip, a + d * s]
        });
        ring = finer.collect();
    }
    if whole {
        ring.iter_mut().for_each(|p| *p = Point::new(p.x.round(), p.y.round()));
    }
    vec![ring]
}

/// Teeth of various widths, lengths and distances.
fn comb(bytes: &mut Bytes) -> Vec<Ring> {
    let mut top = Vec::new();
    let mut x = 0.0;
    let lean = bytes.below(3) as f64;
    for _ in 0..1 + bytes.below(16) {
        let (width, gap, length) = (bytes.byte(), bytes.byte(), bytes.byte());
        let y = f64::from(1 + length % 32);
        top.push(Point::new(x, y));
        x += f64::from(1 + width % 8);
        top.push(Point::new(x, y + lean * f64::from(length >> 5)));
        let y = 1.0 - f64::from(gap >> 3) / 64.0;
        top.push(Point::new(x, y));
        x += f64::from(1 + gap % 8);
        top.push(Point::new(x, y));
    }
    top.truncate(top.len() - 2);
    let right = top.last().map_or(1.0, |p| p.x);
    top.reverse();
    let mut ring = vec![Point::new(0.0, 0.0), Point::new(right, 0.0)];
    ring.extend(top);
    vec![ring]
}

/// Two polygons that share a corner, or are far apart.
fn pair(bytes: &mut Bytes) -> Draft {
    let mut rings = grid(bytes);
    let mut beside = grid(bytes).swap_remove(0);
    let outer = &rings[0];
    let (k, j) = (bytes.below(outer.len()), bytes.below(beside.len()));
    let mut shift = outer[k] - beside[j];
    if bytes.below(4) == 0 {
        shift = Point::new(100.0, bytes.below(20) as f64);
    }
    if bytes.below(2) == 0 {
        beside.iter_mut().for_each(|p| *p = *p * -1.0);
        shift = outer[k] - beside[j];
    }
    beside.iter_mut().for_each(|p| *p = *p + shift);
    rings.truncate(1 + bytes.below(4));
    Draft { rings, regroup: false, beside: Some(beside) }
}

/// Shapes of the test suite.
const FIXTURES: [&str; 14] = [
    include_str!("../../fixtures/shapes/comb_with_three_unit_teeth.wkt"),
    include_str!("../../fixtures/shapes/corridor_tilted_by_45_ulp.wkt"),
    include_str!("../../fixtures/shapes/hole_touching_an_edge.wkt"),
    include_str!("../../fixtures/shapes/hole_touching_the_outer_ring_at_a_corner.wkt"),
    include_str!("../../fixtures/shapes/lattice_of_four_square_holes.wkt"),
    include_str!("../../fixtures/shapes/six_corners_at_ten_million.wkt"),
    include_str!("../../fixtures/shapes/small_holes_hidden_in_a_wedge.wkt"),
    include_str!("../../fixtures/shapes/square_ring_6_around_2.wkt"),
    include_str!("../../fixtures/shapes/star_with_12_corners_on_one_circle.wkt"),
    include_str!("../../fixtures/shapes/straight_joint_between_two_holes.wkt"),
    include_str!("../../fixtures/shapes/twelve_sides_around_one_circle.wkt"),
    include_str!("../../fixtures/shapes/two_keypoints_with_three_governors_in_opposite_order.wkt"),
    include_str!("../../fixtures/shapes/two_reflex_corners_facing_at_a_neck.wkt"),
    include_str!("../../fixtures/shapes/two_touching_holes.wkt"),
];

/// A shape of the test suite with some corners moved, dropped or added.
fn fixture(bytes: &mut Bytes) -> Draft {
    let mut rings = parse(FIXTURES[bytes.below(FIXTURES.len())]);
    for _ in 0..bytes.below(8) {
        let which = bytes.below(rings.len());
        let ring = &mut rings[which];
        let k = bytes.below(ring.len());
        let how = bytes.byte();
        let d = ring[(k + 1) % ring.len()] - ring[k];
        match how % 6 {
            0 => ring[k] = nudge(ring[k], bytes.byte()),
            1 => {
                let by = 2f64.powi(-(bytes.below(50) as i32));
                ring[k] = ring[k] + Point::new(bytes.signed(), bytes.signed()) * (by * d.norm());
            }
            2 if ring.len() > 3 => drop(ring.remove(k)),
            3 => ring.insert(k + 1, ring[k] + d * bytes.unit()),
            4 => {
                let by = 2f64.powi(-(bytes.below(50) as i32)) * bytes.signed();
                ring.insert(k + 1, ring[k] + d * bytes.unit() + d.perp() * by);
            }
            _ => {
                // A small ring on the way to the middle.
                let span = d.norm() * 2f64.powi(-2 - (bytes.below(24) as i32));
                let at = ring[k] + d * bytes.unit() + d.perp() * bytes.signed();
                let corners = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.3, -0.7)];
                rings.push(corners.map(|(u, v)| at + Point::new(u, v) * span).to_vec());
            }
        }
    }
    rings.into()
}

/// Reads the rings of a POLYGON.
fn parse(text: &str) -> Vec<Ring> {
    let rings = text.split(['(', ')']).filter(|part| part.contains(|c: char| c.is_ascii_digit()));
    let point = |pair: &str| {
        let mut numbers = pair.split_whitespace().filter_map(|number| number.parse().ok());
        Some(Point::new(numbers.next()?, numbers.next()?))
    };
    rings
        .map(|ring| {
            let mut points: Ring = ring.split(',').filter_map(point).collect();
            points.pop();
            points
        })
        .collect()
}
