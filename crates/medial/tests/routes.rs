//! Lines for labels and between points, and lines as polylines: by hand, and against brute force.

mod support;

use medial::axis::{Curve, MedialAxis};
use medial::domain::{self, Domain};
use medial::engine::path_tracing;
use medial::geom::{Point, orient2d};
use medial::ops::{
    Centerline, CenterlineError, CenterlineOptions, Extension, Hierarchy, LineOptions, Route,
    centerlines, polylines,
};
use support::random::{self, Family, Ground, Random};
use support::shapes;

fn try_lines(wkt: &str, route: Route) -> Result<Vec<Centerline>, CenterlineError> {
    let domain = shapes::wkt(wkt);
    let axis = path_tracing(&domain).unwrap();
    centerlines(&domain, &axis, &CenterlineOptions { route, ..CenterlineOptions::default() })
}

fn label(wkt: &str, height: f64) -> Centerline {
    let lines = try_lines(wkt, Route::Label { height: Some(height) }).unwrap();
    assert_eq!(lines.len(), 1);
    lines[0].clone()
}

fn points(line: &Centerline) -> Vec<Point> {
    line.polyline(1e-3).into_iter().map(|(p, _)| p).collect()
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-9
}

fn same(points: &[Point], expected: &[(f64, f64)]) -> bool {
    let near = |(p, q): (&Point, &(f64, f64))| close(p.x, q.0) && close(p.y, q.1);
    points.len() == expected.len() && points.iter().zip(expected).all(near)
}

#[test]
fn a_rectangle_is_labelled_along_its_spine() {
    let line = label("POLYGON ((0 0, 10 0, 10 2, 0 2, 0 0))", 1.0);
    let mut ends = [line.curves[0].from(), line.curves[line.curves.len() - 1].to()];
    ends.sort_by(|a, b| a.x.total_cmp(&b.x));
    // Up to where the corners are half a radius farther than the boundary.
    let end = 1.25_f64.sqrt();
    assert!(close(ends[0].x, end) && close(ends[1].x, 10.0 - end), "{ends:?}");
    assert!(ends.iter().all(|p| p.y == 1.0));
    assert!(line.is_best);
}

#[test]
fn a_turn_costs_the_height_for_each_radian() {
    // Arms of width 2; the upper one has some 2 to offer, and the corner costs a quarter turn.
    let l = "POLYGON ((0 0, 12 0, 12 2, 2 2, 2 4, 0 4, 0 0))";
    let both = label(l, 0.5);
    assert!(both.length() > 11.0, "{}", both.length());
    assert!(points(&both).iter().any(|p| p.y > 2.8));
    let one = label(l, 1.9);
    assert!((9.0..10.5).contains(&one.length()), "{}", one.length());
    assert!(points(&one).iter().all(|p| p.y < 1.5), "{:?}", points(&one));
}

#[test]
fn a_straight_line_is_better_than_a_longer_one() {
    // A T: from the stem to one side it is longer than along the bar, by 2.
    let t = "POLYGON ((0 10, 0 8, 9 8, 9 -3, 11 -3, 11 8, 20 8, 20 10, 0 10))";
    let longest = &try_lines(t, Route::Longest).unwrap()[0];
    assert!(points(longest).iter().any(|p| p.y < -1.0));
    let bar = label(t, 1.8);
    assert!(points(&bar).iter().all(|p| p.y > 7.9), "{:?}", points(&bar));
    assert!(bar.length() > 17.7 && bar.length() < longest.length());
}

