//! Shapes of SVG drawings as polygons.
//!
//! # Contract
//! Each painted part of an element is a feature: what it fills, and the outline of its stroke. Coordinates
//! are user units of the outermost `svg` element, that is, of its `viewBox`, with `-y` for y, so that y
//! points up. Those of points that no transform moves are the given doubles.
//!
//! # Method
//! The XML tree is walked with the style and the transform that hold for each element; `use` walks what
//! it names. Circles, ellipses and arcs stay what they are until they are flattened.
//!
//! # Departures
//! The crate `usvg` reads the same, but in single precision, and turns circles into quadratic curves; it is
//! used for text alone.

mod shape;
mod stroke;
mod style;
mod text;

pub use text::Fonts;

use crate::curves::{Affine, Contour, flatten};
use crate::json::quoted;
use crate::text::syntax_at;
use crate::{Error, Feature, FeatureError, Json, Layer, Note, Part, ReadOptions, gzip};
use kurbo::{Cap, Join};
use medial::domain::FillRule;
use medial::geom::Point;
use roxmltree::{Document, Node, ParsingOptions};
use shape::Subpath;
use simplecss::StyleSheet;
use std::collections::HashMap;
use std::rc::Rc;
use style::Style;
use svgtypes::{Length, LengthUnit, NumberListParser, PointsParser, Transform, TransformOrigin};

/// Deepest nesting of elements, those that are used by others included.
const DEPTH: usize = 200;

/// Most elements that are drawn, those drawn by `use` each time.
const MOST: usize = 1_000_000;

/// Reads the shapes of a drawing.
///
/// # Errors
/// If the text is no SVG. A shape that is wrong is an item of the layer.
pub fn read<'a>(text: &str, options: &ReadOptions) -> Result<Layer<'a>, Error> {
    if text.trim().is_empty() {
        return Err(Error::Empty);
    }
    let parsing = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, parsing).map_err(|error| {
        let at = error.pos();
        let why = format!("no well-formed XML: {error}");
        Error::Syntax { line: at.row as usize, column: at.col as usize, why }
    })?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        let why = format!("the outermost element is `{}`, not `svg`", root.tag_name().name());
        return Err(syntax_at(text, root.range().start, why));
    }
    let sheets: String = document
        .descendants()
        .filter(|node| node.tag_name().name() == "style")
        .flat_map(|node| node.children().filter_map(|child| child.text()))
        .collect();
    let ids = document
        .descendants()
        .rev()
        .filter_map(|node| node.attribute("id").map(|id| (id, node)))
        .collect();
    let view = view_box(root).map_or(Point::new(100.0, 100.0), |[_, _, w, h]| Point::new(w, h));
    let mut walker = Walker {
        document: &document,
        sheet: StyleSheet::parse(&sheets),
        sheets: &sheets,
        ids,
        fonts: &options.fonts,
        drawn: Vec::new(),
        n_visited: 0,
    };
    let place = Place {
        to_page: Affine::FLIP,
        view,
        layer: None,
        group: None,
        clipped: None,
        marked: false,
        depth: 0,
    };
    let style = Style::default().child(root, &walker.sheet);
    walker.children(root, &style, &place);
    let drawn = walker.drawn;
    let tolerance = options.tolerance;
    let len = Some(drawn.len());
    let features = (0..).zip(drawn).map(move |(index, drawn)| {
        // Curves are flattened where features are read.
        Part::of_row(drawn.size(), move || drawn.feature(index, tolerance))
    });
    Ok(Layer { len, ..Layer::of_parts(features) })
}

/// Properties for arrows and the like on the lines of shapes.
const MARKERS: [&str; 4] = ["marker", "marker-start", "marker-mid", "marker-end"];

/// Whether a drawing may have text, for which fonts are needed.
#[must_use]
pub fn has_text(bytes: &[u8]) -> bool {
    // Nobody knows what is packed.
    bytes.starts_with(&gzip::MAGIC)
        || bytes
            .windows(5)
            .any(|window| window == b"text>" || window == b"<text" || window == b":text")
}

