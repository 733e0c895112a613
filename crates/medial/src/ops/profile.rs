//! The width of a shape along a line.
//!
//! # Contract
//! Stations lie at every keypoint of the line, where the width is least on a path, and between them. The
//! width as a function of the length along the line is nowhere farther from the chord between two
//! neighbouring stations than the tolerance, and neither is the line from the polyline through them; but
//! for rounding, and unless a path would need more than 65536 of them. Where the line goes on straight
//! beyond the axis, the width is told at the ends only, and nothing is promised in between.
//!
//! # Method
//! Each path is cut where its radius is least, which leaves pieces along which it is monotone, convex in the
//! length and convex in the natural parameter `x`. So is the length in `x`, on the way to greater radii. At one
//! place the chord over the length is therefore between the radius and the chord over `x`, which is as far
//! from it as [`Curve::polyline_in_space`] allows: half of the tolerance, as the width is twice the radius.

use super::centerline::Centerline;
use crate::axis::Curve;
use crate::geom::Point;

/// A place on a line with the width there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Station {
    /// How far it is from the start of the line, along it, in units of the input.
    pub along: f64,
    /// Where it is.
    pub point: Point,
    /// Twice the distance of the boundary; 0 on the boundary, and beyond it.
    pub width: f64,
}

/// The width along a line, in the order of the line, within a tolerance in units of the input; extensions are
/// a part of the line.
///
/// ```
/// use medial::domain::{Domain, Options};
/// use medial::engine::path_tracing;
/// use medial::geom::Point;
/// use medial::ops::{CenterlineOptions, Extension, centerlines, profile};
///
/// // Through a rectangle, and on to its sides.
/// let ring = [(0., 0.), (6., 0.), (6., 2.), (0., 2.)].map(|(x, y)| Point::new(x, y));
/// let domain = Domain::from_polygons(&[vec![ring.to_vec()]], &Options::default())?;
/// let options = CenterlineOptions { extension: Extension::Boundary, ..CenterlineOptions::default() };
/// let lines = centerlines(&domain, &path_tracing(&domain)?, &options)?;
/// let stations = profile(&lines[0], 0.01);
/// let widths: Vec<f64> = stations.iter().map(|station| station.width).collect();
/// assert_eq!(widths, [0.0, 2.0, 2.0, 0.0]);
/// assert_eq!((stations[0].along, stations[3].along), (0.0, 6.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[must_use]
pub fn profile(line: &Centerline, tolerance: f64) -> Vec<Station> {
    let [before, after] = line.extensions;
    let mut stations = Vec::new();
    let mut along = 0.0;
    let station =
        |along, (point, radius): (Point, f64)| Station { along, point, width: 2.0 * radius };
    if let Some((start, first)) = before.zip(line.curves.first()) {
        stations.push(station(along, start));
        along += (start.0 - first.from()).norm();
    }
    for (number, curve) in line.curves.iter().enumerate() {
        for (k, piece) in monotone(curve).into_iter().flatten().enumerate() {
            let points = piece.polyline_in_space(0.5 * tolerance);
            let parts = (points.len() - 1) as f64;
            // What comes before has the first point already.
            let first = usize::from(number + k > 0);
            stations.extend(points.into_iter().enumerate().skip(first).map(|(k, place)| {
                let length = piece.piece(0.0, k as f64 / parts).length();
                station(along + length, place)
            }));
            along += piece.length();
        }
    }
    if let Some((end, last)) = after.zip(line.curves.last()) {
        along += (end.0 - last.to()).norm();
        stations.push(station(along, end));
    }
    stations
}

/// A curve in pieces along which its radius is monotone.
fn monotone(curve: &Curve) -> [Option<Curve>; 2] {
    match curve.neck() {
        Some(neck) => [Some(curve.piece(0.0, neck)), Some(curve.piece(neck, 1.0))],
        None => [Some(*curve), None],
    }
}

/// The number of the narrowest of the stations on both sides of which there are wider ones, the first of
/// several; `None` where the width does not fall and grow again, as in a rectangle. On a line that ends where
/// it starts both sides are the rest of it.
///
/// A line may end in a corner, where the width is 0, or where the shape is about to end; that is not meant.
///
/// ```
/// use medial::geom::Point;
/// use medial::ops::{Station, narrowest};
/// let stations = |widths: &[f64]| -> Vec<Station> {
///     let all = (0..).map(f64::from).zip(widths);
///     all.map(|(along, &width)| Station { along, point: Point::new(along, 0.0), width }).collect()
/// };
/// assert_eq!(narrowest(&stations(&[0.0, 4.0, 2.0, 3.0, 1.0])), Some(2));
/// assert_eq!(narrowest(&stations(&[0.0, 4.0, 4.0, 0.0])), None);
/// ```
#[must_use]
pub fn narrowest(stations: &[Station]) -> Option<usize> {
    let [first, .., last] = stations else { return None };
    // Two ends of the axis may share a corner.
    let is_closed = first.point == last.point && first.width > 0.0;
    let widest = stations.iter().map(|station| station.width).fold(0.0, f64::max);
    let beyond = if is_closed { widest } else { 0.0 };
    let passed = |most: &mut f64, station: &Station| {
        let before = *most;
        *most = most.max(station.width);
        Some(before)
    };
    let before = stations.iter().scan(beyond, passed);
    let after: Vec<f64> = stations.iter().rev().scan(beyond, passed).collect();
    let inside = stations.iter().zip(before).zip(after.iter().rev()).enumerate();
    inside
        .filter(|(_, ((station, before), after))| station.width < before.min(**after))
        .min_by(|(_, ((one, _), _)), (_, ((other, _), _))| one.width.total_cmp(&other.width))
        .map(|(number, _)| number)
}
