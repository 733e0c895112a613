use super::links::links;
use super::node::{Bounds, FAN, Map, Node, Powers};
use crate::domain::rings::Rings;
use crate::geom::Point;

/// An edge of a ring, or the link between two rings.
#[derive(Clone, Copy)]
pub(super) struct Item {
    /// The vertices at both ends.
    pub(super) start: u32,
    pub(super) end: u32,
    /// Position of its ring in the order of the tree.
    pub(super) rank: u32,
    pub(super) is_link: bool,
}

/// A packed tree of boxes, eight to a node, over edges in boundary order, ring after ring.
///
/// If there are several rings, the edges of each are followed by a link, from it to the one before.
pub(super) struct Tree<'a> {
    pub(super) rings: &'a Rings<'a>,
    pub(super) map: Map,
    pub(super) powers: Powers,
    /// Level by level, the leaves, with the boxes of edges, first; node k of a level has nodes 8k
    /// to 8k + 7 of the level below.
    pub(super) nodes: Vec<Node>,
    /// Where each level starts.
    levels: Vec<usize>,
    /// The rings in the order of the tree.
    pub(super) order: &'a [u32],
    /// The first vertex of each of them, and, at the end, the number of vertices.
    firsts: Vec<u32>,
    /// The links of each of them, if there are several; see [`links`].
    pub(super) links: Vec<[u32; 2]>,
    /// Position in `order` of the ring of the first item of each leaf.
    ranks: Vec<u32>,
    /// Which items of each leaf are the first edges of their rings, and which are links, one bit
    /// each.
    marks: Vec<[u8; 2]>,
    n_items: u32,
}

impl<'a> Tree<'a> {
    /// The tree over rings, in the order in which they are laid out.
    pub(super) fn new(rings: &'a Rings<'a>) -> Self {
        let order = &rings.order[..];
        let links = links(rings, order);
        let n_leaves = (rings.points.len() + links.len()).div_ceil(FAN);
        let mut tree = Self {
            rings,
            map: Map::new(&rings.points),
            powers: std::array::from_fn(|k| 1 << k),
            nodes: Vec::with_capacity(n_leaves + n_leaves / (FAN - 1) + FAN),
            levels: vec![0],
            firsts: Vec::with_capacity(order.len() + 1),
            order,
            links,
            ranks: Vec::with_capacity(n_leaves),
            marks: Vec::with_capacity(n_leaves),
            n_items: 0,
        };
        tree.add_items();
        let mut first = 0;
        while tree.nodes.len() - first > 1 {
            let last = tree.nodes.len();
            tree.levels.push(last);
            for start in (first..last).step_by(FAN) {
                let mut node = Node::EMPTY;
                for (k, child) in tree.nodes[start..(start + FAN).min(last)].iter().enumerate() {
                    node.set(k, child.cover());
                }
                tree.nodes.push(node);
            }
            first = last;
        }
        tree
    }

    fn add_items(&mut self) {
        let (rings, map) = (self.rings, self.map);
        for (rank, &ring) in (0..).zip(self.order) {
            let points = rings.ring_points(ring);
            self.firsts.push(rings.rings[ring as usize].first);
            let Some(&first) = points.first() else { continue };
            let mut at = 0;
            while at < points.len() {
                // Eight at once, as far as that goes.
                if self.n_items.is_multiple_of(FAN as u32)
                    && let Some(run) = points[at..].first_chunk::<{ FAN + 1 }>()
                {
                    self.ranks.push(rank);
                    self.marks.push([u8::from(at == 0), 0]);
                    self.nodes.push(Node::of_run(&map, run));
                    self.n_items += FAN as u32;
                    at += FAN;
                    continue;
                }
                let after = points.get(at + 1).copied().unwrap_or(first);
                let bounds = Bounds::of(map.point(points[at]), map.point(after));
                self.push(rank, [at == 0, false], bounds);
                at += 1;
            }
            if let Some(&[a, b]) = self.links.get(rank as usize) {
                let [a, b] = [a, b].map(|k| map.point(rings.point(k)));
                self.push(rank, [false, true], Bounds::of(a, b));
            }
        }
        self.firsts.push(rings.points.len() as u32);
    }

