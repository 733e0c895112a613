//! The outlines of shapes and paths.

use crate::curves::{Arc, Contour, Segment};
use medial::geom::{Point, orient2d};
use std::f64::consts::{FRAC_PI_2, TAU};
use svgtypes::{PathParser, PathSegment};

/// A part of a path that hangs together.
#[derive(Clone, Debug)]
pub(super) struct Subpath {
    pub contour: Contour,
    /// Whether its end is joined to its start; filled it is closed in any case.
    pub closed: bool,
}

impl Subpath {
    fn closed(contour: Contour) -> Self {
        Self { contour, closed: true }
    }

    /// Whether it has no length.
    pub fn is_point(&self) -> bool {
        let is_there = |p: Point| p == self.contour.start;
        self.contour.segments.iter().all(|segment| match segment {
            Segment::Line(to) => is_there(*to),
            Segment::Bezier(curve) => curve.control_points().into_iter().all(is_there),
            Segment::Arc(_) => false,
        })
    }

    /// Whether all of it lies on a straight line, so that it encloses nothing.
    pub fn is_flat(&self) -> bool {
        let start = self.contour.start;
        let mut along = None;
        self.contour.segments.iter().all(|segment| {
            let points = match segment {
                Segment::Line(to) => vec![*to],
                Segment::Bezier(curve) => curve.control_points(),
                Segment::Arc(_) => return false,
            };
            points.into_iter().all(|p| {
                let second = *along.get_or_insert(p);
                if second == start {
                    along = Some(p);
                    return true;
                }
                orient2d(start, second, p) == 0.0
            })
        })
    }
}

/// A rectangle with rounded corners, unless its radii are 0.
pub(super) fn rectangle(at: Point, size: Point, radii: Point) -> Subpath {
    let (low, high) = (at, at + size);
    let (rx, ry) = (radii.x.clamp(0.0, 0.5 * size.x), radii.y.clamp(0.0, 0.5 * size.y));
    let p = Point::new;
    if rx == 0.0 || ry == 0.0 {
        let mut contour = Contour::new(low);
        [p(high.x, low.y), high, p(low.x, high.y), low].iter().for_each(|to| contour.line_to(*to));
        return Subpath::closed(contour);
    }
    let mut contour = Contour::new(p(low.x + rx, low.y));
    let sides = [
        (p(high.x - rx, low.y), p(high.x, low.y + ry), p(high.x - rx, low.y + ry)),
        (p(high.x, high.y - ry), p(high.x - rx, high.y), p(high.x - rx, high.y - ry)),
        (p(low.x + rx, high.y), p(low.x, high.y - ry), p(low.x + rx, high.y - ry)),
        (p(low.x, low.y + ry), p(low.x + rx, low.y), p(low.x + rx, low.y + ry)),
    ];
    for (k, (start, end, centre)) in sides.into_iter().enumerate() {
        contour.line_to(start);
        contour.segments.push(Segment::Arc(Arc {
            centre,
            u: p(rx, 0.0),
            v: p(0.0, ry),
            from: (k as f64 - 1.0) * FRAC_PI_2,
            sweep: FRAC_PI_2,
            start,
            end,
        }));
    }
    Subpath::closed(contour)
}

pub(super) fn ellipse(centre: Point, rx: f64, ry: f64) -> Subpath {
    let arcs = Arc::around(centre, Point::new(rx, 0.0), Point::new(0.0, ry), 0.0, TAU);
    let start = arcs[0].start;
    Subpath::closed(Contour { start, segments: arcs.into_iter().map(Segment::Arc).collect() })
}

/// The points of a polyline; an odd number at the end is left out, as SVG has it.
pub(super) fn polyline(points: &[Point], closed: bool) -> Option<Subpath> {
    let mut contour = Contour::new(*points.first()?);
    points[1..].iter().for_each(|p| contour.line_to(*p));
    Some(Subpath { contour, closed })
}

