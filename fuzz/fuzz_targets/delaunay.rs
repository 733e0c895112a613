//! Points of small lattices, full of circles through four and more, against the contract of the triangulation.

#![no_main]

use libfuzzer_sys::fuzz_target;
use medial::geom::{Delaunay, Point, in_circle, orient2d};

/// Points up to which all circles are asked about all of them.
const MOST: usize = 60;

/// Points of a lattice whose width the first byte tells; the second one tells how they are scaled and moved.
fn points(data: &[u8]) -> Option<Vec<Point>> {
    let (&[width, pose], places) = data.split_first_chunk()?;
    let width = 2 + width % 30;
    let (scale, offset) = match pose % 5 {
        0 | 1 => (1.0, 0.0),
        2 => (0.25, -1e6),
        3 => (0.1, 1.0 / 3.0),
        _ => (2_f64.powi(-60), 2_f64.powi(-20)),
    };
    let place = |byte: u8| f64::from(byte % width) * scale + offset;
    let pairs = places.chunks_exact(2).take(MOST);
    Some(pairs.map(|pair| Point::new(place(pair[0]), place(pair[1]))).collect())
}

fuzz_target!(|data: &[u8]| {
    let Some(points) = points(data) else { return };
    let Some(mut triangles) = Delaunay::new(&points) else {
        let Some(&first) = points.first() else { return };
        let other = points.iter().find(|&&p| p != first).copied().unwrap_or(first);
        assert!(points.iter().all(|&p| orient2d(first, other, p) == 0.0), "{points:?}");
        return;
    };
    let n = triangles.n_vertices();
    let hull = triangles.n_hull();
    assert_eq!(triangles.n_faces() + hull, 2 * n - 2, "{points:?}");
    assert_eq!(triangles.n_edges() + hull, 3 * n - 3, "{points:?}");
    for (k, &point) in (0..).zip(&points) {
        assert_eq!(triangles.point(triangles.vertex_of(k)), point);
    }
    for face in 0..triangles.n_faces() {
        let [a, b, c] = triangles.corners(face).map(|vertex| triangles.point(vertex));
        assert!(orient2d(a, b, c) > 0.0, "{points:?}");
        assert!(points.iter().all(|&d| in_circle(a, b, c, d) <= 0.0), "{points:?}");
    }
    // Whatever two vertices are joined, triangles stay triangles, or it is told what lies between.
    let [a, b] = [0, points.len() as u32 - 1].map(|point| triangles.vertex_of(point));
    if triangles.constrain([(a, b)]).is_ok() {
        assert!(a == b || triangles.edge_between(a, b).is_some_and(|edge| triangles.is_kept(edge)));
        for face in 0..triangles.n_faces() {
            let [a, b, c] = triangles.corners(face).map(|vertex| triangles.point(vertex));
            assert!(orient2d(a, b, c) > 0.0, "{points:?}");
        }
    }
});
