//! Whatever rings are given, repair makes a valid domain of what they enclose, or says why not.

mod support;

use medial::check;
use medial::domain::{Corner, Domain, FillRule, Options, Repair};
use medial::engine::path_tracing;
use medial::geom::Point;
use support::random::{self, Family, Ground, Random};
use support::shapes;

type Polygons = Vec<Vec<Vec<Point>>>;

const REPAIR: Options = Options {
    strict: false,
    regroup: false,
    repair: true,
    fill: FillRule::EvenOdd,
    dissolve: false,
    deadline: None,
};

fn ring(points: &[(f64, f64)]) -> Vec<Point> {
    points.iter().map(|&(x, y)| Point::new(x, y)).collect()
}

fn repaired(polygons: &Polygons) -> Domain {
    Domain::from_polygons(polygons, &REPAIR).unwrap()
}

fn count(domain: &Domain, repair: Repair) -> usize {
    domain.report().count(repair)
}

/// How often rings go around a point, and how often they pass above it.
fn winding<'a>(rings: impl Iterator<Item = &'a Vec<Point>>, p: Point) -> (i32, u32) {
    let (mut number, mut passes) = (0, 0);
    for ring in rings {
        for k in 0..ring.len() {
            let (a, b) = (ring[k], ring[(k + 1) % ring.len()]);
            if (a.x <= p.x) != (b.x <= p.x) {
                let side = (b - a).cross(p - a);
                // Below the edge.
                if (side < 0.0) == (a.x <= p.x) {
                    passes += 1;
                    number += if a.x <= p.x { -1 } else { 1 };
                }
            }
        }
    }
    (number, passes)
}

fn distance(p: Point, a: Point, b: Point) -> f64 {
    let way = b - a;
    let along =
        if way.norm2() > 0.0 { ((p - a).dot(way) / way.norm2()).clamp(0.0, 1.0) } else { 0.0 };
    (p - (a + way * along)).norm()
}

fn edges(polygons: &Polygons) -> impl Iterator<Item = (Point, Point)> + '_ {
    let of = |ring: &'_ Vec<Point>| {
        let n = ring.len();
        let ring = ring.clone();
        (0..n).map(move |k| (ring[k], ring[(k + 1) % n]))
    };
    polygons.iter().flatten().flat_map(of)
}

/// What is true of every repaired domain.
fn check_repair(random: &mut Random, polygons: &Polygons, options: &Options, domain: &Domain) {
    // Once more changes nothing.
    let outlines = domain.polygons();
    let again = Domain::from_polygons(&outlines, &Options::default()).unwrap();
    // Where only parts of one polygon touched an edge, nothing splits it any more.
    let corners = |d: &Domain| -> Vec<Point> {
        let turns = d.edges().iter().filter(|e| e.corner != Corner::Straight);
        turns.map(|e| e.start).collect()
    };
    let mut starts = [domain, &again].map(corners);
    for list in &mut starts {
        list.sort_by(|a, b| a.lexicographic(*b));
    }
    assert_eq!(starts[0], starts[1], "{polygons:?}");
    // The boundary is where edges were.
    let moved = domain.report().moved();
    let snapped = count(domain, Repair::Snapped) > 0;
    let size = edges(polygons).flat_map(|(a, b)| [a, b]).fold(0.0_f64, |s, p| s.max(p.norm()));
    let slack = 1e-15 * size;
    for edge in domain.edges() {
        let middle = (edge.start + domain.edge(edge.next).start) * 0.5;
        for p in [edge.start, middle] {
            let near =
                edges(polygons).map(|(a, b)| distance(p, a, b)).fold(f64::INFINITY, f64::min);
            assert!(near <= moved + slack, "{near} > {moved}: {polygons:?}");
        }
    }
    if !snapped {
        assert!(moved <= 64.0 * f64::EPSILON * size, "{moved}: {polygons:?}");
    }
    // What is inside is what the rule says.
    let (low, high) = edges(polygons).fold(
        (
            Point::new(f64::INFINITY, f64::INFINITY),
            Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY),
        ),
        |(low, high), (a, _)| {
            (
                Point::new(low.x.min(a.x), low.y.min(a.y)),
                Point::new(high.x.max(a.x), high.y.max(a.y)),
            )
        },
    );
    for _ in 0..20 {
        let p = Point::new(
            low.x + (high.x - low.x) * random.unit(),
            low.y + (high.y - low.y) * random.unit(),
        );
        let near = edges(polygons).map(|(a, b)| distance(p, a, b)).fold(f64::INFINITY, f64::min);
        if near <= 4.0 * moved + 1e-12 * size {
            continue;
        }
        let is_in = |rings: &Vec<Vec<Point>>| {
            let (number, passes) = winding(rings.iter(), p);
            match options.fill {
                FillRule::EvenOdd => passes % 2 == 1,
                FillRule::NonZero => number != 0,
            }
        };
        let expected = polygons.iter().filter(|rings| is_in(rings)).count();
        let found = outlines.iter().filter(|rings| winding(rings.iter(), p).1 % 2 == 1).count();
        assert_eq!(found > 0, expected > 0, "{p:?}: {polygons:?}");
    }
    let axis = path_tracing(domain).unwrap();
    let defects = check::defects(domain, &axis);
    assert!(defects.defects.is_empty(), "{:?}: {polygons:?}", defects.defects.first());
}

