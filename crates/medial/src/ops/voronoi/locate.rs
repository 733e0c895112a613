//! The nearest elements of a point [Lee82, definition 3: the image].
//!
//! # Contract
//! Exact, also at ties. O(log n) questions where the diagram has cells.
//!
//! # Method
//! 1. A tree of boxes gives the edges near the point, the nearest first; doubles with a bound on their
//!    error leave few of them, which are compared exactly. This ends nearly every search.
//! 2. It is given up after [`MANY`] edges: then many are about equally near, or boxes are poor bounds
//!    there. From the cell of the best one so far the search goes on across the curve over the point, to
//!    an element that is nearer, until a keypoint is met whose disk holds the point, and from there down
//!    a hierarchy ([`super::descent`]). One question to the cell that is found proves the answer.
//! 3. Where that leads nowhere, as on a side without an axis or beyond its frame, the tree is asked
//!    without a limit.

use std::cmp::Ordering;
use std::ops::ControlFlow;
use std::sync::OnceLock;

use smallvec::SmallVec;

use super::Voronoi;
use super::chain::Over;
use super::descent::{Found, Hierarchy};
use super::nearest::{between_normals, compare, footpoint, nearest_part, side};
use super::sheet::Sheet;
use crate::axis::{self, Side};
use crate::domain::{Corner, Domain, EdgeTree, Site};
use crate::geom::predicates::{Element, ExactDisk, compare_distances};
use crate::geom::{Point, Rect};
use crate::ops::ground::Ground;

/// Where a point lies with respect to the polygons; [`name`](Self::name) gives its name in files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Region {
    /// Inside.
    Interior,
    /// Outside, or in a hole.
    Exterior,
    /// On the boundary.
    Boundary,
}

impl Region {
    /// What lies on a side of the boundary.
    #[must_use]
    pub const fn of(side: Side) -> Self {
        match side {
            Side::Interior => Self::Interior,
            Side::Exterior => Self::Exterior,
        }
    }

    /// Its name in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Interior => "interior",
            Self::Exterior => "exterior",
            Self::Boundary => "boundary",
        }
    }
}

/// An element nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// An open edge, or a corner, convex ones included.
    pub site: axis::Site,
    /// Its point nearest to the point located, rounded.
    pub footpoint: Point,
}

/// Where a point lies, and what of the boundary is nearest to it.
#[derive(Clone, Debug, PartialEq)]
pub struct Located {
    /// On which side of the boundary.
    pub region: Region,
    /// The distance from the boundary, rounded once or twice.
    pub distance: f64,
    /// All nearest elements in boundary order, one for each footpoint: several on a path, at a keypoint
    /// as many as its disk has contacts. Edges are open: if the footpoint is a corner, the corner is
    /// the nearest element. Of several corners in one place, where the boundary touches itself, it is the
    /// one whose wedge holds the point, else the first.
    pub contacts: Vec<Contact>,
}

/// What is kept to locate points, each once a point needs it.
#[derive(Debug)]
pub(super) struct Seeker {
    /// For each side.
    sides: Vec<(OnceLock<EdgeTree>, OnceLock<Hierarchy>)>,
    /// For the inside if that has no axis.
    inside: OnceLock<EdgeTree>,
}

/// Edges that are looked at before the diagram is asked.
///
/// A matter of time only: answers are the same either way.
const MANY: usize = 256;

/// Edges whose cells are tried: that of an edge beside a convex corner may not hold the point.
const TRIED: usize = 8;

/// Cells that are crossed in search of a keypoint whose disk holds the point.
const CROSSED: usize = 16;

/// Candidates, or nearest elements.
type Few<T> = SmallVec<[T; 8]>;

impl Seeker {
    pub fn new(voronoi: &Voronoi) -> Self {
        let sides = voronoi.sheets.iter().map(|_| Default::default()).collect();
        Self { sides, inside: OnceLock::new() }
    }

    pub fn locate(&self, voronoi: &Voronoi, p: Point) -> Located {
        self.locate_within(voronoi, p, MANY)
    }

