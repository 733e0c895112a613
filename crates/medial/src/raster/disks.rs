use super::{Grid, Mask, MaskError};
use crate::axis::MedialAxis;

/// Shows the cells whose centres are nearer to that of a cell than a distance, given as its square in widths
/// of a cell: row by row, from a column up to, but not with, another one.
pub(crate) fn disk_cells(
    grid: &Grid,
    x: u32,
    y: u32,
    squared: f64,
    mut show: impl FnMut(u32, u32, u32),
) {
    let aspect = grid.aspect();
    let height = (squared / aspect).sqrt().ceil() as u32;
    for row in y.saturating_sub(height)..(y + height + 1).min(grid.rows) {
        let rows = f64::from(row) - f64::from(y);
        let left = squared - aspect * rows * rows;
        if left <= 0.0 {
            continue;
        }
        // The greatest number of columns whose square is below what is left.
        let mut half = left.sqrt().ceil();
        while half * half >= left {
            half -= 1.0;
        }
        let half = half as u32;
        show(row, x.saturating_sub(half), (x + half + 1).min(grid.columns));
    }
}

/// The mask that the disks at the keypoints of a sampled axis cover: the inverse of the raster transform.
///
/// Radii are taken as that engine gives them, half a cell less than the distance between centres; an axis from
/// which nothing was removed gives the mask again, cell for cell. Other axes are taken in the same way, within
/// half a cell.
///
/// ```
/// use medial::engine::{Options, raster_transform};
/// use medial::raster::{Grid, Mask, mask_of_disks};
/// let mask = Mask::new(Grid::of_image(40, 20), |x, y| (x / 5 + y / 7) % 3 > 0)?;
/// let axis = raster_transform(&mask, &Options { residual: None, ..Options::default() })?;
/// assert_eq!(mask_of_disks(&axis, mask.grid())?, mask);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// If the grid is too large or its cells have no size.
pub fn mask_of_disks(axis: &MedialAxis, grid: &Grid) -> Result<Mask, MaskError> {
    let mut mask = Mask::empty(*grid)?;
    let width = grid.cell[0].abs();
    for keypoint in axis.keypoints() {
        let [column, row] = grid.locate(keypoint.position);
        let within = |at: f64, n: u32| (0.0..f64::from(n)).contains(&at).then_some(at as u32);
        let cell = within(column, grid.columns).zip(within(row, grid.rows));
        let Some((x, y)) = cell else { continue };
        let distance = keypoint.radius / width + 0.5;
        // Squares of distances between centres of square cells are whole numbers.
        let squared = distance * distance;
        let squared = if grid.aspect() == 1.0 { squared.round() } else { squared };
        disk_cells(grid, x, y, squared, |row, from, to| mask.fill(row, from, to));
    }
    Ok(mask)
}
