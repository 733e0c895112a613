//! How lines go on straight beyond the axis.

use super::line::Centerline;
use crate::domain::Domain;
use crate::geom::Point;

/// Where a line meets the boundary if it goes on straight beyond both ends.
pub(super) fn to_boundary(domain: &Domain, line: &Centerline) -> [Option<(Point, f64)>; 2] {
    let (Some(first), Some(last)) = (line.curves.first(), line.curves.last()) else {
        return [None; 2];
    };
    let start = first.from() - first.control().unwrap_or(first.to());
    let end = last.to() - last.control().unwrap_or(last.from());
    let [starts_free, ends_free] = line.is_free;
    let beyond = |is_free: bool, radius: f64, from: Point, way: Point| {
        // In a corner it is on the boundary already.
        let goes_on = is_free && radius > 0.0;
        goes_on.then(|| hit(domain, from, way)).flatten().map(|p| (p, 0.0))
    };
    [
        beyond(starts_free, first.radius_from(), first.from(), start),
        beyond(ends_free, last.radius_to(), last.to(), end),
    ]
}

/// Where a ray meets the boundary first.
fn hit(domain: &Domain, from: Point, way: Point) -> Option<Point> {
    let mut first: Option<f64> = None;
    for edge in 0..domain.edges().len() as u32 {
        let (a, b) = (domain.edge(edge).start - from, domain.end(edge) - from);
        let (left, right) = (way.cross(a), way.cross(b));
        // From inside an edge is met from its left.
        if left <= 0.0 && right >= 0.0 && left < right {
            let along = a.cross(b) / (right - left);
            if along > 0.0 && first.is_none_or(|first| along < first) {
                first = Some(along);
            }
        }
    }
    first.map(|along| from + way * along)
}
