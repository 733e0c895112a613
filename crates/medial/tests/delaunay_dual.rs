//! The dual of the Delaunay graph of samples: judged on all fixtures and on random domains, and compared with the
//! exact axis.

mod support;

use medial::axis::MedialAxis;
use medial::check::{defects, difference};
use medial::domain::Domain;
use medial::engine::{DelaunayDual, DualPruning, Options, path_tracing};
use medial::raster::default_cell;
use support::random::{Family, Ground, Random, large_shape};
use support::shapes;

/// Options with so many samples along the longer side of the box.
fn along(domain: &Domain, samples: f64) -> Options<'static> {
    Options { spacing: Some(1000.0 / samples * default_cell(domain)), ..Options::default() }
}

/// Faults of the axes of both sides at three distances of samples.
fn faults(name: &str, domain: &Domain) -> Vec<String> {
    eprintln!("at {name}");
    let mut faults = Vec::new();
    for samples in [3.0, 40.0, 500.0] {
        let options = along(domain, samples);
        let sides = [
            ("inside", DelaunayDual::new(domain, &options)),
            ("outside", DelaunayDual::outside(domain, None, &options)),
        ];
        for (side, dual) in sides {
            let axis = dual.and_then(|dual| dual.axis(DualPruning::Nothing));
            match axis.map(|axis| defects(domain, &axis).defects) {
                Ok(defects) if defects.is_empty() => {}
                Ok(defects) => faults.push(format!("{name} {side} {samples}: {:?}", defects[0])),
                Err(error) => faults.push(format!("{name} {side} {samples}: {error}")),
            }
        }
    }
    faults
}

#[test]
fn the_axes_of_every_fixture_have_no_defect_whatever_the_spacing() {
    let all = shapes::names().into_iter().flat_map(|name| {
        let domain = shapes::domain(&name);
        faults(&name, &domain)
    });
    let all: Vec<String> = all.collect();
    assert!(all.is_empty(), "{} faults\n{}", all.len(), all.join("\n"));
}

/// Random domains with holes.
fn random_domains(n: u64) -> impl Iterator<Item = (u64, Domain)> {
    (1..=n).filter_map(|seed| {
        let mut random = Random(seed);
        let family = [Family::Tangle, Family::Holes, Family::Squares][seed as usize % 3];
        let ground = [Ground::Square, Ground::Grid(20)][seed as usize % 2];
        let polygons = large_shape(&mut random, family, ground, 40);
        let options = medial::domain::Options { regroup: true, ..Default::default() };
        Domain::from_polygons(&polygons, &options).ok().map(|domain| (seed, domain))
    })
}

#[test]
fn the_axes_of_random_domains_have_no_defect() {
    let all = random_domains(120).flat_map(|(seed, domain)| faults(&seed.to_string(), &domain));
    let all: Vec<String> = all.collect();
    assert!(all.is_empty(), "{} faults\n{}", all.len(), all.join("\n"));
}

fn axis(domain: &Domain, samples: f64) -> MedialAxis {
    DelaunayDual::new(domain, &along(domain, samples)).unwrap().axis(DualPruning::Nothing).unwrap()
}

#[test]
fn the_distance_from_the_exact_axis_goes_to_zero_with_the_spacing() {
    for (seed, domain) in random_domains(60) {
        let exact = path_tracing(&domain).unwrap();
        let size = 1000.0 * default_cell(&domain);
        for samples in [100.0, 1000.0] {
            let found = difference(&exact, &axis(&domain, samples));
            let spacing = size / samples;
            eprintln!("{seed} {samples}: {} {}", found.distance / spacing, found.missed / spacing);
        }
    }
}
