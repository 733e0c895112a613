use crate::lesson::Lesson;
use crate::shape::{Fallible, Shape};
use crate::sheet::{Sample, Sheet};
use crate::style::{AXIS, BLUE, DISK, INK, ORANGE, PATH};
use medial::axis::KeypointKind;

pub const LESSON: Lesson = Lesson {
    title: "A convex polygon, step by step",
    text: "The tracing starts in the corner v_1 with its two edges as governors (a).\n\
           The first disk that touches a third edge ends the path in a junction; of the two paths that \
           leave it one is traced on and the other put on a stack (b).\n\
           So it goes from junction to junction (c, d) and into a corner (e); the stack then gives back \
           the paths left over, until it is empty (f).",
    draw,
};

fn draw() -> Fallible<String> {
    let shape = Shape::new(&[(0., 0.4), (6.4, 0.), (9., 3.2), (5.2, 6.6), (-0.6, 4.6)])?;
    let window = shape.window(0.75);
    // Steps after which a picture is taken: those that bring something new to see.
    let into_corner = shape.steps.iter().position(|s| s.to.1 == 0.0).ok_or("no path ends")?;
    let junctions: Vec<usize> =
        (0..shape.steps.len()).filter(|&k| shape.steps[k].to.1 > 0.0).collect();
    let mut moments: Vec<usize> = vec![0, into_corner];
    moments.extend(&junctions[1..]);
    moments.sort_unstable();
    let captions = [
        "(a) the first governors",
        "(b) a junction",
        "(c) the next one",
        "(d) and the next",
        "(e) into a corner",
        "(f) the whole axis",
    ];
    let mut sheet = Sheet::new(3, (290.0, 220.0));
    for (k, caption) in captions.iter().enumerate() {
        let mut panel = sheet.panel(window, caption);
        panel.domain(&shape.domain);
        let shown = match k {
            0 => 0,
            5 => shape.steps.len(),
            _ => moments.get(k - 1).ok_or("too few steps")? + 1,
        };
        for step in &shape.steps[..shown] {
            panel.curve(&shape.curve(step), AXIS);
        }
        if k == 5 {
            panel.axis(&shape.axis);
            panel.keypoints(&shape.axis);
        } else {
            let last = &shape.steps[shown.saturating_sub(1)];
            if k > 0 {
                if last.to.1 > 0.0 {
                    panel.disk(last.to.0, last.to.1, DISK);
                    let all: Vec<_> = last.governors.iter().map(|&s| shape.site(s)).collect();
                    panel.spokes(last.to.0, &all);
                }
                panel.curve(&shape.curve(last), PATH);
            }
            for (site, color) in [(last.right, BLUE), (last.left, ORANGE)] {
                panel.site(&shape.site(site), color);
            }
            let kind = |r: f64| if r > 0.0 { KeypointKind::Junction } else { KeypointKind::End };
            panel.dot(last.from.0, kind(last.from.1));
            if k > 0 {
                panel.dot(last.to.0, kind(last.to.1));
            }
        }
        let middle = (window.0 + window.1) * 0.5;
        for (number, edge) in (1..).zip(shape.domain.edges()) {
            let out = edge.start - middle;
            let out = out * (14.0 / out.norm());
            panel.small(edge.start, (out.x, out.y), INK, &format!("v_{number}"));
        }
    }
    sheet.legend(&[
        (Sample::Line(PATH), "path traced last"),
        (Sample::Line("stroke=\"#1976d2\" stroke-width=\"4.5\""), "its right governor"),
        (Sample::Line("stroke=\"#d84315\" stroke-width=\"4.5\""), "its left governor"),
        (Sample::Disk(DISK), "disk at its end"),
        (Sample::Line(AXIS), "axis so far"),
    ]);
    Ok(sheet.finish(LESSON.title))
}
