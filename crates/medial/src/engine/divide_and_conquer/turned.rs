//! The diagrams of closed rings, as those of the same rings seen from outside.
//!
//! A diagram has both sides, so what is nearest to the right sides and to the corners that are convex as
//! seen from inside is the outside of the ring already. It gets the numbers that edges have in the
//! complement, where they run the other way round; what lies inside is left out.

use super::diagram::{Diagram, NONE};
use super::disks::Disk;
use super::elements::{Flank, Member, Members};
use crate::domain::{Complement, Corner, Site};

/// An element inside and outside.
struct Names<'a> {
    inside: Members<'a>,
    outside: Members<'a>,
    /// For each edge inside the one outside.
    edges: Vec<u32>,
}

impl Names<'_> {
    /// What a right side, or a corner, is outside.
    fn outer(&self, member: Member) -> Member {
        let edge = |inner: u32| self.edges[inner as usize];
        if member.is_corner() {
            let corner = self.inside.site(member).index();
            let before = self.inside.domain.edge(corner).prev;
            self.outside.member(Site::corner(edge(before)))
        } else {
            Member::side(edge(member.edge()), Flank::Left)
        }
    }

    /// The same disk, by the elements outside.
    fn disk(&self, disk: &Disk) -> Disk {
        let mut triple = disk.triple.map(|member| self.outer(member));
        let least = (0..3).min_by_key(|&k| triple[k]).unwrap_or(0);
        triple.rotate_left(least);
        // Doubles may make something else of the three in another order.
        Disk { triple, is_plain: false, disk: disk.disk }
    }
}

/// What a diagram of closed rings has outside; `None` if an arc there ends nowhere, which none does.
///
/// No ring touches itself or another one.
pub(super) fn outside(
    inside: Members<'_>,
    rings: &Diagram,
    complement: &Complement,
    outside: Members<'_>,
) -> Option<Diagram> {
    let n = outside.domain.edges().len() as u32;
    let mut names = Names { inside, outside, edges: vec![NONE; inside.domain.edges().len()] };
    for edge in 0..n {
        if let Some(inner) = complement.inner_site(Site::edge(edge)) {
            *names.edges.get_mut(inner.index() as usize)? = edge;
        }
    }
    let mut turned = Diagram::with_room(0..n);
    let mut arcs = vec![NONE; rings.halves.len() / 2];
    let mut vertices = vec![NONE; rings.vertices.len()];
    for (edge, record) in (0..).zip(inside.domain.edges()) {
        let corner = (record.corner == Corner::Convex).then(|| inside.member(Site::corner(edge)));
        for cell in std::iter::once(Member::side(edge, Flank::Right)).chain(corner) {
            let name = names.outer(cell);
            let mut last = NONE;
            let mut half = rings.ends[cell.0 as usize][0];
            while half != NONE {
                let arc = &mut arcs[half as usize / 2];
                if *arc == NONE {
                    *arc = turned.arc(name, name, NONE);
                }
                let own = *arc | half & 1;
                let record = rings.half(half);
                let from = match rings.vertices.get(record.from as usize) {
                    None => record.from,
                    Some(disk) => {
                        let vertex = &mut vertices[record.from as usize];
                        if *vertex == NONE {
                            *vertex = turned.vertex(names.disk(disk));
                        }
                        *vertex
                    }
                };
                turned.halves[own as usize].cell = name;
                turned.halves[own as usize].from = from;
                if last == NONE {
                    turned.ends[name.0 as usize][0] = own;
                } else {
                    turned.link(last, own);
                }
                (last, half) = (own, record.next);
            }
            turned.ends[name.0 as usize][1] = last;
        }
    }
    turned.halves.iter().all(|half| half.from != NONE).then_some(turned)
}
