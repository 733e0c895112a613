//! The outline of the shape that an axis stands for: the union of all its disks.
//!
//! # Contract
//! A complete axis gives the corners of the polygons themselves, bit for bit, from its graph alone. Where
//! something was pruned, an arc of the last disk that is left takes the place of what it touched beyond.
//! Contours keep the interior on their left: counterclockwise around a component, clockwise around holes.
//!
//! # Method
//! Each path is passed twice, with the boundary to the right and the governors on that side next to it. At
//! a keypoint the next path is that whose governor follows counterclockwise: the order of its governors
//! says which, no angle is computed.
//!
//! # Departures
//! Volkmann and St. Clair [VS87, II.C] approximate the outline by tangents of disks; see `reconstruct.rs`.

use std::f64::consts::TAU;

use crate::axis::{KeypointKind, MedialAxis, Path, Side, SiteKind, SiteShape};
use crate::geom::{Point, orient2d, parted, signed_area};

/// The outline of what an axis stands for.
#[derive(Clone, Debug, PartialEq)]
pub struct Outline {
    /// One for each component of the axis.
    pub polygons: Vec<OutlinePolygon>,
}

/// A part of an outline without a way to the others: the outer contour, then those of the holes.
#[derive(Clone, Debug, PartialEq)]
pub struct OutlinePolygon(pub Vec<Contour>);

/// A closed curve of segments and arcs: corners and ends of arcs are joined in their order, the last one
/// with the first.
#[derive(Clone, Debug, PartialEq)]
pub struct Contour(pub Vec<OutlinePiece>);

/// A piece of a contour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum OutlinePiece {
    /// A corner of the boundary.
    Corner(Point),
    /// An arc of a circle; all of it if it ends where it starts.
    Arc {
        /// Centre of the circle.
        centre: Point,
        /// Radius of the circle.
        radius: f64,
        /// Where it starts.
        from: Point,
        /// Where it ends.
        to: Point,
        /// Which way it runs.
        sense: Sense,
    },
}

/// Which way an arc runs around its centre.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sense {
    /// With the inside of the circle to its left.
    Counterclockwise,
    /// With the inside of the circle to its right.
    Clockwise,
}

impl OutlinePiece {
    /// Where it starts and where it ends.
    #[must_use]
    pub const fn ends(&self) -> [Point; 2] {
        match *self {
            Self::Corner(p) => [p, p],
            Self::Arc { from, to, .. } => [from, to],
        }
    }

    /// The angle that an arc runs through, in radians, positive counterclockwise; 0 for a corner.
    #[must_use]
    pub fn sweep(&self) -> f64 {
        match *self {
            Self::Corner(_) => 0.0,
            Self::Arc { centre, from, to, sense: Sense::Counterclockwise, .. } => {
                sweep(centre, from, to)
            }
            Self::Arc { centre, from, to, sense: Sense::Clockwise, .. } => -sweep(centre, to, from),
        }
    }

    fn reversed(&self) -> Self {
        match *self {
            Self::Corner(_) => *self,
            Self::Arc { centre, radius, from, to, sense } => {
                let sense = match sense {
                    Sense::Counterclockwise => Sense::Clockwise,
                    Sense::Clockwise => Sense::Counterclockwise,
                };
                Self::Arc { centre, radius, from: to, to: from, sense }
            }
        }
    }
}

/// Why an axis gives no outline.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum OutlineError {
    /// The outside of polygons has no outline that is closed.
    #[error("the axis is that of the exterior; only that of the interior has an outline")]
    Exterior,
    /// The order of paths around this keypoint cannot be told.
    #[error("keypoint {keypoint}: the paths are not in the order of the governors")]
    Disordered {
        /// Number of the keypoint.
        keypoint: u32,
    },
}

/// Most points of a flattened arc; only for drawing.
const MAX_POINTS: f64 = 65_536.0;

/// The largest angle of an arc without a point between: rings of two arcs are rings, whatever the tolerance.
const WIDEST: f64 = std::f64::consts::FRAC_PI_3;

