//! Formats for the medial axis toolkit.
