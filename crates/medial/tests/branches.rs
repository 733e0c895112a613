//! Branches, their primitives and limbs: closed forms, and what all branches of a shape add up to.

mod support;

use medial::axis::{Curve, Engine, KeypointKind, MedialAxis, Side};
use medial::domain::{self, Domain};
use medial::engine::{Options, both_sides, interior, path_tracing};
use medial::geom::Point;
use medial::ops::{
    Bend, Branch, Limb, Measure, Primitive, Trend, boundary_distance, branches, limb_pairs, limbs,
};
use support::random::{self, Family, Ground, Random};
use support::shapes;

fn of(text: &str) -> MedialAxis {
    path_tracing(&shapes::wkt(text)).unwrap()
}

/// The primitives of a branch, in the direction from a keypoint.
fn kinds(
    axis: &MedialAxis,
    branch: &Branch<'_>,
    from: (f64, f64),
) -> Vec<(Primitive, Option<Trend>, Bend)> {
    let start = axis.keypoints().at(branch.from()).position;
    assert_eq!(start, Point::new(from.0, from.1));
    branch.pieces().map(|piece| (piece.primitive(), piece.trend(), piece.bend())).collect()
}

#[test]
fn a_rectangle_has_a_worm_and_four_wedges() {
    let axis = of("POLYGON ((0 0, 6 0, 6 2, 0 2, 0 0))");
    let branches = branches(&axis);
    assert_eq!(branches.len(), 5);
    for branch in branches.iter() {
        let kind = axis.keypoints().at(branch.from()).kind;
        let piece = branch.pieces().next().unwrap();
        assert_eq!((branch.pieces().len(), piece.bend()), (1, Bend::Straight));
        if kind == KeypointKind::End {
            assert_eq!(
                (piece.primitive(), piece.trend()),
                (Primitive::Wedge, Some(Trend::Opening))
            );
            assert_eq!((branch.extent().area, branch.extent().radius_mean), (1.0, 0.5));
            assert_eq!(branch.boundary_lengths(), [1.0, 1.0]);
        } else {
            assert_eq!((piece.primitive(), piece.trend()), (Primitive::Worm, None));
            assert_eq!((branch.extent().length, branch.extent().area), (4.0, 8.0));
        }
    }
}

#[test]
fn a_waist_between_two_corners_closes_and_opens() {
    // Between the corners (4, 1) and (4, 3), with edges that fall away from them: parabolas of their foci.
    let axis = of("POLYGON ((0 0, 4 1, 8 0, 8 4, 4 3, 0 4, 0 0))");
    let branches = branches(&axis);
    let waist = branches
        .iter()
        .find(|b| b.extent().radius_min == 1.0 && b.extent().radius_start > 1.0)
        .unwrap();
    let ends = [waist.from(), waist.to()].map(|k| axis.keypoints().at(k).position);
    assert_eq!((ends[0].y, ends[1].y), (2.0, 2.0));
    let names: Vec<String> = waist
        .pieces()
        .map(|p| format!("{} {} {}", p.primitive(), p.trend().map_or("", Trend::name), p.bend()))
        .collect();
    let middle = names.iter().position(|n| n == "flare closing straight").unwrap();
    assert_eq!(names[middle + 1], "flare opening straight");
    // The wedges before and behind.
    assert_eq!(names[0], "wedge closing straight");
    assert_eq!(names.last().unwrap(), "wedge opening straight");
    assert_eq!(names.len(), 4, "{names:?}");
    assert!(
        (waist.extent().radius_max - waist.extent().radius_start.max(waist.extent().radius_end))
            .abs()
            < 1e-12
    );
}

#[test]
fn a_corner_over_an_edge_makes_spirals() {
    // The corner (4, 2) above the edge y = 0: the axis bends around it, down to its apex and up again.
    let axis = of("POLYGON ((0 0, 8 0, 8 6, 4 2, 0 6, 0 0))");
    let branches = branches(&axis);
    let around = branches.iter().find(|b| b.pieces().any(|p| p.bend() != Bend::Straight)).unwrap();
    let from = axis.keypoints().at(around.from()).position;
    let bends: Vec<_> = kinds(&axis, &around, (from.x, from.y))
        .into_iter()
        .filter(|k| k.2 != Bend::Straight)
        .collect();
    let expected = if from.x < 4.0 {
        [(Trend::Closing, Bend::SpiralInLeft), (Trend::Opening, Bend::SpiralOutLeft)]
    } else {
        [(Trend::Closing, Bend::SpiralInRight), (Trend::Opening, Bend::SpiralOutRight)]
    };
    assert_eq!(bends, expected.map(|(trend, bend)| (Primitive::Flare, Some(trend), bend)));
}

