//! The branches of an axis and the primitives they consist of, after Blum and Nagel [BN78].
//!
//! # Contract
//! A point of the axis is an end, a normal point or a branch point: its disk touches the boundary in one
//! place, in two, or in more. That is its degree. Branches are the ways through normal points, each in one
//! direction; a component without any other point is one closed branch. A branch is cut where its primitive
//! changes, which in an exact axis is decided by the governors and never by a radius that was computed.
//!
//! # Method
//! What the radius does along a path depends on its governors only: between parallel edges it stays (worm),
//! between other edges it grows or shrinks at one rate (wedge), with a corner the rate itself grows
//! (flare), and changes its sign at the neck. An axis of polygons has no cups.
//!
//! Governors of a sampled axis are as rough as its cells, so there the radii decide: a wedge is as long as they do
//! not turn back, level steps in between included, and other level steps are worms.
//!
//! # Departures
//! The paper allows axes of any curvature. Those of polygons are straight, or spirals: a parabola bends
//! most at its apex. Circular axes do not occur.

use std::fmt;

use super::groups::Incidence;
use super::outline::foot_on;
use crate::axis::{Accuracy, Curve, MedialAxis, Path, SiteKind, SiteShape, names};
use crate::geom::{Point, cross_directions};

/// What the radius does along a piece of a branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Primitive {
    /// It stays.
    Worm,
    /// It changes at one rate.
    Wedge,
    /// Its rate falls.
    Cup,
    /// Its rate grows.
    Flare,
}

names!(
    Primitive, "primitive",
    Worm => "worm", Wedge => "wedge", Cup => "cup", Flare => "flare",
);

/// Whether the radius grows along a piece of a branch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Trend {
    /// It grows.
    Opening,
    /// It shrinks.
    Closing,
}

names!(Trend, "trend", Opening => "opening", Closing => "closing");

/// How a piece of a branch bends, in its direction.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Bend {
    /// Not at all.
    Straight,
    /// To the left, the same all along.
    LeftCircular,
    /// To the right, the same all along.
    RightCircular,
    /// To the left, more and more.
    SpiralInLeft,
    /// To the right, more and more.
    SpiralInRight,
    /// To the left, less and less.
    SpiralOutLeft,
    /// To the right, less and less.
    SpiralOutRight,
}

names!(
    Bend, "bend",
    Straight => "straight", LeftCircular => "left_circular", RightCircular => "right_circular",
    SpiralInLeft => "spiral_in_left", SpiralInRight => "spiral_in_right",
    SpiralOutLeft => "spiral_out_left", SpiralOutRight => "spiral_out_right",
);

/// The branches of an axis, what is said of each in a few tables.
#[derive(Clone)]
pub struct Branches<'a> {
    axis: &'a MedialAxis,
    is_sampled: bool,
    /// The paths along all branches: path `k` in its own direction as `2k`, against it as `2k + 1`.
    passed: Vec<u32>,
    pieces: Vec<PieceRecord>,
    records: Vec<BranchRecord>,
}

#[derive(Clone, Copy)]
struct BranchRecord {
    /// Where it starts in the other tables.
    passed: u32,
    pieces: u32,
    is_closed: bool,
    extent: Extent,
    /// The lengths of the boundary to its left and to its right.
    boundary: [f64; 2],
}

#[derive(Clone, Copy)]
struct PieceRecord {
    kind: Kind,
    extent: Extent,
    /// The paths passed, the first and the last one, and whether it starts, or ends, at their necks.
    passed: [u32; 2],
    at_neck: [bool; 2],
}

type Kind = (Primitive, Option<Trend>, Bend);

const WORM: Kind = (Primitive::Worm, None, Bend::Straight);

/// A way through an axis between two points that are no normal points, or around a cycle of normal points.
#[derive(Clone, Copy)]
pub struct Branch<'a> {
    all: &'a Branches<'a>,
    number: usize,
}

/// A piece of a branch with one primitive.
#[derive(Clone, Copy)]
pub struct BranchPiece<'a> {
    axis: &'a MedialAxis,
    passed: &'a [u32],
    record: &'a PieceRecord,
}

/// Lengths, areas and radii of a part of an axis, in units of the input.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Length along the axis.
    pub length: f64,
    /// Area of the shape nearest to it: all points that are on a line from the axis to a footpoint.
    pub area: f64,
    /// The radius where it starts.
    pub radius_start: f64,
    /// The radius where it ends.
    pub radius_end: f64,
    /// The least radius.
    pub radius_min: f64,
    /// The greatest radius.
    pub radius_max: f64,
    /// The mean radius along the length.
    pub radius_mean: f64,
}

