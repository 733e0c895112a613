//! The curves that edges were flattened from.

use super::Origin;
use crate::geom::Point;

/// Which points a set of closed rings encloses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum FillRule {
    /// Those that the rings go around an odd number of times: of polygons as lists of rings.
    #[default]
    EvenOdd,
    /// Those that the rings go around, more often one way than the other: of fonts, and of SVG unless
    /// it says otherwise.
    NonZero,
}

/// The curves that edges of a feature were flattened from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curves {
    /// The largest distance between a curve and its edges.
    pub tolerance: f64,
    /// Pieces of curves on which the curvature grows or falls, and does not change its sign.
    pub pieces: Vec<Piece>,
    /// For each polygon, ring and edge, as given, its piece, or [`Curves::STRAIGHT`]; edge `k` runs from
    /// vertex `k` of the ring to the next one.
    pub edges: Vec<Vec<Vec<u32>>>,
}

/// A piece of a curve, with what is known of it at its two ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// Where it begins, in the direction of the ring as given.
    pub start: PieceEnd,
    /// Where it ends.
    pub end: PieceEnd,
}

/// A curve at an end of a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PieceEnd {
    /// The direction of the curve, of length 1.
    pub tangent: Point,
    /// The inverse of the radius of curvature; positive where the curve turns left.
    pub curvature: f64,
}

impl Curves {
    /// The number of no piece: of an edge that is straight by itself.
    pub const STRAIGHT: u32 = u32::MAX;

    /// The piece that an edge of a domain comes from.
    #[must_use]
    pub fn piece_of(&self, origin: &Origin) -> Option<u32> {
        let polygon = self.edges.get(origin.polygon as usize)?;
        let piece = *polygon.get(origin.ring as usize)?.get(origin.index as usize)?;
        (piece != Self::STRAIGHT).then_some(piece)
    }
}
