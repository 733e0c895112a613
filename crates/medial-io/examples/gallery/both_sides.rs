use crate::lee;
use crate::lesson::Lesson;
use crate::shape::Fallible;
use medial::axis::Engine;
use medial::engine::{self, exterior, exterior_frame};
use medial::ops::Voronoi;
use medial_io::svg::{self, Diagram};

pub const LESSON: Lesson = Lesson {
    title: "Cells inside and outside",
    text: "The same polygon with its cells on both sides, as `medial voronoi lee.wkt --side both --frame 2.5 \
           -o lee.svg` draws them.\n\
           Outside, corners that are convex from inside have cells, and those on the convex hull are closed \
           at a frame.",
    draw,
};

/// How far the frame is from the box of the polygon.
const MARGIN: f64 = 2.5;

fn draw() -> Fallible<String> {
    let shape = lee::shape(3)?;
    let options = engine::Options::default();
    let outside = exterior(&shape.domain, Engine::PathTracing, Some(MARGIN), &options)?;
    let axes = [shape.axis, outside];
    let frame = exterior_frame(&shape.domain, Some(MARGIN))?;
    let voronoi = Voronoi::within(&shape.domain, &axes, &frame)?;
    Ok(svg::write_diagrams(&[Diagram::new(&voronoi)], &svg::Options::default()))
}
