use crate::domain::rings::Rings;
use crate::geom::{Point, Rect};

/// Edges of a leaf, and children of a node.
pub(super) const FAN: usize = 8;

/// Boxes of the children of one node, or of the edges of a leaf, in the coordinates of a [`Map`].
#[derive(Clone, Copy)]
pub(super) struct Node {
    min_x: [f32; FAN],
    min_y: [f32; FAN],
    max_x: [f32; FAN],
    max_y: [f32; FAN],
}

/// A box in the coordinates of a [`Map`].
#[derive(Clone, Copy)]
pub(super) struct Bounds {
    pub(super) min: [f32; 2],
    pub(super) max: [f32; 2],
}

impl Bounds {
    const EMPTY: Self = Self { min: [f32::INFINITY; 2], max: [f32::NEG_INFINITY; 2] };

    fn of([a, b]: [f32; 2], [c, d]: [f32; 2]) -> Self {
        Self { min: [lesser(a, c), lesser(b, d)], max: [larger(a, c), larger(b, d)] }
    }
}

impl Node {
    const EMPTY: Self = Self {
        min_x: [f32::INFINITY; FAN],
        min_y: [f32::INFINITY; FAN],
        max_x: [f32::NEG_INFINITY; FAN],
        max_y: [f32::NEG_INFINITY; FAN],
    };

    /// The boxes of eight consecutive edges.
    #[inline]
    fn of_run(map: &Map, run: &[Point; FAN + 1]) -> Self {
        let (x, y) = (run.map(|p| map.x(p.x)), run.map(|p| map.y(p.y)));
        let of = |choose: fn(f32, f32) -> f32, list: &[f32; FAN + 1]| {
            std::array::from_fn(|k| choose(list[k], list[k + 1]))
        };
        Self {
            min_x: of(lesser, &x),
            min_y: of(lesser, &y),
            max_x: of(larger, &x),
            max_y: of(larger, &y),
        }
    }

    #[inline]
    pub(super) fn child(&self, k: usize) -> Bounds {
        Bounds { min: [self.min_x[k], self.min_y[k]], max: [self.max_x[k], self.max_y[k]] }
    }

    fn set(&mut self, k: usize, b: Bounds) {
        [self.min_x[k], self.min_y[k]] = b.min;
        [self.max_x[k], self.max_y[k]] = b.max;
    }

    fn cover(&self) -> Bounds {
        let least = |list: &[f32; FAN]| list.iter().fold(f32::INFINITY, |a, &b| lesser(a, b));
        let largest = |list: &[f32; FAN]| list.iter().fold(f32::NEG_INFINITY, |a, &b| larger(a, b));
        Bounds {
            min: [least(&self.min_x), least(&self.min_y)],
            max: [largest(&self.max_x), largest(&self.max_y)],
        }
    }

    /// The children whose closed boxes share a point with a box, one bit each.
    #[inline]
    pub(super) fn meets(&self, b: &Bounds, powers: &Powers) -> u32 {
        let lanes: [u32; FAN] = std::array::from_fn(|k| {
            let meets = (self.min_x[k] <= b.max[0])
                & (b.min[0] <= self.max_x[k])
                & (self.min_y[k] <= b.max[1])
                & (b.min[1] <= self.max_y[k]);
            if meets { powers[k] } else { 0 }
        });
        lanes.into_iter().fold(0, |all, lane| all | lane)
    }
}

/// 1, 2, 4 to 128: compilers keep to vector instructions if they are read from memory.
pub(super) type Powers = [u32; FAN];

// Comparisons that are one instruction each; there is no NaN.
#[inline]
fn lesser(a: f32, b: f32) -> f32 {
    if b < a { b } else { a }
}

#[inline]
fn larger(a: f32, b: f32) -> f32 {
    if b > a { b } else { a }
}

/// A map to small coordinates of single precision.
///
/// It never turns the order of two coordinates round, rounding included. So boxes that share a
/// point have images that share one: nothing is missed.
#[derive(Clone, Copy)]
pub(super) struct Map {
    origin: Point,
    scale: f64,
}

impl Map {
    fn new(points: &[Point]) -> Self {
        let (mut min, mut max) = (Rect::EMPTY.min, Rect::EMPTY.max);
        for p in points {
            min.x = if p.x < min.x { p.x } else { min.x };
            min.y = if p.y < min.y { p.y } else { min.y };
            max.x = if p.x > max.x { p.x } else { max.x };
            max.y = if p.y > max.y { p.y } else { max.y };
        }
        let scale = 1.0 / (max.x - min.x).max(max.y - min.y);
        Self { origin: (min + max) * 0.5, scale }
    }

