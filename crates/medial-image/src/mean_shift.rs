//! Mean shift in the joint domain of places and colours \[CM02\].
//!
//! # Contract
//! Each pixel with data is in one region; regions are connected, and have at least so many pixels unless they
//! have no neighbours. The result does not depend on the number of threads. Time is that of some windows for each
//! pixel.
//!
//! # Method
//! 1. From each pixel move to the mean, of place and colour at once, of the pixels within both radii, until that
//!    rests (flat kernel).
//! 2. Join neighbours whose modes are within both radii.
//! 3. Join regions that are too small to the neighbour that is most alike.
//!
//! # Departures
//! None in the result of a step; whole rows go to one thread each.

use crate::field::{Field, squared};
use crate::labels::Labels;
use crate::merging::merge_small;
use std::num::NonZeroUsize;
use std::sync::Mutex;
use std::sync::PoisonError;

/// How [`mean_shift`] works.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Filter {
    /// The radius in the image, in pixels.
    pub spatial: f32,
    /// The radius among the values.
    pub range: f32,
    /// The least number of pixels of a region.
    pub min_region: u64,
    /// Threads that share the work.
    pub threads: NonZeroUsize,
}

impl Default for Filter {
    /// The radii and the least region of \[CM02\].
    fn default() -> Self {
        Self { spatial: 7.0, range: 6.5, min_region: 20, threads: NonZeroUsize::MIN }
    }
}

/// Where a pixel comes to rest.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Mode {
    place: [f32; 2],
    value: [f32; 3],
}

/// A search rests when the square of a step, in radii, is less.
const REST: f32 = 1e-4;

/// Most steps of a search.
const MOST_STEPS: usize = 100;

/// The regions of an image by mean shift.
#[must_use]
pub fn mean_shift(field: &Field, filter: &Filter) -> Labels {
    mean_shift_with(field, filter, &|| {})
}

/// The same, which calls something whenever the pixels of one more row have come to rest: that takes nearly all of the
/// time.
#[must_use]
pub fn mean_shift_with(field: &Field, filter: &Filter, done: &(dyn Fn() + Sync)) -> Labels {
    let modes = modes(field, filter, done);
    let class: Vec<u32> =
        (0..modes.len()).map(|k| if field.is_known(k) { 0 } else { Labels::NONE }).collect();
    let joined = |a: usize, b: usize| {
        let (a, b) = (&modes[a], &modes[b]);
        let [dx, dy] = [0, 1].map(|axis| a.place[axis] - b.place[axis]);
        dx * dx + dy * dy < filter.spatial * filter.spatial
            && squared(a.value, b.value) < filter.range * filter.range
    };
    let labels = Labels::connected(*field.grid(), &class, joined);
    merge_small(labels, field, filter.min_region)
}

/// The values that the pixels come to: the image smoothed, with its edges.
#[must_use]
pub fn filtered(field: &Field, filter: &Filter) -> Vec<[f32; 3]> {
    modes(field, filter, &|| {}).into_iter().map(|mode| mode.value).collect()
}

fn modes(field: &Field, filter: &Filter, done: &(dyn Fn() + Sync)) -> Vec<Mode> {
    let columns = field.grid().columns as usize;
    let mut modes = vec![Mode { place: [0.0; 2], value: [f32::NAN; 3] }; field.values().len()];
    if columns == 0 {
        return modes;
    }
    let planes = Planes::new(field);
    let rows = Mutex::new(modes.chunks_exact_mut(columns).enumerate());
    let work = || {
        loop {
            let next = rows.lock().unwrap_or_else(PoisonError::into_inner).next();
            let Some((y, row)) = next else { break };
            for (x, mode) in row.iter_mut().enumerate() {
                if field.is_known(y * columns + x) {
                    let value = field.values()[y * columns + x];
                    *mode = planes.mode_of(Mode { place: [x as f32, y as f32], value }, filter);
                }
            }
            done();
        }
    };
    std::thread::scope(|scope| {
        (1..filter.threads.get()).for_each(|_| {
            scope.spawn(work);
        });
        work();
    });
    modes
}

/// Pixels that are looked at together.
const LANES: usize = 8;

/// Stands for no number: farther from all values than any radius, and 0 times it is 0.
const FAR: f32 = 1e18;

/// The values of a field, each of the three by itself, with room behind each row.
struct Planes {
    columns: usize,
    rows: usize,
    /// From one row to the next.
    stride: usize,
    values: [Vec<f32>; 3],
}

/// Sums over pixels within both radii, lane by lane.
#[derive(Clone, Copy, Default)]
struct Sums {
    n: [f32; LANES],
    x: [f32; LANES],
    y: [f32; LANES],
    values: [[f32; LANES]; 3],
}

impl Planes {
    fn new(field: &Field) -> Self {
        let (columns, rows) = (field.grid().columns as usize, field.grid().rows as usize);
        let stride = columns + LANES;
        let plane = |axis: usize| {
            let mut plane = vec![FAR; rows * stride];
            let given = field.values().chunks_exact(columns);
            for (own, row) in plane.chunks_exact_mut(stride).zip(given) {
                for (own, value) in own.iter_mut().zip(row).filter(|(_, v)| v[axis].is_finite()) {
                    *own = value[axis];
                }
            }
            plane
        };
        Self { columns, rows, stride, values: [0, 1, 2].map(plane) }
    }

