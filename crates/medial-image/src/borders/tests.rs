use super::simplifier::squared_distance;
use super::*;
use crate::field::Field;
use crate::labels::Labels;
use crate::selection::{Action, Click, Selection};
use medial::domain::{Corner as Turn, Domain, Edge, Options};
use medial::geom::Point;
use medial::raster::outline;
use std::collections::{BTreeMap, BTreeSet};

/// All regions of an image of numbers.
fn objects(columns: u32, class: &[u32]) -> Objects {
    let grid = Grid::of_image(columns, class.len() as u32 / columns);
    let labels = Labels::connected(grid, class, |_, _| true);
    let field = Field::new(grid, class.iter().map(|_| [0.0; 3])).unwrap();
    let chosen = Selection::of(0..labels.len());
    Objects::new(&labels, &labels.regions(&field), &chosen)
}

/// The area of a ring that runs with the shape on its left.
fn area(ring: &[Point]) -> f64 {
    let pairs = ring.iter().zip(ring.iter().cycle().skip(1));
    0.5 * pairs.map(|(a, b)| a.cross(*b)).sum::<f64>()
}

fn sides(ring: &[Point]) -> impl Iterator<Item = (Point, Point)> + '_ {
    ring.iter().copied().zip(ring.iter().copied().cycle().skip(1))
}

fn distance(p: Point, rings: &[Vec<Point>]) -> f64 {
    let squares = rings.iter().flat_map(|ring| sides(ring));
    let squares = squares.map(|(a, b)| squared_distance([p.x, p.y], [a.x, a.y], [b.x, b.y]));
    squares.fold(f64::INFINITY, f64::min).sqrt()
}

/// Spots of noise in all sizes.
fn noise(columns: u32, rows: u32) -> Vec<u32> {
    let wave = |x: f64, y: f64| (0.9 * x).sin() + (0.7 * y + 0.3 * x).sin() + (0.21 * y).cos();
    let at = |k: u32| (f64::from(k % columns), f64::from(k / columns));
    let value = |(x, y): (f64, f64)| wave(x, y) + 1.5 * wave(0.13 * x + 1.0, 0.17 * y);
    (0..columns * rows).map(|k| (value(at(k)) + 9.0).floor() as u32).collect()
}

/// Fails unless each side of polygons is run through once each way, or lies on the frame of their image.
fn assert_shared(polygons: &[Polygons], columns: u32, rows: u32) {
    let mut ways: BTreeSet<[[u64; 2]; 2]> = BTreeSet::new();
    for (a, b) in polygons.iter().flatten().flatten().flat_map(|ring| sides(ring)) {
        let way = [a, b].map(|p| [p.x.to_bits(), p.y.to_bits()]);
        assert!(ways.insert(way), "{a:?} {b:?}");
    }
    let is_frame = |[[a, c], [b, d]]: [[u64; 2]; 2]| {
        let [a, b, c, d] = [a, b, c, d].map(f64::from_bits);
        (a == b && (a == 0.0 || a == f64::from(columns)))
            || (c == d && (c == 0.0 || c == -f64::from(rows)))
    };
    assert!(ways.iter().all(|&[a, b]| ways.contains(&[b, a]) || is_frame([a, b])));
}

#[test]
fn steps_become_a_slope() {
    // A triangle of pixels in the corner of the image.
    let class: Vec<u32> = (0..64).map(|k| u32::from(k % 8 + k / 8 < 7)).collect();
    let objects = objects(8, &class);
    let [exact, simple] = [0.0, 0.8].map(|d| objects.polygons_between(0, &objects.borders(d)));
    assert_eq!(exact[0][0].len(), 2 * 7 + 2 - 1 + 1);
    // The corner of the image, both ends of the slope on its frame, and at most one between.
    assert!((3..=4).contains(&simple[0][0].len()), "{simple:?}");
    let other = objects.polygons_between(1, &objects.borders(0.8));
    let both: f64 = [&simple, &other].iter().map(|p| area(&p[0][0])).sum();
    assert_eq!(both.abs(), 64.0);
}

#[test]
fn a_pixel_stays_a_polygon_whatever_the_tolerance() {
    let mut class = vec![0; 25];
    class[12] = 1;
    let objects = objects(5, &class);
    let borders = objects.borders(100.0);
    let [ground, spot] = [0, 1].map(|k| objects.polygons_between(k, &borders));
    assert_eq!((ground[0].len(), ground[0][0].len()), (2, 4));
    assert_eq!((ground[0][1].len(), spot[0][0].len()), (3, 3));
}

