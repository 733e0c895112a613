//! Polygons from axes: bit for bit where nothing was pruned, and as near as is promised else.

mod support;

use std::f64::consts::{PI, SQRT_2};

use medial::axis::{MedialAxis, Side};
use medial::domain::{self, Domain};
use medial::engine::{Options, path_tracing};
use medial::geom::{Point, orient2d, signed_area};
use medial::ops::{
    Hierarchy, Measure, Outline, OutlineError, OutlinePiece, ReconstructError, boundary_distance,
    polygons_of, smoothed, tangent_polygons,
};
use support::random::{self, Family, Ground, Random};
use support::shapes;

const RECTANGLE: &str = "POLYGON ((0 0, 6 0, 6 2, 0 2, 0 0))";

fn pruned(domain: &Domain, axis: &MedialAxis, measure: Measure, value: f64) -> (MedialAxis, f64) {
    let pruned = Hierarchy::new(domain, axis).unwrap().pruned(measure, value);
    (pruned.axis, pruned.error)
}

#[test]
fn the_outline_of_a_pruned_rectangle_has_rounded_corners() {
    let domain = shapes::wkt(RECTANGLE);
    let axis = path_tracing(&domain).unwrap();
    // Disks of radius 1/2 stay this far from the corners.
    let (left, error) = pruned(&domain, &axis, Measure::Excess, 0.5 * (SQRT_2 - 1.0));
    let outline = Outline::new(&left).unwrap();
    let [contour] = &outline.polygons[0].0[..] else { panic!("{outline:?}") };
    let arcs: Vec<_> = contour
        .0
        .iter()
        .filter_map(|piece| match *piece {
            OutlinePiece::Arc { radius, from, to, .. } => Some((radius, (to - from).norm())),
            _ => None,
        })
        .collect();
    assert_eq!(arcs.len(), 4);
    for (radius, chord) in arcs {
        assert!((radius - 0.5).abs() < 1e-14 && (chord - 0.5 * SQRT_2).abs() < 1e-14);
    }
    // A quarter of the square of each is cut off but for a quarter of the disk.
    let expected = 12.0 - 4.0 * (0.25 - 0.25 * PI * 0.25);
    assert!((outline.area() - expected).abs() < 1e-14);
    let rings = outline.polygons(1e-7).concat();
    let whole = polygons_of(&axis).unwrap().concat();
    let distance = boundary_distance(&whole, &rings, 1e-9);
    assert!((distance - error).abs() < 1e-6, "{distance} {error}");
    // All that burns leaves one disk.
    let (root, _) = pruned(&domain, &axis, Measure::Excess, f64::INFINITY);
    let outline = Outline::new(&root).unwrap();
    assert!((outline.area() - PI).abs() < 1e-14);
    let ring = &outline.polygons(1e-4)[0][0];
    assert!(
        signed_area(ring) > 0.999 * PI
            && ring.iter().all(|p| (*p - Point::new(3.0, 1.0)).norm() < 1.0 + 1e-12)
    );
    assert_eq!(polygons_of(&root), Err(ReconstructError::Incomplete));
}

#[test]
fn smoothing_takes_bumps_by_their_share_of_the_radius() {
    // The same triangle on a thick part, 4 wide, and on a thin one, 1 wide.
    let text = "POLYGON ((0 0, 10 0, 10 1.5, 14.8 1.5, 15 1.3, 15.2 1.5, 20 1.5, 20 2.5, 10 2.5, 10 4, 5.2 4, 5 4.2, 4.8 4, 0 4, 0 0))";
    let domain = shapes::wkt(text);
    let axis = path_tracing(&domain).unwrap();
    let bump = |smooth: &medial::ops::Smoothed, p: Point| {
        let rings = smooth.outline.polygons(1e-6).concat();
        rings.concat().contains(&p)
    };
    let smooth = smoothed(&domain, &axis, Measure::Prominence, 0.12).unwrap();
    assert!(!bump(&smooth, Point::new(5.0, 4.2)), "it is small there");
    assert!(bump(&smooth, Point::new(15.0, 1.3)), "and large here");
    assert!(smooth.distance <= 0.2 + 1e-12);
    // By the excess they are alike.
    let smooth = smoothed(&domain, &axis, Measure::Excess, 0.25).unwrap();
    assert!(!bump(&smooth, Point::new(5.0, 4.2)) && !bump(&smooth, Point::new(15.0, 1.3)));
}

