use crate::field::{Field, squared};
use medial::geom::DisjointSets;
use medial::raster::{Grid, Mask};

/// A number for each pixel: that of the region that it is in.
///
/// Regions are connected by sides of pixels, and numbered from 0 in the order of their first pixels, row by row.
#[derive(Clone, Debug, PartialEq)]
pub struct Labels {
    grid: Grid,
    labels: Vec<u32>,
    n_regions: u32,
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
                    sets.len() as u32 - 1
                }
            };
        }
        Self { grid, labels, n_regions: 0 }.numbered(|label| sets.first(label))
    }

    /// The same regions, those joined to which something gives the same number, numbered anew.
    pub(crate) fn numbered(mut self, mut name: impl FnMut(u32) -> u32) -> Self {
        let most = self.labels.iter().filter(|&&label| label != Self::NONE).max();
        let mut names = vec![Self::NONE; most.map_or(0, |&most| most as usize + 1)];
        let mut numbers = names.clone();
        let mut n_regions = 0;
        for label in self.labels.iter_mut().filter(|label| **label != Self::NONE) {
            let known = &mut names[*label as usize];
            if *known == Self::NONE {
                *known = name(*label);
            }
            let number = &mut numbers[*known as usize];
            if *number == Self::NONE {
                *number = n_regions;
                n_regions += 1;
            }
            *label = *number;
        }
        self.n_regions = n_regions;
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
        self.n_regions
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.n_regions == 0
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
        let mut regions = vec![nothing; self.n_regions as usize];
        let mut sums = vec![[0.0_f64; 3]; self.n_regions as usize];
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
