//! The keypoints of an axis with their governors: most have three, which are kept side by side.

use std::ops::Range;

use super::views::view;
use super::{Keypoint, KeypointKind};
use crate::geom::Point;

/// What keeps the keypoints: 37 bytes each, and some more where there are more than three governors.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct KeypointTable {
    /// Positions and radii.
    disks: Vec<(Point, f64)>,
    kinds: Vec<KeypointKind>,
    /// The three governors; or two and [`TWO`]; or where in `more` they start, how many they are, and
    /// [`MORE`].
    lists: Vec<[u32; 3]>,
    more: Vec<u32>,
}

/// The number of a keypoint of which nothing is left.
pub(crate) const GONE: u32 = u32::MAX;

/// More than the number of any site.
const TWO: u32 = u32::MAX;
const MORE: u32 = u32::MAX - 1;

impl KeypointTable {
    /// An empty table with room for some keypoints.
    pub fn with_room(keypoints: usize) -> Self {
        Self {
            disks: Vec::with_capacity(keypoints),
            kinds: Vec::with_capacity(keypoints),
            lists: Vec::with_capacity(keypoints),
            more: Vec::new(),
        }
    }

    /// Makes room for some more keypoints.
    #[cfg(feature = "parallel")]
    pub fn reserve(&mut self, keypoints: usize) {
        self.disks.reserve(keypoints);
        self.kinds.reserve(keypoints);
        self.lists.reserve(keypoints);
    }

    /// Gives back the room that was not needed.
    pub fn shrink(&mut self) {
        self.disks.shrink_to_fit();
        self.kinds.shrink_to_fit();
        self.lists.shrink_to_fit();
        self.more.shrink_to_fit();
    }

    /// Adds a keypoint with its governors.
    #[inline(always)]
    pub fn push(
        &mut self,
        keypoint: &Keypoint,
        governors: impl ExactSizeIterator<Item = u32> + Clone,
    ) {
        let mut few = governors.clone();
        let list = match (governors.len(), few.next(), few.next(), few.next()) {
            (3, Some(a), Some(b), Some(c)) => [a, b, c],
            (2, Some(a), Some(b), None) => [a, b, TWO],
            (n, ..) => {
                let first = self.more.len() as u32;
                self.more.extend(governors);
                [first, n as u32, MORE]
            }
        };
        let Keypoint { position, radius, kind } = *keypoint;
        self.disks.push((position, radius));
        self.kinds.push(kind);
        self.lists.push(list);
    }

    /// Adds keypoints of another table.
    #[cfg(feature = "parallel")]
    pub fn copy(&mut self, other: &Self, keypoints: Range<u32>) {
        let range = keypoints.start as usize..keypoints.end as usize;
        self.disks.extend_from_slice(&other.disks[range.clone()]);
        self.kinds.extend_from_slice(&other.kinds[range.clone()]);
        for list in &other.lists[range] {
            self.lists.push(match *list {
                [first, n, MORE] => {
                    let start = self.more.len() as u32;
                    self.more.extend_from_slice(&other.more[first as usize..][..n as usize]);
                    [start, n, MORE]
                }
                list => list,
            });
        }
    }

    pub fn len(&self) -> u32 {
        self.disks.len() as u32
    }

    /// Forgets all keypoints from this number on.
    pub fn truncate(&mut self, len: u32) {
        let len = len as usize;
        let first = self.lists.get(len..).unwrap_or_default().iter().find(|list| list[2] == MORE);
        self.more.truncate(first.map_or(self.more.len(), |list| list[0] as usize));
        self.disks.truncate(len);
        self.kinds.truncate(len);
        self.lists.truncate(len);
    }

    #[inline]
    pub fn at(&self, keypoint: u32) -> Keypoint {
        let k = keypoint as usize;
        let (position, radius) = self.disks[k];
        Keypoint { position, radius, kind: self.kinds[k] }
    }

    /// Makes a keypoint one of another kind.
    pub fn set_kind(&mut self, keypoint: u32, kind: KeypointKind) {
        self.kinds[keypoint as usize] = kind;
    }

