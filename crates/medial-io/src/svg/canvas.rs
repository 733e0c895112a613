use super::Lettering;
use super::frame::Frame;
use super::lettering::{strokes, width};
use crate::text::escaped;
use medial::axis::Curve;
use medial::geom::Point;
use medial::ops::{Sense, Stroke};
use std::fmt::Write as _;

/// The text of a picture while it is drawn, in picture coordinates throughout.
pub(super) struct Canvas {
    pub frame: Frame,
    body: String,
    lettering: Lettering,
}

/// Where a line of text is anchored.
#[derive(Clone, Copy)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

impl Canvas {
    pub fn new(frame: Frame, lettering: Lettering) -> Self {
        Self { frame, body: String::new(), lettering }
    }

    /// Opens a group with a class name and these attributes.
    pub fn open(&mut self, class: &str, attributes: &str) {
        let _ = writeln!(self.body, "<g class=\"{class}\" {attributes}>");
    }

    pub fn close(&mut self) {
        self.body.push_str("</g>\n");
    }

    /// A path element with these data and attributes; nothing without data.
    pub fn path(&mut self, data: &str, attributes: &str) {
        if !data.is_empty() {
            let _ = writeln!(self.body, "<path d=\"{data}\"{}{attributes}/>", gap(attributes));
        }
    }

    /// A PNG image in base 64 of so many columns and rows, each pixel so large, from its first corner on.
    pub fn image(&mut self, data: &str, size: [u32; 2], scale: [f64; 2], corner: Point) {
        let ([w, h], [sx, sy]) = (size, scale.map(number));
        let [x, y] = [corner.x, corner.y].map(number);
        let _ = writeln!(
            self.body,
            "<image width=\"{w}\" height=\"{h}\" transform=\"matrix({sx} 0 0 {sy} {x} {y})\" \
             preserveAspectRatio=\"none\" style=\"image-rendering:pixelated\" \
             href=\"data:image/png;base64,{data}\"/>"
        );
    }

    /// Opens a group of which nothing is seen outside of a rectangle.
    pub fn clip(&mut self, corner: Point, size: Point) {
        self.body.push_str("<clipPath id=\"window\">");
        self.rectangle(corner, size, "");
        self.body.push_str("</clipPath>\n");
        self.open("layers", "clip-path=\"url(#window)\"");
    }

    pub fn circle(&mut self, centre: Point, radius: f64) {
        let [x, y, r] = [centre.x, centre.y, radius].map(number);
        let _ = writeln!(self.body, "<circle cx=\"{x}\" cy=\"{y}\" r=\"{r}\"/>");
    }

    pub fn rectangle(&mut self, corner: Point, size: Point, attributes: &str) {
        let [x, y, w, h] = [corner.x, corner.y, size.x, size.y].map(number);
        let _ = writeln!(
            self.body,
            "<rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\"{}{attributes}/>",
            gap(attributes)
        );
    }

    /// A line of text, with the height of its capitals about 0.7 of `size`.
    pub fn text(&mut self, at: Point, size: f64, anchor: Anchor, color: &str, text: &str) {
        match self.lettering {
            Lettering::Text => {
                let anchor = match anchor {
                    Anchor::Start => "start",
                    Anchor::Middle => "middle",
                    Anchor::End => "end",
                };
                let [x, y, size] = [at.x, at.y, size].map(number);
                let _ = writeln!(
                    self.body,
                    "<text x=\"{x}\" y=\"{y}\" font-family=\"Helvetica, Arial, sans-serif\" \
                     font-size=\"{size}\" text-anchor=\"{anchor}\" fill=\"{color}\">{}</text>",
                    escaped(text)
                );
            }
            Lettering::Strokes => {
                let data = strokes(text, at, size, anchor);
                let width = number(0.085 * size);
                let attributes = format!(
                    "fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\" \
                     stroke-linecap=\"round\" stroke-linejoin=\"round\""
                );
                self.path(&data, &attributes);
            }
        }
    }

    /// The width of a line of text, estimated for fonts.
    pub fn text_width(&self, text: &str, size: f64) -> f64 {
        match self.lettering {
            Lettering::Text => 0.54 * size * text.chars().count() as f64,
            Lettering::Strokes => width(text, size),
        }
    }

    /// The whole picture.
    pub fn finish(self, title: &str) -> String {
        let [w, h] = [self.frame.size.x, self.frame.size.y].map(number);
        self.finish_on(title, &format!("<rect width=\"{w}\" height=\"{h}\" fill=\"#ffffff\"/>\n"))
    }

    /// What machines are told, which is not drawn.
    pub fn metadata(&mut self, text: &str) {
        self.body.push_str(&format!("<metadata>\n{text}\n</metadata>\n"));
    }

    /// The picture without a ground.
    pub fn finish_clear(self, title: &str) -> String {
        self.finish_on(title, "")
    }

