//! Cuts edges where they meet, until they meet at their ends only.
//!
//! # Contract
//! Afterwards two strands share nothing, or an end, or both ends. No end that an edge had moves; a strand
//! is within its `moved` of the edge that it is a part of. Always ends.
//!
//! # Method
//! Crossings are computed exactly and rounded to the nearest doubles, and edges are cut there, and where
//! an end lies on them. A strand between rounded places is no part of its edge any more, but within an ulp
//! or so of it, and may meet something else: it is asked again. Mostly the second or the third round finds
//! nothing. Where [`ROUNDS`] are not enough, or strands become many, all is begun anew by snap rounding
//! (Hobby 1999): on a grid, ends and crossings go to the middle of their cells, and so does each edge that
//! passes through a cell in which one of them is. In theory one pass is enough; it is asked again as well,
//! and the grid gets coarser until it is.

use std::ops::Range;
use std::time::Instant;

use super::crossing::{Crossing, LEAST, scaled};
use crate::domain::DomainError;
use crate::geom::{BoundsTree, Point, Rect, U, Visitor, order_key, orient2d};

/// How often edges are cut before they are snapped to a grid.
const ROUNDS: u32 = 12;

/// How many times more strands there may be than after the first round: bundles of edges within an ulp of
/// one another cross again and again.
const GROWTH: usize = 4;

/// Most strands.
const MOST: usize = 1 << 24;

/// Cells of the first grid along the largest coordinate, and how many times fewer each next one has, as
/// powers of two.
const CELLS: i32 = 46;
const COARSER: i32 = 6;

/// A part of an edge, in its direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Strand {
    pub(super) from: Point,
    pub(super) to: Point,
    /// Number of the edge.
    pub(super) edge: u32,
    /// How far it may be from that.
    pub(super) moved: f64,
    /// Whether it was not asked about yet.
    is_new: bool,
}

/// Where an edge met another one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Meeting {
    /// The two edges.
    pub(super) edges: [u32; 2],
    pub(super) at: Point,
    /// Whether they crossed there, each in its inside; else one of them ended on the other one.
    pub(super) crosses: bool,
}

/// What noding found and made.
pub(super) struct Noded {
    /// Edge by edge, in their order along it.
    pub(super) strands: Vec<Strand>,
    /// Where the edges as given meet, other than in common ends.
    pub(super) meetings: Vec<Meeting>,
    /// Whether ends of edges were moved.
    pub(super) snapped: bool,
}

impl Strand {
    pub(super) fn new(from: Point, to: Point, edge: u32) -> Self {
        Self { from, to, edge, moved: 0.0, is_new: true }
    }

    fn bounds(&self) -> Rect {
        Rect::EMPTY.with(self.from).with(self.to)
    }

    /// Whether a point on its line lies between its ends.
    fn is_inside(&self, p: Point) -> bool {
        let (from, to) = (self.from.lexicographic(p), p.lexicographic(self.to));
        from == to && from.is_ne()
    }
}

/// Where to cut a strand, and how far that is from where it should be.
#[derive(Clone, Copy)]
struct Cut {
    strand: u32,
    at: Point,
    off: f64,
}

/// Cuts strands, one for each edge.
///
/// # Errors
/// If that would make too many of them, or the time is up.
pub(super) fn node(edges: Vec<Strand>, deadline: Option<Instant>) -> Result<Noded, DomainError> {
    let mut meetings = Vec::new();
    let (mut strands, mut first) = (edges.clone(), 0);
    for round in 0..ROUNDS {
        let mut cuts =
            cuts(&strands, if round == 0 { Some(&mut meetings) } else { None }, deadline)?;
        if cuts.is_empty() {
            return Ok(Noded { strands, meetings, snapped: false });
        }
        strands = split(&strands, &mut cuts)?;
        if round == 0 {
            first = strands.len();
        } else if strands.len() > GROWTH * first {
            break;
        }
    }
    let largest = edges.iter().flat_map(|s| [s.from, s.to]);
    let largest = largest.fold(0.0_f64, |most, p| most.max(p.x.abs()).max(p.y.abs()));
    let size = ilogb(largest) + 1;
    let mut cells = CELLS;
    while cells > 0 {
        let strands = snapped(&edges, size - cells, deadline)?;
        if cuts(&strands, None, deadline)?.is_empty() {
            return Ok(Noded { strands, meetings, snapped: true });
        }
        cells -= COARSER;
    }
    Err(DomainError::Internal { stage: "noding" })
}

