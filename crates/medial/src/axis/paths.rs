//! The paths of an axis: their governors are neighbours in the list of the keypoint where they start.

use super::Path;
use super::keypoints::KeypointTable;
use super::views::view;

/// What keeps the paths: nine bytes each.
///
/// The governors of a path are two neighbouring contacts of the keypoint where it starts, so the place
/// of the right one in its list says both.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct PathTable {
    /// Keypoints where they start and end.
    ends: Vec<[u32; 2]>,
    /// Place of the right governor, or [`LISTED`].
    places: Vec<u8>,
    /// The few paths whose governors have to be said, in their order.
    listed: Vec<Listed>,
}

const LISTED: u8 = u8::MAX;

/// The governors of a path.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Listed {
    path: u32,
    left: u32,
    right: u32,
}

impl PathTable {
    /// An empty table with room for some paths.
    pub fn with_room(paths: usize) -> Self {
        let (ends, places) = (Vec::with_capacity(paths), Vec::with_capacity(paths));
        Self { ends, places, listed: Vec::new() }
    }

    /// The table of all these, between keypoints of that table.
    pub fn of(paths: impl ExactSizeIterator<Item = Path>, keypoints: &KeypointTable) -> Self {
        let mut table = Self::with_room(paths.len());
        for path in paths {
            table.push(&path, keypoints);
        }
        table
    }

    /// Gives back the room that was not needed.
    pub fn shrink(&mut self) {
        self.ends.shrink_to_fit();
        self.places.shrink_to_fit();
        self.listed.shrink_to_fit();
    }

    /// Adds a path. It takes least room if it starts at a keypoint of that table, between two
    /// neighbouring governors.
    #[inline(always)]
    pub fn push(&mut self, path: &Path, keypoints: &KeypointTable) {
        let Path { from, to, left, right } = *path;
        let three = keypoints.three(from);
        let Some(place) = three.and_then(|list| place_of_three(list, left, right)) else {
            return self.push_any(path, keypoints);
        };
        self.ends.push([from, to]);
        self.places.push(place);
    }

    /// The same for a path that starts at a keypoint of not just three governors, or not between two.
    #[cold]
    #[inline(never)]
    fn push_any(&mut self, &Path { from, to, left, right }: &Path, keypoints: &KeypointTable) {
        let known = from < keypoints.len();
        let place = if known { place(keypoints.governors(from), left, right) } else { LISTED };
        if place == LISTED {
            self.listed.push(Listed { path: self.len(), left, right });
        }
        self.ends.push([from, to]);
        self.places.push(place);
    }

    /// Adds the paths of another table, between the same keypoints.
    #[cfg(feature = "parallel")]
    pub fn append(&mut self, other: &Self) {
        let first = self.len();
        self.ends.extend_from_slice(&other.ends);
        self.places.extend_from_slice(&other.places);
        self.listed.extend(other.listed.iter().map(|l| Listed { path: first + l.path, ..*l }));
    }

    pub fn len(&self) -> u32 {
        self.ends.len() as u32
    }

    /// Forgets all paths from this number on.
    pub fn truncate(&mut self, len: u32) {
        self.ends.truncate(len as usize);
        self.places.truncate(len as usize);
        self.listed.truncate(self.listed.partition_point(|l| l.path < len));
    }

    /// A path, with the keypoints between which it was added.
    #[inline]
    pub fn at(&self, path: u32, keypoints: &KeypointTable) -> Path {
        let [from, to] = self.ends[path as usize];
        let place = self.places[path as usize];
        let (left, right) = if place == LISTED {
            let Listed { left, right, .. } = self.listed_at(path);
            (left, right)
        } else {
            keypoints.neighbours(from, place)
        };
        Path { from, to, left, right }
    }

    #[cold]
    fn listed_at(&self, path: u32) -> Listed {
        self.listed[self.listed.partition_point(|l| l.path < path)]
    }

    /// Adds a path of another table between two keypoints. The one where it starts has the governors of that
    /// where it starts there, in their order, but for their numbers.
    #[inline]
    pub fn push_of(&mut self, other: &Self, path: u32, ends: [u32; 2], site: impl Fn(u32) -> u32) {
        let place = other.places[path as usize];
        if place == LISTED {
            let Listed { left, right, .. } = other.listed_at(path);
            self.listed.push(Listed { path: self.len(), left: site(left), right: site(right) });
        }
        self.ends.push(ends);
        self.places.push(place);
    }

    /// Whether all keypoints and all governors that are listed are less than these numbers.
    pub fn numbers_below(&self, keypoints: u32, sites: u32) -> bool {
        self.ends.iter().all(|[from, to]| *from < keypoints && *to < keypoints)
            && self.listed.iter().all(|l| l.left < sites && l.right < sites)
    }

    /// Gives the governors that are listed other numbers; the rest change with the keypoints.
    pub fn renumber(&mut self, number: impl Fn(u32) -> u32) {
        for listed in &mut self.listed {
            (listed.left, listed.right) = (number(listed.left), number(listed.right));
        }
    }
}

