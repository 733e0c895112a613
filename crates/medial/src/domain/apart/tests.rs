//! The proof against all pairs of edges, and against the sweep.

use std::f64::consts::TAU;

use super::join::{Doubt, join};
use super::strip::strips;
use super::tree::Tree;
use super::{Around, apart};
use crate::domain::outlines::Draft;
use crate::domain::rings::Rings;
use crate::domain::sweep::{Purpose, sweep};
use crate::domain::{Domain, Options, Report};
use crate::geom::Point;

struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 16) as usize % n
    }

    fn point(&mut self, size: usize) -> Point {
        Point::new(self.below(size) as f64, self.below(size) as f64)
    }
}

/// Whether any two edges share a point, but consecutive ones their corner; by integers.
fn touches(rings: &Rings) -> bool {
    let n = rings.points.len() as u32;
    let whole = |p: Point| (p.x as i128, p.y as i128);
    let edge = |k: u32| (whole(rings.point(k)), whole(rings.point(rings.next(k))));
    let side = |(a, b): ((i128, i128), (i128, i128)), c: (i128, i128)| {
        ((b.0 - a.0) * (c.1 - a.1) - (b.1 - a.1) * (c.0 - a.0)).signum()
    };
    let apart = |a: i128, b: i128, c: i128, d: i128| a.max(b) < c.min(d) || c.max(d) < a.min(b);
    (0..n).any(|j| {
        (0..j).filter(|&k| rings.next(j) != k && rings.next(k) != j).any(|k| {
            let (e, f) = (edge(j), edge(k));
            side(e, f.0) * side(e, f.1) <= 0
                && side(f, e.0) * side(f, e.1) <= 0
                && !apart(e.0.0, e.1.0, f.0.0, f.1.0)
                && !apart(e.0.1, e.1.1, f.0.1, f.1.1)
        })
    })
}

/// All that a domain shows of itself.
fn shown(domain: &Domain) -> String {
    let origins: Vec<_> = (0..domain.edges().len() as u32).map(|k| domain.origin(k)).collect();
    format!("{:?} {:?} {:?} {:?}", domain.edges(), domain.walks(), origins, domain.report())
}

/// Checks one feature; says whether the rings were shown to be apart, and well nested.
fn agrees(polygons: &[Vec<Vec<Point>>], regroup: bool) -> (bool, bool) {
    let options = Options { regroup, ..Options::default() };
    let clean = || {
        let mut report = Report::default();
        Rings::clean(polygons, &options, &mut report).map(|rings| (rings, report))
    };
    let Ok((mut rings, report)) = clean() else { return (false, false) };
    rings.number();
    let touches = touches(&rings);
    let tree = Tree::new(&rings);
    let expected = if touches { Err(Doubt::Touch) } else { Ok(()) };
    assert_eq!(join(&tree, &[]).map(|_| ()), expected, "{polygons:?}");
    assert_eq!(join(&tree, &strips(&tree)).map(|_| ()), expected, "{polygons:?}");
    let Some(nesting) = apart(&rings) else {
        assert!(touches, "{polygons:?}");
        return (false, false);
    };
    let purpose = if regroup { Purpose::Nest } else { Purpose::Validate };
    rings.number();
    let found = sweep(&rings, purpose);
    let good = regroup || nesting.sides_agree(&rings);
    assert_eq!(found.is_ok(), good, "{polygons:?}");
    let Ok(found) = found else { return (true, false) };
    assert_eq!(found.parents, nesting.parents(), "{polygons:?}");
    assert!(found.cuts.is_empty() && found.links.is_empty() && found.removed.is_empty());
    if !regroup && let Ok((again, same)) = clean() {
        let draft = || Draft::with_room(0, 0);
        let fast = Domain::of_rings(draft(), &rings, &nesting, None, report).expect("apart");
        let slow = Domain::of_touching_rings(draft(), again, polygons.len(), &options, same);
        assert_eq!(shown(&fast), shown(&slow.expect("valid")), "{polygons:?}");
    }
    (true, true)
}

