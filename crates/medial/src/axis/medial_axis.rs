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
    /// Range of the keypoint's governors in the axis's list; see [`MedialAxis::governors`].
    pub(super) governors: (u32, u32),
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
    sites: Vec<Site>,
    keypoints: Vec<Keypoint>,
    governors: Vec<u32>,
    paths: Vec<Path>,
}

impl MedialAxis {
    /// The axis with these parts; `keypoints` come with their cyclic governor lists.
    ///
    /// A list starts with its smallest site number. Returns `None` if a number points outside its
    /// table.
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
        let mut axis = Self {
            engine,
            accuracy,
            complete,
            side,
            sites,
            keypoints: Vec::new(),
            governors: Vec::new(),
            paths,
        };
        let n_sites = axis.sites.len() as u32;
        for (position, radius, kind, list) in keypoints {
            let first = axis.governors.len() as u32;
            axis.governors.extend_from_slice(list);
            let governors = (first, axis.governors.len() as u32);
            axis.keypoints.push(Keypoint { position, radius, kind, governors });
        }
        let n_keypoints = axis.keypoints.len() as u32;
        let sound = axis.governors.iter().all(|&g| g < n_sites)
            && axis.paths.iter().all(|p| {
                p.from < n_keypoints && p.to < n_keypoints && p.left < n_sites && p.right < n_sites
            });
        sound.then_some(axis)
    }

    /// Boundary elements that govern something.
    #[must_use]
    pub fn sites(&self) -> &[Site] {
        &self.sites
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
        let (first, last) = self.keypoints[keypoint as usize].governors;
        &self.governors[first as usize..last as usize]
    }
}
