//! The order of the holes: near ones follow one another.

use super::{Domain, Edge, Walk};
use crate::geom::{Rect, hilbert};

impl Domain {
    /// The same domain with the holes of each polygon along a Hilbert curve, in the places where
    /// its holes were.
    ///
    /// Indices over edges in boundary order are then good whatever the order of the input.
    pub(super) fn with_holes_along_a_curve(self) -> Self {
        let order = self.walk_order();
        let Self { edges, origins, walks, report } = self;
        let mut first = vec![0; walks.len()];
        let mut number = vec![0; walks.len()];
        let mut sorted: Vec<Walk> = Vec::with_capacity(walks.len());
        let mut next = 0;
        for (new, &old) in order.iter().enumerate() {
            first[old] = next;
            number[old] = new as u32;
            sorted.push(Walk { first: next, ..walks[old] });
            next += walks[old].len;
        }
        let moved = |edge: u32| {
            let walk = edges[edge as usize].walk as usize;
            edge - walks[walk].first + first[walk]
        };
        // The number of a line is that of its first edge.
        let mut least = vec![u32::MAX; edges.len()];
        for (old, edge) in (0..).zip(&edges) {
            let line = &mut least[edge.line as usize];
            *line = (*line).min(moved(old));
        }
        let old_edges =
            || order.iter().flat_map(|&w| walks[w].first..walks[w].first + walks[w].len);
        let sorted_edges = old_edges().map(|old| {
            let edge = edges[old as usize];
            Edge {
                next: moved(edge.next),
                prev: moved(edge.prev),
                walk: number[edge.walk as usize],
                line: least[edge.line as usize],
                ..edge
            }
        });
        Self {
            edges: sorted_edges.collect(),
            origins: old_edges().map(|old| origins[old as usize]).collect(),
            walks: sorted,
            report,
        }
    }

    /// The old numbers of the walks in their new order.
    fn walk_order(&self) -> Vec<usize> {
        let corner = |walk: usize| self.edge(self.walks[walk].first).start;
        let holes: Vec<usize> = (0..self.walks.len()).filter(|&w| self.walks[w].hole).collect();
        let bounds = holes.iter().fold(Rect::EMPTY, |all, &w| all.with(corner(w)));
        let mut sorted = holes.clone();
        // Equal keys keep their order.
        sorted.sort_by_cached_key(|&w| (self.walks[w].polygon, hilbert(&bounds, corner(w))));
        let mut places = holes;
        places.sort_by_key(|&w| self.walks[w].polygon);
        let mut order: Vec<usize> = (0..self.walks.len()).collect();
        for (place, walk) in places.into_iter().zip(sorted) {
            order[place] = walk;
        }
        order
    }
}

#[cfg(test)]
mod tests {
    use crate::domain::{Domain, Options, Site};
    use crate::geom::Point;

    /// A square with square holes, two of them on one line, in the given order.
    fn domain(order: &[usize]) -> Domain {
        let square = |x: f64, y: f64, side: f64| {
            [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)]
                .map(|(a, b)| Point::new(x + a, y + b))
                .to_vec()
        };
        let holes = [(1.0, 1.0), (7.0, 7.0), (1.0, 7.0), (7.0, 1.0), (4.0, 4.0)];
        let mut rings = vec![square(0.0, 0.0, 10.0)];
        rings.extend(order.iter().map(|&k| square(holes[k].0, holes[k].1, 1.0)));
        Domain::from_polygons(&[rings], &Options::default()).expect("apart from one another")
    }

    #[test]
    fn holes_come_in_one_order_whatever_the_input() {
        let starts = |d: &Domain| -> Vec<Point> { d.edges().iter().map(|e| e.start).collect() };
        let expected = starts(&domain(&[0, 1, 2, 3, 4]));
        for order in [[4, 3, 2, 1, 0], [2, 0, 4, 1, 3]] {
            assert_eq!(starts(&domain(&order)), expected);
        }
        // Lower left, upper left, middle, upper right, lower right: the outer square stays first.
        let corners: Vec<(f64, f64)> = domain(&[0, 1, 2, 3, 4])
            .walks()
            .iter()
            .map(|w| {
                let walk = w.first..w.first + w.len;
                let start = |e: u32| domain(&[0, 1, 2, 3, 4]).edge(e).start;
                let low = walk.map(start).min_by(|a, b| a.lexicographic(*b)).expect("edges");
                (low.x, low.y)
            })
            .collect();
        assert_eq!(corners[0], (0.0, 0.0));
        assert_eq!((corners[1], corners[5]), ((1.0, 1.0), (7.0, 1.0)));
    }

    #[test]
    fn links_lines_and_names_move_with_their_holes() {
        let d = domain(&[3, 1, 0, 4, 2]);
        for (number, walk) in (0..).zip(d.walks()) {
            for edge in walk.first..walk.first + walk.len {
                assert_eq!(d.edge(edge).walk, number);
                assert_eq!(d.edge(d.edge(edge).next).prev, edge);
                let ring = d.origin(edge).ring;
                assert_eq!(ring == 0, !walk.hole);
                // The line of an edge is named by its first edge.
                let line = d.edge(edge).line;
                assert!(line <= edge && d.edge(line).line == line);
                let Point { x, y } = d.edge(edge).start;
                let end = d.end(edge);
                let on = |p: Point| (x == end.x && p.x == x) || (y == end.y && p.y == y);
                assert!(on(d.edge(line).start) && on(d.end(line)), "{:?}", Site::edge(edge));
            }
        }
    }
}
