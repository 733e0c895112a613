use crate::image::WorldFile;
use crate::svg::Fonts;

/// What a reader is told besides the format.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReadOptions {
    /// The largest distance between a curve and the edges drawn for it, in units of the input; by
    /// default 1e-4 of the longer side of the feature's box.
    pub tolerance: Option<f64>,
    /// The layer to read, of a file with several.
    pub layer: Option<String>,
    /// The text to read in glyphs of a font.
    pub text: Option<String>,
    /// Cells of an image whose value is above it belong to the shape; by default the middle between the
    /// least and the greatest value.
    pub threshold: Option<f64>,
    /// Whether those that are not above it are the shape instead.
    pub invert: bool,
    /// Whether images come as masks alone, without the polygons of their outlines, which take much more memory.
    pub masks_alone: bool,
    /// What files beside an image say of where it lies.
    pub world: Box<WorldFile>,
    /// Fonts for the text of drawings.
    pub fonts: Fonts,
}
