//! The nearest edge of a pixel, and the second nearest that makes a pair with it (A.6).
//!
//! Of several edges at one distance the one with the smallest number comes first, so every way to search has the
//! same answer; but for that of the six vertices, which may miss edges.

use super::edges::Edges;
use crate::axis::names;
use crate::geom::{Point, Rect, hilbert};

/// How the two nearest edges of a pixel are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum RidgeSearch {
    /// By a tree of boxes.
    #[default]
    Tree,
    /// By going through all edges in the order of their lower bounds, as the report does.
    Sorted,
    /// Among the edges at the six nearest vertices, as DeSouza and Houghton did: on some shapes the nearest edge
    /// is not among them.
    SixVertices,
}

names!(
    RidgeSearch, "search",
    Tree => "tree", Sorted => "sorted", SixVertices => "six_vertices",
);

/// An edge and the square of its distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Near {
    pub squared: f64,
    pub edge: u32,
}

impl Near {
    const NONE: Self = Self { squared: f64::INFINITY, edge: u32::MAX };

    /// Takes another edge if it comes first.
    #[inline]
    fn offer(&mut self, squared: f64, edge: u32) {
        if squared < self.squared || (squared == self.squared && edge < self.edge) {
            *self = Self { squared, edge };
        }
    }
}

/// What is nearest to a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Two {
    pub first: Near,
    /// Infinitely far if no edge makes a pair with the first one.
    pub second: Near,
}

impl Two {
    /// By how much farther the second edge is (A.6, step 6).
    pub fn quality(&self) -> f64 {
        self.second.squared.sqrt() - self.first.squared.sqrt()
    }
}

/// Answers for one set of edges.
#[derive(Debug)]
pub(super) struct Searcher<'a> {
    edges: &'a Edges,
    /// What lower bounds may be too large by: rounding, relative to the size of everything.
    slack: f64,
    method: Method,
}

#[derive(Debug)]
enum Method {
    Tree(Tree),
    Sorted(Sorted),
    SixVertices(Vec<Near>),
}

/// What rounding may add to a distance, as a share of the size of everything.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

impl<'a> Searcher<'a> {
    pub fn new(edges: &'a Edges, search: RidgeSearch) -> Self {
        let bounds = edges.edges.iter().fold(Rect::EMPTY, |all, edge| all.with(edge.start));
        let largest = [bounds.min.x, bounds.min.y, bounds.max.x, bounds.max.y].map(f64::abs);
        let slack =
            if edges.edges.is_empty() { 0.0 } else { largest.iter().sum::<f64>() * ROUNDING };
        let method = match search {
            RidgeSearch::Tree => Method::Tree(Tree::new(edges, &bounds, slack)),
            RidgeSearch::Sorted => Method::Sorted(Sorted::new(edges)),
            RidgeSearch::SixVertices => Method::SixVertices(Vec::with_capacity(6)),
        };
        Self { edges, slack, method }
    }

    /// Whether each answer takes longer than a look at the clock.
    pub fn takes_long(&self) -> bool {
        !matches!(self.method, Method::Tree(_)) && self.edges.len() > 100
    }

    /// The two nearest edges of a point.
    pub fn two(&mut self, point: Point) -> Two {
        let Self { edges, slack, method } = self;
        match method {
            Method::Tree(tree) => tree.two(edges, point),
            Method::Sorted(sorted) => sorted.two(edges, point, *slack),
            Method::SixVertices(nearest) => six_vertices(edges, point, nearest),
        }
    }
}

/// The segment linked list of the report, kept in the order of the last pixel.
#[derive(Debug)]
struct Sorted {
    list: Vec<Entry>,
}

#[derive(Clone, Copy, Debug)]
struct Entry {
    lower_bound: f64,
    edge: u32,
    /// The square of the distance, once it is computed.
    squared: Option<f64>,
}

impl Sorted {
    fn new(edges: &Edges) -> Self {
        let entry = |edge| Entry { lower_bound: 0.0, edge, squared: None };
        Self { list: (0..edges.len()).map(entry).collect() }
    }

    fn two(&mut self, edges: &Edges, point: Point, slack: f64) -> Two {
        for entry in &mut self.list {
            let bound = edges.edges[entry.edge as usize].lower_bound(point) - slack;
            (entry.lower_bound, entry.squared) = (bound.max(0.0), None);
        }
        // Nearly sorted from the pixel before, which this sort makes use of.
        self.list.sort_by(|a, b| a.lower_bound.total_cmp(&b.lower_bound));
        let first = self.nearest(edges, point, |_| true);
        let distance = first.squared.sqrt();
        let is_pair =
            |edge| edge != first.edge && !edges.is_no_pair(first.edge, edge, point, distance);
        Two { first, second: self.nearest(edges, point, is_pair) }
    }

    fn nearest(&mut self, edges: &Edges, point: Point, is_asked: impl Fn(u32) -> bool) -> Near {
        let mut best = Near::NONE;
        for entry in &mut self.list {
            // The bound is of the distance, not of its square.
            if entry.lower_bound * entry.lower_bound > best.squared {
                break;
            }
            let squared = *entry
                .squared
                .get_or_insert_with(|| edges.edges[entry.edge as usize].squared(point));
            if squared <= best.squared && is_asked(entry.edge) {
                best.offer(squared, entry.edge);
            }
        }
        best
    }
}

