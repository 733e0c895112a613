//! The axis of the outside: that of the complement within a frame, without what the frame governs.
//!
//! # Contract
//! The exact medial axis of the complement of the polygons, holes included as components of their
//! own, as far as it lies in the inside of a frame. Where a path leaves the frame it ends in a
//! keypoint of kind `clipped`, with its true radius. The axis is complete if nothing but unbounded
//! paths is cut.
//!
//! # Method
//! 1. The complement is bounded by walls so far from the frame that no maximal disk with its centre
//!    inside the frame reaches them: none is larger than the diagonal of the frame, which holds the
//!    polygons. So inside the frame the axis of the complement is that of the outside, whoever
//!    computes it.
//! 2. Paths are cut at the frame, and what lies beyond is dropped (`cut.rs`).
//! 3. The cuts are compared with the gaps of the convex hull: a path between the two corners of a gap
//!    that leaves outwards meets nothing any more, since the disk only loses on the inner side of the
//!    gap as it grows, and on the outer side there is nothing. So if these are all the cuts there are,
//!    nothing but unbounded paths was lost.

mod cut;
mod frame;

use super::delaunay_dual::{self, delaunay_dual_of_mask};
use super::divide_and_conquer::{self, divide_and_conquer_with};
use super::draft::site_record;
use super::{
    Burning, EngineError, Options, RidgeOptions, brushfire, brushfire_of_domain, path_tracing_with,
    raster_transform, raster_transform_of_domain, ridge_following, ridge_following_of_mask,
};
use crate::axis::{Accuracy, Engine, KeypointKind, MedialAxis, Path, Side};
use crate::domain::{Complement, Domain, Site};
use crate::geom::{Point, Rect};
use crate::raster::Mask;
use cut::{Cut, End};
use frame::Frame;

/// The medial axis of the interior of a domain, by any engine.
///
/// # Errors
/// Those of [`path_tracing_with`] or [`divide_and_conquer_with`].
pub fn interior(
    domain: &Domain,
    engine: Engine,
    options: &Options<'_>,
) -> Result<MedialAxis, EngineError> {
    match engine {
        Engine::PathTracing => path_tracing_with(domain, options),
        Engine::DivideAndConquer => divide_and_conquer_with(domain, options),
        Engine::RasterTransform => raster_transform_of_domain(domain, options),
        Engine::RidgeFollowing => {
            ridge_following(domain, &RidgeOptions::default(), options).map(|ridges| ridges.axis)
        }
        Engine::Brushfire => brushfire_of_domain(domain, Burning::default(), options),
        Engine::DelaunayDual => delaunay_dual::delaunay_dual(domain, options),
    }
}

/// The sampled medial axis of a mask, by an engine on cells.
///
/// # Errors
/// Those of the engine; [`EngineError::NoMask`] if it takes no masks.
pub fn of_mask(
    mask: &Mask,
    engine: Engine,
    options: &Options<'_>,
) -> Result<MedialAxis, EngineError> {
    match engine {
        Engine::RasterTransform => raster_transform(mask, options),
        Engine::RidgeFollowing => ridge_following_of_mask(mask, &RidgeOptions::default(), options)
            .map(|ridges| ridges.axis),
        Engine::Brushfire => brushfire(mask, Burning::default(), options),
        Engine::DelaunayDual => delaunay_dual_of_mask(mask, options),
        Engine::PathTracing | Engine::DivideAndConquer => Err(EngineError::NoMask { engine }),
    }
}

