//! The main lines of a shape: the longest ways through its axis.
//!
//! # Contract
//! A line runs between two ends of what is left of the axis when blunt corners are taken away, the way
//! between them being the shortest and those ends the farthest apart. Without holes that is the longest
//! path of the axis. Around holes the longest simple path is not to be had in reasonable time, nor is it
//! what a river user expects, who passes each island once, on the shorter side; a ring without any end
//! is one closed line.
//!
//! # Method
//! 1. Ends: corners below a relative excess are pruned (`hierarchy.rs`).
//! 2. In a tree the point farthest from any point is an end of a longest path. With cycles the points far
//!    from the middle of such a path are tried until no pair that is left can be farther apart.
//! 3. Further lines are the longest ones that use no path of those before.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::groups::Groups;
use super::hierarchy::{Hierarchy, HierarchyError};
use super::measure::Measure;
use crate::axis::{Curve, MedialAxis, Path};
use crate::domain::Domain;
use crate::geom::Point;

/// Keypoints that are visited at most to find the longest way around cycles, from all points together
/// that are tried as its end: about a second.
const MOST_VISITED: usize = 1 << 22;

/// What lines are asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CenterlineOptions {
    /// How many lines, at most.
    pub count: usize,
    /// What lies below this value of a measure is no end of a line.
    pub ends: (Measure, f64),
    /// Whether lines go on straight to the boundary.
    pub to_boundary: bool,
}

impl Default for CenterlineOptions {
    /// One line, between ends sharper than some 84 degrees, inside the axis.
    fn default() -> Self {
        Self { count: 1, ends: (Measure::RelativeExcess, 0.5), to_boundary: false }
    }
}

/// A line through an axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Centerline {
    /// The curves it consists of, each starting where the one before ends.
    pub curves: Vec<Curve>,
    /// The points of the boundary before its start and after its end up to which it goes on straight.
    pub extensions: [Option<Point>; 2],
    /// Whether no other pair of ends is farther apart, of what the lines before left; else it was only
    /// not found.
    pub is_longest: bool,
    /// Whether it starts, or ends, where the axis does, and not on another line or a cycle.
    pub is_free: [bool; 2],
}

/// The width of a shape along a line: twice the distance of the boundary, in units of the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Widths {
    /// The least.
    pub least: f64,
    /// The greatest.
    pub greatest: f64,
    /// The mean along the length.
    pub mean: f64,
}

impl Centerline {
    /// Whether it ends where it starts, and not just where two ends of the axis share a corner in which
    /// boundaries touch.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        let ends = self.curves.first().map(Curve::from).zip(self.curves.last().map(Curve::to));
        self.is_free == [false; 2] && ends.is_some_and(|(from, to)| from == to)
    }

    /// Its length inside the axis and, if it goes on to the boundary, beyond.
    #[must_use]
    pub fn length(&self) -> f64 {
        let inside: f64 = self.curves.iter().map(Curve::length).sum();
        let ends = [self.curves.first().map(Curve::from), self.curves.last().map(Curve::to)];
        let beyond = self.extensions.iter().zip(ends);
        inside + beyond.map(|(p, q)| p.zip(q).map_or(0.0, |(p, q)| (p - q).norm())).sum::<f64>()
    }

    /// Its points and the distance of the boundary there, no farther than a tolerance from the curves.
    #[must_use]
    pub fn polyline(&self, tolerance: f64) -> Vec<(Point, f64)> {
        let mut points: Vec<(Point, f64)> = Vec::new();
        points.extend(self.extensions[0].map(|p| (p, 0.0)));
        for (k, curve) in self.curves.iter().enumerate() {
            points.extend(curve.polyline(tolerance).into_iter().skip(usize::from(k > 0)));
        }
        points.extend(self.extensions[1].map(|p| (p, 0.0)));
        points
    }

    /// The widths inside the axis.
    #[must_use]
    pub fn widths(&self) -> Widths {
        let least = self.curves.iter().map(Curve::radius_min).fold(f64::INFINITY, f64::min);
        let greatest = self.curves.iter().map(Curve::radius_max).fold(0.0, f64::max);
        let (mut sum, mut length) = (0.0, 0.0);
        for curve in &self.curves {
            sum += area(curve);
            length += curve.length();
        }
        let mean = if length > 0.0 { (sum / length).clamp(least, greatest) } else { greatest };
        Widths { least: 2.0 * least, greatest: 2.0 * greatest, mean: 2.0 * mean }
    }
}

/// The radius, summed up along a curve by Simpson's rule in pieces that are nearly straight.
fn area(curve: &Curve) -> f64 {
    const PIECES: u32 = 64;
    let at = |k: u32| f64::from(k) / f64::from(PIECES);
    let piece = |k: u32| {
        let piece = curve.piece(at(k), at(k + 1));
        let middle = piece.radius_at(0.5);
        piece.length() * (piece.radius_from() + 4.0 * middle + piece.radius_to()) / 6.0
    };
    (0..PIECES).map(piece).sum()
}