    /// The same, with the diagram asked after so many edges.
    fn locate_within(&self, voronoi: &Voronoi, p: Point, most: usize) -> Located {
        // Elements are named by the side on which the point lies, if that has an axis, else by the inside.
        let on = |side: usize, parts| {
            let located = located(&voronoi.sheets[side].ground, parts, p);
            let has_axis = voronoi.axes().any(|axis| Region::of(axis.side) == located.region);
            let side = voronoi.sheets[side].axis.side;
            let is_named = [Region::of(side), Region::Boundary].contains(&located.region)
                || side == Side::Interior && !has_axis;
            is_named.then_some(located)
        };
        let sides = 0..voronoi.sheets.len();
        let soon = |side| on(side, self.soon(voronoi, side, p, most)?);
        let late = |side| on(side, self.parts(voronoi, side, p));
        sides.clone().find_map(soon).or_else(|| sides.clone().find_map(late)).unwrap_or_else(|| {
            let ground = Ground::Inside(voronoi.domain);
            let tree = self.inside.get_or_init(|| EdgeTree::new(ground.domain(), ground.walks()));
            located(&ground, nearest_parts(ground.domain(), tree, p), p)
        })
    }

    fn tree(&self, voronoi: &Voronoi, side: usize) -> &EdgeTree {
        let ground = &voronoi.sheets[side].ground;
        self.sides[side].0.get_or_init(|| EdgeTree::new(ground.domain(), ground.walks()))
    }

    /// The nearest parts of the boundary, as the side with this number names them.
    fn parts(&self, voronoi: &Voronoi, side: usize, p: Point) -> Few<Site> {
        nearest_parts(voronoi.sheets[side].domain(), self.tree(voronoi, side), p)
    }

    /// The same if few edges or the diagram can tell.
    fn soon(&self, voronoi: &Voronoi, side: usize, p: Point, most: usize) -> Option<Few<Site>> {
        let domain = voronoi.sheets[side].domain();
        match near(domain, self.tree(voronoi, side), p, most) {
            (found, ControlFlow::Continue(())) => Some(nearest(domain, &found, p)),
            (found, ControlFlow::Break(())) => self.by_cells(voronoi, side, &found, p),
        }
    }

    /// The nearest elements by the diagram of a side, from edges that are near; `None` if it cannot tell.
    fn by_cells(
        &self,
        voronoi: &Voronoi,
        side: usize,
        near: &[u32],
        p: Point,
    ) -> Option<Few<Site>> {
        let sheet = &voronoi.sheets[side];
        if sheet.axis.side == Side::Exterior && !is_inside(&voronoi.frame, p) {
            return None;
        }
        let from = |&edge: &u32| self.across_cells(voronoi, side, Site::edge(edge), p);
        near.iter().take(TRIED).find_map(from)
    }

    /// The same from the cell of one element.
    fn across_cells(
        &self,
        voronoi: &Voronoi,
        side: usize,
        first: Site,
        p: Point,
    ) -> Option<Few<Site>> {
        let sheet = &voronoi.sheets[side];
        let holds = |keypoint: &u32| {
            let disk = sheet.disk(*keypoint);
            disk.is_some_and(|disk| disk.side(Element::Corner(p)).is_lt())
        };
        let mut element = voronoi.cell_before(side, first, p);
        for _ in 0..CROSSED {
            let over = voronoi.over(side, element, p)?;
            let Some((edge, across)) = over.bound.filter(|_| over.order.is_gt()) else {
                return Some(voronoi.ties(side, element, &over, p));
            };
            let edge = &voronoi.graph.edges[edge as usize];
            let ends = [edge.from, edge.to].map(|point| voronoi.graph.keypoint(side, point));
            if let Some(start) = ends.into_iter().flatten().find(holds) {
                let hierarchy = self.sides[side].1.get_or_init(|| Hierarchy::new(sheet));
                let found = hierarchy.descend(sheet, p, start)?;
                let nearer = |a: Site, b: Site| {
                    if compare(sheet.domain(), p, a, b).is_le() { a } else { b }
                };
                let best = found.governors(sheet).into_iter().reduce(nearer)?;
                let element = voronoi.cell_before(side, best, p);
                let over = voronoi.over(side, element, p)?;
                return over.order.is_le().then(|| voronoi.ties(side, element, &over, p));
            }
            element = voronoi.cell_before(side, across, p);
        }
        None
    }
}

