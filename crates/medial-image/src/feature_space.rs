//! Analysis of the feature space: colours that stand out become classes [CM97].
//!
//! # Contract
//! Each pixel with data is in one region; regions are connected, and as large as the resolution asks for unless
//! they have no neighbours. The same seed gives the same regions. Time is that of some passes over the pixels for
//! each class.
//!
//! # Method
//! 1. Of some random pixels take the one whose surroundings in the feature space hold most; move to the mean of
//!    what lies within the radius until that rests: a mode.
//! 2. Take away what lies within the radius of the mode, and the neighbours in the image of these pixels, whose
//!    colours are mixed. Go on until a mode holds too little.
//! 3. Keep the modes that have a connected region large enough.
//! 4. Give each pixel within a window of twice the volume to the nearest mode, take the means of these as centres,
//!    and give every pixel to the nearest.
//! 5. Join regions that are too small to the neighbour that is most alike.
//!
//! # Departures
//! Means come from a histogram with bins of a quarter of the radius, so a step does not look at all pixels. The
//! numbers of [CM97], given for images of 512 by 512 pixels, grow with the image. In step 4 pixels beyond all
//! windows need not touch the class that they come to; where they do not, they are small regions for step 5.

use crate::field::{Field, squared};
use crate::histogram::Histogram;
use crate::labels::Labels;
use crate::merging::merge_small;
use crate::random::Random;

/// How finely the feature space is looked at [CM97, table 1].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Resolution {
    /// Few large regions.
    #[default]
    Under,
    /// More and smaller ones.
    Over,
    /// As many colours as it takes to look alike.
    Quantization,
}

/// How [`feature_space`] works.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Analysis {
    /// How finely the feature space is looked at.
    pub resolution: Resolution,
    /// What random choices start from.
    pub seed: u64,
    /// The least number of pixels of a region; by default what the resolution says.
    pub min_region: Option<u64>,
}

/// Pixels for which numbers of pixels are given.
const REFERENCE: f64 = 262_144.0;

/// Random pixels among which a search begins with the best.
const CANDIDATES: usize = 25;

/// A mode rests when a step is shorter.
const REST: f32 = 0.1;

/// Most steps of a search, and most classes.
const MOST_STEPS: usize = 100;
const MOST_CLASSES: usize = 1000;

impl Resolution {
    /// The radius of a window as a share of the deviation of all values.
    fn radius(self) -> f32 {
        match self {
            Self::Under => 0.4,
            Self::Over => 0.3,
            Self::Quantization => 0.2,
        }
    }

    /// The least number of pixels of a mode, and of a region.
    fn least(self) -> (f64, f64) {
        match self {
            Self::Under => (400.0, 10.0),
            Self::Over => (100.0, 10.0),
            Self::Quantization => (50.0, 0.0),
        }
    }
}

/// The regions of an image by the colours that stand out in it.
#[must_use]
pub fn feature_space(field: &Field, analysis: &Analysis) -> Labels {
    let deviation = field.deviation();
    let share = field.grid().n_cells() as f64 / REFERENCE;
    let (least_mode, least_region) = analysis.resolution.least();
    let scaled = |number: f64| (number * share).round() as u64;
    let mut classes = Classes {
        field,
        radius: analysis.resolution.radius() * deviation,
        least: scaled(least_mode).max(1),
        state: vec![FREE; field.values().len()],
        modes: Vec::new(),
    };
    if deviation > 0.0 {
        classes.find_modes(analysis.seed);
    }
    let class = classes.assigned();
    let labels = Labels::connected(*field.grid(), &class, |_, _| true);
    let least = analysis.min_region.unwrap_or_else(|| scaled(least_region));
    merge_small(labels, field, least)
}

/// The search for classes.
struct Classes<'f> {
    field: &'f Field,
    radius: f32,
    /// The least number of pixels of a mode.
    least: u64,
    /// For each pixel the mode that took it, or one of the following.
    state: Vec<u32>,
    modes: Vec<[f32; 3]>,
}

