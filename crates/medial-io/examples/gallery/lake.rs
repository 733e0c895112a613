use crate::lesson::Lesson;
use crate::shape::{Fallible, judged};
use crate::sheet::{Sheet, Window};
use crate::style::{FINE, SHORE};
use medial::axis::Curve;
use medial::domain::{Domain, Options};
use medial::geom::Point;
use medial_io::{Format, read};
use std::fs;

pub const LESSON: Lesson = Lesson {
    title: "A lake and its islands",
    text: "A piece of a real map: one polygon of 12864 corners with 1443 holes, of which a part is shown.\n\
           Every island has a cycle of the axis around it, the line farthest from all shores.",
    draw,
};

/// The part that is shown, as shares of the box around the lake.
const SHOWN: [(f64, f64); 2] = [(0.36, 0.18), (0.66, 0.48)];

fn draw() -> Fallible<String> {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fixtures/lake.rings");
    let bytes = fs::read(file)?;
    let feature = read(Format::Rings, &bytes)?.next().ok_or("no feature in the fixture")??;
    let domain = Domain::from_polygons(&feature.polygons, &Options::default())?;
    let axis = judged(&domain)?;
    let (low, high) = axis.bounds().ok_or("an empty axis")?;
    let [low, high] =
        SHOWN.map(|(x, y)| Point::new(low.x + x * (high.x - low.x), low.y + y * (high.y - low.y)));
    let window = (low, high);
    let height = 860.0 * (high.y - low.y) / (high.x - low.x);
    let mut sheet = Sheet::new(1, (860.0, height));
    let mut panel = sheet.panel(window, "");
    panel.walks(&domain, SHORE, |points| meets(window, points));
    let curves: Vec<Curve> = axis.paths().iter().map(|p| axis.curve(&p)).collect();
    panel.curves(curves.iter().filter(|c| meets(window, &[c.from(), c.to()])), FINE);
    panel.mat();
    Ok(sheet.finish(LESSON.title))
}

/// Whether the box around some points meets a window.
fn meets((low, high): Window, points: &[Point]) -> bool {
    let least = |x: fn(&Point) -> f64| points.iter().map(x).fold(f64::INFINITY, f64::min);
    let most = |x: fn(&Point) -> f64| points.iter().map(x).fold(f64::NEG_INFINITY, f64::max);
    least(|p| p.x) <= high.x
        && low.x <= most(|p| p.x)
        && least(|p| p.y) <= high.y
        && low.y <= most(|p| p.y)
}