/// The kinds of faults.
#[derive(Clone, Copy, Debug)]
enum Kind {
    /// Corners anywhere.
    Tangled,
    /// Corners on a small grid: touches, overlaps, crossings at corners.
    Grid,
    /// Points, edges and rings given twice.
    Duplicated,
    /// Nearly all corners on a few lines.
    Collinear,
    /// Corners an ulp or a few from one another and from lines.
    Hairy,
    /// Several rings, nested in any way.
    Nested,
    /// Numbers that are none.
    Nan,
}

fn some_ring(random: &mut Random, kind: Kind) -> Vec<Point> {
    let n = 3 + random.below(if matches!(kind, Kind::Tangled) { 22 } else { 12 });
    let mut ring: Vec<Point> = Vec::new();
    let base = Point::new(1e3 + random.unit(), -7.0 + random.unit());
    for _ in 0..n {
        let p = match kind {
            Kind::Tangled => Point::new(random.unit(), random.unit()),
            Kind::Collinear => {
                let (t, line) = (random.unit() * 8.0, random.below(3) as f64);
                let t = if random.below(2) == 0 { t.round() } else { t };
                Point::new(t, 0.1 * line * t + line)
            }
            Kind::Hairy => {
                let ulp = |v: f64| v.next_up() - v;
                let (x, y) = (random.below(4) as f64, random.below(4) as f64);
                let far = if random.below(3) == 0 { 1e3 } else { 1.0 };
                Point::new(base.x + far * x * ulp(base.x), base.y + far * y * ulp(base.y))
            }
            _ => Point::new(random.below(6) as f64, random.below(6) as f64),
        };
        ring.push(p);
    }
    if matches!(kind, Kind::Duplicated) {
        for _ in 0..1 + random.below(3) {
            let at = random.below(ring.len() as u64) as usize;
            let p = ring[random.below(ring.len() as u64) as usize];
            ring.insert(at, p);
        }
    }
    if matches!(kind, Kind::Nan) && random.below(2) == 0 {
        let at = random.below(ring.len() as u64) as usize;
        let bad = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, 1e-300];
        ring[at].x = bad[random.below(5) as usize];
    }
    ring
}

fn some_polygons(random: &mut Random, kind: Kind) -> Polygons {
    let n_polygons = 1 + random.below(3) / 2;
    (0..n_polygons)
        .map(|_| {
            let n_rings = match kind {
                Kind::Nested => 1 + random.below(5),
                Kind::Duplicated => 1 + random.below(3),
                _ => 1 + random.below(4) / 3,
            };
            let mut rings: Vec<_> = (0..n_rings).map(|_| some_ring(random, kind)).collect();
            if matches!(kind, Kind::Duplicated) {
                let mut twice = rings[random.below(n_rings) as usize].clone();
                let start = random.below(twice.len() as u64) as usize;
                twice.rotate_left(start);
                if random.below(2) == 0 {
                    twice.reverse();
                }
                rings.push(twice);
            }
            rings
        })
        .collect()
}

