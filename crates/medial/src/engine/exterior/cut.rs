//! Cuts the paths of an axis at a frame.

use super::frame::Frame;
use crate::axis::{Curve, MedialAxis, Site, SiteKind};
use crate::geom::{Double, Point};

/// Steps of Newton's method, from a start that is good to many digits.
const STEPS: usize = 3;

/// Least change of the difference of the two distances along the frame for which a step is of use.
const LEAST_SLOPE: f64 = 1e-9;

/// What of an axis lies inside a frame; numbers are those of the axis.
#[derive(Default)]
pub(super) struct Cut {
    /// Keypoints.
    pub kept: Vec<u32>,
    /// Paths, and parts of paths.
    pub pieces: Vec<Piece>,
    /// Where paths are cut.
    pub ends: Vec<Clipped>,
}

/// A path or a part of one.
pub(super) struct Piece {
    pub from: End,
    pub to: End,
    pub left: u32,
    pub right: u32,
}

/// Where a piece ends.
#[derive(Clone, Copy)]
pub(super) enum End {
    /// In a keypoint of the axis.
    Keypoint(u32),
    /// On the frame: the number of the cut.
    Clipped(u32),
}

/// A point of a path on the frame, with the governors to both sides as seen outwards.
pub(super) struct Clipped {
    pub position: Point,
    pub radius: f64,
    pub left: u32,
    pub right: u32,
}

impl Cut {
    /// What lies inside the frame; that is not governed by any wall.
    pub(super) fn new(frame: &Frame, axis: &MedialAxis, is_wall: impl Fn(u32) -> bool) -> Self {
        let mut inside: Vec<bool> =
            axis.keypoints().iter().map(|k| frame.holds(k.position)).collect();
        loop {
            let cut = Self::with(frame, axis, &is_wall, &inside);
            // A keypoint on the frame may be rounded to its inside, but not all of its paths.
            let mut missing = axis.degrees();
            let ends = cut.pieces.iter().flat_map(|piece| [piece.from, piece.to]);
            for end in ends {
                if let End::Keypoint(keypoint) = end {
                    missing[keypoint as usize] -= 1;
                }
            }
            let before = cut.kept.len();
            for &keypoint in &cut.kept {
                inside[keypoint as usize] = missing[keypoint as usize] == 0;
            }
            if inside.iter().filter(|&&inside| inside).count() == before {
                return cut;
            }
        }
    }

    /// The same, given which keypoints are inside.
    fn with(
        frame: &Frame,
        axis: &MedialAxis,
        is_wall: impl Fn(u32) -> bool,
        inside: &[bool],
    ) -> Self {
        let mut cut = Self::default();
        cut.kept.extend((0..).zip(inside).filter(|&(_, &inside)| inside).map(|(k, _)| k));
        for path in axis.paths() {
            if is_wall(path.left) || is_wall(path.right) {
                continue;
            }
            // One direction, so that rounding is that of any engine.
            let [start, end] = [path.from, path.to].map(|k| axis.keypoints().at(k).position);
            let path = if start.lexicographic(end).is_gt() { path.reversed() } else { path };
            let (left, right) = (path.left, path.right);
            let (from, to) = (End::Keypoint(path.from), End::Keypoint(path.to));
            let [starts, ends] = [path.from, path.to].map(|k| inside[k as usize]);
            let curve = axis.curve(&path);
            let crossings = crossings(frame, &curve);
            if starts && ends && crossings.is_empty() {
                cut.pieces.push(Piece { from, to, left, right });
                continue;
            }
            let governors = axis.path_governors(&path);
            for (u, v) in parts_inside(frame, &curve, crossings) {
                let mut clip = |u: f64, left: u32, right: u32| {
                    let (position, radius) = frame.on_path(&curve, &governors, u);
                    cut.ends.push(Clipped { position, radius, left, right });
                    End::Clipped(cut.ends.len() as u32 - 1)
                };
                // Seen outwards at its start, a path has its sides exchanged.
                let from = if u == 0.0 && starts { from } else { clip(u, right, left) };
                let to = if v == 1.0 && ends { to } else { clip(v, left, right) };
                cut.pieces.push(Piece { from, to, left, right });
            }
        }
        cut
    }
}

