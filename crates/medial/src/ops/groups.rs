//! Numbers by group, and numbers that are joined.

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
    /// A place without a number.
    pub const EMPTY: u32 = u32::MAX;

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

    /// Groups with a place for each number, of which some may be left empty: [`Self::EMPTY`]. `first` says
    /// where the places of each group start, and where the last ones end.
    pub fn in_places(mut first: Vec<u32>, mut places: Vec<u32>) -> Self {
        let mut full = 0;
        let mut start = 0;
        for group_end in first.iter_mut().skip(1) {
            let end = *group_end as usize;
            for place in start..end {
                let member = places[place];
                places[full] = member;
                full += usize::from(member != Self::EMPTY);
            }
            *group_end = full as u32;
            start = end;
        }
        places.truncate(full);
        Self { first, members: places }
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

/// Which nodes are joined, as a forest.
#[derive(Debug)]
pub(super) struct Trees(Vec<u32>);

impl Trees {
    pub fn new(n: usize) -> Self {
        Self((0..n as u32).collect())
    }

    pub fn root(&mut self, mut node: u32) -> u32 {
        while self.0[node as usize] != node {
            let above = self.0[node as usize];
            self.0[node as usize] = self.0[above as usize];
            node = above;
        }
        node
    }

    /// Joins two nodes; false if they were joined already.
    pub fn join(&mut self, a: u32, b: u32) -> bool {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a as usize] = b;
        a != b
    }
}
