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

mod limb;

use std::sync::OnceLock;

use super::fire::{Fire, Step};
use super::ground::Ground;
use super::measure::Measure;
use super::rest::Pruned;
use super::scale::Swallowing;
use crate::axis::{Accuracy, KeypointKind, MedialAxis, Path, Side};
use crate::check::Name;
use crate::domain::{Domain, Site};
use crate::engine::exterior_frame;
use crate::geom::{BoundsTree, Point, Rect};
pub(super) use limb::Limb;

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

/// No corner.
pub(super) const NONE: u32 = u32::MAX;

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
