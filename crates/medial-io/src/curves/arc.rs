//! Arcs of circles and ellipses.

use super::CurveError;
use super::pieces::{Budget, Sink};
use medial::domain::{Piece, PieceEnd};
use medial::geom::Point;
use std::f64::consts::{FRAC_PI_2, PI};

/// An arc of an ellipse: `centre + u·cos t + v·sin t`.
#[derive(Clone, Copy, Debug)]
pub struct Arc {
    /// The centre.
    pub centre: Point,
    /// From the centre to the point with parameter 0.
    pub u: Point,
    /// From the centre to the point with parameter π/2.
    pub v: Point,
    /// The parameter of the start.
    pub from: f64,
    /// By how much the parameter grows, less than a full turn either way.
    pub sweep: f64,
    /// The start as given.
    pub start: Point,
    /// The end as given.
    pub end: Point,
}

/// By how much the axes of an ellipse differ that is a circle but for rounding, as a share of them.
const ROUND: f64 = 1e-12;

impl Arc {
    /// The arc of a circle from `start` to `end` with the tangent of a quarter of its angle, positive
    /// for counterclockwise arcs; `None` if it is no different from the straight line.
    pub fn bulge(start: Point, end: Point, bulge: f64) -> Option<Self> {
        let chord = end - start;
        let radius = chord.norm() * (1.0 + bulge * bulge) / (4.0 * bulge.abs());
        if bulge == 0.0 || !radius.is_finite() || radius == 0.0 {
            return None;
        }
        let middle = start + chord * 0.5;
        let centre = middle + chord.perp() * ((1.0 - bulge * bulge) / (4.0 * bulge));
        let at = start - centre;
        let (u, v) = (Point::new(radius, 0.0), Point::new(0.0, radius));
        Some(Self { centre, u, v, from: at.y.atan2(at.x), sweep: 4.0 * bulge.atan(), start, end })
    }

    /// The arcs that make up a full ellipse or a part of it, each of at most half a turn.
    pub fn around(centre: Point, u: Point, v: Point, from: f64, sweep: f64) -> Vec<Self> {
        let sweep = sweep.clamp(-2.0 * PI, 2.0 * PI);
        let n = (sweep.abs() / PI - 1e-9).ceil().max(1.0) as usize;
        let closed = sweep.abs() == 2.0 * PI;
        let point = |t: f64| centre + turned(u, v, t);
        let place = |k: usize| match k == n {
            true if closed => point(from),
            true => point(from + sweep),
            false => point(from + sweep * (k as f64 / n as f64)),
        };
        let arc = |k: usize| Self {
            centre,
            u,
            v,
            from: from + sweep * (k as f64 / n as f64),
            sweep: sweep / n as f64,
            start: place(k),
            end: place(k + 1),
        };
        (0..n).map(arc).collect()
    }

    pub fn map(&self, map: impl Fn(Point) -> Point, linear: impl Fn(Point) -> Point) -> Self {
        Self {
            centre: map(self.centre),
            u: linear(self.u),
            v: linear(self.v),
            start: map(self.start),
            end: map(self.end),
            ..*self
        }
    }

    /// The same arc the other way round.
    pub fn reversed(&self) -> Self {
        let from = self.from + self.sweep;
        Self { from, sweep: -self.sweep, start: self.end, end: self.start, ..*self }
    }

    /// The same with the axes of the ellipse for `u` and `v`.
    fn principal(&self) -> Self {
        let (u, v) = (self.u, self.v);
        let turn = 0.5 * (2.0 * u.dot(v)).atan2(u.norm2() - v.norm2());
        if turn == 0.0 {
            return *self;
        }
        Self {
            u: turned(u, v, turn),
            v: turned(u, v, turn + FRAC_PI_2),
            from: self.from - turn,
            ..*self
        }
    }

    /// Points that span its box.
    pub(super) fn extremes(&self) -> Vec<Point> {
        let mut extremes = vec![self.start, self.end];
        for (u, v) in [(self.u.x, self.v.x), (self.u.y, self.v.y)] {
            for t in inside(self.from, self.sweep, v.atan2(u), PI) {
                extremes.push(self.centre + turned(self.u, self.v, t));
            }
        }
        extremes
    }

    /// Adds its edges and pieces.
    pub(super) fn flatten(&self, sink: &mut Sink, budget: &mut Budget) -> Result<(), CurveError> {
        // What is as thin as rounding is no curve.
        let area = self.u.cross(self.v);
        let longer = self.u.norm().max(self.v.norm());
        if area.abs() <= 1e-15 * longer * longer || self.sweep == 0.0 {
            sink.line(self.end);
            return Ok(());
        }
        let (a, b) = (self.u.norm(), self.v.norm());
        let is_round = (a - b).abs() <= ROUND * a && self.u.dot(self.v).abs() <= ROUND * a * b;
        if is_round {
            let sweep = self.sweep * area.signum();
            return circle(self.start, self.end, 0.5 * (a + b), sweep, self.centre, sink, budget);
        }
        self.principal().quarters(sink, budget)
    }

