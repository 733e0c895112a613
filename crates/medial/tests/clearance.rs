//! Necks and largest disks: by hand, and against a search over all pairs of elements.

mod support;

use medial::axis::{Engine, MedialAxis, Side};
use medial::domain::{self, Corner, Domain};
use medial::engine::{Options, exterior, path_tracing};
use medial::geom::Point;
use medial::ops::{Neck, Plateau, largest_disks, necks};
use support::plane::{distance, is_inside};
use support::random::{self, Family, Ground, Random};
use support::shapes;

fn inside(domain: &Domain) -> Vec<Neck> {
    necks(domain, &path_tracing(domain).unwrap(), None).unwrap()
}

fn outside(domain: &Domain) -> Vec<Neck> {
    let axis = exterior(domain, Engine::PathTracing, None, &Options::default()).unwrap();
    necks(domain, &axis, None).unwrap()
}

/// Widths with lengths.
fn sizes(necks: &[Neck]) -> Vec<(f64, f64)> {
    necks.iter().map(|neck| (neck.width, neck.length)).collect()
}

#[test]
fn a_convex_shape_has_no_neck_and_a_square_one_largest_disk() {
    let square = shapes::wkt("POLYGON ((0 0, 2 0, 2 2, 0 2, 0 0))");
    assert_eq!(inside(&square), []);
    let axis = path_tracing(&square).unwrap();
    let largest = largest_disks(&square, &axis).unwrap();
    assert_eq!(largest.len(), 1);
    assert_eq!((largest[0].radius, largest[0].middle), (1.0, Point::new(1.0, 1.0)));
    assert_eq!(
        (largest[0].keypoints.len(), largest[0].paths.len(), largest[0].length),
        (1, 0, 0.0)
    );
}

#[test]
fn the_neck_between_two_corners_lies_halfway() {
    let dumbbell =
        shapes::wkt("POLYGON ((0 0, 4 0, 5 1, 6 0, 10 0, 10 4, 6 4, 5 3, 4 4, 0 4, 0 0))");
    let found = inside(&dumbbell);
    assert_eq!(sizes(&found), [(2.0, 0.0)]);
    assert_eq!(found[0].middle, Point::new(5.0, 2.0));
    let mut feet = found[0].footpoints;
    feet.sort_by(|p, q| p.lexicographic(*q));
    assert_eq!(feet, [Point::new(5.0, 1.0), Point::new(5.0, 3.0)]);
    let axis = path_tracing(&dumbbell).unwrap();
    let below = |limit: f64| necks(&dumbbell, &axis, Some(limit)).unwrap().len();
    assert_eq!((below(2.0), below(2.0_f64.next_up())), (0, 1));
    // In both rooms the largest disk may move a little towards the neck.
    let largest = largest_disks(&dumbbell, &axis).unwrap();
    assert_eq!(largest.len(), 2);
    let is_passage = |plateau: &Plateau| (plateau.keypoints.len(), plateau.paths.len()) == (2, 1);
    assert!(largest.iter().all(|plateau| plateau.radius == 2.0 && is_passage(plateau)));
}

/// Radius, length and middle of each place of largest disks.
fn largest(wkt: &str) -> Vec<(f64, f64, Point)> {
    let domain = shapes::wkt(wkt);
    let axis = path_tracing(&domain).unwrap();
    let found = largest_disks(&domain, &axis).unwrap().into_iter();
    let mut found: Vec<_> = found.map(|p| (p.radius, p.length, p.middle)).collect();
    found.sort_by(|one, other| one.2.lexicographic(other.2));
    found
}

