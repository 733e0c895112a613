//! Parallel curves: closed forms, their topology, and every point on the right side.

mod support;

use std::f64::consts::PI;

use medial::axis::{Engine, MedialAxis, Side};
use medial::domain::{self, Domain};
use medial::engine::{Options, exterior, interior, path_tracing};
use medial::geom::Point;
use medial::ops::{Hierarchy, Measure, OffsetError, Outline, OutlinePiece, offset_margin, offsets};
use support::plane::distance;
use support::random::{self, Family, Ground, Random};
use support::shapes;

const RECTANGLE: &str = "POLYGON ((0 0, 6 0, 6 2, 0 2, 0 0))";

/// The exterior axis, cut off beyond the largest distance.
fn outside(domain: &Domain, most: f64) -> MedialAxis {
    let margin = offset_margin(domain, most);
    exterior(domain, Engine::PathTracing, Some(margin), &Options::default()).unwrap()
}

fn inward(domain: &Domain, distance: f64) -> Outline {
    let mut all = offsets(domain, &path_tracing(domain).unwrap(), &[distance]).unwrap();
    all.remove(0)
}

fn outward(domain: &Domain, distance: f64) -> Outline {
    let mut all = offsets(domain, &outside(domain, distance), &[distance]).unwrap();
    all.remove(0)
}

/// The numbers of contours of each polygon.
fn contours(outline: &Outline) -> Vec<usize> {
    outline.polygons.iter().map(|polygon| polygon.0.len()).collect()
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-12 * (a.abs() + b.abs() + 1.0)
}

#[test]
fn a_rectangle_shrinks_to_a_rectangle_and_grows_to_a_rounded_one() {
    let domain = shapes::wkt(RECTANGLE);
    let shrunk = inward(&domain, 0.5);
    let corner = |x, y| OutlinePiece::Corner(Point::new(x, y));
    let mut pieces = shrunk.polygons[0].0[0].0.clone();
    let first = pieces.iter().position(|piece| *piece == corner(0.5, 0.5)).unwrap();
    pieces.rotate_left(first);
    assert_eq!(pieces, [corner(0.5, 0.5), corner(5.5, 0.5), corner(5.5, 1.5), corner(0.5, 1.5)]);
    assert_eq!(shrunk.length(), 12.0);
    let grown = outward(&domain, 0.5);
    assert_eq!(contours(&grown), [1]);
    assert!(close(grown.area(), 12.0 + 0.5 * 16.0 + PI * 0.25), "{}", grown.area());
    assert!(close(grown.length(), 16.0 + PI), "{}", grown.length());
    // At half the width nothing is left, and at no distance everything.
    assert_eq!(inward(&domain, 1.0).polygons, []);
    assert_eq!(inward(&domain, 1.0_f64.next_down()).polygons.len(), 1);
    assert_eq!((inward(&domain, 0.0).area(), outward(&domain, 0.0).area()), (12.0, 12.0));
}

#[test]
fn arcs_run_around_reflex_corners() {
    // Two arms of length 2 and width 1.
    let l = shapes::wkt("POLYGON ((0 0, 2 0, 2 1, 1 1, 1 2, 0 2, 0 0))");
    let d = 0.25;
    let shrunk = inward(&l, d);
    // The strips along the sides overlap in the five convex corners, and a quarter disk is lost at
    // the reflex one.
    let by_hand = 3.0 - d * 8.0 + d * d * (5.0 - PI / 4.0);
    assert!(close(shrunk.area(), by_hand), "{} {by_hand}", shrunk.area());
    let grown = outward(&l, d);
    // The other way round outside.
    let by_hand = 3.0 + d * 8.0 + d * d * (5.0 * PI / 4.0 - 1.0);
    assert!(close(grown.area(), by_hand), "{} {by_hand}", grown.area());
}

