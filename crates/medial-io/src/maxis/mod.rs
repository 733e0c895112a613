//! The compressed axis: all features of a layer in one file, each as disks within an error, or as its
//! corners bit for bit; masks as cells.
//!
//! `docs/formats.md` describes every byte. A head of twelve bytes with version and checksum is followed
//! by a deflated body. Numbers are written as differences from what a reader expects, sorted into four
//! columns, because deflate finds more where like stands by like.
//!
//! ```
//! use medial::ops::{Compressed, Corners};
//! use medial::axis::Engine;
//! use medial::geom::Point;
//! use medial_io::maxis::{self, Record};
//!
//! let ring = [(0., 0.), (4., 0.), (4., 2.), (0., 2.)].map(|(x, y)| Point::new(x, y)).to_vec();
//! let corners =
//!     Corners { engine: Engine::PathTracing, regroup: false, error: 0.0, polygons: vec![vec![ring]] };
//! let record = Record { feature: 0, id: None, shape: Compressed::Corners(corners) };
//! let bytes = maxis::write(None, std::slice::from_ref(&record));
//! assert!(maxis::records(&bytes)?.next().is_some_and(|read| read.is_ok_and(|r| r.shape == record.shape)));
//! let axis = maxis::read(&bytes)?.next().ok_or("no feature")??.axis;
//! assert_eq!(axis.paths().len(), 5);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod cells;
mod corners;
mod cursor;
mod numbers;
mod read;
mod sizes;
mod walk;
mod write;

pub use read::{Records, read, records};
pub use sizes::{Sizes, sizes, smaller};
pub use write::write;

use crate::Json;
use medial::ops::Compressed;

/// What every file begins with: no text, so that what changes line ends is found out, and the version.
pub const MAGIC: [u8; 8] = *b"\x8dMAXIS\n\x01";

/// How many times as long as the file its body may be, so that no small file fills the memory.
const MOST_TIMES: usize = 128;

/// Bytes of the magic, the checksum and the byte that tells how the body is stored.
const HEAD: usize = 13;

/// How the body is stored.
const PLAIN: u8 = 0;
const DEFLATED: u8 = 1;

/// Kinds of features: disks, or corners on one of three scales, or as the doubles they are.
const DISKS: u8 = 0;
const DECIMAL: u8 = 1;
const BINARY: u8 = 2;
const BITS: u8 = 3;
const DOUBLES: u8 = 4;

/// The kind of a feature that is a mask.
const MASK: u8 = 5;

/// A column of the body.
#[derive(Clone, Copy)]
enum Column {
    /// Everything but coordinates and radii.
    Plan,
    X,
    Y,
    Radius,
}

const COLUMNS: usize = 4;

/// One compressed feature.
#[derive(Clone, Debug)]
pub struct Record {
    /// Number of the feature in its input, from 0; they ascend in a file.
    pub feature: usize,
    /// Its identifier, if it has one.
    pub id: Option<Json>,
    /// Its disks, corners or cells.
    pub shape: Compressed,
}

/// What coordinates of a feature count from: the first ones of the feature before, on the same grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Anchor {
    /// The kind of the feature with its grid.
    grid: (u8, i32),
    x: i64,
    y: i64,
}

/// Where a feature on a grid counts from.
fn origin(anchor: Option<Anchor>, grid: (u8, i32)) -> (i64, i64) {
    anchor.filter(|anchor| anchor.grid == grid).map_or((0, 0), |anchor| (anchor.x, anchor.y))
}

#[cfg(test)]
mod tests;
