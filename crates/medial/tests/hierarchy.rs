//! Significance and pruning: closed forms, and random shapes against the judge and the distances that
//! are promised.

mod support;

use std::f64::consts::{PI, SQRT_2};

use medial::axis::{Engine, MedialAxis, Side};
use medial::check;
use medial::domain::{self, Domain};
use medial::engine::{self, exterior, path_tracing};
use medial::geom::Point;
use medial::ops::{Hierarchy, HierarchyError, Measure};
use support::random::{self, Family, Ground, Random};
use support::shapes;

const RECTANGLE: &str = "POLYGON ((0 0, 6 0, 6 2, 0 2, 0 0))";

#[test]
fn the_values_on_a_rectangle_are_those_of_the_formulas() {
    let domain = shapes::wkt(RECTANGLE);
    let axis = path_tracing(&domain).unwrap();
    let hierarchy = Hierarchy::new(&domain, &axis).unwrap();
    let keypoints = axis.keypoints();
    let is_at = |k: u32, x: f64, y: f64| keypoints.at(k).position == Point::new(x, y);
    let path = |a: (f64, f64), b: (f64, f64)| {
        let joins = |p: &medial::axis::Path| is_at(p.from, a.0, a.1) && is_at(p.to, b.0, b.1);
        axis.paths().iter().position(|p| joins(&p) || joins(&p.reversed())).unwrap()
    };
    let (corner, spine) = (path((0.0, 0.0), (1.0, 1.0)), path((1.0, 1.0), (5.0, 1.0)));
    let bevel = SQRT_2 - 1.0;
    let far = 10_f64.sqrt();
    // From the corner to the end of its path; where the spine starts; in its middle, the root.
    for (measure, on_corner, at_spine, at_root) in [
        (Measure::Excess, [0.0, bevel], bevel, far - 1.0),
        (Measure::RelativeExcess, [bevel, bevel], bevel, far - 1.0),
        (Measure::Prominence, [bevel, bevel], bevel, far - 1.0),
        (Measure::Potential, [0.0, 2.0], 4.0, 8.0),
        (Measure::Chord, [0.0, 2.0 - SQRT_2], 2.0, 6.0),
        (Measure::Circularity, [0.0, 2.0 - PI / 2.0], 4.0 - PI, 8.0 - PI),
        (Measure::Erosion, [0.0, bevel], bevel, bevel + 2.0),
        (Measure::Length, [0.0, SQRT_2], SQRT_2, SQRT_2 + 2.0),
        (Measure::Angle, [PI / 2.0, PI / 2.0], PI, PI),
        (Measure::HalfChord, [0.0, 0.5 * SQRT_2], 1.0, 1.0),
        (Measure::Radius, [0.0, 1.0], 1.0, 1.0),
    ] {
        let values = hierarchy.significance(measure).paths;
        let mut found = [values[corner].start, values[corner].end];
        found.sort_by(f64::total_cmp);
        let close = |a: f64, b: f64| (a - b).abs() < 1e-14;
        assert!(
            close(found[0], on_corner[0]) && close(found[1], on_corner[1]),
            "{measure} {found:?}"
        );
        let span = values[spine];
        assert!(close(span.start, at_spine) && close(span.end, at_spine), "{measure} {span:?}");
        assert!(close(span.most, at_root), "{measure} {span:?}");
    }
}

#[test]
fn a_cut_inside_a_path_lies_where_the_threshold_is_reached() {
    let domain = shapes::wkt(RECTANGLE);
    let axis = path_tracing(&domain).unwrap();
    let hierarchy = Hierarchy::new(&domain, &axis).unwrap();
    // The chain behind x = 2 is 2 + 2 + 2 long.
    let pruned = hierarchy.pruned(Measure::Potential, 6.0);
    let mut places: Vec<f64> = pruned.axis.keypoints().iter().map(|k| k.position.x).collect();
    places.sort_by(f64::total_cmp);
    assert!(places.iter().zip([2.0, 4.0]).all(|(a, b)| (a - b).abs() < 1e-14), "{places:?}");
    assert!((pruned.error - (5_f64.sqrt() - 1.0)).abs() < 1e-14);
    assert_eq!(check::defects(&domain, &pruned.axis).defects, []);
    // Nothing below nothing, all below infinity but the root.
    assert_eq!(hierarchy.pruned(Measure::Potential, 0.0).axis, axis);
    let root = hierarchy.pruned(Measure::Potential, f64::INFINITY);
    let keypoints: Vec<_> = root.axis.keypoints().iter().map(|k| (k.position, k.radius)).collect();
    assert_eq!(keypoints, [(Point::new(3.0, 1.0), 1.0)]);
    assert!((root.error - (10_f64.sqrt() - 1.0)).abs() < 1e-14);
}