/// The parts of path data, or why they cannot be read and at which byte.
pub(super) fn path(data: &str) -> Result<Vec<Subpath>, String> {
    let mut drawn = Vec::new();
    let mut pen = Pen { at: Point::default(), start: Point::default(), open: None };
    // Control points that are mirrored: of the last cubic, and the last quadratic.
    let (mut cubic, mut quadratic) = (None, None);
    let mut moved = false;
    for segment in PathParser::from(data) {
        let segment = segment.map_err(|error| error.to_string())?;
        let origin = if segment.is_abs() { Point::default() } else { pen.at };
        let place = |x: f64, y: f64| Point::new(origin.x + x, origin.y + y);
        let is_moved = std::mem::replace(&mut moved, matches!(segment, PathSegment::MoveTo { .. }));
        let (last_cubic, last_quadratic) = (cubic.take(), quadratic.take());
        let mirrored = |p: Option<Point>| p.map_or(pen.at, |p| pen.at + (pen.at - p));
        match segment {
            PathSegment::MoveTo { x, y, .. } => {
                drawn.extend(pen.open.take().map(|contour| Subpath { contour, closed: false }));
                pen.at = place(x, y);
                pen.start = pen.at;
            }
            PathSegment::LineTo { x, y, .. } => pen.draw(|c| c.line_to(place(x, y))),
            PathSegment::HorizontalLineTo { x, .. } => {
                let to = Point::new(origin.x + x, pen.at.y);
                pen.draw(|c| c.line_to(to));
            }
            PathSegment::VerticalLineTo { y, .. } => {
                let to = Point::new(pen.at.x, origin.y + y);
                pen.draw(|c| c.line_to(to));
            }
            PathSegment::CurveTo { x1, y1, x2, y2, x, y, .. } => {
                cubic = Some(place(x2, y2));
                pen.draw(|c| c.curve_to([place(x1, y1), place(x2, y2), place(x, y)]));
            }
            PathSegment::SmoothCurveTo { x2, y2, x, y, .. } => {
                cubic = Some(place(x2, y2));
                let first = mirrored(last_cubic);
                pen.draw(|c| c.curve_to([first, place(x2, y2), place(x, y)]));
            }
            PathSegment::Quadratic { x1, y1, x, y, .. } => {
                quadratic = Some(place(x1, y1));
                pen.draw(|c| c.curve_to([place(x1, y1), place(x, y)]));
            }
            PathSegment::SmoothQuadratic { x, y, .. } => {
                let middle = mirrored(last_quadratic);
                quadratic = Some(middle);
                pen.draw(|c| c.curve_to([middle, place(x, y)]));
            }
            PathSegment::EllipticalArc {
                rx, ry, x_axis_rotation, large_arc, sweep, x, y, ..
            } => {
                let radii = Point::new(rx, ry);
                let turn = x_axis_rotation.to_radians();
                let parts = elliptic(pen.at, place(x, y), radii, turn, (large_arc, sweep));
                pen.draw(|c| c.segments.extend(parts));
            }
            PathSegment::ClosePath { .. } => {
                // A place alone is a part without length.
                let point = is_moved.then(|| Contour::new(pen.at));
                drawn.extend(pen.open.take().or(point).map(Subpath::closed));
                pen.at = pen.start;
            }
        }
    }
    drawn.extend(pen.open.take().map(|contour| Subpath { contour, closed: false }));
    Ok(drawn)
}

struct Pen {
    at: Point,
    /// Where the part began.
    start: Point,
    open: Option<Contour>,
}

impl Pen {
    fn draw(&mut self, draw: impl FnOnce(&mut Contour)) {
        let at = self.at;
        let contour = self.open.get_or_insert_with(|| Contour::new(at));
        draw(contour);
        self.at = contour.end();
    }
}

/// An arc by its ends, as SVG gives it (SVG 2, B.2.4), in parts of at most half a turn.
fn elliptic(
    start: Point,
    end: Point,
    radii: Point,
    turn: f64,
    (large, sweep): (bool, bool),
) -> Vec<Segment> {
    let (mut rx, mut ry) = (radii.x.abs(), radii.y.abs());
    if start == end {
        return Vec::new();
    }
    if rx == 0.0 || ry == 0.0 || !(rx.is_finite() && ry.is_finite() && turn.is_finite()) {
        return vec![Segment::Line(end)];
    }
    let (sin, cos) = turn.sin_cos();
    let (x_axis, y_axis) = (Point::new(cos, sin), Point::new(-sin, cos));
    let half = (start - end) * 0.5;
    let (x, y) = (half.dot(x_axis) / rx, half.dot(y_axis) / ry);
    let reach = (x * x + y * y).sqrt();
    let (mut x, mut y) = (x, y);
    if reach > 1.0 {
        // Radii that are too small grow until the ends are reached.
        (rx, ry) = (rx * reach, ry * reach);
        (x, y) = (x / reach, y / reach);
    }
    let rest = (1.0 / (x * x + y * y) - 1.0).max(0.0).sqrt();
    let side = if large == sweep { -rest } else { rest };
    // On the unit circle: the centre, then both ends seen from it.
    let (cx, cy) = (side * y, -side * x);
    let (u, v) = (x_axis * rx, y_axis * ry);
    let centre = (start + end) * 0.5 + u * cx + v * cy;
    let from = (y - cy).atan2(x - cx);
    let mut angle = (-y - cy).atan2(-x - cx) - from;
    if sweep && angle < 0.0 {
        angle += TAU;
    } else if !sweep && angle > 0.0 {
        angle -= TAU;
    }
    let mut arcs = Arc::around(centre, u, v, from, angle);
    if let Some(first) = arcs.first_mut() {
        first.start = start;
    }
    if let Some(last) = arcs.last_mut() {
        last.end = end;
    }
    arcs.into_iter().map(Segment::Arc).collect()
}