/// How near to a full circle an arc may be by rounding where it has no angle at all. Disks from which the
/// axis goes on to smaller ones nearly all around are no maximal disks.
pub(super) const WRAPPED: f64 = 1e-3;

impl Outline {
    /// The outline of an axis of the interior.
    ///
    /// ```
    /// use medial::domain::{Domain, Options};
    /// use medial::engine::path_tracing;
    /// use medial::geom::Point;
    /// use medial::ops::{Hierarchy, Measure, Outline};
    ///
    /// let ring = [(0., 0.), (6., 0.), (6., 2.), (0., 2.)].map(|(x, y)| Point::new(x, y));
    /// let domain = Domain::from_polygons(&[vec![ring.to_vec()]], &Options::default())?;
    /// let axis = path_tracing(&domain)?;
    /// let mut corners = Outline::new(&axis)?.polygons(0.1).concat().concat();
    /// corners.sort_by(|a, b| a.lexicographic(*b));
    /// assert_eq!(corners, [ring[0], ring[3], ring[1], ring[2]]);
    ///
    /// // Without its branches a stadium is left.
    /// let pruned = Hierarchy::new(&domain, &axis)?.pruned(Measure::Angle, 3.0).axis;
    /// let stadium = Outline::new(&pruned)?;
    /// assert!((stadium.area() - (8.0 + std::f64::consts::PI)).abs() < 1e-14);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If the axis is that of the exterior, or its graph is not that of an axis.
    pub fn new(axis: &MedialAxis) -> Result<Self, OutlineError> {
        if axis.side != Side::Interior {
            return Err(OutlineError::Exterior);
        }
        let turns = Turns::new(axis)?;
        let polygon = |Component { keypoint, mut contours }: Component<Contour>| {
            match contours.len() {
                0 => contours.push(circle(axis, keypoint)),
                1 => {}
                // The outer one is that with the interior inside.
                _ => {
                    let outer = contours.iter().position(|contour| contour.area() > 0.0);
                    contours.swap(0, outer.unwrap_or(0));
                }
            }
            OutlinePolygon(contours)
        };
        let components = turns.components(|around| turns.contour(around));
        Ok(Self { polygons: components.into_iter().map(polygon).collect() })
    }

    /// The rings of polygons no farther than a tolerance from it, the outer one first. A contour that
    /// comes back to a point of its own, where rings touch, is several rings.
    #[must_use]
    pub fn polygons(&self, tolerance: f64) -> Vec<Vec<Vec<Point>>> {
        let rings = |polygon: &OutlinePolygon| {
            let contours = polygon.0.iter().map(|contour| contour.ring(tolerance));
            let mut rings: Vec<_> = contours.flat_map(parted).collect();
            rings.sort_by_cached_key(|ring| signed_area(ring) <= 0.0);
            rings
        };
        self.polygons.iter().map(rings).collect()
    }

    /// The area within.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.polygons.iter().flat_map(|polygon| &polygon.0).map(Contour::area).sum()
    }

    /// The length of all contours.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.polygons.iter().flat_map(|polygon| &polygon.0).map(Contour::length).sum()
    }
}

impl Contour {
    /// The ring of a polygon no farther than a tolerance from it, with its corners on it.
    #[must_use]
    pub fn ring(&self, tolerance: f64) -> Vec<Point> {
        let mut ring: Vec<Point> = Vec::new();
        let mut push = |p: Point| {
            if ring.last() != Some(&p) {
                ring.push(p);
            }
        };
        for piece in &self.0 {
            match *piece {
                OutlinePiece::Corner(p) => push(p),
                OutlinePiece::Arc { centre, radius, from, to, .. } => {
                    push(from);
                    let sweep = piece.sweep();
                    // Half the angle of a chord whose sagitta is the tolerance.
                    let half = (1.0 - tolerance / radius).clamp(-1.0, 1.0).acos();
                    let angle = sweep.abs();
                    let n =
                        (angle / (2.0 * half)).max(angle / WIDEST).ceil().clamp(1.0, MAX_POINTS);
                    let start = from - centre;
                    let size = start.norm();
                    // Of a disk that rounding makes a point nothing lies between.
                    let n = if size > 0.0 { n } else { 1.0 };
                    let start = start * (radius / size);
                    for k in 1..n as u32 {
                        let (sin, cos) = (f64::from(k) * sweep / n).sin_cos();
                        push(centre + start * cos + start.perp() * sin);
                    }
                    push(to);
                }
            }
        }
        while ring.len() > 1 && ring.first() == ring.last() {
            ring.pop();
        }
        ring
    }

