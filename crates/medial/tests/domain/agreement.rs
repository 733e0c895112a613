//! Thousands of tiny polygons against the definitions, and against each other in other positions.

use medial::domain::{Corner, Domain, DomainError, Options, Repair};
use medial::geom::{Point, orient2d};

use crate::brute::{overlap, verdict};
use crate::shapes::Rings;

pub struct Random(pub u64);

impl Random {
    pub fn below(&mut self, n: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 16) as usize % n
    }
}

fn build(rings: &Rings) -> Result<Domain, DomainError> {
    Domain::from_polygons(std::slice::from_ref(rings), &Options::default())
}

fn random_ring(random: &mut Random, size: usize, len: usize) -> Vec<Point> {
    let mut point = || Point::new(random.below(size) as f64, random.below(size) as f64);
    (0..len).map(|_| point()).collect()
}

/// A ring that goes from a random corner to the next by steps of the grid.
pub fn random_walk(random: &mut Random, size: i64, len: usize) -> Vec<Point> {
    let mut at = (random.below(size as usize) as i64, random.below(size as usize) as i64);
    let start = at;
    let mut ring = Vec::new();
    for _ in 0..len {
        ring.push(Point::new(at.0 as f64, at.1 as f64));
        let (dx, dy) = [(1, 0), (0, 1), (-1, 0), (0, -1)][random.below(4)];
        at = ((at.0 + dx).clamp(0, size), (at.1 + dy).clamp(0, size));
    }
    while at != start {
        ring.push(Point::new(at.0 as f64, at.1 as f64));
        if at.0 != start.0 {
            at.0 += (start.0 - at.0).signum();
        } else {
            at.1 += (start.1 - at.1).signum();
        }
    }
    ring
}

/// Checks one polygon against the definitions; says whether it was accepted, and with bridges.
fn agrees(rings: &Rings) -> (bool, bool) {
    let expected = verdict(rings);
    let result = build(rings);
    match &result {
        Ok(domain) => {
            assert!(expected.accepted(), "accepted {rings:?}: {expected:?}");
            assert_eq!(domain.edges().len(), expected.pieces, "{rings:?}");
            assert_eq!(domain.area() * 2.0, expected.twice_area as f64, "{rings:?}");
            names_are_true(domain, rings);
        }
        Err(error) => {
            assert!(!expected.accepted(), "refused {rings:?}: {error}");
            let code = error.code();
            let right = if expected.degenerate {
                code == "collinear" || code == "too_few_points"
            } else if expected.crossing || expected.overlap {
                expected.crossing && code == "crossing" || expected.overlap && code == "overlap"
            } else if expected.wrong_side {
                code == "crossing" || code == "bad_nesting"
            } else {
                code == "empty"
            };
            assert!(right, "{rings:?}: {error}, but {expected:?}");
        }
    }
    if let (Ok(domain), true) = (&result, rings[0][0].x < 1e6) {
        turns_once(domain);
    }
    (result.is_ok(), result.is_ok() && expected.bridges > 0)
}

/// Names of edges and corners are unique, and lead to their place in the input.
fn names_are_true(domain: &Domain, rings: &Rings) {
    let (mut edges, mut corners) = (Vec::new(), Vec::new());
    for k in 0..domain.edges().len() as u32 {
        let (start, end) = (domain.edge(k).start, domain.end(k));
        let origin = domain.origin(k);
        let given = rings[origin.ring as usize][origin.index as usize];
        assert_eq!(orient2d(start, end, given), 0.0);
        let cut = domain.report().entries().iter().any(|e| {
            e.repair == Repair::SplitEdge
                && e.ring == origin.ring
                && e.indices.contains(&origin.index)
        });
        assert!(cut || origin.part == 0 && (given == start || given == end), "{rings:?}");
        edges.push((origin.ring, origin.index, origin.part));

        let corner = origin.corner;
        let before = domain.origin(domain.edge(k).prev);
        assert_eq!(corner.ring, before.ring);
        if corner.part == 0 {
            assert_eq!(rings[corner.ring as usize][corner.index as usize], start, "{rings:?}");
        } else {
            assert_eq!(corner.index, before.index);
            // Along the input direction the touch follows the piece of its number less one.
            assert!(corner.part == before.part || corner.part == before.part + 1);
        }
        corners.push((corner.ring, corner.index, corner.part));
    }
    for mut names in [edges, corners] {
        let n = names.len();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), n, "{rings:?}");
    }
}

