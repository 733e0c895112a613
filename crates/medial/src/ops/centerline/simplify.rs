//! Polylines with fewer points.
//!
//! # Contract
//! The result has some of the points, both ends among them. Neither it nor what was given is anywhere
//! farther from the other than the tolerance, and each of its segments passes a test, unless it was given.
//!
//! # Method
//! Douglas and Peucker's: a chord stands for all points between its ends if they are near it, else the
//! farthest of them is kept. The nearest point of a chord changes continuously along what it stands for, so
//! every point of the chord is near too.

use crate::geom::Point;

/// The numbers of the points that are kept. The test is whether some of the points may be replaced by the
/// chord between the first and the last of them.
pub(super) fn kept(
    points: &[Point],
    tolerance: f64,
    may_go: impl Fn(&[Point], [Point; 2]) -> bool,
) -> Vec<usize> {
    let Some(last) = points.len().checked_sub(1) else { return Vec::new() };
    let mut kept = vec![0];
    // What is left to do, the first on top.
    let mut stack = vec![(0, last)];
    while let Some((from, to)) = stack.pop() {
        let (a, b) = (points[from], points[to]);
        let mut farthest = (from + (to - from) / 2, 0.0);
        for (k, &p) in points.iter().enumerate().take(to).skip(from + 1) {
            let distance = distance_to_segment(p, a, b);
            if distance > farthest.1 {
                farthest = (k, distance);
            }
        }
        let is_far = farthest.1 > tolerance;
        if to > from + 1 && (is_far || !may_go(&points[from..=to], [a, b])) {
            stack.push((farthest.0, to));
            stack.push((from, farthest.0));
        } else if to > from {
            kept.push(to);
        }
    }
    kept
}

fn distance_to_segment(p: Point, a: Point, b: Point) -> f64 {
    let way = b - a;
    let share = way.dot(p - a) / way.norm2();
    // Where both ends are one point the share is NaN.
    let share = if share > 0.0 { share.min(1.0) } else { 0.0 };
    (a + way * share - p).norm()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(list: &[(f64, f64)]) -> Vec<Point> {
        list.iter().map(|&(x, y)| Point::new(x, y)).collect()
    }

    #[test]
    fn what_is_within_the_tolerance_goes() {
        let zigzag = points(&[(0., 0.), (1., 1.), (2., 0.), (3., 2.), (4., 0.)]);
        assert_eq!(kept(&zigzag, 0.0, |_, _| true), [0, 1, 2, 3, 4]);
        assert_eq!(kept(&zigzag, 1.2, |_, _| true), [0, 3, 4]);
        assert_eq!(kept(&zigzag, 2.0, |_, _| true), [0, 4]);
        assert_eq!(kept(&zigzag[..1], 2.0, |_, _| true), [0]);
    }

    #[test]
    fn a_chord_that_is_not_clear_is_none() {
        let arc = points(&[(0., 0.), (1., 1.), (2., 1.), (3., 0.)]);
        assert_eq!(kept(&arc, 9.0, |_, [a, b]| (b.x - a.x).abs() < 2.5), [0, 1, 3]);
        assert_eq!(kept(&arc, 9.0, |_, _| false), [0, 1, 2, 3]);
    }

    #[test]
    fn a_closed_line_is_no_point() {
        let square = points(&[(0., 0.), (1., 0.), (1., 1.), (0., 1.), (0., 0.)]);
        assert_eq!(kept(&square, 0.5, |_, _| true), [0, 1, 2, 3, 4]);
        assert_eq!(kept(&square, 0.8, |_, _| true), [0, 2, 4]);
    }
}
