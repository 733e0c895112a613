//! Raster pictures: the vector picture, drawn.

use crate::Error;
use crate::svg::{self, Lettering, Options, Scene};
use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{self, Tree};

/// Pixels of the picture for each pixel of the vector picture.
const SCALE: f32 = 2.0;

/// The picture of all scenes as PNG.
///
/// # Errors
/// If the renderer cannot draw it, which asks for a report.
pub fn write(scenes: &[Scene], options: &Options) -> Result<Vec<u8>, Error> {
    let options = Options { lettering: Lettering::Strokes, ..options.clone() };
    let picture = svg::write(scenes, &options);
    let failed = |why: String| Error::Picture { why };
    let tree = Tree::from_str(&picture, &usvg::Options::default())
        .map_err(|error| failed(error.to_string()))?;
    let size = tree.size();
    let (width, height) = ((SCALE * size.width()).ceil(), (SCALE * size.height()).ceil());
    let mut pixels = Pixmap::new(width as u32, height as u32)
        .ok_or_else(|| failed(format!("a picture of {width} × {height} pixels does not fit")))?;
    resvg::render(&tree, Transform::from_scale(SCALE, SCALE), &mut pixels.as_mut());
    pixels.encode_png().map_err(|error| failed(error.to_string()))
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
}
