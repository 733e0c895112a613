//! What is made of an axis.

mod centerline;
mod compress;
mod fire;
mod ground;
mod groups;
mod hierarchy;
mod measure;
mod rest;
mod voronoi;

pub use centerline::{Centerline, CenterlineOptions, Widths, centerlines};
pub use compress::{
    CompressError, Compressed, Corners, DiskGraph, GridDisk, RebuildError, Run, compress,
};
pub use hierarchy::{Hierarchy, HierarchyError, Significance, Span};
pub use measure::Measure;
pub use rest::Pruned;
pub use voronoi::{
    Cell, Contact, EdgeKind, Located, PointKind, Region, Voronoi, VoronoiEdge, VoronoiError,
    VoronoiPoint,
};
