//! What is made of an axis.

mod artefacts;
mod branches;
mod carve;
mod centerline;
mod clearance;
mod compress;
mod distance;
mod fire;
#[cfg(feature = "petgraph")]
mod graph;
mod ground;
mod groups;
mod hierarchy;
mod limbs;
mod measure;
mod offset;
mod outline;
mod profile;
mod prominence;
mod prune;
mod radii;
mod reconstruct;
mod rest;
mod scale;
mod smooth;
mod stroke;
mod voronoi;
mod walls;

pub use branches::{
    Bend, BoundaryPiece, Branch, BranchPiece, Branches, Extent, Primitive, Trend, branches,
};
pub use carve::{
    CarveError, CarveOptions, Carving, Clearing, Move, Role, Tip, carve, carving_order,
};
pub use centerline::{
    Centerline, CenterlineError, CenterlineOptions, Extension, LineOptions, Route, Widths,
    centerlines, polylines,
};
pub use clearance::{Neck, Plateau, largest_disks, necks};
pub use compress::{
    Ball, BallShape, CellCode, CellError, CompressError, Compressed, CompressedMask, Corners,
    DiskGraph, GridDisk, MaskMethod, MaskOptions, RebuildError, Run, compress, compress_mask,
};
pub use distance::boundary_distance;
#[cfg(feature = "petgraph")]
pub use graph::Link;
pub use hierarchy::{Hierarchy, HierarchyError, Removal, Significance, Span};
pub use limbs::{Limb, LimbPair, limb_pairs, limbs};
pub use measure::Measure;
pub use offset::{OffsetError, offset_margin, offsets};
pub use outline::{Contour, Outline, OutlineError, OutlinePiece, OutlinePolygon, Sense};
pub use profile::{Station, narrowest, profile};
pub use reconstruct::{Disk, ReconstructError, disks, polygons_of, tangent_polygons};
#[cfg(feature = "union")]
pub use reconstruct::{union_of_disks, union_of_linked_disks, without_crossings};
pub use rest::{Origin, Pruned};
pub use smooth::{SmoothError, Smoothed, smoothed};
pub use stroke::Stroke;
pub use voronoi::{
    Cell, Contact, EdgeKind, Located, PointKind, Region, Voronoi, VoronoiEdge, VoronoiError,
    VoronoiPoint,
};
pub use walls::{Wall, WallError, WallOptions, thin_walls};
