//! Lines in layers over the picture that they come from.

use super::canvas::{Anchor, Canvas, Data, number};
use super::frame::Frame;
use super::layers::INK;
use super::legend;
use super::{Lettering, Options};
use crate::Crs;
use crate::image;
use crate::text::escaped;
use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use medial::geom::{Point, Rect};
use medial::raster::Grid;

/// A picture, or a part of it, with layers over it.
#[derive(Clone, Debug)]
pub struct Overlay {
    /// Where the pixels lie.
    pub grid: Grid,
    /// Their colours, row by row, each of red, green and blue from 0 to 1; not numbers where there are none.
    pub colours: Vec<[f32; 3]>,
    /// What lies over them, the lowest one first.
    pub layers: Vec<OverlayLayer>,
    /// Whether the plane is that of a georeference, which SVG tells in its metadata.
    pub is_georeferenced: bool,
    /// The reference system of the plane, if it is known.
    pub crs: Option<Crs>,
}

/// Lines of one kind.
#[derive(Clone, Debug)]
pub struct OverlayLayer {
    /// Its name, which is the class of its group and stands in the legend.
    pub name: &'static str,
    /// How its lines are drawn.
    pub style: LineStyle,
    /// The points of each line; one point alone is a dot.
    pub lines: Vec<Vec<Point>>,
    /// Whether the lines are rings, which are closed.
    pub are_rings: bool,
}

/// How lines are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineStyle {
    /// As in SVG.
    pub color: &'static str,
    /// Width, in pixels of a picture of 1000.
    pub width: f64,
    /// Lengths of dashes and gaps, in the same pixels; none for a line without gaps.
    pub dashes: &'static [f64],
    /// What rings are filled with, by how much: 0 for not at all.
    pub fill: f64,
}

#[expect(missing_docs, reason = "the names are those of the layers")]
impl LineStyle {
    pub const BORDER: Self = Self::line("#ffeb3b", 1.6, &[0.1, 3.2]);
    pub const DELAUNAY: Self = Self::line("#ffffff", 0.4, &[]);
    pub const CRUST: Self = Self::line("#ff9800", 1.2, &[]);
    pub const DUAL: Self = Self::line("#00b0ff", 0.8, &[3.0, 2.0]);
    pub const NODES: Self = Self::line("#b2ff59", 6.0, &[]);
    pub const AXIS: Self = Self::line("#ff1744", 2.0, &[]);
    pub const CHANGE: Self = Self::line("#ffffff", 1.2, &[]);
    pub const GAINED: Self = Self { fill: 0.5, ..Self::line("#00e676", 0.6, &[]) };
    pub const LOST: Self = Self { fill: 0.5, ..Self::line("#ff1744", 0.6, &[]) };

    const fn line(color: &'static str, width: f64, dashes: &'static [f64]) -> Self {
        Self { color, width, dashes, fill: 0.0 }
    }
}

impl Overlay {
    /// What lies in a rectangle of the plane: the pixels that it meets, and the lines whose boxes these meet, which are
    /// cut off where the pixels end when they are drawn.
    ///
    /// `None` if no pixel does.
    #[must_use]
    pub fn within(mut self, window: Rect) -> Option<Self> {
        let Grid { columns, rows, .. } = self.grid;
        let [a, b] = [window.min, window.max].map(|corner| self.grid.locate(corner));
        let span = |k: usize, n: u32| {
            let low = a[k].min(b[k]).floor().clamp(0.0, f64::from(n)) as u32;
            let high = a[k].max(b[k]).ceil().clamp(0.0, f64::from(n)) as u32;
            (low, high)
        };
        let ((left, right), (top, bottom)) = (span(0, columns), span(1, rows));
        if left >= right || top >= bottom {
            return None;
        }
        let row = |y: u32| {
            let start = y as usize * columns as usize;
            self.colours[start + left as usize..start + right as usize].iter().copied()
        };
        self.colours = (top..bottom).flat_map(row).collect();
        let origin = self.grid.corner(left, top);
        self.grid = Grid { origin, columns: right - left, rows: bottom - top, ..self.grid };
        let end = self.grid.corner(self.grid.columns, self.grid.rows);
        let seen = Rect::EMPTY.with(origin).with(end);
        let is_seen = |line: &Vec<Point>| {
            let around = line.iter().copied().fold(Rect::EMPTY, Rect::with);
            around.min.x <= seen.max.x
                && seen.min.x <= around.max.x
                && around.min.y <= seen.max.y
                && seen.min.y <= around.max.y
        };
        self.layers.iter_mut().for_each(|layer| layer.lines.retain(is_seen));
        Some(self)
    }

