//! Raster pictures: the vector picture, drawn.

use crate::Error;
use crate::svg::{self, Lettering, Options, Overlay, Scene};
use medial::raster::Grid;
use resvg::tiny_skia::{ColorU8, Pixmap, Transform};
use resvg::usvg::{self, Tree};

/// Pixels of the picture for each pixel of the vector picture.
const SCALE: f32 = 2.0;

/// The picture of all scenes as PNG.
///
/// # Errors
/// If the renderer cannot draw it, which asks for a report.
pub fn write(scenes: &[Scene], options: &Options) -> Result<Vec<u8>, Error> {
    let options = Options { lettering: Lettering::Strokes, ..options.clone() };
    let tree = parsed(&svg::write(scenes, &options))?;
    let size = tree.size();
    let (width, height) = ((SCALE * size.width()).ceil(), (SCALE * size.height()).ceil());
    painted(&tree, blank(width as u32, height as u32)?)
}

/// A picture with layers over it as PNG.
///
/// # Errors
/// As [`write()`].
pub fn write_overlay(overlay: &Overlay, options: &Options) -> Result<Vec<u8>, Error> {
    let options = svg::painted_options(options);
    let tree = parsed(&svg::drawn(overlay, &options, false))?;
    let (width, height, colour) = overlay.painted(&options, f64::from(SCALE));
    let mut ground = blank(width, height)?;
    let pixels = ground.pixels_mut().iter_mut();
    for (k, pixel) in (0..).zip(pixels) {
        let [red, green, blue] = colour(k % width, k / width).unwrap_or([1.0; 3]);
        let byte = |value: f32| (255.0 * value.clamp(0.0, 1.0)).round() as u8;
        *pixel = ColorU8::from_rgba(byte(red), byte(green), byte(blue), 255).premultiply();
    }
    painted(&tree, ground)
}

/// Where the pixels of that picture lie in the plane, its margins and its legend among them.
#[must_use]
pub fn overlay_grid(overlay: &Overlay, options: &Options) -> Grid {
    overlay.drawing(&svg::painted_options(options), f64::from(SCALE))
}

fn failed(why: String) -> Error {
    Error::Picture { why }
}

fn parsed(picture: &str) -> Result<Tree, Error> {
    Tree::from_str(picture, &usvg::Options::default()).map_err(|error| failed(error.to_string()))
}

fn blank(width: u32, height: u32) -> Result<Pixmap, Error> {
    let why = || failed(format!("a picture of {width} × {height} pixels does not fit"));
    Pixmap::new(width, height).ok_or_else(why)
}

/// The bytes of a picture painted on a ground.
fn painted(tree: &Tree, mut ground: Pixmap) -> Result<Vec<u8>, Error> {
    resvg::render(tree, Transform::from_scale(SCALE, SCALE), &mut ground.as_mut());
    ground.encode_png().map_err(|error| failed(error.to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples;

    #[test]
    fn a_picture_is_twice_as_large_in_pixels() {
        let scene = Scene { boundary: samples::rectangle_rings(), axis: samples::rectangle() };
        let bytes = write(&[scene], &Options { legend: false, ..Options::default() }).unwrap();
        assert_eq!(&bytes[..8], b"\x89PNG\r\n\x1a\n");
        // 1000 × 500 and 28 around, twice: the header holds width and height.
        assert_eq!(bytes[16..24], [0, 0, 0x08, 0x40, 0, 0, 0x04, 0x58]);
    }

    #[test]
    fn a_picture_shows_through_where_no_line_is() {
        use crate::svg::{LineStyle, OverlayLayer};
        use medial::geom::Point;
        let style = LineStyle { color: "#0000ff", width: 40.0, dashes: &[], fill: 0.0 };
        let lines = vec![vec![Point::new(0.0, -0.5), Point::new(2.0, -0.5)]];
        let layer = OverlayLayer { name: "axis", style, lines, are_rings: false };
        let grid = Grid::of_image(2, 1);
        let colours = vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        let layers = vec![layer];
        let overlay = Overlay { grid, colours, layers, is_georeferenced: false, crs: None };
        let options = Options { legend: false, ..Options::default() };
        let bytes = write_overlay(&overlay, &options).unwrap();
        let world = crate::image::WorldFile::default();
        let read = crate::image::read_colours(crate::Format::Png, &bytes, &[], &world).unwrap();
        let at = |x: usize, y: usize| read.values[y * read.grid.columns as usize + x];
        assert_eq!(at(10, 10), [1.0; 3], "the margin");
        assert_eq!((at(60, 60), at(2000, 60)), ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0]));
        assert_eq!(at(500, 56 + 500), [0.0, 0.0, 1.0], "the line");
    }
}
