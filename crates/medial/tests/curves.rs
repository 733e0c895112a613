//! Shapes with curves: what their axes are, known in closed form, comes out of flattened ones.

mod support;

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use medial::axis::{Engine, KeypointKind, MedialAxis};
use medial::domain::{Curves, Domain, Options, Piece, PieceEnd};
use medial::engine::{Options as EngineOptions, exterior, path_tracing};
use medial::geom::Point;
use medial::ops::{Hierarchy, Measure, Pruned};

/// A ring under construction, with its curves.
struct Drawing {
    tolerance: f64,
    points: Vec<Point>,
    edges: Vec<u32>,
    pieces: Vec<Piece>,
}

impl Drawing {
    fn new(tolerance: f64) -> Self {
        Self { tolerance, points: Vec::new(), edges: Vec::new(), pieces: Vec::new() }
    }

    /// A straight edge from here.
    fn line(&mut self, x: f64, y: f64) {
        self.points.push(Point::new(x, y));
        self.edges.push(Curves::STRAIGHT);
    }

    /// A quarter or so of an ellipse, from one parameter to another one.
    fn arc(&mut self, centre: (f64, f64), [a, b]: [f64; 2], [from, to]: [f64; 2]) {
        let largest = a.max(b) * a.max(b) / a.min(b);
        let step = 2.0 * (1.0 - self.tolerance / largest).acos();
        let n = ((to - from).abs() / step).ceil().max(1.0);
        let sense = (to - from).signum();
        let end = |t: f64| {
            let (sin, cos) = t.sin_cos();
            let way = Point::new(-a * sin, b * cos) * sense;
            let curvature = sense * a * b / way.norm().powi(3);
            PieceEnd { tangent: way * (1.0 / way.norm()), curvature }
        };
        let piece = self.pieces.len() as u32;
        self.pieces.push(Piece { start: end(from), end: end(to) });
        for k in 0..n as u32 {
            let (sin, cos) = (from + (to - from) * f64::from(k) / n).sin_cos();
            self.points.push(Point::new(centre.0 + a * cos, centre.1 + b * sin));
            self.edges.push(piece);
        }
    }

    fn axis(self) -> (Domain, Vec<Vec<Vec<Point>>>, Curves, MedialAxis) {
        let Self { tolerance, points, edges, pieces } = self;
        let polygons = vec![vec![points]];
        let curves = Curves { tolerance, pieces, edges: vec![vec![edges]] };
        let domain = Domain::from_polygons(&polygons, &Options::default()).unwrap();
        let axis = path_tracing(&domain).unwrap();
        (domain, polygons, curves, axis)
    }

    fn smooth(self) -> MedialAxis {
        let tolerance = self.tolerance;
        let (domain, polygons, curves, axis) = self.axis();
        let hierarchy = Hierarchy::new(&domain, &axis).unwrap();
        let pruned = hierarchy.without_artefacts(&polygons, &curves, None);
        assert!(!pruned.axis.complete);
        check_parts(&axis, &pruned, tolerance);
        pruned.axis
    }
}

/// Parts are parts, and no more is lost than flattening may have moved, but for the bend of a curve.
fn check_parts(axis: &MedialAxis, pruned: &Pruned, tolerance: f64) {
    for origin in &pruned.origins {
        let [low, high] = origin.part;
        assert!(0.0 <= low && low < high && high <= 1.0);
        assert!(origin.path < axis.paths().len() as u32);
    }
    // A disk in place of an arc misses the corners of its polyline.
    assert!(pruned.error <= 2.0 * tolerance, "{} {tolerance}", pruned.error);
}

fn tips(axis: &MedialAxis) -> Vec<(Point, f64)> {
    let tips = axis.keypoints().iter().filter(|k| k.kind == KeypointKind::Tip);
    tips.map(|k| (k.position, k.radius)).collect()
}

fn ends(axis: &MedialAxis) -> usize {
    axis.keypoints().iter().filter(|k| k.kind == KeypointKind::End).count()
}

fn near(found: &[(Point, f64)], expected: &[(f64, f64, f64)], within: f64) {
    assert_eq!(found.len(), expected.len(), "{found:?}");
    for &(x, y, r) in expected {
        let off =
            |&(p, radius): &(Point, f64)| (p - Point::new(x, y)).norm().max((radius - r).abs());
        let least = found.iter().map(off).fold(f64::INFINITY, f64::min);
        assert!(least <= within, "{least}: {found:?}: {x} {y} {r}");
    }
}

