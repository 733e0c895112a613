//! The sheet of a figure: panels, each with its own piece of the plane, and what is drawn there.

use crate::style::{self, HALO, INK, MUTED};
use medial::axis::{Curve, KeypointKind, MedialAxis, Site};
use medial::domain::Domain;
use medial::geom::Point;
use medial::raster::Mask;
use std::fmt::Write as _;

/// Space around and between panels, in pixels.
const GAP: f64 = 18.0;
/// Height of the line of words under a panel.
const CAPTION: f64 = 30.0;
/// Height of the legend.
const LEGEND: f64 = 34.0;

/// A figure while it is drawn.
pub struct Sheet {
    columns: usize,
    size: (f64, f64),
    panels: usize,
    captions: bool,
    legend: String,
    body: String,
}

/// A piece of the plane: lower left and upper right corner.
pub type Window = (Point, Point);

/// One panel of a sheet, with a piece of the plane drawn to scale.
pub struct Panel<'s> {
    sheet: &'s mut Sheet,
    window: Window,
    scale: f64,
    origin: Point,
}

impl Sheet {
    /// A sheet with panels of one size, side by side in this many columns.
    pub fn new(columns: usize, size: (f64, f64)) -> Self {
        Self {
            columns,
            size,
            panels: 0,
            captions: false,
            legend: String::new(),
            body: String::new(),
        }
    }

