//! How two axes of one domain differ, whoever computed them.
//!
//! # Contract
//! Graphs are compared without coordinates: sites by their names, keypoints by their cyclic
//! governor lists, paths by their governors and the keypoints at both ends, each as often as it
//! occurs. Distances are measured in doubles; nothing is decided by them. O(n log n) for n paths.
//!
//! # Method
//! 1. Number names, then lists, then paths, equal ones of the two axes alike, and pair them.
//! 2. Of paired keypoints take the distance of the centres and the difference of the radii.
//! 3. For keypoints and some inner points of each path find the distance from the other axis. That
//!    from the paired keypoint or path is no less, so a tree of all curves is asked only where this
//!    would change the largest distance: never, where two exact axes agree bit for bit.

use std::ops::Range;

use super::Name;
use crate::axis::{Curve, Keypoint, MedialAxis, Site};
use crate::geom::{BoundsTree, Point, Rect, Visitor, hilbert};

/// How an axis differs from another one of the same domain, the reference.
///
/// Distances are in units of the input.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Difference {
    /// Keypoints that the axis has and the reference has not, by their cyclic governor lists.
    pub extra_keypoints: usize,
    /// Keypoints of the reference that the axis has not.
    pub missing_keypoints: usize,
    /// Paths that the axis has and the reference has not, by their governors and both ends.
    pub extra_paths: usize,
    /// Paths of the reference that the axis has not.
    pub missing_paths: usize,
    /// Largest distance between the centres of a keypoint that both have.
    pub position: f64,
    /// Largest difference between the radii of a keypoint that both have.
    pub radius: f64,
    /// Largest distance of a point of the axis from the reference: of keypoints, and of three inner
    /// points of each path. Infinite if only the reference is empty.
    pub distance: f64,
    /// The same of a point of the reference from the axis.
    pub missed: f64,
}

impl Difference {
    /// Whether both have the same keypoints and paths, told by governors.
    #[must_use]
    pub fn is_same_graph(&self) -> bool {
        let Self { extra_keypoints, missing_keypoints, extra_paths, missing_paths, .. } = *self;
        [extra_keypoints, missing_keypoints, extra_paths, missing_paths] == [0; 4]
    }
}

/// How an axis differs from a reference, an axis of the same domain.
///
/// ```
/// use medial::check;
/// use medial::domain::{Domain, Options};
/// use medial::engine::{divide_and_conquer, path_tracing};
/// use medial::geom::Point;
/// let corners = [(0.0, 0.0), (5.0, 0.0), (5.0, 2.0), (0.0, 2.0)].map(|(x, y)| Point::new(x, y));
/// let rectangle = Domain::from_polygons(&[vec![corners.to_vec()]], &Options::default())?;
/// let found =
///     check::difference(&path_tracing(&rectangle)?, &divide_and_conquer(&rectangle)?);
/// assert!(found.is_same_graph());
/// assert_eq!((found.position, found.radius, found.distance), (0.0, 0.0, 0.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn difference(reference: &MedialAxis, axis: &MedialAxis) -> Difference {
    let names = |axis: &MedialAxis| -> Vec<Name> {
        axis.sites().iter().map(|site| Name::from(&site)).collect()
    };
    let sites = numbered(&names(axis), &names(reference));
    let (ours, theirs) = (lists(axis, &sites[0]), lists(reference, &sites[1]));
    let lists = numbered(&ours, &theirs);
    let (ours, theirs) =
        (lines(axis, &sites[0], &lists[0]), lines(reference, &sites[1], &lists[1]));
    let lines = numbered(&ours, &theirs);
    let middles = |axis: &MedialAxis| -> Vec<Point> {
        let at = |k: u32| axis.keypoints().at(k).position;
        axis.paths().iter().map(|path| (at(path.from) + at(path.to)) * 0.5).collect()
    };
    let places = |axis: &MedialAxis| -> Vec<Point> {
        axis.keypoints().iter().map(|keypoint| keypoint.position).collect()
    };
    let keypoints = paired(&lists, &[places(axis), places(reference)]);
    let paths = paired(&lines, &[middles(axis), middles(reference)]);
    let mut difference = Difference {
        extra_keypoints: unpaired(&keypoints.ours),
        missing_keypoints: unpaired(&keypoints.theirs),
        extra_paths: unpaired(&paths.ours),
        missing_paths: unpaired(&paths.theirs),
        ..Difference::default()
    };
    for (k, other) in axis.keypoints().iter().zip(&keypoints.ours) {
        let Some(other) = other else { continue };
        let other = reference.keypoints().at(*other);
        let far = (k.position - other.position).norm();
        difference.position = larger(difference.position, far);
        difference.radius = larger(difference.radius, (k.radius - other.radius).abs());
    }
    difference.distance = distance(axis, reference, &keypoints.ours, &paths.ours);
    difference.missed = distance(reference, axis, &keypoints.theirs, &paths.theirs);
    difference
}

