//! Cubic splines through given points, as CAD programs draw them.

use super::{Bezier, CurveError};
use medial::geom::Point;

/// A cubic spline through points, twice differentiable, over the lengths of the chords between them.
#[derive(Clone, Debug)]
pub struct Fit {
    /// The points, in order.
    pub points: Vec<Point>,
    /// Directions at its start and at its end, of any length; without one the curve ends without curvature.
    /// A closed one has none.
    pub tangents: [Option<Point>; 2],
    /// Whether it goes on smoothly from the last point to the first.
    pub closed: bool,
}

impl Fit {
    /// The Bézier curves it is made of, one between two points each. Points that repeat the one before are
    /// passed over.
    ///
    /// # Errors
    /// If there are fewer than two different points, or fewer than three of a closed one.
    pub fn beziers(&self) -> Result<Vec<Bezier>, CurveError> {
        let mut points = self.points.clone();
        points.dedup();
        if self.closed {
            while points.len() > 1 && points.first() == points.last() {
                points.pop();
            }
        }
        let n = points.len();
        let least = if self.closed { 3 } else { 2 };
        if n < least {
            let why = format!("it has {n} different fit points, and {least} are needed");
            return Err(CurveError::Spline { why });
        }
        if self.closed {
            points.push(points[0]);
        }
        let chords: Vec<f64> = points.windows(2).map(|pair| (pair[1] - pair[0]).norm()).collect();
        let slopes = if self.closed {
            round_slopes(&points, &chords)
        } else {
            open_slopes(&points, &chords, self.tangents)
        };
        let curve = |k: usize| {
            let third = chords[k] / 3.0;
            let (a, b) = (points[k], points[k + 1]);
            Bezier::new(&[a, a + slopes[k] * third, b - slopes[k + 1] * third, b])
        };
        Ok((0..chords.len()).map(curve).collect())
    }
}

/// A row of a system with three diagonals, and its right side.
#[derive(Clone, Copy)]
struct Row {
    before: f64,
    own: f64,
    after: f64,
    right: Point,
}

/// The equation that both second derivatives at a point are the same.
fn smooth(points: [Point; 3], [before, after]: [f64; 2]) -> Row {
    let (a, b) = (before.recip(), after.recip());
    let right = ((points[1] - points[0]) * (a * a) + (points[2] - points[1]) * (b * b)) * 3.0;
    Row { before: a, own: 2.0 * (a + b), after: b, right }
}

fn open_slopes(points: &[Point], chords: &[f64], tangents: [Option<Point>; 2]) -> Vec<Point> {
    let n = points.len();
    // Over the length of chords a slope has about the length 1.
    let unit = |tangent: Option<Point>| {
        tangent.map(|t| t * t.norm().recip()).filter(|t| t.x.is_finite() && t.y.is_finite())
    };
    let end = |tangent: Option<Point>, from: Point, to: Point, chord: f64| match unit(tangent) {
        Some(right) => Row { before: 0.0, own: 1.0, after: 0.0, right },
        None => {
            let right = (to - from) * (3.0 / chord);
            Row { before: 1.0, own: 2.0, after: 1.0, right }
        }
    };
    let mut rows = vec![end(tangents[0], points[0], points[1], chords[0])];
    rows.extend(
        (1..n - 1)
            .map(|k| smooth([points[k - 1], points[k], points[k + 1]], [chords[k - 1], chords[k]])),
    );
    rows.push(end(tangents[1], points[n - 2], points[n - 1], chords[n - 2]));
    solved(&rows)
}

/// The slopes at all points of a closed curve, the first one once more at the end.
fn round_slopes(points: &[Point], chords: &[f64]) -> Vec<Point> {
    let n = chords.len();
    let mut rows: Vec<Row> = (0..n)
        .map(|k| {
            let before = (k + n - 1) % n;
            smooth([points[before], points[k], points[k + 1]], [chords[before], chords[k]])
        })
        .collect();
    // The corners of the matrix are a product of two vectors [Sherman and Morrison].
    let (first, last) = (rows[0].before, rows[n - 1].after);
    let lead = -rows[0].own;
    rows[0].own -= lead;
    rows[n - 1].own -= first * last / lead;
    let plain = solved(&rows);
    for (k, row) in rows.iter_mut().enumerate() {
        let right = match k {
            0 => lead,
            k if k == n - 1 => last,
            _ => 0.0,
        };
        row.right = Point::new(right, 0.0);
    }
    let other = solved(&rows);
    let share = (plain[0] + plain[n - 1] * (first / lead))
        * (1.0 + other[0].x + other[n - 1].x * first / lead).recip();
    let mut slopes: Vec<Point> =
        plain.iter().zip(&other).map(|(plain, other)| *plain - share * other.x).collect();
    slopes.push(slopes[0]);
    slopes
}