#[test]
fn the_spine_of_a_rectangle_is_one_plateau() {
    let rectangle = "POLYGON ((0 0, 6 0, 6 2, 0 2, 0 0))";
    assert_eq!(largest(rectangle), [(1.0, 4.0, Point::new(3.0, 1.0))]);
    // However many elements lie along it.
    let parts = shapes::wkt("POLYGON ((0 0, 1 0, 2.5 0, 6 0, 6 2, 4 2, 1.5 2, 0 2, 0 0))");
    let axis = path_tracing(&parts).unwrap();
    let found = largest_disks(&parts, &axis).unwrap();
    assert_eq!((found.len(), found[0].length, found[0].middle), (1, 4.0, Point::new(3.0, 1.0)));
    assert_eq!(found[0].paths.len() + 1, found[0].keypoints.len());
    assert!(found[0].keypoints.is_sorted());
    let x = |&k: &u32| axis.keypoints().at(k).position.x;
    let mut along: Vec<f64> = found[0].keypoints_along(&axis).iter().map(x).collect();
    if along[0] > 1.0 {
        along.reverse();
    }
    assert_eq!(
        (along.len(), along[0], along[along.len() - 1]),
        (found[0].keypoints.len(), 1.0, 5.0)
    );
    assert!(along.is_sorted());
}

#[test]
fn equal_disks_that_no_level_path_joins_are_two_plateaus() {
    // Two squares of side 4; the corridor misses the point where each largest disk touches its wall.
    let rooms =
        "POLYGON ((0 0, 4 0, 4 2.5, 6 2.5, 6 0, 10 0, 10 4, 6 4, 6 3.5, 4 3.5, 4 4, 0 4, 0 0))";
    let ends = [Point::new(2.0, 2.0), Point::new(8.0, 2.0)];
    assert_eq!(largest(rooms), ends.map(|p| (2.0, 0.0, p)));
    // A level passage of the same radius joins two rooms that are no wider.
    let hall = "POLYGON ((0 0, 9 0, 9 2, 0 2, 0 0), (4.4 0.9, 4.4 1.1, 4.6 1.1, 4.6 0.9, 4.4 0.9))";
    let found = largest(hall);
    assert_eq!(found.len(), 2);
    assert!(found.iter().all(|&(radius, length, _)| radius == 1.0 && length > 2.0), "{found:?}");
}

#[test]
fn corners_of_a_frame_are_wider_than_its_sides() {
    // Where arms of width 2 meet, r = (2 - r) √2.
    let radius = 4.0 - 8.0_f64.sqrt();
    let l = largest("POLYGON ((0 0, 7 0, 7 2, 2 2, 2 7, 0 7, 0 0))");
    assert_eq!(l.len(), 1);
    assert!((l[0].0 - radius).abs() < 1e-15 && l[0].1 == 0.0 && l[0].2.x == l[0].2.y, "{l:?}");
    // A hole in the middle of a square: no closed passage, but four points.
    let frame = largest("POLYGON ((0 0, 6 0, 6 6, 0 6, 0 0), (2 2, 2 4, 4 4, 4 2, 2 2))");
    assert_eq!(frame.len(), 4);
    assert!(frame.iter().all(|&(r, length, _)| (r - radius).abs() < 1e-15 && length == 0.0));
}

#[test]
fn a_passage_is_one_neck_however_many_elements_lie_along_it() {
    // Width 1 from x = 4 to 8, with a dent in the lower wall that a third room hangs on.
    let domain = shapes::wkt(
        "POLYGON ((0 0, 4 0, 4 2, 8 2, 8 0, 12 0, 12 5, 8 5, 8 3, 6 3, 5 3, 4 3, 4 5, 0 5, 0 0))",
    );
    let found = inside(&domain);
    assert_eq!(sizes(&found), [(1.0, 4.0)]);
    assert_eq!(found[0].middle, Point::new(6.0, 2.5));
    assert_eq!(found[0].footpoints[0].x, 6.0);
}

#[test]
fn spacings_are_told_outside() {
    let two = shapes::wkt(
        "MULTIPOLYGON (((0 0, 2 0, 2 2, 0 2, 0 0)), ((5 0, 7 0, 7 2, 5 2, 5 0)), ((8 3, 9 3, 9 4, 8 3)))",
    );
    let found = outside(&two);
    assert_eq!(found.len(), 2);
    assert!((found[0].width - 2.0_f64.sqrt()).abs() < 1e-15, "{found:?}");
    assert_eq!(
        (found[1].width, found[1].length, found[1].middle),
        (3.0, 2.0, Point::new(3.5, 1.0))
    );
    assert!(found.iter().all(|neck| neck.side == Side::Exterior));
}

