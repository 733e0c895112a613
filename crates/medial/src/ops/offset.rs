//! Parallel curves: what is farther from the boundary than a distance, and what is not.
//!
//! # Contract
//! The axis of the interior gives the polygons of the points inside that are farther from the boundary than a
//! distance; that of the exterior the polygons grown by it, holes included. Contours consist of segments
//! and of arcs around reflex corners, as seen from that side, and are always closed. Which keypoints are
//! farther than the distance, and whether a neck is, is decided exactly, once: so contours, their nesting and
//! which of them join are those of the true shape, and only coordinates are rounded. Where two would
//! touch, at a neck of exactly that width, they are kept apart. O(n) for each distance and n elements.
//!
//! # Method
//! 1. Along a path the radius is convex, so what lies above the distance is the whole path, one part at
//!    either end, or nothing. Whether it is the whole is told by the neck.
//! 2. What is above is passed around as the outline of an axis is: with the boundary to the right. The
//!    governor there gives a piece of the contour: an edge a parallel segment, a corner an arc.
//! 3. A piece ends where the path comes down to the distance, on the axis itself; or over a corner, where
//!    its governor leaves the one element for the next.
//! 4. Outside, contours go on around infinity, clockwise, along the elements between the path that leads
//!    there and the next one.
//! 5. Grown polygons are one where an element of each governs a path that is not above everywhere.

use std::cmp::Ordering;
use std::collections::HashMap;

use super::ground::Ground;
use super::hierarchy::HierarchyError;
use super::outline::{Contour, Outline, OutlineError, OutlinePiece, OutlinePolygon, Sense, Turns};
use super::radii::{Limit, Radii};
use crate::axis::{KeypointKind, MedialAxis, Side};
use crate::domain::{Complement, Domain, Site};
use crate::geom::predicates::Element;
use crate::geom::{DisjointSets, Point, orient2d};

/// Why there is no offset.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OffsetError {
    /// Distances are not negative, finite, and zero or of a usual size.
    #[error("{distance} is no distance of an offset; give one from 0 on, of a usual size")]
    Distance {
        /// What was given.
        distance: f64,
    },
    /// The exterior axis is cut off too near to the polygons.
    #[error("the exterior axis is cut off at {margin}, before the distance {distance}")]
    Frame {
        /// The distance that was asked for.
        distance: f64,
        /// How far from the boundary the axis is cut off.
        margin: f64,
    },
    /// The axis is pruned, sampled or of another domain.
    #[error(transparent)]
    Axis(#[from] HierarchyError),
    /// Its graph is not that of an axis.
    #[error(transparent)]
    Outline(#[from] OutlineError),
}

/// The least and the largest distance but zero: as for coordinates.
const DISTANCES: [f64; 2] =
    [f64::from_bits((1023 - 200) << 52), f64::from_bits((1023 + 200) << 52)];

/// The least angle of an arc that cannot be: around a corner it is less than a half turn, so this one is
/// nothing, the wrong way round.
const TOO_WIDE: f64 = 3.5;

/// The parallel curves of the polygons at some distances, on the side of an axis: inside the polygons
/// of all points that are farther from the boundary, outside those of all that are not.
///
/// Contours begin at their least point by x, then y; polygons, and the holes of each, are in the order of
/// these.
///
/// ```
/// use medial::axis::Engine;
/// use medial::domain::{Domain, Options};
/// use medial::engine::{exterior, path_tracing};
/// use medial::geom::Point;
/// use medial::ops::{offset_margin, offsets};
/// use std::f64::consts::PI;
///
/// let ring = [(0., 0.), (6., 0.), (6., 2.), (0., 2.)].map(|(x, y)| Point::new(x, y));
/// let domain = Domain::from_polygons(&[vec![ring.to_vec()]], &Options::default())?;
/// let inward = offsets(&domain, &path_tracing(&domain)?, &[0.5, 1.0])?;
/// assert_eq!((inward[0].area(), inward[1].area()), (5.0, 0.0));
/// let margin = offset_margin(&domain, 1.0);
/// let outside = exterior(&domain, Engine::PathTracing, Some(margin), &Default::default())?;
/// let outward = offsets(&domain, &outside, &[1.0])?;
/// assert!((outward[0].area() - (12.0 + 16.0 + PI)).abs() < 1e-13);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If a distance is negative or not of a usual size; if the axis is not complete and exact, or not of this
/// domain; or if it is that of the exterior and cut off before the largest distance.
pub fn offsets(
    domain: &Domain,
    axis: &MedialAxis,
    distances: &[f64],
) -> Result<Vec<Outline>, OffsetError> {
    let usual = |d: f64| d == 0.0 || (DISTANCES[0]..=DISTANCES[1]).contains(&d);
    if let Some(&distance) = distances.iter().find(|&&d| !usual(d)) {
        return Err(OffsetError::Distance { distance });
    }
    let shape = Shape::new(domain, axis)?;
    if let Some(&distance) = distances.iter().find(|&&d| d >= shape.margin) {
        return Err(OffsetError::Frame { distance, margin: shape.margin });
    }
    let offset = |&distance: &f64| Level::new(&shape, distance).outline();
    distances.iter().map(offset).collect()
}

/// A margin with which an exterior axis serves for offsets up to a distance: how far from the box of the
/// polygons it has to be cut off.
#[must_use]
pub fn offset_margin(domain: &Domain, distance: f64) -> f64 {
    /// As a share of the distance.
    const BEYOND: f64 = 1.5;
    let bounds = domain.bounds();
    let size = bounds.max - bounds.min;
    size.x.max(size.y).max(BEYOND * distance)
}

/// An axis, ready to be cut at any distance.
struct Shape<'a> {
    axis: &'a MedialAxis,
    radii: Radii<'a>,
    turns: Turns<'a>,
    horizon: Horizon,
    /// Outside, the component of the domain of each edge of the ground.
    components: Vec<u32>,
    n_components: usize,
    /// The least radius where paths are cut off; infinite if none is.
    margin: f64,
}

