//! Open gaps of keypoints: the paths that wait to be traced, and where loops of the axis close.

use crate::domain::Site;

const NONE: u32 = u32::MAX;

/// Stands for the next gap where a gap is closed.
const CLOSED: u32 = u32::MAX - 1;

/// Sites that share a list of gaps.
const SHARED: u32 = 4;

/// Room for a path between two neighbouring contact runs of a keypoint.
#[derive(Clone, Copy, Debug)]
pub(super) struct Open {
    pub keypoint: u32,
    pub right: Site,
    pub left: Site,
    /// The open gap before this one in its list.
    next: u32,
}

/// A stack of the gaps that no path has used yet.
///
/// Where loops can close, a path that arrives is looked for under its left governor, which is the right
/// one of the gap that it fills. An element has few open gaps at a time.
#[derive(Debug, Default)]
pub(super) struct Gaps {
    /// First site of the polygon.
    base: u32,
    /// Last open gap of some sites each; none where no loop can close.
    heads: Vec<u32>,
    /// The stack, with gaps that were closed since.
    gaps: Vec<Open>,
}

impl Gaps {
    /// Forgets all, for a polygon with these sites.
    pub fn reset(&mut self, base: u32, n_sites: u32, loops: bool) {
        self.base = base;
        self.gaps.clear();
        self.heads.clear();
        if loops {
            self.heads.resize((n_sites / SHARED + 1) as usize, NONE);
        }
    }

    /// The gaps where loops may close; `None` if none can.
    pub fn closing(&self) -> Option<&Self> {
        (!self.heads.is_empty()).then_some(self)
    }

    fn slot(&self, right: Site) -> usize {
        ((right.0 - self.base) / SHARED) as usize
    }

    /// Puts an open gap onto the stack.
    pub fn push(&mut self, keypoint: u32, right: Site, left: Site) {
        let number = self.gaps.len() as u32;
        let slot = self.slot(right);
        let next = self.heads.get_mut(slot).map_or(NONE, |head| std::mem::replace(head, number));
        self.gaps.push(Open { keypoint, right, left, next });
    }

    /// Takes the last open gap from the stack.
    pub fn pop(&mut self) -> Option<Open> {
        loop {
            let gap = self.gaps.pop()?;
            if gap.next != CLOSED {
                // It came last, so it is the first of its list.
                let slot = self.slot(gap.right);
                if let Some(head) = self.heads.get_mut(slot) {
                    *head = gap.next;
                }
                return Some(gap);
            }
        }
    }

    /// Closes the gap between two governors at a keypoint for which `same` holds, and gives the
    /// keypoint.
    pub fn close(
        &mut self,
        right: Site,
        left: Site,
        mut same: impl FnMut(u32) -> bool,
    ) -> Option<u32> {
        let slot = self.slot(right);
        let mut before = NONE;
        let mut number = *self.heads.get(slot)?;
        while number != NONE {
            let gap = self.gaps[number as usize];
            if (gap.right, gap.left) == (right, left) && same(gap.keypoint) {
                self.gaps[number as usize].next = CLOSED;
                if before == NONE {
                    self.heads[slot] = gap.next;
                } else {
                    self.gaps[before as usize].next = gap.next;
                }
                return Some(gap.keypoint);
            }
            before = number;
            number = gap.next;
        }
        None
    }

    /// Keypoints with an open gap between two governors.
    pub fn keypoints(&self, right: Site, left: Site) -> impl Iterator<Item = u32> + '_ {
        let mut number = self.heads.get(self.slot(right)).copied().unwrap_or(NONE);
        std::iter::from_fn(move || {
            while number != NONE {
                let gap = &self.gaps[number as usize];
                number = gap.next;
                if (gap.right, gap.left) == (right, left) {
                    return Some(gap.keypoint);
                }
            }
            None
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_open_gap_comes_first() {
        let mut gaps = Gaps::default();
        for loops in [true, false] {
            gaps.reset(10, 20, loops);
            for k in 0..10 {
                gaps.push(k, Site(12 + k % 3), Site(20 + k));
            }
            assert_eq!(gaps.closing().is_some(), loops);
            // Without loops nothing is found.
            let closed = gaps.close(Site(13), Site(24), |k| k == 4);
            assert_eq!(closed, loops.then_some(4));
            assert_eq!(gaps.close(Site(13), Site(24), |_| true), None);
            assert_eq!(gaps.close(Site(13), Site(27), |_| false), None);
            assert_eq!(gaps.keypoints(Site(13), Site(27)).count(), usize::from(loops));
            let rest: Vec<u32> = std::iter::from_fn(|| gaps.pop()).map(|g| g.keypoint).collect();
            let expected = (0..10).rev().filter(|&k| !loops || k != 4);
            assert_eq!(rest, expected.collect::<Vec<u32>>());
            assert_eq!(gaps.keypoints(Site(13), Site(27)).count(), 0);
        }
    }
}
