//! The outside of a domain within a rectangle, as a domain of its own.
//!
//! The walls of the rectangle come first; all other edges are those of the domain the other way
//! round, so that what was outside lies to their left. Where boundaries touch the walks are paired
//! again, by the sectors of the outside. Edges, and the corners between them, keep their names.

use std::cmp::Ordering;

use super::apart::apart;
use super::origins::{Origins, Source};
use super::outlines::Draft;
use super::rings::{Ring, Rings};
use super::status::NONE;
use super::{Corner, CornerOrigin, Domain, DomainError, Options, Origin, Report, Site};
use crate::geom::{Point, Rect};

/// Number of edges of the frame.
const WALLS: u32 = 4;

/// What the corners and walls of the frame are named, if anybody asks.
const NOWHERE: u32 = u32::MAX;

/// The outside of a domain within a frame.
#[derive(Clone, Debug)]
pub struct Complement {
    domain: Domain,
    /// For each edge its place among all edges along the inner boundary, and that of the one before
    /// which the corner at its start comes there; none for the walls.
    places: Vec<[u32; 2]>,
    touches: bool,
}

impl Complement {
    /// The part of the plane within a rectangle, which must hold the domain in its inside, that is
    /// not covered by the polygons of the domain.
    ///
    /// ```
    /// use medial::domain::{Complement, Domain, Options};
    /// use medial::geom::{Point, Rect};
    ///
    /// let point = |(x, y)| Point::new(x, y);
    /// let square = [(0., 0.), (1., 0.), (1., 1.), (0., 1.)].map(point).to_vec();
    /// let domain = Domain::from_polygons(&[vec![square]], &Options::default())?;
    /// let frame = Rect::EMPTY.with(Point::new(-1.0, -1.0)).with(Point::new(2.0, 2.0));
    /// let outside = Complement::new(&domain, &frame)?;
    /// assert_eq!((outside.domain().walks().len(), outside.domain().area()), (2, 8.0));
    /// # Ok::<(), medial::domain::DomainError>(())
    /// ```
    ///
    /// # Errors
    /// [`DomainError::Internal`] if the frame does not hold the domain.
    pub fn new(domain: &Domain, frame: &Rect) -> Result<Self, DomainError> {
        let Reversed { mut rings, mut inner } = Reversed::new(domain, frame, &[]);
        let n_walks = rings.rings.len();
        let options = Options::default();
        let mut touches = false;
        let outside = match apart(&rings) {
            Some(nesting) if nesting.sides_agree(&rings) => {
                let draft = Draft::with_room(rings.points.len(), n_walks);
                let order = (0..n_walks as u32).collect();
                Domain::of_rings(draft, &rings, &nesting, Some(order), Report::default())?
            }
            _ => {
                touches = true;
                let splits = splits(domain);
                if !splits.is_empty() {
                    Reversed { rings, inner } = Reversed::new(domain, frame, &splits);
                }
                rings.number();
                let draft = Draft::with_room(rings.points.len(), n_walks);
                Domain::of_touching_rings(draft, rings, 1, &options, Report::default())?
            }
        };
        Ok(Self { touches, ..Self::named(outside, domain, &inner) })
    }

    /// The outside, its edges and corners named as in the domain.
    fn named(mut outside: Domain, domain: &Domain, inner: &[Vec<u32>]) -> Self {
        let pieces = Pieces::new(&outside, domain, inner);
        let n = outside.edges.len();
        let nowhere = CornerOrigin { polygon: NOWHERE, ring: NOWHERE, index: 0, part: 0 };
        let wall = Origin { polygon: NOWHERE, ring: NOWHERE, index: 0, part: 0, corner: nowhere };
        let (mut records, mut places) = (vec![wall; n], vec![[NONE; 2]; n]);
        for (rank, &edge) in (0..).zip(&pieces.order) {
            records[edge as usize] = pieces.origin(rank);
            places[edge as usize] = [rank, pieces.after(rank)];
        }
        let sources = outside.walks.iter().map(|walk| Source::Pieces { first: walk.first });
        outside.origins = Origins { sources: sources.collect(), given: Vec::new(), records };
        Self { domain: outside, places, touches: false }
    }

    /// The outside as a domain.
    #[must_use]
    pub fn domain(&self) -> &Domain {
        &self.domain
    }

    /// Whether boundaries touch. If not, each walk but that of the frame is one of the inner domain, the
    /// other way round.
    #[must_use]
    pub fn touches(&self) -> bool {
        self.touches
    }

    /// Whether an edge, or the corner where it starts, belongs to the frame.
    #[must_use]
    pub fn is_frame(&self, edge: u32) -> bool {
        self.places[edge as usize][0] == NONE
    }

    /// The number of edges of the frame, which come first.
    #[must_use]
    pub const fn n_frame_edges() -> u32 {
        WALLS
    }

