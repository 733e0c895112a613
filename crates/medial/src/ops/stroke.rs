//! Contours as segments and arcs from end to end, for what draws, writes or follows them.

use super::outline::{Contour, OutlinePiece, Sense};
use crate::geom::Point;

/// A segment or an arc of a contour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stroke {
    /// A segment.
    Line {
        /// Where it starts.
        from: Point,
        /// Where it ends.
        to: Point,
    },
    /// An arc of a circle.
    Arc {
        /// Where it starts.
        from: Point,
        /// Where it ends.
        to: Point,
        /// Centre of the circle.
        centre: Point,
        /// Radius of the circle.
        radius: f64,
        /// Which way it runs.
        sense: Sense,
        /// The angle that it runs through, in radians, not negative.
        angle: f64,
    },
}

impl Contour {
    /// What it consists of, in its order: each stroke starts where the one before it ends, the first one
    /// where the last one does.
    #[must_use]
    pub fn strokes(&self) -> Vec<Stroke> {
        let mut strokes = Vec::with_capacity(self.0.len() + 1);
        let next = self.0.iter().cycle().skip(1);
        for (piece, next) in self.0.iter().zip(next) {
            if let OutlinePiece::Arc { centre, radius, from, to, sense } = *piece {
                let angle = piece.sweep().abs();
                strokes.push(Stroke::Arc { from, to, centre, radius, sense, angle });
            }
            let (from, to) = (piece.ends()[1], next.ends()[0]);
            if from != to {
                strokes.push(Stroke::Line { from, to });
            }
        }
        strokes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strokes_run_from_end_to_end() {
        let p = |x: f64, y: f64| Point::new(x, y);
        // The right half of a disk, and the other half as a box.
        let arc = OutlinePiece::Arc {
            centre: p(0.0, 0.0),
            radius: 1.0,
            from: p(0.0, -1.0),
            to: p(0.0, 1.0),
            sense: Sense::Counterclockwise,
        };
        let corners = [p(-1.0, 1.0), p(-1.0, -1.0)].map(OutlinePiece::Corner);
        let all = Contour(vec![arc, corners[0], corners[1]]).strokes();
        assert_eq!(all.len(), 4);
        assert!(
            matches!(all[0], Stroke::Arc { angle, .. } if (angle - std::f64::consts::PI).abs() < 1e-15)
        );
        assert_eq!(all[1], Stroke::Line { from: p(0.0, 1.0), to: p(-1.0, 1.0) });
        assert_eq!(all[3], Stroke::Line { from: p(-1.0, -1.0), to: p(0.0, -1.0) });
    }
}
