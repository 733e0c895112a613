//! The hierarchic skeleton [OK95]: how significant each point of an axis is, and what is left of it
//! above any threshold.
//!
//! # Contract
//! Values belong to an exact axis of either side, complete but for what a frame cuts off outside, or, within
//! what its samples allow, to a sampled one, and grow
//! along each path in the direction in which it burns. Points whose value lies below a threshold are
//! removed, from the leaves inwards: the running maximum counts [SB98], so components and cycles stay, and
//! of a component that is removed the root stays as a single tip. Cuts lie at the parameter where the
//! threshold is reached, rounded.
//! Everything takes O(n log n) for n keypoints, a search for far corners aside, which depends on the
//! shape.
//!
//! # Method
//! 1. The axis burns from its leaves (`fire.rs`), which gives each path a direction to the root of its
//!    tree.
//! 2. Measures have closed forms along a path: see [`Limb::value`]. Lengths along the boundary come from
//!    prefix sums.
//! 3. Values at keypoints are the largest of what comes from the leaves: at keypoints and necks. All
//!    measures are largest there, but for the relative excess, and the excess, which may be a little
//!    larger elsewhere on a path that has a corner for a governor.
//!
//! # Departures
//! The root of a tree is where it burns last; the papers leave it to be found otherwise.

use std::cell::{Cell, OnceCell};
use std::ops::Range;
use std::sync::OnceLock;

use super::fire::{Fire, Step};
use super::ground::Ground;
use super::measure::Measure;
use super::rest::Pruned;
use super::scale::Swallowing;
use crate::axis::{Accuracy, Curve, KeypointKind, MedialAxis, Path, Side, bisected, crossing};
use crate::check::Name;
use crate::domain::{Domain, Site};
use crate::engine::exterior_frame;
use crate::geom::{BoundsTree, Point, Rect, Visitor};

/// Why nothing can be said of the significance of an axis.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HierarchyError {
    /// Values need every path, exactly.
    #[error("the axis is pruned; significance needs a complete axis")]
    Incomplete,
    /// The axis is of another domain.
    #[error("the axis names {name}, which the domain does not have")]
    UnknownSite {
        /// What it names.
        name: Name,
    },
    /// The outside of the domain could not be made a domain of its own: a fault of ours.
    #[error("the outside of the domain cannot be made out")]
    NoOutside,
}

/// A complete exact axis with the order in which it burns.
#[derive(Debug)]
pub struct Hierarchy<'a> {
    /// The domain as it was given, and the side of it that the axis is of.
    pub(super) given: &'a Domain,
    ground: Ground<'a>,
    pub(super) axis: &'a MedialAxis,
    /// The element behind each site, and the first corner behind what has it on the left.
    governors: Vec<(Site, u32)>,
    pub(super) fire: Fire,
    /// For each edge the length of the boundary from the start of its walk to the edge, once it is asked for.
    before: OnceLock<Vec<f64>>,
    /// The corners, once far ones are looked for.
    tree: OnceLock<BoundsTree>,
    /// Made when it is asked for.
    swallowing: OnceLock<Swallowing>,
}

/// Values of one measure.
#[derive(Clone, Debug, PartialEq)]
pub struct Significance {
    /// What they measure.
    pub measure: Measure,
    /// One for each path.
    pub paths: Vec<Span>,
}

/// The values of a measure along a path: at each point the largest from the leaves up to there, of those
/// at keypoints and necks. Infinite where nothing burns.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Span {
    /// Where the path starts.
    pub start: f64,
    /// Where it ends.
    pub end: f64,
    /// The largest: at one of the ends, or between them at the root of a tree.
    pub most: f64,
}

impl Span {
    /// The largest value, that at the start and that at the end; nothing where it is infinite.
    #[must_use]
    pub fn values(&self) -> [Option<f64>; 3] {
        [self.most, self.start, self.end].map(|value| value.is_finite().then_some(value))
    }
}

