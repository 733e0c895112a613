//! Where the merge curve around a ring crosses an arc of the ring's own diagram.

use std::cell::Cell;
use std::ops::Range;

use super::diagram::{APEX, Diagram, NONE};
use super::disks::Disk;
use super::elements::{Flank, Member, Members};
use super::merge::Crossing;
use super::order;
use crate::axis::{self, Curve};
use crate::domain::{Corner, Site, Walk};
use crate::engine::EngineError;
use crate::engine::draft::contacts::{Contacts, sort};
use crate::geom::{BoundsTree, Point, Rect, TouchingDisk, Visitor};

/// How much a disk grows that has met nothing yet.
const GROWTH: f64 = 2.0;

/// Radius of the first disk on an arc, in diameters of the domain, if nothing else tells.
const NEAREST: f64 = 2e-6;

/// Radius of the largest disk on an unbounded arc, in diameters of the domain.
const FARTHEST: f64 = 4.0;

/// Rounds of growing or shrinking disks, at most.
const MOST_ROUNDS: usize = 4096;

/// Edges in a piece of a walk, at most.
const PIECE: u32 = 8;

/// A few edges of a walk that follow one another.
struct Piece {
    bounds: Rect,
    walk: u32,
    edges: Range<u32>,
}

/// The rings of a domain that are merged already.
pub(super) struct Merged<'a> {
    members: Members<'a>,
    /// All edges, in pieces, and the boxes of these.
    pieces: Vec<Piece>,
    tree: BoundsTree,
    /// Whether each walk is.
    walks: Vec<bool>,
    /// The component of the last one: what another one has is never seen from this one.
    component: u32,
    /// How many edges were looked at.
    looked: Cell<usize>,
}

/// Collects edges near a disk.
struct Near<'n> {
    centre: Point,
    reach: f64,
    merged: &'n Merged<'n>,
    edges: Vec<u32>,
}

impl Visitor for Near<'_> {
    fn enters(&self, bounds: &Rect, _: Range<u32>) -> bool {
        bounds.distance2(self.centre) <= self.reach * self.reach
    }

    fn item(&mut self, item: u32) {
        let Piece { bounds, walk, edges } = &self.merged.pieces[item as usize];
        if !self.enters(bounds, 0..0) || !self.merged.has(*walk) {
            return;
        }
        for edge in edges.clone() {
            let record = self.merged.members.domain.edge(edge);
            if record.distance2(self.centre - record.start) <= self.reach * self.reach {
                self.edges.push(edge);
            }
        }
    }
}

/// Looks for an edge near a disk that cuts it.
struct Found<'n> {
    near: Near<'n>,
    cuts: &'n dyn Fn(u32) -> bool,
    found: bool,
}

impl Visitor for Found<'_> {
    fn enters(&self, bounds: &Rect, range: Range<u32>) -> bool {
        !self.found && self.near.enters(bounds, range)
    }

    fn item(&mut self, item: u32) {
        if self.found {
            return;
        }
        self.near.item(item);
        while !self.found
            && let Some(edge) = self.near.edges.pop()
        {
            let looked = &self.near.merged.looked;
            looked.set(looked.get() + 1);
            self.found = (self.cuts)(edge);
        }
    }
}

impl<'a> Merged<'a> {
    pub fn new(members: Members<'a>) -> Self {
        let domain = members.domain;
        let mut pieces = Vec::new();
        for walk in order::along_curve(domain) {
            let all = domain.walks()[walk as usize].edges();
            for first in all.clone().step_by(PIECE as usize) {
                let edges = first..(first + PIECE).min(all.end);
                let ends = edges.clone().map(|edge| domain.edge(edge).start);
                let bounds = ends.fold(Rect::EMPTY, Rect::with).with(domain.end(edges.end - 1));
                pieces.push(Piece { bounds, walk, edges });
            }
        }
        let tree = BoundsTree::new(0, pieces.len() as u32, |k| pieces[k as usize].bounds);
        let walks = vec![false; domain.walks().len()];
        Self { members, pieces, tree, walks, component: 0, looked: Cell::new(0) }
    }

    /// Notes that a walk is merged.
    pub fn add(&mut self, walk: u32) {
        self.walks[walk as usize] = true;
        self.component = self.members.domain.walks()[walk as usize].component;
    }

    /// Whether a walk is merged, and bounds the component at hand.
    fn has(&self, walk: u32) -> bool {
        let component = self.members.domain.walks()[walk as usize].component;
        self.walks[walk as usize] && component == self.component
    }

