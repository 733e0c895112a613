//! The boundary as what lines must not cross.

use std::cell::Cell;
use std::ops::Range;

use crate::domain::Domain;
use crate::geom::{BoundsTree, Point, Rect, Visitor, orient2d};

/// The edges of a domain in a tree of boxes.
pub(super) struct Wall<'a> {
    domain: &'a Domain,
    tree: BoundsTree,
    /// A corner of each hole.
    holes: Vec<Point>,
    /// The edge that was nearest last: where the search begins, as the next point is mostly near.
    last: Cell<u32>,
}

/// How much of a segment next to its ends is not looked at, as a share of its length.
///
/// An end on the boundary is rounded, and may lie on the other side.
const BESIDE: f64 = 1.0 / 1_048_576.0;

impl<'a> Wall<'a> {
    pub fn new(domain: &'a Domain) -> Self {
        let bounds = |edge| Rect::EMPTY.with(domain.edge(edge).start).with(domain.end(edge));
        let tree = BoundsTree::new(0, domain.edges().len() as u32, bounds);
        let walks = (0..).zip(domain.walks());
        let holes = walks.filter(|&(number, _)| domain.signed_area(number) < 0.0);
        let holes = holes.map(|(_, walk)| domain.edge(walk.first).start).collect();
        Self { domain, tree, holes, last: Cell::new(0) }
    }

    /// The box around the domain.
    pub fn bounds(&self) -> Rect {
        self.tree.bounds()
    }

    /// Whether a segment keeps off the boundary. What is next to its ends does not count, so both may lie on
    /// the boundary.
    pub fn is_clear(&self, a: Point, b: Point) -> bool {
        let beside = (b - a) * BESIDE;
        let (a, b) = (a + beside, b - beside);
        let bounds = Rect::EMPTY.with(a).with(b);
        let mut crossing = Crossing { domain: self.domain, a, b, bounds, is_clear: true };
        self.tree.visit(&mut crossing);
        crossing.is_clear
    }

    /// Whether a polyline inside can be moved to another one with the same ends: that keeps off the boundary
    /// too, and there is no hole between them.
    pub fn lets_move(&self, old: &[Point], new: &[Point]) -> bool {
        let bounds = old.iter().chain(new).fold(Rect::EMPTY, |bounds, &p| bounds.with(p));
        let is_between = |&hole: &Point| bounds.holds(hole) && rises(old, hole) != rises(new, hole);
        new.windows(2).all(|pair| self.is_clear(pair[0], pair[1]))
            && !self.holes.iter().any(is_between)
    }

    /// The distance of the nearest point of the boundary, rounded.
    pub fn distance(&self, p: Point) -> f64 {
        let last = self.last.get();
        let mut nearest = Nearest { domain: self.domain, p, distance2: f64::INFINITY, edge: last };
        nearest.item(last);
        self.tree.visit(&mut nearest);
        self.last.set(nearest.edge);
        nearest.distance2.sqrt()
    }

    /// Whether a point lies inside, by the edges that a ray to the right crosses; either answer is right on
    /// the boundary.
    pub fn holds(&self, p: Point) -> bool {
        let edges = 0..self.domain.edges().len() as u32;
        let rise = |edge: u32| rises(&[self.domain.edge(edge).start, self.domain.end(edge)], p);
        edges.map(rise).sum::<i32>() != 0
    }
}

/// How often a polyline rises through a ray from a point to the right, less how often it falls: for a closed
/// one, how often it runs around the point.
fn rises(line: &[Point], p: Point) -> i32 {
    let rise = |pair: &[Point]| {
        let (a, b) = (pair[0], pair[1]);
        let (rises, falls) = (a.y <= p.y && p.y < b.y, b.y <= p.y && p.y < a.y);
        i32::from(rises && orient2d(a, b, p) > 0.0) - i32::from(falls && orient2d(a, b, p) < 0.0)
    };
    line.windows(2).map(rise).sum()
}

/// Looks for an edge that a segment meets.
struct Crossing<'a> {
    domain: &'a Domain,
    a: Point,
    b: Point,
    bounds: Rect,
    is_clear: bool,
}

impl Visitor for Crossing<'_> {
    fn enters(&self, bounds: &Rect, _: Range<u32>) -> bool {
        self.is_clear && self.bounds.meets(bounds)
    }

    fn item(&mut self, edge: u32) {
        let (a, b) = (self.a, self.b);
        let (c, d) = (self.domain.edge(edge).start, self.domain.end(edge));
        let apart = |s: f64, t: f64| s > 0.0 && t > 0.0 || s < 0.0 && t < 0.0;
        if self.is_clear
            && self.bounds.meets(&Rect::EMPTY.with(c).with(d))
            && !apart(orient2d(a, b, c), orient2d(a, b, d))
            && !apart(orient2d(c, d, a), orient2d(c, d, b))
        {
            self.is_clear = false;
        }
    }
}

/// Looks for the nearest edge.
struct Nearest<'a> {
    domain: &'a Domain,
    p: Point,
    distance2: f64,
    edge: u32,
}

impl Visitor for Nearest<'_> {
    fn enters(&self, bounds: &Rect, _: Range<u32>) -> bool {
        bounds.distance2(self.p) < self.distance2
    }

    fn item(&mut self, number: u32) {
        let edge = self.domain.edge(number);
        let along = edge.direction.dot(self.p - edge.start).clamp(0.0, edge.length);
        let distance2 = (edge.start + edge.direction * along - self.p).norm2();
        if distance2 < self.distance2 {
            (self.distance2, self.edge) = (distance2, number);
        }
    }
}
