//! The palette of an image: the classes of values that its regions come from.

use crate::labels::{Labels, Region};

/// A class of values: a feature colour, what lies between two thresholds, or what is near to one colour.
#[derive(Clone, Debug, PartialEq)]
pub struct Class {
    /// Its number: in the order in which features were found, of thresholds, or of colours, behind which comes what is
    /// near to none.
    pub number: u32,
    /// How many regions it has.
    pub regions: u32,
    /// What is known of all of them together.
    pub whole: Region,
}

impl Labels {
    /// The classes that have a region, by their numbers; of [`mean_shift`](crate::mean_shift()), which has none, one of all.
    ///
    /// ```
    /// use medial::raster::Grid;
    /// use medial_image::{Field, thresholds};
    /// let values = [1.0, 7.0, 9.0, 2.0].map(|v| [v, 0.0, 0.0]);
    /// let field = Field::new(Grid::of_image(4, 1), values)?;
    /// let labels = thresholds(&field, &[5.0], 1);
    /// let classes = labels.classes(&labels.regions(&field));
    /// let told: Vec<_> = classes.iter().map(|c| (c.number, c.regions, c.whole.mean[0])).collect();
    /// assert_eq!(told, [(0, 2, 1.5), (1, 1, 8.0)]);
    /// # Ok::<(), medial_image::FieldError>(())
    /// ```
    ///
    /// # Panics
    /// If these are fewer regions than there are.
    #[must_use]
    pub fn classes(&self, regions: &[Region]) -> Vec<Class> {
        let mut order: Vec<u32> = (0..self.len()).collect();
        order.sort_by_key(|&region| self.class_of(region));
        let class = |own: &[u32]| Class {
            number: self.class_of(own[0]),
            regions: own.len() as u32,
            whole: Region::united(own.iter().map(|&region| &regions[region as usize])),
        };
        order.chunk_by(|&a, &b| self.class_of(a) == self.class_of(b)).map(class).collect()
    }
}

#[cfg(test)]
mod tests {
    use crate::field::Field;
    use crate::labels::Labels;
    use crate::simple::near_colours;
    use medial::raster::Grid;

    #[test]
    fn a_region_is_of_the_class_that_most_of_it_came_from() {
        // Two specks of one class beside a larger one of another, which together have more.
        let values = [9.0, 9.0, 5.0, 9.0, 9.0, 0.0, 0.0, 0.0].map(|v| [v, 0.0, 0.0]);
        let field = Field::new(Grid::of_image(8, 1), values).unwrap();
        let colours = [[0.0; 3], [5.0, 0.0, 0.0], [9.0, 0.0, 0.0]];
        let labels = near_colours(&field, &colours, 1.0, 3);
        assert_eq!(labels.labels(), [0, 0, 0, 0, 0, 1, 1, 1]);
        assert_eq!([0, 1].map(|region| labels.class_of(region)), [2, 0]);
        let classes = labels.classes(&labels.regions(&field));
        assert_eq!(
            classes.iter().map(|c| (c.number, c.whole.cells)).collect::<Vec<_>>(),
            [(0, 3), (2, 5)]
        );
    }

    #[test]
    fn numbers_that_are_given_are_regions_in_their_order() {
        let numbers = [3.0, -0.0, f64::NAN, 3.0, 0.0, -2.0];
        let (labels, known) = Labels::given(Grid::of_image(3, 2), &numbers);
        assert_eq!(labels.labels(), [2, 1, Labels::NONE, 2, 1, 0]);
        assert_eq!(known, [-2.0, 0.0, 3.0]);
        assert!(Labels::given(Grid::of_image(0, 0), &[]).0.is_empty());
    }
}
