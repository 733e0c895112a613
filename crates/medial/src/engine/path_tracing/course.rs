use crate::geom::{Governor, Point, TouchingDisk, cross_directions};

/// The bisector of a right and a left governor, run through forwards from a disk on it.
///
/// The position on it is the way of the centre along the line between two governors of a kind; else
/// the way of the footpoint along the edge, forwards on the right and backwards on the left.
///
/// Everything here is in doubles and only proposes; decisions are made elsewhere.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course {
    /// What positions are measured along, and from where.
    direction: Point,
    from: Point,
    /// The position of the start, so measured.
    at: f64,
}

impl Course {
    #[inline]
    pub(super) fn new(right: &Governor, left: &Governor, start: Point) -> Self {
        let (from, direction) = match (right, left) {
            (&Governor::Edge { .. }, &Governor::Edge { .. }) => (start, line(right, left).0),
            (&Governor::Corner(p), &Governor::Corner(q)) => {
                let w = q - p;
                (start, -w.perp() * (1.0 / w.norm()))
            }
            (&Governor::Edge { start: from, direction, .. }, &Governor::Corner(_)) => {
                (from, direction)
            }
            (&Governor::Corner(_), &Governor::Edge { start: from, direction, .. }) => {
                (from, -direction)
            }
        };
        Self { direction, from, at: direction.dot(start - from) }
    }

    /// How far ahead of the start a centre lies.
    #[inline]
    pub(super) fn position(&self, disk: &TouchingDisk) -> f64 {
        self.direction.dot(disk.centre + (disk.origin - self.from)) - self.at
    }

    /// The disk of the path at a position, if the bisector of these governors reaches it; `radius` is
    /// that of the start.
    pub(super) fn disk_at(
        &self,
        right: &Governor,
        left: &Governor,
        radius: f64,
        position: f64,
    ) -> Option<TouchingDisk> {
        let way = self.direction * (self.at + position);
        let (centre, radius) = match (right, left) {
            (&Governor::Edge { .. }, &Governor::Edge { .. }) => {
                (way, radius + line(right, left).1 * position)
            }
            (&Governor::Corner(corner), &Governor::Corner(_)) => {
                (way, (way + (self.from - corner)).norm())
            }
            (&Governor::Edge { direction, .. }, &Governor::Corner(corner))
            | (&Governor::Corner(corner), &Governor::Edge { direction, .. }) => {
                let normal = direction.perp();
                let w = (corner - self.from) - way;
                let radius = w.norm2() / (2.0 * normal.dot(w));
                (way + normal * radius, radius)
            }
        };
        let sound = radius > 0.0 && radius.is_finite();
        sound.then_some(TouchingDisk { origin: self.from, centre, radius, bound: f64::INFINITY })
    }
}

/// Forward direction on the bisector of two edges, and how the radius grows along it.
#[inline]
fn line(right: &Governor, left: &Governor) -> (Point, f64) {
    let (
        &Governor::Edge { start: a, end: b, direction: t },
        &Governor::Edge { start: c, end: d, direction: u },
    ) = (right, left)
    else {
        return (Point::default(), 0.0);
    };
    let (difference, sum) = (t - u, (t + u).perp());
    let sine = u.cross(t);
    // The forward direction is that of `difference`; where that cancels, the sign of the turn tells
    // on which side the lines meet.
    if difference.norm2() >= sum.norm2() {
        let inverse = 1.0 / difference.norm();
        (difference * inverse, sine * inverse)
    } else {
        let length = sum.norm();
        let sign = if cross_directions(c, d, a, b) < 0.0 { -1.0 } else { 1.0 };
        (sum * (sign / length), sign * length / 2.0)
    }
}
