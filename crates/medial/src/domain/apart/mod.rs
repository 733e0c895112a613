//! A proof that the rings of a feature are simple and apart from one another, as most are.
//!
//! # Contract
//! [`apart`] says what lies around each ring, if no two edges share a point but the common corner
//! of two consecutive ones; it may decline to answer, and always does if edges touch. Then the
//! sweep has to tell. Linear on input whose edges are near few others; the work is counted, and at
//! most so many times the number of edges.
//!
//! # Method
//! A tree of boxes over runs of edges is joined with itself: only edges with meeting boxes are
//! compared, exactly. Where axis-parallel boxes meet too many others, strips in the direction of
//! the runs are tried: they separate long edges side by side, as in a star of needles. Nesting then
//! follows from the edge right below the first vertex of a ring in lexicographic order, found in
//! the same tree; and rings joined by a link that meets no edge, which the join finds out on the
//! way, have the same around them.
//!
//! # Departures
//! Boundary order takes the place of a sort: consecutive edges are near each other, whatever the
//! shape. Boxes are kept in single precision; the map to it keeps the order of coordinates, so no
//! pair is missed, and what it cannot tell apart is only compared for nothing. Since nothing
//! touches, one comparison a ring says whether the interior is on the left everywhere, where the
//! sweep makes one at each edge that starts.

mod below;
mod join;
mod links;
mod node;
mod strip;
#[cfg(test)]
mod tests;
mod tree;

use join::{Doubt, join};
use node::Bounds;
use tree::Tree;

use super::rings::Rings;
use super::status::NONE;

/// What lies around each ring.
pub(super) struct Nesting {
    around: Vec<Around>,
}

/// The face in which a ring lies, by one of the rings that bound it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Around {
    Nothing,
    /// That right inside a ring.
    Inside(u32),
    /// That right outside a ring.
    Outside(u32),
}

/// Shows that the rings are simple and apart, and how they are nested; `None` if that is not so,
/// or takes too long. The rings are best laid out so that near ones follow one another.
pub(super) fn apart(rings: &Rings) -> Option<Nesting> {
    if let [_] = rings.rings[..]
        && rings.points.len() <= FEW_EDGES
    {
        let around = vec![Around::Nothing];
        return (!join::touches_itself(&rings.points)).then_some(Nesting { around });
    }
    let tree = Tree::new(rings);
    let mut proof = Err(Doubt::Costly);
    if !spreads(&tree) {
        proof = join(&tree, &[]);
    }
    if proof == Err(Doubt::Costly) {
        proof = join(&tree, &strip::strips(&tree));
    }
    let broken = proof.ok()?;
    let around = match rings.rings[..] {
        [_] => vec![Around::Nothing],
        _ => below::all(&tree, &broken)?,
    };
    Some(Nesting { around })
}

/// Edges of a ring that are not worth a tree.
const FEW_EDGES: usize = 16;

/// Whether the leaves' boxes overlap so much that a join by boxes is hopeless.
fn spreads(tree: &Tree) -> bool {
    let area = |b: Bounds| (b.max[0] - b.min[0]) * (b.max[1] - b.min[1]);
    tree.leaf_bounds().map(area).sum::<f32>() > OVERLAP * area(tree.bounds())
}

/// Number of boxes over each place, on average, up to which they are of use.
const OVERLAP: f32 = 4.0;

impl Nesting {
    /// The smallest ring around each ring, or `NONE`.
    pub(super) fn parents(&self) -> Vec<u32> {
        const OPEN: u32 = NONE - 1;
        let mut parents = vec![OPEN; self.around.len()];
        let mut waiting = Vec::new();
        for start in 0..self.around.len() {
            let mut ring = start;
            // What lies below starts farther left, so this ends.
            let parent = loop {
                if parents[ring] != OPEN {
                    break parents[ring];
                }
                waiting.push(ring);
                match self.around[ring] {
                    Around::Nothing => break NONE,
                    Around::Inside(other) => break other,
                    Around::Outside(other) => ring = other as usize,
                }
            };
            waiting.drain(..).for_each(|ring| parents[ring] = parent);
        }
        parents
    }

    /// Whether each ring has on its outer side what its direction says.
    pub(super) fn sides_agree(&self, rings: &Rings) -> bool {
        // The polygon that is left there plus one, or 0.
        let left = |ring: u32, inside: bool| {
            let ring = &rings.rings[ring as usize];
            if ring.hole == inside { 0 } else { ring.polygon + 1 }
        };
        self.around.iter().zip(0..).all(|(around, ring)| {
            let found = match *around {
                Around::Nothing => 0,
                Around::Inside(other) => left(other, true),
                Around::Outside(other) => left(other, false),
            };
            found == left(ring, false)
        })
    }
}