    /// The frame of the picture.
    fn frame(&self, options: &Options) -> Frame {
        let Grid { columns, rows, .. } = self.grid;
        let corners = [self.grid.corner(0, 0), self.grid.corner(columns, rows)];
        Frame::over(corners.into_iter(), 1, options)
    }

    /// The pixels of the drawing, margins and legend among them, `scale` of which are one of the frame, in the plane.
    pub(crate) fn drawing(&self, options: &Options, scale: f64) -> Grid {
        let frame = self.frame(options);
        let [columns, rows] = [frame.size.x, frame.size.y].map(|side| (scale * side).ceil() as u32);
        let origin = frame.unmap(Point::new(0.0, 0.0));
        let step = 1.0 / frame.length(scale);
        Grid { origin, cell: [step, -step], columns, rows }
    }

    /// For pixels of the drawing, `scale` of which are one of the frame, the size of the drawing and the colour of each
    /// where the picture is; else nothing.
    pub(crate) fn painted(
        &self,
        options: &Options,
        scale: f64,
    ) -> (u32, u32, impl Fn(u32, u32) -> Option<[f32; 3]>) {
        let frame = self.frame(options);
        let [width, height] = [frame.size.x, frame.size.y].map(|side| (scale * side).ceil() as u32);
        let Grid { columns, rows, .. } = self.grid;
        let [a, b] = [(0, 0), (columns, rows)].map(|(x, y)| frame.map(self.grid.corner(x, y)));
        let cell = [(b.x - a.x) / f64::from(columns), (b.y - a.y) / f64::from(rows)];
        let colour = move |x: u32, y: u32| {
            let at = [x, y].map(|k| (f64::from(k) + 0.5) / scale);
            let column = ((at[0] - a.x) / cell[0]).floor();
            let row = ((at[1] - a.y) / cell[1]).floor();
            let is_there = (0.0..f64::from(columns)).contains(&column)
                && (0.0..f64::from(rows)).contains(&row);
            let pixel = is_there.then(|| row as usize * columns as usize + column as usize)?;
            let colour = self.colours[pixel];
            (!colour[0].is_nan()).then_some(colour)
        };
        (width, height, colour)
    }
}

/// The picture with its layers; each is a group with its name as class.
#[must_use]
pub fn write_overlay(overlay: &Overlay, options: &Options) -> String {
    drawn(overlay, options, true)
}

