use crate::lesson::Lesson;
use crate::shape::{Fallible, Shape};
use crate::sheet::{Sample, Sheet};
use crate::style::{BLUE, DISK, INK, ORANGE, PATH, PURPLE};

pub const LESSON: Lesson = Lesson {
    title: "Two ways along the boundary",
    text: "A path is traced by a disk that moves and keeps touching its two governors.\n\
           The right one is *isooriented*: its footpoint runs the way of the boundary; the left one is \
           *counteroriented*: its footpoint runs against it.",
    draw,
};

fn draw() -> Fallible<String> {
    let shape = Shape::new(&[(0., 0.4), (12., 0.), (12., 5.2), (0., 3.4)])?;
    let step = shape.step(true, true, (1.6, 1.9))?;
    let mut sheet = Sheet::new(1, (820.0, 370.0));
    let mut panel = sheet.panel(shape.window(0.4), "");
    panel.domain(&shape.domain);
    let curve = shape.curve(step);
    let governors = [step.right, step.left].map(|s| shape.site(s));
    for (governor, color) in governors.iter().zip([BLUE, ORANGE]) {
        panel.site(governor, color);
        let way = governor.b - governor.a;
        for u in [0.25, 0.5, 0.75] {
            panel.head(governor.a + way * u, way, color);
        }
    }
    for u in [0.06, 0.4, 0.82] {
        let (centre, radius) = (curve.point_at(u), curve.radius_at(u));
        panel.disk(centre, radius, DISK);
        panel.spokes(centre, &governors);
    }
    panel.curve(&curve, PATH);
    for u in [0.25, 0.64, 1.0] {
        panel.head(curve.point_at(u), curve.to() - curve.from(), PURPLE);
    }
    panel.label(governors[0].footpoint(curve.point_at(0.62)), (0.0, 16.0), BLUE, "isooriented");
    panel.label(
        governors[1].footpoint(curve.point_at(0.62)),
        (0.0, -20.0),
        ORANGE,
        "counteroriented",
    );
    panel.label(curve.point_at(0.64), (0.0, 16.0), INK, "motion of the disk");
    sheet.legend(&[
        (Sample::Line(PATH), "path"),
        (Sample::Disk(DISK), "moving disk"),
        (Sample::Line("stroke=\"#1976d2\" stroke-width=\"4.5\""), "right governor"),
        (Sample::Line("stroke=\"#d84315\" stroke-width=\"4.5\""), "left governor"),
    ]);
    Ok(sheet.finish(LESSON.title))
}
