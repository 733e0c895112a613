//! What became of objects from one image to another of the same place.
//!
//! # Contract
//! Pixels are compared where both images have data, and nowhere else. Each object is in one change: with the object of
//! the other image that it became, or alone. Pairs are taken by their overlap, what both share of what either has,
//! the largest first; of the same, those with the smaller numbers. Linear in pixels, and n log n in pairs that overlap.

use crate::labels::Labels;
use crate::objects::Objects;
use crate::pixels::{Pixels, Polygons, polygons};
use medial::raster::Grid;
use std::collections::BTreeMap;

/// Why two images cannot be compared.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ChangeError {
    /// Pixels differ in size.
    #[error(
        "pixels are {} by {}, those to compare with {} by {}; resample one of the images",
        before[0], before[1], after[0], after[1]
    )]
    Size {
        /// From one column, and from one row, to the next, in the first image.
        before: [f64; 2],
        /// The same in the second one.
        after: [f64; 2],
    },
    /// Pixels do not lie on pixels.
    #[error("pixels lie {} columns and {} rows from those to compare with, no whole numbers; resample one of the images", shift[0], shift[1])]
    Shift {
        /// Columns and rows from the first pixel of the first image to that of the second one.
        shift: [f64; 2],
    },
    /// They have no pixel in common.
    #[error(
        "the images have no pixel with data in common, so nothing can be compared; name images of one place"
    )]
    Apart,
}

/// What an object became.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Change {
    /// The object of the first image; none of what appeared.
    pub before: Option<u32>,
    /// That of the second one; none of what vanished.
    pub after: Option<u32>,
    /// How many compared pixels are in both, in the second only, and in the first only.
    pub cells: [u64; 3],
}

/// What of the objects of an image is not compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Uncompared {
    /// How many of their pixels.
    pub cells: u64,
    /// How many objects as a whole, which are in no change.
    pub objects: u64,
}

/// Which pixels of a change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// Those in both images.
    Kept,
    /// Those in the second one only.
    Gained,
    /// Those in the first one only.
    Lost,
    /// Those in either.
    All,
}

/// All changes between two images.
#[derive(Clone, Debug, PartialEq)]
pub struct Changes {
    /// What is common to both images.
    grid: Grid,
    /// For each pixel the numbers of the changes that it belongs to before and after.
    numbers: [Vec<u32>; 2],
    list: Vec<Change>,
    uncompared: [Uncompared; 2],
}

/// How far pixels may lie from those of the other image, in columns or rows.
///
/// Origins of georeferenced images are rounded; the pixels of both are then taken to be the same.
const OFF: f64 = 1e-2;

/// By how much the sizes of pixels may differ, over the width of an image, in pixels.
const STRETCH: f64 = 0.5;

impl Change {
    /// The share of the pixels in both of those in either.
    #[must_use]
    pub fn overlap(&self) -> f64 {
        let all: u64 = self.cells.iter().sum();
        self.cells[0] as f64 / all.max(1) as f64
    }
}