/// The medial axis of the exterior of a domain inside a frame: the exact one by an exact engine, or that of
/// ridge following.
///
/// The frame is the box of the domain grown on all sides by `margin`, in units of the input; by its
/// own longer side if that is `None`.
///
/// ```
/// use medial::axis::{Engine, KeypointKind};
/// use medial::domain::{self, Domain};
/// use medial::engine::{Options, exterior};
/// use medial::geom::Point;
///
/// // The notch of an L sends one path to infinity, along the diagonal.
/// let corners = [(0., 0.), (2., 0.), (2., 1.), (1., 1.), (1., 2.), (0., 2.)];
/// let ring = corners.map(|(x, y)| Point::new(x, y)).to_vec();
/// let domain = Domain::from_polygons(&[vec![ring]], &domain::Options::default())?;
/// let axis = exterior(&domain, Engine::PathTracing, None, &Options::default())?;
/// let last = axis.keypoints().iter().find(|k| k.kind == KeypointKind::Clipped);
/// assert_eq!(last.map(|k| k.position), Some(Point::new(4.0, 4.0)));
/// assert!(axis.complete);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Those of [`interior`]; and [`EngineError::Frame`] if the margin is not positive, or too large.
pub fn exterior(
    domain: &Domain,
    engine: Engine,
    margin: Option<f64>,
    options: &Options<'_>,
) -> Result<MedialAxis, EngineError> {
    match engine {
        Engine::PathTracing | Engine::DivideAndConquer => {}
        Engine::RidgeFollowing => {
            let ridge = RidgeOptions { side: Side::Exterior, margin, ..RidgeOptions::default() };
            return ridge_following(domain, &ridge, options).map(|ridges| ridges.axis);
        }
        Engine::DelaunayDual => return delaunay_dual::outside(domain, margin, options),
        Engine::RasterTransform | Engine::Brushfire => {
            return Err(EngineError::NoExterior { engine });
        }
    }
    let frame = Frame::around(domain, margin)?;
    let outside = complement(domain, &frame)?;
    let whole = interior(outside.domain(), engine, options)?;
    within(&frame, &outside, &whole)
}

/// Both axes, as [`interior`] and [`exterior`] give them.
///
/// `divide_and_conquer` makes the diagrams of the rings once for both sides, unless boundaries touch;
/// with several threads each side is finished by one.
///
/// # Errors
/// Those of [`exterior`].
pub fn both_sides(
    domain: &Domain,
    engine: Engine,
    margin: Option<f64>,
    options: &Options<'_>,
) -> Result<[MedialAxis; 2], EngineError> {
    if !engine.is_exact() {
        let outer = exterior(domain, engine, margin, options)?;
        return Ok([interior(domain, engine, options)?, outer]);
    }
    let frame = Frame::around(domain, margin)?;
    let outside = complement(domain, &frame)?;
    let at_once = match engine {
        Engine::DivideAndConquer => divide_and_conquer::both_sides(domain, &outside, options)?,
        _ => None,
    };
    let [inner, whole] = match at_once {
        Some(axes) => axes,
        None => [interior(domain, engine, options)?, interior(outside.domain(), engine, options)?],
    };
    Ok([inner, within(&frame, &outside, &whole)?])
}

/// An error of ours, somewhere at a domain.
fn broken(domain: &Domain, stage: &'static str) -> EngineError {
    let place = domain.edges().first().map_or(Point::default(), |edge| edge.start);
    EngineError::Internal { stage, place }
}

fn complement(domain: &Domain, frame: &Frame) -> Result<Complement, EngineError> {
    Complement::new(domain, &frame.walls())
        .map_err(|_| broken(domain, "turning a domain inside out"))
}

/// The exterior axis, of the axis of the complement within walls.
fn within(
    frame: &Frame,
    outside: &Complement,
    whole: &MedialAxis,
) -> Result<MedialAxis, EngineError> {
    let broken = |stage| broken(outside.domain(), stage);
    let sites = sites_of(outside, whole).ok_or(broken("naming the sites of the outside"))?;
    let cut = Cut::new(frame, whole, |site| outside.is_frame(sites[site as usize].index()));
    assemble(outside, whole, &sites, &cut).ok_or(broken("cutting paths at the frame"))
}

