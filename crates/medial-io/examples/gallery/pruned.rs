use crate::lesson::Lesson;
use crate::shape::{Fallible, Shape};
use crate::sheet::Sheet;
use crate::style::{AXIS, FAINT, FINE};
use medial::axis::{Curve, MedialAxis};
use medial::ops::{CenterlineOptions, Extension, Hierarchy, Measure, centerlines};

pub const LESSON: Lesson = Lesson {
    title: "Pruning, and the main line",
    text: "A real stretch of river. On the left its whole axis; in the middle what \
           `medial prune river.geojson --prune relative_excess=0.5` leaves of it, with what is removed \
           fainter; on the right the line that `medial centerline river.geojson --extend boundary` gives.\n\
           A branch is removed from its leaf inwards for as long as no corner behind a disk is farther from \
           it than half its radius: corners blunter than some 84 degrees go, whatever their size, and bays \
           stay.",
    draw,
};

/// Excess as a share of the radius below which nothing is kept.
const LEAST: f64 = 0.5;

fn draw() -> Fallible<String> {
    let shape = Shape::river()?;
    let Shape { domain, axis, .. } = &shape;
    let pruned = Hierarchy::new(domain, axis)?.pruned(Measure::RelativeExcess, LEAST).axis;
    let extension = Extension::Boundary;
    let options = CenterlineOptions { extension, ..CenterlineOptions::default() };
    let lines = centerlines(domain, axis, &options)?;
    let window = shape.window(0.3);
    let curves = |axis: &MedialAxis| -> Vec<Curve> {
        axis.paths().iter().map(|path| axis.curve(&path)).collect()
    };
    let mut sheet = Sheet::new(3, (300.0, 360.0));
    let mut panel = sheet.panel(window, "the axis");
    panel.domain(domain);
    panel.curves(&curves(axis), FINE);
    let mut panel = sheet.panel(window, "pruned");
    panel.domain(domain);
    panel.curves(&curves(axis), FAINT);
    panel.curves(&curves(&pruned), AXIS);
    let mut panel = sheet.panel(window, "the main line");
    panel.domain(domain);
    for line in &lines {
        panel.curves(&line.curves, AXIS);
        let ends = [line.curves.first().map(Curve::from), line.curves.last().map(Curve::to)];
        for (end, beyond) in ends.into_iter().zip(line.extensions) {
            if let (Some(end), Some((beyond, _))) = (end, beyond) {
                panel.line(end, beyond, AXIS);
            }
        }
    }
    Ok(sheet.finish(LESSON.title))
}
