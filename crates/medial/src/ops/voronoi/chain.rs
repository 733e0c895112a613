//! A cell seen from its element: what bounds it over a point, and whether the point is inside.
//!
//! # Method
//! With every point of a cell its spoke, the way to its footpoint, lies in the cell [Lee82, lemma 1].
//! So along a ray from a footpoint the cell comes first, up to the curve that bounds it there, and the
//! question whether a point of the ray is beyond is the question whether the element across that curve
//! is nearer: at the curve both are equally near, and beyond it the distance to the element grows as
//! fast as one goes, the other one more slowly, as its footpoint lies in another direction.
//! The curves around a cell lie one beside the other as their footpoints do, so the one over a point is
//! found by halves, with one exact question to the disk of a keypoint each time.

use std::cmp::Ordering;

use smallvec::SmallVec;

use super::graph::{EdgeKind, PointKind};
use super::nearest::{between_normals, compare, nearest_part};
use super::sheet::Sheet;
use super::{Cell, Voronoi};
use crate::axis::KeypointKind;
use crate::domain::{Corner, Site};
use crate::geom::predicates::Element;
use crate::geom::{Point, orient2d};

/// A cell over a point in the zone of its element.
pub(super) struct Over {
    /// The distance of the element against those across: `Greater` if the point lies beyond the cell.
    pub order: Ordering,
    /// The edge of the diagram over the point, and the element across it; none if the cell is unbounded
    /// there.
    pub bound: Option<(u32, Site)>,
}

impl Voronoi<'_> {
    /// The element in whose cell a point may lie if this closed element is nearest: its nearest part, or
    /// at a straight joint, which has no cell, the edge that starts there.
    pub(super) fn cell_before(&self, side: usize, element: Site, p: Point) -> Site {
        let sheet = &self.sheets[side];
        let part = nearest_part(sheet.domain(), element, p);
        if sheet.is_joint(part) { Site::edge(part.index()) } else { part }
    }

    /// The cell of an element over a point, on the side with this number; `None` if the point lies
    /// outside the zone of the element, or the axis has a keypoint that is none.
    pub(super) fn over(&self, side: usize, element: Site, p: Point) -> Option<Over> {
        let sheet = &self.sheets[side];
        if !sheet.zone_holds(element, p) {
            return None;
        }
        let site = sheet.number(element);
        let cell = self.graph.cell_of(side, site)?;
        let mut over = Over { order: Ordering::Less, bound: None };
        for edge in self.edges_over(side, element, &cell, p)? {
            let across = self.graph.edges[edge as usize].across(site)?;
            let across = sheet.element_of(across);
            let order = compare(sheet.domain(), p, element, across);
            if over.bound.is_none() || over.order < order {
                over = Over { order, bound: Some((edge, across)) };
            }
        }
        Some(over)
    }

    /// The path that bounds a cell over a point in the zone of its element; in a cell that is closed along
    /// the frame there may be several that could, or none.
    fn edges_over(
        &self,
        side: usize,
        element: Site,
        cell: &Cell,
        p: Point,
    ) -> Option<SmallVec<[u32; 2]>> {
        let edge = |k: usize| &self.graph.edges[cell.edges[k] as usize];
        let n = cell.edges.len();
        let is_path = |k: &usize| *k < n && edge(*k).kind == EdgeKind::Path;
        let passed = |k: usize| self.is_passed(side, element, cell, k, p);
        // The first whose start is not yet beyond the point; the first of all starts at the end of the
        // element.
        if !cell.edges.iter().any(|&e| self.graph.edges[e as usize].kind == EdgeKind::Frame) {
            let (mut low, mut high) = (1, n);
            while low < high {
                let middle = low.midpoint(high);
                if passed(middle)? { low = middle + 1 } else { high = middle }
            }
            // Over a point of a normal, the path beside it.
            let found = [low - 1, low, low.wrapping_sub(2)].into_iter().find(is_path)?;
            return Some([cell.edges[found]].into_iter().collect());
        }
        // The same among those that start at a keypoint with a disk; of what lies between two of them each
        // path may be the one.
        let has_disk = |k: &usize| {
            let start = self.graph.points[self.start_around(cell, *k) as usize].kind;
            matches!(start, PointKind::Keypoint(KeypointKind::Transition | KeypointKind::Junction))
        };
        let starts: SmallVec<[usize; 8]> = (1..n).filter(has_disk).collect();
        let (mut low, mut high) = (0, starts.len());
        while low < high {
            let middle = low.midpoint(high);
            if passed(starts[middle])? { low = middle + 1 } else { high = middle }
        }
        let first = low.checked_sub(1).map_or(0, |k| starts[k]);
        // On the last normal, the path before it.
        let first = if is_path(&first) { first } else { first.saturating_sub(1) };
        let last = starts.get(low).copied().unwrap_or(n);
        let between = (first..last).filter(is_path).map(|k| cell.edges[k]);
        Some(between.collect())
    }

    /// The point where edge number `k` around a cell starts, counterclockwise.
    fn start_around(&self, cell: &Cell, k: usize) -> u32 {
        let edge = &self.graph.edges[cell.edges[k] as usize];
        if edge.left == cell.site { edge.from } else { edge.to }
    }

    /// Whether, counterclockwise around the cell, the footpoint of a point comes after that of where edge
    /// number `k` around the cell starts, or is the same.
    fn is_passed(
        &self,
        side: usize,
        element: Site,
        cell: &Cell,
        k: usize,
        p: Point,
    ) -> Option<bool> {
        let sheet = &self.sheets[side];
        let start = self.start_around(cell, k);
        let disk = sheet.disk(self.graph.keypoint(side, start)?)?;
        Some(match sheet.element(element) {
            Element::Edge(a, b) => disk.along(a, b, p).is_ge(),
            Element::Corner(v) => disk.front(v, p).is_le(),
        })
    }
}

impl Sheet<'_> {
    /// Whether a point sees an element from this side, straight ahead.
    fn zone_holds(&self, site: Site, p: Point) -> bool {
        match self.element(site) {
            Element::Edge(a, b) => {
                let part = nearest_part(self.domain(), site, p);
                orient2d(a, b, p) > 0.0 && (part.is_edge() || self.is_joint(part))
            }
            Element::Corner(_) => {
                self.ground.has_cell(site) && between_normals(self.domain(), site, p)
            }
        }
    }

    /// Whether this is a straight joint.
    fn is_joint(&self, site: Site) -> bool {
        !site.is_edge() && self.domain().edge(site.index()).corner == Corner::Straight
    }
}
