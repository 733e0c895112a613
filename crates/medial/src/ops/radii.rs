//! Exact questions about the radii of a complete axis: against a length, and where they grow.
//!
//! # Method
//! Doubles answer unless they are near a tie; then predicates on three governors of a keypoint do, or on the
//! two governors of a path.

use std::cmp::Ordering;

use super::ground::Ground;
use super::hierarchy::{HierarchyError, grounded};
use crate::axis::{Curve, MedialAxis, Path};
use crate::domain::{Corner, Domain, Site};
use crate::geom::predicates::{Element, ExactDisk, compare_gap};
use crate::geom::{Point, cross_directions};

/// How far, as a share, a radius in doubles may be from the true one at most.
///
/// Within this nothing is decided by it.
const DOUBT: f64 = 1e-12;

/// How near to the line through two corners, or to the foot of one, as a share of the coordinates, a keypoint
/// in doubles is not trusted to be on the side where it seems to be.
const MIDDLE: f64 = 1e-12;

/// The radii of an axis.
pub(super) struct Radii<'a> {
    axis: &'a MedialAxis,
    ground: Ground<'a>,
    /// The element behind each site.
    governors: Vec<Site>,
    /// The least radius along each path.
    least: Vec<f64>,
}

impl<'a> Radii<'a> {
    /// Those of an axis of a domain.
    ///
    /// # Errors
    /// If the axis is not exact, or pruned, or not of this domain.
    pub fn new(domain: &'a Domain, axis: &'a MedialAxis) -> Result<Self, HierarchyError> {
        let (ground, governors) = grounded(domain, axis)?;
        let least = axis.paths().iter().map(|path| axis.curve(&path).radius_min()).collect();
        Ok(Self { axis, ground, governors, least })
    }

