use std::fmt;

use crate::geom::Point;

/// A place in the input.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Place {
    /// Polygon of the feature, from 0.
    pub polygon: u32,
    /// Ring of the polygon, from 0; 0 is the outer ring.
    pub ring: u32,
    /// Position in the ring as given, of a vertex or of the first vertex of an edge.
    pub index: u32,
    /// Whether the feature has this polygon only; then messages do not name it.
    pub lone: bool,
}

/// Why a feature is not a valid domain: where, what, and what to do about it.
///
/// Numbers count from 0, as in the input.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DomainError {
    /// `not_finite`: a coordinate is not a number, or infinite.
    #[error("{}: coordinate ({x}, {y}) is not finite; remove the vertex", .at.vertex())]
    NotFinite {
        /// The vertex.
        at: Place,
        /// Its abscissa.
        x: f64,
        /// Its ordinate.
        y: f64,
    },
    /// `exponent_out_of_range`: a coordinate other than 0 is not between 2^-200 and 2^200.
    #[error(
        "{}: coordinate ({x:e}, {y:e}) is outside 2^-200 to 2^200; scale the input by a power of two",
        .at.vertex()
    )]
    ExponentOutOfRange {
        /// The vertex.
        at: Place,
        /// Its abscissa.
        x: f64,
        /// Its ordinate.
        y: f64,
    },
    /// `empty`: no polygon, a polygon without rings, or nothing left of it.
    #[error("{}: encloses no area; leave it out", .at.polygon_name())]
    Empty {
        /// The polygon.
        at: Place,
    },
    /// `too_few_points`: a ring has fewer than three distinct points.
    #[error("{}: has only {found} distinct points; remove the ring", .at.ring_name())]
    TooFewPoints {
        /// The ring.
        at: Place,
        /// Number of distinct points.
        found: u32,
    },
    /// `collinear`: the points of a ring lie on one line, or it runs back on itself all the way.
    #[error("{}: all on one line, or back on itself all the way; remove the ring", .at.ring_name())]
    Collinear {
        /// The ring.
        at: Place,
    },
    /// `spike`, strict only: a ring runs there and back on one line.
    #[error("{}: tip of a spike; remove the vertex", .at.vertex())]
    Spike {
        /// The tip.
        at: Place,
    },
    /// `crossing`: two edges cross, or two rings at a common corner.
    #[error("{}: crosses {} at {}; repair the polygon", .first.edge(), .second.edge(), Shown(*.at))]
    Crossing {
        /// One edge.
        first: Place,
        /// The other edge.
        second: Place,
        /// Where they cross, rounded.
        at: Point,
    },
    /// `overlap`: two edges of one polygon lie partly on each other, or run the same way.
    #[error("{}: lies partly on {} near {}; repair the polygon", .first.edge(), .second.edge(), Shown(*.at))]
    Overlap {
        /// One edge.
        first: Place,
        /// The other edge.
        second: Place,
        /// Where the overlap starts.
        at: Point,
    },
    /// `bad_nesting`: a ring is not where its role wants it.
    #[error("{}: {fault} {}; reorder the rings or regroup them by depth", .ring.ring_name(), .other.ring_name())]
    BadNesting {
        /// The ring.
        ring: Place,
        /// What is wrong.
        fault: NestingFault,
        /// The ring it should be in, or should not be in.
        other: Place,
    },
    /// `polygons_overlap`: two polygons of the feature overlap, or one lies in the other.
    #[error("{}: overlaps {} near {}; dissolve the polygons first", .first.polygon_name(), .second.polygon_name(), Shown(*.at))]
    PolygonsOverlap {
        /// An edge of one polygon.
        first: Place,
        /// An edge of the other.
        second: Place,
        /// A corner where it shows.
        at: Point,
    },
    /// `self_touch`, strict only: a ring passes a point twice.
    #[error("{}: touched again by {} at {}; split the ring", .first.edge(), .second.edge(), Shown(*.at))]
    SelfTouch {
        /// Edge at the point.
        first: Place,
        /// Other edge at the point.
        second: Place,
        /// The point.
        at: Point,
    },
    /// `bridge`, strict only: an edge is run through both ways.
    #[error("{}: runs back on {}; cut the ring there", .first.edge(), .second.edge())]
    Bridge {
        /// One edge.
        first: Place,
        /// The other edge.
        second: Place,
    },
    /// `cut_interior`, strict only: touching rings cut the interior of a polygon.
    #[error("{}: touching rings cut it into {parts} parts; split the polygon", .at.polygon_name())]
    CutInterior {
        /// The polygon.
        at: Place,
        /// Number of connected parts.
        parts: u32,
    },
    /// `shared_edge`, strict only: polygons of the feature touch along an edge.
    #[error("{}: shares a boundary with {} near {}; dissolve the polygons first", .first.edge(), .second.edge(), Shown(*.at))]
    SharedEdge {
        /// Edge of one polygon.
        first: Place,
        /// Edge of the other.
        second: Place,
        /// Where they start to touch.
        at: Point,
    },
    /// `too_large`: more vertices than can be numbered.
    #[error("polygon has {found} vertices, more than 2^30; divide it")]
    TooLarge {
        /// Number of vertices.
        found: usize,
    },
    /// `time_limit`: the repair was not done in time.
    #[error("the time was up before the polygon was repaired; allow more, or divide it")]
    TimeLimit,
    /// `internal`: our fault.
    #[error("internal error in {stage}; please report it with the input")]
    Internal {
        /// What was being done.
        stage: &'static str,
    },
}

