//! The answer: keypoints and paths, each path labelled with its two governors.

mod medial_axis;

pub use medial_axis::{
    Accuracy, Engine, Keypoint, KeypointKind, MedialAxis, Path, Side, Site, SiteKind,
};
