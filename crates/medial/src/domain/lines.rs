//! Supporting lines of edges.

use std::cmp::Ordering;

use crate::geom::{Point, cross_directions, orient2d};

/// Numbers the supporting lines: for each edge, given by its ends, the least edge on its line.
///
/// Sorts by direction, then by position across it; O(n log n), every comparison exact.
pub(super) fn supporting_lines(edges: &[(Point, Point)]) -> Vec<u32> {
    let line = |(&(a, b), edge)| {
        let d: Point = b - a;
        (if d.x == 0.0 { f64::INFINITY } else { d.y / d.x }, edge)
    };
    let mut lines: Vec<(f64, u32)> = edges.iter().zip(0..).map(line).collect();
    lines.sort_unstable_by(|a, b| compare(edges, a, b).then(a.1.cmp(&b.1)));
    let mut least = vec![0; edges.len()];
    for same in lines.chunk_by(|a, b| compare(edges, a, b).is_eq()) {
        for line in same {
            least[line.1 as usize] = same[0].1;
        }
    }
    least
}

/// Relative difference beyond which rounded slopes are in the order of the true ones: each has an
/// error of three roundings.
const SLOPE_ERROR: f64 = 4.0 * f64::EPSILON;

/// Compares the lines of two edges, given with their rounded slopes.
fn compare(edges: &[(Point, Point)], one: &(f64, u32), other: &(f64, u32)) -> Ordering {
    let gap = one.0 - other.0;
    if gap.abs() > SLOPE_ERROR * one.0.abs().max(other.0.abs()) {
        return sign(gap);
    }
    let ends = |edge: u32| {
        let (a, b) = edges[edge as usize];
        if a.lexicographic(b).is_lt() { (a, b) } else { (b, a) }
    };
    let ((a, b), (c, d)) = (ends(one.1), ends(other.1));
    // Both point to the right, or both up: the one that turns left is steeper.
    sign(cross_directions(c, d, a, b)).then_with(|| sign(orient2d(c, d, a)))
}

fn sign(value: f64) -> Ordering {
    value.partial_cmp(&0.0).unwrap_or(Ordering::Equal)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn p(x: f64, y: f64) -> Point {
        Point::new(x, y)
    }

    #[test]
    fn edges_on_one_line_share_the_least_number_whatever_their_direction() {
        let edges = [
            (p(0.0, 1.0), p(1.0, 1.0)),
            (p(0.0, 0.0), p(3.0, 1.0)),
            (p(9.0, 3.0), p(6.0, 2.0)),
            (p(7.0, 1.0), p(5.0, 1.0)),
            (p(2.0, 7.0), p(2.0, 8.0)),
            (p(2.0, 1.0), p(2.0, 0.0)),
            (p(3.0, 0.0), p(3.0, 1.0)),
        ];
        assert_eq!(supporting_lines(&edges), [0, 1, 1, 0, 4, 4, 6]);
    }

    #[test]
    fn lines_one_ulp_apart_are_told_apart() {
        let shift = 1.0_f64.next_up();
        let edges = [
            (p(0.0, 1.0), p(5.0, 6.0)),
            (p(0.0, shift), p(5.0, 6.0)),
            (p(2.0, 3.0), p(1.0, 2.0)),
            (p(0.0, shift), p(4.0, shift)),
            (p(0.0, 1.0), p(4.0, 1.0)),
        ];
        assert_eq!(supporting_lines(&edges), [0, 1, 0, 3, 4]);
    }
}