#[test]
fn a_text_stays_where_it_fits() {
    // Two rooms of height 4 joined by a corridor of height 1.
    let rooms =
        "POLYGON ((0 0, 12 0, 12 1.5, 20 1.5, 20 0, 30 0, 30 4, 20 4, 20 2.5, 12 2.5, 12 4, 0 4,
                           0 0))";
    let line = label(rooms, 2.0);
    assert!(line.widths().least >= 2.0 - 1e-9, "{:?}", line.widths());
    assert!(points(&line).iter().all(|p| p.x < 12.0), "the larger room");
    let line = label(rooms, 0.9);
    assert!(line.length() > 20.0, "through both: {}", line.length());
    assert_eq!(try_lines(rooms, Route::Label { height: Some(4.5) }).unwrap(), []);
    // By default half of the greatest width, which is that between the corners of a mouth and the wall.
    let default = &try_lines(rooms, Route::Label { height: None }).unwrap()[0];
    assert!(points(default).iter().all(|p| p.x < 13.0));
}

#[test]
fn a_text_goes_along_the_wider_side_of_a_hole() {
    let ring = "POLYGON ((0 0, 20 0, 20 10, 0 10, 0 0), (2 2, 2 6, 18 6, 18 2, 2 2))";
    let line = label(ring, 1.0);
    assert!(!line.is_closed() && !line.is_best);
    // A quarter of the lower corridor is the narrowest there is; the upper one is 4 wide.
    let upper = points(&line).iter().filter(|p| p.y > 7.9).count();
    assert!(upper >= 2, "{:?}", points(&line));
}

#[test]
fn more_labels_use_what_is_left() {
    let t = "POLYGON ((0 10, 0 8, 9 8, 9 -3, 11 -3, 11 8, 20 8, 20 10, 0 10))";
    let domain = shapes::wkt(t);
    let axis = path_tracing(&domain).unwrap();
    let route = Route::Label { height: Some(1.8) };
    let options = CenterlineOptions { route, count: 9, ..CenterlineOptions::default() };
    let lines = centerlines(&domain, &axis, &options).unwrap();
    assert_eq!(lines.len(), 2);
    assert!(points(&lines[1]).iter().all(|p| (9.0..=11.0).contains(&p.x)));
}

const L: &str = "POLYGON ((0 0, 10 0, 10 2, 2 2, 2 8, 0 8, 0 0))";

fn between(wkt: &str, points: &[(f64, f64)]) -> Result<Vec<Centerline>, CenterlineError> {
    let points = points.iter().map(|&(x, y)| Point::new(x, y)).collect();
    try_lines(wkt, Route::Between(points))
}

#[test]
fn a_line_runs_between_the_nearest_points_of_the_axis() {
    let line = &between(L, &[(8.0, 0.5), (4.0, 1.9)]).unwrap()[0];
    assert!(same(&points(line), &[(8.0, 1.0), (4.0, 1.0)]), "{:?}", points(line));
    assert!(close(line.length(), 4.0) && line.is_free == [false; 2]);
    let back = &between(L, &[(4.0, 1.9), (8.0, 0.5)]).unwrap()[0];
    assert!(same(&points(back), &[(4.0, 1.0), (8.0, 1.0)]), "{:?}", points(back));
    // Beyond the ends of the pruned axis.
    let line = &between(L, &[(10.0, 0.0), (0.0, 8.0)]).unwrap()[0];
    assert!(same(&points(line)[..1], &[(10.0 - 1.25_f64.sqrt(), 1.0)]), "{:?}", points(line));
}

#[test]
fn of_several_points_those_farthest_apart_count() {
    let three = [(6.0, 1.5), (9.0, 1.5), (0.5, 6.0)];
    let line = &between(L, &three).unwrap()[0];
    let points = points(line);
    let ends = [points[0], points[points.len() - 1]];
    assert!(same(&ends, &[(10.0 - 1.25_f64.sqrt(), 1.0), (1.0, 6.0)]), "{ends:?}");
}

