//! Regions by one look at each pixel.

use crate::field::{Field, squared};
use crate::labels::Labels;
use crate::merging::merge_small;

/// The regions between thresholds of the first number of a field, in increasing order: a pixel is above those
/// that are not greater than it. Regions of fewer pixels than the least go to the neighbour that is most alike.
#[must_use]
pub fn thresholds(field: &Field, limits: &[f32], min_region: u64) -> Labels {
    let values: Vec<f32> = field.values().iter().map(|value| value[0]).collect();
    thresholds_of(field, &values, limits, min_region)
}

/// The same between thresholds of other values, one for each pixel, such as those of a band in its own units. Where the
/// field has no data there is no region.
///
/// # Panics
/// If there are not as many values as pixels.
#[must_use]
pub fn thresholds_of(field: &Field, values: &[f32], limits: &[f32], min_region: u64) -> Labels {
    assert_eq!(values.len(), field.values().len(), "a value for each pixel");
    let class = |k: usize| match field.is_known(k) {
        true => limits.iter().filter(|&&limit| limit <= values[k]).count() as u32,
        false => Labels::NONE,
    };
    regions(field, (0..values.len()).map(class).collect(), min_region)
}

/// The regions of pixels nearest to each of some colours and within a distance of it, and of those that are near
/// to none. Regions of fewer pixels than the least go to the neighbour that is most alike.
#[must_use]
pub fn near_colours(field: &Field, colours: &[[f32; 3]], distance: f32, min_region: u64) -> Labels {
    let class = |value: &[f32; 3]| {
        if value[0].is_nan() {
            return Labels::NONE;
        }
        let all = (0..).zip(colours).map(|(number, &colour)| (squared(colour, *value), number));
        let nearest = all.min_by(|a, b| a.0.total_cmp(&b.0));
        match nearest {
            Some((squared, number)) if squared <= distance * distance => number,
            _ => colours.len() as u32,
        }
    };
    regions(field, field.values().iter().map(class).collect(), min_region)
}

fn regions(field: &Field, class: Vec<u32>, min_region: u64) -> Labels {
    merge_small(Labels::connected(*field.grid(), &class, |_, _| true), field, min_region)
}

#[cfg(test)]
mod tests {
    use super::*;
    use medial::raster::Grid;

    #[test]
    fn thresholds_belong_to_what_is_above() {
        let values = [0.0, 1.0, 2.0, 3.0, f32::NAN, 3.0].map(|v| [v, 0.0, 0.0]);
        let field = Field::new(Grid::of_image(6, 1), values).unwrap();
        let labels = thresholds(&field, &[1.0, 3.0], 0);
        assert_eq!(labels.labels(), [0, 1, 1, 2, Labels::NONE, 3]);
    }

    #[test]
    fn thresholds_may_be_of_other_values() {
        let kelvin = [280.0, 300.0, 320.0, 300.0];
        let bands = [[280.0; 3], [300.0; 3], [320.0; 3], [f32::NAN; 3]];
        let field = Field::of_bands(Grid::of_image(4, 1), bands).unwrap();
        let labels = thresholds_of(&field, &kelvin, &[300.0], 0);
        assert_eq!(labels.labels(), [0, 1, 1, Labels::NONE]);
    }

    #[test]
    fn colours_take_what_is_near() {
        let values = [0.0, 1.0, 5.0, 9.0, 10.0].map(|v| [v, 0.0, 0.0]);
        let field = Field::new(Grid::of_image(5, 1), values).unwrap();
        let labels = near_colours(&field, &[[0.0; 3], [10.0, 0.0, 0.0]], 2.0, 0);
        assert_eq!(labels.labels(), [0, 0, 1, 2, 2]);
    }
}
