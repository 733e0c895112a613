//! The exact medial axis of polygonal domains.
//!
//! The medial axis of a shape is where the centres of its maximal disks are: the disks inside it
//! that no other disk inside it contains. Here it is a graph. Its nodes are *keypoints*, its edges
//! *paths*, and each path is labelled with its two *governors*, the edges or reflex corners of the
//! boundary that the disks along it touch. Which keypoints and paths there are, and what governs
//! them, is decided exactly; coordinates are rounded once.
//!
//! Data flows one way: a [`Domain`](domain::Domain) is validated once, an engine turns it into a
//! [`MedialAxis`](axis::MedialAxis), and [`check::defects`] judges the result.
//!
//! ```
//! use medial::axis::KeypointKind;
//! use medial::check::defects;
//! use medial::domain::{Domain, Options};
//! use medial::engine::path_tracing;
//! use medial::geom::Point;
//!
//! // A square of side 2 around the origin: four diagonals meet in its centre.
//! let square = [(-1., -1.), (1., -1.), (1., 1.), (-1., 1.)].map(|(x, y)| Point::new(x, y));
//! let domain = Domain::from_polygons(&[vec![square.to_vec()]], &Options::default())?;
//! let axis = path_tracing(&domain)?;
//! let junction = axis.keypoints().iter().find(|k| k.kind == KeypointKind::Junction);
//! assert_eq!(junction.map(|k| (k.position, k.radius)), Some((Point::new(0., 0.), 1.0)));
//! assert_eq!(axis.paths().len(), 4);
//! assert!(defects(&domain, &axis).defects.is_empty());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Each module uses only those before it: `geom < domain < axis < raster < engine < check < ops`.

pub mod geom;

pub mod domain;

pub mod axis;

pub mod raster;

pub mod engine;

pub mod check;

pub mod ops;

/// Runs the lines of Rust in the README.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
