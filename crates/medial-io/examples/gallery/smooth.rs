use crate::lesson::Lesson;
use crate::shape::{Fallible, Shape};
use crate::sheet::{Panel, Sheet};
use crate::style::{AXIS, FINE};
use medial::axis::{Curve, MedialAxis};
use medial::geom::Point;
use medial::ops::{Hierarchy, Measure, smoothed, tangent_polygons};

pub const LESSON: Lesson = Lesson {
    title: "Smoothing and rebuilding",
    text: "A stretch of river. On the left `medial smooth river.geojson --prune relative_excess=0.5`: limbs \
           that stand out by less than half a radius are gone, arcs of the last disks close the gaps, and \
           no point of the boundary has moved farther than the command tells. In the middle what \
           `medial reconstruct river.geojson --max-error 0.3` makes of the pruned axis, all of it within 0.3 m \
           of the boundary. On the right `medial reconstruct river.geojson --method tangents --step 0.5`: \
           the polygonal algorithm of Volkmann and St. Clair, from points of the axis that are far apart.",
    draw,
};

/// How far flattened arcs may be from arcs, in metres.
const FINE_ARCS: f64 = 1e-3;

const NEW: &str = "fill=\"none\" stroke=\"#d84315\" stroke-width=\"1.6\"";

fn draw() -> Fallible<String> {
    let shape = Shape::river()?;
    let Shape { domain, axis, .. } = &shape;
    let window = shape.window(0.3);
    let mut sheet = Sheet::new(3, (300.0, 360.0));
    let mut panel = sheet.panel(window, "smoothed");
    panel.domain(domain);
    let smooth = smoothed(domain, axis, Measure::RelativeExcess, 0.5)?;
    paths(&mut panel, &smooth.axis, FINE);
    rings(&mut panel, &smooth.outline.polygons(FINE_ARCS).concat());
    let mut panel = sheet.panel(window, "within 0.3 m");
    panel.domain(domain);
    let pruned = Hierarchy::new(domain, axis)?.pruned(Measure::Excess, 0.3).axis;
    paths(&mut panel, &pruned, AXIS);
    rings(&mut panel, &medial::ops::Outline::new(&pruned)?.polygons(FINE_ARCS).concat());
    let mut panel = sheet.panel(window, "tangents");
    panel.domain(domain);
    rings(&mut panel, &tangent_polygons(axis, 0.5)?.concat());
    Ok(sheet.finish(LESSON.title))
}

fn paths(panel: &mut Panel<'_>, axis: &MedialAxis, style: &str) {
    let curves: Vec<Curve> = axis.paths().iter().map(|path| axis.curve(&path)).collect();
    panel.curves(&curves, style);
}

fn rings(panel: &mut Panel<'_>, rings: &[Vec<Point>]) {
    rings.iter().for_each(|ring| panel.area(ring, NEW));
}
