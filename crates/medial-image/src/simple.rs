//! Regions by one look at each pixel.

use crate::field::{Field, squared};
use crate::labels::Labels;
use crate::merging::merge_small;

/// The regions between thresholds of the first number of a field, in increasing order: a pixel is above those
/// that are not greater than it. Regions of fewer pixels than the least go to the neighbour that is most alike.
#[must_use]
pub fn thresholds(field: &Field, limits: &[f32], min_region: u64) -> Labels {
    let class = |value: &[f32; 3]| match value[0].is_nan() {
        true => Labels::NONE,
        false => limits.iter().filter(|&&limit| limit <= value[0]).count() as u32,
    };
    regions(field, class, min_region)
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
    regions(field, class, min_region)
}

fn regions(field: &Field, class: impl Fn(&[f32; 3]) -> u32, min_region: u64) -> Labels {
    let class: Vec<u32> = field.values().iter().map(class).collect();
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
    fn colours_take_what_is_near() {
        let values = [0.0, 1.0, 5.0, 9.0, 10.0].map(|v| [v, 0.0, 0.0]);
        let field = Field::new(Grid::of_image(5, 1), values).unwrap();
        let labels = near_colours(&field, &[[0.0; 3], [10.0, 0.0, 0.0]], 2.0, 0);
        assert_eq!(labels.labels(), [0, 0, 1, 2, 2]);
    }
}