impl Changes {
    /// The changes from the objects of one image to those of another; a pair has to overlap by more than a share.
    ///
    /// # Errors
    /// If the pixels of both images are not the same in size and place, or none is in both.
    pub fn new(before: &Objects, after: &Objects, least: f64) -> Result<Self, ChangeError> {
        let (first, second) = (before.grid(), after.grid());
        if are_apart(first, second) {
            return Err(ChangeError::Apart);
        }
        let n = f64::from(first.columns.max(first.rows).max(second.columns).max(second.rows));
        let is_same =
            |k: usize| (second.cell[k] - first.cell[k]).abs() * n <= STRETCH * first.cell[k].abs();
        if !(is_same(0) && is_same(1)) {
            return Err(ChangeError::Size { before: first.cell, after: second.cell });
        }
        // Zeros have no sign.
        let shift = first.locate(second.origin).map(|way| way + 0.0);
        if shift.iter().any(|way| (way - way.round()).abs() > OFF) {
            return Err(ChangeError::Shift { shift });
        }
        // Columns and rows of the first image, from and up to.
        let span = |k: usize| {
            let (a, b) = ([first.columns, first.rows][k], [second.columns, second.rows][k]);
            let way = shift[k].round();
            let low = way.max(0.0);
            let high = (way + f64::from(b)).min(f64::from(a));
            (low as u32, high.max(low) as u32, (low - way) as u32)
        };
        let ((left, right, from), (top, bottom, down)) = (span(0), span(1));
        let (columns, rows) = (right - left, bottom - top);
        if columns == 0 || rows == 0 {
            return Err(ChangeError::Apart);
        }
        let grid = Grid { origin: first.corner(left, top), cell: first.cell, columns, rows };
        let row = |of: &Objects, x: u32, y: u32| {
            let start = y as usize * of.grid().columns as usize + x as usize;
            start..start + columns as usize
        };
        let mut pairs: BTreeMap<(u32, u32), u64> = BTreeMap::new();
        let mut totals = [before, after].map(|objects| vec![0_u64; objects.all().len()]);
        let mut numbers = [(); 2].map(|()| Vec::with_capacity(columns as usize * rows as usize));
        let mut n_compared = 0_u64;
        for y in 0..rows {
            let a = &before.numbers()[row(before, left, top + y)];
            let b = &after.numbers()[row(after, from, down + y)];
            for (&a, &b) in a.iter().zip(b) {
                let is_known = a != Labels::NONE && b != Labels::NONE;
                let [a, b] = [a, b].map(|k| if is_known && k != Objects::REST { k } else { NONE });
                n_compared += u64::from(is_known);
                numbers[0].push(a);
                numbers[1].push(b);
                if a != NONE {
                    totals[0][a as usize] += 1;
                }
                if b != NONE {
                    totals[1][b as usize] += 1;
                }
                if a != NONE && b != NONE {
                    *pairs.entry((a, b)).or_default() += 1;
                }
            }
        }
        if n_compared == 0 {
            return Err(ChangeError::Apart);
        }
        let uncompared = [(before, &totals[0]), (after, &totals[1])].map(|(objects, totals)| {
            let all: u64 = objects.all().iter().map(|object| object.whole.cells).sum();
            Uncompared {
                cells: all - totals.iter().sum::<u64>(),
                objects: totals.iter().filter(|&&n| n == 0).count() as u64,
            }
        });
        let list = matched(&pairs, &totals, least);
        // Numbers of objects become numbers of changes.
        for (side, numbers) in numbers.iter_mut().enumerate() {
            let mut of = vec![NONE; totals[side].len()];
            for (number, change) in (0..).zip(&list) {
                if let Some(object) = [change.before, change.after][side] {
                    of[object as usize] = number;
                }
            }
            numbers.iter_mut().filter(|k| **k != NONE).for_each(|k| *k = of[*k as usize]);
        }
        Ok(Self { grid, numbers, list, uncompared })
    }

    /// What is common to both images.
    #[must_use]
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// What of the objects of the first image and of the second one is not compared, as the other has no data there.
    #[must_use]
    pub fn uncompared(&self) -> [Uncompared; 2] {
        self.uncompared
    }

    /// All changes: by the number of the object before, then what appeared by its number.
    #[must_use]
    pub fn list(&self) -> &[Change] {
        &self.list
    }

    /// The polygons of a part of each change, in their order, one for what hangs together by sides. Linear in pixels and
    /// boxes of objects.
    pub fn polygons(&self, part: Part) -> impl Iterator<Item = Polygons> + '_ {
        let number = |(&before, &after): (&u32, &u32)| match part {
            Part::Kept if before == after => before,
            Part::Gained if before != after => after,
            Part::Lost if before != after => before,
            _ => NONE,
        };
        let [before, after] = &self.numbers;
        let n = self.list.len() as u32;
        let lists: Vec<Pixels> = match part {
            // A pixel may be in the change of what was there and in that of what is there.
            Part::All => vec![Pixels::by_number(before, n), Pixels::by_number(after, n)],
            _ => {
                let of: Vec<u32> = before.iter().zip(after).map(number).collect();
                vec![Pixels::by_number(&of, n)]
            }
        };
        (0..n).map(move |change| {
            let mut pixels: Vec<u64> =
                lists.iter().flat_map(|list| list.of(change)).copied().collect();
            pixels.sort_unstable();
            pixels.dedup();
            polygons(&pixels, &self.grid)
        })
    }
}