/// A pixel that no mode has taken yet, and one that was taken away with its neighbour.
const FREE: u32 = u32::MAX;
const GONE: u32 = u32::MAX - 1;

impl Classes<'_> {
    fn find_modes(&mut self, seed: u64) {
        let values = self.field.values();
        let mut random = Random::new(seed);
        let mut histogram = Histogram::new(self.field, 0.25 * self.radius);
        let mut free: Vec<usize> = (0..values.len()).filter(|&k| self.field.is_known(k)).collect();
        while free.len() as u64 >= self.least && self.modes.len() < MOST_CLASSES {
            let mut best = (0, [0.0; 3]);
            for _ in 0..CANDIDATES {
                let start = self.mean_around(free[random.below(free.len())]);
                let (count, _) = histogram.within(start, self.radius);
                if count > best.0 {
                    best = (count, start);
                }
            }
            let mut mode = best.1;
            for _ in 0..MOST_STEPS {
                let (count, mean) = histogram.within(mode, self.radius);
                let rests = squared(mean, mode) < REST * REST;
                if count == 0 || rests {
                    break;
                }
                mode = mean;
            }
            let number = self.modes.len() as u32;
            let is_in = |k: &usize| squared(values[*k], mode) <= self.radius * self.radius;
            let taken: Vec<usize> = free.iter().copied().filter(is_in).collect();
            if (taken.len() as u64) < self.least {
                break;
            }
            self.modes.push(mode);
            taken.iter().for_each(|&k| self.state[k] = number);
            for &k in &taken {
                for other in around(self.field, k) {
                    if self.state[other] == FREE {
                        self.state[other] = GONE;
                    }
                }
            }
            free.retain(|&k| {
                let stays = self.state[k] == FREE;
                if !stays {
                    histogram.take(values[k]);
                }
                stays
            });
        }
        self.keep_large();
    }

    /// The mean of a pixel and its eight neighbours.
    fn mean_around(&self, pixel: usize) -> [f32; 3] {
        let values = self.field.values();
        let (mut n, mut sums) = (1.0, values[pixel]);
        for other in around(self.field, pixel).filter(|&other| self.field.is_known(other)) {
            n += 1.0;
            sums.iter_mut().zip(values[other]).for_each(|(sum, number)| *sum += number);
        }
        sums.map(|sum| sum / n)
    }

    /// Drops modes without a connected region that is large enough; the first one stays if all would go.
    fn keep_large(&mut self) {
        let class: Vec<u32> =
            self.state.iter().map(|&s| if s >= GONE { Labels::NONE } else { s }).collect();
        let labels = Labels::connected(*self.field.grid(), &class, |_, _| true);
        let mut cells = vec![0_u64; labels.len() as usize];
        let mut is_large = vec![false; self.modes.len()];
        for (&label, &class) in labels.labels().iter().zip(&class) {
            if label != Labels::NONE {
                cells[label as usize] += 1;
                is_large[class as usize] |= cells[label as usize] > self.least;
            }
        }
        if let (true, Some(first)) = (is_large.iter().all(|&large| !large), is_large.first_mut()) {
            *first = true;
        }
        let mut large = is_large.into_iter();
        self.modes.retain(|_| large.next() == Some(true));
    }

    /// The class of each pixel.
    fn assigned(&self) -> Vec<u32> {
        let values = self.field.values();
        if self.modes.is_empty() {
            return (0..values.len())
                .map(|k| if self.field.is_known(k) { 0 } else { Labels::NONE })
                .collect();
        }
        // Twice the volume.
        let wide = self.radius * 2.0_f32.cbrt();
        let mut sums = vec![(0.0_f64, [0.0_f64; 3]); self.modes.len()];
        for &value in values.iter().filter(|value| !value[0].is_nan()) {
            let (class, distance) = nearest(&self.modes, value);
            if distance <= wide * wide {
                let (n, sums) = &mut sums[class as usize];
                *n += 1.0;
                sums.iter_mut().zip(value).for_each(|(sum, number)| *sum += f64::from(number));
            }
        }
        let centre = |((n, sums), &mode): (&(f64, [f64; 3]), &[f32; 3])| {
            if *n > 0.0 { sums.map(|sum| (sum / n) as f32) } else { mode }
        };
        let centres: Vec<[f32; 3]> = sums.iter().zip(&self.modes).map(centre).collect();
        let class = |value: &[f32; 3]| match value[0].is_nan() {
            true => Labels::NONE,
            false => nearest(&centres, *value).0,
        };
        values.iter().map(class).collect()
    }
}