fn random_polygons_of(kind: Kind, n: u64) {
    let seed = 0x7265_7061_6972_0000 + kind as u64;
    let mut random = Random(seed);
    let (mut done, mut refused) = (0, 0);
    for _ in 0..n {
        let polygons = some_polygons(&mut random, kind);
        let options = Options {
            fill: if random.below(3) == 0 { FillRule::NonZero } else { FillRule::EvenOdd },
            dissolve: random.below(2) == 0 || matches!(kind, Kind::Tangled),
            ..REPAIR
        };
        match Domain::from_polygons(&polygons, &options) {
            Ok(domain) => {
                let twice = matches!(kind, Kind::Duplicated);
                // A ring given twice counts once, which the numbers here do not know.
                if !twice {
                    check_repair(&mut random, &polygons, &options, &domain);
                }
                done += 1;
            }
            Err(error) => {
                let code = error.code();
                let expected = match kind {
                    Kind::Nan => "not_finite exponent_out_of_range",
                    _ => "",
                };
                let overlap = code == "polygons_overlap" && !options.dissolve;
                let nothing = ["empty", "too_few_points", "collinear"].contains(&code);
                assert!(
                    overlap || nothing || (expected.contains(code)),
                    "{error}: {options:?}: {polygons:?}"
                );
                refused += 1;
            }
        }
    }
    assert!(done > n / 4 && done + refused == n, "{kind:?}: {done} of {n}");
}

/// One test for each kind, for several threads.
macro_rules! random_polygons {
    ($($name:ident: $kind:ident),+ $(,)?) => {
        $(
            #[test]
            fn $name() {
                random_polygons_of(Kind::$kind, 10_000);
            }
        )+
    };
}

random_polygons! {
    ten_thousand_tangled: Tangled,
    ten_thousand_on_a_grid: Grid,
    ten_thousand_duplicated: Duplicated,
    ten_thousand_collinear: Collinear,
    ten_thousand_within_an_ulp: Hairy,
    ten_thousand_nested_in_any_way: Nested,
    ten_thousand_with_numbers_that_are_none: Nan,
}

#[test]
fn a_bow_tie_becomes_two_triangles_that_touch() {
    let bow = vec![vec![ring(&[(0.0, 0.0), (3.0, 1.0), (3.0, 0.0), (0.0, 1.0)])]];
    let error = Domain::from_polygons(&bow, &Options::default()).unwrap_err();
    assert_eq!(error.code(), "crossing");
    let domain = repaired(&bow);
    assert_eq!(domain.walks().len(), 2);
    assert_eq!(domain.area(), 1.5);
    let [entry] = domain.report().entries() else { panic!("{:?}", domain.report()) };
    assert_eq!((entry.repair, &entry.indices[..]), (Repair::Crossing, &[0, 2][..]));
    assert_eq!(entry.points, [Point::new(1.5, 0.5)]);
    assert!(domain.report().moved() < 1e-15);
    // Every edge is named by the one that it is a part of.
    for edge in 0..domain.edges().len() as u32 {
        let origin = domain.origin(edge);
        let (a, b) = (bow[0][0][origin.index as usize], bow[0][0][(origin.index as usize + 1) % 4]);
        let (start, end) = (domain.edge(edge).start, domain.end(edge));
        assert!(distance(start, a, b) + distance(end, a, b) < 1e-15);
        assert_eq!(origin.part > 0, start != a && end != a, "{origin:?}");
    }
}

#[test]
fn edges_that_lie_on_each_other_are_taken_together() {
    // Two squares drawn as one ring: their common side is run through both ways, a part of it only.
    let shape = [
        (0.0, 0.0),
        (2.0, 0.0),
        (2.0, 2.0),
        (0.0, 2.0),
        (0.0, 0.0),
        (2.0, 0.0),
        (2.0, 1.0),
        (4.0, 1.0),
        (4.0, -1.0),
        (2.0, -1.0),
        (2.0, 0.0),
    ];
    let domain = repaired(&vec![vec![ring(&shape)]]);
    assert_eq!(domain.area(), 8.0);
    assert!(count(&domain, Repair::Overlap) > 0 && count(&domain, Repair::Crossing) == 0);
    assert_eq!(domain.report().moved(), 0.0);
}