/// What is seen from infinity.
#[derive(Default)]
struct Horizon {
    /// For each keypoint where a path goes to infinity the next path clockwise, as passed from there.
    inwards: HashMap<u32, u32>,
    /// A walk that no path leads to from infinity, if it is the only one.
    convex: Option<u32>,
}

impl<'a> Shape<'a> {
    fn new(domain: &'a Domain, axis: &'a MedialAxis) -> Result<Self, OffsetError> {
        let keypoints = axis.keypoints();
        let radii = Radii::new(domain, axis)?;
        let turns = Turns::new(axis)?;
        let clipped = |k: &u32| keypoints.at(*k).kind == KeypointKind::Clipped;
        let ends: Vec<u32> = (0..keypoints.len() as u32).filter(clipped).collect();
        let margin = ends.iter().map(|&k| keypoints.at(k).radius).fold(f64::INFINITY, f64::min);
        let mut horizon = Horizon::default();
        let order = clockwise(domain, &ends, axis, &turns);
        for (k, &end) in order.iter().enumerate() {
            let next = order[if k + 1 < order.len() { k + 1 } else { 0 }];
            horizon.inwards.extend(turns.leaving(next).next().map(|dart| (end, dart)));
        }
        let mut components = Vec::new();
        if let Ground::Outside(outside) = radii.ground() {
            if ends.is_empty() {
                let edges = outside.horizon().edges;
                horizon.convex = edges.first().map(|&edge| outside.domain().edge(edge).walk);
            }
            components = components_outside(domain, outside);
        }
        let n_components = domain.n_components();
        Ok(Self { axis, radii, turns, horizon, components, n_components, margin })
    }

    /// The component of the domain that an element outside belongs to.
    fn component(&self, element: Site) -> u32 {
        // Where walks meet, a corner is that of the edge at its start; there they are one at any distance.
        self.components[element.index() as usize]
    }
}

/// Keypoints where paths are cut off, all on a rectangle around a domain, in clockwise order.
fn clockwise(domain: &Domain, ends: &[u32], axis: &MedialAxis, turns: &Turns<'_>) -> Vec<u32> {
    let bounds = domain.bounds();
    let centre = bounds.min + (bounds.max - bounds.min) * 0.5;
    let place = |k: u32| axis.keypoints().at(k).position;
    let is_left = |p: Point| p.x < centre.x || (p.x == centre.x && p.y < centre.y);
    let mut order = ends.to_vec();
    order.sort_by(|&j, &k| {
        let (p, q) = (place(j), place(k));
        let turn = orient2d(centre, p, q).partial_cmp(&0.0).unwrap_or(Ordering::Equal);
        is_left(p).cmp(&is_left(q)).then(turn)
    });
    // Where a cell between two of them is too thin for doubles, it says which is the first.
    let right = |k: u32, inwards: bool| {
        let path = turns.leaving(k).next().map(|dart| turns.path(dart));
        path.map(|path| if inwards { path.right } else { path.left })
    };
    for k in 1..order.len() {
        let (one, next) = (order[k - 1], order[k]);
        if place(one) == place(next) && right(next, false) == right(one, true) {
            order.swap(k - 1, k);
        }
    }
    order
}

/// The component of the domain to which each edge of its outside belongs; for those of the frame the first.
fn components_outside(domain: &Domain, outside: &Complement) -> Vec<u32> {
    let component = |edge: u32| {
        let inner = outside.inner_site(Site::edge(edge))?;
        Some(domain.walks()[domain.edge(inner.index()).walk as usize].component)
    };
    (0..outside.domain().edges().len() as u32).map(|edge| component(edge).unwrap_or(0)).collect()
}

