use crate::bounds::{VIEW, draw as draw_step, room};
use crate::lesson::Lesson;
use crate::shape::Fallible;
use crate::sheet::{Sample, Sheet};
use crate::style::{BACK, DISK, FAINT, FRONT, GHOST, PATH};

pub const LESSON: Lesson = Lesson {
    title: "Edge and edge",
    text: "The path cannot go beyond the front half-line of its isooriented governor e_j, nor beyond the back \
           half-line of its counteroriented one, e_i.\n\
           They meet its bisector in m_j and m_i; the nearer one is the candidate, and its disk shows that \
           nothing is in the way.",
    draw,
};

fn draw() -> Fallible<String> {
    let shape = room()?;
    let step = shape.step(true, true, (1.4, 1.4))?;
    let mut sheet = Sheet::new(1, (780.0, 560.0));
    let mut panel = sheet.panel(VIEW, "");
    draw_step(&shape, &mut panel, step, ["e_j", "e_i"]);
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