#[test]
fn a_neck_counts_where_it_is_narrowest() {
    // Between the corners (2, 1) and (2, 3) footpoints lie opposite one another; before and behind that
    // the angle is smaller.
    let funnel = "POLYGON ((0 0, 2 1, 14 -6, 14 10, 2 3, 0 4, 0 0))";
    let domain = shapes::wkt(funnel);
    let axis = path_tracing(&domain).unwrap();
    let hierarchy = Hierarchy::new(&domain, &axis).unwrap();
    for threshold in [2.5, 3.0, 3.125] {
        let left = hierarchy.pruned(Measure::Angle, threshold).axis;
        let reach = left.keypoints().iter().map(|k| k.position.x).fold(f64::INFINITY, f64::min);
        assert!(reach < 2.0 && reach > 1.0, "{threshold}: {reach}");
    }
    let most = hierarchy.significance(Measure::Angle).paths;
    assert!(most.iter().any(|span| span.most == PI), "{most:?}");
}

#[test]
fn what_a_frame_cuts_never_burns() {
    // The gap of the shallow dent goes far beyond the frame.
    let domain = shapes::wkt("POLYGON ((0 0, 100 0, 100 100, 50 99, 0 100, 0 0))");
    let options = engine::Options::default();
    let outside = exterior(&domain, Engine::PathTracing, None, &options).unwrap();
    assert!(!outside.complete);
    let hierarchy = Hierarchy::new(&domain, &outside).unwrap();
    let pruned = hierarchy.pruned(Measure::Potential, f64::INFINITY).axis;
    assert_eq!(check::defects(&domain, &pruned).defects, []);
    assert!(pruned.keypoints().len() < outside.keypoints().len());
}

#[test]
fn cycles_never_burn() {
    let frame = "POLYGON ((0 0, 9 0, 9 9, 0 9, 0 0), (3 3, 3 6, 6 6, 6 3, 3 3))";
    let domain = shapes::wkt(frame);
    let axis = path_tracing(&domain).unwrap();
    let hierarchy = Hierarchy::new(&domain, &axis).unwrap();
    for &measure in Measure::ALL {
        let pruned = hierarchy.pruned(measure, f64::INFINITY);
        // Four corners are cut off at a disk of radius 3 √2 (√2 - 1) at most.
        let verdict = check::defects(&domain, &pruned.axis);
        assert_eq!(verdict.defects, [], "{measure}");
        assert_eq!((verdict.counts.cycles, verdict.counts.leaves), (1, 0), "{measure}");
        let finite = |values: &medial::ops::Span| values.most.is_finite();
        let values = hierarchy.significance(measure).paths;
        // No larger disk swallows the largest ones, which are those behind the corners.
        let n_finite = if measure == Measure::Scale { 0 } else { 4 };
        assert_eq!(values.iter().filter(|v| finite(v)).count(), n_finite, "{measure}");
    }
}

#[test]
fn only_complete_axes_of_the_domain_are_taken() {
    let domain = shapes::wkt(RECTANGLE);
    let axis = path_tracing(&domain).unwrap();
    let hierarchy = Hierarchy::new(&domain, &axis).unwrap();
    let pruned = hierarchy.pruned(Measure::Excess, 0.3).axis;
    assert_eq!(Hierarchy::new(&domain, &pruned).unwrap_err(), HierarchyError::Incomplete);
    let other = shapes::wkt("POLYGON ((0 0, 7 0, 7 2, 0 2, 0 0))");
    assert!(matches!(Hierarchy::new(&other, &axis), Err(HierarchyError::UnknownSite { .. })));
}

/// Points of an axis with their radii, close to one another.
fn disks(axis: &MedialAxis) -> Vec<(Point, f64)> {
    let mut disks: Vec<_> = axis.keypoints().iter().map(|k| (k.position, k.radius)).collect();
    for path in axis.paths() {
        let curve = axis.curve(&path);
        disks.extend(
            (1..64).map(|k| f64::from(k) / 64.0).map(|u| (curve.point_at(u), curve.radius_at(u))),
        );
    }
    disks
}

