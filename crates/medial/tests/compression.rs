//! Disks that stand for a shape: the error that is promised, measured on fixtures and random shapes.

mod support;

use medial::axis::{Accuracy, Engine, KeypointKind, MedialAxis};
use medial::domain::{self, Domain};
use medial::engine::{self, exterior, path_tracing};
use medial::geom::Point;
use medial::ops::{CompressError, Compressed, Corners, DiskGraph, compress};
use support::random::{self, Family, Ground, Random};
use support::shapes;

const RECTANGLE: &str = "POLYGON ((0 0, 6 0, 6 2, 0 2, 0 0))";

fn compressed(domain: &Domain, error: f64) -> DiskGraph {
    compress(domain, &path_tracing(domain).unwrap(), error).unwrap()
}

fn size(domain: &Domain) -> f64 {
    domain.edges().iter().map(|e| e.start.x.abs().max(e.start.y.abs())).fold(0.0, f64::max)
}

/// The longer side of the box.
fn extent(domain: &Domain) -> f64 {
    let side = |coordinate: fn(Point) -> f64| {
        let all = domain.edges().iter().map(|edge| coordinate(edge.start));
        all.clone().fold(f64::NEG_INFINITY, f64::max) - all.fold(f64::INFINITY, f64::min)
    };
    side(|p| p.x).max(side(|p| p.y))
}

/// A disk and those between it and another one.
type Piece = [(Point, f64); 2];

fn pieces(graph: &DiskGraph) -> Vec<Piece> {
    let alone = (0..graph.disks().len() as u32).map(|k| [k, k]);
    graph.links().chain(alone).map(|ends| ends.map(|k| graph.disk(k))).collect()
}

/// The distance of a point from the disks of a piece, negative inside.
fn outside(p: Point, [a, b]: Piece) -> f64 {
    let way = b.0 - a.0;
    let length = way.norm();
    let away = |s: f64| (p - (a.0 + way * s)).norm() - (a.1 + (b.1 - a.1) * s);
    let ends = away(0.0).min(away(1.0));
    // Least where the way to the point is square to the tangent.
    let sine = (b.1 - a.1) / length;
    if length == 0.0 || sine.abs() >= 1.0 {
        return ends;
    }
    let (along, across) = ((p - a.0).dot(way) / length, (p - a.0).cross(way).abs() / length);
    let share = (along + across * sine / (1.0 - sine * sine).sqrt()) / length;
    if 0.0 < share && share < 1.0 { away(share).min(ends) } else { ends }
}

fn outside_all(p: Point, pieces: &[Piece]) -> f64 {
    pieces.iter().map(|&piece| outside(p, piece)).fold(f64::INFINITY, f64::min)
}

/// Points of the boundary of the pieces, and some that the others cover.
fn outline(pieces: &[Piece]) -> Vec<Point> {
    let mut points = Vec::new();
    for &[a, b] in pieces {
        for k in 0..24 {
            let angle = std::f64::consts::TAU * f64::from(k) / 24.0;
            let around = Point::new(angle.cos(), angle.sin());
            points.extend([a, b].map(|(centre, radius)| centre + around * radius));
        }
        let way = b.0 - a.0;
        let sine = (a.1 - b.1) / way.norm();
        if sine.abs() < 1.0 {
            let along = way * (1.0 / way.norm());
            for side in [1.0, -1.0] {
                let normal = along * sine + along.perp() * (side * (1.0 - sine * sine).sqrt());
                points.extend(
                    (1..8)
                        .map(|k| f64::from(k) / 8.0)
                        .map(|s| a.0 + way * s + normal * (a.1 + (b.1 - a.1) * s)),
                );
            }
        }
    }
    points
}

fn from_boundary(p: Point, domain: &Domain) -> f64 {
    let edge = |k: usize| {
        let edge = domain.edge(k as u32);
        let along = edge.direction.dot(p - edge.start).clamp(0.0, edge.length);
        (p - (edge.start + edge.direction * along)).norm()
    };
    (0..domain.edges().len()).map(edge).fold(f64::INFINITY, f64::min)
}

/// Distances of either boundary from the other one, measured.
fn measured(domain: &Domain, graph: &DiskGraph, each: u32) -> Result<[f64; 2], String> {
    let rounding = 1e-11 * size(domain);
    let pieces = pieces(graph);
    let mut of_domain: f64 = 0.0;
    for edge in domain.edges() {
        for k in 0..each {
            let p = edge.start + edge.direction * (edge.length * f64::from(k) / f64::from(each));
            let away = outside_all(p, &pieces);
            if away < -rounding {
                return Err(format!("{p:?} of the boundary is covered by {}", -away));
            }
            of_domain = of_domain.max(away);
        }
    }
    let mut of_disks: f64 = 0.0;
    for p in outline(&pieces) {
        if outside_all(p, &pieces) > -rounding {
            of_disks = of_disks.max(from_boundary(p, domain));
        }
    }
    Ok([of_domain, of_disks])
}

