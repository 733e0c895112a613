//! Scalable vector pictures: the domain, the axis coloured by radius, keypoints by kind; and the shapes of
//! drawings.
//!
//! # Contract
//! One picture holds all scenes in one frame. Parabolas are exact quadratic Béziers, cut where
//! the colour changes; y points up. Colours, widths and sizes are attributes of groups, so any
//! renderer draws the same.

mod canvas;
mod carving;
mod centerline;
mod frame;
mod layers;
mod legend;
mod lettering;
mod offset;
mod overlay;
mod palette;
mod profile;
pub(crate) mod read;
mod voronoi;
mod walls;

pub use carving::{ToolPath, write_tool_paths};
pub use centerline::{MainLines, write_lines};
pub use offset::{Parallels, write_offsets};
pub use overlay::{LineStyle, Overlay, OverlayLayer, write_overlay};
pub(crate) use overlay::{drawn, painted_options};
pub use profile::{Profile, write_profiles};
pub use read::{Fonts, has_text, read};
pub use voronoi::{Diagram, write_diagrams};
pub use walls::{ThinWalls, write_walls};

use crate::text::escaped;
use canvas::Canvas;
use frame::Frame;
use medial::axis::{Accuracy, MedialAxis};
use medial::geom::Point;

/// One shape with its axis.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The closed boundary walks.
    pub boundary: Vec<Vec<Point>>,
    /// The axis.
    pub axis: MedialAxis,
}

impl Scene {
    /// Whether its axis comes from samples.
    fn is_sampled(&self) -> bool {
        self.axis.accuracy != Accuracy::Exact
    }
}

/// What a picture shows.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// The line above the picture; none if empty.
    pub title: String,
    /// Whether keypoints are drawn.
    pub keypoints: bool,
    /// Whether a legend is drawn.
    pub legend: bool,
    /// Whether letters are text, or drawn as strokes that need no font.
    pub lettering: Lettering,
    /// What is drawn besides.
    pub draw: Vec<Extra>,
}

/// How letters are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lettering {
    /// As text elements.
    Text,
    /// As strokes.
    Strokes,
}

/// What a picture shows on request.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extra {
    /// The maximal disk of every keypoint.
    Disks,
    /// Lines from every keypoint to its footpoints.
    Footpoints,
    /// The cell of each governor, in a colour of its own.
    Cells,
    /// The zone of each governor along each path, coloured by the kind of governor.
    Zones,
    /// The governors, numbered as in the axis document while they are few.
    Governors,
}

impl Extra {
    /// All extras with their names in commands.
    pub const NAMES: [(&'static str, Self); 5] = [
        ("disks", Self::Disks),
        ("footpoints", Self::Footpoints),
        ("cells", Self::Cells),
        ("zones", Self::Zones),
        ("governors", Self::Governors),
    ];
}

impl Default for Options {
    fn default() -> Self {
        Self {
            title: String::new(),
            keypoints: true,
            legend: true,
            lettering: Lettering::Text,
            draw: Vec::new(),
        }
    }
}

/// The picture of all scenes.
#[must_use]
pub fn write(scenes: &[Scene], options: &Options) -> String {
    let frame = Frame::around(scenes, options);
    let mut canvas = Canvas::new(frame, options.lettering);
    let radius_max = scenes.iter().map(|s| s.axis.radius_max()).fold(0.0, f64::max);
    layers::domain(&mut canvas, scenes.iter().map(|scene| &scene.boundary));
    for extra in [Extra::Cells, Extra::Zones, Extra::Disks] {
        if options.draw.contains(&extra) {
            match extra {
                Extra::Cells => layers::cells(&mut canvas, scenes),
                Extra::Zones => layers::zones(&mut canvas, scenes),
                _ => layers::disks(&mut canvas, scenes),
            }
        }
    }
    layers::boundary(&mut canvas, scenes.iter().map(|scene| &scene.boundary));
    if options.draw.contains(&Extra::Footpoints) {
        layers::footpoints(&mut canvas, scenes);
    }
    if options.draw.contains(&Extra::Governors) {
        layers::governors(&mut canvas, scenes);
    }
    layers::axis(&mut canvas, scenes, radius_max);
    if options.keypoints {
        layers::keypoints(&mut canvas, scenes);
    }
    legend::draw(&mut canvas, scenes, options, radius_max);
    canvas.finish(&escaped(&options.title))
}

#[cfg(test)]
mod tests;
