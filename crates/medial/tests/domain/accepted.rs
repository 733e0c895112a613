use medial::domain::{Domain, Options, Repair};
use medial::geom::Point;

use crate::shapes::{REGROUP, STRICT, corners, domain, origins, repairs, rings, walks};

#[test]
fn a_triangle_is_one_walk_and_needs_no_repair() {
    let d = domain("0 0 4 0 0 3");
    assert_eq!(walks(&d), ["0 0) 4 0) 0 3)"]);
    assert_eq!(d.n_components(), 1);
    assert_eq!(d.area(), 6.0);
    assert!(d.report().entries().is_empty());
    assert_eq!(d.edge(1).length, 5.0);
    assert_eq!(d.edge(1).direction, Point::new(-0.8, 0.6));
    assert_eq!(d.edge(2).direction, Point::new(0.0, -1.0));
}

#[test]
fn closing_points_are_no_repair_and_repeated_points_are_dropped() {
    let d = domain("0 0 4 0 4 0 0 3 0 0 0 0");
    assert_eq!(origins(&d), ["0.0.0", "0.1.0", "0.3.0"]);
    assert_eq!(repairs(&d), ["repeated_point 0:2,4"]);
}

#[test]
fn a_clockwise_outer_ring_is_reversed_and_keeps_its_numbers() {
    let d = domain("0 0 0 3 4 0");
    assert_eq!(walks(&d), ["0 3) 0 0) 4 0)"]);
    assert_eq!(origins(&d), ["0.0.0", "0.2.0", "0.1.0"]);
    assert_eq!(corners(&d), ["0.1.0", "0.0.0", "0.2.0"]);
    assert_eq!(repairs(&d), ["reversed 0:"]);
}

#[test]
fn a_counterclockwise_hole_is_reversed() {
    let d = domain("0 0 9 0 9 9 0 9 / 1 1 2 1 1 2");
    assert_eq!(walks(&d), ["0 0) 9 0) 9 9) 0 9)", "hole 2 1( 1 1( 1 2("]);
    assert_eq!(repairs(&d), ["reversed 1:"]);
    assert_eq!(d.area(), 80.5);
    assert_eq!(d.signed_area(1), -0.5);
}

#[test]
fn straight_corners_are_merged_over_the_start_of_the_ring() {
    // Vertex 5 begins the run 5, 0, 1, and vertex 1 the run 1, 2, 3.
    let d = domain("1 0 4 0 4 1 4 2 0 2 0 0");
    assert_eq!(walks(&d), ["4 0) 4 2) 0 2) 0 0)"]);
    assert_eq!(origins(&d), ["0.1.0", "0.3.0", "0.4.0", "0.5.0"]);
    assert_eq!(repairs(&d), ["straight_corner 0:0,2"]);
}

#[test]
fn merging_may_uncover_spikes_and_spikes_straight_corners() {
    // 4,0 -> 9,0 -> 7,0 -> 8,0 -> 6,0 -> 4,0 folds up; then 4,0 is a repeated point.
    let d = domain("0 0 4 0 9 0 7 0 8 0 6 0 4 0 4 4 0 4");
    assert_eq!(walks(&d), ["0 0) 4 0) 4 4) 0 4)"]);
    assert_eq!(d.report().count(Repair::Spike), 3);
    assert!(Domain::from_polygons(&[rings("0 0 4 0 4 4 0 4")], &STRICT).is_ok());
}

#[test]
fn a_spike_over_the_start_of_the_ring_is_removed() {
    let d = domain("9 9 4 4 0 4 0 0 4 0 4 4");
    assert_eq!(walks(&d), ["4 4) 0 4) 0 0) 4 0)"]);
    assert_eq!(repairs(&d), ["repeated_point 0:5", "spike 0:0"]);
}

#[test]
fn a_tree_of_spikes_folds_up() {
    // A stem to (8,4) with two twigs.
    let d = domain("0 0 4 0 4 4 6 4 6 9 6 4 8 4 8 9 8 4 4 4 0 4");
    assert_eq!(walks(&d), ["0 0) 4 0) 4 4) 0 4)"]);
}

#[test]
fn a_degenerate_hole_is_dropped_with_a_warning() {
    let d = domain("0 0 9 0 9 9 0 9 / 1 1 2 2 / 1 1 2 2 3 3 / 4 4 4 4 4 4");
    assert_eq!(d.walks().len(), 1);
    assert_eq!(repairs(&d), ["degenerate_hole 1:", "degenerate_hole 2:", "degenerate_hole 3:"]);
}

