//! Exterior axes: by hand, by both engines, and with planted faults.

mod support;

use std::num::NonZeroUsize;

use medial::axis::{Engine, KeypointKind, MedialAxis, Side, Site};
use medial::check::{self, Defect};
use medial::domain::{self, Domain};
use medial::engine::{EngineError, Options, both_sides, exterior, interior};
use medial::geom::Point;
use support::parts::Parts;
use support::random::{self, Family, Ground, Random};
use support::{compare, shapes};

fn outside(domain: &Domain, frame: Option<f64>) -> MedialAxis {
    exterior(domain, Engine::PathTracing, frame, &Options::default()).unwrap()
}

fn axis_of(wkt: &str) -> (Domain, MedialAxis) {
    let domain = shapes::wkt(wkt);
    let axis = outside(&domain, None);
    assert_eq!(axis.side, Side::Exterior);
    assert_eq!(check::defects(&domain, &axis).defects, []);
    (domain, axis)
}

/// Places and radii of the keypoints of a kind, in any order.
fn places(axis: &MedialAxis, kind: KeypointKind) -> Vec<(f64, f64, f64)> {
    let keypoints = axis.keypoints().iter().filter(|k| k.kind == kind);
    let mut places: Vec<_> = keypoints.map(|k| (k.position.x, k.position.y, k.radius)).collect();
    places.sort_by(|a, b| a.partial_cmp(b).unwrap());
    places
}

const L: &str = "POLYGON ((0 0, 2 0, 2 1, 1 1, 1 2, 0 2, 0 0))";

#[test]
fn the_notch_of_an_l_sends_one_path_to_infinity() {
    let (domain, axis) = axis_of(L);
    assert!(axis.complete);
    assert_eq!(places(&axis, KeypointKind::End), [(1.0, 1.0, 0.0)]);
    // Where both edges of the notch end; from there on two corners govern.
    assert_eq!(places(&axis, KeypointKind::Transition), [(2.0, 2.0, 1.0)]);
    // The box 2 by 2 grown by 2; (4, 4) is √13 from (2, 1).
    assert_eq!(places(&axis, KeypointKind::Clipped), [(4.0, 4.0, 13f64.sqrt())]);
    assert_eq!(axis.paths().len(), 2);
    let verdict = check::defects(&domain, &axis);
    assert_eq!((verdict.counts.edges, verdict.counts.clipped, verdict.counts.walks), (6, 1, 1));
    assert!(verdict.identities.len() > 5);
}

#[test]
fn edges_have_the_polygon_to_their_left_and_names_of_the_input() {
    let (_, axis) = axis_of(L);
    let sites: Vec<_> = axis.sites().iter().map(|s| (s.kind.name(), s.index, s.a, s.b)).collect();
    let p = Point::new;
    let expected = [
        ("vertex", 2, p(2.0, 1.0), p(2.0, 1.0)),
        ("edge", 2, p(2.0, 1.0), p(1.0, 1.0)),
        ("edge", 3, p(1.0, 1.0), p(1.0, 2.0)),
        ("vertex", 4, p(1.0, 2.0), p(1.0, 2.0)),
    ];
    assert_eq!(sites, expected);
}

#[test]
fn a_convex_polygon_has_an_empty_exterior_axis() {
    let (_, axis) = axis_of("POLYGON ((0 0, 3 0, 4 2, 1 3, 0 0))");
    assert!(axis.complete && axis.sites().is_empty() && axis.keypoints().is_empty());
}

#[test]
fn a_hole_is_a_component_of_its_own() {
    let (domain, axis) = axis_of("POLYGON ((0 0, 4 0, 4 4, 0 4, 0 0), (1 1, 1 3, 3 3, 3 1, 1 1))");
    assert_eq!(places(&axis, KeypointKind::Junction), [(2.0, 2.0, 1.0)]);
    assert_eq!((axis.keypoints().len(), axis.paths().len()), (5, 4));
    assert_eq!(check::defects(&domain, &axis).counts.components, 2);
}

