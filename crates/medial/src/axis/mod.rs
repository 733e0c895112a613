//! The answer: keypoints and paths, each path labelled with its two governors.

mod curve;
mod draw;
mod hyperbolic;
mod keypoints;
mod lengths;
mod medial_axis;
mod names;
mod paths;
mod polylines;
mod roots;
mod sites;
mod views;

pub use curve::Curve;
pub use draw::CurveKind;
pub(crate) use keypoints::{GONE, KeypointTable};
pub use keypoints::{Keypoints, KeypointsIter};
pub use medial_axis::{
    Accuracy, Engine, Keypoint, KeypointKind, MedialAxis, Path, Side, Site, SiteKind,
};
pub use names::UnknownName;
pub(crate) use names::names;
pub(crate) use paths::PathTable;
pub use paths::{Paths, PathsIter};
pub use polylines::{Joining, Polyline};
pub(crate) use roots::{bisected, crossing};
pub(crate) use sites::{SiteShape, SiteTable};
pub use sites::{Sites, SitesIter};
