//! The dual graph of the triangles inside, by the five rules [ASM09, §III].

use std::collections::HashSet;
use std::ops::Range;

use super::samples::Samples;
use crate::geom::{Delaunay, EdgeId, Point};

/// No group, no sample.
pub(super) const NONE: u32 = u32::MAX;

/// What a node of the dual graph is [ASM09, Proposition 5].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DualKind {
    /// Degree 1, or none: a triangle with two sides on the boundary, or with three.
    Dangling,
    /// Degree 2: a triangle with one side on the boundary.
    Internal,
    /// A triangle, or a group of them on one circle, with more than two sides inside.
    RamificationI,
    /// A vertex where more than two boundary edges meet.
    RamificationII,
}

impl DualKind {
    /// Its name in files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Dangling => "dangling",
            Self::Internal => "internal",
            Self::RamificationI => "ramification_1",
            Self::RamificationII => "ramification_2",
        }
    }
}

/// An edge of the dual graph.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct DualEdge {
    /// Nodes: groups of triangles, after these vertices shared by more than two boundary edges, and infinity.
    pub from: u32,
    pub to: u32,
    /// The edge between the two groups, or at infinity, with the first one to its left; for a vertex the boundary edge
    /// out of it, with the second one to its left.
    pub across: EdgeId,
}

/// The triangles inside, and their dual graph.
#[derive(Clone, Debug)]
pub(super) struct Dual {
    /// For each direction of each edge the sample where a boundary edge starts that is this one.
    boundary: Vec<u32>,
    /// All boundary edges, with the shape to their left, along the rings.
    pub walls: Vec<EdgeId>,
    /// The group of each face; none outside, and none at infinity.
    group_of: Vec<u32>,
    /// An edge of each group, which lies to its left.
    pub groups: Vec<EdgeId>,
    /// Vertices of more than two boundary edges through which the graph goes, with the boundary edges out of them.
    pub shared: Vec<(u32, Range<u32>)>,
    /// All vertices where several boundary edges start.
    several: Vec<u32>,
    spokes: Vec<EdgeId>,
    pub edges: Vec<DualEdge>,
    /// Whether edges go to infinity, which is the last node then.
    pub is_unbounded: bool,
}

impl Dual {
    /// The dual graph of the triangles to the left of rings of samples, which are edges that are kept. Triangles on both
    /// sides of some edges are one node even if they are not on one circle.
    pub fn new(triangles: &Delaunay, samples: &Samples, inner: &HashSet<EdgeId>) -> Self {
        let n_directions = 2 * (triangles.n_edges() + triangles.n_hull()) as usize;
        let mut boundary = vec![NONE; n_directions];
        let mut walls = Vec::with_capacity(samples.points.len());
        let vertex = |sample: u32| triangles.vertex_of(sample);
        for (sample, next) in samples.pairs() {
            if let Some(edge) = triangles.edge_between(vertex(sample), vertex(next)) {
                boundary[edge as usize >> 1] = sample;
                walls.push(edge);
            }
        }
        let n_faces = (triangles.n_faces() + triangles.n_hull()) as usize;
        let mut dual = Self {
            boundary,
            walls,
            group_of: vec![NONE; n_faces],
            groups: Vec::with_capacity(samples.points.len()),
            shared: Vec::new(),
            several: Vec::new(),
            spokes: Vec::new(),
            edges: Vec::with_capacity(samples.points.len()),
            is_unbounded: false,
        };
        dual.group(triangles, inner);
        dual.join(triangles);
        dual.link(triangles, samples);
        let infinity = (dual.groups.len() + dual.shared.len()) as u32;
        for edge in dual.edges.iter_mut().filter(|edge| edge.to == NONE) {
            edge.to = infinity;
            dual.is_unbounded = true;
        }
        dual
    }

    /// Rules 1 and 2: a node for each triangle inside, and one for each group of them on one circle.
    fn group(&mut self, triangles: &Delaunay, inner: &HashSet<EdgeId>) {
        let is_inner = |edge: EdgeId, back: EdgeId| {
            triangles.is_cocircular(edge)
                || !inner.is_empty() && (inner.contains(&edge) || inner.contains(&back))
        };
        let (mut open, mut members) = (Vec::new(), Vec::new());
        for wall in 0..self.walls.len() {
            open.push(self.walls[wall]);
            while let Some(first) = open.pop() {
                let face = triangles.left(first);
                if face >= triangles.n_faces() || self.group_of[face as usize] != NONE {
                    continue;
                }
                let group = self.groups.len() as u32;
                self.groups.push(first);
                self.group_of[face as usize] = group;
                members.push(first);
                while let Some(edge) = members.pop() {
                    let next = triangles.next_around_face(edge);
                    for edge in [edge, next, triangles.next_around_face(next)] {
                        let back = triangles.reversed(edge);
                        let beyond = triangles.left(back);
                        if triangles.is_kept(edge)
                            || beyond >= triangles.n_faces()
                            || self.group_of[beyond as usize] != NONE
                        {
                            continue;
                        }
                        if is_inner(edge, back) {
                            self.group_of[beyond as usize] = group;
                            members.push(back);
                        } else {
                            open.push(back);
                        }
                    }
                }
            }
        }
    }

