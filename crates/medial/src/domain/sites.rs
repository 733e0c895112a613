use super::{Corner, Domain, Site};
use crate::geom::Governor;
use crate::geom::predicates::Element;

impl Domain {
    /// A site as doubles compute with it.
    #[inline(always)]
    #[must_use]
    pub fn governor(&self, site: Site) -> Governor {
        let edge = self.edge(site.index());
        if site.is_edge() {
            let end = self.edge(edge.next).start;
            Governor::Edge { start: edge.start, end, direction: edge.direction }
        } else {
            Governor::Corner(edge.start)
        }
    }

    /// Three sites as doubles compute with them.
    #[inline(always)]
    #[must_use]
    pub fn governors(&self, [a, b, c]: [Site; 3]) -> [Governor; 3] {
        [self.governor(a), self.governor(b), self.governor(c)]
    }

    /// A site as exact predicates see it.
    #[inline]
    #[must_use]
    pub fn element(&self, site: Site) -> Element {
        let edge = self.edge(site.index());
        if site.is_edge() {
            Element::Edge(edge.start, self.edge(edge.next).start)
        } else {
            Element::Corner(edge.start)
        }
    }

    /// The sites of some edges: each edge, and the corner at its start unless that is convex.
    pub(crate) fn sites_among(
        &self,
        edges: impl IntoIterator<Item = u32>,
    ) -> impl Iterator<Item = Site> {
        let both = |k| [Site::corner(k), Site::edge(k)];
        let is_site = |s: &Site| s.is_edge() || self.edge(s.index()).corner != Corner::Convex;
        edges.into_iter().flat_map(both).filter(is_site)
    }

    /// The element after a site along the boundary, with convex corners passed over.
    #[inline]
    #[must_use]
    pub fn ahead(&self, site: Site) -> Site {
        if !site.is_edge() {
            return Site::edge(site.index());
        }
        let next = self.edge(site.index()).next;
        if self.edge(next).corner == Corner::Convex { Site::edge(next) } else { Site::corner(next) }
    }

    /// The element before a site along the boundary, with convex corners passed over.
    #[inline]
    #[must_use]
    pub fn behind(&self, site: Site) -> Site {
        let edge = self.edge(site.index());
        if !site.is_edge() || edge.corner == Corner::Convex {
            Site::edge(edge.prev)
        } else {
            Site::corner(site.index())
        }
    }
}
