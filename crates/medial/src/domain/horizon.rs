//! What of a boundary is seen from infinity: the elements on its convex hull.

use super::complement::Complement;
use super::{Corner, Domain, Site};
use crate::geom::{Point, orient2d};

/// The elements whose cells are unbounded, by the outside of a domain.
///
/// Every gap between two neighbouring points of the convex hull that no edge closes sends one path of
/// the exterior axis to infinity, between the two corners there.
#[derive(Clone, Debug, Default)]
pub struct Horizon {
    /// The corners at the two ends of each gap, to the right and to the left as seen outwards; in
    /// boundary order of the hull.
    pub gaps: Vec<(Site, Site)>,
    /// The edges on the hull, in ascending order.
    pub edges: Vec<u32>,
}

impl Complement {
    /// What of the boundary is seen from infinity; sites and edges are those of
    /// [`domain`](Self::domain). O(n log n).
    #[must_use]
    pub fn horizon(&self) -> Horizon {
        let domain = self.domain();
        let mut corners: Vec<u32> = (Self::n_frame_edges()..domain.edges().len() as u32).collect();
        // Most corners are well within.
        let outline = extremes(domain, &corners);
        corners.retain(|&c| !is_within(&outline, domain.edge(c).start));
        // Of what the corners at a place see, one sees infinity.
        corners.sort_unstable_by(|&a, &b| {
            let (p, q) = (domain.edge(a).start, domain.edge(b).start);
            p.lexicographic(q).then(a.cmp(&b))
        });
        let hull = hull(domain, &corners);
        let mut horizon = Horizon::default();
        for (k, &p) in hull.iter().enumerate() {
            let q = hull[(k + 1) % hull.len()];
            let at = |place: Point| {
                let first =
                    corners.partition_point(|&c| domain.edge(c).start.lexicographic(place).is_lt());
                corners[first..].iter().copied().take_while(move |&c| domain.edge(c).start == place)
            };
            // The hull runs counterclockwise, and the outside has its edges the other way round.
            if let Some(edge) = at(q).find(|&c| domain.end(c) == p) {
                horizon.edges.push(edge);
                continue;
            }
            let outer = |place: Point| at(place).find(|&c| domain.edge(c).corner == Corner::Reflex);
            if let (Some(right), Some(left)) = (outer(p), outer(q)) {
                horizon.gaps.push((Site::corner(right), Site::corner(left)));
            }
        }
        horizon.edges.sort_unstable();
        horizon
    }
}

/// The corners that lie farthest in each of eight directions, or nearly so, counterclockwise.
fn extremes(domain: &Domain, corners: &[u32]) -> Vec<Point> {
    const WAYS: [(f64, f64); 8] = [
        (-1.0, -1.0),
        (0.0, -1.0),
        (1.0, -1.0),
        (1.0, 0.0),
        (1.0, 1.0),
        (0.0, 1.0),
        (-1.0, 1.0),
        (-1.0, 0.0),
    ];
    let mut far = [(f64::NEG_INFINITY, Point::default()); WAYS.len()];
    for place in corners.iter().map(|&c| domain.edge(c).start) {
        for (far, (x, y)) in far.iter_mut().zip(WAYS) {
            let reach = x * place.x + y * place.y;
            if reach > far.0 {
                *far = (reach, place);
            }
        }
    }
    let mut outline: Vec<Point> = far.into_iter().map(|(_, place)| place).collect();
    outline.dedup();
    outline
}

/// Whether a place lies to the left of each side of a closed polygon. Then the sides wind around it, so
/// it lies in the inside of the hull of their ends, whatever these are.
fn is_within(outline: &[Point], place: Point) -> bool {
    (0..outline.len()).all(|k| {
        let (a, b) = (outline[k], outline[(k + 1) % outline.len()]);
        a == b || orient2d(a, b, place) > 0.0
    })
}

/// The places on the convex hull of corners in lexicographic order, counterclockwise, with those on
/// its straight parts.
fn hull(domain: &Domain, corners: &[u32]) -> Vec<Point> {
    let mut places: Vec<Point> = corners.iter().map(|&c| domain.edge(c).start).collect();
    places.dedup();
    let mut hull = Vec::new();
    chain(&mut hull, places.iter().copied());
    chain(&mut hull, places.iter().rev().copied());
    hull
}

/// Appends the lower side of the hull of places in order, without the last one.
fn chain(hull: &mut Vec<Point>, places: impl Iterator<Item = Point>) {
    let first = hull.len();
    for place in places {
        while let [.., a, b] = hull[first..]
            && orient2d(a, b, place) < 0.0
        {
            hull.pop();
        }
        hull.push(place);
    }
    hull.pop();
}
