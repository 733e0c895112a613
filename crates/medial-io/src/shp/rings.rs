//! Which rings are holes, and of which polygon.

use crate::Polygons;
use medial::geom::Point;
use std::cmp::Ordering;

/// Polygons of rings that follow one another: clockwise ones are outer rings, the others holes of the
/// smallest outer ring that contains them. Where there is no clockwise ring, or just one ring, orientation
/// says nothing, and depth decides. Some programs have it the other way round: so it is taken if then, and
/// only then, each hole lies in an outer ring.
///
/// A hole that lies in no outer ring goes with the outer ring before it, so that who looks into the
/// polygon finds it misplaced.
pub(super) fn grouped(rings: Vec<Vec<Point>>) -> Polygons {
    if rings.len() < 2 {
        return if rings.is_empty() { Vec::new() } else { vec![rings] };
    }
    let areas: Vec<f64> = rings.iter().map(|ring| area(ring)).collect();
    let boxes: Vec<[f64; 4]> = rings.iter().map(|ring| bounds(ring)).collect();
    let contains = |outer: usize, inner: usize| {
        let ([x, y, x_max, y_max], [left, bottom, right, top]) = (boxes[outer], boxes[inner]);
        x <= left
            && y <= bottom
            && right <= x_max
            && top <= y_max
            && is_within(&rings[inner], &rings[outer])
    };
    let all = 0..rings.len();
    // A ring without area is an outer one, for validation to judge.
    let runs = |hole: Ordering| -> Vec<bool> {
        areas.iter().map(|area| area.partial_cmp(&0.0) != Some(hole)).collect()
    };
    let fits = |is_outer: &[bool]| {
        let mut holes = all.clone().filter(|&k| !is_outer[k]);
        holes.all(|hole| all.clone().any(|k| is_outer[k] && contains(k, hole)))
    };
    let is_outer = if areas.iter().any(|&area| area < 0.0) {
        let [given, turned] = [Ordering::Greater, Ordering::Less].map(runs);
        if !fits(&given) && fits(&turned) { turned } else { given }
    } else {
        let around = |k: usize| all.clone().filter(move |&l| l != k && contains(l, k)).count();
        all.clone().map(|k| around(k) % 2 == 0).collect()
    };
    let outer: Vec<usize> = all.clone().filter(|&k| is_outer[k]).collect();
    let polygon_of = |hole: usize| {
        let around = outer.iter().enumerate().filter(|&(_, &ring)| contains(ring, hole));
        let smallest =
            around.min_by(|(_, a), (_, b)| areas[**a].abs().total_cmp(&areas[**b].abs()));
        smallest.map_or_else(
            || outer.partition_point(|&ring| ring < hole).saturating_sub(1),
            |(polygon, _)| polygon,
        )
    };
    let homes: Vec<Option<usize>> = all.map(|k| (!is_outer[k]).then(|| polygon_of(k))).collect();
    let mut polygons: Polygons = vec![Vec::new(); outer.len().max(1)];
    let mut next = 0;
    let mut holes = Vec::new();
    for (ring, home) in rings.into_iter().zip(homes) {
        match home {
            Some(home) => holes.push((home, ring)),
            None => {
                polygons[next].push(ring);
                next += 1;
            }
        }
    }
    for (home, ring) in holes {
        polygons[home].push(ring);
    }
    polygons
}

/// Twice the area of a ring, positive if it runs counterclockwise; rounded.
pub(super) fn area(ring: &[Point]) -> f64 {
    let Some(&origin) = ring.first() else { return 0.0 };
    let next = ring.iter().cycle().skip(1);
    let cross = |(a, b): (&Point, &Point)| {
        (a.x - origin.x) * (b.y - origin.y) - (a.y - origin.y) * (b.x - origin.x)
    };
    ring.iter().zip(next).map(cross).sum()
}

fn bounds(ring: &[Point]) -> [f64; 4] {
    let nothing = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
    ring.iter().fold(nothing, |[x, y, x_max, y_max], p| {
        [x.min(p.x), y.min(p.y), x_max.max(p.x), y_max.max(p.y)]
    })
}