/// A shape at a distance.
struct Level<'s, 'a> {
    shape: &'s Shape<'a>,
    limit: Limit<'s, 'a>,
    /// Which paths have been passed from a start that is farther.
    is_passed: Vec<bool>,
}

/// Where a contour leaves an element for another one.
struct Break {
    at: Point,
    after: Site,
}

impl<'s, 'a> Level<'s, 'a> {
    fn new(shape: &'s Shape<'a>, distance: f64) -> Self {
        let is_passed = vec![false; 2 * shape.axis.paths().len()];
        Self { shape, limit: Limit::more_than(&shape.radii, distance), is_passed }
    }

    fn outline(mut self) -> Result<Outline, OffsetError> {
        match self.shape.axis.side {
            Side::Interior => self.inside(),
            Side::Exterior => self.outside(),
        }
    }

    /// What is farther: a polygon for each part of the axis that is connected.
    fn inside(&mut self) -> Result<Outline, OffsetError> {
        let shape = self.shape;
        let n = shape.axis.keypoints().len();
        let mut is_met = vec![false; n];
        let mut polygons = Vec::new();
        for start in 0..n as u32 {
            if !self.limit.is_farther(start) || std::mem::replace(&mut is_met[start as usize], true)
            {
                continue;
            }
            let (mut contours, mut open) = (Vec::new(), vec![start]);
            while let Some(keypoint) = open.pop() {
                for dart in shape.turns.leaving(keypoint) {
                    let to = shape.turns.path(dart).to;
                    if self.limit.is_whole(dart / 2)
                        && !std::mem::replace(&mut is_met[to as usize], true)
                    {
                        open.push(to);
                    }
                    if !self.is_passed[dart as usize] {
                        contours.push(self.contour(dart)?.0);
                    }
                }
            }
            polygons.push(contours);
        }
        Ok(Outline { polygons: in_order(polygons) })
    }

    /// What is not farther than the distance outside.
    fn outside(&mut self) -> Result<Outline, OffsetError> {
        let shape = self.shape;
        let mut joined = DisjointSets::new(shape.n_components);
        for (number, path) in (0..).zip(shape.axis.paths()) {
            let [left, right] = [path.left, path.right].map(|s| shape.radii.governor(s));
            let [left, right] = [left, right].map(|s| shape.component(s));
            if left != right && !self.limit.is_whole(number) {
                joined.join(left, right);
            }
        }
        let mut contours: Vec<Vec<Contour>> = vec![Vec::new(); shape.n_components];
        let mut add = |(contour, of): (Contour, Site)| {
            let component = joined.first(shape.component(of));
            contours[component as usize].push(contour.reversed());
        };
        if let Some(walk) = shape.horizon.convex {
            add(self.around(walk));
        }
        for keypoint in 0..shape.axis.keypoints().len() as u32 {
            if self.limit.is_farther(keypoint) {
                for dart in shape.turns.leaving(keypoint) {
                    if !self.is_passed[dart as usize] {
                        add(self.contour(dart)?);
                    }
                }
            }
        }
        contours.retain(|contours| !contours.is_empty());
        Ok(Outline { polygons: in_order(contours) })
    }

    /// The contour to the right of a path and of what follows, and an element on it.
    fn contour(&mut self, start: u32) -> Result<(Contour, Site), OffsetError> {
        let shape = self.shape;
        let right = |dart: u32| shape.radii.governor(shape.turns.path(dart).right);
        let mut breaks = Vec::new();
        let mut dart = start;
        loop {
            self.is_passed[dart as usize] = true;
            // Down to the distance and back again.
            if let Some((_, at)) = self.limit.falls(dart / 2, &shape.turns.path(dart)) {
                dart ^= 1;
                breaks.push(Break { at, after: right(dart) });
            }
            let to = shape.turns.path(dart).to;
            dart = if shape.axis.keypoints().at(to).kind == KeypointKind::Clipped {
                self.turn_at_infinity(dart, &mut breaks)?
            } else {
                self.turn(dart, &mut breaks)?
            };
            if dart == start {
                return Ok((self.joined(&breaks), right(start)));
            }
        }
    }

    /// What follows a path at its end.
    fn turn(&self, dart: u32, breaks: &mut Vec<Break>) -> Result<u32, OffsetError> {
        let shape = self.shape;
        let next = shape.turns.next(dart);
        let path = shape.turns.path(dart);
        let [before, after] =
            [path, shape.turns.path(next)].map(|path| shape.radii.governor(path.right));
        if before != after && self.pass(before, breaks) != after {
            return Err(disordered(path.to));
        }
        Ok(next)
    }