/// The parts of a curve inside a frame, between places where it crosses lines of it.
fn parts_inside(frame: &Frame, curve: &Curve, crossings: Vec<f64>) -> Vec<(f64, f64)> {
    let mut parts: Vec<(f64, f64)> = Vec::new();
    let mut u = 0.0;
    for v in crossings.into_iter().chain([1.0]) {
        if frame.holds(curve.point_at(0.5 * (u + v))) {
            match parts.last_mut() {
                // Through a corner of the frame it crosses two lines in one place, but for rounding.
                Some(last) if last.1 == u => last.1 = v,
                _ => parts.push((u, v)),
            }
        }
        u = v;
    }
    parts
}

/// The parameters at which a curve crosses the lines of a frame, in order.
fn crossings(frame: &Frame, curve: &Curve) -> Vec<f64> {
    let (from, to) = (curve.from(), curve.to());
    let middle = curve.control().unwrap_or((from + to) * 0.5);
    let (min, max) = (frame.bounds.min, frame.bounds.max);
    let straight = curve.control().is_none();
    let mut all = Vec::new();
    for ([a, b, c], lines) in
        [([from.x, middle.x, to.x], [min.x, max.x]), ([from.y, middle.y, to.y], [min.y, max.y])]
    {
        for line in lines {
            // a (1 - u)² + 2 b u (1 - u) + c u² = line
            let (square, linear, constant) = (a - 2.0 * b + c, 2.0 * (b - a), a - line);
            let roots = if straight {
                [(line - a) / (c - a), f64::NAN]
            } else {
                let root = (linear * linear - 4.0 * square * constant).sqrt();
                let q = -0.5 * (linear + root.copysign(linear));
                [q / square, constant / q]
            };
            all.extend(roots.into_iter().filter(|u| 0.0 < *u && *u < 1.0));
        }
    }
    all.sort_unstable_by(f64::total_cmp);
    all.dedup();
    all
}

impl Frame {
    /// The point of a path where it crosses the frame, near a parameter, and the radius there.
    fn on_path(&self, curve: &Curve, governors: &[Site; 2], u: f64) -> (Point, f64) {
        let near = curve.point_at(u);
        let (min, max) = (self.bounds.min, self.bounds.max);
        let sides = [
            (true, min.x, near.x),
            (true, max.x, near.x),
            (false, min.y, near.y),
            (false, max.y, near.y),
        ];
        let off = |side: &(bool, f64, f64)| (side.1 - side.2).abs();
        let side = sides.into_iter().min_by(|a, b| off(a).total_cmp(&off(b)));
        let (upright, at, _) = side.unwrap_or((true, near.x, near.x));
        let along = if upright { Point::new(0.0, 1.0) } else { Point::new(1.0, 0.0) };
        let mut t = Double::from(if upright { near.y } else { near.x });
        let place = |t: Double| if upright { (at.into(), t) } else { (t, at.into()) };
        for _ in 0..STEPS {
            let [(l, to_left), (r, to_right)] =
                governors.each_ref().map(|site| distance(site, place(t)));
            let slope = (to_left - to_right).dot(along);
            if slope.abs() < LEAST_SLOPE {
                break;
            }
            t = t - (l - r) / slope.into();
        }
        let (x, y) = place(t);
        (Point::new(x.value(), y.value()), distance(&governors[0], (x, y)).0.value())
    }
}

/// The distance of a point from a governor, or from its line, and the way in which it grows.
fn distance(site: &Site, (x, y): (Double, Double)) -> (Double, Point) {
    let a = site.a;
    let (dx, dy) = (x - a.x.into(), y - a.y.into());
    if site.kind == SiteKind::Vertex {
        let distance = (dx * dx + dy * dy).sqrt();
        return (distance, Point::new(dx.value(), dy.value()) * (1.0 / distance.value()));
    }
    let (ex, ey) = (Double::difference(site.b.x, a.x), Double::difference(site.b.y, a.y));
    let length = (ex * ex + ey * ey).sqrt();
    let across = (ex * dy - ey * dx) / length;
    let grows = Point::new(ex.value(), ey.value()).perp() * (1.0 / length.value());
    if across.value() < 0.0 { (Double::ZERO - across, -grows) } else { (across, grows) }
}