    /// Adds the parts between the axes, each a piece.
    fn quarters(&self, sink: &mut Sink, budget: &mut Budget) -> Result<(), CurveError> {
        // Where it starts and ends at an axis but for rounding, there is no part before or behind it.
        let near = 1e-9 * self.sweep.abs().min(1.0);
        let last = self.from + self.sweep;
        let mut cuts = inside(self.from, self.sweep, 0.0, FRAC_PI_2);
        cuts.retain(|t| (t - self.from).abs() > near && (t - last).abs() > near);
        cuts.push(last);
        let mut from = self.from;
        let mut start = None;
        for to in cuts {
            let start_end = start.unwrap_or_else(|| self.end_at(from));
            let end = self.end_at(to);
            start = Some(end);
            sink.piece(Piece { start: start_end, end });
            let place = |t: f64| self.centre + turned(self.u, self.v, t);
            let mut ahead = vec![(from, to)];
            while let Some((from, to)) = ahead.pop() {
                let n = (self.sagitta(from, to) / budget.tolerance).sqrt().ceil();
                budget.afford(n)?;
                if n <= 1.0 || (to - from).abs() <= 1e-15 * to.abs() {
                    budget.spend(1)?;
                    sink.curved(if to == last { self.end } else { place(to) });
                    continue;
                }
                let parts = if n <= 5.0 { n as usize } else { 2 };
                let cut = |k: usize| match k == parts {
                    true => to,
                    false => from + (to - from) * (k as f64 / parts as f64),
                };
                ahead.extend((0..parts).rev().map(|k| (cut(k), cut(k + 1))));
            }
            from = to;
        }
        Ok(())
    }

    /// The largest distance between the arc within a quarter and its chord: where the tangent is parallel
    /// to it, which is in the middle, as it is for the circle whose image it is.
    fn sagitta(&self, from: f64, to: f64) -> f64 {
        let half = 0.5 * (to - from);
        let (sin, cos) = (from + half).sin_cos();
        let along = (self.v * cos - self.u * sin).norm();
        // 1 - cos, without cancellation.
        let height = 2.0 * (0.5 * half).sin().powi(2);
        height * self.u.cross(self.v).abs() / along
    }

    fn end_at(&self, t: f64) -> PieceEnd {
        let (sin, cos) = t.sin_cos();
        let along = (self.v * cos - self.u * sin) * self.sweep.signum();
        let length = along.norm();
        let curvature = self.u.cross(self.v) * self.sweep.signum() / length.powi(3);
        PieceEnd { tangent: along * (1.0 / length), curvature }
    }
}

/// Adds the edges of an arc of a circle as one piece, with chords of equal angles.
fn circle(
    start: Point,
    end: Point,
    radius: f64,
    sweep: f64,
    centre: Point,
    sink: &mut Sink,
    budget: &mut Budget,
) -> Result<(), CurveError> {
    let curvature = sweep.signum() / radius;
    let chord = end - start;
    let length = chord.norm();
    // The direction of the chord; of a full turn, that of the tangent at its start.
    let along = match length > 0.0 && sweep.abs() < 1.9 * PI {
        true => chord * (1.0 / length),
        false => rotated((start - centre).perp() * (sweep.signum() / radius), 0.5 * sweep),
    };
    // So far from the origin that the circle is a point.
    if along.norm().is_nan() || along.norm() < 0.5 {
        return Ok(());
    }
    let tangent = |turn: f64| {
        let way = rotated(along, turn);
        way * (1.0 / way.norm())
    };
    let of = |turn: f64| PieceEnd { tangent: tangent(turn), curvature };
    sink.piece(Piece { start: of(-0.5 * sweep), end: of(0.5 * sweep) });
    // No chord spans more than a quarter of the circle, whatever the tolerance.
    let share = (budget.tolerance / radius).min(1.0);
    // acos(1 - share) without cancellation, times 2.
    let most = (4.0 * (0.5 * share).sqrt().asin()).min(FRAC_PI_2);
    let n = (sweep.abs() / most * (1.0 - 1e-12)).ceil().max(1.0);
    budget.afford(n)?;
    let n = n as usize;
    budget.spend(n)?;
    for k in 1..n {
        let angle = sweep * (k as f64 / n as f64);
        // From the start, by a chord of its own: exact also if the centre is far away.
        let way = rotated(along, 0.5 * (angle - sweep));
        sink.curved(start + way * (2.0 * radius * (0.5 * angle.abs()).sin()));
    }
    sink.curved(end);
    Ok(())
}

/// The parameters `first + k·step` strictly inside of a range, in its order.
fn inside(from: f64, sweep: f64, first: f64, step: f64) -> Vec<f64> {
    let (low, high) = (from.min(from + sweep), from.max(from + sweep));
    let k = ((low - first) / step).floor();
    let n = ((high - low) / step).ceil() as usize + 2;
    let mut found: Vec<f64> =
        (0..n).map(|i| first + (k + i as f64) * step).filter(|t| low < *t && *t < high).collect();
    if sweep < 0.0 {
        found.reverse();
    }
    found
}

fn turned(u: Point, v: Point, t: f64) -> Point {
    let (sin, cos) = t.sin_cos();
    u * cos + v * sin
}

fn rotated(p: Point, angle: f64) -> Point {
    turned(p, p.perp(), angle)
}
