//! World files: where an image lies, told by a small file beside it.
//!
//! # Contract
//! Six numbers, a line each: the width of a pixel, two turns, its height, which is negative where rows go down, and the
//! centre of the first pixel. The reference system may stand in a file `.prj` beside it, as WKT. An image that says itself
//! where it lies is believed first.

use super::Place;
use crate::{Crs, Error};
use medial::geom::Point;
use medial::raster::Grid;
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

/// What files beside an image say of where it lies.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct WorldFile {
    /// The name and the text of the world file; without one nothing is told.
    pub world: Option<(String, String)>,
    /// The name and the text of the file with the reference system.
    pub prj: Option<(String, String)>,
}

impl WorldFile {
    /// Reads the files beside an image: of `a.png` one of `a.pgw`, `a.pngw`, `a.png.wld` and `a.wld`, and `a.prj`; of other
    /// extensions as well by the first and the last letter, and all of them. Capital letters make no difference.
    ///
    /// # Errors
    /// If one of these is there and cannot be read.
    pub fn of(image: &Path) -> Result<Self, Error> {
        let extension = image.extension().unwrap_or_default().to_string_lossy().to_lowercase();
        let (Some(first), Some(last)) = (extension.chars().next(), extension.chars().last()) else {
            return Ok(Self::default());
        };
        let names = [
            format!("{first}{last}w"),
            format!("{extension}w"),
            format!("{extension}.wld"),
            "wld".to_owned(),
        ];
        let places = names.iter().flat_map(|name| [name.clone(), name.to_uppercase()]);
        for place in places.map(|name| image.with_extension(name)) {
            if let Some(world) = named(&place)? {
                let [prj, capital] = ["prj", "PRJ"].map(|name| named(&image.with_extension(name)));
                return Ok(Self { world: Some(world), prj: prj?.or(capital?) });
            }
        }
        Ok(Self::default())
    }

    /// The place that they say.
    pub(super) fn place(&self) -> Result<Option<Place>, Error> {
        let Some((name, text)) = &self.world else { return Ok(None) };
        let wrong = |why: String| Error::File { why: format!("its world file {name} {why}") };
        let numbers: Vec<f64> = text
            .trim_start_matches('\u{feff}')
            .split_whitespace()
            .map_while(|word| word.parse().ok())
            .take(6)
            .collect();
        let &[width, a, b, height, x, y] = &numbers[..] else {
            let n = numbers.len();
            return Err(wrong(format!(
                "begins with {n} numbers, not with six with points, not commas; remove it, or write it again"
            )));
        };
        if numbers.iter().any(|number| !number.is_finite()) || width == 0.0 || height == 0.0 {
            return Err(wrong(
                "has a pixel without a finite size or place; remove it, or write it again"
                    .to_owned(),
            ));
        }
        if a != 0.0 || b != 0.0 {
            return Err(wrong("turns the image; warp it first, as with gdalwarp".to_owned()));
        }
        let crs = self.prj.as_ref().map(|(_, text)| Crs::of_wkt(text));
        let origin = Point::new(x - 0.5 * width, y - 0.5 * height);
        Ok(Some(Place { origin, cell: [width, height], crs }))
    }
}

/// The name and the text of a file, if it is there.
fn named(path: &Path) -> Result<Option<(String, String)>, Error> {
    match fs::read(path) {
        Ok(bytes) => {
            let text = String::from_utf8_lossy(&bytes).into_owned();
            Ok(Some((path.display().to_string(), text)))
        }
        Err(error) if matches!(error.kind(), ErrorKind::NotFound | ErrorKind::IsADirectory) => {
            Ok(None)
        }
        Err(error) => Err(Error::File {
            why: format!("{} beside it cannot be read: {error}", path.display()),
        }),
    }
}

/// The text of a world file: where pixels lie that an image cannot tell itself, by the width of one, two turns that are
/// 0, its height, which is negative where rows go down, and the centre of the first pixel.
///
/// ```
/// use medial::{geom::Point, raster::Grid};
/// let grid = Grid { origin: Point::new(100.0, 50.0), cell: [2.0, -2.0], columns: 3, rows: 4 };
/// assert_eq!(medial_io::image::world_file(&grid), "2\n0\n0\n-2\n101\n49\n");
/// ```
#[must_use]
pub fn world_file(grid: &Grid) -> String {
    let ([width, height], first) = (grid.cell, grid.centre(0, 0));
    format!("{width}\n0\n0\n{height}\n{}\n{}\n", first.x, first.y)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn place(text: &str) -> Result<Option<Place>, Error> {
        let world = Some(("a.pgw".to_owned(), text.to_owned()));
        WorldFile { world, prj: None }.place()
    }

    #[test]
    fn what_is_written_is_read() {
        let grid = Grid { origin: Point::new(100.0, 50.0), cell: [2.0, -4.0], columns: 3, rows: 4 };
        let read = place(&world_file(&grid)).unwrap().unwrap();
        assert_eq!((read.origin, read.cell), (grid.origin, grid.cell));
        let marked = format!("\u{feff}{}", world_file(&grid).replace('\n', "\r\n"));
        assert_eq!(place(&marked).unwrap().unwrap().origin, grid.origin);
        assert!(WorldFile::default().place().unwrap().is_none());
    }

    #[test]
    fn what_is_no_place_is_told() {
        let told = |text: &str| place(text).unwrap_err().to_string();
        assert!(
            told("1 0 0 -1 3").contains("a.pgw begins with 5 numbers, not with six with points")
        );
        assert!(told("1\n0.1\n0\n-1\n3\n4\n").contains("turns the image"));
        assert!(told("0 0 0 -1 3 4").contains("without a finite size"));
        assert!(told("1 0 0 -1 inf 4").contains("without a finite size"));
    }

    #[test]
    fn files_are_found_by_their_extension() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        assert_eq!(WorldFile::of(&at("a.png")).unwrap(), WorldFile::default());
        for (image, beside) in [
            ("a.png", "a.PGW"),
            ("b.jpeg", "b.jgw"),
            ("c.jpg", "c.jpgw"),
            ("d.tif", "d.wld"),
            ("e.png", "e.png.wld"),
        ] {
            fs::write(at(beside), "1").unwrap();
            let found = WorldFile::of(&at(image)).unwrap();
            assert_eq!(found.world.unwrap().1, "1", "{image}");
            assert_eq!(found.prj, None);
        }
        fs::write(at("a.prj"), "LOCAL_CS[\"here\"]").unwrap();
        assert!(WorldFile::of(&at("a.png")).unwrap().prj.is_some());
    }
}
