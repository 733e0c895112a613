//! The axis: edges of the dual graph replaced by Voronoi edges, with the elements that their samples lie on.

use super::dual::{Dual, DualEdge};
use super::residuals::Left;
use super::samples::{Plane, Samples};
use crate::axis::{
    self, Accuracy, Engine, Keypoint, KeypointKind, KeypointTable, MedialAxis, Path, PathTable,
    Side, SiteTable,
};
use crate::engine::EngineError;
use crate::geom::{Delaunay, EdgeId, Point, Rect};

/// What an axis is made of.
pub(super) struct Drawn<'a> {
    pub samples: &'a Samples,
    pub triangles: &'a Delaunay,
    pub dual: &'a Dual,
    /// Centres and radii of groups, in the plane of the samples.
    pub disks: &'a [(Point, f64)],
    pub plane: Plane,
    /// Outside, where the axis ends, in the plane of the samples.
    pub frame: Option<Rect>,
    /// What is left of the dual graph.
    pub left: &'a Left,
    /// Whether branches go on into corners.
    pub ends: bool,
}

/// What an axis says of itself.
pub(super) struct Label {
    pub side: Side,
    pub complete: bool,
    pub spacing: f64,
}

/// A path, or what a frame leaves of it.
struct Piece {
    from: End,
    to: End,
    left: u32,
    right: u32,
    /// One of the two samples that it is as far from, in the plane of the input, if it is a Voronoi edge.
    sample: Option<Point>,
}

/// Where a piece ends: in a node, on the frame, at a place of this radius, or in a corner.
#[derive(Clone, Copy)]
enum End {
    Node(u32),
    Clipped(Point, f64),
    Corner(Point),
}