/// Components and cycles of a graph.
fn topology(n: usize, links: impl Iterator<Item = [u32; 2]>) -> (usize, usize) {
    let mut root: Vec<usize> = (0..n).collect();
    fn find(root: &mut [usize], mut k: usize) -> usize {
        while root[k] != k {
            root[k] = root[root[k]];
            k = root[k];
        }
        k
    }
    let (mut components, mut n_links) = (n, 0);
    for [a, b] in links {
        n_links += 1;
        let (a, b) = (find(&mut root, a as usize), find(&mut root, b as usize));
        components -= usize::from(a != b);
        root[a] = b;
    }
    (components, n_links + components - n)
}

fn faults(domain: &Domain, axis: &MedialAxis, error: f64, each: u32) -> Vec<String> {
    let graph = match compress(domain, axis, error) {
        Ok(graph) => graph,
        Err(CompressError::TooFine { size, .. }) if error < size / 4e9 => return Vec::new(),
        Err(why) => return vec![format!("{error}: {why}")],
    };
    let mut faults = Vec::new();
    if graph.error() > error {
        faults.push(format!("{error}: {} is more", graph.error()));
    }
    let of_axis = axis.paths().iter().map(|path| [path.from, path.to]);
    let whole = topology(axis.keypoints().len(), of_axis);
    let kept = topology(graph.disks().len(), graph.links());
    if whole != kept {
        faults.push(format!("{error}: {kept:?} of {whole:?}"));
    }
    match measured(domain, &graph, each) {
        Ok(found) => {
            let most = graph.error() + 1e-11 * size(domain);
            if found.iter().any(|&away| away > most) {
                faults.push(format!("{error}: {found:?}, not {}", graph.error()));
            }
        }
        Err(why) => faults.push(format!("{error}: {why}")),
    }
    let again = graph.axis().unwrap();
    if again.paths().len() != graph.links().count()
        || again.accuracy != Accuracy::Sampled(graph.error())
    {
        faults.push("the axis is another one".to_owned());
    }
    faults
}

const SHARES: [f64; 4] = [1e-3, 1e-2, 0.07, 0.8];

fn random_shapes(family: Family, ground: Ground, most: u64, seed: u64, count: usize) {
    let mut random = Random(seed);
    let options = domain::Options { regroup: true, ..domain::Options::default() };
    let mut tried = 0;
    for _ in 0..20 * count {
        let polygons = random::large_shape(&mut random, family, ground, most);
        let Ok(domain) = Domain::from_polygons(&polygons, &options) else { continue };
        tried += 1;
        let axis = path_tracing(&domain).unwrap();
        for share in SHARES {
            let found = faults(&domain, &axis, share * extent(&domain), 4);
            assert!(found.is_empty(), "{}: {found:#?}", shapes::to_wkt(&polygons));
        }
        if tried == count {
            return;
        }
    }
    panic!("{tried} of {count} shapes are domains");
}

#[test]
fn the_error_holds_on_random_shapes() {
    random_shapes(Family::Tangle, Ground::Square, 24, 701, 30);
    random_shapes(Family::Tangle, Ground::Grid(9), 20, 702, 40);
    random_shapes(Family::Holes, Ground::Grid(30), 20, 703, 20);
    random_shapes(Family::Hung, Ground::Grid(20), 20, 704, 15);
    random_shapes(Family::Triangles, Ground::Grid(4), 20, 705, 25);
    random_shapes(Family::Squares, Ground::Grid(4), 20, 706, 25);
}

#[test]
fn the_error_holds_on_fixtures() {
    for name in shapes::names() {
        let domain = shapes::domain(&name);
        if domain.edges().len() < 120 {
            let axis = path_tracing(&domain).unwrap();
            for share in SHARES {
                let found = faults(&domain, &axis, share * extent(&domain), 4);
                assert!(found.is_empty(), "{name}: {found:#?}");
            }
        }
    }
}

#[test]
fn a_slit_thinner_than_the_error_stays_open() {
    // From the left nearly through, 0.002 wide.
    let slit = "POLYGON ((0 0, 10 0, 10 4, 0 4, 0 2.001, 8 2.001, 8 1.999, 0 1.999, 0 0))";
    let domain = shapes::wkt(slit);
    let axis = path_tracing(&domain).unwrap();
    assert_eq!(faults(&domain, &axis, 0.1, 64), Vec::<String>::new());
    // A hole as small.
    let hole = "POLYGON ((0 0, 10 0, 10 4, 0 4, 0 0), (5 2, 5 2.001, 5.001 2.001, 5.001 2, 5 2))";
    let domain = shapes::wkt(hole);
    let axis = path_tracing(&domain).unwrap();
    assert_eq!(faults(&domain, &axis, 0.1, 64), Vec::<String>::new());
}

#[test]
fn a_bridge_thinner_than_the_grid_stays() {
    let bridge = "POLYGON ((0 0, 4 0, 4 2, 9 2.0001, 9 0, 13 0, 13 4, 9 4, 9 2.0002, 4 2.0001, 4 4, 0 4, 0 0))";
    let domain = shapes::wkt(bridge);
    let axis = path_tracing(&domain).unwrap();
    assert_eq!(faults(&domain, &axis, 0.1, 64), Vec::<String>::new());
    let graph = compressed(&domain, 0.1);
    assert!(graph.disks().iter().filter(|disk| disk.radius == 0).count() >= 2);
}