impl Found {
    /// One of these is nearest.
    fn governors(self, sheet: &Sheet) -> Few<Site> {
        match self {
            Self::Path(path) => {
                let path = sheet.axis.paths().at(path);
                [path.left, path.right].into_iter().map(|site| sheet.governor(site)).collect()
            }
            Self::Keypoint(keypoint) => sheet.governors(keypoint).collect(),
        }
    }
}

/// The nearest parts of a boundary by a tree over all of it, one for each footpoint.
pub(super) fn nearest_parts(domain: &Domain, tree: &EdgeTree, p: Point) -> Few<Site> {
    one_for_each_place(domain, nearest(domain, &near(domain, tree, p, usize::MAX).0, p), p)
}

/// The edges that may be nearest, the best guess first; breaks after `most` edges.
fn near(domain: &Domain, tree: &EdgeTree, p: Point, most: usize) -> (Few<u32>, ControlFlow<()>) {
    let mut found: Few<(f64, u32)> = Few::new();
    // No edge that is farther than this is nearest.
    let mut least = f64::INFINITY;
    let mut left = most;
    let mut best = (f64::INFINITY, 0);
    let end = tree.nearest_first(p, |edge| {
        let (low, high) = distance(domain, edge, p);
        least = least.min(high);
        if low <= least {
            found.push((low, edge));
        }
        if low < best.0 {
            best = (low, found.len() - 1);
        }
        left = left.saturating_sub(1);
        if left == 0 { ControlFlow::Break(()) } else { ControlFlow::Continue(least) }
    });
    if best.1 < found.len() {
        found.swap(0, best.1);
    }
    (found.iter().filter(|(low, _)| *low <= least).map(|&(_, edge)| edge).collect(), end)
}

impl Voronoi<'_> {
    /// All nearest elements of a point that lies in the cell of one of them.
    fn ties(&self, side: usize, element: Site, over: &Over, p: Point) -> Few<Site> {
        let Some((edge, across)) = over.bound.filter(|_| over.order.is_eq()) else {
            return [element].into_iter().collect();
        };
        let edge = &self.graph.edges[edge as usize];
        let sheet = &self.sheets[side];
        let ends = [edge.from, edge.to].map(|point| self.graph.keypoint(side, point));
        let at = ends.into_iter().flatten().find(|&k| sheet.disk(k).is_some_and(|d| is_at(&d, p)));
        let part = |site| nearest_part(sheet.domain(), site, p);
        match at {
            Some(keypoint) => sheet.governors(keypoint).map(part).collect(),
            None => [element, across].into_iter().map(part).collect(),
        }
    }
}

/// Whether a point lies in the inside of a frame.
fn is_inside(frame: &Rect, p: Point) -> bool {
    let Rect { min, max } = *frame;
    min.x < p.x && p.x < max.x && min.y < p.y && p.y < max.y
}

/// Whether a point is the centre of a disk.
fn is_at(disk: &ExactDisk, p: Point) -> bool {
    let origin = Point::new(0.0, 0.0);
    [Point::new(1.0, 0.0), Point::new(0.0, 1.0)]
        .into_iter()
        .all(|unit| disk.along(origin, unit, p).is_eq())
}

/// Bounds on the distance of a point from a closed edge.
fn distance(domain: &Domain, edge: u32, p: Point) -> (f64, f64) {
    /// The way from the start is rounded once; the direction, products with it and their sum, and the
    /// length add less than eight units.
    const ROUNDING: f64 = 8.0 * f64::EPSILON;
    let edge = domain.edge(edge);
    let way = p - edge.start;
    let distance = edge.distance2(way).sqrt();
    let error = ROUNDING * (way.x.abs() + way.y.abs() + edge.length) + f64::MIN_POSITIVE;
    (distance - error, distance + error)
}

/// The nearest parts of some closed edges, decided exactly.
fn nearest(domain: &Domain, edges: &[u32], p: Point) -> Few<Site> {
    let mut nearest: Few<Site> = Few::new();
    for &edge in edges {
        let part = nearest_part(domain, Site::edge(edge), p);
        let order = nearest.first().map_or(Ordering::Less, |&least| {
            compare_distances(p, domain.element(part), domain.element(least))
        });
        if order.is_lt() {
            nearest.clear();
        }
        if order.is_le() {
            nearest.push(part);
        }
    }
    nearest
}