    /// Governors of a keypoint.
    #[inline]
    pub fn governors(&self, keypoint: u32) -> &[u32] {
        match &self.lists[keypoint as usize] {
            &[first, n, MORE] => &self.more[first as usize..][..n as usize],
            [list @ .., TWO] => list,
            list => list,
        }
    }

    /// The governor of a keypoint after a place in its list, and the one at that place.
    #[inline]
    pub fn neighbours(&self, keypoint: u32, place: u8) -> (u32, u32) {
        let list = &self.lists[keypoint as usize];
        let place = usize::from(place);
        match list[2] {
            MORE => {
                let list = self.governors(keypoint);
                (list[if place + 1 < list.len() { place + 1 } else { 0 }], list[place])
            }
            third => {
                // Whether there are two or three is hard to foresee, so nothing branches on it.
                let last = if third == TWO { 1 } else { 2 };
                (list[if place < last { place + 1 } else { 0 }], list[place])
            }
        }
    }

    /// How many places there are for governors, if all lists stand in one row: three for each keypoint, then
    /// those of longer lists.
    pub fn n_places(&self) -> usize {
        3 * self.lists.len() + self.more.len()
    }

    /// The places of the governors of a keypoint in that row.
    #[inline]
    pub fn places(&self, keypoint: u32) -> Range<usize> {
        let first = 3 * keypoint as usize;
        match self.lists[keypoint as usize] {
            [more, n, MORE] => {
                let first = 3 * self.lists.len() + more as usize;
                first..first + n as usize
            }
            [_, _, TWO] => first..first + 2,
            _ => first..first + 3,
        }
    }

    /// The place of a governor of a keypoint in that row.
    #[inline(always)]
    pub fn place_of(&self, keypoint: u32, governor: u32) -> Option<usize> {
        let [a, b, c] = self.lists[keypoint as usize];
        if c == MORE {
            return self.place_of_many(keypoint, governor);
        }
        // Which of the three it is cannot be foreseen, so nothing branches on it.
        let place = if b == governor { 1 } else { 2 };
        let place = if a == governor { 0 } else { place };
        let is_one = (a == governor) | (b == governor) | (c == governor);
        is_one.then_some(3 * keypoint as usize + place)
    }

    #[cold]
    #[inline(never)]
    fn place_of_many(&self, keypoint: u32, governor: u32) -> Option<usize> {
        let place = self.governors(keypoint).iter().position(|&known| known == governor);
        place.map(|place| self.places(keypoint).start + place)
    }

    /// A table of the keypoints of which something is left, in their order, with room for so many and so many
    /// more. `left` says how much of each is left; its new number takes the place of that, or [`GONE`]. Kinds
    /// depend on both. All governors are shown, some more than once.
    #[inline]
    pub fn left(
        &self,
        [kept, more]: [usize; 2],
        left: &mut [u32],
        kind: impl Fn(u32, KeypointKind) -> KeypointKind,
        mut show: impl FnMut(u32),
    ) -> Self {
        let mut table = Self::with_room(kept + more);
        let mut number = 0;
        let all = left.iter_mut().zip(&self.disks).zip(self.kinds.iter().zip(&self.lists));
        for ((left, disk), (&was, list)) in all {
            if *left == 0 {
                *left = GONE;
                continue;
            }
            table.disks.push(*disk);
            table.kinds.push(kind(*left, was));
            *left = number;
            number += 1;
            let [a, b, c] = *list;
            if c == MORE {
                let governors = &self.more[a as usize..][..b as usize];
                table.lists.push([table.more.len() as u32, b, MORE]);
                table.more.extend_from_slice(governors);
                governors.iter().copied().for_each(&mut show);
            } else {
                table.lists.push(*list);
                [a, b, if c == TWO { a } else { c }].into_iter().for_each(&mut show);
            }
        }
        table
    }

    /// Governors of a keypoint, if there is such a keypoint and they are three.
    #[inline(always)]
    pub fn three(&self, keypoint: u32) -> Option<[u32; 3]> {
        self.lists.get(keypoint as usize).copied().filter(|list| list[2] < MORE)
    }

    /// Whether all governors are less than a number.
    pub fn governors_below(&self, bound: u32) -> bool {
        let mut largest = None;
        self.show_governors(|g| largest = largest.max(Some(g)));
        largest.is_none_or(|g| g < bound)
    }