#[test]
fn a_tiny_edge_makes_its_neighbours_near_without_a_neck() {
    // A wedge with its tip cut off: the least distance of its sides is that edge, at which the radius is 0.
    let wedge = shapes::wkt("POLYGON ((0 0, 9 4, 0 4.1, 0 0))");
    assert_eq!(inside(&wedge), []);
    let cut = shapes::wkt("POLYGON ((0 0, 8 3.9, 8 4, 0 4.1, 0 0))");
    assert_eq!(inside(&cut), []);
}

/// Middles and widths of the places inside where two elements face each other with nothing between: corners
/// and corners, corners and edges. Second, whether some place is too close to a tie to tell.
fn faced(domain: &Domain) -> (Vec<(Point, f64)>, bool) {
    let n = domain.edges().len() as u32;
    let (mut found, mut is_doubtful) = (Vec::new(), false);
    let mut try_pair = |p: Point, q: Point, margin: f64| {
        let (middle, width) = (p + (q - p) * 0.5, (q - p).norm());
        let clear = distance(domain, middle) - 0.5 * width;
        if clear > -1e-9 * width && margin > -1e-9 && is_inside(domain, middle) && width > 0.0 {
            // A third element touches, or nearly; or the foot is an end.
            let touching = touched(domain, middle, 0.5 * width * (1.0 + 1e-9));
            is_doubtful |= margin < 1e-9 || touching;
            found.push((middle, width));
        }
    };
    let is_reflex = |k: u32| domain.edge(k).corner == Corner::Reflex;
    // How far a way out of a corner is from the ends of the angle in which it is nearest.
    let slack = |k: u32, way: Point| {
        let (edge, before) = (domain.edge(k), domain.edge(domain.edge(k).prev));
        (edge.direction.dot(way)).abs().min((before.direction.dot(way)).abs()) / way.norm()
    };
    for j in (0..n).filter(|&j| is_reflex(j)) {
        let p = domain.edge(j).start;
        for k in (0..j).filter(|&k| is_reflex(k)) {
            let q = domain.edge(k).start;
            try_pair(p, q, slack(j, q - p).min(slack(k, q - p)));
        }
        for k in 0..n {
            let edge = domain.edge(k);
            if k == j || edge.next == j {
                continue;
            }
            let along = edge.direction.dot(p - edge.start);
            let foot = edge.start + edge.direction * along;
            let slack = if foot == p { 1.0 } else { slack(j, foot - p) };
            // At the end of an edge the foot is a corner.
            try_pair(p, foot, along.min(edge.length - along).min(slack));
        }
    }
    (found, is_doubtful)
}

/// Whether more than the two elements that face each other touch a disk.
fn touched(domain: &Domain, centre: Point, radius: f64) -> bool {
    let mut feet: Vec<Point> = Vec::new();
    for k in 0..domain.edges().len() as u32 {
        let (a, b) = (domain.edge(k).start, domain.end(k));
        let along = ((centre - a).dot(b - a) / (b - a).norm2()).clamp(0.0, 1.0);
        let foot = a + (b - a) * along;
        if (foot - centre).norm() <= radius
            && feet.iter().all(|f| (*f - foot).norm() > 1e-6 * radius)
        {
            feet.push(foot);
        }
    }
    feet.len() > 2
}

