use medial::domain::{Domain, DomainError, NestingFault, Options};
use medial::geom::Point;

use crate::shapes::{REGROUP, STRICT, error, rings, strict_error};

#[test]
fn a_coordinate_that_is_not_finite_names_its_vertex() {
    for bad in ["NaN", "inf", "-inf"] {
        let e = error(&format!("0 0 9 0 9 9 0 9 / 1 1 2 1 2 {bad}"));
        assert_eq!((e.code(), e.ring(), e.index()), ("not_finite", Some(1), Some(2)));
    }
    let e = error("0 0 1 0 0 NaN");
    assert_eq!(
        e.to_string(),
        "ring 0, vertex 2: coordinate (0, NaN) is not finite; remove the vertex"
    );
}

#[test]
fn exponents_end_at_two_hundred() {
    let (least, largest) = (2f64.powi(-200), 2f64.powi(200));
    let triangle =
        |v: f64| vec![vec![vec![Point::new(0.0, 0.0), Point::new(v, 0.0), Point::new(0.0, v)]]];
    let build = |v| Domain::from_polygons(&triangle(v), &Options::default());
    for good in [least, largest, -largest, -least] {
        assert!(build(good).is_ok());
    }
    for bad in [least.next_down(), largest.next_up(), 5e-324] {
        assert_eq!(build(bad).map_err(|e| e.code()).err(), Some("exponent_out_of_range"));
    }
}

#[test]
fn an_outer_ring_without_area_is_refused() {
    assert_eq!(error("").code(), "empty");
    assert_eq!(error("0 0 1 1 0 0").code(), "too_few_points");
    assert_eq!(error("0 0 1 1 0 0 1 1").code(), "too_few_points");
    assert_eq!(error("0 0 1 1 2 2").code(), "collinear");
    assert_eq!(error("0 0 1 0 1 1 1 0").code(), "collinear");
    let none = Domain::from_polygons(&[], &Options::default());
    assert_eq!(none.map_err(|e| e.code()).err(), Some("empty"));
    let no_ring = Domain::from_polygons(&[vec![]], &Options::default());
    assert_eq!(no_ring.map_err(|e| e.code()).err(), Some("empty"));
}

#[test]
fn a_hole_equal_to_the_outer_ring_leaves_nothing() {
    assert_eq!(error("0 0 4 0 4 4 0 4 / 0 0 4 0 4 4 0 4").code(), "empty");
}

#[test]
fn crossing_edges_are_both_named_with_the_place() {
    let e = error("0 0 4 4 4 0 0 4");
    assert_eq!(
        e.to_string(),
        "ring 0, edge 0: crosses ring 0, edge 2 at (2, 2); repair the polygon"
    );
    // Edge 1 of the hole leaves through the right side, edge 1 of the outer ring.
    let e = error("0 0 4 0 4 4 0 4 / 3 1 3 2 5 2 3.5 1");
    assert_eq!(e.code(), "crossing");
    let (a, b) = (e.place().expect("an edge"), e.other_place().expect("an edge"));
    assert_eq!((a.ring, a.index, b.ring), (0, 1, 1));
    assert_eq!(e.point().map(|p| p.x), Some(4.0));
}

#[test]
fn edges_that_cross_through_one_vertex_are_a_crossing() {
    // The figure of eight has (2,2) as a vertex twice.
    assert_eq!(error("0 0 2 2 4 4 4 0 2 2 0 4").code(), "crossing");
    assert_eq!(error("0 0 2 2 4 5 4 0 2 2 0 4").code(), "crossing");
    // An edge passes through a corner and the ring crosses there.
    assert_eq!(error("0 0 4 0 4 4 0 4 / 1 1 4 2 5 3 1 2").code(), "crossing");
}

#[test]
fn partly_overlapping_edges_are_named() {
    let e = error("0 0 4 0 4 4 0 4 / 1 0 1 2 3 2 3 0");
    assert_eq!(
        e.to_string(),
        "ring 0, edge 0: lies partly on ring 1, edge 3 near (1, 0); repair the polygon"
    );
}

#[test]
fn an_edge_run_twice_the_same_way_is_an_overlap() {
    // A loop attached outside runs along (0,0)-(4,0) again.
    let e = error("0 0 4 0 4 -1 5 -1 5 5 -1 5 -1 -1 0 -1 0 0 4 0 4 4 0 4");
    assert_eq!(e.code(), "overlap");
    // Duplicate holes run the same way.
    let e = error("0 0 9 0 9 9 0 9 / 1 1 2 1 1 2 / 1 1 2 1 1 2");
    assert_eq!((e.code(), e.ring()), ("overlap", Some(1)));
}

