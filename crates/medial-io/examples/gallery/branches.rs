use crate::lesson::Lesson;
use crate::shape::{Fallible, Shape};
use crate::sheet::{Sample, Sheet};
use crate::style::{FINE, MUTED};
use medial::axis::{Curve, Engine, Side};
use medial::engine::both_sides;
use medial::ops::{Hierarchy, Measure, Primitive, Trend, branches, limbs};

pub const LESSON: Lesson = Lesson {
    title: "Branches, peninsulas and bays",
    text: "The river again. On the left what `medial branches river.geojson --prune relative_excess=0.5 \
           --by primitive` gives: pieces of branches coloured by what the radius does along them, seen in \
           the direction of their branch. Worms need parallel edges, and there are none. On the right, what \
           `medial branches river.geojson --limbs --side both` gives: peninsulas, which are branches with a \
           free end, and bays, those of the outside as far as they lie within the convex hull.",
    draw,
};

const OPENING: &str = "fill=\"none\" stroke=\"#d84315\" stroke-width=\"2\"";
const CLOSING: &str = "fill=\"none\" stroke=\"#1976d2\" stroke-width=\"2\"";
const WEDGE: &str = "fill=\"none\" stroke=\"#00897b\" stroke-width=\"2\"";
const PENINSULA: &str = "fill=\"none\" stroke=\"#8e24aa\" stroke-width=\"1.8\"";
const BAY: &str = "fill=\"none\" stroke=\"#ef6c00\" stroke-width=\"1.8\"";

fn draw() -> Fallible<String> {
    let shape = Shape::river()?;
    let Shape { domain, axis, .. } = &shape;
    let pruned = Hierarchy::new(domain, axis)?.pruned(Measure::RelativeExcess, 0.5).axis;
    let window = shape.window(0.3);
    let mut sheet = Sheet::new(2, (300.0, 360.0));
    let mut panel = sheet.panel(window, "primitives");
    panel.domain(domain);
    for piece in branches(&pruned).iter().flat_map(|branch| branch.pieces()) {
        let style = match (piece.primitive(), piece.trend()) {
            (Primitive::Flare, Some(Trend::Opening)) => OPENING,
            (Primitive::Flare, _) => CLOSING,
            _ => WEDGE,
        };
        panel.curves(&piece.curves().collect::<Vec<_>>(), style);
    }
    let mut panel = sheet.panel(window, "peninsulas and bays");
    panel.domain(domain);
    let options = medial::engine::Options::default();
    let curves: Vec<Curve> = pruned.paths().iter().map(|path| pruned.curve(&path)).collect();
    panel.curves(&curves, FINE);
    for side in both_sides(domain, Engine::PathTracing, None, &options)? {
        for limb in limbs(domain, &side, Measure::RelativeExcess, 0.5)? {
            let style = if limb.side == Side::Interior { PENINSULA } else { BAY };
            panel.curves(&limb.curves, style);
            panel.point(limb.tip, MUTED);
        }
    }
    sheet.legend(&[
        (Sample::Line(OPENING), "flare, opening"),
        (Sample::Line(CLOSING), "flare, closing"),
        (Sample::Line(WEDGE), "wedge"),
        (Sample::Line(PENINSULA), "peninsula"),
        (Sample::Line(BAY), "bay"),
    ]);
    Ok(sheet.finish(LESSON.title))
}