/// The boundary on one side of a branch.
#[derive(Clone, Debug, PartialEq)]
pub struct BoundaryPiece {
    /// Its points: the first footpoint, corners, the last footpoint.
    pub points: Vec<Point>,
    /// The sites along it, as numbers of the axis.
    pub sites: Vec<u32>,
    /// Its length, in units of the input.
    pub length: f64,
}

/// The branches of an axis: each path is in just one of them.
///
/// Those with a free end come first and start there, closed ones come last. Of an axis that was pruned a
/// boundary goes straight past what was removed. Takes O(n) for n paths.
///
/// ```
/// use medial::domain::{Domain, Options};
/// use medial::engine::path_tracing;
/// use medial::geom::Point;
/// use medial::ops::{Primitive, branches};
///
/// let ring = [(0., 0.), (6., 0.), (6., 2.), (0., 2.)].map(|(x, y)| Point::new(x, y));
/// let domain = Domain::from_polygons(&[vec![ring.to_vec()]], &Options::default())?;
/// let axis = path_tracing(&domain)?;
/// let branches = branches(&axis);
/// // Four corners and the spine.
/// assert_eq!(branches.len(), 5);
/// let is_worm = |primitive| primitive == Primitive::Worm;
/// let spine = branches.iter().find(|b| b.pieces().all(|piece| is_worm(piece.primitive()))).unwrap();
/// assert_eq!((spine.extent().length, spine.extent().area), (4.0, 8.0));
/// assert_eq!(spine.boundary_lengths(), [4.0, 4.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn branches(axis: &MedialAxis) -> Branches<'_> {
    let around = Incidence::new(axis);
    let n_paths = axis.paths().len();
    let n = axis.keypoints().len() as u32;
    // Each branch but closed ones has two ends.
    let n_ends: usize = (0..n).map(|k| around.degree(k)).filter(|&degree| degree != 2).sum();
    let mut branches = Branches {
        axis,
        is_sampled: axis.accuracy != Accuracy::Exact,
        passed: Vec::with_capacity(n_paths),
        // Those with a neck are two pieces.
        pieces: Vec::with_capacity(n_paths + n_paths / 4),
        records: Vec::with_capacity(n_ends / 2),
    };
    let mut is_used = vec![false; n_paths];
    for keypoint in 0..n {
        if around.degree(keypoint) == 1 {
            branches.follow(&around, &mut is_used, [keypoint, around.first(keypoint)], false);
        }
    }
    for keypoint in 0..n {
        if around.degree(keypoint) > 2 {
            for number in around.of(keypoint) {
                branches.follow(&around, &mut is_used, [keypoint, number], false);
            }
        }
    }
    if branches.passed.len() < n_paths {
        for keypoint in (0..n).filter(|&k| around.degree(k) == 2) {
            branches.follow(&around, &mut is_used, [keypoint, around.first(keypoint)], true);
        }
    }
    branches.measure();
    branches
}

/// A branch that is not at its end yet.
struct Open {
    /// Its number.
    number: usize,
    /// Where its pieces start in their table.
    pieces: usize,
    sum: Sum,
    /// That of its last piece, if that has more than one part.
    piece: Option<Sum>,
    banks: [Bank; 2],
}

/// Paths that are read before any of them is measured, so that they wait for memory together.
const ROW: usize = 16;

/// A path as a branch passes it: its governors, left and right, and the disks at its ends.
#[derive(Clone, Copy)]
struct Passed {
    numbers: [u32; 2],
    sites: [SiteShape; 2],
    disks: [(Point, f64); 2],
}

impl Passed {
    const NOTHING: Self = {
        let nowhere = Point::new(0.0, 0.0);
        let site = SiteShape { kind: SiteKind::Vertex, a: nowhere, b: nowhere };
        Self { numbers: [NONE; 2], sites: [site; 2], disks: [(nowhere, 0.0); 2] }
    };
}

/// The boundary on one side of a branch so far: its last site, and where on that it is met first.
#[derive(Clone, Copy)]
struct Bank {
    site: u32,
    first: Point,
    length: f64,
}

/// No site yet.
const NONE: u32 = u32::MAX;

