//! Thin walls: by hand, and every point of the axis on the right side of both limits.

mod support;

use medial::domain::{self, Domain};
use medial::engine::path_tracing;
use medial::geom::Point;
use medial::ops::{Wall, WallError, WallOptions, Widths, thin_walls};
use support::random::{self, Family, Ground, Random};
use support::shapes;

fn walls(domain: &Domain, options: &WallOptions) -> Vec<Wall> {
    thin_walls(domain, &path_tracing(domain).unwrap(), options).unwrap()
}

fn between(domain: &Domain, min: f64, max: f64) -> Vec<Wall> {
    walls(domain, &WallOptions::between(min, max))
}

/// Both ends and the widths there.
fn ends(wall: &Wall) -> [(Point, f64); 2] {
    let points = wall.polyline(1e-3);
    [points[0], points[points.len() - 1]]
}

#[test]
fn a_bar_is_a_wall_from_disk_to_disk_if_its_width_is_within_the_limits() {
    let bar = shapes::wkt("POLYGON ((0 0, 9 0, 9 1, 0 1, 0 0))");
    for (min, max) in [(0.5, 2.0), (1.0, 2.0), (0.5, 1.0), (1.0, 1.0), (0.0, 1.0)] {
        let found = between(&bar, min, max);
        assert_eq!(found.len(), 1, "{min} {max}");
        assert_eq!(ends(&found[0]), [(Point::new(0.5, 0.5), 1.0), (Point::new(8.5, 0.5), 1.0)]);
        let even = Widths { least: 1.0, greatest: 1.0, mean: 1.0 };
        assert_eq!((found[0].length(), found[0].widths()), (8.0, even));
    }
    assert_eq!(between(&bar, 1.0_f64.next_up(), 2.0), []);
    assert_eq!(between(&bar, 0.5, 1.0_f64.next_down()), []);
    // The corners are there if they are asked for.
    let all = walls(&bar, &WallOptions { min: 0.0, max: 1.0, ends: 0.0 });
    assert_eq!(all.len(), 5);
    let Widths { least, greatest, .. } = all[0].widths();
    assert_eq!([least, greatest], [0.0, 1.0]);
}

#[test]
fn a_small_square_is_a_point_and_the_corners_of_a_large_one_are_nothing() {
    let square = shapes::wkt("POLYGON ((0 0, 1 0, 1 1, 0 1, 0 0))");
    let found = between(&square, 0.2, 1.0);
    assert_eq!(found.len(), 1);
    assert_eq!(found[0].polyline(0.1), [(Point::new(0.5, 0.5), 1.0)]);
    assert!(!found[0].is_closed());
    assert_eq!(between(&square, 0.2, 0.9), []);
}

#[test]
fn a_frame_is_a_closed_wall() {
    let frame = shapes::wkt("POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (1 1, 1 8, 8 8, 8 1, 1 1))");
    let found = between(&frame, 0.5, 1.5);
    assert_eq!(found.len(), 1);
    assert!(found[0].is_closed());
    let by_hand = 4.0 * 8.0;
    assert!(found[0].length() < by_hand && found[0].length() > by_hand - 2.0);
}

/// A stroke of some length and of width 2 with round caps of so many segments for a quarter.
fn stroke(length: f64, n: u32) -> Domain {
    let cap = |centre: f64, start: f64| {
        (0..=2 * n).map(move |k| {
            let angle = start + f64::from(k) / f64::from(2 * n) * std::f64::consts::PI;
            Point::new(centre + angle.cos(), angle.sin())
        })
    };
    let quarter = std::f64::consts::FRAC_PI_2;
    let ring = cap(length, -quarter).chain(cap(0.0, quarter)).collect();
    Domain::from_polygons(&[vec![ring]], &domain::Options::default()).unwrap()
}

#[test]
fn a_stroke_with_round_caps_is_one_wall() {
    for n in [2, 4, 16, 64] {
        for length in [0.3, 3.0, 40.0] {
            let found = between(&stroke(length, n), 0.5, 3.0);
            assert_eq!(found.len(), 1, "{n} {length} {found:?}");
            assert!((found[0].length() - length).abs() < 0.2 + 0.5 * length.min(1.0));
        }
    }
}

