//! Outlines with curves, and their edges within a tolerance.
//!
//! # Contract
//! No point of a curve is farther from its edges than the tolerance, nor a point of the edges from the
//! curve. The ends of segments are the given doubles; points between them lie on the curve but for rounding.
//! Each curve is cut into pieces on which the curvature grows or falls and has one sign, and each edge knows
//! its piece.
//!
//! # Method
//! 1. Bézier curves, rational or not, are cut at the roots of the numerator of their curvature and of its
//!    derivative, found in Bernstein form; ellipses at their axes; arcs of circles not at all.
//! 2. A part whose distance to its chord is bounded by the tolerance becomes an edge. For Bézier curves the
//!    bound is a mean of the distances of control points, for ellipses and circles it is the distance itself.
//! 3. Others are cut into as many parts as the square root of the bound says, as it shrinks with the square
//!    of the length.

mod affine;
mod arc;
mod bernstein;
mod bezier;
mod fit;
mod nurbs;
mod pieces;

pub(crate) use affine::Affine;
pub(crate) use arc::Arc;
pub(crate) use bezier::Bezier;
pub(crate) use fit::Fit;
pub(crate) use nurbs::Nurbs;

use crate::path::RELATIVE_TOLERANCE;
use crate::{Error, Polygons};
use medial::domain::Curves;
use medial::geom::{Point, Rect};
use pieces::{Budget, Sink};

/// A line or curve of an outline; it begins where the one before ends.
#[derive(Clone, Debug)]
pub(crate) enum Segment {
    /// A straight line.
    Line(Point),
    /// A Bézier curve.
    Bezier(Bezier),
    /// An arc of a circle or an ellipse.
    Arc(Arc),
}

/// An outline: segments that follow one another.
#[derive(Clone, Debug)]
pub(crate) struct Contour {
    /// Where it begins.
    pub start: Point,
    /// What it is made of; it is closed by a straight line where it is open.
    pub segments: Vec<Segment>,
}

/// Largest coordinate of a curve: what is computed of it stays finite.
const MOST: f64 = 1e140;

/// Why an outline has no edges.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub(crate) enum CurveError {
    #[error(
        "its curves take more than {most} edges at a tolerance of {tolerance}; take a larger one with --tolerance"
    )]
    TooManyEdges { most: usize, tolerance: f64 },
    #[error("a coordinate of a curve is {value}, which is no number of at most 1e140; correct it")]
    Coordinate { value: f64 },
    #[error("a spline cannot be read: {why}; correct it or draw it as a polyline")]
    Spline { why: String },
}

impl From<CurveError> for Error {
    fn from(error: CurveError) -> Self {
        Self::Curve { why: error.to_string() }
    }
}

impl Segment {
    pub fn end(&self) -> Point {
        match self {
            Self::Line(to) => *to,
            Self::Bezier(curve) => curve.end(),
            Self::Arc(arc) => arc.end,
        }
    }

    /// What tells it from other segments between the same ends, in the same direction.
    pub fn between(&self) -> Vec<f64> {
        match self {
            Self::Line(_) => Vec::new(),
            Self::Bezier(curve) => curve.between().collect(),
            Self::Arc(arc) => {
                let points = [arc.centre, arc.u, arc.v];
                points.iter().flat_map(|p| [p.x, p.y]).chain([arc.sweep]).collect()
            }
        }
    }

    /// The segment after an affine map, `linear` for differences of points.
    pub fn map(&self, map: impl Fn(Point) -> Point, linear: impl Fn(Point) -> Point) -> Self {
        match self {
            Self::Line(to) => Self::Line(map(*to)),
            Self::Bezier(curve) => Self::Bezier(curve.map(map)),
            Self::Arc(arc) => Self::Arc(arc.map(map, linear)),
        }
    }
}

impl Contour {
    pub fn new(start: Point) -> Self {
        Self { start, segments: Vec::new() }
    }

    pub fn end(&self) -> Point {
        self.segments.last().map_or(self.start, Segment::end)
    }

    /// About as many bytes as it has as text.
    pub fn size(&self) -> usize {
        /// A curve has two or three points of two numbers, each of ten characters.
        const SEGMENT: usize = 60;
        SEGMENT * self.segments.len()
    }

    pub fn line_to(&mut self, to: Point) {
        self.segments.push(Segment::Line(to));
    }

    /// Adds a Bézier curve with these control points, and its end, behind its start.
    pub fn curve_to<const N: usize>(&mut self, points: [Point; N]) {
        let all: Vec<Point> = std::iter::once(self.end()).chain(points).collect();
        self.segments.push(Segment::Bezier(Bezier::new(&all)));
    }

    /// Adds an arc of a circle by the tangent of a quarter of its angle.
    pub fn bulge_to(&mut self, to: Point, bulge: f64) {
        let arc = Arc::bulge(self.end(), to, bulge);
        self.segments.push(arc.map_or(Segment::Line(to), Segment::Arc));
    }

    pub fn map(
        &self,
        map: impl Fn(Point) -> Point + Copy,
        linear: impl Fn(Point) -> Point + Copy,
    ) -> Self {
        Self {
            start: map(self.start),
            segments: self.segments.iter().map(|segment| segment.map(map, linear)).collect(),
        }
    }

