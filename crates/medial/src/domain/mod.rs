//! The shape: rings of doubles, validated once, as boundary walks with the interior on the left.
//!
//! `rings` cleans and directs each ring by itself; `sweep` and `junction` find how edges meet;
//! `nesting` tells outer rings from holes if asked to; `assemble` links what is left into walks,
//! which `walks` turns into a [`Domain`]. What was changed is in the [`Report`], and why a feature
//! is refused in the [`DomainError`].

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
mod order;
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