#[test]
fn a_hole_touching_the_outer_ring_at_a_corner_makes_one_walk() {
    let text = "0 0 4 0 4 4 0 4 / 0 0 1 2 2 1";
    let d = domain(text);
    assert_eq!(walks(&d), ["0 0) 4 0) 4 4) 0 4) 0 0) 1 2( 2 1("]);
    assert_eq!(origins(&d), ["0.0.0", "0.1.0", "0.2.0", "0.3.0", "1.0.0", "1.1.0", "1.2.0"]);
    // The wedge above the hole is named by the outer edge that comes in.
    assert_eq!(corners(&d)[4], "0.0.0");
    assert_eq!(corners(&d)[0], "1.0.0");
    assert_eq!(d.n_components(), 1);
    assert!(Domain::from_polygons(&[rings(text)], &STRICT).is_ok());
}

#[test]
fn a_corner_on_an_edge_splits_it() {
    let d = domain("0 0 4 0 4 4 0 4 / 2 0 1 1 3 1");
    assert_eq!(walks(&d), ["0 0) 2 0) 1 1( 3 1( 2 0) 4 0) 4 4) 0 4)"]);
    let o = origins(&d);
    assert_eq!((&o[0][..], &o[4][..]), ("0.0.0", "0.0.1"));
    // At the touch: the first wedge comes in along the outer edge, the second along the hole.
    assert_eq!(corners(&d)[1], "0.0.1");
    assert_eq!(corners(&d)[4], "1.0.0");
    assert_eq!(repairs(&d), ["split_edge 0:0"]);
    assert_eq!(d.line(0), d.line(4));
    assert_ne!(d.line(0), d.line(2));
}

#[test]
fn parts_and_touches_count_in_input_direction() {
    // The same ring given clockwise: its edge 3 runs from (4,0) to (0,0), touched at 3 and at 1.
    let d = domain("0 0 0 4 4 4 4 0 / 1 0 1 1 2 1 / 3 0 2 2 3 2");
    let lower: Vec<_> = (0..d.edges().len() as u32)
        .filter(|&k| d.edge(k).start.y == 0.0 && d.end(k).y == 0.0)
        .map(|k| (d.edge(k).start.x, d.origin(k)))
        .collect();
    let parts: Vec<_> = lower.iter().map(|(x, o)| (*x, o.index, o.part)).collect();
    assert_eq!(parts.len(), 3);
    for (x, index, part) in parts {
        assert_eq!(
            (index, part),
            (
                3,
                if x == 0.0 {
                    2
                } else if x == 1.0 {
                    1
                } else {
                    0
                }
            )
        );
    }
    let touch = |x: f64| {
        let c = (0..d.edges().len() as u32)
            .find(|&k| {
                d.edge(d.edge(k).prev).start.y == 0.0 && d.edge(k).start == Point::new(x, 0.0)
            })
            .map(|k| d.origin(k).corner);
        c.map(|c| (c.ring, c.index, c.part))
    };
    assert_eq!(touch(3.0), Some((0, 3, 1)));
    assert_eq!(touch(1.0), Some((0, 3, 2)));
}

#[test]
fn a_hole_touching_two_sides_cuts_the_interior() {
    let d = domain("0 0 4 0 4 4 0 4 / 0 2 2 3 4 2 2 1");
    assert_eq!(d.n_components(), 2);
    assert_eq!(d.walks().len(), 2);
    assert_eq!(d.report().count(Repair::CutInterior), 1);
    assert_eq!(d.area(), 12.0);
}

#[test]
fn two_holes_touching_make_one_hole_walk() {
    // They touch at their leftmost points: one wedge there is convex, the other reflex.
    let d = domain("0 0 9 0 9 9 0 9 / 2 4 5 2 5 3 / 2 4 5 5 5 6");
    let w = walks(&d);
    assert_eq!(w.len(), 2);
    assert!(w[1].starts_with("hole "), "{w:?}");
    assert_eq!(d.n_components(), 1);
    assert!(
        Domain::from_polygons(&[rings("0 0 9 0 9 9 0 9 / 2 4 5 2 5 3 / 2 4 5 5 5 6")], &STRICT)
            .is_ok()
    );
}

