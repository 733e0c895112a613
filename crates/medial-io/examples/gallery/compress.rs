use crate::lesson::Lesson;
use crate::shape::{Fallible, Shape};
use crate::sheet::Sheet;
use crate::style::{AXIS, DISK, FAINT, TEAL};
use medial::axis::Curve;
use medial::ops::{CenterlineOptions, Route, centerlines, compress};

pub const LESSON: Lesson = Lesson {
    title: "Compression, and a line for a label",
    text: "The river once more. On the left the disks that `medial compress river.geojson --max-error 0.3` \
           keeps, joined by straight lines with linear radius: their union is nowhere farther than 0.3 m \
           from the boundary. On the right the line that `medial centerline river.geojson --for label` gives: \
           long, wide enough for letters half as high as the river is wide, and with few turns.",
    draw,
};

/// How far the boundary may move, in metres.
const ERROR: f64 = 0.3;

fn draw() -> Fallible<String> {
    let shape = Shape::river()?;
    let Shape { domain, axis, .. } = &shape;
    let window = shape.window(0.3);
    let mut sheet = Sheet::new(2, (300.0, 360.0));
    let mut panel = sheet.panel(window, "within 0.3 m");
    panel.domain(domain);
    let graph = compress(domain, axis, ERROR)?;
    for number in 0..graph.disks().len() as u32 {
        let (centre, radius) = graph.disk(number);
        panel.disk(centre, radius, DISK);
    }
    for [from, to] in graph.links() {
        panel.line(graph.disk(from).0, graph.disk(to).0, AXIS);
    }
    for number in 0..graph.disks().len() as u32 {
        panel.point(graph.disk(number).0, TEAL);
    }
    let mut panel = sheet.panel(window, "for a label");
    panel.domain(domain);
    let curves: Vec<Curve> = axis.paths().iter().map(|path| axis.curve(&path)).collect();
    panel.curves(&curves, FAINT);
    let route = Route::Label { height: None };
    let options = CenterlineOptions { route, ..CenterlineOptions::default() };
    for line in centerlines(domain, axis, &options)? {
        panel.curves(&line.curves, AXIS);
    }
    Ok(sheet.finish(LESSON.title))
}
