//! The edges that the sweep line meets, from bottom to top: a treap with links to the neighbours.

/// No node, or no edge.
pub(super) const NONE: u32 = u32::MAX;

#[derive(Clone, Copy)]
struct Node {
    edge: u32,
    parent: u32,
    children: [u32; 2],
    /// Neighbours in order: below, above.
    neighbours: [u32; 2],
    priority: u32,
}

const BELOW: usize = 0;
const ABOVE: usize = 1;

/// An ordered list of edges with insertion, removal and search in O(log n), expected over
/// priorities that depend on nothing but the number of insertions before.
pub(super) struct Status {
    nodes: Vec<Node>,
    free: Vec<u32>,
    root: u32,
    /// Lowest and highest node.
    ends: [u32; 2],
    random: u32,
}

/// What a search for a point finds.
pub(super) enum Found {
    /// A node whose edge contains the point.
    Node(u32),
    /// The node just below the point, if any.
    Above(u32),
}

impl Status {
    pub(super) fn new() -> Self {
        let (nodes, free) = (Vec::new(), Vec::new());
        Self { nodes, free, root: NONE, ends: [NONE; 2], random: 0x9e37_79b9 }
    }

    pub(super) fn edge(&self, node: u32) -> u32 {
        self.nodes[node as usize].edge
    }

    pub(super) fn set_edge(&mut self, node: u32, edge: u32) {
        self.nodes[node as usize].edge = edge;
    }

    pub(super) fn below(&self, node: u32) -> u32 {
        self.nodes[node as usize].neighbours[BELOW]
    }

    pub(super) fn above(&self, node: u32) -> u32 {
        self.nodes[node as usize].neighbours[ABOVE]
    }

    /// The node above `node`, or the lowest node if that is `NONE`.
    pub(super) fn after(&self, node: u32) -> u32 {
        if node == NONE { self.ends[BELOW] } else { self.above(node) }
    }

    /// Searches; `side` tells whether the point lies above (+) or below (-) an edge.
    pub(super) fn search(&self, side: impl Fn(u32) -> f64) -> Found {
        let (mut at, mut below) = (self.root, NONE);
        while at != NONE {
            let node = &self.nodes[at as usize];
            let s = side(node.edge);
            if s > 0.0 {
                below = at;
                at = node.children[ABOVE];
            } else if s < 0.0 {
                at = node.children[BELOW];
            } else {
                return Found::Node(at);
            }
        }
        Found::Above(below)
    }

    /// Inserts an edge just above `node`, or at the bottom if that is `NONE`.
    pub(super) fn insert_after(&mut self, node: u32, edge: u32) -> u32 {
        let above = self.after(node);
        let (parent, side) = if node != NONE && self.nodes[node as usize].children[ABOVE] == NONE {
            (node, ABOVE)
        } else {
            (above, BELOW)
        };
        let new = Node {
            edge,
            parent,
            children: [NONE; 2],
            neighbours: [node, above],
            priority: self.next_random(),
        };
        let id = if let Some(id) = self.free.pop() {
            self.nodes[id as usize] = new;
            id
        } else {
            self.nodes.push(new);
            self.nodes.len() as u32 - 1
        };
        if parent == NONE {
            self.root = id;
        } else {
            self.nodes[parent as usize].children[side] = id;
        }
        self.link(node, id);
        self.link(id, above);
        loop {
            let parent = self.nodes[id as usize].parent;
            if parent == NONE
                || self.nodes[parent as usize].priority >= self.nodes[id as usize].priority
            {
                return id;
            }
            self.rotate_up(id);
        }
    }

    pub(super) fn remove(&mut self, node: u32) {
        let [below, above] = self.nodes[node as usize].neighbours;
        loop {
            let Node { children: [low, high], parent, .. } = self.nodes[node as usize];
            if low == NONE || high == NONE {
                let child = if low == NONE { high } else { low };
                self.replace_child(parent, node, child);
                break;
            }
            let priority = |n: u32| self.nodes[n as usize].priority;
            self.rotate_up(if priority(low) > priority(high) { low } else { high });
        }
        self.link(below, above);
        self.free.push(node);
    }