#[test]
fn a_ring_has_a_hole_until_it_is_eaten_or_filled() {
    let domain = shapes::wkt("POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (3 3, 3 6, 6 6, 6 3, 3 3))");
    let shrunk = inward(&domain, 1.0);
    assert_eq!(contours(&shrunk), [2]);
    assert!(close(shrunk.area(), 49.0 - 9.0 - 12.0 - PI), "{}", shrunk.area());
    // Only the corners are farther than half the width of the walls from both rings.
    assert_eq!(contours(&inward(&domain, 1.6)), [1; 4]);
    assert_eq!(contours(&inward(&domain, 1.5)), [1; 4]);
    let grown = outward(&domain, 1.0);
    assert_eq!(contours(&grown), [2]);
    assert!(close(grown.area(), 81.0 + 36.0 + PI - 1.0), "{}", grown.area());
    assert_eq!(contours(&outward(&domain, 1.5)), [1]);
    assert_eq!(contours(&outward(&domain, 1.5_f64.next_down())), [2]);
}

#[test]
fn a_neck_is_cut_at_exactly_its_width() {
    // Two squares of side 4, joined by a passage between two corners that are 2 apart.
    let dumbbell =
        shapes::wkt("POLYGON ((0 0, 4 0, 5 1, 6 0, 10 0, 10 4, 6 4, 5 3, 4 4, 0 4, 0 0))");
    assert_eq!(contours(&inward(&dumbbell, 1.0_f64.next_down())), [1]);
    assert_eq!(contours(&inward(&dumbbell, 1.0)), [1, 1]);
    // Between the corners outside, 2 apart as well.
    let bay = shapes::wkt("POLYGON ((0 0, 9 0, 9 4, 5 4, 4 3, 7 3, 7 1, 2 1, 2 3, 3 4, 0 4, 0 0))");
    let gap: f64 = (Point::new(4.0, 3.0) - Point::new(3.0, 4.0)).norm() / 2.0;
    assert_eq!(contours(&outward(&bay, gap * 0.999)), [1]);
    assert_eq!(contours(&outward(&bay, gap * 1.001)), [2]);
}

#[test]
fn polygons_grow_together_where_they_meet() {
    let two = shapes::wkt(
        "MULTIPOLYGON (((0 0, 2 0, 2 2, 0 2, 0 0)), ((4 0, 6 0, 6 2, 4 2, 4 0)), ((0 9, 1 9, 0 10, 0 9)))",
    );
    assert_eq!(contours(&outward(&two, 1.0_f64.next_down())), [1, 1, 1]);
    assert_eq!(contours(&outward(&two, 1.0)), [1, 1]);
    assert_eq!(contours(&outward(&two, 3.0)), [1, 1]);
    assert_eq!(contours(&outward(&two, 4.0)), [1]);
    // One in the hole of another.
    let nested = shapes::wkt(
        "MULTIPOLYGON (((0 0, 9 0, 9 9, 0 9, 0 0), (1 1, 1 8, 8 8, 8 1, 1 1)), ((4 4, 5 4, 5 5, 4 5, 4 4)))",
    );
    assert_eq!(contours(&outward(&nested, 1.0)), [2, 1]);
    assert_eq!(contours(&outward(&nested, 1.5)), [5]);
    assert_eq!(contours(&outward(&nested, 3.0)), [1]);
    // The neck of a pocket lies on the only path to infinity.
    let pocket = shapes::wkt(
        "MULTIPOLYGON (((2 3, 3 2, 3 3, 2 3)), ((3 1, 2 0, 3 0, 3 1)), ((2 0, 2 2, 1 1, 0 1, 1 0, 2 0)), \
         ((1 3, 0 2, 0 1, 1 2, 1 3)), ((2 2, 2 3, 1 3, 2 2)))",
    );
    assert_eq!(contours(&outward(&pocket, 0.5_f64.next_down())), [1]);
    assert_eq!(contours(&outward(&pocket, 0.5)), [2]);
    // The edge beside a small neighbour is nearest on both of its sides.
    let beside = shapes::wkt("MULTIPOLYGON (((0 0, 9 0, 9 -4, 0 0)), ((4 2, 5 2, 5 3, 4 2)))");
    assert_eq!(contours(&outward(&beside, 0.5)), [1, 1]);
    assert_eq!(contours(&outward(&beside, 1.5)), [1]);
    // Touching at a corner they are one at any distance.
    let touching =
        shapes::wkt("MULTIPOLYGON (((0 0, 2 0, 2 2, 0 2, 0 0)), ((2 2, 4 2, 4 4, 2 4, 2 2)))");
    assert_eq!(contours(&outward(&touching, 1e-9)), [1]);
}

