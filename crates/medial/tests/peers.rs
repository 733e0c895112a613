//! Where peers fail: one unit off axis-parallel, slivers, far coordinates, hidden holes.

mod support;

use medial::axis::KeypointKind;
use medial::check;
use medial::domain::Domain;
use medial::engine::path_tracing;
use medial::geom::Point;
use support::random::Random;
use support::shapes::{self, Polygons};

fn certify(domain: &Domain) -> Result<(), String> {
    let axis = path_tracing(domain).map_err(|e| e.to_string())?;
    match check::defects(domain, &axis).defects.first() {
        None => Ok(()),
        Some(defect) => Err(defect.to_string()),
    }
}

#[test]
fn six_corners_at_ten_million_have_their_two_junctions() {
    // Boost.Polygon's issue 43: an edge is lost there.
    let domain = shapes::wkt(
        "POLYGON ((0 10000000, 700000 1, 700000 9000000, 9100000 9000000, 9100000 0, \
         10000000 10000000, 0 10000000))",
    );
    let axis = path_tracing(&domain).unwrap();
    let junctions: Vec<(f64, f64)> = axis
        .keypoints()
        .iter()
        .filter(|k| k.kind == KeypointKind::Junction)
        .map(|k| ((k.position.x * 10.0).round() / 10.0, (k.position.y * 10.0).round() / 10.0))
        .collect();
    assert!(junctions.contains(&(548_526.7, 9_488_527.9)), "{junctions:?}");
    assert!(junctions.contains(&(9_402_818.0, 9_454_150.6)), "{junctions:?}");
    assert_eq!(certify(&domain), Ok(()));
}

#[test]
fn polygons_that_boost_gets_wrong_are_certified() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/boost_failures.wkt");
    let text = std::fs::read_to_string(path).unwrap();
    let mut count = 0;
    for line in text.lines() {
        assert_eq!(certify(&shapes::wkt(line)), Ok(()), "{line}");
        count += 1;
    }
    assert_eq!(count, 5);
}

#[test]
fn a_sliver_of_two_metres_by_a_third_of_a_nanometre_has_a_plateau() {
    for (x, y) in [(0.0, 0.0), (150_000.0, 480_000.0)] {
        // The thinnest box there that doubles can hold, at least 3e-10 high.
        let top = f64::max(y + 3e-10, y.next_up());
        let domain = shapes::of(&[vec![vec![
            Point::new(x, y),
            Point::new(x + 2.0, y),
            Point::new(x + 2.0, top),
            Point::new(x, top),
        ]]])
        .unwrap();
        let axis = path_tracing(&domain).unwrap();
        assert_eq!((axis.keypoints().len(), axis.paths().len()), (6, 5));
        assert_eq!(certify(&domain), Ok(()));
    }
}

/// The outlines of a random set of cells, some 4 to 40 corners, scaled by a million, each
/// coordinate moved by at most one.
fn one_unit_off(random: &mut Random) -> Polygons {
    const SIZE: usize = 6;
    let mut filled = [[false; SIZE + 2]; SIZE + 2];
    let (mut x, mut y) = (1 + random.below(6) as usize, 1 + random.below(6) as usize);
    for _ in 0..3 + random.below(16) {
        filled[x][y] = true;
        match random.below(4) {
            0 if x > 1 => x -= 1,
            1 if x < SIZE => x += 1,
            2 if y > 1 => y -= 1,
            3 if y < SIZE => y += 1,
            _ => {}
        }
    }
    // Directed unit steps with the cells on their left.
    let mut steps: Vec<((usize, usize), (usize, usize))> = Vec::new();
    for x in 1..=SIZE {
        for y in 1..=SIZE {
            if !filled[x][y] {
                continue;
            }
            let corner = |dx: usize, dy: usize| (x + dx, y + dy);
            for (empty, a, b) in [
                (!filled[x][y - 1], corner(0, 0), corner(1, 0)),
                (!filled[x + 1][y], corner(1, 0), corner(1, 1)),
                (!filled[x][y + 1], corner(1, 1), corner(0, 1)),
                (!filled[x - 1][y], corner(0, 1), corner(0, 0)),
            ] {
                if empty {
                    steps.push((a, b));
                }
            }
        }
    }
    let mut rings: Vec<Vec<(usize, usize)>> = Vec::new();
    while let Some((first, mut at)) = steps.pop() {
        let mut ring = vec![first];
        while at != first {
            ring.push(at);
            // Where two cells meet at a corner, turn left, so that the ring stays simple.
            let from = ring[ring.len() - 2];
            let turn = |to: (usize, usize)| {
                let d = |p: (usize, usize), q: (usize, usize)| {
                    (q.0 as i64 - p.0 as i64, q.1 as i64 - p.1 as i64)
                };
                let (u, v) = (d(from, at), d(at, to));
                u.0 * v.1 - u.1 * v.0
            };
            let next = (0..steps.len())
                .filter(|&k| steps[k].0 == at)
                .max_by_key(|&k| turn(steps[k].1))
                .unwrap();
            at = steps.swap_remove(next).1;
        }
        let n = ring.len();
        let corners = (0..n).filter(|&k| {
            let (a, b, c) = (ring[(k + n - 1) % n], ring[k], ring[(k + 1) % n]);
            (a.0 == b.0) != (b.0 == c.0)
        });
        rings.push(corners.map(|k| ring[k]).collect());
    }
    // The ring with the lowest corner is the outer one.
    rings.sort_by_key(|r| r.iter().min().copied());
    let mut jitter = |v: usize| v as f64 * 1e6 + random.below(3) as f64 - 1.0;
    let rings =
        rings.iter().map(|r| r.iter().map(|&(x, y)| Point::new(jitter(x), jitter(y))).collect());
    vec![rings.collect()]
}

