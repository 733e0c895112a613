use super::*;
use std::f64::consts::{PI, TAU};

/// Numbers that follow from a seed.
struct Draw(u64);

impl Draw {
    fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn point(&mut self) -> Point {
        Point::new(self.number() * 10.0, self.number() * 10.0)
    }

    fn points<const N: usize>(&mut self) -> [Point; N] {
        std::array::from_fn(|_| self.point())
    }
}

fn p(x: f64, y: f64) -> Point {
    Point::new(x, y)
}

/// One contour, its points and the places of its pieces.
fn flat(contour: Contour, tolerance: f64) -> (Vec<Point>, Vec<u32>, Curves) {
    let (mut rings, curves) = flatten(&[vec![contour]], Some(tolerance)).unwrap();
    let mut curves = curves.unwrap();
    (rings[0].remove(0), curves.edges[0].remove(0), curves)
}

/// Tests edges against points that lie on the curve in its order, and gives the number of edges.
fn judged(contour: Contour, tolerance: f64, on_curve: &[Point], what: &str) -> usize {
    let (points, edges, curves) = flat(contour, tolerance);
    assert_eq!(points.len(), edges.len(), "{what}");
    let n = edges.len();
    let edge = |k: usize| (points[k], points[(k + 1) % n]);
    let curved: Vec<usize> = (0..n).filter(|k| edges[*k] != Curves::STRAIGHT).collect();
    for q in on_curve {
        let off = curved
            .iter()
            .map(|k| distance_to_segment(*q, edge(*k).0, edge(*k).1))
            .fold(f64::INFINITY, f64::min);
        assert!(off <= tolerance * (1.0 + 1e-9) + 1e-12, "{what}: {off} at {q:?}");
    }
    // And from the edges to the curve.
    for k in &curved {
        for t in [0.0, 0.25, 0.5, 0.75] {
            let (a, b) = edge(*k);
            let q = a + (b - a) * t;
            let off = on_curve
                .windows(2)
                .map(|w| distance_to_segment(q, w[0], w[1]))
                .fold(f64::INFINITY, f64::min);
            assert!(off <= tolerance * 1.01 + 1e-6, "{what}: edge {k} is {off} away");
        }
    }
    // Edges turn as their pieces say, and pieces have one sign.
    for (number, piece) in (0u32..).zip(&curves.pieces) {
        let (a, b) = (piece.start.curvature, piece.end.curvature);
        assert!(a * b >= 0.0 || (a * b).is_nan(), "{what}: {piece:?}");
        assert!((piece.start.tangent.norm() - 1.0).abs() < 1e-12, "{what}: {piece:?}");
        let own: Vec<usize> = curved.iter().copied().filter(|k| edges[*k] == number).collect();
        assert!(own.windows(2).all(|w| w[1] == w[0] + 1), "{what}: {own:?}");
        let directions: Vec<Point> = std::iter::once(piece.start.tangent)
            .chain(own.iter().map(|k| edge(*k).1 - edge(*k).0))
            .chain([piece.end.tangent])
            .collect();
        let sign = if a == 0.0 { b } else { a };
        for w in directions.windows(2) {
            let turn = w[0].cross(w[1]) * sign.signum() / w[0].norm() / w[1].norm();
            assert!(turn > -1e-7, "{what}: piece {number} turns the other way by {turn}");
        }
    }
    curved.len()
}

fn value(points: &[Point], weights: &[f64], t: f64) -> Point {
    let mut row: Vec<[f64; 3]> =
        points.iter().zip(weights).map(|(q, w)| [q.x * w, q.y * w, *w]).collect();
    for len in (1..row.len()).rev() {
        for k in 0..len {
            row[k] = [0, 1, 2].map(|c| (1.0 - t) * row[k][c] + t * row[k + 1][c]);
        }
    }
    p(row[0][0] / row[0][2], row[0][1] / row[0][2])
}

const SAMPLES: usize = 1500;

fn sampled(of: impl Fn(f64) -> Point) -> Vec<Point> {
    (0..=SAMPLES).map(|k| of(k as f64 / SAMPLES as f64)).collect()
}

