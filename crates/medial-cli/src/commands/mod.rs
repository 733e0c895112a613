pub mod axis;
pub mod centerline;
pub mod check;
pub mod compare;
pub mod compress;
mod features;
pub mod locate;
mod sink;
pub mod voronoi;
