//! The axis is the same bit for bit, whatever the number of threads.

mod support;

use std::f64::consts::TAU;
use std::num::NonZeroUsize;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use medial::axis::Engine;
use medial::domain::{self, Domain};
use medial::engine::{EngineError, Options, interior};
use medial::geom::Point;
use support::random::{Family, Ground, Random, large_shape};
use support::shapes::{self, Polygons};

/// Several threads, however small the domain is.
fn shared(threads: usize) -> Options<'static> {
    let threads = NonZeroUsize::new(threads).unwrap();
    Options { threads, alone_below: 0, ..Options::default() }
}

/// Compares the axes by several numbers of threads with that by one, several times; false if the
/// polygons are no domain.
fn all_agree(name: &str, polygons: &Polygons, rounds: usize) -> bool {
    let Ok(domain) = Domain::from_polygons(
        polygons,
        &domain::Options { regroup: true, ..domain::Options::default() },
    ) else {
        return false;
    };
    let size = domain.bounds().max - domain.bounds().min;
    for &engine in Engine::ALL {
        // Engines on cells share out rows, which takes no luck.
        let (rounds, cell) = match engine.is_exact() {
            true => (rounds, None),
            false => (1, Some(size.x.max(size.y) / 200.0)),
        };
        let alone = interior(&domain, engine, &Options { cell, ..Options::default() });
        for round in 0..rounds {
            for threads in [2, 3, 8] {
                let options = Options { cell, ..shared(threads) };
                let together = interior(&domain, engine, &options);
                assert!(
                    together == alone,
                    "{name}: {engine:?}, round {round}, {threads} threads: {}",
                    shapes::to_wkt(polygons)
                );
            }
        }
    }
    true
}

/// Corners at equal angles and random distances.
fn star(random: &mut Random, corners: usize) -> Vec<Point> {
    let corner = |k: usize| {
        let (sin, cos) = (TAU * k as f64 / corners as f64).sin_cos();
        let radius = 0.3 + 0.7 * random.unit();
        Point::new(radius * cos, radius * sin)
    };
    (0..corners).map(corner).collect()
}

/// A square with square holes at equal distances: every street crossing is a tie of four.
fn lattice(side: usize, unit: f64) -> Polygons {
    let square = |x: usize, y: usize, size: usize| -> Vec<Point> {
        let at = |x: usize, y: usize| Point::new(x as f64 * unit, y as f64 * unit);
        vec![at(x, y), at(x + size, y), at(x + size, y + size), at(x, y + size)]
    };
    let mut rings = vec![square(0, 0, 2 * side + 1)];
    for k in 0..side * side {
        rings.push(square(2 * (k % side) + 1, 2 * (k / side) + 1, 1));
    }
    vec![rings]
}

/// A corridor with teeth on one side.
fn comb(teeth: usize) -> Polygons {
    let width = 2.0 * teeth as f64 - 1.0;
    let mut ring = vec![Point::new(0.0, 0.0), Point::new(width, 0.0)];
    for tooth in (0..teeth).rev() {
        let x = 2.0 * tooth as f64;
        ring.extend([Point::new(x + 1.0, 7.0), Point::new(x, 7.0)]);
        if tooth > 0 {
            ring.extend([Point::new(x, 1.0), Point::new(x - 1.0, 1.0)]);
        }
    }
    vec![vec![ring]]
}

#[test]
fn every_fixture_has_one_axis() {
    for name in shapes::names() {
        assert!(all_agree(&name, &shapes::polygons(&name), 3), "{name}");
    }
}

#[test]
fn shapes_without_holes_have_one_axis() {
    let random = &mut Random(1);
    for corners in [3, 4, 10, 100, 1000, 5000] {
        assert!(all_agree("star", &vec![vec![star(random, corners)]], 3));
    }
    assert!(all_agree("comb", &comb(300), 10));
}

#[test]
fn lattices_of_holes_have_one_axis() {
    // A unit of 1/3 gives every coordinate a full mantissa, and centres between two doubles.
    for unit in [1.0, 1.0 / 3.0] {
        for side in [1, 2, 3, 8, 24] {
            assert!(all_agree("lattice", &lattice(side, unit), 5));
        }
    }
}

#[test]
fn random_shapes_have_one_axis() {
    let random = &mut Random(2);
    let mut compared = 0;
    for family in [Family::Tangle, Family::Holes, Family::Triangles, Family::Squares] {
        for ground in [Ground::Grid(12), Ground::Grid(1000), Ground::Square] {
            for most in [14, 60, 250] {
                for _ in 0..4 {
                    let polygons = large_shape(random, family, ground, most);
                    compared += u32::from(all_agree("random", &polygons, 2));
                }
            }
        }
    }
    assert!(compared > 80, "{compared} of 144 shapes are domains");
}

#[test]
fn many_polygons_have_one_axis() {
    let random = &mut Random(3);
    let polygons: Polygons = (0..200)
        .map(|k| {
            let ring = star(random, 5 + k % 40 * (k % 7));
            let (x, y) = (3.0 * (k % 15) as f64, 3.0 * (k / 15) as f64);
            vec![ring.into_iter().map(|p| p + Point::new(x, y)).collect()]
        })
        .collect();
    assert!(all_agree("polygons", &polygons, 3));
    // Small polygons in groups, large ones by several threads.
    let domain = shapes::of(&polygons).unwrap();
    let threads = NonZeroUsize::new(3).unwrap();
    let options = Options { threads, alone_below: 150, ..Options::default() };
    for &engine in Engine::ALL {
        let alone = interior(&domain, engine, &Options::default());
        assert_eq!(interior(&domain, engine, &options), alone);
    }
}

#[test]
fn the_same_shape_has_one_axis_many_times() {
    let random = &mut Random(4);
    assert!(all_agree("star", &vec![vec![star(random, 200)]], 200));
    assert!(all_agree("lattice", &lattice(4, 0.1), 200));
}

#[test]
fn all_threads_stop_when_cancelled() {
    let domain = shapes::of(&[vec![star(&mut Random(5), 100_000)]]).unwrap();
    for (engine, threads) in Engine::ALL.iter().flat_map(|&e| [(e, 2), (e, 8)]) {
        let cancel = AtomicBool::new(false);
        let threads = NonZeroUsize::new(threads).unwrap();
        let options = Options { threads, cancel: Some(&cancel), ..Options::default() };
        let error = thread::scope(|scope| {
            scope.spawn(|| {
                thread::sleep(Duration::from_millis(1));
                cancel.store(true, Ordering::Relaxed);
            });
            interior(&domain, engine, &options).unwrap_err()
        });
        assert_eq!(error, EngineError::Cancelled);
    }
}
