//! One side of the boundary: a domain with that side to the left of its edges.

use crate::axis::{self, MedialAxis, Side, SiteKind};
use crate::check::Name;
use crate::domain::{Complement, Corner, Domain, Site, Walk};
use crate::geom::Rect;

/// The boundary as one side sees it: with itself to the left of the edges.
#[derive(Debug)]
pub(super) enum Ground<'a> {
    Inside(&'a Domain),
    Outside(Box<Complement>),
}

impl<'a> Ground<'a> {
    /// The ground of a side, within a frame outside.
    ///
    /// `None` if the frame does not hold the domain.
    pub fn new(domain: &'a Domain, side: Side, frame: &Rect) -> Option<Self> {
        match side {
            Side::Interior => Some(Self::Inside(domain)),
            Side::Exterior => {
                Complement::new(domain, frame).ok().map(|outside| Self::Outside(Box::new(outside)))
            }
        }
    }

    /// The domain of that side; outside within walls.
    pub fn domain(&self) -> &Domain {
        match self {
            Self::Inside(domain) => domain,
            Self::Outside(outside) => outside.domain(),
        }
    }

    pub fn side(&self) -> Side {
        match self {
            Self::Inside(_) => Side::Interior,
            Self::Outside(_) => Side::Exterior,
        }
    }

    /// The boundary walks, without the walls.
    pub fn walks(&self) -> &[Walk] {
        match self {
            Self::Inside(domain) => domain.walks(),
            Self::Outside(outside) => &outside.domain().walks()[1..],
        }
    }

    /// All edges and corners but those of the walls, along the boundary of the polygons.
    pub fn elements(&self) -> Vec<Site> {
        let all = (0..2 * self.domain().edges().len() as u32).map(Site);
        match self {
            Self::Inside(_) => all.collect(),
            Self::Outside(_) => {
                let mut all: Vec<Site> = all.filter(|&site| self.place(site).is_some()).collect();
                all.sort_by_key(|&site| self.place(site));
                all
            }
        }
    }

    /// The element behind each site of an axis, found by its name and its coordinates.
    ///
    /// # Errors
    /// The name of a site that the domain does not have.
    pub fn governors(&self, axis: &MedialAxis) -> Result<Vec<Site>, Name> {
        // Inside, elements are in the order of their numbers.
        let listed = matches!(self, Self::Outside(_)).then(|| self.elements());
        let n_elements = listed.as_ref().map_or(2 * self.domain().edges().len(), Vec::len);
        let element = |k: usize| listed.as_ref().map_or(Site(k as u32), |elements| elements[k]);
        let mut next = 0;
        // Made only if sites do not come in boundary order.
        let mut sorted: Option<Vec<(Name, Site)>> = None;
        let mut governor = |site: axis::Site| -> Result<Site, Name> {
            /// Corners without a cell between two that have one, mostly.
            const NEAR: usize = 4;
            let mut ahead = next..n_elements.min(next + NEAR);
            if let Some(place) = ahead.find(|&place| self.is_named(element(place), &site)) {
                next = place + 1;
                return Ok(element(place));
            }
            let names = sorted.get_or_insert_with(|| {
                let named = |site| (Name::of(self.domain(), site), site);
                let elements = (0..n_elements).map(&element);
                let mut names: Vec<(Name, Site)> = elements.map(named).collect();
                names.sort_unstable();
                names
            });
            let axis::Site { kind, polygon, ring, index, part, .. } = site;
            let name = Name { kind, polygon, ring, index, part };
            let found = names.binary_search_by(|(known, _)| known.cmp(&name));
            let found = found.ok().map(|k| names[k].1).filter(|&e| self.is_named(e, &site));
            let found = found.ok_or(name)?;
            // What follows lies behind it, if anywhere.
            next = match &listed {
                None => found.0 as usize + 1,
                Some(list) => list.partition_point(|&e| self.place(e) <= self.place(found)),
            };
            Ok(found)
        };
        let mut governors = Vec::with_capacity(axis.sites().len());
        for site in axis.sites().in_order() {
            governors.push(governor(site)?);
        }
        Ok(governors)
    }

    /// The place of an element along the boundary of the polygons; `None` for the walls.
    pub fn place(&self, site: Site) -> Option<Site> {
        match self {
            Self::Inside(_) => Some(site),
            Self::Outside(outside) => outside.inner_site(site),
        }
    }

    /// Whether an element has a cell on this side.
    pub fn has_cell(&self, site: Site) -> bool {
        site.is_edge() || self.domain().edge(site.index()).corner == Corner::Reflex
    }

    /// Whether an axis lists an element so.
    #[inline(always)]
    fn is_named(&self, element: Site, site: &axis::Site) -> bool {
        let domain = self.domain();
        // The interior of the polygons is on the left, whatever the side.
        let (start, end) = match self {
            Self::Inside(_) => (site.a, site.b),
            Self::Outside(_) => (site.b, site.a),
        };
        let is_edge = element.is_edge();
        if is_edge != (site.kind == SiteKind::Edge) {
            return false;
        }
        let edge = domain.edge(element.index());
        // The name takes longest.
        edge.start == start
            && end == if is_edge { domain.edge(edge.next).start } else { start }
            && domain.is_from(element, [site.polygon, site.ring, site.index, site.part])
    }

    /// An element as an axis lists it.
    pub fn named(&self, site: Site) -> axis::Site {
        let domain = self.domain();
        let Name { kind, polygon, ring, index, part } = Name::of(domain, site);
        let start = domain.edge(site.index()).start;
        let end = if site.is_edge() { domain.end(site.index()) } else { start };
        let (a, b) = match self {
            Self::Inside(_) => (start, end),
            // The interior of the polygons is on the left, whatever the side.
            Self::Outside(_) => (end, start),
        };
        axis::Site { kind, polygon, ring, index, part, a, b }
    }
}
