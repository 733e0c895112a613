//! The edges whose distances are compared: vertex types, merging of straight edges, line coefficients, and
//! which two edges make no pair (A.1, A.3 to A.5, A.7, A.8).

use super::rings::Ring;
use crate::geom::{Point, orient2d};

/// How the boundary turns at a vertex, seen from the side of the axis (A.1.g).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum VertexType {
    Concave,
    Colinear,
    Convex,
}

impl VertexType {
    /// The type of the vertex `b` between two others, straight if the boundary turns by an angle of no larger
    /// sine, and by no more than a quarter of a turn (A.4).
    pub fn of(a: Point, b: Point, c: Point, sine: f64) -> Self {
        let (into, out) = (b - a, c - b);
        let turn = into.cross(out) / (into.norm() * out.norm());
        if into.dot(out) >= 0.0 && turn.abs() <= sine {
            return Self::Colinear;
        }
        // The sign is that of the true turn.
        let turn = orient2d(a, b, c);
        if turn > 0.0 {
            Self::Convex
        } else if turn < 0.0 {
            Self::Concave
        } else {
            Self::Colinear
        }
    }
}

/// When edges are merged to one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Merging {
    /// The sine of the angle up to which a vertex is straight.
    pub sine: f64,
    /// How far a vertex may be from the edge that it is merged into, in units of the plane.
    pub drift: f64,
    /// The same for the corners that it stands for, where it is the middle of a step.
    pub corner_drift: f64,
}

/// An edge: the `Segment_Node` of the report (A.1.i). Places count from the origin of the grid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    pub start: Point,
    pub end: Point,
    pub contour: u32,
    /// `A² + B²` of the line through both ends (A.5).
    length2: f64,
}

impl Edge {
    fn new(start: Point, end: Point, contour: u32) -> Self {
        Self { start, end, contour, length2: (end - start).norm2() }
    }

    /// `Ax + By + C` of a point, with C counted from the start, so that no large numbers cancel.
    #[inline]
    fn across(&self, p: Point) -> f64 {
        (self.end - self.start).cross(p - self.start)
    }

    /// The square of the distance of a point (A.7).
    #[inline]
    pub fn squared(&self, p: Point) -> f64 {
        let along = self.end - self.start;
        let way = p - self.start;
        if way.dot(along) <= 0.0 {
            return way.norm2();
        }
        let back = p - self.end;
        if back.dot(along) >= 0.0 {
            return back.norm2();
        }
        let across = self.across(p);
        across * across / self.length2
    }

    /// A distance that the edge is not nearer to a point than (A.6.a): the greater one of those along both axes.
    #[inline]
    pub fn lower_bound(&self, p: Point) -> f64 {
        let one = |a: f64, b: f64| {
            // Ends on different sides leave no distance.
            if (a < 0.0) == (b < 0.0) { a.abs().min(b.abs()) } else { 0.0 }
        };
        let x = one(self.start.x - p.x, self.end.x - p.x);
        x.max(one(self.start.y - p.y, self.end.y - p.y))
    }

    /// Whether a point lies farther behind the line of the edge than a distance, on its right.
    #[inline]
    fn turns_its_back_to(&self, p: Point, by: f64) -> bool {
        let across = self.across(p);
        across < 0.0 && across * across > by * by * self.length2
    }
}

/// Which edges beside the nearest one are no second nearest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RidgePairs {
    /// Those that meet it at a concave vertex, as in the report.
    Adjacent,
    /// Those from which the boundary leads to it without a corner that an axis could end in: over concave
    /// vertices, turning by no more than half a turn, and along curves that are rounder than the disk. And
    /// those whose back is turned to the pixel.
    #[default]
    Linked,
}

/// A contour: its edges are consecutive.
#[derive(Clone, Copy, Debug)]
pub(super) struct Contour {
    pub first: u32,
    pub len: u32,
    /// Connected component of the side of the axis.
    pub component: u32,
    /// Whether it is the outer one of its component.
    pub is_outer: bool,
}

