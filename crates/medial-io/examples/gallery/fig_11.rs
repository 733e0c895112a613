use crate::lesson::Lesson;
use crate::shape::{Fallible, Shape};
use crate::sheet::{Panel, Sample, Sheet};
use crate::style::{AXIS, BLUE, DISK, FAINT, INK, ORANGE, PATH, RED, REJECTED};
use medial::engine::Step;

pub const LESSON: Lesson = Lesson {
    title: "Candidates that do not hold",
    text: "The path that is traced here runs between the corner v and the floor (a).\n\
           The first candidate is where the back half-line of v bounds it, but other elements cut its \
           disk (b).\n\
           The one of them that the path meets first makes the next candidate; nothing cuts that disk \
           (c), so it is the junction from which the tracing goes on (d).",
    draw,
};

fn draw() -> Fallible<String> {
    let shape = Shape::new(&[
        (0., 0.),
        (13., 0.),
        (13., 3.),
        (9.4, 2.2),
        (13., 6.4),
        (9., 7.),
        (7.4, 4.4),
        (6.6, 7.),
        (4.8, 7.),
        (4.2, 2.8),
        (0., 3.2),
    ])?;
    // The first step with a corner on the left whose candidates did not all hold.
    let (number, step) = shape
        .steps
        .iter()
        .enumerate()
        .find(|(_, s)| s.right.is_edge() && !s.left.is_edge() && s.candidates.len() > 1)
        .ok_or("every first candidate holds")?;
    let window = shape.window(0.35);
    let mut sheet = Sheet::new(2, (440.0, 260.0));
    let mut panel = sheet.panel(window, "(a) a path starts");
    ground(&shape, &mut panel, number, step);
    let start = step.from;
    panel.disk(start.0, start.1, DISK);
    let (last, rejected) = step.candidates.split_last().ok_or("no candidate")?;
    for candidate in rejected {
        let mut panel = sheet.panel(window, "(b) a candidate that is cut");
        ground(&shape, &mut panel, number, step);
        let disk = (candidate.centre, candidate.radius);
        panel.curve(&shape.curve_to(step, disk), FAINT);
        panel.disk(disk.0, disk.1, REJECTED);
        for k in 0..shape.domain.edges().len() as u32 {
            // What cuts the disk, clear of its rim.
            let site = shape.site(medial::domain::Site::edge(k));
            if (site.footpoint(disk.0) - disk.0).norm() < disk.1 * (1.0 - 1e-9) {
                panel.line(site.a, site.b, CUTTING);
            }
        }
        panel.point(disk.0, RED);
    }
    let mut panel = sheet.panel(window, "(c) the candidate that holds");
    ground(&shape, &mut panel, number, step);
    panel.disk(last.centre, last.radius, DISK);
    let all: Vec<_> = step.governors.iter().map(|&s| shape.site(s)).collect();
    panel.spokes(last.centre, &all);
    panel.curve(&shape.curve(step), PATH);
    let mut panel = sheet.panel(window, "(d) the whole axis");
    panel.domain(&shape.domain);
    panel.axis(&shape.axis);
    panel.keypoints(&shape.axis);
    sheet.legend(&[
        (Sample::Line(PATH), "path"),
        (Sample::Disk(DISK), "empty disk"),
        (Sample::Disk(REJECTED), "candidate that is cut"),
        (Sample::Line(CUTTING), "cuts it"),
        (Sample::Line("stroke=\"#1976d2\" stroke-width=\"4.5\""), "right governor"),
        (Sample::Spot(ORANGE), "left governor"),
    ]);
    Ok(sheet.finish(LESSON.title))
}

/// What is in the way.
const CUTTING: &str =
    "fill=\"none\" stroke=\"#c62828\" stroke-width=\"3.4\" stroke-linecap=\"round\"";

/// The domain, the axis before a step, and the governors of that step.
fn ground(shape: &Shape, panel: &mut Panel, number: usize, step: &Step) {
    panel.domain(&shape.domain);
    for earlier in &shape.steps[..number] {
        panel.curve(&shape.curve(earlier), AXIS);
    }
    panel.site(&shape.site(step.right), BLUE);
    panel.site(&shape.site(step.left), ORANGE);
    panel.label(shape.site(step.left).a, (10.0, 6.0), INK, "v");
}