/// The order in which the paths of an axis are removed: any level of the hierarchy is a part of it from the
/// start.
#[derive(Clone, Debug, PartialEq)]
pub struct Removal {
    /// What decides.
    pub measure: Measure,
    /// The paths that can be removed, the first one to go first.
    pub paths: Vec<u32>,
    /// The largest value on each of them, in the same order: all of it goes if the threshold is greater.
    pub values: Vec<f64>,
}

impl Removal {
    /// The paths that a threshold removes altogether. O(log n).
    #[must_use]
    pub fn below(&self, threshold: f64) -> &[u32] {
        &self.paths[..self.values.partition_point(|&value| value < threshold)]
    }
}

/// A path, or the part of one up to the root, seen from the leaves.
pub(super) struct Limb<'h> {
    hierarchy: &'h Hierarchy<'h>,
    step: Step,
    left: Site,
    right: Site,
    /// The first corner of the boundary behind.
    first: u32,
    /// The disks at the start and at the end.
    disks: [(Point, f64); 2],
    /// Made when something between the two is asked for.
    curve: OnceCell<Curve>,
    /// The longest way to a leaf at its start.
    reach: f64,
    /// The squared distance of the farthest corner behind that was found last, and which it was: mostly
    /// it stays the same along the way.
    far: Cell<(f64, u32)>,
    /// From where it was looked for.
    far_from: Cell<Option<Point>>,
    /// The squared distance of the farthest corner behind from the start; 0 at a leaf.
    behind: f64,
}

/// No corner.
pub(super) const NONE: u32 = u32::MAX;

/// Corners up to which each is asked how far it is.
const FEW: u32 = 16;

/// No corner behind yet.
pub(super) const NO_FAR: (f64, u32) = (0.0, NONE);

/// A path, or a part of one, that burns in one direction.
pub(super) struct Part {
    pub path: u32,
    /// Whether from the start of the path.
    pub forwards: bool,
    /// The keypoint where it burns first.
    pub from: u32,
    /// The keypoint ahead.
    pub to: u32,
    /// The parameter up to which it burns in this direction.
    pub end: f64,
    /// That of the root as the path has it, if it lies there.
    pub root: Option<f64>,
}

impl<'a> Hierarchy<'a> {
    /// Burns an axis of a domain.
    ///
    /// ```
    /// use medial::domain::{Domain, Options};
    /// use medial::engine::path_tracing;
    /// use medial::geom::Point;
    /// use medial::ops::{Hierarchy, Measure};
    ///
    /// let ring = [(0., 0.), (6., 0.), (6., 2.), (0., 2.)].map(|(x, y)| Point::new(x, y));
    /// let domain = Domain::from_polygons(&[vec![ring.to_vec()]], &Options::default())?;
    /// let axis = path_tracing(&domain)?;
    /// let hierarchy = Hierarchy::new(&domain, &axis)?;
    /// // The branches to the corners go, and so much of the spine that disks still come as near to them.
    /// let pruned = hierarchy.pruned(Measure::Excess, 0.5);
    /// assert_eq!(pruned.axis.paths().len(), 1);
    /// assert!((pruned.error - 0.5).abs() < 1e-12);
    /// let corner = Point::new(0.0, 0.0);
    /// let away = |k: medial::axis::Keypoint| (k.position - corner).norm() - k.radius;
    /// let nearest = pruned.axis.keypoints().iter().map(away).fold(f64::INFINITY, f64::min);
    /// assert!((nearest - 0.5).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If the axis is not exact, or pruned, or not of this domain.
    pub fn new(domain: &'a Domain, axis: &'a MedialAxis) -> Result<Self, HierarchyError> {
        let (ground, governors) = grounded(domain, axis)?;
        let edges = ground.domain().edges();
        let first = |site: Site| {
            let index = site.index();
            if site.is_edge() { edges[index as usize].next } else { index }
        };
        let governors = governors.into_iter().map(|site| (site, first(site))).collect();
        let fire = Fire::new(axis);
        let (before, tree, swallowing) = (OnceLock::new(), OnceLock::new(), OnceLock::new());
        Ok(Self { given: domain, ground, axis, governors, fire, before, tree, swallowing })
    }

