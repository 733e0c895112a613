use crate::colour::{linear, luv, of_linear};
use medial::raster::Grid;

/// Why numbers are no field.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FieldError {
    /// There are more or fewer pixels than the grid has.
    #[error("{found} pixels for {columns} by {rows}; give one for each")]
    Size {
        /// How many there are.
        found: u64,
        /// Columns of the grid.
        columns: u32,
        /// Rows of the grid.
        rows: u32,
    },
}

/// Three numbers for each pixel of an image, of which distances mean something; not numbers where there is no
/// data.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    grid: Grid,
    values: Vec<[f32; 3]>,
}

/// What stands where there is no data.
const UNKNOWN: [f32; 3] = [f32::NAN; 3];

impl Field {
    /// The field of these values, row by row.
    ///
    /// # Errors
    /// If there are not as many as the grid has cells.
    pub fn new(grid: Grid, values: impl IntoIterator<Item = [f32; 3]>) -> Result<Self, FieldError> {
        let is_known = |value: &[f32; 3]| value.iter().all(|number| number.is_finite());
        let known = |value| if is_known(&value) { value } else { UNKNOWN };
        let values: Vec<[f32; 3]> = values.into_iter().map(known).collect();
        let (found, Grid { columns, rows, .. }) = (values.len() as u64, grid);
        if found == grid.n_cells() {
            Ok(Self { grid, values })
        } else {
            Err(FieldError::Size { found, columns, rows })
        }
    }

    /// The colours of an image, each value of sRGB from 0 to 1, as [L\*u\*v\*](luv).
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn of_colours(
        grid: Grid,
        colours: impl IntoIterator<Item = [f32; 3]>,
    ) -> Result<Self, FieldError> {
        Self::new(grid, colours.into_iter().map(luv))
    }

    /// The same of values from 0 to 255.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn of_bytes(
        grid: Grid,
        colours: impl IntoIterator<Item = [u8; 3]>,
    ) -> Result<Self, FieldError> {
        let light: Vec<f32> = (0..=255_u8).map(|value| linear(f32::from(value) / 255.0)).collect();
        let of = |colour: [u8; 3]| of_linear(colour.map(|value| light[usize::from(value)]));
        Self::new(grid, colours.into_iter().map(of))
    }

    /// Bands that are no colours: each from its least value to its greatest becomes 0 to 100, and a band without a
    /// value 0.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn of_bands(
        grid: Grid,
        bands: impl IntoIterator<Item = [f32; 3]>,
    ) -> Result<Self, FieldError> {
        let field = Self::new(grid, bands)?;
        let extents = field.extents();
        Ok(field.stretched(extents))
    }

    /// The least value and the greatest of each of the three numbers; without data infinity and its negative.
    #[must_use]
    pub fn extents(&self) -> [[f32; 2]; 3] {
        let mut extents = [[f32::INFINITY, f32::NEG_INFINITY]; 3];
        for value in self.values.iter().filter(|value| !value[0].is_nan()) {
            for ([low, high], &number) in extents.iter_mut().zip(value) {
                (*low, *high) = (low.min(number), high.max(number));
            }
        }
        extents
    }

    /// The field in which these values become 0 and 100, as for another image beside which it is looked at; where both
    /// are the same all become 0. What lies between them stays between 0 and 100, whatever is rounded.
    #[must_use]
    pub fn stretched(mut self, extents: [[f32; 2]; 3]) -> Self {
        for (band, extent) in extents.into_iter().enumerate() {
            let [low, high] = extent.map(f64::from);
            let known = self.values.iter_mut().filter(|value| !value[band].is_nan());
            known.for_each(|value| {
                // The share of the greatest value is 1 only if it is divided; a factor would be rounded before.
                let share = (f64::from(value[band]) - low) / (high - low);
                value[band] = if high > low { (100.0 * share) as f32 } else { 0.0 };
            });
        }
        self
    }

    /// The same without the pixels, by column and row, for which something is true.
    #[must_use]
    pub fn without(mut self, mut is_unknown: impl FnMut(u32, u32) -> bool) -> Self {
        let columns = self.grid.columns;
        for (k, value) in (0..).zip(&mut self.values) {
            let (column, row) = ((k % u64::from(columns)) as u32, (k / u64::from(columns)) as u32);
            if is_unknown(column, row) {
                *value = UNKNOWN;
            }
        }
        self
    }

    /// Where the pixels lie.
    #[must_use]
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The values, row by row.
    #[must_use]
    pub fn values(&self) -> &[[f32; 3]] {
        &self.values
    }

    /// Whether there is data for a pixel, by its number row by row.
    #[must_use]
    pub fn is_known(&self, pixel: usize) -> bool {
        !self.values[pixel][0].is_nan()
    }

    /// The square root of the sum of the variances of all three numbers; 0 without data.
    #[must_use]
    pub fn deviation(&self) -> f32 {
        let (mut n, mut sums, mut squares) = (0.0_f64, [0.0_f64; 3], 0.0_f64);
        for value in self.values.iter().filter(|value| !value[0].is_nan()) {
            n += 1.0;
            for (sum, &number) in sums.iter_mut().zip(value) {
                *sum += f64::from(number);
                squares += f64::from(number) * f64::from(number);
            }
        }
        let means: f64 = sums.iter().map(|sum| sum * sum).sum::<f64>() / n.max(1.0);
        ((squares - means).max(0.0) / n.max(1.0)).sqrt() as f32
    }
}

