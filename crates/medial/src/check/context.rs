use super::enclosure::norm1;
use super::{Defect, Name};
use crate::axis::MedialAxis;
use crate::domain::{Complement, Corner, Domain, EdgeTree, Horizon, Site, Walk};
use crate::geom::Point;

/// Edges near one disk up to which all are looked at in a complete axis.
///
/// A matter of time only: what the other steps prove leaves no room for anything nearer.
pub(super) const MOST_NEAR: usize = 256;

/// Counts the edges that are looked at for one disk.
pub(super) struct Crowd {
    left: usize,
}

impl Crowd {
    /// Takes note of one more edge; whether they are too many.
    pub(super) fn is_over(&mut self) -> bool {
        let over = self.left == 0;
        self.left = self.left.saturating_sub(1);
        over
    }
}

/// What every check reads.
pub(super) struct Context<'a> {
    /// The domain on the side of the axis.
    pub(super) domain: &'a Domain,
    /// What of it reaches infinity, if that is the outside of the polygons.
    pub(super) horizon: Option<Horizon>,
    /// Edges of walls, which come first and belong to nobody; their walk is the first one.
    pub(super) n_walls: u32,
    pub(super) axis: &'a MedialAxis,
    /// The element of the domain behind each site of the axis, if it has one.
    pub(super) sites: Vec<Option<Site>>,
    pub(super) tree: EdgeTree,
    /// Largest coordinate sum of a corner: what rounding errors near the boundary refer to.
    pub(super) size: f64,
}

impl<'a> Context<'a> {
    /// Matches the sites of the axis with the domain by name and by coordinates, bit for bit.
    pub(super) fn new(
        domain: &'a Domain,
        outside: Option<&Complement>,
        axis: &'a MedialAxis,
        defects: &mut Vec<Defect>,
    ) -> Self {
        let n_walls = if outside.is_some() { Complement::n_frame_edges() } else { 0 };
        let n = domain.edges().len() as u32;
        let mut names: Vec<(Name, Site)> = (n_walls..n)
            .flat_map(|edge| [Site::edge(edge), Site::corner(edge)])
            .filter(|&site| is_site(domain, site))
            .map(|site| (Name::of(domain, site), site))
            .collect();
        names.sort_unstable();
        let mut sites = Vec::with_capacity(axis.sites().len());
        let mut first_use: Vec<Option<u32>> = vec![None; 2 * domain.edges().len()];
        for (number, claimed) in (0_u32..).zip(axis.sites()) {
            let name = Name::from(&claimed);
            let at = claimed.a;
            let found = names.partition_point(|(known, _)| *known < name);
            let Some(&(_, site)) = names.get(found).filter(|(known, _)| *known == name) else {
                defects.push(Defect::UnknownSite { site: number, name, at });
                sites.push(None);
                continue;
            };
            let start = domain.edge(site.index()).start;
            let end = if site.is_edge() { domain.end(site.index()) } else { start };
            // Sites have the interior of the polygons to their left, on any side.
            let (start, end) = if outside.is_some() { (end, start) } else { (start, end) };
            if !same_bits(start, claimed.a) || !same_bits(end, claimed.b) {
                defects.push(Defect::MovedSite { site: number, name, at: start });
            }
            match &mut first_use[site.0 as usize] {
                Some(first) => {
                    defects.push(Defect::RepeatedSite { first: *first, second: number, at });
                    sites.push(None);
                }
                unused => {
                    *unused = Some(number);
                    sites.push(Some(site));
                }
            }
        }
        let inner = &domain.edges()[n_walls as usize..];
        let size = inner.iter().map(|edge| norm1(edge.start)).fold(0.0, f64::max);
        let walks = &domain.walks()[usize::from(n_walls > 0)..];
        let tree = EdgeTree::new(domain, walks);
        let horizon = outside.map(Complement::horizon);
        Self { domain, horizon, n_walls, axis, sites, tree, size }
    }

    /// The boundary walks, without that of the walls.
    pub(super) fn walks(&self) -> impl ExactSizeIterator<Item = (usize, &Walk)> {
        self.domain.walks()[usize::from(self.n_walls > 0)..].iter().enumerate()
    }

    /// Whether the cell of an edge reaches infinity: it lies on the convex hull, seen from outside.
    pub(super) fn is_on_hull(&self, edge: u32) -> bool {
        self.horizon.as_ref().is_some_and(|horizon| horizon.edges.binary_search(&edge).is_ok())
    }

    /// How many paths go to infinity.
    pub(super) fn n_gaps(&self) -> usize {
        self.horizon.as_ref().map_or(0, |horizon| horizon.gaps.len())
    }

    /// The name of an edge.
    pub(super) fn name(&self, edge: u32) -> Name {
        Name::of(self.domain, Site::edge(edge))
    }

    /// Position of keypoint number `keypoint`.
    pub(super) fn position(&self, keypoint: u32) -> Point {
        self.axis.keypoints().at(keypoint).position
    }

    /// The governors of a keypoint as elements of the domain; `None` if one is unknown.
    pub(super) fn governors(&self, keypoint: u32) -> Option<Vec<Site>> {
        self.axis.governors(keypoint).iter().map(|&g| self.sites[g as usize]).collect()
    }

    /// The count for one more disk.
    pub(super) fn crowd(&self) -> Crowd {
        Crowd { left: if self.axis.complete { MOST_NEAR } else { usize::MAX } }
    }

    /// Closed distance of an edge from a point, in doubles.
    pub(super) fn distance(&self, point: Point, edge: u32) -> f64 {
        let (a, b) = (self.domain.edge(edge).start, self.domain.end(edge));
        let (d, q) = (b - a, point - a);
        if d.dot(q) <= 0.0 {
            q.norm()
        } else if d.dot(b - point) <= 0.0 {
            (point - b).norm()
        } else {
            (d.cross(q) / d.norm()).abs()
        }
    }
}

/// Whether an element can govern: every edge, and every reflex corner.
pub(super) fn is_site(domain: &Domain, site: Site) -> bool {
    site.is_edge() || domain.edge(site.index()).corner == Corner::Reflex
}

/// Whether the contacts of two governors of one keypoint are one, `a` before `b` along the
/// boundary: a corner and its own edge, or the two edges of a straight joint.
pub(super) fn one_contact(domain: &Domain, a: Site, b: Site) -> bool {
    match (a.is_edge(), b.is_edge()) {
        (false, true) => a.index() == b.index(),
        (true, false) => domain.edge(a.index()).next == b.index(),
        (true, true) => {
            domain.edge(a.index()).next == b.index()
                && domain.edge(b.index()).corner == Corner::Straight
        }
        (false, false) => false,
    }
}

fn same_bits(a: Point, b: Point) -> bool {
    a.x.to_bits() == b.x.to_bits() && a.y.to_bits() == b.y.to_bits()
}