/// The edges of all contours.
#[derive(Debug)]
pub(super) struct Edges {
    pub edges: Vec<Edge>,
    pub contours: Vec<Contour>,
    pairs: RidgePairs,
    /// The size of a cell.
    cell: f64,
    /// The type of the vertex where each edge starts; none is merely nearly straight.
    types: Vec<VertexType>,
    /// Runs of edges without a sharp corner between them, by number.
    run: Vec<u32>,
    /// Sums over the vertices before each edge, without that where it starts: of turns to the right in
    /// radians, and of sharp corners.
    turns: Vec<f64>,
    sharp: Vec<u32>,
    /// The least radii of curvature, where curves are known.
    radii: Option<RangeMin>,
}

/// Half a turn, and what rounding may add.
const HALF_TURN: f64 = std::f64::consts::PI * (1.0 + 1e-9);

impl Edges {
    pub fn new(
        rings: &[Ring],
        origin: Point,
        merging: Merging,
        pairs: RidgePairs,
        cell: f64,
    ) -> Self {
        let (mut edges, mut contours) = (Vec::new(), Vec::new());
        let (mut types, mut right, mut radii) = (Vec::new(), Vec::new(), Vec::new());
        for (number, ring) in (0..).zip(rings) {
            let points = &ring.points;
            let n = points.len();
            let around = |k: usize| [points[(k + n - 1) % n], points[k], points[(k + 1) % n]];
            let is_straight = |k: usize| {
                let [a, b, c] = around(k);
                let is_curved = ring.is_curved(k) || ring.is_curved((k + n - 1) % n);
                !is_curved && VertexType::of(a, b, c, merging.sine) == VertexType::Colinear
            };
            let kept = merge(ring, is_straight, &merging);
            let first = edges.len() as u32;
            let len = kept.len();
            for (place, &k) in kept.iter().enumerate() {
                let before = points[kept[(place + len - 1) % len]];
                let (at, after) = (points[k], points[kept[(place + 1) % len]]);
                edges.push(Edge::new(at - origin, after - origin, number));
                // Seen anew, as merged edges have other directions.
                let vertex = VertexType::of(before, at, after, -1.0);
                let (into, out) = (at - before, after - at);
                let turn = into.cross(out).atan2(into.dot(out));
                right.push(if vertex == VertexType::Concave { -turn } else { 0.0 });
                types.push(vertex);
                radii.push(if vertex == VertexType::Convex {
                    ring.radii.get(k).copied().unwrap_or(0.0)
                } else {
                    f64::INFINITY
                });
            }
            let Ring { component, is_outer, .. } = *ring;
            contours.push(Contour { first, len: len as u32, component, is_outer });
        }
        let is_sharp = |radius: &f64| *radius == 0.0;
        let (mut turns, mut sharp) = (vec![0.0], vec![0]);
        for (turn, radius) in right.iter().zip(&radii) {
            turns.push(turns[turns.len() - 1] + turn);
            sharp.push(sharp[sharp.len() - 1] + u32::from(is_sharp(radius)));
        }
        let mut run = Vec::with_capacity(edges.len());
        let mut next = 0;
        for contour in &contours {
            let (first, end) = (contour.first as usize, (contour.first + contour.len) as usize);
            let start = next;
            for (place, radius) in radii[first..end].iter().enumerate() {
                next += u32::from(place == 0 || is_sharp(radius));
                run.push(next);
            }
            // Round the start of the contour the last run goes on with the first one.
            let (last, head) = (next, start + 1);
            if !is_sharp(&radii[first]) && last != head {
                run[first..end].iter_mut().filter(|run| **run == last).for_each(|run| *run = head);
            }
        }
        let is_curved = radii.iter().any(|r| *r > 0.0 && r.is_finite());
        let radii = is_curved.then(|| RangeMin::new(&radii));
        Self { edges, contours, pairs, cell, types, run, turns, sharp, radii }
    }

    pub fn len(&self) -> u32 {
        self.edges.len() as u32
    }

    /// The edge before one along its contour.
    pub fn before(&self, edge: u32) -> u32 {
        let Contour { first, len, .. } = self.contours[self.edges[edge as usize].contour as usize];
        if edge == first { first + len - 1 } else { edge - 1 }
    }

    /// Whether the second edge is no second nearest one of a point to which the first is nearest, at a distance.
    pub fn is_no_pair(&self, first: u32, second: u32, point: Point, distance: f64) -> bool {
        match self.pairs {
            RidgePairs::Adjacent => self.meet_concavely(first, second),
            RidgePairs::Linked => {
                self.are_linked(first, second, distance)
                    || self.edges[second as usize].turns_its_back_to(point, 0.5 * self.cell)
            }
        }
    }