#[test]
fn wrong_nesting_names_ring_and_fault() {
    let cases = [
        ("0 0 4 0 4 4 0 4 / 5 0 6 0 6 1", NestingFault::HoleOutside, 1, 0),
        ("2 2 4 2 4 4 2 4 / 0 0 1 0 1 1", NestingFault::HoleOutside, 1, 0),
        ("0 0 9 0 9 9 0 9 / 1 1 8 1 8 8 1 8 / 2 2 3 2 3 3", NestingFault::HoleInHole, 2, 1),
        ("3 3 4 3 4 4 3 4 / 0 0 9 0 9 9 0 9", NestingFault::OuterInHole, 0, 1),
        // Touching the outer ring from outside at a corner.
        ("0 0 4 0 4 4 0 4 / 4 4 8 5 5 8", NestingFault::HoleOutside, 1, 0),
        // Touching an inside edge of another hole.
        ("0 0 9 0 9 9 0 9 / 1 1 8 1 8 8 1 8 / 4 1 5 3 3 3", NestingFault::HoleInHole, 2, 1),
    ];
    for (text, fault, ring, other) in cases {
        match error(text) {
            DomainError::BadNesting { ring: r, fault: f, other: o } => {
                assert_eq!((f, r.ring, o.ring), (fault, ring, other), "{text}");
            }
            e => panic!("{text}: {e}"),
        }
    }
    assert_eq!(
        error("0 0 4 0 4 4 0 4 / 5 0 6 0 6 1").to_string(),
        "ring 1: a hole outside ring 0; reorder the rings or regroup them by depth"
    );
}

#[test]
fn overlapping_polygons_are_both_named() {
    let square = rings("0 0 4 0 4 4 0 4");
    for other in [
        "1 1 2 1 2 2 1 2",
        "2 2 6 2 6 6 2 6",
        "0 0 4 0 4 4 0 4",
        "0 0 2 0 2 2 0 2",
        "-1 -1 9 -1 9 9 -1 9",
        "2 0 4 2 2 4 0 2",
        "0 0 8 0 8 4 0 4",
        "4 0 4 4 0 2",
    ] {
        for pair in [[square.clone(), rings(other)], [rings(other), square.clone()]] {
            let e = Domain::from_polygons(&pair, &Options::default()).expect_err(other);
            assert_eq!(e.code(), "polygons_overlap", "{other}");
            let both = (e.place().map(|p| p.polygon), e.other_place().map(|p| p.polygon));
            assert_eq!(both, (Some(0), Some(1)), "{other}");
        }
    }
}

#[test]
fn strictness_refuses_what_is_repaired_otherwise() {
    for (text, code) in [
        ("0 0 4 0 6 0 4 0 4 4 0 4", "spike"),
        ("0 0 9 0 9 9 0 9 / 1 1 2 2 3 3", "collinear"),
        ("0 0 4 0 4 4 0 4 0 0 1 1 1 2 2 1 1 1", "bridge"),
        ("0 0 2 2 4 0 4 4 2 2 0 4", "self_touch"),
        ("0 0 4 0 4 4 3 4 2 0 1 4 0 4", "self_touch"),
        ("0 0 4 0 4 4 0 4 / 0 2 2 3 4 2 2 1", "cut_interior"),
        ("0 0 1 0 3 0 4 0 4 4 0 4 / 1 0 1 2 3 2 3 0", "overlap"),
    ] {
        let e = strict_error(text);
        assert_eq!(e.code(), if code == "overlap" { "bridge" } else { code }, "{text}");
    }
}

#[test]
fn strictness_accepts_repeats_straight_corners_and_directions() {
    let text = "0 0 0 4 0 4 4 4 4 2 4 0 / 1 1 2 1 2 2 / 4 2 3 2 3 3";
    assert!(Domain::from_polygons(&[rings(text)], &STRICT).is_ok());
}

#[test]
fn messages_of_features_with_several_polygons_name_the_polygon() {
    let polygons = [rings("0 0 1 0 0 1"), rings("5 5 9 9 9 5 5 9")];
    let e = Domain::from_polygons(&polygons, &Options::default()).expect_err("crosses");
    assert_eq!(
        e.to_string(),
        "polygon 1, ring 0, edge 0: crosses polygon 1, ring 0, edge 2 at (7, 7); repair the polygon"
    );
}

#[test]
fn more_than_two_polygons_on_one_edge_are_refused_when_regrouped_too() {
    let polygons =
        [rings("0 0 4 0 2 1"), rings("0 0 4 0 2 2"), rings("0 0 4 0 2 3"), rings("0 0 4 0 2 -1")];
    for options in [Options::default(), REGROUP] {
        let e = Domain::from_polygons(&polygons, &options).expect_err("overlap");
        assert_eq!(e.code(), "polygons_overlap");
    }
}
