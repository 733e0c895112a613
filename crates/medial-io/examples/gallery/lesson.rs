use crate::shape::Fallible;

/// A figure with what it teaches.
pub struct Lesson {
    /// A few words.
    pub title: &'static str,
    /// Two or three sentences, one a line.
    pub text: &'static str,
    /// Draws the figure.
    pub draw: fn() -> Fallible<String>,
}
