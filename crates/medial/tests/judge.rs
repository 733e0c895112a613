//! The judge on right axes and on axes with planted faults.

mod support;

use medial::axis::{Accuracy, KeypointKind, Path, SiteKind};
use medial::check::{self, Defect, LeftOut, Relation};
use medial::domain::Domain;
use medial::geom::Point;
use support::parts::{Keypoint, Parts};
use support::{brute_force, shapes};

/// Shapes too large for all triples.
const LARGE: [&str; 1] = ["star_with_108_corners_on_one_circle"];

#[test]
fn a_list_that_does_not_start_with_its_smallest_site_is_flagged() {
    let domain = shapes::domain("l_with_unit_arms");
    let mut parts = Parts::of(&brute_force::try_axis(&domain).unwrap());
    let junction = parts.keypoints.iter().position(|k| k.governors.len() > 2).unwrap();
    parts.keypoints[junction].governors.rotate_left(1);
    let found = check::defects(&domain, &parts.axis()).defects;
    assert!(found.iter().any(|d| matches!(d, Defect::ListStart { .. })), "{found:?}");
}

#[test]
fn right_axes_of_all_shapes_have_no_defect() {
    let mut failures = Vec::new();
    for name in shapes::names().iter().filter(|name| !LARGE.contains(&name.as_str())) {
        let domain = shapes::domain(name);
        match brute_force::try_axis(&domain) {
            Ok(axis) => failures.extend(
                check::defects(&domain, &axis).defects.iter().map(|d| format!("{name}: {d}")),
            ),
            Err(why) => failures.push(format!("{name}: {why}")),
        }
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

/// The right axis of a shape, taken apart.
fn parts(name: &str) -> (Domain, Parts) {
    let domain = shapes::domain(name);
    let parts = Parts::of(&brute_force::axis(&domain));
    (domain, parts)
}

/// All defects of an axis with a planted fault.
fn judge(domain: &Domain, parts: &Parts) -> Vec<Defect> {
    check::defects(domain, &parts.axis()).defects
}

/// Whether one of the defects looks like this.
macro_rules! assert_found {
    ($defects:expr, $pattern:pat $(if $guard:expr)?) => {
        let defects: Vec<Defect> = $defects;
        assert!(
            defects.iter().any(|d| matches!(d, $pattern $(if $guard)?)),
            "no {} among {defects:#?}",
            stringify!($pattern)
        );
    };
}

#[test]
fn a_junction_moved_by_ten_ulps_is_off() {
    let (domain, mut parts) = parts("rectangle_5_by_2");
    let k = parts.at(4.0, 1.0);
    let right = parts.keypoints[k].position;
    // One unit in the last place of 4 is 2^-50.
    parts.keypoints[k].position.x = 4.0 + 4.0 * 2f64.powi(-50);
    assert_eq!(judge(&domain, &parts), []);
    parts.keypoints[k].position.x = 4.0 + 10.0 * 2f64.powi(-50);
    let defects = judge(&domain, &parts);
    let k = k as u32;
    assert_eq!(defects, [Defect::Position { keypoint: k, ulps: 10.0, at: right }]);
    assert_eq!(
        defects[0].to_string(),
        format!("keypoint {k}: the position is 10.0 ulps off, at (4, 1)")
    );
}

#[test]
fn a_junction_moved_far_is_off() {
    for far in [1e-9, 0.5, 1e9, f64::NAN, f64::INFINITY] {
        let (domain, mut parts) = parts("l_with_unit_arms");
        let k = parts.at(2.5, 0.5);
        parts.keypoints[k].position.y += far;
        assert_found!(judge(&domain, &parts), Defect::Position { .. });
    }
}

#[test]
fn a_radius_is_held_to_four_ulps() {
    let (domain, mut parts) = parts("rectangle_5_by_2");
    let k = parts.at(4.0, 1.0);
    parts.keypoints[k].radius = 1.0 - 5.0 * 2f64.powi(-50);
    assert_found!(judge(&domain, &parts), Defect::Radius { ulps: 5.0, .. });
    parts.keypoints[k].radius = -1.0;
    assert_found!(judge(&domain, &parts), Defect::Radius { .. });
}

#[test]
fn a_lost_path_leaves_a_gap_and_breaks_the_counts() {
    let (domain, mut parts) = parts("rectangle_5_by_2");
    let (a, b) = (parts.at(1.0, 1.0), parts.at(4.0, 1.0));
    let path = parts.between(a, b);
    parts.paths.remove(path);
    let defects = judge(&domain, &parts);
    let empty = defects.iter().filter(|d| matches!(d, Defect::EmptyGap { .. })).count();
    assert_eq!(empty, 2);
    assert_found!(defects.clone(), Defect::Identity(i) if i.name == "components of the axis");
    assert_found!(defects, Defect::Identity(i) if i.name == "area of the cells");
}

#[test]
fn a_path_with_another_governor_does_not_fit_its_gaps() {
    let (domain, mut parts) = parts("rectangle_5_by_2");
    let (a, b) = (parts.at(1.0, 1.0), parts.at(4.0, 1.0));
    let path = parts.between(a, b);
    let mut swapped = parts.clone();
    let line = &mut swapped.paths[path];
    std::mem::swap(&mut line.left, &mut line.right);
    assert_found!(judge(&domain, &swapped), Defect::Gap { path: p, .. } if *p as usize == path);
    let line = &mut parts.paths[path];
    line.left = (0..4).find(|g| ![line.left, line.right].contains(g)).expect("four edges");
    assert_found!(judge(&domain, &parts), Defect::Gap { path: p, .. } if *p as usize == path);
}

#[test]
fn a_path_may_be_told_from_either_end() {
    let (domain, mut parts) = parts("comb_with_three_unit_teeth");
    for path in &mut parts.paths {
        std::mem::swap(&mut path.from, &mut path.to);
        std::mem::swap(&mut path.left, &mut path.right);
    }
    assert_eq!(judge(&domain, &parts), []);
}

#[test]
fn a_reversed_edge_is_moved() {
    let (domain, mut parts) = parts("triangle_3_4_5");
    let edge = &mut parts.sites[1];
    std::mem::swap(&mut edge.a, &mut edge.b);
    assert_found!(judge(&domain, &parts), Defect::MovedSite { site: 1, .. });
}

#[test]
fn a_site_that_is_none_of_the_domain_is_unknown() {
    let (domain, mut parts) = parts("triangle_3_4_5");
    parts.sites[1].kind = SiteKind::Vertex;
    assert_found!(judge(&domain, &parts), Defect::UnknownSite { site: 1, .. });
}

#[test]
fn a_site_listed_twice_is_reported() {
    let (domain, mut parts) = parts("triangle_3_4_5");
    parts.sites.push(parts.sites[1]);
    let defects = judge(&domain, &parts);
    assert_found!(defects.clone(), Defect::RepeatedSite { first: 1, second: 3, .. });
    assert_found!(defects, Defect::IdleSite { site: 3, .. });
}

/// Cuts a path in two with a keypoint in the middle where nothing changes; gives its number.
fn split(parts: &mut Parts, path: usize) -> u32 {
    let middle = parts.keypoints.len() as u32;
    let line = parts.paths[path];
    let curve = parts.axis().curve(&line);
    parts.keypoints.push(Keypoint {
        position: curve.point_at(0.5),
        radius: curve.radius_at(0.5),
        kind: KeypointKind::Transition,
        governors: vec![line.left.min(line.right), line.left.max(line.right)],
    });
    parts.paths[path].to = middle;
    parts.paths.push(Path { from: middle, ..line });
    middle
}

#[test]
fn a_transition_where_nothing_changes_is_fake() {
    let (domain, mut parts) = parts("rectangle_5_by_2");
    let (a, b) = (parts.at(1.0, 1.0), parts.at(4.0, 1.0));
    let path = parts.between(a, b);
    let middle = split(&mut parts, path);
    assert_found!(judge(&domain, &parts), Defect::FakeTransition { keypoint, .. }
        if *keypoint == middle);
}

/// Name, bound and finding of each bound that is exceeded.
fn excesses(defects: &[Defect]) -> Vec<(&'static str, f64, f64)> {
    let excess = |defect: &Defect| match defect {
        Defect::Identity(i) if i.relation == Relation::AtMost => {
            Some((i.name, i.expected, i.found))
        }
        _ => None,
    };
    defects.iter().filter_map(excess).collect()
}

#[test]
fn more_voronoi_points_and_edges_than_lemma_3_allows_are_found() {
    // n edges, m reflex corners, h holes: n + m - 2 + 2h points and 2(n + m) - 3 + 3h edges.
    for (name, points, edges) in [
        ("triangle_3_4_5", 1.0, 3.0),
        ("rectangle_5_by_2", 2.0, 5.0),
        ("l_with_unit_arms", 5.0, 11.0),
        ("square_ring_6_around_2", 12.0, 24.0),
    ] {
        let (domain, mut parts) = parts(name);
        let verdict = check::defects(&domain, &parts.axis());
        let found = |name| verdict.identities.iter().find(|i| i.name == name).map(|i| i.found);
        // No keypoint here has more than three governors, so the bounds are met.
        assert_eq!(found("inner keypoints"), Some(points), "{name}");
        assert_eq!(found("Voronoi edges"), Some(edges), "{name}");
        split(&mut parts, 0);
        let expected =
            [("inner keypoints", points, points + 1.0), ("Voronoi edges", edges, edges + 1.0)];
        assert_eq!(excesses(&judge(&domain, &parts)), expected, "{name}");
    }
}

#[test]
fn a_path_given_twice_is_one_voronoi_edge_too_many() {
    let (domain, mut parts) = parts("l_with_unit_arms");
    parts.paths.push(parts.paths[0]);
    assert_eq!(excesses(&judge(&domain, &parts)), [("Voronoi edges", 11.0, 12.0)]);
}

#[test]
fn keypoints_of_more_governors_leave_room_below_the_bounds() {
    // Two points of three governors in one of four: one point and one edge fewer.
    let domain = shapes::domain("square_of_side_2");
    let verdict = check::defects(&domain, &brute_force::axis(&domain));
    let bounds = verdict.identities.iter().filter(|i| i.relation == Relation::AtMost);
    let told: Vec<_> = bounds.map(|i| (i.name, i.expected, i.found)).collect();
    assert_eq!(told, [("inner keypoints", 2.0, 1.0), ("Voronoi edges", 5.0, 4.0)]);
}

#[test]
fn a_junction_left_in_two_pieces_is_uncontracted() {
    let (domain, mut parts) = parts("square_of_side_2");
    let k = parts.at(1.0, 1.0);
    assert_eq!(parts.keypoints[k].governors, [0, 1, 2, 3]);
    let other = parts.keypoints.len() as u32;
    parts.keypoints[k].governors = vec![0, 1, 2];
    parts.keypoints[k].kind = KeypointKind::Junction;
    let copy = Keypoint { governors: vec![0, 2, 3], ..parts.keypoints[k].clone() };
    parts.keypoints.push(copy);
    // The paths beside edge 3 leave from the second piece.
    for path in parts.paths.iter_mut().filter(|p| p.left == 3 || p.right == 3) {
        if path.from as usize == k {
            path.from = other;
        }
        if path.to as usize == k {
            path.to = other;
        }
    }
    // Seen from the first piece, gap (2, 0): 2 to the right, 0 to the left.
    parts.paths.push(Path { from: k as u32, to: other, left: 0, right: 2 });
    let last = parts.paths.len() as u32 - 1;
    let defects = judge(&domain, &parts);
    assert_found!(defects.clone(), Defect::Uncontracted { path, .. } if *path == last);
    assert_found!(defects, Defect::MissingGovernor { .. });
}

#[test]
fn a_hole_that_governs_nothing_is_lost() {
    // The small hole near the tip lies between two empty disks of one path.
    let polygons = shapes::polygons("small_holes_hidden_in_a_wedge");
    let rings = &polygons[0];
    let domain = shapes::of(&polygons).expect("valid");
    let without = shapes::of(&[rings[..2].to_vec()]).expect("valid");
    let parts = Parts::of(&brute_force::axis(&without));
    let defects = judge(&domain, &parts);
    assert_found!(defects.clone(), Defect::LostWalk { first, .. } if first.ring == 2);
    assert_found!(defects.clone(), Defect::Identity(i) if i.name == "cycles");
    // No disk of a keypoint shows it.
    assert!(!defects.iter().any(|d| matches!(d, Defect::Cut { .. })), "{defects:#?}");
}

#[test]
fn a_keypoint_given_twice_is_reported() {
    let (domain, mut parts) = parts("triangle_3_4_5");
    let k = parts.at(1.0, 1.0);
    parts.keypoints.push(parts.keypoints[k].clone());
    assert_found!(judge(&domain, &parts), Defect::RepeatedKeypoint { .. });
}

#[test]
fn governors_out_of_order_are_reported() {
    let (domain, mut one) = parts("triangle_3_4_5");
    let k = one.at(1.0, 1.0);
    one.keypoints[k].governors.reverse();
    assert_found!(judge(&domain, &one), Defect::NoDisk { .. });
    // Of four contacts the disk shows from three, and the fourth is in the wrong place.
    for order in [[0, 2, 1, 3], [0, 1, 3, 2], [0, 3, 2, 1]] {
        let (domain, mut four) = parts("square_of_side_2");
        let k = four.at(1.0, 1.0);
        four.keypoints[k].governors = order.to_vec();
        assert_found!(judge(&domain, &four), Defect::Order { .. } | Defect::NoDisk { .. });
    }
}

#[test]
fn a_corner_and_its_edge_are_listed_in_boundary_order() {
    let (domain, mut parts) = parts("l_with_unit_arms");
    // The transition below the reflex corner (1, 1): bottom edge, edge (3,1)-(1,1), corner.
    let k = parts.at(1.0, 0.5);
    let list = &mut parts.keypoints[k].governors;
    assert_eq!(list.len(), 3);
    list.swap(1, 2);
    assert_found!(judge(&domain, &parts), Defect::Order { .. });
}

#[test]
fn a_governor_left_out_is_missing() {
    let (domain, mut parts) = parts("plus_of_unit_squares");
    let k = parts.at(1.5, 1.5);
    assert_eq!(parts.keypoints[k].governors.len(), 4);
    parts.keypoints[k].governors.pop();
    assert_found!(judge(&domain, &parts), Defect::MissingGovernor { .. });
}

#[test]
fn a_disk_with_the_boundary_inside_is_cut() {
    // The largest disk of the square knows nothing of the hole in its middle.
    let polygons = shapes::polygons("square_ring_6_around_2");
    let (outer, hole) = (polygons[0][0].clone(), polygons[0][1].clone());
    let square = shapes::of(&[vec![outer.clone()]]).expect("valid");
    let parts = Parts::of(&brute_force::axis(&square));
    let ring = shapes::of(&[vec![outer, hole]]).expect("valid");
    let middle = parts.at(3.0, 3.0) as u32;
    assert_found!(judge(&ring, &parts), Defect::Cut { keypoint, .. } if *keypoint == middle);
}

#[test]
fn an_end_sits_on_its_corner_bit_for_bit() {
    let (domain, mut parts) = parts("triangle_3_4_5");
    let k = parts.at(4.0, 0.0);
    parts.keypoints[k].position.y = -0.0;
    assert_found!(judge(&domain, &parts), Defect::End { keypoint, .. } if *keypoint as usize == k);
    parts.keypoints[k].position.y = 0.0;
    parts.keypoints[k].radius = f64::MIN_POSITIVE;
    assert_found!(judge(&domain, &parts), Defect::End { .. });
}

#[test]
fn a_corner_without_end_is_reported() {
    let (domain, mut parts) = parts("triangle_3_4_5");
    let k = parts.at(4.0, 0.0);
    let path = parts.paths.iter().position(|p| p.from as usize == k || p.to as usize == k);
    parts.paths.remove(path.expect("every end has one"));
    let last = parts.keypoints.len() - 1;
    parts.keypoints.swap_remove(k);
    for path in &mut parts.paths {
        for end in [&mut path.from, &mut path.to] {
            if *end as usize == last {
                *end = k as u32;
            }
        }
    }
    assert_found!(judge(&domain, &parts), Defect::Corner { ends: 0, .. });
}

#[test]
fn a_kind_must_fit_the_degree() {
    let (domain, mut parts) = parts("l_with_unit_arms");
    let k = parts.at(1.0, 0.5);
    parts.keypoints[k].kind = KeypointKind::Junction;
    assert_found!(judge(&domain, &parts), Defect::Kind { degree: 2, .. });
}

#[test]
fn a_corner_and_its_own_edge_govern_no_path() {
    let (domain, mut parts) = parts("l_with_unit_arms");
    let corner = parts.sites.iter().position(|s| s.kind == SiteKind::Vertex).expect("one");
    let edge = (0..parts.sites.len())
        .find(|&s| s != corner && parts.sites[s].a == parts.sites[corner].a)
        .expect("the edge that starts there");
    parts.paths[0].left = corner as u32;
    parts.paths[0].right = edge as u32;
    assert_found!(judge(&domain, &parts), Defect::OwnEdge { path: 0, .. });
}

#[test]
fn paths_joined_across_a_hole_are_cut_and_reversed() {
    // Two holes on the axis of a corridor: the walls govern three paths of one bisector.
    let domain = shapes::wkt(
        "POLYGON ((0 0, 40 0, 40 4, 0 4), (10 2, 11 2.5, 12 2, 11 1.5), (19 2, 20 2.5, 21 2, 20 1.5))",
    );
    let mut parts = Parts::of(&brute_force::axis(&domain));
    let wall = |y: f64| {
        let is = |s: &medial::axis::Site| s.a.y == y && s.b.y == y;
        parts.sites.iter().position(is).expect("a wall") as u32
    };
    let (low, high) = (wall(0.0), wall(4.0));
    let walls: Vec<usize> = (0..parts.paths.len())
        .filter(|&p| {
            let path = parts.paths[p];
            [path.left, path.right] == [low, high] || [path.left, path.right] == [high, low]
        })
        .collect();
    assert_eq!(walls.len(), 3);
    let (a, b) = (parts.paths[walls[0]], parts.paths[walls[2]]);
    parts.paths[walls[0]].to = b.to;
    parts.paths[walls[2]].to = a.to;
    let defects = judge(&domain, &parts);
    assert_found!(defects.clone(), Defect::PathCut { .. });
    assert_found!(defects, Defect::Reversed { .. });
}

#[test]
fn a_pruned_axis_is_judged_without_counts() {
    let (domain, mut parts) = parts("comb_with_three_unit_teeth");
    parts.complete = false;
    let ends: Vec<usize> = (0..parts.keypoints.len())
        .filter(|&k| parts.keypoints[k].kind == KeypointKind::End)
        .collect();
    let last = *ends.last().expect("eight");
    assert_eq!(last, parts.keypoints.len().min(ends.len()) - 1, "ends come first");
    // Drop the path to the last end, and the end itself.
    let junction =
        parts.paths.iter().position(|p| p.from as usize == last || p.to as usize == last);
    let path = parts.paths.remove(junction.expect("every end has one"));
    let other = if path.from as usize == last { path.to } else { path.from };
    parts.keypoints[other as usize].kind = KeypointKind::Transition;
    parts.keypoints.remove(last);
    for path in &mut parts.paths {
        for end in [&mut path.from, &mut path.to] {
            if *end as usize > last {
                *end -= 1;
            }
        }
    }
    let verdict = check::defects(&domain, &parts.axis());
    assert_eq!(verdict.defects, []);
    assert_eq!(verdict.identities, []);
    for part in [LeftOut::Leaves, LeftOut::Tiling, LeftOut::Area, LeftOut::Counts] {
        assert!(verdict.left_out.contains(&part), "{part}");
    }
    parts.complete = true;
    assert_found!(judge(&domain, &parts), Defect::Corner { ends: 0, .. });
}

#[test]
fn a_sampled_axis_is_judged_by_its_radii_and_topology() {
    let (domain, mut parts) = parts("rectangle_5_by_2");
    parts.accuracy = Accuracy::Sampled(0.01);
    let k = parts.at(4.0, 1.0);
    parts.keypoints[k].position.x += 0.009;
    let verdict = check::defects(&domain, &parts.axis());
    assert_eq!(verdict.defects, []);
    assert!(verdict.left_out.contains(&LeftOut::Governors));
    parts.keypoints[k].position.x += 0.009;
    assert_found!(judge(&domain, &parts), Defect::SampledRadius { .. });
}

#[test]
fn a_step_out_of_the_shape_is_found_in_a_sampled_axis() {
    let (domain, mut parts) = parts("comb_with_three_unit_teeth");
    parts.accuracy = Accuracy::Sampled(0.01);
    assert_eq!(check::defects(&domain, &parts.axis()).defects, []);
    // From the first tooth to the last one.
    let [a, b] = [parts.at(0.5, 1.5) as u32, parts.at(4.5, 1.5) as u32];
    let path = parts.paths[0];
    parts.paths.push(Path { from: a, to: b, ..path });
    assert_found!(judge(&domain, &parts), Defect::Jump { .. });
}

/// The left half of the axis of a rectangle, cut in the middle of the plateau.
fn half(domain: &Domain) -> Parts {
    let mut parts = Parts::of(&brute_force::axis(domain));
    parts.complete = false;
    let (a, b) = (parts.at(1.0, 1.0), parts.at(4.0, 1.0));
    let plateau = parts.paths[parts.between(a, b)];
    parts.keypoints[b] = Keypoint {
        position: Point::new(2.5, 1.0),
        radius: 1.0,
        kind: KeypointKind::Tip,
        governors: vec![plateau.left.min(plateau.right), plateau.left.max(plateau.right)],
    };
    let (a, b) = (a as u32, b as u32);
    // The ends on the right keep no path; take them away with theirs.
    parts.paths.retain(|p| ![p.from, p.to].contains(&b) || [p.from, p.to].contains(&a));
    for place in [Point::new(5.0, 0.0), Point::new(5.0, 2.0)] {
        let k = parts.at(place.x, place.y);
        parts.keypoints.remove(k);
        for path in &mut parts.paths {
            for end in [&mut path.from, &mut path.to] {
                if *end as usize > k {
                    *end -= 1;
                }
            }
        }
    }
    parts.drop_idle_sites();
    parts
}

#[test]
fn a_cut_axis_may_end_between_any_two_governors() {
    let domain = shapes::domain("rectangle_5_by_2");
    let parts = half(&domain);
    assert_eq!(parts.keypoints.len(), 4);
    assert_eq!(judge(&domain, &parts), []);
}

#[test]
fn a_tip_is_held_to_its_governors_too() {
    let domain = shapes::domain("rectangle_5_by_2");
    let mut off = half(&domain);
    let tip = off.at(2.5, 1.0);
    off.keypoints[tip].position.y = 1.1;
    assert_found!(judge(&domain, &off), Defect::NotTouching { keypoint, .. }
        if *keypoint as usize == tip);
    // Too near to the right side, which it does not list.
    let mut cut = half(&domain);
    cut.keypoints[tip].position.x = 4.5;
    assert_found!(judge(&domain, &cut), Defect::Cut { keypoint, .. }
        if *keypoint as usize == tip);
    // In a complete axis nothing ends there.
    let mut complete = half(&domain);
    complete.complete = true;
    assert_found!(judge(&domain, &complete), Defect::NoDisk { .. });
}
