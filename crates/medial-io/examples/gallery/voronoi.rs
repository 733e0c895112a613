use crate::lesson::Lesson;
use crate::shape::{Fallible, Shape};
use crate::sheet::{Sample, Sheet};
use crate::style::{AXIS, CORNER_CELL, EDGE_CELL, MUTED, NORMAL};
use medial::axis::SiteKind;
use medial::geom::Point;
use medial::ops::{EdgeKind, Voronoi};

pub const LESSON: Lesson = Lesson {
    title: "The Voronoi diagram of the boundary",
    text: "Figures 3 and 4 of [Lee82], for a polygon of the same kind: 15 edges and 6 reflex corners, \
           numbered along the boundary.\n\
           Each of the 21 elements has a cell, the points nearer to it than to anything else (a).\n\
           Without the two normals at each reflex corner the edges between the cells are the medial \
           axis (b).",
    draw,
};

/// 15 edges, nine of them in three chains with reflex corners between them.
pub const RING: [(f64, f64); 15] = [
    (0.5, 6.),
    (0., 0.8),
    (2.2, 0.),
    (3.2, 2.2),
    (4.6, 3.2),
    (6.4, 3.3),
    (7.9, 2.3),
    (8.6, 0.2),
    (10.6, 0.4),
    (11.2, 3.),
    (10.2, 5.2),
    (8.4, 6.2),
    (7.2, 5.2),
    (5.2, 6.4),
    (3.2, 5.),
];

fn draw() -> Fallible<String> {
    let shape = Shape::new(&RING)?;
    let voronoi = Voronoi::new(&shape.domain, std::slice::from_ref(&shape.axis))?;
    let mut sheet = Sheet::new(2, (560.0, 370.0));
    let mut panel = sheet.panel(shape.window(0.6), "a");
    panel.domain(&shape.domain);
    for cell in voronoi.cells() {
        let style = match voronoi.sites()[cell.site as usize].kind {
            SiteKind::Edge => EDGE_CELL,
            SiteKind::Vertex => CORNER_CELL,
        };
        panel.outline(&voronoi.outline(&cell), style);
    }
    for edge in voronoi.edges() {
        let style = if edge.kind == EdgeKind::Normal { NORMAL } else { AXIS };
        panel.curve(&voronoi.curve(edge), style);
    }
    for (number, site) in (1..).zip(voronoi.sites()) {
        let (at, out) = match site.kind {
            SiteKind::Edge => {
                let d = site.b - site.a;
                ((site.a + site.b) * 0.5, -d.perp() * (1.0 / d.norm()))
            }
            SiteKind::Vertex => (site.a, outwards(&shape, site.a)),
        };
        panel.small(at, (13.0 * out.x, 13.0 * out.y), MUTED, &number.to_string());
    }
    let mut panel = sheet.panel(shape.window(0.6), "b");
    panel.domain(&shape.domain);
    panel.axis(&shape.axis);
    sheet.legend(&[
        (Sample::Area(EDGE_CELL), "cell of an edge"),
        (Sample::Area(CORNER_CELL), "cell of a reflex corner"),
        (Sample::Line(AXIS), "axis"),
        (Sample::Line(NORMAL), "normals"),
    ]);
    Ok(sheet.finish(LESSON.title))
}

/// The way out of the domain between the two edges at a reflex corner.
fn outwards(shape: &Shape, corner: Point) -> Point {
    let starts = |&edge: &u32| shape.domain.edge(edge).start == corner;
    let edge = (0..shape.domain.edges().len() as u32).find(starts).unwrap_or_default();
    let before = shape.domain.edge(edge).prev;
    let way = -(shape.normal(edge) + shape.normal(before));
    way * (1.0 / way.norm())
}
