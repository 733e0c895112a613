//! Peninsulas and bays, and which of them go together: the purpose for which Volkmann and St. Clair looked
//! for the axis [VS87, I.B], to nest shapes into what is left of a sheet.
//!
//! # Contract
//! A limb is a branch with a free end, of the axis that is left once small branches are pruned: a peninsula
//! inside, a bay outside, as far as it lies within the convex hull, and within a hole. A branch with two
//! free ends is two limbs, each up to its middle. Pairs are compatible if, tip to tip, the peninsula is
//! nowhere wider than the bay.
//!
//! # Method
//! The profile of a limb is its radius against the distance from its tip. Profiles are compared at equal
//! distances; the pose that is told turns the way of the peninsula into that of the bay and brings the
//! tips together, up to the gap that is needed. A peninsula goes in as far as it sticks out of the rest of its
//! shape, which stays outside.
//!
//! # Departures
//! The report leaves the search open. What is compared here is width, not bending: a pair is a proposal
//! for a placement, which a nesting program has to try.

use super::branches::branches;
use super::hierarchy::{Hierarchy, HierarchyError};
use super::measure::Measure;
use crate::axis::{Curve, KeypointKind, MedialAxis, Side, bisected};
use crate::domain::Domain;
use crate::geom::{Point, Rect, orient2d};

/// Places at which two profiles are compared.
const PLACES: u32 = 256;

/// A peninsula or a bay.
#[derive(Clone, Debug, PartialEq)]
pub struct Limb {
    /// Inside it is a peninsula, outside a bay.
    pub side: Side,
    /// The curves of the axis, from the mouth to the tip.
    pub curves: Vec<Curve>,
    /// The point of the boundary, or of the last disk, farthest along.
    pub tip: Point,
    /// The middle of the mouth, where it begins.
    pub mouth: Point,
    /// The direction from the mouth to the tip, of length 1.
    pub direction: Point,
    /// The length from the mouth along the axis to the tip, in units of the input.
    pub length: f64,
    /// The distance from mouth to tip as a share of the length: 1 if it is straight.
    pub straightness: f64,
    /// The length from the tip to the line between the points where the boundary is touched at the mouth: that of
    /// what sticks out of the rest, whose disk begins before. In units of the input.
    pub reach: f64,
    /// Distances from the tip along the axis, growing, and the radius there.
    profile: Vec<(f64, f64)>,
}

/// A peninsula and a bay that it fits into.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LimbPair {
    /// Which of the peninsulas.
    pub peninsula: usize,
    /// Which of the bays.
    pub bay: usize,
    /// How far the tip of the peninsula stays away from that of the bay, in units of the input.
    pub gap: f64,
    /// The length of the peninsula within the bay, in units of the input.
    pub depth: f64,
    /// The share of the bay that it fills: the areas under both profiles.
    pub fill: f64,
    /// By what angle the shape of the peninsula is turned, counterclockwise about the origin, in radians.
    pub turn: f64,
    /// By what it is moved after that.
    pub shift: Point,
}

impl Limb {
    /// The width of the mouth, in units of the input.
    #[must_use]
    pub fn mouth_width(&self) -> f64 {
        2.0 * self.radius(self.length)
    }

    /// The radius at a distance from the tip, in units of the input; 0 beyond the tip, that of the mouth
    /// beyond the mouth.
    #[must_use]
    pub fn radius(&self, distance: f64) -> f64 {
        let (Some(&(begin, cap)), Some(&(_, last))) = (self.profile.first(), self.profile.last())
        else {
            return 0.0;
        };
        if distance < begin {
            // The last disk.
            return (distance * (2.0 * cap - distance)).max(0.0).sqrt();
        }
        let next = self.profile.partition_point(|&(t, _)| t < distance);
        let Some(&(after, high)) = self.profile.get(next) else { return last };
        let (before, low) = self.profile[next.saturating_sub(1)];
        if after > before {
            low + (high - low) * (distance - before) / (after - before)
        } else {
            high
        }
    }

    /// The area under its profile up to a distance from the tip, twice.
    fn area(&self, to: f64) -> f64 {
        let step = to / f64::from(PLACES);
        (0..PLACES).map(|k| 2.0 * step * self.radius((f64::from(k) + 0.5) * step)).sum()
    }

