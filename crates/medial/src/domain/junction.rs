//! Points where more than one vertex, or a vertex and the inside of edges, meet.
//!
//! # Contract
//! After the sweep, links and removals at these points turn rings into boundary walks.
//!
//! # Method
//! The rays from the point are at hand in order: edges that go on, from bottom to top, then edges
//! that arrive, from top to bottom. Rays in one direction are edges that overlap. Each wedge from
//! an outgoing ray counterclockwise to the next ray of the polygon, an incoming one, is interior:
//! the incoming piece continues as the outgoing one.

use super::status::{Found, NONE};
use super::sweep::{Piece, Purpose, Sweep};
use super::{DomainError, area};
use crate::geom::{Point, orient2d};

/// One piece as seen from its end at the point.
#[derive(Clone, Copy)]
struct Ray {
    polygon: u32,
    piece: Piece,
    /// Whether the boundary leaves the point along it.
    out: bool,
    bridged: bool,
    /// Vertex, or edge passing straight through, that it belongs to.
    passage: Passage,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Passage {
    Vertex(u32),
    Through(u32),
}

impl Sweep<'_, '_> {
    /// Handles an event at which anything may meet.
    pub(super) fn junction(&mut self, p: Point, group: &[(Point, u32)]) -> Result<(), DomainError> {
        let starting = self.starting(group);
        let (nodes, below) = self.range(p, group)?;
        let arriving: Vec<u32> = nodes.iter().map(|&n| self.status.edge(n)).collect();
        let through: Vec<u32> =
            arriving.iter().copied().filter(|&e| self.segment(e).right != p).collect();
        if nodes.len() - through.len() + starting.len() != 2 * group.len() {
            return Err(DomainError::Internal { stage: "sweep" });
        }
        for pair in through.windows(2) {
            let [a, b] = [pair[0], pair[1]];
            if orient2d(p, self.segment(a).right, self.segment(b).right) != 0.0 {
                return Err(self.crossing(a, b, p));
            }
        }
        // Arriving rays describe the pieces before this point.
        let left: Vec<Ray> = arriving.iter().rev().map(|&e| self.ray(e, p, false)).collect();
        // At most four: `order_run` refuses more edges on one another.
        let mut cut: Vec<u32> = Vec::new();
        for &edge in &through {
            let polygon = self.segment(edge).polygon;
            let touched = group.iter().find(|g| self.segment(g.1).polygon == polygon);
            if let Some(&(point, _)) = touched {
                self.segments[edge as usize].cuts += 1;
                self.found.cuts.push((edge, point));
                cut.push(edge);
            } else {
                self.found.touched.push((edge, p));
            }
        }
        let leaving = self.order_leaving(p, below, through, starting)?;
        self.update_status(&nodes, below, &leaving)?;
        if self.purpose == Purpose::Validate {
            let right = leaving.iter().map(|&e| self.ray(e, p, true));
            let rays: Vec<Ray> = right.chain(left).collect();
            self.resolve(p, rays, &cut);
        }
        Ok(())
    }

    /// Edges that start at vertices of the group.
    fn starting(&self, group: &[(Point, u32)]) -> Vec<u32> {
        let both = group.iter().flat_map(|&(_, vertex)| {
            let before = self.before(vertex);
            [(vertex, self.segment(vertex).forward), (before, !self.segment(before).forward)]
        });
        both.filter(|e| e.1).map(|e| e.0).collect()
    }

    /// Nodes of all edges that contain the point, from bottom to top, and the node below them.
    fn range(&self, p: Point, group: &[(Point, u32)]) -> Result<(Vec<u32>, u32), DomainError> {
        let ending = group.iter().find_map(|&(_, vertex)| {
            let before = self.before(vertex);
            let ends = |e: u32, ends: bool| ends.then(|| self.segment(e).node);
            ends(vertex, !self.segment(vertex).forward)
                .or_else(|| ends(before, self.segment(before).forward))
        });
        let some = match ending {
            Some(NONE) => return Err(DomainError::Internal { stage: "sweep" }),
            Some(node) => node,
            None => match self.status.search(|e| self.side(e, p)) {
                Found::Node(node) => node,
                Found::Above(below) => return Ok((Vec::new(), below)),
            },
        };
        let mut low = some;
        while self.meets(self.status.below(low), p) {
            low = self.status.below(low);
        }
        let below = self.status.below(low);
        let mut nodes = vec![low];
        let mut node = self.status.above(low);
        while self.meets(node, p) {
            nodes.push(node);
            node = self.status.above(node);
        }
        Ok((nodes, below))
    }

