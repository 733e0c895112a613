//! The engines: each turns a [`Domain`](crate::domain::Domain) into a
//! [`MedialAxis`](crate::axis::MedialAxis).

mod error;
mod path_tracing;

pub use error::EngineError;
pub use path_tracing::{Candidate, Step, Steps, path_tracing, path_tracing_steps};
