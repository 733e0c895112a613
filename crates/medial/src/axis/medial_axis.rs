use super::sites::{SiteTable, Sites};
use crate::geom::Point;

/// The engine that computed an axis; `Display` gives its name in files and commands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Engine {
    /// Tracing of paths after Joan-Arinyo, Pérez and Vilaplana: exact.
    PathTracing,
}

/// The side of the boundary on which an axis lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Side {
    /// Inside the polygons.
    Interior,
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
    /// A reflex corner.
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
    /// End of the edge, with the interior to the left of `a` → `b`; the corner again for a corner.
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
    /// Where the keypoint's governors start in the axis's list; see [`MedialAxis::governors`].
    governors: u32,
}

impl Keypoint {
    /// A keypoint whose governors start at `governors` in the common list.
    pub(crate) fn new(position: Point, radius: f64, kind: KeypointKind, governors: u32) -> Self {
        Self { position, radius, kind, governors }
    }

    /// Where its governors start in the common list.
    pub(crate) fn first_governor(&self) -> u32 {
        self.governors
    }

    /// The same with its governors at another place of the list.
    pub(crate) fn with_governors(self, governors: u32) -> Self {
        Self { governors, ..self }
    }
}

/// Governors of one of these keypoints, which share a list in their order.
pub(crate) fn governors<'a>(keypoints: &[Keypoint], all: &'a [u32], keypoint: u32) -> &'a [u32] {
    let keypoint = keypoint as usize;
    let first = keypoints[keypoint].governors as usize;
    let last = keypoints.get(keypoint + 1).map_or(all.len(), |k| k.governors as usize);
    &all[first..last]
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

/// A medial axis: sites, keypoints and paths.
#[derive(Clone, Debug, PartialEq)]
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
    keypoints: Vec<Keypoint>,
    governors: Vec<u32>,
    paths: Vec<Path>,
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
        let mut table = Vec::new();
        let mut governors = Vec::new();
        for (position, radius, kind, list) in keypoints {
            table.push(Keypoint::new(position, radius, kind, governors.len() as u32));
            governors.extend_from_slice(list);
        }
        let sites = SiteTable::of(sites.into_iter())?;
        Self::from_tables(engine, side, accuracy, complete, sites, table, governors, paths)
    }

    /// The axis with these tables, if every number points into its table.
    #[allow(clippy::too_many_arguments)]
    pub(crate) fn from_tables(
        engine: Engine,
        side: Side,
        accuracy: Accuracy,
        complete: bool,
        sites: SiteTable,
        keypoints: Vec<Keypoint>,
        governors: Vec<u32>,
        paths: Vec<Path>,
    ) -> Option<Self> {
        let (n_sites, n_keypoints) = (sites.len(), keypoints.len() as u32);
        let sound = governors.iter().all(|&g| g < n_sites)
            && paths.iter().all(|p| {
                p.from < n_keypoints && p.to < n_keypoints && p.left < n_sites && p.right < n_sites
            });
        let axis = Self { engine, accuracy, complete, side, sites, keypoints, governors, paths };
        sound.then_some(axis)
    }

    /// Boundary elements that govern something.
    #[must_use]
    pub fn sites(&self) -> Sites<'_> {
        Sites(&self.sites)
    }

    /// All keypoints.
    #[must_use]
    pub fn keypoints(&self) -> &[Keypoint] {
        &self.keypoints
    }

    /// All paths.
    #[must_use]
    pub fn paths(&self) -> &[Path] {
        &self.paths
    }

    /// Governors of keypoint number `keypoint`, as numbers of [`sites`](Self::sites):
    /// counterclockwise by footpoint, starting with the smallest.
    #[must_use]
    pub fn governors(&self, keypoint: u32) -> &[u32] {
        governors(&self.keypoints, &self.governors, keypoint)
    }
}
