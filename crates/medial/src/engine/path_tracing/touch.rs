use std::cmp::Ordering::{self, Equal, Greater, Less};

use crate::domain::{Corner, Domain, Site};
use crate::geom::Point;
use crate::geom::predicates::{Element, ExactDisk};

/// What an edge, with its ends, is to a disk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Touch {
    /// Outside, or touched from behind.
    Clear,
    /// The disk is cut, and this part of the edge is nearest to its centre: the edge itself, or
    /// the corner at one of its ends.
    Cut(Site),
    /// The disk is touched by the edge, by the reflex corner at one of its ends, or by both.
    Contact {
        /// The edge touches, perhaps at its end.
        edge: bool,
        /// A reflex corner touches.
        corner: Option<Site>,
    },
}

/// Where a centre lies to an edge, as far as doubles can tell.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Seen {
    /// Along the edge from its start.
    pub start: Option<Ordering>,
    /// Along the edge from its end.
    pub end: Option<Ordering>,
    /// In front of it.
    pub front: Option<Ordering>,
}

/// Decides exactly what edge number `edge` and its two corners are to a disk.
pub(super) fn touch(domain: &Domain, disk: &ExactDisk, edge: u32, seen: Seen) -> Touch {
    let (a, b) = (domain.edge(edge).start, domain.end(edge));
    let from_start = seen.start.unwrap_or_else(|| disk.along(a, b, a));
    if from_start != Greater {
        return touch_end(domain, disk, edge, a, edge, from_start == Equal);
    }
    let from_end = seen.end.unwrap_or_else(|| disk.along(a, b, b));
    if from_end != Less {
        return touch_end(domain, disk, edge, b, domain.edge(edge).next, from_end == Equal);
    }
    match seen.front.unwrap_or_else(|| disk.front(a, b)) {
        // From behind nothing is touched, but a disk far too large may hold the edge.
        Less => match disk.side(Element::Edge(b, a)) {
            Less => Touch::Cut(Site::edge(edge)),
            Equal | Greater => Touch::Clear,
        },
        Equal => Touch::Cut(Site::edge(edge)),
        Greater => match disk.side(Element::Edge(a, b)) {
            Less => Touch::Cut(Site::edge(edge)),
            Equal => Touch::Contact { edge: true, corner: None },
            Greater => Touch::Clear,
        },
    }
}

/// The nearest point of the edge is its end `p`, the corner at the start of edge `corner`.
fn touch_end(
    domain: &Domain,
    disk: &ExactDisk,
    edge: u32,
    p: Point,
    corner: u32,
    on_normal: bool,
) -> Touch {
    match disk.side(Element::Corner(p)) {
        Less => Touch::Cut(if domain.edge(corner).corner == Corner::Convex {
            Site::edge(edge)
        } else {
            Site::corner(corner)
        }),
        Greater => Touch::Clear,
        Equal => {
            let (a, b) = (domain.edge(edge).start, domain.end(edge));
            let edge = on_normal && disk.front(a, b) == Greater;
            let reflex = domain.edge(corner).corner == Corner::Reflex;
            let corner =
                (reflex && in_corner_zone(domain, disk, corner)).then_some(Site::corner(corner));
            if edge || corner.is_some() { Touch::Contact { edge, corner } } else { Touch::Clear }
        }
    }
}

/// Whether the centre lies between the normals of the corner at the start of edge `corner`.
pub(super) fn in_corner_zone(domain: &Domain, disk: &ExactDisk, corner: u32) -> bool {
    let edge = domain.edge(corner);
    let (before, at, after) = (domain.edge(edge.prev).start, edge.start, domain.end(corner));
    disk.along(before, at, at) != Less && disk.along(at, after, at) != Greater
}
