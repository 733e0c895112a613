use super::*;
use crate::geom::{in_circle, orient2d};

/// A number from 0 below a bound, and the next state.
fn below(state: &mut u64, bound: u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let mut z = *state;
    z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    (z ^ z >> 31) % bound
}

/// Points of a small lattice, some of them more than once, moved and scaled so that no arithmetic is left out.
fn lattice_points(seed: u64) -> Vec<Point> {
    let mut state = seed;
    let (n, side) = (3 + below(&mut state, 60), 2 + below(&mut state, 9));
    let (scale, offset) =
        [(1.0, 0.0), (0.25, -7.0), (0.1, 0.3), (2f64.powi(-300), 0.0)][seed as usize % 4];
    (0..n)
        .map(|_| {
            let mut at = || below(&mut state, side) as f64 * scale + offset;
            Point::new(at(), at())
        })
        .collect()
}

/// That triangles turn to the left, fill the hull, and that no circle holds a vertex.
fn check(points: &[Point], triangles: &Delaunay, seed: u64) {
    let n = triangles.n_vertices();
    let mut distinct: Vec<(u64, u64)> =
        points.iter().map(|p| ((p.x + 0.0).to_bits(), (p.y + 0.0).to_bits())).collect();
    distinct.sort_unstable();
    distinct.dedup();
    assert_eq!(n as usize, distinct.len(), "{seed}");
    for (k, &point) in (0..).zip(points) {
        assert_eq!(triangles.point(triangles.vertex_of(k)), point, "{seed}");
        assert!(triangles.point_of(triangles.vertex_of(k)) <= k, "{seed}");
    }
    // Euler: n vertices, h of them on the hull.
    let h = triangles.n_hull();
    assert_eq!(
        (triangles.n_faces(), triangles.n_edges()),
        (2 * n - 2 - h, 3 * n - 3 - h),
        "{seed}"
    );
    assert_eq!(triangles.edges().count() as u32, triangles.n_edges());
    // Coordinates of the last family underflow; a power of two changes nothing.
    let scale = if seed % 4 == 3 { 2f64.powi(300) } else { 1.0 };
    let at = |vertex: u32| triangles.point(vertex) * scale;
    for face in 0..triangles.n_faces() {
        let [a, b, c] = triangles.corners(face).map(at);
        assert!(orient2d(a, b, c) > 0.0, "{seed}");
        assert!((0..n).all(|d| in_circle(a, b, c, at(d)) <= 0.0), "{seed}");
        assert!(triangles.edges_of_face(face).iter().all(|&edge| triangles.left(edge) == face));
    }
    for vertex in 0..n {
        assert!(triangles.edges_out_of(vertex).all(|edge| triangles.origin(edge) == vertex));
    }
    for edge in triangles.edges().filter(|&edge| triangles.apex(edge) == INFINITY) {
        let [a, b] = [triangles.origin(edge), triangles.target(edge)].map(at);
        assert!((0..n).all(|c| orient2d(a, b, at(c)) <= 0.0), "{seed}");
    }
}

#[test]
fn no_circle_holds_a_point_of_a_lattice_full_of_ties() {
    for seed in 0..3000 {
        let points = lattice_points(seed);
        match Delaunay::new(&points) {
            Some(triangles) => check(&points, &triangles, seed),
            None => {
                let is_flat = |p: &Point| {
                    points.iter().all(|&q| {
                        let far = points.iter().find(|&&r| r != q).unwrap_or(p);
                        cross(q, *far, *p) == 0.0
                    })
                };
                assert!(points.iter().all(is_flat), "{seed}");
            }
        }
    }
}

/// The cross product of points with few bits.
fn cross(a: Point, b: Point, c: Point) -> f64 {
    (b - a).cross(c - a)
}

#[test]
fn whole_lattices_circles_and_lines_are_triangulated() {
    let square: Vec<Point> =
        (0..900).map(|k| Point::new(f64::from(k % 30), f64::from(k / 30))).collect();
    check(&square, &Delaunay::new(&square).unwrap(), 0);
    // All points of whole coordinates at distance 65 from the origin: 36.
    let circle: Vec<Point> = (-65..=65)
        .flat_map(|x: i32| (-65..=65).map(move |y: i32| (x, y)))
        .filter(|(x, y)| x * x + y * y == 65 * 65)
        .map(|(x, y)| Point::new(f64::from(x), f64::from(y)))
        .collect();
    let triangles = Delaunay::new(&circle).unwrap();
    check(&circle, &triangles, 0);
    assert_eq!(circle.len(), 36);
    let inner = triangles.edges().filter(|&edge| {
        triangles.apex(edge) != INFINITY && triangles.apex(triangles.reversed(edge)) != INFINITY
    });
    assert_eq!(inner.filter(|&edge| triangles.is_cocircular(edge)).count(), 33);
    let mut fan: Vec<Point> = (0..100).map(|k| Point::new(f64::from(k), 0.0)).collect();
    assert!(Delaunay::new(&fan).is_none());
    fan.push(Point::new(3.0, 1.0));
    check(&fan, &Delaunay::new(&fan).unwrap(), 0);
}

#[test]
fn random_doubles_are_triangulated() {
    for seed in 0..40 {
        let mut state = seed;
        let mut at = || below(&mut state, 1 << 53) as f64 / 2f64.powi(53);
        let points: Vec<Point> = (0..200).map(|_| Point::new(at(), at())).collect();
        check(&points, &Delaunay::new(&points).unwrap(), 4 * seed);
    }
}