    /// The next panel, with a piece of the plane in its middle and words below it.
    pub fn panel(&mut self, window: Window, caption: &str) -> Panel<'_> {
        let k = self.panels;
        self.panels += 1;
        self.captions |= !caption.is_empty();
        let (low, high) = window;
        let extent = high - low;
        let scale = (self.size.0 / extent.x).min(self.size.1 / extent.y);
        let (column, row) = ((k % self.columns) as f64, (k / self.columns) as f64);
        let left = GAP + column * (self.size.0 + GAP);
        let top = GAP + row * (self.size.1 + self.caption() + GAP);
        let middle = left + 0.5 * self.size.0;
        let base = top + 0.5 * self.size.1;
        let origin = Point::new(middle - 0.5 * extent.x * scale, base + 0.5 * extent.y * scale);
        if !caption.is_empty() {
            let at = Point::new(middle, top + self.size.1 + 20.0);
            self.words(at, 15.0, "middle", INK, caption);
        }
        Panel { sheet: self, window, scale, origin }
    }

    fn caption(&self) -> f64 {
        if self.captions { CAPTION } else { 0.0 }
    }

    /// A line of samples with their meaning, below everything.
    pub fn legend(&mut self, entries: &[(Sample, &str)]) {
        let rows = self.panels.div_ceil(self.columns) as f64;
        let y = GAP + rows * (self.size.1 + self.caption() + GAP) + 0.5 * LEGEND - 8.0;
        let wide = |text: &str| 44.0 + 7.4 * text.chars().count() as f64;
        let width: f64 = entries.iter().map(|(_, text)| wide(text)).sum();
        let mut x = 0.5 * (self.width() - width) + 8.0;
        for (sample, text) in entries {
            let body = std::mem::take(&mut self.body);
            match sample {
                Sample::Line(style) => {
                    self.element("path", &format!("d=\"M{} {}h22\"", px(x), px(y)), style)
                }
                Sample::Disk(style) => self.element(
                    "circle",
                    &format!("cx=\"{}\" cy=\"{}\" r=\"8\"", px(x + 11.0), px(y)),
                    style,
                ),
                Sample::Area(style) => self.element(
                    "rect",
                    &format!("x=\"{}\" y=\"{}\" width=\"22\" height=\"14\"", px(x), px(y - 7.0)),
                    style,
                ),
                Sample::Spot(color) => self.element(
                    "circle",
                    &format!("cx=\"{}\" cy=\"{}\" r=\"5.5\"", px(x + 11.0), px(y)),
                    &format!("fill=\"{color}\""),
                ),
                Sample::Dot(kind) => self.mark(Point::new(x + 11.0, y), *kind),
            }
            self.words(Point::new(x + 29.0, y + 4.5), 13.0, "start", INK, text);
            self.legend += &std::mem::replace(&mut self.body, body);
            x += wide(text);
        }
    }

    fn width(&self) -> f64 {
        GAP + self.columns as f64 * (self.size.0 + GAP)
    }

    /// The finished figure.
    pub fn finish(self, title: &str) -> String {
        let rows = self.panels.div_ceil(self.columns) as f64;
        let legend = if self.legend.is_empty() { 0.0 } else { LEGEND };
        let height = GAP + rows * (self.size.1 + self.caption() + GAP) + legend;
        let (w, h) = (px(self.width()), px(height));
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{w}\" height=\"{h}\" \
             viewBox=\"0 0 {w} {h}\">\n<title>{title}</title>\n\
             <rect width=\"{w}\" height=\"{h}\" fill=\"#ffffff\"/>\n{}{}</svg>\n",
            self.body, self.legend
        )
    }

    fn element(&mut self, name: &str, shape: &str, style: &str) {
        let _ = writeln!(self.body, "<{name} {shape} {style}/>");
    }

    /// A line of text; what follows an underscore is set lower, up to the next space.
    fn words(&mut self, at: Point, size: f64, anchor: &str, color: &str, text: &str) {
        let _ = write!(
            self.body,
            "<text x=\"{}\" y=\"{}\" font-family=\"Helvetica, Arial, sans-serif\" \
             font-size=\"{}\" text-anchor=\"{anchor}\" fill=\"{color}\" {HALO}>",
            px(at.x),
            px(at.y),
            px(size)
        );
        for (k, part) in text.split('_').enumerate() {
            if k == 0 {
                self.body += part;
                continue;
            }
            let end = part.find([' ', ',', ')']).unwrap_or(part.len());
            let (low, rest) = part.split_at(end);
            let drop = px(0.25 * size);
            let small = px(0.72 * size);
            let _ = write!(
                self.body,
                "<tspan dy=\"{drop}\" font-size=\"{small}\">{low}</tspan>\
                 <tspan dy=\"-{drop}\">{}</tspan>",
                if rest.is_empty() { "\u{200b}" } else { rest }
            );
        }
        self.body += "</text>\n";
    }

    /// The mark of a kind of keypoint.
    fn mark(&mut self, at: Point, kind: KeypointKind) {
        let place = format!("cx=\"{}\" cy=\"{}\"", px(at.x), px(at.y));
        match kind {
            KeypointKind::End => {
                self.element("circle", &format!("{place} r=\"4\""), "fill=\"#78909c\"");
            }
            KeypointKind::Transition => {
                let style = format!("fill=\"#ffffff\" stroke=\"{INK}\" stroke-width=\"2\"");
                self.element("circle", &format!("{place} r=\"4.2\""), &style);
            }
            _ => self.element("circle", &format!("{place} r=\"5.2\""), &format!("fill=\"{INK}\"")),
        }
    }
}