#[test]
fn anchors_are_joined_straight() {
    let domain = shapes::wkt(L);
    let axis = path_tracing(&domain).unwrap();
    // On the boundary, and outside: widths are 0 there.
    let anchors = [(8.0, 0.5), (0.0, 6.0)].map(|(x, y)| Point::new(x, y));
    let options = |points: [Point; 2]| CenterlineOptions {
        route: Route::Between(points.to_vec()),
        extension: Extension::Anchors,
        ..CenterlineOptions::default()
    };
    let line = &centerlines(&domain, &axis, &options(anchors)).unwrap()[0];
    assert_eq!(line.extensions, [Some((anchors[0], 0.5)), Some((anchors[1], 0.0))]);
    let outside = [Point::new(8.0, 0.5), Point::new(3.0, 7.0)];
    let line = &centerlines(&domain, &axis, &options(outside)).unwrap()[0];
    assert_eq!(line.extensions[1], Some((outside[1], 0.0)));
    assert!(close(line.curves[line.curves.len() - 1].to().y, 8.0 - 1.25_f64.sqrt()));
}

#[test]
fn a_wall_is_not_looked_through() {
    // A room 4 wide and a corridor 0.4 wide, joined on the right, with a wall 0.2 thick in between.
    let u = "POLYGON ((0 0, 10 0, 10 4.6, 0 4.6, 0 4.2, 9 4.2, 9 4, 0 4, 0 0))";
    let line = &between(u, &[(4.0, 3.9), (2.0, 4.3)]).unwrap()[0];
    let points = points(line);
    assert!(close(points[0].x, 4.0) && close(points[0].y, 2.0), "{points:?}");
    let last = points[points.len() - 1];
    assert!(close(last.x, 2.0) && close(last.y, 4.4), "{points:?}");
    assert!(line.length() > 10.0);
}

#[test]
fn around_a_hole_it_takes_the_shorter_side() {
    let ring = "POLYGON ((0 0, 20 0, 20 20, 0 20, 0 0), (2 2, 2 18, 18 18, 18 2, 2 2))";
    let line = &between(ring, &[(5.0, 1.0), (1.0, 7.0)]).unwrap()[0];
    assert!(points(line).iter().all(|p| p.x <= 5.0 && p.y <= 7.0));
    // Both on one side, the other way round is longer.
    let line = &between(ring, &[(5.0, 1.0), (15.0, 1.0)]).unwrap()[0];
    assert!(close(line.length(), 10.0), "{}", line.length());
}

#[test]
fn what_no_line_runs_between_is_told() {
    let outside = between(L, &[(1.0, 1.0), (11.0, 1.0)]).unwrap_err();
    assert!(matches!(outside, CenterlineError::Outside { point, .. } if point.x == 11.0));
    assert!(outside.to_string().contains("(11, 1) lies outside its box, from (0, 0) to (10, 8)"));
    let nan = between(L, &[(1.0, 1.0), (f64::NAN, 1.0)]).unwrap_err();
    assert!(matches!(nan, CenterlineError::Outside { .. }));
    let few = between(L, &[(1.0, 1.0)]).unwrap_err();
    assert_eq!(few, CenterlineError::FewPoints);
    let one = between(L, &[(5.0, 0.5), (5.0, 1.5)]).unwrap_err();
    assert!(
        matches!(one, CenterlineError::OnePlace { nearest } if same(&[nearest], &[(5.0, 1.0)]))
    );
    let two = "MULTIPOLYGON (((0 0, 6 0, 6 2, 0 2, 0 0)), ((10 0, 16 0, 16 2, 10 2, 10 0)))";
    let apart = between(two, &[(3.0, 1.0), (13.0, 1.0)]).unwrap_err();
    assert!(matches!(apart, CenterlineError::Apart { .. }));
    // The axis of a square is that of all its corners, and no part of what is pruned.
    let square = "MULTIPOLYGON (((0 0, 6 0, 6 2, 0 2, 0 0)), ((10 0, 12 0, 12 2, 10 2, 10 0)))";
    let apart = between(square, &[(3.0, 1.0), (10.5, 0.5)]).unwrap_err();
    assert!(matches!(apart, CenterlineError::Apart { .. }));
    let line = &between(square, &[(10.5, 0.5), (11.5, 1.5)]).unwrap()[0];
    assert!(close(line.length(), 2.0_f64.sqrt()));
}

