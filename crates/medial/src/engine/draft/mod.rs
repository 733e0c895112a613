//! What an engine has found, and the axis made of it: governor lists in their order, keypoints in their
//! places, sites by number. Engines share this, and no search.

pub(super) mod contacts;
mod numbers;
mod positions;
mod refine;

pub(super) use positions::{Fixed, Place};

use super::EngineError;
use super::watch::Watch;
use crate::axis::{
    self, Accuracy, Engine, Keypoint, KeypointKind, KeypointTable, MedialAxis, Path, PathTable,
    Side, SiteKind, SiteTable,
};
use crate::domain::{Domain, Origin, Site};
use crate::geom::{Point, TouchingDisk};
use numbers::Numbers;
use positions::position;

/// Most that the distance of a keypoint's boundary from that of its exact disk is, in any direction,
/// relative to max(|x|, |y|, radius).
///
/// Each of the three numbers is within two units in the last place, or within three together and
/// rounded once.
pub(super) const PLACED: f64 = 6.0 * f64::EPSILON;

/// Keypoints and paths, with sites by their numbers in the domain.
#[derive(Debug, Default)]
pub(super) struct Traced {
    pub keypoints: KeypointTable,
    pub paths: PathTable,
}

/// How much was traced at some moment.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Mark {
    keypoints: u32,
    paths: u32,
}

impl Traced {
    /// Nothing traced yet, with room for what a domain of so many edges and holes has at most,
    /// unless rings touch: two keypoints an edge and two a hole.
    ///
    /// Tables that grow may leave what they were behind in memory; room is not, until it is used.
    pub fn with_room(n_edges: usize, n_holes: usize) -> Self {
        let n_keypoints = 2 * (n_edges + n_holes);
        Self {
            keypoints: KeypointTable::with_room(n_keypoints),
            paths: PathTable::with_room(n_keypoints + n_holes),
        }
    }

    pub fn mark(&self) -> Mark {
        Mark { keypoints: self.keypoints.len(), paths: self.paths.len() }
    }

    /// Keypoints traced since.
    pub fn since(&self, mark: Mark) -> usize {
        (self.keypoints.len() - mark.keypoints) as usize
    }

    /// Forgets what was traced since.
    pub fn go_back(&mut self, mark: Mark) {
        self.keypoints.truncate(mark.keypoints);
        self.paths.truncate(mark.paths);
    }

    /// Whether a keypoint has these governors, from the smallest one on.
    pub fn has_governors(&self, keypoint: u32, list: &[Site]) -> bool {
        let own = self.keypoints.governors(keypoint);
        own.len() == list.len() && own.iter().zip(list).all(|(&a, b)| a == b.0)
    }

    /// Governors of a keypoint, from the smallest one on.
    pub fn governors_of(&self, keypoint: u32) -> Vec<Site> {
        self.keypoints.governors(keypoint).iter().copied().map(Site).collect()
    }

    /// Adds a keypoint with its governors, from the smallest one on.
    #[inline]
    pub fn add(&mut self, position: Point, radius: f64, kind: KeypointKind, list: &[Site]) -> u32 {
        let number = self.keypoints.len();
        let keypoint = Keypoint { position, radius, kind };
        self.keypoints.push(&keypoint, list.iter().map(|site| site.0));
        number
    }

    /// Adds a path that starts at a keypoint traced already.
    #[inline]
    pub fn add_path(&mut self, path: &Path) {
        self.paths.push(path, &self.keypoints);
    }

    /// A path.
    pub fn path(&self, path: u32) -> Path {
        self.paths.at(path, &self.keypoints)
    }

    /// Adds a keypoint as precisely as promised, with its governors from the smallest one on.
    #[inline]
    pub fn add_disk(
        &mut self,
        domain: &Domain,
        disk: &Fixed<'_>,
        kind: KeypointKind,
        list: &[Site],
    ) -> Result<u32, EngineError> {
        let (centre, radius) = match disk.own.filter(|own| own.is_precise()) {
            Some(own) => (own.position(), own.radius),
            None => position(domain, list, disk).ok_or_else(|| EngineError::Internal {
                stage: "placing a keypoint",
                place: disk.found.position(),
            })?,
        };
        Ok(self.add(centre, radius, kind, list))
    }

    /// The disk of a keypoint.
    pub fn disk(&self, keypoint: u32) -> TouchingDisk {
        let Keypoint { position: origin, radius, .. } = self.keypoints.at(keypoint);
        let bound = PLACED * origin.x.abs().max(origin.y.abs()).max(radius);
        TouchingDisk { origin, centre: Point::default(), radius, bound }
    }

    /// The axis, with the sites that govern something numbered in boundary order.
    pub fn finish(
        mut self,
        domain: &Domain,
        watch: &Watch<'_>,
        engine: Engine,
    ) -> Result<MedialAxis, EngineError> {
        watch.check_now()?;
        self.keypoints.shrink();
        self.paths.shrink();
        watch.check_now()?;
        let number = Numbers::new(2 * domain.edges().len(), |marks| {
            self.keypoints.show_governors(|site| marks.mark(site));
        });
        watch.check_now()?;
        self.keypoints.renumber(|site| number.of(site));
        watch.check_now()?;
        self.paths.renumber(|site| number.of(site));
        let sites = site_table(domain, &number)?;
        watch.check_now()?;
        drop(number);
        Ok(axis_of(engine, sites, self.keypoints, self.paths))
    }
}

/// The axis with these tables.
pub(super) fn axis_of(
    engine: Engine,
    sites: SiteTable,
    keypoints: KeypointTable,
    paths: PathTable,
) -> MedialAxis {
    let (side, accuracy) = (Side::Interior, Accuracy::Exact);
    MedialAxis::from_tables(engine, side, accuracy, true, sites, keypoints, paths)
}

/// The table of the sites that have a new number.
fn site_table(domain: &Domain, number: &Numbers) -> Result<SiteTable, EngineError> {
    let n_edges = domain.edges().len();
    let mut sites = SiteTable::with_room(number.len(), n_edges, domain.walks().len());
    for edge in 0..n_edges as u32 {
        let [corner, side] = [Site::corner(edge), Site::edge(edge)].map(|s| number.has(s.0));
        if corner || side {
            let origin = domain.origin(edge);
            let corner = !corner || sites.put(&corner_record(domain, edge, &origin)).is_some();
            let side = !side || sites.put(&edge_record(domain, edge, &origin)).is_some();
            if !corner || !side {
                return Err(EngineError::TooLarge { n_edges });
            }
        }
    }
    sites.shrink();
    Ok(sites)
}

/// What an axis says of a site.
pub(super) fn site_record(domain: &Domain, site: Site) -> axis::Site {
    let edge = site.index();
    let origin = domain.origin(edge);
    if site.is_edge() {
        edge_record(domain, edge, &origin)
    } else {
        corner_record(domain, edge, &origin)
    }
}

#[inline]
fn edge_record(domain: &Domain, edge: u32, origin: &Origin) -> axis::Site {
    axis::Site {
        kind: SiteKind::Edge,
        polygon: origin.polygon,
        ring: origin.ring,
        index: origin.index,
        part: origin.part,
        a: domain.edge(edge).start,
        b: domain.end(edge),
    }
}

#[inline]
fn corner_record(domain: &Domain, edge: u32, origin: &Origin) -> axis::Site {
    let at = domain.edge(edge).start;
    axis::Site {
        kind: SiteKind::Vertex,
        polygon: origin.corner.polygon,
        ring: origin.corner.ring,
        index: origin.corner.index,
        part: origin.corner.part,
        a: at,
        b: at,
    }
}