    fn link(&mut self, low: u32, high: u32) {
        if low == NONE {
            self.ends[BELOW] = high;
        } else {
            self.nodes[low as usize].neighbours[ABOVE] = high;
        }
        if high == NONE {
            self.ends[ABOVE] = low;
        } else {
            self.nodes[high as usize].neighbours[BELOW] = low;
        }
    }

    fn rotate_up(&mut self, node: u32) {
        let parent = self.nodes[node as usize].parent;
        let grand = self.nodes[parent as usize].parent;
        let side = usize::from(self.nodes[parent as usize].children[ABOVE] == node);
        let inner = self.nodes[node as usize].children[1 - side];
        self.nodes[parent as usize].children[side] = inner;
        if inner != NONE {
            self.nodes[inner as usize].parent = parent;
        }
        self.nodes[node as usize].children[1 - side] = parent;
        self.replace_child(grand, parent, node);
        self.nodes[parent as usize].parent = node;
    }

    /// Puts `new` where `old` hangs under `parent`.
    fn replace_child(&mut self, parent: u32, old: u32, new: u32) {
        if parent == NONE {
            self.root = new;
        } else {
            let side = usize::from(self.nodes[parent as usize].children[ABOVE] == old);
            self.nodes[parent as usize].children[side] = new;
        }
        if new != NONE {
            self.nodes[new as usize].parent = parent;
        }
    }

    fn next_random(&mut self) -> u32 {
        self.random ^= self.random << 13;
        self.random ^= self.random >> 17;
        self.random ^= self.random << 5;
        self.random
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn listed(status: &Status) -> Vec<u32> {
        let mut list = Vec::new();
        let mut node = status.after(NONE);
        while node != NONE {
            list.push(status.edge(node));
            node = status.above(node);
        }
        list
    }

    fn depth(status: &Status, node: u32) -> u32 {
        if node == NONE {
            return 0;
        }
        let [low, high] = status.nodes[node as usize].children;
        for child in [low, high] {
            assert!(child == NONE || status.nodes[child as usize].parent == node);
        }
        1 + depth(status, low).max(depth(status, high))
    }

    #[test]
    fn the_order_is_that_of_a_plain_list_under_insertion_and_removal() {
        let mut status = Status::new();
        let mut list: Vec<(u32, u32)> = Vec::new();
        let mut seed = 7u64;
        for edge in 0..3000 {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            let r = (seed >> 33) as usize;
            if r.is_multiple_of(3) && !list.is_empty() {
                let (_, node) = list.remove(r / 3 % list.len());
                status.remove(node);
            } else {
                let at = r / 3 % (list.len() + 1);
                let node = status.insert_after(if at == 0 { NONE } else { list[at - 1].1 }, edge);
                list.insert(at, (edge, node));
            }
        }
        assert_eq!(listed(&status), list.iter().map(|l| l.0).collect::<Vec<_>>());
        for (k, &(_, node)) in list.iter().enumerate() {
            let rank = |edge| list.iter().position(|l| l.0 == edge).unwrap_or(0) as f64;
            assert!(matches!(status.search(|e| k as f64 - rank(e)), Found::Node(n) if n == node));
        }
        assert!(depth(&status, status.root) < 40);
    }

    #[test]
    fn appending_in_order_does_not_degenerate() {
        let mut status = Status::new();
        let mut last = NONE;
        for edge in 0..100_000 {
            last = status.insert_after(last, edge);
        }
        assert!(depth(&status, status.root) < 60);
        assert!(matches!(status.search(|_| -1.0), Found::Above(NONE)));
        assert!(matches!(status.search(|_| 1.0), Found::Above(n) if n == last));
    }
}
