//! What is made of an axis.

mod voronoi;

pub use voronoi::{
    Cell, Contact, EdgeKind, Located, PointKind, Region, Voronoi, VoronoiEdge, VoronoiError,
    VoronoiPoint,
};
