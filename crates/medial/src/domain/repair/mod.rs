//! Domains from rings that cross, overlap, or are nested in any way.
//!
//! # Contract
//! The domain has for its interior what the rings of each polygon enclose by the fill rule, or, dissolved,
//! what they do together. Vertices as given stay where they are, and new ones come where edges cross,
//! within [`Report::moved`](super::Report::moved) of both; only where that has no end vertices move, which
//! the report says ([`Repair::Snapped`](super::Repair::Snapped)). What comes out is valid, so that repairing
//! it again changes nothing.
//!
//! # Method
//! 1. All edges of the feature are cut where they meet, at once, so that neighbours stay neighbours
//!    (`noding.rs`, `crossing.rs`).
//! 2. Pieces in one place become one. A sweep tells for each polygon how often its rings go around what is
//!    on either side (`winding.rs`); a piece bounds the polygon if the rule tells its sides apart.
//! 3. These are joined to rings (`tracing.rs`), which are validated like any others, and keep the names of
//!    the edges that they come from.

mod crossing;
mod noding;
mod tracing;
mod winding;

use std::cmp::Ordering;
use std::collections::{BTreeMap, HashSet};

use super::origins::{Origins, Source};
use super::reduce::{open_len, reduce};
use super::{
    CornerOrigin, Domain, DomainError, Entry, FillRule, Options, Origin, Place, Repair, Report,
};
use crate::geom::{Point, order_key};
use noding::{Noded, Strand};
use tracing::Directed;
use winding::Piece;

/// Where an edge comes from.
#[derive(Clone, Copy)]
struct Given {
    polygon: u32,
    ring: u32,
    /// Positions of its ends.
    index: u32,
    next: u32,
}

/// All edges of a feature.
#[derive(Default)]
struct Edges {
    given: Vec<Given>,
    strands: Vec<Strand>,
    entries: Vec<Entry>,
}

/// A use of a piece by a polygon.
#[derive(Clone, Copy)]
struct Use {
    polygon: u32,
    piece: u32,
    strand: u32,
    forward: bool,
}

impl Use {
    /// What crossing the piece from below to above adds.
    fn weight(&self) -> i32 {
        if self.forward { 1 } else { -1 }
    }
}

/// The domain of polygons that need not be valid.
///
/// Coordinates must be finite and in range.
pub(super) fn repaired(
    polygons: &[Vec<Vec<Point>>],
    options: &Options,
) -> Result<Domain, DomainError> {
    let Edges { given, strands, mut entries } = Edges::of(polygons, options.dissolve);
    let Noded { strands, meetings, snapped } = noding::node(strands, options.deadline)?;
    note_meetings(&given, &meetings, &mut entries);
    let moved = strands.iter().fold(0.0_f64, |most, strand| most.max(strand.moved));
    let (pieces, uses) = pieces_of(&strands, &given);
    note_overlaps(&given, &strands, &uses, &mut entries);
    let mut bounds = Vec::new();
    for of_polygon in uses.chunk_by(|a, b| a.polygon == b.polygon) {
        bounds.extend(bounds_of(&pieces, of_polygon, options.fill)?);
    }
    if options.dissolve {
        let before = bounds.len();
        bounds = dissolved(&pieces, &bounds)?;
        if bounds.len() < before {
            entries.push(Entry::of(Repair::Dissolved, 0, 0));
        }
    } else if let Some((at, [first, second])) = overlap(&pieces, &bounds)? {
        let place = |u: &Use| {
            let Given { polygon, ring, index, .. } =
                given[strands[u.strand as usize].edge as usize];
            Place { polygon, ring, index, lone: false }
        };
        return Err(DomainError::PolygonsOverlap {
            first: place(&first),
            second: place(&second),
            at,
        });
    }
    if snapped {
        entries.push(Entry::of(Repair::Snapped, 0, 0));
    }
    // Rings of polygons that are left.
    let mut rings: Vec<Vec<Vec<Directed>>> = vec![Vec::new(); polygons.len()];
    for of_polygon in bounds.chunk_by(|a, b| a.polygon == b.polygon) {
        let directed: Vec<Directed> = of_polygon
            .iter()
            .map(|bound| {
                let Piece { left, right } = pieces[bound.piece as usize];
                let (from, to) = if bound.forward { (left, right) } else { (right, left) };
                Directed { from, to, strand: bound.strand }
            })
            .collect();
        rings[of_polygon[0].polygon as usize] = tracing::rings(&directed)?
            .into_iter()
            .map(|ring| ring.into_iter().map(|k| directed[k as usize]).collect())
            .collect();
    }
    let points: Vec<Vec<Vec<Point>>> = rings
        .iter()
        .map(|polygon| polygon.iter().map(|ring| ring.iter().map(|d| d.from).collect()).collect())
        .collect();
    let regrouped = Options { regroup: true, ..Options::default() };
    let mut domain = Domain::validated(&points, &regrouped)?;
    let names = Names { given: &given, parts: parts_of(&strands), strands: &strands };
    // By the other rule their order means nothing.
    if options.fill == FillRule::EvenOdd {
        note_roles(&domain, &rings, &names, &mut entries);
    }
    let given_before: HashSet<u32> = entries
        .iter()
        .filter(|entry| entry.repair == Repair::DuplicateRing && entry.ring == 0)
        .map(|entry| entry.polygon)
        .collect();
    for (polygon, of_polygon) in (0..).zip(&rings) {
        let had_any = polygons[polygon as usize].iter().any(|ring| !ring.is_empty());
        let is_lost = of_polygon.is_empty() && had_any && !given_before.contains(&polygon);
        if is_lost && !options.dissolve {
            entries.push(Entry::of(Repair::EmptyPolygon, polygon, 0));
        }
    }
    let cut = domain.report.entries().iter().filter(|e| e.repair == Repair::CutInterior);
    entries.extend(cut.cloned());
    domain.origins = names.origins(&domain, &rings);
    entries.sort_by_key(|entry| (entry.polygon, entry.ring, entry.repair));
    domain.report = Report::rebuilt(entries, moved);
    Ok(domain)
}

