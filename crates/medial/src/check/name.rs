use std::fmt;

use crate::axis::{self, SiteKind};
use crate::domain::{Domain, Site};

/// A boundary element by its place in the input, as the axis document names it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Name {
    /// Edge or corner.
    pub kind: SiteKind,
    /// Polygon of the feature, from 0.
    pub polygon: u32,
    /// Ring of the polygon, from 0; 0 is the outer ring.
    pub ring: u32,
    /// Position in the ring as given.
    pub index: u32,
    /// Piece of a split edge, or which touch along an edge.
    pub part: u32,
}

impl From<&axis::Site> for Name {
    /// The name that an axis gives to one of its sites.
    #[inline]
    fn from(site: &axis::Site) -> Self {
        let axis::Site { kind, polygon, ring, index, part, .. } = *site;
        Self { kind, polygon, ring, index, part }
    }
}

impl Name {
    /// The name of a site of the domain; of any corner, also of one that is no site of an axis.
    #[inline]
    #[must_use]
    pub fn of(domain: &Domain, site: Site) -> Self {
        let origin = domain.origin(site.index());
        if site.is_edge() {
            Self {
                kind: SiteKind::Edge,
                polygon: origin.polygon,
                ring: origin.ring,
                index: origin.index,
                part: origin.part,
            }
        } else {
            Self {
                kind: SiteKind::Vertex,
                polygon: origin.corner.polygon,
                ring: origin.corner.ring,
                index: origin.corner.index,
                part: origin.corner.part,
            }
        }
    }
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let kind = match self.kind {
            SiteKind::Edge => "edge",
            SiteKind::Vertex => "vertex",
        };
        write!(f, "{kind} {}", self.index)?;
        if self.part > 0 {
            write!(f, " (part {})", self.part)?;
        }
        write!(f, " of ring {}", self.ring)?;
        if self.polygon > 0 {
            write!(f, " of polygon {}", self.polygon)?;
        }
        Ok(())
    }
}
