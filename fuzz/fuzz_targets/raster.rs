//! Any mask against the contract of the raster transform.

#![no_main]

use libfuzzer_sys::fuzz_target;
use medial::engine::{Options, Skeleton, raster_transform};
use medial::raster::{Grid, Mask, PixelGraph, mask_of_disks, topology};

/// The mask with these bits, as wide as the first byte says; the second one tells the shape of the cells.
fn mask(data: &[u8]) -> Option<Mask> {
    let (&[width, cell], bits) = data.split_first_chunk()?;
    let columns = 1 + u32::from(width % 80);
    let rows = (8 * bits.len() as u32).div_ceil(columns).min(200);
    let mut grid = Grid::of_image(columns, rows);
    grid.cell = match cell % 8 {
        0..5 => [1.0, 1.0],
        5 => [0.25, -0.25],
        6 => [-1.0, 2.0],
        _ => [3.0, 1.0],
    };
    let is_inside = |x: u32, y: u32| {
        let place = (y * columns + x) as usize;
        bits.get(place / 8).is_some_and(|byte| byte >> (place % 8) & 1 != 0)
    };
    Mask::new(grid, is_inside).ok()
}

fuzz_target!(|data: &[u8]| {
    let Some(mask) = mask(data) else { return };
    let whole = topology(&mask);
    // Whole, or in bands of one row to seven.
    let band_rows = Some(u32::from(data[1] >> 3 & 7)).filter(|&rows| rows > 0);
    for residual in [Some(2.0), None] {
        let options = Options { residual, band_rows, ..Options::default() };
        let skeleton = Skeleton::new(&mask, &options).expect("nobody cancels");
        assert_eq!(topology(skeleton.cells()), whole);
        let graph = skeleton.graph();
        let cycles = graph.steps.len() as i64 - graph.cells.len() as i64;
        assert_eq!(cycles, i64::from(whole.holes) - i64::from(whole.components));
        for [x, y] in PixelGraph::new(skeleton.cells()).cells {
            assert!(mask.get(x, y));
        }
        let axis = raster_transform(&mask, &options).expect("nobody cancels");
        if residual.is_none() && mask.grid().cell[0].abs() == mask.grid().cell[1].abs() {
            assert!(mask_of_disks(&axis, mask.grid()).expect("the same grid") == mask);
        }
    }
});