    /// The area to its left: that within if it runs counterclockwise, the negative one else.
    #[must_use]
    pub fn area(&self) -> f64 {
        let Some(origin) = self.0.first().map(|piece| piece.ends()[0]) else { return 0.0 };
        let chord = |(p, q): (Point, Point)| (p - origin).cross(q - origin);
        let segment = |piece: &OutlinePiece| match *piece {
            OutlinePiece::Corner(_) => 0.0,
            OutlinePiece::Arc { radius, .. } => {
                let sweep = piece.sweep();
                radius * radius * (sweep - sweep.sin())
            }
        };
        0.5 * (self.chords().map(chord).sum::<f64>() + self.0.iter().map(segment).sum::<f64>())
    }

    /// How long it is.
    #[must_use]
    pub fn length(&self) -> f64 {
        let arc = |piece: &OutlinePiece| match *piece {
            OutlinePiece::Corner(_) => 0.0,
            // The chord is counted too.
            OutlinePiece::Arc { radius, from, to, .. } => {
                radius * piece.sweep().abs() - (to - from).norm()
            }
        };
        self.chords().map(|(p, q)| (q - p).norm()).sum::<f64>()
            + self.0.iter().map(arc).sum::<f64>()
    }

    /// Segments from each end of a piece to the next end.
    fn chords(&self) -> impl Iterator<Item = (Point, Point)> {
        let points = || self.0.iter().flat_map(OutlinePiece::ends);
        let next = points().skip(1).chain(points().take(1));
        points().zip(next)
    }

    /// The same curve the other way round.
    pub(super) fn reversed(&self) -> Self {
        Self(self.0.iter().rev().map(OutlinePiece::reversed).collect())
    }
}

/// The angle of an arc, counterclockwise.
fn sweep(centre: Point, from: Point, to: Point) -> f64 {
    let (u, v) = (from - centre, to - centre);
    let angle = u.cross(v).atan2(u.dot(v));
    if from == to {
        TAU
    } else if angle < 0.0 {
        angle + TAU
    } else {
        angle
    }
}

/// The disk of a component without paths.
fn circle(axis: &MedialAxis, keypoint: u32) -> Contour {
    let disk = axis.keypoints().at(keypoint);
    let from = disk.position + Point::new(disk.radius, 0.0);
    let (centre, radius) = (disk.position, disk.radius);
    let sense = Sense::Counterclockwise;
    Contour(vec![OutlinePiece::Arc { centre, radius, from, to: from, sense }])
}

/// A part of an axis that is connected.
pub(super) struct Component<C> {
    /// One of its keypoints.
    pub keypoint: u32,
    /// Its contours; none if it is a point.
    pub contours: Vec<C>,
}

/// Ways around the keypoints. Path `k` is passed from its start as number `2k`, from its end as `2k + 1`.
pub(super) struct Turns<'a> {
    axis: &'a MedialAxis,
    /// For each governor of each keypoint what leaves that with it on the right, or [`EMPTY`].
    places: Vec<u32>,
    /// What follows each along the boundary on the right, and the governor that it has there.
    darts: Vec<Dart>,
}

/// A path as it is passed.
#[derive(Clone, Copy)]
struct Dart {
    next: u32,
    right: u32,
}

/// Nothing leaves.
const EMPTY: u32 = u32::MAX;

