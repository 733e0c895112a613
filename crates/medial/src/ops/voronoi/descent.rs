//! Down a hierarchy of keypoints to the path over a point.
//!
//! # Contract
//! From a keypoint whose maximal disk holds the point, O(log n) keypoints are looked at, each with a few
//! exact questions to its disk, however near the elements around are to a tie. What is found is a
//! proposal that one exact question to a cell proves; around holes there may be none.
//!
//! # Method
//! Keypoints whose disks hold a point are neighbours: if the disks of two hold it, so do those of all
//! on the way between them. For the spokes of a keypoint on the way part the two, so the way from the
//! point to one of the two centres crosses a spoke, and by the triangle inequality the foot of that
//! spoke is farther from the point than its centre is.
//!
//! 1. Once: cut every cycle of the axis where its radius is least, and choose in each tree that is left
//!    the keypoint that halves it, and so on in its parts.
//! 2. From the top: if the disk of a keypoint holds the point, the point lies between two of its
//!    spokes, and goes on along the path between these two. If not, everything goes on to where the
//!    last keypoint is whose disk held it.
//! 3. Between two keypoints that are done there is one path, and the nearer of its governors is the
//!    element sought.

use std::cmp::Ordering;

use smallvec::SmallVec;

use super::sheet::{NONE, Sheet};
use crate::geom::predicates::{Element, ExactDisk};
use crate::geom::{Point, cross_directions};
use crate::ops::groups::Groups;

/// The hierarchy of the keypoints of one axis.
#[derive(Debug)]
pub(super) struct Hierarchy {
    /// The keypoint above each, or [`NONE`].
    above: Vec<u32>,
    /// How many there are above each.
    depth: Vec<u8>,
    /// For each keypoint where its gaps start.
    first_gap: Vec<u32>,
    /// The path in the gap behind each governor of each keypoint, or [`NONE`].
    gaps: Vec<u32>,
    /// Whether the path is in the trees.
    kept: Vec<bool>,
}

/// What is nearest to a point: one of the governors of this.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Found {
    Path(u32),
    Keypoint(u32),
}

impl Hierarchy {
    pub fn new(sheet: &Sheet) -> Self {
        let (keypoints, paths) = (sheet.axis.keypoints(), sheet.axis.paths());
        let n = keypoints.len();
        // The paths at each keypoint.
        let ends = Groups::new(n, || {
            (0..).zip(paths.iter()).flat_map(|(k, path)| [(path.from, k), (path.to, k)])
        });
        let kept = forest(sheet);
        let (first_gap, gaps) = gaps(sheet, &ends);
        let mut hierarchy =
            Self { above: vec![NONE; n], depth: vec![UNKNOWN; n], first_gap, gaps, kept };
        hierarchy.halve(sheet, &ends);
        hierarchy
    }

    /// Chooses the keypoint that halves each tree, and so on in its parts.
    fn halve(&mut self, sheet: &Sheet, ends: &Groups) {
        let n = self.above.len() as u32;
        let mut order: Vec<(u32, u32)> = Vec::new();
        let mut size = vec![0_u32; n as usize];
        for first in 0..n {
            // First keypoints of trees, with what is above them.
            let mut trees = vec![(first, NONE, 0)];
            while let Some((first, above, depth)) = trees.pop() {
                if self.depth[first as usize] != UNKNOWN {
                    continue;
                }
                order.clear();
                order.push((first, NONE));
                let mut k = 0;
                while let Some(&(keypoint, from)) = order.get(k) {
                    size[keypoint as usize] = 1;
                    let next = self.beside(sheet, ends, keypoint).filter(|&other| other != from);
                    order.extend(next.map(|other| (other, keypoint)));
                    k += 1;
                }
                let whole = order.len() as u32;
                let mut middle = first;
                for &(keypoint, from) in order.iter().rev() {
                    let own = size[keypoint as usize];
                    if 2 * own >= whole {
                        middle = keypoint;
                        break;
                    }
                    size[from as usize] += own;
                }
                self.above[middle as usize] = above;
                self.depth[middle as usize] = depth;
                trees
                    .extend(self.beside(sheet, ends, middle).map(|next| (next, middle, depth + 1)));
            }
        }
    }

