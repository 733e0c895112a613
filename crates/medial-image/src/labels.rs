use crate::field::{Field, squared};
use medial::geom::DisjointSets;
use medial::raster::{Grid, Mask};

/// A number for each pixel: that of the region that it is in.
///
/// Regions are connected by sides of pixels, and numbered from 0 in the order of their first pixels, row by row; those
/// that were [given](Self::given) are what they are. Each belongs to a [class](crate::Class).
#[derive(Clone, Debug, PartialEq)]
pub struct Labels {
    grid: Grid,
    labels: Vec<u32>,
    /// The class of each region.
    classes: Vec<u32>,
}

/// What is known of a region.
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// How many pixels it has.
    pub cells: u64,
    /// The mean of their values.
    pub mean: [f32; 3],
    /// The first column and the first row in which it has pixels.
    pub first: [u32; 2],
    /// The last column and the last row.
    pub last: [u32; 2],
}

impl Region {
    /// What is known of several regions together.
    pub(crate) fn united<'r>(parts: impl Iterator<Item = &'r Self>) -> Self {
        let mut whole = Self { cells: 0, mean: [0.0; 3], first: [u32::MAX; 2], last: [0; 2] };
        let mut sums = [0.0_f64; 3];
        for part in parts {
            whole.cells += part.cells;
            whole.first = [0, 1].map(|axis| whole.first[axis].min(part.first[axis]));
            whole.last = [0, 1].map(|axis| whole.last[axis].max(part.last[axis]));
            for (sum, &mean) in sums.iter_mut().zip(&part.mean) {
                *sum += part.cells as f64 * f64::from(mean);
            }
        }
        whole.mean = sums.map(|sum| (sum / whole.cells.max(1) as f64) as f32);
        whole
    }

    /// How far a value is from their mean.
    #[must_use]
    pub fn distance(&self, value: [f32; 3]) -> f32 {
        squared(self.mean, value).sqrt()
    }
}

impl Labels {
    /// The label of a pixel without data.
    pub const NONE: u32 = u32::MAX;

    /// The connected regions of pixels that are alike: of the same class, and both joined if they are
    /// neighbours, which is asked by their numbers.
    pub(crate) fn connected(
        grid: Grid,
        class: &[u32],
        is_joined: impl Fn(usize, usize) -> bool,
    ) -> Self {
        let columns = grid.columns as usize;
        let mut sets = DisjointSets::default();
        let mut labels = vec![Self::NONE; class.len()];
        let mut classes = Vec::new();
        for k in 0..class.len() {
            if class[k] == Self::NONE {
                continue;
            }
            let joined = |other: usize| class[other] == class[k] && is_joined(other, k);
            let left = (!k.is_multiple_of(columns) && joined(k - 1)).then(|| labels[k - 1]);
            let above = (k >= columns && joined(k - columns)).then(|| labels[k - columns]);
            labels[k] = match (left, above) {
                (Some(left), Some(above)) => {
                    if left != above {
                        sets.join(left, above);
                    }
                    left
                }
                (Some(one), None) | (None, Some(one)) => one,
                (None, None) => {
                    sets.push();
                    classes.push(class[k]);
                    sets.len() as u32 - 1
                }
            };
        }
        Self { grid, labels, classes }.numbered(|label| sets.first(label))
    }

    /// The regions that an image of labels says, with the number of each: one for each number, connected or not, in
    /// increasing order, each a class of its own. What is not a number is no data.
    ///
    /// ```
    /// use medial::raster::Grid;
    /// use medial_image::Labels;
    /// let (labels, numbers) = Labels::given(Grid::of_image(4, 1), &[7.0, f64::NAN, 2.0, 7.0]);
    /// assert_eq!((labels.labels(), &numbers[..]), (&[1, Labels::NONE, 0, 1][..], &[2.0, 7.0][..]));
    /// ```
    ///
    /// # Panics
    /// If there are not as many numbers as pixels.
    #[must_use]
    pub fn given(grid: Grid, numbers: &[f64]) -> (Self, Vec<f64>) {
        assert_eq!(numbers.len() as u64, grid.n_cells(), "a number for each pixel");
        let mut known: Vec<f64> =
            numbers.iter().copied().filter(|number| !number.is_nan()).collect();
        // Zeros are the same whatever their sign.
        known.iter_mut().for_each(|number| *number += 0.0);
        known.sort_unstable_by(f64::total_cmp);
        known.dedup();
        let label = |number: &f64| match number.is_nan() {
            true => Self::NONE,
            false => known.partition_point(|other| other < number) as u32,
        };
        let labels = numbers.iter().map(label).collect();
        (Self { grid, labels, classes: (0..known.len() as u32).collect() }, known)
    }

