use crate::lee;
use crate::lesson::Lesson;
use crate::shape::Fallible;
use crate::sheet::{Sample, Sheet};
use crate::style::{AXIS, DOMAIN};
use medial::check::defects;
use medial::engine::divide_and_conquer;
use medial::geom::Point;

pub const LESSON: Lesson = Lesson {
    title: "Plotted examples",
    text: "In place of figures 9 to 11 of [Lee82], which a program in Fortran plotted: three polygons of our \
           own, with the axis that `divide_and_conquer` gives.\n\
           Beside its figure 9 the paper prints a processor time of .569 seconds; [the benchmarks]\
           (../benchmarks.md#figures-of-lee) tell what both engines take for the polygons shown here.",
    draw,
};

const FIGURES: [u32; 3] = [9, 10, 11];

fn draw() -> Fallible<String> {
    let mut sheet = Sheet::new(3, (330.0, 330.0));
    for figure in FIGURES {
        let domain = lee::domain(figure)?;
        let axis = divide_and_conquer(&domain)?;
        if let Some(defect) = defects(&domain, &axis).defects.first() {
            return Err(format!("a figure would show a defect: {defect}").into());
        }
        let (low, high) = axis.bounds().ok_or("an empty axis")?;
        let margin = Point::new(0.3, 0.3);
        let caption = format!("Fig. {figure}: {} edges", domain.edges().len());
        let mut panel = sheet.panel((low - margin, high + margin), &caption);
        panel.domain(&domain);
        panel.axis(&axis);
    }
    sheet.legend(&[(Sample::Area(DOMAIN), "polygon"), (Sample::Line(AXIS), "medial axis")]);
    Ok(sheet.finish(LESSON.title))
}
