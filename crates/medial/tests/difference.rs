//! The comparison of two axes, on equal ones and on planted differences.

mod support;

use medial::axis::KeypointKind;
use medial::check::{Difference, difference};
use medial::domain::Domain;
use medial::engine::{divide_and_conquer, path_tracing};
use support::parts::{Keypoint, Parts};
use support::{brute_force, compare, shapes};

/// The axis of a shape, taken apart, and how a change of it differs from it.
fn changed(name: &str, change: impl FnOnce(&mut Parts)) -> Difference {
    let axis = path_tracing(&shapes::domain(name)).unwrap();
    let mut parts = Parts::of(&axis);
    change(&mut parts);
    difference(&axis, &parts.axis())
}

#[test]
fn exact_engines_do_not_differ_on_any_shape() {
    for name in shapes::names() {
        let domain = shapes::domain(&name);
        let axis = path_tracing(&domain).unwrap();
        assert_eq!(difference(&axis, &axis), Difference::default(), "{name}");
        for other in [divide_and_conquer(&domain).unwrap(), by_triples(&domain, &axis)] {
            let found = difference(&axis, &other);
            assert!(found.is_same_graph(), "{name}: {found:?}");
            assert!(compare::differences(&axis, &other).is_empty());
            let size = axis.bounds().map_or(0.0, |(low, high)| (high - low).norm() + low.norm());
            // Each is within 4 units in the last place.
            let most = 16.0 * f64::EPSILON * size;
            let Difference { position, radius, distance, missed, .. } = found;
            assert!(
                [position, radius, distance, missed].iter().all(|far| *far <= most),
                "{name}: {found:?}"
            );
        }
    }
}

/// The axis of all triples; of shapes too large for that the given one.
fn by_triples(domain: &Domain, axis: &medial::axis::MedialAxis) -> medial::axis::MedialAxis {
    if domain.edges().len() > 40 { axis.clone() } else { brute_force::axis(domain) }
}

#[test]
fn a_moved_keypoint_is_as_far_off_as_it_was_moved() {
    // The end of the spine of a rectangle, a quarter up and longer by an eighth.
    let found = changed("rectangle_5_by_2", |parts| {
        let k = parts.at(4.0, 1.0);
        parts.keypoints[k].position.y += 0.25;
        parts.keypoints[k].radius += 0.125;
    });
    assert!(found.is_same_graph());
    assert_eq!((found.position, found.radius), (0.25, 0.125));
    // Three quarters along the spine it is off by 0.1875 upwards; nearer to the end the diagonals
    // are nearer. The other way round the same point is seen along a normal of (12, 1).
    assert_eq!(found.distance, 0.1875);
    assert!((found.missed - 0.1875 * 12.0 / 145.0_f64.sqrt()).abs() < 1e-15, "{found:?}");
}

#[test]
fn a_lost_path_is_missing_and_missed() {
    let found = changed("rectangle_5_by_2", |parts| {
        let spine = parts.between(parts.at(1.0, 1.0), parts.at(4.0, 1.0));
        parts.paths.remove(spine);
    });
    let Difference { missing_paths, extra_paths, distance, missed, .. } = found;
    assert_eq!((missing_paths, extra_paths, distance), (1, 0, 0.0));
    // The middle of the spine is 1.5 from either end.
    assert_eq!(missed, 1.5);
    assert!(!found.is_same_graph());
}

#[test]
fn paths_may_be_told_from_either_end_and_in_any_order() {
    let found = changed("comb_with_three_unit_teeth", |parts| {
        for path in &mut parts.paths {
            std::mem::swap(&mut path.from, &mut path.to);
            std::mem::swap(&mut path.left, &mut path.right);
        }
        parts.paths.reverse();
    });
    assert!(found.is_same_graph());
    assert_eq!(found.position, 0.0);
}

#[test]
fn another_governor_makes_another_keypoint_and_another_path() {
    let found = changed("triangle_3_4_5", |parts| parts.keypoints[0].governors.reverse());
    // Two governors in the other order are the same cyclic list.
    assert!(found.is_same_graph());
    let found = changed("triangle_3_4_5", |parts| {
        let k = parts.at(1.0, 1.0);
        parts.keypoints[k].governors.reverse();
    });
    assert_eq!((found.missing_keypoints, found.extra_keypoints), (1, 1));
    assert_eq!((found.missing_paths, found.extra_paths), (3, 3));
    // They lie where they lay.
    assert!(found.distance < 1e-15 && found.missed < 1e-15, "{found:?}");
}

#[test]
fn a_keypoint_given_twice_is_one_more() {
    let found = changed("triangle_3_4_5", |parts| {
        let k = parts.at(1.0, 1.0);
        let copy = parts.keypoints[k].clone();
        parts.keypoints.push(copy);
    });
    assert_eq!((found.missing_keypoints, found.extra_keypoints), (0, 1));
}

#[test]
fn a_single_keypoint_is_an_axis_too() {
    let found = changed("triangle_3_4_5", |parts| {
        let centre = parts.keypoints[parts.at(1.0, 1.0)].clone();
        parts.keypoints = vec![Keypoint { kind: KeypointKind::Junction, ..centre }];
        parts.paths.clear();
        parts.complete = false;
    });
    assert_eq!((found.missing_keypoints, found.missing_paths), (3, 3));
    // The corner (4, 0) is the farthest from (1, 1).
    assert_eq!((found.distance, found.missed), (0.0, 10.0_f64.sqrt()));
}

#[test]
fn what_is_not_a_number_is_infinitely_far() {
    let found = changed("triangle_3_4_5", |parts| parts.keypoints[0].position.x = f64::NAN);
    assert_eq!((found.position, found.distance), (f64::INFINITY, f64::INFINITY));
}

#[test]
fn an_empty_reference_is_infinitely_far() {
    let axis = path_tracing(&shapes::domain("triangle_3_4_5")).unwrap();
    let mut empty = Parts::of(&axis);
    empty.keypoints.clear();
    empty.paths.clear();
    let empty = empty.axis();
    assert_eq!(difference(&empty, &axis).distance, f64::INFINITY);
    assert_eq!(difference(&axis, &empty).missed, f64::INFINITY);
    assert_eq!(difference(&empty, &empty), Difference::default());
}