/// Random domains in one piece, each with its axis and its WKT.
fn random_shapes(
    seed: u64,
    n: usize,
    mut test: impl FnMut(&mut Random, &Domain, &MedialAxis, &str),
) {
    let random = &mut Random(seed);
    let options = domain::Options { regroup: true, ..domain::Options::default() };
    let mut tried = 0;
    while tried < n {
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
        test(random, &domain, &axis, &shapes::to_wkt(&polygons));
    }
}

/// All shortest distances between keypoints.
fn distances(axis: &MedialAxis) -> Vec<Vec<f64>> {
    let n = axis.keypoints().len();
    let mut between = vec![vec![f64::INFINITY; n]; n];
    (0..n).for_each(|k| between[k][k] = 0.0);
    for path in axis.paths() {
        let (a, b, length) = (path.from as usize, path.to as usize, axis.curve(&path).length());
        between[a][b] = between[a][b].min(length);
        between[b][a] = between[b][a].min(length);
    }
    for k in 0..n {
        for a in 0..n {
            for b in 0..n {
                between[a][b] = between[a][b].min(between[a][k] + between[k][b]);
            }
        }
    }
    between
}

#[test]
fn no_way_between_two_points_of_random_axes_is_shorter() {
    random_shapes(602, 90, |random, domain, axis, wkt| {
        let options = CenterlineOptions::default();
        let (measure, value) = options.ends;
        let pruned = Hierarchy::new(domain, axis).unwrap().pruned(measure, value).axis;
        let axis = if pruned.paths().is_empty() { axis } else { &pruned };
        let between = distances(axis);
        let mut place = || {
            let number = random.below(axis.paths().len() as u64) as u32;
            let path = axis.paths().at(number);
            let (curve, u) = (axis.curve(&path), random.unit());
            let ways = [
                (path.from as usize, curve.piece(0.0, u).length()),
                (path.to as usize, curve.piece(u, 1.0).length()),
            ];
            (number, curve.piece(0.0, u).length(), curve.point_at(u), ways)
        };
        let (a, b) = (place(), place());
        let mut least = if a.0 == b.0 { (a.1 - b.1).abs() } else { f64::INFINITY };
        for (from, before) in a.3 {
            for (to, after) in b.3 {
                least = least.min(before + between[from][to] + after);
            }
        }
        let route = Route::Between(vec![a.2, b.2]);
        let full = path_tracing(domain).unwrap();
        let lines = centerlines(domain, &full, &CenterlineOptions { route, ..options }).unwrap();
        let line = &lines[0];
        // Points between others are rounded, and so what is nearest to them.
        assert!((line.length() / least - 1.0).abs() < 1e-6, "{} {least}: {wkt}", line.length());
        for pair in line.curves.windows(2) {
            assert_eq!(pair[0].to(), pair[1].from(), "{wkt}");
        }
    });
}

fn distance_to_segment(p: Point, a: Point, b: Point) -> f64 {
    let way = b - a;
    let share = way.dot(p - a) / way.norm2();
    let share = if share > 0.0 { share.min(1.0) } else { 0.0 };
    (a + way * share - p).norm()
}

fn distance_to_line(p: Point, line: &[Point]) -> f64 {
    line.windows(2)
        .map(|pair| distance_to_segment(p, pair[0], pair[1]))
        .fold(f64::INFINITY, f64::min)
}

/// Points close to each other along a polyline.
fn samples(line: &[Point]) -> impl Iterator<Item = Point> {
    let between = |pair: &[Point]| {
        let (a, b) = (pair[0], pair[1]);
        (0..=16).map(move |k| a + (b - a) * (f64::from(k) / 16.0))
    };
    line.windows(2).flat_map(between)
}

fn boundary(domain: &Domain) -> Vec<[Point; 2]> {
    (0..domain.edges().len() as u32).map(|k| [domain.edge(k).start, domain.end(k)]).collect()
}