/// The main lines of a shape, the longest inside the axis first.
///
/// A component that is pruned to a single point has the longest way through its whole axis.
///
/// ```
/// use medial::domain::{Domain, Options};
/// use medial::engine::path_tracing;
/// use medial::geom::Point;
/// use medial::ops::{CenterlineOptions, centerlines};
///
/// let ring = [(0., 0.), (6., 0.), (6., 2.), (0., 2.)].map(|(x, y)| Point::new(x, y));
/// let domain = Domain::from_polygons(&[vec![ring.to_vec()]], &Options::default())?;
/// let axis = path_tracing(&domain)?;
/// let options = CenterlineOptions { to_boundary: true, ..CenterlineOptions::default() };
/// let lines = centerlines(&domain, &axis, &options)?;
/// let mut ends = lines[0].polyline(0.01);
/// ends.sort_by(|a, b| a.0.x.total_cmp(&b.0.x));
/// assert_eq!((ends[0].0, ends.last().unwrap().0), (Point::new(0.0, 1.0), Point::new(6.0, 1.0)));
/// assert_eq!((lines[0].length(), lines[0].widths().mean), (6.0, 2.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If the axis is not complete and exact, or not of this domain.
pub fn centerlines(
    domain: &Domain,
    axis: &MedialAxis,
    options: &CenterlineOptions,
) -> Result<Vec<Centerline>, HierarchyError> {
    let (measure, value) = options.ends;
    let pruned = Hierarchy::new(domain, axis)?.pruned(measure, value).axis;
    let mut lines = longest(&pruned, axis, options.count);
    if options.to_boundary {
        for line in &mut lines {
            line.extensions = extensions(domain, line);
        }
    }
    Ok(lines)
}

/// A graph of keypoints and paths, from which paths are taken.
struct Graph<'a> {
    axis: &'a MedialAxis,
    /// The paths at each keypoint.
    incidence: Groups,
    lengths: Vec<f64>,
    used: Vec<bool>,
    /// The place of each keypoint in its component, once that is known.
    places: Vec<u32>,
}

/// Ways from one keypoint to all others of its component, by their places there.
struct Ways {
    /// Infinite where there is none.
    distances: Vec<f64>,
    /// The path by which each is reached.
    last: Vec<u32>,
}

/// A way through the graph.
struct Way {
    paths: Vec<Path>,
    numbers: Vec<u32>,
    length: f64,
    is_longest: bool,
}

const NONE: u32 = u32::MAX;

/// A component of one of two graphs, with its longest way.
struct Component {
    graph: usize,
    keypoints: Vec<u32>,
    way: Way,
}

/// The longest ways through what is left of an axis, or through the axis itself where that is a single
/// point, each without the paths of those before.
fn longest(pruned: &MedialAxis, axis: &MedialAxis, count: usize) -> Vec<Centerline> {
    let mut graphs = vec![Graph::new(pruned)];
    let mut left = Vec::new();
    let add = |graphs: &mut [Graph<'_>], graph: usize, of: &[u32], left: &mut Vec<Component>| {
        let found = graphs[graph].components(of).into_iter();
        left.extend(found.map(|(keypoints, way)| Component { graph, keypoints, way }));
    };
    let all: Vec<u32> = (0..pruned.keypoints().len() as u32).collect();
    add(&mut graphs, 0, &all, &mut left);
    let points = points_left(pruned, axis);
    if !points.is_empty() {
        graphs.push(Graph::new(axis));
        add(&mut graphs, 1, &points, &mut left);
    }
    let mut lines = Vec::new();
    while lines.len() < count {
        let length = |k: usize| -> f64 { left[k].way.length };
        let longest = (0..left.len()).max_by(|&a, &b| length(a).total_cmp(&length(b)));
        let Some(longest) = longest else { break };
        let Component { graph: number, keypoints, way } = left.swap_remove(longest);
        let graph = &mut graphs[number];
        for &path in &way.numbers {
            graph.used[path as usize] = true;
        }
        let is_end = |k: Option<u32>| k.is_some_and(|k| graph.incidence.of(k).len() == 1);
        let is_free =
            [way.paths.first().map(|p| p.from), way.paths.last().map(|p| p.to)].map(is_end);
        let curves = way.paths.iter().map(|path| graph.axis.curve(path)).collect();
        let (extensions, is_longest) = ([None; 2], way.is_longest);
        lines.push(Centerline { curves, extensions, is_longest, is_free });
        add(&mut graphs, number, &keypoints, &mut left);
    }
    lines
}

