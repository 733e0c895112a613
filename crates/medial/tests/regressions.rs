//! Shapes that once went wrong, each a fixture of its own.

mod support;

use std::path::PathBuf;

use medial::check;
use medial::domain::{Domain, Options};
use medial::engine::path_tracing;
use support::{brute_force, compare, shapes};

fn read(name: &str) -> String {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../fixtures").join(name);
    std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// The axis of a fixture has no defect and is the one of all triples.
fn is_right(name: &str) {
    let text = read(name);
    let domain = shapes::wkt(&text);
    let axis = path_tracing(&domain).unwrap_or_else(|e| panic!("{name}: {e}"));
    let defects = check::defects(&domain, &axis).defects;
    assert!(defects.is_empty(), "{name}: {defects:?}");
    let other = brute_force::try_axis(&domain).unwrap_or_else(|e| panic!("{name}: {e}"));
    let differences = compare::differences(&axis, &other);
    assert!(differences.is_empty(), "{name}: {differences:?}");
}

#[test]
fn a_huge_disk_is_cut_by_an_edge_seen_from_behind() {
    is_right("issue_2_edge_seen_from_behind_cuts_a_huge_disk.wkt");
}

#[test]
fn a_ring_on_the_path_is_met_though_one_of_its_edges_proposes_a_disk_far_away() {
    is_right("issue_2_ring_lost_to_a_proposal_far_away.wkt");
}

#[test]
fn a_path_leads_around_a_hole_smaller_than_the_doubt_about_its_start() {
    is_right("issue_3_hole_smaller_than_the_doubt_about_a_start.wkt");
    is_right("issue_3_hole_in_the_middle_smaller_than_the_doubt.wkt");
    is_right("issue_3_hole_around_which_the_search_came_back.wkt");
}

#[test]
fn a_keypoint_that_waits_is_the_end_only_if_no_hole_smaller_than_the_doubt_lies_before_it() {
    is_right("issue_3_known_keypoint_behind_a_hole_smaller_than_the_doubt.wkt");
}

#[test]
fn an_edge_of_another_component_that_ends_in_the_first_corner_makes_no_keypoint() {
    is_right("issue_2_edge_of_another_component_ends_at_the_first_corner.wkt");
}

#[test]
fn contacts_in_a_gap_of_half_an_ulp_are_sorted_exactly() {
    is_right("issue_2_two_holes_half_an_ulp_apart.wkt");
}

#[test]
fn a_chain_goes_no_further_than_once_round_a_tiny_hole() {
    is_right("issue_3_chain_round_a_tiny_hole.wkt");
}

#[test]
fn a_tiny_hole_in_a_sharp_corner_is_met() {
    is_right("issue_3_hole_hidden_in_a_corner.wkt");
}

#[test]
fn disks_far_outside_that_cut_each_other_do_not_go_on_for_ever() {
    is_right("issue_3_disks_far_outside_cut_each_other.wkt");
}

#[test]
fn a_ring_on_a_path_is_met_first_with_a_part_that_does_not_touch_its_end() {
    is_right("issue_3_ring_on_a_path_touches_its_end_from_behind.wkt");
}

#[test]
fn a_corner_at_the_least_whole_number_of_64_bits_is_no_short_one() {
    is_right("issue_4_corner_at_minus_two_to_the_63.wkt");
}

#[test]
fn an_edge_of_another_component_is_not_met_from_behind() {
    let text = read("issue_3_another_component_touched_from_behind.wkt");
    let options = Options { regroup: true, ..Options::default() };
    let domain = Domain::from_polygons(&shapes::parse(&text), &options).unwrap();
    let axis = path_tracing(&domain).unwrap();
    let defects = check::defects(&domain, &axis).defects;
    assert!(defects.is_empty(), "{defects:?}");
}