    fn ray(&self, edge: u32, p: Point, leaving: bool) -> Ray {
        let segment = self.segment(edge);
        let out = segment.forward == leaving;
        let at_end = (if leaving { segment.left } else { segment.right }) == p;
        let passage = match (at_end, out) {
            (false, _) => Passage::Through(edge),
            (true, true) => Passage::Vertex(edge),
            (true, false) => Passage::Vertex(self.rings.next(edge)),
        };
        let piece = Piece { edge, part: segment.cuts };
        Ray { polygon: segment.polygon, piece, out, bridged: segment.bridged, passage }
    }

    /// Sorts the edges that go on to the right of the point, from bottom to top, and takes note of
    /// overlaps, winding numbers and rings that start.
    fn order_leaving(
        &mut self,
        p: Point,
        below: u32,
        through: Vec<u32>,
        starting: Vec<u32>,
    ) -> Result<Vec<u32>, DomainError> {
        let mut edges = through;
        edges.extend(starting);
        edges.sort_unstable_by(|&a, &b| {
            let turn = orient2d(p, self.segment(a).right, self.segment(b).right);
            0.0.partial_cmp(&turn).unwrap_or(std::cmp::Ordering::Equal).then(a.cmp(&b))
        });
        let mut under = if below == NONE { NONE } else { self.status.edge(below) };
        let mut label = self.label_above(under);
        let mut state = self.state_above(under);
        let mut ordered = Vec::with_capacity(edges.len());
        let mut start = 0;
        while start < edges.len() {
            let first = self.segment(edges[start]).right;
            let same = |&&e: &&u32| orient2d(p, first, self.segment(e).right) == 0.0;
            let len = edges[start..].iter().take_while(same).count();
            let run = &mut edges[start..start + len];
            start += len;
            if let &mut [edge] = run {
                self.segments[edge as usize].bridged = false;
            } else {
                self.order_run(p, run, label)?;
            }
            for &mut edge in run {
                self.enter(p, under, edge, &mut label, &mut state);
                under = edge;
                ordered.push(edge);
            }
        }
        Ok(ordered)
    }

