//! Every exact engine against brute force over all triples, on thousands of small shapes.

mod support;

use medial::check;
use medial::domain::{Domain, Options};
use medial::engine::{divide_and_conquer, path_tracing};
use support::random::{self, Family, Ground, Random};
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
    match divide_and_conquer(domain) {
        Ok(other) => {
            let defects = check::defects(domain, &other).defects;
            faults.extend(defects.iter().map(|d| format!("judge on divide_and_conquer: {d}")));
            faults.extend(compare::differences(&axis, &other));
        }
        Err(why) => faults.push(format!("divide_and_conquer: {why}")),
    }
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

/// Most edges of a random shape.
const MOST: usize = 14;

/// Tries this many valid random shapes with at most 14 edges; one in three is changed by a hair.
fn random_shapes(family: Family, ground: Ground, seed: u64, count: usize) {
    let mut random = Random(seed);
    let mut failures: Vec<(Polygons, Vec<String>)> = Vec::new();
    let mut tried = 0;
    let options = Options { regroup: true, ..Options::default() };
    while tried < count {
        let mut polygons = random::shape(&mut random, family, ground);
        if matches!(ground, Ground::Grid(_)) {
            polygons = random::carried(&mut random, &polygons);
            if random.below(3) == 0 {
                polygons = random::off_by_a_hair(&mut random, &polygons);
            }
        }
        let Ok(domain) = Domain::from_polygons(&polygons, &options) else { continue };
        if domain.edges().len() > MOST {
            continue;
        }
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
    random_shapes(Family::Tangle, Ground::Square, 1, 3000);
}

#[test]
fn random_polygons_with_holes_have_the_axis_of_all_triples() {
    random_shapes(Family::Holes, Ground::Square, 2, 2000);
}

#[test]
fn random_polygons_on_a_tiny_grid_have_the_axis_of_all_triples() {
    random_shapes(Family::Tangle, Ground::Grid(6), 3, 1500);
}

#[test]
fn random_polygons_with_holes_on_a_grid_have_the_axis_of_all_triples() {
    random_shapes(Family::Holes, Ground::Grid(10), 4, 1000);
}

#[test]
fn random_triangles_of_a_lattice_have_the_axis_of_all_triples() {
    random_shapes(Family::Triangles, Ground::Grid(3), 5, 1500);
}

#[test]
fn random_squares_of_a_lattice_have_the_axis_of_all_triples() {
    random_shapes(Family::Squares, Ground::Grid(4), 6, 1000);
}