/// What is to become a feature.
struct Drawn {
    id: Option<Json>,
    properties: Vec<(String, Json)>,
    geometry: String,
    fill: FillRule,
    notes: Vec<Note>,
    contours: Result<Vec<Contour>, Error>,
}

impl Drawn {
    /// About as many bytes as it has as text.
    fn size(&self) -> usize {
        self.contours.iter().flatten().map(Contour::size).sum()
    }

    fn feature(self, index: usize, tolerance: Option<f64>) -> Result<Feature, FeatureError> {
        let read = self.contours.and_then(|contours| {
            // Holes are found by their depth, or by how rings wind.
            Ok(flatten(&[contours], tolerance)?)
        });
        match read {
            Ok((polygons, curves)) => Ok(Feature {
                index,
                id: self.id,
                properties: self.properties,
                polygons,
                geometry: self.geometry,
                polygonal: true,
                fill: self.fill,
                curves,
                notes: self.notes,
                points: None,
                mask: None,
            }),
            Err(error) => Err(FeatureError { feature: index, id: self.id, error }),
        }
    }
}

/// Where elements stand.
#[derive(Clone)]
struct Place<'a> {
    to_page: Affine,
    /// Width and height of the view, for percentages.
    view: Point,
    layer: Option<&'a str>,
    group: Option<&'a str>,
    /// What cuts it off, as it is written.
    clipped: Option<Rc<str>>,
    /// Whether the lines of the element have arrows or the like.
    marked: bool,
    depth: usize,
}

struct Walker<'a, 'input> {
    document: &'a Document<'input>,
    sheet: StyleSheet<'a>,
    sheets: &'a str,
    ids: HashMap<&'a str, Node<'a, 'input>>,
    fonts: &'a Fonts,
    drawn: Vec<Drawn>,
    n_visited: usize,
}

impl<'a, 'input> Walker<'a, 'input> {
    fn children(&mut self, node: Node<'a, 'input>, style: &Style, place: &Place<'a>) {
        for child in node.children().filter(Node::is_element) {
            self.element(child, style, place);
        }
    }

    fn element(&mut self, node: Node<'a, 'input>, parent: &Style, place: &Place<'a>) {
        self.n_visited += 1;
        if place.depth > DEPTH || self.n_visited > MOST {
            if self.n_visited <= MOST + 1 {
                let why = "elements lie in one another, or are used, more often than is read; \
                           simplify the drawing";
                self.broken(node, why);
                self.n_visited = self.n_visited.max(MOST + 1);
            }
            return;
        }
        let name = node.tag_name().name();
        let style = parent.child(node, &self.sheet);
        if style.is_hidden() {
            return;
        }
        let mut place = Place { depth: place.depth + 1, ..place.clone() };
        for name in ["clip-path", "mask"] {
            if let Some(value) = style.get(name).filter(|value| *value != "none") {
                place.clipped = Some(format!("{name} {value}").into());
            }
        }
        place.marked =
            MARKERS.iter().any(|name| style.get(name).is_some_and(|value| value != "none"));
        match self.transform(&style, place.view) {
            Ok(Some(transform)) => place.to_page = place.to_page.after(&transform),
            Ok(None) => {}
            Err(why) => {
                let why = format!("the transform of `{name}` cannot be read: {why}");
                return self.broken(node, &why);
            }
        }
        if place.to_page.determinant() == 0.0 {
            return;
        }
        match name {
            "g" | "a" => {
                if let Some(id) = node.attribute("id") {
                    place.group = Some(id);
                }
                if attribute(node, "groupmode") == Some("layer") {
                    place.layer = attribute(node, "label").or(node.attribute("id"));
                }
                self.children(node, &style, &place);
            }
            "svg" => self.view(node, &style, place, None),
            "switch" => {
                let shown = node.children().filter(Node::is_element).find(|child| {
                    child.attribute("requiredExtensions").is_none()
                        && child.attribute("systemLanguage").is_none_or(|l| l.starts_with("en"))
                });
                if let Some(child) = shown {
                    self.element(child, &style, &place);
                }
            }
            "use" => self.used(node, &style, place),
            "text" => self.text(node, &style, &place),
            "path" | "rect" | "circle" | "ellipse" | "line" | "polyline" | "polygon"
                if !style.is_invisible() =>
            {
                self.shape(node, &style, &place);
            }
            _ => {}
        }
    }

