//! The exact medial axis of polygonal domains.
//!
//! Data flows one way: a [`Domain`](domain::Domain) is validated once, an engine turns it into a
//! [`MedialAxis`](axis::MedialAxis), and [`check::defects`] judges the result.
//!
//! Each module uses only those before it: `geom < domain < axis < engine < check`.

pub mod geom;

pub mod domain;

pub mod axis;

pub mod engine;

pub mod check;

/// Runs the lines of Rust in the README.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