#[test]
fn what_cannot_be_done_is_told() {
    let domain = shapes::wkt(RECTANGLE);
    let axis = path_tracing(&domain).unwrap();
    for distance in [-1.0, f64::NAN, f64::INFINITY, 1e-80] {
        let error = offsets(&domain, &axis, &[0.5, distance]).unwrap_err();
        assert!(matches!(error, OffsetError::Distance { .. }), "{error}");
    }
    let pruned = Hierarchy::new(&domain, &axis).unwrap().pruned(Measure::Excess, 0.5).axis;
    let error = offsets(&domain, &pruned, &[0.5]).unwrap_err();
    assert!(matches!(error, OffsetError::Axis(_)), "{error}");
    let bay = shapes::wkt("POLYGON ((0 0, 9 0, 9 4, 8 4, 8 1, 1 1, 1 4, 0 4, 0 0))");
    let near = exterior(&bay, Engine::PathTracing, Some(1.0), &Options::default()).unwrap();
    assert!(offsets(&bay, &near, &[1.0]).is_ok());
    let error = offsets(&bay, &near, &[9.0]).unwrap_err();
    assert!(matches!(error, OffsetError::Frame { .. }), "{error}");
}

/// How often rings wind around a point.
fn winding<'a>(rings: impl Iterator<Item = &'a Vec<Point>>, p: Point) -> i32 {
    let turns = |ring: &Vec<Point>| -> i32 {
        let next = ring.iter().cycle().skip(1);
        let crossed = ring.iter().zip(next).map(|(a, b)| {
            let is_left = (*b - *a).cross(p - *a) > 0.0;
            match (a.y <= p.y, b.y <= p.y) {
                (true, false) if is_left => 1,
                (false, true) if !is_left => -1,
                _ => 0,
            }
        });
        crossed.sum()
    };
    rings.map(turns).sum()
}

/// Every random point must lie on the right side, and the number of holes be that of the plane.
fn judge(domain: &Domain, axis: &MedialAxis, distances: &[f64], random: &mut Random) {
    let (mut low, mut high) =
        (Point::new(f64::INFINITY, f64::INFINITY), Point::new(-f64::INFINITY, -f64::INFINITY));
    for edge in domain.edges() {
        low = Point::new(low.x.min(edge.start.x), low.y.min(edge.start.y));
        high = Point::new(high.x.max(edge.start.x), high.y.max(edge.start.y));
    }
    let size = (high - low).norm();
    let boundary: Vec<Vec<Point>> = domain
        .walks()
        .iter()
        .map(|walk| walk.edges().map(|k| domain.edge(k).start).collect())
        .collect();
    let all = offsets(domain, axis, distances).unwrap_or_else(|e| {
        panic!("{e}: {:?} {}", axis.side, shapes::to_wkt(&vec![boundary.clone()]))
    });
    for (&d, outline) in distances.iter().zip(&all) {
        let tolerance = 1e-4 * size;
        let polygons = outline.polygons(tolerance);
        for _ in 0..60 {
            let at = |low: f64, high: f64, unit: f64| low - 1.1 * d + (high - low + 2.2 * d) * unit;
            let p = Point::new(at(low.x, high.x, random.unit()), at(low.y, high.y, random.unit()));
            let away = distance(domain, p);
            if (away - d).abs() < 1.5 * tolerance {
                continue;
            }
            let is_inside = winding(boundary.iter(), p) == 1;
            let expected = if axis.side == Side::Interior {
                is_inside && away > d
            } else {
                is_inside || away < d
            };
            let found = winding(polygons.iter().flatten(), p);
            assert_eq!(
                found,
                i32::from(expected),
                "{p:?} at {d} of {}",
                shapes::to_wkt(&vec![boundary.clone()])
            );
        }
        for polygon in &outline.polygons {
            let areas: Vec<f64> = polygon.0.iter().map(|contour| contour.area()).collect();
            assert!(
                areas[0] >= 0.0,
                "{areas:?} {d} {:?} {}",
                axis.side,
                shapes::to_wkt(&vec![boundary.clone()])
            );
            assert!(areas[1..].iter().all(|&area| area <= 1e-9 * size * size), "{areas:?}");
        }
    }
}

