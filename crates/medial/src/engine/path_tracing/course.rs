use crate::geom::{Governor, Point, TouchingDisk, cross_directions};

/// The bisector of a right and a left governor, run through forwards from a disk on it.
///
/// Everything here is in doubles and only proposes; decisions are made elsewhere.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course {
    start: Point,
    radius: f64,
    right: Governor,
    left: Governor,
    /// What moves along: see [`Motion`].
    motion: Motion,
}

/// What the position on a path measures.
#[derive(Clone, Copy, Debug)]
enum Motion {
    /// The way of the centre along a line, and the growth of the radius with it.
    Line { direction: Point, growth: f64 },
    /// The way of the footpoint along the edge that governs on the right, or backwards along the
    /// one on the left; and where on it the start lies.
    Foot { edge: Governor, other: Governor, forward: f64, at: f64 },
}

impl Course {
    pub(super) fn new(right: Governor, left: Governor, start: Point, radius: f64) -> Self {
        let motion = match (right, left) {
            (
                Governor::Edge { start: a, end: b, direction: t },
                Governor::Edge { start: c, end: d, direction: u },
            ) => {
                let (difference, sum) = (t - u, (t + u).perp());
                let sine = u.cross(t);
                // The forward direction is that of `difference`; where that cancels, the sign of
                // the turn tells on which side the lines meet.
                let (direction, growth) = if difference.norm2() >= sum.norm2() {
                    let length = difference.norm();
                    (difference * (1.0 / length), sine / length)
                } else {
                    let length = sum.norm();
                    let sign = if cross_directions(c, d, a, b) < 0.0 { -1.0 } else { 1.0 };
                    (sum * (sign / length), sign * length / 2.0)
                };
                Motion::Line { direction, growth }
            }
            (Governor::Corner(p), Governor::Corner(q)) => {
                let w = q - p;
                Motion::Line { direction: -w.perp() * (1.0 / w.norm()), growth: f64::NAN }
            }
            (edge @ Governor::Edge { start: a, direction, .. }, other) => {
                Motion::Foot { edge, other, forward: 1.0, at: direction.dot(start - a) }
            }
            (other, edge @ Governor::Edge { start: a, direction, .. }) => {
                Motion::Foot { edge, other, forward: -1.0, at: direction.dot(start - a) }
            }
        };
        Self { start, radius, right, left, motion }
    }

    /// How far ahead of the start a centre lies.
    pub(super) fn position(&self, disk: &TouchingDisk) -> f64 {
        match self.motion {
            Motion::Line { direction, .. } => {
                direction.dot(disk.centre + (disk.origin - self.start))
            }
            Motion::Foot { edge, forward, at, .. } => {
                let Governor::Edge { start, direction, .. } = edge else { return 0.0 };
                forward * (direction.dot(disk.centre + (disk.origin - start)) - at)
            }
        }
    }

    /// The disk of the path at a position, if the bisector reaches it.
    pub(super) fn disk_at(&self, position: f64) -> Option<TouchingDisk> {
        let (origin, centre, radius) = match self.motion {
            Motion::Line { direction, growth } => {
                let centre = direction * position;
                let radius = match (self.right, self.left) {
                    (Governor::Corner(p), Governor::Corner(_)) => {
                        (centre + (self.start - p)).norm()
                    }
                    _ => self.radius + growth * position,
                };
                (self.start, centre, radius)
            }
            Motion::Foot { edge, other, forward, at } => {
                let Governor::Edge { start, direction, .. } = edge else { return None };
                let Governor::Corner(q) = other else { return None };
                let foot = direction * (at + forward * position);
                let normal = direction.perp();
                let w = (q - start) - foot;
                let radius = w.norm2() / (2.0 * normal.dot(w));
                (start, foot + normal * radius, radius)
            }
        };
        let sound = radius > 0.0 && radius.is_finite();
        sound.then_some(TouchingDisk { origin, centre, radius, bound: f64::INFINITY })
    }
}