    /// Rule 5: an edge between two nodes across each edge inside, and to infinity across those of the hull.
    fn join(&mut self, triangles: &Delaunay) {
        for edge in triangles.edges().filter(|&edge| !triangles.is_kept(edge)) {
            let back = triangles.reversed(edge);
            let [from, to] = [edge, back].map(|edge| self.group_on_left(triangles, edge));
            if from == to {
                continue;
            }
            let (from, to, across) = if from == NONE { (to, from, back) } else { (from, to, edge) };
            self.edges.push(DualEdge { from, to, across });
        }
    }

    /// Rules 3 and 4: edges from each vertex of more than two boundary edges to the node in each corner there that is
    /// less than half a turn wide. Where polygons share an edge they touch in more than a point, and stay apart.
    fn link(&mut self, triangles: &Delaunay, samples: &Samples) {
        if samples.len() == triangles.n_vertices() {
            return;
        }
        let mut starts = self.walls.clone();
        starts.sort_unstable_by_key(|&edge| triangles.origin(edge));
        for spokes in starts.chunk_by(|&a, &b| triangles.origin(a) == triangles.origin(b)) {
            if spokes.len() < 2 {
                continue;
            }
            let vertex = triangles.origin(spokes[0]);
            self.several.push(vertex);
            if spokes.iter().any(|&edge| self.boundary_at(triangles.reversed(edge)) != NONE) {
                continue;
            }
            let node = (self.groups.len() + self.shared.len()) as u32;
            let first = self.spokes.len() as u32;
            // Counterclockwise.
            let around = triangles.edges_out_of(vertex);
            self.spokes.extend(around.filter(|&edge| self.boundary[edge as usize >> 1] != NONE));
            self.shared.push((vertex, first..self.spokes.len() as u32));
            for &spoke in &self.spokes[first as usize..] {
                if samples.is_convex(self.boundary_at(spoke)) {
                    let to = self.group_in_corner(triangles, spoke);
                    self.edges.push(DualEdge { from: node, to, across: spoke });
                }
            }
        }
    }

    /// The node between a boundary edge and the other one of the same corner; where samples are too few for there to
    /// be only one, that in the middle.
    pub fn group_in_corner(&self, triangles: &Delaunay, spoke: EdgeId) -> u32 {
        let mut groups = vec![self.group_on_left(triangles, spoke)];
        let mut edge = triangles.next_around_origin(spoke);
        while self.boundary_at(triangles.reversed(edge)) == NONE {
            groups.push(self.group_on_left(triangles, edge));
            edge = triangles.next_around_origin(edge);
        }
        groups.dedup();
        groups[groups.len() / 2]
    }

    /// The sample where the boundary edge starts that this one is.
    #[inline]
    pub fn boundary_at(&self, edge: EdgeId) -> u32 {
        self.boundary[edge as usize >> 1]
    }

    /// The group of the triangle to the left of an edge.
    #[inline]
    pub fn group_on_left(&self, triangles: &Delaunay, edge: EdgeId) -> u32 {
        self.group_of[triangles.left(edge) as usize]
    }

    /// The boundary edges out of a shared vertex, counterclockwise.
    pub fn spokes_of(&self, shared: usize) -> &[EdgeId] {
        let Range { start, end } = self.shared[shared].1;
        &self.spokes[start as usize..end as usize]
    }

    /// How many nodes there are.
    pub fn n_nodes(&self) -> usize {
        self.groups.len() + self.shared.len() + usize::from(self.is_unbounded)
    }

    /// Whether a vertex is one of more than two boundary edges through which the graph goes.
    #[inline]
    pub fn is_shared(&self, vertex: u32) -> bool {
        let known = || self.shared.binary_search_by_key(&vertex, |&(vertex, _)| vertex);
        !self.shared.is_empty() && known().is_ok()
    }

    /// The sample at the start of an edge inside, or of a boundary edge.
    pub fn sample_at(&self, triangles: &Delaunay, edge: EdgeId) -> u32 {
        let vertex = triangles.origin(edge);
        if self.several.is_empty() || self.several.binary_search(&vertex).is_err() {
            return triangles.point_of(vertex);
        }
        // Clockwise up to the boundary edge that starts in this corner.
        let mut edge = edge;
        loop {
            let sample = self.boundary_at(edge);
            if sample != NONE {
                return sample;
            }
            edge = triangles.next_around_face(triangles.reversed(edge));
        }
    }

