//! An axis from what was kept of it.

use super::super::groups::Groups;
use super::{CellError, CompressedMask, DiskGraph};
use crate::axis::{Accuracy, Engine, KeypointKind, MedialAxis, Path, Side, Site};
use crate::domain::{Domain, DomainError, Options};
use crate::engine::{self, EngineError};
use crate::geom::Point;

/// The corners of polygons, from which their exact axis follows.
#[derive(Clone, Debug, PartialEq)]
pub struct Corners {
    /// Who computes the axis.
    pub engine: Engine,
    /// Whether rings are outer rings or holes by their depth, as [`Options::regroup`] wants it.
    pub regroup: bool,
    /// How far the boundary of these polygons and the original one are apart at most, in units of the
    /// input; 0 if they are the original ones, bit for bit.
    pub error: f64,
    /// The polygons: each an outer ring and its holes, in units of the input.
    pub polygons: Vec<Vec<Vec<Point>>>,
}

/// What stands for the shape and the axis of a feature.
#[derive(Clone, Debug, PartialEq)]
pub enum Compressed {
    /// Disks, within an error.
    Disks(DiskGraph),
    /// The polygons themselves.
    Corners(Corners),
    /// Cells of a mask.
    Mask(CompressedMask),
}

/// Why corners have no axis.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RebuildError {
    /// They bound no domain.
    #[error(transparent)]
    Domain(#[from] DomainError),
    /// There are too many disks to be numbered.
    #[error("there are more disks than an axis can have")]
    TooLarge,
    /// The cells are no mask.
    #[error(transparent)]
    Cells(#[from] CellError),
    /// The engine gave up.
    #[error(transparent)]
    Engine(#[from] EngineError),
}

impl Compressed {
    /// How far the boundary of what is rebuilt and the original one are apart at most, in units of the
    /// input; 0 for corners that were not simplified.
    #[must_use]
    pub fn error(&self) -> f64 {
        match self {
            Self::Disks(graph) => graph.error(),
            Self::Corners(corners) => corners.error,
            Self::Mask(mask) => mask.error,
        }
    }

    /// The axis: see [`DiskGraph::axis`]; from corners it is computed once more and exact;
    /// for masks see [`CompressedMask::axis`].
    ///
    /// # Errors
    /// If corners bound no domain, or there are too many of them, or too many disks: nothing that was
    /// compressed has these faults.
    pub fn axis(&self) -> Result<MedialAxis, RebuildError> {
        match self {
            Self::Disks(graph) => graph.axis().ok_or(RebuildError::TooLarge),
            Self::Mask(mask) => mask.axis(),
            Self::Corners(corners) => {
                let Corners { engine, regroup, ref polygons, .. } = *corners;
                let options = Options { regroup, ..Options::default() };
                let domain = Domain::from_polygons(polygons, &options)?;
                Ok(engine::interior(&domain, engine, &engine::Options::default())?)
            }
        }
    }
}

impl DiskGraph {
    /// The graph as an axis of the inside: a keypoint for each disk, and for each link a path whose curve
    /// is a line with linear radius. It is sampled with the error as its accuracy, and not complete.
    ///
    /// The governors of a path are the two common tangents of its disks, which are edges of the shape of
    /// the disks, not of the one that was compressed; all are numbered as edges of ring 0 of polygon 0.
    /// Where one disk lies in the other there are no tangents, and both governors lie on the line.
    ///
    /// Returns `None` if there are so many links, 2^28 or more, that their sites cannot be numbered.
    ///
    /// ```
    /// use medial::axis::{Accuracy, Engine};
    /// use medial::ops::{DiskGraph, GridDisk, Run};
    ///
    /// let disks = [(0, 0, 1), (4, 0, 1)].map(|(x, y, radius)| GridDisk { x, y, radius }).to_vec();
    /// let runs = vec![Run { from: None, len: 2, to: None }];
    /// let graph = DiskGraph::new(Engine::PathTracing, 0, 0.25, disks, runs).ok_or("off the grid")?;
    /// let axis = graph.axis().ok_or("too many links")?;
    /// assert_eq!((axis.keypoints().len(), axis.paths().len()), (2, 1));
    /// assert_eq!(axis.accuracy, Accuracy::Sampled(0.25));
    /// let left = axis.sites().at(axis.paths().at(0).left);
    /// assert_eq!((left.a.y, left.b.y), (1.0, 1.0));
    /// # Ok::<(), &str>(())
    /// ```
    #[must_use]
    pub fn axis(&self) -> Option<MedialAxis> {
        let n = self.disks().len();
        let links: Vec<[u32; 2]> = self.links().collect();
        let ends = || (0..).zip(&links).flat_map(|(k, &[a, b])| [(a, 2 * k), (b, 2 * k + 1)]);
        let at = Groups::new(n, ends);
        let mut sites = Vec::with_capacity(2 * links.len());
        let mut paths = Vec::with_capacity(links.len());
        for &[from, to] in &links {
            let left = sites.len() as u32;
            let [left_side, right_side] = tangents(self.disk(from), self.disk(to));
            for mut site in [left_side, right_side] {
                site.index = sites.len() as u32;
                sites.push(site);
            }
            paths.push(Path { from, to, left, right: left + 1 });
        }
        let lists: Vec<Vec<u32>> = (0..n as u32)
            .map(|disk| {
                let centre = self.disk(disk).0;
                let governors = at.of(disk).iter().flat_map(|&end| {
                    let first = end & !1;
                    // Both start with the disk where the path ends, or both end with it.
                    let is_start = end & 1 == 0;
                    [(first, !is_start), (first + 1, is_start)]
                });
                let mut turned: Vec<(f64, u32)> = governors
                    .map(|(number, starts)| {
                        let site = sites[number as usize];
                        let away = (if starts { site.a } else { site.b }) - centre;
                        (away.y.atan2(away.x), number)
                    })
                    .collect();
                turned.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
                let mut list: Vec<u32> = turned.into_iter().map(|(_, number)| number).collect();
                let least = (0..list.len()).min_by_key(|&k| list[k]).unwrap_or(0);
                list.rotate_left(least);
                list
            })
            .collect();
        let keypoints = (0..n as u32).map(|number| {
            let (centre, radius) = self.disk(number);
            let kind = match at.of(number).len() {
                0 | 1 if radius > 0.0 => KeypointKind::Tip,
                0 | 1 => KeypointKind::End,
                2 => KeypointKind::Transition,
                _ => KeypointKind::Junction,
            };
            (centre, radius, kind, &lists[number as usize][..])
        });
        let accuracy = Accuracy::Sampled(self.error());
        let engine = self.engine();
        MedialAxis::from_parts(engine, Side::Interior, accuracy, false, sites, keypoints, paths)
    }
}

/// The common tangents of two disks, to the left and to the right of the way from one to the other, each
/// with the disks on its left.
fn tangents(from: (Point, f64), to: (Point, f64)) -> [Site; 2] {
    let way = to.0 - from.0;
    let length = way.norm();
    let along = if length > 0.0 { way * (1.0 / length) } else { Point::new(1.0, 0.0) };
    // The sine of the angle by which the normals turn to the end of the way.
    let sine = ((from.1 - to.1) / length).clamp(-1.0, 1.0);
    let sine = if sine.is_nan() { 0.0 } else { sine };
    let across = along.perp() * (1.0 - sine * sine).max(0.0).sqrt();
    let at = |disk: (Point, f64), normal: Point| disk.0 + normal * disk.1;
    let [left, right] = [along * sine + across, along * sine - across];
    [Site::edge(at(to, left), at(from, left)), Site::edge(at(from, right), at(to, right))]
}