    pub fn ground(&self) -> &Ground<'a> {
        &self.ground
    }

    /// The domain of the side of the axis.
    pub fn domain(&self) -> &Domain {
        self.ground.domain()
    }

    pub fn governor(&self, site: u32) -> Site {
        self.governors[site as usize]
    }

    /// The element that follows along the boundary.
    pub fn after(&self, element: Site) -> Site {
        if !element.is_edge() {
            return Site::edge(element.index());
        }
        let next = self.domain().edge(element.index()).next;
        if self.ground.has_cell(Site::corner(next)) { Site::corner(next) } else { Site::edge(next) }
    }

    /// An element as predicates see it.
    pub fn element(&self, element: Site) -> Element {
        self.domain().element(element)
    }

    /// The governors of a path as predicates see them.
    pub fn elements(&self, path: &Path) -> [Element; 2] {
        [path.left, path.right].map(|site| self.element(self.governor(site)))
    }

    /// The least radius along a path, rounded.
    pub fn least(&self, path: u32) -> f64 {
        self.least[path as usize]
    }

    /// The disk of a keypoint; `None` for one that no three elements govern.
    fn disk(&self, keypoint: u32) -> Option<ExactDisk> {
        /// Threes that are tried; nearly always the first one is a disk.
        const TRIED: usize = 64;
        let list = self.axis.governors(keypoint);
        let mut elements: Vec<Element> =
            list.iter().map(|&g| self.element(self.governor(g))).collect();
        // Where a straight joint governs, its edges are on one line.
        for k in (0..list.len()).rev() {
            let [one, next] = [k, (k + 1) % list.len()].map(|k| self.governor(list[k]));
            if let (true, Element::Edge(start, _)) = (one.is_edge(), self.element(next))
                && self.after(one) == next
                && self.domain().edge(next.index()).corner == Corner::Straight
            {
                elements.insert(k + 1, Element::Corner(start));
            }
        }
        let n = elements.len();
        let threes = (0..n)
            .flat_map(|i| (i + 1..n).flat_map(move |j| (j + 1..n).map(move |k| [i, j, k])))
            .take(TRIED);
        threes.map(|three| three.map(|k| elements[k])).find_map(ExactDisk::new)
    }

    /// The order of the radius of a keypoint against a length.
    pub fn compare(&self, keypoint: u32, length: f64) -> Ordering {
        let radius = self.axis.keypoints().at(keypoint).radius;
        let rounded = || radius.partial_cmp(&length).unwrap_or(Ordering::Equal);
        if (radius - length).abs() > DOUBT * radius || radius == 0.0 {
            return rounded();
        }
        self.disk(keypoint).map_or_else(rounded, |disk| disk.compare_radius(length))
    }

    /// The order of the radii of two keypoints.
    pub fn compare_two(&self, one: u32, other: u32) -> Ordering {
        let [a, b] = [one, other].map(|k| self.axis.keypoints().at(k).radius);
        let rounded = || a.partial_cmp(&b).unwrap_or(Ordering::Equal);
        if (a - b).abs() > DOUBT * a.max(b) || one == other || a == 0.0 || b == 0.0 {
            return rounded();
        }
        match (self.disk(one), self.disk(other)) {
            (Some(one), Some(other)) => one.compare_radii(&other),
            _ => rounded(),
        }
    }

    /// Whether the place where its governors are nearest to each other lies inside a path: where a parabola
    /// passes the foot of its focus, or a line between two corners that between them.
    pub fn has_neck(&self, path: &Path) -> bool {
        let sides = [self.past(path, path.from), self.past(path, path.to)];
        sides[0] != Ordering::Equal && sides[0] == sides[1].reverse()
    }

    /// On which side of the neck of the whole bisector of a path one of its ends is; equal for two edges.
    fn past(&self, path: &Path, keypoint: u32) -> Ordering {
        let at = self.axis.keypoints().at(keypoint).position;
        let (a, b, p, is_corners) = match self.elements(path) {
            [Element::Corner(p), Element::Corner(q)] => (p, q, p, true),
            [Element::Corner(p), Element::Edge(a, b)]
            | [Element::Edge(a, b), Element::Corner(p)] => (a, b, p, false),
            [Element::Edge(..), Element::Edge(..)] => return Ordering::Equal,
        };
        let way = if is_corners { (b - a).perp() } else { b - a };
        let product = way.dot(at - p);
        let size = at.x.abs() + at.y.abs() + p.x.abs() + p.y.abs();
        let rounded = product.partial_cmp(&0.0).unwrap_or(Ordering::Equal);
        if product.abs() > MIDDLE * size * way.norm() {
            return rounded;
        }
        match self.disk(keypoint) {
            Some(disk) if is_corners => disk.front(a, b),
            Some(disk) => disk.along(a, b, p),
            None => rounded,
        }
    }

    /// Whether the radius is the same all along a path: between two parallel edges.
    pub fn is_level(&self, path: &Path) -> bool {
        match self.elements(path) {
            [Element::Edge(a, b), Element::Edge(c, d)] => cross_directions(a, b, c, d) == 0.0,
            _ => false,
        }
    }

    /// Whether the radius grows from the start of a path on, if it is not level.
    pub fn rises(&self, path: &Path) -> bool {
        let [from, to] = [self.past(path, path.from), self.past(path, path.to)];
        match (from, to) {
            // Two edges, or both ends on one side of the neck: all along in one direction.
            _ if from == to => self.compare_two(path.from, path.to).is_lt(),
            (Ordering::Equal, _) => true,
            _ => false,
        }
    }
}

/// A distance, and what of an axis is farther from the boundary.
pub(super) struct Limit<'r, 'a> {
    radii: &'r Radii<'a>,
    distance: f64,
    /// Whether what is just as far is taken to be farther.
    at_least: bool,
    /// The order of the radius of each keypoint against the distance.
    orders: Vec<Ordering>,
}

impl<'r, 'a> Limit<'r, 'a> {
    /// What is farther than a distance.
    pub fn more_than(radii: &'r Radii<'a>, distance: f64) -> Self {
        Self::new(radii, distance, false)
    }

    /// What is at least as far.
    pub fn at_least(radii: &'r Radii<'a>, distance: f64) -> Self {
        Self::new(radii, distance, true)
    }

    fn new(radii: &'r Radii<'a>, distance: f64, at_least: bool) -> Self {
        let n = radii.axis.keypoints().len() as u32;
        let orders = (0..n).map(|k| radii.compare(k, distance)).collect();
        Self { radii, distance, at_least, orders }
    }

    fn is_over(&self, order: Ordering) -> bool {
        order.is_gt() || self.at_least && order.is_eq()
    }

    pub fn distance(&self) -> f64 {
        self.distance
    }

    /// Whether a keypoint is farther.
    pub fn is_farther(&self, keypoint: u32) -> bool {
        self.is_over(self.orders[keypoint as usize])
    }