/// Curvature by three nearby points grows or falls within each piece of a Bézier curve.
fn monotone(points: &[Point], weights: &[f64], what: &str) {
    let weighted = points.iter().zip(weights).map(|(q, w)| [q.x * w, q.y * w, *w]).collect();
    let curve = Bezier::rational(weighted);
    let mut pieces = Vec::new();
    let mut sink = Sink::new(curve.start(), &mut pieces);
    let mut budget = Budget::new(1e-4);
    curve.flatten(&mut sink, &mut budget).unwrap();
    let (flat, edges) = (sink.points, sink.edges);
    for (number, piece) in (0u32..).zip(&pieces) {
        let own: Vec<usize> = (0..edges.len()).filter(|k| edges[*k] == number).collect();
        let at = |k: usize| (flat[k + 1] - flat[k], flat[k]);
        // The circle through three points on the curve has a curvature that is taken between them.
        let between: Vec<f64> = own
            .windows(2)
            .map(|w| {
                let ((a, _), (b, _)) = (at(w[0]), at(w[1]));
                2.0 * a.cross(b) / (a.norm() * b.norm() * (a + b).norm())
            })
            .collect();
        let (from, to) = (piece.start.curvature, piece.end.curvature);
        let slack = 1e-3 * from.abs().max(to.abs()).min(1e3) + 1e-6;
        for k in &between {
            assert!(
                from.min(to) - slack <= *k && *k <= from.max(to) + slack,
                "{what}: piece {number}: {k} is not between {from} and {to}"
            );
        }
    }
}

#[test]
fn random_bezier_curves_keep_the_tolerance() {
    let mut draw = Draw(1);
    for k in 0..60 {
        let tolerance = [0.5, 1e-2, 1e-3][k % 3];
        let start = draw.point();
        let [a, b] = draw.points();
        let mut quadratic = Contour::new(start);
        quadratic.curve_to([a, b]);
        let on = sampled(|t| value(&[start, a, b], &[1.0; 3], t));
        judged(quadratic, tolerance, &on, &format!("quadratic {k}"));
        monotone(&[start, a, b], &[1.0; 3], &format!("quadratic {k}"));
        let [a, b, c] = draw.points();
        let mut cubic = Contour::new(start);
        cubic.curve_to([a, b, c]);
        let on = sampled(|t| value(&[start, a, b, c], &[1.0; 4], t));
        judged(cubic, tolerance, &on, &format!("cubic {k}"));
        monotone(&[start, a, b, c], &[1.0; 4], &format!("cubic {k}"));
    }
}

#[test]
fn random_rational_curves_keep_the_tolerance() {
    let mut draw = Draw(2);
    for k in 0..40 {
        let points: [Point; 5] = draw.points();
        let weights: [f64; 5] = std::array::from_fn(|_| 0.3 + draw.number() * 2.0);
        let degree = 2 + k % 3;
        let (points, weights) = (&points[..=degree], &weights[..=degree]);
        let spline = Nurbs {
            degree,
            knots: [vec![0.0; degree + 1], vec![1.0; degree + 1]].concat(),
            points: points.to_vec(),
            weights: weights.to_vec(),
        };
        let beziers = spline.beziers().unwrap();
        let contour = Contour {
            start: points[0],
            segments: beziers.into_iter().map(Segment::Bezier).collect(),
        };
        assert_eq!(contour.end(), points[degree]);
        let on = sampled(|t| value(points, weights, t));
        judged(contour, 1e-2, &on, &format!("rational {k}"));
        monotone(points, weights, &format!("rational {k}"));
    }
}

#[test]
fn splines_are_the_same_curve_as_bezier_curves() {
    // By the recursion of Cox and de Boor.
    fn basis(knots: &[f64], k: usize, p: usize, t: f64) -> f64 {
        if p == 0 {
            return f64::from(knots[k] <= t && t < knots[k + 1]);
        }
        let part = |low: f64, high: f64, at: f64| if high > low { at / (high - low) } else { 0.0 };
        part(knots[k], knots[k + p], t - knots[k]) * basis(knots, k, p - 1, t)
            + part(knots[k + 1], knots[k + p + 1], knots[k + p + 1] - t)
                * basis(knots, k + 1, p - 1, t)
    }
    let mut draw = Draw(3);
    let points: [Point; 7] = draw.points();
    let weights: Vec<f64> = (0..7).map(|_| 0.5 + draw.number()).collect();
    for knots in [
        vec![0., 0., 0., 0., 1., 2., 2., 5., 5., 5., 5.],
        vec![0., 0.5, 1., 2., 3., 4.5, 5., 6., 8., 9., 11.],
    ] {
        let spline = Nurbs { degree: 3, knots, points: points.to_vec(), weights: weights.clone() };
        let spans: Vec<[f64; 2]> =
            spline.knots[3..=7].windows(2).filter(|w| w[0] < w[1]).map(|w| [w[0], w[1]]).collect();
        let curves = spline.beziers().unwrap();
        assert_eq!(curves.len(), spans.len());
        for (curve, [low, high]) in curves.iter().zip(spans) {
            for s in [0.1, 0.5, 0.9] {
                let t = low + s * (high - low);
                let (mut sum, mut total) = (p(0.0, 0.0), 0.0);
                for (k, q) in points.iter().enumerate() {
                    let b = basis(&spline.knots, k, 3, t) * weights[k];
                    sum = sum + *q * b;
                    total += b;
                }
                let expected = sum * (1.0 / total);
                assert!((curve.point_at(s) - expected).norm() < 1e-12);
            }
        }
        assert!(curves.windows(2).all(|w| w[0].end() == w[1].start()));
    }
}

