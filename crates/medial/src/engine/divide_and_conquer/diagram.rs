//! Diagrams as lists of the arcs around each cell.

use std::cell::Cell;
use std::ops::{Index, IndexMut, Range};

use super::disks::Disk;
use super::elements::{Flank, Member};

/// No arc.
pub(super) const NONE: u32 = u32::MAX;
/// The vertex where an arc begins or ends in a corner of the boundary.
pub(super) const APEX: u32 = u32::MAX - 1;
/// The vertex at the far end of an unbounded arc.
pub(super) const INFINITE: u32 = u32::MAX - 2;

/// An arc as the boundary of one of its two cells, counterclockwise: the cell lies to its left.
///
/// The arc as the other cell sees it has the number with the last bit changed.
#[derive(Clone, Copy, Debug)]
pub(super) struct Half {
    pub cell: Member,
    pub from: u32,
    /// The next one around the cell; the last one ends at the element itself. Between two unbounded
    /// ones the cell reaches infinity.
    pub next: u32,
    pub prev: u32,
}

/// The diagrams of some chains, with all their arcs.
#[derive(Debug)]
pub(super) struct Diagram {
    pub halves: Vec<Half>,
    /// The disk of each vertex, by three of the elements that it touches.
    pub vertices: Vec<Disk>,
    pub ends: Ends,
    /// How many pieces of merge curves were followed.
    pub pieces: usize,
    /// How many arcs were looked at.
    pub arcs: Cell<usize>,
}

/// The first and the last arc around each cell, by the number of the member.
#[derive(Debug)]
pub(super) struct Ends {
    /// The number of the first one.
    first: usize,
    ends: Vec<[u32; 2]>,
}

impl Ends {
    fn new(edges: Range<u32>) -> Self {
        Self { first: 4 * edges.start as usize, ends: vec![[NONE; 2]; 4 * edges.len()] }
    }

    pub fn len(&self) -> usize {
        self.ends.len()
    }
}

impl Index<usize> for Ends {
    type Output = [u32; 2];

    #[inline]
    fn index(&self, member: usize) -> &[u32; 2] {
        &self.ends[member - self.first]
    }
}

impl IndexMut<usize> for Ends {
    #[inline]
    fn index_mut(&mut self, member: usize) -> &mut [u32; 2] {
        &mut self.ends[member - self.first]
    }
}

impl Diagram {
    /// Room for the diagrams of these edges.
    pub fn with_room(edges: Range<u32>) -> Self {
        let n = edges.len();
        Self {
            halves: Vec::with_capacity(24 * n),
            vertices: Vec::with_capacity(6 * n),
            ends: Ends::new(edges),
            pieces: 0,
            arcs: Cell::new(0),
        }
    }

    /// Takes in the diagrams of the edges that follow, made apart.
    pub fn append(&mut self, next: Self) {
        let (n_halves, n_vertices) = (self.halves.len() as u32, self.vertices.len() as u32);
        let moved = |number: u32, by: u32| if number < INFINITE { number + by } else { number };
        self.halves.extend(next.halves.iter().map(|half| Half {
            cell: half.cell,
            from: moved(half.from, n_vertices),
            next: moved(half.next, n_halves),
            prev: moved(half.prev, n_halves),
        }));
        self.vertices.extend(next.vertices);
        let ends = next.ends.ends.iter();
        self.ends.ends.extend(ends.map(|ends| ends.map(|half| moved(half, n_halves))));
        self.pieces += next.pieces;
        self.arcs.set(self.arcs.get() + next.arcs.get());
    }

    /// Adds the diagram of a single edge: four cells, with four arcs between them, the normals at both
    /// ends on both sides.
    pub fn add_edge(&mut self, edge: u32) {
        let [left, right] = [Flank::Left, Flank::Right].map(|f| Member::side(edge, f));
        let (start, end) = (Member::start(edge), Member::end(edge));
        // Outwards with the first cell to the left.
        let up_at_end = self.ray(left, end);
        let up_at_start = self.ray(start, left);
        let down_at_start = self.ray(right, start);
        let down_at_end = self.ray(end, right);
        self.bound(left, up_at_end, up_at_start ^ 1);
        self.bound(start, up_at_start, down_at_start ^ 1);
        self.bound(right, down_at_start, down_at_end ^ 1);
        self.bound(end, down_at_end, up_at_end ^ 1);
    }

    /// Counts one more arc that is looked at.
    pub fn count_arc(&self) {
        self.arcs.set(self.arcs.get() + 1);
    }

    /// An arc from a corner to infinity.
    fn ray(&mut self, left: Member, right: Member) -> u32 {
        let arc = self.arc(left, right, APEX);
        self.halves[arc as usize ^ 1].from = INFINITE;
        arc
    }

    /// A new arc that starts at a vertex, with a cell to either side; gives the half of the left one.
    pub fn arc(&mut self, left: Member, right: Member, from: u32) -> u32 {
        let arc = self.halves.len() as u32;
        let half = Half { cell: left, from, next: NONE, prev: NONE };
        self.halves.push(half);
        self.halves.push(Half { cell: right, from: NONE, ..half });
        arc
    }

    /// Bounds a cell by two arcs.
    fn bound(&mut self, cell: Member, first: u32, last: u32) {
        self.link(first, last);
        self.ends[cell.0 as usize] = [first, last];
    }

    /// Makes one arc the next of another.
    pub fn link(&mut self, half: u32, next: u32) {
        self.halves[half as usize].next = next;
        self.halves[next as usize].prev = half;
    }

    pub fn half(&self, half: u32) -> &Half {
        &self.halves[half as usize]
    }

    /// The cell beyond an arc.
    pub fn beyond(&self, half: u32) -> Member {
        self.half(half ^ 1).cell
    }

    /// Gives a cell to another member.
    pub fn rename(&mut self, from: Member, to: Member) {
        let mut half = self.ends[from.0 as usize][0];
        if from == to || half == NONE {
            return;
        }
        self.ends[to.0 as usize] = std::mem::replace(&mut self.ends[from.0 as usize], [NONE; 2]);
        while half != NONE {
            let Half { from: vertex, next, .. } = self.halves[half as usize];
            self.halves[half as usize].cell = to;
            if let Some(disk) = self.vertices.get_mut(vertex as usize) {
                disk.triple = disk.triple.map(|member| if member == from { to } else { member });
            }
            half = next;
        }
    }

    /// A new vertex.
    pub fn vertex(&mut self, disk: Disk) -> u32 {
        self.vertices.push(disk);
        self.vertices.len() as u32 - 1
    }

    /// The disk of a vertex, if it is one: neither in a corner nor at infinity.
    pub fn disk(&self, vertex: u32) -> Option<Disk> {
        self.vertices.get(vertex as usize).copied()
    }

    /// The vertex where an arc ends.
    pub fn to(&self, half: u32) -> u32 {
        self.half(half ^ 1).from
    }

    /// Halves that leave a vertex, counterclockwise, from one of them on.
    pub fn around(&self, half: u32) -> impl Iterator<Item = u32> {
        std::iter::successors(Some(half), move |&last| {
            let before = self.half(last).prev;
            (before != NONE && before ^ 1 != half).then_some(before ^ 1)
        })
    }

    /// Gives all halves that leave a vertex another one.
    pub fn replace(&mut self, first: u32, vertex: u32) {
        let mut half = first;
        loop {
            self.halves[half as usize].from = vertex;
            let before = self.half(half).prev;
            if before == NONE || before ^ 1 == first {
                return;
            }
            half = before ^ 1;
        }
    }
}