    /// Whether two edges are incident at a concave vertex (A.8).
    fn meet_concavely(&self, a: u32, b: u32) -> bool {
        let is_at = |before: u32, after: u32| {
            self.before(after) == before && self.types[after as usize] != VertexType::Convex
        };
        self.edges[a as usize].contour == self.edges[b as usize].contour
            && (is_at(a, b) || is_at(b, a))
    }

    fn are_linked(&self, a: u32, b: u32, distance: f64) -> bool {
        self.run[a as usize] == self.run[b as usize]
            && (self.leads(a, b, distance) || self.leads(b, a, distance))
    }

    /// Whether the boundary leads from one edge to another one of the same contour without anything that two
    /// feet of one disk could have between them.
    ///
    /// A curve that is nowhere rounder to the left than the disk leaves it to the right where it touches it, and
    /// does not come back before it has turned by more than half a turn.
    fn leads(&self, from: u32, to: u32, distance: f64) -> bool {
        let Contour { first, len, .. } = self.contours[self.edges[from as usize].contour as usize];
        let pieces = if from < to {
            [(from + 1, to + 1), (0, 0)]
        } else {
            [(from + 1, first + len), (first, to + 1)]
        };
        let pieces = pieces.map(|(a, b)| (a as usize, b as usize));
        let sharp: u32 = pieces.iter().map(|&(a, b)| self.sharp[b] - self.sharp[a]).sum();
        let turn: f64 = pieces.iter().map(|&(a, b)| self.turns[b] - self.turns[a]).sum();
        sharp == 0
            && turn <= HALF_TURN
            && self.radii.as_ref().is_none_or(|radii| {
                // Within a cell the disk at the end of an axis is as round as the curve.
                pieces.iter().all(|&(a, b)| radii.least(a, b) >= distance + self.cell)
            })
    }

    /// Whether some two edges may be a pair: not if all there is bounds one convex set from outside.
    pub fn has_pairs(&self) -> bool {
        let n = self.edges.len();
        let is_one_convex_set = self.pairs == RidgePairs::Linked
            && self.contours.len() == 1
            && self.radii.is_none()
            && self.sharp[n] == 0
            && self.turns[n] <= 2.0 * HALF_TURN;
        !is_one_convex_set && n > 1
    }

    /// For each bounded component a point in it, and the box of its outer contour: from the highest vertex and
    /// its neighbours, lowered to the height of the highest concave vertex (A.3.c).
    ///
    /// The point lies on the boundary where several vertices are highest, so whoever asks looks.
    pub fn seeds(&self) -> Vec<(Point, [Point; 2])> {
        let mut order: Vec<&Contour> = self.contours.iter().collect();
        order.sort_by_key(|contour| (contour.component, !contour.is_outer));
        let seed = |contours: &[&Contour]| {
            let outer = contours.first().filter(|contour| contour.is_outer)?;
            let edges = |c: &Contour| c.first..c.first + c.len;
            let at = |edge: u32| self.edges[edge as usize].start;
            let vertices = contours.iter().flat_map(|contour| edges(contour));
            let concave = vertices.filter(|&k| self.types[k as usize] == VertexType::Concave);
            let floor = concave.map(|k| at(k).y).fold(f64::NEG_INFINITY, f64::max);
            let highest = edges(outer).reduce(|a, b| if at(b).y > at(a).y { b } else { a })?;
            let b = at(highest);
            let lowered = |p: Point| {
                if p.y >= floor { p } else { b + (p - b) * ((floor - b.y) / (p.y - b.y)) }
            };
            let next = lowered(self.edges[highest as usize].end);
            let before = lowered(at(self.before(highest)));
            let low = edges(outer).map(at).reduce(|a, b| Point::new(a.x.min(b.x), a.y.min(b.y)))?;
            let high =
                edges(outer).map(at).reduce(|a, b| Point::new(a.x.max(b.x), a.y.max(b.y)))?;
            Some(((b + next + before) * (1.0 / 3.0), [low, high]))
        };
        order.chunk_by(|a, b| a.component == b.component).filter_map(seed).collect()
    }
}

