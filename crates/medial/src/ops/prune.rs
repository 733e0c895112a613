//! What is left of an axis above a threshold of a measure.
//!
//! # Contract
//! All that lies below is removed, from the leaves inwards, and cut where the threshold is reached, rounded: no
//! more than it is lost.
//!
//! # Method
//! Along the way of the fire. Whether a value by the farthest corner behind is enough mostly shows by one that
//! was far before; only where it is not all of them are asked.

use super::hierarchy::{Hierarchy, Limb, NO_FAR, NONE, Part};
use super::measure::Measure;
use super::rest::{Pruned, Rest};
use crate::axis::MedialAxis;

impl Hierarchy<'_> {
    /// What is left if all that lies below a threshold is removed, from the leaves inwards.
    ///
    /// With [`Measure::Excess`] the threshold bounds the error.
    #[must_use]
    pub fn pruned(&self, measure: Measure, threshold: f64) -> Pruned {
        let (rest, lost) = self.rest(measure, threshold);
        rest.finish(&self.fire.roots, &lost)
    }

    /// What a threshold leaves, and what is lost up to keypoints.
    pub(super) fn rest(&self, measure: Measure, threshold: f64) -> (Rest<'_>, Vec<(u32, f64)>) {
        match measure {
            Measure::Prominence => return self.without_less_prominent(threshold),
            Measure::Excess | Measure::RelativeExcess if threshold > 0.0 => {
                return self.rest_by_far(measure, threshold);
            }
            _ => {}
        }
        let mut cuts = Cuts::of(self.axis);
        self.burn(threshold, |part, limb, before| cuts.add(measure, threshold, part, limb, before));
        (cuts.rest, cuts.lost)
    }

    /// The same for measures by the farthest corner behind: mostly one that was far before is far enough.
    fn rest_by_far(&self, measure: Measure, threshold: f64) -> (Rest<'_>, Vec<(u32, f64)>) {
        let n = self.fire.n_places;
        let mut is_reached = vec![false; n];
        let mut fars = vec![NO_FAR; n];
        let mut cuts = Cuts::of(self.axis);
        for (place, step) in self.fire.steps.iter().enumerate() {
            let next = step.next as usize;
            if is_reached[place] {
                is_reached[next] = true;
                continue;
            }
            let (centre, radius) = self.disk(step.to);
            let excess = |distance2: f64| (distance2.sqrt() - radius).max(0.0);
            let value = |distance2: f64| match measure {
                Measure::Excess => excess(distance2),
                _ => ((distance2.sqrt() - radius) / radius).max(0.0),
            };
            let known = fars[place].1;
            let mut is_enough = known != NONE && value(self.distance2(known, centre)) >= threshold;
            let mut far = fars[place];
            if !is_enough {
                far = self.farthest_behind(step, centre, known);
                is_enough = value(far.0) >= threshold;
            }
            if !is_enough && self.may_have_neck(step) {
                let limb = self.limb(step, 0.0, fars[place]);
                let neck = limb.neck(1.0);
                is_enough = neck.is_some_and(|neck| limb.value(measure, neck) >= threshold);
            }
            let (path, forwards) = (step.dart / 2, step.dart.is_multiple_of(2));
            if is_enough {
                is_reached[next] = true;
                let limb = self.limb(step, 0.0, far);
                let part =
                    Part { path, forwards, from: step.from, to: step.to, end: 1.0, root: None };
                cuts.add_reached(measure, threshold, &part, &limb);
                continue;
            }
            cuts.lost.push((step.to, excess(far.0)));
            cuts.rest.remove(path);
            if far.0 > fars[next].0 {
                fars[next] = far;
            }
        }
        for (part, step, place) in self.rooted() {
            let place = place as usize;
            if !is_reached[place] {
                cuts.add(measure, threshold, &part, &self.limb(&step, 0.0, fars[place]), 0.0);
            }
        }
        (cuts.rest, cuts.lost)
    }
}

/// What a threshold leaves so far.
struct Cuts<'a> {
    rest: Rest<'a>,
    /// What is lost at a keypoint, if that is kept.
    lost: Vec<(u32, f64)>,
}

impl<'a> Cuts<'a> {
    fn of(axis: &'a MedialAxis) -> Self {
        Self { rest: Rest::of(axis), lost: Vec::new() }
    }

    /// Removes what is below a threshold of a part on which the largest value before is given; gives the
    /// largest value up to its end.
    fn add(
        &mut self,
        measure: Measure,
        threshold: f64,
        part: &Part,
        limb: &Limb<'_>,
        before: f64,
    ) -> f64 {
        let first = before.max(limb.first(measure));
        if first >= threshold {
            return first;
        }
        let last = first.max(limb.most(measure, part.end));
        if last < threshold {
            self.remove(part, limb, part.end, true);
        } else {
            self.remove(part, limb, limb.reached(measure, threshold, part.end), false);
        }
        last
    }

    /// The same for a part on which the threshold is reached for sure.
    fn add_reached(&mut self, measure: Measure, threshold: f64, part: &Part, limb: &Limb<'_>) {
        if limb.first(measure) < threshold {
            self.remove(part, limb, limb.reached(measure, threshold, part.end), false);
        }
    }

    /// Removes a part up to a parameter, which may be all of it.
    fn remove(&mut self, part: &Part, limb: &Limb<'_>, cut: f64, is_lost: bool) {
        let excess = limb.value(Measure::Excess, cut);
        if is_lost && part.root.is_none() {
            self.lost.push((part.to, excess));
        } else {
            self.rest.error = self.rest.error.max(excess);
        }
        let along = if part.forwards { cut } else { 1.0 - cut };
        let along = part.root.filter(|_| is_lost).unwrap_or(along);
        self.rest.cut(part.path, part.forwards, along);
    }
}