fn rectilinear(seed: u64, count: usize) {
    let mut random = Random(seed);
    let mut failures = Vec::new();
    let mut tried = 0;
    while tried < count {
        let polygons = one_unit_off(&mut random);
        // Where two cells meet at a corner only, the unit off may make their outlines cross.
        let Ok(domain) = shapes::of(&polygons) else { continue };
        tried += 1;
        if let Err(why) = certify(&domain) {
            failures.push(format!("{}: {why}", shapes::to_wkt(&polygons)));
        }
    }
    assert!(failures.is_empty(), "{} of {count}: {}", failures.len(), failures[0]);
}

// 100,000 in all, in two tests that run side by side.
#[test]
fn rectilinear_polygons_one_unit_off_are_certified() {
    rectilinear(43, 50_000);
}

#[test]
fn more_rectilinear_polygons_one_unit_off_are_certified() {
    rectilinear(44, 50_000);
}

#[test]
fn no_hole_hides_between_two_empty_disks() {
    // A path shrinks into a corner, and a small hole lies in the pocket beside it.
    let mut random = Random(7);
    for trial in 0..1000 {
        let angle = 0.2 + 2.0 * random.unit();
        let (sine, cosine) = angle.sin_cos();
        let outer = vec![
            Point::new(0.0, 0.0),
            Point::new(10.0, 0.0),
            Point::new(10.0 * cosine, 10.0 * sine),
        ];
        // On the bisector or beside it, at most a tenth of the width there.
        let half = angle / 2.0;
        let way = 10.0 * half.cos() * (0.1 + 0.5 * random.unit());
        let aside = (random.unit() - 0.5) * half;
        let (s, c) = (half + aside).sin_cos();
        let centre = Point::new(way * c, way * s);
        let size = way * half.sin() * 10f64.powf(-1.0 - 4.0 * random.unit());
        let turn = 6.3 * random.unit();
        let n = 3 + random.below(3);
        let hole = (0..n)
            .map(|k| {
                let (s, c) = (turn - k as f64 * std::f64::consts::TAU / n as f64).sin_cos();
                centre + Point::new(c, s) * size
            })
            .collect();
        let domain = shapes::of(&[vec![outer, hole]]).unwrap();
        let axis = path_tracing(&domain).unwrap();
        assert_eq!(axis.paths().len(), axis.keypoints().len(), "one cycle, trial {trial}");
        assert_eq!(certify(&domain), Ok(()), "trial {trial}");
    }
}

#[test]
fn two_holes_in_one_pocket_are_both_found() {
    // A wedge of 60 degrees with small holes at 10 and at 2 on its bisector: each candidate disk
    // is clear of the other hole.
    let domain = shapes::wkt(
        "POLYGON ((0 0, 20 -11.547005383792516, 20 11.547005383792516, 0 0), \
         (10 -0.001, 10 0.001, 10.001 0), (2 -0.001, 2 0.001, 2.001 0))",
    );
    let axis = path_tracing(&domain).unwrap();
    assert_eq!(axis.paths().len(), axis.keypoints().len() + 1, "two cycles");
    assert_eq!(certify(&domain), Ok(()));
}

#[test]
fn islands_in_a_channel_are_not_passed_over_where_what_lies_beyond_is_known() {
    // Three channels along two long holes, and islands in them: between two of its keypoints that wait
    // for a path there may be islands that nothing has met yet.
    let mut random = Random(11);
    for trial in 0..200 {
        let rectangle = |x0: f64, y0: f64, x1: f64, y1: f64| {
            vec![Point::new(x0, y0), Point::new(x1, y0), Point::new(x1, y1), Point::new(x0, y1)]
        };
        let mut polygon = vec![rectangle(0.0, 0.0, 60.0, 21.0)];
        for y in [3.0, 12.0] {
            let mut hole = rectangle(3.0, y, 57.0, y + 6.0);
            hole.reverse();
            polygon.push(hole);
        }
        for channel in 0..3 {
            let mut x = 4.0;
            while x < 56.0 {
                let size = 10f64.powf(-1.0 - 3.0 * random.unit());
                let y = 0.3 + f64::from(channel) * 9.0 + 2.4 * random.unit();
                let corner = |k: u32| {
                    Point::new(x + [0.0, 0.0, size][k as usize], y + [0.0, size, 0.0][k as usize])
                };
                polygon.push((0..3).map(corner).collect());
                x += 0.2 + 12.0 * random.unit() * random.unit();
            }
        }
        let holes = polygon.len() - 1;
        let domain = shapes::of(&[polygon]).unwrap();
        let axis = path_tracing(&domain).unwrap();
        assert_eq!(axis.paths().len(), axis.keypoints().len() - 1 + holes, "trial {trial}");
        assert_eq!(certify(&domain), Ok(()), "trial {trial}");
    }
}
