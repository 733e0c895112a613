//! Divide and conquer against path tracing, on shapes larger than brute force can do.

mod support;

use medial::check;
use medial::domain::{Domain, Options};
use medial::engine::{
    self, EngineError, divide_and_conquer, divide_and_conquer_with, path_tracing,
};
use medial::geom::Point;
use support::random::{self, Family, Ground, Random};
use support::{compare, shapes};

/// Shapes that are drawn for each one that is wanted, at most.
const PATIENCE: usize = 100;

/// Tries this many random shapes with at most `most` edges, each as it is or off by a hair.
fn random_shapes(family: Family, ground: Ground, most: u64, seed: u64, count: usize) {
    let mut random = Random(seed);
    let options = Options { regroup: true, ..Options::default() };
    let mut failures = Vec::new();
    let mut tried = 0;
    for _ in 0..PATIENCE * count {
        if tried == count {
            break;
        }
        let mut polygons = random::large_shape(&mut random, family, ground, most);
        if random.below(3) == 0 {
            polygons = random::off_by_a_hair(&mut random, &polygons);
        }
        let Ok(domain) = Domain::from_polygons(&polygons, &options) else { continue };
        let found = match divide_and_conquer(&domain) {
            Ok(axis) => {
                let other = path_tracing(&domain).unwrap();
                let mut found = compare::differences(&other, &axis);
                let defects = check::defects(&domain, &axis).defects;
                found.extend(defects.iter().map(|defect| format!("judge: {defect}")));
                found
            }
            Err(why) => vec![why.to_string()],
        };
        tried += 1;
        if !found.is_empty() {
            failures.push((shapes::to_wkt(&polygons), found));
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
    assert_eq!(tried, count, "too few shapes are valid");
}

#[test]
fn tangles_have_the_axis_of_path_tracing() {
    random_shapes(Family::Tangle, Ground::Square, 60, 71, 150);
    random_shapes(Family::Tangle, Ground::Square, 400, 72, 10);
}

#[test]
fn tangles_on_a_grid_have_the_axis_of_path_tracing() {
    random_shapes(Family::Tangle, Ground::Grid(12), 24, 73, 300);
    random_shapes(Family::Tangle, Ground::Grid(50), 60, 74, 100);
}

#[test]
fn many_holes_have_the_axis_of_path_tracing() {
    random_shapes(Family::Holes, Ground::Square, 120, 75, 60);
    random_shapes(Family::Holes, Ground::Grid(60), 60, 76, 100);
}

#[test]
fn rings_that_hang_on_others_have_the_axis_of_path_tracing() {
    random_shapes(Family::Hung, Ground::Square, 20, 77, 300);
    random_shapes(Family::Hung, Ground::Grid(12), 20, 78, 300);
    random_shapes(Family::Hung, Ground::Grid(60), 36, 79, 60);
}

#[test]
fn lattices_that_touch_have_the_axis_of_path_tracing() {
    random_shapes(Family::Triangles, Ground::Grid(3), 100, 80, 60);
    random_shapes(Family::Squares, Ground::Grid(3), 100, 81, 60);
}

#[test]
fn a_lattice_of_square_holes_has_the_axis_of_path_tracing() {
    let square = |x: f64, y: f64, size: f64| {
        let corner = |i: f64, j: f64| Point::new(x + size * i, y + size * j);
        vec![corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)]
    };
    let holes = (0..81).map(|k| square(f64::from(k % 9 * 2 + 1), f64::from(k / 9 * 2 + 1), 1.0));
    let rings = std::iter::once(square(0.0, 0.0, 19.0)).chain(holes).collect();
    let domain = shapes::of(&[rings]).unwrap();
    let axis = divide_and_conquer(&domain).unwrap();
    assert_eq!(check::defects(&domain, &axis).defects, []);
    assert!(compare::differences(&path_tracing(&domain).unwrap(), &axis).is_empty());
}

/// The axis has no defect and is the one of path tracing.
fn is_right(domain: &Domain) {
    let axis = divide_and_conquer(domain).unwrap();
    assert_eq!(check::defects(domain, &axis).defects, []);
    assert_eq!(compare::differences(&path_tracing(domain).unwrap(), &axis), [""; 0]);
}

#[test]
fn two_holes_that_touch_are_one_obstacle() {
    is_right(&shapes::wkt(
        "POLYGON ((0 0, 8 0, 8 8, 0 8, 0 0), (4 4, 5 6, 3 6, 4 4), (4 4, 3 2, 5 2, 4 4))",
    ));
}

#[test]
fn holes_hang_on_an_edge_of_the_outer_ring() {
    is_right(&shapes::wkt(
        "POLYGON ((0 0, 9 0, 9 7, 0 7, 0 0), (3 0, 4 3, 2 3, 3 0), (6 0, 7 1, 6 2, 6 0))",
    ));
}

#[test]
fn three_holes_hang_on_one_corner() {
    is_right(&shapes::wkt(
        "POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (0 0, 6 1, 6 2, 0 0), (0 0, 5 3, 4 4, 0 0), \
         (0 0, 2 5, 1 7, 0 0))",
    ));
}

#[test]
fn holes_hang_on_holes_that_hang_on_holes() {
    is_right(&shapes::wkt(
        "POLYGON ((0 0, 20 0, 20 9, 0 9, 0 0), (2 4, 5 3, 5 6, 2 4), (5 3, 8 2, 8 5, 5 3), \
         (8 5, 12 4, 11 7, 8 5), (11 7, 14 9, 13 5, 11 7))",
    ));
}

#[test]
fn a_hole_goes_on_straight_where_it_touches_another_one() {
    is_right(&shapes::wkt(
        "POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (4 4, 2 4, 2 2, 4 4), (4 4, 6 2, 6 4, 4 4))",
    ));
    is_right(&shapes::wkt(
        "POLYGON ((0 0, 5 0, 5 5, 0 5, 0 0), (4 3, 5 2, 4 2, 4 3), (4 3, 3 3, 3 4, 4 3))",
    ));
}

#[test]
fn it_stops_when_it_is_told_to() {
    let domain = shapes::wkt("POLYGON ((0 0, 8 0, 8 8, 0 8, 0 0))");
    let cancel = std::sync::atomic::AtomicBool::new(true);
    let options = engine::Options { cancel: Some(&cancel), ..engine::Options::default() };
    assert_eq!(divide_and_conquer_with(&domain, &options).unwrap_err(), EngineError::Cancelled);
}
