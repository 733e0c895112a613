use crate::lesson::Lesson;
use crate::shape::{Fallible, Shape};
use crate::sheet::{Sample, Sheet};
use crate::style::{AXIS, BACK, BLUE, DISK, FRONT, ORANGE, PATH};

pub const LESSON: Lesson = Lesson {
    title: "Where no half-line bounds a path",
    text: "The axis has reached a transition, and the two lower corners govern the next path; their \
           half-lines run beside it and never meet it (a).\n\
           A disk that grows along the path meets both upper corners at once: four governors, one \
           junction (b).\n\
           From there three new paths start (c).",
    draw,
};

fn draw() -> Fallible<String> {
    let shape = Shape::new(&[
        (2., 0.),
        (5., 0.),
        (5., 2.6),
        (8., 2.6),
        (8., 5.6),
        (5., 5.6),
        (5., 7.6),
        (2., 7.6),
        (2., 5.6),
        (-1., 5.6),
        (-1., 2.6),
        (2., 2.6),
    ])?;
    let number = shape
        .steps
        .iter()
        .position(|s| !s.right.is_edge() && !s.left.is_edge())
        .ok_or("no path between two corners")?;
    let step = &shape.steps[number];
    let window = shape.window(0.4);
    let mut sheet = Sheet::new(3, (290.0, 260.0));
    let mut panel = sheet.panel(window, "(a) two corners govern");
    panel.domain(&shape.domain);
    for earlier in &shape.steps[..number] {
        panel.curve(&shape.curve(earlier), AXIS);
    }
    panel.disk(step.from.0, step.from.1, DISK);
    let (right, left) =
        (shape.domain.edge(step.right.index()), shape.domain.edge(step.left.index()));
    panel.ray(right.start, shape.normal(step.right.index()), FRONT);
    panel.ray(left.start, shape.normal(left.prev), BACK);
    panel.site(&shape.site(step.right), BLUE);
    panel.site(&shape.site(step.left), ORANGE);
    let mut panel = sheet.panel(window, "(b) four governors");
    panel.domain(&shape.domain);
    for earlier in &shape.steps[..number] {
        panel.curve(&shape.curve(earlier), AXIS);
    }
    panel.disk(step.to.0, step.to.1, DISK);
    let all: Vec<_> = step.governors.iter().map(|&s| shape.site(s)).collect();
    panel.spokes(step.to.0, &all);
    panel.curve(&shape.curve(step), PATH);
    for site in &all {
        panel.site(site, BLUE);
    }
    panel.dot(step.to.0, medial::axis::KeypointKind::Junction);
    let mut panel = sheet.panel(window, "(c) three new paths");
    panel.domain(&shape.domain);
    for earlier in &shape.steps[..=number] {
        panel.curve(&shape.curve(earlier), AXIS);
    }
    for new in shape.steps.iter().filter(|s| s.from.0 == step.to.0) {
        panel.curve(&shape.curve(new), PATH);
        panel.disk(new.to.0, new.to.1, DISK);
    }
    panel.dot(step.to.0, medial::axis::KeypointKind::Junction);
    sheet.legend(&[
        (Sample::Line(AXIS), "axis so far"),
        (Sample::Line(PATH), "path"),
        (Sample::Disk(DISK), "maximal disk"),
        (Sample::Line(FRONT), "front half-line"),
        (Sample::Line(BACK), "back half-line"),
    ]);
    Ok(sheet.finish(LESSON.title))
}
