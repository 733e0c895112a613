use crate::lee;
use crate::lesson::Lesson;
use crate::shape::Fallible;
use crate::sheet::{Sample, Sheet};
use crate::style::{AXIS, CORNER_CELL, EDGE_CELL, MUTED, NORMAL};
use medial::axis::SiteKind;
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

fn draw() -> Fallible<String> {
    let shape = lee::shape(3)?;
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
    let edges: Vec<u32> = (0..).take(shape.domain.edges().len()).collect();
    lee::numbers(&mut panel, &shape.domain, &edges, 1, MUTED);
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