    /// Shows all governors of all keypoints; of two, one is shown twice.
    pub fn show_governors(&self, mut show: impl FnMut(u32)) {
        for &[a, b, c] in &self.lists {
            if c != MORE {
                // Whether there are two or three is hard to foresee, so nothing branches on it.
                [a, b, if c == TWO { a } else { c }].into_iter().for_each(&mut show);
            }
        }
        self.more.iter().copied().for_each(show);
    }

    /// Gives every governor another number.
    pub fn renumber(&mut self, number: impl Fn(u32) -> u32) {
        for list in &mut self.lists {
            let [a, b, c] = *list;
            if c != MORE {
                let third = number(if c == TWO { a } else { c });
                *list = [number(a), number(b), if c == TWO { TWO } else { third }];
            }
        }
        for governor in &mut self.more {
            *governor = number(*governor);
        }
    }
}

/// The keypoints of an axis, numbered from 0; a [`Keypoint`] is put together when it is asked for.
///
/// An axis keeps 37 bytes for each keypoint and its governors, where they are not more than three.
#[derive(Clone, Copy)]
pub struct Keypoints<'a>(pub(super) &'a KeypointTable);

impl Keypoints<'_> {
    /// How many there are.
    #[must_use]
    pub fn len(self) -> usize {
        self.0.disks.len()
    }

    /// Keypoint number `number`, counted as [`Path`](super::Path) counts.
    ///
    /// # Panics
    /// If the axis has no such keypoint.
    #[inline]
    #[must_use]
    pub fn at(self, number: u32) -> Keypoint {
        self.0.at(number)
    }
}

view! {
    Keypoints of Keypoint;
    /// The keypoints of an axis, one after the other, by value.
    KeypointsIter
}

#[cfg(test)]
mod tests {
    use super::*;

    fn keypoint(x: f64) -> Keypoint {
        Keypoint { position: Point::new(x, -x), radius: x / 2.0, kind: KeypointKind::Junction }
    }

    /// Keypoints with that many governors each.
    fn table(degrees: &[usize]) -> KeypointTable {
        let mut table = KeypointTable::default();
        for (k, &n) in degrees.iter().enumerate() {
            let governors: Vec<u32> = (0..n as u32).map(|g| 10 * k as u32 + g).collect();
            table.push(&keypoint(k as f64), governors.into_iter());
        }
        table
    }

    #[test]
    fn lists_of_any_length_are_kept() {
        let degrees = [3, 2, 5, 3, 0, 1, 4];
        let table = table(&degrees);
        for (k, &n) in degrees.iter().enumerate() {
            let governors: Vec<u32> = (0..n as u32).map(|g| 10 * k as u32 + g).collect();
            assert_eq!(table.governors(k as u32), governors);
            assert_eq!(table.at(k as u32), keypoint(k as f64));
        }
        let mut shown = Vec::new();
        table.show_governors(|g| shown.push(g));
        shown.sort_unstable();
        shown.dedup();
        assert_eq!(shown.len(), degrees.iter().sum());
        assert!(table.governors_below(64) && !table.governors_below(63));
    }

    #[test]
    fn a_copy_of_some_is_the_table_of_these() {
        let table = table(&[3, 2, 5, 3, 4, 6, 2]);
        let mut some = KeypointTable::default();
        some.copy(&table, 4..6);
        some.copy(&table, 1..3);
        let lists: Vec<&[u32]> = (0..4).map(|k| some.governors(k)).collect();
        assert_eq!(lists, [4, 5, 1, 2].map(|k| table.governors(k)));
    }

    #[test]
    fn what_is_forgotten_leaves_nothing() {
        for len in 0..6 {
            let mut longer = table(&[3, 4, 2, 5, 3, 6]);
            longer.truncate(len);
            assert_eq!(longer, table(&[3, 4, 2, 5, 3, 6][..len as usize]));
        }
    }

    #[test]
    fn every_governor_gets_its_new_number() {
        let mut table = table(&[3, 2, 4]);
        table.renumber(|g| 2 * g);
        let lists: Vec<&[u32]> = (0..3).map(|k| table.governors(k)).collect();
        assert_eq!(lists, [&[0, 2, 4][..], &[20, 22], &[40, 42, 44, 46]]);
    }
}