/// Whether a ring lies within another one, told by the first of its corners that is not one of the
/// other's, or the middle of an edge if all are.
fn is_within(inner: &[Point], outer: &[Point]) -> bool {
    let same = |p: &Point| outer.iter().any(|q| q.x == p.x && q.y == p.y);
    if let Some(&p) = inner.iter().find(|p| !same(p)) {
        return is_inside(p, outer);
    }
    let middle = |pair: &[Point]| {
        Point::new(f64::midpoint(pair[0].x, pair[1].x), f64::midpoint(pair[0].y, pair[1].y))
    };
    inner.windows(2).next().is_some_and(|pair| is_inside(middle(pair), outer))
}

/// Whether a point is inside a ring: whether a ray crosses it an odd number of times.
fn is_inside(p: Point, ring: &[Point]) -> bool {
    let next = ring.iter().cycle().skip(1);
    let crosses = |&(a, b): &(&Point, &Point)| {
        (a.y > p.y) != (b.y > p.y) && {
            let turn = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
            (turn > 0.0) == (b.y > a.y)
        }
    };
    ring.iter().zip(next).filter(crosses).count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64, side: f64, is_clockwise: bool) -> Vec<Point> {
        let mut ring = vec![
            Point::new(x, y),
            Point::new(x + side, y),
            Point::new(x + side, y + side),
            Point::new(x, y + side),
            Point::new(x, y),
        ];
        if is_clockwise {
            ring.reverse();
        }
        ring
    }

    #[test]
    fn holes_go_to_the_smallest_ring_around_them() {
        let [lake, island, pond, far] = [
            square(0.0, 0.0, 10.0, true),
            square(1.0, 1.0, 8.0, false),
            square(2.0, 2.0, 6.0, true),
            square(20.0, 0.0, 4.0, true),
        ];
        let hole = square(3.0, 3.0, 1.0, false);
        let rings = vec![hole.clone(), island.clone(), lake.clone(), far.clone(), pond.clone()];
        let expected = vec![vec![lake, island], vec![far], vec![pond, hole]];
        assert_eq!(grouped(rings), expected);
    }

    #[test]
    fn one_ring_is_an_outer_one_whatever_its_direction() {
        let ring = square(0.0, 0.0, 1.0, false);
        assert_eq!(grouped(vec![ring.clone()]), vec![vec![ring]]);
        assert!(grouped(Vec::new()).is_empty());
    }

    #[test]
    fn depth_decides_where_all_rings_run_counterclockwise() {
        let [a, b, c] = [
            square(0.0, 0.0, 9.0, false),
            square(1.0, 1.0, 3.0, false),
            square(2.0, 2.0, 1.0, false),
        ];
        let found = grouped(vec![b.clone(), a.clone(), c.clone()]);
        assert_eq!(found, vec![vec![a, b], vec![c]]);
    }

    #[test]
    fn rings_that_all_run_the_other_way_are_understood() {
        let [a, b] = [square(0.0, 0.0, 9.0, false), square(20.0, 0.0, 9.0, false)];
        let [hole, other] = [square(1.0, 1.0, 3.0, true), square(21.0, 1.0, 3.0, true)];
        let rings = vec![a.clone(), hole.clone(), b.clone(), other.clone()];
        assert_eq!(grouped(rings), vec![vec![a, hole], vec![b, other]]);
    }

    #[test]
    fn a_hole_in_no_ring_stays_where_it_is_found() {
        let [a, b] = [square(0.0, 0.0, 1.0, true), square(5.0, 0.0, 1.0, true)];
        let hole = square(9.0, 0.0, 1.0, false);
        let found = grouped(vec![a.clone(), hole.clone(), b.clone()]);
        assert_eq!(found, vec![vec![a, hole], vec![b]]);
    }

    #[test]
    fn a_hole_with_all_its_corners_on_its_ring_is_in_it() {
        let outer = square(0.0, 0.0, 2.0, true);
        let far = square(9.0, 9.0, 2.0, true);
        let mut hole = vec![outer[0], outer[1], outer[2], outer[0]];
        hole.reverse();
        assert_eq!(grouped(vec![far.clone(), outer.clone(), hole.clone()]).len(), 2);
    }
}