    /// The number of a site if edges were counted along the boundary of the inner domain, by which
    /// sites are ordered. `None` for the frame.
    #[must_use]
    pub fn inner_site(&self, site: Site) -> Option<Site> {
        let [edge, corner] = self.places[site.index() as usize];
        (edge != NONE).then(|| if site.is_edge() { Site::edge(edge) } else { Site::corner(corner) })
    }
}

/// The edges outside along the boundary of the inner domain.
///
/// What touches an edge from outside cuts it there only, so an inner edge may be several pieces; and
/// what cuts it inside has done so already. Pieces are counted anew.
struct Pieces<'a> {
    domain: &'a Domain,
    /// The outer edges, in the order in which the inner boundary passes them.
    order: Vec<u32>,
    /// The inner edge that each is a piece of.
    inner: Vec<u32>,
    /// Place of the first piece of each inner edge.
    first: Vec<u32>,
    /// For each piece how many there are of the same edge of the input before and after it, along the
    /// inner boundary.
    around: Vec<[u32; 2]>,
    /// More than any number of a part, where what is cut keeps the numbers that it has: of a repaired
    /// domain, in which parts of one edge may run either way.
    beyond: Option<u32>,
}

impl<'a> Pieces<'a> {
    fn new(outside: &Domain, domain: &'a Domain, inner: &[Vec<u32>]) -> Self {
        let mut pieces: Vec<(u32, u32)> = Vec::with_capacity(outside.edges.len());
        for edge in WALLS..outside.edges.len() as u32 {
            // Rings were numbered like walks, behind that of the frame.
            let Origin { ring, index, .. } = outside.origin(edge);
            pieces.push((inner[ring as usize - 1][index as usize], edge));
        }
        pieces.sort_unstable_by(|&(m, a), &(n, b)| {
            // The inner boundary runs through an edge from its end to its start.
            let along = outside.end(a).lexicographic(outside.end(b));
            let forwards = domain.edge(m).start.lexicographic(domain.end(m)).is_lt();
            m.cmp(&n).then(if forwards { along } else { along.reverse() })
        });
        let (inner, order): (Vec<u32>, Vec<u32>) = pieces.into_iter().unzip();
        let mut first = Vec::with_capacity(domain.edges.len());
        let mut rank = 0;
        for edge in 0..domain.edges.len() as u32 {
            first.push(rank as u32);
            while inner.get(rank) == Some(&edge) {
                rank += 1;
            }
        }
        let around = vec![[0; 2]; inner.len()];
        let records = domain.origins.records.iter();
        let most = || records.map(|o| o.part.max(o.corner.part)).max().unwrap_or(0);
        let beyond = domain.report().is_rebuilt().then(|| most() + 1);
        let mut pieces = Self { domain, order, inner, first, around, beyond };
        if beyond.is_some() {
            return pieces;
        }
        let is_whole = |&m: &u32| domain.origin(m).part == 0;
        if !pieces.inner.is_sorted_by(|a, b| a < b) || !pieces.inner.iter().all(is_whole) {
            pieces.count(outside);
        }
        pieces
    }

    /// Counts the pieces of each edge of the input. They need not follow one another where boundaries
    /// touch.
    fn count(&mut self, outside: &Domain) {
        let domain = self.domain;
        let name = |rank: u32| {
            let Origin { polygon, ring, index, .. } = domain.origin(self.inner[rank as usize]);
            (polygon, ring, index)
        };
        let mut by_name: Vec<_> = (0..self.inner.len() as u32).map(|k| (name(k), k)).collect();
        by_name.sort_unstable();
        for same in by_name.chunk_by_mut(|a, b| a.0 == b.0) {
            let start = |rank: u32| outside.end(self.order[rank as usize]);
            let m = self.inner[same[0].1 as usize];
            let forwards = domain.edge(m).start.lexicographic(domain.end(m)).is_lt();
            same.sort_unstable_by(|&(_, a), &(_, b)| {
                let along = start(a).lexicographic(start(b));
                if forwards { along } else { along.reverse() }
            });
            let n = same.len() as u32;
            for (before, &(_, rank)) in (0..).zip(&*same) {
                self.around[rank as usize] = [before, n - 1 - before];
            }
        }
    }

    /// The name of a piece, and of the corner where it arrives along the inner boundary.
    ///
    /// A corner is named by the edge that arrives there with the interior to its left.
    fn origin(&self, rank: u32) -> Origin {
        let edge = self.inner[rank as usize];
        let (origin, end) = (self.domain.origin(edge), self.domain.edge(edge).next);
        let end = self.domain.origin(end).corner;
        if let Some(beyond) = self.beyond {
            let more = beyond * (rank - self.first[edge as usize]);
            let is_last = self.inner.get(rank as usize + 1) != Some(&edge);
            let Origin { polygon, ring, index, part, .. } = origin;
            let touch = CornerOrigin { polygon, ring, index, part: part + more + beyond };
            let corner = if is_last { end } else { touch };
            return Origin { part: part + more, corner, ..origin };
        }
        // An edge is named by its first vertex in input direction.
        let runs_along =
            if end.part == 0 { end.index != origin.index } else { end.part == origin.part + 1 };
        let [before, after] = self.around[rank as usize];
        let (part, touch) = if runs_along { (before, before + 1) } else { (after, after) };
        let corner = if after == 0 {
            end
        } else {
            CornerOrigin {
                polygon: origin.polygon,
                ring: origin.ring,
                index: origin.index,
                part: touch,
            }
        };
        Origin { part, corner, ..origin }
    }