/// An outer walk turns left by one full turn in all, one around a hole turns right.
pub fn turns_once(domain: &Domain) {
    for walk in domain.walks() {
        let range = walk.first..walk.first + walk.len;
        let turn: f64 = range
            .map(|k| {
                let edge = domain.edge(k);
                let (u, v) = (domain.edge(edge.prev).direction, edge.direction);
                let angle = u.cross(v).atan2(u.dot(v));
                assert_eq!(angle > 1e-9, edge.corner == Corner::Convex);
                assert_eq!(angle < -1e-9, edge.corner == Corner::Reflex);
                angle
            })
            .sum();
        let turns = turn / std::f64::consts::TAU;
        assert!((turns - if walk.hole { -1.0 } else { 1.0 }).abs() < 1e-9);
    }
}

#[test]
fn random_rings_with_holes_agree_with_the_definitions() {
    let mut random = Random(1);
    let mut accepted = 0;
    for _ in 0..60_000 {
        let size = 3 + random.below(4);
        let len = 3 + random.below(6);
        let mut rings = vec![random_ring(&mut random, size, len)];
        for _ in 0..random.below(3) {
            let len = 3 + random.below(3);
            rings.push(random_ring(&mut random, size, len));
        }
        accepted += usize::from(agrees(&rings).0);
    }
    assert!(accepted > 5_000, "{accepted}");
}

#[test]
fn random_holes_in_a_square_agree_with_the_definitions() {
    let mut random = Random(2);
    let mut accepted = 0;
    for _ in 0..60_000 {
        let size = 4 + random.below(3);
        let side = (size - 1) as f64;
        let corners = [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)];
        let mut rings = vec![corners.map(|(x, y)| Point::new(x, y)).to_vec()];
        for _ in 0..1 + random.below(3) {
            let len = 3 + random.below(3);
            rings.push(random_ring(&mut random, size, len));
        }
        accepted += usize::from(agrees(&rings).0);
    }
    assert!(accepted > 5_000, "{accepted}");
}

#[test]
fn random_walks_on_the_grid_agree_with_the_definitions() {
    let mut random = Random(3);
    let (mut accepted, mut bridged) = (0, 0);
    for _ in 0..100_000 {
        let size = 2 + random.below(3) as i64;
        let len = 3 + random.below(12);
        let mut rings = vec![random_walk(&mut random, size, len)];
        if random.below(2) == 0 {
            let len = 4 + random.below(4);
            rings.push(random_walk(&mut random, size, len));
        }
        let (ok, with_bridges) = agrees(&rings);
        accepted += usize::from(ok);
        bridged += usize::from(with_bridges);
    }
    assert!(accepted > 5_000 && bridged > 200, "{accepted} {bridged}");
}

#[test]
fn one_unit_in_two_to_the_forty_decides() {
    // Shapes full of touches, with some corners moved by the last bit.
    let mut random = Random(8);
    let (mut accepted, mut refused) = (0, 0);
    for _ in 0..60_000 {
        let len = 4 + random.below(10);
        let mut rings = vec![random_walk(&mut random, 3, len)];
        rings.extend((0..random.below(3)).map(|_| random_ring(&mut random, 4, 3)));
        if build(&rings).is_err() {
            continue;
        }
        let unit = 2f64.powi(40) + 3.0;
        for p in rings.iter_mut().flatten() {
            let mut moved = |v: f64| {
                let by = if random.below(4) == 0 { random.below(3) as f64 - 1.0 } else { 0.0 };
                v * unit + 2f64.powi(43) + by
            };
            *p = Point::new(moved(p.x), moved(p.y));
        }
        if agrees(&rings).0 {
            accepted += 1;
        } else {
            refused += 1;
        }
    }
    assert!(accepted > 2_000 && refused > 500, "{accepted} {refused}");
}