/// The same, or the layers alone on no ground.
pub(crate) fn drawn(overlay: &Overlay, options: &Options, has_picture: bool) -> String {
    let frame = overlay.frame(options);
    let mut canvas = Canvas::new(frame, options.lettering);
    let Grid { columns, rows, .. } = overlay.grid;
    let [a, b] = [(0, 0), (columns, rows)].map(|(x, y)| frame.map(overlay.grid.corner(x, y)));
    if has_picture && overlay.is_georeferenced {
        canvas.metadata(&georeference(&frame, overlay.crs.as_ref()));
    }
    if has_picture {
        let bytes = image::write_colours(columns, rows, &overlay.colours);
        let [sx, sy] = [(b.x - a.x) / f64::from(columns), (b.y - a.y) / f64::from(rows)];
        canvas.image(&BASE64_STANDARD.encode(bytes), [columns, rows], [sx, sy], a);
    }
    let (low, high) =
        (Point::new(a.x.min(b.x), a.y.min(b.y)), Point::new(a.x.max(b.x), a.y.max(b.y)));
    canvas.clip(low, high - low);
    for layer in &overlay.layers {
        let LineStyle { color, width, dashes, fill } = layer.style;
        let mut data = Data::new(&frame);
        for line in &layer.lines {
            match line[..] {
                [] => {}
                [p] => data.dot(p),
                _ if layer.are_rings => data.ring(line.iter().copied()),
                [first, ..] => {
                    data.move_to(first);
                    line[1..].iter().for_each(|&p| data.line_to(p));
                }
            }
        }
        let data = data.text;
        let filling = match fill {
            0.0 => "fill=\"none\"".to_owned(),
            fill => {
                format!("fill=\"{color}\" fill-opacity=\"{}\" fill-rule=\"evenodd\"", number(fill))
            }
        };
        canvas.open(layer.name, &format!("{filling} {}", stroke(color, width, dashes)));
        canvas.path(&data, "");
        canvas.close();
    }
    canvas.close();
    legend::title(&mut canvas, options);
    if options.legend {
        let (left, _) = canvas.frame.margins();
        let y = canvas.frame.legend_y + 10.0;
        canvas.open("legend", "fill=\"none\"");
        let mut x = left;
        for OverlayLayer { name, style, .. } in &overlay.layers {
            let LineStyle { color, width, dashes, .. } = *style;
            // What is light on a picture needs a dark ground in the legend.
            let box_at = Point::new(x, y - 11.0);
            canvas.rectangle(box_at, Point::new(30.0, 14.0), "fill=\"#607d8b\"");
            let line = format!("M{} {}h26", number(x + 2.0), number(y - 4.0));
            canvas.path(&line, &stroke(color, width, dashes));
            canvas.text(Point::new(x + 36.0, y), 12.0, Anchor::Start, INK, name);
            x += 36.0 + canvas.text_width(name, 12.0) + 24.0;
        }
        canvas.close();
    }
    match has_picture {
        true => canvas.finish(&escaped(&options.title)),
        false => canvas.finish_clear(&escaped(&options.title)),
    }
}

/// What SVG 1.1 has for maps, in section 7.12: the reference system, and how its coordinates became those of the picture.
fn georeference(frame: &Frame, crs: Option<&Crs>) -> String {
    let matrix = frame.matrix().map(|number| number.to_string()).join(" ");
    let authority = crs.and_then(Crs::authority);
    let resource = authority.map_or_else(String::new, |(authority, code)| {
        let [authority, code] = [authority, code].map(escaped);
        format!(" rdf:resource=\"http://www.opengis.net/def/crs/{authority}/0/{code}\"")
    });
    format!(
        "<rdf:RDF xmlns:rdf=\"http://www.w3.org/1999/02/22-rdf-syntax-ns#\" \
         xmlns:crs=\"http://www.ogc.org/crs\" xmlns:svg=\"http://www.w3.org/2000/svg\">\n\
         <rdf:Description rdf:about=\"\">\n\
         <crs:CoordinateReferenceSystem{resource} svg:transform=\"matrix({matrix})\"/>\n\
         </rdf:Description>\n</rdf:RDF>"
    )
}

fn stroke(color: &str, width: f64, dashes: &[f64]) -> String {
    let gaps: Vec<String> = dashes.iter().map(|&length| number(length)).collect();
    let gaps = match gaps[..] {
        [] => String::new(),
        _ => format!(" stroke-dasharray=\"{}\"", gaps.join(" ")),
    };
    let width = number(width);
    format!(
        "stroke=\"{color}\" stroke-width=\"{width}\" stroke-linecap=\"round\" \
         stroke-linejoin=\"round\"{gaps}"
    )
}

/// Options of an overlay that is painted: letters need no font.
pub(crate) fn painted_options(options: &Options) -> Options {
    Options { lettering: Lettering::Strokes, ..options.clone() }
}

#[cfg(test)]
mod tests {
    use super::*;

    const RED: LineStyle = LineStyle { color: "#f00", width: 2.0, dashes: &[4.0, 2.0], fill: 0.0 };

