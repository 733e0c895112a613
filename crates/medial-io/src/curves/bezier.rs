//! Rational Bézier curves of any degree: quadratics and cubics of drawings, and the spans of NURBS.

use super::bernstein::{Polynomial, tidy};
use super::pieces::{Budget, Sink};
use super::{CurveError, distance_to_segment};
use medial::domain::{Piece, PieceEnd};
use medial::geom::Point;

/// A rational Bézier curve.
#[derive(Clone, Debug)]
pub struct Bezier {
    /// Control points times their weights, and the weights, which are positive.
    points: Vec<[f64; 3]>,
    /// Its two ends as given.
    ends: [Point; 2],
}

impl Bezier {
    /// The curve of these control points, at least two.
    pub fn new(points: &[Point]) -> Self {
        let ends = [points[0], points[points.len() - 1]];
        Self { points: points.iter().map(|p| [p.x, p.y, 1.0]).collect(), ends }
    }

    /// The curve of these control points times their weights, and the weights; at least two.
    pub(super) fn rational(points: Vec<[f64; 3]>) -> Self {
        let ends = [projected(points[0]), projected(points[points.len() - 1])];
        Self { points, ends }
    }

    pub fn start(&self) -> Point {
        self.ends[0]
    }

    pub fn end(&self) -> Point {
        self.ends[1]
    }

    /// Takes these places for its ends where they are the same but for rounding.
    pub(super) fn snap(&mut self, start: Option<Point>, end: Option<Point>) {
        for (own, given) in self.ends.iter_mut().zip([start, end]) {
            if let Some(given) = given
                && (*own - given).norm() <= 1e-12 * (own.norm() + given.norm())
            {
                *own = given;
            }
        }
    }

    pub(super) fn set_ends(&mut self, start: Option<Point>, end: Option<Point>) {
        let [a, b] = self.ends;
        self.ends = [start.unwrap_or(a), end.unwrap_or(b)];
    }

    pub(super) fn reversed(&self) -> Self {
        let [a, b] = self.ends;
        Self { points: self.points.iter().rev().copied().collect(), ends: [b, a] }
    }

    pub fn map(&self, map: impl Fn(Point) -> Point) -> Self {
        let ends = self.ends.map(&map);
        let mut points: Vec<[f64; 3]> = self
            .points
            .iter()
            .map(|p| {
                let q = map(projected(*p));
                [q.x * p[2], q.y * p[2], p[2]]
            })
            .collect();
        if let ([first, .., last], [a, b]) = (&mut points[..], ends) {
            *first = [a.x * first[2], a.y * first[2], first[2]];
            *last = [b.x * last[2], b.y * last[2], last[2]];
        }
        Self { points, ends }
    }

