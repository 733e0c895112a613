//! Exact questions about a point and single elements.

use std::cmp::Ordering;

use crate::domain::{Domain, Site};
use crate::geom::predicates::{Element, compare_distances};
use crate::geom::{Double, Point, dot_directions, orient2d};

/// The part of a closed element that is nearest to a point: an open edge, or a corner.
pub(super) fn nearest_part(domain: &Domain, site: Site, p: Point) -> Site {
    if !site.is_edge() {
        return site;
    }
    let edge = site.index();
    let (a, b) = (domain.edge(edge).start, domain.end(edge));
    if dot_directions(a, b, a, p) <= 0.0 {
        Site::corner(edge)
    } else if dot_directions(a, b, b, p) >= 0.0 {
        Site::corner(domain.edge(edge).next)
    } else {
        site
    }
}

/// Orders the distances of a point from two closed elements.
pub(super) fn compare(domain: &Domain, p: Point, first: Site, second: Site) -> Ordering {
    let [first, second] = [first, second].map(|site| domain.element(nearest_part(domain, site, p)));
    compare_distances(p, first, second)
}

/// Whether a point lies between the normals of both edges at a corner, or on one of them.
pub(super) fn between_normals(domain: &Domain, corner: Site, p: Point) -> bool {
    let edge = domain.edge(corner.index());
    let (v, before, after) = (edge.start, domain.edge(edge.prev).start, domain.end(corner.index()));
    dot_directions(before, v, v, p) >= 0.0 && dot_directions(v, after, v, p) <= 0.0
}

/// The side of an edge on which a point lies: `Greater` for the left, where the interior is.
pub(super) fn side(domain: &Domain, edge: u32, p: Point) -> Ordering {
    let turn = orient2d(domain.edge(edge).start, domain.end(edge), p);
    turn.partial_cmp(&0.0).unwrap_or(Ordering::Equal)
}

/// Distance and footpoint of a point on the line of an edge, or on a corner; rounded once or twice.
pub(super) fn footpoint(p: Point, element: Element) -> (f64, Point) {
    let from = |q: Point| (Double::difference(p.x, q.x), Double::difference(p.y, q.y));
    match element {
        Element::Corner(q) => {
            let (x, y) = from(q);
            ((x * x + y * y).sqrt().value(), q)
        }
        Element::Edge(a, b) => {
            let (x, y) = from(a);
            let (dx, dy) = (Double::difference(b.x, a.x), Double::difference(b.y, a.y));
            let length2 = dx * dx + dy * dy;
            let share = (dx * x + dy * y) / length2;
            let at = |start: f64, d: Double| (Double::from(start) + share * d).value();
            let across = (dx * y - dy * x).value().abs();
            let distance = (Double::from(across) / length2.sqrt()).value();
            (distance, Point::new(at(a.x, dx), at(a.y, dy)))
        }
    }
}