#[test]
fn pairs_of_polygons_agree_with_the_definitions() {
    let mut random = Random(6);
    let (mut disjoint, mut overlapping) = (0, 0);
    while disjoint < 4_000 {
        let polygons: [Rings; 2] = [(); 2].map(|()| {
            let len = 4 + random.below(6);
            if random.below(2) == 0 {
                vec![random_walk(&mut random, 4, len)]
            } else {
                let mut rings = vec![random_ring(&mut random, 5, 3 + len % 3)];
                rings.extend((0..random.below(2)).map(|_| random_ring(&mut random, 5, 3)));
                rings
            }
        });
        if polygons.iter().any(|p| build(p).is_err()) {
            continue;
        }
        match Domain::from_polygons(&polygons, &Options::default()) {
            Ok(domain) => {
                assert!(!overlap(&polygons[0], &polygons[1]), "{polygons:?}");
                let alone = polygons.each_ref().map(|p| build(p).map_or(0.0, |d| d.area()));
                assert_eq!(domain.area(), alone[0] + alone[1]);
                disjoint += 1;
            }
            Err(error) => {
                assert!(overlap(&polygons[0], &polygons[1]), "{polygons:?}: {error}");
                assert_eq!(error.code(), "polygons_overlap");
                overlapping += 1;
            }
        }
    }
    assert!(overlapping > 1_000, "{overlapping}");
}

/// Walks as closed lists of points, from the smallest one on, in order.
fn cycles(domain: &Domain, place: impl Fn(Point) -> Point) -> Vec<Vec<(f64, f64)>> {
    let cycle = |w: &medial::domain::Walk| {
        let edges = &domain.edges()[w.first as usize..(w.first + w.len) as usize];
        let points: Vec<(f64, f64)> =
            edges.iter().map(|e| place(e.start)).map(|p| (p.x + 0.0, p.y + 0.0)).collect();
        let turned = |k: usize| [&points[k..], &points[..k]].concat();
        let all = (0..points.len()).map(turned);
        all.min_by(|a, b| a.partial_cmp(b).expect("finite")).unwrap_or_default()
    };
    let mut all: Vec<_> = domain.walks().iter().map(cycle).collect();
    all.sort_by(|a, b| a.partial_cmp(b).expect("finite"));
    all
}

#[test]
fn the_walks_do_not_depend_on_position_or_order() {
    let mut random = Random(4);
    let mut accepted = 0;
    for _ in 0..20_000 {
        let mut rings = vec![random_walk(&mut random, 4, 14)];
        for _ in 0..random.below(3) {
            let len = 3 + random.below(2);
            rings.push(random_ring(&mut random, 5, len));
        }
        let result = build(&rings);
        // A quarter turn, a scale and a shift, all exact; another start, direction and order.
        let turn = |p: Point| Point::new(-p.y * 0.25 + 1024.0, p.x * 0.25 - 3.0);
        let back = |p: Point| Point::new((p.y + 3.0) * 4.0, (1024.0 - p.x) * 4.0);
        let mut moved: Rings = rings.iter().map(|r| r.iter().map(|&p| turn(p)).collect()).collect();
        for ring in &mut moved {
            let by = random.below(ring.len());
            ring.rotate_left(by);
            if random.below(2) == 0 {
                ring.reverse();
            }
        }
        moved[1..].reverse();
        let other = build(&moved);
        match (&result, &other) {
            (Ok(one), Ok(two)) => {
                accepted += 1;
                assert_eq!(cycles(one, |p| p), cycles(two, back), "{rings:?}");
                assert_eq!(one.n_components(), two.n_components());
            }
            (Err(_), Err(_)) => {}
            _ => panic!("{rings:?}: {result:?} {other:?}"),
        }
    }
    assert!(accepted > 1_000, "{accepted}");
}