/// Where in a cyclic list of three the right governor stands right before the left one.
///
/// Which of the three it is cannot be foreseen, so nothing branches on it.
#[inline(always)]
fn place_of_three([a, b, c]: [u32; 3], left: u32, right: u32) -> Option<u8> {
    let [first, second, third] =
        [(a, b), (b, c), (c, a)].map(|pair| u8::from(pair == (right, left)));
    (first | second | third != 0).then_some(second + 2 * third)
}

/// Where in a cyclic list the right governor stands right before the left one.
fn place(list: &[u32], left: u32, right: u32) -> u8 {
    let next = |k: usize| list[if k + 1 < list.len() { k + 1 } else { 0 }];
    let places = 0..list.len().min(usize::from(LISTED));
    places.into_iter().find(|&k| (list[k], next(k)) == (right, left)).map_or(LISTED, |k| k as u8)
}

/// The paths of an axis, numbered from 0; a [`Path`] is put together when it is asked for.
///
/// An axis keeps 9 bytes for each path.
#[derive(Clone, Copy)]
pub struct Paths<'a> {
    pub(super) paths: &'a PathTable,
    pub(super) keypoints: &'a KeypointTable,
}

impl<'a> Paths<'a> {
    /// How many there are.
    #[must_use]
    pub fn len(self) -> usize {
        self.paths.ends.len()
    }

    /// Path number `number`.
    ///
    /// # Panics
    /// If the axis has no such path.
    #[inline]
    #[must_use]
    pub fn at(self, number: u32) -> Path {
        self.paths.at(number, self.keypoints)
    }

    /// The keypoints where a path starts and ends; who does not need its governors saves most of the time.
    #[inline]
    pub(crate) fn ends(self, number: u32) -> [u32; 2] {
        self.paths.ends[number as usize]
    }

    /// The paths whose governors are no two neighbours in the list of the keypoint where they start.
    pub(crate) fn listed(self) -> impl Iterator<Item = u32> + use<'a> {
        self.paths.listed.iter().map(|listed| listed.path)
    }

    /// The same for all of them, in their order.
    pub(crate) fn all_ends(self) -> impl ExactSizeIterator<Item = [u32; 2]> + use<'a> {
        self.paths.ends.iter().copied()
    }
}

view! {
    Paths of Path;
    /// The paths of an axis, one after the other, by value.
    PathsIter
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::axis::{Keypoint, KeypointKind};
    use crate::geom::Point;

    /// Three keypoints: with three governors, with two, and with 300.
    fn keypoints() -> KeypointTable {
        let mut table = KeypointTable::default();
        let keypoint =
            Keypoint { position: Point::default(), radius: 1.0, kind: KeypointKind::Junction };
        table.push(&keypoint, [4, 2, 7].into_iter());
        table.push(&keypoint, [2, 7].into_iter());
        table.push(&keypoint, 0..300);
        table
    }

    fn path(from: u32, to: u32, right: u32, left: u32) -> Path {
        Path { from, to, left, right }
    }

    #[test]
    fn paths_are_given_back_as_they_came() {
        let keypoints = keypoints();
        let neighbours = [
            path(0, 1, 4, 2),
            path(0, 2, 2, 7),
            path(0, 0, 7, 4),
            path(1, 0, 7, 2),
            path(1, 0, 2, 7),
            path(2, 1, 254, 255),
        ];
        let others = [path(0, 1, 2, 4), path(2, 1, 255, 256), path(2, 0, 299, 0), path(9, 9, 1, 2)];
        let mut table = PathTable::of(neighbours.into_iter(), &keypoints);
        assert_eq!(table.listed, []);
        table.append(&PathTable::of(others.into_iter(), &keypoints));
        assert_eq!(table.listed.len(), 4);
        let all: Vec<Path> = (0..table.len()).map(|k| table.at(k, &keypoints)).collect();
        assert_eq!(all, [&neighbours[..], &others].concat());
        table.truncate(7);
        assert_eq!((table.len(), table.listed.len()), (7, 1));
        table.truncate(6);
        assert_eq!(table, PathTable::of(neighbours.into_iter(), &keypoints));
    }

    #[test]
    fn governors_change_with_those_of_the_keypoints() {
        let mut keypoints = keypoints();
        let paths = [path(0, 1, 4, 2), path(0, 1, 2, 4)];
        let mut table = PathTable::of(paths.into_iter(), &keypoints);
        assert!(table.numbers_below(2, 5) && !table.numbers_below(1, 5));
        assert!(!table.numbers_below(2, 4));
        let new = |g: u32| g + 1;
        keypoints.renumber(new);
        table.renumber(new);
        assert_eq!(table.at(0, &keypoints), path(0, 1, 5, 3));
        assert_eq!(table.at(1, &keypoints), path(0, 1, 3, 5));
    }
}