#[test]
fn only_interior_axes_have_an_outline() {
    let domain = shapes::wkt("POLYGON ((0 0, 9 0, 9 9, 5 2, 0 9, 0 0))");
    let axis = medial::engine::exterior(
        &domain,
        medial::axis::Engine::PathTracing,
        None,
        &Options::default(),
    )
    .unwrap();
    assert_eq!(axis.side, Side::Exterior);
    assert_eq!(Outline::new(&axis), Err(OutlineError::Exterior));
    assert_eq!(tangent_polygons(&axis, 1.0), Err(OutlineError::Exterior));
    assert_eq!(polygons_of(&axis), Err(ReconstructError::Exterior));
}

/// The input ring without its last point, if that repeats the first.
fn open(ring: &[Point]) -> &[Point] {
    match ring {
        [first, .., last] if first == last => &ring[..ring.len() - 1],
        _ => ring,
    }
}

/// Whether what is missing of a ring repeats or lies straight between its neighbours, and nothing was added.
fn is_same_ring(given: &[Point], found: &[Point]) -> bool {
    let given = open(given);
    let mut at = 0;
    let mut kept = Vec::new();
    for (k, p) in given.iter().enumerate() {
        if found.get(at) == Some(p)
            && (k + 1 == given.len() || given[k + 1] != *p || found.get(at + 1) == Some(p))
        {
            kept.push(k);
            at += 1;
        }
    }
    at == found.len()
        && (0..given.len()).filter(|k| !kept.contains(k)).all(|k| {
            let before = kept.iter().rev().find(|&&j| j < k).or(kept.last());
            let after = kept.iter().find(|&&j| j > k).or(kept.first());
            let (a, b) = (given[*before.unwrap()], given[*after.unwrap()]);
            given[k] == a || given[k] == b || orient2d(a, given[k], b) == 0.0
        })
}

#[test]
fn rings_that_belonged_elsewhere_come_back_with_the_polygon_they_bound() {
    let square = |x: f64, y: f64, side: f64| {
        [(x, y), (x + side, y), (x + side, y + side), (x, y + side)]
            .map(|(x, y)| Point::new(x, y))
            .to_vec()
    };
    let again = |rings: &[Vec<Vec<Point>>]| {
        let options = domain::Options { repair: true, ..domain::Options::default() };
        let domain = Domain::from_polygons(rings, &options).unwrap();
        polygons_of(&path_tracing(&domain).unwrap()).unwrap()
    };
    // A hole outside, an island in a hole, a hole before its outer ring.
    let [a, b, c] = [square(0.0, 0.0, 9.0), square(2.0, 2.0, 4.0), square(3.0, 3.0, 1.0)];
    let far = square(20.0, 0.0, 1.0);
    let apart = again(&[vec![a.clone(), far.clone()]]);
    assert_eq!(apart, [vec![a.clone()], vec![far.clone()]]);
    let island = again(&[vec![a.clone(), b.clone(), c.clone()]]);
    assert_eq!(island, [vec![a.clone(), b.clone()], vec![c]]);
    let whole = again(&[vec![b.clone(), a.clone()]]);
    assert_eq!(whole, [vec![a, b]]);
}

#[test]
fn complete_axes_give_back_their_polygons_bit_for_bit() {
    for name in shapes::names() {
        let polygons = shapes::polygons(&name);
        let Ok(domain) = shapes::of(&polygons) else { continue };
        let axis = path_tracing(&domain).unwrap();
        let found = polygons_of(&axis).unwrap();
        if domain.report().entries().is_empty() {
            let open: Vec<Vec<Vec<Point>>> = polygons
                .iter()
                .map(|p| p.iter().map(|ring| open(ring).to_vec()).collect())
                .collect();
            assert_eq!(found, open, "{name}");
        } else if found.len() == polygons.len() {
            for (given, found) in polygons.iter().zip(&found).filter(|(a, b)| a.len() == b.len()) {
                let same = given.iter().zip(found).all(|(a, b)| is_same_ring(a, b));
                assert!(same, "{name}: {given:?} {found:?}");
            }
        }
        // Whatever was repaired, it is the same domain.
        let again = shapes::of(&found).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(edges(&again), edges(&domain), "{name}");
    }
}

