//! What is made of an axis.

mod centerline;
mod fire;
mod ground;
mod groups;
mod hierarchy;
mod measure;
mod rest;
mod voronoi;

pub use centerline::{
    Centerline, CenterlineError, CenterlineOptions, Extension, LineOptions, Route, Widths,
    centerlines, polylines,
};
pub use hierarchy::{Hierarchy, HierarchyError, Significance, Span};
pub use measure::Measure;
pub use rest::Pruned;
pub use voronoi::{
    Cell, Contact, EdgeKind, Located, PointKind, Region, Voronoi, VoronoiEdge, VoronoiError,
    VoronoiPoint,
};
