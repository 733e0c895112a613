//! The diagrams of open chains, and one merge of two of them, as values.
//!
//! # Contract
//! What the engine has for a run of consecutive edges before any ring is closed: which arcs there are, and
//! what lies beside them, is exact; places are rounded once. O(n log n) for a chain of n edges, and memory
//! for all edges of the domain.
//!
//! # Method
//! The chain is built by merges of the engine, the longest power of two first. A merge only adds pieces of
//! its curve and moves or unlinks ends of arcs that were there; so the arcs before and after are compared
//! by number, and nothing is recorded on the way.

use super::diagram::{APEX, Diagram, INFINITE, NONE};
use super::elements::{Flank, Ground, Line, Member, Members};
use super::exact::Exacts;
use super::forest::{add_chain, first_part};
use super::merge::{Joint, Merge};
use crate::axis::{self, Curve, CurveKind, Side};
use crate::domain::{Corner, Domain, Site};
use crate::engine::watch::Watch;
use crate::engine::{EngineError, Options};
use crate::geom::Point;

/// An open chain: consecutive edges of one walk, with all their corners, that pass no place twice.
///
/// In the paper this is a list of elements, and a chain only if it ends at the convex corners next to it
/// [Lee82, §II]; ours end anywhere.
#[derive(Clone, Debug)]
pub struct Chain<'a> {
    domain: &'a Domain,
    /// At least one, each the next of the one before; all corners of them lie apart.
    edges: Vec<u32>,
}

impl<'a> Chain<'a> {
    /// The chain of `len` edges from edge number `first` on, along the boundary.
    ///
    /// `None` if there is no such edge, if `len` is 0, or if the chain comes back to a place where it was:
    /// at the latest where it is a whole walk.
    #[must_use]
    pub fn new(domain: &'a Domain, first: u32, len: u32) -> Option<Self> {
        let walk = domain.walks()[domain.edges().get(first as usize)?.walk as usize];
        if len == 0 || len >= walk.len {
            return None;
        }
        let next = |&edge: &u32| Some(domain.edge(edge).next);
        let mut edges: Vec<u32> =
            std::iter::successors(Some(first), next).take(len as usize + 1).collect();
        let mut places: Vec<Point> = edges.iter().map(|&edge| domain.edge(edge).start).collect();
        places.sort_unstable_by(|&p, &q| p.lexicographic(q));
        edges.truncate(len as usize);
        let is_simple = places.windows(2).all(|pair| pair[0] != pair[1]);
        is_simple.then_some(Self { domain, edges })
    }

    /// The domain.
    #[must_use]
    pub fn domain(&self) -> &'a Domain {
        self.domain
    }

    /// The numbers of its edges in the order of the boundary; never empty.
    #[must_use]
    pub fn edges(&self) -> &[u32] {
        &self.edges
    }

    /// The two chains whose diagrams are merged to that of this one; `None` for an edge alone.
    ///
    /// The first has as many edges as the greatest power of two that leaves some for the second, so that
    /// mostly chains of one length are merged [Lee82, Fig. 8]. The diagram of two edges is written down
    /// instead, unless they go straight on.
    #[must_use]
    pub fn parts(&self) -> Option<(Self, Self)> {
        let (first, second) = halves(&self.edges)?;
        let part = |edges: &[u32]| Self { domain: self.domain, edges: edges.to_vec() };
        Some((part(first), part(second)))
    }
}

/// The two parts in which a chain is built; an edge alone has none.
fn halves(edges: &[u32]) -> Option<(&[u32], &[u32])> {
    (edges.len() > 1).then(|| edges.split_at(first_part(edges.len())))
}

/// An element of the diagram of a chain: a side of an edge, or a corner.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ChainElement {
    /// The edge or corner; the corner may be a convex one, which has a cell on the other side.
    pub site: Site,
    /// On which side of the boundary its cell lies; `None` for the two corners in which the chain ends,
    /// as their cells lie around them.
    pub side: Option<Side>,
}

/// Where an arc starts or ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ArcEnd {
    /// In the corner of the chain that its two elements have in common.
    Corner(Point),
    /// In the centre of a disk of this radius, which touches three elements or more.
    Disk(Point, f64),
    /// Nowhere: it runs on in this direction, a unit vector.
    Infinity(Point),
}

