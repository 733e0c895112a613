//! Carving: what is cut away is the volume under the distance from the boundary, and passes go on without
//! gaps.

mod support;

use medial::axis::{Engine, MedialAxis, SiteKind};
use medial::domain::{self, Domain};
use medial::engine::{Options, exterior, path_tracing};
use medial::geom::Point;
use medial::ops::{CarveError, CarveOptions, Carving, Clearing, Move, Role, carve, offsets};
use support::plane::{distance, is_inside};
use support::random::{self, Family, Ground, Random};
use support::shapes;

fn carved(domain: &Domain, options: &CarveOptions) -> Carving {
    carve(domain, &path_tracing(domain).unwrap(), options).unwrap()
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * (a.abs() + b.abs())
}

/// The integral of the distance from the boundary over the interior, cell by cell: over an edge half the
/// square of the radius, along the edge; around a corner a third of its cube, over the angle.
fn under_the_radius(axis: &MedialAxis) -> f64 {
    const N: u32 = 4000;
    let mut sum = 0.0;
    for path in axis.paths() {
        let curve = axis.curve(&path);
        for governor in [path.left, path.right] {
            let site = axis.sites().at(governor);
            let along = |p: Point| match site.kind {
                SiteKind::Edge => {
                    let way = site.b - site.a;
                    way.dot(p - site.a) / way.norm()
                }
                SiteKind::Vertex => (p - site.a).y.atan2((p - site.a).x),
            };
            let height = |u: f64| {
                let r = curve.radius_at(u);
                if site.kind == SiteKind::Edge { r * r / 2.0 } else { r * r * r / 3.0 }
            };
            for k in 0..N {
                let [u, v] = [k, k + 1].map(|k| f64::from(k) / f64::from(N));
                let mut step = (along(curve.point_at(v)) - along(curve.point_at(u))).abs();
                if step > std::f64::consts::PI && site.kind == SiteKind::Vertex {
                    step = std::f64::consts::TAU - step;
                }
                // Simpson's rule, the abscissa being nearly even.
                sum += step * (height(u) + 4.0 * height(0.5 * (u + v)) + height(v)) / 6.0;
            }
        }
    }
    sum
}

fn domains(seed: u64, n: usize) -> Vec<Domain> {
    let mut random = Random(seed);
    let mut domains = Vec::new();
    while domains.len() < n {
        let k = domains.len();
        let family = [Family::Tangle, Family::Holes, Family::Hung, Family::Triangles][k % 4];
        let ground = if k % 3 == 0 { Ground::Grid(6) } else { Ground::Square };
        let polygons = random::shape(&mut random, family, ground);
        domains.extend(Domain::from_polygons(&polygons, &domain::Options::default()));
    }
    domains
}

#[test]
fn the_volume_cut_is_that_under_the_radius() {
    for domain in domains(31, 200) {
        let axis = path_tracing(&domain).unwrap();
        let by_cells = under_the_radius(&axis);
        let all = carve(&domain, &axis, &CarveOptions::with_angle(90.0)).unwrap();
        assert!((all.volume() / by_cells - 1.0).abs() < 1e-5, "{} {by_cells}", all.volume());
        // A limit beyond the deepest place changes nothing.
        let depth = Some(1.01 * axis.radius_max());
        let deep = CarveOptions { depth, ..CarveOptions::with_angle(90.0) };
        let same = carve(&domain, &axis, &deep).unwrap();
        assert_eq!((same.moves, same.floor.polygons.len()), (all.moves, 0));
    }
}

#[test]
fn below_a_limit_the_volume_grows_as_the_area_of_the_offset() {
    for domain in domains(32, 200) {
        let axis = path_tracing(&domain).unwrap();
        let most = axis.radius_max();
        for share in [0.2, 0.55, 0.9] {
            for angle in [20.0, 60.0, 120.0] {
                let slope = 1.0 / (f64::to_radians(angle) / 2.0).tan();
                let volume = |radius: f64| {
                    let depth = Some(slope * radius);
                    let options = CarveOptions { depth, ..CarveOptions::with_angle(angle) };
                    carve(&domain, &axis, &options).unwrap().volume()
                };
                // Simpson's rule for the areas between two radii a little apart.
                let [low, high] = [share * most, (share + 1e-3) * most];
                let at = [low, 0.5 * (low + high), high];
                let areas: Vec<f64> =
                    offsets(&domain, &axis, &at).unwrap().iter().map(|o| o.area()).collect();
                let grown = slope * (high - low) * (areas[0] + 4.0 * areas[1] + areas[2]) / 6.0;
                let difference = volume(high) - volume(low);
                let whole = volume(high);
                assert!(
                    (difference - grown).abs() < 1e-3 * grown.abs() + 1e-12 * whole,
                    "{difference} {grown} of {whole}"
                );
            }
        }
    }
}