#[test]
fn a_limit_at_the_width_of_a_keypoint_is_decided_there() {
    // A passage of width 2 between two rooms, open to both by reflex corners.
    let level = shapes::wkt(
        "POLYGON ((0 0, 3 0, 3 2, 7 2, 7 0, 10 0, 10 6, 7 6, 7 4, 3 4, 3 6, 0 6, 0 0))",
    );
    for max in [2.0_f64.next_down(), 2.0, 2.0_f64.next_up(), 2.1] {
        let found = between(&level, 0.5, max);
        let expected = usize::from(max >= 2.0);
        assert_eq!(found.len(), expected, "{max} {found:?}");
        assert!(found.iter().all(|wall| wall.length() > 3.9));
    }
}

#[test]
fn a_spike_is_a_wall_as_far_as_it_is_wide_enough() {
    // A triangle 20 long and 2 wide.
    let spike = shapes::wkt("POLYGON ((0 0, 20 1, 0 2, 0 0))");
    let found = between(&spike, 0.5, 1.0);
    assert_eq!(found.len(), 1);
    let [(thick, wide), (thin, narrow)] = ends(&found[0]);
    assert!((wide - 1.0).abs() < 1e-14 && (narrow - 0.5).abs() < 1e-14);
    assert!((thin.x - thick.x) > 4.9 && thick.y == 1.0);
    // A neck of a longer shape gets too narrow to fill: two walls lead up to it.
    let neck = shapes::wkt("POLYGON ((0 0, 20 1, 40 0, 40 2.2, 20 1.2, 0 2.2, 0 0))");
    assert_eq!(between(&neck, 0.5, 1.0).len(), 2);
    assert_eq!(between(&neck, 0.1, 1.0).len(), 1);
}

#[test]
fn limits_in_the_wrong_order_are_told() {
    let bar = shapes::wkt("POLYGON ((0 0, 9 0, 9 1, 0 1, 0 0))");
    let axis = path_tracing(&bar).unwrap();
    for (min, max) in [(2.0, 1.0), (-1.0, 1.0), (0.0, f64::INFINITY), (f64::NAN, 1.0)] {
        let error = thin_walls(&bar, &axis, &WallOptions::between(min, max)).unwrap_err();
        assert!(matches!(error, WallError::Range { .. }), "{error}");
    }
}

#[test]
fn with_all_ends_they_are_all_of_the_axis_between_the_widths() {
    let mut random = Random(71);
    let mut n = 0;
    while n < 400 {
        let family = [Family::Tangle, Family::Holes, Family::Hung, Family::Triangles][n % 4];
        let ground = if n % 3 == 0 { Ground::Grid(6) } else { Ground::Square };
        let polygons = random::shape(&mut random, family, ground);
        let Ok(domain) = Domain::from_polygons(&polygons, &domain::Options::default()) else {
            continue;
        };
        let axis = path_tracing(&domain).unwrap();
        n += 1;
        let most = 2.0 * axis.radius_max();
        let (min, max) = (most * 0.6 * random.unit(), most * (0.6 + 0.5 * random.unit()));
        let found = walls(&domain, &WallOptions { min, max, ends: 0.0 });
        // The length of the axis between both widths, by many short pieces.
        let mut by_pieces = 0.0;
        for path in axis.paths() {
            let curve = axis.curve(&path);
            let length = curve.length();
            const N: u32 = 400;
            for k in 0..N {
                let width = 2.0 * curve.radius_at((f64::from(k) + 0.5) / f64::from(N));
                if (min..=max).contains(&width) {
                    let at = |k: u32| curve.point_at(f64::from(k) / f64::from(N));
                    by_pieces += (at(k + 1) - at(k)).norm().min(length);
                }
            }
        }
        let sum: f64 = found.iter().map(Wall::length).sum();
        let size: f64 = axis.paths().iter().map(|p| axis.curve(&p).length()).sum();
        assert!((sum - by_pieces).abs() < 0.02 * size, "{sum} {by_pieces} {size}");
        for wall in &found {
            let Widths { least, greatest, .. } = wall.widths();
            assert!(least >= min * (1.0 - 1e-9) && greatest <= max * (1.0 + 1e-9));
            for pair in wall.curves.windows(2) {
                assert_eq!(pair[0].to(), pair[1].from());
            }
        }
        // Fewer with loose ends left out, and no wall that is nothing.
        let default = walls(&domain, &WallOptions::between(min, max));
        assert!(default.iter().map(Wall::length).sum::<f64>() <= sum * (1.0 + 1e-12));
    }
}