impl Edges {
    fn of(polygons: &[Vec<Vec<Point>>], dissolve: bool) -> Self {
        let mut edges = Self::default();
        let mut known = HashSet::new();
        for (polygon, rings) in (0..).zip(polygons) {
            let at = |number: u32| Place { polygon, ring: number, index: 0, lone: false };
            let reduced = (0..).zip(rings).map(|(number, ring)| reduce(ring, at(number)));
            let reduced: Vec<_> = reduced.collect();
            let forms = rings.iter().zip(&reduced).map(|(ring, reduced)| match reduced {
                Ok(reduced) => form(ring, &reduced.kept),
                Err(_) => Vec::new(),
            });
            let forms: Vec<_> = forms.collect();
            if !dissolve && polygons.len() > 1 {
                let mut all = forms.clone();
                all.sort_unstable();
                if all.iter().any(|form| !form.is_empty()) && !known.insert(all) {
                    edges.entries.push(Entry::of(Repair::DuplicateRing, polygon, 0));
                    continue;
                }
            }
            let mut of_polygon = HashSet::new();
            for (number, ((ring, form), reduced)) in (0..).zip(rings.iter().zip(forms).zip(reduced))
            {
                if !form.is_empty() && !of_polygon.insert(form) {
                    edges.entries.push(Entry::of(Repair::DuplicateRing, polygon, number));
                    continue;
                }
                match reduced {
                    Ok(reduced) => {
                        let at = at(number);
                        edges.note(Repair::RepeatedPoint, at, reduced.repeated);
                        edges.note(Repair::StraightCorner, at, reduced.straight);
                        edges.note(Repair::Spike, at, reduced.spikes);
                        edges.add(ring, polygon, number);
                    }
                    // By either rule a ring on one line encloses nothing.
                    Err(_) if ring.is_empty() => {}
                    Err(_) => {
                        edges.entries.push(Entry::of(Repair::DegenerateHole, polygon, number));
                    }
                }
            }
        }
        edges
    }

    fn note(&mut self, repair: Repair, at: Place, indices: Vec<u32>) {
        if !indices.is_empty() {
            self.entries.push(Entry { indices, ..Entry::of(repair, at.polygon, at.ring) });
        }
    }