    fn near(&self, disk: &TouchingDisk) -> Vec<u32> {
        let mut near = self.near_to(disk);
        self.tree.visit(&mut near);
        self.looked.set(self.looked.get() + near.edges.len());
        near.edges
    }

    /// What looks for edges near a disk.
    fn near_to(&self, disk: &TouchingDisk) -> Near<'_> {
        let centre = disk.position();
        let size = centre.x.abs().max(centre.y.abs()) + disk.radius;
        let bound = if disk.bound.is_finite() { disk.bound } else { 0.0 };
        // With room for rounding: what is near is asked exactly.
        let reach =
            (disk.radius + bound) * (1.0 + 64.0 * f64::EPSILON) + 64.0 * f64::EPSILON * size;
        Near { centre, reach, merged: self, edges: Vec::new() }
    }

    /// How many edges were looked at so far.
    pub fn looked(&self) -> usize {
        self.looked.get()
    }

    /// The elements at an edge that the interior sees: the edge, and its corners if they are reflex.
    fn members_at(&self, edge: u32) -> impl Iterator<Item = Member> {
        let domain = self.members.domain;
        let next = domain.edge(edge).next;
        let corner = move |k: u32| {
            (domain.edge(k).corner == Corner::Reflex).then(|| self.members.member(Site::corner(k)))
        };
        [Some(Member::side(edge, Flank::Left)), corner(edge), corner(next)].into_iter().flatten()
    }

    /// Whether any edge cuts an exact disk.
    fn is_cut(&self, disk: &Disk) -> bool {
        let cuts = |edge: u32| self.members.meets(disk, Member::side(edge, Flank::Left)).is_lt();
        let mut found = Found { near: self.near_to(&disk.disk), cuts: &cuts, found: false };
        self.tree.visit(&mut found);
        found.found
    }

    /// Edges that cut an exact disk, of those near it.
    fn cutting(&self, disk: &Disk, near: &[u32]) -> Vec<u32> {
        let cuts = |&edge: &u32| self.members.meets(disk, Member::side(edge, Flank::Left)).is_lt();
        near.iter().copied().filter(cuts).collect()
    }

    /// Of the elements at some edges the one whose disk comes first along an arc, after its start and
    /// before an end.
    fn first(
        &self,
        edges: &[u32],
        (right, left): (Member, Member),
        start: Option<&Disk>,
        end: Option<&Disk>,
    ) -> Option<Disk> {
        let mut first: Option<Disk> = None;
        let order = |a: &Disk, b: &Disk| self.members.order(a, b, right, left);
        for member in edges.iter().flat_map(|&edge| self.members_at(edge)) {
            let Some(disk) = self.members.disk([right, member, left]) else { continue };
            if self.members.in_zone(&disk, member)
                && start.is_none_or(|start| order(&disk, start).is_gt())
                && end.is_none_or(|end| order(&disk, end).is_lt())
                && first.as_ref().is_none_or(|first| order(&disk, first).is_lt())
            {
                first = Some(disk);
            }
        }
        first
    }

    /// Where the merge curve crosses an arc around a reflex corner of a ring inside.
    pub fn crossing(&self, diagram: &Diagram, walk: &Walk) -> Result<Crossing, EngineError> {
        let domain = self.members.domain;
        for edge in walk.edges() {
            if domain.edge(edge).corner != Corner::Reflex {
                continue;
            }
            let cell = self.members.member(Site::corner(edge));
            let mut half = diagram.ends[cell.0 as usize][0];
            while half != NONE {
                if diagram.to(half) == APEX {
                    break;
                }
                // Infinity has no disk, and is lost.
                let far = diagram.disk(diagram.to(half));
                if far.as_ref().is_none_or(|far| self.is_cut(far)) {
                    if let Some(crossing) = self.on(diagram, half, far) {
                        return Ok(crossing);
                    }
                    break;
                }
                half = diagram.half(half).next;
            }
        }
        let place = domain.edge(walk.first).start;
        Err(EngineError::Internal { stage: "looking for the merge curve around a ring", place })
    }

    /// Where the merge curve crosses an arc whose far end is lost.
    fn on(&self, diagram: &Diagram, half: u32, far: Option<Disk>) -> Option<Crossing> {
        let (left, right) = (diagram.half(half).cell, diagram.beyond(half));
        let start = diagram.disk(diagram.half(half).from);
        let first = |edges: &[u32], end: Option<&Disk>| {
            self.first(edges, (right, left), start.as_ref(), end)
        };
        let mut next = match &far {
            Some(far) => self.first_before(left, right, start.as_ref(), far)?,
            None => self.first_near(left, right, start.as_ref())?,
        };
        for _ in 0..MOST_ROUNDS {
            let near = self.near(&next.disk);
            let edges = self.cutting(&next, &near);
            if edges.is_empty() {
                return self.crossing_at(diagram, half, next, near);
            }
            next = first(&edges, Some(&next))?;
        }
        None
    }

    /// The first disk that growing disks on an arc up to a vertex lead to.
    fn first_before(
        &self,
        left: Member,
        right: Member,
        start: Option<&Disk>,
        far: &Disk,
    ) -> Option<Disk> {
        let site = |member: Member| {
            let (a, b) = self.members.ends(member);
            if member.is_corner() { axis::Site::vertex(a) } else { axis::Site::edge(a, b) }
        };
        let place = |disk: &Disk| (disk.disk.position(), disk.disk.radius);
        // An arc without a vertex at its start starts in the corner.
        let from = start.map_or_else(|| (self.members.ends(left).0, 0.0), place);
        let curve = Curve::new(&site(left), &site(right), from, place(far));
        let all = self.tree.bounds();
        let mut radius = from.1.max((all.max - all.min).norm() * NEAREST) * GROWTH;
        while radius < far.disk.radius {
            if let Some(u) = curve.parameters_at_radius(radius).into_iter().flatten().last() {
                let (origin, centre) = (curve.point_at(u), Point::default());
                let probe = TouchingDisk { origin, centre, radius, bound: f64::INFINITY };
                let first = self.first(&self.near(&probe), (right, left), start, Some(far));
                if first.is_some() {
                    return first;
                }
            }
            radius *= GROWTH;
        }
        let cutting = self.cutting(far, &self.near(&far.disk));
        self.first(&cutting, (right, left), start, Some(far))
    }

    /// The first disk that growing disks on an unbounded arc lead to.
    fn first_near(&self, left: Member, right: Member, start: Option<&Disk>) -> Option<Disk> {
        let ((l, l_end), (r, r_end)) = (self.members.ends(left), self.members.ends(right));
        let all = self.tree.bounds();
        let all_size = (all.max - all.min).norm();
        let largest = all_size * FARTHEST;
        let (middle, way, half) = if right.is_corner() {
            let across = l - r;
            let length = across.norm();
            ((l + r) * 0.5, -(across.perp() * (1.0 / length)), length / 2.0)
        } else {
            let direction = (r_end - r) * (1.0 / (r_end - r).norm());
            (l_end, direction.perp(), 0.0)
        };
        let size = (l_end - l).norm().max((r_end - r).norm()).max(all_size * NEAREST) / 2.0;
        let mut radius = start.map_or(0.0, |s| s.disk.radius).max(half).max(size);
        loop {
            let along = (radius * radius - half * half).max(0.0).sqrt();
            let (origin, centre) = (middle, way * along);
            let disk = TouchingDisk { origin, centre, radius, bound: f64::INFINITY };
            let edges = self.near(&disk);
            let first = self.first(&edges, (right, left), start, None);
            if first.is_some() || radius > largest {
                return first;
            }
            radius *= GROWTH;
        }
    }

    /// What the curve needs to start at a disk on an arc of the ring.
    fn crossing_at(
        &self,
        diagram: &Diagram,
        half: u32,
        start: Disk,
        near: Vec<u32>,
    ) -> Option<Crossing> {
        let members = &self.members;
        let domain = members.domain;
        let mut contacts: Contacts = start.triple.iter().map(|&m| members.site(m)).collect();
        for member in near.into_iter().flat_map(|edge| self.members_at(edge)) {
            if members.meets(&start, member).is_eq() {
                contacts.push(members.site(member));
            }
        }
        let triple = start.triple.map(|m| members.site(m));
        contacts.sort_unstable();
        contacts.dedup();
        sort(domain, &start.disk, Some(&members.exact(&start)), &triple, &mut contacts);
        // Counterclockwise after the cell that the curve goes on in comes its other one.
        let right = members.site(diagram.beyond(half));
        let at = contacts.iter().position(|&s| s == right)?;
        let site = contacts[(at + 1) % contacts.len()];
        let left = members.member(site);
        Some(Crossing { half, start, left })
    }
}
