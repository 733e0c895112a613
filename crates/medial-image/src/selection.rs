//! What is chosen of the regions of an image: all of them, some by what they are, or those at points.

use crate::labels::Labels;
use medial::geom::Point;
use std::str::FromStr;

/// What a click does with the region under it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// It becomes an object of its own, unless it is in one.
    Add,
    /// It becomes a part of the object of the click before, with all of the object that it is in.
    Combine,
    /// It is chosen no longer.
    Remove,
}

impl Action {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Add, Self::Combine, Self::Remove];

    /// Its name in commands and files.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Add => "add",
            Self::Combine => "combine",
            Self::Remove => "remove",
        }
    }
}

impl FromStr for Action {
    type Err = SelectionError;

    fn from_str(word: &str) -> Result<Self, SelectionError> {
        let found = Self::ALL.into_iter().find(|action| action.name() == word);
        found.ok_or_else(|| SelectionError::Action { word: word.to_owned() })
    }
}

/// A point that somebody chose, in the plane of the image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Click {
    /// What it does.
    pub action: Action,
    /// Where.
    pub at: Point,
}

/// Why a click chooses nothing.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SelectionError {
    /// There is no such action.
    #[error("{word:?} is no action; known are add, combine, remove")]
    Action {
        /// What was said.
        word: String,
    },
    /// It is beside the image.
    #[error(
        "the point {},{} is outside of the image, which reaches from {},{} to {},{}",
        at.x, at.y, low.x, low.y, high.x, high.y
    )]
    Outside {
        /// The point.
        at: Point,
        /// Least coordinates of the image.
        low: Point,
        /// Greatest ones.
        high: Point,
    },
    /// There is no data.
    #[error("the point {},{} is on a pixel without data (column {column}, row {row})", at.x, at.y)]
    NoData {
        /// The point.
        at: Point,
        /// Column of the pixel, from 0.
        column: u32,
        /// Its row, from 0.
        row: u32,
    },
    /// What is to be removed is not chosen.
    #[error("the point {},{} is in region {region}, which is not chosen; nothing can be removed", at.x, at.y)]
    NotChosen {
        /// The point.
        at: Point,
        /// The region there.
        region: u32,
    },
}

/// Chosen regions, put together to objects.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Selection {
    /// The regions of each object, none of them in two.
    objects: Vec<Vec<u32>>,
    /// The object of the last click.
    last: Option<usize>,
}

impl Selection {
    /// Each of these regions as an object.
    #[must_use]
    pub fn of(regions: impl IntoIterator<Item = u32>) -> Self {
        Self { objects: regions.into_iter().map(|region| vec![region]).collect(), last: None }
    }

    /// The regions of each object, none of them in two.
    #[must_use]
    pub fn objects(&self) -> &[Vec<u32>] {
        &self.objects
    }

    /// Does what a click says.
    ///
    /// ```
    /// use medial::{geom::Point, raster::Grid};
    /// use medial_image::{Action, Click, Field, Selection, thresholds};
    /// // Three stripes: dark, light, dark.
    /// let field = Field::new(Grid::of_image(3, 1), [[0.0; 3], [9.0; 3], [0.0; 3]])?;
    /// let labels = thresholds(&field, &[5.0], 1);
    /// let mut chosen = Selection::default();
    /// for (action, x) in [(Action::Add, 0.5), (Action::Combine, 2.5), (Action::Add, 1.5)] {
    ///     chosen.click(&labels, Click { action, at: Point::new(x, -0.5) })?;
    /// }
    /// assert_eq!(chosen.objects(), [vec![0, 2], vec![1]]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// If no region is there, or none to be removed.
    pub fn click(
        &mut self,
        labels: &Labels,
        Click { action, at }: Click,
    ) -> Result<(), SelectionError> {
        let region = labels.region_under(at)?;
        let known = self.objects.iter().position(|object| object.contains(&region));
        match (action, known, self.last) {
            (Action::Add, Some(known), _) => self.last = Some(known),
            (Action::Add, None, _) | (Action::Combine, None, None) => {
                self.last = Some(self.objects.len());
                self.objects.push(vec![region]);
            }
            (Action::Combine, None, Some(last)) => self.objects[last].push(region),
            (Action::Combine, Some(known), None) => self.last = Some(known),
            (Action::Combine, Some(known), Some(last)) if known == last => {}
            (Action::Combine, Some(known), Some(last)) => {
                let other = self.objects.remove(known);
                let last = last - usize::from(known < last);
                self.objects[last].extend(other);
                self.last = Some(last);
            }
            (Action::Remove, None, _) => return Err(SelectionError::NotChosen { at, region }),
            (Action::Remove, Some(known), _) => {
                self.objects[known].retain(|&other| other != region);
                if self.objects[known].is_empty() {
                    self.objects.remove(known);
                    self.last = match self.last {
                        Some(last) if last == known => None,
                        last => last.map(|last| last - usize::from(known < last)),
                    };
                }
            }
        }
        Ok(())
    }
}