#[test]
fn an_island_in_a_bay_stays_outside() {
    // A bay two pixels deep with an island in it, which a straight border would take in.
    let rows = ["#########", "#.......#", "#..###..#", "#.......#", "#########", "#########"];
    let class: Vec<u32> = rows.iter().flat_map(|row| row.bytes()).map(u32::from).collect();
    let objects = objects(9, &class);
    let borders = objects.borders(50.0);
    let polygons: Vec<_> = (0..3).map(|k| objects.polygons_between(k, &borders)).collect();
    let areas: Vec<f64> =
        polygons.iter().map(|p| p.iter().flatten().map(|ring| area(ring)).sum()).collect();
    assert!(areas.iter().all(|&area| area > 0.0), "{areas:?}");
    assert_eq!(areas.iter().sum::<f64>(), 54.0);
}

#[test]
fn simplified_borders_fit_one_another_and_keep_their_distance() {
    let (columns, rows) = (70, 50);
    let class = noise(columns, rows);
    let objects = objects(columns, &class);
    assert!(objects.all().len() > 60);
    let n_corners = |polygons: &Polygons| polygons.iter().flatten().map(Vec::len).sum::<usize>();
    let mut before = usize::MAX;
    for tolerance in [0.0, 0.75, 1.5, 4.0] {
        let borders = objects.borders(tolerance);
        let mut total = 0.0;
        let mut n = 0;
        let mut all = Vec::new();
        for object in 0..objects.all().len() as u32 {
            let polygons = objects.polygons_between(object, &borders);
            let exact = objects.polygons(object);
            n += n_corners(&polygons);
            let shape = |polygons: &Polygons| polygons.iter().map(Vec::len).collect::<Vec<_>>();
            assert_eq!(shape(&polygons), shape(&exact), "the same rings");
            for (rings, exact) in polygons.iter().zip(&exact) {
                for (ring, exact) in rings.iter().zip(exact) {
                    assert_eq!(area(ring) > 0.0, area(exact) > 0.0);
                    total += area(ring);
                }
                let is_near = |p: &Point, rings| distance(*p, rings) <= tolerance + 1e-9;
                assert!(exact.iter().flatten().all(|p| is_near(p, rings)));
                let middles = rings.iter().flat_map(|ring| sides(ring));
                let middles = middles.map(|(a, b)| (a + b) * 0.5);
                assert!(middles.into_iter().all(|p| is_near(&p, exact)));
            }
            all.push(polygons);
        }
        assert_eq!(total, f64::from(columns * rows), "they fill the image");
        assert_shared(&all, columns, rows);
        assert!(n < before, "{n} corners at {tolerance}");
        before = n;
    }
}

#[test]
fn without_tolerance_the_outline_gains_only_corners_of_others() {
    let objects = objects(3, &[0, 0, 0, 1, 1, 2]);
    let exact = objects.polygons_between(0, &objects.borders(0.0));
    let mask = objects.mask(0).unwrap();
    let corners = &outline(&mask)[0][0];
    assert_eq!(exact[0][0].len(), corners.len() + 1);
    assert!(exact[0][0].contains(&Point::new(2.0, -1.0)));
}

#[test]
fn smoothed_borders_are_shared_and_cross_nothing() {
    let (columns, rows) = (70, 50);
    // Spots of all sizes, and squares of a pixel that meet at corners.
    let checkers = (0..columns * rows).map(|k| (k % columns + k / columns) % 2).collect();
    for class in [noise(columns, rows), checkers] {
        let objects = objects(columns, &class);
        for width in [0.4, 1.0, 3.0, 20.0] {
            let borders = objects.smooth_borders(width);
            let n = objects.all().len() as u32;
            let all: Vec<_> = (0..n).map(|k| objects.polygons_between(k, &borders)).collect();
            assert_shared(&all, columns, rows);
            let total: f64 = all.iter().flatten().flatten().map(|ring| area(ring)).sum();
            assert!((total - f64::from(columns * rows)).abs() < 1e-9, "they fill the image");
            for (object, polygons) in (0..).zip(&all) {
                let options = Options { repair: false, ..Options::default() };
                let domain = Domain::from_polygons(polygons, &options);
                assert!(domain.is_ok(), "{width}: {object}: {domain:?}");
                let exact = objects.polygons(object);
                for (rings, exact) in polygons.iter().zip(&exact) {
                    assert_eq!(rings.len(), exact.len(), "the same rings");
                    // Half a diagonal off a corner, and a move.
                    let off = rings.iter().flatten().map(|p| distance(*p, exact));
                    assert!(off.fold(0.0, f64::max) < 0.36);
                }
            }
        }
    }
}