#[test]
fn two_squares_have_a_line_between_them() {
    let (_, axis) =
        axis_of("MULTIPOLYGON (((0 0, 1 0, 1 1, 0 1, 0 0)), ((2 0, 3 0, 3 1, 2 1, 2 0)))");
    assert_eq!(places(&axis, KeypointKind::Transition), [(1.5, 0.0, 0.5), (1.5, 1.0, 0.5)]);
    // The box 3 by 1 grown by 3; (1.5, 4) is √(0.25 + 9) from (1, 1).
    let radius = 9.25f64.sqrt();
    assert_eq!(places(&axis, KeypointKind::Clipped), [(1.5, -3.0, radius), (1.5, 4.0, radius)]);
}

#[test]
fn an_island_in_a_hole_is_outside_of_neither() {
    axis_of(
        "MULTIPOLYGON (((0 0, 9 0, 9 9, 0 9, 0 0), (1 1, 1 8, 8 8, 8 1, 1 1)), \
         ((4 4, 6 4, 5 6, 4 4)))",
    );
}

#[test]
fn polygons_that_touch_leave_wedges_between_them() {
    // At a corner, along an edge, in a ring around a gap, and sharing an edge.
    for wkt in [
        "MULTIPOLYGON (((0 0, 1 0, 1 1, 0 1, 0 0)), ((1 1, 2 1, 2 2, 1 2, 1 1)))",
        "MULTIPOLYGON (((0 0, 4 0, 4 1, 0 1, 0 0)), ((2 1, 3 3, 1 3, 2 1)))",
        "MULTIPOLYGON (((0 0, 3 0, 3 1, 0 1, 0 0)), ((0 1, 1 2, 0 3, -1 2, 0 1)), \
         ((3 1, 4 2, 3 3, 2 2, 3 1)), ((0 3, 3 3, 3 4, 0 4, 0 3)))",
        "POLYGON ((0 0, 8 0, 8 8, 0 8, 0 0), (4 4, 5 6, 3 6, 4 4), (4 4, 3 2, 5 2, 4 4))",
        "MULTIPOLYGON (((0 0, 1 0, 1 1, 0 1, 0 0)), ((1 0, 2 0, 3 1, 1 1, 1 0)))",
    ] {
        let (_, axis) = axis_of(wkt);
        assert!(axis.complete, "{wkt}");
    }
}

#[test]
fn a_frame_that_cuts_more_than_unbounded_paths_leaves_an_incomplete_axis() {
    // A flat notch: its two corners and its bottom govern a disk with its centre far above.
    let domain = shapes::wkt("POLYGON ((0 0, 20 0, 20 2, 18 2, 10 1, 2 2, 0 2, 0 0))");
    let near = outside(&domain, Some(0.25));
    assert!(!near.complete);
    assert_eq!(check::defects(&domain, &near).defects, []);
    let far = outside(&domain, Some(1000.0));
    assert!(far.complete);
    assert_eq!(check::defects(&domain, &far).defects, []);
    let inside = |p: Point| -0.25 < p.x && p.x < 20.25 && -0.25 < p.y && p.y < 2.25;
    let kept = |axis: &MedialAxis| axis.keypoints().iter().filter(|k| inside(k.position)).count();
    let clipped = places(&near, KeypointKind::Clipped);
    assert_eq!(kept(&near), kept(&far));
    assert!(clipped.iter().all(|&(x, y, _)| !inside(Point::new(x, y))), "{clipped:?}");
}

#[test]
fn a_path_through_a_corner_of_the_frame_is_cut_once() {
    // The bisector of (1, 4) and (0, 3) passes it within rounding, by way of its two lines.
    let polygons = shapes::parse(
        "POLYGON ((4 3, 4 4, 3 4, 3 3, 2 4.000000000000001, 1 4, 2 3, 2 2, 1 2, 0 2, 0 1, 1 2, \
         1 3, 0 3, 1 2, 1 1, 2 0, 3 0, 3 1, 2 1, 2 2, 3 2, 4 2, 4 3), (4 1, 3 0, 4 0, 4 1))",
    );
    let options = domain::Options { regroup: true, ..domain::Options::default() };
    let axis = outside(&Domain::from_polygons(&polygons, &options).unwrap(), None);
    let clipped = places(&axis, KeypointKind::Clipped);
    let near_corner = |&&(x, y, _): &&(f64, f64, f64)| x < -3.5 && y > 7.5;
    assert_eq!(clipped.iter().filter(near_corner).count(), 1, "{clipped:?}");
}