    /// The keypoints at the other ends of the kept paths of a keypoint, as far as they have no place yet.
    fn beside<'h>(
        &'h self,
        sheet: &'h Sheet,
        ends: &'h Groups,
        keypoint: u32,
    ) -> impl Iterator<Item = u32> + 'h {
        let paths = ends.of(keypoint).iter().filter(|&&path| self.kept[path as usize]);
        let others = paths.map(move |&path| other_end(sheet, path, keypoint));
        others.filter(|&other| self.depth[other as usize] == UNKNOWN)
    }

    /// What is nearest to a point that the disk of a keypoint holds; `None` if that cannot be told here.
    pub fn descend(&self, sheet: &Sheet, p: Point, start: u32) -> Option<Found> {
        // A keypoint where the point lies or which it lies beyond, and the path that led there.
        let (mut ahead, mut last) = (start, None);
        let mut way = self.way_to(ahead, 0);
        let mut at = way.pop()?;
        loop {
            let disk = sheet.disk(at).filter(|disk| disk.side(Element::Corner(p)).is_lt());
            if let Some(disk) = disk {
                let Some(path) = self.gap(sheet, at, &disk, p) else {
                    return Some(Found::Keypoint(at));
                };
                if !self.kept[path as usize] {
                    return None;
                }
                ahead = other_end(sheet, path, at);
                if self.depth[ahead as usize] < self.depth[at as usize] {
                    return Some(Found::Path(path));
                }
                last = Some(path);
                way = self.way_to(ahead, self.depth[at as usize] + 1);
            } else if at == ahead {
                return last.map(Found::Path);
            }
            at = way.pop()?;
        }
    }

    /// A keypoint and those above it that have at least so many above them, from below.
    fn way_to(&self, keypoint: u32, depth: u8) -> SmallVec<[u32; 32]> {
        let reaches = |&k: &u32| k != NONE && self.depth[k as usize] >= depth;
        let first = Some(keypoint).filter(reaches);
        let up = |&k: &u32| Some(self.above[k as usize]).filter(reaches);
        std::iter::successors(first, up).collect()
    }

    /// The path between the two spokes of a keypoint between which a point of its disk lies; `None` if it
    /// is the keypoint itself, or on the line of its only two spokes.
    fn gap(&self, sheet: &Sheet, at: u32, disk: &ExactDisk, p: Point) -> Option<u32> {
        let list = sheet.axis.governors(at);
        let n = list.len();
        let first_gap = self.first_gap[at as usize] as usize;
        let element = |k: usize| sheet.element(sheet.governor(list[k % n]));
        let path = |k: usize| self.gaps[first_gap + k % n];
        let p = Element::Corner(p);
        let guess = guess(sheet, at, p);
        let holds = |k: &usize| {
            let [before, after] = [element(*k), element(k + 1)];
            // Less than half a turn ahead of one spoke, less than that behind the next; or one of both,
            // if there is more than half a turn between them.
            let (ahead, behind) = (turn(disk, before, p).is_ge(), turn(disk, after, p).is_lt());
            if turn(disk, before, after).is_lt() { ahead || behind } else { ahead && behind }
        };
        (guess..guess + n).find(|k| path(*k) != NONE && holds(k)).map(path)
    }
}

/// No depth.
const UNKNOWN: u8 = u8::MAX;

