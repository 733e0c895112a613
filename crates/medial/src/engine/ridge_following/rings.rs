//! The contours of a domain or a mask, before edges are merged.

use crate::domain::{Curves, Domain, PieceEnd, Walk};
use crate::geom::Point;
use crate::raster::{Contour, Cracks, Grid};

/// A contour with the side of the axis on its left.
#[derive(Clone, Debug)]
pub(super) struct Ring {
    pub points: Vec<Point>,
    /// Connected component of the side of the axis.
    pub component: u32,
    /// Whether it is the outer one of its component.
    pub is_outer: bool,
    /// Where curves are known: for each vertex the radius of curvature there, 0 where it is no point of a smooth
    /// curve.
    pub radii: Vec<f64>,
    /// Where curves are known: whether the edge from each vertex is a part of one.
    pub curved: Vec<bool>,
    /// Of a mask: for each vertex the corners that it stands for.
    pub corners: Vec<[Point; 2]>,
}

impl Ring {
    /// Whether the edge from a vertex is a part of a curve.
    pub fn is_curved(&self, vertex: usize) -> bool {
        self.curved.get(vertex).copied().unwrap_or(false)
    }
}

/// The walks of a domain, but those that are left out.
pub(super) fn of_domain(
    domain: &Domain,
    curves: Option<&Curves>,
    is_kept: impl Fn(&Walk) -> bool,
) -> Vec<Ring> {
    let ring = |walk: &Walk| {
        let points = walk.edges().map(|edge| domain.edge(edge).start).collect();
        let (component, is_outer) = (walk.component, !walk.hole);
        let (radii, curved) = curves.map_or_else(Default::default, |curves| {
            let along = runs_as_given(domain, walk);
            let radius = |edge| radius_at(domain, curves, along, edge).unwrap_or(0.0);
            let is_curved = |edge| curves.piece_of(&domain.origin(edge)).is_some();
            (walk.edges().map(radius).collect(), walk.edges().map(is_curved).collect())
        });
        Ring { points, component, is_outer, radii, curved, corners: Vec::new() }
    };
    domain.walks().iter().filter(|walk| is_kept(walk)).map(ring).collect()
}

/// Whether most edges of a walk follow one another as they were given.
fn runs_as_given(domain: &Domain, walk: &Walk) -> bool {
    let index = |edge: u32| domain.origin(edge).index;
    let rises = walk.edges().filter(|&k| index(domain.edge(k).next) > index(k)).count();
    let falls = walk.edges().filter(|&k| index(domain.edge(k).next) < index(k)).count();
    rises >= falls
}

/// The angle between tangents up to which a curve is smooth where two of its pieces meet: coordinates of
/// drawings are rounded. 2 degrees.
const SMOOTH: f64 = 0.035;

/// The radius of curvature where an edge starts, if that is a point of a smooth curve.
fn radius_at(domain: &Domain, curves: &Curves, along: bool, edge: u32) -> Option<f64> {
    let before = domain.edge(edge).prev;
    let [into, out] = [before, edge].map(|edge| curves.piece_of(&domain.origin(edge)));
    // The curve of an edge where it starts or ends.
    let end = |edge: u32, piece: Option<u32>, is_end: bool| {
        let straight = PieceEnd { tangent: domain.edge(edge).direction, curvature: 0.0 };
        let Some(piece) = piece.and_then(|piece| curves.pieces.get(piece as usize)) else {
            return straight;
        };
        let PieceEnd { tangent, curvature } = if is_end == along { piece.end } else { piece.start };
        PieceEnd { tangent: if along { tangent } else { -tangent }, curvature }
    };
    let corners = [domain.edge(before).start, domain.edge(edge).start, domain.end(edge)];
    if into.is_some() && into == out {
        // That of the circle through three vertices, within what the curvature of the piece leaves.
        let ends = [false, true].map(|is_end| end(edge, out, is_end).curvature.abs().recip());
        let [low, high] = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        return Some(circumradius(corners).max(low).min(high));
    }
    let [a, b] = [end(before, into, true), end(edge, out, false)];
    let is_smooth = a.tangent.cross(b.tangent).abs() <= SMOOTH && a.tangent.dot(b.tangent) > 0.0;
    // Two straight edges meet in a corner, however flat.
    let is_smooth = is_smooth && (into.is_some() || out.is_some());
    is_smooth.then(|| a.curvature.abs().max(b.curvature.abs()).recip())
}

