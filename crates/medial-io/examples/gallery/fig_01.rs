use crate::lesson::Lesson;
use crate::shape::{Fallible, Shape};
use crate::sheet::{Sample, Sheet};
use crate::style::{AXIS, DISK, INK, PURPLE};
use medial::axis::KeypointKind;

pub const LESSON: Lesson = Lesson {
    title: "Points of the axis",
    text: "A maximal disk lies inside the domain and in no larger such disk; the axis is where their \
           centres are.\n\
           At a *junction* the disk touches three or more governors, at a regular point two; an *end* is \
           a convex corner, where the radius is 0.\n\
           A *transition* is a regular point where one of the two governors changes: here the upper \
           one, from the reflex corner to the edge that ends there.",
    draw,
};

fn draw() -> Fallible<String> {
    let shape =
        Shape::new(&[(0., 0.), (11., 0.6), (10.4, 3.8), (4.2, 3.6), (3.4, 7.2), (0.4, 6.8)])?;
    let mut sheet = Sheet::new(1, (820.0, 520.0));
    let mut panel = sheet.panel(shape.window(0.6), "");
    panel.domain(&shape.domain);
    let (junction, at) = shape.keypoint(KeypointKind::Junction, (9., 2.))?;
    panel.disk(at.position, at.radius, DISK);
    panel.spokes(at.position, &shape.governors(junction));
    let (transition, change) = shape.keypoint(KeypointKind::Transition, (4.2, 2.))?;
    panel.disk(change.position, change.radius, DISK);
    panel.spokes(change.position, &shape.governors(transition));
    // A regular point: halfway along the path between those two.
    let spine = shape
        .axis
        .paths()
        .iter()
        .find(|p| [p.from, p.to].contains(&junction) && [p.from, p.to].contains(&transition));
    let spine = spine.ok_or("the two keypoints are not joined")?;
    let curve = shape.axis.curve(&spine);
    let (regular, radius) = (curve.point_at(0.5), curve.radius_at(0.5));
    panel.disk(regular, radius, DISK);
    panel.spokes(regular, &shape.axis.path_governors(&spine));
    panel.axis(&shape.axis);
    panel.keypoints(&shape.axis);
    panel.point(regular, PURPLE);
    panel.label(at.position, (0.0, 20.0), INK, "junction");
    panel.label(change.position, (-12.0, -16.0), INK, "transition");
    panel.label(regular, (0.0, 18.0), INK, "regular point");
    let (_, end) = shape.keypoint(KeypointKind::End, (0., 7.))?;
    panel.label(end.position, (0.0, 15.0), INK, "end");
    sheet.legend(&[
        (Sample::Line(AXIS), "axis"),
        (Sample::Disk(DISK), "maximal disk"),
        (Sample::Dot(KeypointKind::End), "end"),
        (Sample::Dot(KeypointKind::Transition), "transition"),
        (Sample::Dot(KeypointKind::Junction), "junction"),
    ]);
    Ok(sheet.finish(LESSON.title))
}