    fn before(&self) -> &[f64] {
        self.before.get_or_init(|| {
            let edges = self.ground.domain().edges();
            let mut before = vec![0.0; edges.len()];
            for walk in self.ground.domain().walks() {
                let mut sum = 0.0;
                for edge in walk.edges() {
                    before[edge as usize] = sum;
                    sum += edges[edge as usize].length;
                }
            }
            before
        })
    }

    fn tree(&self) -> &BoundsTree {
        self.tree.get_or_init(|| {
            let edges = self.ground.domain().edges();
            let corner = |k: u32| Rect::EMPTY.with(edges[k as usize].start);
            BoundsTree::new(0, edges.len() as u32, corner)
        })
    }

    fn swallowing(&self) -> &Swallowing {
        self.swallowing.get_or_init(|| Swallowing::new(self.axis))
    }

    /// The length of a walk from the start of one edge on to that of another one.
    fn length_between(&self, from: u32, to: u32) -> f64 {
        let before = self.before();
        let way = before[to as usize] - before[from as usize];
        if to >= from {
            return way;
        }
        let domain = self.ground.domain();
        let walk = domain.walks()[domain.edge(from).walk as usize];
        let last = walk.edges().end - 1;
        way + before[last as usize] + domain.edge(last).length
    }

    /// The path as the fire runs through it from one end, with what is known there.
    pub(super) fn limb(&self, step: &Step, reach: f64, far: (f64, u32)) -> Limb<'_> {
        let (left, first) = self.governors[step.left as usize];
        let (right, _) = self.governors[step.right as usize];
        Limb {
            hierarchy: self,
            step: *step,
            left,
            right,
            first,
            disks: [self.disk(step.from), self.disk(step.to)],
            curve: OnceCell::new(),
            reach,
            far: Cell::new(far),
            far_from: Cell::new(None),
            behind: far.0,
        }
    }

    /// The parts of the paths that burn from both ends, each with the place of the keypoint where it starts.
    pub(super) fn rooted(&self) -> impl Iterator<Item = (Part, Step, u32)> {
        self.fire.both.iter().flat_map(|&(number, length, places)| {
            let path = self.axis.paths().at(number);
            // Inside, whatever the rounding.
            let root = self.axis.curve(&path).parameter_at_length(length);
            let root = root.clamp(f64::EPSILON, 1.0 - f64::EPSILON);
            [(path, root, true), (path.reversed(), 1.0 - root, false)].map(
                |(path, end, forwards)| {
                    let Path { from, to, left, right } = path;
                    let [place, next] = if forwards { places } else { [places[1], places[0]] };
                    let dart = 2 * number + u32::from(!forwards);
                    let root = Some(root);
                    let part = Part { path: number, forwards, from, to, end, root };
                    (part, Step { dart, from, to, left, right, next }, place)
                },
            )
        })
    }

    /// Goes through all parts of paths that burn, those nearer to the leaves first. `done` gets each, with
    /// the largest value that comes from the leaves, and gives that at its end. Beyond a value that is
    /// enough nothing is asked any more.
    pub(super) fn burn(&self, enough: f64, mut done: impl FnMut(&Part, &Limb<'_>, f64) -> f64) {
        let n = self.fire.n_places;
        let (mut values, mut reaches) = (vec![0.0_f64; n], vec![0.0_f64; n]);
        let mut fars = vec![NO_FAR; n];
        for (place, step) in self.fire.steps.iter().enumerate() {
            let next = step.next as usize;
            if values[place] >= enough {
                values[next] = values[next].max(values[place]);
                continue;
            }
            let limb = self.limb(step, reaches[place], fars[place]);
            let (path, forwards) = (step.dart / 2, step.dart.is_multiple_of(2));
            let part = Part { path, forwards, from: step.from, to: step.to, end: 1.0, root: None };
            let value = done(&part, &limb, values[place]);
            values[next] = values[next].max(value);
            if limb.far.get().0 > fars[next].0 {
                fars[next] = limb.far.get();
            }
            reaches[next] = reaches[next].max(reaches[place] + self.fire.lengths[path as usize]);
        }
        for (part, step, place) in self.rooted() {
            let place = place as usize;
            if values[place] < enough {
                let limb = self.limb(&step, reaches[place], fars[place]);
                done(&part, &limb, values[place]);
            }
        }
    }

    /// Goes through all parts of paths that burn, those nearer to the leaves first.
    pub(super) fn each_part(&self, mut done: impl FnMut(&Part, &Limb<'_>)) {
        self.burn(f64::INFINITY, |part, limb, _| {
            done(part, limb);
            0.0
        });
    }

    /// Whether a path that burns has a corner among its governors.
    #[inline]
    pub(super) fn may_have_neck(&self, step: &Step) -> bool {
        let is_edge = |site: u32| self.governors[site as usize].0.is_edge();
        !(is_edge(step.left) && is_edge(step.right))
    }

    /// The disk of a keypoint.
    #[inline]
    pub(super) fn disk(&self, keypoint: u32) -> (Point, f64) {
        self.axis.disk(keypoint)
    }

    /// The squared distance of the farthest of the corners behind a path that burns, and which it is; one
    /// that was far before saves most of a search.
    #[inline]
    pub(super) fn farthest_behind(&self, step: &Step, from: Point, known: u32) -> (f64, u32) {
        let first = self.governors[step.left as usize].1;
        let last = self.governors[step.right as usize].0.index();
        self.farthest((first, last), from, known)
    }

    /// The same for the corners from one to another one, along their walk.
    #[inline]
    fn farthest(&self, (first, last): (u32, u32), from: Point, known: u32) -> (f64, u32) {
        if first <= last && last - first < FEW {
            let domain = self.ground.domain();
            let mut farthest = Farthest { domain, from, distance2: 0.0, corner: first };
            (first..=last).for_each(|corner| farthest.item(corner));
            return (farthest.distance2, farthest.corner);
        }
        self.search_far((first, last), from, known)
    }

    /// The same for any number of them, or around the start of their walk.
    fn search_far(&self, (first, last): (u32, u32), from: Point, known: u32) -> (f64, u32) {
        let domain = self.ground.domain();
        let mut farthest = Farthest { domain, from, distance2: 0.0, corner: first };
        let ranges = if first <= last {
            [first..last + 1, 0..0]
        } else {
            let walk = domain.walks()[domain.edge(first).walk as usize];
            [first..walk.edges().end, walk.first..last + 1]
        };
        if ranges.iter().map(ExactSizeIterator::len).sum::<usize>() <= FEW as usize {
            ranges.into_iter().flatten().for_each(|corner| farthest.item(corner));
            return (farthest.distance2, farthest.corner);
        }
        // One that is far saves most of the search.
        let is_behind = ranges.iter().any(|range| range.contains(&known));
        farthest.item(if is_behind { known } else { last });
        for range in ranges.into_iter().filter(|range| !range.is_empty()) {
            self.tree().visit_within(range, &mut farthest);
        }
        (farthest.distance2, farthest.corner)
    }

    /// The squared distance of a corner.
    #[inline]
    pub(super) fn distance2(&self, corner: u32, from: Point) -> f64 {
        (self.ground.domain().edge(corner).start - from).norm2()
    }

    /// The side of the boundary that the axis is of.
    pub(super) fn domain(&self) -> &Domain {
        self.ground.domain()
    }

    /// The values of a measure on all paths.
    #[must_use]
    pub fn significance(&self, measure: Measure) -> Significance {
        self.spans(measure, |_| [0.0, 1.0])
    }

    /// The values of a measure on the paths that pruning left.
    #[must_use]
    pub fn significance_of(&self, measure: Measure, pruned: &Pruned) -> Significance {
        let mut kept = vec![[0.0, 1.0]; self.axis.paths().len()];
        pruned.origins.iter().for_each(|origin| kept[origin.path as usize] = origin.part);
        let all = self.spans(measure, |path| kept[path as usize]).paths;
        let paths = pruned.origins.iter().map(|origin| all[origin.path as usize]).collect();
        Significance { measure, paths }
    }

    /// The values on all paths, at the ends of a part of each.
    fn spans(&self, measure: Measure, kept: impl Fn(u32) -> [f64; 2]) -> Significance {
        if measure == Measure::Prominence {
            return Significance { measure, paths: self.prominences(kept) };
        }
        let all = Span { start: f64::INFINITY, end: f64::INFINITY, most: f64::INFINITY };
        let mut paths = vec![all; self.axis.paths().len()];
        self.burn(f64::INFINITY, |part, limb, before| {
            let [low, high] = kept(part.path);
            let low = if part.forwards { low } else { 1.0 - high };
            let mut first = before.max(limb.first(measure));
            let last = first.max(limb.most(measure, part.end));
            if low > 0.0 {
                first = first.max(limb.most(measure, low.min(part.end)));
            }
            let span = &mut paths[part.path as usize];
            match (part.forwards, part.root) {
                (true, None) => *span = Span { start: first, end: last, most: last },
                (false, None) => *span = Span { start: last, end: first, most: last },
                // What lies beyond the root belongs to the other end, which comes second.
                (true, Some(_)) => *span = Span { start: first, end: first, most: last },
                (false, Some(_)) => (span.end, span.most) = (first, span.most.max(last)),
            }
            last
        });
        Significance { measure, paths }
    }

    /// The order in which paths go as a threshold grows: each one after those nearer to the leaves.
    ///
    /// ```
    /// # use medial::domain::{Domain, Options};
    /// # use medial::engine::path_tracing;
    /// # use medial::geom::Point;
    /// # use medial::ops::{Hierarchy, Measure};
    /// # let ring = [(0., 0.), (6., 0.), (6., 2.), (0., 2.)].map(|(x, y)| Point::new(x, y));
    /// # let domain = Domain::from_polygons(&[vec![ring.to_vec()]], &Options::default())?;
    /// # let axis = path_tracing(&domain)?;
    /// let removal = Hierarchy::new(&domain, &axis)?.removal(Measure::Excess);
    /// // The branches to the corners go at once, then the spine.
    /// assert_eq!((removal.paths.len(), removal.below(0.5).len(), removal.below(0.4).len()), (5, 4, 0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn removal(&self, measure: Measure) -> Removal {
        let most = self.significance(measure).paths;
        let value = |path: u32| most[path as usize].most;
        let mut paths = self.fire.order.clone();
        // Equal ones stay in the order in which they burn.
        paths.sort_by(|&a, &b| value(a).total_cmp(&value(b)));
        let values = paths.iter().map(|&path| value(path)).collect();
        Removal { measure, paths, values }
    }
}

