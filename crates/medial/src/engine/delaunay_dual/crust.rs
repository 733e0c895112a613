//! The border that points without any order lie on.
//!
//! # Contract
//! Edges are those of the definition, decided exactly for the points as given; for the two-step crust, whose
//! definition takes computed points, for these as rounded. O(n log n) expected.
//!
//! # Method
//! One step [GS01]: an edge of the Delaunay graph is in the crust if some circle through its ends holds neither a point
//! nor a Voronoi vertex at one of its sides ([`Delaunay::is_crust`]). Two steps [ABE98]: if it is still an edge of the
//! Delaunay graph when all Voronoi vertices are points as well; inside the hull these edges are some of the others.
//!
//! # Departures
//! Edges of the hull are in the one-step crust if their triangle sees them under no more than half a right angle. By
//! the definition a right angle is enough there, which makes crust of edges across bays, six for a silhouette.

use crate::geom::{Delaunay, Point};

/// The edges of the one-step crust of points, as pairs of their places, and of equal ones the first; `None` if all of
/// them lie on one line.
///
/// ```
/// use medial::engine::crust;
/// use medial::geom::Point;
/// // A square with points in the middles of its sides.
/// let points = [(0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (0, 1)];
/// let points = points.map(|(x, y)| Point::new(f64::from(x), f64::from(y)));
/// assert_eq!(crust(&points).map(|edges| edges.len()), Some(8));
/// ```
#[must_use]
pub fn crust(points: &[Point]) -> Option<Vec<[u32; 2]>> {
    let triangles = Delaunay::new(points)?;
    let edges = triangles.edges().filter(|&edge| triangles.is_crust(edge));
    Some(sorted(edges.map(|edge| {
        [triangles.origin(edge), triangles.target(edge)].map(|vertex| triangles.point_of(vertex))
    })))
}

/// The edges of the two-step crust of points, as those of [`crust`].
#[must_use]
pub fn two_step_crust(points: &[Point]) -> Option<Vec<[u32; 2]>> {
    let triangles = Delaunay::new(points)?;
    let vertices = (0..triangles.n_faces()).map(|face| triangles.circle(face).0);
    let vertices = vertices.filter(|vertex| (vertex.x + vertex.y).is_finite());
    let n = points.len() as u32;
    let all: Vec<Point> = points.iter().copied().chain(vertices).collect();
    let triangles = Delaunay::new(&all)?;
    let ends =
        |edge| [triangles.origin(edge), triangles.target(edge)].map(|v| triangles.point_of(v));
    Some(sorted(triangles.edges().map(ends).filter(|ends| ends.iter().all(|&end| end < n))))
}

/// Pairs in their order, the smaller one of each first.
fn sorted(edges: impl Iterator<Item = [u32; 2]>) -> Vec<[u32; 2]> {
    let mut edges: Vec<[u32; 2]> = edges.map(|[a, b]| [a.min(b), a.max(b)]).collect();
    edges.sort_unstable();
    edges
}

/// The closed borders that points without any order lie on.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Border {
    /// Rings of points, each of which two edges of the crust meet in.
    pub rings: Vec<Vec<Point>>,
    /// Points in none of them.
    pub left_out: Vec<Point>,
}

