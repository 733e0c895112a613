use crate::lesson::Lesson;
use crate::shape::{Fallible, Shape, half_line};
use crate::sheet::{Panel, Sample, Sheet};
use crate::style::{
    AXIS, BLUE, CORNER_CELL, CORNER_REGION, EDGE_CELL, EDGE_REGION, ORANGE, SUPPORT,
};
use medial::domain::Site;
use medial::geom::Point;

pub const LESSON: Lesson = Lesson {
    title: "Influence regions",
    text: "A governor shapes the axis only within its influence region: the part of the plane between \
           the two half-lines that start at its ends.\n\
           At a reflex corner the half-line is the normal of the edge, at a convex corner the bisector \
           of the angle.\n\
           Inside its region each governor has its cell, the points nearer to it than to anything else.",
    draw,
};

fn draw() -> Fallible<String> {
    let shape = Shape::new(&[
        (0., 0.),
        (12., 0.),
        (12., 4.4),
        (8.6, 4.8),
        (7.4, 3.2),
        (5.2, 3.6),
        (5., 6.6),
        (0.4, 6.2),
    ])?;
    let mut sheet = Sheet::new(1, (820.0, 500.0));
    let mut panel = sheet.panel(shape.window(0.4), "");
    panel.domain(&shape.domain);
    // The right wall, between convex corners; the ceiling, between reflex ones; and one of those.
    let (wall, ceiling, corner) = (Site::edge(1), Site::edge(4), Site::corner(5));
    for site in [wall, ceiling, corner] {
        region(&shape, &mut panel, site)?;
    }
    for path in shape.axis.paths() {
        for governor in shape.axis.path_governors(&path) {
            for (site, style) in [(wall, EDGE_CELL), (ceiling, EDGE_CELL), (corner, CORNER_CELL)] {
                let chosen = shape.site(site);
                if (governor.a, governor.b) == (chosen.a, chosen.b) {
                    panel.cell(&shape.axis.curve(&path), &governor, style);
                }
            }
        }
    }
    panel.axis(&shape.axis);
    for (site, color) in [(wall, BLUE), (ceiling, BLUE), (corner, ORANGE)] {
        panel.site(&shape.site(site), color);
    }
    panel.label(Point::new(12.0, 2.2), (-12.0, 0.0), BLUE, "e_1");
    panel.label(Point::new(6.3, 3.4), (0.0, 18.0), BLUE, "e_2");
    panel.label(Point::new(5.2, 3.6), (12.0, 22.0), ORANGE, "v");
    sheet.legend(&[
        (Sample::Line(AXIS), "axis"),
        (Sample::Area(EDGE_REGION), "region of an edge"),
        (Sample::Area(EDGE_CELL), "its cell"),
        (Sample::Area(CORNER_REGION), "region of a corner"),
        (Sample::Area(CORNER_CELL), "its cell"),
        (Sample::Line(SUPPORT), "half-lines"),
    ]);
    Ok(sheet.finish(LESSON.title))
}

/// A site's influence region, between its two half-lines.
fn region(shape: &Shape, panel: &mut Panel, site: Site) -> Fallible<()> {
    const FAR: f64 = 1e3;
    let edge = shape.domain.edge(site.index());
    let (a, b, back, front, style) = if site.is_edge() {
        let end = shape.domain.end(site.index());
        let back = half_line(shape, site.index(), shape.normal(site.index()))?;
        let front = half_line(shape, edge.next, shape.normal(site.index()))?;
        (edge.start, end, back, front, EDGE_REGION)
    } else {
        let (back, front) = (shape.normal(edge.prev), shape.normal(site.index()));
        (edge.start, edge.start, back, front, CORNER_REGION)
    };
    // Where the half-lines of an edge meet, its region is a triangle.
    let turn = back.cross(front);
    let meet = (b - a).cross(front) / turn;
    if site.is_edge() && turn > 0.0 {
        let tip = a + back * meet;
        panel.area(&[a, b, tip], style);
        panel.line(a, tip, SUPPORT);
        panel.line(b, tip, SUPPORT);
    } else {
        panel.area(&[a, b, b + front * FAR, a + back * FAR], style);
        panel.ray(a, back, SUPPORT);
        panel.ray(b, front, SUPPORT);
    }
    Ok(())
}