/// The ends of all edges, in an order of their own.
fn edges(domain: &Domain) -> Vec<[(u64, u64); 2]> {
    let bits = |p: Point| ((p.x + 0.0).to_bits(), (p.y + 0.0).to_bits());
    let ends = |k: u32| [bits(domain.edge(k).start), bits(domain.end(k))];
    let mut all: Vec<_> = (0..domain.edges().len() as u32).map(ends).collect();
    all.sort_unstable();
    all
}

/// What is wrong with rebuilding the shape of an axis.
fn faults(domain: &Domain, axis: &MedialAxis) -> Vec<String> {
    let mut faults = Vec::new();
    let corners: Vec<Point> = domain.edges().iter().map(|edge| edge.start).collect();
    let low = corners.iter().fold(corners[0], |a, b| Point::new(a.x.min(b.x), a.y.min(b.y)));
    let high = corners.iter().fold(corners[0], |a, b| Point::new(a.x.max(b.x), a.y.max(b.y)));
    let size = (high - low).norm();
    let walks: Vec<Vec<Point>> = domain
        .walks()
        .iter()
        .map(|walk| walk.edges().map(|k| domain.edge(k).start).collect())
        .collect();
    let outline = Outline::new(axis).unwrap();
    let arcs = |outline: &Outline| {
        let pieces = outline.polygons.iter().flat_map(|p| &p.0).flat_map(|c| &c.0);
        pieces.filter(|piece| matches!(piece, OutlinePiece::Arc { .. })).count()
    };
    if arcs(&outline) > 0 {
        faults.push("a complete outline has arcs".to_owned());
    }
    let distance = boundary_distance(&walks, &outline.polygons(1.0).concat(), 1e-9 * size);
    if distance > 1e-9 * size || (outline.area() - domain.area()).abs() > 1e-9 * size * size {
        faults.push(format!("the outline is {distance} away"));
    }
    let n_contours = outline.polygons.iter().map(|p| p.0.len()).sum::<usize>();
    for share in [0.02, 0.1, 0.5] {
        let (left, error) = pruned(domain, axis, Measure::Excess, share * size);
        let smooth = Outline::new(&left).unwrap();
        let rings = smooth.polygons(1e-4 * size);
        let distance = boundary_distance(&walks, &rings.concat(), 1e-5 * size);
        // Flattening and the tolerance of the measurement.
        if distance > error + 2e-4 * size {
            faults.push(format!("pruned by {error}: the outline is {distance} away"));
        }
        if smooth.polygons.iter().map(|p| p.0.len()).sum::<usize>() != n_contours {
            faults.push(format!("pruned by {error}: another number of contours"));
        }
        if smooth.area() > domain.area() + 1e-9 * size * size {
            faults.push(format!("pruned by {error}: it has grown"));
        }
        if smooth
            .polygons
            .iter()
            .any(|p| p.0[0].area() <= 0.0 || p.0[1..].iter().any(|c| c.area() >= 0.0))
        {
            faults.push(format!("pruned by {error}: contours the wrong way round"));
        }
    }
    faults
}

fn random_shapes(family: Family, ground: Ground, most: u64, seed: u64, count: usize) {
    let mut random = Random(seed);
    let options = domain::Options { regroup: true, ..domain::Options::default() };
    let mut tried = 0;
    while tried < count {
        let polygons = random::large_shape(&mut random, family, ground, most);
        let Ok(domain) = Domain::from_polygons(&polygons, &options) else { continue };
        tried += 1;
        let found = faults(&domain, &path_tracing(&domain).unwrap());
        assert!(found.is_empty(), "{}: {found:#?}", shapes::to_wkt(&polygons));
    }
}

#[test]
fn outlines_of_random_shapes_are_as_near_as_promised() {
    random_shapes(Family::Tangle, Ground::Square, 30, 701, 60);
    random_shapes(Family::Tangle, Ground::Grid(9), 20, 702, 60);
    random_shapes(Family::Holes, Ground::Grid(30), 40, 703, 30);
    random_shapes(Family::Hung, Ground::Grid(30), 40, 704, 30);
    random_shapes(Family::Triangles, Ground::Grid(4), 20, 705, 60);
    random_shapes(Family::Squares, Ground::Grid(4), 20, 706, 60);
}

