use crate::lesson::Lesson;
use crate::shape::{Fallible, Shape, half_line};
use crate::sheet::{Sample, Sheet};
use crate::style::{BACK, BACK_INK, BLUE, FRONT, FRONT_INK, INK, MUTED, ORANGE, SUPPORT};
use medial::domain::{Corner, Site};
use medial::geom::Point;

pub const LESSON: Lesson = Lesson {
    title: "Order along the boundary",
    text: "The boundary runs so that the interior lies on its left, and so puts its half-lines in order, \
           numbered here from the lower left corner.\n\
           Each edge has a back half-line where it starts and a front one where it ends; a reflex corner \
           has both in one point.\n\
           The front half-line of one element is the back half-line of the next.",
    draw,
};

fn draw() -> Fallible<String> {
    let shape = Shape::new(&[
        (0., 0.),
        (12., 0.4),
        (11.4, 5.2),
        (7.6, 4.8),
        (6.4, 2.8),
        (4.2, 3.4),
        (3.6, 6.4),
        (0.6, 6.),
    ])?;
    let domain = &shape.domain;
    let mut sheet = Sheet::new(1, (820.0, 500.0));
    let mut panel = sheet.panel(shape.window(0.5), "");
    panel.domain(domain);
    let chosen = (0u32, 4u32); // an edge, and the reflex corner where another one starts
    let mut number = 0;
    for k in 0..domain.edges().len() as u32 {
        let edge = domain.edge(k);
        let middle = (edge.start + domain.end(k)) * 0.5;
        panel.head(middle + edge.direction * 0.12, edge.direction, INK);
        // At its start: the normals of both edges of a reflex corner, or one bisector.
        let ways = match edge.corner {
            Corner::Convex => vec![half_line(&shape, k, shape.normal(k))?],
            _ => vec![shape.normal(edge.prev), shape.normal(k)],
        };
        for way in ways {
            number += 1;
            let tip = edge.start + way * 1.05;
            if ![chosen.0, domain.edge(chosen.0).next, chosen.1].contains(&k) {
                panel.line(edge.start, tip, SUPPORT);
                panel.head(tip, way, MUTED);
            }
            panel.note(tip + way.perp() * 0.22, (0.0, 0.0), &number.to_string());
        }
    }
    // One edge and one corner with their own two.
    let (e, v) = chosen;
    let next = domain.edge(e).next;
    let (back, front) =
        (half_line(&shape, e, shape.normal(e))?, half_line(&shape, next, shape.normal(e))?);
    panel.site(&shape.site(Site::edge(e)), BLUE);
    let (start, end) = (domain.edge(e).start, domain.end(e));
    panel.line(start, start + back * 2.6, BACK);
    panel.head(start + back * 2.6, back, BACK_INK);
    panel.label(start + back * 2.6, (8.0, 10.0), BACK_INK, "e(h_1)");
    panel.line(end, end + front * 2.6, FRONT);
    panel.head(end + front * 2.6, front, FRONT_INK);
    panel.label(end + front * 2.6, (-8.0, 10.0), FRONT_INK, "e(h_2)");
    panel.label((start + end) * 0.5, (0.0, 16.0), BLUE, "e");
    let corner = domain.edge(v);
    let (back, front) = (shape.normal(corner.prev), shape.normal(v));
    panel.site(&shape.site(Site::corner(v)), ORANGE);
    for (way, style, color, name, side) in
        [(back, BACK, BACK_INK, "v(h_1)", 10.0), (front, FRONT, FRONT_INK, "v(h_2)", -10.0)]
    {
        let tip: Point = corner.start + way * 2.0;
        panel.line(corner.start, tip, style);
        panel.head(tip, way, color);
        panel.label(tip, (side, 6.0), color, name);
    }
    panel.label(corner.start, (0.0, 18.0), ORANGE, "v");
    sheet.legend(&[
        (Sample::Line(BACK), "back half-line"),
        (Sample::Line(FRONT), "front half-line"),
        (Sample::Line(SUPPORT), "all half-lines, in order"),
    ]);
    Ok(sheet.finish(LESSON.title))
}