impl<'a> Branches<'a> {
    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.records.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.records.is_empty()
    }

    /// All of them, in their order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = Branch<'_>> + DoubleEndedIterator {
        (0..self.records.len()).map(|number| Branch { all: self, number })
    }

    /// Adds the branch that leaves a keypoint by a path, unless that is passed already: only its way so far.
    fn follow(
        &mut self,
        around: &Incidence,
        is_used: &mut [bool],
        [start, number]: [u32; 2],
        is_closed: bool,
    ) {
        if is_used[number as usize] {
            return;
        }
        let passed = self.passed.len() as u32;
        let (extent, boundary) = (Sum::NOTHING.extent(), [0.0; 2]);
        self.records.push(BranchRecord { passed, pieces: 0, is_closed, extent, boundary });
        let (mut keypoint, mut number) = (start, number);
        loop {
            is_used[number as usize] = true;
            let [from, to] = self.axis.paths().ends(number);
            // A loop at one keypoint is passed from its start.
            let forwards = from == keypoint;
            self.passed.push(2 * number + u32::from(!forwards));
            keypoint = if forwards { to } else { from };
            match around.next(keypoint, is_used) {
                Some(next) => number = next,
                None => return,
            }
        }
    }

    /// Finds the pieces of all branches, and measures them.
    fn measure(&mut self) {
        let axis = self.axis;
        let passed = std::mem::take(&mut self.passed);
        let mut paths = [Path { from: 0, to: 0, left: 0, right: 0 }; ROW];
        let mut row = [Passed::NOTHING; ROW];
        let mut open = Open::new(0, 0);
        let mut last = Passed::NOTHING;
        let mut next = 0;
        for (first, darts) in (0..).step_by(ROW).zip(passed.chunks(ROW)) {
            for (path, &dart) in paths.iter_mut().zip(darts) {
                let passed = axis.paths().at(dart / 2);
                *path = if dart.is_multiple_of(2) { passed } else { passed.reversed() };
            }
            for (passed, path) in row.iter_mut().zip(&paths[..darts.len()]) {
                *passed = Passed {
                    numbers: [path.left, path.right],
                    sites: [axis.site_shape(path.left), axis.site_shape(path.right)],
                    disks: [axis.disk(path.from), axis.disk(path.to)],
                };
            }
            for (place, passed) in (first..).zip(&row[..darts.len()]) {
                if self.records.get(next).is_some_and(|record| record.passed == place) {
                    if next > 0 {
                        self.finish(&mut open, &last);
                    }
                    open = Open::new(next, self.pieces.len());
                    next += 1;
                }
                for (side, bank) in open.banks.iter_mut().enumerate() {
                    bank.pass(passed.numbers[side], &passed.sites[side], passed.disks[0].0);
                }
                self.pass(&mut open, place, &passed.sites, passed.disks);
                last = *passed;
            }
        }
        if next > 0 {
            self.finish(&mut open, &last);
        }
        self.passed = passed;
    }

    /// Ends a branch, given its last path.
    fn finish(&mut self, open: &mut Open, last: &Passed) {
        self.end_piece(open);
        let record = &mut self.records[open.number];
        record.pieces = open.pieces as u32;
        record.extent = open.sum.extent();
        for (side, bank) in open.banks.iter().enumerate() {
            record.boundary[side] = bank.length_up_to(&last.sites[side], last.disks[1].0);
        }
    }

    /// Adds a path between these sites at the end of the branch that is open.
    fn pass(
        &mut self,
        open: &mut Open,
        place: u32,
        sites: &[SiteShape; 2],
        disks: [(Point, f64); 2],
    ) {
        if self.is_sampled {
            return self.add_sampled(open, place, &Extent::of_line(disks));
        }
        if let [SiteKind::Edge, SiteKind::Edge] = [sites[0].kind, sites[1].kind] {
            let kind = kind_between_edges(sites);
            return self.add(open, kind, place, [false; 2], &Extent::of_line(disks));
        }
        let curve = self.axis.curve_between(sites, disks);
        match curve.neck() {
            None => {
                let kind = kind_at_corner(sites, trend(curve.grows_at(0.5)));
                self.add(open, kind, place, [false; 2], &Extent::of(&curve));
            }
            // On one side of the neck it closes, on the other it opens.
            Some(neck) => {
                let halves = [curve.piece(0.0, neck), curve.piece(neck, 1.0)];
                let [first, second] = halves.map(|half| Extent::of(&half));
                let [closing, opening] =
                    [Trend::Closing, Trend::Opening].map(|trend| kind_at_corner(sites, trend));
                self.add(open, closing, place, [false, true], &first);
                self.add(open, opening, place, [true, false], &second);
            }
        }
    }

    /// Adds a part on which the radius is monotone.
    #[inline]
    fn add(&mut self, open: &mut Open, kind: Kind, place: u32, at_neck: [bool; 2], next: &Extent) {
        open.sum.add(next);
        let goes_on = self.pieces.len() > open.pieces;
        if let Some(last) = self.pieces.last_mut().filter(|last| goes_on && last.kind == kind) {
            open.piece.get_or_insert_with(|| Sum::of(&last.extent)).add(next);
            (last.passed[1], last.at_neck[1]) = (place, at_neck[1]);
            return;
        }
        self.end_piece(open);
        self.pieces.push(PieceRecord { kind, extent: *next, passed: [place; 2], at_neck });
    }

    /// Adds a step of a sampled axis: level ones between steps that both rise, or both fall, belong to them.
    fn add_sampled(&mut self, open: &mut Open, place: u32, next: &Extent) {
        let rise = next.radius_end - next.radius_start;
        if rise == 0.0 {
            return self.add(open, WORM, place, [false; 2], next);
        }
        let kind = (Primitive::Wedge, Some(trend(rise > 0.0)), Bend::Straight);
        if let [.., before, level] = self.pieces[open.pieces..]
            && (before.kind, level.kind) == (kind, WORM)
        {
            self.end_piece(open);
            let level = self.pieces.pop().unwrap_or(level);
            let mut sum = Sum::of(&before.extent);
            sum.add(&level.extent);
            open.piece = Some(sum);
        }
        self.add(open, kind, place, [false; 2], next);
    }

    /// Says what the extent of the last piece is.
    fn end_piece(&mut self, open: &mut Open) {
        if let Some(sum) = open.piece.take()
            && let Some(last) = self.pieces.last_mut()
        {
            last.extent = sum.extent();
        }
    }

    fn path(&self, passed: u32) -> Path {
        let path = self.axis.paths().at(passed / 2);
        if passed.is_multiple_of(2) { path } else { path.reversed() }
    }
}