/// Nearest parts of the boundary, one for each footpoint: corners in one place are one.
fn one_for_each_place(domain: &Domain, parts: Few<Site>, p: Point) -> Few<Site> {
    let start = |site: Site| domain.edge(site.index()).start;
    let (mut chosen, mut corners): (Few<Site>, Few<Site>) =
        parts.into_iter().partition(|part| part.is_edge());
    corners.sort_unstable_by(|&a, &b| start(a).lexicographic(start(b)).then(a.cmp(&b)));
    corners.dedup();
    let places = corners.chunk_by(|&a, &b| start(a) == start(b));
    chosen.extend(places.map(|here| corner_at(domain, here[0], here, p)));
    chosen.sort_unstable();
    chosen.dedup();
    chosen
}

/// What is to be said of a point with these nearest parts of the boundary.
fn located(ground: &Ground, parts: Few<Site>, p: Point) -> Located {
    let domain = ground.domain();
    let mut parts = one_for_each_place(domain, parts, p);
    parts.sort_by_key(|&part| ground.place(part));
    // Where polygons touch, what another one has in the same place may turn its back on the point.
    let own = Region::of(ground.side());
    let mut regions: Few<Region> = parts.iter().map(|&part| region(ground, part, p)).collect();
    if regions.contains(&own) && !regions.contains(&Region::Boundary) {
        parts.retain(|part| region(ground, *part, p) == own);
        regions.retain(|region| *region == own);
    }
    let on_boundary = regions.contains(&Region::Boundary).then_some(Region::Boundary);
    let region = on_boundary.or(regions.first().copied()).unwrap_or(Region::Exterior);
    let foot = |part| match region {
        Region::Boundary => (0.0, p),
        _ => footpoint(p, domain.element(part)),
    };
    let distance = parts.first().map_or(f64::INFINITY, |&part| foot(part).0);
    let contact = |part| Contact { site: ground.named(part), footpoint: foot(part).1 };
    Located { region, distance, contacts: parts.iter().map(|&part| contact(part)).collect() }
}

/// Of the corners in one place, `first` among them, the one whose wedge holds a point, else the first;
/// for a straight joint the piece of edge that starts there.
fn corner_at(domain: &Domain, first: Site, corners: &[Site], p: Point) -> Site {
    let kind = |site: &Site| domain.edge(site.index()).corner;
    let holds = |site: &&Site| match kind(site) {
        Corner::Reflex => between_normals(domain, **site, p),
        Corner::Straight => side(domain, site.index(), p).is_gt(),
        Corner::Convex => false,
    };
    match corners.iter().find(holds) {
        Some(site) if kind(site) == Corner::Straight => Site::edge(site.index()),
        Some(site) => *site,
        None => {
            let real = corners.iter().find(|site| kind(site) != Corner::Straight);
            real.copied().unwrap_or(first)
        }
    }
}