    fn add(&mut self, ring: &[Point], polygon: u32, number: u32) {
        let n = open_len(ring);
        for index in 0..n {
            let next = (index + 1) % n;
            let (from, to) = (ring[index], ring[next]);
            if from != to {
                self.strands.push(Strand::new(from, to, self.given.len() as u32));
                let (index, next) = (index as u32, next as u32);
                self.given.push(Given { polygon, ring: number, index, next });
            }
        }
    }
}

/// The corners that are kept of a ring, in an order that is the same for a ring that starts elsewhere or runs the
/// other way.
fn form(ring: &[Point], kept: &[u32]) -> Vec<(i64, i64)> {
    let key = |&k: &u32| (order_key(ring[k as usize].x), order_key(ring[k as usize].y));
    let mut there: Vec<_> = kept.iter().map(key).collect();
    let mut back: Vec<_> = there.iter().rev().copied().collect();
    for keys in [&mut there, &mut back] {
        let start = least_rotation(keys);
        keys.rotate_left(start);
    }
    there.min(back)
}

/// Where the rotation of a cyclic list starts that comes first, by comparing two starts at a time: O(n).
fn least_rotation<T: Ord>(list: &[T]) -> usize {
    let n = list.len();
    let (mut first, mut second, mut same) = (0, 1, 0);
    while first < n && second < n && same < n {
        match list[(first + same) % n].cmp(&list[(second + same) % n]) {
            Ordering::Equal => {
                same += 1;
                continue;
            }
            Ordering::Greater => first += same + 1,
            Ordering::Less => second += same + 1,
        }
        second += usize::from(first == second);
        same = 0;
    }
    first.min(second)
}

/// The pieces that strands are made of, and which polygon uses which of them, polygon by polygon.
fn pieces_of(strands: &[Strand], given: &[Given]) -> (Vec<Piece>, Vec<Use>) {
    let mut order: Vec<(Piece, bool, u32)> = strands
        .iter()
        .zip(0..)
        .map(|(strand, k)| {
            let forward = strand.from.lexicographic(strand.to).is_lt();
            let (left, right) =
                if forward { (strand.from, strand.to) } else { (strand.to, strand.from) };
            (Piece { left, right }, forward, k)
        })
        .collect();
    order.sort_unstable_by(|(a, _, k), (b, _, l)| {
        a.left.lexicographic(b.left).then(a.right.lexicographic(b.right)).then(k.cmp(l))
    });
    let mut pieces: Vec<Piece> = Vec::with_capacity(order.len());
    let mut uses = Vec::with_capacity(order.len());
    for (piece, forward, strand) in order {
        if pieces.last() != Some(&piece) {
            pieces.push(piece);
        }
        let polygon = given[strands[strand as usize].edge as usize].polygon;
        uses.push(Use { polygon, piece: pieces.len() as u32 - 1, strand, forward });
    }
    uses.sort_by_key(|u| u.polygon);
    (pieces, uses)
}

/// The pieces that bound what the rings of one polygon enclose, with the inside on their left.
fn bounds_of(pieces: &[Piece], uses: &[Use], fill: FillRule) -> Result<Vec<Use>, DomainError> {
    let mut own: Vec<(Use, i32)> = Vec::with_capacity(uses.len());
    for same in uses.chunk_by(|a, b| a.piece == b.piece) {
        let weight = match fill {
            FillRule::EvenOdd => same.len() as i32 % 2,
            FillRule::NonZero => same.iter().map(Use::weight).sum(),
        };
        if weight != 0 {
            own.push((same[0], weight));
        }
    }
    let is_inside = |number: i32| match fill {
        FillRule::EvenOdd => number % 2 != 0,
        FillRule::NonZero => number != 0,
    };
    selected(pieces, own, is_inside)
}

/// Those of some pieces, each with a weight, that have what is inside on one of their sides only.
fn selected(
    pieces: &[Piece],
    own: Vec<(Use, i32)>,
    is_inside: impl Fn(i32) -> bool,
) -> Result<Vec<Use>, DomainError> {
    let places: Vec<Piece> = own.iter().map(|(u, _)| pieces[u.piece as usize]).collect();
    let weights: Vec<i32> = own.iter().map(|&(_, weight)| weight).collect();
    let numbers = winding::numbers(&places, &weights)?;
    let bounds = own.into_iter().zip(numbers).filter_map(|((u, _), [below, above])| {
        let sides = [is_inside(below), is_inside(above)];
        (sides[0] != sides[1]).then_some(Use { forward: sides[1], ..u })
    });
    Ok(bounds.collect())
}