    /// Moves from a pixel to where it rests.
    fn mode_of(&self, mut mode: Mode, filter: &Filter) -> Mode {
        let Filter { spatial, range, .. } = *filter;
        for _ in 0..MOST_STEPS {
            let [px, py] = mode.place;
            let top = (py - spatial).ceil().max(0.0) as usize;
            let bottom = self.rows.min((py + spatial).floor() as usize + 1);
            let mut sums = Sums::default();
            for v in top..bottom {
                let dy = v as f32 - py;
                // As far as the disk goes in this row.
                let half = (spatial * spatial - dy * dy).max(0.0).sqrt();
                let from = (px - half).ceil().max(0.0) as usize;
                let to = self.columns.min((px + half).floor() as usize + 1);
                for first in (from..to).step_by(LANES) {
                    let at = v * self.stride + first;
                    let near = self.values.each_ref().map(|plane| &plane[at..at + LANES]);
                    let offset = [first as f32 - px, dy];
                    sums.add(near, &mode, offset, (to - first).min(LANES), range * range);
                }
            }
            let n = total(&sums.n);
            if n == 0.0 {
                break;
            }
            let step = [&sums.x, &sums.y].map(|sum| total(sum) / n);
            let mean = sums.values.each_ref().map(|sum| total(sum) / n);
            let moved = (step[0] * step[0] + step[1] * step[1]) / (spatial * spatial)
                + squared(mean, mode.value) / (range * range);
            mode = Mode { place: [px + step[0], py + step[1]], value: mean };
            if moved < REST {
                break;
            }
        }
        mode
    }
}

impl Sums {
    /// Adds the first pixels of a run, those near enough to a value, the first one so far from the place.
    #[inline]
    fn add(&mut self, near: [&[f32]; 3], mode: &Mode, offset: [f32; 2], count: usize, range2: f32) {
        let [a, b, c] = near.map(|plane| <&[f32; LANES]>::try_from(plane).unwrap_or(&[FAR; LANES]));
        let [p, q, r] = mode.value;
        for lane in 0..LANES {
            let (da, db, dc) = (a[lane] - p, b[lane] - q, c[lane] - r);
            let is_near = (da * da + db * db + dc * dc <= range2) & (lane < count);
            let weight = if is_near { 1.0 } else { 0.0 };
            self.n[lane] += weight;
            self.x[lane] += weight * (offset[0] + lane as f32);
            self.y[lane] += weight * offset[1];
            self.values[0][lane] += weight * a[lane];
            self.values[1][lane] += weight * b[lane];
            self.values[2][lane] += weight * c[lane];
        }
    }
}

fn total(lanes: &[f32; LANES]) -> f32 {
    lanes.iter().sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;
    use medial::raster::Grid;
    use std::sync::atomic::{AtomicU32, Ordering};

    /// Two halves with noise.
    fn halves(noise: f32) -> Field {
        let mut random = Random::new(3);
        let value = |k: usize| {
            let ground = if k % 40 < 20 { 20.0 } else { 60.0 };
            [ground + noise * (random.below(1000) as f32 / 500.0 - 1.0), 0.0, 0.0]
        };
        let values: Vec<[f32; 3]> = (0..40 * 30).map(value).collect();
        Field::new(Grid::of_image(40, 30), values).unwrap()
    }

    #[test]
    fn halves_are_two_regions() {
        let labels = mean_shift(&halves(5.0), &Filter::default());
        assert_eq!(labels.len(), 2);
        assert_eq!((labels.region_at(19, 9), labels.region_at(20, 9)), (Some(0), Some(1)));
    }

    #[test]
    fn threads_change_nothing() {
        let field = halves(30.0);
        let filter = Filter { threads: NonZeroUsize::new(3).unwrap(), ..Filter::default() };
        let n_rows = AtomicU32::new(0);
        let count = || {
            n_rows.fetch_add(1, Ordering::Relaxed);
        };
        let found = mean_shift_with(&field, &filter, &count);
        assert_eq!(found, mean_shift(&field, &Filter::default()));
        assert_eq!(n_rows.into_inner(), 30);
    }

    #[test]
    fn smoothing_keeps_edges_and_takes_noise() {
        let smooth = filtered(&halves(3.0), &Filter::default());
        for (k, value) in smooth.iter().enumerate() {
            let ground = if k % 40 < 20 { 20.0 } else { 60.0 };
            assert!((value[0] - ground).abs() < 1.0, "{k}: {value:?}");
        }
    }

    #[test]
    fn no_data_is_no_neighbour() {
        let field = halves(0.0).without(|x, _| x == 19);
        let labels = mean_shift(&field, &Filter::default());
        assert_eq!((labels.len(), labels.region_at(19, 0)), (2, None));
        assert!(
            mean_shift(&Field::new(Grid::of_image(0, 3), []).unwrap(), &Filter::default())
                .is_empty()
        );
    }
}
