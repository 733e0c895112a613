//! Rational splines, as Bézier curves.

use super::{Bezier, CurveError};
use medial::geom::Point;

/// A rational spline with any knots.
#[derive(Clone, Debug)]
pub struct Nurbs {
    /// Its degree, from 1.
    pub degree: usize,
    /// Knots, in order: one more than the control points and the degree together.
    pub knots: Vec<f64>,
    /// The control points.
    pub points: Vec<Point>,
    /// The weight of each control point, positive; none if all are 1.
    pub weights: Vec<f64>,
}

/// Highest degree of a spline; CAD programs write up to 11.
const MOST_DEGREE: usize = 25;

/// A point times its weight, and the weight.
type Weighted = [f64; 3];

impl Nurbs {
    /// The Bézier curves it is made of, the same curve exactly, by inserting knots [Boehm80].
    ///
    /// # Errors
    /// If its knots or weights make no spline.
    pub fn beziers(&self) -> Result<Vec<Bezier>, CurveError> {
        let (p, n) = (self.degree, self.points.len());
        let wrong = |why: String| CurveError::Spline { why };
        if p == 0 || p > MOST_DEGREE {
            return Err(wrong(format!("its degree is {p}; 1 to {MOST_DEGREE} are read")));
        }
        if n <= p {
            let why = format!("it has {n} control points, but its degree {p} needs {}", p + 1);
            return Err(wrong(why));
        }
        if self.knots.len() != n + p + 1 {
            let (found, needed) = (self.knots.len(), n + p + 1);
            return Err(wrong(format!("it has {found} knots where {needed} are needed")));
        }
        if !self.knots.is_sorted() {
            return Err(wrong("its knots do not grow".to_owned()));
        }
        if !self.weights.is_empty() && self.weights.len() != n {
            let (found, n) = (self.weights.len(), n);
            return Err(wrong(format!("it has {found} weights for {n} control points")));
        }
        if self.weights.iter().any(|w| !(*w > 0.0 && w.is_finite())) {
            return Err(wrong("a weight is not positive".to_owned()));
        }
        let weight = |k: usize| self.weights.get(k).copied().unwrap_or(1.0);
        let weighted =
            |(k, q): (usize, &Point)| -> Weighted { [q.x * weight(k), q.y * weight(k), weight(k)] };
        let points: Vec<Weighted> = self.points.iter().enumerate().map(weighted).collect();
        let mut curves: Vec<Bezier> = Vec::new();
        for span in p..n {
            let (low, high) = (self.knots[span], self.knots[span + 1]);
            if low < high {
                let control =
                    (0..=p).map(|k| self.blossom(&points, span, p - k, (low, high))).collect();
                let mut curve = Bezier::rational(control);
                curve.snap(curves.last().map(Bezier::end), None);
                curves.push(curve);
            }
        }
        // Where it begins and ends with a control point, the bits are those of that point.
        if let [first, .., last] = &self.points[..] {
            match &mut curves[..] {
                [] => return Err(wrong("its knots span nothing".to_owned())),
                [curve] => curve.snap(Some(*first), Some(*last)),
                [begin, .., end] => {
                    begin.snap(Some(*first), None);
                    end.snap(None, Some(*last));
                }
            }
        }
        Ok(curves)
    }

    /// The blossom of a span at so many times its low knot, and its high knot for the rest.
    fn blossom(
        &self,
        points: &[Weighted],
        span: usize,
        n_low: usize,
        (low, high): (f64, f64),
    ) -> Weighted {
        let p = self.degree;
        let mut row: Vec<Weighted> = points[span - p..=span].to_vec();
        for step in 1..=p {
            let at = if step <= n_low { low } else { high };
            for k in 0..=p - step {
                let first = span - p + step + k;
                let (a, b) = (self.knots[first], self.knots[first + p + 1 - step]);
                let t = if a < b { (at - a) / (b - a) } else { 0.0 };
                row[k] = [0, 1, 2].map(|c| (1.0 - t) * row[k][c] + t * row[k + 1][c]);
            }
        }
        row[0]
    }
}
