use crate::bounds::{VIEW, draw as draw_step, room};
use crate::lesson::Lesson;
use crate::shape::Fallible;
use crate::sheet::{Sample, Sheet};
use crate::style::{BACK, DISK, FAINT, FRONT, GHOST, PATH};

pub const LESSON: Lesson = Lesson {
    title: "Corner and edge",
    text: "One step on in the same room, the corner v_i has taken the place of its edge, and the path is a \
           piece of a parabola.\n\
           Both half-lines of a corner start in the corner itself, so each of them meets the parabola once.",
    draw,
};

fn draw() -> Fallible<String> {
    let shape = room()?;
    let step = shape.step(true, false, (4.4, 1.8))?;
    let mut sheet = Sheet::new(1, (780.0, 560.0));
    let mut panel = sheet.panel(VIEW, "");
    draw_step(&shape, &mut panel, step, ["e_j", "v_i"]);
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