    /// The edges around a group, counterclockwise, with it to their left.
    pub fn outline(&self, triangles: &Delaunay, group: u32, outline: &mut Vec<EdgeId>) {
        outline.clear();
        let is_inner = |edge: EdgeId| {
            let back = triangles.reversed(edge);
            !triangles.is_kept(edge) && self.group_on_left(triangles, back) == group
        };
        let onwards = |mut edge: EdgeId| {
            while is_inner(edge) {
                edge = triangles.next_around_face(triangles.reversed(edge));
            }
            edge
        };
        let first = onwards(self.groups[group as usize]);
        let mut edge = first;
        loop {
            outline.push(edge);
            edge = onwards(triangles.next_around_face(edge));
            if edge == first {
                return;
            }
        }
    }

    /// How many edges each node has.
    pub fn degrees(&self) -> Vec<u32> {
        let mut degrees = vec![0_u32; self.n_nodes()];
        for edge in &self.edges {
            degrees[edge.from as usize] += 1;
            degrees[edge.to as usize] += 1;
        }
        degrees
    }

    /// What each node is, by its degree.
    pub fn kinds(&self) -> Vec<DualKind> {
        let n = self.groups.len();
        let kind = |(node, degree): (usize, u32)| match degree {
            _ if node >= n => DualKind::RamificationII,
            0 | 1 => DualKind::Dangling,
            2 => DualKind::Internal,
            _ => DualKind::RamificationI,
        };
        self.degrees().into_iter().enumerate().map(kind).collect()
    }
}

/// Where the nodes of groups lie, and how far from the boundary.
///
/// A node is the centre of the circle around its triangles. Where the boundary is so near to itself, for its samples,
/// that the centre lies beyond a boundary edge, it is that of the circle between that edge and the sample farthest
/// from it.
pub(super) fn disks(triangles: &Delaunay, dual: &Dual) -> Vec<(Point, f64)> {
    let circle = |&edge: &EdgeId| triangles.circle(triangles.left(edge));
    let mut disks: Vec<(Point, f64)> = dual.groups.iter().map(circle).collect();
    let mut moved: Vec<(u32, (Point, f64))> = Vec::new();
    let (mut open, mut beyond, mut outline) = (Vec::new(), Vec::new(), Vec::new());
    for &wall in &dual.walls {
        if triangles.opening(wall) >= 0.0 {
            continue;
        }
        let [a, b] = [triangles.origin(wall), triangles.target(wall)].map(|v| triangles.point(v));
        let height = |p: Point| (b - a).cross(p - a);
        // All groups whose centres the wall hides from them lie within the circle on it, one beside the other.
        beyond.clear();
        open.push(dual.group_on_left(triangles, wall));
        while let Some(group) = open.pop() {
            let is_seen = !beyond.is_empty() && height(disks[group as usize].0) > 0.0;
            if is_seen || beyond.contains(&group) {
                continue;
            }
            dual.outline(triangles, group, &mut outline);
            let corners = || outline.iter().map(|&edge| triangles.point(triangles.origin(edge)));
            if !corners().all(|p| (a - p).dot(b - p) <= 0.0) {
                continue;
            }
            beyond.push(group);
            let farthest = corners().max_by(|&p, &q| height(p).total_cmp(&height(q))).unwrap_or(a);
            let along = ((farthest - a).dot(b - a) / (b - a).norm2()).clamp(0.0, 1.0);
            let foot = a + (b - a) * along;
            moved.push((group, ((farthest + foot) * 0.5, 0.5 * (farthest - foot).norm())));
            let inner = outline.iter().map(|&edge| triangles.reversed(edge));
            let groups = inner.map(|edge| dual.group_on_left(triangles, edge));
            open.extend(groups.filter(|&group| group != NONE));
        }
    }
    moved.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.1.total_cmp(&b.1.1)));
    moved.dedup_by_key(|(group, _)| *group);
    moved.into_iter().for_each(|(group, disk)| disks[group as usize] = disk);
    for (disk, &edge) in disks.iter_mut().zip(&dual.groups) {
        // Flat but for rounding; inside, so that its disk is as small.
        if !dual.is_unbounded && !(disk.0.norm() + disk.1).is_finite() {
            let [a, b] = [triangles.origin(edge), triangles.target(edge)];
            let ends = [a, b].map(|vertex| triangles.point(vertex));
            *disk = ((ends[0] + ends[1]) * 0.5, 0.5 * (ends[1] - ends[0]).norm());
        }
    }
    disks
}
