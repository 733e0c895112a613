//! Lines as polylines, smoothed and simplified within a tolerance.
//!
//! # Contract
//! No point of the polyline is farther from the line, and no point of the line farther from the polyline,
//! than the tolerances together: of smoothing, of simplifying, or of drawing if neither is asked for. What
//! is smoothed or simplified stays inside: no segment crosses or touches the boundary but at the ends of the
//! line, and at points given outside. It passes each hole on the same side. Each point comes with its distance from the boundary, which is
//! measured there, not between other points.
//!
//! # Method
//! 1. The line is drawn with a sixteenth of the tolerance, and finer until that is inside.
//! 2. To be smooth, it is simplified within half of what is left, and corners are rounded within the other
//!    half (`smooth.rs`).
//! 3. To have few points, it is simplified (`simplify.rs`).

use super::line::Centerline;
use super::simplify::kept;
use super::smooth::rounded;
use super::wall::Wall;
use crate::domain::Domain;
use crate::geom::Point;

/// How lines become polylines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineOptions {
    /// Largest distance between a curve and the polyline drawn for it, in units of the input.
    pub tolerance: f64,
    /// Largest distance between the line and a smooth one that is taken for it, in units of the input; it
    /// has no corners but where the boundary leaves no room for a curve.
    pub smooth: Option<f64>,
    /// Largest distance by which the polyline may be off to have fewer points, in units of the input; after
    /// smoothing both add up.
    pub simplify: Option<f64>,
}

/// What of a tolerance is used up by drawing.
const DRAWN: f64 = 1.0 / 16.0;

/// How often a line is drawn four times as finely, until no chord leaves the domain.
const TRIES: u32 = 8;

/// The points of each line of a domain, with their distances from the boundary; 0 outside.
///
/// ```
/// use medial::domain::{Domain, Options};
/// use medial::engine::path_tracing;
/// use medial::geom::Point;
/// use medial::ops::{CenterlineOptions, LineOptions, centerlines, polylines};
///
/// // An L with arms of width 2: its line has two quarters of parabolas, and simplified a single corner.
/// let ring = [(0., 0.), (10., 0.), (10., 2.), (2., 2.), (2., 8.), (0., 8.)];
/// let ring = ring.map(|(x, y)| Point::new(x, y)).to_vec();
/// let domain = Domain::from_polygons(&[vec![ring]], &Options::default())?;
/// let lines = centerlines(&domain, &path_tracing(&domain)?, &CenterlineOptions::default())?;
/// let exact = LineOptions { tolerance: 1e-3, smooth: None, simplify: None };
/// assert!(polylines(&domain, &lines, &exact)[0].len() > 9);
/// let simple = polylines(&domain, &lines, &LineOptions { simplify: Some(0.5), ..exact });
/// assert_eq!(simple[0].len(), 3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn polylines(
    domain: &Domain,
    lines: &[Centerline],
    options: &LineOptions,
) -> Vec<Vec<(Point, f64)>> {
    let LineOptions { tolerance, smooth, simplify } = *options;
    let Some(least) = smooth.into_iter().chain(simplify).reduce(f64::min) else {
        return lines.iter().map(|line| line.polyline(tolerance)).collect();
    };
    let wall = Wall::new(domain);
    let tolerance = tolerance.min(DRAWN * least);
    let polyline = |line: &Centerline| {
        let mut points = drawn(&wall, line, tolerance);
        if let Some(room) = smooth {
            if line.is_closed() {
                points = begun_on_a_segment(&wall, &points);
            }
            let half = 0.5 * (room - 2.0 * tolerance);
            points = rounded_within(&wall, simplified(&wall, points, half), half, tolerance);
        }
        match simplify {
            Some(room) => simplified(&wall, points, room - tolerance),
            None => points,
        }
    };
    lines.iter().map(polyline).collect()
}

/// A line drawn finely enough to stay inside, where it does not go on straight.
fn drawn(wall: &Wall, line: &Centerline, tolerance: f64) -> Vec<(Point, f64)> {
    let mut tolerance = tolerance;
    let [before, after] = line.extensions.map(|extension| usize::from(extension.is_some()));
    let is_clear = |points: &[(Point, f64)]| {
        let inside = &points[before..points.len() - after];
        inside.windows(2).all(|pair| wall.is_clear(pair[0].0, pair[1].0))
    };
    let mut points = line.polyline(tolerance);
    for _ in 0..TRIES {
        if is_clear(&points) {
            break;
        }
        tolerance *= 0.25;
        points = line.polyline(tolerance);
    }
    points
}

/// A closed line from the middle of its first segment on.
fn begun_on_a_segment(wall: &Wall, points: &[(Point, f64)]) -> Vec<(Point, f64)> {
    let [(a, _), (b, _), ..] = *points else { return points.to_vec() };
    let middle = (a + b) * 0.5;
    let middle = (middle, wall.distance(middle));
    let mut begun = vec![middle];
    begun.extend(&points[1..]);
    begun.push(middle);
    begun
}

fn simplified(wall: &Wall, points: Vec<(Point, f64)>, tolerance: f64) -> Vec<(Point, f64)> {
    let positions: Vec<Point> = points.iter().map(|point| point.0).collect();
    let kept = kept(&positions, tolerance, |old, new| wall.lets_move(old, &new));
    kept.into_iter().map(|k| points[k]).collect()
}

fn rounded_within(
    wall: &Wall,
    points: Vec<(Point, f64)>,
    tolerance: f64,
    drawn: f64,
) -> Vec<(Point, f64)> {
    let positions: Vec<Point> = points.iter().map(|point| point.0).collect();
    let rounded = rounded(&positions, tolerance, drawn, |old, new| wall.lets_move(old, new));
    let measured = |(p, given): (Point, Option<usize>)| match given {
        Some(k) => points[k],
        None => (p, wall.distance(p)),
    };
    rounded.into_iter().map(measured).collect()
}
