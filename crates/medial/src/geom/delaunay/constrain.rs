//! Edges that are kept whatever circles say [Slo93], and circles that hold nothing visible [LL86].

use std::collections::VecDeque;

use super::quad_edge::{EdgeId, sym};
use super::{Delaunay, INFINITY};

/// Why two vertices cannot be joined.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Blocked {
    /// The two vertices.
    pub pair: [u32; 2],
    /// Both ends of an edge that is kept and crosses the way; twice a vertex that lies on it.
    pub by: [u32; 2],
}

impl Delaunay {
    /// Joins pairs of vertices, and keeps these edges: circles hold no vertex then that can be seen from inside their
    /// triangle, past edges that are kept. Gives how many pairs were not joined before. Pairs of a vertex with itself
    /// are passed over.
    ///
    /// ```
    /// use medial::geom::{Delaunay, Point};
    /// let points = [(0., 0.), (4., 0.), (2., 1.), (2., -1.)].map(|(x, y)| Point::new(x, y));
    /// let mut triangles = Delaunay::new(&points).ok_or("all on one line")?;
    /// let [a, b] = [0, 1].map(|point| triangles.vertex_of(point));
    /// assert!(triangles.edge_between(a, b).is_none());
    /// assert_eq!(triangles.constrain([(a, b)]), Ok(1));
    /// assert!(triangles.edge_between(a, b).is_some_and(|edge| triangles.is_kept(edge)));
    /// # Ok::<(), &str>(())
    /// ```
    ///
    /// # Errors
    /// What lies between two of these vertices, if that is a vertex or another edge of them. The triangulation is then
    /// of no use any more.
    pub fn constrain(
        &mut self,
        pairs: impl IntoIterator<Item = (u32, u32)>,
    ) -> Result<u32, Blocked> {
        self.kept.resize(self.edges.len() as usize, false);
        let mut missing = Vec::new();
        for (from, to) in pairs {
            match self.edge_between(from, to) {
                Some(edge) => self.kept[edge as usize >> 2] = true,
                None if from == to => {}
                None => missing.push((from, to)),
            }
        }
        if missing.is_empty() {
            return Ok(0);
        }
        let mut doubtful = Vec::new();
        for &(from, to) in &missing {
            // Flips for others may have joined them.
            if self.edge_between(from, to).is_none() {
                self.join(from, to, &mut doubtful)?;
            }
            if let Some(edge) = self.edge_between(from, to) {
                self.kept[edge as usize >> 2] = true;
            }
        }
        while let Some(edge) = doubtful.pop() {
            if self.is_kept(edge) || self.is_delaunay(edge) {
                continue;
            }
            let [left, right] = [edge, sym(edge)].map(|edge| self.edges.left_next(edge));
            let around = [left, self.edges.left_next(left), right, self.edges.left_next(right)];
            self.turn(edge);
            doubtful.extend(around);
        }
        self.number();
        Ok(missing.len() as u32)
    }

    /// Whether an edge is kept, whatever circles say.
    #[inline]
    #[must_use]
    pub fn is_kept(&self, edge: EdgeId) -> bool {
        self.kept.get(edge as usize >> 2).is_some_and(|&kept| kept)
    }

    /// Flips edges until two vertices are joined; notes the others that were flipped.
    fn join(&mut self, from: u32, to: u32, doubtful: &mut Vec<EdgeId>) -> Result<(), Blocked> {
        let mut crossing = self.crossed(from, to)?;
        // Each round flips one at least: of the edges that cross the way one has a convex quadrangle around it.
        while let Some(edge) = crossing.pop_front() {
            let [a, b] = [self.origin(edge), self.target(edge)];
            let [left, right] = [self.apex(edge), self.apex(sym(edge))];
            let is_convex =
                self.sites.orient(right, left, a) > 0.0 && self.sites.orient(left, right, b) > 0.0;
            if !is_convex {
                crossing.push_back(edge);
                continue;
            }
            self.turn(edge);
            let ends = [left, right];
            if ends.contains(&from) || ends.contains(&to) {
                doubtful.push(edge);
                continue;
            }
            let [l, r] = ends.map(|end| self.sites.orient(from, to, end));
            if (l > 0.0) == (r > 0.0) {
                doubtful.push(edge);
            } else {
                crossing.push_back(edge);
            }
        }
        Ok(())
    }