#[test]
fn polylines_of_random_shapes_stay_inside_and_near() {
    random_shapes(603, 90, |random, domain, axis, wkt| {
        let extension = if random.below(2) == 0 { Extension::None } else { Extension::Boundary };
        let options = CenterlineOptions { count: 2, extension, ..CenterlineOptions::default() };
        let lines = centerlines(domain, axis, &options).unwrap();
        let edges = boundary(domain);
        let size =
            edges.iter().map(|edge| edge[0].x.abs().max(edge[0].y.abs())).fold(0.0, f64::max);
        let room = [0.003, 0.03, 0.3][random.below(3) as usize] * size;
        let chosen = [(Some(room), None), (None, Some(room)), (Some(room), Some(room))];
        for (smooth, simplify) in chosen {
            let options = LineOptions { tolerance: 1e-4 * size, smooth, simplify };
            let drawn = polylines(domain, &lines, &options);
            assert_eq!(drawn.len(), lines.len());
            let room = room * if smooth.is_some() && simplify.is_some() { 2.0 } else { 1.0 };
            for (line, drawn) in lines.iter().zip(&drawn) {
                let told = || format!("{options:?}: {wkt}");
                let exact: Vec<Point> =
                    line.polyline(1e-5 * size).into_iter().map(|(p, _)| p).collect();
                let points: Vec<Point> = drawn.iter().map(|(p, _)| *p).collect();
                if !line.is_closed() {
                    assert_eq!(points[0], exact[0]);
                    assert_eq!(points[points.len() - 1], exact[exact.len() - 1]);
                }
                let far = |from: &[Point], to: &[Point]| {
                    samples(from).map(|p| distance_to_line(p, to)).fold(0.0, f64::max)
                };
                let most = room + 2e-5 * size;
                assert!(
                    far(&points, &exact) <= most,
                    "{} > {room}, {}",
                    far(&points, &exact),
                    told()
                );
                assert!(
                    far(&exact, &points) <= most,
                    "{} > {room}, {}",
                    far(&exact, &points),
                    told()
                );
                for pair in points.windows(2) {
                    let crosses = |edge: &&[Point; 2]| {
                        let apart = |s: f64, t: f64| s * t >= 0.0;
                        let [a, b] = **edge;
                        !apart(
                            orient2d(pair[0], pair[1], a).signum(),
                            orient2d(pair[0], pair[1], b).signum(),
                        ) && !apart(
                            orient2d(a, b, pair[0]).signum(),
                            orient2d(a, b, pair[1]).signum(),
                        )
                    };
                    // An end on the boundary is rounded.
                    let is_end = |p: Point| p == points[0] || p == points[points.len() - 1];
                    let met = edges.iter().find(crosses);
                    let beside = met.is_some_and(|edge| {
                        pair.iter().any(|&p| {
                            is_end(p) && distance_to_segment(p, edge[0], edge[1]) < 1e-9 * size
                        })
                    });
                    assert!(met.is_none() || beside, "{pair:?} meets {met:?}, {}", told());
                }
                for &(p, radius) in drawn {
                    let near = edges.iter().map(|edge| distance_to_segment(p, edge[0], edge[1]));
                    let least = near.fold(f64::INFINITY, f64::min);
                    assert!((radius - least).abs() < 1e-9 * size, "{radius} {least}, {}", told());
                }
            }
        }
    });
}

#[test]
fn a_smooth_line_has_no_corners() {
    // Of the line of a T's bar and stem, with a corner where the stem meets the bar.
    let domain = shapes::wkt("POLYGON ((0 10, 0 8, 9 8, 9 -9, 11 -9, 11 8, 20 8, 20 10, 0 10))");
    let axis = path_tracing(&domain).unwrap();
    let lines = centerlines(&domain, &axis, &CenterlineOptions::default()).unwrap();
    let sharpest = |smooth: Option<f64>| {
        let options = LineOptions { tolerance: 1e-4, smooth, simplify: None };
        let points = polylines(&domain, &lines, &options).remove(0);
        let turn = |k: usize| {
            let (back, on) = (points[k].0 - points[k - 1].0, points[k + 1].0 - points[k].0);
            back.cross(on).atan2(back.dot(on)).abs()
        };
        (1..points.len() - 1).map(turn).fold(0.0, f64::max)
    };
    assert!(sharpest(None) > 0.5, "{}", sharpest(None));
    assert!(sharpest(Some(0.4)) < 0.2, "{}", sharpest(Some(0.4)));
}