#[test]
fn tiny_rings_on_a_grid_are_apart_if_no_pair_of_edges_meets() {
    let mut random = Random(11);
    let (mut proved, mut good) = (0, 0);
    for round in 0..60_000 {
        let size = 3 + random.below(12);
        let polygons: Vec<Vec<Vec<Point>>> = (0..1 + random.below(3))
            .map(|_| {
                (0..1 + random.below(3))
                    .map(|_| (0..3 + random.below(4)).map(|_| random.point(size)).collect())
                    .collect()
            })
            .collect();
        let (apart, nested) = agrees(&polygons, round % 2 == 0);
        proved += usize::from(apart);
        good += usize::from(nested);
    }
    assert!(proved > 4_000 && good > 3_000, "{proved} {good}");
}

#[test]
fn many_rings_have_the_same_parents_as_in_the_sweep() {
    // Boxes and diamonds of all sizes on a grid: often one in another, sometimes touching.
    let mut random = Random(12);
    let (mut proved, mut good, mut deep) = (0, 0, 0);
    for round in 0..6_000 {
        let rings = (0..2 + random.below(24)).map(|_| {
            let r = ((1 << random.below(10)) + random.below(4)) as f64;
            let middle = random.point(1500);
            let square = [(-r, -r), (r, -r), (r, r), (-r, r)];
            let diamond = [(0.0, -r), (r, 0.0), (0.0, r), (-r, 0.0)];
            let shape = if random.below(2) == 0 { square } else { diamond };
            shape.map(|(x, y)| middle + Point::new(x, y)).to_vec()
        });
        let rings: Vec<Vec<Point>> = rings.collect();
        let one_each = rings.iter().map(|ring| vec![ring.clone()]).collect();
        let polygons = if round % 3 == 0 { one_each } else { vec![rings] };
        let (apart, nested) = agrees(&polygons, round % 3 == 1);
        proved += usize::from(apart);
        good += usize::from(nested && round % 3 != 1);
        deep += usize::from(apart && polygons[0].len() > 5);
    }
    assert!(proved > 1_000 && good > 100 && deep > 100, "{proved} {good} {deep}");
}

/// A star of needles, with whole coordinates.
fn star(random: &mut Random, corners: usize) -> Vec<Point> {
    let corner = |k: usize| {
        let (sin, cos) = (TAU * k as f64 / corners as f64).sin_cos();
        let radius = 3e5 + random.below(700_000) as f64;
        Point::new((radius * cos).round(), (radius * sin).round())
    };
    (0..corners).map(corner).collect()
}

#[test]
fn one_corner_of_a_star_put_on_another_edge_is_found() {
    let mut random = Random(13);
    let (mut proved, mut refused) = (0, 0);
    for round in 0..600 {
        let corners = 5 + random.below(300);
        let mut ring = star(&mut random, corners);
        // Twice as large, so that the middles of edges are whole.
        ring.iter_mut().for_each(|p| *p = *p * 2.0);
        if round % 2 == 1 {
            let (moved, edge) = (random.below(corners), random.below(corners));
            let (a, b) = (ring[edge], ring[(edge + 1) % corners]);
            ring[moved] = (a + b) * 0.5;
        }
        if round % 4 < 2 {
            ring.reverse();
        }
        let (apart, _) = agrees(&[vec![ring]], false);
        proved += usize::from(apart);
        refused += usize::from(!apart);
    }
    assert!(proved > 250 && refused > 200, "{proved} {refused}");
}