/// The larger of two numbers, infinite if one of them is none.
fn larger(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::INFINITY } else { a.max(b) }
}

/// Numbers for two lists of keys, equal keys alike.
fn numbered<K: Ord>(ours: &[K], theirs: &[K]) -> [Vec<u32>; 2] {
    let tagged = |keys: &'_ [K], list: usize| (0..keys.len()).map(move |k| (list, k));
    let key = |&(list, k): &(usize, usize)| if list == 0 { &ours[k] } else { &theirs[k] };
    let mut order: Vec<(usize, usize)> = tagged(ours, 0).chain(tagged(theirs, 1)).collect();
    order.sort_unstable_by(|a, b| key(a).cmp(key(b)));
    let mut numbers = [vec![0; ours.len()], vec![0; theirs.len()]];
    let mut number = 0;
    for (place, at) in order.iter().enumerate() {
        if place > 0 && key(&order[place - 1]) != key(at) {
            number += 1;
        }
        numbers[at.0][at.1] = number;
    }
    numbers
}

/// For each item of two lists its partner in the other one.
struct Pairs {
    ours: Vec<Option<u32>>,
    theirs: Vec<Option<u32>>,
}

/// Pairs items with equal numbers, each with one.
///
/// Where several items of a list have one number, as the two ends of a bisector that is clipped on
/// both sides, they are taken in the order of their places.
fn paired([ours, theirs]: &[Vec<u32>; 2], places: &[Vec<Point>; 2]) -> Pairs {
    let sorted = |numbers: &[u32], places: &[Point]| {
        let mut order: Vec<u32> = (0..numbers.len() as u32).collect();
        order.sort_unstable_by(|&a, &b| {
            let (a, b) = (a as usize, b as usize);
            let (p, q) = (places[a], places[b]);
            let by_place = || p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y));
            numbers[a].cmp(&numbers[b]).then_with(by_place).then(a.cmp(&b))
        });
        order
    };
    let mut pairs = Pairs { ours: vec![None; ours.len()], theirs: vec![None; theirs.len()] };
    let (left, right) = (sorted(ours, &places[0]), sorted(theirs, &places[1]));
    let (mut i, mut j) = (0, 0);
    while let (Some(&a), Some(&b)) = (left.get(i), right.get(j)) {
        let order = ours[a as usize].cmp(&theirs[b as usize]);
        if order.is_eq() {
            pairs.ours[a as usize] = Some(b);
            pairs.theirs[b as usize] = Some(a);
        }
        i += usize::from(order.is_le());
        j += usize::from(order.is_ge());
    }
    pairs
}

fn unpaired(partners: &[Option<u32>]) -> usize {
    partners.iter().filter(|partner| partner.is_none()).count()
}

/// The governor list of each keypoint, from its smallest number on.
fn lists(axis: &MedialAxis, sites: &[u32]) -> Vec<Vec<u32>> {
    let list = |keypoint: u32| {
        let governors = axis.governors(keypoint).iter();
        let mut list: Vec<u32> = governors.map(|&g| sites[g as usize]).collect();
        let least = (0..list.len()).min_by_key(|&k| list[k]).unwrap_or(0);
        list.rotate_left(least);
        list
    };
    (0..axis.keypoints().len() as u32).map(list).collect()
}

/// Ends and governors of each path, from the end that gives the smaller numbers.
fn lines(axis: &MedialAxis, sites: &[u32], lists: &[u32]) -> Vec<[u32; 4]> {
    let line = |path: crate::axis::Path| {
        let [from, to] = [path.from, path.to].map(|k| lists[k as usize]);
        let [left, right] = [path.left, path.right].map(|g| sites[g as usize]);
        [from, to, left, right].min([to, from, right, left])
    };
    axis.paths().iter().map(line).collect()
}

