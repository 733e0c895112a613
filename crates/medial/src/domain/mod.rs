//! The shape: rings of doubles, validated once, as boundary walks with the interior on the left.

mod area;
mod assemble;
mod build;
mod components;
mod error;
#[cfg(feature = "geo-types")]
mod geo;
mod junction;
mod lines;
mod nesting;
mod report;
mod rings;
mod sites;
mod status;
mod sweep;
mod unit;
mod walks;

pub use build::Options;
pub use error::{DomainError, NestingFault, Place};
pub use report::{Entry, Repair, Report};
pub use walks::{Corner, CornerOrigin, Domain, Edge, Origin, Site, Walk};