    /// Its control points.
    pub(super) fn hull(&self) -> impl Iterator<Item = Point> + '_ {
        self.points.iter().map(|p| projected(*p)).chain(self.ends)
    }

    /// What tells it from other curves between the same ends.
    pub(super) fn between(&self) -> impl Iterator<Item = f64> + '_ {
        let last = self.points.len() - 1;
        let weights = [self.points[0][2], self.points[last][2]];
        self.points[1..last].iter().copied().flatten().chain(weights)
    }

    /// Its control points, the ends included.
    pub fn control_points(&self) -> Vec<Point> {
        self.points.iter().map(|p| projected(*p)).collect()
    }

    fn is_polynomial(&self) -> bool {
        let first = self.points[0][2];
        self.points.iter().all(|p| p[2] == first)
    }

    /// Its coordinates and weights as polynomials, with the start at the origin and about as large as 1.
    fn polynomials(&self) -> Option<[Polynomial; 3]> {
        let origin = self.ends[0];
        let size = self.hull().fold(0.0, |most: f64, p| {
            let p = p - origin;
            most.max(p.x.abs()).max(p.y.abs())
        });
        if size == 0.0 {
            return None;
        }
        let weight = self.points.iter().fold(0.0, |most: f64, p| most.max(p[2]));
        let of = |k: usize| {
            let coefficient = |p: &[f64; 3]| match k {
                0 => (projected(*p).x - origin.x) / size * (p[2] / weight),
                1 => (projected(*p).y - origin.y) / size * (p[2] / weight),
                _ => p[2] / weight,
            };
            Polynomial::new(self.points.iter().map(coefficient).collect())
        };
        Some([of(0), of(1), of(2)])
    }

    /// The derivative of the coordinates, times the square of the weight.
    fn velocity(&self, [x, y, w]: &[Polynomial; 3]) -> [Option<Polynomial>; 2] {
        if self.is_polynomial() {
            return [x, y].map(|c| Some(c.derivative()));
        }
        [x, y].map(|c| {
            Polynomial::sum(&[c.derivative().times(w), c.times(&w.derivative()).scaled(-1.0)])
        })
    }

    /// Points that span its box.
    pub(super) fn extremes(&self) -> Vec<Point> {
        let mut extremes = self.ends.to_vec();
        if let Some(polynomials) = self.polynomials() {
            let roots = self.velocity(&polynomials).into_iter().flatten();
            extremes.extend(roots.flat_map(|velocity| velocity.roots()).map(|t| self.point_at(t)));
        }
        extremes
    }

    pub(super) fn point_at(&self, t: f64) -> Point {
        let mut row = self.points.clone();
        for len in (1..row.len()).rev() {
            for k in 0..len {
                row[k] = between(row[k], row[k + 1], t);
            }
        }
        projected(row[0])
    }

    /// Where its curvature changes its sign, and where it is extreme; nothing for a straight line.
    fn splits(&self) -> Option<[Vec<f64>; 2]> {
        let polynomials = self.polynomials()?;
        let [a, b] = self.velocity(&polynomials);
        let [x, y, w] = &polynomials;
        let nothing = || Polynomial::new(vec![0.0]);
        let (a, b) = (a.unwrap_or_else(nothing), b.unwrap_or_else(nothing));
        // The numerator of the curvature, and what its derivative is made of.
        let bend = if self.is_polynomial() {
            Polynomial::sum(&[a.times(&b.derivative()), b.times(&a.derivative()).scaled(-1.0)])?
        } else {
            wronskian([x, y, w])?
        };
        let speed = Polynomial::sum(&[a.times(&a), b.times(&b)])?;
        let growth = speed.derivative().scaled(-1.5);
        let change = if self.is_polynomial() {
            Polynomial::sum(&[bend.derivative().times(&speed), bend.times(&growth)])
        } else {
            let slope = bend.derivative().times(w).times(&speed);
            let weight = bend.times(&w.derivative()).scaled(3.0).times(&speed);
            Polynomial::sum(&[slope, weight, bend.times(w).times(&growth)])
        };
        Some([bend.roots(), change.map(|c| c.roots()).unwrap_or_default()])
    }

    /// Adds its edges and pieces.
    pub(super) fn flatten(&self, sink: &mut Sink, budget: &mut Budget) -> Result<(), CurveError> {
        let Some([turns, extremes]) = self.splits() else {
            sink.line(self.end());
            return Ok(());
        };
        let places = tidy(turns.iter().chain(&extremes).copied().collect());
        let is_turn = |t: f64| turns.iter().any(|turn| (turn - t).abs() < 1e-7);
        let mut rest = self.clone();
        let mut done = 0.0;
        let mut last: Option<PieceEnd> = None;
        for t in places.iter().copied().chain([1.0]) {
            let piece = if t < 1.0 {
                let (piece, after) = rest.split((t - done) / (1.0 - done));
                rest = after;
                done = t;
                piece
            } else {
                rest.clone()
            };
            let [mut start, mut end] = piece.piece_ends();
            // Both sides of a smooth joint have the same bits.
            if let Some(last) = last
                && last.tangent.dot(start.tangent) > 0.0
            {
                start = last;
            }
            if t < 1.0 && is_turn(t) && end.curvature.is_finite() {
                end.curvature = 0.0;
            }
            last = Some(end);
            sink.piece(Piece { start, end });
            piece.edges(sink, budget)?;
        }
        Ok(())
    }

    /// Adds the edges of a curve without turns.
    fn edges(&self, sink: &mut Sink, budget: &mut Budget) -> Result<(), CurveError> {
        let mut ahead = vec![self.clone()];
        while let Some(curve) = ahead.pop() {
            let n = (curve.deviation() / budget.tolerance).sqrt().ceil();
            if n <= 1.0 {
                budget.spend(1)?;
                sink.curved(curve.end());
                continue;
            }
            budget.afford(n)?;
            // A cut at a time, so that each part is cut by what it needs itself.
            let parts = if n <= 5.0 { n as usize } else { 2 };
            let mut rest = curve;
            let mut cut = Vec::with_capacity(parts);
            for k in (2..=parts).rev() {
                let (part, after) = rest.split(1.0 / k as f64);
                if part.end() == part.start() || part.end() == after.end() {
                    // Doubles are no finer than this.
                    break;
                }
                cut.push(part);
                rest = after;
            }
            if cut.is_empty() {
                budget.spend(1)?;
                sink.curved(rest.end());
                continue;
            }
            cut.push(rest);
            ahead.extend(cut.into_iter().rev());
        }
        Ok(())
    }

    /// A bound for the distance between the curve and its chord.
    fn deviation(&self) -> f64 {
        let [a, b] = self.ends;
        let chord = b - a;
        let length = chord.norm();
        let n = self.points.len() - 1;
        let inner = &self.points[1..n];
        // In the strip between the normals at the ends the distance is that to the line of the chord, a mean
        // of the distances of the control points, in which the ends, with none, have a share.
        let within = |p: Point| {
            let along = (p - a).dot(chord);
            0.0 <= along && along <= length * length
        };
        if length > 0.0 && inner.iter().all(|p| within(projected(*p))) {
            let off = |p: &[f64; 3]| (chord.cross(projected(*p) - a) / length).abs();
            let most = inner.iter().map(off).fold(0.0, f64::max);
            let weight = inner.iter().map(|p| p[2]).fold(0.0, f64::max)
                / f64::min(self.points[0][2], self.points[n][2]);
            let ends = 0.5_f64.powi(n as i32 - 1);
            let share = weight * (1.0 - ends);
            return most * (share / (share + ends));
        }
        inner.iter().map(|p| distance_to_segment(projected(*p), a, b)).fold(0.0, f64::max)
    }

    /// The parts before and after a parameter.
    fn split(&self, t: f64) -> (Self, Self) {
        let mut row = self.points.clone();
        let mut left = vec![row[0]];
        for len in (1..row.len()).rev() {
            for k in 0..len {
                row[k] = between(row[k], row[k + 1], t);
            }
            left.push(row[0]);
        }
        let middle = projected(row[0]);
        let [start, end] = self.ends;
        (Self { points: left, ends: [start, middle] }, Self { points: row, ends: [middle, end] })
    }

    fn piece_ends(&self) -> [PieceEnd; 2] {
        let reversed: Vec<[f64; 3]> = self.points.iter().rev().copied().collect();
        let start = piece_start(&self.points);
        let end = piece_start(&reversed);
        [start, PieceEnd { tangent: end.tangent * -1.0, curvature: -end.curvature }]
    }
}

