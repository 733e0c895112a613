//! Relative prominence after Ho and Dyer [HD86]: how far what is behind a disk stands out of it, as a share
//! of its radius.
//!
//! # Contract
//! A limb is judged where it grows out of the shape: a bump on a thick part is less prominent than the same
//! bump on a thin one, however sharp its tip. So the value of a point is the least one on the way from there
//! to the root of its tree, and what is removed always includes all behind it.
//!
//! # Method
//! The relative excess is taken at both ends of each path and at its neck, from the leaves inwards; then the
//! least ones are handed on from the roots outwards.

use super::fire::{Step, Way};
use super::hierarchy::{Hierarchy, Limb, NO_FAR, Part, Span};
use super::measure::Measure;
use super::rest::Rest;
use crate::axis::crossing;

/// A path, or the part of one up to the root, in the direction in which it burns.
#[derive(Clone, Copy)]
struct Stretch {
    /// The relative excess where it starts, or at its neck, if that is less.
    start: f64,
    /// That where it ends.
    end: f64,
    /// The least relative excess between its end and the root.
    beyond: f64,
}

impl Stretch {
    /// Where nothing burns.
    const NONE: Self = Self { start: f64::INFINITY, end: f64::INFINITY, beyond: f64::INFINITY };

    fn of(part: &Part, limb: &Limb<'_>) -> Self {
        let value = |u: f64| limb.value(Measure::RelativeExcess, u);
        let neck = limb.neck(part.end).map_or(f64::INFINITY, value);
        let end = value(part.end);
        Self { start: at_start(limb, end).min(neck), end, beyond: f64::INFINITY }
    }

    fn at_end(&self) -> f64 {
        self.end.min(self.beyond)
    }

    fn at_start(&self) -> f64 {
        self.start.min(self.at_end())
    }
}

/// The relative excess where a part starts, given that where it ends.
fn at_start(limb: &Limb<'_>, end: f64) -> f64 {
    let radius = limb.radius(0.0);
    // Out of a corner it is the same all along.
    if radius > 0.0 { limb.excess_at_start() / radius } else { end }
}

/// Where a part is cut that reaches a threshold at its end and not all along from its start, and the excess
/// there.
fn cut(part: &Part, limb: &Limb<'_>, threshold: f64, starts_low: bool) -> Option<(f64, f64)> {
    let value = |u: f64| limb.value(Measure::RelativeExcess, u);
    // The last place where it is too little, if it is enough at the end.
    let (low, high) = match limb.neck(part.end) {
        Some(place) if value(place) < threshold => (place, part.end),
        Some(place) if starts_low => (0.0, place),
        None if starts_low => (0.0, part.end),
        _ => return None,
    };
    let at = |u: f64| low + (high - low) * u;
    let bracket = limb.bracketed(Measure::RelativeExcess, threshold, [low, high]);
    let cut = bracket.map_or_else(|| at(crossing(|u| value(at(u)) - threshold)[1]), |[_, cut]| cut);
    (cut > 0.0).then(|| (cut, limb.value(Measure::Excess, cut)))
}

/// The stretches of all paths.
struct Stretches {
    /// Of each path in the direction in which it burns; of one with a root from its start to there.
    first: Vec<Stretch>,
    /// Paths with a root, and the stretch from the end.
    rooted: Vec<(u32, Stretch)>,
}

/// What is too little along a step.
mod less {
    pub const AT_END: u8 = 1;
    pub const AT_START: u8 = 2;
    pub const AT_NECK: u8 = 4;
}

