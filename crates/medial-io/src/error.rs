use crate::{Format, Json};

/// Why a text could not be read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The text breaks the rules of its format.
    #[error("line {line}, column {column}: {why}")]
    Syntax {
        /// Line, from 1.
        line: usize,
        /// Column in bytes, from 1.
        column: usize,
        /// What is wrong there.
        why: String,
    },
    /// The bytes are no text.
    #[error("line {line}: the bytes are not UTF-8; save the file as UTF-8")]
    NotUtf8 {
        /// Line, from 1.
        line: usize,
    },
    /// Reading broke off.
    #[error("{source}")]
    Interrupted {
        /// What the system said.
        source: std::io::Error,
    },
    /// Nothing but white space.
    #[error("the input is empty")]
    Empty,
    /// The content is told neither by its type nor by its beginning.
    #[error("the content is of no known format; name it with --from")]
    Unknown,
    /// The format holds no polygons.
    #[error("the format {format} holds no polygons to read")]
    Unreadable {
        /// The format.
        format: Format,
    },
    /// A file is not of its format, or holds nothing to read.
    #[error("{why}")]
    File {
        /// What is wrong with it, and what to do.
        why: String,
    },
    /// The layer that is asked for is not there.
    #[error("{why}")]
    Layer {
        /// Which layers there are.
        why: String,
    },
    /// A value is well written but makes no sense.
    #[error("{place}: {why}")]
    Value {
        /// Where, in the terms of the format, such as `path 3`.
        place: String,
        /// What is wrong with it.
        why: String,
    },
    /// An axis document is well written but makes no sense.
    #[error("feature {feature}: {place}: {why}")]
    Document {
        /// The feature it speaks of.
        feature: usize,
        /// Where in the document, such as `path 3`.
        place: String,
        /// What is wrong with it.
        why: String,
    },
    /// Curves of a feature could not be flattened.
    #[error("{why}")]
    Curve {
        /// What is wrong with them, and what to do.
        why: String,
    },
    /// Lines of a drawing that are not closed.
    #[error("{what} is open; close it in the drawing, or leave it out")]
    OpenChain {
        /// What they are, and where they begin and end.
        what: String,
    },
    /// A text of a drawing for which there is no font.
    #[error("{what} has no font; name one with --font, or turn it into paths")]
    NoFont {
        /// Which text it is.
        what: String,
    },
    /// The picture could not be made.
    #[error("the picture cannot be drawn: {why}")]
    Picture {
        /// What the renderer said.
        why: String,
    },
}

impl Error {
    /// The word of a report for it: `malformed` if it is no other.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::OpenChain { .. } => "open_chain",
            Self::NoFont { .. } => "no_font",
            Self::Curve { .. } => "curve",
            _ => "malformed",
        }
    }

    /// The same in a text that is behind so many lines.
    pub(crate) fn after(self, lines: usize) -> Self {
        match self {
            Self::Syntax { line, column, why } => Self::Syntax { line: line + lines, column, why },
            Self::NotUtf8 { line } => Self::NotUtf8 { line: line + lines },
            other => other,
        }
    }
}

/// One feature that could not be read; the others still can.
#[derive(Debug, thiserror::Error)]
#[error("{error}")]
pub struct FeatureError {
    /// Number of the feature in the input, from 0.
    pub feature: usize,
    /// Its identifier, as far as it could be read.
    pub id: Option<Json>,
    /// What is wrong.
    #[source]
    pub error: Error,
}