/// The sign of the cross product of the directions from the centre of a disk to its contacts with two
/// elements; another corner stands for its own place.
fn turn(disk: &ExactDisk, first: Element, second: Element) -> Ordering {
    match (first, second) {
        // Both directions turned by a quarter turn are those of the edges.
        (Element::Edge(a, b), Element::Edge(c, d)) => {
            cross_directions(a, b, c, d).partial_cmp(&0.0).unwrap_or(Ordering::Equal)
        }
        // The contact with an edge lies along (d.y, -d.x): its cross product with q - c is d·(q - c).
        (Element::Edge(a, b), Element::Corner(q)) => disk.along(a, b, q).reverse(),
        (Element::Corner(q), Element::Edge(a, b)) => disk.along(a, b, q),
        (Element::Corner(p), Element::Corner(q)) => disk.orientation(p, q),
    }
}

/// About the number of the spoke before a point, counterclockwise; only the time it takes to find the
/// right one depends on it.
fn guess(sheet: &Sheet, at: u32, p: Element) -> usize {
    let centre = sheet.axis.keypoints().at(at).position;
    let list = sheet.axis.governors(at);
    let direction = |element: Element| match element {
        Element::Edge(a, b) => -(b - a).perp(),
        Element::Corner(q) => q - centre,
    };
    let spoke = |k: usize| direction(sheet.element(sheet.governor(list[k])));
    // Grows with the angle from the first spoke.
    let first = spoke(0);
    let angle = |v: Point| {
        let (x, y) = (first.dot(v), first.cross(v));
        let share = y / (x.abs() + y.abs());
        match (x < 0.0, y < 0.0) {
            (true, _) => 2.0 - share,
            (false, false) => share,
            (false, true) => 4.0 + share,
        }
    };
    let sought = angle(direction(p));
    let (mut low, mut high) = (1, list.len());
    while low < high {
        let middle = low.midpoint(high);
        if angle(spoke(middle)) <= sought { low = middle + 1 } else { high = middle }
    }
    low - 1
}

fn other_end(sheet: &Sheet, path: u32, end: u32) -> u32 {
    let path = sheet.axis.paths().at(path);
    if path.from == end { path.to } else { path.from }
}

/// The path in the gap behind each governor of each keypoint, with where those of each start.
fn gaps(sheet: &Sheet, ends: &Groups) -> (Vec<u32>, Vec<u32>) {
    let axis = sheet.axis;
    let n = axis.keypoints().len() as u32;
    let mut first_gap = Vec::with_capacity(n as usize + 1);
    let mut gaps = Vec::new();
    let mut place = vec![NONE; axis.sites().len()];
    for keypoint in 0..n {
        let first = gaps.len();
        first_gap.push(first as u32);
        let list = axis.governors(keypoint);
        gaps.resize(first + list.len(), NONE);
        for (k, &site) in (0..).zip(list) {
            place[site as usize] = k;
        }
        for &number in ends.of(keypoint) {
            let path = axis.paths().at(number);
            // Seen from the keypoint, the governor before the path is on its right.
            let before = if path.from == keypoint { path.right } else { path.left };
            let k = place[before as usize] as usize;
            // No governor of a keypoint with defects.
            if list.get(k) == Some(&before) {
                gaps[first + k] = number;
            }
        }
    }
    (first_gap, gaps)
}

/// Whether each path is kept when every cycle is cut where its radius is least.
fn forest(sheet: &Sheet) -> Vec<bool> {
    let paths = sheet.axis.paths();
    let radius = |path| sheet.axis.curve(&path).radius_min();
    let mut order: Vec<(f64, u32)> = paths.iter().map(radius).zip(0..).collect();
    order.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let mut root: Vec<u32> = (0..sheet.axis.keypoints().len() as u32).collect();
    let mut kept = vec![false; paths.len()];
    for (_, number) in order {
        let path = paths.at(number);
        let [a, b] = [path.from, path.to].map(|k| root_of(&mut root, k));
        if a != b {
            root[a as usize] = b;
            kept[number as usize] = true;
        }
    }
    kept
}

/// The root of a tree of numbers, with ways halved.
fn root_of(root: &mut [u32], mut k: u32) -> u32 {
    while root[k as usize] != k {
        let next = root[root[k as usize] as usize];
        root[k as usize] = next;
        k = next;
    }
    k
}