/// The side of the boundary that a complete exact axis is of, and the element behind each of its sites.
///
/// # Errors
/// If the axis is not exact, or pruned, or not of this domain.
pub(super) fn grounded<'a>(
    domain: &'a Domain,
    axis: &MedialAxis,
) -> Result<(Ground<'a>, Vec<Site>), HierarchyError> {
    // Where a frame cuts paths nothing burns, so what does has all of its leaves.
    let is_cut = axis.side == Side::Exterior
        && axis.keypoints().iter().all(|keypoint| keypoint.kind != KeypointKind::Tip);
    // A sampled axis burns from where it was cut off, with the radius it has there.
    let is_sampled = axis.accuracy != Accuracy::Exact;
    if !(axis.complete || is_cut || is_sampled) {
        return Err(HierarchyError::Incomplete);
    }
    let frame = match axis.side {
        Side::Interior => Rect::EMPTY,
        Side::Exterior => exterior_frame(domain, None).map_err(|_| HierarchyError::NoOutside)?,
    };
    let ground = Ground::new(domain, axis.side, &frame).ok_or(HierarchyError::NoOutside)?;
    let unknown = |name| HierarchyError::UnknownSite { name };
    let governors = ground.governors(axis).map_err(unknown)?;
    Ok((ground, governors))
}