#[test]
fn every_shape_has_the_same_exterior_axis_by_both_engines() {
    let mut failures = Vec::new();
    for name in shapes::names() {
        let found = faults(&shapes::domain(&name));
        failures.extend(found.into_iter().map(|fault| format!("{name}: {fault}")));
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

/// What is wrong with the exterior axis of a domain.
fn faults(domain: &Domain) -> Vec<String> {
    let axis = match exterior(domain, Engine::PathTracing, None, &Options::default()) {
        Ok(axis) => axis,
        Err(why) => return vec![format!("path_tracing: {why}")],
    };
    let mut faults: Vec<String> =
        check::defects(domain, &axis).defects.iter().map(|d| format!("judge: {d}")).collect();
    match exterior(domain, Engine::DivideAndConquer, None, &Options::default()) {
        Ok(other) => {
            let defects = check::defects(domain, &other).defects;
            faults.extend(defects.iter().map(|d| format!("judge on divide_and_conquer: {d}")));
            faults.extend(compare::differences(&axis, &other));
            faults.extend(other_than_both(domain, &other));
        }
        Err(why) => faults.push(format!("divide_and_conquer: {why}")),
    }
    faults
}

/// Whether both sides at once are something else than each side alone, on one thread or several.
fn other_than_both(domain: &Domain, outside: &MedialAxis) -> Vec<String> {
    let engine = Engine::DivideAndConquer;
    let inside = interior(domain, engine, &Options::default());
    let shared = |threads: usize| {
        let threads = NonZeroUsize::new(threads).unwrap();
        let options = Options { threads, alone_below: 0, ..Options::default() };
        match both_sides(domain, engine, None, &options) {
            Ok([_, o]) if o != *outside => Some(format!("{threads} threads: another outside")),
            Ok([i, _]) if Ok(&i) != inside.as_ref() => {
                Some(format!("{threads} threads: another inside"))
            }
            Ok(_) => None,
            Err(why) => Some(format!("both sides, {threads} threads: {why}")),
        }
    };
    [1, 3].into_iter().filter_map(shared).collect()
}

/// Tries this many valid random shapes, one in three changed by a hair.
fn random_shapes(family: Family, ground: Ground, most: u64, seed: u64, count: usize) {
    let mut random = Random(seed);
    let options = domain::Options { regroup: true, ..domain::Options::default() };
    let mut failures = Vec::new();
    let mut tried = 0;
    while tried < count {
        let mut polygons = random::large_shape(&mut random, family, ground, most);
        if random.below(3) == 0 {
            polygons = random::off_by_a_hair(&mut random, &polygons);
        }
        let Ok(domain) = Domain::from_polygons(&polygons, &options) else { continue };
        tried += 1;
        let found = faults(&domain);
        if !found.is_empty() {
            failures.push((shapes::to_wkt(&polygons), found));
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

#[test]
fn random_shapes_have_an_exterior_axis() {
    random_shapes(Family::Tangle, Ground::Square, 40, 91, 200);
    random_shapes(Family::Tangle, Ground::Grid(9), 20, 92, 300);
    random_shapes(Family::Holes, Ground::Grid(30), 40, 93, 100);
}

#[test]
fn lattices_that_touch_have_an_exterior_axis() {
    random_shapes(Family::Triangles, Ground::Grid(3), 20, 94, 200);
    random_shapes(Family::Squares, Ground::Grid(3), 20, 95, 200);
}

#[test]
fn polygons_that_share_parts_of_edges_have_one_exterior() {
    // One on a longer edge; two side by side on it; one that juts out; a row of three; one in a notch.
    let a = "((0 0, 10 0, 10 10, 0 10, 0 0))";
    for (others, n_parts) in [
        (vec!["((2 10, 4 10, 3 13, 2 10))"], 2),
        (vec!["((2 10, 4 10, 3 13, 2 10))", "((4 10, 8 10, 8 12, 4 10))"], 2),
        (vec!["((10 5, 12 5, 12 15, 10 15, 10 5))"], 1),
        (vec!["((10 -5, 12 -5, 12 15, 10 15, 10 -5))", "((12 0, 20 0, 12 9, 12 0))"], 1),
    ] {
        let wkt = format!("MULTIPOLYGON ({a}, {})", others.join(", "));
        let domain = shapes::wkt(&wkt);
        assert_eq!(faults(&domain), Vec::<String>::new(), "{wkt}");
        let (_, axis) = axis_of(&wkt);
        // The top edge of the square is cut into what is left of it.
        let is_part = |s: &Site| s.a != s.b && (s.polygon, s.a.y, s.b.y) == (0, 10.0, 10.0);
        let parts = axis.sites().iter().filter(is_part);
        assert_eq!(parts.count(), n_parts, "{wkt}");
    }
}

/// A square cut into cells by lines that jog, with some of the cells left out.
fn jogged_cells(random: &mut Random, side: u64) -> shapes::Polygons {
    let mut cells = Vec::new();
    for row in 0..side {
        let (low, high) = (10.0 * row as f64, 10.0 * (row + 1) as f64);
        let mut left = 0.0;
        while left < 10.0 * side as f64 {
            let right = left + 3.0 + random.below(9) as f64;
            if random.below(4) > 0 {
                let ring = [(left, low), (right, low), (right, high), (left, high)];
                cells.push(vec![ring.map(|(x, y)| Point::new(x, y)).to_vec()]);
            }
            left = right;
        }
    }
    cells
}

#[test]
fn walls_of_bricks_have_an_exterior_axis() {
    let random = &mut Random(96);
    let mut tried = 0;
    for side in [2, 3, 4, 5].into_iter().cycle().take(200) {
        let bricks = jogged_cells(random, side);
        let Ok(domain) = Domain::from_polygons(&bricks, &domain::Options::default()) else {
            continue;
        };
        tried += 1;
        assert_eq!(faults(&domain), Vec::<String>::new(), "{}", shapes::to_wkt(&bricks));
    }
    assert!(tried > 150, "{tried}");
}

#[test]
fn a_path_to_infinity_that_is_missing_is_found() {
    let (domain, axis) = axis_of("POLYGON ((0 0, 4 0, 4 3, 3 1, 2 3, 1 1, 0 3, 0 0))");
    let mut parts = Parts::of(&axis);
    let at = parts.keypoints.iter().position(|k| k.kind == KeypointKind::Clipped).unwrap();
    let path = parts.paths.iter().position(|p| p.to == at as u32 || p.from == at as u32).unwrap();
    parts.paths.remove(path);
    let defects = check::defects(&domain, &parts.axis()).defects;
    assert!(defects.iter().any(|d| matches!(d, Defect::LostGap { .. })), "{defects:#?}");
}

#[test]
fn a_path_that_is_cut_before_its_end_is_found() {
    let (domain, axis) = axis_of(L);
    let mut parts = Parts::of(&axis);
    // Half-way from the notch to the transition, as if that were infinity.
    let end = parts.at(1.0, 1.0);
    let transition = parts.at(2.0, 2.0);
    let first = parts.between(end, transition);
    let path = parts.paths[first];
    let second = parts.paths.iter().position(|p| *p != path).unwrap();
    let last = parts.at(4.0, 4.0);
    parts.keypoints[last].position = Point::new(1.5, 1.5);
    parts.keypoints[last].radius = 0.5;
    parts.keypoints[last].governors = parts.keypoints[end].governors.clone();
    let to_last = |k: u32| if k == transition as u32 { last as u32 } else { k };
    parts.paths[first].from = to_last(path.from);
    parts.paths[first].to = to_last(path.to);
    parts.paths.remove(second);
    parts.keypoints.remove(transition);
    for path in &mut parts.paths {
        for k in [&mut path.from, &mut path.to] {
            *k -= u32::from(*k > transition as u32);
        }
    }
    parts.drop_idle_sites();
    let defects = check::defects(&domain, &parts.axis()).defects;
    assert!(defects.iter().any(|d| matches!(d, Defect::StrayCut { .. })), "{defects:#?}");
    assert!(defects.iter().any(|d| matches!(d, Defect::LostGap { .. })), "{defects:#?}");
}

#[test]
fn a_cut_with_a_wrong_radius_is_found() {
    let (domain, axis) = axis_of(L);
    let mut parts = Parts::of(&axis);
    let last = parts.at(4.0, 4.0);
    parts.keypoints[last].radius *= 1.01;
    let defects = check::defects(&domain, &parts.axis()).defects;
    assert!(!defects.is_empty());
}

#[test]
fn a_cut_that_is_not_on_the_frame_of_the_others_is_found() {
    // Three notches, so three cuts; one of them slides back along its path.
    let (domain, axis) = axis_of("POLYGON ((0 0, 4 0, 4 3, 3 1, 2 3, 1 1, 0 3, 0 0))");
    let mut parts = Parts::of(&axis);
    let cuts = || axis.keypoints().iter().filter(|k| k.kind == KeypointKind::Clipped);
    assert!(cuts().count() > 1);
    let at = cuts().next_back().unwrap();
    let number = parts.at(at.position.x, at.position.y);
    let start = parts.paths.iter().find_map(|p| match (p.from, p.to) {
        (from, to) if to as usize == number => Some(from),
        (from, to) if from as usize == number => Some(to),
        _ => None,
    });
    // On the bisector of two corners the squared radius is quadratic.
    let start = axis.keypoints().at(start.unwrap()).position;
    let middle = (start + at.position) * 0.5;
    let governor = axis.sites().at(parts.keypoints[number].governors[0]).a;
    parts.keypoints[number].position = middle;
    parts.keypoints[number].radius = (middle - governor).norm();
    let defects = check::defects(&domain, &parts.axis()).defects;
    assert!(matches!(defects[..], [Defect::OffFrame { .. }]), "{defects:#?}");
}

#[test]
fn what_is_left_of_an_axis_that_is_not_complete_is_named_by_its_paths() {
    let (domain, axis) = axis_of(L);
    let mut parts = Parts::of(&axis);
    parts.complete = false;
    assert_eq!(check::defects(&domain, &parts.axis()).defects, []);
    // The notch is a corner with one path: its end, nothing else.
    let end = parts.at(1.0, 1.0);
    for kind in [KeypointKind::Junction, KeypointKind::Transition, KeypointKind::Tip] {
        parts.keypoints[end].kind = kind;
        let defects = check::defects(&domain, &parts.axis()).defects;
        assert!(!defects.is_empty(), "{kind:?}");
    }
}

#[test]
fn sites_the_other_way_round_are_found() {
    let (domain, axis) = axis_of(L);
    let mut parts = Parts::of(&axis);
    let edge = parts.sites.iter().position(|s| s.a != s.b).unwrap();
    let site = &mut parts.sites[edge];
    std::mem::swap(&mut site.a, &mut site.b);
    let defects = check::defects(&domain, &parts.axis()).defects;
    assert!(defects.iter().any(|d| matches!(d, Defect::MovedSite { .. })), "{defects:#?}");
}

#[test]
fn a_frame_that_is_none_is_refused() {
    let domain = shapes::wkt(L);
    let error = exterior(&domain, Engine::PathTracing, Some(-1.0), &Options::default());
    assert_eq!(error.unwrap_err(), EngineError::Frame { margin: -1.0 });
}

#[test]
fn a_keypoint_on_the_frame_is_cut_off_however_it_is_rounded() {
    // Between the tips of two triangles a keypoint lies at (9.5, -0.25), on the frame.
    let wkt = "MULTIPOLYGON (((9 0, 9.5 1, 8.5 1, 9 0)), ((10 0, 10.5 1, 9.5 1, 10 0)))";
    let domain = shapes::wkt(wkt);
    let axis = outside(&domain, Some(0.25));
    assert_eq!(check::defects(&domain, &axis).defects, []);
    for (keypoint, degree) in axis.keypoints().iter().zip(axis.degrees()) {
        assert_eq!(degree == 1, keypoint.kind == KeypointKind::Clipped || keypoint.radius == 0.0);
    }
}