fn judge(domain: &Domain, axis: &MedialAxis) -> bool {
    let found = necks(domain, axis, None).unwrap();
    for neck in &found {
        let wrong = (distance(domain, neck.middle) - 0.5 * neck.width).abs();
        assert!(wrong <= 1e-9 * (1.0 + neck.width), "{neck:?}");
        let limits = [neck.width * 1.001, neck.width * 0.999];
        let below = limits.map(|limit| necks(domain, axis, Some(limit)).unwrap().len());
        assert!(below[0] > below[1], "{neck:?}");
    }
    let (expected, is_doubtful) = faced(domain);
    if is_doubtful || found.iter().any(|neck| neck.length > 0.0) {
        return false;
    }
    let text = || {
        let ring = |w: &domain::Walk| w.edges().map(|k| domain.edge(k).start).collect();
        shapes::to_wkt(&vec![domain.walks().iter().map(ring).collect()])
    };
    assert_eq!(found.len(), expected.len(), "{found:?} {expected:?} {}", text());
    for (middle, width) in expected {
        let is_same =
            |neck: &Neck| (neck.middle - middle).norm() < 1e-7 && (neck.width - width).abs() < 1e-9;
        assert!(found.iter().any(is_same), "{middle:?} {width} {}", text());
    }
    true
}

#[test]
fn random_necks_are_the_places_where_elements_face_each_other() {
    let mut random = Random(41);
    let options = domain::Options { regroup: true, ..domain::Options::default() };
    let mut counts = [0; 2];
    for round in 0..20_000 {
        let family = [Family::Tangle, Family::Holes, Family::Hung][round % 3];
        let ground = if round % 4 == 0 { Ground::Grid(12) } else { Ground::Square };
        let polygons = random::shape(&mut random, family, ground);
        let Ok(domain) = Domain::from_polygons(&polygons, &options) else { continue };
        let told = judge(&domain, &path_tracing(&domain).unwrap());
        counts[usize::from(told)] += 1;
    }
    assert!(counts[1] > 10_000, "{counts:?}");
}

#[test]
fn the_largest_disk_is_that_of_a_search() {
    let mut random = Random(3);
    for _ in 0..500 {
        let polygons = random::shape(&mut random, Family::Tangle, Ground::Square);
        let Ok(domain) = shapes::of(&polygons) else { continue };
        let axis = path_tracing(&domain).unwrap();
        let largest = largest_disks(&domain, &axis).unwrap();
        let radius = largest[0].radius;
        for _ in 0..200 {
            let p = Point::new(random.unit(), random.unit());
            assert!(!is_inside(&domain, p) || distance(&domain, p) <= radius * (1.0 + 1e-12));
        }
    }
}

#[test]
fn random_plateaus_are_chains_of_largest_disks() {
    let mut random = Random(12);
    let (mut ties, mut passages) = (0, 0);
    for _ in 0..12_000 {
        let polygons = random::shape(&mut random, Family::Tangle, Ground::Grid(6));
        let Ok(domain) = shapes::of(&polygons) else { continue };
        let axis = path_tracing(&domain).unwrap();
        let found = largest_disks(&domain, &axis).unwrap();
        let mut keypoints: Vec<u32> = found.iter().flat_map(|p| p.keypoints.clone()).collect();
        keypoints.sort_unstable();
        assert!(keypoints.windows(2).all(|pair| pair[0] < pair[1]), "{found:?}");
        for plateau in &found {
            let along = plateau.keypoints_along(&axis);
            assert_eq!(along.len(), plateau.paths.len() + 1);
            for (pair, &number) in along.windows(2).zip(&plateau.paths) {
                let path = axis.paths().at(number);
                assert!(pair == [path.from, path.to] || pair == [path.to, path.from]);
            }
            let mut sorted = along.clone();
            sorted.sort_unstable();
            assert_eq!(sorted, plateau.keypoints);
            // It is straight.
            let [from, to] =
                [along[0], along[along.len() - 1]].map(|k| axis.keypoints().at(k).position);
            assert!(((to - from).norm() - plateau.length).abs() < 1e-12);
            assert!((plateau.middle - (from + to) * 0.5).norm() < 1e-12);
            assert!((distance(&domain, plateau.middle) - plateau.radius).abs() < 1e-12);
            passages += usize::from(plateau.length > 0.0);
        }
        ties += usize::from(found.len() > 1);
    }
    assert!(ties > 10 && passages > 100, "{ties} {passages}");
}