#[test]
fn passes_go_on_where_moves_end_and_take_every_move() {
    for (k, domain) in domains(33, 200).iter().enumerate() {
        let axis = path_tracing(domain).unwrap();
        let depth = (k % 2 == 0).then(|| 0.5 * axis.radius_max());
        let clearing = depth.map(|depth| Clearing { radius: 0.1 * depth, step: 0.1 * depth });
        let lift = [None, Some(0.0), Some(1e9)][k % 3];
        let leave = (k % 5 == 0).then(|| 0.05 * axis.radius_max());
        let options = CarveOptions { depth, clearing, leave, lift, angle: 90.0 };
        let carving = carve(domain, &axis, &options).unwrap();
        let mut times = vec![0; carving.moves.len()];
        let mut last = Role::Valley;
        for pass in &carving.passes {
            let steps: Vec<(Role, Move)> = carving.steps(pass).collect();
            for pair in steps.windows(2) {
                assert_eq!(pair[0].1.to(), pair[1].1.from());
            }
            pass.iter().for_each(|&(number, _)| times[number as usize] += 1);
            let is_floor = carving.role(pass) == Some(Role::Floor);
            assert!(steps.iter().all(|(role, _)| (*role == Role::Floor) == is_floor));
            assert!(is_floor || last != Role::Floor, "the floor comes last");
            last = carving.role(pass).unwrap();
        }
        assert!(times.iter().all(|&n| n == 1 || n == 2));
        // Where a lift is worth more than any way, each part that hangs together is one pass.
        if lift == Some(1e9) && depth.is_none() {
            // What touches in a corner is cut in one pass too.
            assert!(carving.passes.len() <= domain.n_components());
        }
    }
}

#[test]
fn the_bit_reaches_the_boundary_and_never_beyond() {
    let mut random = Random(34);
    for (k, domain) in domains(35, 100).iter().enumerate() {
        let axis = path_tracing(domain).unwrap();
        let depth = (k % 2 == 0).then(|| 0.6 * axis.radius_max());
        let options = CarveOptions { depth, ..CarveOptions::with_angle(90.0) };
        let carving = carve(domain, &axis, &options).unwrap();
        let tips: Vec<(Point, f64)> = carving
            .moves
            .iter()
            .flat_map(|(_, cut)| (0..=200).map(|t| cut.at(f64::from(t) / 200.0)))
            .map(|tip| (tip.point, -tip.z))
            .collect();
        let size = axis.radius_max();
        for &(p, r) in tips.iter().step_by(37) {
            assert!(r <= distance(domain, p) + 1e-9 * size, "{p:?} {r}");
        }
        let corners: Vec<Point> = domain.edges().iter().map(|edge| edge.start).collect();
        let bound = |pick: fn(f64, f64) -> f64, of: fn(&Point) -> f64| {
            corners.iter().map(of).reduce(pick).unwrap()
        };
        let (low, high) = (
            Point::new(bound(f64::min, |p| p.x), bound(f64::min, |p| p.y)),
            Point::new(bound(f64::max, |p| p.x), bound(f64::max, |p| p.y)),
        );
        for _ in 0..40 {
            let p = Point::new(
                low.x + (high.x - low.x) * random.unit(),
                low.y + (high.y - low.y) * random.unit(),
            );
            if !is_inside(domain, p) {
                continue;
            }
            let cut = tips.iter().map(|&(c, r)| r - (p - c).norm()).fold(0.0, f64::max);
            let away = distance(domain, p);
            match depth {
                // The floor is cut by another tool; up to its wall the bit cuts.
                Some(depth) if away >= depth => {}
                _ => assert!((cut - away).abs() < 0.03 * size, "{cut} {away}"),
            }
        }
    }
}

#[test]
fn what_may_be_left_is_left_and_no_more() {
    // A disk of radius 10 as a polygon: without its small corners a single point is left to drill.
    let n = 40;
    let at = |k: u32| {
        Point::new(0.0, 0.0) + {
            let (sin, cos) = (f64::from(k) / f64::from(n) * std::f64::consts::TAU).sin_cos();
            Point::new(cos, sin) * 10.0
        }
    };
    let ring: Vec<Point> = (0..n).map(at).collect();
    let domain = Domain::from_polygons(&[vec![ring]], &domain::Options::default()).unwrap();
    let options = CarveOptions { leave: Some(0.1), ..CarveOptions::with_angle(90.0) };
    let drilled = carved(&domain, &options);
    assert_eq!((drilled.moves.len(), drilled.passes.len()), (1, 1));
    let radius = -drilled.moves[0].1.from().z;
    assert!(close(drilled.volume(), std::f64::consts::PI * radius.powi(3) / 3.0));
    // On any shape no point that was cut before is farther from what is cut now.
    for (k, domain) in domains(36, 120).iter().enumerate() {
        let axis = path_tracing(domain).unwrap();
        let leave = 0.1 * axis.radius_max();
        let depth = (k % 2 == 0).then(|| 0.6 * axis.radius_max());
        let all = CarveOptions { depth, ..CarveOptions::with_angle(90.0) };
        let [all, less] = [all, CarveOptions { leave: Some(leave), ..all }]
            .map(|options| carve(domain, &axis, &options).unwrap());
        assert!(less.volume() <= all.volume() * (1.0 + 1e-12));
        let length =
            |carving: &Carving| -> f64 { carving.moves.iter().map(|(_, cut)| cut.length()).sum() };
        assert!(length(&less) <= length(&all) * (1.0 + 1e-12));
        let tips = |carving: &Carving| -> Vec<(Point, f64)> {
            let of = |(_, cut): &(Role, Move)| {
                (0..=60).map(|t| cut.at(f64::from(t) / 60.0)).collect::<Vec<_>>()
            };
            carving.moves.iter().flat_map(of).map(|tip| (tip.point, -tip.z)).collect()
        };
        let kept = tips(&less);
        for &(p, r) in tips(&all).iter().step_by(7) {
            // The rim of what was cut there is within reach of a rim that is cut now.
            let reach = |&(c, s): &(Point, f64)| (p - c).norm() + r - s;
            let least = kept.iter().map(reach).fold(f64::INFINITY, f64::min);
            assert!(least <= leave + 0.02 * axis.radius_max(), "{least} {leave}");
        }
    }
}