#[test]
fn a_ring_given_twice_counts_once() {
    let outer = ring(&[(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)]);
    let hole = ring(&[(2.0, 2.0), (4.0, 2.0), (4.0, 4.0), (2.0, 4.0)]);
    let twice = ring(&[(4.0, 4.0), (4.0, 2.0), (2.0, 2.0), (2.0, 4.0), (4.0, 4.0)]);
    let domain = repaired(&vec![vec![outer.clone(), hole.clone(), twice]]);
    assert_eq!(domain.area(), 77.0);
    let entry = &domain.report().entries()[0];
    assert_eq!((entry.repair, entry.ring), (Repair::DuplicateRing, 2));
    let domain = repaired(&vec![vec![outer.clone(), hole.clone()], vec![outer, hole]]);
    assert_eq!((domain.area(), count(&domain, Repair::DuplicateRing)), (77.0, 1));
    // Vertices on edges, spikes, and a least vertex that comes twice do not make another ring of it.
    let same = [
        ring(&[(3.0, 0.0), (0.0, 1.0), (0.0, 2.0), (0.0, 1.0), (0.0, 5.0), (3.0, 0.0)]),
        ring(&[(3.0, 0.0), (0.0, 5.0), (0.0, 1.0), (0.0, 2.0), (0.0, 1.0), (3.0, 0.0)]),
        ring(&[
            (1.5, 0.5),
            (3.0, 0.0),
            (0.0, 5.0),
            (0.0, 3.0),
            (0.0, 1.0),
            (-3.0, 2.0),
            (0.0, 1.0),
        ]),
    ];
    for (first, second) in [(0, 1), (0, 2), (1, 2)] {
        let domain = repaired(&vec![vec![same[first].clone(), same[second].clone()]]);
        assert_eq!((domain.area(), count(&domain, Repair::DuplicateRing)), (6.0, 1));
    }
    // A bow tie runs twice through its middle: both ways round it is the same one.
    let tie = ring(&[(0.0, 0.0), (1.0, 1.0), (0.0, 2.0), (2.0, 2.0), (1.0, 1.0), (2.0, 0.0)]);
    let back: Vec<Point> = tie.iter().rev().copied().collect();
    let domain = repaired(&vec![vec![tie, back]]);
    assert_eq!((domain.area(), count(&domain, Repair::DuplicateRing)), (2.0, 1));
}

#[test]
fn all_that_is_found_of_a_crossing_ring_is_reported() {
    // A bow-tie with a repeated vertex, a straight corner and a spike, and a hole on one line.
    let bow_tie = ring(&[
        (0.0, 0.0),
        (4.0, 4.0),
        (4.0, 4.0),
        (4.0, 2.0),
        (4.0, 0.0),
        (5.0, 0.0),
        (4.0, 0.0),
        (0.0, 4.0),
    ]);
    let line = ring(&[(1.0, 1.5), (1.0, 2.0), (1.0, 2.5)]);
    let far = ring(&[(10.0, 0.0), (11.0, 0.0), (11.0, 1.0)]);
    let nothing = ring(&[(20.0, 0.0), (21.0, 0.0)]);
    let domain = repaired(&vec![vec![bow_tie, line], vec![far.clone()], vec![far], vec![nothing]]);
    let found = |repair: Repair| -> Vec<_> {
        let entries = domain.report().entries().iter().filter(|entry| entry.repair == repair);
        entries.map(|entry| (entry.polygon, entry.ring, entry.indices.clone())).collect()
    };
    assert_eq!(found(Repair::RepeatedPoint), [(0, 0, vec![2, 6])]);
    assert_eq!(found(Repair::StraightCorner), [(0, 0, vec![3])]);
    assert_eq!(found(Repair::Spike), [(0, 0, vec![5])]);
    assert_eq!(found(Repair::Crossing), [(0, 0, vec![0, 6])]);
    assert_eq!(found(Repair::DegenerateHole), [(0, 1, vec![]), (3, 0, vec![])]);
    assert_eq!(found(Repair::DuplicateRing), [(2, 0, vec![])]);
    assert_eq!(found(Repair::EmptyPolygon), [(3, 0, vec![])]);
}

#[test]
fn rings_nested_otherwise_get_their_place() {
    let outer = ring(&[(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0)]);
    let hole = ring(&[(2.0, 2.0), (4.0, 2.0), (4.0, 4.0), (2.0, 4.0)]);
    let outside = ring(&[(12.0, 2.0), (14.0, 2.0), (14.0, 4.0), (12.0, 4.0)]);
    let domain = repaired(&vec![vec![hole, outer, outside]]);
    assert_eq!((domain.area(), domain.walks().len()), (81.0, 3));
    let regrouped: Vec<u32> = domain
        .report()
        .entries()
        .iter()
        .filter(|entry| entry.repair == Repair::Regrouped)
        .map(|entry| entry.ring)
        .collect();
    assert_eq!(regrouped, [0, 1, 2]);
}