impl<'a> Turns<'a> {
    pub fn new(axis: &'a MedialAxis) -> Result<Self, OutlineError> {
        let mut places = vec![EMPTY; axis.n_places()];
        let mut darts = Vec::with_capacity(2 * axis.paths().len());
        let mut disordered: Option<u32> = None;
        for (k, path) in (0..).zip(axis.paths()) {
            let Path { from, to, left, right } = path;
            for (dart, keypoint, right) in [(2 * k, from, right), (2 * k + 1, to, left)] {
                match axis.place_of(keypoint, right).map(|place| &mut places[place]) {
                    Some(place) if *place == EMPTY => *place = dart,
                    _ => disordered = Some(disordered.unwrap_or(keypoint).min(keypoint)),
                }
                darts.push(Dart { next: EMPTY, right });
            }
        }
        if let Some(keypoint) = disordered {
            return Err(OutlineError::Disordered { keypoint });
        }
        for keypoint in 0..axis.keypoints().len() as u32 {
            // What comes by one of them goes on by that after it.
            let around = &places[axis.places(keypoint)];
            let Some(&last) = around.iter().rev().find(|dart| **dart != EMPTY) else { continue };
            let mut before = last;
            for &dart in around {
                if dart != EMPTY {
                    darts[before as usize ^ 1].next = dart;
                    before = dart;
                }
            }
        }
        Ok(Self { axis, places, darts })
    }

    /// What leaves a keypoint, counterclockwise.
    pub fn leaving(&self, keypoint: u32) -> impl DoubleEndedIterator<Item = u32> {
        let around = &self.places[self.axis.places(keypoint)];
        around.iter().copied().filter(|dart| *dart != EMPTY)
    }

    /// The path as it is passed.
    #[inline]
    pub fn path(&self, dart: u32) -> Path {
        let path = self.axis.paths().at(dart / 2);
        if dart.is_multiple_of(2) { path } else { path.reversed() }
    }

    /// The keypoint to which it leads.
    #[inline]
    fn end(&self, dart: u32) -> u32 {
        self.axis.paths().ends(dart / 2)[usize::from(dart.is_multiple_of(2))]
    }

    /// What follows along the boundary on the right.
    #[inline]
    pub fn next(&self, dart: u32) -> u32 {
        self.darts[dart as usize].next
    }

