//! The judge on right axes and on axes with planted faults.

mod support;

use medial::check;
use support::{brute_force, shapes};

/// Shapes too large for all triples.
const LARGE: [&str; 1] = ["star_with_108_corners_on_one_circle"];

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
