//! Where pictures lie in the world, beside those that cannot tell it themselves.

use crate::failure::Failure;
use crate::output::Output;
use medial::raster::Grid;
use medial_io::{Crs, png};
use std::fs;
use std::path::Path;

/// Whether pixels lie elsewhere than in an image without a place: at (0, 0), one unit wide.
pub fn is_georeferenced(grid: &Grid, crs: Option<&Crs>) -> bool {
    crs.is_some() || *grid != Grid::of_image(grid.columns, grid.rows)
}

/// Writes beside a PNG file its world file, and its reference system if there is text for it.
///
/// A picture in no file, as on standard output, has nothing beside it.
pub fn write_beside(
    picture: Option<&Path>,
    grid: &Grid,
    crs: Option<&Crs>,
) -> Result<(), Failure> {
    let is_file = |path: &&Path| fs::metadata(path).is_ok_and(|found| found.is_file());
    let Some(picture) = picture.filter(is_file) else { return Ok(()) };
    let write = |extension: &str, text: &str| {
        Output::beside(&picture.with_extension(extension))?.whole(text.as_bytes())
    };
    write("pgw", &png::world_file(grid))?;
    match crs.and_then(Crs::first_wkt) {
        Some(wkt) => write("prj", &wkt),
        None => Ok(()),
    }
}
