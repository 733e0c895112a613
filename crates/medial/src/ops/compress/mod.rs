//! Few disks that stand for a shape, within an error that is promised. For masks see `cells`.
//!
//! # Contract
//! The shape of a [`DiskGraph`] is the union of its disks and of all disks between two that are linked,
//! with centre and radius linear from one to the other. Its boundary and that of the domain are within
//! [`DiskGraph::error`] of one another, in both directions (Hausdorff distance), and so are the two
//! shapes. The graph has the components of the axis, and its cycles.
//! O(n log n) for n keypoints and points of curves, as a rule.
//!
//! # Method
//! 1. Prune the axis by a part of the error, measured by excess [`Hierarchy::pruned`]; several parts are
//!    tried, and the smallest result is kept.
//! 2. Sample its curves, and cut them into chains between keypoints of degree other than two.
//! 3. Take half of the rest of the error off all radii, and go along each chain with as few straight
//!    pieces between points of a grid as stay near it (`fit.rs`).
//!
//! # Why the error holds
//! Let `ε` be the error of pruning. To each point `(c, r)` of a chain belongs a point `(c', r')` of its
//! pieces, and the other way round, with
//!
//! ```text
//! |c - c'| <= r - r'          its disk lies in the disk of the chain         (inside)
//! |c - c'| + r - r' <= δ      and comes within δ of each point of it         (near)
//! ```
//!
//! Both are convex in the difference of the two, so they hold between two places where they hold, if
//! chain and pieces are straight there. Let `S` be the domain, `T` the union of the disks of the pieces.
//!
//! *Every boundary point `p` of `S` is near the boundary of `T`.* By (inside) `T` lies in `S`, so `p` is
//! no inner point of `T`. By the meaning of the excess some disk of the pruned axis comes within `ε` of
//! `p`, so by (near) some disk of `T` comes within `ε + δ`, and the way there ends on the boundary of `T`.
//!
//! *Every boundary point `q` of `T` is near the boundary of `S`.* Let `ρ` be its distance from there. The
//! disk around `q` lies in a maximal disk of `S`. If that was pruned, it lies within `ε` of the disk where
//! the axis was cut; so `|q - c| <= r - (ρ - ε)` for some disk of a chain. By (near) `q` is an inner point
//! of `T` if `ρ - ε > δ`; so it is not.
//!
//! Where the domain is thinner than the grid (inside) cannot be had. Such stretches of a chain become
//! pieces of radius 0, which begin and end with a point of their own, and need only
//! `|c - c'| + r <= δ`: they have no inner points, so the first part holds as it is, and each point of
//! theirs is within `δ` of the boundary of `S`, as the second part wants.
//!
//! Curves are sampled, which moves both sides of (inside) and (near) by a known amount; that amount and
//! one for rounding are taken off.
//!
//! # Departures
//! Disks of a pruned axis are usually kept as they are. Here they shrink, by half of `δ`. Else thin
//! slits outside, and small holes, could be covered by disks that are a little too large, and no bound
//! for the boundary would hold.

mod cells;
mod chains;
mod disk_graph;
mod fit;
mod rebuild;
mod simplify;

pub use cells::{
    Ball, BallShape, CellCode, CellError, CompressedMask, MaskMethod, MaskOptions, compress_mask,
};
pub use disk_graph::{DiskGraph, GridDisk, Run};
pub use rebuild::{Compressed, Corners, RebuildError};

use super::hierarchy::{Hierarchy, HierarchyError};
use super::measure::Measure;
use crate::axis::{MedialAxis, Side};
use crate::domain::Domain;
use fit::Tolerance;

/// Parts of the error that pruning may take: the one is taken that makes the smallest graph.
///
/// Size only: the bound is the same for any. What has many small branches is best with a large part, what
/// has few and bends much with a small one.
const PRUNING_SHARES: [f64; 4] = [0.4, 0.6, 0.75, 0.87];