/// The bounds of all polygons laid on one another: each piece once, with the sum of its weights.
fn laid_together(bounds: &[Use]) -> Vec<(Use, i32)> {
    let mut bounds = bounds.to_vec();
    bounds.sort_by_key(|u| u.piece);
    let same = bounds.chunk_by(|a, b| a.piece == b.piece);
    same.map(|same| (same[0], same.iter().map(Use::weight).sum())).collect()
}

/// The bounds of all polygons together, as those of the first one.
fn dissolved(pieces: &[Piece], bounds: &[Use]) -> Result<Vec<Use>, DomainError> {
    let own = laid_together(bounds)
        .into_iter()
        .filter(|&(_, weight)| weight != 0)
        .map(|(u, weight)| (Use { polygon: 0, ..u }, weight))
        .collect();
    selected(pieces, own, |number| number > 0)
}

/// A place where two polygons overlap, and a piece of either of them, by their numbers.
fn overlap(pieces: &[Piece], bounds: &[Use]) -> Result<Option<(Point, [Use; 2])>, DomainError> {
    let polygons: Vec<&[Use]> = bounds.chunk_by(|a, b| a.polygon == b.polygon).collect();
    if polygons.len() < 2 {
        return Ok(None);
    }
    let place = |u: &Use| pieces[u.piece as usize];
    let (own, weights): (Vec<Piece>, Vec<i32>) =
        laid_together(bounds).iter().map(|(u, weight)| (place(u), *weight)).unzip();
    // How many polygons there are on either side of a piece.
    let found = winding::numbers(&own, &weights)?;
    let Some(k) = found.iter().position(|sides| sides.iter().any(|&side| side > 1)) else {
        return Ok(None);
    };
    let at = own[k].left;
    let side = usize::from(found[k][1] > 1);
    let mut both = Vec::new();
    for &of_one in &polygons {
        // A piece without weight tells what is beside it.
        let is_own = |u: &Use| place(u) == own[k];
        let number = match of_one.iter().find(|u| is_own(u)) {
            Some(u) => i32::from(u.forward == (side == 1)),
            None => {
                let (mut places, mut weights) = (vec![own[k]], vec![0]);
                places.extend(of_one.iter().map(place));
                weights.extend(of_one.iter().map(Use::weight));
                winding::numbers(&places, &weights)?[0][side]
            }
        };
        if number > 0 {
            both.push(of_one[0]);
        }
    }
    match both[..] {
        [first, second, ..] => Ok(Some((at, [first, second]))),
        _ => Err(DomainError::Internal { stage: "overlap" }),
    }
}

/// What was found of a ring, by polygon, ring and kind: positions in it, and places in the plane.
type Found = BTreeMap<(u32, u32, Repair), (Vec<u32>, Vec<Point>)>;

/// Reports where edges met, by the rings that they belong to.
fn note_meetings(given: &[Given], meetings: &[noding::Meeting], entries: &mut Vec<Entry>) {
    let mut found = Found::new();
    for meeting in meetings.iter().filter(|meeting| meeting.crosses) {
        for edge in meeting.edges {
            let Given { polygon, ring, index, .. } = given[edge as usize];
            let (indices, points) = found.entry((polygon, ring, Repair::Crossing)).or_default();
            indices.push(index);
            points.push(meeting.at);
        }
    }
    add_found(found, entries);
}

/// Reports where edges of one polygon lie on each other.
fn note_overlaps(given: &[Given], strands: &[Strand], uses: &[Use], entries: &mut Vec<Entry>) {
    let mut found = Found::new();
    let overlaps = uses.chunk_by(|a, b| (a.polygon, a.piece) == (b.polygon, b.piece));
    for u in overlaps.filter(|same| same.len() > 1).flatten() {
        let strand = &strands[u.strand as usize];
        let Given { polygon, ring, index, .. } = given[strand.edge as usize];
        let (indices, points) = found.entry((polygon, ring, Repair::Overlap)).or_default();
        indices.push(index);
        points.push(strand.from);
    }
    add_found(found, entries);
}

