use crate::axis::Side;
use crate::check::Name;
use crate::geom::Point;

/// Why there is no diagram, or no answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum VoronoiError {
    /// Cells need every path, exactly.
    #[error("the {side} axis is pruned or sampled; only a complete exact axis bounds cells")]
    Incomplete {
        /// Its side.
        side: Side,
    },
    /// A side can have one axis only.
    #[error("there are two axes of the {side}")]
    Repeated {
        /// The side.
        side: Side,
    },
    /// The exterior axis was cut elsewhere.
    #[error("the exterior axis is not cut at the frame that closes its cells")]
    Frame,
    /// The axis is of another domain.
    #[error("the {side} axis names {name}, which the domain does not have")]
    UnknownSite {
        /// The side of the axis.
        side: Side,
        /// What it names.
        name: Name,
    },
    /// The axis has defects.
    #[error("the paths around {name} do not close its cell; check the axis")]
    Open {
        /// The element.
        name: Name,
    },
    /// The point cannot be located.
    #[error("({}, {}) has a coordinate that is not finite, or too large or small", point.x, point.y)]
    Coordinates {
        /// The point.
        point: Point,
    },
}
