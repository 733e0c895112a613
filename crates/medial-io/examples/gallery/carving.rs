use crate::lesson::Lesson;
use crate::shape::{Fallible, Shape};
use crate::sheet::{Panel, Sample, Sheet};
use crate::style::FINE;
use medial::axis::SiteKind;
use medial::geom::Point;
use medial::ops::{CarveOptions, Carving, Clearing, Move, Role, Voronoi, carve};

pub const LESSON: Lesson = Lesson {
    title: "A carved glyph and a carved logo",
    text: "On the left what a V-bit cuts, lit from the upper left: a facet for each edge of the outline, and a piece \
           of a cone around each reflex corner. On the right the way of its point, as deep everywhere as the \
           boundary is away; thin where the bit goes from one pass to the next above the material.\n\
           Above `medial carve glyph.wkt --angle 60 --leave 3`: what reaches less than 3 units out of all else, the \
           corners of the drawn curves, is left. Below `medial carve logo.wkt --angle 60 --depth 6 --leave 0.1 \
           --clear 1,1`: the floor is flat at that depth, and a small tool clears it in rounds.",
    draw,
};

/// How far what is drawn may be from the curves, as a share of the shape.
const FINE_CURVES: f64 = 1e-3;

const ROUND: &str = "fill=\"none\" stroke=\"#90a4ae\" stroke-width=\"0.7\"";
const WALL: &str = "fill=\"none\" stroke=\"#00897b\" stroke-width=\"1.2\"";
const VALLEY: &str =
    "fill=\"none\" stroke=\"#8e24aa\" stroke-width=\"1.2\" stroke-linecap=\"round\"";
const LIFT: &str = "fill=\"none\" stroke=\"#607d8b\" stroke-width=\"0.6\" stroke-dasharray=\"3 3\"";
const FLOOR: &str = "fill=\"#d6ab80\"";

/// The light, from the upper left.
const LIGHT: [f64; 3] = [-0.5, 0.62, 0.6];
/// Wood in the dark and in the light.
const WOOD: [[f64; 3]; 2] = [[74.0, 44.0, 28.0], [255.0, 231.0, 200.0]];

fn draw() -> Fallible<String> {
    let glyph = Shape::fixture("glyph.wkt")?;
    let logo = Shape::fixture("logo.wkt")?;
    let mut sheet = Sheet::new(2, (440.0, 440.0));
    let options = CarveOptions { leave: Some(3.0), ..CarveOptions::with_angle(60.0) };
    both(&mut sheet, &glyph, &options, 40.0)?;
    let clearing = Some(Clearing { radius: 1.0, step: 1.0 });
    let options = CarveOptions {
        depth: Some(6.0),
        leave: Some(0.1),
        clearing,
        ..CarveOptions::with_angle(60.0)
    };
    both(&mut sheet, &logo, &options, 2.0)?;
    sheet.legend(&[
        (Sample::Line(VALLEY), "along the axis"),
        (Sample::Line(WALL), "along the wall of the floor"),
        (Sample::Line(ROUND), "over the floor"),
        (Sample::Line(LIFT), "above the material"),
    ]);
    Ok(sheet.finish(LESSON.title))
}

/// The relief of a shape, and its tool path.
fn both(sheet: &mut Sheet, shape: &Shape, options: &CarveOptions, margin: f64) -> Fallible<()> {
    let carving = carve(&shape.domain, &shape.axis, options)?;
    let window = shape.window(margin);
    let mut panel = sheet.panel(window, "relief");
    relief(&mut panel, shape, &carving)?;
    let n = carving.passes.len();
    let mut panel = sheet.panel(window, &format!("tool path of {n} passes"));
    panel.domain(&shape.domain);
    path(&mut panel, shape, &carving);
    Ok(())
}

fn relief(panel: &mut Panel<'_>, shape: &Shape, carving: &Carving) -> Fallible<()> {
    let tolerance = FINE_CURVES * shape.axis.radius_max();
    let voronoi = Voronoi::new(&shape.domain, std::slice::from_ref(&shape.axis))?;
    for cell in voronoi.cells() {
        let site = voronoi.sites()[cell.site as usize];
        let ring = voronoi.ring(&cell, tolerance);
        match site.kind {
            SiteKind::Edge => panel.area(&ring, &facet((site.b - site.a).perp(), carving.slope)),
            SiteKind::Vertex => {
                for pair in ring.windows(2) {
                    cone(panel, site.a, [pair[0], pair[1]], carving.slope);
                }
            }
        }
    }
    for polygon in carving.floor.polygons(tolerance) {
        panel.rings(&polygon, FLOOR);
    }
    panel.walks(&shape.domain, FINE, |_| true);
    Ok(())
}

/// A part of a cone around a corner, in slices.
fn cone(panel: &mut Panel<'_>, corner: Point, [from, to]: [Point; 2], slope: f64) {
    const SLICES: u32 = 6;
    if from == corner || to == corner {
        return;
    }
    for k in 0..SLICES {
        let [p, q] = [k, k + 1].map(|k| from + (to - from) * (f64::from(k) / f64::from(SLICES)));
        panel.area(&[corner, p, q], &facet((p + q) * 0.5 - corner, slope));
    }
}

/// The style of a slope that falls in a direction.
fn facet(way: Point, slope: f64) -> String {
    let way = way * (1.0 / way.norm());
    let length = (1.0 + slope * slope).sqrt();
    let [x, y, z] = [slope * way.x / length, slope * way.y / length, 1.0 / length];
    let bright = (x * LIGHT[0] + y * LIGHT[1] + z * LIGHT[2]).max(0.0);
    let size = LIGHT.iter().map(|v| v * v).sum::<f64>().sqrt();
    let share = 0.25 + 0.75 * bright / size;
    let [r, g, b] =
        [0, 1, 2].map(|k| (WOOD[0][k] + (WOOD[1][k] - WOOD[0][k]) * share).round() as u8);
    let color = format!("#{r:02x}{g:02x}{b:02x}");
    // A stroke, so that no seam shows.
    format!("fill=\"{color}\" stroke=\"{color}\" stroke-width=\"0.5\"")
}

fn path(panel: &mut Panel<'_>, shape: &Shape, carving: &Carving) {
    let tolerance = FINE_CURVES * shape.axis.radius_max();
    let mut last: Option<Point> = None;
    for pass in &carving.passes {
        let steps: Vec<(Role, Move)> = carving.steps(pass).collect();
        let (Some(first), Some(end)) = (steps.first(), steps.last()) else { continue };
        if let Some(from) = last {
            panel.line(from, first.1.from().point, LIFT);
        }
        last = Some(end.1.to().point);
        for (role, cut) in &steps {
            let style = match role {
                Role::Valley => VALLEY,
                Role::Wall => WALL,
                Role::Floor => ROUND,
            };
            let points: Vec<Point> =
                cut.polyline(tolerance).into_iter().map(|tip| tip.point).collect();
            panel.polyline(&points, style);
        }
    }
}
