use std::fmt;
use std::ops::Range;

use super::keypoints::{KeypointTable, Keypoints};
use super::paths::{PathTable, Paths};
use super::sites::{SiteShape, SiteTable, Sites};
use crate::geom::Point;

/// The engine that computed an axis; `Display` gives its name in files and commands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Engine {
    /// Tracing of paths after Joan-Arinyo, Pérez and Vilaplana: exact.
    PathTracing,
    /// Divide and conquer after Lee: exact.
    DivideAndConquer,
    /// Distances and thinning on cells: sampled, with the topology of the mask.
    RasterTransform,
    /// Following of ridges from cell to cell after Volkmann and St. Clair: sampled.
    RidgeFollowing,
    /// Burning of cells layer by layer: sampled.
    Brushfire,
    /// The dual of the Delaunay graph of samples of the boundary: sampled, with the topology of the shape.
    DelaunayDual,
}

impl Engine {
    /// Whether axes of this engine are exact.
    #[must_use]
    pub const fn is_exact(self) -> bool {
        matches!(self, Self::PathTracing | Self::DivideAndConquer)
    }
}

/// The side of the boundary on which an axis lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Side {
    /// Inside the polygons.
    Interior,
    /// Outside of all of them, holes included.
    Exterior,
}

/// How true an axis is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Accuracy {
    /// Graph and governors are those of the exact axis; coordinates are rounded once.
    Exact,
    /// Found from samples this far apart, in units of the input.
    Sampled(f64),
}

/// Kind of a boundary element.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum SiteKind {
    /// An open edge.
    Edge,
    /// A corner that is reflex as seen from the side of the axis.
    Vertex,
}

/// A boundary element that governs something, with its place in the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Site {
    /// Edge or reflex corner.
    pub kind: SiteKind,
    /// Polygon of the feature, from 0.
    pub polygon: u32,
    /// Ring of the polygon, from 0; 0 is the outer ring.
    pub ring: u32,
    /// Position in the ring as given.
    pub index: u32,
    /// Piece of a split edge, counted in input direction; 0 if unsplit, and for corners.
    pub part: u32,
    /// Start of the edge, or the corner.
    pub a: Point,
    /// End of the edge, with the interior of the polygons to the left of `a` → `b`, whatever the side
    /// of the axis; the corner again for a corner.
    pub b: Point,
}

/// Kind of a keypoint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum KeypointKind {
    /// A convex corner, radius 0.
    End,
    /// Degree two: one governor changes, or both do.
    Transition,
    /// Degree three or more.
    Junction,
    /// Degree one or none: where an axis that is not complete was cut or pruned; any two governors.
    Tip,
    /// Degree one: where a path of an exterior axis leaves the frame.
    Clipped,
}

/// A point of the axis where paths end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Keypoint {
    /// Centre of the maximal disk.
    pub position: Point,
    /// Radius of the maximal disk; 0 at an end.
    pub radius: f64,
    /// What meets here.
    pub kind: KeypointKind,
}

/// A piece of the axis with the same two governors all along.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Path {
    /// Keypoint where the path starts.
    pub from: u32,
    /// Keypoint where the path ends.
    pub to: u32,
    /// Governor to the left of the direction `from` → `to`.
    pub left: u32,
    /// Governor to the right of that direction.
    pub right: u32,
}

impl Path {
    /// The same path from its end to its start.
    #[must_use]
    pub const fn reversed(self) -> Self {
        Self { from: self.to, to: self.from, left: self.right, right: self.left }
    }
}

/// A medial axis: sites, keypoints and paths.
#[derive(Clone, PartialEq)]
pub struct MedialAxis {
    /// Who computed it.
    pub engine: Engine,
    /// Exact, or the sample distance.
    pub accuracy: Accuracy,
    /// False when something was pruned, cut or dropped.
    pub complete: bool,
    /// Side of the boundary.
    pub side: Side,
    sites: SiteTable,
    keypoints: KeypointTable,
    paths: PathTable,
}