    /// Orders edges that overlap to the right of the point, or refuses them.
    ///
    /// Two edges of one polygon that run opposite ways bridge; a polygon is left before another
    /// is entered; and where a ring is left, it is the one we are in.
    fn order_run(&mut self, p: Point, run: &mut [u32], label: u32) -> Result<(), DomainError> {
        run.sort_unstable_by_key(|&e| (self.segment(e).polygon, e));
        for &edge in &*run {
            self.segments[edge as usize].bridged = false;
        }
        for k in 1..run.len() {
            let (a, b) = (run[k - 1], run[k]);
            let (one, other) = (self.segment(a), self.segment(b));
            if one.polygon != other.polygon {
                continue;
            }
            let same_way = one.forward == other.forward
                && (self.purpose == Purpose::Validate || one.ring == other.ring);
            if same_way || one.bridged || !self.overlap_is_bridge(p, a, b) {
                let (first, second) = self.places(a, b);
                return Err(DomainError::Overlap { first, second, at: p });
            }
            for edge in [a, b] {
                self.segments[edge as usize].bridged = true;
            }
            let (first, second) = self.places(a, b);
            let _ = self.found.bridge.get_or_insert(DomainError::Bridge { first, second });
            if self.enters_second(a, b, label) {
                run.swap(k - 1, k);
            }
        }
        // Leave a polygon, pass what is run through both ways, enter a polygon.
        let rank = |e: u32| match (self.segment(e).bridged, self.segment(e).forward) {
            (false, false) => 0,
            (true, _) => 1,
            (false, true) => 2,
        };
        run.sort_by_key(|&e| rank(e));
        let (bridged, single): (Vec<_>, Vec<_>) =
            run.iter().map(|&e| (rank(e), e)).partition(|e| e.0 == 1);
        // Two polygons may share an edge, and one of them have a bridge there; more could make
        // every event on the line as costly as their number.
        for list in [&bridged, &single] {
            if let &[one, _, other, ..] = &list[..] {
                let (first, second) = self.places(one.1, other.1);
                return Err(DomainError::PolygonsOverlap { first, second, at: p });
            }
        }
        for pair in single.windows(2) {
            let [one, other] = [pair[0], pair[1]];
            let (first, second) = self.places(one.1, other.1);
            if one.0 == other.0 && self.purpose == Purpose::Validate {
                return Err(DomainError::PolygonsOverlap { first, second, at: p });
            }
            let shared = DomainError::SharedEdge { first, second, at: p };
            let _ = self.found.shared_edge.get_or_insert(shared);
        }
        if self.purpose == Purpose::Nest && !single.is_empty() {
            self.nest_run(run, label);
        }
        Ok(())
    }

    /// Orders edges of several polygons that overlap, at most four, so that rings are left from
    /// the innermost one out, and then entered from the outermost one in.
    fn nest_run(&mut self, run: &mut [u32], label: u32) {
        for end in 1..run.len() {
            for k in (1..=end).rev() {
                let (one, other) = (self.segment(run[k - 1]), self.segment(run[k]));
                let (a, b) = (one.ring, other.ring);
                let swaps = match (one.enters_ring, other.enters_ring) {
                    (enters, other) if enters != other => enters,
                    (true, _) => self.compare_sizes(a, b).is_lt(),
                    _ if a == label || b == label => b == label,
                    // Of equal rings the one entered last is left first.
                    _ => self.compare_sizes(a, b).is_ge(),
                };
                if !swaps {
                    break;
                }
                run.swap(k - 1, k);
            }
        }
    }

    /// Whether two overlapping edges of one polygon both have vertices, as given, where the
    /// overlap starts and ends; a ring that ran back on itself may have them anywhere.
    fn overlap_is_bridge(&self, p: Point, a: u32, b: u32) -> bool {
        let (one, other) = (self.segment(a), self.segment(b));
        if one.left != p && other.left != p {
            return true;
        }
        let end = match one.right.lexicographic(other.right) {
            std::cmp::Ordering::Greater => other.right,
            _ => one.right,
        };
        [a, b].into_iter().all(|e| {
            let segment = self.segment(e);
            (segment.left == p || self.rings.passes_vertex(e, p))
                && (segment.right == end || self.rings.passes_vertex(e, end))
        })
    }

    /// Whether, of two coinciding edges, the second one comes first from below.
    fn enters_second(&mut self, a: u32, b: u32, label: u32) -> bool {
        let (one, other) = (self.segment(a), self.segment(b));
        let (ring_a, ring_b) = (one.ring, other.ring);
        match (one.enters_ring, other.enters_ring) {
            (false, true) => ring_a != label,
            (true, false) => ring_b == label,
            (false, false) if ring_a == label => false,
            (false, false) if ring_b == label => true,
            // The larger ring is entered first and left last.
            (enters, _) => {
                let order = self.compare_sizes(ring_a, ring_b);
                if enters { order.is_lt() } else { order.is_gt() }
            }
        }
    }

    fn compare_sizes(&mut self, a: u32, b: u32) -> std::cmp::Ordering {
        self.sizes.resize(self.rings.rings.len(), None);
        for ring in [a, b] {
            let size = &mut self.sizes[ring as usize];
            if size.is_none() {
                *size = Some(area::exact_size(self.rings.ring_points(ring)));
            }
        }
        self.sizes[a as usize].cmp(&self.sizes[b as usize])
    }

