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
    /// Fonts for the text of drawings.
    pub fonts: Fonts,
}
