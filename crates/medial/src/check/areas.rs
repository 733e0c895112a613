use super::context::Context;
use super::enclosure::norm1;
use super::verdict::{Identity, Relation};
use crate::axis::Path;
use crate::domain::{Domain, Site};
use crate::geom::{Double, Point};

/// How far a coordinate of a right keypoint may be off, in parts of the local scale.
const POSITION: f64 = 8.0 * f64::EPSILON;

/// The sum of the areas of all cells against the area of the domain.
///
/// Valid pieces of cells cannot overlap, so the sums agree only if nothing is missing.
pub(super) fn identity(context: &Context) -> Identity {
    let mut sum = Double::ZERO;
    let mut bound = 0.0;
    for path in context.axis.paths() {
        let sites = (context.sites[path.left as usize], context.sites[path.right as usize]);
        let (Some(left), Some(right)) = sites else { continue };
        let (area, error) = beside(context, &path, left, right);
        sum = sum + area.into();
        bound += error;
    }
    let (area, error) = area(context.domain);
    Identity {
        name: "area of the cells",
        expected: area,
        found: sum.value(),
        relation: Relation::Within(bound + error),
    }
}

/// The area of the domain and its error.
fn area(domain: &Domain) -> (f64, f64) {
    let mut sum = Double::ZERO;
    let mut error = 0.0;
    for walk in domain.walks() {
        let origin = domain.edge(walk.first).start;
        let local =
            |p: Point| (Double::difference(p.x, origin.x), Double::difference(p.y, origin.y));
        for edge in walk.edges() {
            let ((ax, ay), (bx, by)) = (local(domain.edge(edge).start), local(domain.end(edge)));
            let term = ax * by - ay * bx;
            sum = sum + term;
            error += term.value().abs();
        }
    }
    (0.5 * sum.value(), f64::EPSILON * (sum.value().abs() + f64::EPSILON * error))
}

/// The area of the two pieces of cells beside a path, and its error.
fn beside(context: &Context, path: &Path, left: Site, right: Site) -> (f64, f64) {
    let domain = context.domain;
    let ends = [path.from, path.to].map(|k| context.axis.keypoints().at(k));
    let [c1, c2] = ends.map(|k| k.position);
    let [r1, r2] = ends.map(|k| k.radius);
    // Any point of the boundary near by makes the coordinates small.
    let scale = norm1(c1).max(norm1(c2)) + r1 + r2;
    let off = POSITION * scale;
    let chord = (c2 - c1).norm();
    let start = |site: Site| domain.edge(site.index()).start;
    let direction = |site: Site| domain.edge(site.index()).direction;
    match (left.is_edge(), right.is_edge()) {
        (true, true) => {
            // Two trapezoids.
            let along = |site: Site| direction(site).dot(c2 - c1).abs();
            let width = along(left) + along(right);
            let area = 0.5 * width * (r1 + r2);
            (area, 4.0 * off * (r1 + r2 + chord) + 8.0 * f64::EPSILON * area)
        }
        (false, false) => {
            // Two triangles, mirror images of one another.
            let area = (c1 - start(left)).cross(c2 - start(left)).abs();
            (area, 4.0 * off * (r1 + r2 + chord) + 8.0 * f64::EPSILON * r1 * r2)
        }
        (left_is_edge, _) => {
            let (edge, corner) = if left_is_edge { (left, right) } else { (right, left) };
            let d = distance_from_line(start(corner), start(edge), domain.end(edge.index()));
            let width = direction(edge).dot(c2 - c1).abs();
            // Sagitta of the parabola; the radius is convex along it.
            // A distance far below an ulp may be rounded to 0.
            let sagitta = if width > 0.0 { width * width / (8.0 * d) } else { 0.0 };
            let middle = 0.5 * (r1 + r2) - sagitta;
            let below = width * (r1 + r2 + 4.0 * middle) / 6.0;
            let error = 8.0 * off * (r1 + r2 + chord + 2.0 * sagitta)
                + 16.0 * f64::EPSILON * width * (r1 + r2 + sagitta);
            (1.5 * below, error)
        }
    }
}

/// Distance of a point from the line through `a` and `b`, rounded once or twice.
fn distance_from_line(p: Point, a: Point, b: Point) -> f64 {
    let (dx, dy) = (Double::difference(b.x, a.x), Double::difference(b.y, a.y));
    let (qx, qy) = (Double::difference(p.x, a.x), Double::difference(p.y, a.y));
    ((dx * qy - dy * qx) / (dx * dx + dy * dy).sqrt()).value()
}