impl Open {
    fn new(number: usize, pieces: usize) -> Self {
        let bank = Bank { site: NONE, first: Point::new(0.0, 0.0), length: 0.0 };
        Self { number, pieces, sum: Sum::NOTHING, piece: None, banks: [bank; 2] }
    }
}

impl Bank {
    /// Goes on along a site, from the footpoint of a point.
    #[inline]
    fn pass(&mut self, number: u32, site: &SiteShape, from: Point) {
        if self.site != number {
            let first = foot(site, from);
            if self.site != NONE {
                self.length += (first - self.first).norm();
            }
            (self.site, self.first) = (number, first);
        }
    }

    /// Its length up to the footpoint of a point, on its last site.
    #[inline]
    fn length_up_to(&self, site: &SiteShape, to: Point) -> f64 {
        self.length + (foot(site, to) - self.first).norm()
    }
}

/// The footpoint of a point on a site.
#[inline]
fn foot(site: &SiteShape, from: Point) -> Point {
    match site.kind {
        SiteKind::Vertex => site.a,
        SiteKind::Edge => foot_on(site.a, site.b, from),
    }
}

impl<'a> Branch<'a> {
    fn record(&self) -> &'a BranchRecord {
        &self.all.records[self.number]
    }

    fn passed(&self) -> &'a [u32] {
        let next = self.all.records.get(self.number + 1);
        let end = next.map_or(self.all.passed.len(), |next| next.passed as usize);
        &self.all.passed[self.record().passed as usize..end]
    }

    /// The paths, in the direction of the branch.
    pub fn paths(&self) -> impl ExactSizeIterator<Item = Path> + DoubleEndedIterator + use<'a> {
        let all = self.all;
        self.passed().iter().map(|&passed| all.path(passed))
    }

    /// Their numbers in the axis.
    pub fn numbers(&self) -> impl ExactSizeIterator<Item = u32> + DoubleEndedIterator + use<'a> {
        self.passed().iter().map(|&passed| passed / 2)
    }

    /// Their curves, in the direction of the branch.
    pub fn curves(&self) -> impl ExactSizeIterator<Item = Curve> + DoubleEndedIterator + use<'a> {
        let axis = self.all.axis;
        self.paths().map(|path| axis.curve(&path))
    }

    /// What it consists of, in its direction.
    pub fn pieces(
        &self,
    ) -> impl ExactSizeIterator<Item = BranchPiece<'a>> + DoubleEndedIterator + use<'a> {
        let next = self.all.records.get(self.number + 1);
        let end = next.map_or(self.all.pieces.len(), |next| next.pieces as usize);
        let records = &self.all.pieces[self.record().pieces as usize..end];
        let (axis, passed) = (self.all.axis, &self.all.passed[..]);
        records.iter().map(move |record| BranchPiece { axis, passed, record })
    }

    /// Lengths, areas and radii of all of it.
    #[must_use]
    pub fn extent(&self) -> Extent {
        self.record().extent
    }

    /// The lengths of the boundary to its left and to its right, in units of the input.
    #[must_use]
    pub fn boundary_lengths(&self) -> [f64; 2] {
        self.record().boundary
    }

    /// The boundary to its left and to its right, from where it starts.
    #[must_use]
    pub fn boundary(&self) -> [BoundaryPiece; 2] {
        let [left, right] = self.boundary_lengths();
        let beside = |governor: fn(&Path) -> u32, length| {
            BoundaryPiece::beside(self.all.axis, self.paths(), governor, length)
        };
        [beside(|path| path.left, left), beside(|path| path.right, right)]
    }

    /// Whether it is a cycle of normal points.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        self.record().is_closed
    }

    /// Keypoint where it starts.
    #[must_use]
    pub fn from(&self) -> u32 {
        self.paths().next().map_or(0, |path| path.from)
    }

    /// Keypoint where it ends.
    #[must_use]
    pub fn to(&self) -> u32 {
        self.paths().next_back().map_or(0, |path| path.to)
    }
}

