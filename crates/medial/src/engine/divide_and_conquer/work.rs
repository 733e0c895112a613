/// What the merges of a run did, counted: a measure of work that no machine changes.
///
/// The paper merges in time proportional to the elements of both chains, so that n of them take
/// n log n steps in all [Lee82, §II].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Work {
    /// Pieces of merge curves that were followed, each between two elements.
    pub pieces: usize,
    /// Arcs around cells that were looked at to find where a piece ends.
    pub arcs: usize,
    /// Edges that were looked at to find where the curve around a ring starts.
    pub starts: usize,
}

impl Work {
    /// All of them together.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.pieces + self.arcs + self.starts
    }
}
