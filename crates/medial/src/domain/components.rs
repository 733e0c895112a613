//! Which walks bound the same connected component of the interior.

use super::status::NONE;
use super::{Domain, DomainError};

impl Domain {
    /// Numbers the components in the walks; `parents` gives the walk right around each walk, if it
    /// is needed.
    pub(super) fn number_components(
        &mut self,
        parents: impl FnOnce(&Self) -> Result<Vec<u32>, DomainError>,
    ) -> Result<(), DomainError> {
        let polygons = self.walks.iter().map(|w| w.polygon as usize + 1).max().unwrap_or(0);
        // The last component of each polygon, and whether that is its only one.
        let mut last = vec![(NONE, true); polygons];
        for (component, walk) in (0..).zip(self.walks.iter_mut().filter(|w| !w.hole)) {
            walk.component = component;
            let known = &mut last[walk.polygon as usize];
            *known = (component, known.0 == NONE);
        }
        let mut open = false;
        for walk in self.walks.iter_mut().filter(|w| w.hole) {
            let (component, only) = last[walk.polygon as usize];
            walk.component = component;
            open |= !only;
        }
        if !open {
            return Ok(());
        }
        // What lies right around a hole of a valid domain is an outer walk.
        for (walk, parent) in parents(self)?.into_iter().enumerate() {
            if self.walks[walk].hole {
                self.walks[walk].component = match self.walks.get(parent as usize) {
                    Some(parent) if !parent.hole => parent.component,
                    _ => return Err(DomainError::Internal { stage: "components" }),
                };
            }
        }
        Ok(())
    }
}