/// The vertices that are left if straight ones go, as long as none is farther from its edge than it may be.
fn merge(ring: &Ring, is_straight: impl Fn(usize) -> bool, merging: &Merging) -> Vec<usize> {
    let points = &ring.points;
    let n = points.len();
    let first = (0..n).find(|&k| !is_straight(k)).unwrap_or(0);
    let mut kept = vec![first];
    let mut cone = Cone::new(points[first]);
    for k in (first + 1..first + n).map(|k| k % n) {
        if is_straight(k) {
            cone.pass(points[k], merging.drift);
            let corners = ring.corners.get(k).into_iter().flatten();
            corners.for_each(|&corner| cone.pass(corner, merging.corner_drift));
            if cone.leads_to(points[(k + 1) % n], points[k]) {
                continue;
            }
        }
        kept.push(k);
        cone = Cone::new(points[k]);
    }
    if kept.len() < 3 {
        return (0..n).collect();
    }
    kept.sort_unstable();
    kept
}

/// The directions of edges from a vertex that pass all vertices after it closely.
struct Cone {
    apex: Point,
    /// The direction from which angles count.
    base: Option<Point>,
    low: f64,
    high: f64,
}

impl Cone {
    const fn new(apex: Point) -> Self {
        Self { apex, base: None, low: f64::NEG_INFINITY, high: f64::INFINITY }
    }

    /// The angle of a direction.
    fn angle(&mut self, way: Point) -> f64 {
        let base = *self.base.get_or_insert(way);
        base.cross(way).atan2(base.dot(way))
    }

    /// Keeps the directions that pass a point within a distance.
    fn pass(&mut self, point: Point, within: f64) {
        let way = point - self.apex;
        let length = way.norm();
        if length > within {
            let (own, half) = (self.angle(way), (within / length).asin());
            self.low = self.low.max(own - half);
            self.high = self.high.min(own + half);
        }
    }

    /// Whether an edge to a point is one of them, and goes on from the last point.
    fn leads_to(&mut self, next: Point, last: Point) -> bool {
        let onwards = next - self.apex;
        let towards = self.angle(onwards);
        self.low <= towards && towards <= self.high && (next - last).dot(onwards) >= 0.0
    }
}

/// The least of any range of numbers.
#[derive(Debug)]
struct RangeMin {
    /// Of `2^level` numbers from each place on.
    levels: Vec<Vec<f64>>,
}

impl RangeMin {
    fn new(numbers: &[f64]) -> Self {
        let mut levels = vec![numbers.to_vec()];
        let mut width = 1;
        while 2 * width <= numbers.len() {
            let below = &levels[levels.len() - 1];
            let level = below.iter().zip(&below[width..]).map(|(a, b)| a.min(*b)).collect();
            levels.push(level);
            width *= 2;
        }
        Self { levels }
    }