/// The exponent of a positive double.
fn ilogb(value: f64) -> i32 {
    (value.to_bits() >> 52 & 0x7ff) as i32 - 1023
}

/// Looks at the clock now and then.
fn check(deadline: Option<Instant>, k: u32) -> Result<(), DomainError> {
    let is_over = k.is_multiple_of(64) && deadline.is_some_and(|end| Instant::now() >= end);
    if is_over { Err(DomainError::TimeLimit) } else { Ok(()) }
}

/// Where strands meet, of which at least one is new.
fn cuts(
    strands: &[Strand],
    mut meetings: Option<&mut Vec<Meeting>>,
    deadline: Option<Instant>,
) -> Result<Vec<Cut>, DomainError> {
    let tree = BoundsTree::new(0, strands.len() as u32, |k| strands[k as usize].bounds());
    let mut cuts = Vec::new();
    let mut near = Near { bounds: Rect::EMPTY, found: Vec::new() };
    for (k, strand) in (0..).zip(strands).filter(|(_, strand)| strand.is_new) {
        check(deadline, k)?;
        near.bounds = strand.bounds();
        near.found.clear();
        tree.visit(&mut near);
        for &other in &near.found {
            // Two new ones once.
            if other == k || (other < k && strands[other as usize].is_new) {
                continue;
            }
            meet(strands, [k, other], &mut cuts, meetings.as_deref_mut());
        }
        if cuts.len() > MOST {
            return Err(DomainError::TooLarge { found: strands.len() + cuts.len() });
        }
    }
    Ok(cuts)
}

/// The strands whose boxes meet a box.
struct Near {
    bounds: Rect,
    found: Vec<u32>,
}

impl Visitor for Near {
    fn enters(&self, bounds: &Rect, _: Range<u32>) -> bool {
        self.bounds.meets(bounds)
    }

    fn item(&mut self, item: u32) {
        self.found.push(item);
    }
}

fn meet(
    strands: &[Strand],
    [k, l]: [u32; 2],
    cuts: &mut Vec<Cut>,
    meetings: Option<&mut Vec<Meeting>>,
) {
    let [s, t] = [strands[k as usize], strands[l as usize]];
    let is_apart = |a: f64, b: f64| (a > 0.0 && b > 0.0) || (a < 0.0 && b < 0.0);
    if !s.bounds().meets(&t.bounds()) {
        return;
    }
    let of_s = [s.from, s.to].map(|p| orient2d(t.from, t.to, p));
    if is_apart(of_s[0], of_s[1]) {
        return;
    }
    let of_t = [t.from, t.to].map(|p| orient2d(s.from, s.to, p));
    if is_apart(of_t[0], of_t[1]) {
        return;
    }
    let mut met: Option<(Point, bool)> = None;
    // Ends of the one on the other one.
    for (strand, number, sides, ends) in
        [(&t, l, of_s, [s.from, s.to]), (&s, k, of_t, [t.from, t.to])]
    {
        for (side, end) in sides.into_iter().zip(ends) {
            if side == 0.0 && strand.is_inside(end) {
                cuts.push(Cut { strand: number, at: end, off: 0.0 });
                met = Some((end, false));
            }
        }
    }
    if of_s.iter().chain(&of_t).all(|&side| side != 0.0) {
        let at = Crossing::of([s.from, s.to], [t.from, t.to]).rounded();
        // Half an ulp of each coordinate, or what was taken for 0.
        let off = (2.0 * U * (at.x.abs() + at.y.abs())).max(2.0 * LEAST);
        for (strand, number) in [(&s, k), (&t, l)] {
            // Rounding may have led to an end of one of them, but then not of both.
            if at != strand.from && at != strand.to {
                cuts.push(Cut { strand: number, at, off });
            }
        }
        met = Some((at, true));
    }
    // The same edge given twice meets itself all along.
    let is_same = (s.from == t.from && s.to == t.to) || (s.from == t.to && s.to == t.from);
    if is_same {
        met = Some((s.from, false));
    }
    if let (Some(meetings), Some((at, crosses))) = (meetings, met) {
        meetings.push(Meeting { edges: [s.edge, t.edge], at, crosses });
    }
}