    /// What an element does to its coordinates, in a view of this size.
    fn transform(&self, style: &Style, view: Point) -> Result<Option<Affine>, String> {
        let Some(value) = style.get("transform").filter(|value| *value != "none") else {
            return Ok(None);
        };
        let Transform { a, b, c, d, e, f } = value
            .replace("px", "")
            .replace("deg", "")
            .parse()
            .map_err(|error: svgtypes::Error| error.to_string())?;
        let transform = Affine { a, b, c, d, e, f };
        if let Some(other) = style.get("transform-box").filter(|name| *name != "view-box") {
            return Err(format!("the transform-box `{other}` is not known; leave it out"));
        }
        let Some(origin) = style.get("transform-origin") else { return Ok(Some(transform)) };
        let TransformOrigin { x_offset, y_offset, .. } =
            origin.parse().map_err(|_| format!("`{origin}` is no transform-origin"))?;
        let x = self.user_units(x_offset, style, view.x);
        let y = self.user_units(y_offset, style, view.y);
        let there = Affine::translation(x, y);
        Ok(Some(there.after(&transform).after(&Affine::translation(-x, -y))))
    }

    /// An element with coordinates of its own.
    fn view(
        &mut self,
        node: Node<'a, 'input>,
        style: &Style,
        mut place: Place<'a>,
        sizes: Option<[Option<f64>; 2]>,
    ) {
        let length = |name: &str, along: f64| self.length(node, name, style, along);
        let origin = match node.tag_name().name() {
            "svg" => Point::new(
                length("x", place.view.x).unwrap_or(0.0),
                length("y", place.view.y).unwrap_or(0.0),
            ),
            _ => Point::default(),
        };
        let [width, height] = sizes.unwrap_or([None, None]);
        let width = width.or_else(|| length("width", place.view.x)).unwrap_or(place.view.x);
        let height = height.or_else(|| length("height", place.view.y)).unwrap_or(place.view.y);
        let mut to_parent = Affine::translation(origin.x, origin.y);
        let mut view = Point::new(width, height);
        if let Some([x, y, w, h]) = view_box(node) {
            let (mut sx, mut sy) = (width / w, height / h);
            let aspect = node.attribute("preserveAspectRatio").unwrap_or("xMidYMid meet");
            let (mut dx, mut dy) = (0.0, 0.0);
            if !aspect.contains("none") {
                let s = if aspect.contains("slice") { sx.max(sy) } else { sx.min(sy) };
                (sx, sy) = (s, s);
                let share = |axis: &str| match aspect {
                    a if a.contains(&format!("{axis}Min")) => 0.0,
                    a if a.contains(&format!("{axis}Max")) => 1.0,
                    _ => 0.5,
                };
                dx = (width - w * s) * share("x");
                dy = (height - h * s) * share("Y");
            }
            to_parent = Affine::translation(origin.x + dx, origin.y + dy)
                .after(&Affine::scaling(sx, sy))
                .after(&Affine::translation(-x, -y));
            view = Point::new(w, h);
        }
        place.to_page = place.to_page.after(&to_parent);
        if !place.to_page.is_finite() || place.to_page.determinant() == 0.0 {
            return;
        }
        place.view = view;
        self.children(node, style, &place);
    }

    fn used(&mut self, node: Node<'a, 'input>, style: &Style, mut place: Place<'a>) {
        let target = href(node).and_then(|id| self.ids.get(id).copied());
        let Some(target) = target else {
            let why =
                format!("`use` names {}, which is not there", href(node).unwrap_or("nothing"));
            return self.broken(node, &why);
        };
        let length = |name: &str, along: f64| self.length(node, name, style, along);
        let (x, y) = (length("x", place.view.x), length("y", place.view.y));
        let sizes = [length("width", place.view.x), length("height", place.view.y)];
        let shift = Affine::translation(x.unwrap_or(0.0), y.unwrap_or(0.0));
        place.to_page = place.to_page.after(&shift);
        if let Some(id) = node.attribute("id") {
            place.group = Some(id);
        }
        if matches!(target.tag_name().name(), "svg" | "symbol") {
            let inner = style.child(target, &self.sheet);
            if !inner.is_hidden() && place.depth <= DEPTH {
                place.depth += 1;
                self.view(target, &inner, place, Some(sizes));
            }
        } else {
            self.element(target, style, &place);
        }
    }

