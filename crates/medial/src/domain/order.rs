//! The order of the holes: near ones follow one another.

use super::outlines::Outlines;
use super::rings::Rings;
use crate::geom::{Point, Rect, hilbert};

/// Rings that are not worth sorting for themselves.
const FEW_RINGS: usize = 8;

impl Outlines {
    /// The numbers of the walks, with the holes of each polygon along a Hilbert curve in the places
    /// where its holes are.
    ///
    /// Indices over edges in boundary order are then good whatever the order of the input.
    pub(super) fn order(&self) -> Vec<u32> {
        let corner = |walk: u32| {
            let outline = &self.list[walk as usize];
            self.points[(outline.first + outline.start) as usize]
        };
        let polygon = |walk: u32| self.list[walk as usize].polygon;
        let hole = |walk: u32| self.list[walk as usize].hole;
        holes_along_a_curve(self.list.len(), polygon, hole, corner)
    }
}

impl Rings<'_> {
    /// An order of the rings in which near ones follow one another: if there is one polygon, that
    /// of the walks they make if they touch nowhere; else all along a curve.
    pub(super) fn curve_order(&self) -> Vec<u32> {
        let n = self.rings.len();
        let ring = |number: u32| &self.rings[number as usize];
        if self.lone {
            let corner = |number| self.given_point(ring(number), ring(number).start());
            holes_along_a_curve(n, |_| 0, |number| ring(number).index > 0, corner)
        } else if n <= FEW_RINGS {
            (0..n as u32).collect()
        } else {
            holes_along_a_curve(n, |_| 0, |_| true, |number| self.given_point(ring(number), 0))
        }
    }

    /// The order of the walks they make if they touch nowhere.
    pub(super) fn walk_order(&self) -> Vec<u32> {
        let ring = |number: u32| &self.rings[number as usize];
        let corner = |number| self.given_point(ring(number), ring(number).start());
        let (polygon, hole) = (|number| ring(number).polygon, |number| ring(number).hole);
        holes_along_a_curve(self.rings.len(), polygon, hole, corner)
    }
}

/// The numbers 0 to `n - 1`, with the holes of each polygon along a Hilbert curve in the places
/// where its holes are.
fn holes_along_a_curve(
    n: usize,
    polygon: impl Fn(u32) -> u32,
    hole: impl Fn(u32) -> bool,
    corner: impl Fn(u32) -> Point,
) -> Vec<u32> {
    let mut order: Vec<u32> = (0..n as u32).collect();
    let n_holes = order.iter().filter(|&&w| hole(w)).count();
    if n_holes < 2 {
        return order;
    }
    let mut places = Vec::with_capacity(n_holes);
    places.extend(order.iter().copied().filter(|&w| hole(w)));
    if !places.is_sorted_by_key(|&w| polygon(w)) {
        places.sort_by_key(|&w| polygon(w));
    }
    let bounds = places.iter().fold(Rect::EMPTY, |all, &w| all.with(corner(w)));
    let mut keys = Vec::with_capacity(n_holes);
    for places in places.chunk_by(|&a, &b| polygon(a) == polygon(b)) {
        keys.clear();
        // Equal ones keep their order. A position on the curve has 32 bits.
        keys.extend(places.iter().map(|&w| hilbert(&bounds, corner(w)) << 32 | u64::from(w)));
        keys.sort_unstable();
        for (&place, &key) in places.iter().zip(&keys) {
            order[place as usize] = key as u32;
        }
    }
    order
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
                let walk = w.edges();
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
            for edge in walk.edges() {
                assert_eq!(d.edge(edge).walk, number);
                assert_eq!(d.edge(d.edge(edge).next).prev, edge);
                let ring = d.origin(edge).ring;
                assert_eq!(ring == 0, !walk.hole);
                // The line of an edge is named by its first edge.
                let line = d.line(edge);
                assert!(line <= edge && d.line(line) == line);
                let Point { x, y } = d.edge(edge).start;
                let end = d.end(edge);
                let on = |p: Point| (x == end.x && p.x == x) || (y == end.y && p.y == y);
                assert!(on(d.edge(line).start) && on(d.end(line)), "{:?}", Site::edge(edge));
            }
        }
    }
}