/// Cuts strands.
fn split(strands: &[Strand], cuts: &mut [Cut]) -> Result<Vec<Strand>, DomainError> {
    if strands.len() + cuts.len() > MOST {
        return Err(DomainError::TooLarge { found: strands.len() + cuts.len() });
    }
    cuts.sort_unstable_by_key(|cut| {
        let strand = &strands[cut.strand as usize];
        // Along a strand neither coordinate turns back, not even when they are rounded.
        let along = |value: f64, from: f64, to: f64| {
            if from <= to { order_key(value) } else { !order_key(value) }
        };
        let (Point { x, y }, from, to) = (cut.at, strand.from, strand.to);
        (cut.strand, along(x, from.x, to.x), along(y, from.y, to.y))
    });
    let mut result = Vec::with_capacity(strands.len() + cuts.len());
    let mut rest = &*cuts;
    for (k, strand) in (0..).zip(strands) {
        let n = rest.iter().take_while(|cut| cut.strand == k).count();
        let (own, others) = rest.split_at(n);
        rest = others;
        let mut from = strand.from;
        let off = own.iter().fold(0.0_f64, |most, cut| most.max(cut.off));
        let moved = (strand.moved + off) * (1.0 + 4.0 * U);
        let is_new = off > 0.0;
        for cut in own.iter().filter(|cut| cut.at != strand.from && cut.at != strand.to) {
            if cut.at != from {
                result.push(Strand { from, to: cut.at, moved, is_new, ..*strand });
                from = cut.at;
            }
        }
        result.push(Strand { from, to: strand.to, moved, is_new, ..*strand });
    }
    Ok(result)
}

/// Edges rounded to a grid, through the middle of each cell that they pass in which something is.
fn snapped(
    edges: &[Strand],
    exponent: i32,
    deadline: Option<Instant>,
) -> Result<Vec<Strand>, DomainError> {
    let cell = scaled(1.0, exponent);
    let middle = |v: f64| (v / cell).round() * cell;
    let of = |p: Point| Point::new(middle(p.x), middle(p.y));
    // Where something is: ends first, in boundary order.
    let mut hot: Vec<Point> = edges.iter().flat_map(|s| [of(s.from), of(s.to)]).collect();
    let tree = BoundsTree::new(0, edges.len() as u32, |k| edges[k as usize].bounds());
    let mut near = Near { bounds: Rect::EMPTY, found: Vec::new() };
    for (k, s) in (0..).zip(edges) {
        check(deadline, k)?;
        near.bounds = s.bounds();
        near.found.clear();
        tree.visit(&mut near);
        for t in near.found.iter().filter(|&&other| other > k).map(|&l| &edges[l as usize]) {
            let differ = |a: f64, b: f64| (a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0);
            let crosses = differ(orient2d(t.from, t.to, s.from), orient2d(t.from, t.to, s.to))
                && differ(orient2d(s.from, s.to, t.from), orient2d(s.from, s.to, t.to));
            if crosses {
                hot.push(Crossing::of([s.from, s.to], [t.from, t.to]).on_grid(exponent));
            }
        }
        if hot.len() > MOST {
            return Err(DomainError::TooLarge { found: hot.len() });
        }
    }
    let key = |p: &Point| (order_key(p.x), order_key(p.y));
    hot.sort_unstable_by_key(key);
    hot.dedup();
    let cells = BoundsTree::new(0, hot.len() as u32, |k| Rect::EMPTY.with(hot[k as usize]));
    let half = 0.5 * cell;
    let moved = 2.0 * cell;
    let mut result = Vec::with_capacity(2 * edges.len());
    for (k, edge) in (0..).zip(edges) {
        check(deadline, k)?;
        let mut passed: Vec<Point> = Vec::new();
        let bounds = edge.bounds();
        near.bounds = Rect {
            min: bounds.min - Point::new(cell, cell),
            max: bounds.max + Point::new(cell, cell),
        };
        near.found.clear();
        cells.visit(&mut near);
        passed
            .extend(near.found.iter().map(|&k| hot[k as usize]).filter(|&p| passes(edge, p, half)));
        let (from, to) = (of(edge.from), of(edge.to));
        let way = edge.to - edge.from;
        // In their order along the edge.
        passed.sort_by(|&p, &q| {
            let order = way.dot(p - from).total_cmp(&way.dot(q - from));
            order.then(key(&p).cmp(&key(&q)))
        });
        let mut last = from;
        for p in passed.into_iter().filter(|&p| p != from && p != to).chain([to]) {
            if p != last {
                result.push(Strand { from: last, to: p, edge: edge.edge, moved, is_new: true });
                last = p;
            }
        }
        if result.len() > MOST {
            return Err(DomainError::TooLarge { found: result.len() });
        }
    }
    Ok(result)
}

