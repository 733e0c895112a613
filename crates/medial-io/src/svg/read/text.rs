//! Text as the outlines of its glyphs.
//!
//! The crate `usvg` lays text out, in single precision; each text is given to it alone, so that it is known
//! which one has no font.

use super::style::Style;
use crate::curves::{Affine, Contour};
use crate::font::caught;
use medial::geom::Point;
use roxmltree::{Document, Node};
use std::fmt::Write as _;
use std::sync::Arc;
use usvg::tiny_skia_path::PathSegment;
use usvg::{Tree, fontdb};

/// Fonts for the text of drawings.
#[derive(Clone, Debug, Default)]
pub struct Fonts(Arc<fontdb::Database>);

impl Fonts {
    /// The fonts that are installed; this reads their files.
    #[must_use]
    pub fn of_system() -> Self {
        let mut fonts = fontdb::Database::new();
        fonts.load_system_fonts();
        Self(Arc::new(fonts))
    }

    /// With the fonts in the bytes of a font file, which come before others for any family.
    #[must_use]
    pub fn with(self, bytes: Vec<u8>) -> Self {
        let mut fonts = Arc::unwrap_or_clone(self.0);
        let first = fonts.len();
        fonts.load_font_data(bytes);
        let named = fonts.faces().nth(first).and_then(|face| face.families.first());
        if let Some((family, _)) = named.cloned() {
            fonts.set_serif_family(&family);
            fonts.set_sans_serif_family(&family);
            fonts.set_monospace_family(&family);
        }
        Self(Arc::new(fonts))
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl PartialEq for Fonts {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// The outlines of the glyphs of a text element, in its coordinates, in a view of some size; none if it
/// has no glyphs.
pub(super) fn glyphs(
    sources: (&Document, &str),
    node: Node,
    style: &Style,
    view: Point,
    fonts: &Fonts,
) -> Vec<Contour> {
    let alone = alone(sources, node, style, view);
    let options = usvg::Options {
        fontdb: Arc::clone(&fonts.0),
        image_href_resolver: usvg::ImageHrefResolver {
            resolve_data: Box::new(|_, _, _| None),
            resolve_string: Box::new(|_, _| None),
        },
        ..usvg::Options::default()
    };
    let drawn = caught(|| {
        let mut contours = Vec::new();
        if let Ok(tree) = Tree::from_str(&alone, &options) {
            add(tree.root(), &mut contours);
        }
        contours
    });
    drawn.unwrap_or_default()
}

/// A document with nothing but a text.
fn alone((document, sheets): (&Document, &str), node: Node, style: &Style, view: Point) -> String {
    let mut text = String::from("<svg xmlns=\"http://www.w3.org/2000/svg\"");
    for namespace in node.namespaces() {
        if let Some(name) = namespace.name().filter(|name| *name != "xml") {
            let _ = write!(text, " xmlns:{name}=\"{}\"", crate::text::escaped(namespace.uri()));
        }
    }
    // Percentages are of the view.
    let Point { x, y } = view;
    let _ = write!(text, " width=\"{x}\" height=\"{y}\"><style>");
    text.push_str(&crate::text::escaped(sheets).replace("&quot;", "\""));
    text.push_str("</style><defs>");
    // Paths that the text runs along.
    for part in node.descendants().filter(Node::is_element) {
        let target = super::href(part)
            .and_then(|id| document.descendants().find(|other| other.attribute("id") == Some(id)));
        if let Some(path) = target.filter(|target| target.tag_name().name() == "path") {
            text.push_str(&document.input_text()[path.range()]);
        }
    }
    text.push_str("</defs><g");
    for (name, value) in style.inherited() {
        if name != "fill" && name != "stroke" {
            let _ = write!(text, " {name}=\"{}\"", crate::text::escaped(value));
        }
    }
    text.push('>');
    // Where it stands is said by the transform of all of it.
    let source = &document.input_text()[node.range()];
    text.push_str(source);
    text.push_str("</g></svg>");
    text
}

fn add(group: &usvg::Group, contours: &mut Vec<Contour>) {
    for child in group.children() {
        match child {
            usvg::Node::Group(group) => add(group, contours),
            usvg::Node::Text(text) => add(text.flattened(), contours),
            usvg::Node::Path(path) => {
                let t = path.abs_transform();
                let map = Affine {
                    a: t.sx.into(),
                    b: t.ky.into(),
                    c: t.kx.into(),
                    d: t.sy.into(),
                    e: t.tx.into(),
                    f: t.ty.into(),
                };
                let first = contours.len();
                let place =
                    |p: usvg::tiny_skia_path::Point| Point::new(f64::from(p.x), f64::from(p.y));
                for segment in path.data().segments() {
                    if let PathSegment::MoveTo(p) = segment {
                        contours.push(Contour::new(place(p)));
                    }
                    let Some(contour) = contours[first..].last_mut() else { continue };
                    match segment {
                        PathSegment::MoveTo(_) | PathSegment::Close => {}
                        PathSegment::LineTo(p) => contour.line_to(place(p)),
                        PathSegment::QuadTo(a, b) => contour.curve_to([place(a), place(b)]),
                        PathSegment::CubicTo(a, b, c) => {
                            contour.curve_to([place(a), place(b), place(c)]);
                        }
                    }
                }
                if map != Affine::IDENTITY {
                    contours[first..].iter_mut().for_each(|c| *c = map.contour(c));
                }
            }
            usvg::Node::Image(_) => {}
        }
    }
}