    /// Whether the radius is just the distance at the start of a path, and grows from there.
    pub fn is_left_upwards(&self, path: &Path) -> bool {
        self.orders[path.from as usize].is_eq()
            && !self.radii.is_level(path)
            && self.radii.rises(path)
    }

    /// Whether all of a path is farther.
    pub fn is_whole(&self, number: u32) -> bool {
        let path = self.radii.axis.paths().at(number);
        if !self.is_farther(path.from) || !self.is_farther(path.to) {
            return false;
        }
        if self.radii.least(number) > self.distance * (1.0 + DOUBT) {
            return true;
        }
        let elements = self.radii.elements(&path);
        if let [Element::Edge(..), Element::Edge(..)] = elements {
            return true;
        }
        // Twice a double is one.
        self.is_over(compare_gap(elements[0], elements[1], 2.0 * self.distance))
            || !self.radii.has_neck(&path)
    }

    /// Where a path, in the direction given, comes down to the distance first: a parameter and the point
    /// there. None if its start is not farther, or all of it is.
    pub fn falls(&self, number: u32, path: &Path) -> Option<(f64, Point)> {
        if !self.is_farther(path.from) || self.is_whole(number) {
            return None;
        }
        let keypoint = |k: u32| self.radii.axis.keypoints().at(k).position;
        if self.orders[path.from as usize].is_eq() {
            return Some((0.0, keypoint(path.from)));
        }
        if self.is_left_upwards(&path.reversed()) {
            return Some((1.0, keypoint(path.to)));
        }
        let curve = self.radii.axis.curve(path);
        let u = falls_to(&curve, self.is_farther(path.to), self.distance);
        Some((u, curve.point_at(u)))
    }

    /// Where a path comes down to the distance first from its start, and from its end.
    fn cuts(&self, number: u32, path: &Path) -> [Option<(f64, Point)>; 2] {
        let back = self.falls(number, &path.reversed());
        [self.falls(number, path), back.map(|(u, point)| (1.0 - u, point))]
    }

    /// What of a part of a path, between two parameters, is not farther; none if all is. Its ends are those
    /// of the part, or the points of [`Limit::falls`] with the distance as radius.
    pub fn rest(&self, number: u32, part: [f64; 2]) -> Option<Curve> {
        if self.is_whole(number) {
            return None;
        }
        let path = self.radii.axis.paths().at(number);
        let curve = self.radii.axis.curve(&path);
        let [from, to] = self.cuts(number, &path);
        let from = from.filter(|cut| cut.0 >= part[0]);
        let to = to.filter(|cut| cut.0 <= part[1]);
        let [first, last] = [from.map_or(part[0], |cut| cut.0), to.map_or(part[1], |cut| cut.0)];
        // From the other end it may be farther all along the part.
        if first > last {
            return None;
        }
        let piece = curve.piece(first, last);
        let end = |cut: Option<(f64, Point)>, end: (Point, f64)| {
            cut.map_or(end, |(_, point)| (point, self.distance))
        };
        let start = end(from, (piece.from(), piece.radius_from()));
        let end = end(to, (piece.to(), piece.radius_to()));
        Some(piece.with_ends(start, end))
    }

    /// Between which parameters a path is not farther; none if all is.
    pub fn within(&self, number: u32) -> Option<[f64; 2]> {
        if self.is_whole(number) {
            return None;
        }
        let [from, to] = self.cuts(number, &self.radii.axis.paths().at(number));
        let [first, last] = [from.map_or(0.0, |cut| cut.0), to.map_or(1.0, |cut| cut.0)];
        Some([first, last.max(first)])
    }
}

/// The parameter at which a curve, from a start that is farther from the boundary than a distance, first comes
/// down to it; it does so on its way to its end, or if that is farther as well, to its neck.
fn falls_to(curve: &Curve, end_is_farther: bool, distance: f64) -> f64 {
    // Rounded, it may reach the distance at an end only.
    let end = curve.neck().filter(|_| end_is_farther).unwrap_or(1.0);
    if curve.radius_from() <= distance {
        return 0.0;
    }
    let off = |u: f64| (curve.radius_at(u) - distance).abs();
    let [first, _] = curve.parameters_at_radius(distance);
    let nearest = if off(0.0) < off(end) { 0.0 } else { end };
    first.filter(|&u| u <= end).unwrap_or(nearest)
}