const TOLERANCES: [f64; 3] = [1e-2, 1e-3, 1e-5];

#[test]
fn a_circle_leaves_its_centre() {
    for tolerance in TOLERANCES {
        for pieces in [1, 2, 4] {
            let mut drawing = Drawing::new(tolerance);
            for k in 0..pieces {
                let at = |k: i32| TAU * f64::from(k) / f64::from(pieces);
                drawing.arc((7.0, -3.0), [2.0, 2.0], [at(k), at(k + 1)]);
            }
            let axis = drawing.smooth();
            assert_eq!(axis.paths().len(), 0);
            near(&tips(&axis), &[(7.0, -3.0, 2.0)], 2.0 * tolerance);
        }
    }
}

#[test]
fn an_ellipse_leaves_the_segment_between_centres_of_curvature() {
    for tolerance in TOLERANCES {
        for clockwise in [false, true] {
            let (a, b) = (5.0, 3.0);
            let mut drawing = Drawing::new(tolerance);
            for k in 0..4 {
                let at = |k: f64| if clockwise { -FRAC_PI_2 * k } else { FRAC_PI_2 * k };
                drawing.arc((0.0, 0.0), [a, b], [at(f64::from(k)), at(f64::from(k) + 1.0)]);
            }
            let axis = drawing.smooth();
            let tip = (a * a - b * b) / a;
            // Where the radius grows slowly, flattening moves the tip more.
            let within = 4.0 * (tolerance * a).sqrt();
            near(&tips(&axis), &[(-tip, 0.0, b * b / a), (tip, 0.0, b * b / a)], within);
            let off = axis.keypoints().iter().map(|k| k.position.y.abs());
            assert!(off.fold(0.0, f64::max) <= 2.0 * tolerance);
            assert!(axis.keypoints().iter().all(|k| k.kind != KeypointKind::Junction));
        }
    }
}

#[test]
fn a_stadium_leaves_a_segment() {
    for tolerance in TOLERANCES {
        let mut drawing = Drawing::new(tolerance);
        drawing.line(0.0, -1.0);
        drawing.arc((4.0, 0.0), [1.0, 1.0], [-FRAC_PI_2, FRAC_PI_2]);
        drawing.line(4.0, 1.0);
        drawing.arc((0.0, 0.0), [1.0, 1.0], [FRAC_PI_2, 3.0 * FRAC_PI_2]);
        let axis = drawing.smooth();
        near(&tips(&axis), &[(0.0, 0.0, 1.0), (4.0, 0.0, 1.0)], 4.0 * tolerance);
        let length: f64 = axis.paths().iter().map(|p| axis.curve(&p).length()).sum();
        assert!((length - 4.0).abs() <= 8.0 * tolerance, "{length}");
    }
}

fn rounded_rectangle(tolerance: f64, r: f64) -> Drawing {
    let mut drawing = Drawing::new(tolerance);
    let corners: [(f64, f64); 4] = [(8.0, 0.0), (8.0, 5.0), (0.0, 5.0), (0.0, 0.0)];
    let centre = |k: usize| {
        let (x, y) = corners[k];
        (x.clamp(r, 8.0 - r), y.clamp(r, 5.0 - r))
    };
    for k in 0..4 {
        // From where the arc before ends.
        let (c, t) = (centre((k + 3) % 4), FRAC_PI_2 * (k as f64 - 1.0));
        drawing.line(c.0 + r * t.cos(), c.1 + r * t.sin());
        let t = FRAC_PI_2 * (k as f64 - 1.0);
        drawing.arc(centre(k), [r, r], [t, t + FRAC_PI_2]);
    }
    drawing
}

#[test]
fn a_rounded_rectangle_has_one_tip_a_fillet() {
    for tolerance in TOLERANCES {
        for r in [0.5, 2.0] {
            let axis = rounded_rectangle(tolerance, r).smooth();
            let expected = [(r, r, r), (r, 5.0 - r, r), (8.0 - r, r, r), (8.0 - r, 5.0 - r, r)];
            near(&tips(&axis), &expected, 8.0 * tolerance);
            assert_eq!(ends(&axis), 0);
            let junctions =
                axis.keypoints().iter().filter(|k| k.kind == KeypointKind::Junction).count();
            assert_eq!(junctions, 2, "{tolerance} {r}");
        }
    }
}