#[test]
fn a_ring_touching_itself_is_two_parts_with_a_warning() {
    let d = domain("0 0 2 2 4 0 4 4 2 2 0 4");
    assert_eq!(walks(&d), ["0 0) 2 2) 0 4)", "2 2) 4 0) 4 4)"]);
    assert_eq!(repairs(&d), ["self_touch 0:0,3", "cut_interior 0:"]);
}

#[test]
fn a_ring_touching_its_own_edge_encloses_a_hole() {
    // The notch from the top reaches the middle of the bottom edge at one point.
    let d = domain("0 0 4 0 4 4 3 4 2 0 1 4 0 4");
    assert_eq!(d.n_components(), 2);
    assert_eq!(repairs(&d), ["split_edge 0:0", "self_touch 0:0,3", "cut_interior 0:"]);
}

#[test]
fn a_straight_joint_that_arises_from_touching_stays() {
    // Two triangles touch the bottom edge from inside at one point, filling the lower wedges
    // so that left and right pieces of the edge end in convex wedges; the wedge between is convex.
    let d = domain("0 0 4 0 4 4 0 4 / 2 0 1 2 1 1 / 2 0 3 1 3 2");
    let at = |d: &Domain| d.edges().iter().filter(|e| e.start == Point::new(2.0, 0.0)).count();
    assert_eq!(at(&d), 3);
    assert_eq!(d.walks().len(), 1);
}

#[test]
fn a_bridge_makes_a_ring_and_a_hole() {
    // Keyhole: from (0,0) in to the hole's corner (1,1) and back.
    let d = domain("0 0 4 0 4 4 0 4 0 0 1 1 1 2 2 1 1 1");
    assert_eq!(walks(&d), ["0 0) 4 0) 4 4) 0 4)", "hole 1 1( 1 2( 2 1("]);
    assert_eq!(repairs(&d), ["bridge 0:4,8"]);
    assert_eq!(d.n_components(), 1);
}

#[test]
fn a_bridge_that_continues_a_side_needs_its_vertex() {
    // The bridge (2,2)-(2,3) continues the side (2,0)-(2,2), whose vertex (2,2) is straight.
    let d = domain("0 0 2 0 2 2 2 3 1 4 3 4 2 3 2 2 5 2 5 6 0 6");
    assert_eq!(d.n_components(), 1);
    assert_eq!(d.walks().len(), 2);
    assert_eq!(d.report().count(Repair::Bridge), 2);
}

#[test]
fn a_folded_ring_is_repaired_wherever_it_starts() {
    // The way to (36,40) and back comes after the spike to (37,40), or before it.
    let mut polygon =
        rings("0 0 99 0 99 99 0 99 / 50 20 20 50 38 40 36 40 37 40 36 40 50 20 37 40 38 40");
    for _ in 0..2 {
        for _ in 0..polygon[1].len() {
            polygon[1].rotate_left(1);
            let d = Domain::from_polygons(&[polygon.clone()], &Options::default())
                .expect("a valid polygon");
            assert_eq!(d.area(), 9801.0 - 110.0, "{:?}", polygon[1]);
        }
        polygon[1].reverse();
    }
}

#[test]
fn a_bridge_outside_makes_two_parts() {
    let d = domain("0 0 1 0 1 1 3 1 3 0 4 0 4 2 3 2 3 1 1 1 1 2 0 2");
    assert_eq!(d.n_components(), 2);
    assert_eq!(d.area(), 4.0);
    assert_eq!(d.report().count(Repair::Bridge), 2);
}

#[test]
fn a_hole_sharing_an_edge_with_the_outer_ring_is_a_notch() {
    let d = domain("0 0 1 0 3 0 4 0 4 4 0 4 / 1 0 1 2 3 2 3 0");
    assert_eq!(walks(&d), ["0 0) 1 0) 1 2( 3 2( 3 0) 4 0) 4 4) 0 4)"]);
    assert_eq!(d.area(), 12.0);
}

#[test]
fn two_holes_sharing_an_edge_are_one() {
    let d = domain("0 0 9 0 9 9 0 9 / 2 2 2 4 4 4 4 2 / 4 2 4 4 6 4 6 2");
    assert_eq!(d.area(), 73.0);
    assert_eq!(d.walks().len(), 2);
    // The straight joints at (4,2) and (4,4) stay.
    assert_eq!(walks(&d)[1], "hole 2 2( 2 4( 4 4| 6 4( 6 2( 4 2|");
}