#[test]
fn smoothing_makes_a_slope_of_steps_and_leaves_what_is_straight() {
    // A slope of two to one from frame to frame, and to its right a border along a column.
    let (columns, rows) = (40, 30);
    let class = |k: u32| match (k % columns, k / columns) {
        (x, y) if x < 4 + y / 2 => 0,
        (x, _) if x < 30 => 1,
        _ => 2,
    };
    let class: Vec<u32> = (0..columns * rows).map(class).collect();
    let objects = objects(columns, &class);
    let off = |borders: &Borders| {
        let slope = objects.polygons_between(0, borders);
        let inner = slope[0][0].iter().filter(|p| p.x > 5.0 && (-25.0..-5.0).contains(&p.y));
        // The line through the middles of the steps.
        let off = inner.map(|p| ((p.x - 3.5) * 2.0 + p.y).abs() / 5.0_f64.sqrt());
        off.fold(0.0, f64::max)
    };
    let [stepped, smooth] = [objects.borders(0.0), objects.smooth_borders(2.0)].map(|b| off(&b));
    assert!(stepped > 0.4 && smooth < 0.05, "{stepped} {smooth}");
    let borders = objects.smooth_borders(2.0);
    let [between, right] = [1, 2].map(|k| objects.polygons_between(k, &borders));
    assert!(right[0][0].iter().all(|p| p.x == 30.0 || p.x == 40.0 || p.y == 0.0 || p.y == -30.0));
    // Where borders meet on the frame they stay.
    for corner in [Point::new(4.0, 0.0), Point::new(30.0, 0.0), Point::new(30.0, -30.0)] {
        assert!(between[0][0].contains(&corner), "{corner:?}");
    }
}

#[test]
fn an_object_goes_on_through_corners_between_angles_less_than_half_a_turn() {
    let (columns, rows) = (60, 40);
    let mut n_corners = 0;
    for seed in 0..4_u32 {
        let spots = |k: u32| (k ^ seed).wrapping_mul(0x9e37_79b9).rotate_left(k % 7) >> 30 > 1;
        let class: Vec<u32> = (0..columns * rows).map(|k| u32::from(spots(k))).collect();
        let grid = Grid::of_image(columns, rows);
        let labels = Labels::connected(grid, &class, |_, _| true);
        let field = Field::new(grid, class.iter().map(|_| [0.0; 3])).unwrap();
        // All spots are one object.
        let mut chosen = Selection::of([]);
        for k in (0..columns * rows).filter(|&k| class[k as usize] == 1) {
            let at = grid.place(f64::from(k % columns) + 0.5, f64::from(k / columns) + 0.5);
            let click = Click { action: Action::Combine, at };
            let click = if chosen.objects().is_empty() {
                Click { action: Action::Add, ..click }
            } else {
                click
            };
            // What is chosen already is told.
            let _ = chosen.click(&labels, click);
        }
        let objects = Objects::new(&labels, &labels.regions(&field), &chosen);
        assert_eq!(objects.all().len(), 1);
        for tolerance in [0.75, 1.5, 9.0] {
            let polygons = objects.polygons_between(0, &objects.borders(tolerance));
            // The interior lies to the left of walks, also where an outer ring and its hole meet.
            let domain = Domain::from_polygons(&polygons, &Options::default()).unwrap();
            let place = |edge: &Edge| (edge.start.x as i32, edge.start.y as i32);
            let mut times: BTreeMap<(i32, i32), u32> = BTreeMap::new();
            domain.edges().iter().for_each(|edge| *times.entry(place(edge)).or_default() += 1);
            for edge in domain.edges().iter().filter(|edge| times[&place(edge)] > 1) {
                n_corners += 1;
                assert_eq!(edge.corner, Turn::Convex, "{tolerance}: {edge:?}");
            }
        }
    }
    assert!(n_corners > 1000, "{n_corners}");
}