    /// The limb along curves from the mouth to the tip, and the points touched at the mouth if they tell where it
    /// begins.
    fn new(
        side: Side,
        curves: Vec<Curve>,
        feet: Option<[Point; 2]>,
        tolerance: f64,
    ) -> Option<Self> {
        let (first, last) = (curves.first()?, curves.last()?);
        let mouth = first.from();
        let way = last.to() - last.control().unwrap_or(last.from());
        let way = if way.norm2() > 0.0 { way * (1.0 / way.norm()) } else { Point::default() };
        let tip = last.to() + way * last.radius_to();
        let mut profile = vec![(last.radius_to(), last.radius_to())];
        let mut along = last.radius_to();
        let is_before = |p: Point| {
            feet.is_some_and(|[a, b]| {
                let (side, of_tip) = (orient2d(a, b, p), orient2d(a, b, tip));
                side > 0.0 && of_tip < 0.0 || side < 0.0 && of_tip > 0.0
            })
        };
        // How far it is from the tip to where the line between the feet is crossed last.
        let mut reach = None;
        for curve in curves.iter().rev() {
            let points = curve.reversed().polyline_in_space(tolerance);
            let chords: f64 = points.windows(2).map(|p| (p[1].0 - p[0].0).norm()).sum();
            // Chords fall short of the curve by a little.
            let stretch = if chords > 0.0 { curve.length() / chords } else { 1.0 };
            for pair in points.windows(2) {
                let way = stretch * (pair[1].0 - pair[0].0).norm();
                if let Some([a, b]) = feet.filter(|_| reach.is_none() && is_before(pair[1].0)) {
                    let [here, there] = [pair[0].0, pair[1].0].map(|p| (b - a).cross(p - a));
                    reach = Some(along + way * (here / (here - there)).clamp(0.0, 1.0));
                }
                along += way;
                profile.push((along, pair[1].1));
            }
        }
        let (chord, length) = (tip - mouth, along);
        let far = chord.norm();
        (far > 0.0 && length > 0.0).then(|| Self {
            side,
            tip,
            mouth,
            direction: chord * (1.0 / far),
            length,
            straightness: (far / length).min(1.0),
            reach: reach.unwrap_or(length),
            profile,
            curves,
        })
    }
}

/// The peninsulas of a shape, from its interior axis, or its bays, from the exterior one; those with the
/// longest way first. What lies below a threshold of a measure is no limb of its own:
/// [`Measure::RelativeExcess`] of 0.5 leaves out corners.
///
/// ```
/// use medial::axis::Engine;
/// use medial::domain::{Domain, Options};
/// use medial::engine::both_sides;
/// use medial::geom::Point;
/// use medial::ops::{Measure, limb_pairs, limbs};
///
/// // A bar with a notch of half its height: a bay, with a key that fits.
/// let notched = [(0., 0.), (9., 0.), (9., 6.), (6., 6.), (6., 2.), (4., 2.), (4., 6.), (0., 6.)];
/// let key = [(0., 0.), (9., 0.), (9., 2.), (0., 2.)];
/// let limbs_of = |ring: &[(f64, f64)]| {
///     let ring = ring.iter().map(|&(x, y)| Point::new(x, y)).collect();
///     let domain = Domain::from_polygons(&[vec![ring]], &Options::default())?;
///     let sides = both_sides(&domain, Engine::PathTracing, None, &Default::default())?;
///     let [inside, outside] = sides.map(|axis| limbs(&domain, &axis, Measure::RelativeExcess, 0.5));
///     Ok::<_, Box<dyn std::error::Error>>((inside?, outside?))
/// };
/// let (_, bays) = limbs_of(&notched)?;
/// let (peninsulas, _) = limbs_of(&key)?;
/// assert_eq!((peninsulas.len(), bays.len()), (2, 1));
/// let pairs = limb_pairs(&peninsulas, &bays);
/// assert_eq!(pairs.len(), 2);
/// assert!(pairs[0].fill > 0.99 && pairs[0].gap < 0.05, "{pairs:?}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If the axis is not complete and exact, or not of this domain.
pub fn limbs(
    domain: &Domain,
    axis: &MedialAxis,
    measure: Measure,
    threshold: f64,
) -> Result<Vec<Limb>, HierarchyError> {
    let pruned = Hierarchy::new(domain, axis)?.pruned(measure, threshold).axis;
    let degrees = pruned.degrees();
    let is_free = |keypoint: u32| {
        degrees[keypoint as usize] == 1
            && pruned.keypoints().at(keypoint).kind != KeypointKind::Clipped
    };
    let hull = hull(domain);
    let bounds = hull.iter().fold(Rect::EMPTY, |all, &p| all.with(p));
    let tolerance = 1e-4 * (bounds.max - bounds.min).norm();
    let mut limbs = Vec::new();
    for branch in branches(&pruned).iter() {
        let ends = [is_free(branch.from()), is_free(branch.to())];
        let feet = |at_end: bool| {
            let banks = branch.boundary().map(|bank| bank.points);
            let foot = |bank: &Vec<Point>| if at_end { bank.last() } else { bank.first() }.copied();
            Some([foot(&banks[0])?, foot(&banks[1])?])
        };
        let ways: Vec<(Vec<Curve>, Option<[Point; 2]>)> = match ends {
            [true, true] => {
                let curves: Vec<Curve> = branch.curves().collect();
                let [first, last] = halves(&curves, 0.5 * branch.extent().length);
                vec![(reversed(first.into_iter()), None), (last, None)]
            }
            [true, false] => vec![(reversed(branch.curves()), feet(true))],
            [false, true] => vec![(branch.curves().collect(), feet(false))],
            [false, false] => continue,
        };
        for (way, feet) in ways {
            limbs.extend(match axis.side {
                Side::Interior => Limb::new(axis.side, way, feet, tolerance),
                // It begins at the hull, or where it leaves a hole.
                Side::Exterior => Limb::new(axis.side, within(&hull, way), None, tolerance),
            });
        }
    }
    limbs.sort_by(|a, b| b.length.total_cmp(&a.length));
    Ok(limbs)
}

