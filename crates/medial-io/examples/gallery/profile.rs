use crate::lesson::Lesson;
use crate::shape::{Fallible, Shape};
use medial::ops::{CenterlineOptions, centerlines, profile};
use medial_io::domain_tolerance;
use medial_io::svg::{self, Profile};

pub const LESSON: Lesson = Lesson {
    title: "The width along a river",
    text: "The river from one end of its main line to the other, as \
           `medial clearance river.geojson --profile -o widths.svg` plots it, in metres: how wide it is, and \
           where it is narrowest between wider places.\n\
           Between two points of the plot the width is linear within the tolerance, and every place where \
           two banks are nearest to each other is a point of it.",
    draw,
};

fn draw() -> Fallible<String> {
    let Shape { domain, axis, .. } = Shape::river()?;
    let lines = centerlines(&domain, &axis, &CenterlineOptions::default())?;
    let line = lines.first().ok_or("a river without a line")?;
    let stations = profile(line, domain_tolerance(&domain));
    Ok(svg::write_profiles(&[Profile { feature: 0, stations }], &svg::Options::default()))
}