    fn finish_on(self, title: &str, ground: &str) -> String {
        let [w, h] = [self.frame.size.x, self.frame.size.y].map(number);
        let title = if title.is_empty() { "Medial axis" } else { title };
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}\" height=\"{h}\" \
             viewBox=\"0 0 {w} {h}\">\n<title>{title}</title>\n{ground}{}</svg>\n",
            self.body
        )
    }
}

fn gap(attributes: &str) -> &str {
    if attributes.is_empty() { "" } else { " " }
}

/// Data of path elements, from points of the plane.
pub(super) struct Data<'a> {
    frame: &'a Frame,
    pub text: String,
}

impl<'a> Data<'a> {
    pub fn new(frame: &'a Frame) -> Self {
        Self { frame, text: String::new() }
    }

    pub fn move_to(&mut self, p: Point) {
        self.verb('M', &[p]);
    }

    pub fn line_to(&mut self, p: Point) {
        self.verb('L', &[p]);
    }

    /// On to the end of a curve that starts where the pen is.
    pub fn curve_to(&mut self, curve: &Curve) {
        match curve.control() {
            Some(control) => self.quadratic_to(control, curve.to()),
            None => self.line_to(curve.to()),
        }
    }

    /// A closed ring.
    pub fn ring(&mut self, points: impl IntoIterator<Item = Point>) {
        for (k, p) in points.into_iter().enumerate() {
            self.verb(if k == 0 { 'M' } else { 'L' }, &[p]);
        }
        self.text.push('Z');
    }

    /// A closed contour, its arcs as arcs.
    pub fn contour(&mut self, strokes: &[Stroke]) {
        for (k, stroke) in strokes.iter().enumerate() {
            let (Stroke::Line { from, .. } | Stroke::Arc { from, .. }) = *stroke;
            if k == 0 {
                self.move_to(from);
            }
            self.stroke(stroke);
        }
        if !strokes.is_empty() {
            self.text.push('Z');
        }
    }

    /// On to the end of a stroke that starts where the pen is.
    pub fn stroke(&mut self, stroke: &Stroke) {
        match *stroke {
            Stroke::Line { to, .. } => self.line_to(to),
            Stroke::Arc { to, radius, sense, angle, .. } => {
                let is_large = angle > std::f64::consts::PI;
                self.arc_to(to, radius, is_large, sense == Sense::Clockwise);
            }
        }
    }

    fn arc_to(&mut self, to: Point, radius: f64, is_large: bool, is_clockwise: bool) {
        let radius = number(self.frame.length(radius));
        // Pictures have y down.
        let (large, sweep) = (u8::from(is_large), u8::from(is_clockwise));
        let p = self.frame.map(to);
        let [x, y] = [p.x, p.y].map(number);
        let _ = write!(self.text, "A{radius} {radius} 0 {large} {sweep} {x} {y}");
    }

    /// A whole disk, counterclockwise.
    pub fn disk(&mut self, centre: Point, radius: f64) {
        let [right, left] = [radius, -radius].map(|x| centre + Point::new(x, 0.0));
        self.move_to(right);
        self.arc_to(left, radius, false, false);
        self.arc_to(right, radius, false, false);
        self.text.push('Z');
    }

    /// What lies between the outer tangents of two disks, each a centre and a diameter; nothing if one
    /// holds the other.
    pub fn hull(&mut self, (p, first): (Point, f64), (q, second): (Point, f64)) {
        let way = q - p;
        let distance = way.norm();
        let lean = 0.5 * (first - second) / distance;
        if lean.is_nan() || lean.abs() >= 1.0 {
            return;
        }
        let along = way * (1.0 / distance);
        let across = along.perp() * ((1.0 - lean) * (1.0 + lean)).sqrt();
        let [left, right] = [along * lean + across, along * lean - across];
        let corners = [(p, right, first), (q, right, second), (q, left, second), (p, left, first)];
        self.ring(corners.map(|(at, normal, width)| at + normal * (0.5 * width)));
    }

    /// On along a quadratic Bézier curve.
    pub fn quadratic_to(&mut self, control: Point, to: Point) {
        self.verb('Q', &[control, to]);
    }

    /// A dot, as large as the stroke with round caps.
    pub fn dot(&mut self, p: Point) {
        self.move_to(p);
        self.text.push_str("h.01");
    }

    /// A dot at a place of the picture.
    pub fn dot_at(place: Point) -> String {
        format!("M{} {}h.01", number(place.x), number(place.y))
    }

    fn verb(&mut self, verb: char, points: &[Point]) {
        self.text.push(verb);
        for (k, &p) in points.iter().enumerate() {
            let p = self.frame.map(p);
            let gap = if k == 0 { "" } else { " " };
            let _ = write!(self.text, "{gap}{} {}", number(p.x), number(p.y));
        }
    }
}

/// A picture coordinate: a ten-thousandth of a pixel is far below what can be seen.
pub(super) fn number(value: f64) -> String {
    let mut text = format!("{value:.4}");
    text.truncate(text.trim_end_matches('0').trim_end_matches('.').len());
    if text == "-0" { "0".to_owned() } else { text }
}
