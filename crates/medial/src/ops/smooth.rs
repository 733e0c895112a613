//! Smoothing after Ho and Dyer [HD86]: limbs that say little are removed, and the shape is rebuilt from
//! what is left.
//!
//! # Contract
//! A limb is kept as far as its relative prominence reaches a threshold: how far it stands out of the disk
//! where it grows out of the shape, as a share of the radius. So a bump on a thick part goes where the same
//! bump on a thin part stays. What is left is bounded by pieces of the boundary and by arcs of disks;
//! components and holes stay, and no point of either boundary is farther from the other than the distance
//! that is told.
//!
//! # Departures
//! Ho and Dyer measure prominence along discrete axes; here it is exact (`prominence.rs`). Other measures
//! may decide as well.

use super::hierarchy::{Hierarchy, HierarchyError};
use super::measure::Measure;
use super::outline::{Outline, OutlineError};
use crate::axis::MedialAxis;
use crate::domain::Domain;

/// A smoothed shape.
#[derive(Clone, Debug, PartialEq)]
pub struct Smoothed {
    /// Its outline.
    pub outline: Outline,
    /// What is left of the axis.
    pub axis: MedialAxis,
    /// The Hausdorff distance of the outline from the boundary, at most; in units of the input.
    pub distance: f64,
}

/// Why a shape cannot be smoothed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SmoothError {
    /// Nothing can be said of the significance of its axis.
    #[error(transparent)]
    Hierarchy(#[from] HierarchyError),
    /// What is left has no outline.
    #[error(transparent)]
    Outline(#[from] OutlineError),
}

/// Smooths the shape of an axis of the interior: what lies below a threshold of a measure is removed.
/// [`Measure::Prominence`] is that of Ho and Dyer; 0.1 is a good start.
///
/// ```
/// use medial::domain::{Domain, Options};
/// use medial::engine::path_tracing;
/// use medial::geom::Point;
/// use medial::ops::{Measure, smoothed};
///
/// // A blunt tip of height 0.1 on a block.
/// let ring = [(0., 0.), (6., 0.), (6., 4.), (3.3, 4.), (3., 4.1), (2.7, 4.), (0., 4.)];
/// let ring = ring.map(|(x, y)| Point::new(x, y));
/// let domain = Domain::from_polygons(&[vec![ring.to_vec()]], &Options::default())?;
/// let smooth = smoothed(&domain, &path_tracing(&domain)?, Measure::Prominence, 0.1)?;
/// assert!(0.0 < smooth.distance && smooth.distance < 0.1);
/// assert!(smooth.outline.area() < domain.area());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If the axis is not complete and exact, not of this domain, or not of the interior.
pub fn smoothed(
    domain: &Domain,
    axis: &MedialAxis,
    measure: Measure,
    threshold: f64,
) -> Result<Smoothed, SmoothError> {
    Hierarchy::new(domain, axis)?.smoothed(measure, threshold)
}

impl Hierarchy<'_> {
    /// What [`smoothed`] gives, for who has the hierarchy already.
    ///
    /// # Errors
    /// If the axis is not of the interior.
    pub fn smoothed(&self, measure: Measure, threshold: f64) -> Result<Smoothed, SmoothError> {
        let (rest, lost) = self.rest(measure, threshold);
        let (axis, distance) = rest.axis_and_error(&self.fire.roots, &lost);
        Ok(Smoothed { outline: Outline::new(&axis)?, axis, distance })
    }
}
