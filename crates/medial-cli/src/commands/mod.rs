pub mod axis;
pub mod check;
mod features;
pub mod locate;
mod sink;
pub mod voronoi;