/// Whether an edge passes through the closed cell around a point.
fn passes(edge: &Strand, p: Point, half: f64) -> bool {
    let corner = |x: f64, y: f64| Point::new(p.x + x * half, p.y + y * half);
    let cell = Rect { min: corner(-1.0, -1.0), max: corner(1.0, 1.0) };
    if !edge.bounds().meets(&cell) {
        return false;
    }
    let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    let sides = corners.map(|c| orient2d(edge.from, edge.to, c));
    !(sides.iter().all(|&s| s > 0.0) || sides.iter().all(|&s| s < 0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn random(seed: &mut u64) -> f64 {
        *seed =
            seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*seed >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn some_edges(seed: &mut u64, n: u32, size: f64) -> Vec<Strand> {
        let mut point = || {
            Point::new(size * (random(seed) * 40.0).floor(), size * (random(seed) * 40.0).floor())
                + Point::new(1.0 / 3.0, 0.1)
        };
        (0..n)
            .map(|edge| (edge, point(), point()))
            .filter(|(_, a, b)| a != b)
            .map(|(edge, a, b)| Strand::new(a, b, edge))
            .collect()
    }

    /// Whether strands are whole edges from end to end, each near its edge.
    fn follow(edges: &[Strand], strands: &[Strand]) {
        for same in strands.chunk_by(|a, b| a.edge == b.edge) {
            let edge = edges.iter().find(|e| e.edge == same[0].edge).unwrap();
            assert!(same.windows(2).all(|pair| pair[0].to == pair[1].from));
            let way = edge.to - edge.from;
            for strand in same {
                for p in [strand.from, strand.to] {
                    let off = (way.cross(p - edge.from) / way.norm()).abs();
                    assert!(off <= strand.moved + 1e-14, "{off} {}", strand.moved);
                }
            }
        }
    }

    #[test]
    fn edges_are_cut_until_they_meet_at_ends_only() {
        let mut seed = 1;
        for size in [1.0, f64::EPSILON, 1e-9] {
            for _ in 0..60 {
                let edges = some_edges(&mut seed, 24, size);
                let Noded { strands, snapped, .. } = node(edges.clone(), None).unwrap();
                assert!(cuts(&strands, None, None).unwrap().is_empty());
                follow(&edges, &strands);
                assert!(!snapped);
            }
        }
    }

    #[test]
    fn a_crossing_that_is_taken_for_the_origin_moves_its_edges() {
        let tiny = scaled(1.0, -200);
        let p = Point::new;
        let edges = vec![
            Strand::new(p(-1.0, -tiny), p(3.0, tiny), 0),
            Strand::new(p(0.0, -1.0), p(0.0, 1.0), 1),
        ];
        let Noded { strands, .. } = node(edges, None).unwrap();
        assert_eq!(strands.iter().filter(|s| s.from == Point::default()).count(), 2);
        assert!(strands.iter().all(|s| s.moved >= tiny / 2.0), "{strands:?}");
    }

    #[test]
    fn snapped_edges_meet_at_ends_only_on_any_grid() {
        let mut seed = 2;
        for exponent in [-40, -20, -6, -3, -1, 0, 1, 3] {
            for _ in 0..40 {
                let edges = some_edges(&mut seed, 24, 1.0);
                let strands = snapped(&edges, exponent, None).unwrap();
                assert!(cuts(&strands, None, None).unwrap().is_empty(), "{exponent} {edges:?}");
                let cell = scaled(1.0, exponent);
                let is_on = |v: f64| (v / cell).fract() == 0.0;
                assert!(strands.iter().all(|s| is_on(s.from.x) && is_on(s.to.y)));
                follow(&edges, &strands);
            }
        }
    }
}
