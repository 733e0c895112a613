use std::cmp::Ordering;
use std::ops::Range;

use super::contacts;
use super::front::Lune;
use super::search::{Gap, Proposal, SLACK, Search};
use super::touch::Touch;
use crate::domain::{Corner, Site};
use crate::geom::predicates::ExactDisk;
use crate::geom::{Point, Rect, TouchingDisk, Visitor};

const U: f64 = f64::EPSILON / 2.0;

/// What became of a disk.
#[derive(Clone, Debug)]
pub(super) enum Verdict {
    /// Empty, and every governor is touched in its zone: all contacts, counterclockwise.
    Clear(Vec<Site>),
    /// Something cuts it, and this comes earlier on the path.
    Better(Proposal),
    /// This site cuts it, exactly.
    Earlier(Site),
    /// Some of these sites cut it, or stand where a governor of the path ends.
    Cut(Vec<Site>),
    /// The third governor is touched beyond its end.
    OffEdge,
}

/// One walk through the tree with one disk.
pub(super) struct Verify<'s, 'a> {
    search: &'s Search<'a>,
    gap: &'s Gap,
    /// Sites of the certified disk.
    triple: [Site; 3],
    certified: TouchingDisk,
    position: f64,
    /// The disk that is looked into: the certified one, or a better proposal.
    disk: TouchingDisk,
    best: Option<Proposal>,
    /// Whether the disk looked into is only a proposal.
    hunting: bool,
    /// Whether doubles may propose.
    floating: bool,
    centre: Point,
    reach2: f64,
    lune: Lune,
    cut: Vec<u32>,
    doubtful: Vec<u32>,
}

impl<'s, 'a> Verify<'s, 'a> {
    /// Looks for anything that cuts the certified disk of a triple.
    pub fn certified(
        search: &'s Search<'a>,
        gap: &'s Gap,
        triple: [Site; 3],
        disk: TouchingDisk,
        position: f64,
        floating: bool,
    ) -> Self {
        let mut verify = Self {
            search,
            gap,
            triple,
            certified: disk,
            position,
            disk,
            best: None,
            hunting: false,
            floating,
            centre: Point::default(),
            reach2: 0.0,
            lune: Lune::EVERYTHING,
            cut: Vec::new(),
            doubtful: Vec::new(),
        };
        verify.look_into(disk);
        verify
    }

    /// Looks for the first proposal within an uncertified disk of the path.
    pub fn hunting(
        search: &'s Search<'a>,
        gap: &'s Gap,
        disk: TouchingDisk,
        position: f64,
    ) -> Self {
        let triple = [gap.right, gap.right, gap.left];
        let mut verify = Self::certified(search, gap, triple, disk, position, true);
        verify.hunting = true;
        verify
    }

    /// The best proposal met.
    pub fn best(&self) -> Option<Proposal> {
        self.best
    }

    /// Whether anything met cuts the first disk looked into.
    pub fn is_cut(&self) -> bool {
        !self.cut.is_empty()
    }

    pub fn run(&mut self) {
        self.search.tree.visit(self);
    }

    fn look_into(&mut self, disk: TouchingDisk) {
        self.disk = disk;
        self.centre = disk.position();
        let size = self.centre.x.abs().max(self.centre.y.abs()) + disk.radius;
        let bound = if disk.bound.is_finite() { disk.bound } else { 0.0 };
        let reach = (disk.radius + bound) * (1.0 + 64.0 * U) + 64.0 * U * size;
        self.reach2 = reach * reach * (1.0 + 8.0 * U);
        let start = &self.gap.start;
        self.lune = Lune::new(start.centre, start.radius, start.doubt, &disk);
    }

    /// Sites of an edge that could become third governors.
    fn sites_of(&self, edge: u32) -> impl Iterator<Item = Site> + use<> {
        let domain = self.search.domain;
        let next = domain.edge(edge).next;
        let corner = |k: u32| (domain.edge(k).corner != Corner::Convex).then_some(Site::corner(k));
        [Some(Site::edge(edge)), corner(edge), corner(next)].into_iter().flatten()
    }

