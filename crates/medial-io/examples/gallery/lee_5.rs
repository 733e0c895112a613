use crate::lee;
use crate::lesson::Lesson;
use crate::shape::Fallible;
use crate::sheet::{Sample, Sheet};
use crate::style::{AXIS, BLUE, DISK, EDGE_CELL, ORANGE, PURPLE, SPOKE, TEAL};
use medial::axis::SiteKind;
use medial::geom::Point;
use medial::ops::{EdgeKind, Voronoi};

pub const LESSON: Lesson = Lesson {
    title: "Cells and disks",
    text: "Figure 5 of [Lee82], for two lemmas.\n\
           With each point z of a cell all of the way to its image t, the point of the element that is \
           nearest to z, lies in the cell (a).\n\
           Two cells share an edge where a disk touches both of their elements and holds no point of the \
           boundary (b); there is one around each point of that edge.",
    draw,
};

/// The elements of (a) and of (b), by their numbers in the diagram of figure 3.
const CELL: usize = 14;
const PAIR: [usize; 2] = [9, 17];

fn draw() -> Fallible<String> {
    let shape = lee::shape(3)?;
    let voronoi = Voronoi::new(&shape.domain, std::slice::from_ref(&shape.axis))?;
    let mut sheet = Sheet::new(2, (500.0, 400.0));
    let site = |number: usize| voronoi.sites()[number - 1];

    let own = site(CELL);
    let cell = voronoi.cells().nth(CELL - 1).ok_or("no such cell")?;
    let mut panel = sheet.panel((Point::new(3.4, -0.3), Point::new(12.2, 6.7)), "a");
    panel.clipped(|panel| {
        panel.domain(&shape.domain);
        panel.outline(&voronoi.outline(&cell), EDGE_CELL);
        for edge in voronoi.edges().iter().filter(|edge| edge.kind != EdgeKind::Normal) {
            panel.curve(&voronoi.curve(edge), AXIS);
        }
        panel.site(&own, BLUE);
    });
    for &edge in cell.edges {
        let curve = voronoi.curve(&voronoi.edges()[edge as usize]);
        for u in [0.25, 0.75] {
            panel.spokes(curve.point_at(u), &[own]);
        }
    }
    if let Some(&edge) = cell.edges.get(cell.edges.len() / 2) {
        let z = voronoi.curve(&voronoi.edges()[edge as usize]).point_at(0.25);
        panel.point(z, PURPLE);
        panel.label(z, (-8.0, 10.0), PURPLE, "z");
        panel.label(own.footpoint(z), (10.0, 0.0), TEAL, "t");
    }
    panel.label(own.a * 0.8 + own.b * 0.2, (12.0, 4.0), BLUE, "e_i");

    let [i, j] = PAIR.map(|number| number as u32 - 1);
    let between = voronoi.edges().iter().find(|edge| {
        (edge.left, edge.right) == (i, Some(j)) || (edge.left, edge.right) == (j, Some(i))
    });
    let curve = voronoi.curve(between.ok_or("these two cells share no edge")?);
    let (z, radius) = (curve.point_at(0.5), curve.radius_at(0.5));
    let mut panel = sheet.panel(shape.window(0.4), "b");
    panel.domain(&shape.domain);
    panel.axis(&shape.axis);
    panel.disk(z, radius, DISK);
    for (number, name, shift) in [(PAIR[0], "e_i", (0.0, -15.0)), (PAIR[1], "e_j", (0.0, 16.0))] {
        let site = site(number);
        let color = if site.kind == SiteKind::Edge { BLUE } else { ORANGE };
        panel.site(&site, color);
        panel.label((site.a + site.b) * 0.5, shift, color, name);
    }
    panel.spokes(z, &PAIR.map(site));
    panel.point(z, PURPLE);
    panel.label(z, (9.0, 3.0), PURPLE, "z");
    sheet.legend(&[
        (Sample::Area(EDGE_CELL), "cell"),
        (Sample::Line(SPOKE), "way to the image"),
        (Sample::Line(AXIS), "axis"),
        (Sample::Disk(DISK), "disk"),
    ]);
    Ok(sheet.finish(LESSON.title))
}
