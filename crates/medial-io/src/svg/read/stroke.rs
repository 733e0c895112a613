//! The outlines of strokes.

use super::shape::Subpath;
use crate::curves::{Arc, Contour, Segment};
use kurbo::{BezPath, Cap, Join, PathEl, Stroke, StrokeOpts};
use medial::geom::Point;
use std::f64::consts::{FRAC_PI_8, TAU};

/// How a stroke is drawn.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Pen {
    pub width: f64,
    pub join: Join,
    pub miter_limit: f64,
    pub cap: Cap,
    pub dashes: Vec<f64>,
    pub dash_offset: f64,
}

/// Most dashes of a path.
const MOST_DASHES: f64 = 1e5;

/// Largest ratio of a coordinate and the width.
const MOST_LENGTH: f64 = 1e9;

/// Length of a dash that has none, as a share of the width.
const DOT_LENGTH: f64 = 1e-6;

/// How far what is an arc of a cap or a join may be off one, as a share of its radius.
///
/// It makes up for rounding only.
const ARC_ERROR: f64 = 1e-9;

/// How far an outline of a stroke may be off, as a share of the box of its line.
const STROKE_ERROR: f64 = 1e-6;

/// The outline of a stroke.
#[derive(Debug, Default)]
pub(super) struct Outline {
    /// What it covers is what these go around (nonzero).
    pub contours: Vec<Contour>,
    /// Whether its dashes are too many to be followed.
    pub is_solid: bool,
}

/// The outline of a stroke along parts of a path, or why there is none.
pub(super) fn outline(parts: &[Subpath], pen: &Pen) -> Result<Outline, String> {
    if let Some(contours) = rings(parts, pen) {
        return Ok(Outline { contours, is_solid: false });
    }
    let mut line = BezPath::new();
    let mut dots = Vec::new();
    for part in parts {
        match part.is_point() {
            true => dots.extend(dot(part.contour.start, pen)),
            false => append(&mut line, part),
        }
    }
    let (mut most, mut is_finite) = (0.0_f64, true);
    let mut length: f64 = 0.0;
    let mut last: Option<kurbo::Point> = None;
    for element in line.elements() {
        for p in points(element) {
            most = most.max(p.x.abs()).max(p.y.abs());
            is_finite &= p.is_finite();
            length += last.map_or(0.0, |last| p.distance(last));
            last = Some(p);
        }
    }
    if !is_finite || most > MOST_LENGTH * pen.width {
        return Err("its stroke is too thin for its size, or a coordinate is no number".to_owned());
    }
    let size = kurbo::Shape::bounding_box(&line);
    let tolerance = STROKE_ERROR * size.width().max(size.height()).max(pen.width);
    let mut stroke = Stroke::new(pen.width)
        .with_join(pen.join)
        .with_miter_limit(pen.miter_limit)
        .with_caps(pen.cap);
    let period: f64 = pen.dashes.iter().sum();
    let is_solid = period > 0.0 && length * pen.dashes.len() as f64 / period > MOST_DASHES;
    if period > 0.0 && !is_solid {
        stroke = stroke.with_dashes(pen.dash_offset, dashes(pen));
    }
    let outline = kurbo::stroke(line, &stroke, &StrokeOpts::default(), tolerance);
    let mut contours = contours(outline.elements(), 0.5 * pen.width);
    contours.extend(dots);
    Ok(Outline { contours, is_solid })
}

/// The dashes of a pen; those without length, of which caps make dots, get a little of the gap behind them, as
/// the other crate draws none.
fn dashes(pen: &Pen) -> Vec<f64> {
    let mut dashes = pen.dashes.clone();
    if pen.cap != Cap::Butt {
        for pair in dashes.chunks_exact_mut(2) {
            let length = DOT_LENGTH * pen.width;
            if pair[0] == 0.0 && pair[1] > length {
                (pair[0], pair[1]) = (length, pair[1] - length);
            }
        }
    }
    dashes
}

/// What a pen draws of a part without length: its caps.
fn dot(at: Point, pen: &Pen) -> Option<Contour> {
    let r = 0.5 * pen.width;
    match pen.cap {
        Cap::Butt => None,
        Cap::Round => {
            let arcs = Arc::around(at, Point::new(r, 0.0), Point::new(0.0, r), 0.0, TAU);
            let start = arcs[0].start;
            Some(Contour { start, segments: arcs.into_iter().map(Segment::Arc).collect() })
        }
        Cap::Square => {
            let corner = |x: f64, y: f64| at + Point::new(x * r, y * r);
            let mut square = Contour::new(corner(-1.0, -1.0));
            [(1.0, -1.0), (1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0)]
                .iter()
                .for_each(|&(x, y)| square.line_to(corner(x, y)));
            Some(square)
        }
    }
}

/// The outline of full circles, as circles.
fn rings(parts: &[Subpath], pen: &Pen) -> Option<Vec<Contour>> {
    if !pen.dashes.is_empty() {
        return None;
    }
    let mut rings = Vec::new();
    for part in parts {
        let mut arcs = Vec::new();
        for segment in &part.contour.segments {
            let Segment::Arc(arc) = segment else { return None };
            arcs.push(*arc);
        }
        let first = arcs.first()?;
        let radius = first.u.norm();
        let is_round = |a: &Arc| {
            a.centre == first.centre && a.u == first.u && a.v == first.v && a.v == a.u.perp()
        };
        if !part.closed || first.start != arcs[arcs.len() - 1].end || !arcs.iter().all(is_round) {
            return None;
        }
        for (radius, inner) in [(radius + 0.5 * pen.width, false), (radius - 0.5 * pen.width, true)]
        {
            if radius > 0.0 {
                let (u, v) = (Point::new(radius, 0.0), Point::new(0.0, radius));
                let sweep = TAU * if inner { -1.0 } else { 1.0 };
                let arcs = Arc::around(first.centre, u, v, 0.0, sweep);
                let start = arcs[0].start;
                let segments = arcs.into_iter().map(Segment::Arc).collect();
                rings.push(Contour { start, segments });
            }
        }
    }
    Some(rings)
}