    /// The piece before which the corner comes where a piece arrives.
    fn after(&self, rank: u32) -> u32 {
        let edge = self.inner[rank as usize];
        if self.inner.get(rank as usize + 1) == Some(&edge) {
            rank + 1
        } else {
            self.first[self.domain.edge(edge).next as usize]
        }
    }
}

/// Where edges of two polygons share a part of their length, the places inside an edge where it starts
/// or ends, by the edge.
///
/// What polygons share is not their outside; cut out it can be where both have corners.
fn splits(domain: &Domain) -> Vec<(u32, Point)> {
    let ends = |edge: u32| {
        let (a, b) = (domain.edge(edge).start, domain.end(edge));
        if a.lexicographic(b).is_lt() { (a, b) } else { (b, a) }
    };
    let lines = domain.lines();
    let mut order: Vec<u32> = (0..domain.edges.len() as u32).collect();
    order.sort_unstable_by(|&a, &b| {
        let line = |edge: u32| lines[edge as usize];
        line(a).cmp(&line(b)).then_with(|| ends(a).0.lexicographic(ends(b).0))
    });
    let mut splits = Vec::new();
    for line in order.chunk_by(|&a, &b| lines[a as usize] == lines[b as usize]) {
        // No more than two lie on one another anywhere.
        let mut last = line[0];
        for &edge in &line[1..] {
            let ((start, end), (last_start, last_end)) = (ends(edge), ends(last));
            let order = end.lexicographic(last_end);
            if start.lexicographic(last_end).is_lt() {
                if start != last_start {
                    splits.push((last, start));
                }
                match order {
                    Ordering::Less => splits.push((last, end)),
                    Ordering::Equal => {}
                    Ordering::Greater => splits.push((edge, last_end)),
                }
            }
            if order.is_gt() {
                last = edge;
            }
        }
    }
    splits
}

/// The frame and the walks of a domain the other way round, as rings of one polygon.
struct Reversed {
    rings: Rings<'static>,
    /// For each walk the edge of the domain that each edge of its ring is a part of.
    inner: Vec<Vec<u32>>,
}

impl Reversed {
    /// The rings, with more corners where edges go on straight, each given with its edge.
    fn new(domain: &Domain, frame: &Rect, splits: &[(u32, Point)]) -> Self {
        let mut splits = splits.to_vec();
        splits.sort_unstable_by(|&(a, p), &(b, q)| {
            let (start, end) = (domain.edge(a).start, domain.end(a));
            let along = p.lexicographic(q);
            // From the end of an edge to its start.
            a.cmp(&b).then(if start.lexicographic(end).is_lt() { along.reverse() } else { along })
        });
        splits.dedup();
        let (low, high) = (frame.min, frame.max);
        let n = domain.edges.len() + splits.len() + WALLS as usize;
        let (mut points, mut corners) = (Vec::with_capacity(n), Vec::with_capacity(n));
        points.extend([low, Point::new(high.x, low.y), high, Point::new(low.x, high.y)]);
        corners.extend([Corner::Convex; WALLS as usize]);
        let ring = |index: u32, first: u32, len: u32, hole: bool| Ring {
            polygon: 0,
            index,
            first,
            len,
            cleaned: NONE,
            hole,
            reversed: false,
        };
        let mut rings = vec![ring(0, 0, WALLS, false)];
        let mut inner = Vec::with_capacity(domain.walks.len());
        for (number, walk) in (1..).zip(&domain.walks) {
            let first = points.len() as u32;
            let mut edges = Vec::with_capacity(walk.len as usize);
            // The first corner stays the first.
            let rest = walk.first + 1..walk.first + walk.len;
            let backwards = std::iter::once(walk.first).chain(rest.rev());
            for edge in backwards.map(|k| domain.edge(k)) {
                points.push(edge.start);
                edges.push(edge.prev);
                corners.push(match edge.corner {
                    Corner::Convex => Corner::Reflex,
                    Corner::Reflex => Corner::Convex,
                    Corner::Straight => Corner::Straight,
                });
                let begin = splits.partition_point(|&(split, _)| split < edge.prev);
                for &(_, at) in splits[begin..].iter().take_while(|split| split.0 == edge.prev) {
                    points.push(at);
                    edges.push(edge.prev);
                    corners.push(Corner::Straight);
                }
            }
            rings.push(ring(number, first, edges.len() as u32, !walk.hole));
            inner.push(edges);
        }
        Self { rings: Rings::of_parts(rings, points, corners), inner }
    }
}