/// The grid, as a share of what pruning leaves of the error: these, rounded down to a power of two.
///
/// Size only. A finer one needs more bits for each disk, a coarser one leaves less for straight pieces.
const GRID_SHARES: [f64; 2] = [0.125, 0.25];

/// Least error, as a share of the largest coordinate, that disks on a grid are made for.
///
/// Below that the bits of doubles would be used up, and no file would be smaller than one of the corners.
const FINEST: f64 = 1.0 / (1_u64 << 32) as f64;

/// Bound for what rounding adds to distances from positions of the axis, as a share of the largest
/// coordinate: 32 units in the last place.
const ROUNDING: f64 = 1.0 / (1_u64 << 48) as f64;

/// Why an axis has no disks that stand for its shape.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CompressError {
    /// The axis cannot be pruned.
    #[error(transparent)]
    Hierarchy(#[from] HierarchyError),
    /// Cells are too many.
    #[error(transparent)]
    Cells(#[from] CellError),
    /// The outside has no bound that could be kept.
    #[error("the axis is one of the outside; only that of the inside can be compressed")]
    Exterior,
    /// The error is negative, not a number, or too small for the coordinates.
    #[error("an error of {max_error} is too small for coordinates up to {size}; keep the corners")]
    TooFine {
        /// The error that was asked for, in units of the input.
        max_error: f64,
        /// The largest coordinate, in units of the input.
        size: f64,
    },
}

/// The disks that stand for the shape of a domain, with an error of at most `max_error`, in units of
/// the input.
///
/// ```
/// use medial::domain::{Domain, Options};
/// use medial::engine::path_tracing;
/// use medial::geom::Point;
/// use medial::ops::compress;
///
/// let ring = [(0., 0.), (6., 0.), (6., 2.), (0., 2.)].map(|(x, y)| Point::new(x, y));
/// let domain = Domain::from_polygons(&[vec![ring.to_vec()]], &Options::default())?;
/// let axis = path_tracing(&domain)?;
/// // The branches to the corners go: two disks, and what is between them.
/// let graph = compress(&domain, &axis, 1.0)?;
/// assert_eq!((graph.disks().len(), graph.links().count()), (2, 1));
/// assert!(graph.error() <= 1.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If the axis is not the complete exact axis of the inside of the domain, or if the error is less than
/// 2^-32 of the largest coordinate.
pub fn compress(
    domain: &Domain,
    axis: &MedialAxis,
    max_error: f64,
) -> Result<DiskGraph, CompressError> {
    if axis.side == Side::Exterior {
        return Err(CompressError::Exterior);
    }
    let hierarchy = Hierarchy::new(domain, axis)?;
    let coordinates = domain.edges().iter().flat_map(|edge| [edge.start.x, edge.start.y]);
    let size = coordinates.map(f64::abs).fold(0.0, f64::max);
    let too_fine = || CompressError::TooFine { max_error, size };
    if max_error.is_nan() || max_error < FINEST * size {
        return Err(too_fine());
    }
    // One far beyond the shape is as good as any that is larger.
    let max_error = max_error.min(4.0 * size);
    let graphs = PRUNING_SHARES.into_iter().flat_map(|share| {
        let pruned = hierarchy.pruned(Measure::Excess, share * max_error);
        let layout = chains::layout(&pruned.axis);
        GRID_SHARES.map(|grid| {
            let exponent = (grid * (1.0 - share) * max_error).log2().floor() as i32;
            let budget = DiskGraph::whole_error(exponent, max_error)?;
            let tolerance = Tolerance::new(exponent, budget - pruned.error, ROUNDING * size)?;
            let fitted = fit::fitted(&pruned.axis, &layout, &tolerance)?;
            let error = pruned.error + fitted.error;
            DiskGraph::new(axis.engine, exponent, error, fitted.disks, fitted.runs)
        })
    });
    graphs.flatten().min_by_key(DiskGraph::cost).ok_or_else(too_fine)
}