impl Hierarchy<'_> {
    /// The stretches of all paths.
    fn stretches(&self) -> Stretches {
        let mut all =
            Stretches { first: vec![Stretch::NONE; self.fire.ways.len()], rooted: Vec::new() };
        self.burn(f64::INFINITY, |part, limb, _| {
            let stretch = Stretch::of(part, limb);
            match part.root {
                Some(_) if !part.forwards => all.rooted.push((part.path, stretch)),
                _ => all.first[part.path as usize] = stretch,
            }
            0.0
        });
        // From the roots outwards: each keypoint has one path that leads on.
        let mut least = vec![f64::INFINITY; self.fire.n_places];
        for ((path, second), (_, _, ends)) in all.rooted.iter().zip(&self.fire.both) {
            least[ends[0] as usize] = all.first[*path as usize].at_start();
            least[ends[1] as usize] = second.at_start();
        }
        for (place, step) in self.fire.steps.iter().enumerate().rev() {
            let stretch = &mut all.first[step.dart as usize / 2];
            stretch.beyond = least[step.next as usize];
            least[place] = stretch.at_start();
        }
        all
    }

    /// The values along all paths.
    pub(super) fn prominences(&self, kept: impl Fn(u32) -> [f64; 2]) -> Vec<Span> {
        let Stretches { first, rooted } = self.stretches();
        // Where it was cut the rest is enough.
        let at_start = |stretch: &Stretch, is_cut: bool| {
            if is_cut { stretch.at_end() } else { stretch.at_start() }
        };
        let span = |(path, stretch): (u32, &Stretch)| {
            let [low, high] = kept(path);
            let end = stretch.at_end();
            match self.fire.ways[path as usize] {
                Way::Backwards => {
                    Span { start: end, end: at_start(stretch, high < 1.0), most: end }
                }
                // What lies beyond a root comes below.
                _ => Span { start: at_start(stretch, low > 0.0), end, most: end },
            }
        };
        let mut spans: Vec<Span> = (0..).zip(&first).map(span).collect();
        for (path, second) in &rooted {
            let [_, high] = kept(*path);
            let span = &mut spans[*path as usize];
            span.end = at_start(second, high < 1.0);
            span.most = span.most.max(second.at_end());
        }
        spans
    }

    /// What is left if all that is less prominent than a threshold is removed, and what is lost up to
    /// keypoints.
    ///
    /// Whether a value is enough shows mostly by a corner that was far before.
    pub(super) fn without_less_prominent(&self, threshold: f64) -> (Rest<'_>, Vec<(u32, f64)>) {
        let mut rest = Rest::of(self.axis);
        let mut lost: Vec<(u32, f64)> = Vec::new();
        if threshold.is_nan() || threshold <= 0.0 {
            return (rest, lost);
        }
        let n = self.fire.n_places;
        let mut fars = vec![NO_FAR; n];
        // Whether the value at a keypoint is enough, as that of something that ends there is.
        let mut is_enough = vec![false; n];
        let mut is_less = Vec::with_capacity(self.fire.steps.len());
        // Out of a corner it is the same all along.
        let starts_low = |is_enough: bool, step: &Step| !is_enough && self.disk(step.from).1 > 0.0;
        for (place, step) in self.fire.steps.iter().enumerate() {
            let next = step.next as usize;
            let (centre, radius) = self.disk(step.to);
            let value = |distance2: f64| ((distance2.sqrt() - radius) / radius).max(0.0);
            let known = fars[place].1;
            let mut far = (0.0, known);
            if known != NO_FAR.1 {
                far.0 = self.distance2(known, centre);
            }
            if known == NO_FAR.1 || value(far.0) < threshold {
                far = self.farthest_behind(step, centre, known);
            }
            let mut less = 0;
            if value(far.0) < threshold {
                less |= less::AT_END;
            } else {
                is_enough[next] = true;
                if starts_low(is_enough[place], step) {
                    less |= less::AT_START;
                } else if self.may_have_neck(step)
                    && !self.is_far_all_along(step, far.0.sqrt(), threshold)
                    && self.is_less_at_neck(&self.limb(step, 0.0, far), 1.0, threshold)
                {
                    less |= less::AT_NECK;
                }
            }
            is_less.push(less);
            if far.0 > fars[next].0 {
                fars[next] = far;
            }
        }
        // From the roots outwards: each keypoint has one path that leads on.
        let mut ends_low = vec![false; n];
        let mut rooted = Vec::new();
        for (part, step, place) in self.rooted() {
            let place = place as usize;
            let limb = self.limb(&step, 0.0, fars[place]);
            let end = limb.value(Measure::RelativeExcess, part.end);
            let starts_low = starts_low(is_enough[place], &step);
            ends_low[place] =
                end < threshold || starts_low || self.is_less_at_neck(&limb, part.end, threshold);
            rooted.push((part, step, place, end, starts_low));
        }
        for (place, (step, &less)) in self.fire.steps.iter().zip(&is_less).enumerate().rev() {
            let is_lost = less == less::AT_END || ends_low[step.next as usize];
            ends_low[place] = is_lost || less != 0;
            if !ends_low[place] {
                continue;
            }
            let (path, forwards) = (step.dart / 2, step.dart.is_multiple_of(2));
            if is_lost {
                let (centre, radius) = self.disk(step.to);
                let far = self.farthest_behind(step, centre, fars[place].1);
                let value = ((far.0.sqrt() - radius) / radius).max(0.0);
                lost.push((step.to, value * radius));
                rest.remove(path);
                continue;
            }
            let limb = self.limb(step, 0.0, fars[place]);
            let part = Part { path, forwards, from: step.from, to: step.to, end: 1.0, root: None };
            if let Some((cut, excess)) = cut(&part, &limb, threshold, less == less::AT_START) {
                rest.error = rest.error.max(excess);
                rest.cut(path, forwards, if forwards { cut } else { 1.0 - cut });
            }
        }
        for (part, step, place, end, starts_low) in &rooted {
            let along = |u: f64| if part.forwards { u } else { 1.0 - u };
            let limb = self.limb(step, 0.0, fars[*place]);
            if *end < threshold {
                // Up to one root from both sides.
                rest.error = rest.error.max(end * limb.radius(part.end));
                rest.cut(part.path, part.forwards, part.root.unwrap_or_else(|| along(1.0)));
            } else if ends_low[*place]
                && let Some((cut, excess)) = cut(part, &limb, threshold, *starts_low)
            {
                rest.error = rest.error.max(excess);
                rest.cut(part.path, part.forwards, along(cut));
            }
        }
        (rest, lost)
    }

    fn is_less_at_neck(&self, limb: &Limb<'_>, end: f64, threshold: f64) -> bool {
        let neck = limb.neck(end);
        neck.is_some_and(|neck| limb.value(Measure::RelativeExcess, neck) < threshold)
    }

    /// Whether a corner behind that is so far from the end of a path is far enough from all of it, for sure:
    /// at a neck the radius is less than at the end.
    fn is_far_all_along(&self, step: &Step, far: f64, threshold: f64) -> bool {
        /// Far more than all rounding, as a factor.
        const SURE: f64 = 2.0;
        let length = self.fire.lengths[step.dart as usize / 2];
        far - length > SURE * (1.0 + threshold) * self.disk(step.to).1
    }
}