#[test]
fn a_ring_of_normal_points_is_one_closed_branch() {
    // Two circles of many corners would have branches; a hole in a disk that was pruned has none.
    let text = "POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (3 3, 3 6, 6 6, 6 3, 3 3))";
    let domain = shapes::wkt(text);
    let axis = path_tracing(&domain).unwrap();
    let pruned = medial::ops::Hierarchy::new(&domain, &axis)
        .unwrap()
        .pruned(Measure::Excess, f64::INFINITY)
        .axis;
    let closed = branches(&pruned);
    assert_eq!(closed.len(), 1);
    let only = closed.iter().next().unwrap();
    assert!(only.is_closed() && only.from() == only.to());
    assert_eq!(only.paths().len(), pruned.paths().len());
    assert_eq!(branches(&axis).iter().filter(Branch::is_closed).count(), 0);
}

/// Whether all branches add up to the axis and the domain.
fn faults(domain: &Domain, axis: &MedialAxis) -> Vec<String> {
    let mut faults = Vec::new();
    let all = branches(axis);
    let mut seen: Vec<u32> = all.iter().flat_map(|b| b.numbers()).collect();
    seen.sort_unstable();
    if seen != (0..axis.paths().len() as u32).collect::<Vec<_>>() {
        faults.push(format!("paths {seen:?}"));
    }
    let degrees = axis.degrees();
    for branch in all.iter() {
        let paths: Vec<_> = branch.paths().collect();
        if paths.windows(2).any(|p| p[0].to != p[1].from || degrees[p[0].to as usize] != 2) {
            faults.push("a branch does not run through normal points".to_owned());
        }
        let ends = [branch.from(), branch.to()].map(|k| degrees[k as usize]);
        if !branch.is_closed() && ends.contains(&2) {
            faults.push("a branch ends in a normal point".to_owned());
        }
        let lengths: f64 = branch.pieces().map(|piece| piece.extent().length).sum();
        let areas: f64 = branch.pieces().map(|piece| piece.extent().area).sum();
        let close = |a: f64, b: f64| (a - b).abs() <= 1e-9 * a.abs().max(b.abs()) + 1e-12;
        if !close(lengths, branch.extent().length) || !close(areas, branch.extent().area) {
            faults.push("pieces do not add up".to_owned());
        }
        for (boundary, length) in branch.boundary().iter().zip(branch.boundary_lengths()) {
            let chords = boundary.points.windows(2).map(|pair| (pair[1] - pair[0]).norm());
            if !close(chords.sum(), length) || boundary.length != length {
                faults.push(format!("{boundary:?} is not {length} long"));
            }
        }
        // The curves of the pieces are those of the branch, cut at necks.
        let radii = |curves: &mut dyn Iterator<Item = Curve>| {
            curves.flat_map(|c| [c.radius_from(), c.radius_to()]).collect::<Vec<_>>()
        };
        let (whole, cut) = (
            radii(&mut branch.curves()),
            radii(&mut branch.pieces().flat_map(|piece| piece.curves())),
        );
        if (whole.first(), whole.last()) != (cut.first(), cut.last()) {
            faults.push("the curves of pieces are others".to_owned());
        }
        let pieces: Vec<_> = branch.pieces().collect();
        for pair in pieces.windows(2) {
            if pair[0].extent().radius_end != pair[1].extent().radius_start {
                faults.push("pieces do not meet".to_owned());
            }
        }
        for piece in pieces {
            let (start, end) = (piece.extent().radius_start, piece.extent().radius_end);
            let wrong = match piece.trend() {
                None => (start - end).abs() > 1e-9 * start,
                Some(Trend::Opening) => start > end * (1.0 + 1e-12),
                Some(Trend::Closing) => end > start * (1.0 + 1e-12),
            };
            if wrong {
                faults.push(format!("{:?} from {start} to {end}", piece.trend()));
            }
        }
    }
    if axis.side == Side::Interior {
        let area: f64 = all.iter().map(|branch| branch.extent().area).sum();
        if (area - domain.area()).abs() > 1e-9 * domain.area() {
            faults.push(format!("area {area} of {}", domain.area()));
        }
        // Each edge is passed once, from one end to the other.
        let length: f64 = all.iter().map(|b| b.boundary_lengths().iter().sum::<f64>()).sum();
        let whole: f64 = domain.edges().iter().map(|edge| edge.length).sum();
        if (length - whole).abs() > 1e-9 * whole {
            faults.push(format!("boundary {length} of {whole}"));
        }
    }
    faults
}