#[test]
fn rings_that_wind_are_apart_unless_moved_by_one_unit() {
    // A staircase up and back down at one unit below: apart; at no unit below: on one another.
    for steps in [1, 3, 8, 20, 100] {
        for gap in [0.0, 1.0] {
            let up = (0..steps).flat_map(|k| {
                let k = f64::from(k) * 4.0;
                [Point::new(k, k), Point::new(k + 4.0, k)]
            });
            let mut ring: Vec<Point> = up.collect();
            let n = ring.len();
            let back: Vec<Point> =
                ring[1..n - 1].iter().rev().map(|&p| p + Point::new(gap, -gap)).collect();
            ring.push(Point::new(f64::from(steps) * 4.0, f64::from(steps) * 4.0));
            ring.push(Point::new(f64::from(steps) * 4.0 + 9.0, 0.0));
            ring.extend(back);
            ring.push(Point::new(0.0, -9.0));
            let (apart, _) = agrees(&[vec![ring]], false);
            assert_eq!(apart, gap > 0.0 || steps == 1, "{steps} steps");
        }
    }
}

#[test]
fn a_ring_lies_above_the_nearest_of_two_edges_from_one_corner() {
    // The corner (0, 0) of the outer ring is a notch right below the hole's leftmost corner.
    let p = Point::new;
    let outer = vec![p(-9.0, -9.0), p(0.0, 0.0), p(9.0, -9.0), p(9.0, 9.0), p(-9.0, 9.0)];
    let hole = vec![p(0.0, 1.0), p(1.0, 2.0), p(2.0, 1.0)];
    let polygons = [vec![outer, hole]];
    let mut report = Report::default();
    let rings = Rings::clean(&polygons, &Options::default(), &mut report).expect("two rings");
    let nesting = apart(&rings).expect("apart");
    assert_eq!(nesting.around, [Around::Nothing, Around::Inside(0)]);
    assert_eq!(agrees(&polygons, false), (true, true));
}

#[test]
fn a_lattice_of_holes_is_apart_until_one_of_them_grows() {
    let diamond = |x: f64, y: f64, r: f64| {
        [(r, 0.0), (0.0, -r), (-r, 0.0), (0.0, r)].map(|(a, b)| Point::new(x + a, y + b)).to_vec()
    };
    let side = 30;
    let end = f64::from(10 * side);
    let square = [(0.0, 0.0), (end, 0.0), (end, end), (0.0, end)];
    // With radius 6, a diamond reaches its neighbours of radius 4 ten units away.
    for (radius, apart) in [(4.0, true), (5.0, true), (6.0, false)] {
        let mut rings = vec![square.map(|(x, y)| Point::new(x, y)).to_vec()];
        for k in 0..side * side {
            let (x, y) = (10 * (k % side) + 5, 10 * (k / side) + 5);
            let r = if k == 433 { radius } else { 4.0 };
            rings.push(diamond(f64::from(x), f64::from(y), r));
        }
        assert_eq!(agrees(&[rings.clone()], false), (apart, apart));
        // Each as a polygon of its own, in the face of a ring around all of them.
        let polygons: Vec<_> = rings.into_iter().skip(1).map(|ring| vec![ring]).collect();
        assert_eq!(agrees(&polygons, false), (apart, apart));
    }
}

#[test]
fn rings_too_small_for_single_precision_are_told_apart() {
    let large = 2f64.powi(60);
    let square = |x: f64, y: f64, r: f64| {
        [(-r, -r), (r, -r), (r, r), (-r, r)].map(|(a, b)| Point::new(x + a, y + b)).to_vec()
    };
    for shift in [0.0, 1.0] {
        let mut rings = vec![square(0.0, 0.0, large)];
        for k in 0..100 {
            let (x, y) = (f64::from(k % 10) * 8.0, f64::from(k / 10) * 8.0);
            // Three units on each side: two apart, or one.
            rings.push(square(x + f64::from(k % 2) * shift, y, 3.0));
        }
        assert_eq!(agrees(&[rings.clone()], false), (true, true));
        // Now one around another reaches the neighbours of that.
        rings[34] = square(16.0, 16.0, 5.0);
        assert!(!agrees(&[rings], false).0);
    }
}
