//! Pictures of Voronoi diagrams: cells in quiet colours, paths, and normals.

use super::Options;
use super::canvas::{Anchor, Canvas, Data, number};
use super::frame::Frame;
use super::layers::{self, INK};
use super::legend::{self, QUIET, plural};
use super::palette::pale;
use crate::text::escaped;
use medial::axis::{Curve, SiteKind};
use medial::geom::Point;
use medial::ops::{EdgeKind, Voronoi};

/// What a picture needs of a diagram.
#[derive(Clone, Debug)]
pub struct Diagram {
    boundary: Vec<Vec<Point>>,
    /// The closed outline of each cell, and the number of its site.
    cells: Vec<(u32, Vec<Curve>)>,
    paths: Vec<Curve>,
    normals: Vec<Curve>,
    /// Corners with a cell.
    corners: Vec<Point>,
}

impl Diagram {
    /// The picture of a diagram.
    #[must_use]
    pub fn new(voronoi: &Voronoi) -> Self {
        let domain = voronoi.domain();
        let ring = |walk: &medial::domain::Walk| {
            walk.edges().map(|edge| domain.edge(edge).start).collect()
        };
        let curves = |kind| {
            let edges = voronoi.edges().iter().filter(move |edge| edge.kind == kind);
            edges.map(|edge| voronoi.curve(edge)).collect()
        };
        let corners = voronoi.sites().iter().filter(|site| site.kind == SiteKind::Vertex);
        Self {
            boundary: domain.walks().iter().map(ring).collect(),
            cells: voronoi.cells().map(|cell| (cell.site, voronoi.outline(&cell))).collect(),
            paths: curves(EdgeKind::Path),
            normals: curves(EdgeKind::Normal),
            corners: corners.map(|site| site.a).collect(),
        }
    }
}

/// The colour of paths.
const PATH: &str = "#5e35b1";
/// The colour of normals.
const NORMAL: &str = "#78909c";
/// Dashes of normals, in strokes.
const DASHES: [f64; 2] = [3.0, 2.0];

/// The picture of some diagrams in one frame: curves are exact quadratic Béziers.
#[must_use]
pub fn write_diagrams(diagrams: &[Diagram], options: &Options) -> String {
    let boundary = diagrams.iter().flat_map(|d| d.boundary.iter().flatten()).copied();
    let outlines = diagrams.iter().flat_map(|d| &d.cells).flat_map(|(_, outline)| outline);
    let corners = boundary.chain(outlines.map(Curve::from));
    let n = diagrams.iter().map(|d| d.paths.len() + d.normals.len()).sum();
    let mut canvas = Canvas::new(Frame::over(corners, n, options), options.lettering);
    cells(&mut canvas, diagrams);
    let unit = canvas.frame.stroke;
    let dashes = DASHES.map(|dash| number(dash * unit)).join(" ");
    let dashed = format!("stroke=\"{NORMAL}\" stroke-dasharray=\"{dashes}\"");
    lines(&mut canvas, "normals", &dashed, 0.6 * unit, diagrams.iter().flat_map(|d| &d.normals));
    let plain = format!("stroke=\"{PATH}\"");
    lines(&mut canvas, "paths", &plain, 0.8 * unit, diagrams.iter().flat_map(|d| &d.paths));
    layers::boundary(&mut canvas, diagrams.iter().map(|d| &d.boundary));
    dots(&mut canvas, diagrams);
    legend::title(&mut canvas, options);
    if options.legend {
        counts(&mut canvas, diagrams, &dashed);
    }
    canvas.finish(&escaped(&options.title))
}

fn cells(canvas: &mut Canvas, diagrams: &[Diagram]) {
    let frame = canvas.frame;
    // A thin rim of its own colour, so that no ground shows between neighbours.
    canvas.open("cells", "stroke-width=\"0.5\" stroke-linejoin=\"round\"");
    let mut before = 0;
    for diagram in diagrams {
        for (site, outline) in &diagram.cells {
            let mut data = Data::new(&frame);
            if let Some(first) = outline.first() {
                data.move_to(first.from());
            }
            outline.iter().for_each(|curve| data.curve_to(curve));
            data.text.push('Z');
            let color = pale(before + *site as usize);
            canvas.path(&data.text, &format!("fill=\"{color}\" stroke=\"{color}\""));
        }
        before += diagram.cells.len();
    }
    canvas.close();
}

fn lines<'d>(
    canvas: &mut Canvas,
    class: &str,
    style: &str,
    width: f64,
    curves: impl Iterator<Item = &'d Curve>,
) {
    let mut data = Data::new(&canvas.frame);
    for curve in curves {
        data.move_to(curve.from());
        data.curve_to(curve);
    }
    let style = format!(
        "fill=\"none\" {style} stroke-width=\"{}\" stroke-linecap=\"round\"",
        number(width)
    );
    let data = data.text;
    canvas.open(class, &style);
    canvas.path(&data, "");
    canvas.close();
}

/// The corners with a cell.
fn dots(canvas: &mut Canvas, diagrams: &[Diagram]) {
    let mut data = Data::new(&canvas.frame);
    diagrams.iter().flat_map(|d| &d.corners).for_each(|&corner| data.dot(corner));
    let (data, width) = (data.text, number(2.0 * canvas.frame.stroke));
    canvas.open("corners", &format!("fill=\"none\" stroke=\"{INK}\" stroke-linecap=\"round\""));
    canvas.path(&data, &format!("stroke-width=\"{width}\""));
    canvas.close();
}

/// How many cells, paths and normals there are, the lines with a sample each.
fn counts(canvas: &mut Canvas, diagrams: &[Diagram], dashed: &str) {
    let total = |count: fn(&Diagram) -> usize| diagrams.iter().map(count).sum::<usize>();
    let (left, _) = canvas.frame.margins();
    let mut at = Point::new(left, canvas.frame.legend_y + 10.0);
    canvas.open("legend", "");
    let samples = [
        (plural(total(|d| d.paths.len()), "path"), format!("stroke=\"{PATH}\"")),
        (plural(total(|d| d.normals.len()), "normal"), dashed.to_owned()),
    ];
    for (label, style) in samples {
        let data = format!("M{} {}h26", number(at.x), number(at.y - 4.2));
        canvas.path(&data, &format!("fill=\"none\" {style} stroke-width=\"2\""));
        canvas.text(at + Point::new(34.0, 0.0), 12.0, Anchor::Start, INK, &label);
        at.x += 34.0 + canvas.text_width(&label, 12.0) + 28.0;
    }
    let label = plural(total(|d| d.cells.len()), "cell");
    canvas.text(at, 12.0, Anchor::Start, QUIET, &label);
    canvas.close();
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples;

    fn picture(rings: &[Vec<Point>]) -> String {
        let diagram = samples::with_voronoi(rings, Diagram::new);
        write_diagrams(&[diagram], &Options { title: "A & B".to_owned(), ..Options::default() })
    }

    #[test]
    fn cells_are_closed_and_curved_exactly() {
        let picture = picture(&samples::l_rings());
        let start = picture.find("<g class=\"cells\"").unwrap();
        let cells = &picture[start..start + picture[start..].find("</g>").unwrap()];
        assert_eq!((cells.matches("<path").count(), cells.matches('Z').count()), (7, 7));
        // Two parabolas, each around two cells.
        assert_eq!(cells.matches('Q').count(), 4);
    }

    #[test]
    fn the_legend_counts() {
        let picture = picture(&samples::l_rings());
        for text in [">9 paths<", ">2 normals<", ">7 cells<", "<title>A &amp; B</title>"] {
            assert!(picture.contains(text), "{text}");
        }
    }
}
