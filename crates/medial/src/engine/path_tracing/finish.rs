//! Transitions passed, and where paths start: what is traced as a draft has it.

use super::chain::Passed;
use super::contacts::{from_least, three_from_least};
use super::search::Start;
use crate::axis::{Keypoint, KeypointKind};
use crate::domain::{Domain, Site};
use crate::engine::EngineError;
use crate::engine::draft::{Fixed, PLACED};
pub(super) use crate::engine::draft::{Mark, Traced};

impl Traced {
    /// Adds a transition that was passed on a path.
    #[inline]
    pub(super) fn add_transition(
        &mut self,
        domain: &Domain,
        passed: &Passed,
    ) -> Result<u32, EngineError> {
        let [a, b, c, _] = passed.contacts;
        let own = passed.fixed.then_some(&passed.disk);
        let disk = Fixed { own, sought: false, found: &passed.disk, triple: [a, b, c] };
        let kind = KeypointKind::Transition;
        if passed.n_contacts == 3 {
            return self.add_disk(domain, &disk, kind, &three_from_least([a, b, c]));
        }
        let list = from_least(&passed.contacts[..usize::from(passed.n_contacts)]);
        self.add_disk(domain, &disk, kind, &list)
    }

    /// Where a path starts that leaves a keypoint, which these sites define if it is no end.
    pub(super) fn start(&self, keypoint: u32, triple: [Site; 3]) -> Start {
        let Keypoint { position: centre, radius, kind, .. } = self.keypoints.at(keypoint);
        if kind == KeypointKind::End {
            return Start { centre, radius, doubt: 0.0, triple: None };
        }
        let doubt = PLACED * centre.x.abs().max(centre.y.abs()).max(radius);
        Start { centre, radius, doubt, triple: Some(triple) }
    }
}
