//! Centerlines: by hand, and against all pairs of keypoints.

mod support;

use medial::axis::MedialAxis;
use medial::domain::{self, Domain};
use medial::engine::path_tracing;
use medial::geom::Point;
use medial::ops::{Centerline, CenterlineOptions, Extension, Hierarchy, Measure, centerlines};
use support::random::{self, Family, Ground, Random};
use support::shapes;

fn lines(wkt: &str, options: &CenterlineOptions) -> Vec<Centerline> {
    let domain = shapes::wkt(wkt);
    let axis = path_tracing(&domain).unwrap();
    centerlines(&domain, &axis, options).unwrap()
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-12
}

#[test]
fn an_l_has_one_line_around_its_corner() {
    // Arms of width 2, 10 and 8 long.
    let l = "POLYGON ((0 0, 10 0, 10 2, 2 2, 2 8, 0 8, 0 0))";
    let options =
        CenterlineOptions { extension: Extension::Boundary, ..CenterlineOptions::default() };
    let lines = lines(l, &options);
    assert_eq!(lines.len(), 1);
    let line = &lines[0];
    assert!(line.is_best);
    let mut ends = line.extensions.map(|end| end.unwrap().0);
    ends.sort_by(|a, b| a.x.total_cmp(&b.x));
    assert_eq!(ends, [Point::new(1.0, 8.0), Point::new(10.0, 1.0)]);
    // Around the corner at (2, 2) it is two quarters of parabolas over edges, 2 wide.
    let points = line.polyline(1e-3);
    assert!(points.iter().all(|(p, r)| *r <= 1.2 && p.x >= 0.9 && p.y >= 0.9), "{points:?}");
    let widths = line.widths();
    assert!(close(widths.least, 2.0) && widths.greatest < 2.4 && widths.mean < 2.2, "{widths:?}");
    assert!((15.0..16.0).contains(&line.length()), "{}", line.length());
}

#[test]
fn a_ring_without_ends_is_closed() {
    let frame = "POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (3 3, 3 6, 6 6, 6 3, 3 3))";
    let options =
        CenterlineOptions { extension: Extension::Boundary, ..CenterlineOptions::default() };
    let lines = lines(frame, &options);
    let line = &lines[0];
    assert_eq!(line.curves.first().unwrap().from(), line.curves.last().unwrap().to());
    assert_eq!(line.extensions, [None, None]);
    // Four sides of 3, and four quarters of parabolas with their foci in the corners of the hole, 3 from
    // the edges.
    let quarter =
        2.0 * 1.5 * ((2.0_f64.sqrt() - 1.0) * 2.0_f64.sqrt() + (2.0_f64.sqrt() - 1.0).asinh());
    assert!(line.length() > 12.0 && line.length() < 12.0 + 4.0 * quarter, "{}", line.length());
}

#[test]
fn further_lines_are_tributaries() {
    // A T: the bar, then the stem.
    let t = "POLYGON ((0 10, 0 8, 9 8, 9 0, 11 0, 11 8, 20 8, 20 10, 0 10))";
    let options = CenterlineOptions {
        count: 9,
        extension: Extension::Boundary,
        ..CenterlineOptions::default()
    };
    let lines = lines(t, &options);
    assert_eq!(lines.len(), 2);
    assert!(close(lines[0].length(), 20.0) || lines[0].length() > 19.9, "{}", lines[0].length());
    assert!(lines[1].length() > 8.0 && lines[1].length() < 9.5, "{}", lines[1].length());
    assert!(lines[1].polyline(0.1).iter().any(|(p, _)| *p == Point::new(10.0, 0.0)));
}

#[test]
fn a_square_has_its_diagonal() {
    let lines = lines("POLYGON ((0 0, 2 0, 2 2, 0 2, 0 0))", &CenterlineOptions::default());
    assert_eq!(lines.len(), 1);
    assert!(close(lines[0].length(), 8_f64.sqrt()), "{}", lines[0].length());
}

#[test]
fn arms_are_ends_and_not_the_far_side_of_a_ring() {
    // A square ring, 100 wide, with two arms 20 long on one side.
    let ring =
        "POLYGON ((0 0, 100 0, 100 100, 0 100, 0 62, -20 62, -20 58, 0 58, 0 42, -20 42, -20 38,
                0 38, 0 0), (4 4, 4 96, 96 96, 96 4, 4 4))";
    let options =
        CenterlineOptions { extension: Extension::Boundary, ..CenterlineOptions::default() };
    let lines = lines(ring, &options);
    let mut ends = lines[0].extensions.map(|end| end.unwrap().0);
    ends.sort_by(|a, b| a.y.total_cmp(&b.y));
    assert_eq!(ends, [Point::new(-20.0, 40.0), Point::new(-20.0, 60.0)]);
}

#[test]
fn each_component_has_its_line() {
    // Of the square nothing is left but its centre, when corners are taken away.
    let two = "MULTIPOLYGON (((0 0, 6 0, 6 2, 0 2, 0 0)), ((10 0, 12 0, 12 2, 10 2, 10 0)))";
    let lines = lines(two, &CenterlineOptions { count: 2, ..CenterlineOptions::default() });
    assert_eq!(lines.len(), 2);
    assert!(close(lines[1].length(), 8_f64.sqrt()), "{}", lines[1].length());
    assert!(lines.iter().all(|line| line.widths().mean <= line.widths().greatest));
}

