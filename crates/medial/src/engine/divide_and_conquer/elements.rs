//! Boundary elements seen from both sides.

use super::exact::Exacts;
use super::infinity::turn;
use super::touches;
use crate::domain::{Domain, Edge, Site};
use crate::engine::EngineError;
use crate::geom::predicates::{Element, Whole};
use crate::geom::{Governor, Point};

/// An element of a two-sided diagram.
///
/// Of edge number k: 4k is the corner at its start, 4k + 1 its left side, where the interior is, 4k + 2
/// its right side, and 4k + 3 the corner at its end. So a corner has two numbers, one for each of the
/// chains that meet in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Member(pub u32);

/// A side of the boundary.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Flank {
    Left,
    Right,
}

impl Member {
    pub const fn start(edge: u32) -> Self {
        Self(4 * edge)
    }

    pub const fn end(edge: u32) -> Self {
        Self(4 * edge + 3)
    }

    pub const fn side(edge: u32, flank: Flank) -> Self {
        match flank {
            Flank::Left => Self(4 * edge + 1),
            Flank::Right => Self(4 * edge + 2),
        }
    }

    pub const fn edge(self) -> u32 {
        self.0 >> 2
    }

    pub const fn is_corner(self) -> bool {
        matches!(self.0 & 3, 0 | 3)
    }

    /// The side of the edge; the right one only where it is that.
    pub const fn flank(self) -> Flank {
        if self.0 & 3 == 2 { Flank::Right } else { Flank::Left }
    }
}

/// What threads share of the elements of a domain.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ground<'a> {
    pub domain: &'a Domain,
    lines: &'a [Line],
    /// Whether the boundary touches itself anywhere.
    pub touches: bool,
    /// If all coordinates are whole numbers.
    whole: Option<Whole>,
}

impl<'a> Ground<'a> {
    /// # Errors
    /// [`EngineError::TooLarge`] if its arcs cannot be numbered.
    pub fn new(domain: &'a Domain, lines: &'a [Line]) -> Result<Self, EngineError> {
        // Four elements an edge, and some arcs for each.
        let n_edges = domain.edges().len();
        if u32::try_from(n_edges).is_ok_and(|n| n < u32::MAX / 64) {
            let whole = Whole::all(domain.edges().iter().map(|edge| edge.start));
            Ok(Self { domain, lines, touches: touches::any(domain), whole })
        } else {
            Err(EngineError::TooLarge { n_edges })
        }
    }

    /// The elements for one thread.
    pub fn members<'e>(&self, exacts: &'e Exacts) -> Members<'e>
    where
        'a: 'e,
    {
        let Self { domain, lines, touches, whole } = *self;
        Members { domain, exacts, lines, touches, whole }
    }
}

/// The elements of a domain.
#[derive(Clone, Copy, Debug)]
pub(super) struct Members<'a> {
    pub domain: &'a Domain,
    pub exacts: &'a Exacts,
    /// One to an edge.
    lines: &'a [Line],
    /// Whether the boundary touches itself anywhere.
    pub touches: bool,
    /// If all coordinates are whole numbers.
    pub whole: Option<Whole>,
}

/// Where an edge starts and ends, and its unit direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    ends: [Point; 2],
    direction: Point,
}

impl Line {
    /// Those of all edges of a domain.
    pub fn all(domain: &Domain) -> Vec<Self> {
        let edges = domain.edges().iter();
        let line = |edge: &Edge| {
            let ends = [edge.start, domain.edge(edge.next).start];
            Self { ends, direction: edge.direction }
        };
        edges.map(line).collect()
    }
}

impl<'a> Members<'a> {
    /// Whether one side goes straight on where another one ends, in either order.
    #[inline]
    pub fn is_straight(&self, a: Member, b: Member) -> bool {
        self.touches && (self.goes_straight_on(a, b) || self.goes_straight_on(b, a))
    }

    /// Whether the first of two sides goes straight on into the second one.
    fn goes_straight_on(&self, a: Member, b: Member) -> bool {
        let ((start, end), (corner, last)) = (self.ends(a), self.ends(b));
        !a.is_corner()
            && !b.is_corner()
            && a.flank() == b.flank()
            && end == corner
            && turn(start, end, last).is_eq()
    }

    /// The elements of a disk, with the corner in place of a side into which another one goes straight
    /// on: the corner is where the disk touches both.
    #[inline]
    pub fn without_straight(&self, triple: [Member; 3]) -> [Member; 3] {
        if !self.touches {
            return triple;
        }
        let mut without = triple;
        for (k, &side) in triple.iter().enumerate() {
            if triple.iter().any(|&before| self.goes_straight_on(before, side)) {
                without[k] = match side.flank() {
                    Flank::Left => Member::start(side.edge()),
                    Flank::Right => Member::end(side.edge()),
                };
            }
        }
        without
    }

    #[inline]
    fn line(&self, member: Member) -> &Line {
        &self.lines[member.edge() as usize]
    }

    /// Where a corner is.
    #[inline]
    pub fn place(&self, corner: Member) -> Point {
        self.line(corner).ends[(corner.0 >> 1 & 1) as usize]
    }

    /// The ends of a side, so that it is seen from its left; a corner twice.
    #[inline]
    pub fn ends(&self, member: Member) -> (Point, Point) {
        let ends = &self.line(member).ends;
        (ends[(member.0 >> 1 & 1) as usize], ends[(member.0 & 1) as usize])
    }

    pub fn element(&self, member: Member) -> Element {
        let (a, b) = self.ends(member);
        if member.is_corner() { Element::Corner(a) } else { Element::Edge(a, b) }
    }

    #[inline]
    pub fn governor(&self, member: Member) -> Governor {
        let (start, end) = self.ends(member);
        if member.is_corner() {
            return Governor::Corner(start);
        }
        Governor::Edge { start, end, direction: self.direction(member) }
    }

    /// The unit vector along a side, seen from its left.
    #[inline]
    pub fn direction(&self, side: Member) -> Point {
        let direction = self.line(side).direction;
        if side.flank() == Flank::Left { direction } else { -direction }
    }

    /// The site of the interior that an element is.
    pub fn site(&self, member: Member) -> Site {
        let edge = member.edge();
        match member.0 & 3 {
            0 => Site::corner(edge),
            3 => Site::corner(self.domain.edge(edge).next),
            _ => Site::edge(edge),
        }
    }

    /// The element that a site of the interior is in the finished diagram of its ring.
    pub fn member(&self, site: Site) -> Member {
        let (edge, record) = (site.index(), self.domain.edge(site.index()));
        if site.is_edge() {
            Member::side(edge, Flank::Left)
        } else if edge == self.domain.walks()[record.walk as usize].first {
            Member::start(edge)
        } else {
            // The chain that ends in a corner keeps it; at the start of a walk the one that starts.
            Member::end(record.prev)
        }
    }
}