#[test]
fn tangents_come_nearer_with_the_step() {
    for name in shapes::names() {
        let polygons = shapes::polygons(&name);
        let Ok(domain) = shapes::of(&polygons) else { continue };
        if domain.edges().len() > 200 {
            continue;
        }
        let axis = path_tracing(&domain).unwrap();
        let whole = polygons_of(&axis).unwrap().concat();
        let corners = whole.concat();
        // Samples of tiny shapes far out differ by their rounding only.
        let far = corners.iter().map(|p| p.norm()).fold(0.0, f64::max);
        let size = corners.iter().map(|p| (*p - corners[0]).norm()).fold(0.0, f64::max);
        if far * 1e-9 > size {
            continue;
        }
        let distance = |step: f64| {
            let rings = tangent_polygons(&axis, step * size).unwrap().concat();
            boundary_distance(&whole, &rings, 1e-6 * size) / size
        };
        let distances = [3e-2, 3e-3].map(distance);
        assert!(
            distances[1] < 4e-3 && distances[1] <= distances[0] + 1e-6,
            "{name}: {distances:?}"
        );
    }
}

#[test]
fn the_tangents_of_a_rectangle_are_its_edges() {
    let domain = shapes::wkt(RECTANGLE);
    let axis = path_tracing(&domain).unwrap();
    let rings = tangent_polygons(&axis, 0.25).unwrap();
    let [polygon] = &rings[..] else { panic!("{rings:?}") };
    let on_boundary =
        |p: &Point| p.x.abs().min((p.x - 6.0).abs()).min(p.y.abs()).min((p.y - 2.0).abs()) < 1e-12;
    assert!(polygon[0].len() > 40 && polygon[0].iter().all(on_boundary), "{polygon:?}");
    assert!((signed_area(&polygon[0]) - 12.0).abs() < 1e-12);
    // An end that is no corner gets points around it.
    let (left, _) = pruned(&domain, &axis, Measure::Angle, 3.0);
    let stadium = tangent_polygons(&left, 0.25).unwrap().concat().concat();
    let at = |x: f64, y: f64| stadium.iter().any(|p| (*p - Point::new(x, y)).norm() < 1e-12);
    let angle = PI / 10.0;
    assert!(
        at(5.0, 0.0) && at(5.0, 2.0) && at(5.0 + angle.cos(), 1.0 + angle.sin()),
        "{stadium:?}"
    );
}

#[cfg(feature = "union")]
#[test]
fn the_union_of_disks_fills_the_shape() {
    use medial::ops::{disks, union_of_disks};
    let domain = shapes::wkt("POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (3 3, 3 6, 6 6, 6 3, 3 3))");
    let axis = path_tracing(&domain).unwrap();
    let polygons = union_of_disks(&disks(&axis, 0.01), 1e-4);
    assert_eq!((polygons.len(), polygons[0].len()), (1, 2), "one part with a hole");
    let area: f64 = polygons.iter().flatten().map(|ring| signed_area(ring)).sum();
    assert!(area < 72.0 && area > 71.9, "{area}");
    let distance =
        boundary_distance(&polygons_of(&axis).unwrap().concat(), &polygons.concat(), 1e-6);
    assert!(distance < 0.01, "{distance}");
}

#[test]
fn corners_that_are_nearly_straight_make_no_circles() {
    // The second corner is straight but for its rounding; so are those of the coast below.
    let blunt = "POLYGON ((0 0, 2.94 0.9799999999999999, 4.2 1.4, 1.9 3.8, 0 0))";
    let mut coast = Vec::new();
    let corners = [(0.1, 0.2), (9.3, 1.1), (8.2, 7.7), (4.4, 3.3), (1.3, 8.9)];
    for (k, &(x, y)) in corners.iter().enumerate() {
        let (u, v) = corners[(k + 1) % corners.len()];
        coast.extend(
            (0..7)
                .map(|k| f64::from(k) / 7.0)
                .map(|t| Point::new(x + t * (u - x), y + t * (v - y))),
        );
    }
    for domain in [shapes::wkt(blunt), shapes::of(&[vec![coast]]).unwrap()] {
        let axis = path_tracing(&domain).unwrap();
        for (measure, value) in
            [(Measure::Prominence, 0.1), (Measure::Excess, 1e-9), (Measure::Excess, 0.1)]
        {
            let smooth = smoothed(&domain, &axis, measure, value).unwrap();
            let walks: Vec<Vec<Point>> = domain
                .walks()
                .iter()
                .map(|walk| walk.edges().map(|k| domain.edge(k).start).collect())
                .collect();
            let rings = smooth.outline.polygons(1e-4).concat();
            let distance = boundary_distance(&walks, &rings, 1e-6);
            assert!(distance <= smooth.distance + 2e-4, "{measure} {value}: {distance}");
            assert!(smooth.outline.area() <= domain.area() + 1e-9);
            assert!(shapes::of(&smooth.outline.polygons(1e-4)).is_ok());
        }
    }
}

