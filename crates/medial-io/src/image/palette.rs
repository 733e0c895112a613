//! Palettes: the colours of an image by their classes.

use std::fmt::Write as _;

/// A colour of a palette.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PaletteColour {
    /// The number of the class.
    pub class: u32,
    /// Red, green and blue.
    pub colour: [u8; 3],
    /// The means that the colour stands for.
    pub means: [f32; 3],
    /// How many of these there are; the others are left empty.
    pub n_means: usize,
    /// How many pixels have it.
    pub pixels: u64,
    /// In how many regions.
    pub regions: u32,
}

/// A colour as text, `#rrggbb`.
#[must_use]
pub fn hexadecimal([red, green, blue]: [u8; 3]) -> String {
    format!("#{red:02x}{green:02x}{blue:02x}")
}

/// The palette as a table of comma-separated values: `class`, `color` as `#rrggbb`, `mean_1` to `mean_3`, `pixels` and
/// `regions`.
#[must_use]
pub fn palette_table(palette: &[PaletteColour]) -> String {
    let mut text = "class,color,mean_1,mean_2,mean_3,pixels,regions\n".to_owned();
    for colour in palette {
        let PaletteColour { class, colour, means, n_means, pixels, regions } = colour;
        let means =
            [0, 1, 2].map(|k| if k < *n_means { means[k].to_string() } else { String::new() });
        // Writing to text does not fail.
        let _ = writeln!(
            text,
            "{class},{},{},{pixels},{regions}",
            hexadecimal(*colour),
            means.join(",")
        );
    }
    text
}

/// The palette as GIMP, Inkscape and others read it, with the number of pixels of each colour.
///
/// ```
/// use medial_io::image::{PaletteColour, palette_gpl};
/// let water = PaletteColour {
///     class: 0, colour: [20, 60, 200], means: [32.0, -20.0, -90.0], n_means: 3, pixels: 950, regions: 2,
/// };
/// let text = palette_gpl("lake", &[water]);
/// assert_eq!(text, "GIMP Palette\nName: lake\n#\n 20  60 200\tclass 0, 950 pixels\n");
/// ```
#[must_use]
pub fn palette_gpl(name: &str, palette: &[PaletteColour]) -> String {
    let name: String = name.chars().filter(|c| !c.is_control()).collect();
    let mut text = format!("GIMP Palette\nName: {name}\n#\n");
    for PaletteColour { class, colour: [red, green, blue], pixels, .. } in palette {
        // Writing to text does not fail.
        let _ = writeln!(text, "{red:3} {green:3} {blue:3}\tclass {class}, {pixels} pixels");
    }
    text
}
