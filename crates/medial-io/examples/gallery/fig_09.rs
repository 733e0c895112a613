use crate::bounds::draw as draw_step;
use crate::lesson::Lesson;
use crate::shape::{Fallible, Shape};
use crate::sheet::{Sample, Sheet};
use crate::style::{BACK, DISK, FAINT, FRONT, GHOST, PATH};

pub const LESSON: Lesson = Lesson {
    title: "Corner and corner",
    text: "Between two corners the path is straight again.\n\
           A half-line may bound it as before (a); where none meets it ahead (b), it ends at the first disk \
           that touches something else, here the two corners on the other side.",
    draw,
};

fn draw() -> Fallible<String> {
    let mut sheet = Sheet::new(2, (440.0, 360.0));
    let shape = Shape::new(&[
        (0., 0.7),
        (4., 1.),
        (6.2, -1.2),
        (10., -1.2),
        (10., 6.6),
        (7., 6.6),
        (4.4, 4.2),
        (0., 4.5),
    ])?;
    let step = shape.step(false, false, (4.2, 2.6))?;
    let mut panel = sheet.panel(shape.window(0.4), "(a) a half-line bounds the path");
    draw_step(&shape, &mut panel, step, ["v_j", "v_i"]);
    let shape = Shape::new(&[
        (2., 0.),
        (5., 0.),
        (5., 2.4),
        (8., 2.4),
        (8., 5.4),
        (5., 5.4),
        (5., 7.),
        (2., 7.),
        (2., 5.4),
        (-1., 5.4),
        (-1., 2.4),
        (2., 2.4),
    ])?;
    let step = shape.step(false, false, (3.5, 2.4))?;
    let mut panel = sheet.panel(shape.window(0.4), "(b) no half-line does");
    draw_step(&shape, &mut panel, step, ["v_j", "v_i"]);
    sheet.legend(&[
        (Sample::Line(PATH), "path"),
        (Sample::Line(FAINT), "its bisector"),
        (Sample::Disk(DISK), "disk at its end"),
        (Sample::Disk(GHOST), "farther on"),
        (Sample::Line(FRONT), "front half-line"),
        (Sample::Line(BACK), "back half-line"),
    ]);
    Ok(sheet.finish(LESSON.title))
}