#[test]
fn corners_keep_their_branches() {
    // A quarter of a disk: three corners, one of them between two straight edges.
    for tolerance in TOLERANCES {
        let mut drawing = Drawing::new(tolerance);
        drawing.line(0.0, 0.0);
        drawing.arc((0.0, 0.0), [3.0, 3.0], [0.0, FRAC_PI_2]);
        drawing.line(0.0, 3.0);
        let axis = drawing.smooth();
        assert_eq!((ends(&axis), tips(&axis).len()), (3, 0));
        let r = 3.0 / (1.0 + 2.0_f64.sqrt());
        let near = axis.keypoints().iter().map(|k| (k.position - Point::new(r, r)).norm());
        assert!(near.fold(f64::INFINITY, f64::min) <= 4.0 * tolerance);
    }
}

#[test]
fn a_bump_between_corners_ends_in_its_centre() {
    // A keyhole: most of a disk on a slot, with corners where they meet.
    let tolerance = 1e-4;
    let (half, r): (f64, f64) = (0.4, 1.0);
    let t = (half / r).asin();
    let mut drawing = Drawing::new(tolerance);
    drawing.line(-half, -4.0);
    drawing.line(half, -4.0);
    drawing.arc((0.0, 0.0), [r, r], [-FRAC_PI_2 + t, PI + FRAC_PI_2 - t]);
    drawing.line(-half, -(r * r - half * half).sqrt());
    let axis = drawing.smooth();
    assert_eq!(ends(&axis), 2);
    near(&tips(&axis), &[(0.0, 0.0, r)], 50.0 * tolerance);
}

#[test]
fn hollow_curves_have_nothing_to_drop_inside_and_all_outside() {
    let tolerance = 1e-3;
    let (domain, polygons, curves, _) = rounded_rectangle(tolerance, 1.0).axis();
    let outside = exterior(&domain, Engine::PathTracing, None, &EngineOptions::default()).unwrap();
    let hierarchy = Hierarchy::new(&domain, &outside).unwrap();
    let pruned = hierarchy.without_artefacts(&polygons, &curves, None);
    assert_eq!(pruned.axis, outside);
}

#[test]
fn a_threshold_counts_as_well() {
    let tolerance = 1e-4;
    let (domain, polygons, curves, axis) = rounded_rectangle(tolerance, 0.5).axis();
    let hierarchy = Hierarchy::new(&domain, &axis).unwrap();
    for measure in [Measure::Excess, Measure::Prominence] {
        let threshold = Some((measure, 0.3));
        let both = hierarchy.without_artefacts(&polygons, &curves, threshold);
        assert_eq!(both.axis, hierarchy.pruned(measure, 0.3).axis);
        let little = hierarchy.without_artefacts(&polygons, &curves, Some((measure, 1e-9)));
        assert_eq!(little.axis, hierarchy.without_artefacts(&polygons, &curves, None).axis);
    }
}

#[test]
fn a_corner_too_flat_to_matter_has_no_branch() {
    // A stadium whose straight sides are bent by 3 degrees in the middle.
    let tolerance = 1e-2;
    let mut drawing = Drawing::new(tolerance);
    let bend: f64 = 0.052;
    drawing.line(0.0, -1.0);
    drawing.line(2.0, -1.0 - 2.0 * (0.5 * bend).tan());
    drawing.arc((4.0, 0.0), [1.0, 1.0], [-FRAC_PI_2, FRAC_PI_2]);
    drawing.line(4.0, 1.0);
    drawing.arc((0.0, 0.0), [1.0, 1.0], [FRAC_PI_2, 3.0 * FRAC_PI_2]);
    let axis = drawing.smooth();
    assert_eq!((ends(&axis), tips(&axis).len()), (0, 2));
    assert!(axis.keypoints().iter().all(|k| k.kind != KeypointKind::Junction));
}

