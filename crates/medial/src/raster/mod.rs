//! The plane cut into cells: which of them belong to a shape, and what follows from that alone.
//!
//! A [`Mask`] is the spatial occupancy array of \[VS87\], cells in rows that a [`Grid`] places in the plane.
//! Cells of the shape are neighbours of all eight around them, other cells of four; so an outline that touches
//! itself at a corner goes on there, and counts of components and holes are of that topology ([`topology`]).
//! Whatever lies outside of the array is outside of the shape.

mod bits;
mod crack_code;
#[cfg(test)]
pub(crate) mod dice;
mod digitise;
mod disks;
mod features;
mod grid;
mod margin;
mod mask;
mod outline;
mod pixel_graph;
mod ranks;
mod topology;
mod windows;

pub(crate) use bits::{Bits, ones};
pub use crack_code::{CrackChain, CrackError, CrackWalk, Turn, crack_chains, mask_of_cracks};
pub use digitise::{
    DigitiseError, boundary_cells, default_cell, digitise, grid_around, line_cells,
};
pub(crate) use disks::disk_cells;
pub use disks::mask_of_disks;
pub(crate) use features::{Band, Features, Offset};
pub use grid::Grid;
pub use mask::{Mask, MaskError};
pub use outline::outline;
pub(crate) use outline::{Contour, Cracks, Side};
pub use pixel_graph::PixelGraph;
pub use topology::{Topology, topology};
pub(crate) use windows::{SIMPLE, WINDOW_RING, can_go, filled_ring, n_runs};
