//! Numbers by group.

use std::ops::Range;

use crate::axis::MedialAxis;

/// Numbers sorted into groups, within each in the order in which they came.
#[derive(Debug)]
pub(super) struct Groups {
    /// Where each group starts among the members; the last one ends at the last number.
    first: Vec<u32>,
    members: Vec<u32>,
}

impl Groups {
    /// So many groups, from pairs of a group and a member, which are asked for twice.
    pub fn new<I: Iterator<Item = (u32, u32)>>(groups: usize, pairs: impl Fn() -> I) -> Self {
        let mut first = vec![0_u32; groups + 1];
        pairs().for_each(|(group, _)| first[group as usize + 1] += 1);
        for k in 1..first.len() {
            first[k] += first[k - 1];
        }
        let mut place = first.clone();
        let mut members = vec![0; first[groups] as usize];
        for (group, member) in pairs() {
            members[place[group as usize] as usize] = member;
            place[group as usize] += 1;
        }
        Self { first, members }
    }

    /// The paths at each keypoint of an axis.
    pub fn paths_at_keypoints(axis: &MedialAxis) -> Self {
        let ends =
            || (0..).zip(axis.paths().all_ends()).flat_map(|(k, [from, to])| [(from, k), (to, k)]);
        Self::new(axis.keypoints().len(), ends)
    }

    /// All members, group by group.
    pub fn all(&self) -> &[u32] {
        &self.members
    }

    pub fn of(&self, group: u32) -> &[u32] {
        &self.members[self.range(group)]
    }

    /// The places of a group's members among all of them.
    pub fn range(&self, group: u32) -> Range<usize> {
        let k = group as usize;
        self.first[k] as usize..self.first[k + 1] as usize
    }
}

/// The paths at each keypoint of an axis, for who mostly asks for few: found in one pass.
pub(super) struct Incidence {
    around: Vec<Around>,
    /// The fourth path at a keypoint and those after it, sorted by keypoint.
    more: Vec<(u32, u32)>,
}

/// The paths at a keypoint: how many, and the first three.
#[derive(Clone, Copy)]
struct Around {
    degree: u32,
    numbers: [u32; 3],
}

impl Incidence {
    pub fn new(axis: &MedialAxis) -> Self {
        let mut around = vec![Around { degree: 0, numbers: [0; 3] }; axis.keypoints().len()];
        let mut more = Vec::new();
        for (number, ends) in (0..).zip(axis.paths().all_ends()) {
            for keypoint in ends {
                let Around { degree, numbers } = &mut around[keypoint as usize];
                match numbers.get_mut(*degree as usize) {
                    Some(place) => *place = number,
                    None => more.push((keypoint, number)),
                }
                *degree += 1;
            }
        }
        // Of each keypoint they stay in their order.
        more.sort_by_key(|&(keypoint, _)| keypoint);
        Self { around, more }
    }

    /// How many paths there are; one from a keypoint to itself counts twice.
    #[inline]
    pub fn degree(&self, keypoint: u32) -> usize {
        self.around[keypoint as usize].degree as usize
    }

    /// The first path, if there is one.
    #[inline]
    pub fn first(&self, keypoint: u32) -> u32 {
        self.around[keypoint as usize].numbers[0]
    }

    /// The paths, in their order.
    pub fn of(&self, keypoint: u32) -> impl Iterator<Item = u32> {
        let Around { degree, numbers } = &self.around[keypoint as usize];
        let few = &numbers[..numbers.len().min(*degree as usize)];
        let more = match (*degree as usize).checked_sub(few.len()) {
            None | Some(0) => &[][..],
            Some(n) => &self.more[self.more.partition_point(|&(k, _)| k < keypoint)..][..n],
        };
        few.iter().copied().chain(more.iter().map(|&(_, number)| number))
    }

    /// The path that goes on at a keypoint where two meet, the first one that is not used.
    #[inline]
    pub fn next(&self, keypoint: u32, is_used: &[bool]) -> Option<u32> {
        let Around { degree, numbers: [first, second, _] } = self.around[keypoint as usize];
        let is_open = |number: u32| !is_used[number as usize];
        match degree {
            2 if is_open(first) => Some(first),
            2 if is_open(second) => Some(second),
            _ => None,
        }
    }
}