impl ArcEnd {
    /// The place and its distance from the chain, 0 in a corner; `None` at infinity.
    #[must_use]
    pub fn disk(&self) -> Option<(Point, f64)> {
        match *self {
            Self::Corner(place) => Some((place, 0.0)),
            Self::Disk(centre, radius) => Some((centre, radius)),
            Self::Infinity(_) => None,
        }
    }
}

/// A piece of the diagram of a chain: the points that have two elements nearest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChainArc {
    /// The element whose cell lies to the left of its direction.
    pub left: ChainElement,
    /// The one to the right.
    pub right: ChainElement,
    /// Where it starts.
    pub from: ArcEnd,
    /// Where it ends.
    pub to: ArcEnd,
    /// Line or parabola; only a line runs to infinity.
    pub kind: CurveKind,
    /// Whether it is the normal of an edge in its own end, which is no part of an axis [Lee82, cor. 3].
    pub is_normal: bool,
}

impl ChainArc {
    /// Its curve; `None` if it runs to infinity.
    #[must_use]
    pub fn curve(&self, domain: &Domain) -> Option<Curve> {
        let site = |element: ChainElement| {
            let (start, end) =
                (domain.edge(element.site.index()).start, domain.end(element.site.index()));
            if element.site.is_edge() {
                axis::Site::edge(start, end)
            } else {
                axis::Site::vertex(start)
            }
        };
        Some(Curve::new(&site(self.left), &site(self.right), self.from.disk()?, self.to.disk()?))
    }
}

/// One merge of the diagrams of two neighbouring chains.
#[derive(Clone, Debug)]
pub struct ChainMerge {
    /// The diagrams of the first and of the second chain.
    pub before: [Vec<ChainArc>; 2],
    /// The pieces of the merge curve in the order in which they were followed.
    ///
    /// It leaves the common corner on the left side of the boundary, with the first chain to the left, and
    /// each piece starts where the one before ends. Where it does not come back on the right side it runs
    /// to infinity, and a second walk leaves the corner on the right side, with the first chain to the right.
    pub curve: Vec<ChainArc>,
    /// What each diagram still has after it, some of it cut short: with the curve the diagram of both
    /// chains together.
    pub kept: [Vec<ChainArc>; 2],
    /// What each diagram lost: whole arcs, and what was cut off others, with their elements as before it.
    pub discarded: [Vec<ChainArc>; 2],
}

/// The two-sided diagram of an open chain: its arcs in the order of the cells along the chain.
///
/// It covers the whole plane: both sides of each edge and all corners have cells. So a chain of n edges that
/// nowhere goes straight on has 3n + 1 of them.
///
/// # Errors
/// As [`divide_and_conquer`](super::divide_and_conquer()).
///
/// ```
/// use medial::domain::{Domain, Options, Site};
/// use medial::engine::{ArcEnd, Chain, chain_diagram};
/// use medial::geom::Point;
/// let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)].map(|(x, y)| Point::new(x, y));
/// let domain = Domain::from_polygons(&[vec![square.to_vec()]], &Options::default())?;
/// let chain = Chain::new(&domain, 0, 2).expect("two of four edges");
/// let arcs = chain_diagram(&chain)?;
/// // Inside, the two edges have the diagonal between them, from (2, 0) to the normals at both other ends.
/// let diagonal = arcs.iter().find(|arc| arc.left.site.is_edge() && arc.right.site.is_edge());
/// let ends = diagonal.map(|arc| (arc.from, arc.to));
/// let corner = ArcEnd::Corner(Point::new(2.0, 0.0));
/// assert_eq!(ends, Some((corner, ArcEnd::Disk(Point::new(0.0, 2.0), 2.0))));
/// // The closed walk is no open chain.
/// assert!(Chain::new(&domain, 0, 4).is_none());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn chain_diagram(chain: &Chain<'_>) -> Result<Vec<ChainArc>, EngineError> {
    of_chain(chain, |parts| {
        parts.build(&chain.edges)?;
        let arcs = parts.arcs(&chain.edges)?;
        Ok(arcs.iter().map(|&half| parts.arc(half, &chain.edges)).collect())
    })
}