/// The greatest of all shortest distances between ends of an axis in one piece; between any keypoints if
/// it has none, from the one to any if it has one.
fn diameter(axis: &MedialAxis) -> f64 {
    let n = axis.keypoints().len();
    let degrees = axis.degrees();
    let n_ends = degrees.iter().filter(|&&d| d == 1).count();
    let counts = |a: usize, b: usize| match n_ends {
        0 => true,
        1 => degrees[a] == 1,
        _ => degrees[a] == 1 && degrees[b] == 1,
    };
    let mut between = vec![f64::INFINITY; n * n];
    (0..n).for_each(|k| between[k * n + k] = 0.0);
    for path in axis.paths() {
        let (a, b, length) = (path.from as usize, path.to as usize, axis.curve(&path).length());
        for at in [a * n + b, b * n + a] {
            between[at] = between[at].min(length);
        }
    }
    for k in 0..n {
        for a in 0..n {
            for b in 0..n {
                between[a * n + b] =
                    between[a * n + b].min(between[a * n + k] + between[k * n + b]);
            }
        }
    }
    let all = (0..n * n).filter(|k| counts(k / n, k % n)).map(|k| between[k]);
    all.filter(|d| d.is_finite()).fold(0.0, f64::max)
}

#[test]
fn no_two_points_of_random_shapes_are_farther_apart() {
    let random = &mut Random(601);
    let options = domain::Options { regroup: true, ..domain::Options::default() };
    let mut tried = 0;
    while tried < 150 {
        let (family, ground, most) = match tried % 3 {
            0 => (Family::Tangle, Ground::Square, 30),
            1 => (Family::Holes, Ground::Grid(30), 60),
            _ => (Family::Holes, Ground::Square, 80),
        };
        let polygons = random::large_shape(random, family, ground, most);
        let Ok(domain) = Domain::from_polygons(&polygons, &options) else { continue };
        if domain.n_components() > 1 {
            continue;
        }
        tried += 1;
        let axis = path_tracing(&domain).unwrap();
        let asked = CenterlineOptions::default();
        let pruned =
            Hierarchy::new(&domain, &axis).unwrap().pruned(asked.ends.0, asked.ends.1).axis;
        let lines = centerlines(&domain, &axis, &asked).unwrap();
        let wkt = || shapes::to_wkt(&polygons);
        assert_eq!(lines.len(), 1, "{}", wkt());
        let line = &lines[0];
        for pair in line.curves.windows(2) {
            assert_eq!(pair[0].to(), pair[1].from(), "{}", wkt());
        }
        let of = if pruned.paths().is_empty() { &axis } else { &pruned };
        let (length, most) = (line.length(), diameter(of));
        // A closed line is all there is.
        let all: f64 = of.paths().iter().map(|path| of.curve(&path).length()).sum();
        let expected = if line.is_closed() { all } else { most };
        assert!(line.is_best, "{}", wkt());
        assert!((length / expected - 1.0).abs() < 1e-12, "{length} of {expected}: {}", wkt());
    }
}

/// A rectangle from a corner on.
fn rectangle(x: f64, y: f64, width: f64, height: f64) -> Vec<Vec<Point>> {
    let corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height)];
    vec![corners.map(|(x, y)| Point::new(x, y)).to_vec()]
}

#[test]
fn a_part_that_prunes_to_a_point_comes_after_those_that_do_not() {
    // Its whole axis is longer than the spine of the rectangle, which its corners leave by 1.99.
    let parts = [rectangle(50.0, 0.0, 2.0, 2.0), rectangle(0.0, 0.0, 40.0, 34.0)];
    let domain = Domain::from_polygons(&parts, &domain::Options::default()).unwrap();
    let axis = path_tracing(&domain).unwrap();
    for count in [1, 2] {
        let options = CenterlineOptions { count, ..CenterlineOptions::default() };
        let lines = centerlines(&domain, &axis, &options).unwrap();
        assert_eq!(lines.len(), count);
        assert!(lines[0].curves.iter().all(|curve| curve.from().x < 41.0), "{lines:?}");
        let alone = lines.get(1).map(|line| line.length());
        assert!(alone.is_none_or(|length| (length - 8.0_f64.sqrt()).abs() < 1e-12), "{alone:?}");
    }
}

#[test]
fn what_rounding_leaves_of_a_point_is_no_line() {
    // A square that is turned and moved: its corners burn up to the middle, but for rounding.
    let corners = [(2.6, 0.2), (-0.2, 2.6), (-2.6, -0.2), (0.2, -2.6)];
    let ring: Vec<Point> = corners.iter().map(|(x, y)| Point::new(1000.1 + x, y - 77.7)).collect();
    let domain = Domain::from_polygons(&[vec![ring]], &domain::Options::default()).unwrap();
    let axis = path_tracing(&domain).unwrap();
    for (measure, threshold) in
        [(Measure::Potential, 3.9), (Measure::Erosion, 1.0), (Measure::RelativeExcess, 0.5)]
    {
        for count in [1, 2] {
            let ends = (measure, threshold);
            let options = CenterlineOptions { count, ends, ..CenterlineOptions::default() };
            let lines = centerlines(&domain, &axis, &options).unwrap();
            assert!(lines.iter().all(|line| line.length() > 1.0), "{measure}: {lines:?}");
            assert!(!lines.is_empty());
        }
    }
}
