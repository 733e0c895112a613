//! Glyphs of TrueType and OpenType fonts as polygons, in font units, y up.
//!
//! With a text, its glyphs are laid out as the tables of the font have it, with kerning and ligatures, each
//! line below the one before; without one, all glyphs with an outline stand one after the other. Of a
//! variable font that is its default instance; of a collection the first font, or the one whose number is
//! named as the layer.

use crate::curves::{Contour, flatten};
use crate::json::quoted;
use crate::{Error, Feature, FeatureError, Json, Layer, Note, ReadOptions};
use harfrust::{ShaperData, UnicodeBuffer};
use medial::domain::FillRule;
use medial::geom::Point;
use skrifa::instance::{LocationRef, Size};
use skrifa::outline::{DrawSettings, OutlinePen};
use skrifa::raw::FileRef;
use skrifa::{FontRef, GlyphId, MetadataProvider};
use std::collections::HashMap;

/// Whether bytes begin like a font.
pub(crate) fn begins(bytes: &[u8]) -> bool {
    [&[0, 1, 0, 0][..], b"OTTO", b"true", b"ttcf"].iter().any(|magic| bytes.starts_with(magic))
}

/// Reads the glyphs of a text, or all there are.
///
/// # Errors
/// If the bytes are no font. A glyph that is broken or missing is an item of the layer.
pub fn read<'a>(bytes: &[u8], options: &ReadOptions) -> Result<Layer<'a>, Error> {
    if bytes.is_empty() {
        return Err(Error::Empty);
    }
    let (mut glyphs, is_variable) = caught(|| {
        let font = face(bytes, options.layer.as_deref())?;
        let glyphs = match &options.text {
            Some(text) => laid_out(&font, text, is_cut_off(&font, bytes))?,
            None => all(&font)?,
        };
        Ok::<_, Error>((glyphs, font.axes().iter().next().is_some()))
    })??;
    if is_variable && let Some(Ok(first)) = glyphs.first_mut() {
        let text = "the font is variable; its default instance is taken".to_owned();
        first.notes.push(Note { code: "default_instance", text });
    }
    let tolerance = options.tolerance;
    let len = Some(glyphs.len());
    let features = (0..).zip(glyphs).map(move |(index, glyph)| {
        let read = glyph.and_then(|glyph| glyph.feature(index, tolerance));
        read.map_err(|error| FeatureError { feature: index, id: None, error })
    });
    Ok(Layer { len, ..Layer::new(features) })
}

/// What work with a font gives; its parser may panic where a font is broken (read-fonts 0.41 does on
/// glyphs that are cut off).
pub(crate) fn caught<T>(work: impl FnOnce() -> T) -> Result<T, Error> {
    std::panic::catch_unwind(std::panic::AssertUnwindSafe(work)).map_err(|_| Error::Value {
        place: "the font".to_owned(),
        why: "a table of it is broken; take another font".to_owned(),
    })
}

/// A glyph in its place.
struct Glyph {
    text: Option<String>,
    name: String,
    at: Point,
    contours: Vec<Contour>,
    notes: Vec<Note>,
}

impl Glyph {
    fn feature(self, index: usize, tolerance: Option<f64>) -> Result<Feature, Error> {
        let at = self.at;
        let moved = |contour: &Contour| contour.map(|p| p + at, |p| p);
        let contours = self.contours.iter().map(moved).collect();
        let (polygons, curves) = flatten(&[contours], tolerance)?;
        let mut properties: Vec<(String, Json)> = Vec::new();
        properties.extend(self.text.map(|text| ("char".to_owned(), quoted(&text))));
        properties.push(("glyph".to_owned(), quoted(&self.name)));
        properties.push(("x".to_owned(), crate::json::real(at.x)));
        if at.y != 0.0 {
            properties.push(("y".to_owned(), crate::json::real(at.y)));
        }
        Ok(Feature {
            index,
            properties,
            polygons,
            geometry: format!("the glyph {}", self.name),
            polygonal: true,
            fill: FillRule::NonZero,
            curves,
            notes: self.notes,
            ..Feature::default()
        })
    }
}