impl Drawn<'_> {
    /// The axis, with the elements that govern something as sites.
    pub fn axis(
        &self,
        n_elements: usize,
        record: impl Fn(u32) -> axis::Site,
        label: &Label,
    ) -> Result<MedialAxis, EngineError> {
        let mut degrees = vec![0_u32; self.dual.n_nodes()];
        let mut pieces = Vec::with_capacity(self.left.edges.len());
        let edges = self.left.edges.iter().map(|&edge| self.dual.edges[edge as usize]);
        pieces.extend(edges.filter_map(|edge| self.piece(edge)));
        if self.ends {
            pieces.extend(self.dual.walls.iter().filter_map(|&wall| self.end(wall)));
        }
        for end in pieces.iter().flat_map(|piece| [piece.from, piece.to]) {
            if let End::Node(node) = end {
                degrees[node as usize] += 1;
            }
        }
        // Elements that govern something, and the number of each among them.
        let mut numbers = vec![u32::MAX; n_elements];
        let mut number = vec![u32::MAX; degrees.len()];
        let mut keypoints = KeypointTable::with_room(degrees.len());
        let (mut outline, mut list) = (Vec::new(), Vec::new());
        let joined = (0..degrees.len() as u32).filter(|&node| degrees[node as usize] > 0);
        let is_alone = |node: &u32| degrees[*node as usize] == 0 && self.holds(*node);
        let alone = self.left.alone.iter().copied().filter(is_alone);
        for node in joined.chain(alone) {
            number[node as usize] = keypoints.len();
            self.governors(node, &mut outline, &mut list);
            list.iter().for_each(|&element| numbers[element as usize] = 0);
            keypoints.push(&self.keypoint(node, degrees[node as usize]), list.iter().copied());
        }
        let mut paths = PathTable::with_room(pieces.len());
        let mut between = Vec::new();
        for Piece { from, to, left, right, sample } in pieces {
            [left, right].into_iter().for_each(|element| numbers[element as usize] = 0);
            let mut numbered = |end: End| {
                let (position, radius, kind) = match end {
                    End::Node(node) => return number[node as usize],
                    End::Clipped(position, radius) => (position, radius, KeypointKind::Clipped),
                    End::Corner(position) => (position, 0.0, KeypointKind::End),
                };
                let governors = [left.min(right), left.max(right)];
                keypoints.push(&Keypoint { position, radius, kind }, governors.into_iter());
                keypoints.len() - 1
            };
            let [mut from, to] = [from, to].map(&mut numbered);
            if let Some(sample) = sample {
                let ends = [from, to].map(|k| keypoints.at(k)).map(|k| (k.position, k.radius));
                divided(sample, ends, label.spacing, MOST_HALVINGS, &mut between);
            }
            for (position, radius) in between.drain(..) {
                let governors = [left.min(right), left.max(right)];
                let kind = KeypointKind::Transition;
                keypoints.push(&Keypoint { position, radius, kind }, governors.into_iter());
                let next = keypoints.len() - 1;
                paths.push(&Path { from, to: next, left, right }, &keypoints);
                from = next;
            }
            paths.push(&Path { from, to, left, right }, &keypoints);
        }
        let too_large = || EngineError::TooLarge { n_edges: n_elements };
        let mut sites = SiteTable::with_room(n_elements, 0, 0);
        for (element, number) in (0..).zip(&mut numbers).filter(|(_, number)| **number == 0) {
            *number = sites.len();
            sites.push(&record(element)).ok_or_else(too_large)?;
        }
        sites.shrink();
        keypoints.shrink();
        keypoints.renumber(|element| numbers[element as usize]);
        paths.renumber(|element| numbers[element as usize]);
        let Label { side, complete, spacing } = *label;
        let (engine, accuracy) = (Engine::DelaunayDual, Accuracy::Sampled(spacing));
        Ok(MedialAxis::from_tables(engine, side, accuracy, complete, sites, keypoints, paths))
    }

    /// Whether a node lies within the frame, if there is one.
    fn holds(&self, node: u32) -> bool {
        self.frame.is_none_or(|frame| self.known(node).is_some_and(|at| frame.holds(at)))
    }

    /// Where a node is, and its radius; `None` for infinity.
    fn disk(&self, node: u32) -> Option<(Point, f64)> {
        let shared = (node as usize).checked_sub(self.disks.len());
        match shared {
            None => Some(self.disks[node as usize]),
            Some(shared) => {
                let &(vertex, _) = self.dual.shared.get(shared)?;
                Some((self.triangles.point(vertex), 0.0))
            }
        }
    }

    /// Where a node is, unless that is surely far outside of the frame: centres of triangles that are nearly flat are not
    /// known well.
    fn known(&self, node: u32) -> Option<Point> {
        let (at, radius) = self.disk(node)?;
        // The circle goes through samples, which lie in the frame.
        let most = self.frame.map_or(f64::INFINITY, |frame| 2.0 * (frame.max - frame.min).norm());
        (at.norm().is_finite() && radius <= most).then_some(at)
    }

    fn keypoint(&self, node: u32, degree: u32) -> Keypoint {
        let (centre, radius) = self.disk(node).unwrap_or_default();
        let is_group = (node as usize) < self.disks.len();
        let kind = match degree {
            0 | 1 if is_group => KeypointKind::Tip,
            0 | 1 => KeypointKind::End,
            2 => KeypointKind::Transition,
            _ => KeypointKind::Junction,
        };
        let position = self.plane.place(centre);
        Keypoint { position, radius: radius * self.plane.unit(), kind }
    }

    /// The elements around a node, counterclockwise, from the smallest one on.
    fn governors(&self, node: u32, outline: &mut Vec<EdgeId>, list: &mut Vec<u32>) {
        list.clear();
        if let Some(&(centre, _)) = self.disks.get(node as usize) {
            self.dual.outline(self.triangles, node, outline);
            for &edge in outline.iter() {
                let sample = self.dual.sample_at(self.triangles, edge);
                list.push(self.samples.element(sample, centre));
            }
        } else {
            for &spoke in self.dual.spokes_of(node as usize - self.disks.len()) {
                // In a corner, counterclockwise, the edge after the sample comes before the one before it.
                let [before, after] = self.samples.elements[self.dual.boundary_at(spoke) as usize];
                list.extend([after, before]);
            }
        }
        if self.plane.is_mirrored() {
            list.reverse();
        }
        list.dedup();
        while list.len() > 1 && list.first() == list.last() {
            list.pop();
        }
        let smallest = (0..list.len()).min_by_key(|&k| list[k]).unwrap_or(0);
        list.rotate_left(smallest);
    }

    /// What the frame leaves of an edge of the dual graph, if anything.
    fn piece(&self, edge: DualEdge) -> Option<Piece> {
        let sides = [edge.across, self.triangles.reversed(edge.across)];
        let [right, left] = sides.map(|edge| self.triangles.point(self.triangles.origin(edge)));
        let (from, to) = (self.known(edge.from), self.known(edge.to));
        let middle = match (from, to) {
            (Some(from), Some(to)) => (from + to) * 0.5,
            (from, to) => from.or(to).unwrap_or((left + right) * 0.5),
        };
        let (left_element, right_element) = if (edge.from as usize) < self.disks.len() {
            let [right, left] = sides.map(|edge| {
                self.samples.element(self.dual.sample_at(self.triangles, edge), middle)
            });
            (left, right)
        } else {
            // Seen from the vertex, the edge before it lies to the left.
            let [before, after] =
                self.samples.elements[self.dual.boundary_at(edge.across) as usize];
            (before, after)
        };
        let [from, to] = match self.frame {
            None => [End::Node(edge.from), End::Node(edge.to)],
            Some(frame) => {
                let away = (right - left).perp();
                let (from, to) = match (from, to) {
                    (Some(from), Some(to)) => (from, to),
                    (Some(from), None) => (from, beyond(&frame, from, away)),
                    (None, Some(to)) => (beyond(&frame, to, -away), to),
                    (None, None) => {
                        // Both beyond the frame on one side, unless each is on its own side of the edge.
                        if sides.iter().any(|&side| self.triangles.opening(side) <= 0.0) {
                            return None;
                        }
                        (beyond(&frame, middle, -away), beyond(&frame, middle, away))
                    }
                };
                let starts = (from, self.holds(edge.from).then_some(End::Node(edge.from)));
                let ends = (to, self.holds(edge.to).then_some(End::Node(edge.to)));
                self.within(&frame, starts, ends, [left, right])?
            }
        };
        let is_voronoi_edge = (edge.from as usize) < self.disks.len();
        let sample = is_voronoi_edge.then(|| self.plane.place(left));
        Some(Piece { sample, ..self.mirrored(from, to, left_element, right_element) })
    }

    /// The path into the corner where a boundary edge starts, if it is one that no node stands for.
    fn end(&self, wall: EdgeId) -> Option<Piece> {
        let sample = self.dual.boundary_at(wall);
        let vertex = self.triangles.origin(wall);
        if !self.samples.is_convex(sample) || self.dual.is_shared(vertex) {
            return None;
        }
        let node = self.dual.group_in_corner(self.triangles, wall);
        let corner = self.triangles.point(vertex);
        let [left, right] = self.samples.elements[sample as usize];
        let place = End::Corner(self.plane.place(corner));
        let [from, to] = match self.frame {
            None => [place, End::Node(node)],
            Some(frame) => {
                let bisector = self.samples.bisector(sample);
                let to = self.known(node).unwrap_or_else(|| beyond(&frame, corner, bisector));
                let ends = (to, self.holds(node).then_some(End::Node(node)));
                self.within(&frame, (corner, Some(place)), ends, [corner; 2])?
            }
        };
        Some(self.mirrored(from, to, left, right))
    }

    fn mirrored(&self, from: End, to: End, left: u32, right: u32) -> Piece {
        match self.plane.is_mirrored() {
            true => Piece { from, to, left: right, right: left, sample: None },
            false => Piece { from, to, left, right, sample: None },
        }
    }

    /// The ends of what a frame leaves of a way between two places, each with what it is if the frame holds it;
    /// radii are the distances of two samples.
    fn within(
        &self,
        frame: &Rect,
        (from, starts): (Point, Option<End>),
        (to, ends): (Point, Option<End>),
        samples: [Point; 2],
    ) -> Option<[End; 2]> {
        let (low, high) = clipped(frame, from, to)?;
        let clip = |u: f64| {
            let Point { x, y } = from + (to - from) * u;
            let at =
                Point::new(x.clamp(frame.min.x, frame.max.x), y.clamp(frame.min.y, frame.max.y));
            let radius = samples.map(|sample| (at - sample).norm());
            End::Clipped(self.plane.place(at), radius[0].min(radius[1]) * self.plane.unit())
        };
        Some([starts.unwrap_or_else(|| clip(low)), ends.unwrap_or_else(|| clip(high))])
    }
}