impl<'a> BranchPiece<'a> {
    /// What the radius does.
    #[must_use]
    pub fn primitive(&self) -> Primitive {
        self.record.kind.0
    }

    /// Whether it grows; nothing for a worm.
    #[must_use]
    pub fn trend(&self) -> Option<Trend> {
        self.record.kind.1
    }

    /// How the axis bends.
    #[must_use]
    pub fn bend(&self) -> Bend {
        self.record.kind.2
    }

    /// Lengths, areas and radii of all of it.
    #[must_use]
    pub fn extent(&self) -> Extent {
        self.record.extent
    }

    /// The curves, in the direction of the branch.
    pub fn curves(&self) -> impl ExactSizeIterator<Item = Curve> + use<'a> {
        let PieceRecord { passed: [first, last], at_neck: [from_neck, to_neck], .. } = *self.record;
        let axis = self.axis;
        let passed = &self.passed[first as usize..=last as usize];
        let count = passed.len();
        passed.iter().enumerate().map(move |(k, &passed)| {
            let path = axis.paths().at(passed / 2);
            let path = if passed.is_multiple_of(2) { path } else { path.reversed() };
            let curve = axis.curve(&path);
            let neck = curve.neck();
            let low = neck.filter(|_| from_neck && k == 0).unwrap_or(0.0);
            let high = neck.filter(|_| to_neck && k + 1 == count).unwrap_or(1.0);
            if (low, high) == (0.0, 1.0) { curve } else { curve.piece(low, high) }
        })
    }
}

impl fmt::Debug for Branches<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

impl fmt::Debug for Branch<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Branch")
            .field("numbers", &self.numbers().collect::<Vec<_>>())
            .field("pieces", &self.pieces().collect::<Vec<_>>())
            .field("extent", &self.extent())
            .field("boundary_lengths", &self.boundary_lengths())
            .field("is_closed", &self.is_closed())
            .finish()
    }
}

impl fmt::Debug for BranchPiece<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (primitive, trend, bend) = self.record.kind;
        f.debug_struct("BranchPiece")
            .field("primitive", &primitive)
            .field("trend", &trend)
            .field("bend", &bend)
            .field("extent", &self.extent())
            .finish()
    }
}

fn trend(opens: bool) -> Trend {
    if opens { Trend::Opening } else { Trend::Closing }
}

/// The primitive of a line between two edges, left and right.
fn kind_between_edges([left, right]: &[SiteShape; 2]) -> Kind {
    // One of them runs in the direction of the path and the other against it: inside the right one does,
    // outside the left one.
    let turn = cross_directions(right.a, right.b, left.b, left.a);
    if turn == 0.0 { WORM } else { (Primitive::Wedge, Some(trend(turn > 0.0)), Bend::Straight) }
}