    /// The edges that cross the way between two vertices, in their order.
    fn crossed(&self, from: u32, to: u32) -> Result<VecDeque<EdgeId>, Blocked> {
        let side = |vertex: u32| self.sites.orient(from, to, vertex);
        let pair = [from, to];
        let mut crossed = VecDeque::new();
        let mut edge = None;
        for spoke in self.edges_out_of(from) {
            let (right, left) = (self.target(spoke), self.apex(spoke));
            if right == INFINITY {
                continue;
            }
            let at = side(right);
            if at == 0.0 && self.sites.opening(from, right, to) > 0.0 {
                return Err(Blocked { pair, by: [right; 2] });
            }
            if left != INFINITY && at < 0.0 && side(left) > 0.0 {
                edge = Some(self.next_around_face(spoke));
            }
        }
        let mut edge = edge.ok_or(Blocked { pair, by: [from; 2] })?;
        loop {
            if self.is_kept(edge) {
                return Err(Blocked { pair, by: [self.origin(edge), self.target(edge)] });
            }
            crossed.push_back(edge);
            let next = self.next_around_face(sym(edge));
            let apex = self.target(next);
            if apex == to {
                return Ok(crossed);
            }
            let at = side(apex);
            if at == 0.0 {
                return Err(Blocked { pair, by: [apex; 2] });
            }
            edge = if at > 0.0 { next } else { self.next_around_face(next) };
        }
    }

    /// Flips an edge, and notes another one out of its ends.
    fn turn(&mut self, edge: EdgeId) {
        for end in [edge, sym(edge)] {
            let origin = self.edges.origin(end);
            self.out[origin as usize] = self.edges.next(end);
        }
        self.edges.flip(edge);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geom::{Point, in_circle, orient2d};

    /// A comb: its edges cut through all circles between its teeth.
    fn comb(teeth: u32) -> Vec<Point> {
        let mut ring = vec![Point::new(0.0, -9.0)];
        for k in 0..teeth {
            let x = f64::from(k);
            ring.extend([
                Point::new(x + 0.5, f64::from(10 + 17 * (k % 4))),
                Point::new(x + 0.75, 0.0),
            ]);
        }
        ring.push(Point::new(f64::from(teeth) + 1.0, -9.0));
        ring.reverse();
        ring
    }

    #[test]
    fn edges_of_a_comb_are_kept_and_circles_hold_nothing_visible() {
        let ring = comb(12);
        let mut triangles = Delaunay::new(&ring).unwrap();
        let n = ring.len() as u32;
        let vertex: Vec<u32> = (0..n).map(|k| triangles.vertex_of(k)).collect();
        let pairs: Vec<(u32, u32)> =
            (0..n as usize).map(|k| (vertex[k], vertex[(k + 1) % n as usize])).collect();
        let missing = triangles.constrain(pairs.iter().copied()).unwrap();
        assert!(missing > 5, "{missing}");
        let crosses = |a: Point, b: Point, (c, d): (u32, u32)| {
            let [c, d] = [c, d].map(|v| triangles.point(v));
            orient2d(a, b, c) * orient2d(a, b, d) < 0.0
                && orient2d(c, d, a) * orient2d(c, d, b) < 0.0
        };
        for face in 0..triangles.n_faces() {
            let [a, b, c] = triangles.corners(face).map(|v| triangles.point(v));
            assert!(orient2d(a, b, c) > 0.0);
            let inside = (a + b + c) * (1.0 / 3.0);
            for d in (0..n).map(|d| triangles.point(d)) {
                let is_visible = !pairs.iter().any(|&pair| crosses(inside, d, pair));
                assert!(!is_visible || in_circle(a, b, c, d) <= 0.0);
            }
        }
        for (a, b) in pairs {
            let edge = triangles.edge_between(a, b).unwrap();
            assert!(triangles.is_kept(edge));
        }
        let euler = (triangles.n_faces(), 2 * n - 2 - triangles.n_hull());
        assert_eq!(euler.0, euler.1);
    }

    #[test]
    fn what_is_in_the_way_is_told() {
        let points = [(0.0, 0.0), (4.0, 0.0), (2.0, 0.0), (2.0, 2.0), (2.0, -2.0)];
        let points = points.map(|(x, y)| Point::new(x, y));
        let mut triangles = Delaunay::new(&points).unwrap();
        let [a, b, middle, top, bottom] = [0, 1, 2, 3, 4].map(|k| triangles.vertex_of(k));
        let blocked = |pair: [u32; 2]| Err(Blocked { pair, by: [middle; 2] });
        assert_eq!(triangles.clone().constrain([(a, b)]), blocked([a, b]));
        assert_eq!(triangles.constrain([(bottom, top)]), blocked([bottom, top]));
        let square =
            [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)].map(|(x, y)| Point::new(x, y));
        let mut triangles = Delaunay::new(&square).unwrap();
        let [a, b, c, d] = [0, 1, 2, 3].map(|k| triangles.vertex_of(k));
        let blocked = triangles.constrain([(a, c), (b, d)]).unwrap_err();
        let mut ends = [blocked.pair, blocked.by].concat();
        ends.sort_unstable();
        assert_eq!(ends, [0, 1, 2, 3]);
    }
}
