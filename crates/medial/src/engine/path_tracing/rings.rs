//! Whole rings that hide between two empty disks of one path.
//!
//! Two empty disks on a path and the footpoints between them close a pocket that only a complete
//! boundary walk can occupy: so one corner of each hole, in a small index, is enough.

use std::ops::Range;

use super::search::{Found, Gap, Start};
use crate::domain::{Domain, Site};
use crate::geom::{BoundsTree, Governor, Point, Rect, TouchingDisk, Visitor};

/// One corner of every hole of a polygon.
#[derive(Debug)]
pub(super) struct HiddenRings {
    /// Reflex corners, sorted along a space-filling curve.
    corners: Vec<Site>,
    tree: BoundsTree,
}

impl HiddenRings {
    /// The index over the given walks; `None` if none of them is a hole.
    pub fn new(domain: &Domain, walks: Range<usize>) -> Option<Self> {
        let mut bounds = Rect::EMPTY;
        let mut corners: Vec<(Point, u32)> = Vec::new();
        for walk in domain.walks()[walks].iter().filter(|w| w.hole) {
            // At its first point in lexicographic order the walk of a hole turns right.
            let lowest = (walk.first..walk.first + walk.len).min_by(|&a, &b| {
                domain.edge(a).start.lexicographic(domain.edge(b).start).then(a.cmp(&b))
            });
            if let Some(k) = lowest {
                let p = domain.edge(k).start;
                bounds = bounds.with(p);
                corners.push((p, k));
            }
        }
        if corners.is_empty() {
            return None;
        }
        let size =
            (bounds.max - bounds.min).x.max((bounds.max - bounds.min).y).max(f64::MIN_POSITIVE);
        corners.sort_by_key(|&(p, k)| {
            let cell = |v: f64| (v / size * f64::from(1 << 16)) as u32;
            (interleave(cell(p.x - bounds.min.x), cell(p.y - bounds.min.y)), k)
        });
        let tree =
            BoundsTree::new(0, corners.len() as u32, |k| Rect::EMPTY.with(corners[k as usize].0));
        Some(Self { corners: corners.iter().map(|&(_, k)| Site::corner(k)).collect(), tree })
    }

    /// Corners of rings that may lie in the pocket of a path. Generous: doubles with a margin.
    pub fn suspects(&self, domain: &Domain, gap: &Gap, found: &Found) -> Vec<Site> {
        let end = match found {
            Found::Corner(edge) => Round::corner(domain.edge(*edge).start),
            Found::Disk { disk, .. } => Round::disk(disk),
        };
        let start = Round::start(&gap.start);
        let link = Link { right: gap.right, left: gap.left, start, end };
        let mut query = Query {
            rings: self,
            domain,
            pocket: Pocket::new(domain, &link),
            link,
            found: Vec::new(),
        };
        self.tree.visit(&mut query);
        query.found
    }

    /// Whether any ring may lie in the pocket of one of these pieces of a path.
    pub fn any(&self, domain: &Domain, links: impl Iterator<Item = Link> + Clone) -> bool {
        let walk = |s: Site| domain.edge(s.index()).walk;
        let mut own = None;
        let mut bounds = Rect::EMPTY;
        for link in links.clone() {
            own = Some((walk(link.right), walk(link.left)));
            bounds = bounds.union(Pocket::new(domain, &link).bounds);
        }
        let Some((right, left)) = own else { return false };
        let mut near = Near { bounds, found: Vec::new() };
        self.tree.visit(&mut near);
        near.found.iter().any(|&k| {
            let site = self.corners[k as usize];
            let ring = walk(site);
            ring != right
                && ring != left
                && links
                    .clone()
                    .any(|link| Pocket::new(domain, &link).holds(domain.edge(site.index()).start))
        })
    }
}

/// The bits of two 16-bit numbers in turn.
fn interleave(x: u32, y: u32) -> u64 {
    let spread = |v: u32| {
        let mut v = u64::from(v);
        v = (v | (v << 16)) & 0x0000_ffff_0000_ffff;
        v = (v | (v << 8)) & 0x00ff_00ff_00ff_00ff;
        v = (v | (v << 4)) & 0x0f0f_0f0f_0f0f_0f0f;
        v = (v | (v << 2)) & 0x3333_3333_3333_3333;
        (v | (v << 1)) & 0x5555_5555_5555_5555
    };
    spread(x) | (spread(y) << 1)
}