/// A convex polygon around the origin with some of its corners rounded, by its corners and radii.
fn rounded(tolerance: f64, corners: &[Point], radii: &[f64]) -> Drawing {
    let mut drawing = Drawing::new(tolerance);
    let n = corners.len();
    for k in 0..n {
        let (a, p, b) = (corners[(k + n - 1) % n], corners[k], corners[(k + 1) % n]);
        let unit = |v: Point| v * (1.0 / v.norm());
        let (into, out) = (unit(p - a), unit(b - p));
        let turn = into.cross(out).atan2(into.dot(out));
        let r = radii[k];
        if r == 0.0 {
            drawing.line(p.x, p.y);
            continue;
        }
        let off = r * (0.5 * turn).tan();
        let start = p - into * off;
        let centre = start + into.perp() * r;
        let from = (-into.perp().y).atan2(-into.perp().x);
        drawing.arc((centre.x, centre.y), [r, r], [from, from + turn]);
        let end = p + out * off;
        drawing.line(end.x, end.y);
    }
    drawing
}

/// The boundary from one governor on to another one: the vertices between them.
fn between(domain: &Domain, left: u32, right: u32) -> Vec<u32> {
    let mut vertices = vec![domain.edge(left).next];
    while *vertices.last().unwrap() != right {
        vertices.push(domain.edge(*vertices.last().unwrap()).next);
    }
    vertices
}

/// What is dropped, asked disk by disk and vertex by vertex.
#[test]
fn what_is_dropped_is_what_the_rules_allow() {
    let mut random = support::random::Random(71);
    let mut dropped = 0;
    for _ in 0..200 {
        let n = 3 + random.below(5) as usize;
        let corners: Vec<Point> = (0..n)
            .map(|k| {
                let t = TAU * (k as f64 + 0.3 * random.unit()) / n as f64;
                Point::new(10.0 * t.cos(), 10.0 * t.sin())
            })
            .collect();
        let radii: Vec<f64> =
            (0..n).map(|_| if random.below(3) == 0 { 0.0 } else { 0.2 + random.unit() }).collect();
        let tolerance = [1e-2, 1e-3][random.below(2) as usize];
        let drawing = rounded(tolerance, &corners, &radii);
        let (domain, polygons, curves, axis) = drawing.axis();
        let hierarchy = Hierarchy::new(&domain, &axis).unwrap();
        let pruned = hierarchy.without_artefacts(&polygons, &curves, None);
        // Convex, so that every governor is an edge.
        let edge_of = |site: u32| {
            let site = axis.sites().iter().nth(site as usize).unwrap();
            (0..domain.edges().len() as u32).find(|&e| domain.edge(e).start == site.a).unwrap()
        };
        let mut kept = vec![[1.0, 0.0]; axis.paths().len()];
        pruned.origins.iter().for_each(|origin| kept[origin.path as usize] = origin.part);
        for (path, [low, high]) in axis.paths().iter().zip(kept) {
            let (left, right) = (edge_of(path.left), edge_of(path.right));
            let curve = axis.curve(&path);
            for u in (0..=20).map(|k| f64::from(k) / 20.0).filter(|&u| u < low || u > high) {
                let (centre, radius) = (curve.point_at(u), curve.radius_at(u));
                let is_allowed = |vertices: &[u32]| {
                    // Two straight edges meet in a corner; an arc has all others.
                    let piece = |edge: u32| curves.piece_of(&domain.origin(edge));
                    let bends = vertices.iter().map(|&v| {
                        let pieces = [piece(domain.edge(v).prev), piece(v)];
                        pieces.into_iter().flatten().next()
                    });
                    let bends: Option<Vec<u32>> = bends.collect();
                    let by_bend = bends.is_some_and(|pieces| {
                        let bend = |&p: &u32| curves.pieces[p as usize].start.curvature;
                        let most = pieces.iter().map(bend).fold(0.0, f64::max);
                        radius <= 1.0 / most + 1e-9
                    });
                    let far = vertices.iter().map(|&v| (domain.edge(v).start - centre).norm());
                    by_bend || far.fold(0.0, f64::max) - radius <= tolerance * (1.0 + 1e-5)
                };
                let sides = [between(&domain, left, right), between(&domain, right, left)];
                assert!(sides.iter().any(|side| is_allowed(side)), "{u} {corners:?} {radii:?}");
                dropped += 1;
            }
        }
        // And what is left ends in true corners and in the middles of fillets.
        let n_corners = radii.iter().filter(|&&r| r == 0.0).count();
        assert_eq!(ends(&pruned.axis), n_corners, "{corners:?} {radii:?}");
        assert_eq!(tips(&pruned.axis).len(), n - n_corners, "{corners:?} {radii:?}");
    }
    assert!(dropped > 10_000);
}
