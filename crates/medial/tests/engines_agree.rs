//! Every exact engine against brute force over all triples, on thousands of small shapes.

mod support;

use medial::check;
use medial::domain::Domain;
use medial::engine::path_tracing;
use support::random::{Ground, Random, polygon};
use support::shapes::{self, Polygons};
use support::{brute_force, compare};

/// Shapes too large for all triples.
const LARGE: [&str; 1] = ["star_with_108_corners_on_one_circle"];

/// What is wrong with the engine on a domain; empty if it agrees with brute force and the judge
/// finds nothing in either axis.
fn faults(domain: &Domain, triples: bool) -> Vec<String> {
    let axis = match path_tracing(domain) {
        Ok(axis) => axis,
        Err(why) => return vec![format!("path_tracing: {why}")],
    };
    let mut faults: Vec<String> =
        check::defects(domain, &axis).defects.iter().map(|d| format!("judge: {d}")).collect();
    if triples {
        match brute_force::try_axis(domain) {
            Ok(other) => {
                faults.extend(
                    check::defects(domain, &other)
                        .defects
                        .iter()
                        .map(|d| format!("judge on brute force: {d}")),
                );
                faults.extend(compare::differences(&axis, &other));
            }
            Err(why) => faults.push(format!("brute force: {why}")),
        }
    }
    faults
}

#[test]
fn shapes_have_the_axis_of_all_triples() {
    let mut failures = Vec::new();
    for name in shapes::names() {
        let domain = shapes::domain(&name);
        let found = faults(&domain, !LARGE.contains(&name.as_str()));
        failures.extend(found.into_iter().map(|f| format!("{name}: {f}")));
    }
    assert!(failures.is_empty(), "{failures:#?}");
}

/// Tries this many valid random shapes with at most 14 edges.
fn random_shapes(ground: Ground, seed: u64, count: usize) {
    let mut random = Random(seed);
    let mut failures: Vec<(Polygons, Vec<String>)> = Vec::new();
    let mut tried = 0;
    while tried < count {
        let most = 3 + random.below(12).max(random.below(6));
        let polygons = polygon(&mut random, ground, most);
        let Ok(domain) = shapes::of(&polygons) else { continue };
        tried += 1;
        let found = faults(&domain, true);
        if !found.is_empty() {
            failures.push((polygons, found));
        }
    }
    // The smallest ones are the easiest to understand.
    failures.sort_by_key(|(p, _)| p.iter().flatten().map(Vec::len).sum::<usize>());
    let told: Vec<String> = failures
        .iter()
        .take(5)
        .map(|(p, f)| format!("{}\n    {}", shapes::to_wkt(p), f.join("\n    ")))
        .collect();
    assert!(
        failures.is_empty(),
        "{} of {tried} shapes; the smallest:\n{}",
        failures.len(),
        told.join("\n")
    );
}

#[test]
fn random_polygons_have_the_axis_of_all_triples() {
    random_shapes(Ground::Square, 1, 5000);
}

#[test]
fn random_polygons_on_a_tiny_grid_have_the_axis_of_all_triples() {
    random_shapes(Ground::Grid(6), 2, 2500);
}

#[test]
fn random_polygons_on_a_small_grid_have_the_axis_of_all_triples() {
    random_shapes(Ground::Grid(12), 3, 2500);
}