/// The merge of the diagrams of the first `at` edges of a chain and of the others [Lee82, §II].
///
/// # Errors
/// As [`divide_and_conquer`](super::divide_and_conquer()).
///
/// # Panics
/// If `at` is 0 or not less than the number of edges.
///
/// ```
/// use medial::domain::{Domain, Options};
/// use medial::engine::{Chain, chain_merge};
/// use medial::geom::Point;
/// let square = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)].map(|(x, y)| Point::new(x, y));
/// let domain = Domain::from_polygons(&[vec![square.to_vec()]], &Options::default())?;
/// let merge = chain_merge(&Chain::new(&domain, 0, 2).expect("two of four edges"), 1)?;
/// // An edge alone has the normals in its ends, on both sides. In the common corner the first one loses that
/// // on the inside, and the second one both: the curve runs where it has that on the outside.
/// assert_eq!(merge.before.map(|arcs| arcs.len()), [4, 4]);
/// let kept = merge.kept.each_ref().map(|arcs| arcs.len());
/// assert_eq!((kept, merge.curve.len()), ([3, 2], 3));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn chain_merge(chain: &Chain<'_>, at: usize) -> Result<ChainMerge, EngineError> {
    let edges = &chain.edges;
    assert!(0 < at && at < edges.len(), "{at} of {} edges are no first part", edges.len());
    of_chain(chain, |parts| {
        let lists = [&edges[..at], &edges[at..]];
        let mut arcs = [Vec::new(), Vec::new()];
        for (list, arcs) in lists.iter().zip(&mut arcs) {
            parts.build(list)?;
            *arcs = parts.arcs(list)?;
        }
        let old = parts.diagram.halves.clone();
        let before = [0, 1].map(|k| arcs[k].iter().map(|&a| parts.arc(a, lists[k])).collect());
        parts.merge([edges[at - 1], edges[at]])?;
        let mut is_there = vec![false; parts.diagram.halves.len()];
        parts.arcs(edges)?.into_iter().for_each(|arc| is_there[arc as usize] = true);
        let (mut kept, mut discarded) = ([vec![], vec![]], [vec![], vec![]]);
        for (k, arcs) in arcs.iter().enumerate() {
            for &arc in arcs {
                let was = [arc, arc ^ 1].map(|half| old[half as usize].from);
                if is_there[arc as usize] {
                    kept[k].push(parts.arc(arc, edges));
                    discarded[k].extend(parts.cut_off(arc, was, lists[k]));
                } else {
                    discarded[k].push(parts.between(arc, was, lists[k]));
                }
            }
        }
        let curve = (old.len() as u32..parts.diagram.halves.len() as u32).step_by(2);
        let curve = curve.map(|piece| parts.arc(piece, edges)).collect();
        Ok(ChainMerge { before, curve, kept, discarded })
    })
}

/// Diagrams of parts of a chain.
struct Parts<'a, 'w> {
    members: Members<'a>,
    diagram: Diagram,
    watch: &'w Watch<'w>,
}

/// Does something with the diagrams of parts of a chain.
fn of_chain<T>(
    chain: &Chain<'_>,
    work: impl FnOnce(&mut Parts<'_, '_>) -> Result<T, EngineError>,
) -> Result<T, EngineError> {
    let domain = chain.domain;
    let watch = Watch::new(&Options::default());
    let (lines, exacts) = (Line::all(domain), Exacts::new());
    let members = Ground::new(domain, &lines)?.members(&exacts);
    let diagram = Diagram::with_room(0..domain.edges().len() as u32);
    work(&mut Parts { members, diagram, watch: &watch })
}

impl Parts<'_, '_> {
    /// Adds the diagram of some edges in a row.
    fn build(&mut self, edges: &[u32]) -> Result<(), EngineError> {
        add_chain(self.members, &mut self.diagram, edges, 0..edges.len(), self.watch)
    }

    /// Merges the diagrams of two chains, given the last edge of one and the first of the other.
    fn merge(&mut self, joint: [u32; 2]) -> Result<(), EngineError> {
        let joint = Joint::new(&self.members, joint, true);
        Merge::new(self.members, &mut self.diagram, &[joint], self.watch).run()
    }

