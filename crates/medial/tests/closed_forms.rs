//! Shapes whose axis is known by hand.

use medial::axis::{KeypointKind, MedialAxis};
use medial::domain::{Domain, Options};
use medial::engine::path_tracing;
use medial::geom::Point;

fn axis(rings: &[&[(f64, f64)]]) -> MedialAxis {
    let rings: Vec<Vec<Point>> =
        rings.iter().map(|r| r.iter().map(|&(x, y)| Point::new(x, y)).collect()).collect();
    let domain = Domain::from_polygons(&[rings], &Options::default()).unwrap();
    path_tracing(&domain).unwrap()
}

/// Keypoints that are no ends: x, y, radius and number of governors, sorted.
fn inner(axis: &MedialAxis) -> Vec<(f64, f64, f64, usize)> {
    let mut list: Vec<_> = (0_u32..)
        .zip(axis.keypoints())
        .filter(|(_, k)| k.kind != KeypointKind::End)
        .map(|(n, k)| (k.position.x, k.position.y, k.radius, axis.governors(n).len()))
        .collect();
    list.sort_by(|a, b| a.partial_cmp(b).unwrap());
    list
}

#[test]
fn three_four_five_triangle_has_one_junction() {
    let a = axis(&[&[(0.0, 0.0), (4.0, 0.0), (0.0, 3.0)]]);
    assert_eq!(inner(&a), [(1.0, 1.0, 1.0, 3)]);
    assert_eq!(a.paths().len(), 3);
}

#[test]
fn rectangle_has_a_plateau() {
    let a = axis(&[&[(0.0, 0.0), (5.0, 0.0), (5.0, 2.0), (0.0, 2.0)]]);
    assert_eq!(inner(&a), [(1.0, 1.0, 1.0, 3), (4.0, 1.0, 1.0, 3)]);
    assert_eq!(a.paths().len(), 5);
}

#[test]
fn square_has_one_junction_of_degree_four() {
    let a = axis(&[&[(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)]]);
    assert_eq!(inner(&a), [(1.0, 1.0, 1.0, 4)]);
}

#[test]
fn l_shape_bends_around_its_corner() {
    let a = axis(&[&[(0.0, 0.0), (3.0, 0.0), (3.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0)]]);
    // 2 - √2, correctly rounded.
    let q = 0.585_786_437_626_905;
    assert_eq!(
        inner(&a),
        [
            (0.5, 1.0, 0.5, 3),
            (0.5, 2.5, 0.5, 3),
            (q, q, q, 3),
            (1.0, 0.5, 0.5, 3),
            (2.5, 0.5, 0.5, 3)
        ]
    );
}

#[test]
fn square_ring_has_one_cycle() {
    let a = axis(&[
        &[(0.0, 0.0), (6.0, 0.0), (6.0, 6.0), (0.0, 6.0)],
        &[(2.0, 2.0), (2.0, 4.0), (4.0, 4.0), (4.0, 2.0)],
    ]);
    // 4 - 2√2, correctly rounded.
    let q = 1.171_572_875_253_81;
    let found = inner(&a);
    assert_eq!(found.len(), 12);
    assert!(found.contains(&(q, q, q, 3)), "{found:?}");
    assert_eq!(a.paths().len(), a.keypoints().len());
}

#[test]
fn plus_has_its_centre_between_four_corners() {
    let a = axis(&[&[
        (1.0, 0.0),
        (2.0, 0.0),
        (2.0, 1.0),
        (3.0, 1.0),
        (3.0, 2.0),
        (2.0, 2.0),
        (2.0, 3.0),
        (1.0, 3.0),
        (1.0, 2.0),
        (0.0, 2.0),
        (0.0, 1.0),
        (1.0, 1.0),
    ]]);
    let found = inner(&a);
    assert_eq!(found.len(), 9, "{found:?}");
    assert!(found.contains(&(1.5, 1.5, 0.5_f64.sqrt(), 4)));
}