fn append(line: &mut BezPath, part: &Subpath) {
    let place = |p: Point| kurbo::Point::new(p.x, p.y);
    line.move_to(place(part.contour.start));
    for segment in &part.contour.segments {
        match segment {
            Segment::Line(to) => line.line_to(place(*to)),
            Segment::Bezier(curve) => match curve.control_points()[..] {
                [_, a, b] => line.quad_to(place(a), place(b)),
                [_, a, b, c] => line.curve_to(place(a), place(b), place(c)),
                _ => line.line_to(place(curve.end())),
            },
            Segment::Arc(arc) => {
                // Cubics of at most an eighth of π, which are off by 6e-8 of the radius.
                let n = (arc.sweep.abs() / FRAC_PI_8).ceil().clamp(1.0, 16.0) as usize;
                let step = arc.sweep / n as f64;
                let reach = 4.0 / 3.0 * (0.25 * step).tan();
                for k in 0..n {
                    let (s0, c0) = (arc.from + step * k as f64).sin_cos();
                    let (s1, c1) = (arc.from + step * (k + 1) as f64).sin_cos();
                    let at = |s: f64, c: f64| arc.centre + arc.u * c + arc.v * s;
                    let along = |s: f64, c: f64| (arc.v * c - arc.u * s) * reach;
                    let end = if k + 1 == n { arc.end } else { at(s1, c1) };
                    let first = at(s0, c0) + along(s0, c0);
                    line.curve_to(place(first), place(at(s1, c1) - along(s1, c1)), place(end));
                }
            }
        }
    }
    if part.closed {
        line.close_path();
    }
}

fn points(element: &PathEl) -> Vec<kurbo::Point> {
    match *element {
        PathEl::MoveTo(a) | PathEl::LineTo(a) => vec![a],
        PathEl::QuadTo(a, b) => vec![a, b],
        PathEl::CurveTo(a, b, c) => vec![a, b, c],
        PathEl::ClosePath => Vec::new(),
    }
}

/// The contours of a path of the other crate, with its cubics for arcs of this radius, which are caps and
/// joins, as arcs.
fn contours(elements: &[PathEl], radius: f64) -> Vec<Contour> {
    let place = |p: kurbo::Point| Point::new(p.x, p.y);
    let mut contours: Vec<Contour> = Vec::new();
    for element in elements {
        if let PathEl::MoveTo(p) = element {
            contours.push(Contour::new(place(*p)));
        }
        let Some(contour) = contours.last_mut() else { continue };
        match *element {
            PathEl::MoveTo(_) | PathEl::ClosePath => {}
            PathEl::LineTo(p) => contour.line_to(place(p)),
            PathEl::QuadTo(a, b) => contour.curve_to([place(a), place(b)]),
            PathEl::CurveTo(a, b, c) => {
                let points = [contour.end(), place(a), place(b), place(c)];
                match arc(points, radius) {
                    Some(arc) => add_arc(contour, arc),
                    None => contour.curve_to([points[1], points[2], points[3]]),
                }
            }
        }
    }
    contours
}

/// How far apart centres may be that are one.
fn slack(at: Point, radius: f64) -> f64 {
    let rounding = 64.0 * f64::EPSILON * at.x.abs().max(at.y.abs());
    (ARC_ERROR * radius).max(rounding.min(1e-4 * radius))
}

/// The arc of a circle that a cubic stands for, if it has the arms for one of this radius.
fn arc([start, a, b, end]: [Point; 4], radius: f64) -> Option<Arc> {
    let (first, last) = (a - start, end - b);
    let (arm, other) = (first.norm(), last.norm());
    let sweep = first.cross(last).atan2(first.dot(last));
    let expected = 4.0 / 3.0 * (0.25 * sweep.abs()).tan() * radius;
    let slack = slack(start, radius);
    if sweep == 0.0 || (arm - expected).abs() > slack || (other - expected).abs() > slack {
        return None;
    }
    // Short arms tell directions worse.
    let side = radius.copysign(sweep);
    let centre = start + first.perp() * (side / arm);
    let again = end + last.perp() * (side / other);
    if (centre - again).norm() > slack * (radius / arm).max(1.0) {
        return None;
    }
    let at = start - centre;
    let (u, v) = (Point::new(radius, 0.0), Point::new(0.0, radius));
    Some(Arc { centre, u, v, from: at.y.atan2(at.x), sweep, start, end })
}

/// Adds an arc, which may go on where the last one ends.
fn add_arc(contour: &mut Contour, arc: Arc) {
    let slack = slack(arc.start, arc.u.x);
    if let Some(Segment::Arc(last)) = contour.segments.last_mut()
        && (last.centre - arc.centre).norm() <= 1e3 * slack
        && last.sweep * arc.sweep > 0.0
        && (last.sweep + arc.sweep).abs() < 0.999 * TAU
    {
        last.sweep += arc.sweep;
        last.end = arc.end;
        return;
    }
    contour.segments.push(Segment::Arc(arc));
}