fn add_found(found: Found, entries: &mut Vec<Entry>) {
    for ((polygon, ring, repair), (mut indices, mut points)) in found {
        indices.sort_unstable();
        indices.dedup();
        points.sort_unstable_by_key(|p| (order_key(p.x), order_key(p.y)));
        points.dedup();
        entries.push(Entry { indices, points, ..Entry::of(repair, polygon, ring) });
    }
}

/// Reports rings that are whole and have become outer rings or holes against their place.
fn note_roles(
    domain: &Domain,
    rings: &[Vec<Vec<Directed>>],
    names: &Names,
    entries: &mut Vec<Entry>,
) {
    let mut known = HashSet::new();
    for walk in domain.walks() {
        let polygon = walk.polygon as usize;
        let origin = domain.origin(walk.first);
        let pieces = &rings[polygon][origin.ring as usize];
        let of = |d: &Directed| {
            let given = names.given[names.strands[d.strand as usize].edge as usize];
            (given.polygon, given.ring)
        };
        let first = of(&pieces[0]);
        let is_whole = pieces.iter().all(|d| of(d) == first);
        if is_whole && walk.hole != (first.1 > 0) && known.insert(first) {
            entries.push(Entry::of(Repair::Regrouped, first.0, first.1));
        }
    }
}

/// The number of each strand among those of its edge.
fn parts_of(strands: &[Strand]) -> Vec<[u32; 2]> {
    let mut parts = Vec::with_capacity(strands.len());
    for same in strands.chunk_by(|a, b| a.edge == b.edge) {
        let n = same.len() as u32;
        parts.extend((0..n).map(|part| [part, n]));
    }
    parts
}

/// The first piece of a ring, from one of them on, of which something is true.
fn from(ring: &[Directed], first: usize, is_it: impl Fn(&Directed) -> bool) -> &Directed {
    let n = ring.len();
    let found = (first..first + n).map(|k| &ring[k % n]).find(|&piece| is_it(piece));
    found.unwrap_or(&ring[first % n])
}

/// What names are made of.
struct Names<'a> {
    given: &'a [Given],
    strands: &'a [Strand],
    /// The number of each strand along its edge, and of how many.
    parts: Vec<[u32; 2]>,
}

impl Names<'_> {
    /// The names of a domain's edges, each of them one piece of the rings or a few that go straight on.
    fn origins(&self, domain: &Domain, rings: &[Vec<Vec<Directed>>]) -> Origins {
        let mut records = Vec::with_capacity(domain.edges().len());
        for walk in domain.walks() {
            for edge in walk.first..walk.first + walk.len {
                let (new, start) = (domain.origin(edge), domain.edge(edge).start);
                let polygon = &rings[new.polygon as usize];
                let ring = &polygon[new.ring as usize];
                let piece = from(ring, new.index as usize, |d| d.from == start);
                let CornerOrigin { ring, index, part, .. } = new.corner;
                let ring = &polygon[ring as usize];
                // The piece before the corner, or, where another ring touches, one that straight ones
                // follow.
                let index = index as usize + if part == 0 { ring.len() - 1 } else { 0 };
                let into = from(ring, index, |d| d.to == start);
                let given = self.given[self.strands[piece.strand as usize].edge as usize];
                records.push(Origin {
                    polygon: given.polygon,
                    ring: given.ring,
                    index: given.index,
                    part: self.parts[piece.strand as usize][0],
                    corner: self.end_name(into),
                });
            }
        }
        let sources = domain.walks().iter().map(|walk| Source::Pieces { first: walk.first });
        Origins { sources: sources.collect(), given: Vec::new(), records }
    }

    /// The name of the corner where a piece ends.
    fn end_name(&self, piece: &Directed) -> CornerOrigin {
        let strand = &self.strands[piece.strand as usize];
        let given = self.given[strand.edge as usize];
        let [part, n] = self.parts[piece.strand as usize];
        let is_along = strand.to == piece.to;
        let Given { polygon, ring, .. } = given;
        let end = if is_along { part + 1 } else { part };
        match end {
            0 => CornerOrigin { polygon, ring, index: given.index, part: 0 },
            end if end == n => CornerOrigin { polygon, ring, index: given.next, part: 0 },
            end => CornerOrigin { polygon, ring, index: given.index, part: end },
        }
    }
}
