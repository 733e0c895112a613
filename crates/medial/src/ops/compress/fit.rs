//! Chains with as few straight pieces as stay near them, in space: with the radius as height.

use super::chains::Step;
use super::disk_graph::{GridDisk, Run};
use crate::axis::{MedialAxis, Path};
use crate::geom::Point;

/// Tolerance of sampled curves in space, as a share of what there is for straight pieces.
///
/// Size only: it is taken off the rest, and smaller ones make more points to look at.
const SAMPLING_SHARE: f64 = 1.0 / 24.0;

/// Points of a polyline from which on it is as fine as polylines get, but not as was asked for.
const MOST_POINTS: usize = 65_537;

/// A disk of a chain: centre and radius.
type Sample = (Point, f64);

/// How near the pieces must stay to the chains.
pub(super) struct Tolerance {
    /// A step of the grid.
    step: f64,
    /// `δ` of the module above.
    delta: f64,
    /// Tolerance of sampled curves in space.
    sampling: f64,
    /// What sampling and rounding may add to `|c - c'| + |r - r'|`.
    blur: f64,
    /// The radius below which pieces have none: at any larger one (inside) can be had on the grid.
    thin: f64,
}

/// All disks, and how they are linked.
pub(super) struct Fitted {
    pub disks: Vec<GridDisk>,
    pub runs: Vec<Run>,
    /// The largest `|c - c'| + r - r'` that occurs, at most `δ`.
    pub error: f64,
}

impl Tolerance {
    /// `None` if nothing is left once the grid and what else is uncertain are taken off.
    pub fn new(exponent: i32, delta: f64, rounding: f64) -> Option<Self> {
        let step = 2.0_f64.powi(exponent);
        let sampling = SAMPLING_SHARE * delta;
        // Plane and height are off by 1/√2 of the tolerance each, or the height alone by all of it.
        let blur = std::f64::consts::SQRT_2 * sampling + rounding;
        let thin = std::f64::consts::FRAC_1_SQRT_2 * step + blur;
        let tolerance = Self { step, delta, sampling, blur, thin };
        // A centre is off by 1/√2 of a step, a radius by half a step.
        (thin + 0.5 * step <= 0.5 * delta).then_some(tolerance)
    }

    /// The disk on the grid that stands for one of a chain where a piece begins or ends.
    fn disk(&self, (centre, radius): Sample) -> GridDisk {
        let steps = |value: f64| (value / self.step).round() as i64;
        let radius = if radius < self.thin { 0 } else { steps(radius - 0.5 * self.delta).max(0) };
        GridDisk { x: steps(centre.x), y: steps(centre.y), radius }
    }

    fn sample(&self, disk: GridDisk) -> Sample {
        let [x, y, radius] = [disk.x, disk.y, disk.radius].map(|steps| steps as f64 * self.step);
        (Point::new(x, y), radius)
    }

    /// `|c - c'| + r - r'` at a disk of a chain and the one that belongs to it on a piece, if that is
    /// as near as it must be.
    fn error(&self, sample: Sample, piece: [Sample; 2]) -> Option<f64> {
        let [a, b] = piece;
        let (along, rise) = (b.0 - a.0, b.1 - a.1);
        let off = (sample.0 - a.0).dot(along) + (sample.1 - 0.5 * self.delta - a.1) * rise;
        let share = off / (along.norm2() + rise * rise);
        let share = if share.is_nan() { 0.0 } else { share.clamp(0.0, 1.0) };
        let away = (sample.0 - (a.0 + along * share)).norm();
        let shrunk = sample.1 - (a.1 + rise * share);
        // Points need not lie inside.
        let is_point = a.1 == 0.0 && b.1 == 0.0 && sample.1 <= self.thin;
        let inside = is_point || away + self.blur <= shrunk;
        let error = away + shrunk + self.blur;
        (inside && error <= self.delta).then_some(error)
    }
}

/// Disks for all steps of the way through an axis; `None` if curves cannot be sampled finely enough.
pub(super) fn fitted(axis: &MedialAxis, way: &[Step], tolerance: &Tolerance) -> Option<Fitted> {
    let mut fit = Fit {
        tolerance,
        numbers: vec![None; axis.keypoints().len()],
        fitted: Fitted { disks: Vec::new(), runs: Vec::new(), error: 0.0 },
    };
    for step in way {
        match step {
            Step::Begin(keypoint) => {
                let begin = axis.keypoints().at(*keypoint);
                let sample = (begin.position, begin.radius);
                fit.fitted.runs.push(Run { from: None, len: 0, to: None });
                fit.keep(sample);
                fit.numbers[*keypoint as usize] = fit.last();
                fit.check(sample, [sample; 2].map(|s| tolerance.sample(tolerance.disk(s))));
            }
            Step::Chain(paths) => {
                let samples = samples(axis, paths, tolerance)?;
                fit.chain(paths, &samples)?;
            }
        }
    }
    Some(fit.fitted)
}

