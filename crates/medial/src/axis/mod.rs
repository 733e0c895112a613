//! The answer: keypoints and paths, each path labelled with its two governors.

mod curve;
mod draw;
mod medial_axis;
mod names;
mod sites;

pub use curve::Curve;
pub use draw::CurveKind;
pub(crate) use medial_axis::governors;
pub use medial_axis::{
    Accuracy, Engine, Keypoint, KeypointKind, MedialAxis, Path, Side, Site, SiteKind,
};
pub use names::UnknownName;
pub(crate) use sites::SiteTable;
pub use sites::{Sites, SitesIter};
