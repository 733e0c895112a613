//! The edges of a ring while it is flattened, and how many of them there may be.

use super::CurveError;
use medial::domain::{Curves, Piece};
use medial::geom::Point;

/// Most edges that the curves of a feature may take.
pub(super) const MOST_EDGES: usize = 1 << 22;

/// The tolerance, and the edges that are left.
pub(super) struct Budget {
    pub tolerance: f64,
    left: usize,
}

impl Budget {
    pub fn new(tolerance: f64) -> Self {
        Self { tolerance, left: MOST_EDGES }
    }

    /// Takes so many edges of those that are left.
    pub fn spend(&mut self, n: usize) -> Result<(), CurveError> {
        self.left = self.left.checked_sub(n).ok_or_else(|| self.spent())?;
        Ok(())
    }

    /// Fails if there are not about so many edges left.
    pub fn afford(&self, n: f64) -> Result<(), CurveError> {
        // Curves may take fewer edges than a bound for all of them says.
        if n <= 4.0 * self.left as f64 { Ok(()) } else { Err(self.spent()) }
    }

    fn spent(&self) -> CurveError {
        CurveError::TooManyEdges { most: MOST_EDGES, tolerance: self.tolerance }
    }
}

/// A ring of edges.
pub(super) struct Sink<'a> {
    pub points: Vec<Point>,
    /// The piece of each edge; one less than there are points until the ring is closed.
    pub edges: Vec<u32>,
    pieces: &'a mut Vec<Piece>,
}

impl<'a> Sink<'a> {
    pub fn new(start: Point, pieces: &'a mut Vec<Piece>) -> Self {
        Self { points: vec![start], edges: Vec::new(), pieces }
    }

    /// Adds a straight edge, if it has a length.
    pub fn line(&mut self, to: Point) {
        self.edge(to, Curves::STRAIGHT);
    }

    /// Begins a piece of a curve, to which edges are added then.
    pub fn piece(&mut self, piece: Piece) {
        self.pieces.push(piece);
    }

    /// Adds an edge of the last piece.
    pub fn curved(&mut self, to: Point) {
        self.edge(to, (self.pieces.len() - 1) as u32);
    }

    fn edge(&mut self, to: Point, piece: u32) {
        if self.points.last() != Some(&to) {
            self.points.push(to);
            self.edges.push(piece);
        }
    }

    /// The ring, closed by a straight edge if need be, its first point not repeated.
    pub fn close(mut self) -> (Vec<Point>, Vec<u32>) {
        if self.points.len() > 1 && self.points.first() == self.points.last() {
            self.points.pop();
        } else {
            self.edges.push(Curves::STRAIGHT);
        }
        (self.points, self.edges)
    }
}