#[test]
fn random_points_lie_on_the_right_side() {
    let mut random = Random(77);
    let options = domain::Options { regroup: true, ..domain::Options::default() };
    let mut tried = 0;
    for family in [Family::Tangle, Family::Holes, Family::Hung, Family::Triangles, Family::Squares]
    {
        for ground in [Ground::Grid(12), Ground::Square] {
            for _ in 0..60 {
                let polygons = random::shape(&mut random, family, ground);
                let Ok(domain) = Domain::from_polygons(&polygons, &options) else { continue };
                tried += 1;
                let axis = interior(&domain, Engine::PathTracing, &Options::default()).unwrap();
                let most = axis.keypoints().iter().map(|k| k.radius).fold(0.0, f64::max);
                let distances = [0.1, 0.3, 0.5, 0.8].map(|share| share * most);
                judge(&domain, &axis, &distances, &mut random);
                // Radii that keypoints have, exactly or nearly.
                let known: Vec<f64> = (0..3)
                    .map(|_| {
                        axis.keypoints()
                            .at(random.below(axis.keypoints().len() as u64) as u32)
                            .radius
                    })
                    .filter(|&radius| radius > 1e-50)
                    .collect();
                judge(&domain, &axis, &known, &mut random);
                judge(
                    &domain,
                    &outside(&domain, 3.0 * most),
                    &distances.map(|d| 3.0 * d),
                    &mut random,
                );
            }
        }
    }
    assert!(tried > 300, "{tried}");
}

#[test]
fn the_area_changes_by_the_length() {
    let mut random = Random(5);
    let mut tried = 0;
    while tried < 100 {
        let polygons = random::large_shape(&mut random, Family::Tangle, Ground::Square, 60);
        let Ok(domain) = shapes::of(&polygons) else { continue };
        tried += 1;
        let axis = path_tracing(&domain).unwrap();
        let most = axis.keypoints().iter().map(|k| k.radius).fold(0.0, f64::max);
        for (axis, sign) in [(&axis, -1.0), (&outside(&domain, 2.0 * most), 1.0)] {
            let d = random.unit() * most;
            // By Simpson's rule over a step in which hardly anything happens.
            let step = 1e-3 * most;
            let at = [d, d + 0.5 * step, d + step];
            let outlines = offsets(&domain, axis, &at).unwrap();
            let [low, middle, high] = [0, 1, 2].map(|k| outlines[k].length());
            let integral = sign * step * (low + 4.0 * middle + high) / 6.0;
            let grown = outlines[2].area() - outlines[0].area();
            let scale = step * (low + high);
            assert!((grown - integral).abs() <= 1e-2 * scale, "{grown} {integral} at {d}");
            if outlines.iter().all(|o| pieces(o) == pieces(&outlines[0])) {
                // What is left is the rule: where arcs end, lengths change like a square root.
                assert!((grown - integral).abs() <= 1e-5 * scale, "{grown} {integral} at {d}");
            }
        }
    }
}

/// How many pieces the contours of an outline have.
fn pieces(outline: &Outline) -> usize {
    outline.polygons.iter().flat_map(|polygon| &polygon.0).map(|contour| contour.0.len()).sum()
}