    /// Puts the leaving edges in the place of the arriving ones, and checks the neighbours.
    fn update_status(
        &mut self,
        nodes: &[u32],
        below: u32,
        leaving: &[u32],
    ) -> Result<(), DomainError> {
        let mut last = below;
        for (k, &edge) in leaving.iter().enumerate() {
            last = if let Some(&node) = nodes.get(k) {
                self.replace(node, edge);
                node
            } else {
                self.insert_after(last, edge)
            };
        }
        for &node in nodes.iter().skip(leaving.len()) {
            self.remove(node);
        }
        let above = self.status.after(last);
        if last == below {
            self.check_order(below, above)
        } else {
            self.check_order(below, self.status.after(below))?;
            self.check_order(last, above)
        }
    }

    /// Links pieces by sectors, polygon by polygon.
    fn resolve(&mut self, p: Point, mut rays: Vec<Ray>, cut: &[u32]) {
        let starts = |ray: &Ray| {
            !matches!(ray.passage, Passage::Through(e) if !cut.contains(&e))
                && self.segment(ray.piece.edge).forward == ray.out
        };
        let removed = rays.iter().filter(|ray| ray.bridged && starts(ray));
        let removed: Vec<Piece> = removed.map(|ray| ray.piece).collect();
        self.found.removed.extend(removed);
        // Stable: the rays of each polygon stay in counterclockwise order.
        rays.sort_by_key(|ray| ray.polygon);
        for rays in rays.chunk_by(|a, b| a.polygon == b.polygon) {
            let plain = rays.len() == 2 && !rays[0].bridged && !rays[1].bridged;
            if plain || rays.iter().all(|r| matches!(r.passage, Passage::Through(_))) {
                continue;
            }
            self.note_self_touch(p, rays);
            if rays.iter().all(|ray| !ray.bridged) {
                self.note_corner_crossing(p, rays);
            }
            let open: Vec<&Ray> = rays.iter().filter(|ray| !ray.bridged).collect();
            for (k, ray) in open.iter().enumerate() {
                let next = open[(k + 1) % open.len()];
                // If the next ray goes out too, the winding numbers have told already.
                if ray.out && !next.out {
                    self.found.links.push((next.piece, ray.piece));
                }
            }
        }
    }

    fn note_self_touch(&mut self, p: Point, rays: &[Ray]) {
        let incoming = rays.iter().filter(|ray| !ray.out && !ray.bridged);
        let mut incoming: Vec<(u32, u32)> =
            incoming.map(|ray| (self.segment(ray.piece.edge).ring, ray.piece.edge)).collect();
        incoming.sort_unstable();
        for same in incoming.chunk_by(|a, b| a.0 == b.0).filter(|c| c.len() > 1) {
            let (first, second) = self.places(same[0].1, same[1].1);
            self.found.self_touches.extend(same.iter().map(|s| s.1));
            let touch = DomainError::SelfTouch { first, second, at: p };
            let _ = self.found.self_touch.get_or_insert(touch);
        }
    }

    /// Passages that do not cross close like parentheses around the point.
    fn note_corner_crossing(&mut self, p: Point, rays: &[Ray]) {
        if self.corner_crossing.is_some() {
            return;
        }
        let mut by_passage: Vec<usize> = (0..rays.len()).collect();
        by_passage.sort_by_key(|&k| rays[k].passage);
        let mut partner = vec![0; rays.len()];
        for pair in by_passage.chunks_exact(2) {
            (partner[pair[0]], partner[pair[1]]) = (pair[1], pair[0]);
        }
        let mut open: Vec<usize> = Vec::new();
        for (k, &partner) in partner.iter().enumerate() {
            if partner > k {
                open.push(k);
            } else if let Some(last) = open.pop()
                && partner != last
            {
                let edge = |k: usize| rays[k].piece.edge;
                self.corner_crossing = Some(self.crossing(edge(last), edge(k), p));
                return;
            }
        }
    }
}