#[test]
fn a_parabola_becomes_a_few_straight_pieces() {
    // Between the corner (5, 2) and the lower edge.
    let domain = shapes::wkt("POLYGON ((0 0, 10 0, 10 5, 5 2, 0 5, 0 0))");
    let counts = [0.5, 0.05, 0.005].map(|error| compressed(&domain, error).disks().len());
    assert!(counts.is_sorted() && counts[2] > counts[0] && counts[2] < 60, "{counts:?}");
    let axis = path_tracing(&domain).unwrap();
    assert_eq!(faults(&domain, &axis, 0.005, 256), Vec::<String>::new());
}

#[test]
fn a_rectangle_is_two_disks() {
    let domain = shapes::wkt(RECTANGLE);
    let graph = compressed(&domain, 1.0);
    let axis = graph.axis().unwrap();
    let kinds: Vec<KeypointKind> = axis.keypoints().iter().map(|k| k.kind).collect();
    assert_eq!(kinds, [KeypointKind::Tip, KeypointKind::Tip]);
    // The spine of length 4, less what half of the error takes off both ends.
    let length = axis.curve(&axis.paths().at(0)).length();
    assert!(length > 2.0 && length < 4.0, "{length}");
    // All of it becomes one disk once the error is that of the corners and more.
    let one = compressed(&domain, 9.0);
    assert_eq!((one.disks().len(), one.links().count()), (1, 0));
    assert_eq!(one.axis().unwrap().keypoints().len(), 1);
}

#[test]
fn what_cannot_be_compressed_is_told() {
    let domain = shapes::wkt(RECTANGLE);
    let axis = path_tracing(&domain).unwrap();
    for error in [0.0, 1e-12, -1.0, f64::NAN] {
        let found = compress(&domain, &axis, error);
        assert!(matches!(found, Err(CompressError::TooFine { .. })), "{error}: {found:?}");
    }
    assert!(compress(&domain, &axis, f64::INFINITY).is_ok());
    let options = engine::Options::default();
    let outside = exterior(&domain, Engine::PathTracing, None, &options).unwrap();
    assert_eq!(compress(&domain, &outside, 1.0), Err(CompressError::Exterior));
}

#[test]
fn corners_give_the_exact_axis_again() {
    let polygons = shapes::parse(RECTANGLE);
    let domain = shapes::of(&polygons).unwrap();
    let corners = Corners { engine: Engine::PathTracing, regroup: false, error: 0.0, polygons };
    let again = Compressed::Corners(corners).axis().unwrap();
    assert_eq!(again, path_tracing(&domain).unwrap());
}

#[test]
fn governors_of_what_is_read_back_touch_its_disks() {
    let frame = "POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (3 3, 3 6, 6 6, 6 3, 3 3))";
    let graph = compressed(&shapes::wkt(frame), 0.05);
    let axis = graph.axis().unwrap();
    for (number, keypoint) in (0..).zip(axis.keypoints()) {
        let list = axis.governors(number);
        assert!(!list.is_empty() && list[0] == *list.iter().min().unwrap());
        for foot in axis.footpoints(number) {
            let away = (foot - keypoint.position).norm();
            assert!((away - keypoint.radius).abs() < 1e-9, "{away} {keypoint:?}");
        }
    }
    // The axis of a frame has one cycle, and so has this one.
    assert_eq!(axis.paths().len() + 1 - axis.keypoints().len(), 1);
}

/// The largest distance of points of the boundary of one domain from that of another one.
fn from_to(from: &Domain, to: &Domain) -> f64 {
    let mut most: f64 = 0.0;
    for edge in from.edges() {
        for k in 0..8 {
            let p = edge.start + edge.direction * (edge.length * f64::from(k) / 8.0);
            most = most.max(from_boundary(p, to));
        }
    }
    most
}

#[test]
fn simplified_corners_stay_within_the_error() {
    let mut n_simpler = 0;
    for name in shapes::names() {
        let polygons = shapes::polygons(&name);
        let domain = shapes::domain(&name);
        if domain.edges().len() > 400 {
            continue;
        }
        let corners = Corners { engine: Engine::PathTracing, regroup: false, error: 0.0, polygons };
        for share in SHARES {
            let error = share * extent(&domain);
            let Some(left) = corners.simplified(error) else { continue };
            let simpler = shapes::of(&left.polygons).unwrap();
            n_simpler += usize::from(simpler.edges().len() < domain.edges().len());
            assert!(left.error <= error && left.error > 0.06 * error);
            let most = left.error + 1e-11 * size(&domain);
            let found = [from_to(&domain, &simpler), from_to(&simpler, &domain)];
            assert!(found.iter().all(|&away| away <= most), "{name}: {found:?}, not {error}");
        }
    }
    assert!(n_simpler > 5, "{n_simpler}");
}
