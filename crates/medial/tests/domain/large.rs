//! Shapes on which an algorithm that is not O(n log n) does not come to an end.

use medial::domain::{Domain, Options};
use medial::geom::Point;

fn edges(rings: Vec<Vec<Point>>) -> usize {
    let domain = Domain::from_polygons(&[rings], &Options::default()).expect("valid");
    domain.edges().len()
}

#[test]
fn a_comb_of_long_diagonals_is_valid() {
    // 50,000 teeth of width 1 along (1, 1), all as long as the comb is wide.
    let teeth = 50_000;
    let length = 4.0 * f64::from(teeth);
    let mut ring = Vec::new();
    for k in 0..teeth {
        let x = 4.0 * f64::from(k);
        ring.push(Point::new(x, -x));
        ring.push(Point::new(x + length, length - x));
        ring.push(Point::new(x + length + 1.0, length - x - 1.0));
        ring.push(Point::new(x + 1.0, -x - 1.0));
    }
    ring.push(Point::new(length, -length));
    ring.push(Point::new(length - 9.0, -length - 9.0));
    ring.push(Point::new(-9.0, -9.0));
    // The back ends at (-9, -9), so the first corner is straight.
    assert_eq!(edges(vec![ring]), 200_003 - 1);
}

#[test]
fn a_spiral_of_many_turns_is_valid() {
    // A square spiral corridor of width 1: corners at odd and even distances.
    let turns = 50_000;
    let corner = |k: i32, r: f64| match k % 4 {
        0 => Point::new(r, -r),
        1 => Point::new(r, r),
        2 => Point::new(-r, r),
        _ => Point::new(-r, -r + 2.0),
    };
    let arm = |offset: f64| (4..2 * turns).map(move |k| corner(k, f64::from(k / 4) * 2.0 + offset));
    let mut ring: Vec<Point> = arm(0.0).collect();
    ring.extend(arm(1.0).rev());
    let n = ring.len();
    assert_eq!(n, 4 * turns as usize - 8);
    assert_eq!(edges(vec![ring]), n);
}

#[test]
fn many_corners_at_one_point_are_sectors_of_one_star() {
    // Triangles with a common corner, on a parabola so that nothing is on one line.
    let triangles = 30_000;
    let mut ring = Vec::new();
    for k in 0..triangles {
        let x = f64::from(2 * k + 1);
        ring.push(Point::new(0.0, 0.0));
        ring.push(Point::new(1.0, x));
        ring.push(Point::new(1.0, x + 1.0));
    }
    let domain = Domain::from_polygons(&[vec![ring]], &Options::default()).expect("valid");
    assert_eq!(domain.n_components(), triangles as usize);
    assert_eq!(domain.walks().len(), triangles as usize);
}

#[test]
fn a_ring_of_spikes_folds_up_to_nothing() {
    let ring: Vec<Point> = (0..200_000)
        .map(|k| if k % 2 == 0 { Point::new(0.0, 0.0) } else { Point::new(1.0, f64::from(k)) })
        .collect();
    let error = Domain::from_polygons(&[vec![ring]], &Options::default()).expect_err("folds");
    assert_eq!(error.code(), "collinear");
}

#[test]
fn an_edge_may_be_touched_by_many_holes() {
    let holes = 30_000;
    let width = f64::from(4 * holes + 4);
    let outer = [(0.0, 0.0), (width, 0.0), (width, 4.0), (0.0, 4.0)];
    let mut rings = vec![outer.map(|(x, y)| Point::new(x, y)).to_vec()];
    for k in 0..holes {
        let x = f64::from(4 * k + 2);
        rings.push(vec![Point::new(x, 0.0), Point::new(x + 1.0, 1.0), Point::new(x - 1.0, 1.0)]);
    }
    let domain = Domain::from_polygons(&[rings], &Options::default()).expect("valid");
    assert_eq!(domain.edges().len(), 4 + 4 * holes as usize);
    assert_eq!(domain.walks().len(), 1);
    let last = domain.lines().iter().filter(|&&line| line == domain.line(0)).count();
    assert_eq!(last, 1 + holes as usize);
}
