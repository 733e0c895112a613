//! The shape: rings of doubles, validated once, as boundary walks with the interior on the left.

mod build;
mod error;
mod report;
mod sites;
mod walks;

pub use build::Options;
pub use error::{DomainError, NestingFault, Place};
pub use report::{Entry, Repair, Report};
pub use walks::{Corner, CornerOrigin, Domain, Edge, Origin, Site, Walk};