/// How a ring and another one are wrongly nested; `Display` reads between their names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum NestingFault {
    /// A hole lies outside the outer ring.
    HoleOutside,
    /// A hole lies inside another hole.
    HoleInHole,
    /// The outer ring lies inside one of its holes.
    OuterInHole,
    /// Rings touch so that the interior is on both sides, or on none.
    Sides,
}

impl fmt::Display for NestingFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::HoleOutside => "a hole outside",
            Self::HoleInHole => "a hole inside the hole",
            Self::OuterInHole => "an outer ring inside its hole",
            Self::Sides => "has the interior on the wrong side, seen from",
        })
    }
}

impl DomainError {
    /// All reason codes.
    pub const CODES: [&str; 17] = [
        "not_finite",
        "exponent_out_of_range",
        "empty",
        "too_few_points",
        "collinear",
        "spike",
        "crossing",
        "overlap",
        "bad_nesting",
        "polygons_overlap",
        "self_touch",
        "bridge",
        "cut_interior",
        "shared_edge",
        "too_large",
        "time_limit",
        "internal",
    ];

    /// The reason code, one of [`CODES`](Self::CODES).
    #[must_use]
    pub const fn code(&self) -> &'static str {
        match self {
            Self::NotFinite { .. } => "not_finite",
            Self::ExponentOutOfRange { .. } => "exponent_out_of_range",
            Self::Empty { .. } => "empty",
            Self::TooFewPoints { .. } => "too_few_points",
            Self::Collinear { .. } => "collinear",
            Self::Spike { .. } => "spike",
            Self::Crossing { .. } => "crossing",
            Self::Overlap { .. } => "overlap",
            Self::BadNesting { .. } => "bad_nesting",
            Self::PolygonsOverlap { .. } => "polygons_overlap",
            Self::SelfTouch { .. } => "self_touch",
            Self::Bridge { .. } => "bridge",
            Self::CutInterior { .. } => "cut_interior",
            Self::SharedEdge { .. } => "shared_edge",
            Self::TooLarge { .. } => "too_large",
            Self::TimeLimit => "time_limit",
            Self::Internal { .. } => "internal",
        }
    }

    /// Whether a repair may help.
    pub(super) const fn is_reparable(&self) -> bool {
        !matches!(
            self,
            Self::NotFinite { .. }
                | Self::ExponentOutOfRange { .. }
                | Self::TooLarge { .. }
                | Self::TimeLimit
        )
    }

    /// The place it is about, or the first of two; its ring and index only mean something if
    /// [`ring`](Self::ring) and [`index`](Self::index) say so.
    #[must_use]
    pub const fn place(&self) -> Option<Place> {
        match *self {
            Self::NotFinite { at, .. }
            | Self::ExponentOutOfRange { at, .. }
            | Self::Empty { at }
            | Self::TooFewPoints { at, .. }
            | Self::Collinear { at }
            | Self::Spike { at }
            | Self::CutInterior { at, .. } => Some(at),
            Self::Crossing { first, .. }
            | Self::Overlap { first, .. }
            | Self::PolygonsOverlap { first, .. }
            | Self::SelfTouch { first, .. }
            | Self::Bridge { first, .. }
            | Self::SharedEdge { first, .. } => Some(first),
            Self::BadNesting { ring, .. } => Some(ring),
            Self::TooLarge { .. } | Self::TimeLimit | Self::Internal { .. } => None,
        }
    }

    /// The second of two places.
    #[must_use]
    pub const fn other_place(&self) -> Option<Place> {
        match *self {
            Self::Crossing { second, .. }
            | Self::Overlap { second, .. }
            | Self::PolygonsOverlap { second, .. }
            | Self::SelfTouch { second, .. }
            | Self::Bridge { second, .. }
            | Self::SharedEdge { second, .. } => Some(second),
            Self::BadNesting { other, .. } => Some(other),
            _ => None,
        }
    }

    /// The point of the plane where it shows, if it is about one.
    #[must_use]
    pub const fn point(&self) -> Option<Point> {
        match *self {
            Self::Crossing { at, .. }
            | Self::Overlap { at, .. }
            | Self::PolygonsOverlap { at, .. }
            | Self::SelfTouch { at, .. }
            | Self::SharedEdge { at, .. } => Some(at),
            _ => None,
        }
    }

    /// Polygon of the feature, from 0.
    #[must_use]
    pub fn polygon(&self) -> Option<u32> {
        self.place().map(|p| p.polygon)
    }

    /// Ring of that polygon, from 0, if it is about one.
    #[must_use]
    pub fn ring(&self) -> Option<u32> {
        match self {
            Self::Empty { .. } | Self::CutInterior { .. } | Self::PolygonsOverlap { .. } => None,
            _ => self.place().map(|p| p.ring),
        }
    }

    /// Position in that ring as given, of the vertex or the first vertex of the edge, if it is
    /// about one.
    #[must_use]
    pub fn index(&self) -> Option<u32> {
        match self {
            Self::TooFewPoints { .. } | Self::Collinear { .. } | Self::BadNesting { .. } => None,
            _ => self.ring().and(self.place()).map(|p| p.index),
        }
    }
}