/// The points of a chain, its sharpest bends and both ends included, and those where it gets thin.
fn samples(axis: &MedialAxis, paths: &[Path], tolerance: &Tolerance) -> Option<Vec<Sample>> {
    let mut samples: Vec<Sample> = Vec::new();
    for path in paths {
        let points = axis.curve(path).polyline_in_space(tolerance.sampling);
        if points.len() >= MOST_POINTS {
            return None;
        }
        for point in points {
            if let Some(&last) = samples.last() {
                if last == point {
                    continue;
                }
                if (last.1 < tolerance.thin) != (point.1 < tolerance.thin) {
                    let share = (tolerance.thin - last.1) / (point.1 - last.1);
                    let at = last.0 + (point.0 - last.0) * share;
                    samples.push((at, tolerance.thin));
                }
            }
            samples.push(point);
        }
    }
    Some(samples)
}

struct Fit<'a> {
    tolerance: &'a Tolerance,
    /// The disks of keypoints that were met.
    numbers: Vec<Option<u32>>,
    fitted: Fitted,
}

impl Fit<'_> {
    /// The number of the last disk.
    fn last(&self) -> Option<u32> {
        (self.fitted.disks.len() as u32).checked_sub(1)
    }

    /// Adds a disk to the last run.
    fn keep(&mut self, sample: Sample) {
        self.fitted.disks.push(self.tolerance.disk(sample));
        if let Some(run) = self.fitted.runs.last_mut() {
            run.len += 1;
        }
    }

    /// Takes note of how far a disk and a piece are apart; whether that is near enough.
    fn check(&mut self, sample: Sample, piece: [Sample; 2]) -> bool {
        let error = self.tolerance.error(sample, piece);
        self.fitted.error = self.fitted.error.max(error.unwrap_or(self.tolerance.delta));
        error.is_some()
    }

    /// Whether a straight piece between the disks for two samples stays near all between them.
    fn is_near(&self, samples: &[Sample]) -> bool {
        let [a, .., b] = samples else { return true };
        let piece = [*a, *b].map(|end| self.tolerance.sample(self.tolerance.disk(end)));
        // Those in the middle are off first.
        let (before, after) = samples.split_at(samples.len() / 2);
        let mut all = after.iter().chain(before);
        all.all(|&sample| self.tolerance.error(sample, piece).is_some())
    }

    /// Adds the pieces of a chain, and its end if that is new.
    fn chain(&mut self, paths: &[Path], samples: &[Sample]) -> Option<()> {
        let from = self.numbers[paths.first()?.from as usize]?;
        let goes_on = self.last() == Some(from)
            && self.fitted.runs.last().is_some_and(|run| run.to.is_none());
        if !goes_on {
            self.fitted.runs.push(Run { from: Some(from), len: 0, to: None });
        }
        let end = paths.last()?.to as usize;
        let is_thin = |sample: &Sample| sample.1 == self.tolerance.thin;
        let mut first = 0;
        while first + 1 < samples.len() {
            // A place where the chain gets thin is one of a disk.
            let rest = &samples[first..];
            let bound = rest.iter().skip(1).position(is_thin).map_or(rest.len() - 1, |k| k + 1);
            let reach = farthest(bound, |k| self.is_near(&rest[..=k]));
            let piece = [rest[0], rest[reach]];
            let piece = piece.map(|end| self.tolerance.sample(self.tolerance.disk(end)));
            for &sample in &rest[..=reach] {
                self.check(sample, piece);
            }
            first += reach;
            if first + 1 < samples.len() {
                self.keep(samples[first]);
            }
        }
        match self.numbers[end] {
            None => {
                self.keep(*samples.last()?);
                self.numbers[end] = self.last();
            }
            to => self.fitted.runs.last_mut()?.to = to,
        }
        Some(())
    }
}

/// A number from 1 to a bound up to which something holds, found with few questions, none of them about 1.
fn farthest(bound: usize, holds: impl Fn(usize) -> bool) -> usize {
    let (mut good, mut bad) = (1, bound + 1);
    while 2 * good < bad && holds(2 * good) {
        good *= 2;
    }
    bad = bad.min(2 * good);
    while bad - good > 1 {
        let middle = good + (bad - good) / 2;
        if holds(middle) {
            good = middle;
        } else {
            bad = middle;
        }
    }
    good
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_farthest_number_is_found() {
        for bound in 1..20 {
            for last in 1..=bound {
                assert_eq!(farthest(bound, |k| k <= last), last, "{last} of {bound}");
            }
        }
    }

    #[test]
    fn disks_of_the_grid_are_near_and_inside() {
        let tolerance = Tolerance::new(-3, 1.0, 0.0).unwrap();
        for k in 0..1000 {
            let k = f64::from(k);
            let sample = (Point::new(0.37 * k, -0.73 * k), tolerance.thin + 0.011 * k);
            let disk = tolerance.sample(tolerance.disk(sample));
            assert!(tolerance.error(sample, [disk; 2]).is_some(), "{sample:?} {disk:?}");
        }
        assert_eq!(tolerance.disk((Point::default(), 0.99 * tolerance.thin)).radius, 0);
        assert!(Tolerance::new(-1, 1.0, 0.0).is_none());
    }
}
