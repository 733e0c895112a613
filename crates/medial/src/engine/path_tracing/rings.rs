//! Whole rings that hide between two empty disks of one path.
//!
//! Two empty disks on a path and the footpoints between them close a pocket that only a complete
//! boundary walk can occupy: so one point of each hole, in a small index, is enough.

use std::ops::Range;
use std::sync::OnceLock;

use smallvec::SmallVec;

use super::holes::{Ahead, Holes, point};
use super::search::{Found, Gap, Start};
use crate::domain::{Domain, Site};
use crate::geom::{BoundsTree, Governor, Point, Rect, TouchingDisk, Visitor};

/// The holes of a polygon, as far as somebody asks for them.
#[derive(Debug)]
pub(super) struct Rings {
    holes: Holes,
    hidden: OnceLock<HiddenRings>,
}

impl Rings {
    /// The holes among the given walks; `None` if there is none.
    pub fn new(domain: &Domain, walks: Range<usize>) -> Option<Self> {
        let any = domain.walks()[walks.clone()].iter().any(|walk| walk.hole);
        let holes = any.then(|| Holes::new(domain, walks))?;
        Some(Self { holes, hidden: OnceLock::new() })
    }

    fn hidden(&self, domain: &Domain) -> &HiddenRings {
        self.hidden.get_or_init(|| HiddenRings::new(domain, &self.holes))
    }

    /// Corners of rings that may lie in the pocket of a path. Generous: doubles with a margin.
    pub fn suspects(&self, domain: &Domain, gap: &Gap, found: &Found) -> Vec<Site> {
        let end = match found {
            Found::Corner(edge) => Round::corner(domain.edge(*edge).start),
            Found::Disk { disk, .. } => Round::disk(disk),
            // Looked into when it was found.
            Found::Known(_) => return Vec::new(),
        };
        let start = Round::start(&gap.start);
        let link = Link { right: gap.right, left: gap.left, start, end };
        let pockets = Pockets::new(domain, std::iter::once(link));
        let mut suspects = Vec::new();
        let mut suspect = |walk: u32| {
            suspects.extend(lowest(domain, walk));
            true
        };
        if !self.holes.each(domain, &pockets, &mut suspect) {
            self.hidden(domain).each(domain, &pockets, &mut suspect);
        }
        suspects
    }

    /// Holes that a disk may reach, other than two walks: about the share of the way from the start to
    /// the disk at which it does, least first, and the walk. Proposals only; empty where there are many.
    pub fn ahead(&self, start: &Start, disk: &TouchingDisk, own: [u32; 2]) -> Ahead {
        self.holes.ahead(start, disk, own)
    }

    /// Whether any ring may lie in the pocket of one of these pieces of a path.
    pub fn any(&self, domain: &Domain, links: impl Iterator<Item = Link>) -> bool {
        let pockets = Pockets::new(domain, links);
        let mut any = false;
        let mut suspect = |_| {
            any = true;
            false
        };
        if !self.holes.each(domain, &pockets, &mut suspect) {
            self.hidden(domain).each(domain, &pockets, &mut suspect);
        }
        any
    }
}

/// The first point of a hole in lexicographic order, where its walk turns right.
fn lowest(domain: &Domain, walk: u32) -> Option<Site> {
    let walk = domain.walks()[walk as usize];
    let lowest = walk
        .edges()
        .min_by(|&a, &b| domain.edge(a).start.lexicographic(domain.edge(b).start).then(a.cmp(&b)));
    lowest.map(Site::corner)
}

/// A tree over one point of every hole, wherever they are.
#[derive(Debug)]
struct HiddenRings {
    /// Their walks, sorted along a space-filling curve.
    walks: Vec<u32>,
    tree: BoundsTree,
}

impl HiddenRings {
    fn new(domain: &Domain, holes: &Holes) -> Self {
        let mut walks: Vec<u32> = holes.all().iter().map(|hole| hole.walk).collect();
        let at = |walk: u32| point(domain, walk);
        let bounds = walks.iter().fold(Rect::EMPTY, |all, &walk| all.with(at(walk)));
        let size =
            (bounds.max - bounds.min).x.max((bounds.max - bounds.min).y).max(f64::MIN_POSITIVE);
        walks.sort_by_key(|&walk| {
            let cell = |v: f64| (v / size * f64::from(1 << 16)) as u32;
            let place = at(walk) - bounds.min;
            (interleave(cell(place.x), cell(place.y)), walk)
        });
        let bounds = |k: u32| Rect::EMPTY.with(at(walks[k as usize]));
        let tree = BoundsTree::new(0, walks.len() as u32, bounds);
        Self { walks, tree }
    }

    /// As [`Holes::each`], however long it takes.
    fn each(&self, domain: &Domain, pockets: &Pockets, suspect: &mut dyn FnMut(u32) -> bool) {
        self.tree.visit(&mut Near { domain, rings: self, pockets, suspect, done: false });
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

/// The pockets of some pieces of one path.
#[derive(Debug)]
pub(super) struct Pockets {
    pockets: SmallVec<[Pocket; 4]>,
    /// The box of all.
    pub bounds: Rect,
    /// Walks of the governors: they are touched, so they do not lie in a pocket whole.
    own: [u32; 2],
}

impl Pockets {
    fn new(domain: &Domain, links: impl Iterator<Item = Link>) -> Self {
        let mut own = [u32::MAX; 2];
        let mut bounds = Rect::EMPTY;
        let mut pockets = SmallVec::new();
        for link in links {
            own = [link.right, link.left].map(|s| domain.edge(s.index()).walk);
            let pocket = Pocket::new(domain, &link);
            bounds = bounds.union(pocket.bounds);
            pockets.push(pocket);
        }
        Self { pockets, bounds, own }
    }

    /// Whether a ring with this point, of this walk, may lie in one of them.
    #[inline]
    pub fn may_hold(&self, at: Point, walk: u32) -> bool {
        self.bounds.holds(at)
            && !self.own.contains(&walk)
            && self.pockets.iter().any(|pocket| pocket.bounds.holds(at) && pocket.holds(at))
    }
}

/// The walks of holes that may lie in one of some pockets.
struct Near<'q> {
    domain: &'q Domain,
    rings: &'q HiddenRings,
    pockets: &'q Pockets,
    suspect: &'q mut dyn FnMut(u32) -> bool,
    done: bool,
}

impl Visitor for Near<'_> {
    fn enters(&self, bounds: &Rect, _items: Range<u32>) -> bool {
        !self.done && bounds.meets(&self.pockets.bounds)
    }

    fn item(&mut self, item: u32) {
        let walk = self.rings.walks[item as usize];
        if !self.done && self.pockets.may_hold(point(self.domain, walk), walk) {
            self.done = !(self.suspect)(walk);
        }
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