    /// The same regions, those joined to which something gives the same number, numbered anew.
    pub(crate) fn numbered(mut self, mut name: impl FnMut(u32) -> u32) -> Self {
        let mut names = vec![Self::NONE; self.classes.len()];
        let mut numbers = names.clone();
        let mut cells = vec![0_u64; self.classes.len()];
        let mut n_regions = 0;
        for label in self.labels.iter_mut().filter(|label| **label != Self::NONE) {
            let known = &mut names[*label as usize];
            if *known == Self::NONE {
                *known = name(*label);
            }
            cells[*label as usize] += 1;
            let number = &mut numbers[*known as usize];
            if *number == Self::NONE {
                *number = n_regions;
                n_regions += 1;
            }
            *label = *number;
        }
        // A region is of the class that has most of its pixels; of the same, the first one.
        let was = (0..).zip(&names).filter(|(_, name)| **name != Self::NONE);
        let mut parts: Vec<(u32, u32, u64)> = was
            .map(|(label, &name): (usize, _)| {
                (numbers[name as usize], self.classes[label], cells[label])
            })
            .collect();
        parts.sort_unstable();
        let mut best = vec![(0, 0); n_regions as usize];
        for part in parts.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
            let (region, class, _) = part[0];
            let cells: u64 = part.iter().map(|part| part.2).sum();
            let best = &mut best[region as usize];
            if cells > best.0 {
                *best = (cells, class);
            }
        }
        self.classes = best.into_iter().map(|(_, class)| class).collect();
        self
    }

    /// Where the pixels lie.
    #[must_use]
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The labels, row by row; [`NONE`](Self::NONE) where there is no data.
    #[must_use]
    pub fn labels(&self) -> &[u32] {
        &self.labels
    }

    /// The number of regions.
    #[must_use]
    pub fn len(&self) -> u32 {
        self.classes.len() as u32
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.classes.is_empty()
    }

    /// The class of a region.
    ///
    /// # Panics
    /// If there is no such region.
    #[must_use]
    pub fn class_of(&self, region: u32) -> u32 {
        self.classes[region as usize]
    }

    /// The region of a pixel, by column and row; `None` outside of the grid and where there is no data.
    #[must_use]
    pub fn region_at(&self, column: u32, row: u32) -> Option<u32> {
        let Grid { columns, rows, .. } = self.grid;
        if column >= columns || row >= rows {
            return None;
        }
        let label = self.labels[row as usize * columns as usize + column as usize];
        (label != Self::NONE).then_some(label)
    }

    /// What is known of each region, with means of a field of the same grid.
    #[must_use]
    pub fn regions(&self, field: &Field) -> Vec<Region> {
        let nothing = Region { cells: 0, mean: [0.0; 3], first: [u32::MAX; 2], last: [0; 2] };
        let mut regions = vec![nothing; self.classes.len()];
        let mut sums = vec![[0.0_f64; 3]; self.classes.len()];
        let columns = self.grid.columns.max(1) as usize;
        for (k, (&label, value)) in self.labels.iter().zip(field.values()).enumerate() {
            let Some(region) = regions.get_mut(label as usize) else { continue };
            let at = [(k % columns) as u32, (k / columns) as u32];
            region.cells += 1;
            region.first = [0, 1].map(|axis| region.first[axis].min(at[axis]));
            region.last = [0, 1].map(|axis| region.last[axis].max(at[axis]));
            for (sum, &number) in sums[label as usize].iter_mut().zip(value) {
                *sum += f64::from(number);
            }
        }
        for (region, sums) in regions.iter_mut().zip(sums) {
            region.mean = sums.map(|sum| (sum / region.cells as f64) as f32);
        }
        regions
    }

    /// The pixels of some regions as a mask of the same grid.
    ///
    /// # Errors
    /// If the grid is too large for masks.
    pub fn mask(&self, is_chosen: impl Fn(u32) -> bool) -> Result<Mask, medial::raster::MaskError> {
        let columns = self.grid.columns as usize;
        Mask::new(self.grid, |column, row| {
            let label = self.labels[row as usize * columns + column as usize];
            label != Self::NONE && is_chosen(label)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn regions_are_connected_by_sides() {
        // Two diagonals of ones, and what they part.
        let class = [1, 0, 1, 0, 1, 0, 1, 0, 1];
        let labels = Labels::connected(Grid::of_image(3, 3), &class, |_, _| true);
        assert_eq!(labels.labels(), [0, 1, 2, 3, 4, 5, 6, 7, 8]);
        let class = [1, 0, 1, 1, 0, 1, 1, 1, 1];
        let labels = Labels::connected(Grid::of_image(3, 3), &class, |_, _| true);
        assert_eq!(labels.labels(), [0, 1, 0, 0, 1, 0, 0, 0, 0]);
        assert_eq!(labels.len(), 2);
        assert_eq!((labels.region_at(1, 1), labels.region_at(1, 3)), (Some(1), None));
    }

    #[test]
    fn what_has_no_data_is_in_no_region() {
        let class = [1, Labels::NONE, 1];
        let labels = Labels::connected(Grid::of_image(3, 1), &class, |_, _| true);
        assert_eq!(labels.labels(), [0, Labels::NONE, 1]);
        let empty = Labels::connected(Grid::of_image(0, 5), &[], |_, _| true);
        assert!(empty.is_empty());
    }

    #[test]
    fn regions_know_their_box_and_mean() {
        let class = [0, 1, 1, 0, 0, 1];
        let grid = Grid::of_image(3, 2);
        let labels = Labels::connected(grid, &class, |_, _| true);
        let values = (0..6).map(|k| [k as f32, 0.0, 1.0]);
        let regions = labels.regions(&Field::new(grid, values).unwrap());
        assert_eq!(
            regions[1],
            Region { cells: 3, mean: [8.0 / 3.0, 0.0, 1.0], first: [1, 0], last: [2, 1] }
        );
        assert_eq!(labels.mask(|label| label == 0).unwrap().count(), 3);
    }
}