/// Inner points of each path whose distance is measured.
///
/// A matter of time only: more of them would find a difference between sampled curves more closely.
const INNER: [f64; 3] = [0.25, 0.5, 0.75];

/// Largest distance of a point of an axis from another one, given the partners of its keypoints and
/// paths there.
fn distance(
    axis: &MedialAxis,
    other: &MedialAxis,
    keypoints: &[Option<u32>],
    paths: &[Option<u32>],
) -> f64 {
    let mut nearest = Nearest { axis: other, curves: None, last: 0 };
    let mut worst = 0.0;
    let mut measure = |p: Point, known: f64| {
        if known.is_nan() || known > worst {
            worst = larger(worst, nearest.distance(p, known));
        }
    };
    for (keypoint, partner) in axis.keypoints().iter().zip(keypoints) {
        let far = |k: u32| (other.keypoints().at(k).position - keypoint.position).norm();
        measure(keypoint.position, partner.map_or(f64::INFINITY, far));
    }
    for (path, partner) in axis.paths().iter().zip(paths) {
        let curve = axis.curve(&path);
        let partner = partner.map(|p| other.curve(&other.paths().at(p)));
        let ends = |curve: &Curve| (curve.from(), curve.to());
        let is_same = |partner: Curve| {
            let (from, to) = ends(&partner);
            [(from, to), (to, from)].contains(&ends(&curve))
        };
        // Governors and ends tell the whole curve.
        if partner.is_some_and(is_same) {
            continue;
        }
        for p in INNER.map(|u| curve.point_at(u)) {
            measure(p, partner.map_or(f64::INFINITY, |partner| partner.distance(p)));
        }
    }
    worst
}

/// Finds how far points are from an axis.
struct Nearest<'a> {
    axis: &'a MedialAxis,
    /// Made when first asked for.
    curves: Option<(Vec<Curve>, BoundsTree)>,
    /// The curve that was nearest to the last point, which is likely to be near the next one.
    last: usize,
}

impl Nearest<'_> {
    /// The distance of a point, which is known to be at most this.
    fn distance(&mut self, point: Point, known: f64) -> f64 {
        let (curves, tree) = self.curves.get_or_insert_with(|| packed(self.axis));
        let near = curves.get(self.last).map_or(f64::INFINITY, |curve| curve.distance(point));
        let mut search = Search { point, curves, least: known.min(near), nearest: self.last };
        tree.visit(&mut search);
        self.last = search.nearest;
        search.least
    }
}

/// The curves of an axis along a space-filling curve, and the tree of their boxes.
fn packed(axis: &MedialAxis) -> (Vec<Curve>, BoundsTree) {
    let mut curves: Vec<Curve> = axis.paths().iter().map(|path| axis.curve(&path)).collect();
    // What is left of a pruned axis may be a keypoint without a path.
    for (keypoint, degree) in axis.keypoints().iter().zip(axis.degrees()) {
        if degree == 0 {
            let Keypoint { position, radius, .. } = keypoint;
            let site = Site::edge(position, position);
            curves.push(Curve::new(&site, &site, (position, radius), (position, radius)));
        }
    }
    let bounds = |curve: &Curve| {
        let ends = Rect::EMPTY.with(curve.from()).with(curve.to());
        curve.control().map_or(ends, |control| ends.with(control))
    };
    let all = curves.iter().fold(Rect::EMPTY, |all, curve| all.union(bounds(curve)));
    curves.sort_by_cached_key(|curve| hilbert(&all, (curve.from() + curve.to()) * 0.5));
    let tree = BoundsTree::new(0, curves.len() as u32, |k| bounds(&curves[k as usize]));
    (curves, tree)
}

/// A search for the nearest curve.
struct Search<'a> {
    point: Point,
    curves: &'a [Curve],
    least: f64,
    nearest: usize,
}

impl Visitor for Search<'_> {
    fn enters(&self, bounds: &Rect, _: Range<u32>) -> bool {
        bounds.distance2(self.point) < self.least * self.least
    }

    fn item(&mut self, item: u32) {
        let far = self.curves[item as usize].distance(self.point);
        if far < self.least {
            (self.least, self.nearest) = (far, item as usize);
        }
    }
}