/// The rectangle at which [`exterior`] cuts the axis with this margin.
///
/// # Errors
/// [`EngineError::Frame`] if the margin is not positive, or too large.
pub fn exterior_frame(domain: &Domain, margin: Option<f64>) -> Result<Rect, EngineError> {
    Frame::around(domain, margin).map(|frame| frame.bounds)
}

/// The sites of an axis as those of its domain: both are in boundary order.
fn sites_of(outside: &Complement, axis: &MedialAxis) -> Option<Vec<Site>> {
    let domain = outside.domain();
    let mut all = (0..2 * domain.edges().len() as u32).map(Site);
    axis.sites().iter().map(|site| all.find(|&s| site_record(domain, s) == site)).collect()
}

/// The axis of what is left, with sites numbered along the boundary of the inner domain.
fn assemble(
    outside: &Complement,
    whole: &MedialAxis,
    sites: &[Site],
    cut: &Cut,
) -> Option<MedialAxis> {
    let domain = outside.domain();
    let mut used = vec![false; sites.len()];
    for &keypoint in &cut.kept {
        whole.governors(keypoint).iter().for_each(|&g| used[g as usize] = true);
    }
    for piece in &cut.pieces {
        used[piece.left as usize] = true;
        used[piece.right as usize] = true;
    }
    let mut order: Vec<(Site, u32)> = Vec::new();
    for (number, _) in (0..).zip(&used).filter(|&(_, &used)| used) {
        order.push((outside.inner_site(sites[number as usize])?, number));
    }
    order.sort_unstable();
    let mut new = vec![0; sites.len()];
    let mut records = Vec::with_capacity(order.len());
    for (number, &(_, old)) in (0..).zip(&order) {
        new[old as usize] = number;
        let mut record = site_record(domain, sites[old as usize]);
        // Edges have the interior of the polygons to their left, whatever the side.
        std::mem::swap(&mut record.a, &mut record.b);
        records.push(record);
    }
    // The lists of all keypoints, each from its smallest number on.
    let mut lists: Vec<u32> = Vec::with_capacity(4 * cut.kept.len());
    let mut list = |governors: &[u32]| {
        let start = lists.len();
        lists.extend(governors.iter().map(|&g| new[g as usize]));
        let list = &mut lists[start..];
        let first = (0..list.len()).min_by_key(|&k| list[k]).unwrap_or(0);
        list.rotate_left(first);
        start..start + governors.len()
    };
    let mut keypoints = Vec::with_capacity(cut.kept.len() + cut.ends.len());
    let mut number = vec![None; whole.keypoints().len()];
    for &keypoint in &cut.kept {
        number[keypoint as usize] = Some(keypoints.len() as u32);
        let known = whole.keypoints().at(keypoint);
        keypoints.push((known.position, known.radius, known.kind, list(whole.governors(keypoint))));
    }
    let first = keypoints.len() as u32;
    for end in &cut.ends {
        let governors = list(&[end.right, end.left]);
        keypoints.push((end.position, end.radius, KeypointKind::Clipped, governors));
    }
    let at = |end: End| match end {
        End::Keypoint(keypoint) => number[keypoint as usize],
        End::Clipped(end) => Some(first + end),
    };
    let mut paths = Vec::with_capacity(cut.pieces.len());
    for piece in &cut.pieces {
        let (left, right) = (new[piece.left as usize], new[piece.right as usize]);
        paths.push(Path { from: at(piece.from)?, to: at(piece.to)?, left, right });
    }
    let mut gaps: Vec<_> =
        cut.ends.iter().map(|end| (sites[end.right as usize], sites[end.left as usize])).collect();
    let mut expected = outside.horizon().gaps;
    gaps.sort_unstable();
    expected.sort_unstable();
    let keypoints = keypoints
        .iter()
        .map(|(at, radius, kind, list)| (*at, *radius, *kind, &lists[list.clone()]));
    let complete = gaps == expected;
    let (engine, accuracy) = (whole.engine, Accuracy::Exact);
    MedialAxis::from_parts(engine, Side::Exterior, accuracy, complete, records, keypoints, paths)
}
