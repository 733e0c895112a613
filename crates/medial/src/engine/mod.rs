//! The engines: each turns a [`Domain`](crate::domain::Domain) into a
//! [`MedialAxis`](crate::axis::MedialAxis).

mod brushfire;
mod delaunay_dual;
mod divide_and_conquer;
mod draft;
mod error;
mod exterior;
mod options;
mod path_tracing;
mod raster_transform;
mod ridge_following;
mod sampled;
mod threads;
mod watch;

pub use brushfire::{Burning, Burnt, brushfire, brushfire_of_domain};
pub use delaunay_dual::{
    Border, DelaunayDual, DualKind, DualNode, DualPruning, Sampling, border, crust, delaunay_dual,
    delaunay_dual_of_mask, two_step_crust,
};
pub use divide_and_conquer::{
    ArcEnd, Chain, ChainArc, ChainElement, ChainMerge, Work, chain_diagram, chain_merge,
    divide_and_conquer, divide_and_conquer_counted, divide_and_conquer_with,
};
pub use error::EngineError;
pub use exterior::{both_sides, exterior, exterior_frame, interior, of_mask};
pub use options::Options;
pub use path_tracing::{
    Candidate, Step, Steps, path_tracing, path_tracing_steps, path_tracing_with,
};
pub use raster_transform::{Skeleton, raster_transform, raster_transform_of_domain};
pub use ridge_following::{
    RidgeAxis, RidgeOptions, RidgePairs, RidgePixel, RidgeSearch, RidgeThinning, RidgeTimes,
    STRAIGHT_ANGLE, STRAIGHT_ANGLE_OF_MASKS, ridge_following, ridge_following_of_mask,
};