    /// What comes in from infinity after a path that goes there.
    fn turn_at_infinity(&self, dart: u32, breaks: &mut Vec<Break>) -> Result<u32, OffsetError> {
        let shape = self.shape;
        let out = shape.turns.path(dart);
        let &next = shape.horizon.inwards.get(&out.to).ok_or_else(|| disordered(out.to))?;
        let inwards = shape.turns.path(next);
        let [start, end] = [out, inwards].map(|path| shape.radii.governor(path.right));
        if start == end && self.is_between(start, out.to, inwards.from) {
            return Ok(next);
        }
        let mut element = start;
        loop {
            element = self.pass(element, breaks);
            if element == end {
                return Ok(next);
            }
            if element == start {
                return Err(disordered(out.to));
            }
        }
    }

    /// Whether all between two keypoints far away, the second one after the first clockwise, is nearest to
    /// an element, and not all the rest of the boundary between.
    fn is_between(&self, element: Site, first: u32, second: u32) -> bool {
        let [p, q] = [first, second].map(|k| self.shape.axis.keypoints().at(k).position);
        match self.shape.radii.element(element) {
            Element::Edge(a, b) => (b - a).dot(q - p) >= 0.0,
            Element::Corner(corner) => orient2d(corner, p, q) <= 0.0,
        }
    }

    /// Goes on from an element to the next one along the boundary.
    fn pass(&self, element: Site, breaks: &mut Vec<Break>) -> Site {
        let after = self.shape.radii.after(element);
        let domain = self.shape.radii.domain();
        let edge = domain.edge(if element.is_edge() { element } else { after }.index());
        let corner = domain.edge(after.index()).start;
        breaks.push(Break { at: corner + edge.direction.perp() * self.limit.distance(), after });
        after
    }

    /// The contour around a walk that no path leads to.
    fn around(&self, walk: u32) -> (Contour, Site) {
        let start = Site::edge(self.shape.radii.domain().walks()[walk as usize].first);
        let (mut element, mut breaks) = (start, Vec::new());
        loop {
            element = self.pass(element, &mut breaks);
            if element == start {
                return (self.joined(&breaks), start);
            }
        }
    }

    /// The contour from one break to the next, all around.
    fn joined(&self, breaks: &[Break]) -> Contour {
        let mut pieces: Vec<OutlinePiece> = Vec::with_capacity(2 * breaks.len());
        let mut push = |piece: OutlinePiece| {
            if pieces.last() != Some(&piece) {
                pieces.push(piece);
            }
        };
        let next = breaks.iter().cycle().skip(1);
        for (&Break { at: from, after: site }, &Break { at: to, .. }) in breaks.iter().zip(next) {
            let centre = self.shape.radii.domain().edge(site.index()).start;
            let arc = OutlinePiece::Arc {
                centre,
                radius: self.limit.distance(),
                from,
                to,
                sense: Sense::Clockwise,
            };
            if !site.is_edge() && from != to && arc.sweep().abs() < TOO_WIDE {
                push(arc);
            } else {
                push(OutlinePiece::Corner(from));
                push(OutlinePiece::Corner(to));
            }
        }
        if pieces.len() > 1 && pieces.first() == pieces.last() {
            pieces.pop();
        }
        Contour(pieces)
    }
}

/// Polygons of their contours, whoever made the axis: each contour begins at its least point, the outer one,
/// which has the interior inside, comes first, and all else is in the order of the least points.
fn in_order(contours: impl IntoIterator<Item = Vec<Contour>>) -> Vec<OutlinePolygon> {
    let start = |piece: &OutlinePiece| piece.ends()[0];
    let least = |contour: &Contour| contour.0.first().map(start).unwrap_or_default();
    let polygon = |mut contours: Vec<Contour>| {
        for Contour(pieces) in &mut contours {
            let places = 0..pieces.len();
            let first = places.min_by(|&j, &k| start(&pieces[j]).lexicographic(start(&pieces[k])));
            pieces.rotate_left(first.unwrap_or(0));
        }
        contours.sort_by(|one, other| least(one).lexicographic(least(other)));
        let areas: Vec<f64> = contours.iter().map(Contour::area).collect();
        if let Some(outer) = (0..areas.len()).max_by(|&j, &k| areas[j].total_cmp(&areas[k])) {
            contours[..=outer].rotate_right(1);
        }
        OutlinePolygon(contours)
    };
    let mut polygons: Vec<OutlinePolygon> = contours.into_iter().map(polygon).collect();
    polygons.sort_by(|one, other| least(&one.0[0]).lexicographic(least(&other.0[0])));
    polygons
}

fn disordered(keypoint: u32) -> OffsetError {
    OutlineError::Disordered { keypoint }.into()
}