#[test]
fn polygons_may_touch_and_share_edges() {
    let left = rings("0 0 2 0 2 4 0 4");
    let right = rings("2 1 4 1 4 3 2 3");
    let polygons = [left, right];
    let d = Domain::from_polygons(&polygons, &Options::default()).expect("valid");
    assert_eq!(walks(&d), ["0 0) 2 0) 2 4) 0 4)", "2 1) 4 1) 4 3) 2 3)"]);
    assert_eq!(d.walks()[1].polygon, 1);
    assert!(d.report().entries().is_empty());
    assert_eq!(d.line(1), d.line(7));
    let error = Domain::from_polygons(&polygons, &STRICT).expect_err("shares an edge");
    assert_eq!(error.code(), "shared_edge");
}

#[test]
fn a_polygon_may_fill_the_hole_of_another() {
    let ring = rings("0 0 9 0 9 9 0 9 / 3 3 6 3 6 6 3 6");
    let filled =
        Domain::from_polygons(&[ring.clone(), rings("3 3 6 3 6 6 3 6")], &Options::default());
    assert_eq!(filled.expect("valid").area(), 81.0);
    let inside = Domain::from_polygons(&[rings("4 4 5 4 5 5 4 5"), ring], &Options::default());
    assert_eq!(inside.expect("valid").n_components(), 2);
}

#[test]
fn regrouping_finds_roles_by_depth() {
    let text = "2 2 3 2 3 3 2 3 / 1 1 8 1 8 8 1 8 / 0 0 9 0 9 9 0 9";
    let d = Domain::from_polygons(&[rings(text)], &REGROUP).expect("valid");
    // Depths 2, 1, 0: outer ring, hole, outer ring.
    assert_eq!(d.area(), 81.0 - 49.0 + 1.0);
    assert_eq!(d.n_components(), 2);
    assert_eq!(repairs(&d), ["reversed 1:", "regrouped 2:"]);
}

#[test]
fn regrouping_copes_with_rings_that_share_edges() {
    // A ring inside on the bottom edge, and one beside the outer ring on its right edge.
    let text = "0 0 4 0 4 4 0 4 / 0 0 4 0 2 1 / 4 0 6 2 4 4";
    let d = Domain::from_polygons(&[rings(text)], &REGROUP).expect("valid");
    assert_eq!(d.area(), 16.0 - 2.0 + 4.0);
    assert_eq!(d.n_components(), 1);
}

#[test]
fn regrouping_copes_with_a_polygon_that_shares_the_edge_of_a_hole() {
    // The second polygon lies in a hole of the first, under its top edge; above is another hole.
    let holes = rings("0 0 10 0 10 10 0 10 / 1 1 9 1 9 4 1 4 / 2 6 4 6 4 8 2 8");
    let filling = rings("2 2 8 2 9 4 1 4");
    let d = Domain::from_polygons(&[holes, filling], &REGROUP).expect("valid");
    assert_eq!(d.area(), 100.0 - 24.0 - 4.0 + 14.0);
    assert_eq!(d.n_components(), 2);
}

#[test]
fn supporting_lines_are_shared_across_rings() {
    let d = domain("0 0 9 0 9 9 6 9 6 8 3 8 3 9 0 9 / 1 1 8 1 8 2 1 2");
    let at = |x: f64, y: f64| {
        let edge = d.edges().iter().position(|e| e.start == Point::new(x, y));
        edge.map(|e| d.lines()[e])
    };
    assert_eq!(at(9.0, 9.0), at(3.0, 9.0));
    assert_ne!(at(9.0, 9.0), at(6.0, 8.0));
}

#[test]
fn walks_know_their_component() {
    // Two squares that touch at (4,4), each with a hole; a polygon in the second one's hole.
    let touching = rings("0 0 4 0 4 4 9 4 9 9 4 9 4 4 0 4 / 5 5 8 5 8 8 5 8 / 1 1 2 1 2 2 1 2");
    let inner = rings("6 6 7 6 7 7 6 7");
    let d = Domain::from_polygons(&[touching, inner], &Options::default()).expect("valid");
    let list: Vec<_> = d.walks().iter().map(|w| (w.hole, w.component)).collect();
    // Along the curve the hole of the lower square comes first.
    assert_eq!(list, [(false, 0), (false, 1), (true, 0), (true, 1), (false, 2)]);
}
