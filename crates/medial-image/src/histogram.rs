use crate::field::{Field, squared};

/// The values of a field in bins, from which they can be taken again.
#[derive(Clone, Debug)]
pub(crate) struct Histogram {
    low: [f32; 3],
    /// The side of a bin.
    size: f32,
    /// Bins along each axis.
    n: [usize; 3],
    bins: Vec<Bin>,
}

#[derive(Clone, Copy, Debug, Default)]
struct Bin {
    count: u32,
    sums: [f64; 3],
}

/// Most bins along an axis.
const MOST: f32 = 96.0;

impl Histogram {
    /// All values that are known, in bins of about this size.
    pub fn new(field: &Field, size: f32) -> Self {
        let known = || field.values().iter().filter(|value| !value[0].is_nan());
        let (mut low, mut high) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
        for value in known() {
            for axis in 0..3 {
                low[axis] = low[axis].min(value[axis]);
                high[axis] = high[axis].max(value[axis]);
            }
        }
        let extent = |axis: usize| (high[axis] - low[axis]).max(0.0);
        let widest = (0..3).map(extent).fold(0.0, f32::max);
        let size = size.max(widest / MOST).max(f32::MIN_POSITIVE);
        let n = [0, 1, 2].map(|axis| (extent(axis) / size) as usize + 1);
        let bins = vec![Bin::default(); n[0] * n[1] * n[2]];
        let mut histogram = Self { low, size, n, bins };
        known().for_each(|&value| histogram.add(value));
        histogram
    }

    fn place(&self, value: [f32; 3]) -> usize {
        let [x, y, z] = [0, 1, 2].map(|axis| {
            (((value[axis] - self.low[axis]) / self.size) as usize).min(self.n[axis] - 1)
        });
        (x * self.n[1] + y) * self.n[2] + z
    }

    fn add(&mut self, value: [f32; 3]) {
        let place = self.place(value);
        let bin = &mut self.bins[place];
        bin.count += 1;
        bin.sums.iter_mut().zip(value).for_each(|(sum, number)| *sum += f64::from(number));
    }

    /// Takes a value that is in it.
    pub fn take(&mut self, value: [f32; 3]) {
        let place = self.place(value);
        let bin = &mut self.bins[place];
        bin.count = bin.count.saturating_sub(1);
        bin.sums.iter_mut().zip(value).for_each(|(sum, number)| *sum -= f64::from(number));
        if bin.count == 0 {
            *bin = Bin::default();
        }
    }

    /// How many values lie within a distance of a place, and their mean; those of a bin count together, where
    /// their mean lies.
    pub fn within(&self, centre: [f32; 3], radius: f32) -> (u64, [f32; 3]) {
        let range = |axis: usize| {
            let at = |value: f32| ((value - self.low[axis]) / self.size).floor().max(0.0) as usize;
            at(centre[axis] - radius)..self.n[axis].min(at(centre[axis] + radius) + 1)
        };
        let (mut count, mut sums) = (0, [0.0; 3]);
        for x in range(0) {
            for y in range(1) {
                let row = (x * self.n[1] + y) * self.n[2];
                for bin in &self.bins[row..][range(2)] {
                    if bin.count == 0 {
                        continue;
                    }
                    let mean = bin.sums.map(|sum| (sum / f64::from(bin.count)) as f32);
                    if squared(mean, centre) <= radius * radius {
                        count += u64::from(bin.count);
                        sums.iter_mut().zip(bin.sums).for_each(|(sum, more)| *sum += more);
                    }
                }
            }
        }
        (count, sums.map(|sum| (sum / count.max(1) as f64) as f32))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use medial::raster::Grid;

    #[test]
    fn values_are_counted_and_taken() {
        let values = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [10.0, 3.0, 0.0]];
        let field = Field::new(Grid::of_image(3, 1), values).unwrap();
        let mut histogram = Histogram::new(&field, 0.5);
        assert_eq!(histogram.within([0.0; 3], 2.0), (2, [0.5, 0.0, 0.0]));
        histogram.take([1.0, 0.0, 0.0]);
        assert_eq!(histogram.within([0.0; 3], 2.0), (1, [0.0; 3]));
        assert_eq!(histogram.within([9.0, 3.0, 0.0], 1.5), (1, [10.0, 3.0, 0.0]));
        assert_eq!(histogram.within([100.0; 3], 1.0).0, 0);
    }
}