/// The primitive of a curve with these governors, left and right, one of them a corner, on which the radius
/// is monotone.
fn kind_at_corner([left, right]: &[SiteShape; 2], trend: Trend) -> Kind {
    let bend = match (left.kind, right.kind, trend) {
        (SiteKind::Vertex, SiteKind::Vertex, _) => Bend::Straight,
        (SiteKind::Vertex, _, Trend::Opening) => Bend::SpiralOutLeft,
        (SiteKind::Vertex, _, Trend::Closing) => Bend::SpiralInLeft,
        (_, _, Trend::Opening) => Bend::SpiralOutRight,
        (_, _, Trend::Closing) => Bend::SpiralInRight,
    };
    (Primitive::Flare, Some(trend), bend)
}

impl Extent {
    /// That of a line between two edges with these disks at its ends.
    fn of_line([from, to]: [(Point, f64); 2]) -> Self {
        let (r1, r2) = (from.1, to.1);
        let (length, rise) = ((to.0 - from.0).norm(), r2 - r1);
        Self {
            length,
            // Two trapezoids.
            area: ((length - rise) * (length + rise)).max(0.0).sqrt() * (r1 + r2),
            radius_start: r1,
            radius_end: r2,
            radius_min: lesser(r1, r2),
            radius_max: greater(r1, r2),
            radius_mean: 0.5 * (r1 + r2),
        }
    }

    fn of(curve: &Curve) -> Self {
        let (length, radius_mean) = curve.length_and_mean();
        Self {
            length,
            area: curve.strip_area(),
            radius_start: curve.radius_from(),
            radius_end: curve.radius_to(),
            radius_min: curve.radius_min(),
            radius_max: curve.radius_max(),
            radius_mean,
        }
    }
}

/// The extents of parts that follow one another.
#[derive(Clone, Copy)]
struct Sum {
    length: f64,
    area: f64,
    /// The radius summed along the length.
    moment: f64,
    /// The radius where the first starts, and where the last ends; the least, the greatest.
    start: f64,
    end: f64,
    least: f64,
    greatest: f64,
}

impl Sum {
    /// The sum of nothing.
    const NOTHING: Self = Self {
        length: 0.0,
        area: 0.0,
        moment: 0.0,
        start: 0.0,
        end: 0.0,
        least: f64::INFINITY,
        greatest: 0.0,
    };

    fn of(first: &Extent) -> Self {
        let mut sum = Self::NOTHING;
        sum.add(first);
        sum
    }

    #[inline]
    fn add(&mut self, next: &Extent) {
        // Nothing is greater than any radius only as long as there is nothing.
        self.start = if self.least == f64::INFINITY { next.radius_start } else { self.start };
        self.end = next.radius_end;
        self.length += next.length;
        self.area += next.area;
        self.moment += next.length * next.radius_mean;
        self.least = lesser(self.least, next.radius_min);
        self.greatest = greater(self.greatest, next.radius_max);
    }

    #[inline]
    fn extent(&self) -> Extent {
        let Self { length, area, moment, start, end, least, greatest } = *self;
        let mean = if length > 0.0 { moment / length } else { greatest };
        Extent {
            length,
            area,
            radius_start: start,
            radius_end: end,
            radius_min: least,
            radius_max: greatest,
            radius_mean: lesser(greater(mean, least), greatest),
        }
    }
}

/// The lesser of two numbers, as machines have it.
#[inline]
fn lesser(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The greater of two numbers, as machines have it.
#[inline]
fn greater(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

impl BoundaryPiece {
    /// The boundary on one side of paths that follow one another.
    fn beside(
        axis: &MedialAxis,
        paths: impl Iterator<Item = Path>,
        governor: impl Fn(&Path) -> u32,
        length: f64,
    ) -> Self {
        let mut piece = Self { points: Vec::new(), sites: Vec::new(), length };
        let foot_at = |site: u32, keypoint: u32| {
            let SiteShape { a, b, .. } = axis.site_shape(site);
            foot_on(a, b, axis.keypoints().at(keypoint).position)
        };
        let mut last = None;
        for path in paths {
            let site = governor(&path);
            if piece.sites.last() != Some(&site) {
                piece.sites.push(site);
                piece.push(foot_at(site, path.from));
            }
            last = Some((site, path.to));
        }
        if let Some((site, to)) = last {
            piece.push(foot_at(site, to));
        }
        piece
    }

    fn push(&mut self, p: Point) {
        if self.points.last() != Some(&p) {
            self.points.push(p);
        }
    }
}
