//! What the axis of flattened curves has that the axis of the curves has not.
//!
//! # Contract
//! Given a complete exact axis of a domain whose edges were flattened from curves: what is left of it is
//! the axis of the curves, within the tolerance of flattening. A circle leaves a point, an ellipse the
//! segment between two centres of curvature, a rounded corner ends in its centre. Whatever a true corner
//! of the shape holds up stays. Cuts lie inside paths; components and cycles stay.
//!
//! # Method
//! From the leaves inwards, as for pruning:
//! 1. A disk of the curved shape touches a piece of monotone curvature once. So a path goes if the boundary
//!    behind it, between its governors, is a part of one piece.
//! 2. If the boundary behind passes joints, and the curve is smooth in all of them, the axis ends where
//!    the radius is that of the sharpest bend there: what has a smaller radius goes, less the tolerance, by
//!    which walls have moved. The same holds for arcs of circles, which touch all along.
//! 3. What is left at a fillet are stubs, since flattening has moved the wall: paths go of which all is
//!    within the tolerance, if all that was behind has gone. Of the branch of a corner all goes up to the
//!    next junction, or nothing: a corner so flat that it moves no wall by more than the tolerance.
//!
//! # Departures
//! None of [the rules](crate::domain::Curves); cuts are made for the second one only, so that the third
//! one takes nothing of what is true.

use std::collections::BTreeMap;

use super::hierarchy::Hierarchy;
use super::measure::Measure;
use super::rest::{Pruned, Rest};
use crate::domain::{Corner, Curves, Domain, PieceEnd};
use crate::geom::Point;

/// The angle between tangents up to which a curve is smooth where two of its pieces meet: coordinates of
/// drawings are rounded. 2 degrees.
const SMOOTH: f64 = 0.035;

/// By how much more than the tolerance something may be off, as a share of it: it is rounded.
const ROUNDING: f64 = 1e-6;

/// What the boundary does where an edge starts.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Joint {
    /// It goes on along one piece of a curve, or straight.
    Within,
    /// From one piece to another one without a corner, with the larger curvature of the two, or along an
    /// arc of a circle; positive where the interior is inside the bend.
    Smooth(f64),
    /// It has a corner.
    Rough,
}

/// The joints of a domain.
struct Joints {
    joints: Vec<Joint>,
    /// How many corners there are up to each edge, it included, and how many of them are convex.
    rough: Vec<[u32; 2]>,
}

impl Hierarchy<'_> {
    /// What is left without the artefacts of flattened curves, and above a threshold if there is one.
    ///
    /// `polygons` are those that the domain was made of, with their curves.
    #[must_use]
    pub fn without_artefacts(
        &self,
        polygons: &[Vec<Vec<Point>>],
        curves: &Curves,
        threshold: Option<(Measure, f64)>,
    ) -> Pruned {
        let joints = Joints::of(self.domain(), polygons, curves);
        let tolerance = curves.tolerance * (1.0 + ROUNDING);
        let (mut rest, mut lost) = self.smooth_rest(&joints, tolerance);
        if let Some((measure, value)) = threshold {
            let (other, more) = match measure {
                Measure::Prominence => {
                    (Rest::again(self.axis, &self.pruned(measure, value)), Vec::new())
                }
                _ => self.rest(measure, value),
            };
            rest.and(other);
            lost.extend(more);
        }
        rest.finish(&self.fire.roots, &lost)
    }

    fn smooth_rest(&self, joints: &Joints, tolerance: f64) -> (Rest<'_>, Vec<(u32, f64)>) {
        let mut rest = Rest::of(self.axis);
        let n = self.axis.keypoints().len();
        // Whether anything stays that ends in a keypoint, and the largest curvature at joints behind.
        let mut stays = vec![false; n];
        let mut bends = vec![f64::NEG_INFINITY; n];
        let mut lost = Vec::new();
        // What goes from a corner up to a keypoint, if more goes beyond it.
        let mut waiting: BTreeMap<u32, Vec<Cut>> = BTreeMap::new();
        let degree = self.axis.degrees();
        self.each_part(|part, limb| {
            let (from, to) = (part.from as usize, part.to as usize);
            if stays[from] {
                stays[to] = true;
                return;
            }
            let mut bend = bends[from];
            let (first, last) = limb.corners();
            if limb.radius(0.0) == 0.0
                && first == last
                && let Joint::Smooth(curvature) = joints.joints[first as usize]
            {
                bend = bend.max(curvature);
            }
            let corners = joints.corners(self.domain(), (first, last));
            // How much of it goes.
            let gone = if corners[0] > 0 {
                0.0
            } else if bend <= 0.0 {
                // Of one piece, or hollow all along.
                part.end
            } else {
                limb.reaches(1.0 / bend - tolerance, part.end).unwrap_or(part.end)
            };
            // What is left of a fillet.
            let is_stub = gone < part.end && limb.value(Measure::Excess, part.end) <= tolerance;
            let gone = if is_stub { part.end } else { gone };
            let is_gone = gone == part.end;
            let mut before = waiting.remove(&part.from).unwrap_or_default();
            if gone > 0.0 {
                let along = if part.forwards { gone } else { 1.0 - gone };
                let along = part.root.filter(|_| is_gone).unwrap_or(along);
                let excess = limb.value(Measure::Excess, gone);
                let goes_to = (is_gone && part.root.is_none()).then_some(part.to);
                let cut =
                    Cut { path: part.path, forwards: part.forwards, along, excess, to: goes_to };
                let is_on_its_way = goes_to.is_some() && degree[to] == 2;
                before.push(cut);
                if corners[1] > 0 && is_on_its_way {
                    waiting.insert(part.to, before);
                } else if corners[1] == 0 || is_gone {
                    for cut in before {
                        rest.cut(cut.path, cut.forwards, cut.along);
                        match cut.to {
                            Some(to) => lost.push((to, cut.excess)),
                            None => rest.error = rest.error.max(cut.excess),
                        }
                    }
                }
            }
            stays[to] |= !is_gone;
            bends[to] = bends[to].max(bend);
        });
        (rest, lost)
    }
}

