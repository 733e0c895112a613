//! Where corners of one polygon touch edges of another.

use super::Domain;
use super::apart::apart;
use super::rings::Rings;
use super::sweep::{Purpose, sweep};
use crate::geom::Point;

impl Domain {
    /// Edges that corners touch in their inside, with these corners: edge by edge, in order from the start of each. `None` if
    /// no two polygons touch.
    ///
    /// What touches an edge of its own polygon has cut it; these are corners of other polygons.
    pub(crate) fn touched_edges(&self) -> Option<Vec<(u32, Point)>> {
        let walks = self.walks();
        let is_one = walks.windows(2).all(|pair| pair[0].polygon == pair[1].polygon);
        if is_one {
            return None;
        }
        let rings = Rings::of_walks(self);
        if apart(&rings).is_some() {
            return None;
        }
        // That walks fit one another is known.
        let found = sweep(&rings, Purpose::Validate).unwrap_or_default();
        let mut touched = found.touched;
        touched.sort_by(|&(a, p), &(b, q)| {
            let is_forward = self.edge(a).start.lexicographic(self.end(a)).is_lt();
            let along = p.lexicographic(q);
            a.cmp(&b).then(if is_forward { along } else { along.reverse() })
        });
        Some(touched)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Domain, Options};
    use super::*;

    fn domain(polygons: &[&[(f64, f64)]]) -> Domain {
        let ring =
            |ring: &&[(f64, f64)]| vec![ring.iter().map(|&(x, y)| Point::new(x, y)).collect()];
        let polygons: Vec<Vec<Vec<Point>>> = polygons.iter().map(ring).collect();
        Domain::from_polygons(&polygons, &Options::default()).unwrap()
    }

    #[test]
    fn a_corner_of_another_polygon_is_found_on_an_edge() {
        let below: &[(f64, f64)] = &[(0., 0.), (4., 0.), (4., -4.), (0., -4.)];
        let above = [[(1., 0.), (2., 3.), (0., 3.)], [(3., 0.), (4., 3.), (2.5, 3.)]];
        let found = domain(&[below, &above[0], &above[1]]);
        let at = |x: f64| Point::new(x, 0.0);
        let touched = found.touched_edges().unwrap();
        let points: Vec<Point> = touched.iter().map(|touch| touch.1).collect();
        let edge = touched[0].0;
        assert!(touched.iter().all(|touch| touch.0 == edge));
        assert_eq!([found.edge(edge).start, found.end(edge)], [at(4.0), at(0.0)]);
        assert_eq!(points, [at(3.0), at(1.0)], "from the start of the edge");
        // Corners on corners touch no edge.
        assert_eq!(domain(&[below, &[(4., 0.), (6., 1.), (4., 2.)]]).touched_edges(), Some(vec![]));
        assert_eq!(domain(&[below, &[(1., 1.), (2., 3.), (0., 3.)]]).touched_edges(), None);
    }

    #[test]
    fn the_ends_of_a_shared_part_are_found() {
        let below: &[(f64, f64)] = &[(0., 0.), (4., 0.), (4., -4.), (0., -4.)];
        let found = domain(&[below, &[(1., 0.), (5., 0.), (5., 1.), (1., 1.)]]);
        let points: Vec<Point> =
            found.touched_edges().unwrap().iter().map(|touch| touch.1).collect();
        assert_eq!(points.len(), 2, "{points:?}");
        assert!([1.0, 4.0].iter().all(|&x| points.contains(&Point::new(x, 0.0))));
    }
}