/// How often a Voronoi edge is halved at most.
const MOST_HALVINGS: u32 = 12;

/// Places between the ends of a Voronoi edge, with their distance from one of its samples, so that between two of them
/// the distance is that of a straight line but for half of a tolerance.
fn divided(
    sample: Point,
    [from, to]: [(Point, f64); 2],
    tolerance: f64,
    halvings: u32,
    between: &mut Vec<(Point, f64)>,
) {
    let at = (from.0 + to.0) * 0.5;
    let middle = (at, (at - sample).norm());
    let off = 0.5 * (from.1 + to.1) - middle.1;
    if halvings == 0 || off.abs() <= 0.5 * tolerance || !off.is_finite() {
        return;
    }
    divided(sample, [from, middle], tolerance, halvings - 1, between);
    between.push(middle);
    divided(sample, [middle, to], tolerance, halvings - 1, between);
}

/// A place so far away in a direction that it lies beyond a frame, whether the way there starts inside or not.
fn beyond(frame: &Rect, from: Point, away: Point) -> Point {
    let way = (from - (frame.min + frame.max) * 0.5).norm();
    from + away * (2.0 * (way + (frame.max - frame.min).norm()) / away.norm())
}

/// The part of a way within a frame, as shares of it; `None` if that is no more than a point.
fn clipped(frame: &Rect, from: Point, to: Point) -> Option<(f64, f64)> {
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    let axes = [(from.x, to.x, frame.min.x, frame.max.x), (from.y, to.y, frame.min.y, frame.max.y)];
    for (from, to, min, max) in axes {
        let way = to - from;
        if way == 0.0 {
            if !(min <= from && from <= max) {
                return None;
            }
            continue;
        }
        let (a, b) = ((min - from) / way, (max - from) / way);
        (low, high) = (low.max(a.min(b)), high.min(a.max(b)));
    }
    (low < high).then_some((low, high))
}
