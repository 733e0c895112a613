use crate::lesson::Lesson;
use crate::shape::{Fallible, Shape};
use crate::sheet::Sheet;
use crate::style::{DISK, FINE, TEAL};
use medial::axis::{Curve, Engine};
use medial::engine::{Options, exterior};
use medial::ops::{largest_disks, necks, offset_margin, offsets};

pub const LESSON: Lesson = Lesson {
    title: "Offsets, necks and the largest disk",
    text: "The river for makers. On the left `medial offset river.geojson --distance 0.2,0.4,0.8,-0.4,-0.8`: \
           the true parallel curves, of segments and of arcs around the corners. On the right the necks that \
           `medial clearance river.geojson` finds, each a line between the two elements that face each \
           other, and the disk of `medial clearance river.geojson --largest`.",
    draw,
};

const INWARD: [f64; 3] = [0.2, 0.4, 0.8];
const OUTWARD: [f64; 2] = [0.4, 0.8];

/// How far flattened arcs may be from arcs, in metres.
const FINE_ARCS: f64 = 1e-3;

const INSIDE: &str = "fill=\"none\" stroke=\"#00897b\" stroke-width=\"1.3\"";
const OUTSIDE: &str = "fill=\"none\" stroke=\"#d84315\" stroke-width=\"1.3\"";
const NECK: &str = "fill=\"none\" stroke=\"#d84315\" stroke-width=\"2\"";

fn draw() -> Fallible<String> {
    let shape = Shape::river()?;
    let Shape { domain, axis, .. } = &shape;
    let window = shape.window(1.2);
    let mut sheet = Sheet::new(2, (360.0, 380.0));
    let mut panel = sheet.panel(window, "offsets");
    panel.domain(domain);
    for outline in offsets(domain, axis, &INWARD)? {
        outline.polygons(FINE_ARCS).concat().iter().for_each(|ring| panel.area(ring, INSIDE));
    }
    let margin = offset_margin(domain, OUTWARD[1]);
    let outer = exterior(domain, Engine::PathTracing, Some(margin), &Options::default())?;
    for outline in offsets(domain, &outer, &OUTWARD)? {
        outline.polygons(FINE_ARCS).concat().iter().for_each(|ring| panel.area(ring, OUTSIDE));
    }
    let mut panel = sheet.panel(window, "necks, and the largest disk");
    panel.domain(domain);
    for plateau in largest_disks(domain, axis)? {
        panel.disk(plateau.middle, plateau.radius, DISK);
        panel.point(plateau.middle, TEAL);
    }
    let curves: Vec<Curve> = axis.paths().iter().map(|path| axis.curve(&path)).collect();
    panel.curves(&curves, FINE);
    for neck in necks(domain, axis, None)? {
        let [from, to] = neck.footpoints;
        panel.line(from, to, NECK);
    }
    Ok(sheet.finish(LESSON.title))
}
