//! Polylines without corners.
//!
//! # Contract
//! A corner is replaced by a curve that touches both segments, no farther than a tolerance from them, and
//! only if all of it passes a test. Ends stay; of a closed line the first point is any.
//!
//! # Method
//! A corner is cut by a parabola from the middle of the shorter segment beside it to the point as far away on
//! the other one, nearer to the corner where the tolerance, or the test, does not allow that. It is a Bézier
//! curve with the corner as control point, and comes as near to it as half way to its chord.

use crate::geom::Point;

/// How often a parabola is brought nearer to its corner before that stays.
const TRIES: u32 = 10;

/// How far a parabola turns from piece to piece, on average, in radians: it looks smooth however small it is.
const TURN: f64 = 0.1;

/// Most pieces a parabola is drawn with.
const MOST_PIECES: f64 = 64.0;

/// The points of a smooth line, each with the number of the given point that it is, if it is one. The test is
/// whether two halves of segments may be replaced by a curve.
pub(super) fn rounded(
    points: &[Point],
    tolerance: f64,
    drawn: f64,
    may_go: impl Fn(&[Point], &[Point]) -> bool,
) -> Vec<(Point, Option<usize>)> {
    let Some(last) = points.len().checked_sub(1) else { return Vec::new() };
    let mut rounded = vec![(points[0], Some(0))];
    for (k, corner) in points.windows(3).enumerate() {
        match parabola([corner[0], corner[1], corner[2]], tolerance, drawn, &may_go) {
            Some(parabola) => rounded.extend(parabola.into_iter().map(|p| (p, None))),
            None => rounded.push((corner[1], Some(k + 1))),
        }
    }
    rounded.push((points[last], Some(last)));
    // Where two parabolas meet in the middle of a segment.
    rounded.dedup_by(|a, b| a.0 == b.0);
    rounded
}

/// What replaces a corner; nothing if it is none, or if nothing passes the test.
fn parabola(
    [a, b, c]: [Point; 3],
    tolerance: f64,
    drawn: f64,
    may_go: impl Fn(&[Point], &[Point]) -> bool,
) -> Option<Vec<Point>> {
    // Equally far on both sides, so that it turns evenly.
    let reach = 0.5 * (a - b).norm().min((c - b).norm());
    let [back, on] = [a, c].map(|end| (end - b) * (reach / (end - b).norm()));
    // How far the corner is from the curve at most: a quarter of the sum of both ways.
    let bend = (back + on).norm() * 0.25;
    let mut share = if bend > tolerance { tolerance / bend } else { 1.0 };
    let turn = on.cross(back).atan2(-on.dot(back)).abs();
    // NaN where two points are one.
    if turn.is_nan() || turn == 0.0 {
        return None;
    }
    for _ in 0..TRIES {
        let (p, q) = (b + back * share, b + on * share);
        let n = (bend * share / drawn).sqrt().max(turn / TURN).ceil().clamp(1.0, MOST_PIECES);
        let at = |k: u32| {
            let u = f64::from(k) / n;
            let (p, q) = (p * (1.0 - u) + b * u, b * (1.0 - u) + q * u);
            p * (1.0 - u) + q * u
        };
        let points: Vec<Point> = (0..=n as u32).map(at).collect();
        if may_go(&[p, b, q], &points) {
            return Some(points);
        }
        share *= 0.5;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    const CORNER: [Point; 3] = [Point::new(0.0, 0.0), Point::new(4.0, 0.0), Point::new(4.0, 4.0)];

    #[test]
    fn a_corner_becomes_a_parabola() {
        // From (2, 0) to (4, 2), over (3.5, 0.5).
        let rounded = rounded(&CORNER, 9.0, 1e-4, |_, _| true);
        assert_eq!((rounded[0].1, rounded[rounded.len() - 1].1), (Some(0), Some(2)));
        let middle = rounded[rounded.len() / 2].0;
        assert_eq!((rounded[1].0, middle), (Point::new(2.0, 0.0), Point::new(3.5, 0.5)));
    }

    #[test]
    fn it_is_no_farther_than_the_tolerance() {
        let tolerance = 0.125;
        let rounded = rounded(&CORNER, tolerance, 1e-4, |_, _| true);
        let away = |p: Point| (p - CORNER[1]).norm();
        let nearest = rounded.iter().map(|(p, _)| away(*p)).fold(f64::INFINITY, f64::min);
        assert!((nearest - tolerance).abs() < 1e-12, "{nearest}");
    }

    #[test]
    fn a_corner_stays_where_nothing_else_is_clear() {
        let rounded = rounded(&CORNER, 9.0, 0.1, |_, _| false);
        let points: Vec<Point> = rounded.into_iter().map(|(p, _)| p).collect();
        assert_eq!(points, CORNER);
    }
}