/// Pairs of a peninsula and a bay that it fits into with half of its length at least, those that fill most
/// of the bay first.
#[must_use]
pub fn limb_pairs(peninsulas: &[Limb], bays: &[Limb]) -> Vec<LimbPair> {
    let mut pairs = Vec::new();
    for (peninsula, inner) in peninsulas.iter().enumerate() {
        for (bay, outer) in bays.iter().enumerate() {
            let Some(gap) = gap(inner, outer) else { continue };
            let depth = inner.reach.min(outer.length - gap);
            let (from, to) = (inner.direction, outer.direction);
            let turn = from.cross(to).atan2(from.dot(to));
            let (sin, cos) = turn.sin_cos();
            let turned = inner.tip * cos + inner.tip.perp() * sin;
            let shift = outer.tip - to * gap - turned;
            let fill = (inner.area(depth) / outer.area(outer.length)).min(1.0);
            pairs.push(LimbPair { peninsula, bay, gap, depth, fill, turn, shift });
        }
    }
    pairs.sort_by(|a, b| b.fill.total_cmp(&a.fill));
    pairs
}

/// How far from the tip of a bay a peninsula has to stay to be nowhere wider, if half of it is within then.
fn gap(inner: &Limb, outer: &Limb) -> Option<f64> {
    /// Rounding and flattening of profiles, as a share of the width.
    const SLACK: f64 = 1e-3;
    let fits = |gap: f64| {
        let depth = inner.reach.min(outer.length - gap);
        (0..=PLACES).all(|k| {
            let t = depth * f64::from(k) / f64::from(PLACES);
            inner.radius(t) <= outer.radius(t + gap) * (1.0 + SLACK)
        })
    };
    let most = outer.length - 0.5 * inner.reach;
    // What is around the mouth of the peninsula stays outside.
    let least = (outer.length - inner.reach).max(0.0);
    (0..=PLACES)
        .map(|k| least + (most - least) * f64::from(k) / f64::from(PLACES))
        .take_while(|_| most >= least)
        .find(|&g| fits(g))
}

fn reversed(curves: impl DoubleEndedIterator<Item = Curve>) -> Vec<Curve> {
    curves.rev().map(|curve| curve.reversed()).collect()
}

/// The part of a way up to a length, and the rest.
fn halves(curves: &[Curve], length: f64) -> [Vec<Curve>; 2] {
    let mut parts = [Vec::new(), Vec::new()];
    let mut left = length;
    for curve in curves {
        let whole = curve.length();
        if left <= 0.0 {
            parts[1].push(*curve);
        } else if whole <= left {
            parts[0].push(*curve);
        } else {
            let u = curve.parameter_at_length(left);
            parts[0].push(curve.piece(0.0, u));
            parts[1].push(curve.piece(u, 1.0));
        }
        left -= whole;
    }
    parts
}

/// The last part of a way that lies within a convex polygon.
fn within(hull: &[Point], way: Vec<Curve>) -> Vec<Curve> {
    let is_inside = |p: Point| {
        let next = hull.iter().skip(1).chain(hull.first());
        hull.iter().zip(next).all(|(&a, &b)| orient2d(a, b, p) >= 0.0)
    };
    let outside = way.iter().rposition(|curve| !is_inside(curve.from()));
    let Some(outside) = outside else { return way };
    let mut rest = way[outside + 1..].to_vec();
    let curve = way[outside];
    if is_inside(curve.to()) {
        let u = bisected(|u| if is_inside(curve.point_at(u)) { 1.0 } else { -1.0 });
        rest.insert(0, curve.piece(u, 1.0));
    }
    rest
}

/// The convex hull of the corners of a domain, counterclockwise.
fn hull(domain: &Domain) -> Vec<Point> {
    let mut corners: Vec<Point> = domain.edges().iter().map(|edge| edge.start).collect();
    corners.sort_unstable_by(|p, q| p.lexicographic(*q));
    corners.dedup();
    let chain = |points: &mut dyn Iterator<Item = &Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for &p in points {
            while let [.., a, b] = chain[..]
                && orient2d(a, b, p) <= 0.0
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut hull = chain(&mut corners.iter());
    hull.extend(chain(&mut corners.iter().rev()));
    hull
}
