//! The lengths of paths; those of many parabolas side by side.

use super::curve::{Frame, Spread};
use super::hyperbolic::{asinh_of_little, is_little, is_usual};
use super::{Accuracy, MedialAxis, Path, SiteKind};

impl MedialAxis {
    /// The length of that curve.
    #[inline]
    pub(crate) fn length_of(&self, path: &Path) -> f64 {
        match self.line_or_parabola(path) {
            Ok(length) => length,
            Err((d, x)) => Spread::new(d, x).length_of_parabola(d),
        }
    }

    /// The lengths of all paths. Those of parabolas are found side by side.
    pub(crate) fn lengths(&self, paths: &[Path]) -> Vec<f64> {
        let mut lengths = Vec::with_capacity(paths.len());
        let mut row = Row::default();
        for path in paths {
            lengths.push(self.line_or_parabola(path).unwrap_or_else(|(d, x)| {
                row.add(lengths.len(), d, x);
                0.0
            }));
            if row.len == ROW {
                row.finish(&mut lengths);
            }
        }
        row.finish(&mut lengths);
        lengths
    }

    /// The length of a path that is a line; else the distance of its corner from its edge and the positions
    /// of its ends.
    #[inline(always)]
    fn line_or_parabola(&self, path: &Path) -> Result<f64, (f64, [f64; 2])> {
        let (left, right) = (self.site_shape(path.left), self.site_shape(path.right));
        let (from, to) = (self.disk(path.from), self.disk(path.to));
        let frame = match (left.kind, right.kind) {
            (SiteKind::Vertex, SiteKind::Edge) if self.accuracy == Accuracy::Exact => {
                Frame::new(left.a, &right)
            }
            (SiteKind::Edge, SiteKind::Vertex) if self.accuracy == Accuracy::Exact => {
                Frame::new(right.a, &left)
            }
            _ => None,
        };
        match frame {
            None => Ok((to.0 - from.0).norm()),
            Some(frame) => Err((frame.d, [frame.position(from), frame.position(to)])),
        }
    }
}

/// Parabolas whose lengths are found side by side: plain loops, which compilers turn into vector
/// instructions, with the same operations in the same order as for one.
struct Row {
    len: usize,
    /// Where each length goes.
    places: [usize; ROW],
    d: [f64; ROW],
    x: [[f64; ROW]; 2],
}

/// Parabolas side by side.
const ROW: usize = 64;

/// As many as instructions take at once, on any machine.
const GROUP: usize = 8;

impl Default for Row {
    fn default() -> Self {
        Self { len: 0, places: [0; ROW], d: [1.0; ROW], x: [[0.0; ROW]; 2] }
    }
}

impl Row {
    #[inline]
    fn add(&mut self, place: usize, d: f64, [x1, x2]: [f64; 2]) {
        let k = self.len;
        (self.places[k], self.d[k], self.x[0][k], self.x[1][k]) = (place, d, x1, x2);
        self.len += 1;
    }

    fn finish(&mut self, lengths: &mut [f64]) {
        let Self { len, places, d, x: [x1, x2] } = self;
        let mut row = [0.0; ROW];
        // Whether it is the length: not where squares overflow or vanish, or where a series is too short.
        let mut is_it = [false; ROW];
        // Whole groups, of which the last one may hold old ones too.
        for k in 0..len.next_multiple_of(GROUP) {
            let (d, x1, x2) = (d[k], x1[k], x2[k]);
            let squares = [x1 * x1 + d * d, x2 * x2 + d * d];
            let w = squares.map(f64::sqrt);
            let span = x2 - x1;
            let rise = span * (x1 + x2) / (w[0] + w[1]);
            let sinh = (span * w[0] - x1 * rise) / (d * d);
            let chordal = (span * w[1] + x1 * rise) / (2.0 * d);
            row[k] = (chordal + 0.5 * d * asinh_of_little(sinh)).abs();
            is_it[k] = is_usual(squares[0]) & is_usual(squares[1]) & is_little(sinh);
        }
        for k in 0..*len {
            let of_one = || Spread::new(d[k], [x1[k], x2[k]]).length_of_parabola(d[k]);
            lengths[places[k]] = if is_it[k] { row[k] } else { of_one() };
        }
        *len = 0;
    }
}