fn face<'a>(bytes: &'a [u8], layer: Option<&str>) -> Result<FontRef<'a>, Error> {
    let wrong = |why: String| Error::Value { place: "the font".to_owned(), why };
    let number = match layer {
        None => 0,
        Some(layer) => layer
            .parse()
            .map_err(|_| wrong(format!("the layer `{layer}` is no number of a font, from 0")))?,
    };
    let file = FileRef::new(bytes).map_err(|error| wrong(error.to_string()))?;
    let font = match file {
        FileRef::Font(font) if number == 0 => Ok(font),
        FileRef::Font(_) => return Err(wrong("the file holds one font only, number 0".to_owned())),
        FileRef::Collection(fonts) => fonts.get(number),
    };
    font.map_err(|error| wrong(error.to_string()))
}

/// All glyphs that have an outline.
fn all(font: &FontRef) -> Result<Vec<Result<Glyph, Error>>, Error> {
    let mut characters: HashMap<GlyphId, char> = HashMap::new();
    for (code, glyph) in font.charmap().mappings() {
        if let Some(c) = char::from_u32(code) {
            let least = characters.entry(glyph).or_insert(c);
            *least = c.min(*least);
        }
    }
    let advances = font.glyph_metrics(Size::unscaled(), LocationRef::default());
    let mut x = 0.0;
    let mut glyphs = Vec::new();
    for (id, outline) in font.outline_glyphs().iter() {
        let text = characters.get(&id).map(char::to_string);
        match drawn(font, id, &outline) {
            Ok(contours) if contours.is_empty() => {}
            Ok(contours) => {
                let (name, at) = (name(font, id), Point::new(x, 0.0));
                glyphs.push(Ok(Glyph { text, name, at, contours, notes: Vec::new() }));
            }
            Err(error) => glyphs.push(Err(error)),
        }
        x += f64::from(advances.advance_width(id).unwrap_or(0.0));
    }
    if glyphs.is_empty() {
        let why = "it has no glyph with an outline; it is cut off, or of pictures".to_owned();
        return Err(Error::Value { place: "the font".to_owned(), why });
    }
    Ok(glyphs)
}

/// Whether a table of a font, or the list of them, ends behind the end of its file.
fn is_cut_off(font: &FontRef, bytes: &[u8]) -> bool {
    let size = bytes.len() as u64;
    let directory = font.table_directory();
    let records = directory.table_records();
    records.len() < usize::from(directory.num_tables())
        || records
            .iter()
            .any(|record| u64::from(record.offset()) + u64::from(record.length()) > size)
}

/// The glyphs of a text with an outline.
fn laid_out(
    font: &FontRef,
    text: &str,
    is_cut_off: bool,
) -> Result<Vec<Result<Glyph, Error>>, Error> {
    let metrics = font.metrics(Size::unscaled(), LocationRef::default());
    let height = f64::from(metrics.ascent - metrics.descent + metrics.leading);
    let outlines = font.outline_glyphs();
    let data = ShaperData::new(font);
    let shaper = data.shaper(font).build();
    let mut glyphs = Vec::new();
    for (row, line) in text.lines().enumerate() {
        let mut buffer = UnicodeBuffer::new();
        buffer.push_str(line);
        buffer.guess_segment_properties();
        let shaped = shaper.shape(buffer, harfrust::ShapeOptions::new());
        let mut ends: Vec<usize> =
            shaped.glyph_infos().iter().map(|i| i.cluster as usize).collect();
        ends.push(line.len());
        ends.sort_unstable();
        ends.dedup();
        let mut pen = Point::new(0.0, -(row as f64) * height);
        for (info, position) in shaped.glyph_infos().iter().zip(shaped.glyph_positions()) {
            let id = GlyphId::new(info.glyph_id);
            let start = info.cluster as usize;
            let end = ends.iter().copied().find(|end| *end > start).unwrap_or(line.len());
            let cluster = line.get(start..end).unwrap_or_default().to_owned();
            let offset = Point::new(f64::from(position.x_offset), f64::from(position.y_offset));
            if id == GlyphId::NOTDEF {
                let place = format!("character `{cluster}`");
                let why = match is_cut_off {
                    true => "the font is cut off, and has no glyph for it; copy the font again",
                    false => "the font has no glyph for it; take another font",
                };
                glyphs.push(Err(Error::Value { place, why: why.to_owned() }));
            } else if let Some(outline) = outlines.get(id) {
                match drawn(font, id, &outline) {
                    Ok(contours) if contours.is_empty() => {}
                    Ok(contours) => glyphs.push(Ok(Glyph {
                        text: Some(cluster),
                        name: name(font, id),
                        at: pen + offset,
                        contours,
                        notes: Vec::new(),
                    })),
                    Err(error) => glyphs.push(Err(error)),
                }
            }
            let advance = Point::new(f64::from(position.x_advance), f64::from(position.y_advance));
            pen = pen + advance;
        }
    }
    if glyphs.is_empty() {
        let why = "it has no glyph with an outline; give another --text".to_owned();
        return Err(Error::Value { place: "the text".to_owned(), why });
    }
    Ok(glyphs)
}

