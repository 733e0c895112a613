//! Cancelling and deadlines reach into everything that takes long.

mod support;

use std::f64::consts::TAU;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use medial::domain::Domain;
use medial::engine::{EngineError, Options, path_tracing, path_tracing_with};
use medial::geom::Point;
use support::shapes;

/// A regular polygon in doubles: nearly all of its edges nearly touch one disk, so a single
/// keypoint takes long.
fn regular(corners: usize) -> Domain {
    let corner = |k: usize| {
        let (sin, cos) = (TAU * k as f64 / corners as f64).sin_cos();
        Point::new(cos, sin)
    };
    shapes::of(&[vec![(0..corners).map(corner).collect()]]).unwrap()
}

/// The time from now until the engine gives up, and why it does.
fn given_up(domain: &Domain, options: &Options<'_>) -> (Duration, EngineError) {
    let start = Instant::now();
    let error = path_tracing_with(domain, options).unwrap_err();
    (start.elapsed(), error)
}

#[test]
fn a_deadline_ends_a_search_among_thousands_of_cocircular_edges() {
    let domain = regular(30_000);
    let limit = Duration::from_millis(5);
    let options = Options { deadline: Some(Instant::now() + limit), ..Options::default() };
    let (time, error) = given_up(&domain, &options);
    assert_eq!(error, EngineError::TimeLimit);
    assert!(time < Duration::from_secs(5), "{time:?}");
}

#[test]
fn another_thread_cancels() {
    let domain = regular(30_000);
    let cancel = AtomicBool::new(false);
    let options = Options { cancel: Some(&cancel), ..Options::default() };
    let (time, error) = thread::scope(|scope| {
        scope.spawn(|| {
            thread::sleep(Duration::from_millis(5));
            cancel.store(true, Ordering::Relaxed);
        });
        given_up(&domain, &options)
    });
    assert_eq!(error, EngineError::Cancelled);
    assert!(time < Duration::from_secs(5), "{time:?}");
}

#[test]
fn what_is_cancelled_before_it_begins_never_begins() {
    let cancel = AtomicBool::new(true);
    let options = Options { cancel: Some(&cancel), ..Options::default() };
    assert_eq!(path_tracing_with(&regular(3), &options), Err(EngineError::Cancelled));
}

#[test]
fn limits_that_are_not_reached_change_nothing() {
    let cancel = AtomicBool::new(false);
    let deadline = Some(Instant::now() + Duration::from_secs(3600));
    let options = Options { cancel: Some(&cancel), deadline, ..Options::default() };
    for name in shapes::names() {
        let domain = shapes::domain(&name);
        assert_eq!(path_tracing_with(&domain, &options), path_tracing(&domain), "{name}");
    }
}
