//! Exact disks, kept while they are asked about.

use std::cell::RefCell;
use std::rc::Rc;

use super::elements::Member;
use crate::geom::predicates::ExactDisk;

/// Disks that are kept.
const KEPT: usize = 256;

/// The last exact disks.
///
/// What doubles leave open about one disk they mostly leave open more than once, and always within a
/// few steps.
#[derive(Debug)]
pub(super) struct Exacts {
    slots: RefCell<Vec<Option<Slot>>>,
}

/// A disk and the elements that it touches.
type Slot = ([Member; 3], Rc<ExactDisk>);

impl Exacts {
    pub fn new() -> Self {
        Self { slots: RefCell::new(vec![None; KEPT]) }
    }

    fn place([a, b, c]: [Member; 3]) -> usize {
        const ODD: u32 = 0x9e37_79b1;
        let mixed =
            a.0.wrapping_mul(ODD) ^ b.0.rotate_left(11).wrapping_mul(ODD) ^ c.0.rotate_left(21);
        (mixed.wrapping_mul(ODD) >> 16) as usize % KEPT
    }

    /// The disk that is kept for these elements, else the one given, which is kept then.
    pub fn get(&self, triple: [Member; 3], make: impl FnOnce() -> ExactDisk) -> Rc<ExactDisk> {
        let slot = &mut self.slots.borrow_mut()[Self::place(triple)];
        match slot {
            Some((known, disk)) if *known == triple => Rc::clone(disk),
            _ => Rc::clone(&slot.insert((triple, Rc::new(make()))).1),
        }
    }
}