/// The closed rings of the one-step crust of points; of points where other than two edges meet there are none.
///
/// Whoever wants an axis of them makes a [`Domain`](crate::domain::Domain) of the rings, regrouped by nesting.
///
/// ```
/// use medial::engine::border;
/// use medial::geom::Point;
/// let turn = |k: u32| 0.1 * std::f64::consts::TAU * f64::from(k);
/// // Ten points around a circle in no order, and one far away.
/// let order = [3, 1, 4, 0, 5, 9, 2, 6, 8, 7];
/// let mut points: Vec<Point> = order.map(|k| Point::new(turn(k).cos(), turn(k).sin())).to_vec();
/// points.push(Point::new(9.0, 0.5));
/// let border = border(&points);
/// assert_eq!((border.rings.len(), border.rings[0].len(), border.left_out.len()), (1, 10, 1));
/// ```
#[must_use]
pub fn border(points: &[Point]) -> Border {
    let edges = crust(points).unwrap_or_default();
    let mut joined: Vec<Vec<u32>> = vec![Vec::new(); points.len()];
    for &[a, b] in &edges {
        joined[a as usize].push(b);
        joined[b as usize].push(a);
    }
    // Ends of open lines are in no ring, nor is what leads to them.
    let mut ends: Vec<u32> =
        (0..points.len() as u32).filter(|&k| joined[k as usize].len() == 1).collect();
    while let Some(end) = ends.pop() {
        let Some(other) = joined[end as usize].pop() else { continue };
        joined[other as usize].retain(|&k| k != end);
        if joined[other as usize].len() == 1 {
            ends.push(other);
        }
    }
    let mut is_taken = vec![false; points.len()];
    let mut border = Border::default();
    for start in 0..points.len() as u32 {
        if is_taken[start as usize] || joined[start as usize].len() != 2 {
            continue;
        }
        let mut ring = vec![start];
        let (mut before, mut at) = (start, joined[start as usize][0]);
        while at != start && joined[at as usize].len() == 2 {
            ring.push(at);
            let [first, second] = [joined[at as usize][0], joined[at as usize][1]];
            (before, at) = (at, if first == before { second } else { first });
        }
        if at == start {
            ring.iter().for_each(|&k| is_taken[k as usize] = true);
            border.rings.push(ring.iter().map(|&k| points[k as usize]).collect());
        }
    }
    let left_out = (0..points.len()).filter(|&k| !is_taken[k]).map(|k| points[k]);
    border.left_out = left_out.collect();
    border
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::INFINITY;

    /// Numbers between 0 and 1 without any order.
    fn numbers(seed: u64) -> impl FnMut() -> f64 {
        let mut state = seed;
        move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 11) as f64 / 2f64.powi(53)
        }
    }

    #[test]
    fn the_one_step_crust_is_that_of_the_heights_of_voronoi_vertices() {
        for seed in 0..40 {
            let mut number = numbers(seed);
            let points: Vec<Point> = (0..60).map(|_| Point::new(number(), number())).collect();
            let triangles = Delaunay::new(&points).unwrap();
            for edge in triangles.edges() {
                let [a, b] = [triangles.origin(edge), triangles.target(edge)];
                let [a, b] = [a, b].map(|vertex| triangles.point(vertex));
                let sides = [edge, triangles.reversed(edge)].map(|side| triangles.left(side));
                if sides.iter().any(|&face| face >= triangles.n_faces()) {
                    continue;
                }
                // How far the centres are from the edge, each to its own side.
                let normal = (b - a).perp() * (1.0 / (b - a).norm());
                let [left, right] = sides.map(|face| normal.dot(triangles.circle(face).0 - a));
                let half = 0.5 * (b - a).norm();
                let expected = left > 0.0 && right < 0.0 && left * -right >= half * half;
                assert_eq!(triangles.is_crust(edge), expected, "{seed} {a:?} {b:?}");
            }
        }
    }

    #[test]
    fn the_two_step_crust_is_a_part_of_the_one_step_crust() {
        for seed in 0..40 {
            let mut number = numbers(seed);
            let points: Vec<Point> = (0..80).map(|_| Point::new(number(), number())).collect();
            let (one, two) = (crust(&points).unwrap(), two_step_crust(&points).unwrap());
            let triangles = Delaunay::new(&points).unwrap();
            let is_hull = |edge: &[u32; 2]| {
                let [a, b] = edge.map(|point| triangles.vertex_of(point));
                let edge = triangles.edge_between(a, b).unwrap();
                [edge, triangles.reversed(edge)].map(|e| triangles.apex(e)).contains(&INFINITY)
            };
            assert!(two.len() > 20);
            assert!(two.iter().all(|edge| one.binary_search(edge).is_ok() || is_hull(edge)));
        }
    }

    #[test]
    fn dense_samples_of_smooth_curves_give_the_curves_back() {
        // An ellipse around two circles.
        let round = |n: u32, x: f64, a: f64, b: f64| {
            (0..n).map(move |k| {
                let (sin, cos) = (std::f64::consts::TAU * f64::from(k) / f64::from(n)).sin_cos();
                Point::new(x + a * cos, b * sin)
            })
        };
        let rings = [(300, 0.0, 10.0, 5.0), (60, -4.0, 2.0, 2.0), (60, 4.0, 2.0, 2.0)];
        let mut points: Vec<Point> =
            rings.into_iter().flat_map(|(n, x, a, b)| round(n, x, a, b)).collect();
        let expected = points.len();
        assert_eq!(crust(&points).unwrap().len(), expected);
        assert_eq!(two_step_crust(&points).unwrap().len(), expected);
        let mut number = numbers(7);
        points.sort_by_cached_key(|_| (number() * 1e6) as u64);
        let found = border(&points);
        let mut sizes: Vec<usize> = found.rings.iter().map(Vec::len).collect();
        sizes.sort_unstable();
        assert_eq!((sizes, found.left_out.len()), (vec![60, 60, 300], 0));
    }

    #[test]
    fn points_on_a_line_have_no_border() {
        let line: Vec<Point> = (0..9).map(|k| Point::new(f64::from(k), f64::from(k))).collect();
        assert_eq!(crust(&line), None);
        assert_eq!(border(&line), Border { rings: Vec::new(), left_out: line });
    }
}