/// Looks for the farthest corner.
struct Farthest<'a> {
    domain: &'a Domain,
    from: Point,
    distance2: f64,
    corner: u32,
}

impl Visitor for Farthest<'_> {
    #[inline]
    fn enters(&self, bounds: &Rect, _: Range<u32>) -> bool {
        let (low, high) = (self.from - bounds.min, bounds.max - self.from);
        let far = Point::new(low.x.abs().max(high.x.abs()), low.y.abs().max(high.y.abs()));
        far.norm2() > self.distance2
    }

    #[inline]
    fn item(&mut self, corner: u32) {
        let distance2 = (self.domain.edge(corner).start - self.from).norm2();
        if distance2 > self.distance2 {
            (self.distance2, self.corner) = (distance2, corner);
        }
    }
}

impl Limb<'_> {
    fn curve(&self) -> &Curve {
        self.curve.get_or_init(|| {
            let axis = self.hierarchy.axis;
            let site = |site: u32| axis.site_shape(site);
            let [from, to] = self.disks;
            Curve::between(&site(self.step.left), &site(self.step.right), from, to)
        })
    }

    #[inline]
    pub fn radius(&self, u: f64) -> f64 {
        if u <= 0.0 {
            self.disks[0].1
        } else if u >= 1.0 {
            self.disks[1].1
        } else {
            self.curve().radius_at(u)
        }
    }

    #[inline]
    fn centre(&self, u: f64) -> Point {
        if u <= 0.0 {
            self.disks[0].0
        } else if u >= 1.0 {
            self.disks[1].0
        } else {
            self.curve().point_at(u)
        }
    }

    /// The first parameter at which the radius is that large, if it is before an end.
    pub fn reaches(&self, radius: f64, end: f64) -> Option<f64> {
        if self.radius(0.0) >= radius {
            return Some(0.0);
        }
        let found = self.curve().parameters_at_radius(radius).into_iter().flatten();
        found.filter(|&u| u < end).min_by(f64::total_cmp)
    }

    /// The parameter of the neck, if it lies before an end.
    pub fn neck(&self, end: f64) -> Option<f64> {
        if self.is_monotone() {
            return None;
        }
        self.curve().neck().filter(|&neck| neck < end)
    }

    /// Whether it can be told without the curve that there is no neck: the line through a corner that is
    /// square to the other governor, on which the neck would lie, has both ends on one side.
    fn is_monotone(&self) -> bool {
        /// Many times the rounding error of the products and of the direction of an edge.
        const SURE: f64 = 1e-12;
        let domain = self.hierarchy.ground.domain();
        let [left, right] = [self.left, self.right].map(|site| domain.edge(site.index()));
        let (on_line, along) = match (self.left.is_edge(), self.right.is_edge()) {
            (true, true) => return true,
            (true, false) => (right.start, left.direction),
            (false, true) => (left.start, right.direction),
            (false, false) => {
                let way = right.start - left.start;
                (left.start + way * 0.5, way.perp())
            }
        };
        let [from, to] = self.disks.map(|(centre, _)| {
            let way = centre - on_line;
            let (x, y) = (along.x * way.x, along.y * way.y);
            if (x + y).abs() > SURE * (x.abs() + y.abs()) { x + y } else { f64::NAN }
        });
        from > 0.0 && to > 0.0 || from < 0.0 && to < 0.0
    }

    /// The first parameter at which a measure reaches a threshold, if it does so before an end.
    pub fn reached(&self, measure: Measure, threshold: f64, end: f64) -> f64 {
        // Between these places nearly every measure grows, falls or stays.
        let neck = self.neck(end);
        let middle = neck.filter(|&neck| self.value(measure, neck) >= threshold);
        let (low, high) = match (middle, neck) {
            (Some(neck), _) => (0.0, neck),
            (None, Some(neck)) => (neck, end),
            (None, None) => (0.0, end),
        };
        if let Some([before, _]) = self.bracketed(measure, threshold, [low, high]) {
            return before;
        }
        let at = |u: f64| low + (high - low) * u;
        // No more than the threshold is lost, unless that is reached at the very end.
        let last_below = |[before, after]: [f64; 2]| at(if after == 1.0 { after } else { before });
        if measure == Measure::Excess {
            // The usual one, which is asked for at every leaf.
            return last_below(crossing(|u| self.excess(at(u)) - threshold));
        }
        let missing = |u: f64| self.value(measure, at(u)) - threshold;
        // What swallows a disk may be another one a little farther on.
        if measure == Measure::Scale {
            return at(bisected(missing));
        }
        last_below(crossing(missing))
    }

    /// Two places between two others, a few ulp of 1 apart, of which the first one is below a threshold of the
    /// excess or the relative excess and the second is not: by the closed form for the corner that is farthest.
    ///
    /// With that corner at the origin and `c` and `r` polynomials of degree two, `|c| = a + b r` is an equation
    /// of degree two as well on lines, and for `b = 1` on parabolas, where higher terms cancel.
    pub fn bracketed(
        &self,
        measure: Measure,
        threshold: f64,
        [low, high]: [f64; 2],
    ) -> Option<[f64; 2]> {
        /// Corners that are tried.
        const TRIES: u32 = 3;
        /// How far the two places are from the solution, in turn, for each ulp of the coordinates there.
        const MARGINS: [f64; 2] = [1.0, 16.0];
        let [start, slope, bend] = self.curve().polynomial()?;
        let is_line = self.left.is_edge() && self.right.is_edge();
        let (more, times) = match measure {
            Measure::Excess => (threshold, 1.0),
            Measure::RelativeExcess if is_line => (0.0, 1.0 + threshold),
            _ => return None,
        };
        let is_below = |u: f64| self.value(measure, u) < threshold;
        let squared = times * times;
        let mut far = self.far_corner(high);
        for _ in 0..TRIES {
            let from = start.0 - far;
            let radius = more + times * start.1;
            let constant = (from.norm() - radius) * (from.norm() + radius);
            let linear = 2.0 * (from.dot(slope.0) - times * radius * slope.1);
            let quadratic = slope.0.norm2() - squared * slope.1 * slope.1
                + 2.0 * (from.dot(bend.0) - times * radius * bend.1);
            // The root where it grows.
            let root = (linear * linear - 4.0 * quadratic * constant).sqrt();
            let u = if linear > 0.0 {
                -2.0 * constant / (linear + root)
            } else {
                (root - linear) / (2.0 * quadratic)
            };
            if !(low < u && u < high) {
                return None;
            }
            // The parameter changes by so much where the distance changes by an ulp of the coordinates.
            let (size, distance) = (far.x.abs().max(far.y.abs()), more + times * self.radius(u));
            let ulp = f64::EPSILON * (1.0 + 2.0 * distance * (size + distance) / root);
            let around = MARGINS.map(|margin| [u - margin * ulp, u + margin * ulp]);
            let inside = around.into_iter().take_while(|[a, b]| low < *a && *b < high);
            for [before, after] in inside {
                if is_below(before) && !is_below(after) {
                    return Some([before, after]);
                }
            }
            let next = self.far_corner(u);
            if next == far {
                return None;
            }
            far = next;
        }
        None
    }

    /// The farthest corner behind.
    fn far_corner(&self, u: f64) -> Point {
        self.farthest(self.centre(u));
        self.hierarchy.ground.domain().edge(self.far.get().1).start
    }

    /// The excess at the start, from the corners behind all that ends there.
    pub fn excess_at_start(&self) -> f64 {
        (self.behind.sqrt() - self.radius(0.0)).max(0.0)
    }

    /// The value at the start, as far as it may be larger than those of what ends there.
    pub fn first(&self, measure: Measure) -> f64 {
        match measure {
            // All corners behind are behind one of those.
            Measure::Excess => 0.0,
            Measure::RelativeExcess if self.radius(0.0) > 0.0 => 0.0,
            _ => self.value(measure, 0.0),
        }
    }

    /// The largest value up to a parameter, of those there and at the neck.
    pub fn most(&self, measure: Measure, end: f64) -> f64 {
        let at_neck = self.neck(end).map_or(0.0, |neck| self.value(measure, neck));
        self.value(measure, end).max(at_neck)
    }

    /// The value of a measure at a parameter, by itself.
    pub fn value(&self, measure: Measure, u: f64) -> f64 {
        let (centre, radius) = (self.centre(u), self.radius(u));
        let length = || self.curve().piece(0.0, u).length();
        let behind = || 2.0 * self.curve().growth_at(u).clamp(-1.0, 1.0).acos();
        let value = match measure {
            Measure::Excess => self.excess(u),
            Measure::RelativeExcess | Measure::Prominence if radius > 0.0 => {
                (self.farthest(centre) - radius) / radius
            }
            // Out of a corner it is the same all along.
            Measure::RelativeExcess | Measure::Prominence => self.value(measure, 1.0),
            Measure::Potential => self.boundary(centre),
            Measure::Chord => self.boundary(centre) - self.chord(centre),
            Measure::Circularity => self.boundary(centre) - radius * behind(),
            Measure::Erosion => {
                self.hierarchy.fire.times[self.step.from as usize] + length() - radius
            }
            Measure::Length => self.reach + length(),
            Measure::Angle => behind().min(std::f64::consts::TAU - behind()),
            Measure::HalfChord => radius * (0.5 * behind()).sin(),
            Measure::Radius => radius,
            Measure::Scale => self.hierarchy.swallowing().value(centre, radius),
        };
        value.max(0.0)
    }

    /// How far along its edge a governor is touched, or where it is, if a corner.
    fn foot(&self, site: Site, centre: Point) -> (f64, Point) {
        let edge = self.hierarchy.ground.domain().edge(site.index());
        if !site.is_edge() {
            return (0.0, edge.start);
        }
        let along = edge.direction.dot(centre - edge.start).clamp(0.0, edge.length);
        (along, edge.start + edge.direction * along)
    }

    fn chord(&self, centre: Point) -> f64 {
        (self.foot(self.left, centre).1 - self.foot(self.right, centre).1).norm()
    }

    /// The first and the last corner of the boundary behind, between the footpoints.
    pub fn corners(&self) -> (u32, u32) {
        (self.first, self.right.index())
    }

    /// The length of the boundary behind, between the footpoints.
    fn boundary(&self, centre: Point) -> f64 {
        let (first, last) = self.corners();
        let domain = self.hierarchy.ground.domain();
        let rest = |site: Site| {
            let along = self.foot(site, centre).0;
            if site.is_edge() { domain.edge(site.index()).length - along } else { 0.0 }
        };
        rest(self.left)
            + self.hierarchy.length_between(first, last)
            + self.foot(self.right, centre).0
    }

    /// The distance of the farthest corner behind less the radius.
    #[inline]
    fn excess(&self, u: f64) -> f64 {
        (self.farthest(self.centre(u)) - self.radius(u)).max(0.0)
    }

    /// The distance of the farthest corner behind.
    #[inline]
    fn farthest(&self, centre: Point) -> f64 {
        if self.far_from.get() != Some(centre) {
            let known = self.far.get().1;
            self.far.set(self.hierarchy.farthest(self.corners(), centre, known));
            self.far_from.set(Some(centre));
        }
        self.far.get().0.sqrt()
    }
}
