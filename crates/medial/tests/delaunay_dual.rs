//! The dual of the Delaunay graph of samples: judged on all fixtures, and compared with the exact axis.

mod support;

use medial::check::defects;
use medial::domain::Domain;
use medial::engine::{DelaunayDual, DualPruning, Options};
use medial::raster::default_cell;
use support::shapes;

/// Options with so many samples along the longer side of the box.
fn along(domain: &Domain, samples: f64) -> Options<'static> {
    Options { spacing: Some(1000.0 / samples * default_cell(domain)), ..Options::default() }
}

#[test]
fn the_axis_of_every_fixture_has_no_defect_whatever_the_spacing() {
    let mut faults = Vec::new();
    for name in shapes::names() {
        let Ok(domain) = shapes::of(&shapes::polygons(&name)) else { continue };
        for samples in [3.0, 40.0, 1000.0] {
            let dual = match DelaunayDual::new(&domain, &along(&domain, samples)) {
                Ok(dual) => dual,
                Err(error) => {
                    faults.push(format!("{name} {samples}: {error}"));
                    continue;
                }
            };
            let axis = dual.axis(DualPruning::Nothing).unwrap();
            let verdict = defects(&domain, &axis);
            if !verdict.defects.is_empty() {
                let first = &verdict.defects[0];
                let n = verdict.defects.len();
                faults.push(format!("{name} {samples}: {n} defects, the first {first:?}"));
            }
        }
    }
    assert!(faults.is_empty(), "{} faults\n{}", faults.len(), faults.join("\n"));
}