/// Whether two images have no part of the plane in common.
fn are_apart(first: &Grid, second: &Grid) -> bool {
    let ends = [(0, 0), (second.columns, second.rows)].map(|(x, y)| second.corner(x, y));
    let [a, b] = ends.map(|end| first.locate(end));
    (0..2).any(|k| {
        let n = f64::from([first.columns, first.rows][k]);
        a[k].min(b[k]) >= n - OFF || a[k].max(b[k]) <= OFF
    })
}

/// No object.
const NONE: u32 = u32::MAX;

/// The changes of objects with so many pixels, and so many in pairs.
fn matched(pairs: &BTreeMap<(u32, u32), u64>, totals: &[Vec<u64>; 2], least: f64) -> Vec<Change> {
    let change = |(&(a, b), &both): (&(u32, u32), &u64)| Change {
        before: Some(a),
        after: Some(b),
        cells: [both, totals[1][b as usize] - both, totals[0][a as usize] - both],
    };
    let mut known: Vec<Change> =
        pairs.iter().map(change).filter(|change| change.overlap() > least).collect();
    // Stable, so that pairs with the same overlap stay in the order of their numbers.
    known.sort_by(|a, b| b.overlap().total_cmp(&a.overlap()));
    let mut is_taken = totals.each_ref().map(|totals| vec![false; totals.len()]);
    let mut list: Vec<Change> = Vec::new();
    for change in known {
        let (Some(a), Some(b)) = (change.before, change.after) else { continue };
        if !is_taken[0][a as usize] && !is_taken[1][b as usize] {
            (is_taken[0][a as usize], is_taken[1][b as usize]) = (true, true);
            list.push(change);
        }
    }
    for (side, totals) in totals.iter().enumerate() {
        // Those of which no pixel is compared are in no change.
        let alone =
            (0..).zip(totals).filter(|&(k, &n): &(u32, _)| n > 0 && !is_taken[side][k as usize]);
        list.extend(alone.map(|(object, &n)| match side {
            0 => Change { before: Some(object), after: None, cells: [0, 0, n] },
            _ => Change { before: None, after: Some(object), cells: [0, n, 0] },
        }));
    }
    list.sort_by_key(|change| (change.before.unwrap_or(NONE), change.after.unwrap_or(NONE)));
    list
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::Field;
    use crate::selection::Selection;
    use medial::geom::Point;

    /// The objects of an image drawn in letters: each letter is a region, but for dots, which are not chosen, and blanks,
    /// which have no data.
    fn objects(rows: &[&str], origin: Point) -> Objects {
        let grid = Grid { origin, ..Grid::of_image(rows[0].len() as u32, rows.len() as u32) };
        let letters: Vec<u8> = rows.iter().flat_map(|row| row.bytes()).collect();
        let class: Vec<u32> =
            letters.iter().map(|&c| if c == b' ' { Labels::NONE } else { c.into() }).collect();
        let labels = Labels::connected(grid, &class, |_, _| true);
        let values = letters.iter().map(|&c| if c == b' ' { [f32::NAN; 3] } else { [c.into(); 3] });
        let regions = labels.regions(&Field::new(grid, values).unwrap());
        let is_chosen = |region: &u32| regions[*region as usize].mean[0] != f32::from(b'.');
        let chosen = Selection::of((0..labels.len()).filter(is_chosen));
        Objects::new(&labels, &regions, &chosen)
    }

    fn at(x: f64, y: f64) -> Point {
        Point::new(x, y)
    }

    #[test]
    fn objects_stay_appear_vanish_and_change() {
        let before = objects(&["aa..b", "aa...", ".....", "cc..."], at(0.0, 0.0));
        let after = objects(&["aaa..", "aaa..", ".....", "cc..d"], at(0.0, 0.0));
        let changes = Changes::new(&before, &after, 0.0).unwrap();
        let found: Vec<_> = changes.list().iter().map(|c| (c.before, c.after, c.cells)).collect();
        assert_eq!(
            found,
            [
                (Some(0), Some(0), [4, 2, 0]),
                (Some(1), None, [0, 0, 1]),
                (Some(2), Some(1), [2, 0, 0]),
                (None, Some(2), [0, 1, 0]),
            ]
        );
        assert!((changes.list()[0].overlap() - 4.0 / 6.0).abs() < 1e-12);
        let gained: Vec<_> = changes.polygons(Part::Gained).collect();
        // Column 2, rows 0 and 1.
        assert_eq!(
            gained[0],
            [vec![vec![at(2.0, 0.0), at(2.0, -2.0), at(3.0, -2.0), at(3.0, 0.0)]]]
        );
        assert_eq!(gained.iter().map(Vec::len).collect::<Vec<_>>(), [1, 0, 0, 1]);
        let n = |part| changes.polygons(part).map(|p| p.len()).collect::<Vec<_>>();
        assert_eq!(n(Part::Lost), [0, 1, 0, 0]);
        assert_eq!(n(Part::Kept), [1, 0, 1, 0]);
        assert_eq!(n(Part::All), [1; 4]);
    }

    #[test]
    fn an_object_becomes_the_one_that_it_overlaps_most() {
        let before = objects(&["aaaaaa"], at(0.0, 0.0));
        let after = objects(&["aabbbb"], at(0.0, 0.0));
        let changes = Changes::new(&before, &after, 0.0).unwrap();
        let found: Vec<_> = changes.list().iter().map(|c| (c.before, c.after)).collect();
        assert_eq!(found, [(Some(0), Some(1)), (None, Some(0))]);
        // The second one has what the first one lost, so these pixels are in both changes.
        assert_eq!(changes.list()[1].cells, [0, 2, 0]);
        let changes = Changes::new(&before, &after, 0.7).unwrap();
        assert_eq!(changes.list().len(), 3);
    }

    #[test]
    fn only_what_both_images_have_is_compared() {
        // The second image begins one column to the right, and has no data in its second column.
        let before = objects(&["aaab"], at(0.0, 0.0));
        let after = objects(&["a aaa"], at(1.0, 0.0));
        let changes = Changes::new(&before, &after, 0.0).unwrap();
        assert_eq!(changes.grid().columns, 3);
        let found: Vec<_> = changes.list().iter().map(|c| (c.before, c.after, c.cells)).collect();
        assert_eq!(
            found,
            [(Some(0), Some(0), [1, 0, 0]), (Some(1), Some(1), [1, 0, 0])],
            "columns 1 and 3 of the first image"
        );
        // Columns 0 and 2, and the last two of the second image.
        let uncompared = [(2, 0), (2, 0)].map(|(cells, objects)| Uncompared { cells, objects });
        assert_eq!(changes.uncompared(), uncompared);
        let beside = Changes::new(&before, &objects(&["b.c"], at(3.0, 0.0)), 0.0).unwrap();
        let uncompared = [(3, 1), (1, 1)].map(|(cells, objects)| Uncompared { cells, objects });
        assert_eq!(beside.uncompared(), uncompared);
    }

    #[test]
    fn images_that_do_not_fit_are_told() {
        let before = objects(&["aa"], at(0.0, 0.0));
        let shifted = Changes::new(&before, &objects(&["aa"], at(0.5, 0.0)), 0.0);
        assert_eq!(shifted, Err(ChangeError::Shift { shift: [0.5, 0.0] }));
        // However they lie.
        for far in [at(7.0, 0.0), at(7.3, 0.0), at(0.0, 1.5), at(-2.0, 0.0), at(1e12, 0.5)] {
            let apart = Changes::new(&before, &objects(&["aa"], far), 0.0);
            assert_eq!(apart, Err(ChangeError::Apart), "{far:?}");
        }
    }
}