impl MedialAxis {
    /// The axis with these parts; `keypoints` come with their cyclic governor lists.
    ///
    /// A list starts with its smallest site number. Returns `None` if a number points outside its
    /// table, or if the sites have 2³⁰ end points. Sites in boundary order take least memory.
    #[must_use]
    pub fn from_parts<'a>(
        engine: Engine,
        side: Side,
        accuracy: Accuracy,
        complete: bool,
        sites: Vec<Site>,
        keypoints: impl IntoIterator<Item = (Point, f64, KeypointKind, &'a [u32])>,
        paths: Vec<Path>,
    ) -> Option<Self> {
        let sites = SiteTable::of(sites.into_iter())?;
        let mut table = KeypointTable::default();
        for (position, radius, kind, list) in keypoints {
            if list.iter().any(|&g| g >= sites.len()) {
                return None;
            }
            table.push(&Keypoint { position, radius, kind }, list.iter().copied());
        }
        let paths = PathTable::of(paths.into_iter(), &table);
        let sound = paths.numbers_below(table.len(), sites.len());
        sound.then(|| Self::from_tables(engine, side, accuracy, complete, sites, table, paths))
    }

    /// The axis with these tables. Every number must point into its table.
    pub(crate) fn from_tables(
        engine: Engine,
        side: Side,
        accuracy: Accuracy,
        complete: bool,
        sites: SiteTable,
        keypoints: KeypointTable,
        paths: PathTable,
    ) -> Self {
        debug_assert!(keypoints.governors_below(sites.len()));
        debug_assert!(paths.numbers_below(keypoints.len(), sites.len()));
        Self { engine, accuracy, complete, side, sites, keypoints, paths }
    }

    /// Boundary elements that govern something.
    #[must_use]
    pub fn sites(&self) -> Sites<'_> {
        Sites(&self.sites)
    }

    /// A site without its place in the input, which takes a search.
    #[inline]
    pub(crate) fn site_shape(&self, site: u32) -> SiteShape {
        self.sites.shape(site)
    }

    /// A table of those sites whose number is not `u32::MAX`; each gets its number there.
    pub(crate) fn sites_among(&self, numbers: &mut [u32]) -> SiteTable {
        self.sites.among(numbers)
    }

    /// How many places there are for governors, if the lists of all keypoints stand in one row.
    pub(crate) fn n_places(&self) -> usize {
        self.keypoints.n_places()
    }

    /// The places of the governors of a keypoint in that row.
    #[inline]
    pub(crate) fn places(&self, keypoint: u32) -> Range<usize> {
        self.keypoints.places(keypoint)
    }

    /// The place of a governor of a keypoint in that row.
    #[inline(always)]
    pub(crate) fn place_of(&self, keypoint: u32, governor: u32) -> Option<usize> {
        self.keypoints.place_of(keypoint, governor)
    }

    /// The table of all sites.
    pub(crate) fn all_sites(&self) -> SiteTable {
        self.sites.clone()
    }

    /// A table of the keypoints of which something is left, as [`KeypointTable::left`] has it.
    #[inline]
    pub(crate) fn keypoints_left(
        &self,
        room: [usize; 2],
        left: &mut [u32],
        kind: impl Fn(u32, KeypointKind) -> KeypointKind,
        show: impl FnMut(u32),
    ) -> KeypointTable {
        self.keypoints.left(room, left, kind, show)
    }

    /// Adds a path to a table between two keypoints, of which the first one is such a copy of that where it
    /// starts here.
    #[inline]
    pub(crate) fn copy_path(
        &self,
        table: &mut PathTable,
        path: u32,
        ends: [u32; 2],
        site: impl Fn(u32) -> u32,
    ) {
        table.push_of(&self.paths, path, ends, site);
    }

    /// All keypoints.
    #[inline]
    #[must_use]
    pub fn keypoints(&self) -> Keypoints<'_> {
        Keypoints(&self.keypoints)
    }

    /// All paths.
    #[inline]
    #[must_use]
    pub fn paths(&self) -> Paths<'_> {
        Paths { paths: &self.paths, keypoints: &self.keypoints }
    }

    /// Governors of keypoint number `keypoint`, as numbers of [`sites`](Self::sites):
    /// counterclockwise by footpoint, starting with the smallest.
    ///
    /// # Panics
    /// If the axis has no such keypoint.
    #[inline]
    #[must_use]
    pub fn governors(&self, keypoint: u32) -> &[u32] {
        self.keypoints.governors(keypoint)
    }
}

impl fmt::Debug for MedialAxis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { engine, accuracy, complete, side, .. } = self;
        let numbers = 0..self.keypoints.len();
        f.debug_struct("MedialAxis")
            .field("engine", engine)
            .field("accuracy", accuracy)
            .field("complete", complete)
            .field("side", side)
            .field("sites", &self.sites())
            .field("keypoints", &self.keypoints())
            .field("governors", &numbers.map(|k| self.governors(k)).collect::<Vec<_>>())
            .field("paths", &self.paths())
            .finish()
    }
}
