//! Points of the plane and a domain, by its edges one after the other.

use medial::domain::Domain;
use medial::geom::Point;

/// The distance of a point from the boundary.
pub fn distance(domain: &Domain, p: Point) -> f64 {
    let to = |k: u32| {
        let (a, b) = (domain.edge(k).start, domain.end(k));
        let along = ((p - a).dot(b - a) / (b - a).norm2()).clamp(0.0, 1.0);
        (p - (a + (b - a) * along)).norm()
    };
    (0..domain.edges().len() as u32).map(to).fold(f64::INFINITY, f64::min)
}

/// Whether a point lies inside.
pub fn is_inside(domain: &Domain, p: Point) -> bool {
    let crosses = |k: u32| {
        let (a, b) = (domain.edge(k).start, domain.end(k));
        (a.y <= p.y) != (b.y <= p.y) && ((b - a).cross(p - a) > 0.0) == (b.y > a.y)
    };
    (0..domain.edges().len() as u32).filter(|&k| crosses(k)).count() % 2 == 1
}