/// The square of the distance of two values.
#[inline(always)]
pub(crate) fn squared(a: [f32; 3], b: [f32; 3]) -> f32 {
    let [x, y, z] = [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    x * x + y * y + z * z
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bands_are_stretched_as_those_of_another_image() {
        let band = |values: [f32; 2]| {
            Field::new(Grid::of_image(2, 1), values.map(|v| [v, 7.0, v])).unwrap()
        };
        let extents = band([2.0, 4.0]).extents();
        assert_eq!(extents, [[2.0, 4.0], [7.0, 7.0], [2.0, 4.0]]);
        let values = [[50.0, 0.0, 50.0], [300.0, 0.0, 300.0]];
        assert_eq!(band([3.0, 8.0]).stretched(extents).values(), values);
    }

    #[test]
    fn bands_go_from_0_to_100() {
        let bands = [[2.0, 5.0, 0.0], [4.0, 5.0, -1.0], [f32::NAN, 1.0, 1.0], [3.0, 5.0, 1.0]];
        let field = Field::of_bands(Grid::of_image(2, 2), bands).unwrap();
        let expected = [[0.0, 0.0, 50.0], [100.0, 0.0, 0.0], [50.0, 0.0, 100.0]];
        let known: Vec<[f32; 3]> = [0, 1, 3].map(|k| field.values()[k]).to_vec();
        assert_eq!(known, expected);
        assert!(!field.is_known(2));
    }

    #[test]
    fn bands_stay_within_0_and_100_whatever_is_rounded() {
        // A hundred over 45 is rounded up so much that 45 times it is more than a hundred.
        let greatest = 45.0_f32;
        assert!(greatest * (100.0 / greatest) > 100.0);
        let band = [0.0, greatest, f32::MIN, f32::MAX];
        let fields = [[band[0], band[1]], [band[2], band[3]]].map(|values| {
            Field::of_bands(Grid::of_image(2, 1), values.map(|v| [v, 7.0, -v])).unwrap()
        });
        for field in fields {
            assert_eq!(field.values(), [[0.0, 0.0, 100.0], [100.0, 0.0, 0.0]]);
        }
    }

    #[test]
    fn a_field_has_a_value_for_each_cell() {
        let error = Field::new(Grid::of_image(2, 2), [[0.0; 3]; 3]);
        assert_eq!(error, Err(FieldError::Size { found: 3, columns: 2, rows: 2 }));
    }

    #[test]
    fn the_deviation_adds_up_variances() {
        let values = [[0.0, 0.0, 1.0], [2.0, 4.0, 1.0]];
        let field = Field::new(Grid::of_image(2, 1), values).unwrap();
        assert!((field.deviation() - 5.0_f32.sqrt()).abs() < 1e-6);
    }
}
