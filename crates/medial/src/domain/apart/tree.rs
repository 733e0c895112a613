use crate::domain::rings::Rings;
use crate::geom::{Point, Rect, hilbert};

/// Edges of a leaf, and children of a node.
pub(super) const FAN: usize = 8;

/// Rings that are not worth sorting.
const FEW_RINGS: usize = 8;

/// A run of up to eight edges of one ring.
#[derive(Clone, Copy)]
pub(super) struct Leaf {
    pub(super) first: u32,
    pub(super) ring: u32,
}

/// The vertices of a run of edges, both ends included.
pub(super) struct Chain {
    points: [Point; FAN + 1],
    pub(super) first: u32,
    pub(super) ring: u32,
    /// Number of edges.
    pub(super) len: usize,
}

impl Chain {
    #[inline]
    pub(super) fn points(&self) -> &[Point] {
        &self.points[..=self.len]
    }

    #[inline]
    pub(super) fn edge(&self, k: usize) -> (Point, Point) {
        (self.points[k], self.points[k + 1])
    }
}

/// A packed tree of boxes, eight to a node, over runs of edges in boundary order, ring after ring.
pub(super) struct Tree<'a> {
    pub(super) rings: &'a Rings<'a>,
    pub(super) leaves: Vec<Leaf>,
    /// Boxes level by level, those of the leaves first; box k of a level covers boxes 8k to 8k + 7
    /// below.
    pub(super) boxes: Vec<Rect>,
    /// Where each level starts.
    levels: Vec<usize>,
}

impl<'a> Tree<'a> {
    pub(super) fn new(rings: &'a Rings<'a>) -> Self {
        let runs = |len: u32| (len as usize).div_ceil(FAN);
        let n_leaves = rings.rings.iter().map(|r| runs(r.len)).sum();
        let mut tree = Self {
            rings,
            leaves: Vec::with_capacity(n_leaves),
            boxes: Vec::with_capacity(n_leaves + n_leaves / (FAN - 1) + FAN),
            levels: vec![0],
        };
        let n_rings = rings.rings.len() as u32;
        if rings.rings.len() <= FEW_RINGS {
            (0..n_rings).for_each(|ring| tree.push(ring));
        } else {
            near_together(rings).into_iter().for_each(|ring| tree.push(ring));
        }
        let mut first = 0;
        while tree.boxes.len() - first > 1 {
            let last = tree.boxes.len();
            tree.levels.push(last);
            for start in (first..last).step_by(FAN) {
                let children = &tree.boxes[start..(start + FAN).min(last)];
                let cover = children.iter().fold(Rect::EMPTY, |all, b| all.union(*b));
                tree.boxes.push(cover);
            }
            first = last;
        }
        tree
    }

    fn push(&mut self, ring: u32) {
        let record = &self.rings.rings[ring as usize];
        let points = self.rings.ring_points(ring);
        for start in (0..points.len()).step_by(FAN) {
            let end = (start + FAN).min(points.len());
            let last = points[if end < points.len() { end } else { 0 }];
            let run = &points[start..end];
            let bounds = run.iter().fold(Rect::EMPTY.with(last), |all, &p| all.with(p));
            self.leaves.push(Leaf { first: record.first + start as u32, ring });
            self.boxes.push(bounds);
        }
    }

    /// Number of levels, the leaves included.
    pub(super) fn height(&self) -> usize {
        self.levels.len()
    }

    /// Position of a node among all boxes.
    #[inline]
    pub(super) fn place(&self, level: usize, node: usize) -> usize {
        self.levels[level] + node
    }

    /// The numbers, on the level below, of the children of a node.
    #[inline]
    pub(super) fn children(&self, level: usize, node: usize) -> std::ops::Range<usize> {
        let count = self.levels[level] - self.levels[level - 1];
        node * FAN..((node + 1) * FAN).min(count)
    }

    #[inline]
    pub(super) fn bounds(&self, level: usize, node: usize) -> &Rect {
        &self.boxes[self.place(level, node)]
    }

    #[inline]
    pub(super) fn chain(&self, leaf: usize) -> Chain {
        let Leaf { first, ring } = self.leaves[leaf];
        let record = &self.rings.rings[ring as usize];
        let end = record.first + record.len;
        let len = (end - first).min(FAN as u32);
        let mut points = [Point::default(); FAN + 1];
        let run = &self.rings.points[first as usize..(first + len) as usize];
        points[..run.len()].copy_from_slice(run);
        let after = if first + len == end { record.first } else { first + len };
        points[run.len()] = self.rings.point(after);
        Chain { points, first, ring, len: run.len() }
    }
}

/// The rings along a Hilbert curve, so that near ones share nodes whatever the order of the input.
fn near_together(rings: &Rings) -> Vec<u32> {
    let corner = |ring: usize| rings.point(rings.rings[ring].first);
    let all = 0..rings.rings.len();
    let bounds = all.clone().fold(Rect::EMPTY, |bounds, ring| bounds.with(corner(ring)));
    let keyed = all.map(|ring| (hilbert(&bounds, corner(ring)), ring as u32));
    let mut order: Vec<(u64, u32)> = keyed.collect();
    order.sort_unstable();
    order.into_iter().map(|(_, ring)| ring).collect()
}