/// The nearest of some centres, the first one of several, and the square of its distance.
fn nearest(centres: &[[f32; 3]], value: [f32; 3]) -> (u32, f32) {
    let mut best = (0, f32::INFINITY);
    for (number, &centre) in (0..).zip(centres) {
        let distance = squared(centre, value);
        if distance < best.1 {
            best = (number, distance);
        }
    }
    best
}

/// The neighbours of a pixel by sides and corners.
fn around(field: &Field, pixel: usize) -> impl Iterator<Item = usize> {
    let (columns, rows) = (field.grid().columns as usize, field.grid().rows as usize);
    let (x, y) = (pixel % columns, pixel / columns);
    let (left, right) = (x.saturating_sub(1), (x + 2).min(columns));
    let (above, below) = (y.saturating_sub(1), (y + 2).min(rows));
    (above..below)
        .flat_map(move |y| (left..right).map(move |x| y * columns + x))
        .filter(move |&k| k != pixel)
}

#[cfg(test)]
mod tests {
    use super::*;
    use medial::raster::Grid;

    /// Stripes of some colours with noise, 20 pixels wide.
    fn stripes(noise: f32) -> Field {
        let mut random = Random::new(5);
        let colours = [[20.0, 0.0, 0.0], [60.0, 50.0, 0.0], [80.0, -40.0, 30.0]];
        let value = |k: usize| {
            let mut jitter = || noise * (random.below(1000) as f32 / 500.0 - 1.0);
            colours[k % 60 / 20].map(|number| number + jitter())
        };
        let values: Vec<[f32; 3]> = (0..60 * 50).map(value).collect();
        Field::new(Grid::of_image(60, 50), values).unwrap()
    }

    #[test]
    fn stripes_are_regions_whatever_the_seed() {
        for (seed, noise) in (0..10).flat_map(|seed| [(seed, 0.0), (seed, 6.0)]) {
            let field = stripes(noise);
            let analysis = Analysis { seed, min_region: Some(20), ..Analysis::default() };
            let labels = feature_space(&field, &analysis);
            assert_eq!(labels.len(), 3, "{seed} {noise}");
            for x in 0..60 {
                assert_eq!(labels.region_at(x, 25), Some(x / 20), "{seed} {noise}");
            }
        }
    }

    #[test]
    fn the_same_seed_gives_the_same() {
        let field = stripes(20.0);
        for resolution in [Resolution::Under, Resolution::Over, Resolution::Quantization] {
            let analysis = Analysis { resolution, seed: 7, min_region: None };
            assert_eq!(feature_space(&field, &analysis), feature_space(&field, &analysis));
        }
    }

    #[test]
    fn one_colour_is_one_region_and_no_data_is_none() {
        let grid = Grid::of_image(4, 3);
        let field = Field::new(grid, [[5.0; 3]; 12]).unwrap().without(|x, _| x == 0);
        let labels = feature_space(&field, &Analysis::default());
        assert_eq!((labels.len(), labels.region_at(0, 0)), (1, None));
        let nothing = Field::new(Grid::of_image(0, 0), []).unwrap();
        assert!(feature_space(&nothing, &Analysis::default()).is_empty());
        let unknown = Field::new(grid, [[f32::NAN; 3]; 12]).unwrap();
        assert!(feature_space(&unknown, &Analysis::default()).is_empty());
    }
}