impl Labels {
    /// The region under a point of the plane; a point between pixels belongs to the one with the larger column and row.
    ///
    /// # Errors
    /// If the point is outside of the image, or on a pixel without data.
    pub fn region_under(&self, at: Point) -> Result<u32, SelectionError> {
        let grid = self.grid();
        let [column, row] = grid.locate(at).map(f64::floor);
        let is_within = (0.0..f64::from(grid.columns)).contains(&column)
            && (0.0..f64::from(grid.rows)).contains(&row);
        if !is_within {
            let [a, b] = [grid.corner(0, 0), grid.corner(grid.columns, grid.rows)];
            let low = Point::new(a.x.min(b.x), a.y.min(b.y));
            let high = Point::new(a.x.max(b.x), a.y.max(b.y));
            return Err(SelectionError::Outside { at, low, high });
        }
        let (column, row) = (column as u32, row as u32);
        self.region_at(column, row).ok_or(SelectionError::NoData { at, column, row })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use medial::raster::Grid;

    /// Four stripes of one column, and one without data.
    fn stripes() -> Labels {
        let grid = Grid { origin: Point::new(100.0, 50.0), cell: [2.0, -2.0], columns: 5, rows: 1 };
        Labels::connected(grid, &[0, 1, 2, 3, Labels::NONE], |_, _| true)
    }

    fn clicked(clicks: &[(Action, f64)]) -> Result<Vec<Vec<u32>>, SelectionError> {
        let mut chosen = Selection::default();
        for &(action, x) in clicks {
            chosen.click(&stripes(), Click { action, at: Point::new(x, 49.0) })?;
        }
        Ok(chosen.objects().to_vec())
    }

    #[test]
    fn clicks_add_combine_and_remove() {
        use Action::{Add, Combine, Remove};
        assert_eq!(clicked(&[(Add, 101.0), (Add, 105.0)]), Ok(vec![vec![0], vec![2]]));
        assert_eq!(clicked(&[(Add, 101.0), (Combine, 105.0)]), Ok(vec![vec![0, 2]]));
        // What is in another object brings all of it along.
        let two = [(Add, 101.0), (Combine, 103.0), (Add, 105.0), (Combine, 101.0)];
        assert_eq!(clicked(&two), Ok(vec![vec![2, 0, 1]]));
        let wrong = [(Add, 101.0), (Combine, 103.0), (Remove, 101.0)];
        assert_eq!(clicked(&wrong), Ok(vec![vec![1]]));
        assert_eq!(clicked(&[(Add, 101.0), (Remove, 101.5)]), Ok(vec![]));
        // After its object has gone, the next one begins anew.
        let again = [(Add, 101.0), (Remove, 101.0), (Combine, 107.0)];
        assert_eq!(clicked(&again), Ok(vec![vec![3]]));
    }

    #[test]
    fn a_click_on_a_chosen_region_makes_it_the_one_to_combine_with() {
        use Action::{Add, Combine};
        let back = [(Add, 101.0), (Add, 105.0), (Add, 101.0), (Combine, 107.0)];
        assert_eq!(clicked(&back), Ok(vec![vec![0, 3], vec![2]]));
    }

    #[test]
    fn points_that_choose_nothing_are_told() {
        let told = |action, x| clicked(&[(action, x)]).unwrap_err().to_string();
        let outside = told(Action::Add, 90.0);
        assert_eq!(
            outside,
            "the point 90,49 is outside of the image, which reaches from 100,48 to 110,50"
        );
        let empty = told(Action::Add, 109.0);
        assert_eq!(empty, "the point 109,49 is on a pixel without data (column 4, row 0)");
        assert!(told(Action::Remove, 101.0).contains("region 0, which is not chosen"));
        assert!(told(Action::Add, f64::NAN).contains("outside"));
    }
}