/// The radius of the circle through three points; infinite if they lie on a line.
fn circumradius([a, b, c]: [Point; 3]) -> f64 {
    let product = (b - a).norm() * (c - b).norm() * (a - c).norm();
    product / (2.0 * (b - a).cross(c - b).abs())
}

/// The contours of a mask, with steps of one cell cut at their middles.
///
/// A straight boundary becomes stairs in an array: runs of cells, and between them sides of one cell that turn
/// one way where they start and the other way where they end. The middles of these lie within half a cell of the
/// boundary, and the polygon through them has no corners where the shape has none. Corners proper turn twice the
/// same way and stay where they are, so rectangles do as well.
pub(super) fn of_mask(cracks: &Cracks, grid: &Grid) -> Vec<Ring> {
    let ring = |(number, contour): (u32, &Contour)| {
        let edges = cracks.edges_of(number);
        let corners: Vec<[u32; 2]> = edges.iter().map(|edge| edge.from()).collect();
        let mut vertices = cut_steps(&corners);
        if vertices.len() < 3 {
            vertices = corners.iter().map(|&corner| [corner; 2]).collect();
        }
        if grid.is_mirrored() {
            vertices.reverse();
        }
        let corners: Vec<[Point; 2]> =
            vertices.iter().map(|ends| ends.map(|[x, y]| grid.corner(x, y))).collect();
        let points = corners.iter().map(|&[a, b]| (a + b) * 0.5).collect();
        let (component, is_outer) = (contour.polygon, contour.ring == 0);
        Ring { points, component, is_outer, radii: Vec::new(), curved: Vec::new(), corners }
    };
    (0..).zip(&cracks.contours).map(ring).collect()
}

/// The vertices of a contour once its steps are cut: the two ends of each step, whose middle is one, and the
/// corners of none, twice.
fn cut_steps(corners: &[[u32; 2]]) -> Vec<[[u32; 2]; 2]> {
    let n = corners.len();
    let at = |k: usize| corners[k % n].map(i64::from);
    let way = |k: usize| {
        let ([x1, y1], [x2, y2]) = (at(k), at(k + 1));
        [x2 - x1, y2 - y1]
    };
    let turns_left = |k: usize| {
        let ([a, b], [c, d]) = (way(k + n - 1), way(k));
        a * d - b * c > 0
    };
    let is_step = |k: usize| {
        let [x, y] = way(k);
        x.abs() + y.abs() == 1 && turns_left(k) != turns_left(k + 1)
    };
    let mut vertices = Vec::with_capacity(n);
    for k in 0..n {
        if is_step(k) {
            vertices.push([corners[k], corners[(k + 1) % n]]);
        } else if !is_step(k + n - 1) {
            vertices.push([corners[k]; 2]);
        }
    }
    vertices
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stairs_become_slopes_and_corners_stay() {
        let square = [[0, 0], [3, 0], [3, 3], [0, 3]];
        assert_eq!(cut_steps(&square), square.map(|corner| [corner; 2]));
        // Up in three steps of one cell, and straight back.
        let stairs = [[0, 0], [3, 0], [3, 3], [2, 3], [2, 2], [1, 2], [1, 1], [0, 1]];
        let cut = cut_steps(&stairs);
        for step in [[[2, 3], [2, 2]], [[2, 2], [1, 2]], [[1, 2], [1, 1]], [[1, 1], [0, 1]]] {
            assert!(cut.contains(&step), "{cut:?}");
        }
        assert_eq!(cut.len(), 7);
        let single = [[0, 0], [1, 0], [1, 1], [0, 1]];
        assert_eq!(cut_steps(&single).len(), 4);
    }

    #[test]
    fn three_points_have_a_circle() {
        let at = |degrees: f64| {
            Point::new(5.0, 0.0) * degrees.to_radians().cos()
                + Point::new(0.0, 5.0) * degrees.to_radians().sin()
        };
        assert!((circumradius([at(10.0), at(20.0), at(35.0)]) - 5.0).abs() < 1e-12);
    }
}
