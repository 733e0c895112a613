use crate::axis::Engine;
use crate::geom::Point;
use crate::raster::DigitiseError;

/// Why an engine gave no axis.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EngineError {
    /// An invariant of the engine broke: a fault of ours, never of the input.
    #[error(
        "internal error while {stage} near ({}, {}); please report it with this shape",
        place.x, place.y
    )]
    Internal {
        /// What the engine was doing.
        stage: &'static str,
        /// Where.
        place: Point,
    },
    /// The domain has too many edges for 32-bit numbers.
    #[error("{n_edges} edges are too many; split the feature")]
    TooLarge {
        /// Edges of the domain.
        n_edges: usize,
    },
    /// The frame of an exterior axis does not lie around the polygons, or not within the numbers.
    #[error(
        "a frame {margin:?} away from the polygons cannot be computed with; give a margin that is positive, no less than the rounding of their coordinates, and below 2^200"
    )]
    Frame {
        /// How far the box of the polygons was to grow.
        margin: f64,
    },
    /// The domain cannot be put into cells of that size.
    #[error(transparent)]
    Cells(#[from] DigitiseError),
    /// The boundary cannot be sampled at that distance.
    #[error("samples {spacing} apart are none; give a distance above 0")]
    Spacing {
        /// The distance between samples.
        spacing: f64,
    },
    /// There would be too many samples.
    #[error(
        "samples {spacing} apart are {samples:.0}, and at most 100 million can be; give a larger distance"
    )]
    Samples {
        /// How many there would be.
        samples: f64,
        /// The distance between them.
        spacing: f64,
    },
    /// The boundary is nearer to itself than rounded samples are to it.
    #[error(
        "near ({}, {}) the boundary is nearer to itself than doubles can tell samples apart; use path_tracing, or a smaller spacing, or smooth less",
        place.x, place.y
    )]
    Crowded {
        /// Where.
        place: Point,
    },
    /// The engine has no axis of the outside.
    #[error("{engine} finds no axis outside of polygons; use path_tracing")]
    NoExterior {
        /// The engine that was asked.
        engine: Engine,
    },
    /// The engine takes polygons only.
    #[error("{engine} takes polygons, no mask; give it the outline of the mask")]
    NoMask {
        /// The engine that was asked.
        engine: Engine,
    },
    /// Another thread set the flag that cancels.
    #[error("cancelled")]
    Cancelled,
    /// The deadline has passed.
    #[error("not done within the time limit")]
    TimeLimit,
}
