//! The axis: edges of the dual graph replaced by Voronoi edges, with the elements that their samples lie on.

use super::dual::{Dual, DualEdge};
use super::samples::{Plane, Samples};
use crate::axis::{
    self, Accuracy, Engine, Keypoint, KeypointKind, KeypointTable, MedialAxis, Path, PathTable,
    Side, SiteTable,
};
use crate::engine::EngineError;
use crate::geom::{Delaunay, EdgeId, Point};

/// What an axis is made of.
pub(super) struct Drawn<'a> {
    pub samples: &'a Samples,
    pub triangles: &'a Delaunay,
    pub dual: &'a Dual,
    /// Centres and radii of groups, in the plane of the samples.
    pub disks: &'a [(Point, f64)],
    pub plane: Plane,
    /// Edges of the dual graph that are left, by their numbers.
    pub edges: &'a [u32],
    /// Nodes that are left without any edge.
    pub alone: &'a [u32],
}

/// What an axis says of itself.
pub(super) struct Label {
    pub side: Side,
    pub complete: bool,
    pub spacing: f64,
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
        let edges = || self.edges.iter().map(|&edge| self.dual.edges[edge as usize]);
        for edge in edges() {
            degrees[edge.from as usize] += 1;
            degrees[edge.to as usize] += 1;
        }
        let is_left = |node: u32| degrees[node as usize] > 0;
        let nodes = (0..degrees.len() as u32).filter(|&node| is_left(node));
        let nodes: Vec<u32> = nodes.chain(self.alone.iter().copied()).collect();
        let mut number = vec![u32::MAX; degrees.len()];
        // Elements that govern something, and the number of each among them.
        let mut numbers = vec![u32::MAX; n_elements];
        let mut keypoints = KeypointTable::with_room(nodes.len());
        let (mut outline, mut list) = (Vec::new(), Vec::new());
        for &node in &nodes {
            number[node as usize] = keypoints.len();
            let keypoint = self.keypoint(node, degrees[node as usize]);
            self.governors(node, &mut outline, &mut list);
            list.iter().for_each(|&element| numbers[element as usize] = 0);
            keypoints.push(&keypoint, list.iter().copied());
        }
        let mut paths = PathTable::with_room(self.edges.len());
        for edge in edges() {
            let (left, right) = self.sides(edge);
            [left, right].into_iter().for_each(|element| numbers[element as usize] = 0);
            let [from, to] = [edge.from, edge.to].map(|node| number[node as usize]);
            paths.push(&Path { from, to, left, right }, &keypoints);
        }
        let too_large = || EngineError::TooLarge { n_edges: n_elements };
        let mut sites = SiteTable::with_room(n_elements, 0, 0);
        for (element, number) in (0..).zip(&mut numbers).filter(|(_, number)| **number == 0) {
            *number = sites.len();
            sites.push(&record(element)).ok_or_else(too_large)?;
        }
        sites.shrink();
        keypoints.renumber(|element| numbers[element as usize]);
        paths.renumber(|element| numbers[element as usize]);
        let accuracy = Accuracy::Sampled(label.spacing);
        let Label { side, complete, .. } = *label;
        let engine = Engine::DelaunayDual;
        Ok(MedialAxis::from_tables(engine, side, accuracy, complete, sites, keypoints, paths))
    }

    fn keypoint(&self, node: u32, degree: u32) -> Keypoint {
        let kind = |end: KeypointKind| match degree {
            0 | 1 => end,
            2 => KeypointKind::Transition,
            _ => KeypointKind::Junction,
        };
        match self.disks.get(node as usize) {
            Some(&(centre, radius)) => Keypoint {
                position: self.plane.place(centre),
                radius: radius * self.plane.unit(),
                kind: kind(KeypointKind::Tip),
            },
            None => {
                let (vertex, _) = self.dual.shared[node as usize - self.disks.len()];
                let position = self.plane.place(self.triangles.point(vertex));
                Keypoint { position, radius: 0.0, kind: kind(KeypointKind::End) }
            }
        }
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
                // Between two edges, the one before the sample lies to the left of what comes from there.
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

    /// The elements to the left and to the right of an edge of the dual graph.
    fn sides(&self, edge: DualEdge) -> (u32, u32) {
        let (left, right) = if let Some(&(from, _)) = self.disks.get(edge.from as usize) {
            let (to, _) = self.disks[edge.to as usize];
            let middle = (from + to) * 0.5;
            let ends = [self.triangles.reversed(edge.across), edge.across];
            let [left, right] = ends.map(|edge| {
                self.samples.element(self.dual.sample_at(self.triangles, edge), middle)
            });
            (left, right)
        } else {
            let [before, after] =
                self.samples.elements[self.dual.boundary_at(edge.across) as usize];
            (before, after)
        };
        if self.plane.is_mirrored() { (right, left) } else { (left, right) }
    }
}