#[test]
fn random_arcs_keep_the_tolerance() {
    let mut draw = Draw(4);
    for k in 0..60 {
        let [a, b] = draw.points();
        let bulge = (draw.number() - 0.5) * [0.1, 2.0, 20.0][k % 3];
        let arc = Arc::bulge(a, b, bulge).unwrap();
        let on = sampled(|t| {
            let angle = arc.from + t * arc.sweep;
            arc.centre + p(angle.cos(), angle.sin()) * arc.u.norm()
        });
        assert!((on[0] - a).norm() < 1e-9 && (on[SAMPLES] - b).norm() < 1e-9);
        let mut contour = Contour::new(a);
        contour.bulge_to(b, bulge);
        let n = judged(contour, 1e-2, &on, &format!("arc {k}"));
        let share = (1e-2 / arc.u.norm()).min(1.0);
        let most = (2.0 * (1.0 - share).acos()).min(PI / 2.0);
        assert_eq!(n, (arc.sweep.abs() / most).ceil() as usize, "arc {k}");
    }
}

#[test]
fn random_ellipses_keep_the_tolerance() {
    let mut draw = Draw(5);
    for k in 0..60 {
        let [centre, u, v] = draw.points();
        let (u, v) = (u - p(5.0, 5.0), (v - p(5.0, 5.0)) * [1.0, 0.01][k % 2]);
        let (from, sweep) = (draw.number() * 9.0 - 4.0, (draw.number() - 0.5) * 2.0 * TAU);
        let arcs = Arc::around(centre, u, v, from, sweep);
        let contour = Contour {
            start: arcs[0].start,
            segments: arcs.iter().map(|arc| Segment::Arc(*arc)).collect(),
        };
        let on = sampled(|t| {
            let (sin, cos) = (from + t * sweep).sin_cos();
            centre + u * cos + v * sin
        });
        judged(contour, [1e-2, 1e-3][k % 2], &on, &format!("ellipse {k}"));
    }
}

#[test]
fn a_circle_is_two_pieces_of_one_curvature() {
    let arcs = Arc::around(p(1.0, 2.0), p(2.0, 0.0), p(0.0, 2.0), 0.0, TAU);
    let segments = arcs.iter().map(|arc| Segment::Arc(*arc)).collect();
    let (points, edges, curves) = flat(Contour { start: arcs[0].start, segments }, 1e-3);
    assert_eq!(curves.pieces.len(), 2);
    assert!(curves.pieces.iter().all(|q| q.start.curvature == 0.5 && q.end.curvature == 0.5));
    assert_eq!(edges.iter().filter(|k| **k == 0).count() * 2, points.len());
    assert_eq!(points[0], p(3.0, 2.0));
    // A rational spline that is a circle has one piece as well.
    let root = 0.5_f64.sqrt();
    let quarter = Nurbs {
        degree: 2,
        knots: vec![0., 0., 0., 1., 1., 1.],
        points: vec![p(1.0, 0.0), p(1.0, 1.0), p(0.0, 1.0)],
        weights: vec![1.0, root, 1.0],
    };
    let segments = quarter.beziers().unwrap().into_iter().map(Segment::Bezier).collect();
    let (_, _, curves) = flat(Contour { start: p(1.0, 0.0), segments }, 1e-3);
    assert_eq!(curves.pieces.len(), 1);
    assert!((curves.pieces[0].start.curvature - 1.0).abs() < 1e-12, "{curves:?}");
}