#[test]
fn a_cone_is_cut_around_the_ends_of_what_was_pruned() {
    // A bar of 10 by 2 without its corners: a groove between two halves of a cone.
    let bar = shapes::wkt("POLYGON ((0 0, 10 0, 10 2, 0 2, 0 0))");
    let leave = Some(2f64.sqrt() - 1.0 + 1e-12);
    let options = CarveOptions { leave, ..CarveOptions::with_angle(90.0) };
    let carving = carved(&bar, &options);
    assert_eq!(carving.moves.len(), 1);
    assert!(close(carving.volume(), 8.0 + std::f64::consts::PI / 3.0), "{}", carving.volume());
}

#[test]
fn a_floor_is_flat_and_cleared_in_rounds() {
    let square = shapes::wkt("POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0))");
    let clearing = Some(Clearing { radius: 1.5, step: 1.0 });
    let options = CarveOptions { depth: Some(2.0), clearing, ..CarveOptions::with_angle(90.0) };
    let carving = carved(&square, &options);
    assert_eq!(carving.floor.area(), 36.0);
    // Four corners and four walls in one pass, and rounds 3.5 and 4.5 from the boundary.
    let count = |role| carving.moves.iter().filter(|(r, _)| *r == role).count();
    assert_eq!([Role::Valley, Role::Wall, Role::Floor].map(count), [4, 4, 8]);
    assert_eq!(carving.passes.len(), 3);
    assert!(close(carving.volume(), 2.0 / 3.0 * (100.0 + 36.0 + 60.0)), "{}", carving.volume());
    for (role, cut) in &carving.moves {
        let z = [cut.from().z, cut.to().z];
        assert!(if *role == Role::Valley {
            z.contains(&0.0) && z.contains(&-2.0)
        } else {
            z == [-2.0; 2]
        });
    }
    // The bit itself goes over the floor from a step beside the wall on.
    let clearing = Some(Clearing { radius: 0.0, step: 1.5 });
    let own = carved(&square, &CarveOptions { clearing, ..options });
    assert_eq!(own.passes.len(), 2);
}

#[test]
fn what_cannot_be_carved_is_told() {
    let square = shapes::wkt("POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0))");
    let axis = path_tracing(&square).unwrap();
    let fails = |options: CarveOptions| carve(&square, &axis, &options).unwrap_err();
    for angle in [0.0, -5.0, 180.0, f64::NAN] {
        assert!(matches!(fails(CarveOptions::with_angle(angle)), CarveError::Angle { .. }));
    }
    let vee = CarveOptions::with_angle(60.0);
    for depth in [0.0, -1.0, f64::INFINITY] {
        let error = fails(CarveOptions { depth: Some(depth), ..vee });
        assert!(matches!(error, CarveError::Length { name: "depth", .. }), "{error}");
    }
    let clearing = Some(Clearing { radius: 1.0, step: 1.0 });
    assert_eq!(fails(CarveOptions { clearing, ..vee }), CarveError::NoFloor);
    let clearing = Some(Clearing { radius: 1.0, step: 1.01 });
    let error = fails(CarveOptions { clearing, depth: Some(1.0), ..vee });
    assert!(matches!(error, CarveError::Gaps { .. }), "{error}");
    let error = fails(CarveOptions { depth: Some(1e-90), ..vee });
    assert!(matches!(error, CarveError::Length { name: "depth", .. }), "{error}");
    // Deeper than the shape is anywhere is no limit.
    let deep = carved(&square, &CarveOptions { depth: Some(1e300), ..vee });
    assert_eq!(deep.moves, carved(&square, &vee).moves);
    let clearing = Some(Clearing { radius: 1.0, step: 1e-9 });
    let error = fails(CarveOptions { clearing, depth: Some(1.0), ..vee });
    assert!(matches!(error, CarveError::Step { .. }), "{error}");
    let outside = exterior(&square, Engine::PathTracing, None, &Options::default()).unwrap();
    assert_eq!(carve(&square, &outside, &vee).unwrap_err(), CarveError::Exterior);
}