    /// The arcs of a chain, each by its half that has the even number, in the order of the cells.
    fn arcs(&self, edges: &[u32]) -> Result<Vec<u32>, EngineError> {
        let domain = self.members.domain;
        let last = edges[edges.len() - 1];
        let cells = edges.iter().flat_map(|&edge| {
            let [left, right] = [Flank::Left, Flank::Right].map(|f| Member::side(edge, f));
            // The cell of a corner belongs to the edge that ends there; where it goes straight on nobody
            // has one.
            let goes_on = domain.edge(domain.edge(edge).next).corner == Corner::Straight;
            let end = (edge == last || !goes_on).then_some(Member::end(edge));
            [Some(left), Some(right), end].into_iter().flatten()
        });
        let mut is_listed = vec![false; self.diagram.halves.len() / 2];
        let mut arcs = Vec::new();
        for cell in std::iter::once(Member::start(edges[0])).chain(cells) {
            let mut half = self.diagram.ends[cell.0 as usize][0];
            let mut left = self.diagram.halves.len();
            while half != NONE {
                let place = self.members.ends(cell).0;
                let broken = EngineError::Internal { stage: "reading the cell of a chain", place };
                left = left.checked_sub(1).ok_or(broken)?;
                if !std::mem::replace(&mut is_listed[half as usize / 2], true) {
                    arcs.push(half & !1);
                }
                half = self.diagram.half(half).next;
            }
        }
        Ok(arcs)
    }

    /// An arc as it is now, as a part of a chain of these edges.
    fn arc(&self, half: u32, edges: &[u32]) -> ChainArc {
        self.between(half, [half, half ^ 1].map(|half| self.diagram.half(half).from), edges)
    }

    /// What an arc was, or a part of it: its two cells, with other ends.
    fn between(&self, half: u32, [from, to]: [u32; 2], edges: &[u32]) -> ChainArc {
        let members = &self.members;
        let (left, right) = (self.diagram.half(half).cell, self.diagram.beyond(half));
        let is_normal = members.is_normal(left, right);
        let is_line = is_normal || left.is_corner() == right.is_corner();
        ChainArc {
            left: self.element(left, edges),
            right: self.element(right, edges),
            from: self.end(from, [right, left]),
            to: self.end(to, [left, right]),
            kind: if is_line { CurveKind::Line } else { CurveKind::Parabola },
            is_normal,
        }
    }

    fn element(&self, member: Member, edges: &[u32]) -> ChainElement {
        let site = self.members.site(member);
        let is_end =
            member == Member::start(edges[0]) || member == Member::end(edges[edges.len() - 1]);
        let side = if !member.is_corner() {
            Some(member.flank() == Flank::Left)
        } else if is_end {
            None
        } else {
            Some(self.members.domain.edge(site.index()).corner == Corner::Reflex)
        };
        let side = side.map(|left| if left { Side::Interior } else { Side::Exterior });
        ChainElement { site, side }
    }

    /// The end of an arc in a vertex, with the cells to its left and to its right as seen on the way there.
    fn end(&self, vertex: u32, [left, right]: [Member; 2]) -> ArcEnd {
        let members = &self.members;
        if let Some(disk) = self.diagram.disk(vertex) {
            return ArcEnd::Disk(disk.disk.position(), disk.disk.radius);
        }
        let l = members.ends(left);
        if vertex == INFINITE {
            let across = match (left.is_corner(), right.is_corner()) {
                (true, true) => {
                    let way = members.place(right) - l.0;
                    way * (1.0 / way.norm())
                }
                (false, _) => members.direction(left),
                (true, false) => members.direction(right),
            };
            return ArcEnd::Infinity(across.perp());
        }
        debug_assert_eq!(vertex, APEX);
        // On the way into a corner what lies to the left starts there, and what lies to the right ends.
        ArcEnd::Corner(l.0)
    }

    /// What was cut off an arc, given the vertices where it started and ended.
    fn cut_off(&self, arc: u32, was: [u32; 2], edges: &[u32]) -> impl Iterator<Item = ChainArc> {
        let is = [arc, arc ^ 1].map(|half| self.diagram.half(half).from);
        let parts = [[was[0], is[0]], [is[1], was[1]]];
        let is_cut = move |&[a, b]: &[u32; 2]| self.is_apart(arc, a, b);
        parts.into_iter().filter(is_cut).map(move |ends| self.between(arc, ends, edges))
    }

    /// Whether two vertices of an arc lie apart: where a merge finds that two are one it keeps one of them.
    fn is_apart(&self, arc: u32, a: u32, b: u32) -> bool {
        let (left, right) = (self.diagram.half(arc).cell, self.diagram.beyond(arc));
        match (self.diagram.disk(a), self.diagram.disk(b)) {
            (Some(a), Some(b)) => self.members.order(&a, &b, right, left).is_ne(),
            _ => a != b,
        }
    }
}

#[cfg(test)]
#[path = "chains_tests.rs"]
mod tests;