/// The solution of a system with three diagonals, of which the middle one prevails.
fn solved(rows: &[Row]) -> Vec<Point> {
    let mut forward: Vec<(f64, Point)> = Vec::with_capacity(rows.len());
    for (k, row) in rows.iter().enumerate() {
        let (after, right) = match k.checked_sub(1) {
            Some(last) => forward[last],
            None => (0.0, Point::default()),
        };
        let before = if k == 0 { 0.0 } else { row.before };
        let own = (row.own - before * after).recip();
        forward.push((row.after * own, (row.right - right * before) * own));
    }
    let mut found = vec![Point::default(); rows.len()];
    for k in (0..rows.len()).rev() {
        let (after, right) = forward[k];
        let next = found.get(k + 1).copied().unwrap_or_default();
        found[k] = right - next * after;
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    fn control(fit: &Fit) -> Vec<Vec<Point>> {
        fit.beziers().unwrap().iter().map(Bezier::control_points).collect()
    }

    fn near(a: Point, b: Point) {
        assert!((a - b).norm() < 1e-12, "{a:?} is not {b:?}");
    }

    #[test]
    fn two_points_are_joined_by_a_line() {
        let points = vec![Point::new(0.0, 0.0), Point::new(3.0, 0.0), Point::new(3.0, 0.0)];
        let curves = control(&Fit { points, tangents: [None; 2], closed: false });
        assert_eq!(curves.len(), 1);
        [0.0, 1.0, 2.0, 3.0]
            .iter()
            .zip(&curves[0])
            .for_each(|(x, p)| near(*p, Point::new(*x, 0.0)));
    }

    /// A cubic from (0, 0) straight up to (1, 1) and straight up again: with chords of length 1 slopes at the
    /// ends are the tangents, and in the middle they follow by symmetry.
    #[test]
    fn given_tangents_are_those_of_the_ends() {
        let points = vec![Point::new(0.0, 0.0), Point::new(1.0, 0.0), Point::new(2.0, 0.0)];
        let up = Some(Point::new(0.0, 7.0));
        let curves = control(&Fit { points, tangents: [up, up], closed: false });
        near(curves[0][1], Point::new(0.0, 1.0 / 3.0));
        near(curves[1][2], Point::new(2.0, -1.0 / 3.0));
        // 4 D = 3 (2, 0) - 2 (0, 1).
        near(curves[0][2], Point::new(1.0 - 0.5, 0.5 / 3.0));
    }

    /// The closed one through the corners of a square: by symmetry each slope is along a diagonal, and
    /// D1 - D3 = 0, so 4 D0 = 3 (P1 - P3) for chords of length 1.
    #[test]
    fn a_closed_one_is_as_symmetric_as_its_points() {
        let p = Point::new;
        let points = vec![p(0.0, 0.0), p(1.0, 0.0), p(1.0, 1.0), p(0.0, 1.0), p(0.0, 0.0)];
        let curves = control(&Fit { points, tangents: [None; 2], closed: true });
        assert_eq!(curves.len(), 4);
        near(curves[0][1], p(0.25, -0.25));
        near(curves[0][2], p(0.75, -0.25));
        near(curves[3][2], p(-0.25, 0.25));
        assert_eq!(curves[3][3], p(0.0, 0.0));
    }

    #[test]
    fn too_few_points_are_told() {
        let points = vec![Point::new(1.0, 1.0); 4];
        let error = Fit { points, tangents: [None; 2], closed: false }.beziers().unwrap_err();
        assert!(error.to_string().contains("1 different fit points"), "{error}");
    }
}
