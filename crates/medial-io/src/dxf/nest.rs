//! Outlines that lie in one another.

use crate::curves::{Contour, flatten};
use medial::geom::{Point, Rect};

/// An outline with those that are its holes.
pub(super) struct Nest {
    /// How many outlines it lies in, an even number.
    pub depth: usize,
    /// The numbers of the outline and of its holes.
    pub rings: Vec<usize>,
}

/// Groups closed outlines by their depth: each at an even depth is the outer ring of those directly in it.
pub(super) fn nests(contours: &[&Contour]) -> Vec<Nest> {
    let rings: Vec<Ring> = contours.iter().map(|contour| Ring::new(contour)).collect();
    let mut order: Vec<usize> = (0..rings.len()).collect();
    order.sort_by(|a, b| rings[*a].bounds.min.x.total_cmp(&rings[*b].bounds.min.x));
    let mut around: Vec<Vec<usize>> = vec![Vec::new(); rings.len()];
    let mut active: Vec<usize> = Vec::new();
    for k in order {
        let left = rings[k].bounds.min.x;
        active.retain(|other| rings[*other].bounds.max.x >= left);
        for other in &active {
            let (own, other_ring) = (&rings[k], &rings[*other]);
            if other_ring.holds(own) {
                around[k].push(*other);
            } else if own.holds(other_ring) {
                around[*other].push(k);
            }
        }
        active.push(k);
    }
    let mut holes: Vec<Vec<usize>> = (0..rings.len()).map(|k| vec![k]).collect();
    for k in 0..rings.len() {
        if around[k].len() % 2 == 1 {
            let smallest = around[k].iter().copied().filter(|o| around[*o].len().is_multiple_of(2));
            let outer = smallest.min_by(|a, b| rings[*a].area.total_cmp(&rings[*b].area));
            match outer {
                Some(outer) => holes[outer].push(k),
                // Outlines that cross may surround one another without order.
                None => around[k].clear(),
            }
        }
    }
    (0..rings.len())
        .filter(|k| around[*k].len().is_multiple_of(2))
        .map(|k| Nest { depth: around[k].len(), rings: std::mem::take(&mut holes[k]) })
        .collect()
}

struct Ring {
    points: Vec<Point>,
    bounds: Rect,
    area: f64,
}

impl Ring {
    fn new(contour: &Contour) -> Self {
        let flat = flatten(std::slice::from_ref(&vec![contour.clone()]), None);
        let points = flat.map(|(mut rings, _)| rings.remove(0).remove(0)).unwrap_or_default();
        let bounds = points.iter().copied().fold(Rect::EMPTY, Rect::with);
        let next = points.iter().cycle().skip(1);
        let area: f64 = points.iter().zip(next).map(|(a, b)| a.cross(*b)).sum();
        Self { points, bounds, area: area.abs() }
    }

    /// Whether most of three corners of another ring lie in it, and its box does.
    fn holds(&self, other: &Self) -> bool {
        let n = other.points.len();
        let (own, box_of) = (&self.bounds, &other.bounds);
        n > 0
            && other.area < self.area
            && own.min.x <= box_of.min.x
            && own.min.y <= box_of.min.y
            && box_of.max.x <= own.max.x
            && box_of.max.y <= own.max.y
            && [0, n / 3, 2 * n / 3].iter().filter(|k| self.winds(other.points[**k])).count() >= 2
    }

    /// Whether it goes around a point an odd number of times.
    fn winds(&self, p: Point) -> bool {
        let mut inside = false;
        let next = self.points.iter().cycle().skip(1);
        for (a, b) in self.points.iter().zip(next) {
            if (a.y > p.y) != (b.y > p.y) {
                let side = (*b - *a).cross(p - *a);
                inside ^= (side > 0.0) == (b.y > a.y);
            }
        }
        inside
    }
}