/// A disk at an end of a piece of a path.
#[derive(Clone, Copy, Debug)]
pub(super) struct Round {
    pub centre: Point,
    /// What rounding took from the centre.
    pub off: Point,
    pub radius: f64,
    pub doubt: f64,
}

impl Round {
    pub fn start(start: &Start) -> Self {
        let Start { centre, radius, doubt, .. } = *start;
        Self { centre, off: Point::default(), radius, doubt }
    }

    pub fn corner(at: Point) -> Self {
        Self { centre: at, off: Point::default(), radius: 0.0, doubt: 0.0 }
    }

    pub fn disk(disk: &TouchingDisk) -> Self {
        let centre = disk.position();
        let off = disk.centre - (centre - disk.origin);
        Self { centre, off, radius: disk.radius, doubt: disk.bound }
    }
}

/// A piece of a path between two of its disks.
#[derive(Clone, Copy, Debug)]
pub(super) struct Link {
    pub right: Site,
    pub left: Site,
    pub start: Round,
    pub end: Round,
}

/// The items of a box.
struct Near {
    bounds: Rect,
    found: Vec<u32>,
}

impl Visitor for Near {
    fn enters(&self, bounds: &Rect, _items: Range<u32>) -> bool {
        bounds.meets(&self.bounds)
    }

    fn item(&mut self, item: u32) {
        self.found.push(item);
    }
}

/// Spokes and footpoints around a path: a polygon that holds all its pocket.
#[derive(Debug)]
struct Pocket {
    /// Relative to `origin`, in order.
    outline: [Point; 6],
    origin: Point,
    bounds: Rect,
    margin: f64,
}

impl Pocket {
    fn new(domain: &Domain, link: &Link) -> Self {
        let origin = link.start.centre;
        let length = |p: Point| p.x.abs() + p.y.abs();
        // How far away numbers come from that enter the outline.
        let mut reach: f64 = 0.0;
        let mut foot = |site: Site, centre: Point| match domain.governor(site) {
            Governor::Corner(p) => p - origin,
            Governor::Edge { start, direction, .. } => {
                let from = start - origin;
                reach = reach.max(length(from));
                from + direction * direction.dot(centre - from)
            }
        };
        let c0 = Point::default();
        let c1 = (link.end.centre - origin) + link.end.off;
        let (radius, doubt) = (link.end.radius, link.end.doubt);
        let outline = [
            c0,
            foot(link.right, c0),
            foot(link.right, c1),
            c1,
            foot(link.left, c1),
            foot(link.left, c0),
        ];
        let extent = outline.iter().map(|&p| length(p)).fold(0.0, f64::max);
        let size = length(origin) + extent + radius + reach;
        let margin = 1e-9 * extent + 64.0 * f64::EPSILON * size + 4.0 * (doubt + link.start.doubt);
        let mut bounds = outline.iter().fold(Rect::EMPTY, |b, &p| b.with(p + origin));
        bounds.min = bounds.min - Point::new(margin, margin);
        bounds.max = bounds.max + Point::new(margin, margin);
        Self { outline, origin, bounds, margin }
    }

    /// Whether a point lies inside, or within the margin of the outline.
    fn holds(&self, p: Point) -> bool {
        let p = p - self.origin;
        let mut inside = false;
        for k in 0..6 {
            let (a, b) = (self.outline[k], self.outline[(k + 1) % 6]);
            let d = b - a;
            let along = (d.dot(p - a) / d.norm2().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
            if (p - (a + d * along)).norm() <= self.margin {
                return true;
            }
            if (a.y > p.y) != (b.y > p.y) && p.x < a.x + d.x * ((p.y - a.y) / d.y) {
                inside = !inside;
            }
        }
        inside
    }
}

struct Query<'q> {
    rings: &'q HiddenRings,
    domain: &'q Domain,
    link: Link,
    pocket: Pocket,
    found: Vec<Site>,
}

impl Visitor for Query<'_> {
    fn enters(&self, bounds: &Rect, _items: Range<u32>) -> bool {
        bounds.meets(&self.pocket.bounds)
    }

    fn item(&mut self, item: u32) {
        let site = self.rings.corners[item as usize];
        let walk = |s: Site| self.domain.edge(s.index()).walk;
        // The rings of the governors are touched, so they do not lie in the pocket whole.
        let own = walk(site) == walk(self.link.right) || walk(site) == walk(self.link.left);
        if !own && self.pocket.holds(self.domain.edge(site.index()).start) {
            self.found.push(site);
        }
    }
}
