//! The way from disk to disk, and what is expected on it.

use super::numbers::expected;
use medial::ops::GridDisk;

/// The disks that were met, and what the next one is expected to be.
pub(super) struct Walk {
    /// Each with the one from which it was reached.
    disks: Vec<(GridDisk, GridDisk)>,
    last: (GridDisk, GridDisk),
    /// Whether nothing leads to the next disk.
    is_fresh: bool,
}

impl Walk {
    /// A walk that counts from a point.
    pub fn new(start: (i64, i64)) -> Self {
        let start = GridDisk { x: start.0, y: start.1, radius: 0 };
        Self { disks: Vec::new(), last: (start, start), is_fresh: true }
    }

    /// Goes on from a disk, or from the first one for a disk that nothing leads to.
    pub fn begin(&mut self, from: Option<u32>) {
        self.is_fresh = from.is_none();
        match from {
            Some(from) => self.last = self.disks[from as usize],
            None => {
                let first = self.disks.first().map_or(self.last.0, |&(disk, _)| disk);
                self.last = (first, first);
            }
        }
    }

    /// What the next disk is expected to be.
    pub fn guess(&self, quarters: u8) -> [i64; 3] {
        let (last, before) = self.last;
        [(last.x, before.x), (last.y, before.y), (last.radius, before.radius)]
            .map(|(last, before)| expected(last, before, quarters))
    }

    /// Goes on to the next disk.
    pub fn add(&mut self, disk: GridDisk) {
        let before = if std::mem::take(&mut self.is_fresh) { disk } else { self.last.0 };
        self.last = (disk, before);
        self.disks.push(self.last);
    }

    /// All disks.
    pub fn into_disks(self) -> Vec<GridDisk> {
        self.disks.into_iter().map(|(disk, _)| disk).collect()
    }
}