    fn shape(&mut self, node: Node<'a, 'input>, style: &Style, place: &Place<'a>) {
        let name = node.tag_name().name();
        let fill = style.paint("fill", Some("black")).filter(|_| name != "line");
        let stroke = style.paint("stroke", None);
        if fill.is_none() && stroke.is_none() {
            return;
        }
        let parts = match self.subpaths(node, style, place) {
            Ok(parts) if parts.is_empty() => return,
            Ok(parts) => parts,
            Err(why) => return self.broken(node, &why),
        };
        // What has no area is filled with nothing, as an open line is by default.
        if let Some(paint) = fill.filter(|_| !parts.iter().all(Subpath::is_flat)) {
            let contours = parts.iter().map(|part| place.to_page.contour(&part.contour));
            let rule = match style.get("fill-rule") {
                Some("evenodd") => FillRule::EvenOdd,
                _ => FillRule::NonZero,
            };
            let contours = Ok(contours.collect());
            self.add(node, place, ("fill", &paint), rule, contours);
        }
        if let Some(paint) = stroke {
            self.stroke(node, style, place, &parts, &paint);
        }
    }

    fn stroke(
        &mut self,
        node: Node<'a, 'input>,
        style: &Style,
        place: &Place<'a>,
        parts: &[Subpath],
        paint: &str,
    ) {
        let diagonal = (place.view.norm2() / 2.0).sqrt();
        let number = |name: &str| style.get(name).and_then(|v| self.value(v, style, diagonal));
        let width = number("stroke-width").unwrap_or(1.0);
        if width <= 0.0 {
            return;
        }
        let dashes = style.get("stroke-dasharray").filter(|v| *v != "none").unwrap_or_default();
        let mut dashes: Vec<f64> = dashes
            .split(|c: char| c == ',' || c.is_whitespace())
            .filter(|word| !word.is_empty())
            .filter_map(|word| self.value(word, style, diagonal))
            .collect();
        if dashes.iter().any(|dash| *dash < 0.0) || dashes.iter().all(|dash| *dash == 0.0) {
            dashes.clear();
        }
        if dashes.len() % 2 == 1 {
            dashes = dashes.repeat(2);
        }
        let pen = stroke::Pen {
            width,
            join: match style.get("stroke-linejoin") {
                Some("round") => Join::Round,
                Some("bevel") => Join::Bevel,
                _ => Join::Miter,
            },
            miter_limit: number("stroke-miterlimit").filter(|m| *m >= 1.0).unwrap_or(4.0),
            cap: match style.get("stroke-linecap") {
                Some("round") => Cap::Round,
                Some("square") => Cap::Square,
                _ => Cap::Butt,
            },
            dashes,
            dash_offset: number("stroke-dashoffset").unwrap_or(0.0),
        };
        let on_page = style.get("vector-effect") == Some("non-scaling-stroke");
        let outline = if on_page {
            let moved = |part: &Subpath| Subpath {
                contour: place.to_page.contour(&part.contour),
                closed: part.closed,
            };
            stroke::outline(&parts.iter().map(moved).collect::<Vec<_>>(), &pen)
        } else {
            stroke::outline(parts, &pen).map(|outline| stroke::Outline {
                contours: outline.contours.iter().map(|c| place.to_page.contour(c)).collect(),
                ..outline
            })
        };
        match outline {
            // Without caps there is nothing to see of what has no length.
            Ok(outline) if outline.contours.is_empty() => {}
            Ok(outline) => {
                let contours = Ok(outline.contours);
                self.add(node, place, ("stroke", paint), FillRule::NonZero, contours);
                if outline.is_solid
                    && let Some(drawn) = self.drawn.last_mut()
                {
                    let name = node.tag_name().name();
                    drawn.notes.push(Note {
                        code: "dashes_ignored",
                        text: format!(
                            "the dashes of the {name} are too many and are ignored; make them longer"
                        ),
                    });
                }
            }
            Err(why) => self.broken(node, &why),
        }
    }

