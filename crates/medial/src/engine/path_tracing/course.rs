use crate::geom::{Governor, Point, TouchingDisk, cross_directions};

/// The bisector of a right and a left governor, run through forwards from a disk on it.
///
/// Everything here is in doubles and only proposes; decisions are made elsewhere.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course {
    start: Point,
    motion: Motion,
}

/// What the position on a path measures.
#[derive(Clone, Copy, Debug)]
enum Motion {
    /// Between two edges: the way of the centre along a line; the radius at the start, and its growth
    /// on the way.
    Line { direction: Point, radius: f64, growth: f64 },
    /// Between two corners: the way of the centre along a line, and one of the corners.
    Middle { direction: Point, corner: Point },
    /// Between an edge and a corner: the way of the footpoint along the edge, forwards on the right
    /// and backwards on the left; the start of the edge, and where on it the way begins.
    Foot { from: Point, direction: Point, corner: Point, forward: f64, at: f64 },
}

impl Course {
    pub(super) fn new(right: &Governor, left: &Governor, start: Point, radius: f64) -> Self {
        let motion = match (right, left) {
            (
                &Governor::Edge { start: a, end: b, direction: t },
                &Governor::Edge { start: c, end: d, direction: u },
            ) => {
                let (difference, sum) = (t - u, (t + u).perp());
                let sine = u.cross(t);
                // The forward direction is that of `difference`; where that cancels, the sign of
                // the turn tells on which side the lines meet.
                let (direction, growth) = if difference.norm2() >= sum.norm2() {
                    let inverse = 1.0 / difference.norm();
                    (difference * inverse, sine * inverse)
                } else {
                    let length = sum.norm();
                    let sign = if cross_directions(c, d, a, b) < 0.0 { -1.0 } else { 1.0 };
                    (sum * (sign / length), sign * length / 2.0)
                };
                Motion::Line { direction, radius, growth }
            }
            (&Governor::Corner(p), &Governor::Corner(q)) => {
                let w = q - p;
                Motion::Middle { direction: -w.perp() * (1.0 / w.norm()), corner: p }
            }
            (&Governor::Edge { start: from, direction, .. }, &Governor::Corner(corner)) => {
                let at = direction.dot(start - from);
                Motion::Foot { from, direction, corner, forward: 1.0, at }
            }
            (&Governor::Corner(corner), &Governor::Edge { start: from, direction, .. }) => {
                let at = direction.dot(start - from);
                Motion::Foot { from, direction, corner, forward: -1.0, at }
            }
        };
        Self { start, motion }
    }

    /// How far ahead of the start a centre lies.
    #[inline]
    pub(super) fn position(&self, disk: &TouchingDisk) -> f64 {
        match self.motion {
            Motion::Line { direction, .. } | Motion::Middle { direction, .. } => {
                direction.dot(disk.centre + (disk.origin - self.start))
            }
            Motion::Foot { from, direction, forward, at, .. } => {
                forward * (direction.dot(disk.centre + (disk.origin - from)) - at)
            }
        }
    }

    /// The disk of the path at a position, if the bisector reaches it.
    pub(super) fn disk_at(&self, position: f64) -> Option<TouchingDisk> {
        let (origin, centre, radius) = match self.motion {
            Motion::Line { direction, radius, growth } => {
                (self.start, direction * position, radius + growth * position)
            }
            Motion::Middle { direction, corner } => {
                let centre = direction * position;
                (self.start, centre, (centre + (self.start - corner)).norm())
            }
            Motion::Foot { from, direction, corner, forward, at } => {
                let foot = direction * (at + forward * position);
                let normal = direction.perp();
                let w = (corner - from) - foot;
                let radius = w.norm2() / (2.0 * normal.dot(w));
                (from, foot + normal * radius, radius)
            }
        };
        let sound = radius > 0.0 && radius.is_finite();
        sound.then_some(TouchingDisk { origin, centre, radius, bound: f64::INFINITY })
    }
}