/// A keypoint of each component of an axis of which a single point is left.
fn points_left(pruned: &MedialAxis, axis: &MedialAxis) -> Vec<u32> {
    let degrees = pruned.degrees();
    if !degrees.contains(&0) {
        return Vec::new();
    }
    let mut path_of = vec![NONE; axis.sites().len()];
    for (number, path) in (0..).zip(axis.paths()) {
        path_of[path.left as usize] = number;
        path_of[path.right as usize] = number;
    }
    // Sites that are left are in the same order.
    let mut all = (0_u32..).zip(axis.sites().iter());
    let same = |site| all.find(|(_, other)| *other == site).map(|(number, _)| number);
    let numbers: Vec<Option<u32>> = pruned.sites().iter().map(same).collect();
    let alone = |&(_, degree): &(u32, u32)| degree == 0;
    let tips = (0..).zip(degrees).filter(alone).map(|(tip, _)| pruned.governors(tip)[0]);
    let paths = tips.filter_map(|site| numbers[site as usize].map(|k| path_of[k as usize]));
    paths.filter(|&path| path != NONE).map(|path| axis.paths().at(path).from).collect()
}

impl<'a> Graph<'a> {
    fn new(axis: &'a MedialAxis) -> Self {
        let lengths = axis.paths().iter().map(|path| axis.curve(&path).length()).collect();
        let used = vec![false; axis.paths().len()];
        let places = vec![NONE; axis.keypoints().len()];
        Self { axis, incidence: Groups::paths_at_keypoints(axis), lengths, used, places }
    }

    /// The paths at a keypoint that are left.
    fn paths_at(&self, keypoint: u32) -> impl Iterator<Item = u32> {
        self.incidence.of(keypoint).iter().copied().filter(|&path| !self.used[path as usize])
    }

    fn other_end(&self, path: u32, keypoint: u32) -> u32 {
        let path = self.axis.paths().at(path);
        if path.from == keypoint { path.to } else { path.from }
    }

    /// The components with a path in which these keypoints lie, each with its longest way. Whatever these
    /// keypoints were joined to before is among them.
    fn components(&mut self, keypoints: &[u32]) -> Vec<(Vec<u32>, Way)> {
        let mut list = Vec::new();
        for &keypoint in keypoints {
            self.places[keypoint as usize] = NONE;
        }
        for &start in keypoints {
            if self.places[start as usize] != NONE || self.paths_at(start).next().is_none() {
                continue;
            }
            self.places[start as usize] = 0;
            let mut component = vec![start];
            let mut next = 0;
            while let Some(&keypoint) = component.get(next) {
                next += 1;
                for &path in self.incidence.of(keypoint) {
                    let other = self.other_end(path, keypoint);
                    if !self.used[path as usize] && self.places[other as usize] == NONE {
                        self.places[other as usize] = component.len() as u32;
                        component.push(other);
                    }
                }
            }
            let way = self.longest(&component);
            list.extend(way.map(|way| (component, way)));
        }
        list
    }

    /// The shortest ways from a keypoint of a component of so many.
    fn ways_from(&self, start: u32, n: usize) -> Ways {
        let place = |keypoint: u32| self.places[keypoint as usize] as usize;
        let mut ways = Ways { distances: vec![f64::INFINITY; n], last: vec![NONE; n] };
        ways.distances[place(start)] = 0.0;
        // Positive numbers are in the order of their bits.
        let mut heap = BinaryHeap::from([Reverse((0_u64, start))]);
        while let Some(Reverse((bits, keypoint))) = heap.pop() {
            let distance = f64::from_bits(bits);
            if distance > ways.distances[place(keypoint)] {
                continue;
            }
            for path in self.paths_at(keypoint) {
                let other = self.other_end(path, keypoint);
                let there = distance + self.lengths[path as usize];
                if there < ways.distances[place(other)] {
                    ways.distances[place(other)] = there;
                    ways.last[place(other)] = path;
                    heap.push(Reverse((there.to_bits(), other)));
                }
            }
        }
        ways
    }

    /// Of some keypoints of a component the one that is farthest by these ways; of equal ones the first.
    fn farthest(&self, keypoints: &[u32], ways: &Ways) -> (u32, f64) {
        let mut best = (keypoints[0], 0.0);
        for &keypoint in keypoints {
            let distance = ways.distances[self.places[keypoint as usize] as usize];
            if distance > best.1 {
                best = (keypoint, distance);
            }
        }
        best
    }