/// The determinant of the curve in space, its first and its second derivative; `None` if it is zero.
fn wronskian(h: [&Polynomial; 3]) -> Option<Polynomial> {
    let first = h.map(Polynomial::derivative);
    let second = [0, 1, 2].map(|k| first[k].derivative());
    let term = |i: usize, j: usize, k: usize, sign: f64| {
        h[i].times(&first[j]).times(&second[k]).scaled(sign)
    };
    Polynomial::sum(&[
        term(0, 1, 2, 1.0),
        term(1, 2, 0, 1.0),
        term(2, 0, 1, 1.0),
        term(0, 2, 1, -1.0),
        term(1, 0, 2, -1.0),
        term(2, 1, 0, -1.0),
    ])
}

/// The direction and the curvature at the start of a curve.
fn piece_start(points: &[[f64; 3]]) -> PieceEnd {
    let start = projected(points[0]);
    let legs: Vec<Point> = points[1..].iter().map(|p| projected(*p) - start).collect();
    let n = legs.len() as f64;
    let size = legs.iter().map(|leg| leg.norm()).fold(0.0, f64::max);
    // A leg that is only rounding has no direction.
    let Some(first) = legs.iter().position(|leg| leg.norm() > 1e-13 * size) else {
        return PieceEnd { tangent: Point::new(1.0, 0.0), curvature: 0.0 };
    };
    let length = legs[first].norm();
    let tangent = legs[first] * (1.0 / length);
    let aside = |k: usize| legs.get(k).map(|leg| tangent.cross(*leg));
    let curvature = if first == 0 {
        let weights = points[0][2] * points.get(2).map_or(1.0, |p| p[2]) / points[1][2].powi(2);
        (n - 1.0) / n * weights * aside(1).unwrap_or(0.0) / (length * length)
    } else {
        let off = (first + 1..legs.len()).filter_map(aside).find(|a| a.abs() > 1e-13 * size);
        off.map_or(0.0, |off| f64::INFINITY.copysign(off))
    };
    PieceEnd { tangent, curvature }
}

fn projected([x, y, w]: [f64; 3]) -> Point {
    if w == 1.0 { Point::new(x, y) } else { Point::new(x / w, y / w) }
}

fn between(a: [f64; 3], b: [f64; 3], t: f64) -> [f64; 3] {
    [0, 1, 2].map(|k| (1.0 - t) * a[k] + t * b[k])
}