#[test]
fn cubics_are_cut_at_inflections_and_cusps() {
    let mut s = Contour::new(p(0.0, 0.0));
    s.curve_to([p(1.0, 1.0), p(1.0, -1.0), p(2.0, 0.0)]);
    let (_, _, curves) = flat(s, 1e-3);
    // An inflection in the middle and an extreme on either side.
    assert_eq!(curves.pieces.len(), 4, "{curves:?}");
    assert_eq!((curves.pieces[1].end.curvature, curves.pieces[2].start.curvature), (0.0, 0.0));
    let mut cusp = Contour::new(p(0.0, 0.0));
    cusp.curve_to([p(1.0, 1.0), p(0.0, 1.0), p(1.0, 0.0)]);
    let (points, _, curves) = flat(cusp, 1e-3);
    assert!(points.iter().any(|q| (*q - p(0.5, 0.75)).norm() < 1e-6), "{points:?}");
    let before: Vec<_> = curves.pieces.iter().map(|q| q.end.tangent).collect();
    assert!(before.iter().any(|t| t.y > 0.99), "{before:?}");
}

#[test]
fn ends_are_the_doubles_as_given() {
    let [a, b, c] = [p(0.1, 0.2), p(0.3, 0.7), p(1.0 / 3.0, -0.1)];
    let mut contour = Contour::new(a);
    contour.curve_to([p(0.0, 0.5), b]);
    contour.bulge_to(c, -0.3);
    let (points, edges, _) = flat(contour, 1e-3);
    assert_eq!(points[0], a);
    assert!(points.contains(&b));
    assert_eq!((points[points.len() - 1], edges[edges.len() - 1]), (c, Curves::STRAIGHT));
}

#[test]
fn straight_curves_are_lines_and_repeated_points_are_none() {
    let mut contour = Contour::new(p(0.0, 0.0));
    contour.curve_to([p(1.0, 0.0), p(2.0, 0.0), p(3.0, 0.0)]);
    contour.line_to(p(3.0, 0.0));
    contour.curve_to([p(3.0, 0.0), p(3.0, 0.0)]);
    contour.bulge_to(p(0.0, 3.0), 0.0);
    contour.line_to(p(0.0, 0.0));
    let (points, edges, curves) = flat(contour, 1e-3);
    assert_eq!(points, [p(0.0, 0.0), p(3.0, 0.0), p(0.0, 3.0)]);
    assert!(edges.iter().all(|k| *k == Curves::STRAIGHT) && curves.pieces.is_empty());
}

#[test]
fn the_tolerance_is_a_share_of_the_box() {
    let arcs = Arc::around(p(0.0, 0.0), p(5.0, 0.0), p(0.0, 2.0), 0.3, TAU);
    let segments = arcs.iter().map(|arc| Segment::Arc(*arc)).collect();
    let contour = Contour { start: arcs[0].start, segments };
    let curves = flatten(&[vec![contour]], None).unwrap().1.unwrap();
    assert!((curves.tolerance - 1e-3).abs() < 1e-15, "{}", curves.tolerance);
}

#[test]
fn absurd_curves_are_refused() {
    let circle = |radius: f64, tolerance: f64| {
        let arcs = Arc::around(p(0.0, 0.0), p(radius, 0.0), p(0.0, radius), 0.0, TAU);
        let segments = arcs.iter().map(|arc| Segment::Arc(*arc)).collect();
        let contour = Contour { start: arcs[0].start, segments };
        flatten(&[vec![contour]], Some(tolerance)).err().map(|error| error.to_string())
    };
    assert_eq!(circle(1.0, 1e-3), None);
    let error = circle(1.0, 1e-15).unwrap();
    assert!(error.starts_with("its curves take more than 4194304 edges at a tolerance of"));
    assert!(circle(1e9, 1e-300).unwrap().ends_with("take a larger one with --tolerance"));
    assert!(circle(f64::NAN, 1.0).unwrap().starts_with("a coordinate of a curve is NaN"));
    assert!(circle(1e300, 1.0).is_some());
    let mut cubic = Contour::new(p(0.0, 0.0));
    cubic.curve_to([p(1e-300, 1e120), p(-1e130, 1.0), p(3.0, f64::MIN_POSITIVE)]);
    assert!(flatten(&[vec![cubic.clone()]], Some(1e-280)).is_err());
    let (rings, _) = flatten(&[vec![cubic]], None).unwrap();
    assert!(rings[0][0].len() < 10_000);
    let tiny = |x: f64, y: f64| p(x * 1e-300, y * 1e-300);
    let mut small = Contour::new(tiny(0.0, 0.0));
    small.curve_to([tiny(1.0, 2.0), tiny(3.0, -1.0), tiny(4.0, 0.0)]);
    let (rings, curves) = flatten(&[vec![small]], None).unwrap();
    assert!(rings[0][0].len() < 1000 && curves.unwrap().pieces.len() == 4);
}
