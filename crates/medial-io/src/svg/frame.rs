use super::{Options, Scene};
use medial::axis::Side;
use medial::geom::{Point, Rect};

/// Longer side of the drawn shapes, in pixels.
const SIDE: f64 = 1000.0;
/// Space around the drawing.
const MARGIN: f64 = 28.0;
/// Height of the title line.
const TITLE: f64 = 34.0;
/// Height of the legend.
const LEGEND: f64 = 64.0;
/// Least width, so that the legend fits below a slender shape.
const LEAST_WIDTH: f64 = 560.0;

/// Where the shapes lie on the picture, and how large its strokes are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    low: Point,
    scale: f64,
    /// Picture coordinates of the lower left corner of the shapes.
    origin: Point,
    /// Size of the picture.
    pub size: Point,
    /// Baseline of the title.
    pub title_y: f64,
    /// Top of the legend.
    pub legend_y: f64,
    /// Width of the strokes of the axis: thinner where much is drawn.
    pub stroke: f64,
}

impl Frame {
    pub fn around(scenes: &[Scene], options: &Options) -> Self {
        let boundary = scenes.iter().flat_map(|s| s.boundary.iter().flatten()).copied();
        // An axis inside lies within its boundary.
        let outside = scenes.iter().filter(|s| s.axis.side == Side::Exterior);
        let outside = outside.filter_map(|s| s.axis.bounds()).flat_map(|(low, high)| [low, high]);
        let n = scenes.iter().map(|s| s.axis.keypoints().len()).sum();
        Self::over(boundary.chain(outside), n, options)
    }

    /// The frame of shapes with these corners, on which so many points are drawn.
    pub fn over(corners: impl Iterator<Item = Point>, n: usize, options: &Options) -> Self {
        let bounds = corners.fold(Rect::EMPTY, Rect::with);
        let (low, high) = match bounds.min.x.is_finite() {
            true => (bounds.min, bounds.max),
            false => (Point::new(0.0, 0.0), Point::new(1.0, 1.0)),
        };
        let extent = high - low;
        let longer = extent.x.max(extent.y);
        let scale = if longer > 0.0 { SIDE / longer } else { 1.0 };
        let drawn = extent * scale;
        let title = if options.title.is_empty() { 0.0 } else { TITLE };
        let legend = if options.legend { LEGEND } else { 0.0 };
        let least = if options.legend || title > 0.0 { LEAST_WIDTH } else { 0.0 };
        let width = (drawn.x + 2.0 * MARGIN).max(least);
        let top = MARGIN + title;
        Self {
            low,
            scale,
            origin: Point::new(0.5 * (width - drawn.x), top + drawn.y),
            size: Point::new(width, top + drawn.y + MARGIN + legend),
            title_y: MARGIN + 10.0,
            legend_y: top + drawn.y + MARGIN,
            stroke: stroke(n, drawn),
        }
    }

    /// The frame of a plot: the plane is the picture, in pixels right of and above the origin of the axes, with
    /// so much room left of and below them, and above.
    pub fn plot(extent: Point, room: Point, above: f64, options: &Options) -> Self {
        let title = if options.title.is_empty() { 0.0 } else { TITLE };
        let legend = if options.legend { LEGEND } else { 0.0 };
        let (top, left) = (MARGIN + title + above, MARGIN + room.x);
        let legend_y = top + extent.y + room.y + MARGIN;
        Self {
            low: Point::new(0.0, 0.0),
            scale: 1.0,
            origin: Point::new(left, top + extent.y),
            size: Point::new(left + extent.x + MARGIN, legend_y + legend),
            title_y: MARGIN + 10.0,
            legend_y,
            stroke: 1.0,
        }
    }

    /// A point of the plane in picture coordinates, y down.
    pub fn map(&self, p: Point) -> Point {
        let p = (p - self.low) * self.scale;
        Point::new(self.origin.x + p.x, self.origin.y - p.y)
    }

    /// The same as the matrix of SVG: the picture coordinates of (x, y) are (a x + c y + e, b x + d y + f).
    pub fn matrix(&self) -> [f64; 6] {
        let Self { low, scale, origin, .. } = *self;
        [scale, 0.0, 0.0, -scale, origin.x - scale * low.x, origin.y + scale * low.y]
    }

    /// The point of the plane at picture coordinates.
    pub fn unmap(&self, p: Point) -> Point {
        let Self { low, scale, origin, .. } = *self;
        Point::new(low.x + (p.x - origin.x) / scale, low.y + (origin.y - p.y) / scale)
    }

    /// A length in picture units.
    pub fn length(&self, length: f64) -> f64 {
        length * self.scale
    }

    /// Left and right of what is not the drawing.
    pub fn margins(&self) -> (f64, f64) {
        (MARGIN, self.size.x - MARGIN)
    }
}

/// A tenth of the typical distance of keypoints, between 0.6 and 2.6 pixels.
fn stroke(n: usize, drawn: Point) -> f64 {
    let spacing = (drawn.x * drawn.y / n.max(1) as f64).sqrt();
    (0.1 * spacing).clamp(0.6, 2.6)
}