/// What goes of a path.
struct Cut {
    path: u32,
    forwards: bool,
    /// The parameter up to which it goes.
    along: f64,
    excess: f64,
    /// The keypoint up to which it goes.
    to: Option<u32>,
}

impl Joints {
    fn of(domain: &Domain, polygons: &[Vec<Vec<Point>>], curves: &Curves) -> Self {
        let edges = domain.edges();
        let n = edges.len() as u32;
        let joints: Vec<Joint> = (0..n).map(|edge| joint(domain, polygons, curves, edge)).collect();
        let mut rough = Vec::with_capacity(edges.len());
        let mut sum = [0, 0];
        for (joint, edge) in joints.iter().zip(edges) {
            if *joint == Joint::Rough {
                sum[0] += 1;
                sum[1] += u32::from(edge.corner == Corner::Convex);
            }
            rough.push(sum);
        }
        Self { joints, rough }
    }

    /// How many corners there are in a cyclic range of a walk, its ends included, and how many convex ones.
    fn corners(&self, domain: &Domain, (first, last): (u32, u32)) -> [u32; 2] {
        let up_to = |k: u32| self.rough[k as usize];
        let before = |k: u32| k.checked_sub(1).map_or([0, 0], up_to);
        let between = |a: u32, b: u32| [0, 1].map(|k| up_to(b)[k] - before(a)[k]);
        if first <= last {
            return between(first, last);
        }
        let walk = domain.walks()[domain.edge(first).walk as usize].edges();
        let (a, b) = (between(first, walk.end - 1), between(walk.start, last));
        [a[0] + b[0], a[1] + b[1]]
    }
}

/// What the boundary does where an edge starts.
fn joint(domain: &Domain, polygons: &[Vec<Vec<Point>>], curves: &Curves, edge: u32) -> Joint {
    let before = domain.edge(edge).prev;
    if domain.edge(edge).corner == Corner::Straight {
        return Joint::Within;
    }
    let sides = [before, edge].map(|edge| Side::of(domain, polygons, curves, edge));
    let [Some(into), Some(out)] = sides else { return Joint::Rough };
    // Between two edges as given, which follow one another.
    let follow = |a: &Side, b: &Side| {
        let ring = &polygons[a.polygon][a.ring];
        let n = ring.len() - usize::from(ring.len() > 1 && ring.first() == ring.last());
        (a.polygon, a.ring) == (b.polygon, b.ring) && (a.index + 1) % n == b.index
    };
    let is_next = if into.along { follow(&into, &out) } else { follow(&out, &into) };
    if into.along != out.along || !is_next || domain.origin(edge).corner.part > 0 {
        return Joint::Rough;
    }
    let is_start_of_ring = if into.along { out.index == 0 } else { into.index == 0 };
    if into.piece == out.piece && into.piece.is_some() && !is_start_of_ring {
        let [start, end] = [false, true].map(|is_end| into.end(curves, is_end).curvature);
        let is_arc = (start - end).abs() <= ROUNDING * start.abs();
        return if is_arc { Joint::Smooth(start) } else { Joint::Within };
    }
    let [a, b] = [into.end(curves, true), out.end(curves, false)];
    let angle = a.tangent.cross(b.tangent).abs();
    let is_smooth = angle <= SMOOTH && a.tangent.dot(b.tangent) > 0.0;
    // Two straight edges meet in a corner, however flat.
    if is_smooth && (into.piece.is_some() || out.piece.is_some()) {
        Joint::Smooth(a.curvature.max(b.curvature))
    } else {
        Joint::Rough
    }
}

/// An edge as it was given.
struct Side {
    polygon: usize,
    ring: usize,
    index: usize,
    piece: Option<u32>,
    /// Whether it runs as it was given.
    along: bool,
    direction: Point,
}

impl Side {
    fn of(
        domain: &Domain,
        polygons: &[Vec<Vec<Point>>],
        curves: &Curves,
        edge: u32,
    ) -> Option<Self> {
        let origin = domain.origin(edge);
        let (polygon, number) = (origin.polygon as usize, origin.ring as usize);
        let ring = polygons.get(polygon)?.get(number)?;
        let index = origin.index as usize;
        let (from, to) = (*ring.get(index)?, ring[(index + 1) % ring.len()]);
        let direction = domain.edge(edge).direction;
        let along = (to - from).dot(direction) > 0.0;
        let piece = curves.piece_of(&origin);
        Some(Self { polygon, ring: number, index, piece, along, direction })
    }

    /// The curve at the end of the edge, or at its start, as the boundary runs.
    fn end(&self, curves: &Curves, is_end: bool) -> PieceEnd {
        let piece = self.piece.and_then(|piece| curves.pieces.get(piece as usize));
        let Some(piece) = piece else {
            return PieceEnd { tangent: self.direction, curvature: 0.0 };
        };
        let PieceEnd { tangent, curvature } =
            if is_end == self.along { piece.end } else { piece.start };
        if self.along {
            PieceEnd { tangent, curvature }
        } else {
            PieceEnd { tangent: -tangent, curvature: -curvature }
        }
    }
}