fn name(font: &FontRef, id: GlyphId) -> String {
    let name = font.glyph_names().get(id);
    name.map_or_else(|| format!("gid{}", id.to_u32()), |name| name.to_string())
}

fn drawn(
    font: &FontRef,
    id: GlyphId,
    outline: &skrifa::outline::OutlineGlyph,
) -> Result<Vec<Contour>, Error> {
    let wrong = |why: String| Error::Value {
        place: format!("glyph {}", name(font, id)),
        why: format!("its outline cannot be read: {why}"),
    };
    let drawn = caught(|| {
        let mut pen = Pen::default();
        let settings = DrawSettings::unhinted(Size::unscaled(), LocationRef::default());
        outline.draw(settings, &mut pen).map(|_| pen.contours)
    });
    match drawn {
        Ok(Ok(contours)) => Ok(contours),
        Ok(Err(error)) => Err(wrong(error.to_string())),
        Err(_) => Err(wrong("it is cut off".to_owned())),
    }
}

#[derive(Default)]
struct Pen {
    contours: Vec<Contour>,
}

impl Pen {
    fn draw(&mut self, draw: impl FnOnce(&mut Contour)) {
        if let Some(contour) = self.contours.last_mut() {
            draw(contour);
        }
    }
}

fn place(x: f32, y: f32) -> Point {
    Point::new(x.into(), y.into())
}

impl OutlinePen for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.contours.push(Contour::new(place(x, y)));
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.draw(|contour| contour.line_to(place(x, y)));
    }

    fn quad_to(&mut self, cx: f32, cy: f32, x: f32, y: f32) {
        self.draw(|contour| contour.curve_to([place(cx, cy), place(x, y)]));
    }

    fn curve_to(&mut self, ax: f32, ay: f32, bx: f32, by: f32, x: f32, y: f32) {
        self.draw(|contour| contour.curve_to([place(ax, ay), place(bx, by), place(x, y)]));
    }

    fn close(&mut self) {}
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_font_is_refused() {
        for bytes in [&b"OTTO"[..], b"\0\x01\0\0\0\xff", b"ttcf\0\x01", b"nothing"] {
            let error = read(bytes, &ReadOptions::default()).err().unwrap();
            assert!(error.to_string().starts_with("the font: "), "{error}");
        }
    }

    #[test]
    fn characters_of_a_font_that_is_cut_off_say_so() {
        let font = include_bytes!("../../../fixtures/drawings/two_letters.ttf");
        let said = |bytes: &[u8], text: &str| -> Vec<String> {
            let options = ReadOptions { text: Some(text.to_owned()), ..ReadOptions::default() };
            let Ok(layer) = read(bytes, &options) else { return Vec::new() };
            layer.filter_map(Result::err).map(|error| error.to_string()).collect()
        };
        assert!(said(font, "X")[0].ends_with("has no glyph for it; take another font"));
        let mut n = 0;
        for end in 12..font.len() {
            for why in said(&font[..end], "X") {
                assert!(!why.contains("take another font"), "{end}: {why}");
                n += usize::from(why.ends_with("copy the font again"));
            }
        }
        assert!(n > 0);
    }

    #[test]
    fn a_font_that_is_cut_off_is_not_taken_for_an_empty_one() {
        let font = include_bytes!("../../../fixtures/drawings/two_letters.ttf");
        for end in 12..font.len() {
            if let Ok(layer) = read(&font[..end], &ReadOptions::default()) {
                assert!(layer.count() > 0, "{end} bytes");
            }
        }
    }
}