#[test]
fn branches_of_random_shapes_add_up() {
    let options = domain::Options { regroup: true, ..domain::Options::default() };
    let mut random = Random(801);
    for (family, ground, most) in [
        (Family::Tangle, Ground::Square, 40),
        (Family::Tangle, Ground::Grid(9), 20),
        (Family::Holes, Ground::Grid(30), 40),
        (Family::Triangles, Ground::Grid(4), 20),
        (Family::Squares, Ground::Grid(4), 20),
    ] {
        let mut tried = 0;
        while tried < 60 {
            let polygons = random::large_shape(&mut random, family, ground, most);
            let Ok(domain) = Domain::from_polygons(&polygons, &options) else { continue };
            tried += 1;
            for axis in both_sides(&domain, Engine::PathTracing, None, &Options::default()).unwrap()
            {
                let found = faults(&domain, &axis);
                assert!(found.is_empty(), "{}: {found:#?}", shapes::to_wkt(&polygons));
            }
        }
    }
}

fn limbs_of(text: &str, least: f64) -> (Vec<Limb>, Vec<Limb>) {
    let domain = shapes::wkt(text);
    let [inside, outside] =
        both_sides(&domain, Engine::PathTracing, None, &Options::default()).unwrap();
    let of = |axis: &MedialAxis| limbs(&domain, axis, Measure::RelativeExcess, least).unwrap();
    (of(&inside), of(&outside))
}

#[test]
fn arms_are_peninsulas_and_the_room_between_them_is_bays() {
    // A plus with arms 3 long and 1 wide.
    let plus = "POLYGON ((3 0, 4 0, 4 3, 7 3, 7 4, 4 4, 4 7, 3 7, 3 4, 0 4, 0 3, 3 3, 3 0))";
    // Its own corners are no limbs, nor are the right angles between the arms, unless they are to be.
    let (peninsulas, none) = limbs_of(plus, 0.5);
    let (all, bays) = limbs_of(plus, 0.4);
    assert_eq!((peninsulas.len(), none.len(), all.len(), bays.len()), (4, 0, 8, 4));
    for limb in &peninsulas {
        // From the middle of the plus to the end of an arm.
        // The last disk that is left does not quite reach it.
        assert!((limb.length - 3.5).abs() < 0.06 && limb.straightness > 0.999, "{limb:?}");
        let axis_aligned = limb.direction.x.abs().max(limb.direction.y.abs());
        assert!(axis_aligned > 0.999 && (limb.radius(1.0) - 0.5).abs() < 1e-9);
    }
    for bay in &bays {
        // From the corner to the chord between two arms: 3/√2 away.
        let depth = (bay.tip - bay.mouth).norm();
        assert!((depth - 3.0 / 2.0_f64.sqrt()).abs() < 1e-6, "{bay:?}");
        assert!(bay.mouth_width() > 2.0);
    }
}

#[test]
fn a_key_fits_its_lock_and_no_other() {
    let lock = "POLYGON ((0 0, 10 0, 10 8, 6 8, 6 3, 4 3, 4 8, 0 8, 0 0))";
    let (_, bays) = limbs_of(lock, 0.5);
    // Turned by a quarter: 1.9 wide, 5 long beyond its handle.
    let key = "POLYGON ((0 0, 3 0, 3 1.05, 8 1.05, 8 2.95, 3 2.95, 3 4, 0 4, 0 0))";
    let (peninsulas, _) = limbs_of(key, 0.5);
    let pairs = limb_pairs(&peninsulas, &bays);
    assert!(!pairs.is_empty());
    let best = pairs[0];
    assert!(best.fill > 0.85 && best.gap < 0.2, "{best:?}");
    // Where it says, the blade lies within the notch: its end is near the bottom, its sides inside.
    let (sin, cos) = best.turn.sin_cos();
    let moved = |x: f64, y: f64| {
        let p = Point::new(x, y);
        p * cos + p.perp() * sin + best.shift
    };
    for (x, y) in [(8.0, 1.05), (8.0, 2.95), (4.0, 1.05), (4.0, 2.95)] {
        let p = moved(x, y);
        assert!(p.x > 4.0 - 1e-9 && p.x < 6.0 + 1e-9 && p.y > 2.9, "{p:?}");
    }
    let end = moved(8.0, 2.0);
    assert!((end.y - 3.0).abs() < 0.3, "{end:?}");
    // A blade that is too wide.
    let (wide, _) = limbs_of("POLYGON ((0 0, 9 0, 9 2.2, 0 2.2, 0 0))", 0.5);
    assert_eq!(limb_pairs(&wide, &bays), []);
}

