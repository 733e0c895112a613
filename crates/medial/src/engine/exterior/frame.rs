//! The rectangle at which an exterior axis is cut, and the walls behind it.

use crate::domain::Domain;
use crate::engine::EngineError;
use crate::geom::{Point, Rect};

/// The largest coordinate that the walls may have: what predicates can still square twice.
const LARGEST: f64 = f64::from_bits((1023 + 210) << 52);

/// The rectangle at which an exterior axis is cut.
pub(super) struct Frame {
    pub(super) bounds: Rect,
}

impl Frame {
    /// The box of a domain, grown on all sides by a margin, or by its longer side.
    pub(super) fn around(domain: &Domain, margin: Option<f64>) -> Result<Self, EngineError> {
        let bounds = domain.bounds();
        let size = bounds.max - bounds.min;
        let margin = margin.unwrap_or(size.x.max(size.y));
        let grown = Point::new(margin, margin);
        let frame = Self { bounds: Rect { min: bounds.min - grown, max: bounds.max + grown } };
        let Rect { min, max } = frame.bounds;
        // A margin below the last place of a coordinate adds nothing.
        let is_around = min.x < bounds.min.x
            && min.y < bounds.min.y
            && bounds.max.x < max.x
            && bounds.max.y < max.y;
        let walls = frame.walls();
        let all = [walls.min.x, walls.min.y, walls.max.x, walls.max.y];
        // Not a number is not within.
        let is_within = all.iter().all(|v| v.abs() <= LARGEST);
        (is_around && is_within).then_some(frame).ok_or(EngineError::Frame { margin })
    }

    /// A box that holds every disk whose centre lies in the frame and which does not reach beyond all
    /// of the domain, in coordinates with few digits.
    pub(super) fn walls(&self) -> Rect {
        let Rect { min, max } = self.bounds;
        let size = max - min;
        // Longer than the diagonal.
        let step = power_of_two_above(size.x + size.y);
        let below = |v: f64| ((v / step).floor() - 1.0) * step;
        let above = |v: f64| ((v / step).ceil() + 1.0) * step;
        Rect {
            min: Point::new(below(min.x), below(min.y)),
            max: Point::new(above(max.x), above(max.y)),
        }
    }

    /// Whether a point lies in the inside.
    pub(super) fn holds(&self, p: Point) -> bool {
        let Rect { min, max } = self.bounds;
        min.x < p.x && p.x < max.x && min.y < p.y && p.y < max.y
    }
}

/// The least power of two that is greater than a positive number.
fn power_of_two_above(value: f64) -> f64 {
    const MANTISSA: u64 = (1 << 52) - 1;
    f64::from_bits(value.to_bits() & !MANTISSA) * 2.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::Options;

    fn frame(size: f64, margin: Option<f64>) -> Result<Frame, EngineError> {
        let corners = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (0.0, 1.0)];
        let ring = corners.map(|(x, y)| Point::new(1.0 + x * size, 3.0 + y * size)).to_vec();
        let domain = Domain::from_polygons(&[vec![ring]], &Options::default()).expect("valid");
        Frame::around(&domain, margin)
    }

    #[test]
    fn the_frame_is_the_box_grown_by_its_longer_side() {
        let bounds = frame(1.0, None).expect("small").bounds;
        assert_eq!(bounds, Rect { min: Point::new(-1.0, 1.0), max: Point::new(5.0, 6.0) });
        let bounds = frame(1.0, Some(0.5)).expect("small").bounds;
        assert_eq!(bounds, Rect { min: Point::new(0.5, 2.5), max: Point::new(3.5, 4.5) });
    }

    #[test]
    fn walls_are_farther_from_the_frame_than_its_diagonal() {
        let frame = frame(1.0, None).expect("small");
        // 6 by 5; the next power of two above 11 is 16.
        let walls = Rect { min: Point::new(-32.0, -16.0), max: Point::new(32.0, 32.0) };
        assert_eq!(frame.walls(), walls);
    }

    #[test]
    fn a_margin_that_is_none_is_refused() {
        for margin in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-300, 1e70] {
            assert!(matches!(frame(1.0, Some(margin)), Err(EngineError::Frame { .. })), "{margin}");
        }
    }
}
