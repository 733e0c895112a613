//! The edge algebra of Guibas and Stolfi [GS85, §2], on numbers instead of pointers.

/// A directed edge, of the subdivision or of its dual: four times the number of an undirected one, plus how many
/// quarter turns it is away from it.
pub type EdgeId = u32;

/// The edges of a subdivision with those of its dual. 32 bytes an undirected edge.
#[derive(Clone, Debug, Default)]
pub(super) struct QuadEdges {
    quads: Vec<Quad>,
}

/// An undirected edge: its two directions, and those of its dual between them.
#[derive(Clone, Copy, Debug)]
struct Quad {
    /// The next edge counterclockwise with the same origin.
    next: [EdgeId; 4],
    /// Vertices for edges, faces for dual ones.
    origin: [u32; 4],
}

/// The edge turned by a quarter to the left: from the face on the right to the one on the left.
#[inline(always)]
pub(super) const fn rot(edge: EdgeId) -> EdgeId {
    (edge & !3) | ((edge + 1) & 3)
}

/// The edge the other way round.
#[inline(always)]
pub(super) const fn sym(edge: EdgeId) -> EdgeId {
    edge ^ 2
}

/// The edge turned by a quarter to the right: from the face on the left to the one on the right.
#[inline(always)]
pub(super) const fn inverse_rot(edge: EdgeId) -> EdgeId {
    (edge & !3) | ((edge + 3) & 3)
}

impl QuadEdges {
    pub fn with_room(edges: usize) -> Self {
        Self { quads: Vec::with_capacity(edges) }
    }

    /// How many undirected edges there are.
    #[inline]
    pub fn len(&self) -> u32 {
        self.quads.len() as u32
    }

    /// A new edge between two vertices, in no face yet.
    #[inline]
    pub fn push(&mut self, from: u32, to: u32) -> EdgeId {
        let edge = 4 * self.len();
        let next = [edge, edge + 3, edge + 2, edge + 1];
        self.quads.push(Quad { next, origin: [from, u32::MAX, to, u32::MAX] });
        edge
    }

    /// `Onext`: the next edge counterclockwise with the same origin.
    #[inline(always)]
    pub fn next(&self, edge: EdgeId) -> EdgeId {
        self.quads[edge as usize >> 2].next[edge as usize & 3]
    }

    /// `Lnext`: the next edge along the face to the left.
    #[inline(always)]
    pub fn left_next(&self, edge: EdgeId) -> EdgeId {
        rot(self.next(inverse_rot(edge)))
    }

    #[inline(always)]
    pub fn origin(&self, edge: EdgeId) -> u32 {
        self.quads[edge as usize >> 2].origin[edge as usize & 3]
    }

    #[inline(always)]
    pub fn target(&self, edge: EdgeId) -> u32 {
        self.origin(sym(edge))
    }

    /// The face to the left, once it is numbered.
    #[inline(always)]
    pub fn left(&self, edge: EdgeId) -> u32 {
        self.origin(inverse_rot(edge))
    }

    #[inline(always)]
    pub fn set_origin(&mut self, edge: EdgeId, vertex: u32) {
        self.quads[edge as usize >> 2].origin[edge as usize & 3] = vertex;
    }

    #[inline(always)]
    fn set_next(&mut self, edge: EdgeId, next: EdgeId) {
        self.quads[edge as usize >> 2].next[edge as usize & 3] = next;
    }

    /// Makes three edges, each of which ends where the next one starts, a face to their left.
    ///
    /// What the splices of [GS85, §4] come to where all faces are triangles.
    #[inline(always)]
    pub fn make_triangle(&mut self, a: EdgeId, b: EdgeId, c: EdgeId) {
        for (edge, next) in [(a, b), (b, c), (c, a)] {
            self.set_next(inverse_rot(edge), inverse_rot(next));
            self.set_next(next, sym(edge));
        }
    }

    /// Turns the diagonal of the two triangles beside an edge: it then goes from the apex on its right to the one
    /// on its left.
    #[inline(always)]
    pub fn flip(&mut self, edge: EdgeId) {
        let back = sym(edge);
        let (left, right) = (self.left_next(edge), self.left_next(back));
        let (left_last, right_last) = (self.left_next(left), self.left_next(right));
        self.set_origin(edge, self.origin(right_last));
        self.set_origin(back, self.origin(left_last));
        self.make_triangle(edge, left_last, right);
        self.make_triangle(back, right_last, left);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two triangles 0 1 2 and 1 0 3 beside the edge from 0 to 1.
    fn two() -> (QuadEdges, EdgeId) {
        let mut edges = QuadEdges::default();
        let [a, b, c] = [(0, 1), (1, 2), (2, 0)].map(|(from, to)| edges.push(from, to));
        let [d, e] = [(0, 3), (3, 1)].map(|(from, to)| edges.push(from, to));
        edges.make_triangle(a, b, c);
        edges.make_triangle(sym(a), d, e);
        (edges, a)
    }

    fn face(edges: &QuadEdges, edge: EdgeId) -> [u32; 3] {
        let next = edges.left_next(edge);
        [edge, next, edges.left_next(next)].map(|edge| edges.origin(edge))
    }

    #[test]
    fn four_quarter_turns_are_none() {
        for edge in 0..8 {
            assert_eq!(rot(rot(edge)), sym(edge));
            assert_eq!(inverse_rot(rot(edge)), edge);
            assert_eq!(rot(rot(rot(edge))), inverse_rot(edge));
        }
    }

    #[test]
    fn a_flip_joins_the_other_two_corners() {
        let (mut edges, a) = two();
        assert_eq!((face(&edges, a), face(&edges, sym(a))), ([0, 1, 2], [1, 0, 3]));
        // `Onext` is the opposite of `Lprev`.
        assert_eq!(sym(edges.next(a)), edges.left_next(edges.left_next(a)));
        edges.flip(a);
        assert_eq!((face(&edges, a), face(&edges, sym(a))), ([3, 2, 0], [2, 3, 1]));
    }
}