    /// The same the other way round.
    pub fn reversed(&self) -> Self {
        let ends = self.segments.iter().rev().skip(1).map(Segment::end).chain([self.start]);
        let segment = |(segment, end): (&Segment, Point)| match segment {
            Segment::Line(_) => Segment::Line(end),
            Segment::Bezier(curve) => Segment::Bezier(curve.reversed()),
            Segment::Arc(arc) => Segment::Arc(arc.reversed()),
        };
        Self {
            start: self.end(),
            segments: self.segments.iter().rev().zip(ends).map(segment).collect(),
        }
    }

    /// Moves its start to a place very near.
    pub fn set_start(&mut self, start: Point) {
        self.start = start;
        match self.segments.first_mut() {
            Some(Segment::Bezier(curve)) => curve.set_ends(Some(start), None),
            Some(Segment::Arc(arc)) => arc.start = start,
            _ => {}
        }
    }

    /// Moves its end to a place very near.
    pub fn set_end(&mut self, end: Point) {
        match self.segments.last_mut() {
            Some(Segment::Line(to)) => *to = end,
            Some(Segment::Bezier(curve)) => curve.set_ends(None, Some(end)),
            Some(Segment::Arc(arc)) => arc.end = end,
            None => self.start = end,
        }
    }

    /// Points that span its box.
    pub fn extremes(&self) -> Vec<Point> {
        let mut extremes = vec![self.start];
        for segment in &self.segments {
            match segment {
                Segment::Line(to) => extremes.push(*to),
                Segment::Bezier(curve) => extremes.extend(curve.extremes()),
                Segment::Arc(arc) => extremes.extend(arc.extremes()),
            }
        }
        extremes
    }

    /// Fails if a coordinate of a curve is too large to compute with.
    fn check(&self) -> Result<(), CurveError> {
        let mut coordinates = Vec::new();
        for segment in &self.segments {
            match segment {
                Segment::Line(_) => {}
                Segment::Bezier(curve) => {
                    coordinates.extend(curve.hull().flat_map(|p| [p.x, p.y]));
                }
                Segment::Arc(arc) => {
                    let points = [arc.centre, arc.u, arc.v, arc.start, arc.end];
                    coordinates.extend(points.iter().flat_map(|p| [p.x, p.y]));
                    coordinates.extend([arc.from, arc.sweep]);
                }
            }
        }
        match coordinates.into_iter().find(|c| !(-MOST <= *c && *c <= MOST)) {
            Some(value) => Err(CurveError::Coordinate { value }),
            None => Ok(()),
        }
    }
}

/// The rings of polygons, with the pieces of curves, if there are any.
///
/// The tolerance is by default 1e-4 of the longer side of the box of all.
pub(crate) fn flatten(
    polygons: &[Vec<Contour>],
    tolerance: Option<f64>,
) -> Result<(Polygons, Option<Curves>), CurveError> {
    let contours = || polygons.iter().flatten();
    contours().try_for_each(Contour::check)?;
    let is_curved = |c: &Contour| c.segments.iter().any(|s| !matches!(s, Segment::Line(_)));
    if !contours().any(is_curved) {
        let ring = |contour: &Contour| {
            let mut pieces = Vec::new();
            let mut sink = Sink::new(contour.start, &mut pieces);
            contour.segments.iter().for_each(|segment| sink.line(segment.end()));
            sink.close().0
        };
        let rings = polygons.iter().map(|p| p.iter().map(ring).collect()).collect();
        return Ok((rings, None));
    }
    let tolerance = tolerance.unwrap_or_else(|| {
        let extremes = contours().flat_map(Contour::extremes);
        let bounds = extremes.fold(Rect::EMPTY, Rect::with);
        let size = bounds.max - bounds.min;
        RELATIVE_TOLERANCE * f64::max(size.x, size.y)
    });
    let mut curves = Curves { tolerance, ..Curves::default() };
    let mut rings = Vec::with_capacity(polygons.len());
    let mut budget = Budget::new(tolerance);
    for polygon in polygons {
        let mut points_of = Vec::new();
        let mut edges_of = Vec::new();
        for contour in polygon {
            let mut sink = Sink::new(contour.start, &mut curves.pieces);
            for segment in &contour.segments {
                match segment {
                    Segment::Line(to) => sink.line(*to),
                    Segment::Bezier(curve) => {
                        // Splines may have gaps.
                        sink.line(curve.start());
                        curve.flatten(&mut sink, &mut budget)?;
                    }
                    Segment::Arc(arc) => arc.flatten(&mut sink, &mut budget)?,
                }
            }
            let (points, edges) = sink.close();
            points_of.push(points);
            edges_of.push(edges);
        }
        rings.push(points_of);
        curves.edges.push(edges_of);
    }
    Ok((rings, Some(curves)))
}

fn distance_to_segment(p: Point, a: Point, b: Point) -> f64 {
    let way = b - a;
    let length2 = way.norm2();
    let t = if length2 > 0.0 { ((p - a).dot(way) / length2).clamp(0.0, 1.0) } else { 0.0 };
    (p - (a + way * t)).norm()
}

#[cfg(test)]
mod tests;