#[test]
fn overlapping_polygons_are_united_on_request() {
    let square = |x: f64| ring(&[(x, 0.0), (x + 2.0, 0.0), (x + 2.0, 2.0), (x, 2.0)]);
    for (second, area, walks) in [(1.0, 6.0, 1), (2.0, 8.0, 1), (5.0, 8.0, 2)] {
        let both = vec![vec![square(0.0)], vec![square(second)]];
        if second < 2.0 {
            let error = Domain::from_polygons(&both, &REPAIR).unwrap_err();
            assert_eq!(error.code(), "polygons_overlap");
            assert_eq!(
                (error.polygon(), error.other_place().map(|p| p.polygon)),
                (Some(0), Some(1))
            );
        }
        for repair in [false, true] {
            let options = Options { dissolve: true, repair, ..Options::default() };
            let domain = Domain::from_polygons(&both, &options).unwrap();
            assert_eq!((domain.area(), domain.walks().len()), (area, walks));
        }
    }
}

#[test]
fn by_the_nonzero_rule_directions_count() {
    let square = |s: f64| ring(&[(-s, -s), (s, -s), (s, s), (-s, s)]);
    let mut turned = square(1.0);
    turned.reverse();
    let options = Options { fill: FillRule::NonZero, ..REPAIR };
    for (inner, area) in [(square(1.0), 16.0), (turned, 12.0)] {
        let polygons = vec![vec![square(2.0), inner]];
        assert_eq!(Domain::from_polygons(&polygons, &options).unwrap().area(), area);
        assert_eq!(repaired(&polygons).area(), 12.0);
    }
    // A ring that runs around its middle twice: a pentagram.
    let star: Vec<Point> = (0..5)
        .map(|k| {
            let (sin, cos) = (std::f64::consts::TAU * 2.0 * f64::from(k) / 5.0).sin_cos();
            Point::new(cos, sin)
        })
        .collect();
    let star = vec![vec![star]];
    let whole = Domain::from_polygons(&star, &options).unwrap();
    let even = repaired(&star);
    assert_eq!((whole.edges().len(), even.walks().len()), (10, 5));
    assert!(whole.area() > 1.3 * even.area());
}

#[test]
fn what_is_valid_passes_bit_for_bit() {
    let mut random = Random(7);
    for _ in 0..500 {
        let family = [Family::Tangle, Family::Holes, Family::Triangles][random.below(3) as usize];
        let shape = random::shape(&mut random, family, Ground::Square);
        let plain = Options { regroup: true, ..Options::default() };
        let Ok(domain) = Domain::from_polygons(&shape, &plain) else { continue };
        let again = Domain::from_polygons(&shape, &Options { repair: true, ..plain }).unwrap();
        let bits = |d: &Domain| -> Vec<_> {
            d.edges().iter().map(|e| (e.start.x.to_bits(), e.start.y.to_bits(), e.next)).collect()
        };
        assert_eq!(bits(&domain), bits(&again));
        assert_eq!(domain.report(), again.report());
    }
}

#[test]
fn strict_refuses_what_would_be_repaired() {
    let bow = vec![vec![ring(&[(0.0, 0.0), (2.0, 1.0), (2.0, 0.0), (0.0, 1.0)])]];
    let strict = Options { strict: true, ..REPAIR };
    for fill in [FillRule::EvenOdd, FillRule::NonZero] {
        let error = Domain::from_polygons(&bow, &Options { fill, ..strict }).unwrap_err();
        assert_eq!(error.code(), "crossing");
    }
}

/// Edges that are equal but for an ulp cross wherever rounding lets them, in more places each time they are
/// cut there.
#[test]
fn a_bundle_of_edges_is_snapped_soon() {
    let polygons = shapes::polygons("../issue_7_bundle_of_edges_within_an_ulp");
    let domain = repaired(&polygons);
    assert_eq!(count(&domain, Repair::Snapped), 1);
    check_repair(&mut Random(1), &polygons, &REPAIR, &domain);
    assert!(domain.report().moved() < 1e-11);
}

/// A corner is nearer to the line of an edge than doubles of twice the precision tell, on a path of no
/// length: the judge divided 0 by 0.
#[test]
fn distances_far_below_an_ulp_are_judged() {
    let polygons = shapes::polygons("../issue_7_distance_far_below_an_ulp");
    let options = Options { dissolve: true, ..REPAIR };
    let domain = Domain::from_polygons(&polygons, &options).unwrap();
    check_repair(&mut Random(1), &polygons, &options, &domain);
}