#[test]
fn what_a_blade_sticks_out_of_stays_outside_of_a_deeper_notch() {
    let deep = "POLYGON ((20 0, 32 0, 32 10, 27.1 10, 27.1 4, 24.9 4, 24.9 10, 20 10, 20 0))";
    let tab = "POLYGON ((0 0, 10 0, 10 4, 6 4, 6 9, 4 9, 4 4, 0 4, 0 0))";
    let ((peninsulas, _), (_, bays)) = (limbs_of(tab, 0.5), limbs_of(deep, 0.5));
    let pairs = limb_pairs(&peninsulas, &bays);
    let into = pairs.iter().find(|pair| peninsulas[pair.peninsula].tip.y > 8.0).unwrap();
    // Last disks do not quite reach the boundary, here and there by as much.
    assert!((into.gap - 1.0).abs() < 0.02 && (into.depth - 5.0).abs() < 0.15, "{into:?}");
    // Turned by half, its shoulders at height 4 are at the mouth, at height 10.
    assert!(
        (into.turn.abs() - std::f64::consts::PI).abs() < 1e-9 && (into.shift.y - 14.0).abs() < 1e-9,
        "{into:?}"
    );
}

#[test]
fn the_distance_of_boundaries_is_that_of_the_farthest_points() {
    let square = |low: f64, high: f64| {
        vec![
            [(low, low), (high, low), (high, high), (low, high)]
                .map(|(x, y)| Point::new(x, y))
                .to_vec(),
        ]
    };
    // The middle of the inner square is as far from nothing: boundaries only.
    assert_eq!(boundary_distance(&square(0.0, 8.0), &square(0.0, 8.0), 1e-9), 0.0);
    let inner = boundary_distance(&square(0.0, 8.0), &square(1.0, 7.0), 1e-9);
    assert!((inner - 2.0_f64.sqrt()).abs() <= 1e-9);
    // A notch: its bottom is 3 from the straight edge; corners alone would say less.
    let notched = [(0., 0.), (8., 0.), (8., 8.), (5., 8.), (4., 5.), (3., 8.), (0., 8.)];
    let notched = vec![notched.map(|(x, y)| Point::new(x, y)).to_vec()];
    let one = boundary_distance(&square(0.0, 8.0), &notched, 1e-6);
    assert!((one - 3.0).abs() < 1e-5, "{one}");
    assert_eq!(boundary_distance(&[], &square(0.0, 1.0), 1e-9), f64::INFINITY);
}

#[test]
fn primitives_of_a_sampled_axis_say_what_its_radii_do() {
    let mut seen = [0; 3];
    for name in ["plus_of_unit_squares", "triangle_3_4_5", "comb_with_three_unit_teeth"] {
        let domain = shapes::domain(name);
        let options = Options { cell: Some(0.013), ..Options::default() };
        let axis = interior(&domain, Engine::RasterTransform, &options).unwrap();
        for branch in branches(&axis).iter() {
            let mut last = None;
            for piece in branch.pieces() {
                let kind = (piece.primitive(), piece.trend());
                assert_ne!(last, Some(kind), "{name}");
                last = Some(kind);
                let growths: Vec<f64> =
                    piece.curves().map(|curve| curve.radius_to() - curve.radius_from()).collect();
                let (k, holds): (usize, fn(f64) -> bool) = match kind {
                    (Primitive::Worm, None) => (0, |growth| growth == 0.0),
                    (Primitive::Wedge, Some(Trend::Opening)) => (1, |growth| growth >= 0.0),
                    (Primitive::Wedge, Some(Trend::Closing)) => (2, |growth| growth <= 0.0),
                    other => panic!("{name}: {other:?}"),
                };
                assert!(growths.iter().all(|&growth| holds(growth)), "{name}: {growths:?}");
                assert!(k == 0 || growths.iter().any(|&growth| growth != 0.0), "{name}");
                let length: f64 = piece.curves().map(|curve| curve.length()).sum();
                assert!((length - piece.extent().length).abs() < 1e-9, "{name}");
                seen[k] += 1;
            }
        }
    }
    assert!(seen.iter().all(|&n| n > 0), "{seen:?}");
}