    /// Adds an item, and whether it is the first edge of its ring, or a link.
    fn push(&mut self, rank: u32, marks: [bool; 2], bounds: Bounds) {
        let k = self.n_items as usize % FAN;
        if k == 0 {
            self.ranks.push(rank);
            self.marks.push([0, 0]);
            self.nodes.push(Node::EMPTY);
        }
        if let (Some(node), Some(all)) = (self.nodes.last_mut(), self.marks.last_mut()) {
            node.set(k, bounds);
            all[0] |= u8::from(marks[0]) << k;
            all[1] |= u8::from(marks[1]) << k;
        }
        self.n_items += 1;
    }

    pub(super) fn n_leaves(&self) -> usize {
        self.ranks.len()
    }

    /// Number of levels, the leaves included.
    pub(super) fn height(&self) -> usize {
        self.levels.len()
    }

    /// Position of a node among all nodes.
    #[inline]
    pub(super) fn place(&self, level: usize, node: usize) -> usize {
        self.levels[level] + node
    }

    #[inline]
    pub(super) fn node(&self, level: usize, node: usize) -> &Node {
        &self.nodes[self.place(level, node)]
    }

    /// The boxes of all leaves.
    pub(super) fn leaf_bounds(&self) -> impl Iterator<Item = Bounds> {
        self.nodes[..self.n_leaves()].iter().map(Node::cover)
    }

    /// The box of all edges.
    pub(super) fn bounds(&self) -> Bounds {
        self.nodes.last().map_or(Bounds::EMPTY, Node::cover)
    }

    /// The items of a leaf that start where the one before them in the tree ends, one bit each.
    #[inline]
    pub(super) fn followers(&self, leaf: usize) -> u32 {
        let [heads, links] = self.marks[leaf];
        u32::from(!(heads | links))
    }

    /// Item number `k` of a leaf, which must have as many.
    #[inline]
    pub(super) fn item(&self, leaf: usize, k: usize) -> Item {
        let [heads, _] = self.marks[leaf];
        // Rings that start after the first item, but not after this one.
        let started = u32::from(heads & !1) & ((2 << k) - 1);
        let rank = self.ranks[leaf] + started.count_ones();
        let (first, end) = (self.firsts[rank as usize], self.firsts[rank as usize + 1]);
        // Each ring before this one has a link among the items.
        let start = (leaf * FAN + k) as u32 - rank;
        if start == end {
            let [start, end] = self.links[rank as usize];
            return Item { start, end, rank, is_link: true };
        }
        let next = if start + 1 == end { first } else { start + 1 };
        Item { start, end: next, rank, is_link: false }
    }

    /// The items of a leaf.
    pub(super) fn items(&self, leaf: usize) -> impl Iterator<Item = Item> {
        let n = (self.n_items as usize - leaf * FAN).min(FAN);
        (0..n).map(move |k| self.item(leaf, k))
    }

    #[inline]
    pub(super) fn ends(&self, item: Item) -> (Point, Point) {
        (self.rings.point(item.start), self.rings.point(item.end))
    }

    /// The vertices of a leaf's edges, if it holds eight edges of one ring.
    #[inline]
    pub(super) fn chain(&self, leaf: usize) -> Option<[Point; FAN + 1]> {
        let Item { start, rank, is_link: false, .. } = self.item(leaf, 0) else { return None };
        let (first, end) = (start as usize, self.firsts[rank as usize + 1] as usize);
        let run = self.rings.points.get(first..first + FAN)?;
        if first + FAN > end {
            return None;
        }
        let last =
            if first + FAN == end { self.firsts[rank as usize] as usize } else { first + FAN };
        let mut points = [self.rings.points[last]; FAN + 1];
        points[..FAN].copy_from_slice(run);
        Some(points)
    }
}
