//! Open gaps of keypoints, by their governors: where loops of the axis close.

use crate::domain::Site;

const NONE: u32 = u32::MAX;

/// Room for a path between two neighbouring contact runs of a keypoint.
#[derive(Clone, Copy, Debug)]
struct Open {
    keypoint: u32,
    right: Site,
    left: Site,
    /// The next open gap with the same right governor.
    next: u32,
}

/// The gaps that no path has used yet.
///
/// A path that arrives is looked for under its left governor, which is the right one of the gap that
/// it fills. An element has few open gaps at a time.
#[derive(Debug)]
pub(super) struct Gaps {
    /// First site of the polygon.
    base: u32,
    /// First open gap of each site.
    heads: Vec<u32>,
    /// Gaps that are not taken, those closed as well.
    gaps: Vec<Open>,
    /// Numbers of gaps that were taken.
    free: Vec<u32>,
}

impl Gaps {
    pub fn new(base: u32, n_sites: u32) -> Self {
        Self { base, heads: vec![NONE; n_sites as usize], gaps: Vec::new(), free: Vec::new() }
    }

    /// Takes note of an open gap and gives its number.
    pub fn open(&mut self, keypoint: u32, right: Site, left: Site) -> u32 {
        let head = &mut self.heads[(right.0 - self.base) as usize];
        let gap = Open { keypoint, right, left, next: *head };
        let number = match self.free.pop() {
            Some(number) => {
                self.gaps[number as usize] = gap;
                number
            }
            None => {
                self.gaps.push(gap);
                self.gaps.len() as u32 - 1
            }
        };
        *head = number;
        number
    }

    /// Closes a gap by its number, which is not used again for it; false if it was closed already.
    pub fn take(&mut self, gap: u32) -> bool {
        let right = self.gaps[gap as usize].right;
        let open = self.unlink(right, |number, _| number == gap).is_some();
        self.free.push(gap);
        open
    }

    /// Closes the gap between two governors at a keypoint for which `same` holds, and gives the
    /// keypoint.
    pub fn close(
        &mut self,
        right: Site,
        left: Site,
        mut same: impl FnMut(u32) -> bool,
    ) -> Option<u32> {
        self.unlink(right, |_, gap| gap.left == left && same(gap.keypoint))
    }

    /// Keypoints with an open gap between two governors.
    pub fn keypoints(&self, right: Site, left: Site) -> impl Iterator<Item = u32> + '_ {
        let mut number = self.heads[(right.0 - self.base) as usize];
        std::iter::from_fn(move || {
            while number != NONE {
                let gap = &self.gaps[number as usize];
                number = gap.next;
                if gap.left == left {
                    return Some(gap.keypoint);
                }
            }
            None
        })
    }

    /// Takes the first open gap of a site for which `wanted` holds, and gives its keypoint.
    fn unlink(&mut self, right: Site, mut wanted: impl FnMut(u32, &Open) -> bool) -> Option<u32> {
        let slot = (right.0 - self.base) as usize;
        let mut before = NONE;
        let mut number = self.heads[slot];
        while number != NONE {
            let gap = self.gaps[number as usize];
            if wanted(number, &gap) {
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
}