#[test]
fn rings_that_touch_stay_rings() {
    for name in
        ["hole_touching_an_edge", "two_touching_holes", "hole_touching_the_outer_ring_at_a_corner"]
    {
        let domain = shapes::domain(name);
        let axis = path_tracing(&domain).unwrap();
        let polygons = Outline::new(&axis).unwrap().polygons(1e-4);
        let n_rings = shapes::polygons(name)[0].len();
        assert_eq!((polygons.len(), polygons[0].len()), (1, n_rings), "{name}: {polygons:?}");
        assert!(signed_area(&polygons[0][0]) > 0.0);
        assert!(polygons[0][1..].iter().all(|hole| signed_area(hole) < 0.0));
        // As simple features want it.
        let strict = domain::Options { strict: true, ..domain::Options::default() };
        assert!(Domain::from_polygons(&polygons, &strict).is_ok(), "{name}");
    }
}

#[cfg(feature = "union")]
#[test]
fn the_union_of_linked_disks_is_as_near_as_they_are() {
    use medial::ops::{compress, union_of_linked_disks};
    let mut checked = 0;
    for name in shapes::names() {
        let domain = shapes::domain(&name);
        if domain.edges().len() > 200 {
            continue;
        }
        let axis = path_tracing(&domain).unwrap();
        let size = domain.bounds().max - domain.bounds().min;
        let Ok(graph) = compress(&domain, &axis, 0.01 * size.x.max(size.y)) else { continue };
        let tolerance = 0.125 * graph.error();
        let polygons = union_of_linked_disks(&graph.axis().unwrap(), tolerance);
        // Where the shape is thinner than the disks are right nothing is left of it.
        if graph.disks().iter().any(|disk| disk.radius == 0) {
            continue;
        }
        let walks = polygons_of(&axis).unwrap().concat();
        let distance = boundary_distance(&walks, &polygons.concat(), 0.01 * tolerance);
        assert!(distance <= graph.error() + 1.01 * tolerance, "{name}: {distance}");
        checked += 1;
    }
    assert!(checked > 10, "{checked}");
}

#[cfg(feature = "union")]
#[test]
fn a_loop_without_length_is_a_point() {
    use medial::ops::{compress, disks, union_of_disks, union_of_linked_disks};
    // A ring that is a single disk within the error, with a link to itself.
    let domain = shapes::wkt("POLYGON ((0 0, 6 0, 6 6, 0 6, 0 0), (2 2, 4 2, 4 4, 2 4, 2 2))");
    let graph = compress(&domain, &path_tracing(&domain).unwrap(), 10.0).unwrap();
    assert_eq!((graph.disks().len(), graph.links().count()), (1, 1));
    let axis = graph.axis().unwrap();
    let disks = disks(&axis, 0.0);
    assert_eq!(disks.len(), 1);
    assert!(
        tangent_polygons(&axis, 0.0).unwrap().concat().concat().iter().all(|p| p.x.is_finite())
    );
    assert_eq!(union_of_disks(&disks, 0.0), union_of_linked_disks(&axis, 0.0));
}

#[test]
fn arcs_around_what_rounding_makes_a_point_have_places() {
    // The last disks that are left are smaller than the ulp of the coordinates.
    let domain = shapes::wkt(
        "POLYGON ((1e7 -3e7, 10000007.785867814 -29999999.63259036, \
         10000000.146997092 -29999995.838274453, 9999998.105150495 -29999998.444729164, 1e7 -3e7))",
    );
    let axis = path_tracing(&domain).unwrap();
    for threshold in [1e-9, 3e-9, 1e-8, 3e-8] {
        let smooth = smoothed(&domain, &axis, Measure::Chord, threshold).unwrap();
        let points = smooth.outline.polygons(1e-3).concat().concat();
        assert!(!points.is_empty() && points.iter().all(|p| p.x.is_finite() && p.y.is_finite()));
    }
}