/// Components and cycles of an axis.
fn topology(axis: &MedialAxis) -> (usize, usize) {
    let n = axis.keypoints().len();
    let mut group: Vec<usize> = (0..n).collect();
    for _ in 0..n {
        let mut changed = false;
        for path in axis.paths() {
            let (a, b) = (path.from as usize, path.to as usize);
            let least = group[a].min(group[b]);
            changed |= group[a] != least || group[b] != least;
            (group[a], group[b]) = (least, least);
        }
        if !changed {
            break;
        }
    }
    let components = (0..n).filter(|&k| group[k] == k).count();
    (components, axis.paths().len() + components - n)
}

/// What is wrong with pruning the axis of a domain by all measures.
fn faults(domain: &Domain, axis: &MedialAxis) -> Vec<String> {
    let mut faults = Vec::new();
    let hierarchy = Hierarchy::new(domain, axis).unwrap();
    let size =
        domain.edges().iter().map(|e| e.start.x.abs().max(e.start.y.abs())).fold(0.0, f64::max);
    let whole = topology(axis);
    for &measure in Measure::ALL {
        let values = hierarchy.significance(measure).paths;
        let mut all: Vec<f64> = values.iter().map(|v| v.most).filter(|v| v.is_finite()).collect();
        all.sort_by(f64::total_cmp);
        if values.iter().any(|v| v.most < v.start.max(v.end)) {
            faults.push(format!("{measure}: the largest value is not the largest"));
        }
        if faults.len() > 3 {
            break;
        }
        let mut left = Vec::new();
        for share in [0.3, 0.6, 0.9, 1.0] {
            let at = ((all.len() as f64 * share) as usize).min(all.len().saturating_sub(1));
            let Some(&value) = all.get(at) else { continue };
            // Between values, and just above one.
            let threshold = if share == 0.6 { 0.9 * value } else { value.next_up() };
            let pruned = hierarchy.pruned(measure, threshold);
            let what = |why: &str| format!("{measure} below {threshold}: {why}");
            let defects = check::defects(domain, &pruned.axis).defects;
            faults.extend(defects.iter().map(|d| what(&d.to_string())));
            if topology(&pruned.axis) != whole {
                faults.push(what(&format!("{:?} of {whole:?}", topology(&pruned.axis))));
            }
            left.push((threshold, pruned.axis.paths().len()));
            if measure == Measure::Excess && pruned.error > threshold + 1e-14 * size {
                faults.push(what(&format!("error {}", pruned.error)));
            }
            // Every corner is as near to a disk that is left as was said.
            if axis.side == Side::Interior {
                let disks = disks(&pruned.axis);
                for edge in domain.edges() {
                    let away = disks.iter().map(|(c, r)| (edge.start - *c).norm() - r);
                    let least = away.fold(f64::INFINITY, f64::min);
                    if least > pruned.error + 1e-9 * size {
                        faults.push(what(&format!("{:?} is {least} away", edge.start)));
                    }
                }
            }
        }
        left.sort_by(|a, b| a.0.total_cmp(&b.0));
        if !left.is_sorted_by(|a, b| a.1 >= b.1) {
            faults.push(format!("{measure}: paths left above thresholds: {left:?}"));
        }
    }
    faults
}

fn random_shapes(family: Family, ground: Ground, most: u64, seed: u64, count: usize) {
    let mut random = Random(seed);
    let options = domain::Options { regroup: true, ..domain::Options::default() };
    let mut tried = 0;
    for _ in 0..20 * count {
        let polygons = random::large_shape(&mut random, family, ground, most);
        let Ok(domain) = Domain::from_polygons(&polygons, &options) else { continue };
        tried += 1;
        let inside = path_tracing(&domain).unwrap();
        let outside =
            exterior(&domain, Engine::PathTracing, None, &engine::Options::default()).unwrap();
        for axis in [&inside, &outside] {
            let found = faults(&domain, axis);
            assert!(found.is_empty(), "{}: {}: {found:#?}", axis.side, shapes::to_wkt(&polygons));
        }
        if tried == count {
            return;
        }
    }
    panic!("{tried} of {count} shapes are domains");
}

#[test]
fn what_is_left_of_random_shapes_keeps_topology_and_distance() {
    random_shapes(Family::Tangle, Ground::Square, 30, 501, 40);
    random_shapes(Family::Tangle, Ground::Grid(9), 20, 502, 60);
    random_shapes(Family::Holes, Ground::Grid(30), 40, 503, 30);
    random_shapes(Family::Triangles, Ground::Grid(4), 20, 504, 40);
    random_shapes(Family::Squares, Ground::Grid(4), 20, 505, 40);
}