/// On which side of the boundary a point lies whose nearest part this is.
fn region(ground: &Ground, part: Site, p: Point) -> Region {
    let domain = ground.domain();
    let is_own = if part.is_edge() {
        match side(domain, part.index(), p) {
            Ordering::Equal => return Region::Boundary,
            order => order.is_gt(),
        }
    } else {
        let edge = domain.edge(part.index());
        if edge.start == p {
            return Region::Boundary;
        }
        edge.corner == Corner::Reflex && between_normals(domain, part, p)
    };
    match (ground.side(), is_own) {
        (Side::Interior, true) | (Side::Exterior, false) => Region::Interior,
        (Side::Interior, false) | (Side::Exterior, true) => Region::Exterior,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::axis::{Engine, MedialAxis};
    use crate::domain::Options;
    use crate::engine::{self, exterior, path_tracing};

    /// Numbers that look random.
    struct Numbers(u64);

    impl Numbers {
        fn below(&mut self, n: u64) -> u64 {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (self.0 >> 33) % n
        }
    }

    /// Star-shaped around the middle of a grid, with some square holes.
    fn shape(numbers: &mut Numbers) -> Option<Domain> {
        let n = 5 + numbers.below(20);
        let corner = |k: u64, numbers: &mut Numbers| {
            let angle = std::f64::consts::TAU * k as f64 / n as f64;
            let r = 8.0 + numbers.below(9) as f64;
            Point::new((r * angle.cos()).round(), (r * angle.sin()).round())
        };
        let outer: Vec<Point> = (0..n).map(|k| corner(k, numbers)).collect();
        let mut rings = vec![outer];
        for _ in 0..numbers.below(4) {
            let (x, y) = (numbers.below(12) as f64 - 6.0, numbers.below(12) as f64 - 6.0);
            let side = 1.0 + numbers.below(2) as f64;
            let ring = [(x, y), (x, y + side), (x + side, y + side), (x + side, y)];
            rings.push(ring.map(|(x, y)| Point::new(x, y)).to_vec());
        }
        Domain::from_polygons(&[rings], &Options::default()).ok()
    }

    fn both_axes(domain: &Domain) -> [MedialAxis; 2] {
        let options = engine::Options::default();
        let outside = exterior(domain, Engine::PathTracing, None, &options).unwrap();
        [path_tracing(domain).unwrap(), outside]
    }

    #[test]
    fn the_diagram_answers_as_all_edges_do() {
        let mut numbers = Numbers(5);
        let mut counts = [[0; 2]; 2];
        for _ in 0..150 {
            let Some(domain) = shape(&mut numbers) else { continue };
            let axes = both_axes(&domain);
            let voronoi = Voronoi::new(&domain, &axes).unwrap();
            let seeker = Seeker::new(&voronoi);
            let keypoints = axes.iter().flat_map(|axis| axis.keypoints()).map(|k| k.position);
            let grid = (0..40).map(|_| {
                let half = |n: u64| n as f64 / 2.0 - 12.0;
                Point::new(half(numbers.below(49)), half(numbers.below(49)))
            });
            for p in keypoints.chain(grid).collect::<Vec<_>>() {
                let expected = seeker.locate_within(&voronoi, p, usize::MAX);
                for most in [1, 5] {
                    assert_eq!(seeker.locate_within(&voronoi, p, most), expected, "{p:?}");
                }
                for (side, sheet) in voronoi.sheets.iter().enumerate() {
                    let within = side == 0 || is_inside(&voronoi.frame, p);
                    if within && expected.region == Region::of(sheet.axis.side) {
                        let tree = EdgeTree::new(sheet.domain(), sheet.ground.walks());
                        let (near, _) = near(sheet.domain(), &tree, p, usize::MAX);
                        let told = seeker.by_cells(&voronoi, side, &near, p).is_some();
                        counts[side][0] += 1;
                        counts[side][1] += usize::from(told);
                    }
                }
            }
        }
        assert!(counts.iter().all(|[asked, told]| *asked > 2000 && told == asked), "{counts:?}");
    }

    #[test]
    fn from_any_keypoint_whose_disk_holds_a_point_the_way_down_leads_to_it() {
        let mut numbers = Numbers(9);
        let (mut asked, mut lost) = (0, 0);
        for _ in 0..60 {
            let Some(domain) = shape(&mut numbers) else { continue };
            let axes = [path_tracing(&domain).unwrap()];
            let voronoi = Voronoi::new(&domain, &axes).unwrap();
            let (sheet, hierarchy) = (&voronoi.sheets[0], Hierarchy::new(&voronoi.sheets[0]));
            let holes = domain.walks().len() > 1;
            for _ in 0..20 {
                let half = |n: u64| n as f64 / 2.0 - 8.0;
                let p = Point::new(half(numbers.below(33)), half(numbers.below(33)));
                let expected = voronoi.locate(p).unwrap();
                for k in 0..axes[0].keypoints().len() as u32 {
                    let disk = sheet.disk(k);
                    if !disk.is_some_and(|disk| disk.side(Element::Corner(p)).is_lt()) {
                        continue;
                    }
                    let Some(found) = hierarchy.descend(sheet, p, k) else {
                        assert!(holes);
                        lost += 1;
                        continue;
                    };
                    asked += 1;
                    let is_nearest = |site: &Site| {
                        let part = nearest_part(&domain, *site, p);
                        expected.contacts.iter().any(|c| c.site == sheet.ground.named(part))
                    };
                    let found = found.governors(sheet);
                    assert!(holes || found.iter().any(is_nearest), "{p:?} from {k}");
                }
            }
        }
        assert!(asked > 3000 && lost < asked / 20, "{lost} of {asked}");
    }
}