/// Children of a node, and edges of a leaf.
const WIDTH: usize = 4;

/// Boxes around edges that are near each other.
#[derive(Debug)]
struct Tree {
    /// The edges in leaves, four by four.
    order: Vec<u32>,
    /// Boxes of leaves, then of nodes above, level by level.
    boxes: Vec<Rect>,
    /// Where each level starts.
    levels: Vec<usize>,
    /// The edges found for the last pixel.
    last: [u32; 2],
    stack: Vec<Waiting>,
}

/// A node that is still to be looked into.
#[derive(Clone, Copy, Debug)]
struct Waiting {
    bound: f64,
    level: u32,
    node: u32,
}

impl Tree {
    fn new(edges: &Edges, bounds: &Rect, slack: f64) -> Self {
        let middle = |edge: u32| {
            let edge = &edges.edges[edge as usize];
            (edge.start + edge.end) * 0.5
        };
        let mut order: Vec<u32> = (0..edges.len()).collect();
        order.sort_by_cached_key(|&edge| hilbert(bounds, middle(edge)));
        let grown = Point::new(slack, slack);
        let leaf = |chunk: &[u32]| {
            let all = chunk.iter().map(|&edge| &edges.edges[edge as usize]);
            let around = all.fold(Rect::EMPTY, |all, edge| all.with(edge.start).with(edge.end));
            Rect { min: around.min - grown, max: around.max + grown }
        };
        let mut boxes: Vec<Rect> = order.chunks(WIDTH).map(leaf).collect();
        let mut levels = vec![0];
        let mut below = 0..boxes.len();
        while below.len() > 1 {
            let union = |chunk: &[Rect]| chunk.iter().fold(Rect::EMPTY, |all, one| all.union(*one));
            let next: Vec<Rect> = boxes[below.clone()].chunks(WIDTH).map(union).collect();
            levels.push(below.end);
            boxes.extend(next);
            below = below.end..boxes.len();
        }
        Self { order, boxes, levels, last: [u32::MAX; 2], stack: Vec::new() }
    }

    fn two(&mut self, edges: &Edges, point: Point) -> Two {
        let first = self.nearest(edges, point, self.last[0], |_| true);
        let distance = first.squared.sqrt();
        let is_pair =
            |edge| edge != first.edge && !edges.is_no_pair(first.edge, edge, point, distance);
        let second = self.nearest(edges, point, self.last[1], is_pair);
        self.last = [first.edge, second.edge];
        Two { first, second }
    }

    /// The nearest edge of those that are asked, with one to begin with.
    fn nearest(
        &mut self,
        edges: &Edges,
        point: Point,
        hint: u32,
        is_asked: impl Fn(u32) -> bool,
    ) -> Near {
        let mut best = Near::NONE;
        if hint < edges.len() && is_asked(hint) {
            best.offer(edges.edges[hint as usize].squared(point), hint);
        }
        let stack = &mut self.stack;
        stack.clear();
        if !self.boxes.is_empty() {
            stack.push(Waiting { bound: 0.0, level: self.levels.len() as u32 - 1, node: 0 });
        }
        while let Some(Waiting { bound, level, node }) = stack.pop() {
            if bound > best.squared {
                continue;
            }
            let first = node as usize * WIDTH;
            if level == 0 {
                for &edge in self.order.iter().skip(first).take(WIDTH) {
                    let squared = edges.edges[edge as usize].squared(point);
                    if squared <= best.squared && is_asked(edge) {
                        best.offer(squared, edge);
                    }
                }
                continue;
            }
            let below = level as usize - 1;
            let (start, end) = (self.levels[below], self.levels[below + 1]);
            let waiting = stack.len();
            for child in first..(first + WIDTH).min(end - start) {
                let bound = beyond(&self.boxes[start + child], point);
                if bound <= best.squared {
                    stack.push(Waiting { bound, level: level - 1, node: child as u32 });
                }
            }
            // The nearest one is looked into first.
            stack[waiting..].sort_unstable_by(|a, b| b.bound.total_cmp(&a.bound));
        }
        best
    }
}

/// The square of the distance of a box from a point.
#[inline]
fn beyond(around: &Rect, point: Point) -> f64 {
    let x = (around.min.x - point.x).max(point.x - around.max.x).max(0.0);
    let y = (around.min.y - point.y).max(point.y - around.max.y).max(0.0);
    x * x + y * y
}

/// The two nearest ones of the edges at the six nearest vertices (III.C).
fn six_vertices(edges: &Edges, point: Point, nearest: &mut Vec<Near>) -> Two {
    nearest.clear();
    for (number, edge) in (0..).zip(&edges.edges) {
        let own = Near { squared: (edge.start - point).norm2(), edge: number };
        let place = nearest.partition_point(|other| other.squared <= own.squared);
        if place < 6 {
            nearest.truncate(5);
            nearest.insert(place, own);
        }
    }
    let incident = nearest.iter().flat_map(|near| [near.edge, edges.before(near.edge)]);
    let (mut first, mut second) = (Near::NONE, Near::NONE);
    for edge in incident.clone() {
        first.offer(edges.edges[edge as usize].squared(point), edge);
    }
    let distance = first.squared.sqrt();
    for edge in incident {
        if edge != first.edge && !edges.is_no_pair(first.edge, edge, point, distance) {
            second.offer(edges.edges[edge as usize].squared(point), edge);
        }
    }
    Two { first, second }
}
