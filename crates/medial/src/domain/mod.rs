//! The shape: rings of doubles, validated once, as boundary walks with the interior on the left.
//!
//! `rings` cleans and directs each ring by itself; `apart` shows that no edges meet, as is usual;
//! else `sweep` and `junction` find how they meet, and `assemble` links what is left into walks.
//! `nesting` tells outer rings from holes if asked to. `outlines` turns walks into a [`Domain`].
//! `complement` turns a domain inside out, and `horizon` tells what of it is seen from far away.
//! `repair` makes a domain of what is none as it stands, if asked to.
//! What was changed is in the [`Report`], and why a feature is refused in the [`DomainError`].

mod apart;
mod area;
mod assemble;
mod build;
mod complement;
mod components;
mod curves;
mod error;
#[cfg(feature = "geo-types")]
mod geo;
mod horizon;
mod junction;
mod lines;
mod nesting;
mod order;
mod origins;
mod outlines;
mod reduce;
mod repair;
mod report;
mod rings;
mod sites;
mod status;
mod sweep;
mod touches;
mod tree;
mod unit;
mod walks;

pub use build::Options;
pub use complement::Complement;
pub use curves::{Curves, FillRule, Piece, PieceEnd};
pub use error::{DomainError, NestingFault, Place};
pub use horizon::Horizon;
pub use origins::{CornerOrigin, Origin};
pub use report::{Entry, Repair, Report};
pub(crate) use tree::EdgeTree;
pub use walks::{Corner, Domain, Edge, Site, Walk};
