//! The outlines of cells.

use super::{Cell, Voronoi};
use crate::axis::{Curve, Side, Site, SiteKind};
use crate::geom::Point;

/// A straight line between two points with their distances from the boundary.
pub(super) fn straight(from: (Point, f64), to: (Point, f64)) -> Curve {
    // Between two edges every curve is a line with a linear radius.
    let edge = Site::edge(from.0, to.0);
    Curve::new(&edge, &edge, from, to)
}

/// The closed outline of a cell, counterclockwise.
pub(super) fn outline(voronoi: &Voronoi, cell: &Cell) -> Vec<Curve> {
    let mut curves: Vec<Curve> = base(voronoi, cell).into_iter().collect();
    curves.extend(pieces(voronoi, cell).map(
        |(curve, forwards)| {
            if forwards { curve } else { curve.piece(1.0, 0.0) }
        },
    ));
    curves
}

/// The outline as points, each curve drawn in its own direction and then turned, so that the cells on
/// both sides of it have the same points.
pub(super) fn ring(voronoi: &Voronoi, cell: &Cell, tolerance: f64) -> Vec<Point> {
    let mut points: Vec<Point> = Vec::new();
    let mut go_on = |next: Point| {
        if points.last() != Some(&next) {
            points.push(next);
        }
    };
    if let Some(curve) = base(voronoi, cell) {
        go_on(curve.from());
        go_on(curve.to());
    }
    for (curve, forwards) in pieces(voronoi, cell) {
        let mut drawn = curve.polyline(tolerance);
        if !forwards {
            drawn.reverse();
        }
        drawn.into_iter().for_each(|(point, _)| go_on(point));
    }
    while points.len() > 1 && points.first() == points.last() {
        points.pop();
    }
    points
}

/// The element itself, if it is an edge, along its cell.
fn base(voronoi: &Voronoi, cell: &Cell) -> Option<Curve> {
    let site = &voronoi.sites[cell.site as usize];
    // The interior of the polygons lies to the left of a site.
    let (from, to) = match cell.side {
        Side::Interior => (site.a, site.b),
        Side::Exterior => (site.b, site.a),
    };
    (site.kind == SiteKind::Edge).then(|| straight((from, 0.0), (to, 0.0)))
}

/// The edges around the cell, with whether they run counterclockwise.
fn pieces<'v>(voronoi: &'v Voronoi, cell: &Cell<'v>) -> impl Iterator<Item = (Curve, bool)> + 'v {
    let site = cell.site;
    cell.edges.iter().map(move |&edge| {
        let edge = &voronoi.graph.edges[edge as usize];
        (voronoi.curve(edge), edge.left == site)
    })
}
