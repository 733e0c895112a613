//! Shapes whose axis is known by hand.

mod support;

use medial::axis::{KeypointKind, MedialAxis, SiteKind};
use medial::check;
use medial::domain::{Domain, Options};
use medial::engine::path_tracing;
use medial::geom::Point;

fn axis(rings: &[&[(f64, f64)]]) -> MedialAxis {
    let rings: Vec<Vec<Point>> =
        rings.iter().map(|r| r.iter().map(|&(x, y)| Point::new(x, y)).collect()).collect();
    certified(&Domain::from_polygons(&[rings], &Options::default()).unwrap())
}

fn shape(name: &str) -> MedialAxis {
    certified(&support::shapes::domain(name))
}

fn certified(domain: &Domain) -> MedialAxis {
    let axis = path_tracing(domain).unwrap();
    let defects = check::defects(domain, &axis).defects;
    assert!(defects.is_empty(), "{defects:?}");
    axis
}

/// Ends, transitions, junctions.
fn kinds(axis: &MedialAxis) -> [usize; 3] {
    [KeypointKind::End, KeypointKind::Transition, KeypointKind::Junction]
        .map(|kind| axis.keypoints().iter().filter(|k| k.kind == kind).count())
}

/// Paths between two edges, between an edge and a corner, between two corners.
fn curves(axis: &MedialAxis) -> [usize; 3] {
    let mut count = [0; 3];
    for path in axis.paths() {
        let corners = [path.left, path.right]
            .iter()
            .filter(|&&g| axis.sites().at(g).kind == SiteKind::Vertex)
            .count();
        count[corners] += 1;
    }
    count
}

/// Cycles of the graph, for an axis of one component.
fn cycles(axis: &MedialAxis) -> usize {
    axis.paths().len() + 1 - axis.keypoints().len()
}

/// The number of paths that meet at a keypoint.
fn degree(axis: &MedialAxis, x: f64, y: f64) -> usize {
    let at = axis.keypoints().iter().position(|k| k.position == Point::new(x, y)).unwrap() as u32;
    axis.paths().iter().map(|p| usize::from(p.from == at) + usize::from(p.to == at)).sum()
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

#[test]
fn t_has_one_transition_for_two_corners() {
    let a = shape("t_of_unit_bars");
    let found = inner(&a);
    assert_eq!(found.len(), 7, "{found:?}");
    assert!(found.contains(&(1.5, 1.375, 0.625, 3)), "{found:?}");
    assert!(found.contains(&(1.5, 1.0, 0.5, 4)), "{found:?}");
    assert_eq!(found.iter().map(|k| k.3 - 2).sum::<usize>(), 8);
    assert_eq!(degree(&a, 1.5, 1.0), 2);
}

#[test]
fn comb_with_three_teeth_has_all_three_kinds_of_paths() {
    let a = shape("comb_with_three_unit_teeth");
    assert_eq!(kinds(&a), [8, 7, 6]);
    assert_eq!(curves(&a), [13, 6, 1]);
}

#[test]
fn two_facing_corners_make_a_neck() {
    let a = shape("two_reflex_corners_facing_at_a_neck");
    // √5 - 1, correctly rounded.
    let r = 1.236_067_977_499_789_8;
    let junctions: Vec<f64> = a
        .keypoints()
        .iter()
        .filter(|k| k.kind == KeypointKind::Junction)
        .map(|k| k.radius)
        .collect();
    assert_eq!(junctions, [r, r]);
    assert_eq!(curves(&a)[2], 1, "one path between the two corners, through (2, 2)");
}

#[test]
fn corners_on_one_circle_meet_in_one_keypoint() {
    for (name, corners) in
        [("star_with_12_corners_on_one_circle", 12), ("star_with_108_corners_on_one_circle", 108)]
    {
        let a = shape(name);
        let degree = (0..a.keypoints().len() as u32).map(|k| a.governors(k).len()).max();
        assert_eq!(degree, Some(corners), "{name}");
    }
}

#[test]
fn a_polygon_around_one_circle_has_one_inner_keypoint() {
    let a = shape("twelve_sides_around_one_circle");
    let found = inner(&a);
    assert_eq!((found.len(), found[0].3), (1, 12), "{found:?}");
}

#[test]
fn an_octagon_of_two_side_lengths_has_a_centre_of_degree_four() {
    // An octagon with corners (±2, ±1), (±1, ±2): its eight sides touch two circles.
    let a = axis(&[&[
        (2.0, -1.0),
        (2.0, 1.0),
        (1.0, 2.0),
        (-1.0, 2.0),
        (-2.0, 1.0),
        (-2.0, -1.0),
        (-1.0, -2.0),
        (1.0, -2.0),
    ]]);
    // The axis-parallel sides are at distance 2, the oblique ones at 3/√2 > 2: one keypoint
    // where four sides meet, and four where an oblique side gives way.
    assert_eq!(degree(&a, 0.0, 0.0), 4);
    assert_eq!(inner(&a).len(), 5);
}

#[test]
fn a_corridor_has_a_plateau_only_if_its_walls_are_parallel() {
    let level = axis(&[&[(0.0, 0.0), (10.0, 0.0), (10.0, 1.0), (0.0, 1.0)]]);
    assert_eq!(inner(&level), [(0.5, 0.5, 0.5, 3), (9.5, 0.5, 0.5, 3)]);
    for ulps in [1, 2, 45] {
        let a = shape(&format!("corridor_tilted_by_{ulps}_ulp"));
        let found = inner(&a);
        // The far disk is larger by about half the tilt: one rounding tells, or none.
        assert_eq!(found.len(), 2);
        assert!(found[1].2 >= found[0].2, "{found:?}");
    }
    assert!({
        let found = inner(&shape("corridor_tilted_by_45_ulp"));
        found[1].2 > found[0].2
    });
}

#[test]
fn holes_that_touch_make_no_cycle_of_their_own() {
    for (name, cycles_expected) in [
        ("hole_touching_the_outer_ring_at_a_corner", 0),
        ("hole_touching_an_edge", 0),
        ("two_touching_holes", 1),
        ("square_ring_6_around_2", 1),
        ("lattice_of_four_square_holes", 4),
    ] {
        assert_eq!(cycles(&shape(name)), cycles_expected, "{name}");
    }
}

#[test]
fn three_governors_in_opposite_order_govern_two_keypoints() {
    let a = shape("two_keypoints_with_three_governors_in_opposite_order");
    let near = |x: f64, y: f64| {
        a.keypoints()
            .iter()
            .any(|k| (k.position.x - x).abs() < 1e-4 && (k.position.y - y).abs() < 1e-4)
    };
    assert!(near(0.1623, 1.1754) && near(-6.1623, 13.8246));
}

#[test]
fn one_ulp_moves_only_the_keypoints_it_touches() {
    // A square has one junction of degree four; a corner moved by one ulp splits it in two.
    let a = axis(&[&[(0.0, 0.0), (2.0, 0.0), (2.0, 2.0_f64.next_up()), (0.0, 2.0)]]);
    assert_eq!(kinds(&a), [4, 0, 2]);
    let a = axis(&[&[(0.0, 0.0), (2.0, 0.0), (2.0, 2.0_f64.next_down()), (0.0, 2.0)]]);
    assert_eq!(kinds(&a), [4, 0, 2]);
}