    /// Takes note of an edge that cuts the disk looked into.
    fn cuts(&mut self, edge: u32) {
        self.cut.push(edge);
        if !self.floating {
            return;
        }
        for site in self.sites_of(edge) {
            let Some(p) = self.search.propose(self.gap, site) else { continue };
            let limit = self.best.map_or(self.position, |b| b.position);
            // The radius is convex along a path: an earlier disk is no larger than both ends.
            let largest = self.disk.radius.max(self.gap.start.radius) * (1.0 + SLACK);
            if p.position < limit && p.disk.radius <= largest {
                self.best = Some(p);
                self.hunting = true;
                self.look_into(p.disk);
            }
        }
    }

    /// Whether a corner governor stands at an end of the edge, and at which.
    fn end_at_governor(&self, edge: u32) -> Option<bool> {
        let next = self.search.domain.edge(edge).next;
        self.triple.iter().find_map(|&s| {
            if s.is_edge() {
                None
            } else if s.index() == edge {
                Some(true)
            } else if s.index() == next {
                Some(false)
            } else {
                None
            }
        })
    }

    /// The verdict on the certified disk, once the walk is done.
    pub fn verdict(self, exact: Option<ExactDisk>) -> Verdict {
        let search = self.search;
        if let Some(best) = self.best {
            return Verdict::Better(best);
        }
        if !self.cut.is_empty() {
            return Verdict::Cut(self.cut.iter().flat_map(|&k| self.sites_of(k)).collect());
        }
        let mut exact = exact;
        let mut contacts: Vec<Site> = Vec::with_capacity(4);
        let domain = search.domain;
        let need = |exact: &mut Option<ExactDisk>| -> bool {
            if exact.is_none() {
                *exact = search.exact(&self.triple);
            }
            exact.is_some()
        };
        // The three sites themselves, each touched within its zone.
        for (role, &site) in self.triple.iter().enumerate() {
            if !site.is_edge() {
                if domain.edge(site.index()).corner == Corner::Reflex {
                    contacts.push(site);
                }
                continue;
            }
            let edge = site.index();
            let next = domain.edge(edge).next;
            let corner_at = |k: u32| self.triple.contains(&Site::corner(k));
            let (at_start, at_end) = if corner_at(edge) {
                (Ordering::Equal, Ordering::Less)
            } else if corner_at(next) {
                (Ordering::Greater, Ordering::Equal)
            } else {
                let (start, end) = self.foot(edge);
                match (start, end) {
                    (Some(s), Some(e)) => (s, e),
                    _ if need(&mut exact) => {
                        let (a, b) = (domain.edge(edge).start, domain.end(edge));
                        let disk = exact.as_ref();
                        let ask = |p| disk.map_or(Ordering::Equal, |d| d.along(a, b, p));
                        (start.unwrap_or_else(|| ask(a)), end.unwrap_or_else(|| ask(b)))
                    }
                    _ => return Verdict::OffEdge,
                }
            };
            if at_start == Ordering::Less || at_end == Ordering::Greater {
                return match (role, at_end) {
                    (0, Ordering::Greater) => Verdict::Cut(vec![domain.ahead(site)]),
                    (2, _) if at_start == Ordering::Less => Verdict::Cut(vec![domain.behind(site)]),
                    _ => Verdict::OffEdge,
                };
            }
            contacts.push(site);
            let reflex = |k: u32| domain.edge(k).corner == Corner::Reflex;
            for (side, corner) in [(at_start, edge), (at_end, next)] {
                if side == Ordering::Equal && reflex(corner) && !corner_at(corner) {
                    contacts.push(Site::corner(corner));
                }
            }
        }
        for &edge in &self.doubtful {
            if !need(&mut exact) {
                return Verdict::OffEdge;
            }
            let Some(disk) = &exact else { return Verdict::OffEdge };
            match search.touch(disk, edge) {
                Touch::Clear => {}
                Touch::Cut(part) => return Verdict::Earlier(part),
                Touch::Contact { edge: on_edge, corner } => {
                    contacts.extend(on_edge.then_some(Site::edge(edge)));
                    contacts.extend(corner);
                }
            }
        }
        contacts::sort(domain, &self.certified, exact.as_ref(), &self.triple, &mut contacts);
        Verdict::Clear(contacts)
    }

