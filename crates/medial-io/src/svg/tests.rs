use super::*;
use crate::samples;

fn scene() -> Scene {
    Scene { boundary: samples::l_rings(), axis: samples::l_shape() }
}

fn picture(draw: &[Extra]) -> String {
    let options = Options { draw: draw.to_vec(), legend: false, ..Options::default() };
    write(&[scene()], &options)
}

fn group<'a>(picture: &'a str, class: &str) -> &'a str {
    let start = picture.find(&format!("<g class=\"{class}\"")).unwrap();
    let end = start + picture[start..].find("</g>").unwrap();
    &picture[start..end]
}

#[test]
fn y_points_up_and_the_longer_side_has_1000_pixels() {
    // The L is 3 × 3 with 28 pixels around: (0, 0) lies at the lower left.
    let picture = picture(&[]);
    assert!(picture.contains("viewBox=\"0 0 1056 1056\""), "{picture}");
    assert!(group(&picture, "domain").contains("M28 1028L1028 1028L1028 694.6667"));
}

#[test]
fn parabolas_are_quadratic_beziers() {
    let picture = picture(&[]);
    let axis = group(&picture, "axis");
    assert!(axis.contains('Q'));
    // The transition (1, 0.5) lies at (361.3333, 861.3333); the parabola ends there.
    assert!(axis.contains(" 361.3333 861.3333"), "{axis}");
}

#[test]
fn a_curve_is_cut_where_its_color_changes() {
    // From (0, 0) with radius 0 to (1, 1) with radius 1 every colour occurs once; the spine has
    // the last one.
    let axis = samples::rectangle();
    let scene = Scene { boundary: samples::rectangle_rings(), axis };
    let picture = write(&[scene], &Options::default());
    let axis = group(&picture, "axis");
    assert_eq!(axis.matches("<path").count(), palette::STEPS);
    let last = axis.lines().last().unwrap();
    assert_eq!(last.matches('M').count(), 5, "four diagonals and the spine: {last}");
}

#[test]
fn each_kind_of_keypoint_has_its_marks() {
    let picture = picture(&[]);
    assert_eq!(group(&picture, "junction").matches('M').count(), 3);
    // Hollow: each transition is drawn twice.
    assert_eq!(group(&picture, "transition").matches('M').count(), 4);
    assert_eq!(group(&picture, "end").matches('M').count(), 5);
}

#[test]
fn disks_have_the_radius_of_their_keypoint() {
    let picture = picture(&[Extra::Disks]);
    let disks = group(&picture, "disks");
    assert_eq!(disks.matches("<circle").count(), 5);
    assert!(disks.contains("cx=\"861.3333\" cy=\"861.3333\" r=\"166.6667\""), "{disks}");
}

#[test]
fn footpoints_are_joined_to_their_keypoints() {
    let picture = picture(&[Extra::Footpoints]);
    let feet = group(&picture, "footpoints");
    // 3 governors at each of 5 inner keypoints, a line and a dot each.
    assert_eq!(feet.matches('M').count(), 30);
    // From (2.5, 0.5) down to (2.5, 0).
    assert!(feet.contains("M861.3333 861.3333L861.3333 1028"), "{feet}");
}

#[test]
fn every_path_has_two_zones() {
    let zones = picture(&[Extra::Zones]);
    assert_eq!(group(&zones, "zones").matches('Z').count(), 18);
    let cells = picture(&[Extra::Cells]);
    assert_eq!(group(&cells, "cells").matches('Z').count(), 18);
    assert_eq!(group(&cells, "cells").matches("<path").count(), 7, "one for each governor");
}

#[test]
fn governors_carry_their_numbers() {
    let picture = picture(&[Extra::Governors]);
    assert_eq!(group(&picture, "governors").matches("<path").count(), 2);
    assert!(picture.contains(">6</text>"));
}

#[test]
fn a_title_is_escaped() {
    let options = Options { title: "a<b & \"c\"".to_owned(), ..Options::default() };
    let picture = write(&[scene()], &options);
    assert!(picture.contains("<title>a&lt;b &amp; &quot;c&quot;</title>"));
}

#[test]
fn no_shape_makes_an_empty_picture() {
    let picture = write(&[], &Options::default());
    assert!(picture.starts_with("<svg") && picture.ends_with("</svg>\n"));
    assert!(!picture.contains("NaN") && !picture.contains("inf"));
}