    /// The components with their contours, each made of all that is passed with it on the right.
    pub fn components<C>(&self, contour: impl Fn(&mut Around<'_>) -> C) -> Vec<Component<C>> {
        let n = self.axis.keypoints().len();
        let mut is_met = vec![false; n];
        let mut is_passed = vec![false; self.darts.len()];
        let mut left = self.darts.len();
        let mut open = Vec::new();
        let mut components = Vec::new();
        for start in 0..n as u32 {
            // Where all has been passed only keypoints without paths are left.
            let is_done = left == 0 && self.leaving(start).next().is_some();
            if is_done || std::mem::replace(&mut is_met[start as usize], true) {
                continue;
            }
            let mut component = Component { keypoint: start, contours: Vec::new() };
            open.push(start);
            while let Some(keypoint) = open.pop() {
                for dart in self.leaving(keypoint) {
                    if !std::mem::replace(&mut is_met[self.end(dart) as usize], true) {
                        open.push(self.end(dart));
                    }
                    if !is_passed[dart as usize] {
                        let darts = &self.darts;
                        let mut around =
                            Around { darts, is_passed: &mut is_passed, next: dart, left };
                        component.contours.push(contour(&mut around));
                        around.by_ref().for_each(drop);
                        left = around.left;
                    }
                }
                if left == 0 {
                    open.clear();
                }
            }
            components.push(component);
        }
        components
    }

    /// The contour to the right of all these.
    fn contour(&self, around: &mut Around<'_>) -> Contour {
        /// Paths passed for each corner, about.
        const PASSED: usize = 3;
        // The first contour may be all there is; of many each is short.
        let is_first = around.left == self.darts.len();
        let mut pieces = Vec::with_capacity(if is_first { around.left / PASSED } else { 16 });
        let right = |dart: u32| self.darts[dart as usize].right;
        let Some(first) = around.next() else { return Contour(pieces) };
        let mut before = (right(first), self.axis.site_shape(right(first)));
        let mut came_by = first;
        loop {
            let next = around.next();
            let dart = next.unwrap_or(first);
            let is_end = dart == came_by ^ 1;
            if right(dart) != before.0 || is_end {
                let after = (right(dart), self.axis.site_shape(right(dart)));
                if before.1.kind == SiteKind::Vertex {
                    push(&mut pieces, OutlinePiece::Corner(before.1.a));
                }
                self.turn(&mut pieces, came_by, &before, &after);
                before = after;
            } else if next.is_none() && before.1.kind == SiteKind::Vertex {
                // It goes on at the start.
                push(&mut pieces, OutlinePiece::Corner(before.1.a));
            }
            came_by = dart;
            if next.is_none() {
                break;
            }
        }
        if pieces.len() > 1 && pieces.first() == pieces.last() {
            pieces.pop();
        }
        pieces.shrink_to_fit();
        Contour(pieces)
    }

    /// Adds what lies between two sites, at the keypoint to which a path leads.
    #[inline]
    fn turn(
        &self,
        pieces: &mut Vec<OutlinePiece>,
        came_by: u32,
        before: &(u32, SiteShape),
        after: &(u32, SiteShape),
    ) {
        let keypoint = self.end(came_by);
        let disk = self.axis.keypoints().at(keypoint);
        if disk.kind == KeypointKind::End {
            push(pieces, OutlinePiece::Corner(disk.position));
        } else if before.0 != after.0 && !meet(&before.1, &after.1) {
            let (centre, radius) = (disk.position, disk.radius);
            let [from, to] = [before, after].map(|(_, site)| foot_on(site.a, site.b, centre));
            let closes = self.leaving(keypoint).nth(1).is_none()
                && self.axis.curve(&self.path(came_by)).growth_at(1.0) > 0.0;
            if TAU - sweep(centre, from, to) < WRAPPED && !closes {
                // An arc of nothing, for a corner that is nearly straight.
                push(pieces, OutlinePiece::Corner(from));
            } else {
                let sense = Sense::Counterclockwise;
                push(pieces, OutlinePiece::Arc { centre, radius, from, to, sense });
            }
        }
    }
}

/// What is passed with the same contour on the right, from a path on.
pub(super) struct Around<'t> {
    darts: &'t [Dart],
    is_passed: &'t mut [bool],
    next: u32,
    /// How much has not been passed yet, of all.
    left: usize,
}

impl Iterator for Around<'_> {
    type Item = u32;

    #[inline]
    fn next(&mut self) -> Option<u32> {
        let dart = self.next;
        if std::mem::replace(&mut self.is_passed[dart as usize], true) {
            return None;
        }
        self.left -= 1;
        self.next = self.darts[dart as usize].next;
        Some(dart)
    }
}

/// Adds a piece; a corner that governs several paths in a row counts once.
fn push(pieces: &mut Vec<OutlinePiece>, piece: OutlinePiece) {
    if pieces.last() != Some(&piece) {
        pieces.push(piece);
    }
}

/// Whether two sites that follow one another along the boundary have one footpoint: a corner and one of its
/// edges, or two pieces of an edge.
fn meet(before: &SiteShape, after: &SiteShape) -> bool {
    match (before.kind, after.kind) {
        (SiteKind::Vertex, SiteKind::Edge) => after.a == before.a,
        (SiteKind::Edge, SiteKind::Vertex) => before.b == after.a,
        (SiteKind::Edge, SiteKind::Edge) => {
            before.b == after.a
                && orient2d(before.a, before.b, after.b) == 0.0
                && along(before).dot(along(after)) > 0.0
        }
        (SiteKind::Vertex, SiteKind::Vertex) => before.a == after.a,
    }
}

fn along(edge: &SiteShape) -> Point {
    edge.b - edge.a
}

/// The point of a segment that is nearest to a point.
pub(super) fn foot_on(a: Point, b: Point, p: Point) -> Point {
    let along = b - a;
    let length2 = along.norm2();
    if length2 == 0.0 {
        return a;
    }
    let share = along.dot(p - a) / length2;
    if share <= 0.0 {
        a
    } else if share >= 1.0 {
        b
    } else {
        a + along * share
    }
}