    /// On which side of an edge's start and end the foot of the certified centre lies, where
    /// doubles can tell.
    fn foot(&self, edge: u32) -> (Option<Ordering>, Option<Ordering>) {
        let domain = self.search.domain;
        let direction = domain.edge(edge).direction;
        let side = |p: Point| {
            let a = p - self.certified.origin;
            let q = self.certified.centre - a;
            let x = direction.dot(q);
            let doubt = self.doubt(a, q);
            (x.abs() > doubt).then_some(if x > 0.0 { Ordering::Greater } else { Ordering::Less })
        };
        (side(domain.edge(edge).start), side(domain.end(edge)))
    }

    /// Bound on the error of a distance, or a position along an edge, from the certified centre.
    fn doubt(&self, a: Point, q: Point) -> f64 {
        let d = &self.certified;
        d.bound + U * (16.0 * (q.x.abs() + q.y.abs()) + a.x.abs() + a.y.abs() + 2.0 * d.radius)
    }
}

impl Visitor for Verify<'_, '_> {
    #[inline]
    fn enters(&self, bounds: &Rect, items: Range<u32>) -> bool {
        bounds.distance2(self.centre) <= self.reach2
            && self.lune.meets(bounds)
            && self.gap.front.is_none_or(|f| f.meets(&items))
    }

    fn item(&mut self, edge: u32) {
        let domain = self.search.domain;
        let site = Site::edge(edge);
        if site == self.gap.right
            || site == self.gap.left
            || self.gap.front.is_some_and(|f| !f.holds(edge))
        {
            return;
        }
        let record = domain.edge(edge);
        let d = self.disk;
        let a = record.start - d.origin;
        let q = d.centre - a;
        let x = record.direction.dot(q);
        if self.hunting {
            // A share of the radius keeps what merely touches from being proposed.
            let clear = d.radius * (1.0 - 1e-9);
            let next = record.next;
            let own = |s: Site| !s.is_edge() && (s.index() == edge || s.index() == next);
            if own(self.gap.right) || own(self.gap.left) {
                return;
            }
            let distance2 = if x <= 0.0 {
                q.norm2()
            } else if x >= record.length {
                (d.centre - (domain.end(edge) - d.origin)).norm2()
            } else {
                let h = record.direction.cross(q);
                h * h
            };
            if distance2 < clear * clear {
                self.cuts(edge);
            }
            return;
        }
        if site == self.triple[1] {
            return;
        }
        let doubt = self.doubt(a, q);
        if let Some(at_start) = self.end_at_governor(edge) {
            // The nearest point is at most the corner itself: only its wall counts.
            let b = domain.end(edge) - d.origin;
            let x = if at_start { x } else { -record.direction.dot(d.centre - b) };
            if x > doubt {
                self.cuts(edge);
            } else if x >= -doubt {
                self.doubtful.push(edge);
            }
            return;
        }
        let distance = if x <= 0.0 {
            q.norm()
        } else if x >= record.length {
            (d.centre - (domain.end(edge) - d.origin)).norm()
        } else {
            record.direction.cross(q).abs()
        };
        if distance > d.radius + doubt {
        } else if distance < d.radius - doubt {
            self.cuts(edge);
        } else {
            self.doubtful.push(edge);
        }
    }
}