#[test]
fn a_closed_line_stays_closed() {
    let frame = "POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (3 3, 3 6, 6 6, 6 3, 3 3))";
    let domain = shapes::wkt(frame);
    let axis = path_tracing(&domain).unwrap();
    let lines = centerlines(&domain, &axis, &CenterlineOptions::default()).unwrap();
    assert!(lines[0].is_closed());
    for (smooth, simplify) in [(Some(0.3), None), (None, Some(9.0)), (Some(9.0), Some(9.0))] {
        let options = LineOptions { tolerance: 1e-3, smooth, simplify };
        let points = polylines(&domain, &lines, &options).remove(0);
        assert_eq!(points[0], points[points.len() - 1]);
        // It goes around the hole still.
        let area: f64 = points.windows(2).map(|pair| pair[0].0.cross(pair[1].0)).sum::<f64>() * 0.5;
        assert!(area.abs() > 9.0, "{area}");
    }
}

#[test]
fn an_island_is_passed_on_the_same_side() {
    // A corridor 8 wide with a square hole off its middle: the line goes around it, and the chord of all
    // would pass it on the other side.
    let corridor =
        "POLYGON ((0 0, 40 0, 40 8, 0 8, 0 0), (19 3.4, 19 4.2, 21 4.2, 21 3.4, 19 3.4))";
    let domain = shapes::wkt(corridor);
    let axis = path_tracing(&domain).unwrap();
    let lines = centerlines(&domain, &axis, &CenterlineOptions::default()).unwrap();
    let side = |points: &[(Point, f64)]| {
        let pair =
            points.windows(2).find(|pair| (pair[0].0.x - 20.0) * (pair[1].0.x - 20.0) <= 0.0);
        let [(a, _), (b, _)] = *pair.unwrap() else { unreachable!() };
        let share = (20.0 - a.x) / (b.x - a.x);
        (a.y + (b.y - a.y) * share > 3.8, points.len())
    };
    let exact = side(&lines[0].polyline(1e-3));
    for room in [0.1, 1.0, 9.0] {
        let options = LineOptions { tolerance: 1e-3, smooth: Some(room), simplify: Some(room) };
        let drawn = side(&polylines(&domain, &lines, &options)[0]);
        assert_eq!(drawn.0, exact.0, "{room}");
        assert!(drawn.1 < exact.1);
    }
}

#[test]
fn the_nearest_parameter_is_that_of_the_nearest_sample() {
    let random = &mut Random(604);
    for _ in 0..200 {
        let mut unit = || 4.0 * random.unit() - 2.0;
        let (focus, p) = (Point::new(unit(), 1.0 + unit().abs()), Point::new(unit(), unit()));
        let edge = medial::axis::Site::edge(Point::new(-9.0, 0.0), Point::new(9.0, 0.0));
        let corner = medial::axis::Site::vertex(focus);
        let end = |x: f64| {
            let y = ((x - focus.x).powi(2) / focus.y + focus.y) / 2.0;
            (Point::new(x, y), y)
        };
        let curve = Curve::new(&corner, &edge, end(unit()), end(unit()));
        let away = |u: f64| (curve.point_at(u) - p).norm();
        let least = (0..=1000).map(|k| away(f64::from(k) / 1000.0)).fold(f64::INFINITY, f64::min);
        let found = away(curve.nearest_parameter(p));
        assert!(found <= least + 1e-12 && found > least - 1e-2, "{found} {least}");
        assert_eq!(found, curve.distance(p));
    }
}