    /// The way between those two ends of a component that are farthest apart. If it has one end only, from
    /// there to the farthest keypoint; if none, between the farthest two, or all of it, if it is a single
    /// cycle.
    fn longest(&self, component: &[u32]) -> Option<Way> {
        let degree = |keypoint: u32| self.paths_at(keypoint).count();
        let n = component.len();
        let n_paths = component.iter().map(|&k| degree(k)).sum::<usize>() / 2;
        if component.iter().all(|&k| degree(k) == 2) {
            return Some(self.cycle(component[0]));
        }
        let mut ends: Vec<u32> = component.iter().copied().filter(|&k| degree(k) == 1).collect();
        let lone = (ends.len() == 1).then(|| ends[0]);
        if ends.len() < 2 {
            ends = component.to_vec();
        }
        let place = |keypoint: u32| self.places[keypoint as usize] as usize;
        let start =
            lone.unwrap_or_else(|| self.farthest(&ends, &self.ways_from(component[0], n)).0);
        let mut best = (start, self.ways_from(start, n));
        let (mut end, mut length) = self.farthest(&ends, &best.1);
        let mut is_longest = true;
        if n_paths >= n && lone.is_none() {
            // Around cycles: from the middle of the way found, no two ends are farther apart than twice
            // the farther of the two.
            let middle = self.back(&best.1, best.0, end);
            let half = middle
                .iter()
                .map(|&(_, k)| k)
                .find(|&k| best.1.distances[place(k)] * 2.0 <= length);
            let around = self.ways_from(half.unwrap_or(end), n);
            let distance = |k: u32| around.distances[place(k)];
            let mut order = ends.clone();
            order.sort_by(|&a, &b| distance(b).total_cmp(&distance(a)).then(a.cmp(&b)));
            for (tried, &keypoint) in order.iter().enumerate() {
                if 2.0 * distance(keypoint) <= length {
                    break;
                }
                if tried * n > MOST_VISITED {
                    is_longest = false;
                    break;
                }
                let ways = self.ways_from(keypoint, n);
                let (other, there) = self.farthest(&ends, &ways);
                if there > length {
                    (best, end, length) = ((keypoint, ways), other, there);
                }
            }
        }
        let mut back = self.back(&best.1, best.0, end);
        back.reverse();
        let mut way = Way { paths: Vec::new(), numbers: Vec::new(), length, is_longest };
        for (number, from) in back {
            let path = self.axis.paths().at(number);
            way.paths.push(if path.from == from { path } else { path.reversed() });
            way.numbers.push(number);
        }
        (length > 0.0).then_some(way)
    }

    /// The paths on the way back from a keypoint to where the ways start, each with the end nearer to
    /// the start.
    fn back(&self, ways: &Ways, start: u32, from: u32) -> Vec<(u32, u32)> {
        let mut back = Vec::new();
        let mut keypoint = from;
        while keypoint != start {
            let path = ways.last[self.places[keypoint as usize] as usize];
            keypoint = self.other_end(path, keypoint);
            back.push((path, keypoint));
        }
        back
    }

    /// A closed way through keypoints with two paths each.
    fn cycle(&self, start: u32) -> Way {
        let mut way = Way { paths: Vec::new(), numbers: Vec::new(), length: 0.0, is_longest: true };
        let mut keypoint = start;
        loop {
            let next = self.paths_at(keypoint).find(|path| way.numbers.last() != Some(path));
            let Some(number) = next.or_else(|| self.paths_at(keypoint).next()) else { return way };
            let path = self.axis.paths().at(number);
            way.paths.push(if path.from == keypoint { path } else { path.reversed() });
            way.numbers.push(number);
            way.length += self.lengths[number as usize];
            keypoint = self.other_end(number, keypoint);
            if keypoint == start {
                return way;
            }
        }
    }
}

/// Where a line meets the boundary if it goes on straight beyond both ends.
fn extensions(domain: &Domain, line: &Centerline) -> [Option<Point>; 2] {
    let (Some(first), Some(last)) = (line.curves.first(), line.curves.last()) else {
        return [None; 2];
    };
    let start = first.from() - first.control().unwrap_or(first.to());
    let end = last.to() - last.control().unwrap_or(last.from());
    let [starts_free, ends_free] = line.is_free;
    // In a corner it is on the boundary already.
    let beyond = |is_free: bool, radius: f64| is_free && radius > 0.0;
    [
        beyond(starts_free, first.radius_from())
            .then(|| hit(domain, first.from(), start))
            .flatten(),
        beyond(ends_free, last.radius_to()).then(|| hit(domain, last.to(), end)).flatten(),
    ]
}

/// Where a ray meets the boundary first.
fn hit(domain: &Domain, from: Point, way: Point) -> Option<Point> {
    let mut first: Option<f64> = None;
    for edge in 0..domain.edges().len() as u32 {
        let (a, b) = (domain.edge(edge).start - from, domain.end(edge) - from);
        let (left, right) = (way.cross(a), way.cross(b));
        // From inside an edge is met from its left.
        if left <= 0.0 && right >= 0.0 && left < right {
            let along = a.cross(b) / (right - left);
            if along > 0.0 && first.is_none_or(|first| along < first) {
                first = Some(along);
            }
        }
    }
    first.map(|along| from + way * along)
}
