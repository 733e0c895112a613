use crate::geom::{Governor, Point, TouchingDisk};

/// The bisector of a right and a left governor, run through forwards.
///
/// Everything here is in doubles and only proposes; decisions are made elsewhere.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course {
    right: Governor,
    left: Governor,
}

impl Course {
    pub(super) fn new(right: Governor, left: Governor) -> Self {
        Self { right, left }
    }

    /// How far along the path a centre lies: the position of the footpoint on an edge governor,
    /// or the position along the bisector of two corners.
    pub(super) fn position(&self, disk: &TouchingDisk) -> f64 {
        let from = |p: Point| disk.centre + (disk.origin - p);
        match (self.right, self.left) {
            (Governor::Edge { start, direction, .. }, _) => direction.dot(from(start)),
            (_, Governor::Edge { start, direction, .. }) => -direction.dot(from(start)),
            (Governor::Corner(p), Governor::Corner(q)) => {
                let w = q - p;
                -w.perp().dot(from(p)) / w.norm()
            }
        }
    }

    /// The disk of the path at a position, if the bisector reaches it.
    pub(super) fn disk_at(&self, position: f64) -> Option<TouchingDisk> {
        let (origin, centre, radius) = match (self.right, self.left) {
            (Governor::Edge { start, direction, .. }, other) => {
                lean_on(start, direction, position, other)?
            }
            (other, Governor::Edge { start, direction, .. }) => {
                lean_on(start, direction, -position, other)?
            }
            (Governor::Corner(p), Governor::Corner(q)) => {
                let w = q - p;
                let centre = w * 0.5 - w.perp() * (position / w.norm());
                (p, centre, centre.norm())
            }
        };
        let sound = radius > 0.0 && radius.is_finite();
        sound.then_some(TouchingDisk { origin, centre, radius, bound: f64::INFINITY })
    }
}

/// The disk that touches an edge's line at `foot` from its start, and the other governor.
fn lean_on(start: Point, t: Point, foot: f64, other: Governor) -> Option<(Point, Point, f64)> {
    let n = t.perp();
    let at = t * foot;
    let radius = match other {
        Governor::Edge { start: s, direction: u, .. } => {
            let (c, g) = (t.cross(u), t.dot(u));
            let um = if g >= 0.0 { c * c / (1.0 + g) } else { 1.0 - g };
            u.cross(at + (start - s)) / um
        }
        Governor::Corner(q) => {
            let w = (q - start) - at;
            w.norm2() / (2.0 * n.dot(w))
        }
    };
    (radius > 0.0).then(|| (start, at + n * radius, radius))
}