    fn text(&mut self, node: Node<'a, 'input>, style: &Style, place: &Place<'a>) {
        let text: String =
            node.descendants().filter(|n| n.is_text()).filter_map(|n| n.text()).collect();
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        let paint = style.paint("fill", Some("black")).or_else(|| style.paint("stroke", None));
        let Some(paint) = paint.filter(|_| !text.is_empty() && !style.is_invisible()) else {
            return;
        };
        // Its own transform is in the source, and in the place.
        let to_page = match self.transform(style, place.view) {
            Ok(Some(transform)) => match transform.inverse() {
                Some(back) => place.to_page.after(&back),
                None => return,
            },
            _ => place.to_page,
        };
        let sources = (self.document, self.sheets);
        let found = text::glyphs(sources, node, style, place.view, self.fonts);
        let contours = if found.is_empty() {
            let start: String = text.chars().take(20).collect();
            Err(Error::NoFont { what: format!("the text `{start}`") })
        } else {
            Ok(found.iter().map(|c| to_page.contour(c)).collect())
        };
        self.add(node, place, ("fill", &paint), FillRule::NonZero, contours);
        if let Some(drawn) = self.drawn.last_mut() {
            drawn.properties.push(("text".to_owned(), quoted(&text)));
        }
    }

    fn add(
        &mut self,
        node: Node<'a, 'input>,
        place: &Place<'a>,
        (part, paint): (&str, &str),
        fill: FillRule,
        contours: Result<Vec<Contour>, Error>,
    ) {
        let mut properties = Vec::new();
        let mut add = |name: &str, value: Option<&str>| {
            if let Some(value) = value {
                properties.push((name.to_owned(), quoted(value)));
            }
        };
        let name = node.tag_name().name();
        add("element", Some(name));
        add("id", node.attribute("id"));
        add("part", Some(part));
        add(part, Some(paint));
        add("class", node.attribute("class"));
        add("label", attribute(node, "label"));
        add("group", place.group);
        add("layer", place.layer);
        let mut notes = Vec::new();
        if let Some(clip) = &place.clipped {
            notes.push(Note {
                code: "clip_ignored",
                text: format!("the {clip} of the {name} is ignored"),
            });
        }
        if part == "stroke" && place.marked {
            notes.push(Note {
                code: "marker_ignored",
                text: format!("markers on the {name} are ignored"),
            });
        }
        self.drawn.push(Drawn {
            id: node.attribute("id").map(quoted),
            properties,
            geometry: format!("an SVG {name}"),
            fill,
            notes,
            contours,
        });
    }

    /// Adds an element that cannot be read.
    fn broken(&mut self, node: Node<'a, 'input>, why: &str) {
        self.drawn.push(Drawn {
            id: node.attribute("id").map(quoted),
            properties: Vec::new(),
            geometry: String::new(),
            fill: FillRule::NonZero,
            notes: Vec::new(),
            contours: Err(syntax_at(self.document.input_text(), node.range().start, why)),
        });
    }