impl Place {
    fn polygon_name(self) -> impl fmt::Display {
        Name { place: self, depth: 0, last: "" }
    }

    fn ring_name(self) -> impl fmt::Display {
        Name { place: self, depth: 1, last: "" }
    }

    fn vertex(self) -> impl fmt::Display {
        Name { place: self, depth: 2, last: "vertex" }
    }

    fn edge(self) -> impl fmt::Display {
        Name { place: self, depth: 2, last: "edge" }
    }
}

struct Name {
    place: Place,
    depth: u8,
    last: &'static str,
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Place { polygon, ring, index, lone } = self.place;
        if self.depth == 0 || !lone {
            write!(f, "polygon {polygon}")?;
        }
        if self.depth >= 1 {
            write!(f, "{}ring {ring}", if lone { "" } else { ", " })?;
        }
        if self.depth >= 2 {
            write!(f, ", {} {index}", self.last)?;
        }
        Ok(())
    }
}

struct Shown(Point);

impl fmt::Display for Shown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({}, {})", self.0.x, self.0.y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_error_has_its_own_code_and_says_what_to_do() {
        let place = |ring, index| Place { polygon: 0, ring, index, lone: true };
        let (at, first, second) = (place(1, 4), place(0, 2), place(1, 3));
        let point = Point::new(0.5, 2.0);
        let all = [
            DomainError::NotFinite { at, x: f64::NAN, y: 0.0 },
            DomainError::ExponentOutOfRange { at, x: 1e300, y: 0.0 },
            DomainError::Empty { at },
            DomainError::TooFewPoints { at, found: 2 },
            DomainError::Collinear { at },
            DomainError::Spike { at },
            DomainError::Crossing { first, second, at: point },
            DomainError::Overlap { first, second, at: point },
            DomainError::BadNesting { ring: at, fault: NestingFault::HoleOutside, other: first },
            DomainError::PolygonsOverlap { first, second, at: point },
            DomainError::SelfTouch { first, second, at: point },
            DomainError::Bridge { first, second },
            DomainError::CutInterior { at, parts: 2 },
            DomainError::SharedEdge { first, second, at: point },
            DomainError::TooLarge { found: 1 << 31 },
            DomainError::TimeLimit,
            DomainError::Internal { stage: "sweep" },
        ];
        assert_eq!(all.map(|e| e.code()), DomainError::CODES);
        for error in all {
            let message = error.to_string();
            assert!(message.contains("; ") && !message.ends_with('.'), "{message}");
            let named = message.contains(", vertex ") || message.contains(", edge ");
            assert_eq!(error.index().is_some(), named, "{message}");
        }
    }
}