    /// Two pixels, red and without data, with a line along the middle of both.
    fn overlay() -> Overlay {
        let grid = Grid { origin: Point::new(10.0, 5.0), ..Grid::of_image(2, 1) };
        let lines = vec![vec![Point::new(10.0, 4.5), Point::new(12.0, 4.5)]];
        let layer = OverlayLayer { name: "axis", style: RED, lines, are_rings: false };
        let colours = vec![[1.0, 0.0, 0.0], [f32::NAN; 3]];
        Overlay { grid, colours, layers: vec![layer], is_georeferenced: false, crs: None }
    }

    #[test]
    fn a_place_is_told_in_metadata() {
        let bare = write_overlay(&overlay(), &Options::default());
        assert!(!bare.contains("<metadata>"), "{bare}");
        let crs = Some(Crs::epsg(32632));
        let placed = Overlay { is_georeferenced: true, crs, ..overlay() };
        let picture = write_overlay(&placed, &Options::default());
        // 500 pixels a unit; (10, 5) is at (28, 28).
        let told = "rdf:resource=\"http://www.opengis.net/def/crs/EPSG/0/32632\" \
                    svg:transform=\"matrix(500 0 0 -500 -4972 2528)\"";
        assert!(picture.contains(told), "{picture}");
        let picture = write_overlay(&Overlay { crs: None, ..placed }, &Options::default());
        assert!(picture.contains("<crs:CoordinateReferenceSystem svg:transform="), "{picture}");
    }

    #[test]
    fn the_drawing_has_margins_in_the_plane() {
        let options = Options { legend: false, ..Options::default() };
        let Grid { origin, cell, columns, rows } = overlay().drawing(&options, 2.0);
        assert_eq!((columns, rows), (2112, 1112));
        // 1000 pixels a unit, and 56 around.
        let is_near = |a: f64, b: f64| (a - b).abs() < 1e-12;
        assert!(is_near(cell[0], 1e-3) && is_near(cell[1], -1e-3), "{cell:?}");
        assert!(is_near(origin.x, 10.0 - 0.056) && is_near(origin.y, 5.056), "{origin:?}");
    }

    #[test]
    fn the_picture_lies_under_the_lines() {
        let picture = write_overlay(&overlay(), &Options::default());
        // 1000 pixels for 2, with a margin of 28.
        let image = "transform=\"matrix(500 0 0 500 28 28)\"";
        let line = "<path d=\"M28 278L1028 278\"/>";
        assert!(picture.contains(image) && picture.contains(line), "{picture}");
        assert!(picture.find(image) < picture.find(line));
        assert!(picture.contains("stroke-dasharray=\"4 2\"") && picture.contains(">axis</text>"));
    }

    #[test]
    fn a_window_shows_the_pixels_that_it_meets() {
        let window = Rect { min: Point::new(9.0, 4.2), max: Point::new(10.5, 4.6) };
        let part = overlay().within(window).unwrap();
        assert_eq!((part.grid.columns, part.grid.origin), (1, Point::new(10.0, 5.0)));
        assert_eq!(part.colours, [[1.0, 0.0, 0.0]]);
        assert_eq!(part.layers[0].lines.len(), 1);
        let mut other = overlay();
        other.layers[0].lines.push(vec![Point::new(11.5, 4.5), Point::new(12.0, 4.5)]);
        assert_eq!(other.within(window).unwrap().layers[0].lines, part.layers[0].lines);
        let beside = Rect { min: Point::new(0.0, 0.0), max: Point::new(1.0, 1.0) };
        assert!(overlay().within(beside).is_none());
    }

    #[test]
    fn painted_pixels_are_those_of_the_picture() {
        let overlay = overlay();
        let options = Options { legend: false, ..Options::default() };
        let (width, height, colour) = overlay.painted(&options, 2.0);
        assert_eq!((width, height), (2112, 1112));
        assert_eq!(colour(56, 56), Some([1.0, 0.0, 0.0]));
        assert_eq!((colour(55, 56), colour(1056, 56)), (None, None));
    }
}
