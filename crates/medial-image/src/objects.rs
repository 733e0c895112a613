//! What is chosen of an image, as objects with their pixels, masks and polygons.

use crate::labels::{Labels, Region};
use crate::pixels::{Pixels, Polygons, Window, polygons};
use crate::selection::Selection;
use medial::raster::{Grid, Mask, MaskError};

/// An object: one region of an image, or several taken together.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// The regions, in the order in which they were chosen.
    pub regions: Vec<u32>,
    /// What is known of all of them together.
    pub whole: Region,
}

/// Objects in an image, none of which overlap.
#[derive(Clone, Debug, PartialEq)]
pub struct Objects {
    grid: Grid,
    /// The number of each pixel's object, [`REST`](Self::REST), or [`Labels::NONE`] where there is no data.
    numbers: Vec<u32>,
    objects: Vec<Object>,
    pixels: Pixels,
}

impl Objects {
    /// The number of a pixel that is in no object.
    pub const REST: u32 = u32::MAX - 1;

    /// The chosen regions of an image, of which this is known.
    ///
    /// # Panics
    /// If one of them is not there.
    #[must_use]
    pub fn new(labels: &Labels, regions: &[Region], chosen: &Selection) -> Self {
        let mut number_of = vec![Self::REST; regions.len()];
        let mut objects = Vec::with_capacity(chosen.objects().len());
        for (number, object) in (0..).zip(chosen.objects()) {
            object.iter().for_each(|&region| number_of[region as usize] = number);
            let parts = object.iter().map(|&region| &regions[region as usize]);
            objects.push(Object { regions: object.clone(), whole: Region::united(parts) });
        }
        let number = |&label: &u32| match label {
            Labels::NONE => Labels::NONE,
            label => number_of[label as usize],
        };
        let numbers: Vec<u32> = labels.labels().iter().map(number).collect();
        let pixels = Pixels::by_number(&numbers, objects.len() as u32);
        Self { grid: *labels.grid(), numbers, objects, pixels }
    }

    /// Where the pixels lie.
    #[must_use]
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The objects, by their numbers.
    #[must_use]
    pub fn all(&self) -> &[Object] {
        &self.objects
    }

    /// The number of each pixel's object, row by row; [`REST`](Self::REST) in none, [`Labels::NONE`] without data.
    #[must_use]
    pub fn numbers(&self) -> &[u32] {
        &self.numbers
    }

    /// The pixels of an object in the box around it, where they lie in the plane.
    ///
    /// # Errors
    /// If the grid is too large for masks.
    ///
    /// # Panics
    /// If there is no such object.
    pub fn mask(&self, object: u32) -> Result<Mask, MaskError> {
        let Region { first: [left, top], last: [right, bottom], .. } =
            self.objects[object as usize].whole;
        let (columns, rows) = (right + 1 - left, bottom + 1 - top);
        let origin = self.grid.corner(left, top);
        let mut mask = Mask::empty(Grid { origin, cell: self.grid.cell, columns, rows })?;
        for &pixel in self.pixels.of(object) {
            let [column, row] = self.place(pixel);
            mask.put(column - left, row - top, true);
        }
        Ok(mask)
    }

    fn place(&self, pixel: u64) -> [u32; 2] {
        let columns = u64::from(self.grid.columns);
        [(pixel % columns) as u32, (pixel / columns) as u32]
    }

    /// The polygons of an object along the sides of its pixels, one for each part that hangs together by sides; where
    /// objects meet their corners are the same numbers. Outer rings run counterclockwise, holes clockwise.
    ///
    /// # Panics
    /// If there is no such object.
    #[must_use]
    pub fn polygons(&self, object: u32) -> Polygons {
        polygons(self.pixels.of(object), &self.grid)
    }

    pub(crate) fn windows(&self, object: u32) -> Vec<Window> {
        Window::parts(self.pixels.of(object), self.grid.columns)
    }
}