    /// The parts of a shape, none if nothing of it is drawn.
    fn subpaths(
        &self,
        node: Node<'a, 'input>,
        style: &Style,
        place: &Place<'a>,
    ) -> Result<Vec<Subpath>, String> {
        let size = |name: &str, along: f64| self.length(node, name, style, along);
        let diagonal = (place.view.norm2() / 2.0).sqrt();
        let x = |name: &str| size(name, place.view.x);
        let y = |name: &str| size(name, place.view.y);
        let zero = |value: Option<f64>| value.unwrap_or(0.0);
        let at = |a: &str, b: &str| Point::new(zero(x(a)), zero(y(b)));
        Ok(match node.tag_name().name() {
            "path" => {
                let data = node.attribute("d").unwrap_or_default();
                if data.trim() == "none" {
                    return Ok(Vec::new());
                }
                return shape::path(data)
                    .map_err(|why| format!("the data of the path cannot be read: {why}"));
            }
            "rect" => {
                let (width, height) = (zero(x("width")), zero(y("height")));
                if !(width > 0.0 && height > 0.0) {
                    return Ok(Vec::new());
                }
                let (rx, ry) = (x("rx"), y("ry"));
                let radii = Point::new(zero(rx.or(ry)), zero(ry.or(rx)));
                vec![shape::rectangle(at("x", "y"), Point::new(width, height), radii)]
            }
            "circle" => match size("r", diagonal) {
                Some(r) if r > 0.0 => vec![shape::ellipse(at("cx", "cy"), r, r)],
                _ => Vec::new(),
            },
            "ellipse" => {
                let (rx, ry) = (x("rx"), y("ry"));
                match (rx.or(ry), ry.or(rx)) {
                    (Some(rx), Some(ry)) if rx > 0.0 && ry > 0.0 => {
                        vec![shape::ellipse(at("cx", "cy"), rx, ry)]
                    }
                    _ => Vec::new(),
                }
            }
            "line" => {
                let ends = [at("x1", "y1"), at("x2", "y2")];
                shape::polyline(&ends, false).into_iter().collect()
            }
            name => {
                let data = node.attribute("points").unwrap_or_default();
                let points: Vec<Point> =
                    PointsParser::from(data).map(|(x, y)| Point::new(x, y)).collect();
                let n = NumberListParser::from(data).filter(Result::is_ok).count();
                if n / 2 != points.len() || NumberListParser::from(data).any(|n| n.is_err()) {
                    return Err(format!("the points of the {name} cannot be read"));
                }
                shape::polyline(&points, name == "polygon").into_iter().collect()
            }
        })
    }

    /// The length in an attribute, or in a style sheet, in user units.
    fn length(&self, node: Node, name: &str, style: &Style, along: f64) -> Option<f64> {
        self.value(style.get(name).or_else(|| node.attribute(name))?, style, along)
    }

    fn value(&self, value: &str, style: &Style, along: f64) -> Option<f64> {
        Some(self.user_units(value.trim().parse().ok()?, style, along))
    }

    fn user_units(&self, length: Length, style: &Style, along: f64) -> f64 {
        let Length { number, unit } = length;
        let font_size = || match style.get("font-size").map(str::parse::<Length>) {
            Some(Ok(Length { number, unit: LengthUnit::None | LengthUnit::Px })) => number,
            _ => 16.0,
        };
        match unit {
            LengthUnit::None | LengthUnit::Px => number,
            LengthUnit::Em => number * font_size(),
            LengthUnit::Ex => number * font_size() / 2.0,
            LengthUnit::In => number * 96.0,
            LengthUnit::Cm => number * 96.0 / 2.54,
            LengthUnit::Mm => number * 96.0 / 25.4,
            LengthUnit::Pt => number * 4.0 / 3.0,
            LengthUnit::Pc => number * 16.0,
            LengthUnit::Percent => number / 100.0 * along,
        }
    }
}

/// The identifier that a reference within the document names.
fn href<'a>(node: Node<'a, '_>) -> Option<&'a str> {
    attribute(node, "href")?.trim().strip_prefix('#')
}

/// An attribute of any namespace.
fn attribute<'a>(node: Node<'a, '_>, name: &str) -> Option<&'a str> {
    node.attributes().find(|attribute| attribute.name() == name).map(|a| a.value())
}

/// The box of the coordinates of an element, if it has one that is not empty.
fn view_box(node: Node) -> Option<[f64; 4]> {
    let numbers: Vec<f64> =
        NumberListParser::from(node.attribute("viewBox")?).collect::<Result<_, _>>().ok()?;
    let [x, y, w, h] = numbers.try_into().ok()?;
    (w > 0.0 && h > 0.0).then_some([x, y, w, h])
}

#[cfg(test)]
mod tests;