    /// The least from one place up to, but not at, another one; infinite for none.
    fn least(&self, from: usize, to: usize) -> f64 {
        if from >= to {
            return f64::INFINITY;
        }
        let level = (to - from).ilog2();
        let numbers = &self.levels[level as usize];
        numbers[from].min(numbers[to - (1 << level)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(points: &[(f64, f64)]) -> Ring {
        let points = points.iter().map(|&(x, y)| Point::new(x, y)).collect();
        Ring {
            points,
            component: 0,
            is_outer: true,
            radii: Vec::new(),
            curved: Vec::new(),
            corners: Vec::new(),
        }
    }

    fn edges(points: &[(f64, f64)], degrees: f64, drift: f64) -> Edges {
        let merging = Merging { sine: degrees.to_radians().sin(), drift, corner_drift: drift };
        Edges::new(&[ring(points)], Point::default(), merging, RidgePairs::Linked, 1.0)
    }

    #[test]
    fn vertex_types_have_a_tolerance() {
        let [a, b] = [Point::new(0.0, 0.0), Point::new(1.0, 0.0)];
        let at = |x: f64, y: f64| VertexType::of(a, b, Point::new(x, y), 5_f64.to_radians().sin());
        assert_eq!(at(2.0, 0.08), VertexType::Colinear);
        assert_eq!(at(2.0, -0.08), VertexType::Colinear);
        assert_eq!(at(2.0, 0.09), VertexType::Convex);
        assert_eq!(at(2.0, -0.09), VertexType::Concave);
        // Nearly back where it came from.
        assert_eq!(at(0.0, 0.01), VertexType::Convex);
        assert_eq!(at(0.0, -0.01), VertexType::Concave);
    }

    #[test]
    fn straight_edges_are_merged() {
        let square = [(0., 0.), (1., 0.), (2., 0.), (4., 0.), (4., 4.), (2., 4.01), (0., 4.)];
        assert_eq!(edges(&square, 5.0, 0.5).len(), 4);
        assert_eq!(edges(&square, 0.0, 0.5).len(), 5);
    }

    #[test]
    fn merged_edges_do_not_drift() {
        // A circle of radius 1000, every joint of which is nearly straight.
        let n = 720;
        let circle: Vec<(f64, f64)> = (0..n)
            .map(|k| (f64::from(k) * std::f64::consts::TAU / f64::from(n)).sin_cos())
            .map(|(sin, cos)| (1000.0 * cos, 1000.0 * sin))
            .collect();
        for drift in [0.5, 2.0, 50.0] {
            let merged = edges(&circle, 5.0, drift);
            for &(x, y) in &circle {
                let p = Point::new(x, y);
                let least = merged.edges.iter().map(|e| e.squared(p)).fold(f64::INFINITY, f64::min);
                assert!(least.sqrt() <= drift * 1.000_001, "{drift}: {}", least.sqrt());
            }
            // About as few as that allows: the sagitta of a chord of half the angle a is 1000 (1 - cos a).
            let angle = 2.0 * (1.0 - drift / 1000.0_f64).acos();
            let least = std::f64::consts::TAU / angle;
            assert!(f64::from(merged.len()) <= 1.5 * least + 2.0, "{drift}: {}", merged.len());
        }
    }

    #[test]
    fn lower_bounds_are_below_distances() {
        let edge = Edge::new(Point::new(1.0, 2.0), Point::new(4.0, 3.0), 0);
        for k in 0..400 {
            let p = Point::new(f64::from(k % 20) * 0.4 - 1.0, f64::from(k / 20) * 0.4 - 1.0);
            assert!(edge.lower_bound(p).powi(2) <= edge.squared(p) + 1e-12, "{p:?}");
        }
        assert_eq!(edge.lower_bound(Point::new(0.0, 2.5)), 1.0);
        assert_eq!(edge.lower_bound(Point::new(2.0, 2.5)), 0.0);
        assert_eq!(edge.lower_bound(Point::new(0.0, 5.0)), 2.0);
    }

    #[test]
    fn a_chain_of_concave_vertices_links_its_edges() {
        // A notch with a rounded tip, three edges around it: a triangle with one side bent inwards.
        let shape = [(0., 0.), (10., 0.), (5.4, 5.0), (5.2, 5.3), (4.8, 5.3), (4.6, 5.0)];
        let linked = edges(&shape, 0.0, 0.0);
        let above = Point::new(5.0, 8.0);
        for (a, b) in [(1, 2), (1, 3), (1, 4), (2, 5)] {
            assert!(linked.is_no_pair(a, b, above, 1.0), "{a} {b}");
            assert!(linked.is_no_pair(b, a, above, 1.0), "{a} {b}");
        }
        // Over the convex corners.
        assert!(!linked.is_no_pair(0, 1, Point::new(9.0, 0.5), 0.1));
        assert!(!linked.is_no_pair(0, 5, Point::new(1.0, 0.5), 0.1));
    }

    #[test]
    fn seeds_are_inside_where_one_vertex_is_highest() {
        let shape = edges(&[(0., 0.), (10., 0.), (9., 8.), (5., 4.), (3., 9.)], 0.0, 0.0);
        let seeds = shape.seeds();
        let expected = Point::new((3.0 + 5.0 + 4.0 / 3.0) / 3.0, (9.0 + 4.0 + 4.0) / 3.0);
        assert!((seeds[0].0 - expected).norm() < 1e-12, "{seeds:?}");
    }

    #[test]
    fn the_least_of_a_range_is_found() {
        let numbers = [5.0, 3.0, 4.0, 1.0, 7.0, 2.0, 9.0];
        let table = RangeMin::new(&numbers);
        for a in 0..=numbers.len() {
            for b in a..=numbers.len() {
                let least = numbers[a..b].iter().copied().fold(f64::INFINITY, f64::min);
                assert_eq!(table.least(a, b), least);
            }
        }
    }
}
