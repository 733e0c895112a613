//! The diagram of two edges that share a corner, in closed form.
//!
//! On the convex side the curve between the two edges is their bisector up to the normal at the far end
//! of the shorter one, then that between this end and the longer edge, then that between both ends. On
//! the other side it is a normal of the second edge.

use std::cmp::Ordering;

use super::diagram::{APEX, Diagram, INFINITE};
use super::elements::{Flank, Member, Members};
use crate::geom::compare_lengths;

/// An arc with the two cells beside it, as it is where the convex side is on the left.
#[derive(Clone, Copy)]
struct Arc {
    half: u32,
    left: Member,
}

/// A diagram seen so that the corner is convex on the left, in a mirror if need be.
struct Mirror<'d> {
    diagram: &'d mut Diagram,
    convex: Flank,
}

impl Mirror<'_> {
    fn arc(&mut self, (left, right): (Member, Member), from: u32, to: u32) -> Arc {
        let half = if self.convex == Flank::Left {
            self.diagram.arc(left, right, from)
        } else {
            self.diagram.arc(right, left, from)
        };
        self.diagram.halves[half as usize ^ 1].from = to;
        Arc { half, left }
    }

    /// Bounds a cell by arcs, counterclockwise.
    fn bound(&mut self, cell: Member, arcs: &[Arc]) {
        let is_mirrored = self.convex == Flank::Right;
        let n = arcs.len();
        let half = |k: usize| {
            let arc = arcs[if is_mirrored { n - 1 - k } else { k }];
            if (arc.left == cell) == is_mirrored { arc.half ^ 1 } else { arc.half }
        };
        for k in 1..n {
            self.diagram.link(half(k - 1), half(k));
        }
        self.diagram.ends[cell.0 as usize] = [half(0), half(n - 1)];
    }

    /// A vertex that touches three elements, counterclockwise.
    fn vertex(&mut self, members: &Members<'_>, mut triple: [Member; 3]) -> Option<u32> {
        if self.convex == Flank::Right {
            triple.reverse();
        }
        Some(self.diagram.vertex(members.sharp(members.disk(triple)?)))
    }
}

impl Diagram {
    /// Adds the diagram of an edge and the next one, in whose common corner the boundary is convex on
    /// one side; `None` if a disk is missing, which it never is.
    ///
    /// The corner belongs to the first of the two.
    pub fn add_pair(
        &mut self,
        members: &Members<'_>,
        [first, second]: [u32; 2],
        convex: Flank,
    ) -> Option<()> {
        let concave = if convex == Flank::Left { Flank::Right } else { Flank::Left };
        let (a, b, c) = (Member::start(first), Member::end(first), Member::end(second));
        let [s, t] = [first, second].map(|edge| Member::side(edge, convex));
        let [u, v] = [first, second].map(|edge| Member::side(edge, concave));
        let places = [a, b, c].map(|corner| members.place(corner));
        let lengths = compare_lengths(places[0], places[1], places[2]);
        let mut mirror = Mirror { diagram: self, convex };
        let m = &mut mirror;
        // Where the curve meets the normal at the far end of the first edge, and of the second one.
        let (at_a, at_c) = match lengths {
            Ordering::Less => (m.vertex(members, [t, a, s])?, m.vertex(members, [t, c, a])?),
            Ordering::Greater => {
                let at_c = m.vertex(members, [t, c, s])?;
                (m.vertex(members, [c, a, s])?, at_c)
            }
            Ordering::Equal => {
                let both = m.vertex(members, [t, a, s])?;
                (both, both)
            }
        };
        let (near, far) = if lengths.is_gt() { (at_c, at_a) } else { (at_a, at_c) };
        let (start, end) = (m.arc((s, t), APEX, near), m.arc((a, c), far, INFINITE));
        let (normal_a, normal_c) = (m.arc((a, s), APEX, at_a), m.arc((t, c), APEX, at_c));
        let mut normal = |cells| m.arc(cells, APEX, INFINITE);
        let (behind_a, behind_c) = (normal((u, a)), normal((c, v)));
        let (behind_b, beyond_b) = (normal((b, u)), normal((v, b)));
        m.bound(u, &[behind_a, behind_b]);
        m.bound(b, &[behind_b, beyond_b]);
        m.bound(v, &[beyond_b, behind_c]);
        if lengths.is_lt() {
            let middle = m.arc((a, t), near, far);
            m.bound(t, &[normal_c, middle, start]);
            m.bound(a, &[normal_a, middle, end, behind_a]);
        } else {
            m.bound(t, &[normal_c, start]);
            m.bound(a, &[normal_a, end, behind_a]);
        }
        if lengths.is_gt() {
            let middle = m.arc((s, c), near, far);
            m.bound(s, &[start, middle, normal_a]);
            m.bound(c, &[behind_c, end, middle, normal_c]);
        } else {
            m.bound(s, &[start, normal_a]);
            m.bound(c, &[behind_c, end, normal_c]);
        }
        Some(())
    }
}
