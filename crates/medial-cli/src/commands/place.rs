//! Where pixels lie in the plane, and in the world, which is told beside pictures that cannot tell it themselves.

use crate::failure::Failure;
use crate::output::Output;
use medial::geom::Point;
use medial::raster::Grid;
use medial_io::image::{self, WorldFile};
use medial_io::{Crs, Format};
use std::ffi::OsStr;
use std::fs;
use std::path::Path;

/// Whether pixels lie elsewhere than in an image without a place: at (0, 0), one unit wide.
pub fn is_georeferenced(grid: &Grid, crs: Option<&Crs>) -> bool {
    crs.is_some() || *grid != Grid::of_image(grid.columns, grid.rows)
}

/// Whether rows go down, or columns to the left, so that outlines of pixels have the shape on their right in the plane.
pub fn is_mirrored(grid: &Grid) -> bool {
    let [width, height] = grid.cell;
    (width < 0.0) != (height < 0.0)
}

/// The ring around pixels between two corners, by column and row, counterclockwise in the plane.
pub fn box_ring(grid: &Grid, [left, top]: [u32; 2], [right, bottom]: [u32; 2]) -> Vec<Point> {
    let mut corners = [(left, top), (right, top), (right, bottom), (left, bottom)];
    if is_mirrored(grid) {
        corners[1..].reverse();
    }
    corners.map(|(column, row)| grid.corner(column, row)).to_vec()
}

/// Tells beside a PNG file where it lies, or warns of what was there before and tells it for a picture without a place.
///
/// A picture in no file, as on standard output, has nothing beside it.
pub fn tell_place(
    picture: Option<&Path>,
    place: Option<(&Grid, Option<&Crs>)>,
    quiet: bool,
) -> Result<(), Failure> {
    match place {
        Some((grid, crs)) => write_beside(picture, grid, crs, quiet),
        None => {
            warn_of_stale(picture, quiet);
            Ok(())
        }
    }
}

/// Writes labels, as bytes of TIFF, which tell where they lie if that is known.
pub fn write_labels(
    output: Output,
    bytes: &[u8],
    is_georeferenced: bool,
    quiet: bool,
) -> Result<(), Failure> {
    let file = output.target().map(Path::to_owned);
    output.whole(bytes)?;
    if !is_georeferenced {
        warn_of_stale(file.as_deref(), quiet);
    }
    Ok(())
}

/// Writes beside a PNG file its world file, and its reference system if there is text for it.
fn write_beside(
    picture: Option<&Path>,
    grid: &Grid,
    crs: Option<&Crs>,
    quiet: bool,
) -> Result<(), Failure> {
    let is_file = |path: &&Path| fs::metadata(path).is_ok_and(|found| found.is_file());
    let Some(picture) = picture.filter(is_file) else { return Ok(()) };
    // They go with the picture, whatever was there.
    let write = |extension: &str, text: &str| {
        Output::create(Some(&picture.with_extension(extension)))?.whole(text.as_bytes())
    };
    write("pgw", &image::world_file(grid))?;
    match crs.and_then(Crs::first_wkt) {
        Some(wkt) => write("prj", &wkt),
        None => {
            let told = WorldFile::of(picture).ok().and_then(|world| world.prj);
            if let Some((name, _)) = told.filter(|_| !quiet) {
                crate::progress::line(&format!(
                    "warning: {name} was there before and names a reference system; remove it"
                ));
            }
            Ok(())
        }
    }
}

/// Fails if a file that is written besides has a name of one that comes beside a picture.
pub fn check_beside(
    results: Option<&Path>,
    format: Format,
    others: &[(&str, Option<&Path>)],
) -> Result<(), Failure> {
    for &(option, path) in others {
        let Some(path) = path else { continue };
        let is_beside = |extension: &str| {
            let picture = results.filter(|_| format == Format::Png);
            picture.is_some_and(|picture| picture.with_extension(extension) == path)
        };
        if ["pgw", "prj"].into_iter().any(is_beside) {
            return Err(needs_file(option));
        }
    }
    Ok(())
}

/// Extensions of the files that labels are written to.
pub const TIFF: &[&str] = &["tif", "tiff"];

fn needs_file(option: &str) -> Failure {
    Failure::Usage(format!("{option} needs a file of its own"))
}

/// Fails if what is written to a file is to go to standard output, or to one with the extension of something else.
pub fn check_file(option: &str, path: Option<&Path>, known: &[&str]) -> Result<(), Failure> {
    if path.is_some_and(|path| path.as_os_str() == "-") {
        return Err(needs_file(option));
    }
    let extension = path.and_then(Path::extension);
    let is_known =
        |extension: &OsStr| known.iter().any(|known| extension.eq_ignore_ascii_case(known));
    match extension.filter(|extension| !is_known(extension)) {
        None => Ok(()),
        Some(other) => {
            let (names, other) = (known.join(" and ."), other.display());
            Err(Failure::Usage(format!("{option} writes files .{names}, not .{other}")))
        }
    }
}

/// Fails if standard input is named for two files.
pub fn check_inputs(inputs: &[Option<&Path>]) -> Result<(), Failure> {
    let n = inputs.iter().flatten().filter(|path| path.as_os_str() == "-").count();
    if n > 1 {
        return Err(Failure::Usage("standard input is named twice; name a file".to_owned()));
    }
    Ok(())
}

/// Says what stands beside an image without a place and gives it one, as an image before it had.
fn warn_of_stale(image: Option<&Path>, quiet: bool) {
    let world = image.and_then(|image| WorldFile::of(image).ok()).and_then(|told| told.world);
    if let Some((name, _)) = world.filter(|_| !quiet) {
        crate::progress::line(&format!(
            "warning: {name} was there before and says that the image lies elsewhere; remove it"
        ));
    }
}