/// A sample in a legend.
pub enum Sample {
    /// A stroke.
    Line(&'static str),
    /// A disk.
    Disk(&'static str),
    /// An area.
    Area(&'static str),
    /// A corner.
    Spot(&'static str),
    /// A keypoint.
    Dot(KeypointKind),
}

impl Panel<'_> {
    fn map(&self, p: Point) -> Point {
        let d = (p - self.window.0) * self.scale;
        Point::new(self.origin.x + d.x, self.origin.y - d.y)
    }

    fn pair(&self, p: Point) -> String {
        let p = self.map(p);
        format!("{} {}", px(p.x), px(p.y))
    }

    /// The domain: its interior and its boundary.
    pub fn domain(&mut self, domain: &Domain) {
        self.walks(domain, style::DOMAIN, |_| true);
    }

    /// Those walks of a domain that are wanted.
    pub fn walks(&mut self, domain: &Domain, style: &str, wanted: impl Fn(&[Point]) -> bool) {
        let mut data = String::new();
        for walk in domain.walks() {
            let edges = &domain.edges()[walk.first as usize..(walk.first + walk.len) as usize];
            let points: Vec<Point> = edges.iter().map(|e| e.start).collect();
            if wanted(&points) {
                let pairs: Vec<String> = points.iter().map(|&p| self.pair(p)).collect();
                let _ = write!(data, "M{}Z", pairs.join("L"));
            }
        }
        self.sheet.element("path", &format!("d=\"{data}\""), style);
    }

    /// The cells of a mask, each run of a row as a rectangle.
    pub fn cells(&mut self, mask: &Mask, style: &str) {
        let mut data = String::new();
        for y in 0..mask.grid().rows {
            let cells: Vec<u32> = mask.cells(y).collect();
            for run in cells.chunk_by(|a, b| a + 1 == *b) {
                let (first, last) = (run[0], run[run.len() - 1] + 1);
                let [a, b] =
                    [(first, y), (last, y + 1)].map(|(x, y)| self.map(mask.grid().corner(x, y)));
                let _ =
                    write!(data, "M{} {}H{}V{}H{}Z", px(a.x), px(a.y), px(b.x), px(b.y), px(a.x));
            }
        }
        self.sheet.element("path", &format!("d=\"{data}\""), style);
    }

    /// A rectangle between two corners.
    pub fn rectangle(&mut self, low: Point, high: Point, style: &str) {
        let (a, b) = (self.map(low), self.map(high));
        let data = format!("M{} {}H{}V{}H{}Z", px(a.x), px(a.y), px(b.x), px(b.y), px(a.x));
        self.sheet.element("path", &format!("d=\"{data}\""), style);
    }

    /// Covers what lies outside the panel.
    pub fn mat(&mut self) {
        let (a, b) = (self.map(self.window.0), self.map(self.window.1));
        let [x, y, w, h] = [a.x, b.y, b.x - a.x, a.y - b.y].map(px);
        let far = "M-9999 -9999H19999V19999H-9999Z";
        let data = format!("{far}M{x} {y}v{h}h{w}v-{h}Z");
        let style = format!("fill=\"#ffffff\" fill-rule=\"evenodd\" stroke=\"{INK}\"");
        self.sheet.element("path", &format!("d=\"{data}\""), &style);
    }

    /// All paths of an axis.
    pub fn axis(&mut self, axis: &MedialAxis) {
        for path in axis.paths() {
            self.curve(&axis.curve(&path), style::AXIS);
        }
    }

    /// All keypoints of an axis.
    pub fn keypoints(&mut self, axis: &MedialAxis) {
        for keypoint in axis.keypoints() {
            self.dot(keypoint.position, keypoint.kind);
        }
    }

    /// A curve, exactly.
    pub fn curve(&mut self, curve: &Curve, style: &str) {
        self.curves([curve], style);
    }

    /// Curves in one stroke.
    pub fn curves<'c>(&mut self, curves: impl IntoIterator<Item = &'c Curve>, style: &str) {
        let mut data = String::new();
        for curve in curves {
            let (from, to) = (self.pair(curve.from()), self.pair(curve.to()));
            let _ = match curve.control() {
                Some(control) => write!(data, "M{from}Q{} {to}", self.pair(control)),
                None => write!(data, "M{from}L{to}"),
            };
        }
        self.sheet.element("path", &format!("d=\"{data}\""), style);
    }

    /// What a closed chain of curves surrounds, exactly.
    pub fn outline(&mut self, curves: &[Curve], style: &str) {
        let mut data = String::new();
        for (k, curve) in curves.iter().enumerate() {
            if k == 0 {
                let _ = write!(data, "M{}", self.pair(curve.from()));
            }
            let to = self.pair(curve.to());
            let _ = match curve.control() {
                Some(control) => write!(data, "Q{} {to}", self.pair(control)),
                None => write!(data, "L{to}"),
            };
        }
        self.sheet.element("path", &format!("d=\"{data}Z\""), style);
    }

    /// A straight line.
    pub fn line(&mut self, a: Point, b: Point, style: &str) {
        let data = format!("M{}L{}", self.pair(a), self.pair(b));
        self.sheet.element("path", &format!("d=\"{data}\""), style);
    }

    /// A polyline.
    pub fn polyline(&mut self, points: &[Point], style: &str) {
        let data: Vec<String> = points.iter().map(|&p| self.pair(p)).collect();
        self.sheet.element("path", &format!("d=\"M{}\"", data.join("L")), style);
    }

    /// Rings that bound one area, not cut at the panel's border.
    pub fn rings(&mut self, rings: &[Vec<Point>], style: &str) {
        let ring = |ring: &Vec<Point>| {
            let data: Vec<String> = ring.iter().map(|&p| self.pair(p)).collect();
            format!("M{}Z", data.join("L"))
        };
        let data: String = rings.iter().map(ring).collect();
        self.sheet.element("path", &format!("d=\"{data}\" fill-rule=\"evenodd\""), style);
    }

    /// The part of a half-line within the panel; gives its end.
    pub fn ray(&mut self, from: Point, towards: Point, style: &str) -> Point {
        let (low, high) = self.window;
        let reach = |p: f64, d: f64, low: f64, high: f64| {
            if d > 0.0 {
                (high - p) / d
            } else if d < 0.0 {
                (low - p) / d
            } else {
                f64::INFINITY
            }
        };
        let x = reach(from.x, towards.x, low.x, high.x);
        let y = reach(from.y, towards.y, low.y, high.y);
        let end = from + towards * x.min(y).max(0.0);
        self.line(from, end, style);
        end
    }

    /// A half-line in the direction of a unit vector, beyond the panel's border wherever it starts.
    pub fn onwards(&mut self, from: Point, way: Point, style: &str) {
        let (low, high) = self.window;
        let reach = (high - low).norm() + (from - (low + high) * 0.5).norm();
        self.line(from, from + way * reach, style);
    }

    /// Draws so that what lies beyond the panel's border is cut off.
    pub fn clipped(&mut self, draw: impl FnOnce(&mut Self)) {
        let (a, b) = (self.map(self.window.0), self.map(self.window.1));
        let [x, y, w, h] = [a.x, b.y, b.x - a.x, a.y - b.y].map(px);
        let name = format!("panel-{}", self.sheet.panels);
        let _ = writeln!(
            self.sheet.body,
            "<clipPath id=\"{name}\"><rect x=\"{x}\" y=\"{y}\" width=\"{w}\" height=\"{h}\"/></clipPath>\n\
             <g clip-path=\"url(#{name})\">"
        );
        draw(self);
        self.sheet.body += "</g>\n";
    }

    /// An arrowhead of this colour at `tip`.
    pub fn head(&mut self, tip: Point, towards: Point, color: &str) {
        let tip = self.map(tip);
        let d = Point::new(towards.x, -towards.y) * (1.0 / towards.norm());
        let base = tip - d * 11.0;
        let side = d.perp() * 4.6;
        let at = |p: Point| format!("{} {}", px(p.x), px(p.y));
        let data = format!("M{}L{}L{}Z", at(tip), at(base + side), at(base - side));
        self.sheet.element("path", &format!("d=\"{data}\""), &format!("fill=\"{color}\""));
    }

    /// A closed polygon, cut at the panel's border.
    pub fn area(&mut self, corners: &[Point], style: &str) {
        let data: Vec<String> = cut(corners, self.window).iter().map(|&p| self.pair(p)).collect();
        self.sheet.element("path", &format!("d=\"M{}Z\"", data.join("L")), style);
    }

    /// The part of the plane between a curve and its footpoints on a site.
    pub fn cell(&mut self, curve: &Curve, site: &Site, style: &str) {
        let [from, to] = [curve.from(), curve.to()].map(|p| self.pair(p));
        let [start, end] = [curve.from(), curve.to()].map(|p| self.pair(site.footpoint(p)));
        let middle =
            curve.control().map_or_else(|| format!("L{to}"), |c| format!("Q{} {to}", self.pair(c)));
        let data = format!("M{from}{middle}L{end}L{start}Z");
        self.sheet.element("path", &format!("d=\"{data}\""), style);
    }

    /// A disk.
    pub fn disk(&mut self, centre: Point, radius: f64, style: &str) {
        let c = self.map(centre);
        let r = px(radius * self.scale);
        let shape = format!("cx=\"{}\" cy=\"{}\" r=\"{r}\"", px(c.x), px(c.y));
        self.sheet.element("circle", &shape, style);
    }

    /// Lines from a centre to its footpoints on some sites.
    pub fn spokes(&mut self, centre: Point, sites: &[Site]) {
        for site in sites {
            let foot = site.footpoint(centre);
            self.line(centre, foot, style::SPOKE);
            let c = self.map(foot);
            let shape = format!("cx=\"{}\" cy=\"{}\" r=\"2.6\"", px(c.x), px(c.y));
            self.sheet.element("circle", &shape, &format!("fill=\"{}\"", style::TEAL));
        }
    }

    /// A site, as a broad stroke or a broad dot.
    pub fn site(&mut self, site: &Site, color: &str) {
        if site.a == site.b {
            let c = self.map(site.a);
            let shape = format!("cx=\"{}\" cy=\"{}\" r=\"5.5\"", px(c.x), px(c.y));
            self.sheet.element("circle", &shape, &format!("fill=\"{color}\""));
        } else {
            let style = format!(
                "fill=\"none\" stroke=\"{color}\" stroke-width=\"4.5\" stroke-linecap=\"round\""
            );
            self.line(site.a, site.b, &style);
        }
    }

    /// A keypoint.
    pub fn dot(&mut self, at: Point, kind: KeypointKind) {
        let at = self.map(at);
        self.sheet.mark(at, kind);
    }

    /// Words `dx` pixels to the right of a point and `dy` above it, as far as they must be to
    /// stand clear: a negative `dx` puts their end there, zero their middle.
    pub fn label(&mut self, at: Point, (dx, dy): (f64, f64), color: &str, text: &str) {
        let anchor = if dx > 0.0 {
            "start"
        } else if dx < 0.0 {
            "end"
        } else {
            "middle"
        };
        let at = self.map(at) + Point::new(dx, 5.0 - dy);
        self.sheet.words(at, 15.0, anchor, color, text);
    }

    /// The same in small words.
    pub fn small(&mut self, at: Point, (dx, dy): (f64, f64), color: &str, text: &str) {
        let at = self.map(at) + Point::new(dx, 4.0 - dy);
        self.sheet.words(at, 12.0, "middle", color, text);
    }

    /// A point that is no keypoint.
    pub fn point(&mut self, at: Point, color: &str) {
        let at = self.map(at);
        let shape = format!("cx=\"{}\" cy=\"{}\" r=\"3.6\"", px(at.x), px(at.y));
        self.sheet.element(
            "circle",
            &shape,
            &format!("fill=\"{color}\" stroke=\"#ffffff\" stroke-width=\"1.2\""),
        );
    }

    /// Small quiet words.
    pub fn note(&mut self, at: Point, (dx, dy): (f64, f64), text: &str) {
        let at = self.map(at) + Point::new(dx, 4.0 - dy);
        self.sheet.words(at, 12.0, "middle", MUTED, text);
    }
}

/// A polygon cut at the four sides of a window.
fn cut(corners: &[Point], (low, high): Window) -> Vec<Point> {
    let mut corners = corners.to_vec();
    let sides = [
        (Point::new(1.0, 0.0), low.x),
        (Point::new(-1.0, 0.0), -high.x),
        (Point::new(0.0, 1.0), low.y),
        (Point::new(0.0, -1.0), -high.y),
    ];
    for (normal, least) in sides {
        let depth = |p: Point| normal.dot(p) - least;
        let mut kept = Vec::new();
        for (k, &p) in corners.iter().enumerate() {
            let q = corners[(k + 1) % corners.len()];
            let (a, b) = (depth(p), depth(q));
            if a >= 0.0 {
                kept.push(p);
            }
            if (a >= 0.0) != (b >= 0.0) {
                kept.push(p + (q - p) * (a / (a - b)));
            }
        }
        corners = kept;
    }
    corners
}

/// A coordinate of the picture: a hundredth of a pixel cannot be seen, and hides the last digits,
/// in which platforms might differ.
pub fn px(value: f64) -> String {
    let mut text = format!("{value:.2}");
    text.truncate(text.trim_end_matches('0').trim_end_matches('.').len());
    if text == "-0" { "0".to_owned() } else { text }
}
