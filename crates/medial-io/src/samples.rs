//! Axes known by heart, for tests.

use medial::axis::{Accuracy, Engine, KeypointKind, MedialAxis, Path, Side, Site};
use medial::domain::{Domain, Options};
use medial::engine::{self, path_tracing};
use medial::geom::Point;
use medial::ops::Voronoi;

fn p(x: f64, y: f64) -> Point {
    Point::new(x, y)
}

/// Edges of a ring followed by its reflex corners, each named by its position in the ring.
fn sites(ring: &[Point], reflex: &[u32]) -> Vec<Site> {
    let n = ring.len();
    let edges = (0..n).map(|k| Site { index: k as u32, ..Site::edge(ring[k], ring[(k + 1) % n]) });
    let corners = reflex.iter().map(|&k| Site { index: k, ..Site::vertex(ring[k as usize]) });
    edges.chain(corners).collect()
}

fn axis(
    sites: Vec<Site>,
    keypoints: &[(Point, f64, KeypointKind, &[u32])],
    paths: &[[u32; 4]],
) -> MedialAxis {
    let paths =
        paths.iter().map(|&[from, to, left, right]| Path { from, to, left, right }).collect();
    MedialAxis::from_parts(
        Engine::PathTracing,
        Side::Interior,
        Accuracy::Exact,
        true,
        sites,
        keypoints.iter().copied(),
        paths,
    )
    .unwrap()
}

/// What `ask` says of the Voronoi diagram inside some rings.
pub(crate) fn with_voronoi<R>(rings: &[Vec<Point>], ask: impl FnOnce(&Voronoi) -> R) -> R {
    let domain = Domain::from_polygons(&[rings.to_vec()], &Options::default()).unwrap();
    let axes = [path_tracing(&domain).unwrap()];
    ask(&Voronoi::new(&domain, &axes).unwrap())
}

/// The same of the diagram inside and outside.
pub(crate) fn with_both_sides<R>(rings: &[Vec<Point>], ask: impl FnOnce(&Voronoi) -> R) -> R {
    let domain = Domain::from_polygons(&[rings.to_vec()], &Options::default()).unwrap();
    let options = engine::Options::default();
    let outside = engine::exterior(&domain, Engine::PathTracing, None, &options).unwrap();
    let axes = [path_tracing(&domain).unwrap(), outside];
    ask(&Voronoi::new(&domain, &axes).unwrap())
}

/// The boundary of the square of side 2.
pub(crate) fn square_rings() -> Vec<Vec<Point>> {
    vec![vec![p(0.0, 0.0), p(2.0, 0.0), p(2.0, 2.0), p(0.0, 2.0)]]
}

/// The boundary of the rectangle 4 × 2.
pub(crate) fn rectangle_rings() -> Vec<Vec<Point>> {
    vec![vec![p(0.0, 0.0), p(4.0, 0.0), p(4.0, 2.0), p(0.0, 2.0)]]
}

/// Its axis: a spine from (1, 1) to (3, 1), and four diagonals.
pub(crate) fn rectangle() -> MedialAxis {
    use KeypointKind::{End, Junction};
    let ring = &rectangle_rings()[0];
    axis(
        sites(ring, &[]),
        &[
            (ring[0], 0.0, End, &[3, 0]),
            (ring[1], 0.0, End, &[0, 1]),
            (ring[2], 0.0, End, &[1, 2]),
            (ring[3], 0.0, End, &[2, 3]),
            (p(1.0, 1.0), 1.0, Junction, &[0, 2, 3]),
            (p(3.0, 1.0), 1.0, Junction, &[0, 1, 2]),
        ],
        &[[0, 4, 3, 0], [3, 4, 2, 3], [4, 5, 2, 0], [5, 1, 1, 0], [5, 2, 2, 1]],
    )
}

/// The boundary of the L with arms 1 wide and 3 long.
pub(crate) fn l_rings() -> Vec<Vec<Point>> {
    vec![vec![p(0.0, 0.0), p(3.0, 0.0), p(3.0, 1.0), p(1.0, 1.0), p(1.0, 3.0), p(0.0, 3.0)]]
}

/// Its axis: the reflex corner (1, 1) is site 6 and governs two parabolas.
pub(crate) fn l_shape() -> MedialAxis {
    use KeypointKind::{End, Junction, Transition};
    let ring = &l_rings()[0];
    let q = 2.0 - 2.0_f64.sqrt();
    axis(
        sites(ring, &[3]),
        &[
            (ring[0], 0.0, End, &[5, 0]),
            (ring[1], 0.0, End, &[0, 1]),
            (ring[2], 0.0, End, &[1, 2]),
            (ring[4], 0.0, End, &[3, 4]),
            (ring[5], 0.0, End, &[4, 5]),
            (p(2.5, 0.5), 0.5, Junction, &[0, 1, 2]),
            (p(0.5, 2.5), 0.5, Junction, &[3, 4, 5]),
            (p(q, q), q, Junction, &[0, 6, 5]),
            (p(1.0, 0.5), 0.5, Transition, &[0, 2, 6]),
            (p(0.5, 1.0), 0.5, Transition, &[3, 5, 6]),
        ],
        &[
            [0, 7, 5, 0],
            [7, 8, 6, 0],
            [8, 5, 2, 0],
            [5, 1, 1, 0],
            [5, 2, 2, 1],
            [7, 9, 5, 6],
            [9, 6, 5, 3],
            [6, 3, 4, 3],
            [6, 4, 5, 4],
        ],
    )
}