#[test]
fn every_fixture_can_be_pruned() {
    for name in shapes::names() {
        let domain = shapes::domain(&name);
        if domain.edges().len() < 400 {
            let axis = path_tracing(&domain).unwrap();
            assert_eq!(faults(&domain, &axis), Vec::<String>::new(), "{name}");
        }
    }
}

/// When each keypoint burns if the axis is cut into short fuses and all fires go on by one step at a time;
/// nothing where none comes.
fn simulated(axis: &MedialAxis, step: f64) -> Vec<Option<f64>> {
    // The fuses at each node; keypoints come first.
    let mut fuses: Vec<Vec<usize>> = vec![Vec::new(); axis.keypoints().len()];
    for path in axis.paths() {
        let n = (axis.curve(&path).length() / step).round().max(1.0) as usize;
        let mut last = path.from as usize;
        for k in 1..=n {
            let next = if k == n { path.to as usize } else { fuses.len() };
            if next == fuses.len() {
                fuses.push(Vec::new());
            }
            fuses[last].push(next);
            fuses[next].push(last);
            last = next;
        }
    }
    let mut burnt: Vec<Option<f64>> = vec![None; fuses.len()];
    let leaf = |k: usize| k < axis.keypoints().len() && fuses[k].len() == 1;
    let lit_at = |k: usize| axis.keypoints().at(k as u32).radius;
    let mut left: Vec<usize> = fuses.iter().map(Vec::len).collect();
    let mut now = 0.0;
    // What burns next: nodes that were reached by all of their fuses but one.
    let mut fronts: Vec<usize> = Vec::new();
    let mut waiting: Vec<usize> = (0..axis.keypoints().len()).filter(|&k| leaf(k)).collect();
    while !fronts.is_empty() || !waiting.is_empty() {
        let (lit, rest): (Vec<usize>, Vec<usize>) =
            waiting.iter().partition(|&&k| lit_at(k) <= now);
        waiting = rest;
        for k in lit {
            if burnt[k].is_none() {
                burnt[k] = Some(now);
                fronts.push(k);
            }
        }
        now += step;
        let mut next = Vec::new();
        for k in std::mem::take(&mut fronts) {
            let Some(&to) = fuses[k].iter().find(|&&to| burnt[to].is_none()) else { continue };
            left[to] -= 1;
            // A fire that comes from behind finds nothing left to burn.
            if left[to] <= 1 {
                burnt[to] = Some(now);
                next.push(to);
            }
        }
        fronts = next;
    }
    burnt.truncate(axis.keypoints().len());
    burnt
}

#[test]
fn burn_times_are_those_of_a_simulation() {
    let mut compared = 0;
    for name in shapes::names() {
        let domain = shapes::domain(&name);
        let axis = path_tracing(&domain).unwrap();
        let whole: f64 = axis.paths().iter().map(|path| axis.curve(&path).length()).sum();
        if domain.edges().len() > 60 || axis.paths().is_empty() {
            continue;
        }
        let step = whole / 20_000.0;
        let times = simulated(&axis, step);
        let values = Hierarchy::new(&domain, &axis).unwrap().significance(Measure::Erosion).paths;
        // What was rounded away on each path on the way, and a step for each keypoint.
        let slack = step * (axis.paths().len() + axis.keypoints().len()) as f64;
        for (path, value) in axis.paths().iter().zip(values) {
            for (keypoint, thickness) in [(path.from, value.start), (path.to, value.end)] {
                let radius = axis.keypoints().at(keypoint).radius;
                if let (Some(time), true) = (times[keypoint as usize], thickness.is_finite()) {
                    // The value is that of this path, which may burn before its keypoint does.
                    assert!(thickness <= time - radius + slack, "{name}: {thickness} {time}");
                    compared += 1;
                }
            }
            // The end at which the path lights the next one.
            let ends = [(path.from, value.start), (path.to, value.end)];
            let last = ends.iter().filter(|(_, v)| v.is_finite()).map(|(k, v)| {
                times[*k as usize].map(|t| (t - axis.keypoints().at(*k).radius - v).abs())
            });
            if let Some(off) = last.flatten().reduce(f64::min) {
                assert!(off <= slack, "{name}: {off} {slack}");
            }
        }
    }
    assert!(compared > 100, "{compared}");
}