    #[inline]
    pub(super) fn x(&self, x: f64) -> f32 {
        ((x - self.origin.x) * self.scale) as f32
    }

    #[inline]
    pub(super) fn y(&self, y: f64) -> f32 {
        ((y - self.origin.y) * self.scale) as f32
    }

    #[inline]
    fn point(&self, p: Point) -> [f32; 2] {
        [self.x(p.x), self.y(p.y)]
    }
}

/// An edge with its place in its ring.
#[derive(Clone, Copy)]
pub(super) struct Located {
    pub(super) edge: u32,
    pub(super) next: u32,
    pub(super) ring: u32,
}

/// A packed tree of boxes, eight to a node, over edges in boundary order, ring after ring.
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
    order: &'a [u32],
    /// Where in the order of the tree the edges of each of them start.
    starts: Vec<u32>,
    /// Position in `order` of the ring of the first edge of each leaf.
    ranks: Vec<u32>,
    /// Which edges of each leaf are the first of their rings, one bit each.
    heads: Vec<u8>,
}

impl<'a> Tree<'a> {
    /// The tree over rings in the given order: near ones should follow one another.
    pub(super) fn new(rings: &'a Rings<'a>, order: &'a [u32]) -> Self {
        let n = rings.points.len();
        let n_leaves = n.div_ceil(FAN);
        let mut tree = Self {
            rings,
            map: Map::new(&rings.points),
            powers: std::array::from_fn(|k| 1 << k),
            nodes: Vec::with_capacity(n_leaves + n_leaves / (FAN - 1) + FAN),
            levels: vec![0],
            starts: Vec::with_capacity(order.len()),
            order,
            ranks: Vec::with_capacity(n_leaves),
            heads: vec![0; n_leaves],
        };
        tree.add_edges();
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

    fn add_edges(&mut self) {
        let map = self.map;
        let (mut node, mut filled, mut position) = (Node::EMPTY, 0, 0);
        for (rank, &ring) in (0..).zip(self.order) {
            self.starts.push(position);
            if let Some(heads) = self.heads.get_mut(position as usize / FAN) {
                *heads |= 1 << (position as usize % FAN);
            }
            let points = self.rings.ring_points(ring);
            position += points.len() as u32;
            let Some(&first) = points.first() else { continue };
            let mut at = 0;
            while at < points.len() {
                if filled == 0 {
                    self.ranks.push(rank);
                    // Eight at once, as far as that goes.
                    if let Some(run) = points[at..].first_chunk::<{ FAN + 1 }>() {
                        self.nodes.push(Node::of_run(&map, run));
                        at += FAN;
                        continue;
                    }
                }
                let after = points.get(at + 1).copied().unwrap_or(first);
                node.set(filled, Bounds::of(map.point(points[at]), map.point(after)));
                at += 1;
                filled += 1;
                if filled == FAN {
                    self.nodes.push(node);
                    filled = 0;
                }
            }
        }
        if filled > 0 {
            for k in filled..FAN {
                node.set(k, Bounds::EMPTY);
            }
            self.nodes.push(node);
        }
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

    /// The edges of a leaf that start where the edge before them in the tree ends, one bit each.
    #[inline]
    pub(super) fn followers(&self, leaf: usize) -> u32 {
        u32::from(!self.heads[leaf])
    }

    /// Edge number `k` of a leaf.
    #[inline]
    pub(super) fn locate(&self, leaf: usize, k: usize) -> Located {
        let position = (leaf * FAN + k) as u32;
        let mut rank = self.ranks[leaf] as usize;
        while self.starts.get(rank + 1).is_some_and(|&start| start <= position) {
            rank += 1;
        }
        let ring = self.order[rank];
        let record = &self.rings.rings[ring as usize];
        let along = position - self.starts[rank];
        let next = if along + 1 == record.len { 0 } else { along + 1 };
        Located { edge: record.first + along, next: record.first + next, ring }
    }

    #[inline]
    pub(super) fn ends(&self, located: Located) -> (Point, Point) {
        (self.rings.point(located.edge), self.rings.point(located.next))
    }

    /// The vertices of a leaf's edges, if it holds eight edges of one ring.
    #[inline]
    pub(super) fn chain(&self, leaf: usize) -> Option<[Point; FAN + 1]> {
        let Located { edge, ring, .. } = self.locate(leaf, 0);
        let record = &self.rings.rings[ring as usize];
        let (first, end) = (edge as usize, (record.first + record.len) as usize);
        let run = self.rings.points.get(first..first + FAN)?;
        if first + FAN > end {
            return None;
        }
        let last = if first + FAN == end { record.first as usize } else { first + FAN };
        let mut points = [self.rings.points[last]; FAN + 1];
        points[..FAN].copy_from_slice(run);
        Some(points)
    }
}
