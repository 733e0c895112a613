use crate::lesson::Lesson;
use crate::shape::{Fallible, Shape};
use crate::sheet::{Sample, Sheet};
use crate::style::{BLUE, DISK, ORANGE, PATH, SUPPORT};
use medial::geom::Point;

pub const LESSON: Lesson = Lesson {
    title: "Bisectors",
    text: "What two governors have between them: the straight bisector of two reflex corners (a), a piece \
           of a parabola with the corner as focus and the edge as directrix (b), the bisector of the \
           angle between two edges (c).\n\
           Each disk touches both governors, and the radius has no maximum inside a path.",
    draw,
};

fn draw() -> Fallible<String> {
    let facing = [
        (0., 0.),
        (3.5, 0.),
        (4., 2.),
        (4.5, 0.),
        (8., 0.),
        (8., 6.),
        (4.5, 6.),
        (4., 4.),
        (3.5, 6.),
        (0., 6.),
    ];
    let spike = [(0., 0.), (8., 0.), (8., 6.), (4.5, 6.), (4., 2.4), (3.5, 6.), (0., 6.)];
    let wedge = [(3., 2.2), (8., 0.4), (8., 5.6), (3., 3.8)];
    let window = (Point::new(-0.3, -0.3), Point::new(8.3, 6.3));
    let mut sheet = Sheet::new(3, (300.0, 240.0));
    for (ring, kinds, caption) in [
        (&facing[..], (false, false), "(a) corner and corner"),
        (&spike[..], (true, false), "(b) edge and corner"),
        (&wedge[..], (true, true), "(c) edge and edge"),
    ] {
        let shape = Shape::new(ring)?;
        let mut panel = sheet.panel(window, caption);
        panel.domain(&shape.domain);
        // The longest inner path with governors of these kinds.
        let path = shape
            .axis
            .paths()
            .iter()
            .filter(|p| {
                let edges = shape.axis.path_governors(p).map(|s| s.a != s.b);
                let inner = shape.axis.curve(p).radius_min() > 0.0;
                inner && (edges == [kinds.0, kinds.1] || edges == [kinds.1, kinds.0])
            })
            .max_by(|p, q| {
                let length = |p| shape.axis.curve(p).length();
                length(p).total_cmp(&length(q))
            })
            .ok_or("no path with such governors")?;
        let governors = shape.axis.path_governors(&path);
        let curve = shape.axis.curve(&path);
        for u in [0.0, 0.3, 0.7, 1.0] {
            panel.disk(curve.point_at(u), curve.radius_at(u), DISK);
            panel.spokes(curve.point_at(u), &governors);
        }
        if kinds == (true, true) {
            // The supporting lines, back to where they meet the border of the panel.
            for governor in &governors {
                let (a, d) = (governor.a, governor.b - governor.a);
                panel.ray(
                    if d.x > 0.0 { a } else { governor.b },
                    if d.x > 0.0 { -d } else { d },
                    SUPPORT,
                );
            }
        }
        for governor in &governors {
            panel.site(governor, if governor.a == governor.b { ORANGE } else { BLUE });
        }
        panel.curve(&curve, PATH);
    }
    sheet.legend(&[
        (Sample::Line(PATH), "path"),
        (Sample::Disk(DISK), "maximal disk"),
        (Sample::Line("stroke=\"#1976d2\" stroke-width=\"4.5\""), "edge that governs"),
        (Sample::Spot(ORANGE), "corner that governs"),
    ]);
    Ok(sheet.finish(LESSON.title))
}
