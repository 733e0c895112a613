//! Contours as segments and arcs from end to end, for what draws or writes them.

use medial::geom::Point;
use medial::ops::{Contour, OutlinePiece, Sense};

/// A segment or an arc of a contour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Stroke {
    Line { from: Point, to: Point },
    Arc { from: Point, to: Point, centre: Point, radius: f64, sense: Sense, angle: f64 },
}

/// What a contour consists of, in its order: each stroke starts where the one before it ends.
pub(crate) fn strokes(contour: &Contour) -> Vec<Stroke> {
    let mut strokes = Vec::with_capacity(contour.0.len() + 1);
    let next = contour.0.iter().cycle().skip(1);
    for (piece, next) in contour.0.iter().zip(next) {
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
        let all = strokes(&Contour(vec![arc, corners[0], corners[1]]));
        assert_eq!(all.len(), 4);
        assert!(
            matches!(all[0], Stroke::Arc { angle, .. } if (angle - std::f64::consts::PI).abs() < 1e-15)
        );
        assert_eq!(all[1], Stroke::Line { from: p(0.0, 1.0), to: p(-1.0, 1.0) });
        assert_eq!(all[3], Stroke::Line { from: p(-1.0, -1.0), to: p(0.0, -1.0) });
    }
}
